"""Natural neighbors beside MetPy, linear interpolation beside SciPy: alternating, the medians count.

Values are compared too: largest difference where both have one, and how many have one in one alone. Without MetPy only
SciPy is measured. Needs: pip install ./bindings/python scipy metpy.

python compare/with_metpy.py [--sizes 2000,20000] [--side 100] [--runs 3]
"""

import argparse
import statistics
import time
import warnings

import delone
import numpy as np
import scipy.interpolate

try:
    from metpy.interpolate import natural_neighbor_to_points
except ImportError:
    natural_neighbor_to_points = None


def seconds(work):
    """How long something takes, and what it gives."""
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def compare(what, ours, theirs, runs):
    """Prints the medians of alternating runs, their ratio, and whether the values agree."""
    rounds = [(seconds(ours), seconds(theirs)) for _ in range(runs)]
    mine, other = (statistics.median(one[k][0] for one in rounds) for k in (0, 1))
    a, b = rounds[-1][0][1], rounds[-1][1][1]
    both = ~(np.isnan(a) | np.isnan(b))
    off = np.sort(abs(a[both] - b[both])) if both.any() else np.zeros(1)
    alone = int((np.isnan(a) != np.isnan(b)).sum())
    agreement = f"difference {off[len(off) // 2]:.1e} in the median, {off[-1]:.1e} at most, {int((off > 1e-6).sum())} above 1e-6"
    print(f"{what:40} {mine:9.4f} s {other:9.3f} s {other / mine:8.1f} x  {agreement}, {alone} alone", flush=True)


def main():
    """Runs all comparisons."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="2000,20000")
    parser.add_argument("--side", type=int, default=100, help="cells of the grid along each axis")
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    random = np.random.default_rng(1)
    axis = np.linspace(0.02, 0.98, arguments.side)
    grid = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    for n in map(int, arguments.sizes.split(",")):
        points = random.random((n, 2))
        values = np.sin(5 * points[:, 0]) + np.cos(4 * points[:, 1])
        if natural_neighbor_to_points is not None:
            compare(
                f"natural, {len(grid)} in {n} points, from MetPy",
                lambda p=points, v=values: delone.NaturalNeighborInterpolator(p, v)(grid),
                lambda p=points, v=values: natural_neighbor_to_points(p, v, grid),
                arguments.runs,
            )
        compare(
            f"linear, {len(grid)} in {n} points, from SciPy",
            lambda p=points, v=values: delone.LinearNDInterpolator(p, v)(grid),
            lambda p=points, v=values: scipy.interpolate.LinearNDInterpolator(p, v)(grid),
            arguments.runs,
        )
    for n, ndim in [(100_000, 2), (100_000, 3)]:
        points, queries = random.random((n, ndim)), random.random((1_000_000, ndim))
        values = points[:, 0] * points[:, 1]
        ours = delone.LinearNDInterpolator(points, values)
        theirs = scipy.interpolate.LinearNDInterpolator(points, values)
        compare(f"linear, 1000000 in {n} points, {ndim}D", lambda f=ours, q=queries: f(q), lambda f=theirs, q=queries: f(q), 3)


if __name__ == "__main__":
    main()
