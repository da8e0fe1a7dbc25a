"""Diagrams merged within rounding: faces of crystals, cells of lattices, chains of sides."""

from itertools import product

import delone
import numpy as np
import pytest

#: Lattices by their vectors, and the faces of the cell of a point: the Brillouin zones of the reciprocal ones.
LATTICES = {
    "simple cubic": (np.eye(3), 6),
    "face-centered cubic": (np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0]]) / 2, 12),
    "body-centered cubic": (np.array([[-1, 1, 1], [1, -1, 1], [1, 1, -1]]) / 2, 14),
    "hexagonal": (np.array([[1, 0, 0], [-0.5, 3**0.5 / 2, 0], [0, 0, 1.633]]), 8),
}


def turned(random, ndim):
    return np.linalg.qr(random.normal(size=(ndim, ndim)))[0]


@pytest.mark.parametrize("name", LATTICES)
def test_cells_of_crystals_have_their_faces(name):
    basis, expected = LATTICES[name]
    random = np.random.default_rng(5)
    steps = np.array(list(product(range(-2, 3), repeat=3)))
    exact = set()
    for _ in range(25):
        points = steps @ (basis * random.uniform(0.1, 10)) @ turned(random, 3)
        for merge in ("auto", 1e-9, None):
            diagram = delone.Voronoi(points, merge=merge)
            pairs = zip(diagram.ridge_points.tolist(), diagram.ridge_vertices, strict=True)
            faces = [ridge for pair, ridge in pairs if len(points) // 2 in pair]
            if merge is None:
                exact.add(len(faces))
                continue
            assert len(faces) == expected
            assert all(-1 not in ridge and len(set(ridge)) == len(ridge) for ridge in faces)
            assert set(diagram.regions[diagram.point_region[len(points) // 2]]) == set().union(*faces)
    assert max(exact) >= expected


def test_lattices_of_decimals_have_square_cells():
    random = np.random.default_rng(6)
    steps = np.array(list(product(range(12), repeat=2)))
    inside = ((steps > 0) & (steps < 11)).all(axis=1)
    for offset in (0.0, 5e5):
        points = 0.1 * steps @ turned(random, 2) + offset
        diagram = delone.Voronoi(points, merge="auto")
        assert {len(diagram.regions[r]) for r in diagram.point_region[inside]} == {4}
        box = points.min(axis=0) - 1, points.max(axis=0) + 1
        region = np.array([[box[i][0], box[j][1]] for i, j in [(0, 0), (1, 0), (1, 1), (0, 1)]])
        for cells in (diagram.cells(region), delone.OrderVoronoi(points, 1).cells(region, merge="auto")):
            assert sum(len(ring) == 4 for (ring,) in cells) >= 100
        assert max(len(ring) for (ring,) in delone.Voronoi(points).cells(region)) > 4


def test_no_short_side_is_left():
    random = np.random.default_rng(7)
    for ndim in (2, 3):
        points = random.random((300, ndim))
        for merge in (0.0, 0.01, 0.1):
            diagram = delone.Voronoi(points, merge=merge)
            for ridge in diagram.ridge_vertices:
                ends = zip(ridge, [*ridge[1:], ridge[0]], strict=True) if ndim == 3 else [ridge]
                for i, j in ends:
                    if i >= 0 and j >= 0:
                        assert i != j and np.linalg.norm(diagram.vertices[i] - diagram.vertices[j]) > merge
        assert len(delone.Voronoi(points, merge=0.0).vertices) == len(delone.Voronoi(points).vertices)


def test_slivers_of_the_hull_have_no_vertex():
    points = np.array([[0, 0], [1, 0], [2, 1e-14], [3, 0], [1.5, 2.0]])
    exact, merged = delone.Voronoi(points), delone.Voronoi(points, merge="auto")
    assert np.abs(exact.vertices).max() > 1e10 and np.abs(merged.vertices).max() < 10
    pairs = {tuple(pair) for pair in np.sort(merged.ridge_points).tolist()}
    assert pairs == {(0, 1), (1, 2), (2, 3), (0, 4), (1, 4), (2, 4), (3, 4)}
    assert all(-1 in merged.regions[r] for r in merged.point_region[:4])


def test_merge_is_checked():
    points = np.random.default_rng(8).random((9, 2))
    for merge in (-1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="merge must be a length"):
            delone.Voronoi(points, merge=merge)
    for merge in ("much", [1.0], True):
        with pytest.raises(TypeError, match="merge must be"):
            delone.OrderVoronoi(points, 2).cells(merge=merge)
    assert len(delone.Voronoi(np.empty((0, 2)), merge="auto").vertices) == 0
    assert len(delone.Voronoi(points[:2], merge="auto").regions) == 3
