"""Convex hulls, with the names of scipy.spatial.ConvexHull."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._points import as_points


class ConvexHull:
    """The convex hull of points in the plane or in space, exact. Points that span less have no facets.

    Attributes
    ----------
    points : (n, ndim) array
        The points.
    simplices : (nfacet, ndim) array
        Edges counter-clockwise around, or triangles counter-clockwise seen from outside; flat faces are cut.
    vertices : (nvertex,) array
        The corners: in the plane counter-clockwise, in space by index.
    """

    def __init__(self, points: ArrayLike, incremental: bool = False, qhull_options: str | None = None) -> None:
        """Finds the hull of points."""
        self.points: NDArray[np.float64] = np.array(as_points(points), order="C")
        self.ndim, self.npoints = self.points.shape[1], len(self.points)
        self.simplices: NDArray[np.int32] = _delone.convex_hull(self.points)
        self.nsimplex = len(self.simplices)
        around = self.simplices[:, 0]
        self.vertices: NDArray[np.int32] = around if self.ndim == 2 else np.unique(self.simplices)

    @cached_property
    def equations(self) -> NDArray[np.float64]:
        """Normals of length 1 that point outside, and offsets: (nfacet, ndim + 1)."""
        corners = self.points[self.simplices]
        if self.ndim == 2:
            along = corners[:, 1] - corners[:, 0]
            normals = np.stack([along[:, 1], -along[:, 0]], axis=1)
        else:
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        with np.errstate(invalid="ignore"):
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        offsets = -(normals * corners[:, 0]).sum(axis=1)
        return np.concatenate([normals, offsets[:, None]], axis=1)

    @cached_property
    def area(self) -> float:
        """The area of the surface; in the plane the perimeter."""
        corners = self.points[self.simplices]
        sides = corners[:, 1:] - corners[:, :1]
        if self.ndim == 2:
            return float(np.linalg.norm(sides[:, 0], axis=1).sum())
        return float(np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2)

    @cached_property
    def volume(self) -> float:
        """The volume inside; in the plane the area."""
        if not self.nsimplex:
            return 0.0
        corners = self.points[self.simplices] - self.points[self.simplices[0, 0]]
        return float(np.linalg.det(corners).sum() / (2 if self.ndim == 2 else 6))

    def __repr__(self) -> str:
        """A line that says what there is."""
        return f"<delone.ConvexHull: {len(self.vertices)} vertices, {self.nsimplex} facets>"
