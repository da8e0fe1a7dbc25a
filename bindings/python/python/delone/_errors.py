"""Errors that say more than words."""

from __future__ import annotations

from typing import Any


class CrossingError(ValueError):
    """Segments, or sides of polygons, cross where that is refused.

    Attributes
    ----------
    first, second : int
        Two segments that cross, by id; of polygons two sides, each by the corner that it leaves, counted over all rings.
    near : tuple of two floats
        Where they cross, rounded.
    count : int
        The number of pairs that cross; of a segment that is inserted, the number of segments that it crosses.
    """

    def __init__(self, words: str, first: int, second: int, near: tuple[float, float], count: int) -> None:
        """Says what crosses, and where."""
        super().__init__(words)
        self.first, self.second, self.near, self.count = first, second, near, count

    def __reduce__(self) -> tuple[Any, ...]:
        """All of it goes along to other processes."""
        return type(self), (str(self), self.first, self.second, self.near, self.count)
