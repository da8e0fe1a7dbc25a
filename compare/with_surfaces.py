#!/usr/bin/env python3
"""Terrain from file to raster: `delone dtm` beside SciPy's and startin's ways, alternating.

    python compare/with_surfaces.py target/release/delone data/autzen_trim.laz 1 5

Needs: pip install numpy scipy 'laspy[lazrs]'; startinpy if it is there. Says medians in seconds and ratios,
and how far the values are apart where both have one.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time

import laspy
import numpy as np
from scipy.interpolate import LinearNDInterpolator

program, scan, cell, runs = sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4])


def read() -> np.ndarray:
    """Ground points of the scan."""
    las = laspy.read(scan)
    ground = np.asarray(las.classification) == 2
    return np.column_stack([np.asarray(axis)[ground] for axis in (las.x, las.y, las.z)])


def centres(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres of the cells that delone makes."""
    low, high = np.floor(points[:, :2].min(0) / cell), np.ceil(points[:, :2].max(0) / cell)
    xs = (np.arange(low[0], high[0]) + 0.5) * cell
    ys = (np.arange(high[1] - 1, low[1] - 1, -1) + 0.5) * cell
    return xs, ys


def of_delone(method: str) -> np.ndarray:
    """The whole way by delone."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "-q", "dtm", scan, "--cell", str(cell), "--method", method, "--duplicates", "first"]
        subprocess.run([*command, "-o", f"{folder}/dem.npy"], check=True)
        return np.load(f"{folder}/dem.npy")


def of_scipy() -> np.ndarray:
    """The whole way by SciPy."""
    points = read()
    xs, ys = centres(points)
    return LinearNDInterpolator(points[:, :2], points[:, 2])(*np.meshgrid(xs, ys))


def of_startin(method: str) -> np.ndarray:
    """The whole way by startin."""
    import startinpy

    points = read()
    xs, ys = centres(points)
    dt = startinpy.DT()
    dt.insert(points)
    asked = np.column_stack([axis.ravel() for axis in np.meshgrid(xs, ys)])
    values = dt.interpolate({"method": method}, asked, strict=False)
    return np.asarray(values).reshape(len(ys), len(xs))


ways = [("linear", "SciPy", of_scipy)]
try:
    import startinpy  # noqa: F401

    ways += [("linear", "startin", lambda: of_startin("TIN")), ("laplace", "startin", lambda: of_startin("Laplace"))]
    ways += [("natural", "startin", lambda: of_startin("NNI"))]
except ImportError:
    print("startin is not there")
for method, name, way in ways:
    ours, theirs = [], []
    for _ in range(runs):
        start = time.perf_counter()
        mine = of_delone(method)
        ours.append(time.perf_counter() - start)
        start = time.perf_counter()
        other = way()
        theirs.append(time.perf_counter() - start)
    both = np.isfinite(mine) & np.isfinite(other)
    apart = np.abs(mine[both] - other[both])
    a, b = statistics.median(ours), statistics.median(theirs)
    print(
        f"{method}: delone {a:.3f} s, {name} {b:.3f} s, {b / a:.1f} times; {both.sum()} cells, "
        f"apart by at most {apart.max():.2g}, in the median {np.median(apart):.2g}"
    )
