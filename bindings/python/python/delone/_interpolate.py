"""Interpolation on a triangulation, with the names and the calls of scipy.interpolate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._delaunay import Delaunay
from ._points import as_choice, as_coordinates, as_flag, as_points, as_queries

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_SMOOTH = ("smooth", "farin")


class _Interpolator:
    """What interpolators have in common: points, values with a row for each, and how they are called."""

    _method = "linear"
    #: What triangulates points.
    _triangulation = Delaunay

    def __init__(self, points: ArrayLike | Delaunay, values: ArrayLike, fill_value: complex, rescale: bool, outside: str) -> None:
        self.outside = as_choice(outside, ("fill", "nearest", "hull"), "outside")
        self._offset: NDArray[np.float64] | float = 0.0
        self._scale: NDArray[np.float64] | float = 1.0
        rescale = as_flag(rescale, "rescale")
        if isinstance(points, Delaunay):
            if rescale:
                raise ValueError("Rescaling is not supported when passing a Delaunay triangulation as ``points``.")
            if points.furthest_site:
                raise ValueError("values are interpolated on a triangulation of nearest sites, not of furthest ones")
            self.tri = points
        else:
            given = as_points(as_coordinates(points, "points"))
            if rescale and len(given):
                self._offset = given.mean(axis=0)
                size = np.ptp(given, axis=0)
                self._scale = np.where(size > 0, size, 1.0)
                given = (given - self._offset) / self._scale
            self.tri = self._triangulation(given)
        self._values = _as_values(values, self.tri.npoints)
        fill = np.asarray(fill_value)
        if fill.ndim or fill.dtype.kind not in "fiubc" or not np.can_cast(fill.dtype, self._values.dtype):
            raise TypeError(f"fill_value must be a number of {self._values.dtype}, not {fill_value!r}")
        self.fill_value = fill_value

    @property
    def values(self) -> NDArray[Any]:
        """The values, a row for each point."""
        return self._values

    @property
    def points(self) -> NDArray[np.float64]:
        """The points of the triangulation; with `rescale` the scaled ones, as in SciPy."""
        return self.tri.points

    def __call__(self, *xi: ArrayLike, simplex_tolerance: float = 1.0) -> NDArray[Any]:
        """Values at points: an array whose last axis has the coordinates, or an array for each coordinate.

        As in SciPy a tuple is one of coordinates, `f((x, y))` as `f(x, y)`, and they are broadcast; an array or list of one
        axis is points one after the other. Of shape (..., *values.shape[1:]). Points with a coordinate that is not finite are
        outside. All threads are used. `simplex_tolerance` is for those who come from SciPy, and has no effect: which simplex
        holds a point is decided exactly.
        """
        _ = float(simplex_tolerance)
        rows, shape = self._queries(xi)
        known = np.isfinite(rows).all(axis=1)
        every = bool(known.all())
        table = self._table()
        asked = rows if every else rows[known]
        found = _delone.interpolate(self.tri._core, self._method, self.outside, asked, table, self._slopes())
        lost = np.array(~known)
        if not np.isnan(self.fill_value):
            # Values may be NaN too: outside are only those for which ones are.
            doubtful = np.flatnonzero(np.isnan(found).all(axis=1))
            ones = np.ones((self.tri.npoints, 1))
            sure = _delone.interpolate(self.tri._core, "linear", self.outside, asked[doubtful], ones)
            lost[np.flatnonzero(known)[doubtful[np.isnan(sure[:, 0])]]] = True
        if every:
            whole = found
        else:
            whole = np.full((len(rows), table.shape[1]), np.nan)
            whole[known] = found
        result = whole.view(self._values.dtype).reshape(len(rows), *self._values.shape[1:])
        if lost.any():
            result[lost] = self.fill_value
        return result.reshape((*shape, *self._values.shape[1:]))

    def weights(self, queries: ArrayLike) -> csr_array:
        """The weights of points at queries, whose last axis has the coordinates.

        A `scipy.sparse.csr_array` of shape (m, npoints): `f.weights(queries) @ values` interpolates any other values at the same
        places. Rows have the sum one; those of queries outside are empty, which gives 0. Smooth surfaces are no sums of values
        alone: with "smooth" and "farin" these are the weights of Sibson, which both begin with. All queries must be finite.
        """
        at, _ = as_queries(as_coordinates(queries, "queries"), self.tri.ndim, "queries")
        at = np.ascontiguousarray((at - self._offset) / self._scale)
        starts, columns, values = _delone.interpolation_weights(self.tri._core, self._method, self.outside, at)
        try:
            from scipy.sparse import csr_array
        except ImportError as error:
            raise ImportError("sparse arrays are SciPy's: pip install scipy") from error
        return csr_array((values, columns, starts), shape=(len(at), self.tri.npoints))

    def _slopes(self) -> NDArray[np.float64] | None:
        return None

    def _table(self) -> NDArray[np.float64]:
        """The values as rows of float64, complex ones as two."""
        count = self.tri.npoints
        if len(self._values) != count:
            raise ValueError(
                f"there are {len(self._values)} values and {count} points, because points were added to the triangulation: "
                "make an interpolator anew"
            )
        return self._values.reshape(count, -1 if count else int(np.prod(self._values.shape[1:]))).view(np.float64)

    def _queries(self, xi: tuple[ArrayLike, ...]) -> tuple[NDArray[np.float64], tuple[int, ...]]:
        ndim = self.tri.ndim
        if len(xi) not in (1, ndim):
            raise ValueError(f"one array of points or {ndim} of coordinates, not {len(xi)}")
        given: Any = xi[0] if len(xi) == 1 else xi
        at = as_coordinates(given, "xi")
        if at.ndim == 1 and not isinstance(given, tuple) and len(at) % ndim == 0:
            at = at.reshape(-1, ndim)
        if at.ndim == 0 or at.shape[-1] != ndim:
            raise ValueError(f"points must have {ndim} coordinates in their last axis; their shape is {at.shape}")
        with np.errstate(all="ignore"):
            at = at.astype(np.float64)
        rows = (at.reshape(-1, ndim) - self._offset) / self._scale
        return np.ascontiguousarray(rows), at.shape[:-1]


class LinearNDInterpolator(_Interpolator):
    """Piecewise linear interpolation of values at points of the plane or of space.

    Takes the place of scipy.interpolate.LinearNDInterpolator. `LinearInterpolator` is the same class. Points on one line, or in
    space in one plane, are no error: values are linear along it, and everything else is outside.

    Parameters
    ----------
    points : array_like of shape (n, ndim), or a tuple of arrays of coordinates, or Delaunay
        The points, or their triangulation, which can be that of many interpolators.
    values : array_like of shape (n, ...)
        The values, real or complex. Of equal points the first one's count.
    fill_value : number
        What there is outside of the hull; NaN.
    rescale : bool
        Whether to bring all axes to the same size first.
    outside : "fill", "nearest" or "hull"
        What there is outside: `fill_value`, the value of the nearest point, or the value at the nearest point of the hull.
        Queries that are on the hull but for rounding, by 2**-48 of the largest coordinate, have the hull's value always.

    Examples
    --------
    >>> import delone
    >>> f = delone.LinearNDInterpolator([[0, 0], [2, 0], [0, 2]], [0.0, 2.0, 4.0])
    >>> f(0.5, 0.5).item(), f([[1.0, 0.0]]).tolist()
    (1.5, [1.0])
    >>> f.weights([[1.0, 0.0]]).toarray().tolist()
    [[0.5, 0.5, 0.0]]
    """

    def __init__(
        self,
        points: ArrayLike | Delaunay,
        values: ArrayLike,
        fill_value: complex = np.nan,
        rescale: bool = False,
        outside: Literal["fill", "nearest", "hull"] = "fill",
    ) -> None:
        """Triangulates the points, unless they are."""
        super().__init__(points, values, fill_value, rescale, outside)


LinearInterpolator = LinearNDInterpolator


class NaturalNeighborInterpolator(_Interpolator):
    """Interpolation by natural neighbors of values at points of the plane or of space.

    Called as SciPy's interpolators are. Which points take part is exact, and the result is the same for any number of threads
    and any order of the points. Linear functions come out as they are. On the border of the hull values are linear. Cost: of k
    neighbors O(k log k) for each query, and more for queries that are far from the ones before.

    Parameters
    ----------
    points : array_like of shape (n, ndim), or a tuple of arrays of coordinates, or Delaunay
        The points, or their triangulation, which can be that of many interpolators.
    values : array_like of shape (n, ...)
        The values, real or complex. Of equal points the first one's count.
    method : "sibson", "laplace", "smooth" or "farin"
        "sibson": each neighbor weighs what the cell of the query would take from its cell; smooth but at the points.
        "laplace": the length, in space the area, of the border between both cells over their distance; with kinks at circles.
        "smooth" is Sibson's surface with gradients, and "farin" the cubic one of Farin, which has all quadratic functions whose
        gradients are given: both are smooth everywhere inside, and take a column of values at a time.
    fill_value : number
        What there is outside of the hull; NaN.
    rescale : bool
        Whether to bring all axes to the same size first.
    outside : "fill", "nearest" or "hull"
        What there is outside: `fill_value`, the value of the nearest point, or the value at the nearest point of the hull.
        Queries that are on the hull but for rounding, by 2**-48 of the largest coordinate, have the hull's value always.
    gradients : array_like of shape (n, ..., ndim), optional
        The derivatives of values along the axes, for "smooth" and "farin"; else they are estimated, as `gradients()` tells.

    Examples
    --------
    >>> import delone
    >>> corners = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]]
    >>> f = delone.NaturalNeighborInterpolator(corners, [0.0, 4.0, 4.0, 0.0, 2.0])
    >>> round(f(2.5, 2.5).item(), 12), f([[9.0, 9.0]]).tolist()
    (2.5, [nan])
    >>> f.weights([[2.0, 2.0]]).shape
    (1, 5)
    """

    def __init__(
        self,
        points: ArrayLike | Delaunay,
        values: ArrayLike,
        method: Literal["sibson", "laplace", "smooth", "farin"] = "sibson",
        fill_value: complex = np.nan,
        rescale: bool = False,
        outside: Literal["fill", "nearest", "hull"] = "fill",
        *,
        gradients: ArrayLike | None = None,
    ) -> None:
        """Triangulates the points, unless they are."""
        self._method = self.method = as_choice(method, ("sibson", "laplace", "smooth", "farin"), "method")
        super().__init__(points, values, fill_value, rescale, outside)
        self._given: NDArray[np.float64] | None = None
        if gradients is not None:
            if method not in _SMOOTH:
                raise ValueError(f'gradients are for method="smooth" and "farin", not {method!r}')
            self._given = self._as_slopes(gradients)

    def gradients(self) -> NDArray[Any]:
        """The gradients at the points: (n, ..., ndim), in units of values for a unit of length along each axis.

        Those given, else estimates from the neighbors of each point, which are right for linear functions, and but at the border
        for a + b x + c |x|^2.
        """
        slopes = self._given if self._given is not None else _delone.vertex_gradients(self.tri._core, self._table())
        rows = np.moveaxis(slopes, 0, 1) / self._scale
        shape = (*self._values.shape, self.tri.ndim)
        if self._values.dtype.kind == "c":
            return np.asarray(rows[:, 0::2] + 1j * rows[:, 1::2]).reshape(shape)
        return rows.reshape(shape)

    def _slopes(self) -> NDArray[np.float64] | None:
        if self._method in _SMOOTH and self._given is None:
            self._given = _delone.vertex_gradients(self.tri._core, self._table())
        return self._given

    def _as_slopes(self, gradients: ArrayLike) -> NDArray[np.float64]:
        """As an array (columns, n, ndim)."""
        if ma.isMaskedArray(gradients):
            raise ValueError("gradients are a masked array: leave out the points that have none")
        array: NDArray[Any] = np.asarray(gradients)
        shape = (*self._values.shape, self.tri.ndim)
        if array.dtype.kind not in "fiubc" or not np.can_cast(array.dtype, self._values.dtype, "same_kind"):
            raise TypeError(f"gradients must be numbers as the values are, {self._values.dtype}, not {array.dtype}")
        if array.shape != shape:
            raise ValueError(f"gradients must have the shape {shape}, a derivative along each axis, not {array.shape}")
        columns = int(np.prod(self._values.shape[1:]))
        rows = array.astype(self._values.dtype).reshape(len(array), columns, self.tri.ndim)
        if not np.isfinite(rows).all():
            point = int(np.argwhere(~np.isfinite(rows))[0][0])
            raise ValueError(f"gradients: that of point {point} is not finite; leave gradients out to have them estimated")
        if self._values.dtype.kind == "c":
            rows = np.stack([rows.real, rows.imag], axis=2).reshape(len(array), 2 * columns, self.tri.ndim)
        return np.ascontiguousarray(np.moveaxis(rows * self._scale, 1, 0), dtype=np.float64)


def _as_values(values: ArrayLike, count: int) -> NDArray[Any]:
    """A row for each of so many points, float64 or complex128."""
    if ma.is_masked(values):
        raise ValueError("values are a masked array: leave out the points that have none")
    array: NDArray[Any] = np.asarray(values)
    if array.dtype.kind not in "fiubc":
        remedy = "; give them as float64 or complex128, as array.astype(float) does" if array.dtype.kind == "O" else ""
        raise TypeError(f"values must be numbers, not {array.dtype}{remedy}")
    if array.ndim == 0 or len(array) != count:
        raise ValueError(f"{count} points need as many values; they have the shape {array.shape}")
    return np.array(array, dtype=np.complex128 if array.dtype.kind == "c" else np.float64, order="C")
