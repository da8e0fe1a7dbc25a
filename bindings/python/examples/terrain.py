"""Real terrain: a laser scan as a triangulated surface, heights anywhere, cells, and a picture of them.

pip install './bindings/python[examples]'
python bindings/python/examples/terrain.py [terrain.png]

The cells (# %%) run one by one in editors that know them as notebooks.
"""

# %% The ground in a laser scan: x, y and height, in feet
import sys
from pathlib import Path

import delone
import laspy
import matplotlib
import numpy as np

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt

scan = laspy.read(Path(__file__).resolve().parents[3] / "data" / "autzen_trim.laz")
ground = scan.classification == 2
points = np.column_stack([scan.x[ground], scan.y[ground]])
heights = np.asarray(scan.z[ground])
print(f"{len(points)} points of the ground, {heights.min():.0f} to {heights.max():.0f} feet high")

# %% The triangulation: exact, and the same whatever the order of the points
tri = delone.Delaunay(points)
print(tri, "of which duplicates:", len(tri.duplicates))

# %% Heights on a grid: piecewise linear, NaN outside of the hull
surface = delone.LinearInterpolator(tri, heights)
x, y = (np.linspace(low, high, 600) for low, high in zip(tri.min_bound, tri.max_bound, strict=True))
grid = surface(*np.meshgrid(x, y))
print(f"{np.isfinite(grid).mean():.0%} of the grid is inside of the hull")

# %% Points that stick out are taken away: their neighbors tell
starts, around = tri.vertex_neighbor_vertices
of = np.repeat(np.arange(len(points)), np.diff(starts))
usual = np.full(len(points), np.nan)
some = np.diff(starts) > 0
usual[some] = np.bincount(of, heights[around], len(points))[some] / np.diff(starts)[some]
odd = np.flatnonzero(np.abs(heights - usual) > 4)
odd = odd[tri.vertex_to_simplex[odd] >= 0]
tri.remove(odd)
print(f"{len(odd)} points stick out by more than 4 feet and are removed")

# %% A picture: shaded heights, triangles, cells
figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15, 4.2), layout="constrained")
slope_y, slope_x = np.gradient(grid, y, x)
light = (slope_x + slope_y) / np.sqrt(1 + slope_x**2 + slope_y**2)
left.imshow(light, extent=(x[0], x[-1], y[0], y[-1]), origin="lower", cmap="gray", vmin=-1, vmax=1, aspect="equal")
left.set_title("shaded heights")
middle.tripcolor(*points.T, heights, triangles=tri.simplices, shading="gouraud", cmap="terrain")
delone.plot(tri, middle, color="k", linewidth=0.05)
middle.set_title(f"{tri.nsimplex} triangles")
some = np.flatnonzero((np.abs(points - np.median(points, axis=0)) < 60).all(axis=1))
delone.plot(delone.Voronoi(points[some]), right)
right.plot(*points[some].T, ".", markersize=1, color="tab:red")
right.set_title("Voronoi cells in the middle")
for axes in (left, middle, right):
    axes.tick_params(labelsize=6)
out = Path(sys.argv[1] if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "terrain-python.png")
figure.savefig(out, dpi=110)
print(f"the picture is {out}")
