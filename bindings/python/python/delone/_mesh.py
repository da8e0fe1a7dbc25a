"""Meshes: triangles of good shape inside of segments, made by Delaunay refinement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypedDict, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._errors import restores
from ._points import as_choice, as_flag, as_index, as_numbers, as_points
from ._polygons import points_and_segments

T = TypeVar("T")

#: What an element may be large: a number, a number for each point, or a function of a place.
Size = float | ArrayLike | Callable[[float, float], float]


class Wanted(TypedDict):
    """What is wanted of a mesh."""

    min_angle: float
    max_area: float | None
    max_edge: float | None
    edge: float | None
    growth: float
    max_vertices: int | None
    keep: str
    conforming: bool
    smooth: int
    size: Callable[[float, float], float] | NDArray[np.float64] | None


class Wishes(Wanted):
    """The same, and what is inside; `_delone.Mesh` takes it."""

    fill: str
    holes: NDArray[np.float64]
    #: Places and largest areas, which may be infinite.
    regions: NDArray[np.float64]
    keep_concavities: bool
    #: An area for each triangle: of the mesh that is refined again, or of this triangulation.
    max_areas: NDArray[np.float64] | None
    #: The first height, the number of rows, growth, thickness, and segments.
    layers: tuple[float, int, float, float | None, list[int] | None] | None
    of: _delone.Constrained | None


_FILLS = ("all", "even-odd", "nonzero", "seeds")
_KEPT = ("nothing", "border", "constraints")


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
class Layers:
    """Boundary layers of a mesh: rows of thin triangles along walls, as flows need them.

    Around a corner of more than 240 degrees there is a fan. Where chosen segments end at another one, rows end on that one if it
    leaves at 50 to 130 degrees; else, and where there is no room, they end one by one.

    Examples
    --------
    >>> import delone
    >>> sides = [[0, 1], [1, 2], [2, 3], [3, 0]]
    >>> walls = delone.Layers(0.01, 5, growth=1.4, segments=[0, 2])
    >>> made = delone.mesh([[0, 0], [6, 0], [6, 1], [0, 1]], sides, edge=0.2, layers=walls)
    >>> made.report.layers.rows, made.report.layers.shortened
    (5, 0)"""

    #: The height of the first row.
    first_height: float
    #: The number of rows.
    count: int = 5
    #: How many times as high as the row before each row is.
    growth: float = 1.2
    #: The height of all rows together: fewer rows, if that comes nearer to it.
    thickness: float | None = None
    #: The segments, by their rows; all of the border, if there are none.
    segments: ArrayLike | None = None


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
    #: Counts of boundary layers. Angles above are those of the other triangles.
    layers: LayerReport


def mesh(
    points: ArrayLike,
    segments: ArrayLike | None = None,
    *,
    holes: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    min_angle: float = 20.0,
    max_area: float | None = None,
    max_edge: float | None = None,
    edge: float | None = None,
    growth: float = 1.2,
    size: Size | None = None,
    max_vertices: int | None = None,
    keep: str = "nothing",
    conforming: bool = False,
    smooth: int = 0,
    layers: Layers | None = None,
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
    """
    given, ends, _ = points_and_segments(points, segments)
    seeded = holes is not None or regions is not None
    plain = "seeds" if seeded else "even-odd" if len(ends) else "all"
    filled = plain if fill is None else as_choice(fill, _FILLS, "fill")
    concave = as_flag(keep_concavities, "keep_concavities")
    if filled != "seeds" and (seeded or concave):
        raise ValueError(f"holes, regions and keep_concavities are for fill='seeds', not {filled!r}")
    seeds, attributes = _regions(regions)
    wishes: Wishes = {
        "fill": filled,
        "holes": _seeds(holes),
        "regions": seeds,
        "keep_concavities": concave,
        **_wanted(min_angle, max_area, max_edge, edge, growth, max_vertices, keep, conforming, smooth, size, len(given)),
        "max_areas": None,
        "layers": None if layers is None else _layers(layers, len(ends)),
        "of": None,
    }
    split = as_choice(crossings, ("refuse", "split"), "crossings") == "split"
    return Mesh._make((given, ends, split), wishes, attributes)


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
            points, segments, split = origin
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
        """The attribute of the region of each triangle, (t,); NaN for none."""
        return self._once("attributes", lambda: np.append(self._recipe[2], np.nan)[self.regions])

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
        return self._once("segments", self._core.segments)[1]

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
            return MeshReport(
                *self._core.added, smallest, largest, *counts, rows[order], reasons, LayerReport(*self._core.layer_counts)
            )

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
        """Of a mesh that `refine` made: for each triangle the row of the old triangle that holds its centroid, (t,); -1 for none,
        and in a mesh that is not refined. So data of old triangles go to new ones. Old points keep their indices.

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
            return origin._core.rows_at(np.ascontiguousarray(self.points[self.triangles].mean(axis=1)))

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
        max_vertices: int | None = None,
        keep: str = "nothing",
        conforming: bool = False,
        smooth: int = 0,
    ) -> Mesh:
        """A finer mesh of the same triangles, which has all points of this one under the indices that they have. What is good
        enough stays as it is. `parents` tells which old triangle each new one is in.

        Parameters
        ----------
        marked : array_like of bools, shape (t,), or of integers, optional
            Triangles to refine, by a flag for each or by their rows, as error estimators say: what is in them has at most half of
            their area.
        max_areas : array_like of floats, shape (t,), optional
            The largest areas for what is in each triangle, by the centroids of new triangles. Infinite is no bound.
        min_angle, max_area, max_edge, edge, growth, size, max_vertices, keep, conforming, smooth
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
        areas = None if max_areas is None else _numbers(max_areas, "max_areas", len(self.triangles))
        if marked is not None:
            halves = np.where(_flags(marked, "marked", len(self.triangles)), self.areas / 2, np.inf)
            areas = halves if areas is None else np.minimum(areas, halves)
        old: Wishes = self._recipe[1]
        wishes: Wishes = {
            "fill": old["fill"],
            "holes": old["holes"],
            "regions": old["regions"],
            "keep_concavities": old["keep_concavities"],
            **_wanted(
                min_angle, max_area, max_edge, edge, growth, max_vertices, keep, conforming, smooth, size, len(self.points)
            ),
            "max_areas": areas,
            "layers": None,
            "of": None,
        }
        return Mesh._make(self, wishes, self._recipe[2])

    def check(self) -> None:
        """Proves that this is the one canonical triangulation of its points and constraints; RuntimeError that names what is
        wrong if it is not. O(n log n)."""
        self._core.check()

    def __repr__(self) -> str:
        """A line that says what there is."""
        counts = f"{len(self.points)} points, {len(self.triangles)} triangles, {len(self.segments)} segments"
        return f"<delone.Mesh: {counts}>"


