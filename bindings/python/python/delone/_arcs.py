"""Segments that are chords of arcs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._errors import CrossingError
from ._points import as_numbers


class Chords(NamedTuple):
    """Points and segments, of which arcs are divided into chords."""

    #: The points that were given, then those on arcs.
    points: NDArray[np.float64]
    segments: NDArray[np.int64]
    #: The segment that was given, for each.
    origins: NDArray[np.int64]
    #: The rows of segments that are chords of arcs, and the centers of these.
    rows: NDArray[np.int64]
    centers: NDArray[np.float64]


class SecondOrder(NamedTuple):
    """Triangles with six nodes."""

    #: The points of the mesh, then the middles of its edges: (n, 2).
    points: NDArray[np.float64]
    #: Corners, then the nodes between the first two, the last two, and the last and the first: (t, 6).
    triangles: NDArray[np.int64]


def chords_of(points: NDArray[np.float64], segments: NDArray[np.int64], centers: ArrayLike) -> Chords:
    """Divides arcs, whose centers are not NaN."""
    return Chords(*_delone.divide_arcs(points, segments, centers_of(centers, len(segments))))


def centers_of(centers: ArrayLike, count: int) -> NDArray[np.float64]:
    """A center or NaN for each segment, checked."""
    array = np.array(as_numbers(centers, "centers"), dtype=np.float64)
    if array.shape != (count, 2):
        raise ValueError(f"centers must have the shape ({count}, 2), one for each segment, not {array.shape}")
    return array


def renamed(error: CrossingError, origins: NDArray[np.int64], which: str = "") -> CrossingError:
    """By the segments that were given."""
    one, other = origins[[error.first, error.second]].tolist()
    x, y = error.near
    words = f"segments {one} and {other}{which} cross near ({x:g}, {y:g})"
    return CrossingError(words, one, other, error.near, error.count)


def second_order_of(
    points: NDArray[np.float64], triangles: NDArray[np.int64], arcs: tuple[NDArray[np.int64], NDArray[np.float64]]
) -> SecondOrder:
    """With nodes in the middles of edges, on arcs where these have some."""
    key = np.array([len(points), 1])
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    _, firsts, edges = np.unique(sides @ key, return_index=True, return_inverse=True)
    ends = sides[firsts]
    middles = points[ends[:, 0]] / 2 + points[ends[:, 1]] / 2
    on_arcs, places = arcs
    middles[np.searchsorted(ends @ key, on_arcs @ key)] = places
    nodes = len(points) + edges.reshape(-1, 3)
    return SecondOrder(np.concatenate([points, middles]), np.concatenate([triangles, nodes], axis=1))
