"""Interpolators that are SciPy's too, on triangulations of Delone."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import scipy.interpolate
import scipy.spatial
from numpy.typing import ArrayLike, NDArray

from .. import _delaunay, _interpolate
from .._points import ShapeError
from ._place import Assignable, InItsPlace, as_doubles, as_rows, or_theirs
from ._spatial import Delaunay


def _is_ours(points: Any) -> bool:
    """Whether they are a triangulation of ours with all its own, or points of the plane or of space."""
    if isinstance(points, scipy.spatial.Delaunay):
        return type.__instancecheck__(Delaunay, points) and not (points.furthest_site or points._is_assigned())
    if isinstance(points, tuple):
        return len(points) in (2, 3)
    shape = np.shape(points)
    return not (len(shape) == 2 and shape[1] > 3)


def _as_coordinates(given: Any, ndim: int = 1) -> NDArray[Any]:
    """Coordinates in the last axis, as SciPy's interpolators take them.

    A tuple has an array for each, an array of one axis has points one after the other. Masks do not count.
    """
    if isinstance(given, tuple) and len(given) == 1:
        given = given[0]
    if not isinstance(given, tuple):
        array: NDArray[Any] = np.asarray(given)
        return array.reshape(-1, ndim) if array.ndim == 1 else array
    if not given:
        raise ShapeError("no coordinates")
    parts = np.broadcast_arrays(*given)
    stacked = np.empty((*parts[0].shape, len(parts)))
    for axis, part in enumerate(parts):
        stacked[..., axis] = part
    return stacked


def _as_points(points: Any) -> Any:
    """A triangulation as it is, else float64."""
    if isinstance(points, _delaunay.Delaunay):
        return points
    return as_doubles(_as_coordinates(points))


def _as_values(values: ArrayLike, fill_value: Any) -> tuple[NDArray[Any], Any]:
    """Values and what there is outside, as float64 or complex128."""
    array: NDArray[Any] = np.asarray(values)
    if not array.ndim:
        raise ShapeError(f"values must have a row for each point; it is no array but {values!r}")
    if np.issubdtype(array.dtype, np.complexfloating):
        return array.astype(np.complex128), complex(fill_value)
    return array.astype(np.float64), float(fill_value)


def _refuse_changed(tri: Any, count: int) -> None:
    """A ValueError for triangulations that are no longer those of so many values."""
    if tri.npoints != count:
        raise ValueError(
            f"there are {count} values and {tri.npoints} points, because points were added to the triangulation: "
            "make an interpolator anew"
        )
    if _is_assigned(tri):
        tri._refuse_out_of_range(alone=False)


def _is_assigned(tri: Any) -> bool:
    """Whether parts of a triangulation of ours were assigned."""
    return type.__instancecheck__(Delaunay, tri) and tri._is_assigned()


class LinearNDInterpolator(_interpolate.LinearNDInterpolator, scipy.interpolate.LinearNDInterpolator, metaclass=InItsPlace):  # type: ignore[misc]
    """Piecewise linear interpolation: a `scipy.interpolate.LinearNDInterpolator`; see `delone.LinearNDInterpolator`."""

    _theirs = scipy.interpolate.LinearNDInterpolator
    _triangulation = Delaunay

    @or_theirs
    def __init__(
        self,
        points: Any,
        values: ArrayLike,
        fill_value: complex = np.nan,
        rescale: bool = False,
        outside: Literal["fill", "nearest", "hull"] = "fill",
    ) -> None:
        """Triangulates the points, unless they are."""
        self._is_scaled = bool(rescale)
        numbers, fill = _as_values(values, fill_value)
        super().__init__(_as_points(points), numbers, fill, self._is_scaled, outside)

    @classmethod
    def _suits(cls, points: Any, *args: Any, **options: Any) -> bool:
        return _is_ours(points)

    @property
    def values(self) -> NDArray[Any]:
        """The values, a row for each point and a column for each of its values."""
        return self._values.reshape(len(self._values), -1)

    @values.setter
    def values(self, values: ArrayLike) -> None:
        """Takes other values at the same points."""
        self._values = _interpolate._as_values(values, self.tri.npoints)

    @values.deleter
    def values(self) -> None:
        """There are none any more."""
        del self._values

    points = Assignable(lambda self: self.tri.points)
    scale = Assignable(lambda self: self._scale if self._is_scaled else None)
    is_complex = Assignable(lambda self: self._values.dtype.kind == "c")
    values_shape = Assignable(lambda self: self._values.shape[1:])

    @Assignable
    def offset(self) -> NDArray[np.float64] | float:
        """What `rescale` has taken from the points."""
        if not self._is_scaled:
            raise AttributeError("nothing was rescaled")
        return self._offset

    def __call__(self, *xi: Any, simplex_tolerance: float = 1.0) -> NDArray[Any]:
        """Values at points, as `delone.LinearNDInterpolator` has them; in simplices that were assigned SciPy finds them."""
        if not simplex_tolerance > 0:
            raise ValueError("simplex_tolerance must be positive")
        if isinstance(self.tri, _delaunay.Delaunay) and not _is_assigned(self.tri):
            return super().__call__(*xi)
        _refuse_changed(self.tri, len(self._values))
        found: NDArray[Any] = scipy.interpolate.LinearNDInterpolator.__call__(self, *xi)
        return found

    def _queries(self, xi: tuple[Any, ...]) -> tuple[NDArray[np.float64], tuple[int, ...]]:
        rows, shape = as_rows(_as_coordinates(xi, self.tri.ndim), self.tri.ndim)
        return (rows if self.scale is None else (rows - self.offset) / self.scale), shape


class CloughTocher2DInterpolator(scipy.interpolate.CloughTocher2DInterpolator, metaclass=InItsPlace):  # type: ignore[misc]
    """A smooth piecewise cubic surface through values at points of the plane: SciPy's own, on a triangulation of Delone.

    Gradients are estimated as SciPy does, after a plane was taken away from the values: so linear functions come out as they
    are, and all others the nearer to where SciPy's iteration would end.

    Parameters
    ----------
    points : array_like of shape (n, 2), or a tuple of arrays of coordinates, or Delaunay
        The points, or their triangulation.
    values : array_like of shape (n, ...)
        The values, real or complex.
    fill_value : number
        What there is outside of the hull; NaN.
    tol, maxiter : float, int
        When the estimation of gradients ends: SciPy's.
    rescale : bool
        Whether to bring both axes to the same size first.

    Examples
    --------
    >>> import delone.scipy as spatial
    >>> f = spatial.CloughTocher2DInterpolator([[0, 0], [1, 0], [1, 1], [0, 1]], [0.0, 1.0, 3.0, 2.0])
    >>> round(f(0.25, 0.5).item(), 12)
    1.25
    """

    _theirs = scipy.interpolate.CloughTocher2DInterpolator
    values: NDArray[Any]
    grad: NDArray[Any]

    @or_theirs
    def __init__(
        self,
        points: Any,
        values: ArrayLike | None,
        fill_value: complex = np.nan,
        tol: float = 1e-6,
        maxiter: int = 400,
        rescale: bool = False,
    ) -> None:
        """Triangulates the points, unless they are, and estimates gradients."""
        given = _as_points(points)
        if isinstance(given, _delaunay.Delaunay) and not isinstance(given, Delaunay):
            given = given.to_scipy()
        if values is None:
            # Values that are set later are SciPy's own affair.
            super().__init__(given, None, fill_value, tol, maxiter, rescale)
            return
        where = given.points if isinstance(given, Delaunay) else given
        rows = _as_values(values, fill_value)[0]
        if where.ndim == 2 and where.shape[1] == 2 and len(rows) == len(where) > 0:
            rest, slopes = _without_plane(where, rows)
            super().__init__(given, rest.reshape(rows.shape), fill_value, tol, maxiter, rescale)
            self.values = np.ascontiguousarray(rows.reshape(self.values.shape), dtype=self.values.dtype)
            scale = self.scale if rescale else 1.0
            self.grad = np.ascontiguousarray(self.grad + slopes * scale)
        else:
            # What is wrong with them SciPy says.
            super().__init__(given, values, fill_value, tol, maxiter, rescale)

    @classmethod
    def _suits(cls, points: Any, *args: Any, **options: Any) -> bool:
        return _is_ours(points)

    def __call__(self, *xi: Any, **options: Any) -> NDArray[Any]:
        """Values at points: an array whose last axis has the coordinates, or an array for each coordinate."""
        if self.values is not None:
            _refuse_changed(self.tri, min(len(self.values), len(self.grad)))
        found: NDArray[Any] = super().__call__(*xi, **options)
        return found

    def _calculate_triangulation(self, points: NDArray[np.float64]) -> None:
        self.tri = Delaunay(points)


def _without_plane(points: NDArray[np.float64], values: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """The columns of values less the plane that fits each best, and the slopes of these: (columns, 2).

    Nothing is taken from what is not finite.
    """
    columns = values.reshape(len(values), -1).astype(np.complex128 if values.dtype.kind == "c" else np.float64)
    with np.errstate(all="ignore"):
        middle = points.mean(axis=0)
        size = np.abs(points - middle).max()
        at = (points - middle) / size
    if not np.isfinite(columns).all() or not np.isfinite(at).all():
        return columns, np.zeros((columns.shape[1], 2))
    found = np.linalg.lstsq(np.column_stack([np.ones(len(at)), at]), columns, rcond=None)[0]
    return columns - found[0] - at @ found[1:], found[1:].T / size


def griddata(
    points: Any, values: ArrayLike, xi: Any, method: str = "linear", fill_value: complex = np.nan, rescale: bool = False
) -> NDArray[Any]:
    """Values between scattered points, as `scipy.interpolate.griddata`.

    Parameters
    ----------
    points : array_like of shape (n, ndim), or a tuple of ndim arrays of coordinates
        The points; of one dimension SciPy's own function is called.
    values : array_like of shape (n, ...)
        The values.
    xi : array_like of shape (..., ndim), or a tuple of arrays of coordinates
        Where values are wanted.
    method : "linear", "nearest" or "cubic"
        Cubic is for the plane.
    fill_value : number
        What there is outside of the hull; "nearest" has no outside.
    rescale : bool
        Whether to bring all axes to the same size first.

    Examples
    --------
    >>> import delone.scipy as spatial
    >>> spatial.griddata([[0, 0], [2, 0], [0, 2]], [0.0, 2.0, 4.0], ([0.5], [0.5])).tolist()
    [1.5]
    """
    at = _as_coordinates(points)
    if at.ndim < 2 or at.shape[-1] == 1 or method not in ("linear", "cubic") or (method == "cubic" and at.shape[-1] != 2):
        result: NDArray[Any] = scipy.interpolate.griddata(points, values, xi, method, fill_value, rescale)
        return result
    kind = LinearNDInterpolator if method == "linear" else CloughTocher2DInterpolator
    result = kind(points, values, fill_value=fill_value, rescale=rescale)(xi)
    return result