def _flags(marked: ArrayLike, name: str, count: int, what: str = "triangles") -> NDArray[np.bool_]:
    """A flag for each of so many, of flags or indices."""
    array = np.asarray(marked)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ValueError(f"{name} must have a flag for each of {count} {what}; its shape is {array.shape}")
        return array
    if array.ndim != 1 or (array.size and array.dtype.kind not in "iu"):
        raise TypeError(f"{name} must be flags or integers in a row, not {array.dtype} of the shape {array.shape}")
    rows = array.astype(np.int64)
    if rows.size and not -1 < rows.min() <= rows.max() < count:
        k = int(np.argmax((rows < 0) | (rows >= count)))
        raise IndexError(f"{name}[{k}] is {rows[k]}, and there are {count} {what}")
    flags = np.zeros(count, bool)
    flags[rows] = True
    return flags


def _layers(layers: Any, segments: int) -> tuple[float, int, float, float | None, list[int] | None]:
    """Boundary layers, checked."""
    if not isinstance(layers, Layers):
        raise TypeError(f"layers must be delone.Layers, not {layers!r}")
    count = as_index(layers.count, "layers.count")
    if not 1 <= count <= 1024:
        raise ValueError(f"layers.count must be from 1 to 1024, not {count}")
    growth = _number(layers.growth, "layers.growth")
    if not 1 <= growth < np.inf:
        raise ValueError(f"layers.growth must be at least 1 and finite, not {growth}")
    height, thickness = (
        None if value is None else float(_positive(np.array([_number(value, what)]), what, True)[0])
        for value, what in ((layers.first_height, "layers.first_height"), (layers.thickness, "layers.thickness"))
    )
    if height is None:
        raise TypeError("layers.first_height must be a number, not None")
    chosen = None if layers.segments is None else np.flatnonzero(_flags(layers.segments, "layers.segments", segments, "segments"))
    return height, count, growth, thickness, None if chosen is None else chosen.tolist()


