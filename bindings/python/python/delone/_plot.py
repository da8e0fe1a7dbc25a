"""Pictures: with matplotlib if it is there, and as SVG for notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._alpha import AlphaComplex
    from ._constrained import ConstrainedDelaunay
    from ._delaunay import Delaunay
    from ._hull import ConvexHull
    from ._mesh import Mesh
    from ._voronoi import Voronoi


def plot(what: Delaunay | ConstrainedDelaunay | Mesh | Voronoi | ConvexHull | AlphaComplex, ax: Any = None, **style: Any) -> Any:
    """Draws a triangulation, a mesh, a hull, an alpha shape, or Voronoi cells clipped to the box of the points; returns the axes.

    Of a mesh and a constrained triangulation it draws what is inside, and segments as thick lines; of an alpha complex the
    shape at `optimal_alpha()`. `style` goes to matplotlib: to `triplot` for triangles in the plane, to `PolyCollection` for cells
    and a hull in the plane; in space to `Line3DCollection` for a triangulation, to `Poly3DCollection` for a hull and a shape.
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("plot needs the package matplotlib: pip install matplotlib") from error
    from matplotlib.collections import LineCollection, PolyCollection

    from ._alpha import AlphaComplex
    from ._constrained import ConstrainedDelaunay
    from ._delaunay import Delaunay
    from ._hull import ConvexHull
    from ._mesh import Mesh
    from ._voronoi import Voronoi

    if not isinstance(what, (Delaunay, ConstrainedDelaunay, Mesh, Voronoi, ConvexHull, AlphaComplex)):
        raise TypeError(
            f"a Delaunay, ConstrainedDelaunay, Mesh, Voronoi, ConvexHull or AlphaComplex is drawn, not {type(what).__name__}"
        )
    if not isinstance(what, (Mesh, Voronoi)) and what.ndim == 3:
        from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

        ax = ax or plt.figure().add_subplot(projection="3d")
        if isinstance(what, Delaunay):
            ax.add_collection(Line3DCollection(what.points[what.edges], **{"linewidths": 0.5, **style}))
        else:
            faces = what.outline(what.optimal_alpha()) if isinstance(what, AlphaComplex) else what.simplices
            usual = {"facecolors": "lightsteelblue", "edgecolors": "tab:blue", "linewidths": 0.3}
            ax.add_collection(Poly3DCollection(what.points[faces], **{**usual, **style}))
        if len(what.points):
            low, high = what.points.min(axis=0), what.points.max(axis=0)
            ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        return ax
    ax = ax or plt.gca()
    if isinstance(what, (Delaunay, ConstrainedDelaunay, Mesh)):
        if len(what.simplices):
            ax.triplot(what.points[:, 0], what.points[:, 1], what.simplices, **{"linewidth": 0.5, **style})
        elif isinstance(what, Delaunay):
            ax.plot(*what.points[what.edges].reshape(-1, 2).T, **style)
    if isinstance(what, AlphaComplex):
        triangles = what.complex(what.optimal_alpha())[2]
        if len(triangles):
            ax.triplot(what.points[:, 0], what.points[:, 1], triangles, **{"linewidth": 0.5, **style})
    if isinstance(what, ConvexHull):
        usual = {"facecolors": "none", "edgecolors": "tab:blue"}
        ax.add_collection(PolyCollection([what.points[what.vertices]], **{**usual, **style}))
        ax.plot(what.points[:, 0], what.points[:, 1], "k.", markersize=3)
    if isinstance(what, (ConstrainedDelaunay, Mesh)):
        segments = what.segments if isinstance(what, Mesh) else what.constraints
        ax.add_collection(LineCollection(list(what.points[segments]), colors="black", linewidths=1.5))
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
