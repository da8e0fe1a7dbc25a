"""Rows of several lengths as lists, as SciPy has them."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray


def rows_of(starts: NDArray[np.int64], items: NDArray[np.int64]) -> list[list[int]]:
    """A list for each row, from where rows start and what is in them."""
    with _no_collection():
        flat: list[int] = items.tolist()
        return [flat[a:b] for a, b in pairwise(starts.tolist())]


def pairs_of(items: NDArray[np.int64]) -> list[list[int]]:
    """The same of rows of two."""
    with _no_collection():
        pairs: list[Any] = items.reshape(-1, 2).tolist()
        return pairs


@contextmanager
def _no_collection() -> Iterator[None]:
    """Pauses the collector of cycles, which would look through lists that become many again and again."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
