"""Sides of triangles that are given: the border, and what is between triangles of other attributes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

#: The origin of a segment that nobody gave: on the border, and between triangles of other attributes.
BORDER = -1
BETWEEN = -2

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


class Sides(NamedTuple):
    """Segments by which an odd number of borders is around the inside: of those that are inside there are two each."""

    segments: Ints
    #: The segment that was given, or `BORDER` or `BETWEEN`.
    origins: Ints


def sides_of(triangles: Ints, segments: Ints, attributes: Floats) -> Sides:
    """The border of triangles, the segments that were given, and edges between triangles of other attributes, so no new triangle
    has a part of both."""
    keys, sides, counts = np.unique(keys_of(all_edges(triangles)), return_inverse=True, return_counts=True)
    border = pairs_of(keys[counts % 2 == 1])
    own = np.sort(segments, axis=1)
    is_border = among(own, border)
    twice = np.flatnonzero(~is_border)
    missing = border[~among(border, own)]
    on_border = np.flatnonzero(is_border)
    _, firsts = np.unique(keys_of(own[on_border]), return_index=True)
    on_border = on_border[np.sort(firsts)] if len(on_border) else on_border
    between = pairs_of(keys[_between(sides, counts, attributes)])
    between = between[~among(between, own)]
    ends = np.concatenate([own[on_border], own[twice], own[twice], missing, between, between])
    unknown = np.repeat([BORDER, BETWEEN], [len(missing), 2 * len(between)])
    origins = np.concatenate([on_border, twice, twice, unknown]).astype(np.int64)
    return Sides(np.ascontiguousarray(ends), origins)


def _between(sides: Ints, counts: Ints, attributes: Floats) -> NDArray[np.bool_]:
    """Which edges are between two triangles of other attributes; `sides` are the edges of each triangle, three a row."""
    if not attributes.size:
        return np.zeros(len(counts), bool)
    _, names = np.unique(attributes, axis=0, return_inverse=True)
    of_sides = np.repeat(names.ravel(), 3)
    least, largest = np.full(len(counts), len(names)), np.full(len(counts), -1)
    np.minimum.at(least, sides.ravel(), of_sides)
    np.maximum.at(largest, sides.ravel(), of_sides)
    return np.asarray((counts == 2) & (least < largest))


def set_apart(points: Floats, used: Ints) -> Floats:
    """With points that nothing has outside of all others: where they are, such as the center of a circle or the middle of a side,
    they would split triangles. Points at the place of one that is used stay."""
    apart = np.ones(len(points), bool)
    apart[used] = False
    if not len(used) or not apart.any():
        return points
    # Zero has no sign here.
    _, places = np.unique(points + 0.0, axis=0, return_inverse=True)
    apart &= ~np.isin(places.ravel(), places.ravel()[used])
    with np.errstate(over="ignore"):
        outside = points[used].max(axis=0) + np.ptp(points[used], axis=0).max()
    if not np.isfinite(outside).all():
        return points
    moved = points.copy()
    moved[apart] = outside
    return moved


def rows_of(triangles: Ints, known: Ints) -> Ints:
    """For each triangle the row of the first one with the same corners among `known`, or -1."""
    count = len(known)
    both = np.concatenate([np.sort(known, axis=1), np.sort(triangles, axis=1)])
    names, same = np.unique(both, axis=0, return_inverse=True)
    same = same.ravel()
    row = np.full(len(names), -1)
    row[same[:count][::-1]] = np.arange(count)[::-1]
    return np.asarray(row[same[count:]])


def all_edges(triangles: Ints) -> Ints:
    """The edges of triangles, the lesser end first; those of two twice."""
    return np.sort(triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2), axis=1)


def keys_of(pairs: Ints) -> Ints:
    """A number for each pair of indices, in their order; NumPy is many times as fast with numbers as with rows."""
    return np.asarray((pairs[:, 0] << 32) | pairs[:, 1])


def pairs_of(keys: Ints) -> Ints:
    """The pairs that have these numbers."""
    return np.column_stack([keys >> 32, keys & 0xFFFFFFFF])


def among(rows: Ints, others: Ints) -> NDArray[np.bool_]:
    """Which pairs are among others."""
    return np.asarray(np.isin(keys_of(rows), keys_of(others)))
