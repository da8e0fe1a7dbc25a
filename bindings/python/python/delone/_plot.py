"""Pictures: with matplotlib if it is there, and as SVG for notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._constrained import ConstrainedDelaunay
    from ._delaunay import Delaunay
    from ._voronoi import Voronoi


def plot(what: Delaunay | ConstrainedDelaunay | Voronoi, ax: Any = None, **style: Any) -> Any:
    """Draws a triangulation, or Voronoi cells clipped to the box of the points, and returns the axes.

    Of a constrained triangulation it draws what is inside, and constraints as thick lines. `style` goes to matplotlib: to
    `triplot` in the plane, to `Line3DCollection` in space, to `PolyCollection` for cells.
    """
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection, PolyCollection

    from ._constrained import ConstrainedDelaunay
    from ._delaunay import Delaunay
    from ._voronoi import Voronoi

    if not isinstance(what, (Delaunay, ConstrainedDelaunay, Voronoi)):
        raise TypeError(f"a Delaunay, ConstrainedDelaunay or Voronoi is drawn, not {what!r}")
    if isinstance(what, Delaunay) and what.ndim == 3:
        from mpl_toolkits.mplot3d.art3d import Line3DCollection

        ax = ax or plt.figure().add_subplot(projection="3d")
        ax.add_collection(Line3DCollection(what.points[what.edges], **{"linewidths": 0.5, **style}))
        low, high = what.min_bound, what.max_bound
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        return ax
    ax = ax or plt.gca()
    if isinstance(what, (Delaunay, ConstrainedDelaunay)):
        if len(what.simplices):
            ax.triplot(what.points[:, 0], what.points[:, 1], what.simplices, **{"linewidth": 0.5, **style})
        elif isinstance(what, Delaunay):
            ax.plot(*what.points[what.edges].reshape(-1, 2).T, **style)
    if isinstance(what, ConstrainedDelaunay):
        ax.add_collection(LineCollection(list(what.points[what.constraints]), colors="black", linewidths=1.5))
        ax.autoscale()
    if isinstance(what, Voronoi):
        rings = [ring for cell in what.cells() for ring in cell]
        usual = {"facecolors": "none", "edgecolors": "tab:blue", "linewidths": 0.5}
        ax.add_collection(PolyCollection(rings, **{**usual, **style}))
        ax.autoscale()
    ax.set_aspect("equal")
    return ax


def svg(tri: Delaunay | ConstrainedDelaunay, width: int = 320) -> str:
    """A triangulation of the plane as SVG."""
    low, extent = tri.min_bound, tri.max_bound - tri.min_bound
    size = float(extent.max())
    scale = (width - 8) / size if 1e-290 < size < np.inf else 0.0
    at = (tri.points - low) * scale + 4
    height = float(extent[1]) * scale + 8
    at[:, 1] = height - at[:, 1]
    constraints = getattr(tri, "constraints", None)
    if constraints is None:
        return _svg(width, height, [(at[tri.edges], "#357", 0.7)])
    sides = np.concatenate([tri.simplices[:, [k, (k + 1) % 3]] for k in range(3)])
    sides = np.unique(np.sort(sides, axis=1), axis=0)
    return _svg(width, height, [(at[sides], "#357", 0.7), (at[constraints], "#000", 1.5)])


def _svg(width: int, height: float, layers: list[tuple[NDArray[np.float64], str, float]]) -> str:
    paths = []
    for lines, color, thickness in layers:
        path = "".join(f"M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}" for (x0, y0), (x1, y1) in lines)
        paths.append(f'<path d="{path}" fill="none" stroke="{color}" stroke-width="{thickness}"/>')
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height:.0f}">{"".join(paths)}</svg>'
