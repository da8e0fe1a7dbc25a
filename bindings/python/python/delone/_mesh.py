"""Meshes: triangles of good shape inside of segments, made by Delaunay refinement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._errors import CrossingError, restores
from ._points import as_choice, as_flag, as_numbers
from ._polygons import points_and_segments
from ._sides import rows_of, sides_of
from ._wishes import FILLS, Size, Test, Wanted, Wishes, flags_of, numbers_of, regions_of, seeds_of, triangles_of, wanted_of

T = TypeVar("T")


@dataclass(frozen=True)
class MeshShapes:
    """How nearly equilateral the triangles of a mesh are, and how evenly they grow. Rounded."""

    #: The mean quality: 4 sqrt(3) times the area over the sum of the squares of the sides, which is 1 of an equilateral triangle.
    quality_mean: float
    #: A quality that 5 percent of the triangles do not reach.
    quality_p5: float
    #: A ratio of areas that 5 percent of the pairs of neighbors exceed.
    step_p95: float


@dataclass(frozen=True)
class MeshReport:
    """What a refinement did, and what it could not do. Angles are in degrees."""

    #: New points that are on no constraint.
    inside: int
    #: New points on constraints.
    on_constraints: int
    #: The smallest and the largest angle of a triangle, rounded; 0 if there is none.
    smallest_angle: float
    largest_angle: float
    #: How many angles are from 0 to 10 degrees, from 10 to 20, and so on to 180: (18,).
    angles: NDArray[np.int64]
    #: How many triangles have a smallest angle from 0 to 10 degrees, from 10 to 20, and so on to 60: (6,).
    smallest_angles: NDArray[np.int64]
    #: The rows of triangles that are not as they were to be, increasing.
    left: NDArray[np.int64]
    #: Why, for each of them: "input angle" where constraints meet at a small angle, "precision" where coordinates are too coarse
    #: for a point that would be needed, "cascade" where points would come nearer and nearer to each other, "budget" for
    #: `max_vertices`, "kept" for `keep`.
    reasons: tuple[str, ...]


def mesh(
    points: ArrayLike,
    segments: ArrayLike | None = None,
    *,
    triangles: ArrayLike | None = None,
    attributes: ArrayLike | None = None,
    holes: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    min_angle: float = 20.0,
    max_area: float | None = None,
    max_edge: float | None = None,
    edge: float | None = None,
    growth: float = 1.2,
    size: Size | None = None,
    refine_if: Test | None = None,
    max_vertices: int | None = None,
    keep: str = "nothing",
    conforming: bool = False,
    smooth: int = 0,
    fill: str | None = None,
    crossings: str = "refuse",
    keep_concavities: bool = False,
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
    fill : str, optional
        What is inside. "all": the convex hull, whose edges become segments. "even-odd": what an odd number of segments is
        around. "nonzero": what segments wind around, counter-clockwise less clockwise. "seeds": all but holes and what no
        segments part from the outside. The last one with `holes` or `regions`; else "even-odd" with segments, "all" without.
    crossings : str
        What happens where segments cross: "refuse" is a CrossingError, "split" makes points there.
    keep_concavities : bool
        With "seeds": what no segments part from the outside is inside.

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
        min_angle, max_area, max_edge, edge, growth, max_vertices, keep, conforming, smooth, size, refine_if, len(given)
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
        again: Wishes = {**_PLAIN, **wanted}
        return Mesh._make(first, again, first._recipe[2])
    if attributes is not None:
        raise ValueError("attributes are those of triangles: give these, too")
    plain = "seeds" if seeded else "even-odd" if len(ends) else "all"
    filled = plain if fill is None else as_choice(fill, FILLS, "fill")
    if filled != "seeds" and (seeded or concave):
        raise ValueError(f"holes, regions and keep_concavities are for fill='seeds', not {filled!r}")
    seeds, of_regions = regions_of(regions)
    wishes: Wishes = {**_PLAIN, **wanted}
    wishes["fill"], wishes["holes"], wishes["regions"] = filled, seeds_of(holes), seeds
    wishes["keep_concavities"] = concave
    return Mesh._make((given, ends, split), wishes, of_regions)


#: Nothing wanted, nothing given.
_PLAIN: Wishes = {
    "fill": "even-odd",
    "holes": np.empty((0, 2)),
    "regions": np.empty((0, 3)),
    "keep_concavities": False,
    "min_angle": 0.0,
    "max_area": None,
    "max_edge": None,
    "edge": None,
    "growth": 1.2,
    "max_vertices": None,
    "keep": "nothing",
    "conforming": False,
    "smooth": 0,
    "size": None,
    "refine_if": None,
    "max_areas": None,
    "of": None,
    "triangles": None,
}


def _attributes(values: ArrayLike, count: int) -> NDArray[np.float64]:
    array = as_numbers(values, "attributes")
    if array.shape != (count,):
        raise ValueError(f"attributes must have the shape ({count},), one number each, not {array.shape}")
    return np.array(array, dtype=np.float64)


class Mesh:
    """Triangles, and where they come from; `mesh` makes it. All arrays are read-only."""

    _recipe: tuple[Any, ...]
    _core: _delone.Mesh
    _cache: dict[str, Any]

    def __init__(self) -> None:
        """There is `mesh` for that."""
        raise TypeError("delone.mesh makes meshes")

    @classmethod
    def _make(cls, origin: tuple[Any, ...] | Mesh, wishes: Wishes, attributes: NDArray[np.float64]) -> Mesh:
        made = cls.__new__(cls)
        made._restore((origin, wishes, attributes))
        return made

    @classmethod
    def _of_triangles(
        cls,
        points: NDArray[np.float64],
        segments: NDArray[np.int64],
        split: bool,
        triangles: NDArray[np.int64],
        attributes: NDArray[np.float64] | None,
    ) -> Mesh:
        """The mesh of triangles that are given, as it is."""
        # Zero has no sign here.
        _, firsts, same = np.unique(points + 0.0, axis=0, return_index=True, return_inverse=True)
        first = firsts[same.ravel()]
        corners = np.ascontiguousarray(first[triangles])
        sides = sides_of(corners, first[segments], np.empty((0, 0)) if attributes is None else attributes[:, None])
        origin = (points, sides.segments, split, np.maximum(sides.origins, -1), attributes)
        try:
            return cls._make(origin, {**_PLAIN, "triangles": corners}, np.empty(0))
        except CrossingError as error:
            one, other = sides.origins[[error.first, error.second]].tolist()
            x, y = error.near
            if one >= 0 and other >= 0:
                words = f"segments {one} and {other} cross near ({x:g}, {y:g})"
                raise CrossingError(words, one, other, error.near, error.count) from None
            raise ValueError(f"triangles cross each other or a segment near ({x:g}, {y:g})") from None

    def __getstate__(self) -> tuple[Any, ...]:
        """What was given."""
        return self._recipe

    @restores
    def __setstate__(self, state: tuple[Any, ...]) -> None:
        """Makes it again."""
        self._restore(state)

    def _restore(self, state: tuple[Any, ...]) -> None:
        self._recipe, self._cache = state, {}
        origin, wishes, _ = state
        if isinstance(origin, Mesh):
            self._core = origin._core.again(wishes)
        else:
            points, segments, split = origin[:3]
            self._core = _delone.Mesh(points, segments, split, wishes)

    def __copy__(self) -> Mesh:
        """Itself, for nothing changes it."""
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        """Itself, for nothing changes it."""
        return self

    def _once(self, name: str, make: Callable[[], T]) -> T:
        if name not in self._cache:
            made = make()
            for array in made if isinstance(made, tuple) else (made,):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False
            self._cache[name] = made
        result: T = self._cache[name]
        return result

    @property
    def points(self) -> NDArray[np.float64]:
        """The points that were given, those that no triangle has included, then those where segments crossed, then new ones:
        (n, 2)."""
        return self._once("points", self._core.points)

    @property
    def triangles(self) -> NDArray[np.int64]:
        """The triangles inside, counter-clockwise, as indices of points: (t, 3)."""
        return self._once("arrays", self._core.arrays)[0]

    simplices = triangles

    @property
    def neighbors(self) -> NDArray[np.int64]:
        """The rows of `triangles` across from each corner, (t, 3); -1 where nothing inside is."""
        return self._once("arrays", self._core.arrays)[1]

    @property
    def regions(self) -> NDArray[np.int64]:
        """The region that each triangle is in, by the row of its seed, (t,); -1 for none. Of two seeds in one part the first one
        counts."""
        return self._once("regions", self._core.regions)

    @property
    def attributes(self) -> NDArray[np.float64]:
        """The attribute of the region of each triangle, or of the given triangle that it is in, (t,); NaN for none."""

        def make() -> NDArray[np.float64]:
            known = self._known_attributes()
            if known is None:
                return np.asarray(np.append(self._recipe[2], np.nan)[self.regions])
            return known

        return self._once("attributes", make)

    def _known_attributes(self) -> NDArray[np.float64] | None:
        """By the attributes of triangles that were given, if there were any."""
        origin = self._recipe[0]
        if isinstance(origin, Mesh):
            known = origin._recipe[0][4] if origin._is_given() else origin._known_attributes()
            return None if known is None else np.append(known, np.nan)[self.parents]
        return None

    def _is_given(self) -> bool:
        """Whether these are triangles that were given, as they are."""
        return not isinstance(self._recipe[0], Mesh) and len(self._recipe[0]) > 3

    @property
    def segments(self) -> NDArray[np.int64]:
        """The constraint edges that triangles have, as indices of points, (k, 2), each once, and in the direction of the segment
        that it is on. The whole border is among them."""
        return self._once("segments", self._core.segments)[0]

    @property
    def segment_origin(self) -> NDArray[np.int64]:
        """For each of `segments` the segment that was given and that it is on, the first of several: (k,); -1 for the border
        of the hull where no segment is. Of a polygon side i leaves corner i, counted ring after ring: boundary markers.

        Examples
        --------
        >>> import delone
        >>> from shapely.geometry import Polygon
        >>> made = delone.mesh(Polygon([(0, 0), (4, 0), (4, 1), (0, 1)]), max_edge=0.5)
        >>> bottom = made.segments[made.segment_origin == 0]
        >>> set(made.points[bottom, 1].ravel().tolist())
        {0.0}
        >>> sorted(set(made.segment_origin.tolist()))
        [0, 1, 2, 3]"""

        def make() -> NDArray[np.int64]:
            origins: NDArray[np.int64] = self._once("segments", self._core.segments)[1]
            root = self
            while isinstance(root._recipe[0], Mesh):
                root = root._recipe[0]
            return np.append(root._recipe[0][3], -1)[origins] if root._is_given() else origins

        return self._once("segment_origin", make)

    @property
    def areas(self) -> NDArray[np.float64]:
        """The area of each triangle, rounded: (t,)."""

        def make() -> NDArray[np.float64]:
            a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
            (ux, uy), (vx, vy) = (b - a).T, (c - a).T
            return np.asarray((ux * vy - uy * vx) / 2)

        return self._once("areas", make)

    @property
    def area(self) -> float:
        """The sum of the areas, rounded."""
        return float(self.areas.sum())

    @property
    def report(self) -> MeshReport:
        """What was done, and which triangles are not as they were to be."""

        def make() -> MeshReport:
            smallest, largest, sharpest, angles = self._core.angles
            left = self._core.left
            rows = np.array([row for row, _ in left], dtype=np.int64)
            order = np.argsort(rows)
            reasons = tuple(left[k][1] for k in order.tolist())
            counts = (np.array(angles, dtype=np.int64), np.array(sharpest, dtype=np.int64))
            return MeshReport(*self._core.added, smallest, largest, *counts, rows[order], reasons)

        return self._once("report", make)

    @property
    def shapes(self) -> MeshShapes:
        """How good the triangles are for computing.

        Examples
        --------
        >>> import delone
        >>> made = delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], min_angle=30, edge=0.1)
        >>> made.shapes.quality_mean > 0.97, made.shapes.step_p95 < 1.4
        (True, True)
        """
        return self._once("shapes", lambda: MeshShapes(*self._core.shapes()))

    @property
    def parents(self) -> NDArray[np.int64]:
        """Of a mesh that `refine` made, or `mesh` from `triangles`: for each triangle the row of the old triangle that holds its
        centroid, (t,); -1 for none, and in other meshes. So data of old triangles go to new ones. Old points keep their indices.

        Examples
        --------
        >>> import delone
        >>> coarse = delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], min_angle=0)
        >>> fine = coarse.refine(marked=[0])
        >>> sorted(set(fine.parents.tolist()))
        [0, 1]"""

        def make() -> NDArray[np.int64]:
            origin = self._recipe[0]
            if not isinstance(origin, Mesh):
                return np.full(len(self.triangles), -1)
            rows = origin._core.rows_at(np.ascontiguousarray(self.points[self.triangles].mean(axis=1)))
            if not origin._is_given():
                return rows
            return np.append(rows_of(origin.triangles, origin._recipe[1]["triangles"]), -1)[rows]

        return self._once("parents", make)

    def refine(
        self,
        *,
        marked: ArrayLike | None = None,
        min_angle: float = 20.0,
        max_area: float | None = None,
        max_areas: ArrayLike | None = None,
        max_edge: float | None = None,
        edge: float | None = None,
        growth: float = 1.2,
        size: Size | None = None,
        refine_if: Test | None = None,
        max_vertices: int | None = None,
        keep: str = "nothing",
        conforming: bool = False,
        smooth: int = 0,
    ) -> Mesh:
        """A finer mesh of the same triangles, which has all points of this one under the indices that they have. What is good
        enough stays as it is, and so do `triangles` that were given, until a new point comes near. `parents` tells which old
        triangle each new one is in.

        Parameters
        ----------
        marked : array_like of bools, shape (t,), or of integers, optional
            Triangles to refine, by a flag for each or by their rows, as error estimators say: what is in them has at most half of
            their area.
        max_areas : array_like of floats, shape (t,), optional
            The largest areas for what is in each triangle, by the centroids of new triangles. Infinite is no bound.
        min_angle, max_area, max_edge, edge, growth, size, refine_if, max_vertices, keep, conforming, smooth
            As for `mesh`; a size in an array is one for each of `points`. Largest areas of regions hold again.

        Raises
        ------
        TypeError, ValueError, MemoryError
            As `mesh`.

        Examples
        --------
        >>> import delone, numpy as np
        >>> coarse = delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], max_area=0.1)
        >>> corner = (coarse.points[coarse.triangles].mean(axis=1) < 0.4).all(axis=1)
        >>> fine = coarse.refine(max_areas=np.where(corner, 0.001, np.inf))
        >>> bool(len(fine.triangles) > 50), bool(np.isclose(fine.area, 1))
        (True, True)
        >>> finer = fine.refine(marked=fine.areas > 0.01)  # for adaptive solvers
        >>> finer.parents.shape == finer.areas.shape
        True
        """
        areas = None if max_areas is None else numbers_of(max_areas, "max_areas", len(self.triangles))
        if marked is not None:
            halves = np.where(flags_of(marked, "marked", len(self.triangles)), self.areas / 2, np.inf)
            areas = halves if areas is None else np.minimum(areas, halves)
        old: Wishes = self._recipe[1]
        wanted: Wanted = wanted_of(
            min_angle,
            max_area,
            max_edge,
            edge,
            growth,
            max_vertices,
            keep,
            conforming,
            smooth,
            size,
            refine_if,
            len(self.points),
        )
        wishes: Wishes = {**old, **wanted, "max_areas": areas, "of": None, "triangles": None}
        return Mesh._make(self, wishes, self._recipe[2])

    def check(self) -> None:
        """Proves that this is the one canonical triangulation of its points and constraints; RuntimeError that names what is
        wrong if it is not. O(n log n)."""
        self._core.check()

    def __repr__(self) -> str:
        """A line that says what there is."""
        counts = f"{len(self.points)} points, {len(self.triangles)} triangles, {len(self.segments)} segments"
        return f"<delone.Mesh: {counts}>"
