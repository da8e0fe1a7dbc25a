"""Points near others: as brute force in exact arithmetic has them, as SciPy, and as the triangulation."""

from __future__ import annotations

import pickle
from fractions import Fraction

import delone
import numpy as np
import pytest
from scipy.spatial import KDTree


def ranked(points: np.ndarray, q: np.ndarray) -> list[int]:
    """All points by their exact distance, then lexicographically, then by index."""

    def key(i: int) -> tuple[Fraction, tuple[float, ...], int]:
        away = [Fraction(float(a)) - Fraction(float(b)) for a, b in zip(points[i], q, strict=True)]
        return sum((d * d for d in away), Fraction(0)), tuple(points[i]), i

    return sorted(range(len(points)), key=key)


def sets(ndim: int) -> list[np.ndarray]:
    """Lattices with ties, equal points, spans of numbers, few points."""
    rng = np.random.default_rng(ndim)
    return [
        rng.integers(0, 4, (60, ndim)).astype(float),
        rng.random((80, ndim)),
        np.full((9, ndim), 0.5),
        rng.choice([1e-300, -1e300, 0.0, 1.0, 5e-324, 1e150], (40, ndim)),
        rng.random((1, ndim)),
    ]


@pytest.mark.parametrize("ndim", [2, 3])
def test_answers_are_exact(ndim: int) -> None:
    for points in sets(ndim):
        tree = delone.Neighbors(points)
        rng = np.random.default_rng(7)
        queries = np.concatenate([points[:6], rng.integers(0, 8, (6, ndim)) / 2, rng.random((4, ndim))])
        expected = [ranked(points, q) for q in queries]
        assert tree.nearest(queries).tolist() == [order[0] for order in expected]
        k = 5
        padded = [(order + [-1] * k)[:k] for order in expected]
        assert tree.k_nearest(queries, k).tolist() == padded
        starts, indices = tree.within(queries, 1.5)
        for i, q in enumerate(queries):
            limit = Fraction(1.5) ** 2
            near = [
                j
                for j, p in enumerate(points)
                if sum((Fraction(float(a)) - Fraction(float(b))) ** 2 for a, b in zip(p, q, strict=True)) <= limit
            ]
            assert indices[starts[i] : starts[i + 1]].tolist() == near


@pytest.mark.parametrize("ndim", [2, 3])
def test_many_are_as_scipys_and_the_triangulations(ndim: int) -> None:
    rng = np.random.default_rng(3)
    points, queries = rng.random((30_000, ndim)), rng.random((5_000, ndim))
    tree, theirs, d = delone.Neighbors(points), KDTree(points), delone.Delaunay(points)
    for k in (1, 6):
        distances, indices = tree.query(queries, k)
        other = theirs.query(queries, k)
        assert np.array_equal(indices, other[1])
        assert np.allclose(distances, other[0], rtol=1e-15)
        assert indices.shape == other[1].shape
    assert np.array_equal(tree.nearest(queries), d.nearest(queries))
    assert np.array_equal(tree.k_nearest(queries, 4), d.k_nearest(queries, 4))
    starts, indices = tree.within(queries, 0.02)
    for i in range(0, len(queries), 97):
        assert indices[starts[i] : starts[i + 1]].tolist() == sorted(theirs.query_ball_point(queries[i], 0.02))


def test_shapes_are_those_of_queries() -> None:
    points = np.random.default_rng(1).random((10, 2))
    tree = delone.Neighbors(points)
    assert len(tree) == 10 and tree.ndim == 2 and repr(tree) == "<delone.Neighbors: 10 points, 2D>"
    assert tree.nearest(points.reshape(2, 5, 2)).shape == (2, 5)
    assert tree.k_nearest(points[0], 3).shape == (3,)
    distance, index = tree.query(points[4])
    assert distance == 0.0 and index == 4
    distances, indices = tree.query(points[:2], 12)
    theirs = KDTree(points).query(points[:2], 12)
    assert np.array_equal(indices, theirs[1]) and np.allclose(distances, theirs[0])
    assert tree.within(np.empty((0, 2)), 1.0)[0].tolist() == [0]
    again = pickle.loads(pickle.dumps(tree))
    assert np.array_equal(again.nearest(points), np.arange(10))


def test_there_may_be_none() -> None:
    tree = delone.Neighbors(np.empty((0, 3)))
    assert tree.nearest([[0, 0, 0]]).tolist() == [-1]
    distances, indices = tree.query([0, 0, 0], 2)
    assert distances.tolist() == [np.inf, np.inf] and indices.tolist() == [0, 0]
    assert tree.within([[0, 0, 0]], 5.0)[1].tolist() == []


def test_what_is_wrong_is_named() -> None:
    points = [[0.0, 0.0], [1.0, 1.0]]
    tree = delone.Neighbors(points)
    with pytest.raises(ValueError, match="point 1 has the y coordinate nan"):
        delone.Neighbors([[0, 0], [1, np.nan]])
    with pytest.raises(ValueError, match="2 or 3 coordinates"):
        delone.Neighbors([[0.0]])
    with pytest.raises(ValueError, match="at least 1"):
        tree.k_nearest(points, 0)
    with pytest.raises(TypeError, match="k must be an integer"):
        tree.k_nearest(points, 1.5)
    with pytest.raises(ValueError, match="not finite"):
        tree.nearest([[np.inf, 0]])
    with pytest.raises(ValueError, match="radius"):
        tree.within(points, np.nan)
    with pytest.raises(MemoryError):
        tree.k_nearest(points, 2**50)
    assert tree.within(points, -1.0)[0].tolist() == [0, 0, 0]
