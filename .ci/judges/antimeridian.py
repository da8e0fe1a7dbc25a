#!/usr/bin/env python3
"""Judges polygons of longitude and latitude that are cut at 180 degrees, as GEOS does: they are where what was given is.

.ci/judges/antimeridian.py PROGRAM FOLDER [SET...]
"""

import json

import geopandas
import numpy as np
import shapely
from judging import Judge, uncovered

WORLD = shapely.box(-180, -90, 180, 90)


def star(random, middle, step, sizes):
    """A star-shaped polygon around a place, its corners on a grid if there is a step; perhaps with a hole."""
    angles = np.sort(random.random(random.integers(3, 14))) * 2 * np.pi
    radii = random.uniform(0.3, 1.0, len(angles))
    corners = middle + np.column_stack([np.cos(angles) * radii * sizes[0], np.sin(angles) * radii * sizes[1]])
    hole = middle + (corners - middle) * random.uniform(0.2, 0.6, (len(corners), 1))
    if step:
        corners, hole = (step * np.round(each / step) for each in (corners, hole))
    plain = shapely.Polygon(corners)
    if random.random() < 0.5 and len(hole) > 3:
        with_hole = shapely.Polygon(corners, [hole])
        return with_hole if with_hole.is_valid else plain
    return plain


def stars(seed, step, sizes, count=150):
    """Valid polygons of any width up to a half of the world, around any place."""
    random = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        middle = np.array([random.uniform(-200, 200), random.uniform(-60, 60)])
        if random.random() < 0.5:
            middle[0] = 180 * random.choice([-1, 1])
        polygon = star(random, middle if not step else step * np.round(middle / step), step, sizes)
        if polygon.is_valid and polygon.area > 0 and abs(np.array(polygon.bounds)[[1, 3]]).max() < 90:
            found.append(shapely.geometry.polygon.orient(polygon))
    return found


def caps(seed, step, count=60):
    """Rings around a pole as the polygons that they are closed to, east to west or west to east; some as bands between two."""
    random = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        n = random.integers(4, 20)
        at = (
            np.unique(random.uniform(-180, 180, n))
            if not step
            else step * np.unique(random.integers(-180 // step, 180 // step, n))
        )
        if np.diff(at, append=at[0] + 360).max() >= 180:
            continue
        north = random.random() < 0.5
        heights = random.uniform(30, 60, len(at))
        if step:
            heights = step * np.round(heights / step)
        inner = np.minimum(heights + random.uniform(1, 20, len(at)), 89.0) if random.random() < 0.5 else None
        sign = 1 if north else -1
        found.append((at, sign * heights, None if inner is None else sign * inner, north))
    return found


def wrapped(random, corners):
    """Longitudes from -180 to 180; at these, either."""
    x = (corners[:, 0] + 180) % 360 - 180
    x = np.where((abs(x) == 180) & (random.random(len(x)) < 0.5), -x, x)
    return np.column_stack([x, corners[:, 1]])


def ring(random, corners, how):
    """A ring as GeoJSON has it, in one of the forms."""
    if how == "wrapped":
        corners = wrapped(random, np.asarray(corners)[:-1])
        corners = np.vstack([corners, corners[:1]])
    return np.asarray(corners).tolist()


def is_plain(polygon):
    """Whether all edges are shorter than half of the world, and none has no length."""
    steps = [np.diff(np.asarray(ring.coords), axis=0) for ring in [polygon.exterior, *polygon.interiors]]
    return all(np.abs(each[:, 0]).max() < 180 and np.abs(each).max(axis=1).min() > 0 for each in steps)


def in_world(polygon):
    """What a polygon on the line without end is in [-180, 180]."""
    parts = [shapely.intersection(shapely.affinity.translate(polygon, 360 * turn, 0), WORLD) for turn in (-1, 0, 1)]
    return shapely.union_all(parts)


def cap(at, heights, inner, north):
    """A ring around a pole, closed along it, and perhaps without the part beyond another ring."""

    def below(values):
        line = [(x + turn, y) for turn in (-360, 0, 360) for x, y in zip(at, values, strict=True)]
        pole = 90.0 if north else -90.0
        return shapely.Polygon([*line, (line[-1][0], pole), (line[0][0], pole)]).intersection(WORLD)

    return below(heights) if inner is None else below(heights).difference(below(inner))


def feature(rings, i):
    """A polygon of GeoJSON with its number."""
    geometry = {"type": "Polygon", "coordinates": rings}
    return {"type": "Feature", "properties": {"number": i}, "geometry": geometry}


def inputs():
    """Features and what they are in [-180, 180], by name."""
    for name, step, sizes in [
        ("stars", 0, (60, 40)),
        ("small stars", 0, (2e-3, 1e-3)),
        ("wide stars on a grid", 10, (90, 60)),
        ("narrow stars on a grid", 10, (30, 60)),
    ]:
        for how in ["wrapped", "unwrapped"]:
            random = np.random.default_rng(7)
            polygons = [p for p in stars(11, step, sizes) if is_plain(p)]
            rings = [[ring(random, r.coords, how) for r in [p.exterior, *p.interiors]] for p in polygons]
            yield f"{name}, {how}", rings, [in_world(p) for p in polygons]
    for name, step in [("caps", 0), ("caps on a grid", 10)]:
        random = np.random.default_rng(5)
        all_rings, expected = [], []
        for at, heights, inner, north in caps(13, step):
            line = np.column_stack([at, heights])[:: 1 if north else -1]
            lines = [line] if inner is None else [line, np.column_stack([at, inner])[:: -1 if north else 1]]
            all_rings.append([ring(random, [*each, each[0]], "wrapped") for each in lines])
            expected.append(cap(at, heights, inner, north))
        yield name, all_rings, expected


def judge(found, expected):
    """What is wrong with the triangles of features."""
    faults = []
    low, _, high, _ = found.total_bounds
    if low < -180 or high > 180:
        faults.append(f"longitudes from {low} to {high}")
    for number, whole in enumerate(expected):
        triangles = found.geometry[found["number"] == number].to_numpy()
        wrong = uncovered(triangles, None)
        union = shapely.union_all(triangles, grid_size=0)
        room = 1e-9 * (1 + whole.length) * max(1e-3, min(1.0, whole.length))
        if shapely.symmetric_difference(union, whole).area > room:
            wrong.append(f"other places than expected: {union.wkt}, {whole.wkt}")
        faults.extend(f"{number}: {fault}" for fault in wrong)
    return faults[:3]


def main():
    """Judges all sets by two commands."""
    judged = Judge("polygons cut at 180 degrees")
    chosen = {name: (rings, expected) for name, rings, expected in inputs()}
    for name, (rings, expected) in judged.chosen(chosen):
        features = [feature(each, i) for i, each in enumerate(rings)]
        content = {"type": "FeatureCollection", "features": features}
        (judged.folder / "given.geojson").write_text(json.dumps(content))
        faults = judged.run("polygons", "given.geojson", "--antimeridian", "cut", "-o", "cut.geojson")
        faults = faults or judge(geopandas.read_file(judged.folder / "cut.geojson"), expected)
        judged.told(name, faults)
    judged.end()


if __name__ == "__main__":
    main()
