"""Times delone beside SciPy in one run: constructor to simplices, and a million queries.

python compare/with_scipy.py [--runs 3]
"""

import argparse
import time

import delone
import numpy as np
import scipy.interpolate
import scipy.spatial


def seconds(work):
    """How long something takes, and what it gives."""
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def compare(what, ours, theirs, runs):
    """Prints the shortest of interleaved runs."""
    pairs = [(seconds(ours)[0], seconds(theirs)[0]) for _ in range(runs)]
    mine, other = (min(column) for column in zip(*pairs, strict=True))
    print(f"{what:44} {mine:9.4f} s {other:9.3f} s {other / mine:8.1f} x", flush=True)


def main():
    """Runs all comparisons."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    runs = parser.parse_args().runs
    random = np.random.default_rng(1)
    print(f"{'':44} {'delone':>11} {'scipy':>11}")
    for n, ndim in [(1_000, 2), (100_000, 2), (1_000_000, 2), (1_000, 3), (100_000, 3)]:
        points = random.random((n, ndim))
        compare(
            f"Delaunay, {n} points, {ndim}D",
            lambda p=points: delone.Delaunay(p).simplices,
            lambda p=points: scipy.spatial.Delaunay(p).simplices,
            runs if n < 1_000_000 else min(runs, 2),
        )
    for n, ndim in [(100_000, 2), (100_000, 3)]:
        points, queries = random.random((n, ndim)), random.random((1_000_000, ndim))
        ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
        compare(
            f"find_simplex, 1000000 in {n} points, {ndim}D",
            lambda q=queries, t=ours: t.find_simplex(q),
            lambda q=queries, t=theirs: t.find_simplex(q),
            runs,
        )
        values = points[:, 0]
        linear = delone.LinearInterpolator(ours, values)
        other = scipy.interpolate.LinearNDInterpolator(theirs, values)
        compare(
            f"linear interpolation, 1000000 queries, {ndim}D",
            lambda q=queries, f=linear: f(q),
            lambda q=queries, f=other: f(q),
            runs,
        )
    points = random.random((100_000, 2))
    compare("Voronoi, 100000 points, 2D", lambda: delone.Voronoi(points), lambda: scipy.spatial.Voronoi(points), runs)
    points = random.random((20_000, 3))
    compare("Voronoi, 20000 points, 3D", lambda: delone.Voronoi(points), lambda: scipy.spatial.Voronoi(points), runs)
    points = random.random((1_000_000, 3))
    compare("ConvexHull, 1000000 points, 3D", lambda: delone.ConvexHull(points), lambda: scipy.spatial.ConvexHull(points), runs)


if __name__ == "__main__":
    main()
