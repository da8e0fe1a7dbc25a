"""What is taken for an array of points, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def as_points(points: ArrayLike, what: str = "points", columns: int | None = None) -> NDArray[np.float64]:
    """Coordinates as a C-contiguous and aligned float64 array of shape (n, 2) or (n, 3); the same array if it is one already.

    Raises TypeError for what holds no real numbers, ValueError for wrong shapes and for numbers that are not finite.
    """
    if np.ma.isMaskedArray(points):
        raise TypeError(f"{what} is a masked array: give the points that count, for example masked.compressed() by column")
    array: NDArray[Any] = np.asarray(points)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what} must hold real numbers, not {array.dtype}")
    if array.ndim != 2:
        raise ValueError(f"{what} must have the shape (n, 2) or (n, 3), not {array.shape}")
    if columns is None and array.shape[1] not in (2, 3):
        raise ValueError(f"{what} must have 2 or 3 coordinates each, not {array.shape[1]}")
    if columns is not None and array.shape[1] != columns:
        raise ValueError(f"{what} must have {columns} coordinates each, not {array.shape[1]}")
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and array.size:
        largest = max(abs(int(array.min())), abs(int(array.max())))
        if largest > 2**53:
            raise ValueError(f"{what} holds integers beyond 2**53, which float64 does not tell apart")
    with np.errstate(over="ignore"):
        result: NDArray[np.float64] = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    is_finite = np.isfinite(result)
    if not is_finite.all():
        row, column = np.argwhere(~is_finite)[0]
        raise ValueError(f"{what}: point {row} has the {'xyz'[column]} coordinate {result[row, column]}, which is not finite")
    return result


def as_queries(xi: ArrayLike, columns: int) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Queries as rows, and the shape that their answers have: that of `xi` without its last axis."""
    if np.ma.isMaskedArray(xi):
        raise TypeError("xi is a masked array")
    array: NDArray[Any] = np.asarray(xi)
    if array.ndim == 0 or array.shape[-1] != columns:
        raise ValueError(f"xi must have {columns} coordinates in its last axis; its shape is {array.shape}")
    return as_points(array.reshape(-1, columns), "xi", columns), array.shape[:-1]
