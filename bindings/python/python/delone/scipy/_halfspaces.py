"""What half-spaces have in common, by the hull of their duals.

Source: Preparata & Muller, "Finding the intersection of n half-spaces in time O(n log n)", TCS 1979.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.spatial
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from .. import _delone
from .._errors import qhull_error
from .._points import ShapeError
from ._place import InItsPlace, WithoutQhull, as_doubles, as_more, is_ours, or_theirs, refuse_options, taken_for_array
from ._spatial import ConvexHull


class HalfspaceIntersection(WithoutQhull, scipy.spatial.HalfspaceIntersection, metaclass=InItsPlace):  # type: ignore[misc]
    """The intersection of half-spaces of the plane or of space that hold a point: a `scipy.spatial.HalfspaceIntersection`.

    Parameters
    ----------
    halfspaces : array_like of floats, shape (nineq, ndim + 1)
        Rows [A, b] of A x + b <= 0.
    interior_point : array_like of floats, shape (ndim,)
        A point that is strictly inside of all of them.
    incremental : bool
        For those who come from SciPy; half-spaces can be added either way.
    qhull_options : str, optional
        For those who come from SciPy, as of `delone.ConvexHull`.
    merge : float or "auto", optional
        Corners of the dual hull within this distance of the hull of the others are left out, see `delone.ConvexHull`. "auto" is
        2^-40 of the distance of the nearest corner of the dual hull from the origin; None is the exact dual hull.

    Attributes
    ----------
    ndim, nineq : int
        2 or 3, and the number of half-spaces.
    interior_point : (ndim,) array
        The point.
    intersections : (ninter, ndim) array
        The corners of the intersection, one for each facet of the dual hull; where the intersection is not bounded some are
        not on it, as in SciPy.
    dual_points : (nineq, ndim) array
        The half-spaces as points around the interior point.
    dual_facets : list of lists
        The half-spaces that meet in each corner, in turn.
    dual_equations : (ninter, ndim + 1) array
        Normals of the dual facets, and offsets.
    dual_area, dual_volume : float
        Sizes of the dual hull.

    Raises
    ------
    QhullError
        If the point is not strictly inside, or the duals span less than the plane or space.
    ValueError, TypeError
        What is wrong with the half-spaces, and where.

    Examples
    --------
    >>> import delone.scipy as spatial
    >>> square = spatial.HalfspaceIntersection([[1, 0, -1], [-1, 0, 0], [0, 1, -1], [0, -1, 0]], [0.25, 0.5])
    >>> sorted(square.intersections.round(9).tolist())
    [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
    """

    _theirs = scipy.spatial.HalfspaceIntersection

    @or_theirs
    def __init__(
        self,
        halfspaces: ArrayLike,
        interior_point: ArrayLike,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: float | str | None = "auto",
    ) -> None:
        """Intersects half-spaces."""
        refuse_options(qhull_options, incremental)
        self._qhull_options, self._merge, self._is_closed = qhull_options, merge, False
        for given, what in ((halfspaces, "halfspaces"), (interior_point, "interior_point")):
            if ma.is_masked(given):
                raise ValueError(f"{what} must not be masked")
        with taken_for_array(halfspaces):
            self._halfspaces = np.array(_as_halfspaces(halfspaces))
        self.ndim = self._halfspaces.shape[1] - 1
        with taken_for_array(interior_point):
            self.interior_point: NDArray[np.float64] = np.array(as_doubles(interior_point))
            if self.interior_point.shape != (self.ndim,):
                raise ValueError(f"interior_point must have the shape ({self.ndim},), not {self.interior_point.shape}")
        self._intersect()

    @classmethod
    def _suits(
        cls,
        halfspaces: ArrayLike,
        interior_point: ArrayLike,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: Any = None,
    ) -> bool:
        shape = np.shape(halfspaces)
        return is_ours(np.empty((0, shape[1] - 1)) if len(shape) == 2 and shape[1] else halfspaces, qhull_options, is_hull=True)

    def _intersect(self) -> None:
        normals, offsets = self._halfspaces[:, :-1], self._halfspaces[:, -1]
        self.nineq = self.npoints = len(self._halfspaces)
        with np.errstate(all="ignore"):
            depths = -(normals @ self.interior_point + offsets)
            self.dual_points: NDArray[np.float64] = normals / depths[:, None]
        outside = np.flatnonzero(~(depths > 0))
        if len(outside):
            row = self._halfspaces[outside[0]]
            raise qhull_error(f"interior_point is not feasible: not strictly inside of half-space {outside[0]}, {row}")
        far = np.flatnonzero(~np.isfinite(self.dual_points).all(axis=1))
        if len(far):
            raise qhull_error(f"interior_point is hardly feasible: too near to the border of half-space {far[0]}")
        merge = self._merge
        if isinstance(merge, str):
            # A border that is near makes a dual point that is far: rounding is measured by the nearest corner.
            exact = ConvexHull(self.dual_points, qhull_options=self._qhull_options, merge=None)
            merge = _delone.MERGE_AUTO * float(np.linalg.norm(self.dual_points[exact.vertices], axis=1).min())
        hull = ConvexHull(self.dual_points, qhull_options=self._qhull_options, merge=merge)
        self.min_bound, self.max_bound = self._halfspaces.min(axis=0), self._halfspaces.max(axis=0)
        self.dual_facets: list[list[int]] = [facet.tolist() for facet in hull.facets]
        self._dual_vertices = np.sort(hull.vertices).astype(np.int64)
        self.dual_area, self.dual_volume = hull.area, hull.volume
        self.dual_equations: NDArray[np.float64] = hull._facet_equations()
        with np.errstate(all="ignore"):
            away = -self.dual_equations[:, :-1] / self.dual_equations[:, -1:]
        self.intersections: NDArray[np.float64] = away + self.interior_point

    @property
    def halfspaces(self) -> NDArray[np.float64]:
        """The half-spaces, (nineq, ndim + 1)."""
        return self._halfspaces

    @property
    def dual_vertices(self) -> NDArray[np.int64]:
        """The half-spaces that bound the intersection: (nvertex,)."""
        return self._dual_vertices

    def add_halfspaces(self, halfspaces: ArrayLike, restart: bool = False) -> None:
        """Adds half-spaces, or one, whose indices follow those there are. RuntimeError after `close`.

        `restart` is for those who come from SciPy, and has no effect.
        """
        if self._is_closed:
            raise RuntimeError("closed: no half-spaces can be added any more")
        with taken_for_array(halfspaces):
            more = np.atleast_2d(as_more(halfspaces, (1, 2)))
            if more.shape[1] != self.ndim + 1:
                raise qhull_error(f"half-spaces must have {self.ndim + 1} numbers each, not {more.shape[1]}")
        before = self._halfspaces
        self._halfspaces = np.concatenate([before, more])
        try:
            self._intersect()
        except ValueError:
            self._halfspaces = before
            self._intersect()
            raise

    def close(self) -> None:
        """Ends changes: no half-spaces can be added any more."""
        self._is_closed = True

    def _shown(self) -> str:
        return f"<delone.scipy.HalfspaceIntersection: {self.nineq} half-spaces, {len(self.intersections)} corners>"


def _as_halfspaces(halfspaces: ArrayLike) -> NDArray[np.float64]:
    """Rows of three or four finite numbers."""
    rows = as_doubles(halfspaces)
    if rows.ndim == 2 and rows.shape[1] == 2:
        raise qhull_error("half-spaces must be of at least two dimensions, rows of three numbers; these are half-lines")
    if rows.ndim != 2 or rows.shape[1] not in (3, 4):
        raise ShapeError(f"halfspaces must be a 2D array of shape (n, 3) or (n, 4), not {rows.shape}")
    if not np.isfinite(rows).all():
        raise ValueError(f"half-space {np.argwhere(~np.isfinite(rows))[0][0]} is not finite")
    return rows
