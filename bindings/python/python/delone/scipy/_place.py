"""How classes stand in the place of SciPy's: which calls they take, which they leave to SciPy, and what counts as an instance."""

from __future__ import annotations

from abc import ABCMeta
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from .._errors import qhull_error
from .._options import parse


class InItsPlace(ABCMeta):
    """The type of classes that have `_theirs`, the class of SciPy that they stand for.

    What `_suits` refuses SciPy makes itself; what SciPy has made is an instance too. Classes that users derive are plain ones.
    """

    def __call__(cls, *args: Any, **options: Any) -> Any:
        """Makes one of these, or one of SciPy's."""
        own = vars(cls)
        if "_theirs" in own:
            try:
                suits = cls._suits(*args, **options)  # type: ignore[attr-defined]
            except TypeError:
                # Arguments are wrong, as the constructor will say.
                suits = True
            given = {name: value for name, value in options.items() if name != "merge"}
            if not suits:
                return own["_theirs"](*args, **given)
            texts = [text for text in (*args, *given.values()) if isinstance(text, (str, bytes))]
            if any("QJ" in str(text) for text in texts):
                # A joggle makes corners of points that are equal, and a body of what is flat.
                try:
                    return super().__call__(*args, **options)
                except ValueError:
                    return own["_theirs"](*args, **given)
        return super().__call__(*args, **options)

    def __instancecheck__(cls, instance: Any) -> bool:
        """Whether it is one of these or one of SciPy's."""
        return super().__instancecheck__(instance) or ("_theirs" in vars(cls) and isinstance(instance, vars(cls)["_theirs"]))

    def __subclasscheck__(cls, subclass: type) -> bool:
        """Whether it is derived from this or from SciPy's."""
        return super().__subclasscheck__(subclass) or ("_theirs" in vars(cls) and issubclass(subclass, vars(cls)["_theirs"]))


def as_doubles(points: ArrayLike) -> NDArray[np.float64]:
    """Points as SciPy takes them: whatever NumPy makes float64 of, rounded where it must be.

    Raises QhullError for what is infinite, as Qhull does.
    """
    doubles: NDArray[np.float64] = points.astype(np.float64) if ma.isMaskedArray(points) else np.asarray(points, dtype=np.float64)
    if np.isinf(doubles).any():
        where = np.argwhere(np.isinf(doubles))[0]
        raise qhull_error(f"point {where[0] if len(where) else 0} is infinitely far away")
    return doubles


def is_ours(points: ArrayLike, options: Any, is_hull: bool = False) -> bool:
    """Whether points are in the plane or in space, and options are known here; what is no array is refused here."""
    shape = np.shape(points)
    if len(shape) == 2 and shape[1] > 3:
        return False
    try:
        parse(options, "", is_hull)
    except ValueError:
        return False
    return True


def refuse_flat(is_flat: bool, count: int, ndim: int) -> None:
    """An error as Qhull has it for points that span less."""
    if not count:
        raise ValueError("there are no points")
    if is_flat:
        what = "the plane" if ndim == 2 else "space"
        raise qhull_error(
            f"{count} points that do not span {what}: delone.{{Delaunay, ConvexHull}} take them, and tell their span"
        )


class Assignable:
    """An attribute that is made when it is asked for, unless it was assigned."""

    def __init__(self, make: Callable[[Any], Any]) -> None:
        """Of what makes it."""
        self._make = make
        self.__doc__ = make.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        """Where assigned values are kept."""
        self._name = f"_given_{name}"

    def __get__(self, instance: Any, owner: type | None = None) -> Any:
        """The value."""
        if instance is None:
            return self
        given = instance.__dict__
        return given[self._name] if self._name in given else self._make(instance)

    def __set__(self, instance: Any, value: Any) -> None:
        """Keeps a value."""
        instance.__dict__[self._name] = value

    @staticmethod
    def forget(instance: Any) -> None:
        """Nothing was assigned any more."""
        for name in [name for name in instance.__dict__ if name.startswith("_given_")]:
            del instance.__dict__[name]
