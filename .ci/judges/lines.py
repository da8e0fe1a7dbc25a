#!/usr/bin/env python3
"""Judges Voronoi cells of lines and areas: valid, a coverage, and within the tolerance of the places nearest to a line.

.ci/judges/lines.py PROGRAM FOLDER [SET...]
"""

import json

import geopandas
import numpy as np
import shapely
from judging import Judge, uncovered

BOX = shapely.box(-0.2, -0.2, 1.2, 1.2)
PLACES = 20_000


def chains(seed, count):
    """Chains of segments, which may cross; the second begins at a corner of the first."""
    random = np.random.default_rng(seed)
    found = []
    for k in range(count):
        steps = random.normal(0, 0.1, (random.integers(1, 6), 2))
        start = random.random(2) if k != 1 else np.array(found[0].coords[1])
        found.append(shapely.LineString(start + np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])))
    return found


def apart(seed, count):
    """Polygons that do not touch, some with holes."""
    random = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        shape = shapely.Point(random.random(2)).buffer(random.uniform(0.02, 0.15), quad_segs=int(random.integers(1, 5)))
        if random.random() < 0.4:
            shape = shape.difference(shapely.affinity.scale(shape, 0.5, 0.5))
        if all(shape.distance(other) > 1e-3 for other in found):
            found.append(shape)
    return found


def beyond(seed, count):
    """Segments around the box, most of them with no end in it."""
    ends = np.random.default_rng(seed).uniform(-2, 3, (count, 2, 2))
    return [shapely.LineString(pair) for pair in ends]


def parcels(seed, count):
    """Areas that share sides, with some left out."""
    places = shapely.MultiPoint(np.random.default_rng(seed).random((count, 2)))
    cells = shapely.get_parts(shapely.voronoi_polygons(places, extend_to=BOX))
    unit = shapely.box(0, 0, 1, 1)
    return [shapely.intersection(cell, unit) for k, cell in enumerate(cells) if k % 3]


def tenths(size, count):
    """Parcels of a lattice whose steps are no binary numbers: sides nearly touch, and slits are a rounding wide."""
    steps = [(i, j) for i in range(count) for j in range(count) if (i + j) % 7]
    return [shapely.box(i * size, j * size, i * size + size, j * size + size) for i, j in steps]


def row(gap, turn):
    """Houses beside each other, a part of whose walls nearly touch."""
    sizes = [0.2, 0.13, 0.25, 0.1]
    starts = np.cumsum([0] + [size + gap for size in sizes])
    houses = [shapely.box(x, 0.3 * size, x + size, 0.3 * size + 2 * size) for x, size in zip(starts, sizes, strict=False)]
    return [shapely.affinity.rotate(house, turn, origin=(0, 0)) for house in houses]


SETS = {
    "two lines": (chains(1, 2), "lines", 1e-3),
    "lines": (chains(2, 12), "lines", 1e-3),
    "many lines": (chains(3, 60), "lines", 1e-3),
    "lines, coarse": (chains(4, 20), "lines", 3e-2),
    "a grid": (
        [shapely.LineString([(x, 0), (x, 1)]) for x in (0, 0.5, 1)] + [shapely.LineString([(0, y), (1, y)]) for y in (0, 0.5, 1)],
        "lines",
        1e-2,
    ),
    "areas": (apart(5, 12), "areas", 1e-3),
    "areas, coarse": (apart(6, 8), "areas", 1e-2),
    "from beyond": (beyond(11, 2), "lines", 1e-2),
    "from beyond, fine": (beyond(12, 5), "lines", 1e-3),
    "parcels": (parcels(8, 15), "areas", 1e-3),
    "parcels of a lattice": (tenths(0.05, 20), "areas", 1e-2),
    "a row": (row(1e-9, 0), "areas", 1e-3),
    "a row, turned": (row(1e-12, 17), "areas", 2e-2),
    "borders of areas": (apart(7, 8), "lines", 1e-3),
}


def judge(found, shapes, kind, tolerance):
    """What is wrong with the cells."""
    cells = found.geometry.to_numpy()
    # A line far away has no cell.
    faults = uncovered(cells[~shapely.is_missing(cells)], BOX)
    if found["number"].tolist() != list(range(len(shapes))):
        faults.append("the attributes are others")
    borders = np.array(shapes if kind == "areas" else [s.boundary if s.geom_type != "LineString" else s for s in shapes])
    places = shapely.points(np.random.default_rng(9).random((PLACES, 2)) * 1.4 - 0.2)
    distances = np.array([shapely.distance(border, places) for border in borders])
    nearest = distances.argmin(axis=0)
    tree = shapely.STRtree(cells)
    at, owners = tree.query(places, predicate="within")
    wrong = nearest[at] != owners
    more = (distances[owners, at] - distances[nearest[at], at]).max(initial=0)
    if more > 2 * tolerance:
        faults.append(f"a place is farther from its line than from the nearest one, by {more}")
    off = max((float(shapely.distance(cells[nearest[k]], places[k])) for k in at[wrong]), default=0.0)
    if not off <= tolerance:
        faults.append(f"a place is {off} from the cell of its nearest line")
    return faults


def judge_axis(found, shapes, tolerance):
    """What is wrong with a medial axis: it is inside, and its widths are twice the distance from the border."""
    inside = shapely.union_all(shapes)
    borders = shapely.union_all(shapely.boundary(shapes))
    middles = shapely.line_interpolate_point(found.geometry.to_numpy(), 0.5, normalized=True)
    faults = []
    if len(found) == 0 or not shapely.contains(inside, middles).all():
        faults.append("there is no axis, or some of it is outside")
    off = np.abs(2 * shapely.distance(borders, middles) - found["width"].to_numpy()).max(initial=0)
    if off > 2 * tolerance:
        faults.append(f"a width is off by {off}")
    return faults


def main():
    """Judges all sets."""
    judged = Judge("cells of lines")
    for name, (shapes, kind, tolerance) in judged.chosen(SETS):
        features = [
            {"type": "Feature", "properties": {"number": k}, "geometry": json.loads(shapely.to_geojson(shape))}
            for k, shape in enumerate(shapes)
        ]
        given = judged.folder / "given.geojson"
        given.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        options = ["--of", kind, "--tolerance", str(tolerance), "--box=-0.2,-0.2,1.2,1.2", "-o", "cells.fgb"]
        faults = judged.run("voronoi", "given.geojson", *options)
        faults = faults or judge(geopandas.read_file(judged.folder / "cells.fgb"), shapes, kind, tolerance)
        judged.told(name, faults)
        if kind == "areas":
            axis = ["--medial-axis", "--tolerance", str(tolerance), "-o", "axis.gpkg"]
            faults = judged.run("voronoi", "given.geojson", *axis)
            faults = faults or judge_axis(geopandas.read_file(judged.folder / "axis.gpkg"), shapes, tolerance)
            judged.told(f"{name}, axis", faults)
    judged.end()


if __name__ == "__main__":
    main()
