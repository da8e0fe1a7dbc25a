"""What is taken for points, queries, indices and flags, and what is refused."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from numbers import Integral, Real
from typing import Any

import numpy as np

# Beforehand: a fork while another thread imports it would leave it half imported.
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._geometries import coordinates

_DOUBLE = np.dtype(np.float64)


class ShapeError(ValueError, IndexError):
    """A number or a row where there must be points; SciPy raises IndexError for that in some places, ValueError in others."""


def as_numbers(values: ArrayLike, what: str) -> NDArray[Any]:
    """An array of real numbers of any shape.

    Arrays of objects are taken if all are real numbers, as columns of a DataFrame may be, and masked arrays if nothing is masked.
    Points that are geometries are taken by x and y: columns of geopandas, shapely's points, mappings of GeoJSON.

    Raises TypeError for what holds no real numbers, ValueError for masked values and for rows of several lengths.
    """
    if type(values) is np.ndarray and values.dtype.kind in "fiub":
        return values
    if ma.is_masked(values):
        raise ValueError(f"{what} is a masked array: give what counts, for example array[~array.mask.any(axis=1)].data")
    places = coordinates(values, what)
    if places is not None:
        return places
    array: NDArray[Any] = np.asarray(values)
    if array.dtype.kind == "O":
        array = _unboxed(array, what)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what} must hold real numbers, not {array.dtype}")
    return array


def _unboxed(array: NDArray[Any], what: str) -> NDArray[Any]:
    """Numbers that are objects of Python: integers as int64, others as float64, which must hold them exactly."""
    every = array.ravel().tolist()
    if not all(isinstance(x, (Real, np.bool_)) for x in every):
        remedy = "give them as float64, as array.astype(float) does, without what is missing"
        raise TypeError(f"{what} must hold real numbers, not object; {remedy}")
    try:
        if every and all(isinstance(x, Integral) for x in every):
            return np.array(every, dtype=np.int64).reshape(array.shape)
        result = np.array([float(x) for x in every])
    except OverflowError as error:
        raise ValueError(f"{what} holds numbers beyond the range of float64, or integers beyond that of int64") from error
    if any(x != y and x == x for x, y in zip(every, result.tolist(), strict=True)):
        raise ValueError(f"{what} holds numbers that float64 does not hold exactly; round them with astype(numpy.float64)")
    return result.reshape(array.shape)


def as_points(points: ArrayLike, what: str = "points", columns: int | None = None) -> NDArray[np.float64]:
    """Coordinates as a C-contiguous and aligned float64 array of shape (n, 2) or (n, 3); the same array if it is one already.

    Raises TypeError for what holds no real numbers, ValueError for wrong shapes and for numbers that float64 does not tell
    apart or that are not finite.
    """
    array = as_numbers(points, what)
    if array.ndim != 2:
        raise ShapeError(f"{what} must have the shape (n, 2) or (n, 3), not {array.shape} of {array.ndim} dimensions")
    if columns is None and array.shape[1] not in (2, 3):
        turned = "; rows are points, so transpose it" if array.shape[0] in (2, 3) and array.shape[1] > 3 else ""
        raise ValueError(f"{what} must have 2 or 3 coordinates each, not {array.shape[1]}{turned}")
    if columns is not None and array.shape[1] != columns:
        raise ValueError(f"{what} must have {columns} coordinates each, not {array.shape[1]}")
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and array.size:
        largest = max(abs(int(array.min())), abs(int(array.max())))
        if largest > 2**53:
            raise ValueError(f"{what} holds integers beyond 2**53, which float64 does not tell apart")
    result: NDArray[np.float64] = array
    if array.dtype is not _DOUBLE or not (array.flags.c_contiguous and array.flags.aligned):
        with np.errstate(over="ignore", under="ignore"):
            result = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    if not _delone.is_finite(result):
        row, column = np.argwhere(~np.isfinite(result))[0]
        raise ValueError(f"{what}: point {row} has the {'xyz'[column]} coordinate {array[row, column]}, which is not finite")
    if array.dtype.kind == "f" and array.dtype.itemsize > 8 and (result != array).any():
        raise ValueError(f"{what} holds numbers that float64 does not hold exactly; round them with astype(numpy.float64)")
    return result


def as_coordinates(values: ArrayLike, what: str) -> NDArray[Any]:
    """Points as SciPy's interpolators take them.

    A tuple has an array for each coordinate, which are broadcast and become the last axis; all else is an array with that axis.
    """
    if isinstance(values, tuple):
        return np.stack(np.broadcast_arrays(*(as_numbers(x, what) for x in values)), axis=-1) if values else np.empty(0)
    return as_numbers(values, what)


def as_queries(xi: ArrayLike, columns: int, what: str = "xi") -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Queries as rows, and the shape that their answers have: that of `xi` without its last axis."""
    if np.asarray(xi).ndim == 0 and coordinates(xi, what) is None:
        raise ShapeError(f"{what} must have {columns} coordinates in its last axis; it is no array but {xi!r}")
    array = as_numbers(xi, what)
    if array.shape[-1] != columns:
        raise ValueError(f"{what} must have {columns} coordinates in its last axis; its shape is {array.shape}")
    return as_points(array.reshape(-1, columns), what, columns), array.shape[:-1]


