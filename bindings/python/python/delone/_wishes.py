"""What is wanted of a mesh: arguments, checked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._points import as_choice, as_flag, as_index, as_numbers, as_points

#: Whether a triangle is to be refined, by its corners (3, 2) and its area.
Test = Callable[[NDArray[np.float64], float], bool]

#: What an element may be large: a number, a number for each point, or a function of a place.
Size = float | ArrayLike | Callable[[float, float], float]


class Wanted(TypedDict):
    """What is wanted of a mesh."""

    min_angle: float
    max_area: float | None
    max_edge: float | None
    min_edge: float
    edge: float | None
    growth: float
    max_vertices: int | None
    keep: str
    conforming: bool
    smooth: int
    size: Callable[[float, float], float] | NDArray[np.float64] | None
    refine_if: Test | None


class Wishes(Wanted):
    """The same, and what is inside; `_delone.Mesh` takes it."""

    fill: str
    holes: NDArray[np.float64]
    #: Places and largest areas, which may be infinite.
    regions: NDArray[np.float64]
    keep_concavities: bool
    #: An area for each triangle: of the mesh that is refined again, or of this triangulation.
    max_areas: NDArray[np.float64] | None
    #: The first height, the number of rows, growth, thickness, and segments.
    layers: tuple[float, int, float, float | None, list[int] | None] | None
    of: _delone.Constrained | None
    #: Rows of segments that are chords of arcs, and the centers of these.
    arcs: tuple[NDArray[np.int64], NDArray[np.float64]] | None
    #: Triangles that stay until a vertex comes near.
    triangles: NDArray[np.int64] | None
    #: Triangles whose vertices go; what is wanted besides is then `min_angle`.
    coarsen: NDArray[np.bool_] | None


FILLS = ("all", "even-odd", "nonzero", "positive", "negative", "seeds")
_KEPT = ("nothing", "border", "constraints")


def flags_of(marked: ArrayLike, name: str, count: int, what: str = "triangles") -> NDArray[np.bool_]:
    """A flag for each of so many, of flags or indices."""
    array = np.asarray(marked)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ValueError(f"{name} must have a flag for each of {count} {what}; its shape is {array.shape}")
        return array
    if array.ndim != 1 or (array.size and array.dtype.kind not in "iu"):
        raise TypeError(f"{name} must be flags or integers in a row, not {array.dtype} of the shape {array.shape}")
    rows = array.astype(np.int64)
    if rows.size and not -1 < rows.min() <= rows.max() < count:
        k = int(np.argmax((rows < 0) | (rows >= count)))
        raise IndexError(f"{name}[{k}] is {rows[k]}, and there are {count} {what}")
    flags = np.zeros(count, bool)
    flags[rows] = True
    return flags


def wanted_of(
    min_angle: float,
    max_area: float | None,
    max_edge: float | None,
    min_edge: float,
    edge: float | None,
    growth: float,
    max_vertices: int | None,
    keep: str,
    conforming: bool,
    smooth: int,
    size: Any,
    refine_if: Test | None,
    count: int,
) -> Wanted:
    """What is wanted of a mesh, checked."""
    most = None if max_vertices is None else as_index(max_vertices, "max_vertices")
    if most is not None and not 0 <= most < 2**62:
        raise ValueError(f"max_vertices must be from 0 to 2**62, not {most}")
    rounds = as_index(smooth, "smooth")
    if not 0 <= rounds < 2**31:
        raise ValueError(f"smooth must be from 0 to 2**31, not {rounds}")
    if edge is None and growth != 1.2:
        raise ValueError("growth is that of edges of a wanted length: give edge, too")
    lengths = [] if max_edge is None else [_bound(max_edge, "max_edge")]
    if refine_if is not None and not callable(refine_if):
        raise TypeError(f"refine_if must be a function of corners and area, not {refine_if!r}")
    field = size
    if size is not None and not callable(size):
        if np.ndim(size) == 0:
            if edge is None:
                lengths.append(_bound(size, "size"))
            else:
                edge = min(_bound(edge, "edge"), _bound(size, "size"))
            field = None
        else:
            field = numbers_of(size, "size", count, finite=True)
    return {
        "min_angle": number_of(min_angle, "min_angle"),
        "max_area": None if max_area is None else _bound(max_area, "max_area"),
        "max_edge": min(lengths, default=None),
        "min_edge": number_of(min_edge, "min_edge"),
        "edge": None if edge is None else _bound(edge, "edge"),
        "growth": number_of(growth, "growth"),
        "max_vertices": most,
        "keep": as_choice(keep, _KEPT, "keep"),
        "conforming": as_flag(conforming, "conforming"),
        "smooth": rounds,
        "size": field,
        "refine_if": refine_if,
    }


def number_of(value: Any, what: str) -> float:
    if type(value) is float:
        return value
    array = as_numbers(value, what)
    if array.ndim or array.dtype.kind == "b":
        raise TypeError(f"{what} must be a number, not {value!r}")
    return float(array)


def _bound(value: Any, what: str) -> float:
    number = number_of(value, what)
    if not number > 0:
        raise ValueError(f"{what} is {number}; it must be positive")
    return number


def numbers_of(values: Any, what: str, count: int, finite: bool = False) -> NDArray[np.float64]:
    """A positive number for each of so many."""
    array = as_numbers(values, what)
    if array.shape != (count,):
        raise ValueError(f"{what} must have the shape ({count},), one number each, not {array.shape}")
    return _positive(np.array(array, dtype=np.float64), what, finite)


def _positive(numbers: NDArray[np.float64], what: str, finite: bool) -> NDArray[np.float64]:
    wrong = ~(numbers > 0) | (np.isinf(numbers) if finite else False)
    if wrong.any():
        row = int(np.argmax(wrong))
        place = f"{what}[{row}]" if finite or len(numbers) > 1 else what
        raise ValueError(f"{place} is {numbers[row]}; it must be positive{' and finite' if finite else ''}")
    return numbers


def seeds_of(holes: ArrayLike | None) -> NDArray[np.float64]:
    array = np.empty((0, 2)) if holes is None else as_numbers(holes, "holes")
    return np.array(as_points(array.reshape(0, 2) if array.shape == (0,) else array, "holes", 2))


def regions_of(regions: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Seeds with largest areas, and attributes."""
    if regions is None:
        return np.empty((0, 3)), np.empty(0)
    array = as_numbers(regions, "regions")
    if array.shape == (0,):
        array = array.reshape(0, 2)
    if array.ndim != 2 or not 2 <= array.shape[1] <= 4:
        raise ValueError(f"regions must have the shape (k, 2), (k, 3) or (k, 4), not {array.shape}")
    seeds, count = as_points(array[:, :2], "regions", 2), len(array)
    attributes = array[:, 2].astype(np.float64) if array.shape[1] > 2 else np.arange(count, dtype=np.float64)
    areas = array[:, 3].astype(np.float64) if array.shape[1] > 3 else np.full(count, np.inf)
    return np.column_stack([seeds, np.where(areas > 0, areas, np.inf)]), attributes


