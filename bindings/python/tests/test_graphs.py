"""Proximity graphs, beside SciPy's trees of points and graphs."""

import sys

import delone
import numpy as np
import pytest
from scipy.sparse.csgraph import minimum_spanning_tree
from scipy.spatial import cKDTree
from scipy.spatial.distance import pdist, squareform

rng = np.random.default_rng(7)


def sets():
    lattice = np.stack(np.meshgrid(np.arange(7.0), np.arange(6.0)), axis=-1).reshape(-1, 2)
    yield rng.random((150, 2))
    yield rng.random((100, 3))
    yield lattice
    yield np.concatenate([lattice, lattice[:5]])
    yield np.stack([np.arange(9.0), 2 * np.arange(9.0)], axis=1)
    yield np.zeros((3, 3))
    yield np.empty((0, 2))


def pairs(graph):
    graph = graph.tocoo()
    assert (graph.data > 0).all()
    assert np.isclose(graph.toarray(), graph.toarray().T).all()
    return {(int(i), int(j)) for i, j in zip(*graph.coords, strict=True) if i < j}


def by_definition(points, is_in_the_way):
    first = sorted(np.unique(points, axis=0, return_index=True)[1]) if len(points) else []
    square = ((points[:, None] - points[None]) ** 2).sum(axis=-1)
    free = {
        (int(i), int(j))
        for i in first
        for j in first
        if i < j and not any(is_in_the_way(square[i, j], square[i, k], square[j, k]) for k in first if k not in (i, j))
    }
    return free


@pytest.mark.parametrize("points", list(sets()))
def test_graphs_are_as_defined_and_nested(points):
    gabriel = pairs(delone.gabriel_graph(points))
    relative = pairs(delone.relative_neighborhood_graph(points))
    tree = pairs(delone.euclidean_minimum_spanning_tree(points))
    assert gabriel == by_definition(points, lambda ij, ik, jk: ik + jk <= ij)
    assert relative == by_definition(points, lambda ij, ik, jk: max(ik, jk) < ij)
    assert tree <= relative <= gabriel
    assert pairs(delone.beta_skeleton(points, 1)) == gabriel
    assert pairs(delone.beta_skeleton(points, 2.0)) == relative
    assert relative <= pairs(delone.beta_skeleton(points, 1.5)) <= gabriel
    distinct = len(np.unique(points, axis=0))
    assert len(tree) == max(distinct - 1, 0)
    edges = {tuple(sorted(edge)) for edge in delone.Delaunay(points).edges.tolist()}
    assert gabriel <= edges


@pytest.mark.parametrize("dimension", [2, 3])
def test_trees_are_as_short_as_those_of_scipy(dimension):
    points = rng.random((300, dimension))
    tree = delone.euclidean_minimum_spanning_tree(points)
    expected = minimum_spanning_tree(squareform(pdist(points)))
    assert np.isclose(tree.sum() / 2, expected.sum())
    assert pairs(tree) == {tuple(sorted(edge)) for edge in np.argwhere(expected.toarray()).tolist()}


@pytest.mark.parametrize("k", [0, 1, 4, 1000])
def test_nearest_are_those_of_a_tree_of_points(k):
    points = rng.random((200, 3))
    _, near = cKDTree(points).query(points, min(k + 1, len(points)))
    near = near.reshape(len(points), -1)[:, 1:]
    expected = {(min(i, int(j)), max(i, int(j))) for i in range(len(points)) for j in near[i]}
    assert pairs(delone.knn_graph(points, k)) == expected


def test_arrays_hold_the_same():
    points = rng.random((50, 2))
    heads, tails, weights = delone.gabriel_graph(points, as_arrays=True)
    assert heads.dtype == tails.dtype == np.int64
    assert (np.lexsort((tails, heads)) == np.arange(len(heads))).all()
    graph = delone.gabriel_graph(points).toarray()
    assert (graph[heads, tails] == weights).all()
    assert len(heads) == np.count_nonzero(graph)
    assert np.allclose(weights, np.linalg.norm(points[heads] - points[tails], axis=1))


def test_arrays_need_no_scipy(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    assert len(delone.gabriel_graph([[0, 0], [1, 0]], as_arrays=True)[0]) == 2
    with pytest.raises(ImportError, match="as_arrays"):
        delone.gabriel_graph([[0, 0], [1, 0]])


def test_what_makes_no_sense_is_refused():
    points = rng.random((5, 2))
    for beta in [0.99, -1, float("nan"), float("inf")]:
        with pytest.raises(ValueError, match="beta"):
            delone.beta_skeleton(points, beta)
    with pytest.raises(ValueError, match="negative"):
        delone.knn_graph(points, -1)
    with pytest.raises(TypeError, match="integer"):
        delone.knn_graph(points, 1.5)
    with pytest.raises(ValueError, match="point 1 has the y coordinate"):
        delone.gabriel_graph([[0, 0], [1, np.inf]])
    with pytest.raises(TypeError, match="as_arrays"):
        delone.gabriel_graph(points, as_arrays="yes")


def test_lengths_of_any_size():
    for size in [1e-300, 1e300]:
        points = np.array([[0, 0, 0], [3, 4, 0], [3, 4, 12]]) * size
        tree = delone.euclidean_minimum_spanning_tree(points)
        assert np.allclose(tree.toarray()[[0, 1], [1, 2]] / size, [5, 12])
