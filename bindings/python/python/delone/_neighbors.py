"""Points near other points, where no triangulation is wanted."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._errors import restores
from ._points import as_count, as_points, as_queries


class Neighbors:
    """A tree of points in the plane or in space that is asked for those near others, as `scipy.spatial.KDTree`.

    Which point is nearer is exact: of several at the same distance the lexicographically smallest comes first, and of equal
    points the first. `Delaunay.nearest` gives the same answers; where nothing else is wanted of a triangulation, this takes less
    time and memory.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite. There may be none, and equal ones.

    Notes
    -----
    Building takes O(n log n). A query takes O(log n) on average where points are not much further away from it than from each
    other. Many queries are answered on all threads.

    Examples
    --------
    >>> import delone
    >>> tree = delone.Neighbors([[0, 0], [4, 0], [0, 4]])
    >>> tree.nearest([[3, 1], [2, 2]])
    array([1, 0])
    >>> distances, indices = tree.query([3, 0], k=2)
    >>> distances, indices
    (array([1., 3.]), array([1, 0]))
    """

    def __init__(self, points: ArrayLike) -> None:
        """Builds the tree."""
        self._points: NDArray[np.float64] = np.array(as_points(points), order="C")
        self._points.flags.writeable = False
        self._core = _delone.Neighbors(self._points)

    @property
    def points(self) -> NDArray[np.float64]:
        """The points, which cannot be written."""
        return self._points

    @property
    def ndim(self) -> int:
        """The number of coordinates of a point: 2 or 3."""
        return int(self._points.shape[1])

    def __len__(self) -> int:
        """The number of points."""
        return len(self._points)

    def __repr__(self) -> str:
        """In short."""
        return f"<delone.Neighbors: {len(self)} points, {self.ndim}D>"

    def __getstate__(self) -> dict[str, Any]:
        """The points, and what a subclass added; the tree is built again."""
        return {name: value for name, value in self.__dict__.items() if name != "_core"}

    @restores
    def __setstate__(self, state: dict[str, Any]) -> None:
        """Builds the tree of the points."""
        self.__dict__.update(state)
        self._points = as_points(self._points, "points")
        self._points.flags.writeable = False
        self._core = _delone.Neighbors(self._points)

    def nearest(self, xi: ArrayLike) -> NDArray[np.int64]:
        """The nearest points, by their indices. -1 if there are none.

        Examples
        --------
        >>> import delone
        >>> near = delone.Neighbors([[0, 0], [1, 0], [5, 0], [0, 3]])
        >>> near.nearest([[0.9, 0], [4, 1]]).tolist()
        [1, 2]
        """
        queries, shape = as_queries(xi, self.ndim)
        return self._core.nearest(queries).reshape(shape)

    def k_nearest(self, xi: ArrayLike, k: int) -> NDArray[np.int64]:
        """The k nearest points, nearest first, with one more axis than `nearest`; -1 where there are not so many.

        Examples
        --------
        >>> import delone
        >>> near = delone.Neighbors([[0, 0], [1, 0], [5, 0], [0, 3]])
        >>> near.k_nearest([[0.9, 0]], 3).tolist()
        [[1, 0, 3]]
        """
        queries, shape = as_queries(xi, self.ndim)
        k = as_count(k, len(queries))
        return self._core.k_nearest(queries, k).reshape((*shape, k))

    def within(self, xi: ArrayLike, radius: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The points at most `radius` away from each query, border included.

        Returns
        -------
        starts : (m + 1,) array
            Where those of each query start, and where the last ones end; queries in the order of the rows of `xi`.
        indices : array
            The points of query i are ``indices[starts[i]:starts[i + 1]]``, increasing. None for a negative radius.
        """
        queries, _ = as_queries(xi, self.ndim)
        indices, ends = self._core.within(queries, float(radius))
        return np.concatenate([np.zeros(1, np.int64), ends]), indices

    def query(self, x: ArrayLike, k: int = 1) -> tuple[Any, Any]:
        """Distances and indices of the k nearest points, as `scipy.spatial.KDTree.query` gives them.

        The last axis has the k neighbors, nearest first, and is left out for k = 1. Where there are not so many points, the
        distance is infinite and the index is the number of points.

        Examples
        --------
        >>> import delone
        >>> near = delone.Neighbors([[0, 0], [1, 0], [5, 0], [0, 3]])
        >>> distances, indices = near.query([[0, 0]], k=2)
        >>> distances.tolist(), indices.tolist()
        ([[0.0, 1.0]], [[0, 1]])
        """
        queries, shape = as_queries(x, self.ndim)
        k = as_count(k, len(queries))
        distances, indices = self._core.query(self._points, queries, k)
        rows = shape if k == 1 else (*shape, k)
        return distances.reshape(rows)[()], indices.reshape(rows)[()]
