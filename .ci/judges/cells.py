#!/usr/bin/env python3
"""Judges clipped cells as GEOS does: every polygon valid, all together a coverage, their union the region, its corners kept.

.ci/judges/cells.py PROGRAM FOLDER [SET...]
"""

import json

import numpy as np
import shapely
from judging import Judge, uncovered
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
    yield "merged", ["--merge", "auto", "--box", box], around
    yield "merged far", ["--merge", repr(float(size.max() / 16)), "--box", text(near, far)], inner
    # A hole with two sides on the borders of a lattice's cells.
    middle = points[len(points) // 2]
    others = np.abs(points - middle).max(axis=1)
    step = others[others > 0].min() / 2
    hole = shapely.box(middle[0] - step, middle[1] - step / 2, middle[0] + step, middle[1] + step / 2)
    if around.contains_properly(hole):
        holed = shapely.Polygon(around.exterior, [hole.exterior])
        yield "hole on borders", holed, holed
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
    faults = uncovered(cells, region)
    if region is not None:
        corners = {tuple(corner) for corner in shapely.get_coordinates(region)}
        missing = corners - {tuple(corner) for corner in shapely.get_coordinates(cells)}
        if missing:
            faults.append(f"{len(missing)} corners of the region are missing")
    return faults


def main():
    """Judges all kinds of diagrams of all sets."""
    judged = Judge("cells")
    for name, points in judged.chosen(planar()):
        np.save(judged.folder / "points.npy", points)
        size = np.ptp(points, axis=0).max()
        weights = (0.1 * size) ** 2 * np.random.default_rng(3).random(len(points))
        np.savetxt(judged.folder / "weights.csv", weights, fmt="%.17g")
        for kind, how, region in regions(points):
            if not isinstance(how, list):
                (judged.folder / "region.geojson").write_text(shapely.to_geojson(how))
                how = ["--clip", "region.geojson"]
                region = shapely.from_geojson((judged.folder / "region.geojson").read_text())
            faults = judged.run("voronoi", "points.npy", "-o", "cells.geojson", *how)
            if not faults:
                features = json.loads((judged.folder / "cells.geojson").read_text())["features"]
                found = [json.dumps(f["geometry"]) for f in features if f["geometry"]]
                with np.errstate(all="ignore"):
                    faults = judge(shapely.from_geojson(found), region)
            judged.told(f"{name}, {kind}", faults)
    judged.end()


if __name__ == "__main__":
    main()
