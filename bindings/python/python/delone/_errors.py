"""Errors that say more than words."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from pickle import UnpicklingError
from typing import Any


class QhullError(ValueError, RuntimeError):
    """What SciPy raises as `scipy.spatial.QhullError`; where SciPy is loaded, it is one of these too."""


def qhull_error(words: str) -> QhullError:
    """An error that those catch who expect SciPy's."""
    theirs = getattr(sys.modules.get("scipy.spatial"), "QhullError", None)
    kind = QhullError if theirs is None else type("QhullError", (QhullError, theirs), {"__module__": __name__})
    made: QhullError = kind(words)
    return made


def restores(restore: Callable[[Any, Any], None]) -> Callable[[Any, Any], None]:
    """Of a `__setstate__`: a damaged state is an `UnpicklingError`, whatever is wrong with it."""

    @wraps(restore)
    def restored(self: Any, state: Any) -> None:
        try:
            restore(self, state)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
            raise UnpicklingError(f"the state of a {type(self).__name__} is damaged: {error!r}") from error

    return restored


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
