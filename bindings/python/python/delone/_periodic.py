"""Triangulations and cells of points in a box that repeats."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._cached import cached_property
from ._points import as_flag, as_numbers, as_points
from ._regular import as_weights


class Faces(NamedTuple):
    """The faces of cells, as the rows of a sparse matrix: those of point i are ``indptr[i]:indptr[i + 1]``.

    An entry is a face that has an area: `indices` is the point beyond it, `offsets` how often each axis of the box is added to
    that, `areas` its area, `vectors` goes from the point to the copy beyond. Both sides of a face have an entry; a point may
    be its own neighbor. Walls of the box have the indices -1 and -2 at the beginning and the end of the first axis, then -3 to
    -6, and NaN as vectors. Faces of cells in the plane are sides, and `areas` are their lengths, which `lengths` names.
    """

    indptr: NDArray[np.int64]
    indices: NDArray[np.int32]
    offsets: NDArray[np.int64]
    areas: NDArray[np.float64]
    vectors: NDArray[np.float64]

    @property
    def lengths(self) -> NDArray[np.float64]:
        """The lengths of sides in the plane; the areas of faces in space."""
        return self.areas

    def filter(self, min_area: float = 0.0, min_relative_area: float = 0.0) -> Faces:
        """The faces that are large enough to be neighbors: of at least `min_area`, in the plane of that length, and of at least
        `min_relative_area` of all areas of their row. Lattices that are no decimals have faces that rounding makes, where more
        than four cells meet in a corner; cells stay as they are.

        Examples
        --------
        >>> import delone
        >>> import numpy as np
        >>> a = [[1, 0, 0], [0.5, 3**0.5 / 2, 0], [0, 0, (8 / 3) ** 0.5]]
        >>> hcp = delone.Voronoi([[0, 0, 0], [0.5, 12**-0.5, (2 / 3) ** 0.5]], box=a)
        >>> np.diff(hcp.nlist.filter(min_relative_area=1e-6).indptr).tolist()
        [12, 12]
        """
        for name, least in (("min_area", min_area), ("min_relative_area", min_relative_area)):
            if not 0 <= least < np.inf:
                raise ValueError(f"{name} must be a number from 0, not {least!r}")
        rows = len(self.indptr) - 1
        of = np.repeat(np.arange(rows), np.diff(self.indptr))
        sums = np.bincount(of, self.areas, rows)
        return self._of((self.areas >= min_area) & (self.areas >= min_relative_area * sums[of]))

    def _of(self, kept: NDArray[np.bool_]) -> Faces:
        before = np.concatenate([[0], np.cumsum(kept)])
        indptr, indices, offsets, areas, vectors = self
        return Faces(before[indptr], indices[kept], offsets[kept], areas[kept], vectors[kept])


class Periodic:
    """The triangulation of points and of all their copies in a box that repeats, in the plane or in space; and the cells.

    It is exact, and does not depend on the order of the points, nor on where the box begins. One point is enough. Of the
    points only their places in the box count: they may be outside of it, and offsets are seen from where they are.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    box : array_like
        The sides of a box; or in space six numbers (lx, ly, lz, xy, xz, yz), as LAMMPS has them for the axes (lx, 0, 0), (xy,
        ly, 0) and (xz, yz, lz), in the plane three (lx, ly, xy); or a matrix with an axis in each row, right-handed.
    periodic : bool or sequence of bool
        Along which axes the box repeats. Along others simplices go on without bounds, and cells end at the walls of the box.
    radii : array_like of floats, shape (n,), optional
        Radii of balls: cells are power cells (radical, Laguerre) then, bounded by radical planes.
    origin : array_like of d floats, optional
        Where the box begins, zeros by default: for the walls.
    grid : "auto" or float, optional
        A step that coordinates are multiples of: crystals of decimals are exact then. "auto" takes the decimals of points and
        box, if they have any within rounding.

    Attributes
    ----------
    simplices, offsets : arrays of shape (m, d + 1) and (m, d + 1, d)
        The points that are corners, in positive order, and how often each axis of the box is added to them: corner k of
        simplex j is at ``points[simplices[j, k]] + offsets[j, k] @ box``. Each simplex stands for all its copies.
    neighbors, neighbor_offsets : arrays of shape (m, d + 1) and (m, d + 1, d)
        The simplex across from each corner, -1 where the triangulation ends, and what is to be added to all its offsets.
    edges, edge_offsets : arrays of shape (k, 2) and (k, d)
        The edges, each once: from a point to a copy of the other one, or of itself.
    duplicates, duplicate_offsets : arrays of shape (k, 2) and (k, d)
        The points that equal a copy of another one, and that copy.
    hidden : array
        The points whose power cell is empty.
    is_simplicial : bool
        Whether points alone name the simplices: no simplex has a point twice, and no two have the same points.
    volumes, areas : arrays of shape (n,)
        Of points in space the volumes of their cells, which add up to that of the box, and the areas of their surfaces. Of
        points in the plane both are the areas of their cells. 0 for duplicates, hidden points, and cells beyond the walls.
    perimeters : array of shape (n,)
        Of points in the plane the lengths of the borders of their cells.
    centroids : array of shape (n, d)
        The centers of mass of the cells; NaN for those without volume.
    nlist : Faces
        The faces between cells, as rows of a sparse matrix.
    faces : Faces
        The same with walls.
    rounding : float
        By how much coordinates of points, and of axes that repeat, were rounded at most, so that copies are exact.
    step : float or None
        The step of the decimal grid, if there is one.

    Raises
    ------
    TypeError, ValueError, MemoryError
        What is wrong with points, box or radii, and where.

    Examples
    --------
    >>> import delone
    >>> import numpy as np
    >>> p = delone.Periodic([[0, 0, 0], [1, 1, 1]], box=[2, 2, 2])
    >>> p.volumes.tolist(), np.diff(p.nlist.indptr).tolist()
    ([4.0, 4.0], [14, 14])
    >>> p.is_simplicial, len(p.simplices)
    (False, 12)
    """

    def __init__(
        self,
        points: ArrayLike,
        box: ArrayLike,
        periodic: bool | Sequence[bool] = True,
        radii: ArrayLike | None = None,
        grid: str | float | None = None,
        origin: ArrayLike | None = None,
    ) -> None:
        """Triangulates points and their copies."""
        self.points = np.array(as_points(points), order="C")
        self.points.flags.writeable = False
        self.npoints, self.ndim = self.points.shape
        self.box = as_box(box, self.ndim)
        self.periodic = as_axes(periodic, self.ndim)
        weights = None if radii is None else _squares(radii, self.npoints)
        self.origin = _as_origin(origin, self.ndim)
        arguments = self.box, self.periodic, self.origin.tolist(), as_step(grid)
        self._core = _delone.Periodic(self.points, weights, *arguments)
        self.rounding, self.step, self._span = self._core.facts()

    @cached_property
    def _arrays(self) -> tuple[NDArray[Any], ...]:
        corners, offsets, neighbors, across = self._core.arrays()
        shape = (-1, self.ndim + 1, self.ndim)
        return corners, offsets.reshape(shape), neighbors, across.reshape(shape)

    @property
    def simplices(self) -> NDArray[np.int32]:
        """The corners of the simplices."""
        return self._arrays[0]

    @property
    def offsets(self) -> NDArray[np.int64]:
        """The offsets of the corners."""
        return self._arrays[1]

    @property
    def neighbors(self) -> NDArray[np.int32]:
        """The simplices across from each corner."""
        return self._arrays[2]

    @property
    def neighbor_offsets(self) -> NDArray[np.int64]:
        """What is to be added to the offsets of neighbors."""
        return self._arrays[3]

    @cached_property
    def _edges(self) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        return self._core.edges()

    @property
    def edges(self) -> NDArray[np.int32]:
        """The points that edges join."""
        return self._edges[0]

    @property
    def edge_offsets(self) -> NDArray[np.int64]:
        """The offsets of their second points."""
        return self._edges[1]

    @cached_property
    def _duplicates(self) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        return self._core.duplicates()

    @property
    def duplicates(self) -> NDArray[np.int32]:
        """The points that equal a copy of another one, each with that."""
        return self._duplicates[0]

    @property
    def duplicate_offsets(self) -> NDArray[np.int64]:
        """The offsets of the copies that they equal."""
        return self._duplicates[1]

    @cached_property
    def hidden(self) -> NDArray[np.int32]:
        """The points whose power cell is empty."""
        return self._core.hidden()

    @cached_property
    def is_simplicial(self) -> bool:
        """Whether points alone name the simplices."""
        return self._core.is_simplicial()

    @cached_property
    def _cells(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], Faces]:
        (volumes, areas, centroids), indptr, (indices, offsets, face_areas, vectors) = self._core.cells()
        return volumes, areas, centroids, Faces(indptr, indices, offsets, face_areas, vectors)

    @property
    def volumes(self) -> NDArray[np.float64]:
        """The volumes of the cells; in the plane their areas."""
        return self._cells[0]

    @property
    def areas(self) -> NDArray[np.float64]:
        """The areas of their surfaces; in the plane those of the cells."""
        return self._cells[1] if self.ndim == 3 else self._cells[0]

    @property
    def perimeters(self) -> NDArray[np.float64]:
        """The lengths of the borders of cells in the plane."""
        if self.ndim == 3:
            raise NotImplementedError("perimeters are those of cells in the plane")
        return self._cells[1]

    @property
    def centroids(self) -> NDArray[np.float64]:
        """Their centers of mass."""
        return self._cells[2]

    @property
    def faces(self) -> Faces:
        """The faces of the cells."""
        return self._cells[3]

    @cached_property
    def nlist(self) -> Faces:
        """The faces between cells."""
        return self.faces._of(self.faces.indices >= 0)

    def polyhedra(self) -> list[tuple[NDArray[np.float64], list[NDArray[np.int64]]]]:
        """The cells as polyhedra: for each point the corners, and the faces as indices of corners, counter-clockwise seen from
        outside, in the order of `faces`. Each is around the point where it was given."""
        starts, corners, ends, numbers = self._core.polyhedra()
        rings = np.split(numbers, ends[1:-1]) if len(ends) > 1 else []
        rows = self.faces.indptr
        both = zip(pairwise(starts), pairwise(rows), strict=True)
        return [(corners[a:b], rings[c:d]) for (a, b), (c, d) in both]

    def polygons(self) -> list[list[NDArray[np.float64]]]:
        """The cells in the plane as polygons: for each point the rings of its cell, counter-clockwise, as `Voronoi.cells` gives
        them: one, but for points without a cell. Each is around the point where it was given."""
        corners, ends, starts = self._core.polygons()
        return pieces(corners, ends, starts)

    def __repr__(self) -> str:
        """A line that says what there is."""
        return f"<delone.Periodic: {self.npoints} points, {len(self.simplices)} simplices>"


def pieces(
    corners: NDArray[np.float64], ring_starts: NDArray[np.int64], starts: NDArray[np.int64]
) -> list[list[NDArray[np.float64]]]:
    """For each cell its rings."""
    rings = np.split(corners, ring_starts[1:-1]) if len(ring_starts) > 1 else []
    return [rings[a:b] for a, b in pairwise(starts.tolist())]


def as_box(box: ArrayLike, ndim: int) -> NDArray[np.float64]:
    """The axes of a box, one a row, from its sides, from these and tilt factors, or from a matrix."""
    array = as_numbers(box, "box").astype(np.float64)
    is_tilted = array.shape == (ndim * (ndim + 1) // 2,)
    if array.shape == (ndim,) or is_tilted:
        for axis, side in enumerate(array[:ndim]):
            if not 0 < side < np.inf:
                raise ValueError(f"box has the side {side} along axis {axis}, counted from 0; it must be positive and finite")
    if array.shape == (ndim,):
        return np.diag(array)
    if is_tilted:
        axes = np.diag(array[:ndim])
        axes[np.tril_indices(ndim, -1)] = array[ndim:]
        return axes
    if array.shape == (ndim, ndim):
        return np.require(array, requirements=["C_CONTIGUOUS", "ALIGNED"])
    of_space = "3 sides, (lx, ly, lz, xy, xz, yz), or a matrix of 3 rows"
    kinds = of_space if ndim == 3 else "2 sides, (lx, ly, xy), or a matrix of 2 rows"
    raise ValueError(f"box must be {kinds} for points of {ndim} coordinates; its shape is {array.shape}")


def as_axes(periodic: bool | Sequence[bool], ndim: int) -> list[bool]:
    """A truth for each axis."""
    if isinstance(periodic, (bool, np.bool_)):
        return [bool(periodic)] * ndim
    if not isinstance(periodic, (Sequence, np.ndarray)) or isinstance(periodic, str):
        raise TypeError(f"periodic must be True, False, or {ndim} of them, one for each axis, not {periodic!r}")
    axes = [as_flag(axis, "periodic") for axis in periodic]
    if len(axes) != ndim:
        raise ValueError(f"periodic must be True, False, or {ndim} of them, one for each axis, not {len(axes)}")
    return axes


def _as_origin(origin: ArrayLike | None, ndim: int) -> NDArray[np.float64]:
    array = np.zeros(ndim) if origin is None else as_numbers(origin, "origin").astype(np.float64)
    if array.shape != (ndim,) or not np.isfinite(array).all():
        raise ValueError(f"origin must be {ndim} finite coordinates, not {origin!r}")
    return array


def as_step(grid: str | float | None) -> float | None:
    """None for no decimal grid, 0 for one to be found, else a step."""
    if grid is None:
        return None
    if isinstance(grid, str):
        if grid == "auto":
            return 0.0
        raise ValueError(f"grid must be 'auto' or a step, not {grid!r}")
    if isinstance(grid, (bool, np.bool_)) or not isinstance(grid, (int, float, np.integer, np.floating)):
        raise TypeError(f"grid must be 'auto' or a step, not {grid!r}")
    step = float(grid)
    if not 0 < step < np.inf:
        raise ValueError(f"grid must be 'auto' or a positive step, not {grid!r}")
    return step


def _squares(radii: ArrayLike, count: int) -> NDArray[np.float64]:
    array = as_weights(radii, count, "radii", "radius")
    if (array < 0).any():
        row = int(np.argmax(array < 0))
        raise ValueError(f"radii: point {row} has the radius {array[row]}, which is negative")
    with np.errstate(over="ignore"):
        squares: NDArray[np.float64] = array * array
    if not np.isfinite(squares).all():
        row = int(np.argmin(np.isfinite(squares)))
        raise ValueError(f"radii: point {row} has the radius {array[row]}, the square of which is beyond the range of float64")
    return squares
