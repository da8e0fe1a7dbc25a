#!/usr/bin/env python3
"""Judges alpha shapes in space as trimesh does: watertight with --manifold, wound alike, with the triangles of the outline.

.ci/judges/alpha.py PROGRAM FOLDER [SET...]
"""

import numpy as np
import trimesh
from judging import Judge
from sets import solids


def main():
    """Judges all sets."""
    judge = Judge("alpha shapes")
    for name, points in judge.chosen(solids()):
        np.save(judge.folder / "points.npy", points)
        size = np.ptp(points, axis=0).max()
        for how in [["--optimal"], ["--radius", repr(float(size / 5))], ["--radius", repr(float(size / 9))]]:
            shape = ["alpha", "points.npy", "--dim", "3", *how]
            faults = judge.run(*shape, "-o", "pinched.ply")
            faults = faults or judge.run(*shape, "--manifold", "-o", "apart.ply", "-o", "apart.obj")
            if not faults:
                # As they are written: without joining what is at one place.
                pinched, apart, obj = (
                    trimesh.load(judge.folder / file, process=False, force="mesh")
                    for file in ["pinched.ply", "apart.ply", "apart.obj"]
                )
                if len(apart.faces) and not (apart.is_watertight and apart.is_winding_consistent):
                    faults.append("not watertight")
                if len(apart.faces) and len(obj.faces) != len(apart.faces):
                    faults.append("obj has other faces than ply")
                if not np.array_equal(pinched.triangles, apart.triangles):
                    faults.append("the triangles are not those of the outline")
                edges, counts = np.unique(apart.edges_sorted, axis=0, return_counts=True)
                if (counts != 2).any():
                    faults.append(f"{int((counts != 2).sum())} of {len(edges)} edges have not two faces")
            judge.told(f"{name}, {' '.join(how)}", faults)
    judge.end()


if __name__ == "__main__":
    main()
