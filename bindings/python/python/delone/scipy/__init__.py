"""In SciPy's place: what `scipy.spatial` and `scipy.interpolate` have of triangulations, made by Delone.

import delone.scipy as spatial

tri = spatial.Delaunay(points)
isinstance(tri, scipy.spatial.Delaunay)     # and SciPy's compiled interpolators take it
spatial.griddata(points, values, (x, y), method="cubic")

with delone.scipy.patched():                # for programs of others
    analyze(points)

Classes are those of `delone` and of SciPy at once. Where the two differ they do as SciPy does:

| | `delone` | `delone.scipy` |
| --- | --- | --- |
| points that span less than the plane or space | no simplices | `QhullError` |
| facets in one plane and vertices at one place but for rounding | apart | one: `merge="auto"`; `None` for the exact ones |
| corners of tetrahedra | in one orientation | by index, so that both sides of a facet name it alike |
| more than three dimensions, furthest sites in space, options that only Qhull has | refused | made by SciPy |
| numbers that float64 does not hold | refused | rounded |
| classes that users derive, where only SciPy has an answer | refused | stay instances, over SciPy's class |
| `points` and others | read-only | `points` may be changed, which changes nothing else; others may be assigned and deleted |
| `find_simplex` after `simplices` or others were assigned | as before | in what was assigned, as SciPy finds it |
| wrong calls | TypeError, ValueError | errors of SciPy's class |

All other names of `scipy.spatial` are SciPy's own. Needs the package `scipy`.
"""

from __future__ import annotations

from typing import Any

try:
    import scipy.interpolate
    import scipy.spatial
except ImportError as error:
    raise ImportError("delone.scipy stands in SciPy's place, and needs it: pip install scipy") from error

from scipy.interpolate import NearestNDInterpolator
from scipy.spatial import QhullError, convex_hull_plot_2d, delaunay_plot_2d, voronoi_plot_2d

from ._halfspaces import HalfspaceIntersection
from ._interpolate import CloughTocher2DInterpolator, LinearNDInterpolator, griddata
from ._patched import patched
from ._spatial import ConvexHull, Delaunay, Voronoi, tsearch

__all__ = [
    "CloughTocher2DInterpolator",
    "ConvexHull",
    "Delaunay",
    "HalfspaceIntersection",
    "LinearNDInterpolator",
    "NearestNDInterpolator",
    "QhullError",
    "Voronoi",
    "convex_hull_plot_2d",
    "delaunay_plot_2d",
    "griddata",
    "patched",
    "tsearch",
    "voronoi_plot_2d",
]


def __getattr__(name: str) -> Any:
    """What else SciPy has."""
    if not name.startswith("_"):
        for module in (scipy.spatial, scipy.interpolate):
            if hasattr(module, name):
                return getattr(module, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
