"""Times delone beside SciPy in one run: constructors with all that SciPy makes in them, small calls, and a million queries.

python compare/with_scipy.py [--runs 5] [--only large|small|queries]
"""

import argparse
import statistics
import time

import delone
import numpy as np
import scipy.interpolate
import scipy.spatial


def seconds(work, repeats):
    """How long something takes, the mean of some calls one after the other."""
    start = time.perf_counter()
    for _ in range(repeats):
        work()
    return (time.perf_counter() - start) / repeats


def compare(what, ours, theirs, runs, repeats=1):
    """Prints the medians of alternating runs, after one that does not count."""
    ours(), theirs()
    pairs = [(seconds(ours, repeats), seconds(theirs, repeats)) for _ in range(runs)]
    mine, other = (statistics.median(column) * 1e3 for column in zip(*pairs, strict=True))
    print(f"{what:48} {mine:10.4g} ms {other:10.4g} ms {other / mine:8.2g} x", flush=True)


#: What SciPy makes in each constructor, and delone when it is asked for.
MADE = {
    "Delaunay": ["simplices", "neighbors", "equations", "coplanar"],
    "Voronoi": ["vertices", "ridge_points", "ridge_vertices", "regions", "point_region"],
    "ConvexHull": ["simplices", "neighbors", "equations", "vertices", "area", "volume", "coplanar"],
}


def everything(package, name, points):
    """A call that makes all of that."""

    def make():
        made = getattr(package, name)(points)
        return [getattr(made, attribute) for attribute in MADE[name]]

    return make


def large(random, runs):
    """Constructors on many points."""
    for n, ndim in [(100_000, 2), (1_000_000, 2), (100_000, 3)]:
        points = random.random((n, ndim))
        compare(
            f"Delaunay, simplices, {n} points, {ndim}D",
            lambda p=points: delone.Delaunay(p).simplices,
            lambda p=points: scipy.spatial.Delaunay(p).simplices,
            runs if n < 1_000_000 else min(runs, 2),
        )
    sphere = random.normal(size=(20_000, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, None]
    for name, points in [
        ("Delaunay", random.random((100_000, 2))),
        ("Voronoi", random.random((100_000, 2))),
        ("Voronoi", random.random((20_000, 3))),
        ("ConvexHull", random.random((100_000, 2))),
        ("ConvexHull", random.random((1_000_000, 3))),
        ("ConvexHull", sphere),
    ]:
        n, ndim = points.shape
        where = "sphere" if points is sphere else f"{ndim}D"
        calls = (everything(package, name, points) for package in (delone, scipy.spatial))
        compare(f"{name}, all, {n} points, {where}", *calls, runs)
    points = random.random((100_000, 2))
    for attribute in ("transform", "vertex_neighbor_vertices"):
        compare(
            f"Delaunay, {attribute}, {len(points)} points, 2D",
            lambda a=attribute: getattr(delone.Delaunay(points), a),
            lambda a=attribute: getattr(scipy.spatial.Delaunay(points), a),
            min(runs, 3),
        )


def small(random, runs):
    """Everything on few points, where the call itself is most of the work."""
    for n in (10, 100, 1000):
        for ndim in (2, 3):
            points = random.random((n, ndim))
            rows = [(name, *(everything(p, name, points) for p in (delone, scipy.spatial))) for name in MADE]
            rows.append(
                (
                    "Neighbors, KDTree; 2 of each",
                    lambda p=points: delone.Neighbors(p).query(p, k=2),
                    lambda p=points: scipy.spatial.KDTree(p).query(p, k=2),
                )
            )
            rows.append(
                (
                    "LinearNDInterpolator, as many queries",
                    lambda p=points: delone.LinearNDInterpolator(p, p[:, 0])(p),
                    lambda p=points: scipy.interpolate.LinearNDInterpolator(p, p[:, 0])(p),
                )
            )
            for name, ours, theirs in rows:
                compare(f"{name}, {n} points, {ndim}D", ours, theirs, runs, max(1, 2000 // n))


def queries(random, runs):
    """A million queries."""
    for n, ndim in [(100_000, 2), (100_000, 3)]:
        points, places = random.random((n, ndim)), random.random((1_000_000, ndim))
        ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
        values = points[:, 0]
        linear = delone.LinearInterpolator(ours, values)
        other = scipy.interpolate.LinearNDInterpolator(theirs, values)
        for what, mine, one in [
            ("find_simplex", ours.find_simplex, theirs.find_simplex),
            ("linear interpolation", linear, other),
        ]:
            compare(
                f"{what}, 1000000 in {n} points, {ndim}D",
                lambda f=mine, q=places: f(q),
                lambda f=one, q=places: f(q),
                min(runs, 2),
            )


def main():
    """Runs all comparisons, or some."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", choices=["large", "small", "queries"])
    asked = parser.parse_args()
    print(f"{'':48} {'delone':>13} {'scipy':>13}")
    for part in (large, small, queries):
        if asked.only in (None, part.__name__):
            part(np.random.default_rng(1), asked.runs)


if __name__ == "__main__":
    main()
