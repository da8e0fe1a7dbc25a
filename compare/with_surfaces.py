#!/usr/bin/env python3
"""Terrain from file to raster: `delone dtm` beside SciPy's, startin's and PDAL's ways, alternating.

    python compare/with_surfaces.py target/release/delone data/autzen_trim.laz 1 5

Needs: pip install numpy scipy 'laspy[lazrs]'; startinpy, rasterio and the program pdal if they are there. Says medians in
seconds and ratios, and how far the values are apart where both have one. TMPDIR says where PDAL writes.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

import laspy
import numpy as np
from scipy.interpolate import LinearNDInterpolator

program, scan, cell, runs = sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4])


def read() -> np.ndarray:
    """Ground points of the scan."""
    las = laspy.read(scan)
    ground = np.asarray(las.classification) == 2
    return np.column_stack([np.asarray(axis)[ground] for axis in (las.x, las.y, las.z)])


def centers(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centers of the cells that delone makes."""
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
    xs, ys = centers(points)
    return LinearNDInterpolator(points[:, :2], points[:, 2])(*np.meshgrid(xs, ys))


def of_startin(method: str) -> np.ndarray:
    """The whole way by startin."""
    import startinpy

    points = read()
    xs, ys = centers(points)
    dt = startinpy.DT()
    dt.insert(points)
    asked = np.column_stack([axis.ravel() for axis in np.meshgrid(xs, ys)])
    values = dt.interpolate({"method": method}, asked, strict=False)
    return np.asarray(values).reshape(len(ys), len(xs))


def of_pdal() -> np.ndarray:
    """The whole way by PDAL, to its raster; read here for the comparison of values alone."""
    with tempfile.TemporaryDirectory() as folder:
        west, south = np.floor(extent[:2] / cell) * cell
        east, north = np.ceil(extent[2:] / cell) * cell
        width, height = round((east - west) / cell), round((north - south) / cell)
        raster = {"origin_x": west, "origin_y": south, "width": width, "height": height}
        steps = [
            os.path.abspath(scan),
            {"type": "filters.range", "limits": "Classification[2:2]"},
            {"type": "filters.delaunay"},
            {"type": "filters.faceraster", "resolution": cell, **raster},
            {"type": "writers.raster", "filename": f"{folder}/dem.tif"},
        ]
        with open(f"{folder}/steps.json", "w") as file:
            json.dump(steps, file)
        start = time.perf_counter()
        subprocess.run(["pdal", "pipeline", f"{folder}/steps.json"], check=True)
        of_pdal.seconds = time.perf_counter() - start
        import rasterio

        with rasterio.open(f"{folder}/dem.tif") as dem:
            return dem.read(1, masked=True).filled(np.nan)


def timed(work: Callable[..., np.ndarray], *given: str) -> tuple[float, np.ndarray]:
    """What work takes, begun when no thread of what ran before it is busy: those of OpenBLAS turn in circles for a while."""
    time.sleep(0.2)
    start = time.perf_counter()
    done = work(*given)
    return time.perf_counter() - start, done


ways = [("linear", "SciPy", of_scipy)]
if shutil.which("pdal"):
    ground = read()
    extent = np.concatenate([ground[:, :2].min(0), ground[:, :2].max(0)])
    ways.append(("linear", "PDAL", of_pdal))
else:
    print("PDAL is not there")
try:
    import startinpy  # noqa: F401

    ways += [("linear", "startin", lambda: of_startin("TIN")), ("laplace", "startin", lambda: of_startin("Laplace"))]
    ways += [("natural", "startin", lambda: of_startin("NNI"))]
except ImportError:
    print("startin is not there")
for method, name, way in ways:
    ours, theirs = [], []
    for _ in range(runs):
        seconds, mine = timed(of_delone, method)
        ours.append(seconds)
        seconds, other = timed(way)
        theirs.append(getattr(way, "seconds", seconds))
    both = np.isfinite(mine) & np.isfinite(other)
    apart = np.abs(mine[both] - other[both])
    a, b = statistics.median(ours), statistics.median(theirs)
    print(
        f"{method}: delone {a:.3f} s, {name} {b:.3f} s, {b / a:.1f} times; {both.sum()} cells, "
        f"apart by at most {apart.max():.2g}, in the median {np.median(apart):.2g}"
    )
