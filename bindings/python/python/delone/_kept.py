"""What is made of a triangulation at the first need, and anew after a change."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol, TypeVar

T = TypeVar("T")


class _Changing(Protocol):
    """What changes."""

    @property
    def version(self) -> int: ...


class Kept:
    """Keeps what is made of a `_core`.

    Each is kept with the version that it was made of: a change shows, also one that its caller did not wait for.
    """

    _core: _Changing
    _cache: dict[str, tuple[int, Any]]

    def _once(self, name: str, make: Callable[[], T]) -> T:
        version = self._core.version
        held = self._cache.get(name)
        if held is None or held[0] != version:
            held = self._cache[name] = (version, make())
        result: T = held[1]
        return result

    def _forget(self) -> None:
        """Drops it all, before a change: nothing of it is of use then."""
        self._cache.clear()
