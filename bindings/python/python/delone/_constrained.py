"""Constrained Delaunay triangulations: segments are edges, and what they bound may be inside or not."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._arcs import renamed
from ._errors import CrossingError, restores
from ._kept import Kept
from ._points import as_choice, as_count, as_flag, as_index, as_numbers, as_points, as_queries
from ._polygons import points_and_segments
from ._welded import Welded, welded_of

_FILLS = ("all", "even-odd", "nonzero", "positive", "negative", "seeds")
_CROSSINGS = ("refuse", "split")
_ENDS = ("refuse", "join", "drop")


class ConstrainedDelaunay(Kept):
    """The constrained Delaunay triangulation of points and segments in the plane.

    It is exact, and a function of the set of points and of the union of the segments alone. Segments may pass through points,
    overlap, repeat each other and have no length.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2), or polygons
        The points. All must be finite. Of equal points the first is the vertex. Or polygons, as shapely, geopandas and GeoJSON
        have them: their corners are the points, and their sides the segments.
    segments : array_like of integers, shape (m, 2), optional
        The ends of segments, by indices of points. The row of a segment is its id.
    holes : array_like of floats, shape (k, 2), optional
        A point in each hole.
    regions : array_like of floats, shape (k, 2) or (k, 3), optional
        A point in each region, and an attribute for its triangles; without one it is the index of the region.
    fill : str, optional
        Which triangles are inside. "all": those of the convex hull. "even-odd": those that an odd number of segments is
        around. "nonzero": those that segments wind around, counter-clockwise less clockwise; "positive" where this is more
        than zero, "negative" where it is less. "seeds": all but holes and what
        no segments part from the outside, as Triangle has it. The last one with `holes` or `regions`; else "even-odd" for
        polygons, "all" for points.
    crossings : str
        What happens where segments cross: "refuse" is a CrossingError, "split" makes points there.
    keep_concavities : bool
        With "seeds": what no segments part from the outside is inside.
    weld : float, optional
        A distance: points and segments nearer to each other become one first, as `delone.weld` has it. Rows of segments are then
        those of `welded.segments`.

    Raises
    ------
    TypeError, ValueError, IndexError, MemoryError
        What is wrong with the points or the segments, and where; for example a hole that is on a segment.

    Examples
    --------
    A square with a triangular hole.

    >>> import delone
    >>> points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]]
    >>> segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
    >>> tri = delone.ConstrainedDelaunay(points, segments, holes=[[2, 2]])
    >>> tri.nsimplex, len(tri.all_triangles), len(tri.constraints)
    (7, 8, 7)
    >>> tri.find_simplex([2, 2]).tolist(), tri.sees(0, [1, 4, 2]).tolist()
    (-1, [False, True, False])
    """

    def __init__(
        self,
        points: ArrayLike,
        segments: ArrayLike | None = None,
        *,
        holes: ArrayLike | None = None,
        regions: ArrayLike | None = None,
        fill: str | None = None,
        crossings: str = "refuse",
        keep_concavities: bool = False,
        weld: float | None = None,
    ) -> None:
        """Triangulates points and segments."""
        given, ends, has_inside = points_and_segments(points, segments)
        seeded = holes is not None or regions is not None
        plain = "seeds" if seeded else "even-odd" if has_inside else "all"
        self._fill = plain if fill is None else as_choice(fill, _FILLS, "fill")
        self._keep = as_flag(keep_concavities, "keep_concavities")
        if self._fill != "seeds" and (seeded or self._keep):
            raise ValueError(f"holes, regions and keep_concavities are for fill='seeds', not {self._fill!r}")
        self._holes = np.array(_seeds(holes, "holes"))
        self._regions, self._values = _regions(regions)
        #: What welding did; None without it.
        self.welded: Welded | None = None
        if weld is not None:
            self.welded = welded_of(given, ends, weld)
            given, ends = self.welded[:2]
        self._split = as_choice(crossings, _CROSSINGS, "crossings") == "split"
        self._origin = (given, ends)
        try:
            self._begin(_delone.Constrained(given, ends, self._split))
        except CrossingError as error:
            raise error if self.welded is None else renamed(error, self.welded.origins) from None
        if self._fill == "seeds":
            # What is wrong with seeds is told now.
            self._parts()

    def _begin(self, core: _delone.Constrained) -> None:
        self._core, self._cache = core, {}

    # What there is.

    _core: _delone.Constrained

    @property
    def points(self) -> NDArray[np.float64]:
        """All points: those given, those made where segments crossed, and those inserted, removed ones and duplicates
        included: (n, 2). Read-only."""

        def make() -> NDArray[np.float64]:
            given = self._origin[0]
            more = self._core.points_from(len(given))
            points = np.concatenate([given, more]) if len(more) else given
            points.flags.writeable = False
            return points

        return self._once("points", make)

    @property
    def ndim(self) -> int:
        """2: the plane."""
        return 2

    @property
    def npoints(self) -> int:
        """The number of points."""
        return self._core.point_count

    @property
    def nsimplex(self) -> int:
        """The number of triangles inside."""
        return len(self.simplices)

    @property
    def vertex_count(self) -> int:
        """The number of vertices: points without duplicates and removed ones."""
        return self._core.vertex_count

    @property
    def span(self) -> int:
        """The dimension of what the points span: -1 for none, 0 for a point, 1 for a line, 2 for the plane."""
        return self._core.span

    @property
    def min_bound(self) -> NDArray[np.float64]:
        """The least coordinate of the points along each axis."""
        return np.asarray(self.points.min(axis=0, initial=np.inf))

    @property
    def max_bound(self) -> NDArray[np.float64]:
        """The largest coordinate of the points along each axis."""
        return np.asarray(self.points.max(axis=0, initial=-np.inf))

    @property
    def fill(self) -> str:
        """Which triangles are inside: "all", "even-odd", "nonzero", "positive", "negative" or "seeds"."""
        return self._fill

    @property
    def report(self) -> dict[str, int]:
        """What became of the segments at the beginning, in numbers.

        `zero_length` segments are no constraints; `repeated` ones repeat another, `overlapping` ones share a part of their
        length with another, `through_vertices` counts those with vertices inside of them; pairs in `crossings` were split by
        `added_points` in `rounds`.
        """
        return dict(self._core.report())

    # All triangles.

    @property
    def all_triangles(self) -> NDArray[np.int32]:
        """The triangles of the convex hull, counter-clockwise, as indices of points: (nall, 3)."""
        return self._once("arrays", self._core.arrays)[0]

    @property
    def all_neighbors(self) -> NDArray[np.int32]:
        """For each of `all_triangles` those across from its corners, (nall, 3); -1 where there is none."""
        return self._once("arrays", self._core.arrays)[1]

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which of `all_triangles` are inside, as `fill` says: (nall,)."""
        return self._once("inside", lambda: self._of_parts(1))

    def _parts(self) -> tuple[NDArray[Any], ...]:
        """Of all triangles their parts; of parts whether they are inside, windings and regions; rivals."""
        return self._once("parts", lambda: self._core.parts(self._fill, self._holes, self._regions, self._keep))

    def _of_parts(self, column: int) -> NDArray[Any]:
        parts = self._parts()
        return np.asarray(parts[column][parts[0]])

    def _of_inside(self, values: NDArray[Any]) -> NDArray[Any]:
        return values if self._fill == "all" else np.asarray(values[self.inside])

    # The triangles inside.

    @property
    def simplices(self) -> NDArray[np.int32]:
        """The triangles inside, counter-clockwise, as indices of points: (nsimplex, 3)."""
        return self._once("simplices", lambda: self._of_inside(self.all_triangles))

    triangles = simplices

    @property
    def neighbors(self) -> NDArray[np.int32]:
        """The rows of `simplices` across from each corner, (nsimplex, 3); -1 where nothing inside is."""

        def make() -> NDArray[np.int32]:
            if self._fill == "all":
                return self.all_neighbors
            # The last one is for -1.
            names = np.append(self._names(), np.int32(-1))
            return np.asarray(names[self._of_inside(self.all_neighbors)])

        return self._once("neighbors", make)

    def _names(self) -> NDArray[np.int32]:
        """For each of all triangles its row among those inside, or -1."""

        def make() -> NDArray[np.int32]:
            inside = self.inside
            return np.where(inside, np.cumsum(inside, dtype=np.int32) - np.int32(1), np.int32(-1))

        return self._once("names", make)

    @property
    def constrained(self) -> NDArray[np.bool_]:
        """Whether the edge across from each corner of `simplices` is a constraint: (nsimplex, 3)."""
        return self._once("constrained", lambda: self._of_inside(self._core.sides()))

    @property
    def parts(self) -> NDArray[np.int32]:
        """The part that each triangle inside is in, (nsimplex,): parts are bounded by constraints."""
        return self._once("part", lambda: self._of_inside(self._parts()[0]))

    @property
    def windings(self) -> NDArray[np.int32]:
        """How often segments wind around each triangle inside, counter-clockwise less clockwise, (nsimplex,); 0 unless `fill`
        is "even-odd", "nonzero", "positive" or "negative"."""
        return self._once("windings", lambda: self._of_inside(self._of_parts(2)))

    @property
    def regions(self) -> NDArray[np.int32]:
        """The region that each triangle inside is in, by the row of its seed, (nsimplex,); -1 for none. Of two seeds in one
        part the first one counts."""
        return self._once("regions", lambda: self._of_inside(self._of_parts(3)))

    @property
    def attributes(self) -> NDArray[np.float64]:
        """The attribute of the region of each triangle inside, (nsimplex,); NaN for none."""
        return self._once("attributes", lambda: np.append(self._values, np.nan)[self.regions])

    @property
    def rivals(self) -> NDArray[np.int64]:
        """Pairs of regions whose seeds are in one part; the first of each pair has it: (k, 2)."""
        return np.asarray(self._parts()[4])

    # Edges and segments.

    @property
    def edges(self) -> NDArray[np.int32]:
        """All edges, constraints among them, (nedge, 2), each once; those of points on a line too."""
        return self._once("edges", self._core.edges)

    @property
    def convex_hull(self) -> NDArray[np.int32]:
        """The edges of the convex hull, counter-clockwise: (nfacet, 2)."""
        return self._once("hull", self._core.hull)

    @property
    def constraints(self) -> NDArray[np.int32]:
        """The edges that are constraints, (k, 2), each once, the lesser index first."""
        return self._once("constraints", self._core.constraints)

    @property
    def segments(self) -> NDArray[np.int32]:
        """The vertices at the ends of segments, by their ids: (m, 2); -1 for those that have no length or were removed."""
        return self._once("segments", self._core.segments)

    @property
    def duplicates(self) -> NDArray[np.int32]:
        """Points that equal an earlier one which is a vertex, each with this: (k, 2)."""
        return self._once("duplicates", self._core.duplicates)

    def chain(self, segment: int) -> NDArray[np.int64]:
        """The vertices along a segment, from its first end to its second. IndexError for one that is not there."""
        return self._core.chain(self._segment(segment))

    def _segment(self, segment: int) -> int:
        wanted = as_index(segment, "a segment")
        if not 0 <= wanted < len(self.segments):
            raise IndexError(f"there is no segment {wanted} in this triangulation")
        return wanted

    def _vertex(self, index: int) -> int:
        wanted = as_index(index, "a vertex")
        if not 0 <= wanted < self.npoints:
            raise IndexError(f"{wanted} is no vertex of this triangulation")
        return wanted

    # Questions.

    def find_simplex(self, xi: ArrayLike) -> NDArray[np.int32]:
        """The rows of `simplices` that hold points, with the shape of `xi` without its last axis; -1 for points that are not
        inside.

        Exact: a point on a border between triangles is in one of them that is inside, if there is one.

        Examples
        --------
        >>> import delone
        >>> points, ring = [[0, 0], [4, 0], [4, 4], [0, 4], [9, 2]], [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> tri = delone.ConstrainedDelaunay(points, ring, fill="even-odd")
        >>> (tri.find_simplex([[1, 2], [6, 2]]) >= 0).tolist()
        [True, False]
        """
        queries, shape = as_queries(xi, 2)
        return self._core.find(queries, self._names()).reshape(shape)

    locate = find_simplex

    def nearest(self, xi: ArrayLike) -> NDArray[np.int64]:
        """The nearest vertices, whether they are seen or not; the lexicographically smallest of several. -1 if there is no
        vertex."""
        queries, shape = as_queries(xi, 2)
        return self._core.nearest(queries).reshape(shape)

    def k_nearest(self, xi: ArrayLike, k: int) -> NDArray[np.int64]:
        """The k nearest vertices, nearest first, with one more axis than `nearest`; -1 where there are not so many."""
        queries, shape = as_queries(xi, 2)
        k = as_count(k, len(queries))
        return self._core.k_nearest(queries, k).reshape((*shape, k))

    def first_constraint(self, a: ArrayLike, b: ArrayLike) -> NDArray[np.int64]:
        """The first constraint that the open segment from a vertex to another meets: crosses, runs along, or comes to an end
        of.

        `a` and `b` are indices or arrays of them, which are broadcast. Its two ends are in one more axis; -1 for none.
        IndexError for what is no vertex.
        """
        ends = [as_numbers(side, "vertices") for side in (a, b)]
        for side in ends:
            if side.dtype.kind not in "iu" and side.size:
                raise TypeError(f"vertices must be integers, not {side.dtype}")
            wrong = side[(side < 0) | (side >= self.npoints)]
            if wrong.size:
                raise IndexError(f"{int(wrong.flat[0])} is no vertex of this triangulation")
        both = np.stack(np.broadcast_arrays(*ends), axis=-1).astype(np.int64)
        return self._core.first_constraints(np.ascontiguousarray(both.reshape(-1, 2))).reshape(both.shape)

    def sees(self, a: ArrayLike, b: ArrayLike) -> NDArray[np.bool_]:
        """Whether the open segment from a vertex to another meets no constraint; indices or arrays of them, which are
        broadcast. A vertex sees itself. IndexError for what is no vertex.

        Examples
        --------
        >>> import delone
        >>> tri = delone.ConstrainedDelaunay([[0, 0], [8, 0], [4, 1], [4, -1]], [[0, 1]])
        >>> tri.sees(2, [0, 3]).tolist()
        [True, False]
        """
        return np.asarray(self.first_constraint(a, b)[..., 0] < 0)

    def check(self) -> None:
        """Proves that this is the one canonical triangulation of its points and segments; RuntimeError that names what is
        wrong if it is not. O(n log n)."""
        self._core.check()

    # Changes.

    def insert(self, points: ArrayLike) -> NDArray[np.int64]:
        """Inserts a point, or rows of points, and returns their indices: new ones, or those of vertices that are there
        already. A constraint that a point is on is split. All or none.

        Ctrl-C ends the wait for this and other changes, not the change: whoever asks next waits for its end.
        """
        more, shape = as_queries(points, 2, "points")
        self._forget()
        return self._core.insert(np.array(more)).reshape(shape)

    def remove(self, vertex: int, ends: str = "refuse") -> None:
        """Removes a vertex; indices of others stay as they are. Segments that pass straight through it stay.

        `ends` says what becomes of segments that end there. "refuse": ValueError. "join": where two end, and nothing else,
        they become one, with the lesser id. "drop": they are removed. IndexError for what is no vertex.
        """
        v, how = self._vertex(vertex), as_choice(ends, _ENDS, "ends")
        self._forget()
        self._core.remove(v, how)

    def insert_segment(self, a: int, b: int) -> int:
        """Inserts a segment between two vertices, and returns its id. CrossingError where it crosses a constraint,
        ValueError for twice the same vertex, IndexError for what is no vertex.

        Examples
        --------
        >>> import delone
        >>> points = [[0, 0], [8, 0], [4, 1], [4, -1]]
        >>> tri = delone.ConstrainedDelaunay(points, [])
        >>> wall = tri.insert_segment(0, 1)
        >>> tri.chain(wall).tolist(), len(tri.constraints)
        ([0, 1], 1)
        """
        v, w = self._vertex(a), self._vertex(b)
        self._forget()
        return self._core.insert_segment(v, w)

    def remove_segment(self, segment: int) -> None:
        """Removes a segment; its ends, and the vertices on it, stay. IndexError for one that is not there.

        Examples
        --------
        >>> import delone
        >>> points = [[0, 0], [8, 0], [4, 1], [4, -1]]
        >>> tri = delone.ConstrainedDelaunay(points, [])
        >>> tri.remove_segment(tri.insert_segment(0, 1))
        >>> len(tri.constraints)
        0
        """
        s = self._segment(segment)
        self._forget()
        self._core.remove_segment(s)

    # Copies, and how it looks.

    def copy(self) -> ConstrainedDelaunay:
        """A triangulation of its own with the same points and segments."""
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__dict__)
        made._begin(self._core.copy())
        return made

    def __copy__(self) -> ConstrainedDelaunay:
        """See `copy`."""
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> ConstrainedDelaunay:
        """See `copy`."""
        return self.copy()

    def __getstate__(self) -> dict[str, Any]:
        """What was given at the beginning, and the changes since."""
        state = {name: value for name, value in self.__dict__.items() if name not in ("_core", "_cache")}
        return {**state, "_changes": self._core.changes()}

    @restores
    def __setstate__(self, state: dict[str, Any]) -> None:
        """Triangulates again, and changes it as it was changed."""
        self.__dict__.update({name: value for name, value in state.items() if name != "_changes"})
        core = _delone.Constrained(*self._origin, self._split)
        for name, *arguments in state["_changes"]:
            getattr(core, name)(*arguments)
        self._begin(core)

    def __repr__(self) -> str:
        """A line that says what there is."""
        counts = f"{self.vertex_count} vertices, {self.nsimplex} triangles, {len(self.constraints)} constraints"
        return f"<delone.ConstrainedDelaunay: {counts}>"

    def _repr_svg_(self) -> str | None:
        """A picture for notebooks; of small triangulations."""
        from ._plot import svg

        return svg(self) if 0 < self.npoints <= 5000 else None


def _seeds(seeds: ArrayLike | None, what: str) -> NDArray[np.float64]:
    array = np.empty((0, 2)) if seeds is None else as_numbers(seeds, what)
    return as_points(array.reshape(0, 2) if array.shape == (0,) else array, what, 2)


def _regions(regions: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Seeds and attributes."""
    array = np.empty((0, 2)) if regions is None else as_numbers(regions, "regions")
    if array.ndim == 2 and array.shape[1] == 4:
        raise ValueError("regions of 4 columns: largest areas are for refinement; give regions[:, :3]")
    if array.ndim == 2 and array.shape[1] == 3:
        return np.array(as_points(array[:, :2], "regions", 2)), np.array(array[:, 2], dtype=np.float64)
    seeds = np.array(_seeds(array, "regions"))
    return seeds, np.arange(len(seeds), dtype=np.float64)
