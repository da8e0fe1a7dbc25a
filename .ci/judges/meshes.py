#!/usr/bin/env python3
"""Judges meshes of polygons with NumPy and GEOS: every side once in each direction, the area and border of the polygon, angles.

.ci/judges/meshes.py PROGRAM FOLDER [SET...]
"""

import json
from collections import Counter

import numpy as np
import shapely
from judging import Judge, quiet_read
from sets import polygons

ANGLE = 20.0


def smallest_angles(corners):
    """In degrees."""
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return np.degrees(np.arctan2(cross, (u * v).sum(axis=-1))).min(axis=1)


def judge_mesh(path, polygon, stats):
    """What is wrong with a mesh."""
    mesh = quiet_read(path)
    points, triangles = mesh.points[:, :2], mesh.cells_dict.get("triangle", np.empty((0, 3), int))
    corners = points[triangles]
    faults = []
    sides = Counter((int(t[k]), int(t[(k + 1) % 3])) for t in triangles for k in range(3))
    if any(count > 1 for count in sides.values()):
        faults.append("two triangles have a side in the same direction")
    border = [(a, b) for a, b in sides if (b, a) not in sides]
    room = 8 * np.spacing(np.abs(polygon.bounds).max())
    lines = shapely.linestrings(points[np.array(border)])
    off = shapely.distance(shapely.points(points[np.unique(border)]), polygon.boundary)
    if len(border) and off.max() > room:
        faults.append(f"the border is {off.max()} beside that of the polygon")
    if abs(shapely.length(lines).sum() - polygon.boundary.length) > 1e-9 * polygon.boundary.length:
        faults.append("the border has another length than that of the polygon")
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    if not (areas > 0).all():
        faults.append(f"{int((areas <= 0).sum())} triangles turned or flat")
    if abs(areas.sum() - polygon.area) > 1e-9 * polygon.area + room * polygon.length:
        faults.append(f"the area is {areas.sum()} of {polygon.area}")
    bad = int((smallest_angles(corners) < ANGLE - 1e-6).sum())
    told = sum(stats["left"].values())
    if bad > told:
        faults.append(f"{bad} triangles have a smaller angle, {told} are told")
    return faults


def main():
    """Judges all sets."""
    judge = Judge("meshes")
    for name, polygon in judge.chosen(polygons()):
        (judge.folder / "polygon.geojson").write_text(shapely.to_geojson(polygon))
        size = polygon.area**0.5
        areas = ["--max-area", repr(polygon.area / 60), "--conforming"]
        for how in [[], ["--max-edge", repr(size / 6)], areas, ["--edge", repr(size / 12)]]:
            faults = judge.run(
                "mesh", "polygon.geojson", "--min-angle", str(ANGLE), *how, "-o", "mesh.vtu", "--stats", "stats.json"
            )
            if not faults:
                stats = json.loads((judge.folder / "stats.json").read_text())
                faults = judge_mesh(judge.folder / "mesh.vtu", polygon, stats)
            judge.told(f"{name}{', ' * bool(how)}{' '.join(how)}", faults)
    judge.end()


if __name__ == "__main__":
    main()
