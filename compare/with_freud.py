"""Times cells of space of delone beside freud's in a box that repeats, and beside SciPy's, in one run; volumes are judged.

pip install freud-analysis scipy; python compare/with_freud.py [--runs 5]
"""

import argparse
import statistics
import time

import delone
import freud
import numpy as np
import scipy.spatial


def seconds(work):
    """How long something takes, and what it gives."""
    start = time.perf_counter()
    made = work()
    return time.perf_counter() - start, made


def compare(what, ours, theirs, runs):
    """Prints the medians of alternating runs, after one that does not count, and returns what they gave."""
    ours(), theirs()
    pairs = [(seconds(ours), seconds(theirs)) for _ in range(runs)]
    mine, other = (statistics.median(pair[k][0] for pair in pairs) * 1e3 for k in (0, 1))
    print(f"{what:56} {mine:10.4g} ms {other:10.4g} ms {other / mine:8.2g} x", flush=True)
    return pairs[-1][0][1], pairs[-1][1][1]


def repeated(points, side):
    """Volumes, and neighbors with the areas of their faces, of a box that repeats: of both."""
    box = freud.box.Box.cube(side)

    def ours():
        made = delone.Voronoi(points, box=[side] * 3, periodic=True)
        return made.volumes, made.nlist.areas

    def theirs():
        made = freud.locality.Voronoi().compute((box, points - side / 2))
        return made.volumes, made.nlist.weights

    return ours, theirs


def bounded(points):
    """Volumes of all bounded cells: ours of cells in a box, SciPy's by a hull of each cell."""

    def ours():
        return delone.Voronoi(points, box=[1.0] * 3, periodic=False).volumes

    def theirs():
        made = scipy.spatial.Voronoi(points)
        regions = [made.regions[r] for r in made.point_region]
        hull = scipy.spatial.ConvexHull
        return np.array([np.nan if -1 in r else hull(made.vertices[r]).volume for r in regions])

    return ours, theirs


def main():
    """Runs all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=5)
    runs = parser.parse_args().runs
    random = np.random.default_rng(1)
    print(f"{'':56} {'delone':>13} {'peer':>13}")
    for n in (1_000, 20_000, 100_000):
        points = random.random((n, 3))
        mine, other = compare(f"freud: cells that repeat, {n} points", *repeated(points, 1.0), runs if n < 100_000 else 2)
        # freud keeps points in single precision.
        assert np.allclose(mine[0].sum(), 1) and np.allclose(mine[0], other[0], rtol=0.01, atol=1e-4 / n)
    points = random.random((2_000, 3))
    mine, other = compare(f"SciPy: volumes of cells, {len(points)} points", *bounded(points), min(runs, 3))
    # Cells that the box cuts are smaller than SciPy's.
    whole = np.isclose(mine, other, rtol=1e-9)
    assert whole.sum() > 1_000 and (mine[~whole & (other > 0)] < other[~whole & (other > 0)]).all()


if __name__ == "__main__":
    main()
