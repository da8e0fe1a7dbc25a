"""The triangulation, with the names of scipy.spatial.Delaunay."""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy, deepcopy
from itertools import chain, count
from typing import Any

import numpy as np
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._errors import restores
from ._kept import Kept
from ._options import parse
from ._points import as_count, as_flag, as_indices, as_points, as_queries, owned

#: What a triangulation holds itself; all else is a subclass's.
_OWN = frozenset(["_core", "_ndim", "_is_closed", "_cache", "_options", "_furthest"])


class Delaunay(Kept):
    """The Delaunay triangulation of points in the plane or in space.

    It is exact, and a function of the set of points alone: neither the order of the points nor the number of threads
    shows. Points that equal an earlier one are reported as its duplicates. Points on one line, or in space in one
    plane, are no error: they have no simplices.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    furthest_site : bool
        Triangulate so that the circle of each triangle holds all points; for points of the plane. Its triangles join the
        corners of the hull.
    incremental : bool
        For those who come from SciPy; points can be added and removed either way.
    qhull_options : str, optional
        For those who come from SciPy. Options that concern rounding have no effect, because there is none; what would
        change the result is refused by a ValueError. `QJ` refuses equal points, which only a joggle tells apart.

    Raises
    ------
    TypeError, ValueError
        What is wrong with the points, and where.
    MemoryError
        Where there is not enough for so many points.

    Examples
    --------
    >>> import delone
    >>> tri = delone.Delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> len(tri.simplices)
    2
    >>> tri.find_simplex([[0.9, 0.5], [2.0, 2.0]]).tolist()[1]
    -1
    """

    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
    ) -> None:
        """Triangulates points."""
        as_flag(incremental, "incremental")
        self._options = parse(qhull_options, "")
        # SciPy copies too: what a caller changes later does not change the triangulation.
        given = owned(as_points(points))
        self._furthest = as_flag(furthest_site, "furthest_site")
        if self._furthest and given.shape[1] != 2:
            raise NotImplementedError("furthest-site triangulations are for points of the plane")
        self._begin(_delone.Triangulation(given))
        self._refuse_twins(given)

    def _begin(self, core: _delone.Triangulation) -> None:
        self._core, self._ndim = core, int(core.points.shape[1])
        self._is_closed = False
        self._cache = {}

    def _refuse_twins(self, points: NDArray[np.float64]) -> None:
        if self._options.distinct and len(np.unique(points + 0.0, axis=0)) < len(points):
            raise ValueError("qhull_options: 'QJ' makes a corner of each point, but some are equal, and nothing is joggled")

    @classmethod
    def _of(cls, core: _delone.Triangulation) -> Delaunay:
        made = cls.__new__(cls)
        made._options, made._furthest = parse(None, ""), False
        made._begin(core)
        return made

    # What there is.

    _core: _delone.Triangulation

    @property
    def points(self) -> NDArray[np.float64]:
        """The points given, removed ones and duplicates included: (n, ndim). Read-only."""
        return self._core.points

    @property
    def ndim(self) -> int:
        """2 in the plane, 3 in space."""
        return self._ndim

    @property
    def npoints(self) -> int:
        """The number of points given."""
        return len(self.points)

    @property
    def nsimplex(self) -> int:
        """The number of simplices."""
        return len(self.simplices)

    @property
    def vertex_count(self) -> int:
        """The number of vertices: points without duplicates and removed ones."""
        return self._core.vertex_count

    @property
    def span(self) -> int:
        """The dimension of what the points span: -1 for none, 0 for a point, 1 for a line, 2 for a plane, 3 for space."""
        return self._core.span

    @property
    def furthest_site(self) -> bool:
        """Whether the circles of triangles hold all points, instead of none."""
        return self._furthest

    @property
    def good(self) -> NDArray[np.int32]:
        """1 for each simplex; for those who come from SciPy."""
        return np.ones(self.nsimplex, dtype=np.int32)

    @property
    def min_bound(self) -> NDArray[np.float64]:
        """The least coordinate of the points along each axis."""
        # Kept, because SciPy's compiled code looks at it later.
        return self._once("low", lambda: np.asarray(self.points.min(axis=0, initial=np.inf)))

    @property
    def max_bound(self) -> NDArray[np.float64]:
        """The largest coordinate of the points along each axis."""
        return self._once("high", lambda: np.asarray(self.points.max(axis=0, initial=-np.inf)))

    def _arrays(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        def make() -> tuple[NDArray[np.int32], NDArray[np.int32]]:
            if not self._furthest:
                return self._core.arrays()
            triangles = self._farthest()[0]
            return triangles, _delone.neighbors_of(triangles)

        return self._once("arrays", make)

    def _farthest(self) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        return self._once("furthest", lambda: _delone.furthest(self._core))

    def _centers(self) -> NDArray[np.float64]:
        """The circumcenters of simplices, each the nearest numbers to the exact one."""
        return self._farthest()[1] if self._furthest else self._core.centers()

    @property
    def simplices(self) -> NDArray[np.int32]:
        """Corners as indices of points, (nsimplex, ndim + 1).

        Counter-clockwise in the plane; in space the first three are seen counter-clockwise from the fourth.
        """
        return self._arrays()[0]

    @property
    def neighbors(self) -> NDArray[np.int32]:
        """The simplices across from each corner, (nsimplex, ndim + 1); -1 where there is none."""
        return self._arrays()[1]

    @property
    def convex_hull(self) -> NDArray[np.int32]:
        """Facets of the hull, (nfacet, ndim): edges counter-clockwise around the plane's hull, triangles counter-clockwise
        seen from outside."""

        def make() -> NDArray[np.int32]:
            if not self._furthest:
                return self._core.hull()
            rows, corners = np.nonzero(self.neighbors < 0)
            ends = [self.simplices[rows, (corners + k) % 3] for k in (1, 2)]
            return np.stack(ends, axis=1)

        return self._once("hull", make)

    @property
    def edges(self) -> NDArray[np.int32]:
        """The edges, (nedge, 2), each once; those of points on a line too."""

        def make() -> NDArray[np.int32]:
            if not self._furthest:
                return self._core.edges()
            rows, corners = np.nonzero(np.arange(self.nsimplex)[:, None] > self.neighbors)
            ends = [self.simplices[rows, (corners + k) % 3] for k in (1, 2)]
            return np.stack(ends, axis=1)

        return self._once("edges", make)

    @property
    def duplicates(self) -> NDArray[np.int32]:
        """Points that equal an earlier one, each with this: (m, 2)."""

        return self._once("duplicates", self._core.duplicates)

    @property
    def coplanar(self) -> NDArray[np.int32]:
        """Points that are no vertices, each with a simplex and the vertex that it equals: (m, 3).

        SciPy lists what it lost to rounding here, too; nothing is lost here.
        """
        twins = self.duplicates
        if not len(twins):
            return np.empty((0, 3), dtype=np.int32)
        return np.column_stack([twins[:, 0], self._simplex_of_each()[twins[:, 1]], twins[:, 1]])

    @property
    def vertex_to_simplex(self) -> NDArray[np.int32]:
        """For each point a simplex that it, or the one that it equals, is a corner of; -1 for those that are no corner."""
        return self._simplex_of_each()

    def _simplex_of_each(self) -> NDArray[np.int32]:
        def make() -> NDArray[np.int32]:
            return _delone.vertex_to_simplex(len(self._core.points), self._arrays()[0], self.duplicates)

        return self._once("vertex_to_simplex", make)

    @property
    def vertex_neighbor_vertices(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Neighbors of all points as (indptr, indices): those of point k are indices[indptr[k]:indptr[k + 1]]."""

        return self._once("vertex_neighbor_vertices", lambda: _delone.vertex_neighbors(self.npoints, self.edges))

    @property
    def transform(self) -> NDArray[np.float64]:
        """For each simplex the map to barycentric coordinates, (nsimplex, ndim + 1, ndim).

        With T = transform[i, :ndim] and r = transform[i, ndim], the first ndim coordinates of x are T @ (x - r). All of
        transform[i] is NaN where a simplex is so flat, or so thin beside the size of its coordinates, that a change of x in
        its last place may move the result by a thousandth, or where T is out of range. In all others the result is right to
        a 50th for each x in the simplex; that is proved, and mostly it is right to many places.
        """
        return self._once("transform", lambda: _delone.transforms(self.points, self.simplices))

    #: Lifted points have the height paraboloid_scale * |x|^2 + paraboloid_shift; SciPy scales to the size of the others.
    paraboloid_scale = 1.0
    paraboloid_shift = 0.0

    def _lift(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        with np.errstate(over="ignore", under="ignore"):
            return np.concatenate([x, (x**2).sum(axis=-1, keepdims=True)], axis=-1)

    def lift_points(self, x: ArrayLike) -> NDArray[np.float64]:
        """Points on the paraboloid: one more coordinate, the square of the distance from the origin."""
        rows, shape = as_queries(x, self.ndim, "x")
        return self._lift(rows).reshape((*shape, self.ndim + 1))

    @property
    def equations(self) -> NDArray[np.float64]:
        """Planes of the lifted simplices, (nsimplex, ndim + 2): normals of length 1 that point down, of furthest sites up, and
        offsets."""

        def make() -> NDArray[np.float64]:
            return _delone.lifted_equations(self.points, self.simplices, self._furthest)

        return self._once("equations", make)

    def plane_distance(self, xi: ArrayLike) -> NDArray[np.float64]:
        """Distances of lifted points from the planes of all simplices, (..., nsimplex): positive for those whose
        circumscribed circle or sphere holds the point; of furthest sites, for those whose circle does not."""
        lifted = self.lift_points(xi)
        with np.errstate(all="ignore"):
            return np.asarray(lifted @ self.equations[:, :-1].T + self.equations[:, -1])

    # Questions.

    def find_simplex(self, xi: ArrayLike, bruteforce: bool = False, tol: float | None = None) -> NDArray[np.int32]:
        """The simplices that hold points, with the shape of `xi` without its last axis; -1 outside of the hull.

        Exact: a point on the border between simplices is in one of them; one with NaN or infinity is outside. `bruteforce` and
        `tol` are for those who come from SciPy, and have no effect.

        Examples
        --------
        >>> import delone
        >>> tri = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
        >>> row = tri.find_simplex([[3, 2]])[0]
        >>> sorted(tri.simplices[row].tolist())
        [1, 2, 4]
        >>> tri.find_simplex([[9, 9]]).tolist()
        [-1]
        """
        given: NDArray[Any] = np.empty(0) if ma.is_masked(xi) else np.asarray(xi)
        if given.dtype.kind == "f" and given.ndim and given.shape[-1] == self.ndim and not np.isfinite(given).all():
            known = np.isfinite(given).all(axis=-1)
            found = np.full(given.shape[:-1], -1, dtype=np.int32)
            found[known] = self.find_simplex(given[known])
            return found
        queries, shape = as_queries(xi, self.ndim)
        if self._furthest:
            return self._find_furthest(queries).reshape(shape)
        return self._core.find(queries).reshape(shape)

    locate = find_simplex

    def _find_furthest(self, queries: NDArray[np.float64]) -> NDArray[np.int32]:
        """Looks at all triangles, which join the corners of the hull alone."""
        found = np.full(len(queries), -1, dtype=np.int32)
        sides = self.points[np.stack([self.simplices, np.roll(self.simplices, -1, axis=1)], axis=2)].reshape(-1, 2)
        # So many at a time that the answers for all of them fit memory.
        step = max(1, 10**7 // max(1, len(sides)))
        for start in range(0, len(queries) if len(sides) else 0, step):
            part = queries[start : start + step]
            inside = np.all(_delone.sides(sides, part).reshape(len(part), -1, 3) <= 0, axis=2)
            found[start : start + step] = np.where(np.any(inside, axis=1), np.argmax(inside, axis=1), -1)
        return found

    def nearest(self, xi: ArrayLike) -> NDArray[np.int64]:
        """The nearest vertices; the lexicographically smallest of several. -1 if there is no vertex.

        Examples
        --------
        >>> import delone
        >>> tri = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
        >>> tri.nearest([[1, 1], [9, 9]]).tolist()
        [4, 2]
        """
        queries, shape = as_queries(xi, self.ndim)
        return self._core.nearest(queries).reshape(shape)

    def k_nearest(self, xi: ArrayLike, k: int) -> NDArray[np.int64]:
        """The k nearest vertices, nearest first, with one more axis than `nearest`; -1 where there are not so many.

        Examples
        --------
        >>> import delone
        >>> tri = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
        >>> tri.k_nearest([[1, 1.5]], 2).tolist()
        [[4, 0]]
        """
        queries, shape = as_queries(xi, self.ndim)
        k = as_count(k, len(queries))
        return self._core.k_nearest(queries, k).reshape((*shape, k))

    # Changes.

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, whose indices follow those there are. `restart` triangulates all anew, removed ones left out: the
        result is the same, and for more points than there are it is faster. RuntimeError after `close`.

        Ctrl-C ends the wait, not the change: whoever asks next waits for its end, and the points are there then. With `restart`
        no point was added.

        Examples
        --------
        >>> import delone
        >>> tri = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
        >>> tri.add_points([[3, 1]])
        >>> tri.npoints, tri.nsimplex
        (6, 6)
        """
        self._refuse_closed()
        self._forget()
        more = as_points(points, columns=self.ndim)
        is_new = as_flag(restart, "restart")
        while True:
            given, removed = self._core.given()
            everything = np.concatenate([given, more])
            everything.flags.writeable = False
            self._refuse_twins(everything)
            if is_new:
                self._core = _built(everything, removed)
                return
            # Another thread may have added some meanwhile.
            if self._core.extend(more, everything):
                return

    def remove(self, points: int | Iterable[int] | ArrayLike) -> None:
        """Removes vertices by index, or those that a mask says, all or none. Duplicates of a vertex go with it. Indices of
        others stay as they are.

        A mask has a boolean for each point, and those that are no vertices must not be marked. TypeError for what is neither
        integers nor a mask, IndexError for what is no vertex, RuntimeError after `close`.

        Ctrl-C ends the wait, not the change, as in `add_points`.

        Examples
        --------
        >>> import delone
        >>> tri = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
        >>> tri.remove([4])
        >>> tri.nsimplex, tri.npoints
        (2, 5)
        """
        self._refuse_closed()
        wanted = as_indices(points, self.npoints)
        beyond = next((v for v in wanted if not 0 <= v < self.npoints), None)
        if beyond is not None:
            raise IndexError(f"point {beyond} is no vertex")
        self._forget()
        self._core.remove(wanted)

    def close(self) -> None:
        """Ends changes: points can be neither added nor removed any more."""
        self._is_closed = True

    def _refuse_closed(self) -> None:
        if self._is_closed:
            raise RuntimeError("closed: points can be neither added nor removed any more")

    # Copies, and how it looks.

    def copy(self) -> Delaunay:
        """A triangulation of its own with the same points."""
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__dict__)
        made._begin(self._core.copy())
        made._is_closed = self._is_closed
        return made

    def to_scipy(self) -> Any:
        """A `scipy.spatial.Delaunay` with these simplices, for what takes no other class, as SciPy's interpolators.

        Its `find_simplex` is SciPy's, with SciPy's tolerance; points cannot be added to it. ValueError where there are no
        simplices, and for furthest sites. O(n).
        """
        import scipy.spatial

        if not self.nsimplex or self._furthest:
            raise ValueError("SciPy has no triangulation without simplices, and its interpolators take none of furthest sites")
        made = scipy.spatial.Delaunay.__new__(scipy.spatial.Delaunay)
        names = ["ndim", "npoints", "nsimplex", "min_bound", "max_bound", "furthest_site", "paraboloid_scale"]
        names += ["paraboloid_shift", "simplices", "neighbors", "equations", "coplanar", "good"]
        given = {name: copy(getattr(self, name)) for name in names}
        nothing = dict.fromkeys(["_qhull", "_transform", "_vertex_to_simplex", "_vertex_neighbor_vertices"])
        made.__dict__.update(given, **nothing, _points=np.array(self.points))
        return made

    def __copy__(self) -> Delaunay:
        """See `copy`."""
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> Delaunay:
        """See `copy`; what a subclass added is copied deeply."""
        made = self.copy()
        memo[id(self)] = made
        made.__dict__.update({name: deepcopy(value, memo) for name, value in self.__dict__.items() if name not in _OWN})
        return made

    def __getstate__(self) -> dict[str, Any]:
        """Points and what was removed, and what a subclass added."""
        points, removed = self._core.given()
        state = {"points": np.array(points), "removed": removed, "options": self._options}
        others = {name: value for name, value in self.__dict__.items() if name not in _OWN}
        return {**state, "furthest": self._furthest, "closed": self._is_closed, "others": others}

    @restores
    def __setstate__(self, state: dict[str, Any]) -> None:
        """Triangulates again: the triangulation is a function of the points."""
        self._options, self._furthest = state["options"], state["furthest"]
        points = as_points(state["points"], "points")
        self._begin(_built(owned(points), state["removed"]))
        self._is_closed = state["closed"]
        self.__dict__.update(state.get("others", {}))

    def __repr__(self) -> str:
        """A line that says what there is."""
        what = "triangles" if self.ndim == 2 else "tetrahedra"
        return f"<delone.Delaunay: {self.vertex_count} vertices, {self.nsimplex} {what}>"

    def _repr_svg_(self) -> str | None:
        """A picture for notebooks; of small triangulations of the plane."""
        from ._plot import svg

        return svg(self) if self.ndim == 2 and 0 < self.npoints <= 5000 else None


def _built(points: NDArray[np.float64], removed: list[int]) -> _delone.Triangulation:
    """The triangulation of points without some, indices kept: these are put where no other point is, and removed."""
    if not removed:
        return _delone.Triangulation(points)
    column = points[:, 0]
    ends = [np.nextafter(column.max(), np.inf), np.nextafter(column.min(), -np.inf)]
    elsewhere = next(x for x in chain(ends, count(0.5)) if np.isfinite(x) and not (column == x).any())
    moved = np.array(points)
    moved[removed] = elsewhere
    return _delone.Triangulation.without(points, moved, removed)
