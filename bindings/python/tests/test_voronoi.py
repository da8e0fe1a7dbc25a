"""Voronoi diagrams against fractions: every vertex is the nearest number to the exact center, equal centers are one vertex."""

from fractions import Fraction
from itertools import pairwise, product

import delone
import numpy as np
import pytest
import scipy.spatial


def solved(rows, right):
    """The solution of a system of fractions, None where there is not one."""
    n = len(rows)
    m = [[*map(Fraction, row), Fraction(x)] for row, x in zip(rows, right, strict=True)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if m[i][k]), None)
        if pivot is None:
            return None
        m[k], m[pivot] = m[pivot], m[k]
        m[k] = [x / m[k][k] for x in m[k]]
        for i in range(n):
            if i != k:
                m[i] = [x - m[i][k] * y for x, y in zip(m[i], m[k], strict=True)]
    return [row[-1] for row in m]


def center(corners):
    """The exact center of the sphere through corners, rounded once."""
    first, *others = [[Fraction(float(x)) for x in corner] for corner in corners]
    rows = [[2 * (x - y) for x, y in zip(other, first, strict=True)] for other in others]
    right = [sum(x * x for x in other) - sum(x * x for x in first) for other in others]
    exact = solved(rows, right)
    return None if exact is None else tuple(float(x) for x in exact)


def cubic(n, a, offsets=((0, 0, 0),)):
    cells = np.array(list(product(range(n), repeat=3)), dtype=float)
    return np.vstack([a * (cells + np.array(offset) / 2) for offset in offsets])


def fullerene():
    """The corners of a truncated icosahedron, C60."""
    golden = (1 + 5**0.5) / 2
    corners = set()
    for a, b, c in [(0, 1, 3 * golden), (1, 2 + golden, 2 * golden), (golden, 2, 2 * golden + 1)]:
        for signs in product((1, -1), repeat=3):
            x, y, z = (s * v for s, v in zip(signs, (a, b, c), strict=True))
            corners |= {(x + 0.0, y + 0.0, z + 0.0), (y + 0.0, z + 0.0, x + 0.0), (z + 0.0, x + 0.0, y + 0.0)}
    return np.array(sorted(corners))


def icosahedron():
    golden = (1 + 5**0.5) / 2
    turns = [(0.0, s, t * golden) for s in (1, -1) for t in (1, -1)]
    return np.array([p[k:] + p[:k] for p in turns for k in range(3)])


def dodecahedron():
    golden = (1 + 5**0.5) / 2
    turns = [(0.0, s / golden, t * golden) for s in (1, -1) for t in (1, -1)]
    return np.array([*product((1.0, -1.0), repeat=3), *(p[k:] + p[:k] for p in turns for k in range(3))])


SETS = {
    "uniform": np.random.default_rng(1).random((60, 3)),
    "uniform far away": np.random.default_rng(2).random((60, 3)) + np.array([5e5, 4.5e6, 300.0]),
    "fullerene": fullerene(),
    "icosahedron": icosahedron(),
    "dodecahedron": dodecahedron(),
    "bcc of tenths": cubic(3, 0.1, ((0, 0, 0), (1, 1, 1))),
    "fcc of 3.61": cubic(2, 3.61, ((0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 0))),
    "rounded to a hundredth": np.round(np.random.default_rng(3).random((60, 3)), 2),
    "plane": np.random.default_rng(4).random((80, 2)),
    "plane, lattice of tenths": np.array(list(product(range(7), repeat=2))) * 0.1,
}


@pytest.mark.parametrize("name", SETS)
def test_vertices_are_exact_centers_rounded_once(name):
    points = SETS[name]
    diagram = delone.Voronoi(points)
    expected = {center(points[row]) for row in diagram.triangulation.simplices}
    assert None not in expected
    assert len(diagram.vertices) == len(expected)
    assert {tuple(vertex) for vertex in diagram.vertices} == expected


@pytest.mark.parametrize("a", [1.0, 0.1, 0.3, 2.87, 1 / 3])
@pytest.mark.parametrize("low", [(0.0, 0.0, 0.0), (0.1, 0.7, 500_000.3)])
def test_a_box_has_one_vertex(a, low):
    corners = np.array(list(product((0.0, 1.0), repeat=3))) * [a, 2 * a, 3 * a] + low
    # Its corners are exactly on one sphere, whatever was rounded.
    diagram = delone.Voronoi(corners)
    assert diagram.vertices.tolist() == [list(center(corners[[0, 1, 2, 4]]))]
    assert all(-1 in ridge for ridge in diagram.ridge_vertices)


