"""Points and segments that nearly touch become one."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ._polygons import points_and_segments
from ._welded import Welded, welded_of


def weld(points: ArrayLike, segments: ArrayLike | None = None, *, tolerance: float) -> Welded:
    """Welds points nearer to each other than a tolerance, and vertices nearer than it to a segment.

    The result does not depend on the order of points and segments, and welding it again changes nothing. No point moves
    farther than the tolerance. `mesh`, `ConstrainedDelaunay` and `triangulate_polygons` do this first for `weld=tolerance`.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2), or polygons
        The points. Or polygons, as shapely, geopandas and GeoJSON have them: their corners are the points, their sides the
        segments.
    segments : array_like of integers, shape (m, 2), optional
        The ends of segments, by indices of points.
    tolerance : float
        A distance in units of coordinates, from 0.

    Examples
    --------
    Two squares with a gap between them.

    >>> import delone
    >>> points = [[0, 0], [1, 0], [1, 1], [0, 1], [1.0000001, 0], [2, 0], [2, 1], [1.0000001, 1]]
    >>> sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    >>> welded = delone.weld(points, sides, tolerance=1e-6)
    >>> welded.stays.tolist(), welded.moved
    ([0, 1, 2, 3, 1, 5, 6, 2], 2)
    """
    given, ends, _ = points_and_segments(points, segments)
    return welded_of(given, ends, tolerance)
