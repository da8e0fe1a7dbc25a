"""The interface of the package `triangle`, for those who have programs that use it.

`delone.triangle.triangulate` takes the same dictionary and the same switches, and returns the same arrays under the same keys.
What is inside of it is not Shewchuk's Triangle: it is exact, always ends, and may be used for anything.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._delaunay import Delaunay
from ._like_triangle import Given, arrays_of, refined
from ._points import as_points
from ._switches import parse
from ._wishes import Test

__all__ = ["convex_hull", "delaunay", "triangulate", "voronoi"]


def triangulate(tri: Mapping[str, ArrayLike], opts: str = "", *, refine: Test | None = None) -> dict[str, NDArray[Any]]:
    """Triangulates or meshes what a dictionary describes, as `triangle.triangulate` does.

    Parameters
    ----------
    tri : mapping
        `vertices` (n, 2); and if there are any `vertex_attributes` (n, k), `vertex_markers` (n, 1), `segments` (m, 2),
        `segment_markers` (m, 1), `holes` (h, 2), `regions` (r, 4): x, y, an attribute, a largest area; for the switch r
        `triangles` (t, 3), `triangle_attributes` (t, k), `triangle_max_area` (t, 1). Other arrays of results are ignored.
    opts : str
        Switches. p: with segments, holes and regions. r: refines `triangles`. q: no angle below 20 degrees, or below the
        number that follows; more than 34 are tried, with a warning where they are not reached. a: no area above the number
        that follows; without one those of `regions`, or with r `triangle_max_area`. A: attributes of regions. c: all of the
        hull. D: conforming Delaunay. Y: no new vertices on the border, YY: on no segment. S: with so many new vertices at
        most. O: without holes. j: without vertices that no triangle has. o2: with vertices in the middles of edges. e, n:
        with edges, neighbors. B, N, E, P: without markers, vertices, triangles, segments.
        u: triangles are refined as long as `refine` says so. z, v, g, X, I, Q, V, h, i, F, l, s and C change nothing here.
    refine : function, optional
        For the switch u: whether a triangle is to be refined, of its corners, an array (3, 2), and its area. Where it always says
        yes it ends, see `delone.mesh`.

    Returns
    -------
    dict
        `vertices` float64, those given first; `triangles`, `segments`, `neighbors`, `edges` and all markers int32; attributes
        float64. Attributes of new vertices are linear between those given. What is empty is left out. Edges run counter-clockwise
        around the first of their triangles. Segments of the border have the mesh on their right, others run as they were given.

    Raises
    ------
    ValueError
        For switches that are none, by their letter, and for what is wrong in the dictionary. KeyError for other keys.

    Examples
    --------
    >>> import delone
    >>> square = {"vertices": [[0, 0], [0, 1], [1, 1], [1, 0]]}
    >>> made = delone.triangle.triangulate(square, "qa0.1")
    >>> sorted(made), made["triangles"].dtype
    (['triangles', 'vertex_markers', 'vertices'], dtype('int32'))
    """
    switches = parse(opts)
    if switches.asks != (refine is not None):
        raise ValueError("the switch u and the function refine go together")
    given = Given.of(tri, switches)
    made = refined(given, switches, refine)
    if switches.min_angle > 34 and switches.max_vertices is None:
        # Triangle would not end.
        left = sum(reason in ("budget", "cascade") for _, reason in made.core.left)
        if left:
            words = f"{left} triangles have an angle of less than {switches.min_angle:g} degrees; up to 34 are reached"
            warnings.warn(words, stacklevel=2)
    return arrays_of(given, switches, made)


def delaunay(pts: ArrayLike) -> NDArray[np.int32]:
    """The triangles of points, counter-clockwise: (t, 3)."""
    return Delaunay(as_points(pts, "pts", 2)).simplices


def convex_hull(pts: ArrayLike) -> NDArray[np.int32]:
    """The edges of the convex hull of points, clockwise as Triangle has them; points that are on it are corners: (k, 2)."""
    return np.ascontiguousarray(Delaunay(as_points(pts, "pts", 2)).convex_hull[::-1, ::-1])


def voronoi(
    pts: ArrayLike,
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
    """The Voronoi diagram of points.

    Its vertices, which are the circumcenters of `delaunay(pts)`, (t, 2); its edges between two of them, (e, 2); and of its rays
    the vertices where they begin, (r,), and their directions, (r, 2), which are as long as the edges of the hull across.
    """
    tri = Delaunay(as_points(pts, "pts", 2))
    rows, columns = np.nonzero(tri.neighbors > np.arange(tri.nsimplex)[:, None])
    edges = np.column_stack([rows, tri.neighbors[rows, columns]]).astype(np.int32)
    origins, across = np.nonzero(tri.neighbors < 0)
    tails, heads = (tri.points[tri.simplices[origins, (across + k) % 3]] for k in (1, 2))
    (dx, dy) = (heads - tails).T
    return tri._centers(), edges, origins.astype(np.int32), np.column_stack([dy, -dx])