def _wanted(
    min_angle: float,
    max_area: float | None,
    max_edge: float | None,
    edge: float | None,
    growth: float,
    max_vertices: int | None,
    keep: str,
    conforming: bool,
    smooth: int,
    size: Any,
    count: int,
) -> Wanted:
    """What is wanted of a mesh, checked."""
    most = None if max_vertices is None else as_index(max_vertices, "max_vertices")
    if most is not None and not 0 <= most < 2**62:
        raise ValueError(f"max_vertices must be from 0 to 2**62, not {most}")
    rounds = as_index(smooth, "smooth")
    if not 0 <= rounds < 2**31:
        raise ValueError(f"smooth must be from 0 to 2**31, not {rounds}")
    if edge is None and growth != 1.2:
        raise ValueError("growth is that of edges of a wanted length: give edge, too")
    lengths = [] if max_edge is None else [_bound(max_edge, "max_edge")]
    field = size
    if size is not None and not callable(size):
        if np.ndim(size) == 0:
            if edge is None:
                lengths.append(_bound(size, "size"))
            else:
                edge = min(_bound(edge, "edge"), _bound(size, "size"))
            field = None
        else:
            field = _numbers(size, "size", count, finite=True)
    return {
        "min_angle": _number(min_angle, "min_angle"),
        "max_area": None if max_area is None else _bound(max_area, "max_area"),
        "max_edge": min(lengths, default=None),
        "edge": None if edge is None else _bound(edge, "edge"),
        "growth": _number(growth, "growth"),
        "max_vertices": most,
        "keep": as_choice(keep, _KEPT, "keep"),
        "conforming": as_flag(conforming, "conforming"),
        "smooth": rounds,
        "size": field,
    }


def _number(value: Any, what: str) -> float:
    array = as_numbers(value, what)
    if array.ndim or array.dtype.kind == "b":
        raise TypeError(f"{what} must be a number, not {value!r}")
    return float(array)


def _bound(value: Any, what: str) -> float:
    return float(_positive(np.array([_number(value, what)]), what)[0])


def _numbers(values: Any, what: str, count: int, finite: bool = False) -> NDArray[np.float64]:
    """A positive number for each of so many."""
    array = as_numbers(values, what)
    if array.shape != (count,):
        raise ValueError(f"{what} must have the shape ({count},), one number each, not {array.shape}")
    return _positive(np.array(array, dtype=np.float64), what, finite)


def _positive(numbers: NDArray[np.float64], what: str, finite: bool = False) -> NDArray[np.float64]:
    wrong = ~(numbers > 0) | (np.isinf(numbers) if finite else False)
    if wrong.any():
        row = int(np.argmax(wrong))
        place = f"{what}[{row}]" if finite or len(numbers) > 1 else what
        raise ValueError(f"{place} is {numbers[row]}; it must be positive{' and finite' if finite else ''}")
    return numbers


def _seeds(holes: ArrayLike | None) -> NDArray[np.float64]:
    array = np.empty((0, 2)) if holes is None else as_numbers(holes, "holes")
    return np.array(as_points(array.reshape(0, 2) if array.shape == (0,) else array, "holes", 2))


def _regions(regions: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Seeds with largest areas, and attributes."""
    array = np.empty((0, 2)) if regions is None else as_numbers(regions, "regions")
    if array.shape == (0,):
        array = array.reshape(0, 2)
    if array.ndim != 2 or not 2 <= array.shape[1] <= 4:
        raise ValueError(f"regions must have the shape (k, 2), (k, 3) or (k, 4), not {array.shape}")
    seeds, count = as_points(array[:, :2], "regions", 2), len(array)
    attributes = array[:, 2].astype(np.float64) if array.shape[1] > 2 else np.arange(count, dtype=np.float64)
    areas = array[:, 3].astype(np.float64) if array.shape[1] > 3 else np.full(count, np.inf)
    return np.column_stack([seeds, np.where(areas > 0, areas, np.inf)]), attributes
