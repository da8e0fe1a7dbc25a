"""Boundary layers as they are asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._points import as_index
from ._wishes import flags_of, number_of


@dataclass(frozen=True)
class Layers:
    """Boundary layers of a mesh: rows of thin triangles along walls, as flows need them.

    Around a corner of more than 240 degrees there is a fan. Where chosen segments end at another one, rows end on that one if it
    leaves at 50 to 130 degrees; else, and where there is no room, they end one by one.

    Examples
    --------
    >>> import delone
    >>> sides = [[0, 1], [1, 2], [2, 3], [3, 0]]
    >>> walls = delone.Layers(0.01, 5, growth=1.4, segments=[0, 2])
    >>> made = delone.mesh([[0, 0], [6, 0], [6, 1], [0, 1]], sides, edge=0.2, layers=walls)
    >>> made.report.layers.rows, made.report.layers.shortened
    (5, 0)"""

    #: The height of the first row.
    first_height: float
    #: The number of rows.
    count: int = 5
    #: How many times as high as the row before each row is.
    growth: float = 1.2
    #: The height of all rows together: fewer rows, if that comes nearer to it.
    thickness: float | None = None
    #: The segments, by their rows; all of the border if None.
    segments: ArrayLike | None = None


def layers_of(layers: Any, segments: int) -> tuple[float, int, float, float | None, list[int] | None]:
    """Boundary layers, checked."""
    if not isinstance(layers, Layers):
        raise TypeError(f"layers must be delone.Layers, not {layers!r}")
    count = as_index(layers.count, "layers.count")
    if not 1 <= count <= 1024:
        raise ValueError(f"layers.count must be from 1 to 1024, not {count}")
    growth = number_of(layers.growth, "layers.growth")
    if not 1 <= growth < np.inf:
        raise ValueError(f"layers.growth must be at least 1 and finite, not {growth}")
    height = _height(layers.first_height, "layers.first_height")
    thickness = None if layers.thickness is None else _height(layers.thickness, "layers.thickness")
    chosen = None
    if layers.segments is not None:
        chosen = np.flatnonzero(flags_of(layers.segments, "layers.segments", segments, "segments"))
        if not len(chosen):
            raise ValueError("layers.segments is empty: leave it out for all of the border")
    return height, count, growth, thickness, None if chosen is None else chosen.tolist()


def _height(value: Any, what: str) -> float:
    height = number_of(value, what)
    if not 0 < height < np.inf:
        raise ValueError(f"{what} is {height}; it must be positive and finite")
    return height
