"""Convex hulls, with the names of scipy.spatial.ConvexHull."""

from __future__ import annotations

from copy import copy
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._cached import cached_property
from ._errors import qhull_error
from ._merge import as_merge, length_of
from ._options import parse
from ._points import as_choice, as_flag, as_points
from ._span import facets_in_span, normals_in_span, sizes_in_span


class ConvexHull:
    """The convex hull of points in the plane or in space, exact. Points that span less have none; see `flat`.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    incremental : bool
        For those who come from SciPy; points can be added either way.
    qhull_options : str, optional
        For those who come from SciPy. `QGn` leaves out point n and marks in `good` the facets that it sees from outside,
        `QG-n` those that it does not; `Qc` asks for `coplanar`. Those about rounding have no effect, others are a QhullError,
        which is a ValueError.
    flat : "empty", "span" or "raise"
        What points are that span less than the plane or space: nothing, the hull in their span, or a QhullError as in SciPy.
        In a plane of space `simplices` are the edges around, `volume` is the area and `area` the perimeter; on a line they are
        the two ends, the length and 2; of a single point there are none. Normals in `equations` are in the span.
    merge : float or "auto", optional
        Leaves out corners within this distance of the hull of the others, in coordinate units, and joins facets in one plane
        within it: points of turned grids and parts are corners by rounding alone. No point is further from the result than
        this. "auto" is 2^-40 of the largest coordinate. Points that are flat within "auto" are flat; a length that leaves
        nothing is a ValueError. Without it the hull is exact.

    Attributes
    ----------
    simplices : (nfacet, ndim) array
        Edges counter-clockwise around, or triangles counter-clockwise seen from outside; flat faces are cut.
    neighbors : (nfacet, ndim) array
        The facets across from each corner.
    vertices : (nvertex,) array
        The corners: in the plane counter-clockwise, in space by index.
    good : (nfacet,) array of booleans, or None
        What `QGn` or `QG-n` asks for, decided exactly: a point in the plane of a facet does not see it. Else None.

    Examples
    --------
    >>> import delone
    >>> hull = delone.ConvexHull([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
    >>> hull.vertices.tolist(), hull.area, hull.volume
    ([0, 1, 2, 3], 16.0, 16.0)
    """

    def __init__(
        self,
        points: ArrayLike,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        flat: Literal["empty", "span", "raise"] = "empty",
        merge: float | str | None = None,
    ) -> None:
        """Finds the hull of points."""
        as_flag(incremental, "incremental")
        self._options = parse(qhull_options, "", is_hull=True)
        self.flat = as_choice(flat, ("empty", "span", "raise"), "flat")
        self._merge = as_merge(merge)
        self._is_closed = False
        self._points: NDArray[np.float64] = np.array(as_points(points), order="C")
        self.ndim = self._points.shape[1]
        if self._options.seen_from is not None and self._options.seen_from >= len(self._points):
            raise qhull_error(f"qhull_options: 'QG{self._options.seen_from}' among {len(self._points)} points")
        self._make(None)

    def _make(self, candidates: NDArray[np.intp] | None) -> None:
        """The hull of some points, which must be that of all; None are all."""
        eye = self._options.seen_from
        self.npoints = len(self._points)
        self._length = length_of(self._merge, self._points)
        # A length that is asked for must leave something.
        may_be_flat = isinstance(self._merge, str)
        if candidates is None and eye is None:
            found = _delone.convex_hull(self._points, self._length, may_be_flat)
            self.simplices: NDArray[np.int32] = found[0]
            corners = found[2]
        else:
            candidates = self._without_eye(np.arange(self.npoints) if candidates is None else candidates)
            found = _delone.convex_hull(self._points[candidates], self._length, may_be_flat)
            self.simplices, corners = (candidates[rows].astype(np.int32) for rows in (found[0], found[2]))
        self._face_of, self._faces = found[1], (corners, found[3])
        if not len(self.simplices) and self.flat != "empty":
            self._flatten()
        self.nsimplex = len(self.simplices)
        self.good: NDArray[np.bool_] | None = None
        if eye is not None and self._has_body:
            is_seen = self._sides(self._points[eye : eye + 1])[0] > 0
            self.good = is_seen if self._options.seen else ~is_seen
        for name in ("vertices", "neighbors", "equations", "area", "volume", "_sizes", "coplanar", "facets"):
            self.__dict__.pop(name, None)

    @property
    def points(self) -> NDArray[np.float64]:
        """The points, (npoints, ndim)."""
        return self._points

    @cached_property
    def facets(self) -> list[NDArray[np.int32]]:
        """The flat facets whole, each as its corners in turn: polygons counter-clockwise seen from outside, in the plane edges.

        `simplices` are their parts. Of points that span less it is what `simplices` has.
        """
        if not self._has_body:
            return list(self.simplices)
        corners, starts = self._faces
        return np.split(corners, starts[1:-1])

    @cached_property
    def vertices(self) -> NDArray[np.int32]:
        """The corners."""
        if not self._has_body:
            single = np.zeros(1 if self.flat == "span" and self.npoints else 0, dtype=np.int32)
            return self.simplices[:, 0] if self.nsimplex else single
        if self.ndim == 2:
            return self.simplices[:, 0].copy()
        return _delone.corners_of(self.npoints, self.simplices)

    @cached_property
    def neighbors(self) -> NDArray[np.int32]:
        """The facets across from each corner."""
        if self.simplices.shape[1] == 1:
            return np.array([[1], [0]], dtype=np.int32)
        return _delone.neighbors_of(self.simplices) if self.nsimplex else np.empty_like(self.simplices)

    @property
    def _has_body(self) -> bool:
        """Whether it has facets of the full dimension."""
        return self.nsimplex > 0 and self.simplices.shape[1] == self.ndim

    def _flatten(self) -> None:
        """The hull in the span of the points, or an error."""
        if self.flat == "raise":
            raise qhull_error(f"{self.npoints} points that span less than {self.ndim} dimensions have no hull")
        if self._options.seen_from is not None:
            raise ValueError('qhull_options: "QG" tells facets of bodies, and flat points have none')
        self.simplices = facets_in_span(self._points, self._length)

    def _without_eye(self, candidates: NDArray[np.intp]) -> NDArray[np.intp]:
        eye = self._options.seen_from
        return candidates if eye is None else candidates[candidates != eye]

    def _sides(self, at: NDArray[np.float64]) -> NDArray[np.int8]:
        """For points a row each with 1 for the facets that see them, 0 for those in whose plane they are."""
        return _delone.sides(self._points[self.simplices].reshape(-1, self.ndim), np.ascontiguousarray(at))

    def add_points(self, points: ArrayLike, restart: bool = False) -> None:
        """Adds points, whose indices follow those there are: the hull of the corners and of these, or with `restart` of all
        points, is found, which gives the same. RuntimeError after `close`. After Ctrl-C no point was added."""
        if self._is_closed:
            raise RuntimeError("closed: no points can be added any more")
        more = as_points(points, columns=self.ndim)
        before = len(self._points)
        # Fewer than a hull takes have no corners.
        is_anew = as_flag(restart, "restart") or not self.nsimplex
        # Merging starts from all corners there are.
        is_anew = is_anew or self._merge is not None
        corners = None if is_anew else np.sort(self.vertices)
        made = copy(self)
        made._points = np.concatenate([self._points, more])
        made._make(None if corners is None else np.concatenate([corners, np.arange(before, len(made._points))]))
        self.__dict__ = made.__dict__

    def close(self) -> None:
        """Ends changes: no points can be added any more."""
        self._is_closed = True

    @property
    def min_bound(self) -> NDArray[np.float64]:
        """The least coordinate of the points along each axis."""
        return np.asarray(self._points.min(axis=0, initial=np.inf))

    @property
    def max_bound(self) -> NDArray[np.float64]:
        """The largest coordinate of the points along each axis."""
        return np.asarray(self._points.max(axis=0, initial=-np.inf))

    @cached_property
    def coplanar(self) -> NDArray[np.int32]:
        """With the option `Qc` the points on the hull that are no corners, equal ones included, each with a facet in whose
        plane it is and the nearest corner of this: (m, 3). Without it none, as in SciPy.

        Triangulates all points, and looks at all facets for each point found.
        """
        if not (self._options.coplanar and self._has_body):
            return np.empty((0, 3), dtype=np.int32)
        candidates = self._without_eye(np.arange(self.npoints))
        core = _delone.Triangulation(self._points[candidates])
        on_hull, twins = np.unique(core.hull()), core.duplicates()
        found = candidates[np.union1d(on_hull, twins[np.isin(twins[:, 1], on_hull), 0])]
        if self._length:
            found = np.union1d(found, candidates[self._is_near(candidates)])
        found = np.setdiff1d(found, self.vertices)
        result = np.empty((len(found), 3), dtype=np.int32)
        for k, point in enumerate(found):
            on = self._sides(self._points[point : point + 1])[0] == 0
            facet = int(on.argmax()) if on.any() else int(self._heights(self._points[point : point + 1])[0].argmax())
            corners = self.simplices[facet]
            away = np.abs(self._points[corners] - self._points[point]).max(axis=1)
            result[k] = point, facet, corners[away.argmin()]
        return result

    def _heights(self, at: NDArray[np.float64]) -> NDArray[np.float64]:
        """Rounded distances from the planes of facets, a row for each point; positive outside."""
        return np.asarray(at @ self.equations[:, :-1].T + self.equations[:, -1])

    def _is_near(self, candidates: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Which points are within the length of a facet's plane."""
        # So many at a time that the distances of all of them fit memory.
        step = max(1, 10**7 // self.nsimplex)
        starts = range(0, len(candidates), step)
        heights = [self._heights(self._points[candidates[k : k + step]]).max(axis=1) for k in starts]
        return np.concatenate(heights) >= -(self._length or 0.0)

    @cached_property
    def equations(self) -> NDArray[np.float64]:
        """Normals of length 1 that point outside, and offsets: (nfacet, ndim + 1)."""
        if not self._has_body and self.nsimplex:
            normals = _unit(normals_in_span(_shrunk(self._points - self._points[0])[0], self.simplices))
            offsets = -(normals * self._points[self.simplices[:, 0]]).sum(axis=1)
            return np.concatenate([normals, offsets[:, None]], axis=1)
        if not self.nsimplex:
            return np.empty((0, self.ndim + 1))
        has_parts = self.nsimplex > len(self._faces[1]) - 1
        return _delone.facet_equations(self._points, self.simplices, self._face_of if has_parts else None)

    def _facet_equations(self) -> NDArray[np.float64]:
        """A row of `equations` for each of `facets`."""
        first = np.unique(self._face_of, return_index=True)[1]
        return self.equations[first]

    @cached_property
    def area(self) -> float:
        """The area of the surface; in the plane the perimeter."""
        return self._sizes[0]

    @cached_property
    def volume(self) -> float:
        """The volume inside; in the plane the area."""
        return self._sizes[1]

    @cached_property
    def _sizes(self) -> tuple[float, float]:
        """Of the border and the inside."""
        return _delone.facet_sizes(self._points, self.simplices) if self._has_body else self._flat_sizes()

    def _flat_sizes(self) -> tuple[float, float]:
        """Of the border and the inside of what has no body."""
        if not self.nsimplex:
            return 0.0, 0.0
        points, power = _shrunk(self._points - self._points[0])
        border, inside = sizes_in_span(points, self.simplices)
        if self.simplices.shape[1] == 1:
            return border, float(_times(inside, power))
        return float(_times(border, power)), float(_times(inside, 2 * power))

    def __repr__(self) -> str:
        """A line that says what there is."""
        return f"<delone.ConvexHull: {len(self.vertices)} vertices, {self.nsimplex} facets>"


def _times(value: float, power: int) -> NDArray[np.float64]:
    """A number times a power of two; infinite beyond the range."""
    with np.errstate(all="ignore"):
        return np.asarray(np.ldexp(value, power))


def _shrunk(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], int]:
    """Numbers divided by the power of two that makes the largest about one; and this power."""
    power = int(np.frexp(np.abs(values).max(initial=0.0))[1])
    return np.ldexp(values, -power), power


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vectors of length 1; squares stay in range."""
    power = np.frexp(np.abs(vectors).max(axis=1, initial=0.0, keepdims=True))[1]
    scaled = np.ldexp(vectors, -power)
    with np.errstate(invalid="ignore"):
        return np.asarray(scaled / np.linalg.norm(scaled, axis=1, keepdims=True))
