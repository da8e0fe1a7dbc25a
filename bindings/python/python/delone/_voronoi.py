"""Voronoi diagrams, with the names of scipy.spatial.Voronoi."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._cached import cached_property
from ._delaunay import Delaunay
from ._lists import lists
from ._merge import as_merge, length_of, merged_centers
from ._options import parse
from ._periodic import Faces, Periodic, pieces
from ._points import as_flag, as_numbers, as_points
from ._polygons import rings_of_region


class Voronoi:
    """The Voronoi diagram of points in the plane or in space.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    furthest_site : bool
        The diagram of furthest sites; for points of the plane. Only corners of the hull have regions then.
    incremental : bool
        For those who come from SciPy; points can be added either way. See `regions`.
    qhull_options : str, optional
        For those who come from SciPy, where "Qz" is usual unless `incremental`; see `regions`. Options that concern
        rounding have no effect, others are a ValueError.
    merge : float or "auto", optional
        Contracts sides of the diagram up to this length, in coordinate units: vertices that rounding of the points has parted are
        one again, as on lattices of decimals, crystals and rotated grids. Slivers of the hull that are flat within the length
        have their vertex infinitely far away. "auto" is 2^-40 of the largest coordinate. Without it the diagram is exact.
    box, periodic, radii, grid, origin : optional
        A box that cells end at, or that repeats: see `Periodic`, which takes the same. The diagram has `volumes`, `areas`,
        `centroids`, `nlist` and `in_box` then, and not the attributes below; in the plane also `cells()` and `perimeters`.

    Attributes
    ----------
    volumes, areas, perimeters, centroids, nlist :
        Of cells in a box, as `Periodic` has them, which `in_box` is.
    vertices : (nvertex, ndim) array
        The circumcenters of the triangulation's simplices, each coordinate the nearest number to the exact one; equal ones once.
    ridge_points : (nridge, 2) array
        The points that each ridge is between.
    ridge_vertices : list of lists
        The vertices of each ridge, in order around it; -1 is infinitely far away.
    regions : list of lists
        The vertices of each region; -1 is infinitely far away. In the plane in order, counter-clockwise. With `Qz` there is
        an empty one first, which is that of no point.
    ridge_indptr, ridge_indices : arrays of int64
        The vertices of ridge k are ``ridge_indices[ridge_indptr[k]:ridge_indptr[k + 1]]``: rows as in
        a sparse array, the same as `ridge_vertices`, without the time and the memory that lists take.
    region_indptr, region_indices : arrays of int64
        The same of regions, in the order of `regions`.
    point_region : (n,) array
        The region of each point, in the order of the points; that of the equal one for duplicates; -1 for points that are
        furthest from nowhere.

    Examples
    --------
    >>> import delone
    >>> vor = delone.Voronoi([[0, 0], [4, 0], [0, 2], [9, 9]])
    >>> vor.vertices[0].tolist()
    [2.0, 1.0]
    >>> len(vor.ridge_points), len(vor.point_region)
    (5, 4)
    """

    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: float | str | None = None,
        box: ArrayLike | None = None,
        periodic: bool | Sequence[bool] = True,
        radii: ArrayLike | None = None,
        grid: str | float | None = None,
        origin: ArrayLike | None = None,
    ) -> None:
        """Makes the diagram of points."""
        if box is not None:
            if furthest_site or merge is not None:
                raise ValueError("furthest_site and merge are for diagrams without a box: leave them out, or box=")
            self.in_box = Periodic(points, box, periodic, radii, grid, origin)
            self.ndim, self.npoints, self.furthest_site = self.in_box.ndim, self.in_box.npoints, False
            return
        if not (radii is None and grid is None and origin is None and periodic is True):
            raise ValueError("periodic, radii, grid and origin are for points in a box: give box=, or see PowerDiagram")
        self._merge = as_merge(merge)
        usual = "" if as_flag(incremental, "incremental") else "Qz"
        self._has_empty = parse(qhull_options, usual).at_infinity
        self._tri = Delaunay(points, furthest_site, incremental, qhull_options)
        self._make()

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, whose indices follow those there are, and makes the diagram of all. `restart` is for those who come
        from SciPy: it triangulates anew, which gives the same. RuntimeError after `close`. After Ctrl-C no point was added."""
        made = copy(self)
        if "in_box" in self.__dict__:
            raise NotImplementedError("no points can be added to cells in a box: make them anew")
        made._tri.add_points(points, restart)
        made._make()
        self.__dict__ = made.__dict__

    def close(self) -> None:
        """Ends changes: no points can be added any more."""
        if "in_box" not in self.__dict__:
            self._tri.close()

    def _make(self) -> None:
        tri = self._tri
        self.ndim, self.npoints = tri.ndim, tri.npoints
        self.furthest_site = tri.furthest_site
        length = length_of(self._merge, tri.points)
        centers, kept = (tri._centers(), None) if length is None else merged_centers(tri, length)
        made = _delone.voronoi_ridges(*tri._arrays(), centers, kept)
        self.vertices, self._which, self.ridge_points, self.ridge_indptr, self.ridge_indices = made
        # What is made when it is asked for; lists cost more than all the rest.
        for later in ("_rows_of_regions", "ridge_vertices", "regions"):
            self.__dict__.pop(later, None)
        first = int(self._has_empty)
        self.point_region = np.arange(first, tri.npoints + first, dtype=np.int64)
        twins = tri.duplicates
        if len(twins):
            self.point_region[twins[:, 0]] = twins[:, 1] + first
        if tri.furthest_site:
            is_empty = np.diff(self.region_indptr) == 0
            self.point_region[is_empty[self.point_region]] = -1

    @property
    def volumes(self) -> NDArray[np.float64]:
        """The volumes of the cells in the box; in the plane their areas."""
        return self.in_box.volumes

    @property
    def areas(self) -> NDArray[np.float64]:
        """The areas of their surfaces; in the plane those of the cells."""
        return self.in_box.areas

    @property
    def perimeters(self) -> NDArray[np.float64]:
        """The lengths of the borders of cells in the plane."""
        return self.in_box.perimeters

    @property
    def centroids(self) -> NDArray[np.float64]:
        """Their centers of mass."""
        return self.in_box.centroids

    @property
    def nlist(self) -> Faces:
        """The faces between them."""
        return self.in_box.nlist

    def __getattr__(self, name: str) -> Any:
        """Names what there is in a box alone, and what there is not."""
        if name in {"in_box", "volumes", "areas", "perimeters", "centroids", "nlist"}:
            raise AttributeError(f"{name} is for cells in a box: give box=")
        made = {"_tri", "vertices", "ridge_points", "ridge_indptr", "ridge_indices", "point_region"}
        if "in_box" in self.__dict__ and (name in made or hasattr(type(self), name)):
            name = name.strip("_")
            raise AttributeError(f"cells in a box have no {name}: see in_box, its nlist, polyhedra() and polygons()")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        """The vertices of each ridge."""
        return lists(self.ridge_indptr, self.ridge_indices)

    @cached_property
    def regions(self) -> list[list[int]]:
        """The vertices of each region."""
        return lists(*self._rows_of_regions)

    @property
    def region_indptr(self) -> NDArray[np.int64]:
        """Where the vertices of each region start, and where the last ones end."""
        return self._rows_of_regions[0]

    @property
    def region_indices(self) -> NDArray[np.int64]:
        """The vertices of all regions."""
        return self._rows_of_regions[1]

    @cached_property
    def _rows_of_regions(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        simplices, neighbors = self._tri._arrays()
        ridges = self.ridge_points, self.ridge_indptr, self.ridge_indices
        return _delone.voronoi_regions(self.npoints, self._has_empty, simplices, neighbors, self._which, *ridges)

    @property
    def min_bound(self) -> NDArray[np.float64]:
        """The least coordinate of the points along each axis."""
        return self.points.min(axis=0) if "in_box" in self.__dict__ else self._tri.min_bound

    @property
    def max_bound(self) -> NDArray[np.float64]:
        """The largest coordinate of the points along each axis."""
        return self.points.max(axis=0) if "in_box" in self.__dict__ else self._tri.max_bound

    @property
    def points(self) -> NDArray[np.float64]:
        """The points, (npoints, ndim)."""
        return self.in_box.points if "in_box" in self.__dict__ else self._tri.points

    @property
    def triangulation(self) -> Delaunay:
        """The Delaunay triangulation of the points."""
        return self._tri

    @property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        """Vertices of ridges by pairs of points."""
        return {(p, q): v for (p, q), v in zip(self.ridge_points.tolist(), self.ridge_vertices, strict=True)}

    def cells(self, region: ArrayLike | Sequence[ArrayLike] | None = None) -> list[list[NDArray[np.float64]]]:
        """The cells of all points of the plane, clipped: for each point the rings of its cell, counter-clockwise, holes
        clockwise; none for duplicates.

        `region` is a polygon of shape (m, 2), or a list of them, the first around the others, which are holes; a polygon of
        shapely or GeoJSON, or a column of them; or a box of four numbers, the least x and y and the largest. Without it
        cells are clipped to the box of the points, a twentieth larger. Cells in a box are those of `Periodic.polygons`,
        and take no region. Sides are contracted as `merge` says, and the corners of
        the polygon kept.

        Examples
        --------
        >>> import delone
        >>> first, second = delone.Voronoi([[1, 1], [3, 1]]).cells((0, 0, 4, 2))
        >>> len(first), first[0].tolist()
        (1, [[2.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0]])
        """
        if "in_box" in self.__dict__:
            if region is not None:
                raise ValueError("cells in a box end at its walls: leave region out")
            return self.in_box.polygons()
        if self.ndim != 2 or self.furthest_site:
            raise NotImplementedError("cells are clipped in the plane, and not those of furthest sites")
        if region is None and not self.npoints:
            return []
        rings = _rings(region, self._tri.min_bound, self._tri.max_bound)
        length = length_of(self._merge, *rings)
        corners, ring_starts, starts = _delone.clipped_cells(self._tri._core, self.npoints, rings, length)
        return pieces(corners, ring_starts, starts)

    def __copy__(self) -> Voronoi:
        """A diagram of its own of the same points."""
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__dict__)
        if "in_box" not in self.__dict__:
            made._tri = self._tri.copy()
        return made

    def __repr__(self) -> str:
        """A line that says what there is."""
        if "in_box" in self.__dict__:
            return f"<delone.Voronoi: {self.npoints} points in a box>"
        return f"<delone.Voronoi: {self.npoints} points, {len(self.vertices)} vertices, {len(self.ridge_points)} ridges>"


def _rings(
    region: ArrayLike | Sequence[ArrayLike] | None, low: NDArray[np.float64], high: NDArray[np.float64]
) -> list[NDArray[np.float64]]:
    """The rings of a polygon, or of a box of points that is a twentieth larger."""
    if region is None:
        most = np.finfo(np.float64).max
        with np.errstate(over="ignore"):
            margin = max(float((high - low).max()) / 20, float(np.abs(high).max()) * 1e-9, 1e-300)
            (x0, y0), (x1, y1) = np.maximum(low - margin, -most), np.minimum(high + margin, most)
        return [np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])]
    rings = rings_of_region(region)
    if rings is not None:
        return [as_points(ring, "region", 2) for ring in rings]
    given: Any = region
    if not isinstance(given, (list, tuple)):
        given = as_numbers(given, "region")
    is_one = given.ndim != 3 if isinstance(given, np.ndarray) else len(given) > 0 and np.ndim(given[0]) < 2
    parts: list[Any] = [given] if is_one else list(given)
    return [as_points(ring, "region", 2) for ring in parts]
