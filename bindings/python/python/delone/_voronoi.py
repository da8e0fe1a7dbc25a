"""Voronoi diagrams, with the names of scipy.spatial.Voronoi."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._delaunay import Delaunay
from ._merge import as_merge, length_of, merged_centres
from ._options import parse
from ._points import as_flag, as_numbers, as_points


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

    Attributes
    ----------
    vertices : (nvertex, ndim) array
        The circumcentres of the triangulation's simplices, each coordinate the nearest number to the exact one; equal ones once.
    ridge_points : (nridge, 2) array
        The points that each ridge is between.
    ridge_vertices : list of lists
        The vertices of each ridge, in order around it; -1 is infinitely far away.
    regions : list of lists
        The vertices of each region; -1 is infinitely far away. In the plane in order, counter-clockwise. With `Qz` there is
        an empty one first, which is that of no point.
    point_region : (n,) array
        The region of each point, in the order of the points; that of the equal one for duplicates; -1 for points that are
        furthest from nowhere.
    """

    def __init__(
        self,
        points: ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        merge: float | str | None = None,
    ) -> None:
        """Makes the diagram of points."""
        self._merge = as_merge(merge)
        usual = "" if as_flag(incremental, "incremental") else "Qz"
        self._has_empty = parse(qhull_options, usual).at_infinity
        self._tri = Delaunay(points, furthest_site, incremental, qhull_options)
        self._make()

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, whose indices follow those there are, and makes the diagram of all. `restart` is for those who come
        from SciPy: it triangulates anew, which gives the same. RuntimeError after `close`. After Ctrl-C no point was added."""
        made = copy(self)
        made._tri.add_points(points, restart)
        made._make()
        self.__dict__ = made.__dict__

    def close(self) -> None:
        """Ends changes: no points can be added any more."""
        self._tri.close()

    def _make(self) -> None:
        tri = self._tri
        self.ndim, self.npoints = tri.ndim, tri.npoints
        self.min_bound, self.max_bound = tri.min_bound, tri.max_bound
        self.furthest_site = tri.furthest_site
        length = length_of(self._merge, tri.points)
        if length is None:
            self.vertices, self._which = _distinct(tri._centres())
        else:
            centres, kept = merged_centres(tri, length)
            self.vertices, which = _distinct(centres[kept])
            self._which = np.full(len(centres), -1, dtype=np.intp)
            self._which[kept] = which
        self.ridge_points, self._ridge_ends, self._ridge_starts = _ridges(tri, self._which)
        # Lists are made when they are asked for: they cost more than all the rest.
        for lists in ("ridge_vertices", "regions"):
            self.__dict__.pop(lists, None)
        self.point_region = np.arange(tri.npoints, dtype=np.int64) + self._has_empty
        twins = tri.duplicates
        self.point_region[twins[:, 0]] = twins[:, 1] + self._has_empty
        if tri.furthest_site:
            self.point_region[[not self.regions[r] for r in self.point_region]] = -1

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        """The vertices of each ridge."""
        flat: list[Any] = self._ridge_ends.tolist()
        if self._ridge_starts is None:
            return flat
        return [flat[a:b] for a, b in pairwise(self._ridge_starts.tolist())]

    @cached_property
    def regions(self) -> list[list[int]]:
        """The vertices of each region."""
        regions = _regions(self._tri, self._which, self.ridge_points, self._ridge_ends, self._ridge_starts)
        return [[], *regions] if self._has_empty else regions

    @property
    def points(self) -> NDArray[np.float64]:
        """The points, (npoints, ndim)."""
        return self._tri.points

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

        `region` is a polygon of shape (m, 2), or a list of them, the first around the others, which are holes. Without it
        cells are clipped to the box of the points, a twentieth larger. Sides are contracted as `merge` says, and the corners of
        the polygon kept.
        """
        if self.ndim != 2 or self.furthest_site:
            raise NotImplementedError("cells are clipped in the plane, and not those of furthest sites")
        if region is None and not self.npoints:
            return []
        rings = _rings(region, self._tri.min_bound, self._tri.max_bound)
        length = length_of(self._merge, *rings)
        corners, ring_starts, starts = _delone.clipped_cells(self._tri._core, self.npoints, rings, length)
        return _pieces(corners, ring_starts, starts)

    def __copy__(self) -> Voronoi:
        """A diagram of its own of the same points."""
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__dict__, _tri=self._tri.copy())
        return made

    def __repr__(self) -> str:
        """A line that says what there is."""
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
    given: Any = region
    if not isinstance(given, (list, tuple)):
        given = as_numbers(given, "region")
    is_one = given.ndim != 3 if isinstance(given, np.ndarray) else len(given) > 0 and np.ndim(given[0]) < 2
    parts: list[Any] = [given] if is_one else list(given)
    return [as_points(ring, "region", 2) for ring in parts]


