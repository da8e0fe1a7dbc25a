"""Points with weights: what they hide, and what belongs to them."""

import delone
import numpy as np
import pytest
from scipy.spatial import ConvexHull

rng = np.random.default_rng(3)


def lower_hull(points, weights):
    """The simplices of the lower hull of the lifted sites, by Qhull."""
    lifted = np.column_stack([points, (points**2).sum(axis=1) - weights])
    hull = ConvexHull(lifted)
    return {tuple(sorted(map(int, s))) for s in hull.simplices[hull.equations[:, -2] < 0]}


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("scale", [0.0, 0.01, 0.3])
def test_it_is_the_lower_hull_of_lifted_sites(dimension, scale):
    points, weights = rng.random((150, dimension)), scale * rng.random(150)
    tri = delone.RegularTriangulation(points, weights)
    assert {tuple(sorted(s)) for s in tri.simplices.tolist()} == lower_hull(points, weights)
    used = np.unique(tri.simplices)
    assert np.array_equal(np.setdiff1d(np.arange(150), used), tri.hidden)
    queries = rng.random((200, dimension))
    powers = ((queries[:, None] - points[None]) ** 2).sum(axis=-1) - weights
    found = tri.nearest(queries)
    assert np.allclose(powers[np.arange(200), found], powers.min(axis=1))


@pytest.mark.parametrize("dimension", [2, 3])
def test_weights_change(dimension):
    points, weights = rng.random((300, dimension)), 0.02 * rng.random(300)
    tri = delone.RegularTriangulation(points, weights)
    for count in [1, 10, 300]:
        weights = weights.copy()
        weights[rng.choice(300, count, replace=False)] = 0.02 * rng.random(count)
        tri.set_weights(weights)
        anew = delone.RegularTriangulation(points, weights)
        assert sorted(map(sorted, tri.simplices.tolist())) == sorted(map(sorted, anew.simplices.tolist()))
        assert np.array_equal(tri.hidden, anew.hidden)


def test_cells_tile_the_domain():
    points, weights = rng.random((80, 2)), 0.01 * rng.random(80)
    hole = [[0.4, 0.4], [0.4, 0.6], [0.6, 0.6], [0.6, 0.4]]
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    diagram = delone.PowerDiagram(points, weights, [square, hole])
    assert np.isclose(diagram.integrals().sum(), 0.96, rtol=1e-13)
    jacobian = diagram.der_integrals_wrt_weights()
    assert np.allclose(jacobian.toarray(), jacobian.toarray().T)
    assert np.allclose(jacobian.sum(axis=1), 0)
    assert np.array_equal(np.isnan(diagram.centroids()[:, 0]), diagram.integrals() == 0)
    assert (diagram.second_order_moments() >= 0).all()


def test_what_is_wrong_is_named():
    points = [[0, 0], [1, 0], [0, 1]]
    for weights, word in [([1, 2], "shape"), ([1, np.nan, 2], "point 1"), ([[1], [2], [3]], "shape")]:
        with pytest.raises(ValueError, match=word):
            delone.RegularTriangulation(points, weights)
    with pytest.raises(TypeError):
        delone.RegularTriangulation(points, ["a", "b", "c"])
    with pytest.raises(ValueError, match="2 coordinates"):
        delone.PowerDiagram(rng.random((5, 3)))
    empty = delone.RegularTriangulation(np.empty((0, 2)))
    assert empty.nsimplex == 0 and empty.nearest([[0.0, 0.0]]).tolist() == [-1]


def test_prescribed_areas_come_out():
    sites, areas = rng.random((60, 2)), 0.2 + rng.random(60)
    diagram = delone.PowerDiagram(sites, domain=[[-0.5, -0.5], [1.5, -0.5], [1.5, 1.5], [-0.5, 1.5]])
    assert diagram.adjust_weights(areas) <= 1e-9
    assert np.allclose(diagram.integrals(), 4 * areas / areas.sum(), rtol=1e-8)
    anew = delone.PowerDiagram(sites, diagram.weights)
    assert sorted(map(sorted, diagram.simplices.tolist())) == sorted(map(sorted, anew.simplices.tolist()))
    for wrong, word in [([1, 2], "shape"), (np.zeros(60), "site 0"), (np.full(60, np.nan), "site 0")]:
        with pytest.raises(ValueError, match=word):
            diagram.adjust_weights(wrong)
    assert delone.PowerDiagram(np.zeros((0, 2))).adjust_weights() == 0
    with pytest.raises(ValueError, match="site 1 has no cell"):
        delone.PowerDiagram([[0.5, 0.5], [0.5, 0.5]]).adjust_weights()
