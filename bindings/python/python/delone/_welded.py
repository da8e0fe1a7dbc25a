"""Points and segments that nearly touch, of arrays that were checked."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._arcs import centers_of
from ._points import as_numbers


class Welded(NamedTuple):
    """Points and segments after welding."""

    #: The points that were given, each where the one is that it became: (n, 2).
    points: NDArray[np.float64]
    #: The pieces of the segments, in their order and direction, as indices of points that stay: (k, 2).
    segments: NDArray[np.int64]
    #: For each point the one that it became; of equal points the first one: (n,).
    stays: NDArray[np.int64]
    #: The segment that each piece is of: (k,).
    origins: NDArray[np.int64]
    #: Points that became another one at another place.
    moved: int
    #: The longest way of such a point, rounded.
    largest_move: float
    #: Vertices that became part of a segment, once for each segment.
    bends: int
    #: Segments that became a point.
    collapsed: int


def welded_of(points: NDArray[np.float64], segments: NDArray[np.int64], tolerance: float) -> Welded:
    """See `weld`."""
    distance = as_numbers(tolerance, "weld")
    if distance.ndim:
        raise TypeError(f"a tolerance must be a number, not {tolerance!r}")
    stays, pieces, origins, counts = _delone.weld(points, segments, float(distance))
    return Welded(points[stays], pieces, stays, origins, *counts)


def welded_centers(
    welded: Welded, points: NDArray[np.float64], segments: NDArray[np.int64], centers: ArrayLike
) -> NDArray[np.float64]:
    """The centers of arcs for the pieces of segments. An arc whose chord changed has none: it is straight."""
    array = centers_of(centers, len(segments))
    is_whole = np.bincount(welded.origins, minlength=len(segments)) == 1
    is_still = (points == welded.points).all(axis=1)[segments].all(axis=1)
    array[~(is_whole & is_still)] = np.nan
    return np.asarray(array[welded.origins])


def welded_rings(
    corners: NDArray[np.float64], rings: NDArray[np.int64], tolerance: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Rings by their corners and where each begins, welded to each other and to themselves."""
    lengths = np.diff(rings)
    following = np.arange(1, len(corners) + 1)
    following[rings[1:][lengths > 0] - 1] = rings[:-1][lengths > 0]
    sides = np.column_stack([np.arange(len(corners)), following])
    welded = welded_of(corners, sides, tolerance)
    of_side = np.repeat(np.arange(len(lengths)), lengths)
    counts = np.bincount(of_side[welded.origins], minlength=len(lengths))
    return welded.points[welded.segments[:, 0]], np.concatenate([[0], np.cumsum(counts)])
