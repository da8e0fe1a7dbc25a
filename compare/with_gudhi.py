"""Alpha filtrations in space beside Gudhi's: seconds from points to all values, alternating, the minimum counts; and the values.

Of both the Python package is timed: here `delone.AlphaComplex(points)`, on one thread unless RAYON_NUM_THREADS says more,
which is sorted as well; there `gudhi.AlphaComplex(points, precision=...).create_simplex_tree()`, which is CGAL's
triangulation, the values and the tree, unsorted. Values are compared with those of each precision, simplex by simplex on
the smallest size. Needs: pip install gudhi numpy, and the package.

python compare/with_gudhi.py [--sizes 10000,100000] [--runs 3] [--weighted] [--plane]
"""

import argparse
import os
import time

# Before threads are made.
os.environ.setdefault("RAYON_NUM_THREADS", "1")

import delone
import gudhi
import numpy as np

PRECISIONS = ("fast", "safe", "exact")


def ours(points, weights):
    """Seconds, and the complex."""
    start = time.perf_counter()
    complexes = delone.AlphaComplex(points, weights)
    return time.perf_counter() - start, complexes


def theirs(points, weights, precision):
    """The same of Gudhi."""
    start = time.perf_counter()
    tree = gudhi.AlphaComplex(points=points, weights=weights, precision=precision).create_simplex_tree()
    return time.perf_counter() - start, tree


def triangulated(points):
    """Seconds of our triangulation alone."""
    start = time.perf_counter()
    delone.Delaunay(points)
    return time.perf_counter() - start


def difference(complexes, tree):
    """How many values there are, how many differ, and by how much of themselves at most."""
    found = {tuple(sorted(simplex)): value for simplex, value in tree.get_simplices()}
    count = differing = 0
    worst = 0.0
    for simplex, value in complexes.filtration():
        other = found.pop(simplex)
        count += 1
        if other != value:
            differing += 1
            worst = max(worst, abs(other - value) / max(abs(value), 1e-300))
    return count, differing, worst, len(found)


def main():
    """Times all, interleaved."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="10000,100000")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--weighted", action="store_true")
    parser.add_argument("--plane", action="store_true")
    args = parser.parse_args()
    print(f"{'points':>8} {'delone s':>9} {'of that Delaunay':>16}" + "".join(f" {p + ' s':>8} {'ratio':>6}" for p in PRECISIONS))
    sizes = [int(size) for size in args.sizes.split(",")]
    for size in sizes:
        random = np.random.default_rng(size)
        points = random.random((size, 2 if args.plane else 3))
        # Half of the distance between neighbors, squared.
        weights = random.random(size) * 0.25 * size ** (-2 / points.shape[1]) if args.weighted else None
        times, build = {}, []
        for _ in range(args.runs):
            times.setdefault("ours", []).append(ours(points, weights)[0])
            build.append(triangulated(points))
            for precision in PRECISIONS:
                times.setdefault(precision, []).append(theirs(points, weights, precision)[0])
        us = min(times["ours"])
        line = "".join(f" {min(times[p]):8.3f} {min(times[p]) / us:6.1f}" for p in PRECISIONS)
        print(f"{size:8} {us:9.3f} {min(build):16.3f}{line}", flush=True)
    random = np.random.default_rng(sizes[0])
    points = random.random((sizes[0], 2 if args.plane else 3))
    weights = random.random(sizes[0]) * 0.25 * sizes[0] ** (-2 / points.shape[1]) if args.weighted else None
    complexes = delone.AlphaComplex(points, weights)
    for precision in PRECISIONS:
        count, differing, worst, left = difference(complexes, theirs(points, weights, precision)[1])
        print(f"{precision}: {differing} of {count} values differ, by {worst:.1e} at most; {left} faces are only there")


if __name__ == "__main__":
    main()
