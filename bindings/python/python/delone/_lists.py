"""Rows of several lengths as lists, as SciPy has them."""

from __future__ import annotations

import gc

import numpy as np
from numpy.typing import NDArray

from . import _delone


def lists(starts: NDArray[np.int64], items: NDArray[np.int64]) -> list[list[int]]:
    """A list for each row, from where rows start and what is in them."""
    # The collector of cycles would look through lists that become many again and again, and there is no cycle.
    was_on = gc.isenabled()
    gc.disable()
    try:
        return _delone.lists(starts, items)
    finally:
        if was_on:
            gc.enable()
