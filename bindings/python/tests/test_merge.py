"""Diagrams merged within rounding: faces of crystals, cells of lattices, chains of sides."""

from itertools import product

import delone
import numpy as np
import pytest
from scipy.spatial import Voronoi

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


GOLDEN = (1 + 5**0.5) / 2


def all_signs(*triples):
    """Points by their coordinates in all cyclic orders, with all signs."""
    rolled = [np.roll(triple, k) for triple in triples for k in range(3)]
    return np.unique([sign * p + 0.0 for sign in map(np.array, product((1, -1), repeat=3)) for p in rolled], axis=0)


def signature(diagram):
    """Vertices, and ridges that are more than a line by their points and the places of their vertices."""

    def place(v):
        return None if v < 0 else tuple(np.round(diagram.vertices[v], 6) + 0.0)

    ridges = zip(np.sort(diagram.ridge_points, axis=1).tolist(), diagram.ridge_vertices, strict=True)
    found = {tuple(pair): frozenset(map(place, ridge)) for pair, ridge in ridges}
    return len(diagram.vertices), {pair: places for pair, places in found.items() if len(places) > 2 or None in places}


@pytest.mark.parametrize(
    ("points", "vertices"),
    [
        (all_signs([0, 1, GOLDEN]), 1),
        (all_signs([1, 1, 1], [0, 1 / GOLDEN, GOLDEN]), 1),
        (all_signs([0, 1, 3 * GOLDEN], [1, 2 + GOLDEN, 2 * GOLDEN], [GOLDEN, 2, 2 * GOLDEN + 1]), 1),
        (np.array(list(product((0.1, 0.3), (0.7, 7.5), (-2.2, 0.4)))), 1),
    ],
)
def test_solids_are_those_of_scipy(points, vertices):
    """Pentagons and hexagons are flat but for rounding: slivers of the hull, each with a sphere of its own."""
    random = np.random.default_rng(8)
    for _ in range(5):
        for merge_of, expected in ((points, vertices), (np.vstack([points, points.mean(axis=0)]), None)):
            given = merge_of @ turned(random, 3)
            diagram = delone.Voronoi(given, merge="auto")
            assert expected is None or len(diagram.vertices) == expected
            assert signature(diagram) == signature(Voronoi(given))


@pytest.mark.parametrize("corners", [4, 5, 6, 8])
def test_rings_between_two_spheres_have_no_vertex_of_their_own(corners):
    """Flat tetrahedra inside: their centers are anywhere between those of what is on both sides."""
    angles = 2 * np.pi / corners * np.arange(corners)
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    apexes = [[0, 0, 1.3], [0, 0, -2.1], [0, 0, 6], [0, 0, -7], [8, 0, 0], [-8, 0, 1], [0, 8, 0], [0, -8, 1]]
    random = np.random.default_rng(corners)
    more = 0
    for _ in range(8):
        points = np.vstack([ring, apexes]) @ turned(random, 3)
        assert signature(delone.Voronoi(points, merge="auto")) == signature(Voronoi(points))
        more += len(delone.Voronoi(points).vertices) > len(Voronoi(points).vertices)
    assert more > 4


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
