"""Triangulations, Voronoi diagrams and hulls that are SciPy's too."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import scipy.spatial
from numpy.typing import ArrayLike, NDArray

from .. import _delaunay, _hull, _voronoi
from .._cached import cached_property
from .._points import ShapeError
from ._place import (
    Assignable,
    InItsPlace,
    WithoutQhull,
    as_doubles,
    as_more,
    as_rows,
    is_ours,
    or_theirs,
    refuse_flat,
    refuse_options,
    taken_for_array,
)

#: What SciPy's compiled code keeps of a triangulation whose parts were assigned.
_KEPT = ("_transform", "_vertex_to_simplex", "_vertex_neighbor_vertices")


def _forget_following(tri: Delaunay) -> None:
    """What follows from the parts of a triangulation is to be made anew."""
    tri._cache.pop("equations", None)
    for name in _KEPT:
        tri.__dict__.pop(name, None)


class _Shape(Assignable):
    """A part of a triangulation; once it is assigned, what follows from it is made anew.

    Of an array that is not contiguous there is a copy: SciPy's compiled code would misread it.
    """

    def __set__(self, instance: Any, value: Any) -> None:
        """Keeps a value."""
        is_spread = isinstance(value, np.ndarray) and not value.flags.c_contiguous
        super().__set__(instance, np.ascontiguousarray(value) if is_spread else value)
        _forget_following(instance)


def _is_within(values: ArrayLike, low: int, end: int) -> bool:
    """Whether integers are indices from one number to before another."""
    array: NDArray[Any] = np.asarray(values)
    return array.dtype == np.int32 and (not array.size or bool(low <= array.min() and array.max() < end))


def _following(name: str) -> Any:
    """An attribute that is SciPy's once parts of a triangulation were assigned."""
    ours, theirs = getattr(_delaunay.Delaunay, name), getattr(scipy.spatial.Delaunay, name)

    def get(self: Delaunay) -> Any:
        if not self._is_assigned():
            return ours.__get__(self)
        self._refuse_out_of_range(alone=True)
        return theirs.__get__(self)

    return property(get, doc=ours.__doc__)


