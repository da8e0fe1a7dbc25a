"""Meshes: triangles of good shape inside of segments, made by Delaunay refinement."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._arcs import SecondOrder, second_order_of
from ._errors import CrossingError, restores
from ._sides import rows_of, set_apart, sides_of
from ._wishes import PLAIN, Size, Test, Wanted, Wishes, flags_of, numbers_of, wanted_of

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
class LayerReport:
    """The boundary layers of a mesh."""

    #: Their triangles.
    triangles: int
    #: Their points that are not on the chosen segments.
    points: int
    #: The largest number of rows anywhere.
    rows: int
    #: Points on the chosen segments, one for each side with layers.
    places: int
    #: How many of these have fewer rows than were asked for, because there is no room for more.
    shortened: int


class MeshQuads(NamedTuple):
    """Quadrilaterals and triangles that cover a mesh."""

    #: The corners of each quadrilateral as indices of points, counter-clockwise: (q, 4).
    corners: NDArray[np.int64]
    #: The rows of the two triangles of each: (q, 2).
    pairs: NDArray[np.int64]
    #: The rows of the triangles that stay: (r,).
    triangles: NDArray[np.int64]


class MeshAllQuads(NamedTuple):
    """A mesh of quadrilaterals alone."""

    #: Points: those of the mesh, which smoothing may have moved, then middles of edges, then centers: (m, 2).
    points: NDArray[np.float64]
    #: The corners of each quadrilateral as indices of these, counter-clockwise, the first one a point of the mesh: (q, 4).
    corners: NDArray[np.int64]
    #: The row of a triangle of the mesh that each is a part of, for its region: (q,).
    triangles: NDArray[np.int64]
    #: The halves of the segments of the mesh, in their directions: (2 s, 2).
    segments: NDArray[np.int64]
    #: The segment given that each is on, or -1: boundary markers, (2 s,).
    segment_origin: NDArray[np.int64]
    #: Rows of those that are not convex because coordinates are rounded: none but between the closest of numbers.
    left: NDArray[np.int64]


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
    #: `max_vertices`, "kept" for `keep`, and beside boundary layers, "short" for `min_edge`.
    reasons: tuple[str, ...]
    #: Counts of boundary layers. Angles above are those of the other triangles.
    layers: LayerReport


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
        again = np.flatnonzero(rows_of(corners, corners) != np.arange(len(corners)))
        if len(again):
            raise ValueError(f"triangle {again[0]} has the corners of an earlier one")
        sides = sides_of(corners, first[segments], np.empty((0, 0)) if attributes is None else attributes[:, None])
        apart = set_apart(points, np.concatenate([corners.ravel(), segments.ravel()]))
        origin = (apart, sides.segments, split, np.maximum(sides.origins, -1), attributes, points)
        try:
            made = cls._make(origin, {**PLAIN, "triangles": corners}, np.empty(0))
            missing = np.flatnonzero(rows_of(corners, made.triangles) < 0)
            centers = np.ascontiguousarray(points[corners[missing]].mean(axis=1))
            hidden = missing[made._core.rows_at(centers) < 0] if len(missing) else missing
            if len(hidden):
                raise ValueError(f"triangle {hidden[0]} overlaps another one")
            return made
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
            marked = wishes["coarsen"]
            core = origin._core
            self._core = core.again(wishes) if marked is None else core.coarser(marked, wishes["min_angle"])
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

        def make() -> NDArray[np.float64]:
            points, root = self._core.points(), self
            while isinstance(root._recipe[0], Mesh):
                root = root._recipe[0]
            if root._is_given():
                given = root._recipe[0][5]
                points[: len(given)] = given
            return points

        return self._once("points", make)

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
        return not isinstance(self._recipe[0], Mesh) and len(self._recipe[0]) > 4

    @property
    def is_layer(self) -> NDArray[np.bool_]:
        """Whether each triangle is of a boundary layer: (t,)."""
        return self._once("is_layer", self._core.layers)

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
            return np.append(root._recipe[0][3], -1)[origins] if len(root._recipe[0]) > 3 else origins

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
            layers = LayerReport(*self._core.layer_counts)
            return MeshReport(*self._core.added, smallest, largest, *counts, rows[order], reasons, layers)

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
    def quads(self) -> MeshQuads:
        """Triangles in pairs that make convex quadrilaterals with angles from 30 to 150 degrees, and the triangles that stay. No
        quadrilateral crosses a segment. For solvers that want quadrilaterals.

        Examples
        --------
        >>> import delone
        >>> made = delone.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], edge=0.1)
        >>> quads = made.quads
        >>> quads.corners.shape[1], 2 * len(quads.corners) + len(quads.triangles) == len(made.triangles)
        (4, True)
        """
        return self._once("quads", lambda: MeshQuads(*self._core.quads()))

    def all_quads(self, smooth: int = 5) -> MeshAllQuads:
        """Quadrilaterals alone: each of `quads` becomes four and each triangle three, about its center; so edges are about half
        as long. New points inside move to where quadrilaterals are better, in rounds; those of the input, on segments and in
        boundary layers stay. All are convex, which is decided exactly, but those in `left`.

        Parameters
        ----------
        smooth
            Rounds of smoothing.

        Examples
        --------
        >>> import delone
        >>> made = delone.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], edge=0.1)
        >>> quads = made.all_quads()
        >>> len(quads.corners) == 4 * len(made.quads.corners) + 3 * len(made.quads.triangles), len(quads.left)
        (True, 0)
        """
        points, corners, triangles, middles, first, left = self._core.all_quads(operator.index(smooth))
        # Middles are sorted by the ends of their edges, so they are found by one number for both.
        ends = np.sort(self.segments, axis=1)
        keys = middles[:, 0] * first + middles[:, 1]
        at = first + np.searchsorted(keys, ends[:, 0] * first + ends[:, 1])
        halves = np.stack([self.segments[:, 0], at, at, self.segments[:, 1]], axis=1).reshape(-1, 2)
        return MeshAllQuads(points, corners, triangles, halves, np.repeat(self.segment_origin, 2), left)

    @property
    def second_order(self) -> SecondOrder:
        """The triangles with six nodes, for finite elements of second order. Nodes of sides that are chords of arcs are on these,
        where it is proven that the element is inverted nowhere; others are in the middles.

        Examples
        --------
        >>> import delone
        >>> square = delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], min_angle=0)
        >>> nodes = square.second_order
        >>> nodes.points.shape, nodes.triangles.shape
        ((9, 2), (2, 6))
        """
        return self._once("second_order", lambda: second_order_of(self.points, self.triangles, self._core.arc_middles()))

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
        min_edge: float = 0.0,
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
            their area. Those of boundary layers stay as they are.
        max_areas : array_like of floats, shape (t,), optional
            The largest areas for what is in each triangle, by the centroids of new triangles. Infinite is no bound.
        min_angle, max_area, max_edge, min_edge, edge, growth, size, refine_if, max_vertices, keep, conforming, smooth
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
            min_edge,
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
        wishes: Wishes = {**old, **wanted, "max_areas": areas, "of": None, "triangles": None, "coarsen": None, "layers": None}
        return Mesh._make(self, wishes, self._recipe[2])

    def coarsen(self, *, marked: ArrayLike, min_angle: float = 20.0) -> Mesh:
        """A coarser mesh: new points go where all triangles around are marked. The points keep their indices; those that went are
        in no triangle. `parents` tells which old triangle holds the centroid of each new one.

        A call takes away no two neighbors; several calls go further. Points that were given stay, and so do those on segments
        that are not exactly straight there.

        Parameters
        ----------
        marked : array_like of bools, shape (t,), or of integers
            Triangles that may be larger, by a flag for each or by their rows.
        min_angle : float
            No angle falls below so many degrees, or below the smallest around.

        Raises
        ------
        TypeError, ValueError, IndexError
            For flags, rows or angles that are none.

        Examples
        --------
        >>> import delone
        >>> fine = delone.mesh([[0, 0], [1, 0], [1, 1], [0, 1]], max_area=0.002)
        >>> coarse = fine.coarsen(marked=fine.points[fine.triangles].mean(axis=1)[:, 0] > 0.5)
        >>> len(coarse.triangles) < len(fine.triangles), round(coarse.area, 12)
        (True, 1.0)
        """
        flags = flags_of(marked, "marked", len(self.triangles))
        old: Wishes = self._recipe[1]
        wishes: Wishes = {**old, "min_angle": float(min_angle), "max_areas": None, "of": None, "triangles": None}
        wishes["coarsen"], wishes["layers"] = np.array(flags), None
        return Mesh._make(self, wishes, self._recipe[2])

    def check(self) -> None:
        """Proves that this is the one canonical triangulation of its points and constraints; RuntimeError that names what is
        wrong if it is not. O(n log n)."""
        self._core.check()

    def __repr__(self) -> str:
        """A line that says what there is."""
        counts = f"{len(self.points)} points, {len(self.triangles)} triangles, {len(self.segments)} segments"
        return f"<delone.Mesh: {counts}>"
