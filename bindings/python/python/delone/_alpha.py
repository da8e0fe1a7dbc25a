"""Alpha complexes and alpha shapes, with weights or without."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._points import as_index, as_numbers, as_points


class AlphaComplex:
    """All alpha complexes of points in the plane or in space: every face of their Delaunay triangulation with its value.

    The value of a face is the squared radius from which on balls around its corners meet in it: the squared radius of its
    smallest circumsphere if that is empty, else the least value of the faces that it is a side of. With weights, which are
    squared radii, balls have the squared radius `alpha` plus weight, triangulations are regular ones, and values may be
    negative; a vertex has the negative weight, or more if it is not in its own cell. Gudhi and CGAL define the same. Values are
    correctly rounded, so no face comes before its sides, and infinite where no float is as large.

    Points that equal earlier ones, and those that are hidden by others' weights, are in no face.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    weights : array_like of floats, shape (n,), optional
        The weights, squared radii.

    Attributes
    ----------
    points : (n, ndim) array
        The points.
    weights : (n,) array, or None
        The weights.

    Examples
    --------
    >>> import delone
    >>> complexes = delone.AlphaComplex([[0, 0], [2, 0], [0, 2], [20, 0], [22, 0], [20, 2]])
    >>> complexes.values(2)[:2]
    array([2., 2.])
    >>> [[ring.tolist() for ring in polygon] for polygon in complexes.outline(2.0)]
    [[[0, 1, 2]], [[3, 4, 5]]]
    """

    def __init__(self, points: ArrayLike, weights: ArrayLike | None = None) -> None:
        """Triangulates points, and finds all values."""
        self.points: NDArray[np.float64] = np.array(as_points(points), order="C")
        self.ndim = self.points.shape[1]
        self.weights = None if weights is None else _as_weights(weights, len(self.points))
        self._core = _delone.Alpha(self.points, self.weights)

    def simplices(self, dimension: int) -> NDArray[np.int32]:
        """The faces of a dimension by their corners, increasing indices of points: (count, dimension + 1), in the order of
        the filtration."""
        return self._core.simplices(self._dimension(dimension))

    def values(self, dimension: int) -> NDArray[np.float64]:
        """The values of the faces of a dimension, increasing, in the order of `simplices`."""
        return self._core.values(self._dimension(dimension))

    def filtration(self) -> Iterator[tuple[tuple[int, ...], float]]:
        """All faces with their values, by value, then by dimension, then by corners: each after its sides."""
        sizes = [len(self.values(k)) for k in range(self.ndim + 1)]
        values = np.concatenate([self.values(k) for k in range(self.ndim + 1)])
        dimensions = np.repeat(np.arange(self.ndim + 1), sizes)
        faces = [tuple(face) for k in range(self.ndim + 1) for face in self.simplices(k).tolist()]
        for i in np.lexsort((dimensions, values)).tolist():
            yield faces[i], float(values[i])

    def complex(self, alpha: float) -> list[NDArray[np.int32]]:
        """For each dimension the faces that are there at a squared radius."""
        found = []
        for k in range(self.ndim + 1):
            # None for NaN.
            count = int(np.searchsorted(self.values(k), alpha, side="right")) if alpha == alpha else 0
            found.append(self.simplices(k)[:count])
        return found

    def outline(self, alpha: float) -> Any:
        """The border of the triangles, in space of the tetrahedra, that are there at a squared radius.

        In the plane a list of polygons, each a list of rings of indices of points: an outer one, counter-clockwise, and
        holes, clockwise; a polygon for each part that hangs together across edges. In space closed triangles,
        counter-clockwise seen from outside, of shape (count, 3).

        Examples
        --------
        >>> import delone
        >>> ring = [[x, y] for x in range(5) for y in range(5) if (x, y) != (2, 2)]
        >>> [rings] = delone.AlphaComplex(ring).outline(0.5)
        >>> [len(part) for part in rings]
        [16, 4]
        """
        corners, lengths, counts = self._core.outline(float(alpha))
        if self.ndim == 3:
            return corners.reshape(-1, 3)
        rings = np.split(corners, np.cumsum(lengths)[:-1]) if len(lengths) else []
        ends = np.cumsum(counts).tolist()
        return [rings[end - count : end] for end, count in zip(ends, counts.tolist(), strict=True)]

    def manifold(self, alpha: float) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """The outline in space at a squared radius as a closed surface: where sheets of it touch along an edge or in a vertex,
        each has a copy of it, so every edge has two triangles.

        The point of each vertex, of shape (m,), and triangles as indices of vertices, of shape (count, 3), counter-clockwise seen
        from outside. ValueError in the plane.
        """
        vertices, corners = self._core.manifold(float(alpha))
        return vertices, corners.reshape(-1, 3)

    def components(self, alpha: float) -> NDArray[np.int32]:
        """For each point the number of its component at a squared radius, by their least points; -1 for points that are not
        there."""
        return self._core.components(float(alpha))

    def optimal_alpha(self, parts: int = 1) -> float:
        """The least value at which the triangles, in space the tetrahedra, have every vertex as a corner and are at most so many
        parts, which hang together across sides. ValueError if points span less than the whole.

        Examples
        --------
        >>> import delone
        >>> ring = [[x, y] for x in range(5) for y in range(5) if (x, y) != (2, 2)]
        >>> delone.AlphaComplex(ring).optimal_alpha()
        0.5
        """
        count = as_index(parts, "parts")
        if count < 1:
            raise ValueError(f"parts must be at least 1, not {count}")
        found = self._core.optimal(count)
        if found is None:
            raise ValueError("the points span no shape that has all of them")
        return found

    def spectrum(self) -> NDArray[np.float64]:
        """All values, each once, increasing."""
        return self._core.spectrum()

    def create_simplex_tree(self, max_alpha_square: float = np.inf) -> Any:
        """A `gudhi.SimplexTree` of all faces up to a squared radius, with their values as filtration. ImportError where there
        is no Gudhi."""
        try:
            from gudhi import SimplexTree
        except ImportError as error:
            raise ImportError("create_simplex_tree needs the package gudhi: pip install gudhi") from error
        tree = SimplexTree()
        for k, faces in enumerate(self.complex(max_alpha_square)):
            tree.insert_batch(np.ascontiguousarray(faces.T), self.values(k)[: len(faces)])
        return tree

    def _dimension(self, dimension: int) -> int:
        found = as_index(dimension, "dimension")
        if not 0 <= found <= self.ndim:
            raise ValueError(f"dimension must be from 0 to {self.ndim}, not {found}")
        return found

    def __repr__(self) -> str:
        """A line that says what there is."""
        sizes = ", ".join(str(len(self.values(k))) for k in range(self.ndim + 1))
        return f"<delone.AlphaComplex of {len(self.points)} points: {sizes} faces by dimension>"


def _as_weights(weights: ArrayLike, count: int) -> NDArray[np.float64]:
    """A finite float64 for each point."""
    array = as_numbers(weights, "weights")
    if array.shape != (count,):
        raise ValueError(f"weights must have the shape ({count},), one for each point, not {array.shape}")
    result = np.array(array, dtype=np.float64, order="C")
    if not np.isfinite(result).all():
        index = int(np.argmin(np.isfinite(result)))
        raise ValueError(f"weights: point {index} has the weight {array[index]}, which is not finite")
    return result
