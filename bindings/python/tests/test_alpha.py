"""Alpha complexes: what they are, and beside Gudhi where it is installed."""

import delone
import numpy as np
import pytest

RNG = np.random.default_rng(5)


def lattice(n, ndim):
    return RNG.integers(0, 4, (n, ndim)).astype(float)


def as_dict(complexes):
    return dict(complexes.filtration())


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize("weighted", [False, True])
def test_filtrations_are_monotone_and_complete(ndim, weighted):
    points = RNG.random((200, ndim))
    complexes = delone.AlphaComplex(points, RNG.random(200) / 100 if weighted else None)
    faces = as_dict(complexes)
    for face, value in faces.items():
        for k in range(len(face) if len(face) > 1 else 0):
            assert faces[face[:k] + face[k + 1 :]] <= value
    assert sum((-1) ** (len(face) - 1) for face in faces) == 1
    keys = [(value, len(face), face) for face, value in complexes.filtration()]
    assert keys == sorted(keys)
    for k in range(ndim + 1):
        assert complexes.simplices(k).shape == (len(complexes.values(k)), k + 1)
        assert (np.diff(complexes.values(k)) >= 0).all()
    assert np.array_equal(complexes.spectrum(), np.unique(list(faces.values())))


def test_top_simplices_are_those_of_delaunay():
    points = RNG.random((300, 3))
    top = delone.AlphaComplex(points).simplices(3)
    expected = np.sort(delone.Delaunay(points).simplices, axis=1)
    assert np.array_equal(top[np.lexsort(top.T)], expected[np.lexsort(expected.T)])


def test_outlines_and_parts():
    ring = [[x, y] for x in range(5) for y in range(5) if (x, y) != (2, 2)]
    complexes = delone.AlphaComplex(ring)
    [[outer, hole]] = complexes.outline(0.5)
    assert (len(outer), len(hole)) == (16, 4)
    assert complexes.outline(0.4) == []
    assert complexes.optimal_alpha() == 0.5
    assert (complexes.components(0.25) == 0).all()
    assert complexes.components(0.2).tolist() == list(range(24))
    assert [len(faces) for faces in complexes.complex(0.0)] == [24, 0, 0]
    assert [len(faces) for faces in complexes.complex(float("nan"))] == [0, 0, 0]
    cube = delone.AlphaComplex(np.stack(np.meshgrid(range(3), range(3), range(3)), axis=-1).reshape(-1, 3))
    assert cube.outline(0.75).shape == (48, 3)
    assert cube.outline(0.7).shape == (0, 3)


def test_weights_hide_and_lower():
    complexes = delone.AlphaComplex([[0, 0], [0.1, 0], [9, 0], [0, 9]], [4, 0, 0, 1])
    assert complexes.components(-0.5).tolist() == [0, -1, -1, 1]
    assert complexes.values(0).tolist() == [-4.0, -1.0, 0.0]


def test_wrong_arguments_are_named():
    with pytest.raises(ValueError, match="shape"):
        delone.AlphaComplex([[0, 0]], [1, 2])
    with pytest.raises(ValueError, match="point 1 has the weight inf"):
        delone.AlphaComplex([[0, 0], [1, 0]], [1, np.inf])
    complexes = delone.AlphaComplex([[0, 0], [1, 0]])
    with pytest.raises(ValueError, match="from 0 to 2"):
        complexes.simplices(3)
    with pytest.raises(ValueError, match="span no shape"):
        complexes.optimal_alpha()
    with pytest.raises(ValueError, match="at least 1"):
        complexes.optimal_alpha(0)
    assert [len(values) for values in map(delone.AlphaComplex(np.empty((0, 3))).values, range(4))] == [0] * 4


def test_without_gudhi_the_error_says_so(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "gudhi", None)
    with pytest.raises(ImportError, match="pip install gudhi"):
        delone.AlphaComplex([[0, 0], [1, 0]]).create_simplex_tree()


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("make", [lambda n, ndim: RNG.random((n, ndim)), lattice])
def test_persistence_is_that_of_gudhi(ndim, weighted, make):
    gudhi = pytest.importorskip("gudhi")
    points = np.unique(make(150, ndim), axis=0)
    weights = RNG.random(len(points)) / 50 if weighted else None
    tree = delone.AlphaComplex(points, weights).create_simplex_tree()
    # The same complex: nothing to repair.
    assert not tree.make_filtration_non_decreasing()
    theirs = gudhi.AlphaComplex(points=points, weights=weights, precision="exact").create_simplex_tree()
    diagrams = []
    for one in (tree, theirs):
        one.compute_persistence(homology_coeff_field=2, min_persistence=1e-12)
        diagrams.append([one.persistence_intervals_in_dimension(k) for k in range(ndim)])
    for ours, other in zip(*diagrams, strict=True):
        assert len(ours) == len(other)
        assert np.allclose(ours[np.lexsort(ours.T)], other[np.lexsort(other.T)], rtol=1e-12, atol=1e-12)


def test_manifolds_have_no_pinches():
    points = np.random.default_rng(2).random((80, 3))
    complexes = delone.AlphaComplex(points)
    pinched = 0
    for alpha in np.linspace(0.01, 0.06, 12):
        outline = complexes.outline(alpha)
        vertices, triangles = complexes.manifold(alpha)
        assert np.array_equal(vertices[triangles], outline)

        def sides(corners):
            return np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])

        forth, counts = np.unique(sides(triangles), axis=0, return_counts=True)
        assert counts.max(initial=1) == 1
        assert np.array_equal(forth, np.unique(sides(triangles)[:, ::-1], axis=0))
        pinched += np.unique(sides(outline), axis=0, return_counts=True)[1].max(initial=1) > 1
    assert pinched
    with pytest.raises(ValueError, match="no pinches"):
        delone.AlphaComplex(points[:, :2]).manifold(1.0)
