"""Voronoi diagrams of higher order: against brute force, the other diagrams, and what must hold of any."""

from itertools import combinations

import delone
import numpy as np
import pytest

RNG = np.random.default_rng(11)
BOX = np.array([[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]])


def nearest_sets(points, queries, k):
    """The k nearest by integers, of equal distances the lexicographically smallest points."""
    found = []
    for x, y in queries.tolist():
        keys = [((px - x) ** 2 + (py - y) ** 2, px, py, i) for i, (px, py) in enumerate(points.tolist())]
        found.append(sorted(key[-1] for key in sorted(keys)[:k]))
    return found


def area(ring):
    x, y = ring.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@pytest.mark.parametrize("k", [1, 2, 3, 7])
def test_points_are_in_the_region_of_their_nearest(k):
    points = np.unique(RNG.integers(0, 9, (40, 2)), axis=0)
    RNG.shuffle(points)
    diagram = delone.OrderVoronoi(points, k)
    queries = RNG.integers(-3, 12, (500, 2))
    rows = diagram.locate(queries)
    assert rows.dtype == np.int32
    assert diagram.regions[rows].tolist() == nearest_sets(points, queries, k)
    assert diagram.locate(queries.reshape(50, 10, 2)).shape == (50, 10)
    assert diagram.locate(np.empty((0, 2))).shape == (0,)


@pytest.mark.parametrize("k", [1, 2, 5])
def test_circles_are_as_defined(k):
    points = RNG.random((14, 2))
    diagram = delone.OrderVoronoi(points, k)
    expected = {}
    for on in combinations(range(14), 3):
        (ax, ay), (bx, by), (cx, cy) = points[list(on)]
        d = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by))
        squares = [ax**2 + ay**2, bx**2 + by**2, cx**2 + cy**2]
        center = np.array([np.dot(squares, [by - cy, cy - ay, ay - by]), np.dot(squares, [cx - bx, ax - cx, bx - ax])]) / d
        is_nearer = ((points - center) ** 2).sum(axis=1) < ((points[on[0]] - center) ** 2).sum()
        is_nearer[list(on)] = False
        if is_nearer.sum() in (k - 1, k - 2):
            expected[on] = (np.flatnonzero(is_nearer).tolist(), center)
    assert sorted(map(tuple, np.sort(diagram.circles, axis=1).tolist())) == sorted(expected)
    regions = diagram.regions.tolist()
    for on, inside, around, vertex in zip(
        diagram.circles.tolist(), diagram.inside.tolist(), diagram.circle_regions.tolist(), diagram.vertices, strict=True
    ):
        within, center = expected[tuple(sorted(on))]
        assert inside == within + [-1] * (k - 1 - len(within))
        assert np.allclose(vertex, center)
        more = [[v] for v in on] if len(within) == k - 1 else [[v for v in on if v != other] for other in on]
        assert sorted(regions[r] for r in around) == sorted(sorted(within + added) for added in more)


def test_regions_are_as_many_as_proved_and_sorted():
    points = RNG.random((200, 2))
    unbounded = 0
    for k in range(1, 6):
        diagram = delone.OrderVoronoi(points, k)
        count = len(diagram.regions)
        assert count == (2 * k - 1) * 200 - k * k + 1 - unbounded
        assert diagram.regions.dtype == np.int32
        assert diagram.regions.shape == (count, k)
        assert diagram.regions.tolist() == sorted(diagram.regions.tolist())
        assert (np.diff(diagram.regions, axis=1) > 0).all()
        assert diagram.bounded.shape == (count,)
        assert len(diagram.k_sets()) == (~diagram.bounded).sum()
        unbounded += len(diagram.k_sets())
    assert repr(diagram) == f"<delone.OrderVoronoi of order 5: 200 points, {count} regions>"


@pytest.mark.parametrize("k", [1, 2, 4])
@pytest.mark.parametrize("make", [lambda: RNG.random((60, 2)), lambda: RNG.integers(0, 4, (30, 2)) / 3])
def test_cells_tile(k, make):
    diagram = delone.OrderVoronoi(make(), k)
    hole = [[0.2, 0.2], [0.2, 0.6], [0.5, 0.4]]
    for region, whole in [(BOX, 9.0), ([BOX, hole], 9.0 - 0.06), ([[0.5, 0], [1, 0.5], [0, 1]], 0.375)]:
        areas = diagram.areas(region)
        assert areas.shape == (len(diagram.regions),)
        assert abs(areas.sum() - whole) < 1e-9
        cells = diagram.cells(region)
        assert len(cells) == len(areas)
        assert np.allclose([sum(map(area, rings)) for rings in cells], areas, atol=1e-12)
    for row, rings in enumerate(diagram.cells()):
        for ring in rings:
            if area(ring) > 1e-6:
                assert diagram.locate(ring.mean(axis=0)) == row


