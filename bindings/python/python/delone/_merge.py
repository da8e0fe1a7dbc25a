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


def merged_centers(tri: Delaunay, length: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """For each simplex the vertex that its center becomes, and whether there is one: it is infinitely far away for slivers of the
    hull that are flat within the length."""
    rows, neighbors = tri._centers(), tri._arrays()[1]
    kept: NDArray[np.bool_] = np.logical_and.reduce(np.isfinite(rows), axis=1, dtype=bool)
    if not tri.furthest_site:
        kept[_slivers(tri, rows, length)] = False
    row, corner = np.nonzero(neighbors > np.arange(len(rows))[:, None])
    sides = np.empty((len(row), 2), dtype=np.int64)
    sides[:, 0], sides[:, 1] = row, neighbors[row, corner]
    if kept.all():
        return rows[_delone.merged_vertices(rows, sides, length)], kept
    number = np.cumsum(kept) - 1
    sides = number[sides[kept[sides].all(axis=1)]]
    places = rows.copy()
    places[kept] = rows[kept][_delone.merged_vertices(rows[kept], sides, length)]
    return places, kept


def _slivers(tri: Delaunay, rows: NDArray[np.float64], length: float) -> NDArray[np.intp]:
    """The simplices on the hull whose circle or sphere is as flat as the length along their longest edge, and those on the hull
    without them."""
    simplices, neighbors = tri._arrays()
    found: list[NDArray[np.intp]] = []
    seen = np.zeros(len(rows), dtype=bool)
    outer = np.nonzero(neighbors < 0)[0]
    while True:
        seen[outer] = True
        found.append(outer[_is_flat(tri.points[simplices[outer]], rows[outer], length)])
        if not len(found[-1]):
            return np.concatenate(found)
        around = neighbors[found[-1]]
        outer = np.unique(around[(around >= 0) & ~seen[around]]).astype(np.intp)


def _is_flat(corners: NDArray[np.float64], centers: NDArray[np.float64], length: float) -> NDArray[np.bool_]:
    """Whether circles or spheres are as flat as the length along the longest edges of their simplices."""
    at = corners.T
    with np.errstate(over="ignore", invalid="ignore"):
        squares = [((at[:, i] - at[:, j]) ** 2).sum(axis=0) for i in range(at.shape[1]) for j in range(i)]
        longest = np.sqrt(np.maximum.reduce(squares))
        radius = np.sqrt(((centers.T - at[:, 0]) ** 2).sum(axis=0))
        # The height of an arc over its chord.
        is_flat: NDArray[np.bool_] = (radius > longest) & (longest / radius * longest <= 8 * length)
    is_flat[~np.isfinite(centers).all(axis=1)] = True
    return is_flat
