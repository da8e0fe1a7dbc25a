"""Proximity graphs: who is near whom."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._points import as_flag, as_index, as_points

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Arrays: TypeAlias = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]


def gabriel_graph(points: ArrayLike, *, as_arrays: bool = False) -> csr_array | Arrays:
    """The Gabriel graph: pairs of points whose closed disk (ball) with both on a diameter holds no other point.

    Exact, and the same for any order of the points: on every set the spanning tree is part of the relative neighbors, these of
    the Gabriel graph, and that of the Delaunay triangulation. Of equal points the first has the edges.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    as_arrays : bool
        Whether arrays are wanted, for which SciPy is not needed.

    Returns
    -------
    csr_array of shape (n, n)
        Symmetric, with the distances of neighbors.
    (heads, tails, weights)
        With `as_arrays`: every edge in both directions with its length, sorted by heads, then by tails: as
        `libpysal.graph.Graph.from_arrays` takes it.

    Examples
    --------
    >>> import delone
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> heads, tails, lengths = delone.gabriel_graph(square, as_arrays=True)  # both ways
    >>> len(heads) // 2, float(lengths.sum() / 2)
    (4, 4.0)
    """
    return _graph(points, "gabriel", 0.0, as_arrays)


def relative_neighborhood_graph(points: ArrayLike, *, as_arrays: bool = False) -> csr_array | Arrays:
    """The relative neighbors: pairs to which no point is nearer, strictly and from both, than they are to each other.

    Parameters and results as for `gabriel_graph`.

    Examples
    --------
    >>> import delone
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> heads, tails, lengths = delone.relative_neighborhood_graph(square, as_arrays=True)  # both ways
    >>> len(heads) // 2, float(lengths.sum() / 2)
    (4, 4.0)
    """
    return _graph(points, "relative neighbors", 0.0, as_arrays)


def euclidean_minimum_spanning_tree(points: ArrayLike, *, as_arrays: bool = False) -> csr_array | Arrays:
    """The Euclidean minimum spanning tree; of edges of one length those at lexicographically smaller points are taken.

    Parameters and results as for `gabriel_graph`.

    Examples
    --------
    >>> import delone
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> heads, tails, lengths = delone.euclidean_minimum_spanning_tree(square, as_arrays=True)  # both ways
    >>> len(heads) // 2, float(lengths.sum() / 2)
    (3, 3.0)
    """
    return _graph(points, "spanning tree", 0.0, as_arrays)


def beta_skeleton(points: ArrayLike, beta: float, *, as_arrays: bool = False) -> csr_array | Arrays:
    """The skeleton of lunes: pairs whose lune holds no other point, the meeting of two disks of radius beta/2 times their
    distance, each with one of both on its border and its center on the ray from there through the other one.

    For `beta` 1 the lune is closed: the Gabriel graph. Above it is open: 2 gives the relative neighbors, and a larger `beta`
    part of the edges of a smaller one. Below 1, where a skeleton is no part of the triangulation, it is a ValueError.
    Other parameters and results as for `gabriel_graph`.

    Examples
    --------
    >>> import delone
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> heads, tails, lengths = delone.beta_skeleton(square, 1.5, as_arrays=True)  # both ways
    >>> len(heads) // 2, float(lengths.sum() / 2)
    (4, 4.0)
    """
    return _graph(points, "beta", float(beta), as_arrays)


def knn_graph(points: ArrayLike, k: int, *, as_arrays: bool = False) -> csr_array | Arrays:
    """Pairs of which one is among the `k` points nearest to the other; of equally near ones the lexicographically smaller.

    It is symmetric, so points may have more than `k` neighbors. Other parameters and results as for `gabriel_graph`.

    Examples
    --------
    >>> import delone
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> heads, tails, lengths = delone.knn_graph(square, 2, as_arrays=True)  # both ways
    >>> len(heads) // 2, float(lengths.sum() / 2)
    (4, 4.0)
    """
    k = as_index(k, "k")
    if k < 0:
        raise ValueError(f"k must not be negative, but is {k}")
    return _graph(points, "nearest", float(min(k, 2**53)), as_arrays)


def _graph(points: ArrayLike, kind: str, parameter: float, as_arrays: bool) -> csr_array | Arrays:
    as_arrays = as_flag(as_arrays, "as_arrays")
    at = as_points(points)
    edges = _delone.proximity_graph(at, kind, parameter)
    with np.errstate(over="ignore", under="ignore"):
        along = at[edges[:, 0]] - at[edges[:, 1]]
        lengths = np.hypot.reduce(along, axis=1)
    heads, tails = np.concatenate([edges, edges[:, ::-1]]).T
    weights = np.concatenate([lengths, lengths])
    if as_arrays:
        order = np.lexsort((tails, heads))
        return heads[order], tails[order], weights[order]
    try:
        from scipy.sparse import csr_array
    except ImportError as error:
        raise ImportError("sparse arrays are SciPy's: install it, or ask for as_arrays=True") from error
    return csr_array((weights, (heads, tails)), shape=(len(at), len(at)))