def _pieces(
    corners: NDArray[np.float64], ring_starts: NDArray[np.int64], starts: NDArray[np.int64]
) -> list[list[NDArray[np.float64]]]:
    """For each cell its rings."""
    pieces = np.split(corners, ring_starts[1:-1]) if len(ring_starts) > 1 else []
    return [pieces[a:b] for a, b in pairwise(starts.tolist())]


def _distinct(rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """The distinct rows, sorted, and for each row which of them it is."""
    order = np.lexsort(rows.T[::-1])
    in_order = rows[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (in_order[1:] != in_order[:-1]).any(axis=1)
    which = np.empty(len(rows), dtype=np.intp)
    which[order] = np.cumsum(is_new) - 1
    return in_order[is_new], which


def _ridges(tri: Delaunay, which: NDArray[np.intp]) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64] | None]:
    """Pairs of points, and the vertices between them: in the plane two in a row, in space all in one, with where each begins."""
    simplices, neighbors, ndim = tri.simplices, tri.neighbors, tri.ndim
    if not len(simplices):
        return np.empty((0, 2), dtype=np.int32), np.empty((0, 2), dtype=np.int64), None
    vertex_of = np.concatenate([which, [-1]])
    if ndim == 2:
        # An edge is across from a corner; from the smaller of its two triangles.
        rows, corners = np.nonzero((neighbors < 0) | (np.arange(len(simplices))[:, None] < neighbors))
        pairs = np.stack([simplices[rows, (corners + 1) % 3], simplices[rows, (corners + 2) % 3]], axis=1)
        beyond = neighbors[rows, corners]
        vertices = np.stack([vertex_of[np.where(beyond < 0, -1, beyond)], vertex_of[rows]], axis=1)
        # Cocircular points: both sides are one vertex, and there is no ridge.
        real = vertices[:, 0] != vertices[:, 1]
        return np.ascontiguousarray(pairs[real]), vertices[real], None
    pairs, starts, around = _delone.ridges(simplices, neighbors, which.astype(np.int64))
    return pairs, around, starts


def _regions(
    tri: Delaunay,
    which: NDArray[np.intp],
    ridge_points: NDArray[np.int32],
    ridge_ends: NDArray[np.int64],
    ridge_starts: NDArray[np.int64] | None,
) -> list[list[int]]:
    """The vertices of the region of each point; none for duplicates."""
    if not len(ridge_points):
        return [[] for _ in range(tri.npoints)]
    if ridge_starts is not None:
        sites = np.repeat(ridge_points, np.diff(ridge_starts), axis=0).T.ravel()
        # Pairs as one number, which sorts faster; infinity is -1.
        most = int(ridge_ends.max()) + 2
        both = np.sort(sites.astype(np.int64) * most + np.tile(ridge_ends + 1, 2))
        both = both[np.r_[True, both[1:] != both[:-1]]]
        ends = np.searchsorted(both // most, np.arange(tri.npoints + 1)).tolist()
        found = (both % most - 1).tolist()
        return [found[a:b] for a, b in pairwise(ends)]
    return _stars(tri, which)


def _stars(tri: Delaunay, which: NDArray[np.intp]) -> list[list[int]]:
    """In the plane: the vertices of the triangles around each point, counter-clockwise; infinity first where the star is open.

    Neighbours alone say who follows whom. Vertices are rounded, so that different ones may be equal: runs of them are one.
    """
    regions: list[list[int]] = [[] for _ in range(tri.npoints)]
    # Corner k of triangle t is 3 t + k. After it counter-clockwise around its point comes the triangle across from corner k + 1.
    beyond = tri.neighbors[:, [1, 2, 0]]
    opposite = np.empty_like(beyond)
    for k in range(3):
        # Which corner of the triangle across has the same point.
        same = tri.simplices[beyond[:, k]] == tri.simplices[:, k, None]
        opposite[:, k] = same.argmax(axis=1)
    after = np.where(beyond < 0, -1, 3 * beyond + opposite).ravel().tolist()
    points = tri.simplices.ravel().tolist()
    # An open star begins where nothing is clockwise.
    is_first = (tri.neighbors[:, [2, 0, 1]] < 0).ravel()
    starts = np.concatenate([np.flatnonzero(is_first), np.arange(len(points))]).tolist()
    vertex = np.repeat(which, 3).tolist()
    is_open = is_first.tolist()
    for start in starts:
        point = points[start]
        if regions[point]:
            continue
        ring = [-1] if is_open[start] else []
        corner = start
        # No star has more triangles than there are.
        for _ in range(len(tri.simplices)):
            if not ring or ring[-1] != vertex[corner]:
                ring.append(vertex[corner])
            corner = after[corner]
            if corner in (-1, start):
                break
        while len(ring) > 1 and ring[-1] == ring[0]:
            ring.pop()
        regions[point] = ring
    return regions
