"""Triangulations, Voronoi diagrams and hulls that are SciPy's too."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.spatial
from numpy.typing import ArrayLike, NDArray

from .. import _delaunay, _hull, _voronoi
from .._cached import cached_property
from ._place import Assignable, InItsPlace, WithoutQhull, as_doubles, is_ours, or_theirs, refuse_flat


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

    @or_theirs
    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
    ) -> None:
        """Triangulates points."""
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

    simplices = Assignable(lambda self: self._arrays()[0])
    neighbors = Assignable(lambda self: self._arrays()[1])
    equations = Assignable(lambda self: _delaunay.Delaunay.equations.__get__(self))
    coplanar = Assignable(lambda self: self._once("coplanar", lambda: _delaunay.Delaunay.coplanar.__get__(self)))
    good = Assignable(lambda self: self._once("good", lambda: _delaunay.Delaunay.good.__get__(self)))
    nsimplex = Assignable(lambda self: len(self.simplices))

    @property
    def convex_hull(self) -> NDArray[np.int32]:
        """Facets of the hull, (nfacet, ndim); in space in the order of indices."""
        facets = super().convex_hull
        return facets if self.ndim == 2 else np.sort(facets, axis=1)

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, as `delone.Delaunay` does."""
        super().add_points(as_doubles(points), restart)
        Assignable.forget(self)


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
        super().add_points(as_doubles(points), restart)

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
        super().__init__(as_doubles(points), bool(incremental), qhull_options, merge=merge)

    @classmethod
    def _suits(cls, points: ArrayLike, incremental: bool = False, qhull_options: str | None = None, *, merge: Any = None) -> bool:
        return is_ours(points, qhull_options, is_hull=True)

    def _make(self, candidates: NDArray[np.intp] | None) -> None:
        super()._make(candidates)
        refuse_flat(not self._has_body, self.npoints, self.ndim)

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, as `delone.ConvexHull` does."""
        super().add_points(as_doubles(points), restart)


def tsearch(tri: Any, xi: ArrayLike) -> NDArray[np.int32]:
    """The simplices that hold points: `tri.find_simplex(xi)`."""
    found: NDArray[np.int32] = tri.find_simplex(xi)
    return found