def test_the_first_and_the_last_order_are_known():
    points = RNG.random((50, 2))
    voronoi, first = delone.Voronoi(points), delone.OrderVoronoi(points, 1)
    assert first.regions.tolist() == [[i] for i in range(50)]
    assert first.inside.shape == (len(first.circles), 0)
    assert np.array_equal(np.unique(first.vertices, axis=0), voronoi.vertices)
    for ours, cell in zip(first.cells(BOX), voronoi.cells(BOX), strict=True):
        assert [sorted(ring.tolist()) for ring in ours] == [sorted(ring.tolist()) for ring in cell]
    last = delone.OrderVoronoi(points, 49)
    missing = {(set(range(50)) - set(sites)).pop() for sites in last.regions.tolist()}
    assert missing == set(np.unique(delone.Delaunay(points).convex_hull).tolist())
    assert not last.bounded.any()
    whole = delone.OrderVoronoi(points, 50)
    assert whole.regions.tolist() == [list(range(50))]
    assert len(whole.circles) == 0
    assert whole.vertices.shape == (0, 2)


def test_equal_and_collinear_points():
    diagram = delone.OrderVoronoi([[0, 0], [0, 0], [3, 0], [1, 0], [3, 0]], 2)
    assert diagram.regions.tolist() == [[0, 3], [2, 3]]
    assert diagram.duplicates.tolist() == [[1, 0], [4, 2]]
    assert not diagram.bounded.any()
    assert diagram.areas([[0, 0], [3, 0], [3, 2], [0, 2]]).tolist() == [3.0, 3.0]
    assert diagram.circles.shape == (0, 3)
    assert delone.OrderVoronoi([[2, 3]], 1).locate([7, 7]) == 0


def test_the_order_of_the_points_does_not_show():
    points = RNG.permutation(np.stack(np.meshgrid(range(6), range(6)), axis=-1).reshape(-1, 2))
    shuffle = RNG.permutation(36)
    one, other = delone.OrderVoronoi(points, 3), delone.OrderVoronoi(points[shuffle], 3)
    assert {frozenset(sites) for sites in one.regions.tolist()} == {frozenset(sites) for sites in shuffle[other.regions].tolist()}


def test_large_sets_are_made_on_other_threads():
    points = RNG.random((30_000, 2))
    diagram = delone.OrderVoronoi(points, 2)
    queries = RNG.random((5_000, 2))
    nearest = np.sort(delone.Delaunay(points).k_nearest(queries, 2), axis=1)
    assert np.array_equal(diagram.regions[diagram.locate(queries)], nearest)
    assert abs(diagram.areas(BOX).sum() - 9) < 1e-8


def test_wrong_arguments_are_named():
    points = [[0, 0], [1, 0], [0, 1], [0, 1]]
    for k in (0, -1, 5, 10**30):
        with pytest.raises(ValueError, match=f"number of points, 4; it is {k}"):
            delone.OrderVoronoi(points, k)
    with pytest.raises(ValueError, match="number of vertices"):
        delone.OrderVoronoi(points, 4)
    with pytest.raises(TypeError, match="k must be an integer"):
        delone.OrderVoronoi(points, 1.5)
    with pytest.raises(ValueError, match="2 coordinates"):
        delone.OrderVoronoi([[0, 0, 0]], 1)
    with pytest.raises(ValueError, match="point 1 has the x coordinate nan"):
        delone.OrderVoronoi([[0, 0], [np.nan, 0]], 1)
    diagram = delone.OrderVoronoi(points, 2)
    with pytest.raises(ValueError, match="not finite"):
        diagram.locate([[np.inf, 0]])
    with pytest.raises(ValueError, match="region"):
        diagram.cells([[0, 0, 0]])
    with pytest.raises(ValueError, match="there is no area inside"):
        diagram.areas([[0, 0], [1, 1]])
