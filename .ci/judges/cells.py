#!/usr/bin/env python3
"""Judges clipped cells as GEOS does: every polygon valid, all together a coverage, their union the region, its corners kept.

    .ci/judges/cells.py PROGRAM FOLDER [SET...]
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import shapely

from sets import planar


def regions(points):
    """What each kind of diagram is asked for, and the region that its cells are to cover."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = high - low
    if not (size > 0).all():
        low, high = low - 1.0, high + 1.0
        size = high - low
    def text(*corners):
        return ",".join(repr(float(x)) for corner in corners for x in corner)

    box = text(low, high)
    around = shapely.box(*low, *high)
    near, far = low + 0.21 * size, low + 0.83 * size
    inner = shapely.box(*near, *far)
    middle = shapely.box(*(low + 0.4 * size), *(low + 0.6 * size))
    notch = shapely.Polygon([low + s * size for s in ([0.02, 0.03], [0.97, 0.05], [0.5, 0.3], [0.96, 0.98], [0.03, 0.9])])
    polygon = shapely.Polygon(notch.exterior, [middle.exterior]) if notch.contains(middle) else notch
    hull = shapely.MultiPoint(points).convex_hull
    yield "box", ["--box", box], around
    yield "inner box", ["--box", text(near, far)], inner
    if hull.geom_type == "Polygon":
        yield "hull", ["--clip", "hull"], None
    yield "polygon", polygon, polygon
    if len(np.unique(points, axis=0)) > 4:
        yield "order 2", ["--order", "2", "--box", box], around
        yield "order 3", ["--order", "3", "--box", box], around
    yield "weights", ["--weights", "weights.csv", "--box", box], around
    yield "relaxed", ["--relax", "3", "--box", box], around
    # Equal areas need room between the numbers, and squares of sizes.
    has_room = size.max() > 1e6 * np.spacing(np.abs(high).max()) and abs(np.log2(size.max())) < 300
    if len(points) < 350 and len(np.unique(points, axis=0)) == len(points) and has_room:
        yield "equal areas", ["--areas", "equal", "--box", box], around


def judge(cells, region):
    """What is wrong with cells that are to cover a region, as words."""
    faults = []
    invalid = int((~shapely.is_valid(cells)).sum())
    if invalid:
        faults.append(f"{invalid} of {len(cells)} invalid")
    if not shapely.coverage_is_valid(cells):
        faults.append("no coverage")
    try:
        union = shapely.union_all(cells)
    except shapely.GEOSException:
        return [*faults, "union raises"]
    if region is not None:
        low = np.array(region.bounds)
        room = 1e-9 * region.area + 8 * np.spacing(np.abs(low).max()) * region.length
        if not abs(union.area - region.area) <= room:
            faults.append(f"union {union.area} of {region.area}")
        corners = {tuple(corner) for corner in shapely.get_coordinates(region)}
        missing = corners - {tuple(corner) for corner in shapely.get_coordinates(cells)}
        if missing:
            faults.append(f"{len(missing)} corners of the region are missing")
    return faults


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    runs = bad = 0
    for name, points in planar().items():
        if sys.argv[3:] and name not in sys.argv[3:]:
            continue
        np.save(folder / "points.npy", points)
        size = np.ptp(points, axis=0).max()
        weights = (0.1 * size) ** 2 * np.random.default_rng(3).random(len(points))
        np.savetxt(folder / "weights.csv", weights, fmt="%.17g")
        for kind, how, region in regions(points):
            if not isinstance(how, list):
                (folder / "region.geojson").write_text(shapely.to_geojson(how))
                how = ["--clip", "region.geojson"]
                region = shapely.from_geojson((folder / "region.geojson").read_text())
            command = [program, "voronoi", "points.npy", "-q", "-o", "cells.geojson", *how]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            runs += 1
            if done.returncode:
                faults = [done.stderr.strip().splitlines()[0]]
            else:
                features = json.loads((folder / "cells.geojson").read_text())["features"]
                found = [json.dumps(f["geometry"]) for f in features if f["geometry"]]
                with np.errstate(all="ignore"):
                    faults = judge(shapely.from_geojson(found), region)
            if faults:
                bad += 1
                print(f"{name}, {kind}: {'; '.join(faults)}")
    print(f"cells: {runs} diagrams, {bad} with a fault")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
