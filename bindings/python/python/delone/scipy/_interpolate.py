"""Interpolators that are SciPy's too, on triangulations of Delone."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.interpolate
import scipy.spatial
from numpy.typing import ArrayLike, NDArray

from .. import _delaunay, _interpolate
from .._points import as_coordinates
from ._place import InItsPlace, as_doubles, or_theirs
from ._spatial import Delaunay


def _is_ours(points: Any) -> bool:
    """Whether they are a triangulation of ours, or points of the plane or of space."""
    if isinstance(points, scipy.spatial.Delaunay):
        return type.__instancecheck__(Delaunay, points)
    if isinstance(points, tuple):
        return len(points) in (2, 3)
    shape = np.shape(points)
    return not (len(shape) == 2 and shape[1] > 3)


def _as_points(points: Any) -> Any:
    """A triangulation as it is, else float64."""
    if isinstance(points, _delaunay.Delaunay):
        return points
    return as_doubles(as_coordinates(points, "points"))


class LinearNDInterpolator(_interpolate.LinearNDInterpolator, scipy.interpolate.LinearNDInterpolator, metaclass=InItsPlace):  # type: ignore[misc]
    """Piecewise linear interpolation: a `scipy.interpolate.LinearNDInterpolator`; see `delone.LinearNDInterpolator`."""

    _theirs = scipy.interpolate.LinearNDInterpolator
    _triangulation = Delaunay

    @or_theirs
    def __init__(
        self, points: Any, values: ArrayLike, fill_value: complex = np.nan, rescale: bool = False, **options: Any
    ) -> None:
        """Triangulates the points, unless they are."""
        super().__init__(_as_points(points), values, fill_value, rescale, **options)

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

    @property
    def offset(self) -> NDArray[np.float64] | float:
        """What `rescale` has taken from the points."""
        return self._offset

    @property
    def scale(self) -> NDArray[np.float64] | float:
        """What `rescale` has divided the points by."""
        return self._scale

    @property
    def is_complex(self) -> bool:
        """Whether values are complex."""
        return self._values.dtype.kind == "c"

    @property
    def values_shape(self) -> tuple[int, ...]:
        """The shape of the values of a point."""
        return self._values.shape[1:]


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
        values: ArrayLike,
        fill_value: complex = np.nan,
        tol: float = 1e-6,
        maxiter: int = 400,
        rescale: bool = False,
    ) -> None:
        """Triangulates the points, unless they are, and estimates gradients."""
        given = _as_points(points)
        where = given.points if isinstance(given, Delaunay) else given
        rows: NDArray[Any] = np.asarray(values)
        slopes: NDArray[Any] | None = None
        if where.ndim == 2 and where.shape[1] == 2 and len(rows) == len(where) > 0 and rows.dtype.kind in "fiubc":
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
    at = as_coordinates(points, "points")
    if at.ndim < 2 or at.shape[-1] == 1 or method not in ("linear", "cubic") or (method == "cubic" and at.shape[-1] != 2):
        result: NDArray[Any] = scipy.interpolate.griddata(points, values, xi, method, fill_value, rescale)
        return result
    kind = LinearNDInterpolator if method == "linear" else CloughTocher2DInterpolator
    result = kind(points, values, fill_value=fill_value, rescale=rescale)(xi)
    return result
