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
    hull that are flat within the length. Other flat tetrahedra have that of what is beside them."""
    rows, neighbors = tri._centers(), tri._arrays()[1]
    kept: NDArray[np.bool_] = np.logical_and.reduce(np.isfinite(rows), axis=1, dtype=bool)
    if not tri.furthest_site:
        kept[_slivers(tri, rows, length)] = False
        if tri.ndim == 3:
            rows = _beside_flat(tri, rows, kept, length)
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
    """Whether circles or spheres are as flat as the length along the longest edges of their simplices, or tetrahedra themselves:
    of four corners on one circle but for rounding the sphere is any through that."""
    at = corners.T
    with np.errstate(over="ignore", invalid="ignore"):
        squares = [((at[:, i] - at[:, j]) ** 2).sum(axis=0) for i in range(at.shape[1]) for j in range(i)]
        longest = np.sqrt(np.maximum.reduce(squares))
        radius = np.sqrt(((centers.T - at[:, 0]) ** 2).sum(axis=0))
        # The height of an arc over its chord.
        is_flat: NDArray[np.bool_] = (radius > longest) & (longest / radius * longest <= 8 * length)
        if len(at) == 3:
            is_flat |= _are_flat(corners, length)
    is_flat[~np.isfinite(centers).all(axis=1)] = True
    return is_flat


def _are_flat(corners: NDArray[np.float64], length: float) -> NDArray[np.bool_]:
    """Whether tetrahedra are no higher than the length, though all of their edges are longer."""
    u, v, w = (corners[:, k] - corners[:, 0] for k in (1, 2, 3))
    shortest = np.minimum.reduce([(edge**2).sum(axis=1) for edge in (u, v, w, v - u, w - u, w - v)])
    normals = [np.cross(u, v), np.cross(v, w), np.cross(w, u), np.cross(v - u, w - u)]
    largest = np.sqrt(np.maximum.reduce([(normal**2).sum(axis=1) for normal in normals]))
    six_volumes = np.abs((normals[0] * w).sum(axis=1))
    are_flat: NDArray[np.bool_] = (six_volumes <= length * largest) & (shortest > length * length)
    return are_flat


def _beside_flat(tri: Delaunay, rows: NDArray[np.float64], kept: NDArray[np.bool_], length: float) -> NDArray[np.float64]:
    """The centers, where flat tetrahedra that are joined have one of those beside them: four corners on one circle have theirs
    anywhere between those on both sides. Where more than two are beside them, no circle is the reason, and nothing is moved."""
    simplices, neighbors = tri._arrays()
    with np.errstate(over="ignore", invalid="ignore"):
        flat = np.nonzero(kept & _are_flat(tri.points[simplices], length))[0]
    if not len(flat):
        return rows
    none = len(rows)
    order = np.lexsort(rows.T)
    # The first and the last of the centers beside; no neighbor is the last row.
    ends = np.stack([np.full(none + 1, none), np.full(none + 1, -1)])
    ends[:, order] = np.arange(none)
    ends[:, :-1][:, ~kept] = [[none], [-1]]
    ends[:, flat] = [[none], [-1]]
    beside = neighbors[flat]
    while True:
        found = np.stack([ends[0, beside].min(axis=1), ends[1, beside].max(axis=1)])
        found = np.stack([np.minimum(found[0], ends[0, flat]), np.maximum(found[1], ends[1, flat])])
        if (found == ends[:, flat]).all():
            break
        ends[:, flat] = found
    first, last = found
    is_beside = (ends[0, beside] < none) & ~np.isin(beside, flat)
    places = rows[beside]
    gaps = [np.abs(places - rows[order[end.clip(0, none - 1)]][:, None]).max(axis=2) for end in (first, last)]
    is_other = (is_beside & (np.minimum(*gaps) > length)).any(axis=1) | (last < 0)
    pairs = first * (none + 1) + last
    is_one = ~np.isin(pairs, pairs[is_other])
    moved = rows.copy()
    moved[flat[is_one]] = rows[order[first[is_one]]]
    return moved