def test_cubes_have_cubes_as_regions():
    diagram = delone.Voronoi(cubic(4, 1.0))
    inner = [r for r in diagram.regions if r and -1 not in r]
    assert len(inner) == 8 and all(len(region) == 8 for region in inner)
    assert len(diagram.vertices) == 27


def rows(starts, items):
    """Lists of rows of which the starts and what is in them are given."""
    assert starts.dtype == items.dtype == np.int64
    assert starts[0] == 0 and starts[-1] == len(items)
    return [items[a:b].tolist() for a, b in pairwise(starts)]


ASKED = [{}, {"furthest_site": True}, {"incremental": True}, {"merge": "auto"}, {"merge": 0.05}]


@pytest.mark.parametrize("asked", ASKED, ids=str)
@pytest.mark.parametrize("name", [*SETS, "equal points", "a line", "nothing", "large"])
def test_rows_are_lists(name, asked):
    sets = {
        "equal points": np.repeat(np.random.default_rng(5).integers(0, 4, (30, 2)).astype(float), 2, axis=0),
        "a line": np.outer(np.arange(5.0), [1.0, 2.0]),
        "nothing": np.empty((0, 2)),
        # As many as are worth threads.
        "large": np.random.default_rng(6).random((21_000, 2)),
    }
    points = sets[name] if name in sets else SETS[name]
    if "furthest_site" in asked and points.shape[1] == 3:
        pytest.skip("in the plane alone")
    diagram = delone.Voronoi(points, **asked)
    assert rows(diagram.ridge_indptr, diagram.ridge_indices) == diagram.ridge_vertices
    assert rows(diagram.region_indptr, diagram.region_indices) == diagram.regions
    assert len(diagram.ridge_vertices) == len(diagram.ridge_points)
    assert len(diagram.regions) == len(points) + ("incremental" not in asked)
    most = len(diagram.vertices)
    assert all(-1 <= v < most for ridge in diagram.ridge_vertices for v in ridge)


@pytest.mark.parametrize("ndim", [2, 3])
def test_rows_are_those_of_scipy(ndim):
    points = np.random.default_rng(ndim).random((2000, ndim))
    ours, theirs = delone.Voronoi(points), scipy.spatial.Voronoi(points)
    # Both have the same vertices but for rounding, ours sorted.
    order = np.lexsort(theirs.vertices.T[::-1])
    assert np.allclose(ours.vertices, theirs.vertices[order], rtol=1e-6, atol=1e-6)
    number = np.append(np.argsort(order), -1)
    mine = zip(ours.ridge_points.tolist(), rows(ours.ridge_indptr, ours.ridge_indices), strict=True)
    others = zip(theirs.ridge_points.tolist(), theirs.ridge_vertices, strict=True)
    expected = {frozenset(pair): frozenset(number[ridge].tolist()) for pair, ridge in others}
    assert {frozenset(pair): frozenset(ridge) for pair, ridge in mine} == expected
    regions = rows(ours.region_indptr, ours.region_indices)
    for point in range(len(points)):
        region = theirs.regions[theirs.point_region[point]]
        assert sorted(regions[ours.point_region[point]]) == sorted(number[region].tolist())


@pytest.mark.parametrize("ndim", [2, 3])
def test_what_is_written_into_arrays_is_looked_at(ndim):
    points = np.random.default_rng(ndim).random((50, ndim))
    diagram = delone.Voronoi(points)
    diagram.ridge_points[3, 0] = 50
    with pytest.raises(IndexError, match="50 is out of bounds for 50"):
        _ = diagram.regions
    triangulation = delone.Delaunay(points)
    triangulation.simplices[7, 1] = -1
    for name in ("transform", "equations", "vertex_to_simplex"):
        with pytest.raises(IndexError, match="-1 is out of bounds for 50"):
            getattr(triangulation, name)
    # Neighbors of something else have no meaning, but an end.
    diagram = delone.Voronoi(points)
    diagram.triangulation.neighbors[:] = np.roll(diagram.triangulation.neighbors, 1)
    assert len(diagram.regions) == 51