def triangles_of(triangles: ArrayLike, count: int) -> NDArray[np.int64]:
    """Corners of triangles between so many points."""
    array = as_numbers(triangles, "triangles")
    if array.ndim != 2 or array.shape[1] != 3 or (array.dtype.kind not in "iu" and array.size):
        raise TypeError(f"triangles must be three integers each, not {array.dtype} of the shape {array.shape}")
    corners = array.astype(np.int64, order="C")
    if corners.size and not 0 <= corners.min() <= corners.max() < count:
        row = int(np.argmax(((corners < 0) | (corners >= count)).any(axis=1)))
        raise IndexError(f"triangle {row} has the corners {corners[row].tolist()}, and there are {count} points")
    return corners


#: Nothing wanted, nothing given.
PLAIN: Wishes = {
    "fill": "even-odd",
    "holes": np.empty((0, 2)),
    "regions": np.empty((0, 3)),
    "keep_concavities": False,
    "min_angle": 0.0,
    "max_area": None,
    "max_edge": None,
    "min_edge": 0.0,
    "edge": None,
    "growth": 1.2,
    "max_vertices": None,
    "keep": "nothing",
    "conforming": False,
    "smooth": 0,
    "size": None,
    "refine_if": None,
    "max_areas": None,
    "of": None,
    "arcs": None,
    "triangles": None,
    "coarsen": None,
    "layers": None,
}
