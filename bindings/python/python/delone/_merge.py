"""Vertices of diagrams that are one to a reader: sides up to a length are contracted."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _delone
from ._delaunay import Delaunay

Merge = float | str | None


def as_merge(merge: Any) -> Merge:
    """A length, "auto" for that of rounding, or None."""
    if merge is None or (isinstance(merge, str) and merge == "auto"):
        return merge
    if isinstance(merge, (int, float, np.integer, np.floating)) and not isinstance(merge, bool):
        length = float(merge)
        if length >= 0 and np.isfinite(length):
            return length
        raise ValueError(f"merge must be a length that is not negative, not {merge!r}")
    raise TypeError(f'merge must be a length, "auto" or None, not {merge!r}')


def length_of(merge: Merge, *arrays: NDArray[np.float64]) -> float | None:
    """The length up to which sides are contracted, if any are; `auto` is a part of the largest coordinate."""
    if not isinstance(merge, str):
        return merge
    return _delone.MERGE_AUTO * max((float(np.abs(array).max()) for array in arrays if array.size), default=0.0)


def merged_centres(tri: Delaunay, length: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """For each simplex the vertex that its centre becomes, and whether there is one: it is infinitely far away for slivers of the
    hull that are flat within the length."""
    rows = tri._centres()
    gone = np.logical_or.reduce(~np.isfinite(rows), axis=1, dtype=bool)
    kept = ~gone if tri.furthest_site else ~(gone | _slivers(tri, rows, length))
    number = np.cumsum(kept) - 1
    row, corner = np.nonzero(tri.neighbors > np.arange(len(rows))[:, None])
    sides = np.stack([row, tri.neighbors[row, corner]], axis=1)
    sides = sides[kept[sides].all(axis=1)]
    which = _delone.merged_vertices(np.ascontiguousarray(rows[kept]), number[sides].astype(np.int64), length)
    places = rows.copy()
    places[kept] = rows[kept][which]
    return places, kept


def _slivers(tri: Delaunay, rows: NDArray[np.float64], length: float) -> NDArray[np.bool_]:
    """The simplices on the hull whose circle or sphere is as flat as the length along their longest edge, and those on the hull
    without them."""
    corners = tri.points[tri.simplices]
    longest = np.zeros(len(rows))
    for i in range(tri.ndim + 1):
        for j in range(i):
            longest = np.maximum(longest, np.linalg.norm(corners[:, i] - corners[:, j], axis=1))
    with np.errstate(over="ignore", invalid="ignore"):
        radius = np.linalg.norm(rows - corners[:, 0], axis=1)
        # The height of an arc over its chord.
        is_flat = (radius > longest) & (longest / radius * longest <= 8 * length)
    is_flat |= ~np.isfinite(rows).all(axis=1)
    gone = np.zeros(len(rows), dtype=bool)
    while True:
        is_outer = ((tri.neighbors < 0) | gone[tri.neighbors]).any(axis=1)
        new = is_flat & is_outer & ~gone
        if not new.any():
            return gone
        gone |= new
