"""From points, segments and polygons, or from triangles, to a mesh."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arcs import chords_of, renamed
from ._errors import CrossingError
from ._layers import Layers, layers_of
from ._mesh import Mesh
from ._points import as_choice, as_flag, as_numbers
from ._polygons import points_and_segments
from ._welded import welded_centers, welded_of
from ._wishes import FILLS, PLAIN, Size, Test, Wishes, regions_of, seeds_of, triangles_of, wanted_of


def mesh(
    points: ArrayLike,
    segments: ArrayLike | None = None,
    *,
    centers: ArrayLike | None = None,
    triangles: ArrayLike | None = None,
    attributes: ArrayLike | None = None,
    holes: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    min_angle: float = 20.0,
    max_area: float | None = None,
    max_edge: float | None = None,
    min_edge: float = 0.0,
    edge: float | None = None,
    growth: float = 1.2,
    size: Size | None = None,
    refine_if: Test | None = None,
    max_vertices: int | None = None,
    keep: str = "nothing",
    conforming: bool = False,
    smooth: int = 0,
    layers: Layers | None = None,
    fill: str | None = None,
    crossings: str = "refuse",
    keep_concavities: bool = False,
    weld: float | None = None,
) -> Mesh:
    """Meshes what segments bound: a constrained Delaunay triangulation with new points, so that its triangles have no small
    angles and are no larger than wanted.

    The mesh is a function of the points and segments. It always ends, and its `report` names each triangle that is not as it was
    to be, and why. Some 0.3 microseconds a triangle, without Python's lock unless `size` is a function; Ctrl-C ends it.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2), or polygons
        The points. All must be finite. Of equal points the first is the vertex. Or polygons, as shapely, geopandas and GeoJSON
        have them: their corners are the points, their sides the segments, and the mesh is inside.
    segments : array_like of integers, shape (m, 2), optional
        The ends of segments, by indices of points. They may pass through points, overlap and repeat each other.
    centers : array_like of floats, shape (m, 2), optional
        For each segment that is the chord of an arc the center of its circle, for others NaN. The arc is the shorter way around
        the center. It is divided into equal parts of at most 11.25 degrees; new points are on it, and so are nodes of
        `Mesh.second_order`.
    triangles : array_like of integers, shape (t, 3), optional
        A mesh that there is, by indices of points. Its triangles stay, Delaunay or not, until a new vertex comes near, but where
        `edge` is given. The inside is what they cover, and their border is a segment each. `parents` tells in which of them each
        new one is.
    attributes : array_like of floats, shape (t,), optional
        A number for each of `triangles`, such as its material: sides between triangles of other numbers are segments, and new
        triangles have the number of the one that they are in.
    holes : array_like of floats, shape (k, 2), optional
        A point in each hole.
    regions : array_like of floats, shape (k, 2), (k, 3) or (k, 4), optional
        A point in each region, an attribute for its triangles, which is the index of the region if there is none, and the largest
        area of its triangles; NaN and what is not positive is no bound.
    min_angle : float
        No angle is to be smaller, in degrees: from 0, which asks for nothing, to less than 60. Up to 28.6 is proven where
        segments meet at 60 degrees or more, and 34 is reached in practice. More is tried, with at most twice the points of 34
        degrees if `max_vertices` says nothing else; `report.left` tells where it failed.
    max_area : float, optional
        No triangle is to be larger.
    max_edge : float, optional
        No edge is to be longer, segments included.
    min_edge : float
        No edge with a new vertex is to be shorter, up to rounding: triangles that would need some are left, with the reason
        "short". Not for boundary layers.
    edge : float, optional
        The length that edges are to have: triangles become nearly equilateral and grow smoothly. It is what is wanted and no
        bound; most edges have from 0.9 to 1.15 times it. Infinite where `size` says all.
    growth : float
        With `edge`, neighboring edges differ by at most this factor, which is more than 1.
    size : float, function or array_like of shape (n,), optional
        No edge of a triangle is to be longer than this at its centroid: a number, what a function says of x and y, or linear
        between points that have a number each, on their Delaunay triangulation. Infinite is no bound. With `edge` it is a length
        that is wanted, too.
    refine_if : function, optional
        Whether a triangle is to be refined, of its corners, an array (3, 2), and its area. If it always says yes, it ends at the
        larger of 2^21 new vertices and 64 a point, or at `max_vertices`.
    max_vertices : int, optional
        So many new points at most.
    keep : str
        Segments that are not split: "nothing", those at the "border" of the mesh, or all "constraints".
    conforming : bool
        No point is inside of the diametral circle of a segment, so that all triangles are Delaunay.
    smooth : int
        Rounds of smoothing afterwards: new points move a little, and angles become larger. What was asked for still holds.
    layers : Layers, optional
        Rows of thin triangles along the border, or along segments that are chosen. Angles and sizes are asked of the other
        triangles.
    fill : str, optional
        What is inside. "all": the convex hull, whose edges become segments. "even-odd": what an odd number of segments is
        around. "nonzero": what segments wind around, counter-clockwise less clockwise; "positive" where this is more than
        zero, "negative" where it is less. "seeds": all but holes and what no
        segments part from the outside. The last one with `holes` or `regions`; else "even-odd" with segments, "all" without.
    crossings : str
        What happens where segments cross: "refuse" is a CrossingError, "split" makes points there.
    keep_concavities : bool
        With "seeds": what no segments part from the outside is inside.
    weld : float, optional
        A distance: points and segments nearer to each other become one first, as `delone.weld` has it. An arc whose chord changes
        becomes straight.

    Raises
    ------
    TypeError, ValueError, IndexError
        What is wrong with the arguments, and where. ValueError for a size that is NaN, zero or negative. What a function raises
        is passed on as it is.
    MemoryError
        There is no room for as many triangles as `max_area` or `max_edge` ask for.

    Examples
    --------
    A square with a triangular hole.

    >>> import delone
    >>> points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]]
    >>> segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
    >>> made = delone.mesh(points, segments, min_angle=30, max_area=0.1)
    >>> round(made.area, 12), len(made.report.left), made.report.smallest_angle >= 30
    (14.0, 0, True)
    >>> made.triangles.shape[1], made.points[:7].tolist() == points
    (3, True)

    A disk, from four arcs.

    >>> around = [[1, 0], [0, 1], [-1, 0], [0, -1]]
    >>> disk = delone.mesh(around, [[0, 1], [1, 2], [2, 3], [3, 0]], centers=[[0, 0]] * 4, edge=0.2)
    >>> round(disk.area, 1), disk.second_order.triangles.shape[1]
    (3.1, 6)

    A mesh from elsewhere, finer in one material.

    >>> corners = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]
    >>> given = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
    >>> finer = delone.mesh(corners, triangles=given, attributes=[7, 7, 8, 8],
    ...     refine_if=lambda corners, area: area > 0.05 and corners[:, 0].mean() > 1)
    >>> [round(float(finer.areas[finer.attributes == k].sum()), 12) for k in (7, 8)]
    [1.0, 1.0]
    """
    given, ends, _ = points_and_segments(points, segments)
    wanted = wanted_of(
        min_angle, max_area, max_edge, min_edge, edge, growth, max_vertices, keep, conforming, smooth, size, refine_if, len(given)
    )
    split = as_choice(crossings, ("refuse", "split"), "crossings") == "split"
    seeded = holes is not None or regions is not None
    concave = as_flag(keep_concavities, "keep_concavities")
    if triangles is not None:
        if seeded or concave or fill is not None:
            raise ValueError("holes, regions, fill and keep_concavities say nothing of triangles: the inside is what they cover")
        corners = triangles_of(triangles, len(given))
        known = None if attributes is None else _attributes(attributes, len(corners))
        first = Mesh._of_triangles(given, ends, split, corners, known)
        if centers is not None:
            raise ValueError("centers are for points and segments: sides of triangles that are given are straight")
        if weld is not None:
            raise ValueError("weld is for points and segments: triangles that are given stay")
        if layers is not None:
            raise ValueError("layers are for points and segments: triangles that are given stay")
        again: Wishes = {**PLAIN, **wanted}
        return Mesh._make(first, again, first._recipe[2])
    if attributes is not None:
        raise ValueError("attributes are those of triangles: give these, too")
    plain = "seeds" if seeded else "even-odd" if len(ends) else "all"
    filled = plain if fill is None else as_choice(fill, FILLS, "fill")
    if filled != "seeds" and (seeded or concave):
        raise ValueError(f"holes, regions and keep_concavities are for fill='seeds', not {filled!r}")
    seeds, of_regions = regions_of(regions)
    wishes: Wishes = {**PLAIN, **wanted}
    wishes["fill"], wishes["holes"], wishes["regions"] = filled, seeds_of(holes), seeds
    wishes["keep_concavities"] = concave
    wishes["layers"] = None if layers is None else layers_of(layers, len(ends))
    if centers is None and weld is None:
        return _told(Mesh._make((given, ends, split), wishes, of_regions), np.arange(len(ends)))
    origins = np.arange(len(ends))
    if weld is not None:
        welded = welded_of(given, ends, weld)
        if centers is not None:
            centers = welded_centers(welded, given, ends, centers)
        given, ends, origins = welded.points, welded.segments, welded.origins
    if centers is not None:
        chords = chords_of(given, ends, centers)
        wishes["arcs"] = chords.rows, chords.centers
        given, ends, origins = chords.points, chords.segments, origins[chords.origins]
    if wishes["layers"] is not None and wishes["layers"][4] is not None:
        along = np.flatnonzero(np.isin(origins, wishes["layers"][4])).tolist()
        wishes["layers"] = (*wishes["layers"][:4], along)
    try:
        return _told(Mesh._make((given, ends, split, origins), wishes, of_regions), origins)
    except CrossingError as error:
        raise renamed(error, origins, "" if centers is None else ", or the chords of their arcs,") from None


def _told(made: Mesh, origins: NDArray[np.int64]) -> Mesh:
    """Warns of a gap that is too narrow to be meant."""
    if made._core.gap is not None:
        width, (x, y), segments, exponent = made._core.gap
        one, other = origins[segments].tolist()
        warnings.warn(
            f"segments {one} and {other} are {width:g} apart near ({x:g}, {y:g}): triangles there are as small, or not as "
            f"wanted; weld=1e{exponent} joins them",
            stacklevel=3,
        )
    return made


def _attributes(values: ArrayLike, count: int) -> NDArray[np.float64]:
    array = as_numbers(values, "attributes")
    if array.shape != (count,):
        raise ValueError(f"attributes must have the shape ({count},), one number each, not {array.shape}")
    return np.array(array, dtype=np.float64)
