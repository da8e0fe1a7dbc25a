"""Interpolation on a triangulation."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from ._delaunay import Delaunay
from ._points import as_flag, as_numbers, as_points


class LinearInterpolator:
    """Piecewise linear interpolation of values at points of the plane or of space.

    Takes the place of scipy.interpolate.LinearNDInterpolator.

    Parameters
    ----------
    points : array_like of shape (n, ndim), or Delaunay
        The points, or their triangulation.
    values : array_like of shape (n, ...)
        The values, real or complex.
    fill_value : number
        What there is outside of the hull; NaN.
    rescale : bool
        Whether to bring all axes to the same size first.
    outside : "fill" or "nearest"
        Whether to take the value of the nearest point outside instead.

    Examples
    --------
    >>> import delone
    >>> f = delone.LinearInterpolator([[0, 0], [2, 0], [0, 2]], [0.0, 2.0, 4.0])
    >>> f(0.5, 0.5).item(), f([[1.0, 0.0]]).tolist()
    (1.5, [1.0])
    """

    def __init__(
        self,
        points: ArrayLike | Delaunay,
        values: ArrayLike,
        fill_value: float = np.nan,
        rescale: bool = False,
        outside: Literal["fill", "nearest"] = "fill",
    ) -> None:
        """Triangulates the points, unless they are."""
        if outside not in ("fill", "nearest"):
            raise ValueError(f'outside must be "fill" or "nearest", not {outside!r}')
        self._offset: NDArray[np.float64] | float = 0.0
        self._scale: NDArray[np.float64] | float = 1.0
        rescale = as_flag(rescale, "rescale")
        if isinstance(points, Delaunay):
            if rescale:
                raise ValueError("rescale is for points, not for a triangulation")
            if points.furthest_site:
                raise ValueError("values are interpolated on a triangulation of nearest sites, not of furthest ones")
            self.tri = points
        else:
            given = as_points(points)
            if rescale and len(given):
                self._offset = given.mean(axis=0)
                size = np.ptp(given, axis=0)
                self._scale = np.where(size > 0, size, 1.0)
                given = (given - self._offset) / self._scale
            self.tri = Delaunay(given)
        if ma.isMaskedArray(values):
            raise ValueError("values are a masked array: leave out the points that have none")
        array: NDArray[Any] = np.asarray(values)
        if array.dtype.kind not in "fiubc":
            raise TypeError(f"values must be numbers, not {array.dtype}")
        if array.ndim == 0 or len(array) != self.tri.npoints:
            raise ValueError(f"{self.tri.npoints} points need as many values; they have the shape {array.shape}")
        self.values = array.astype(np.result_type(array.dtype, np.float64))
        fill = np.asarray(fill_value)
        if fill.ndim or fill.dtype.kind not in "fiubc" or not np.can_cast(fill.dtype, self.values.dtype):
            raise TypeError(f"fill_value must be a number of {self.values.dtype}, not {fill_value!r}")
        self.fill_value, self.outside = fill_value, outside

    def __call__(self, *xi: ArrayLike) -> NDArray[Any]:
        """Values at points: an array whose last axis has the coordinates, or an array for each coordinate."""
        ndim = self.tri.ndim
        if len(xi) == 1:
            at = _rounded(xi[0])
        elif len(xi) == ndim:
            at = np.stack(np.broadcast_arrays(*(_rounded(x) for x in xi)), axis=-1)
        else:
            raise ValueError(f"one array of points or {ndim} of coordinates, not {len(xi)}")
        if at.ndim == 0 or at.shape[-1] != ndim:
            raise ValueError(f"points must have {ndim} coordinates in their last axis; their shape is {at.shape}")
        shape = at.shape[:-1]
        rows = (at.reshape(-1, ndim) - self._offset) / self._scale
        known = np.isfinite(rows).all(axis=1)
        simplex = np.full(len(rows), -1, dtype=np.int32)
        simplex[known] = self.tri.find_simplex(rows[known])
        result = np.full((len(rows), *self.values.shape[1:]), self.fill_value, dtype=self.values.dtype)
        inside = np.flatnonzero(simplex >= 0)
        if len(inside):
            result[inside] = self._linear(rows[inside], simplex[inside])
        if self.outside == "nearest":
            beyond = np.flatnonzero(known & (simplex < 0))
            if len(beyond) and self.tri.vertex_count:
                result[beyond] = self.values[self.tri.nearest(rows[beyond])]
        return result.reshape((*shape, *self.values.shape[1:]))

    def _linear(self, rows: NDArray[np.float64], simplex: NDArray[np.int32]) -> NDArray[Any]:
        corners = self.tri.simplices[simplex]
        points = self.tri.points[corners]
        last = points[:, -1]
        sides = np.swapaxes(points[:, :-1] - last[:, None, :], 1, 2)
        away = rows - last
        # Cramer's rule, a determinant for each corner.
        whole = _det(sides)
        shares = np.empty((len(rows), self.tri.ndim + 1))
        for k in range(self.tri.ndim):
            part = sides.copy()
            part[:, :, k] = away
            with np.errstate(all="ignore"):
                shares[:, k] = _det(part) / whole
        shares[:, -1] = 1.0 - shares[:, :-1].sum(axis=1)
        values = self.values[corners]
        return np.asarray(np.einsum("nk,nk...->n...", shares, values))


def _rounded(xi: ArrayLike) -> NDArray[np.float64]:
    with np.errstate(all="ignore"):
        return as_numbers(xi, "xi").astype(np.float64)


def _det(m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Determinants of small matrices."""
    if m.shape[-1] == 2:
        return np.asarray(m[:, 0, 0] * m[:, 1, 1] - m[:, 0, 1] * m[:, 1, 0])
    a, b, c = m[:, :, 0], m[:, :, 1], m[:, :, 2]
    return np.asarray((a * np.cross(b, c)).sum(axis=1))