class Delaunay(WithoutQhull, _delaunay.Delaunay, scipy.spatial.Delaunay, metaclass=InItsPlace):  # type: ignore[misc]
    """A triangulation that is a `scipy.spatial.Delaunay`; see `delone.Delaunay` for all that it has, and `delone.scipy`.

    Examples
    --------
    >>> import delone.scipy as spatial
    >>> tri = spatial.Delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> isinstance(tri, scipy.spatial.Delaunay), len(tri.simplices)
    (True, 2)
    """

    _theirs = scipy.spatial.Delaunay
    _transform = _vertex_to_simplex = _vertex_neighbor_vertices = None

    @or_theirs
    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
    ) -> None:
        """Triangulates points."""
        refuse_options(qhull_options, incremental)
        super().__init__(as_doubles(points), bool(furthest_site), bool(incremental), qhull_options)
        refuse_flat(not self.nsimplex, self.npoints, self.ndim)

    @classmethod
    def _suits(
        cls, points: ArrayLike, furthest_site: bool = False, incremental: bool = False, qhull_options: str | None = None
    ) -> bool:
        is_plane = np.shape(points)[-1:] == (2,)
        return is_ours(points, qhull_options) and (is_plane or not furthest_site)

    @property
    def points(self) -> NDArray[np.float64]:
        """The points given, (npoints, ndim): a copy that may be changed, which changes nothing else."""
        return self._once("points", lambda: np.array(self._core.points))

    def _arrays(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """In space all rows have their corners in the order of indices, so that both sides of a facet name it alike."""
        if self.ndim == 2:
            return super()._arrays()

        def make() -> tuple[NDArray[np.int32], NDArray[np.int32]]:
            simplices, neighbors = super(Delaunay, self)._arrays()
            order = np.argsort(simplices, axis=1)
            return np.take_along_axis(simplices, order, 1), np.take_along_axis(neighbors, order, 1)

        return self._once("arrays in order", make)

    # What may be assigned, and what follows from it.

    simplices = _Shape(lambda self: self._arrays()[0])
    neighbors = _Shape(lambda self: self._arrays()[1])
    equations = _Shape(_delaunay.Delaunay.equations.__get__)
    coplanar = _Shape(lambda self: self._once("coplanar", lambda: _delaunay.Delaunay.coplanar.__get__(self)))
    good = Assignable(lambda self: self._once("good", lambda: _delaunay.Delaunay.good.__get__(self)))
    nsimplex = _Shape(lambda self: len(self.simplices))
    npoints = _Shape(_delaunay.Delaunay.npoints.__get__)
    ndim = _Shape(_delaunay.Delaunay.ndim.__get__)
    min_bound = _Shape(_delaunay.Delaunay.min_bound.__get__)
    max_bound = _Shape(_delaunay.Delaunay.max_bound.__get__)
    furthest_site = Assignable(_delaunay.Delaunay.furthest_site.__get__)
    paraboloid_scale = _Shape(lambda self: _delaunay.Delaunay.paraboloid_scale)
    paraboloid_shift = _Shape(lambda self: _delaunay.Delaunay.paraboloid_shift)

    transform = _following("transform")
    vertex_to_simplex = _following("vertex_to_simplex")
    vertex_neighbor_vertices = _following("vertex_neighbor_vertices")

    def _is_assigned(self) -> bool:
        """Whether the triangulation is another one than that of the points, because parts of it were assigned."""
        return not _SHAPES.isdisjoint(self.__dict__)

    def _refuse_out_of_range(self, *, alone: bool) -> None:
        """A ValueError for arrays that are assigned and do not fit the others, which SciPy's compiled code would follow out of
        memory; `alone` are simplices without what SciPy knows of their neighbors."""
        parts = [self.simplices] if alone else [self.simplices, self.neighbors, self.min_bound, self.max_bound]
        if not all(isinstance(part, np.ndarray) for part in parts):
            # SciPy takes nothing else.
            return
        rows, count, ndim = len(self.simplices), *self.points.shape
        sizes = (self.ndim, self.npoints, self.nsimplex) == (ndim, count, rows)
        if not sizes or self.simplices.shape != (rows, ndim + 1) or not _is_within(self.simplices, 0, count):
            raise ValueError(f"simplices that were assigned must be {self.nsimplex} rows of {ndim + 1} indices of points, int32")
        if alone:
            return
        if np.shape(self.neighbors) != (rows, ndim + 1) or not _is_within(self.neighbors, -1, rows):
            raise ValueError("neighbors must be assigned with simplices: a row for each, of indices of simplices, or -1 for none")
        if np.shape(self.equations) != (rows, ndim + 2):
            raise ValueError(f"equations must be assigned with simplices, of the shape {(rows, ndim + 2)}")
        if not np.shape(self.min_bound) == np.shape(self.max_bound) == (ndim,):
            raise ValueError(f"min_bound and max_bound must have the shape {(ndim,)}")

    @property
    def convex_hull(self) -> NDArray[np.int32]:
        """Facets of the hull, (nfacet, ndim); in space in the order of indices."""
        if self._is_assigned():
            self._refuse_out_of_range(alone=False)
            theirs: NDArray[np.int32] = scipy.spatial.Delaunay.convex_hull.__get__(self)
            return theirs
        facets = super().convex_hull
        return facets if self.ndim == 2 else np.sort(facets, axis=1)

    def find_simplex(self, xi: ArrayLike, bruteforce: bool = False, tol: float | None = None) -> NDArray[np.int32]:
        """The simplices that hold points, as `delone.Delaunay` finds them; after simplices, neighbors or other parts were
        assigned as SciPy does, in what was assigned."""
        rows, shape = as_rows(xi, self.ndim)
        by_force = bool(bruteforce)
        if tol is not None:
            math.fabs(tol)
        if not self._is_assigned():
            return super().find_simplex(rows).reshape(shape)
        self._refuse_out_of_range(alone=False)
        found: NDArray[np.int32] = scipy.spatial.Delaunay.find_simplex(self, rows, by_force, tol)
        return found.reshape(shape)

    def plane_distance(self, xi: ArrayLike) -> NDArray[np.float64]:
        """Distances of lifted points from the planes of all simplices, (..., nsimplex), as `delone.Delaunay` has them."""
        with taken_for_array(xi):
            rows, shape = as_rows(xi, self.ndim)
        with np.errstate(all="ignore"):
            heights = self._lift(rows) @ self.equations[:, :-1].T + self.equations[:, -1]
        return np.asarray(heights).reshape((*shape, self.nsimplex))

    def lift_points(self, x: ArrayLike) -> NDArray[np.float64]:
        """Points on the paraboloid, of any dimension: one more coordinate, the square of the distance from the origin."""
        with taken_for_array(x):
            array = np.asarray(x).astype(np.float64)
            if not array.ndim:
                raise ShapeError(f"x must have coordinates in its last axis; it is no array but {x!r}")
        return self._lift(array)

    def _lift(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        lifted = super()._lift(x)
        if self._is_assigned():
            lifted[..., -1] = lifted[..., -1] * self.paraboloid_scale + self.paraboloid_shift
        return lifted

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, as `delone.Delaunay` does."""
        super().add_points(as_more(points), bool(restart))
        Assignable.forget(self)
        _forget_following(self)


_SHAPES = frozenset(name for name, value in vars(Delaunay).items() if isinstance(value, _Shape))


class Voronoi(WithoutQhull, _voronoi.Voronoi, scipy.spatial.Voronoi, metaclass=InItsPlace):  # type: ignore[misc]
    """A Voronoi diagram that is a `scipy.spatial.Voronoi`; see `delone.Voronoi` for all that it has, and `delone.scipy`.

    Sides up to rounding are contracted, unless `merge` is None or another length.
    """

    _theirs = scipy.spatial.Voronoi

    @or_theirs
    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: float | str | None = "auto",
    ) -> None:
        """Makes the diagram of points."""
        refuse_options(qhull_options, incremental)
        super().__init__(as_doubles(points), bool(furthest_site), bool(incremental), qhull_options, merge=merge)

    @classmethod
    def _suits(
        cls,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: Any = None,
    ) -> bool:
        return Delaunay._suits(points, furthest_site, incremental, qhull_options)

    def _make(self) -> None:
        refuse_flat(not self._tri.nsimplex, self._tri.npoints, self._tri.ndim)
        self.__dict__.pop("_points", None)
        super()._make()

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, as `delone.Voronoi` does."""
        super().add_points(as_more(points), bool(restart))
        Assignable.forget(self)

    regions = Assignable(_voronoi.Voronoi.regions.__get__)
    ridge_vertices = Assignable(_voronoi.Voronoi.ridge_vertices.__get__)
    min_bound = Assignable(_voronoi.Voronoi.min_bound.__get__)
    max_bound = Assignable(_voronoi.Voronoi.max_bound.__get__)

    @property
    def points(self) -> NDArray[np.float64]:
        """The points, (npoints, ndim): a copy that may be changed, which changes nothing else."""
        return self._points

    @cached_property
    def _points(self) -> NDArray[np.float64]:
        return np.array(self._tri.points)


class ConvexHull(WithoutQhull, _hull.ConvexHull, scipy.spatial.ConvexHull, metaclass=InItsPlace):  # type: ignore[misc]
    """A convex hull that is a `scipy.spatial.ConvexHull`; see `delone.ConvexHull` for all that it has, and `delone.scipy`.

    Corners and facets that only rounding has made are no more, unless `merge` is None or another length.
    """

    _theirs = scipy.spatial.ConvexHull

    @or_theirs
    def __init__(
        self,
        points: ArrayLike,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: float | str | None = "auto",
    ) -> None:
        """Finds the hull of points."""
        refuse_options(qhull_options, incremental)
        super().__init__(as_doubles(points), bool(incremental), qhull_options, merge=merge)

    @classmethod
    def _suits(cls, points: ArrayLike, incremental: bool = False, qhull_options: str | None = None, *, merge: Any = None) -> bool:
        return is_ours(points, qhull_options, is_hull=True)

    neighbors = Assignable(_hull.ConvexHull.neighbors.__get__)
    equations = Assignable(_hull.ConvexHull.equations.__get__)
    coplanar = Assignable(_hull.ConvexHull.coplanar.__get__)
    area = Assignable(_hull.ConvexHull.area.__get__)
    volume = Assignable(_hull.ConvexHull.volume.__get__)
    min_bound = Assignable(_hull.ConvexHull.min_bound.__get__)
    max_bound = Assignable(_hull.ConvexHull.max_bound.__get__)

    def _make(self, candidates: NDArray[np.intp] | None) -> None:
        super()._make(candidates)
        refuse_flat(not self._has_body, self.npoints, self.ndim)

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, as `delone.ConvexHull` does."""
        super().add_points(as_more(points), bool(restart))
        Assignable.forget(self)


def tsearch(tri: Any, xi: ArrayLike) -> NDArray[np.int32]:
    """The simplices that hold points: `tri.find_simplex(xi)`."""
    found: NDArray[np.int32] = tri.find_simplex(xi)
    return found