def as_indices(values: int | Iterable[int] | ArrayLike, count: int) -> list[int]:
    """Indices of so many points: from an integer, from integers, or from a mask of a boolean for each point, as NumPy has it.

    Raises TypeError for all else, IndexError for masks of another length. Whether there are such points is for the caller.
    """
    given: Any = values
    if isinstance(given, (set, frozenset)) or hasattr(given, "__next__"):
        given = list(given)
    if ma.isMaskedArray(given):
        raise TypeError("indices must not be a masked array")
    array: NDArray[Any] = np.asarray(given)
    if array.dtype.kind == "b":
        if array.shape != (count,):
            raise IndexError(f"a mask must have the shape ({count},), one boolean for each point, not {array.shape}")
        found: list[int] = np.flatnonzero(array).tolist()
        return found
    if array.dtype.kind == "O" and array.ndim < 2:
        # Integers beyond 64 bits; they are indices of nothing, and are told so.
        return [as_index(v, "an index") for v in array.ravel().tolist()]
    if array.ndim > 1 or (array.dtype.kind not in "iu" and array.size):
        raise TypeError(f"indices must be integers or a mask, not an array of {array.dtype} and the shape {array.shape}")
    return [int(v) for v in array.ravel().tolist()]


def as_segments(segments: ArrayLike | None, count: int) -> NDArray[np.int64]:
    """Pairs of indices of so many points as a C-contiguous array of shape (m, 2); None for no segments.

    Raises TypeError for what holds no integers, ValueError for wrong shapes, IndexError for what is no index of a point.
    """
    if segments is None:
        return np.empty((0, 2), dtype=np.int64)
    array = as_numbers(segments, "segments")
    if array.shape == (0,):
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"segments must have the shape (m, 2), two indices of points each, not {array.shape}")
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"segments must hold integers, which are indices of points, not {array.dtype}")
    wrong = (array < 0) | (array >= count)
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        index = int(array[row, column])
        raise IndexError(f"segment {row} ends at point {index}, and there are {count} points, counted from 0")
    return np.ascontiguousarray(array, dtype=np.int64)


def as_choice(value: Any, choices: tuple[str, ...], what: str) -> str:
    """One of some words."""
    if isinstance(value, str) and value in choices:
        return value
    raise ValueError(f"{what} must be one of {', '.join(map(repr, choices))}, not {value!r}")


def as_index(value: Any, what: str) -> int:
    """An integer that is no boolean."""
    if not isinstance(value, (bool, np.bool_)):
        try:
            return operator.index(value)
        except TypeError:
            pass
    raise TypeError(f"{what} must be an integer, not {value!r}")


def as_number_in(value: Any, what: str, least: int, most: int) -> int:
    """An integer of a range."""
    number = as_index(value, what)
    if not least <= number <= most:
        raise ValueError(f"{what} must be an integer from {least} to {most}, not {number}")
    return number


def as_names(values: Any, what: str) -> list[str]:
    """Names, which one text is not: it would be one for each of its letters."""
    names = [] if isinstance(values, str) else list(values)
    if isinstance(values, str) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"{what} must be names, as in ['x', 'y', 'z'], not {values!r}")
    return names


def as_count(k: Any, queries: int) -> int:
    """How many neighbors each of so many queries is to have: at least one."""
    k = as_index(k, "k")
    if k < 1:
        raise ValueError(f"k must be at least 1, not {k}")
    if k >= 2**62:
        raise MemoryError(f"{queries} times {k} neighbors")
    return int(k)


def as_flag(value: Any, what: str) -> bool:
    """True or False, or the numbers 1 and 0."""
    if isinstance(value, (bool, np.bool_)) or (isinstance(value, (int, np.integer)) and value in (0, 1)):
        return bool(value)
    raise TypeError(f"{what} must be True or False, not {value!r}")


def owned(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """A copy that nobody writes."""
    copied = np.array(points, order="C")
    copied.flags.writeable = False
    return copied
