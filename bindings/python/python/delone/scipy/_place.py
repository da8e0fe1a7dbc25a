"""How classes stand in the place of SciPy's: which calls they take, which they leave to SciPy, and what counts as an instance."""

from __future__ import annotations

from abc import ABCMeta
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any

import numpy as np
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from .._errors import qhull_error
from .._options import parse
from .._points import ShapeError


class InItsPlace(ABCMeta):
    """The type of classes that have `_theirs`, the class of SciPy that they stand for. What SciPy has made is an instance too."""

    def mro(cls) -> list[type]:
        """In classes that `_over_theirs` makes the class of SciPy takes the place of ours."""
        usual = super().mro()
        ours = vars(cls).get("_instead_of")
        if ours is None:
            return usual
        theirs = ours._theirs.__mro__
        return [kind for kind in usual if kind not in ours.__mro__ and kind not in theirs] + list(theirs)

    def __instancecheck__(cls, instance: Any) -> bool:
        """Whether it is one of these or one of SciPy's."""
        return super().__instancecheck__(instance) or ("_theirs" in vars(cls) and isinstance(instance, vars(cls)["_theirs"]))

    def __subclasscheck__(cls, subclass: type) -> bool:
        """Whether it is derived from this or from SciPy's."""
        return super().__subclasscheck__(subclass) or ("_theirs" in vars(cls) and issubclass(subclass, vars(cls)["_theirs"]))


def or_theirs(make: Callable[..., None]) -> Callable[..., None]:
    """Of a constructor: what `_suits` refuses SciPy makes, in the same object.

    The object is of SciPy's class then. Of a class that a user has derived it stays an instance, with SciPy's class as its base.
    """

    @wraps(make)
    def made(self: Any, *args: Any, **options: Any) -> None:
        if "_instead_of" in vars(type(self)):
            # Made once more, maybe of what suits.
            self.__class__ = type(self).__bases__[0]
        if self.__dict__:
            Assignable.forget(self)
        try:
            suits = self._suits(*args, **options)
        except (TypeError, ValueError):
            # Arguments are wrong, as the constructor will say.
            suits = True
        given = {name: value for name, value in options.items() if name != "merge"}
        if suits:
            # A joggle makes corners of points that are equal, and a body of what is flat.
            if not any(isinstance(text, (str, bytes)) and "QJ" in str(text) for text in (*args, *given.values())):
                return make(self, *args, **options)
            before = dict(self.__dict__)
            try:
                return make(self, *args, **options)
            except ValueError:
                self.__dict__ = before
        theirs = self._theirs
        self.__class__ = _over_theirs(type(self))
        theirs.__init__(self, *args, **given)

    return made


def _over_theirs(kind: Any) -> type:
    """SciPy's class instead of one of ours; instead of a derived class one of the same body over SciPy's."""
    ours = next(base for base in kind.__mro__ if "_theirs" in vars(base))
    if kind is ours:
        theirs: type = ours._theirs
        return theirs
    if "_over" not in vars(kind):
        body = {name: getattr(kind, name) for name in ("__module__", "__qualname__", "__doc__")}
        body.update(_instead_of=ours, __reduce_ex__=_reduce)
        kind._over = type(kind)(kind.__name__, (kind,), body)
    over: type = vars(kind)["_over"]
    return over


def _reduce(self: Any, protocol: Any) -> tuple[Any, ...]:
    """Pickles name the class that the user has derived."""
    state = super(type(self), self).__reduce_ex__(protocol)[2]
    return _new_over_theirs, (type(self).__bases__[0],), state


def _new_over_theirs(kind: type) -> Any:
    """An object to which a state is given."""
    over: Any = _over_theirs(kind)
    return over.__new__(over)


class WithoutQhull:
    """What Qhull has not made: nothing is to be closed, and it is shown also where its constructor has failed."""

    # SciPy's destructor looks for it.
    _qhull = None

    def __del__(self) -> None:
        """Nothing of SciPy's is to be closed."""

    def __repr__(self) -> str:
        """A line that says what there is."""
        try:
            return self._shown()
        except AttributeError:
            return object.__repr__(self)

    def _shown(self) -> str:
        return super().__repr__()


