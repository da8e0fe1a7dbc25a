#!/usr/bin/env python3
"""Judges surfaces as others read them: no turned or flat faces in ply, obj and stl, the same points bit for bit elsewhere.

.ci/judges/surfaces.py PROGRAM FOLDER [SET...]
"""

import geopandas
import numpy as np
import shapely
import trimesh
from judging import Judge, quiet_read
from sets import relief


def judge_faces(path, hull, rounded):
    """No face is turned over or flat from above, and together they have the area of the hull."""
    mesh = trimesh.load(path, process=False, force="mesh")
    corners = np.asarray(mesh.triangles, dtype=float)[..., :2]
    # What is shifted for single precision, and rounded in it, has the area but for that.
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    faults = []
    if not (areas > 0).all():
        faults.append(f"{path.suffix}: {int((areas <= 0).sum())} of {len(areas)} faces turned or flat")
    if abs(areas.sum() - hull.area) > rounded * hull.area:
        faults.append(f"{path.suffix}: the area is {areas.sum()} of {hull.area}")
    return faults


def main():
    """Judges all sets."""
    judge = Judge("surfaces")
    for name, points in judge.chosen(relief()):
        np.save(judge.folder / "points.npy", points)
        hull = shapely.MultiPoint(points[:, :2]).convex_hull
        files = ["s.ply", "s.obj", "s.stl", "s.vtu", "s.msh", "s.geojson", "s.npy"]
        outputs = [word for file in files for word in ["-o", file]]
        faults = judge.run("triangulate", "points.npy", "--drop-slivers", "1e-9", *outputs)
        if not faults:
            triangles = np.load(judge.folder / "s.npy")
            expected = {tuple(sorted(map(tuple, t))) for t in points[triangles][..., :2].tolist()}
            for file in files[:3]:
                faults += judge_faces(judge.folder / file, hull, 1e-4 if file == "s.stl" else 1e-9)
            for file in files[3:5]:
                mesh = quiet_read(judge.folder / file)
                found = mesh.points[mesh.cells_dict["triangle"]][..., :2].tolist()
                if {tuple(sorted(map(tuple, t))) for t in found} != expected:
                    faults.append(f"{file}: other triangles")
            rings = shapely.get_coordinates(geopandas.read_file(judge.folder / "s.geojson").geometry).reshape(-1, 4, 2)
            if {tuple(sorted(map(tuple, t[:3]))) for t in rings.tolist()} != expected:
                faults.append("s.geojson: other triangles")
        judge.told(name, faults)
    judge.end()


if __name__ == "__main__":
    main()
