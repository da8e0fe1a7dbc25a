"""Hulls of points that span less, the error that SciPy has for them, and copies of subclasses."""

import copy
import pickle

import delone
import numpy as np
import pytest
import scipy.spatial


def turned(points):
    """Points of the plane x, y in a plane of space that is in no axis."""
    plane = np.array([[1.0, 2.0, 3.0], [-2.0, 1.0, 1.0]])
    return points @ plane


@pytest.mark.parametrize("where", [turned, lambda p: np.insert(p, 1, 7.0, axis=1), lambda p: np.insert(p, 0, 0.0, axis=1)])
def test_a_polygon_in_space_is_that_of_the_plane(where):
    # Whole numbers, so that the points are in one plane exactly.
    points = np.random.default_rng(1).integers(0, 1000, (200, 2)).astype(float)
    known = scipy.spatial.ConvexHull(points)
    flat = where(points)
    hull = delone.ConvexHull(flat, flat="span")
    assert set(hull.vertices.tolist()) == set(known.vertices.tolist()) and hull.simplices.shape == known.simplices.shape
    corners = flat[hull.vertices]
    assert np.isclose(hull.area, np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).sum())
    scale = 1.0 if where is not turned else np.linalg.norm(np.cross([1, 2, 3], [-2, 1, 1]))
    assert np.isclose(hull.volume, known.volume * scale)
    sides = flat @ hull.equations[:, :3].T + hull.equations[:, 3]
    assert sides.max() < 1e-9 and np.allclose(np.linalg.norm(hull.equations[:, :3], axis=1), 1)
    assert np.allclose(np.sort(hull.neighbors, axis=1)[:, 0] >= 0, True)
    # A point more, and it is a body.
    hull.add_points([[1e4, -1e4, 3e4 + 1.5]])
    assert hull.simplices.shape[1] == 3 and hull.volume > 0


def test_lines_and_points():
    line = delone.ConvexHull([[1, 1, 1], [3, 3, 3], [2, 2, 2]], flat="span")
    assert line.vertices.tolist() == [0, 1] and (line.area, line.volume) == (2.0, pytest.approx(2 * 3**0.5))
    assert line.neighbors.tolist() == [[1], [0]]
    plane = delone.ConvexHull([[0, 0], [3, 4], [1.5, 2]], flat="span")
    assert plane.vertices.tolist() == [0, 1] and plane.volume == 5
    point = delone.ConvexHull([[5, 5, 5], [5, 5, 5]], flat="span")
    assert (point.vertices.tolist(), point.nsimplex, point.area, point.volume) == ([0], 0, 0, 0)
    assert point.equations.shape == (0, 4) and point.neighbors.shape == point.simplices.shape
    nothing = delone.ConvexHull(np.empty((0, 2)), flat="span")
    assert len(nothing.vertices) == 0 and nothing.volume == 0
    assert delone.ConvexHull([[0, 0], [1, 1]]).nsimplex == 0


def test_errors_are_those_of_scipy():
    flat = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    with pytest.raises(scipy.spatial.QhullError):
        scipy.spatial.ConvexHull(flat)
    for kind in (scipy.spatial.QhullError, delone.QhullError, ValueError):
        with pytest.raises(kind, match="span less"):
            delone.ConvexHull(flat, flat="raise")
    with pytest.raises(scipy.spatial.QhullError):
        delone.Delaunay(flat, qhull_options="no such option")
    with pytest.raises(ValueError, match="flat must be one of"):
        delone.ConvexHull(flat, flat="other")


@pytest.mark.parametrize("name", ["Delaunay", "Voronoi", "ConvexHull", "Neighbors"])
def test_copies_of_subclasses_are_subclasses(name):
    kind = SUBCLASSES[name]
    made = kind(np.random.default_rng(2).random((30, 2)))
    made.note = ["kept"]
    for made_again in (copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))):
        other = made_again(made)
        assert type(other) is kind and other.note == ["kept"]
        assert np.array_equal(other.points, made.points)
    assert copy.deepcopy(made).note is not made.note


def test_numbers_of_other_kinds():
    points = np.random.default_rng(3).random((20, 2))
    assert np.array_equal(delone.Delaunay(points.astype(object)).points, points)
    with pytest.raises(TypeError, match="astype"):
        delone.Delaunay(np.where(points > 0.9, None, points))
    f = delone.LinearNDInterpolator(points, np.ma.array(points[:, 0]))
    assert np.isclose(f(0.5, 0.5), 0.5) and np.array_equal(f.points, points)
    # As SciPy's griddata calls it.
    assert f(0.5, 0.5) == f((0.5, 0.5), simplex_tolerance=1.0)
    queries = [[[np.nan, 0.5], [0.5, 0.5]], [[np.inf, 0.5], [9, 9]]]
    found = delone.Delaunay(points).find_simplex(queries)
    assert (found >= 0).tolist() == [[False, True], [False, False]]


SUBCLASSES = {
    name: type(f"My{name}", (getattr(delone, name),), {}) for name in ("Delaunay", "Voronoi", "ConvexHull", "Neighbors")
}
globals().update({f"My{name}": kind for name, kind in SUBCLASSES.items()})
for _kind in SUBCLASSES.values():
    _kind.__module__ = __name__