def as_doubles(points: ArrayLike) -> NDArray[np.float64]:
    """Points as SciPy takes them: whatever NumPy makes float64 of, rounded where it must be.

    Raises QhullError for what is infinite, as Qhull does.
    """
    doubles: NDArray[np.float64] = points.astype(np.float64) if ma.isMaskedArray(points) else np.asarray(points, dtype=np.float64)
    if np.isinf(doubles).any():
        where = np.argwhere(np.isinf(doubles))[0]
        raise qhull_error(f"point {where[0] if len(where) else 0} is infinitely far away")
    return doubles


class NotAnArrayError(AttributeError, IndexError, TypeError, ValueError):
    """What is wrong with something that is no array, where SciPy takes nothing else and finds that it has no `shape`."""


@contextmanager
def taken_for_array(given: Any) -> Iterator[None]:
    """Errors on the way from something to an array are NotAnArrayErrors unless it is one."""
    try:
        yield
    except (TypeError, ValueError) as error:
        if hasattr(given, "shape"):
            raise
        raise NotAnArrayError(str(error)) from error


def as_more(points: ArrayLike, ndims: tuple[int, ...] = (2,)) -> NDArray[np.float64]:
    """What is to be added as SciPy takes it, also what a mask hides.

    Raises QhullError for what is not finite, as Qhull does then.
    """
    array: NDArray[Any] = np.asarray(points)
    if array.ndim not in ndims:
        raise ShapeError(f"what is added must be a 2D array, a row of numbers for each, not one of {array.ndim} dimensions")
    doubles = array.astype(np.float64)
    if not np.isfinite(doubles).all():
        raise qhull_error(f"what is to be added holds {doubles[~np.isfinite(doubles)][0]}, which is not finite")
    return doubles


def as_rows(xi: ArrayLike, columns: int) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Queries as SciPy takes them, as rows, and the shape that their answers have: that of `xi` without its last axis."""
    array: NDArray[Any] = np.asarray(xi)
    if not array.ndim:
        raise ShapeError(f"xi must have {columns} coordinates in its last axis; it is no array but {xi!r}")
    if array.shape[-1] != columns:
        raise ValueError(f"xi must have {columns} coordinates in its last axis; its shape is {array.shape}")
    return np.ascontiguousarray(array.reshape(-1, columns).astype(np.float64)), array.shape[:-1]


class OptionsError(AttributeError, TypeError):
    """Options that are no string; SciPy finds that they have no `encode`."""


def refuse_options(options: Any, incremental: Any) -> None:
    """An error for what is no string, and for options that SciPy takes not with `incremental`."""
    if options is None:
        return
    if not isinstance(options, (str, bytes)):
        raise OptionsError(f"qhull_options must be a string, not {options!r}")
    wrong = [word for word in ("Qbb", "Qbk", "QBk", "QbB", "Qz") if incremental and word in str(options)]
    if wrong:
        raise ValueError(f"qhull_options: {wrong[0]!r} is not for incremental=True, as in SciPy")


def is_ours(points: ArrayLike, options: Any, is_hull: bool = False) -> bool:
    """Whether points are in the plane or in space, and options are known here; what is no array is refused here."""
    shape = np.shape(points)
    if (len(shape) == 2 and shape[1] > 3) or (is_hull and "Qz" in str(options)):
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


class _Deleted:
    """Stands for the value of an attribute that was deleted."""


class Assignable:
    """An attribute that is made when it is asked for, unless it was assigned; it may be deleted."""

    def __init__(self, make: Callable[[Any], Any]) -> None:
        """Of what makes it, such as `__get__` of an attribute of a base class."""
        self._make = make
        self.__doc__ = getattr(make, "__self__", make).__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        """Where assigned values are kept."""
        self._name = name

    def __get__(self, instance: Any, owner: type | None = None) -> Any:
        """The value."""
        if instance is None:
            return self
        given = instance.__dict__
        if self._name not in given:
            return self._make(instance)
        value = given[self._name]
        if value is _Deleted:
            raise AttributeError(f"{self._name} was deleted")
        return value

    def __set__(self, instance: Any, value: Any) -> None:
        """Keeps a value."""
        instance.__dict__[self._name] = value

    def __delete__(self, instance: Any) -> None:
        """There is none any more."""
        self.__get__(instance)
        instance.__dict__[self._name] = _Deleted

    @staticmethod
    def forget(instance: Any) -> None:
        """Nothing was assigned any more."""
        kind = type(instance)
        for name in [name for name in instance.__dict__ if isinstance(getattr(kind, name, None), Assignable)]:
            del instance.__dict__[name]
