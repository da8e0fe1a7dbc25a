#!/usr/bin/env python3
"""Judges contours as GEOS does: lines simple, levels apart, bands valid, all together a coverage, with the area of the hull.

.ci/judges/contours.py PROGRAM FOLDER [SET...]
"""

import itertools
import json

import numpy as np
import shapely
from judging import Judge, uncovered
from sets import relief


def read(path):
    """Geometries by level, and without empty ones."""
    features = [f for f in json.loads(path.read_text())["features"] if f["geometry"]]
    keys = [json.dumps({k: v for k, v in f["properties"].items() if k != "length"}) for f in features]
    return keys, shapely.from_geojson([json.dumps(f["geometry"]) for f in features])


def judge_lines(keys, lines):
    """Lines of one level may meet at saddles, lines of two levels nowhere."""
    faults = []
    parts, of = shapely.get_parts(lines, return_index=True)
    bad = int((~shapely.is_simple(parts)).sum())
    if bad:
        faults.append(f"{bad} of {len(parts)} lines not simple")
    tree = shapely.STRtree(parts)
    pairs = tree.query(parts, predicate="crosses")
    crossing = sum(keys[of[i]] != keys[of[j]] for i, j in pairs.T)
    if crossing:
        faults.append(f"{crossing // 2} crossings of levels")
    return faults


def main():
    """Judges all sets."""
    judge = Judge("contours")
    for name, points in judge.chosen(relief()):
        np.save(judge.folder / "points.npy", points)
        hull = shapely.MultiPoint(points[:, :2]).convex_hull
        low, high = points[:, 2].min(), points[:, 2].max()
        steps = {"eight levels": (high - low) / 8, "levels at heights": max(1.0, np.round((high - low) / 6))}
        for (how, step), bands in itertools.product(steps.items(), [False, True]):
            more = ["--bands"] if bands else []
            faults = judge.run("contours", "points.npy", "--interval", repr(float(step)), "-o", "out.geojson", *more)
            if not faults:
                keys, found = read(judge.folder / "out.geojson")
                faults = uncovered(found, hull) if bands else judge_lines(keys, found)
            judge.told(f"{name}, {how}, {'bands' if bands else 'lines'}", faults)
    judge.end()


if __name__ == "__main__":
    main()
