"""Hulls of points that span less than the plane or space: a polygon in its plane, two ends on their line, a point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import _delone


def facets_in_span(points: NDArray[np.float64], length: float | None = None) -> NDArray[np.int32]:
    """The facets of points without a body.

    Edges of a polygon (m, 2) in turn, two ends (2, 1), or of a single point none (0, 0).

    Exact, or with a length as hulls are merged: along an axis that is not in the plane a polygon is projected to one with the
    same corners.
    """
    best: NDArray[np.int32] = np.empty((0, 2), dtype=np.int32)
    if points.shape[1] == 3:
        largest = -1.0
        for axes in ([0, 1], [0, 2], [1, 2]):
            flat = np.ascontiguousarray(points[:, axes])
            edges = _delone.convex_hull(flat, length, True)[0]
            size = float(np.prod(np.ptp(flat, axis=0))) if len(edges) else -1.0
            if size > largest or (len(edges) and not len(best)):
                best, largest = edges, size
    if len(best) or not len(points):
        return best
    order = np.lexsort(points.T[::-1])
    ends = order[[0, -1]].astype(np.int32)
    return ends[:, None] if (points[ends[0]] != points[ends[1]]).any() else np.empty((0, 0), dtype=np.int32)


def normals_in_span(points: NDArray[np.float64], facets: NDArray[np.int32]) -> NDArray[np.float64]:
    """For each facet a vector in the span that points outside."""
    corners = points[facets]
    if facets.shape[1] == 1:
        along = corners[1, 0] - corners[0, 0]
        return np.stack([-along, along])
    along = corners[:, 1] - corners[:, 0]
    seen = corners[:, 0] - corners[0, 0]
    upright = np.cross(seen, np.roll(seen, -1, axis=0)).sum(axis=0)
    return np.cross(along, upright / np.abs(upright).max())


def sizes_in_span(points: NDArray[np.float64], facets: NDArray[np.int32]) -> tuple[float, float]:
    """The size of the border and what is inside: perimeter and area, or two ends and the length."""
    corners = points[facets]
    if facets.shape[1] == 1:
        return 2.0, float(np.linalg.norm(corners[1, 0] - corners[0, 0]))
    perimeter = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1).sum()
    seen = corners[:, 0] - corners[0, 0]
    area = np.linalg.norm(np.cross(seen, np.roll(seen, -1, axis=0)).sum(axis=0)) / 2
    return float(perimeter), float(area)
