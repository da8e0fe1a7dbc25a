"""Attributes that are made when they are asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar, overload

T = TypeVar("T")


class cached_property(Generic[T]):
    """As that of functools, which before Python 3.12 takes a lock: microseconds, where small diagrams take twenty of them."""

    def __init__(self, make: Callable[[Any], T]) -> None:
        """Makes it by a method."""
        self._make = make
        self._name = make.__name__
        self.__doc__ = make.__doc__

    @overload
    def __get__(self, instance: None, owner: type) -> cached_property[T]: ...
    @overload
    def __get__(self, instance: object, owner: type | None = None) -> T: ...
    def __get__(self, instance: object | None, owner: type | None = None) -> cached_property[T] | T:
        """Called once: later the instance has what was made under the same name."""
        if instance is None:
            return self
        made = instance.__dict__[self._name] = self._make(instance)
        return made
