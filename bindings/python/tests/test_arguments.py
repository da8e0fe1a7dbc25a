"""Arguments of all kinds: taken for what NumPy takes them for, or refused by an error that says what is wrong."""

import warnings
from decimal import Decimal
from fractions import Fraction
from itertools import product

import delone
import numpy as np
import pytest

POINTS = np.random.default_rng(0).integers(0, 100, (12, 2)).astype(float)
REFUSED = (TypeError, ValueError, IndexError)
INFINITE = np.finfo(float).max


class Sub(np.ndarray):
    pass


class Arraylike:
    def __array__(self, dtype=None, copy=None):
        return POINTS


def read_only():
    array = POINTS.copy()
    array.flags.writeable = False
    return array


def matrix():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return np.matrix(POINTS)


#: The same points in other clothes.
SAME = {
    "list": POINTS.tolist(),
    "tuples": tuple(map(tuple, POINTS.tolist())),
    "rows": list(POINTS),
    "numpy scalars": [[np.float32(x), np.uint16(y)] for x, y in POINTS],
    "float16": POINTS.astype(np.float16),
    "float32": POINTS.astype(np.float32),
    "longdouble": POINTS.astype(np.longdouble),
    "int64": POINTS.astype(np.int64),
    "uint8": POINTS.astype(np.uint8),
    "every other": np.repeat(POINTS, 2, axis=1)[:, ::2],
    "backwards": POINTS[::-1].copy()[::-1],
    "fortran": np.asfortranarray(POINTS),
    "read-only": read_only(),
    "big-endian": POINTS.astype(">f8"),
    "big-endian int32": POINTS.astype(">i4"),
    "matrix": matrix(),
    "subclass": POINTS.view(Sub),
    "memoryview": memoryview(POINTS),
    "array-like": Arraylike(),
    "objects": POINTS.astype(object),
    "fractions": [[Fraction(x), Fraction(y)] for x, y in POINTS.tolist()],
    "nothing masked": np.ma.masked_array(POINTS, mask=False),
}

#: What is no array of points of the plane.
WRONG = {
    "None": None,
    "text": "abc",
    "bytes": b"abc",
    "bytearray": bytearray(16),
    "number": 2.5,
    "NaN": float("nan"),
    "NumPy number": np.float64(3),
    "complex": 1j,
    "empty list": [],
    "list of None": [None],
    "ragged": [[1, 2], [3]],
    "texts": [["1", "2"], ["3", "4"]],
    "text among numbers": [[1, "2"]],
    "None among numbers": [[1, None]],
    "set": {1, 2},
    "dict": {"a": 1},
    "iterator": iter([[0, 0]]),
    "inexact fractions": [[Fraction(1, 3), 1], [2, 3]],
    "decimals": [[Decimal("1.1"), 1], [2, 3]],
    "complex numbers": POINTS.astype(complex),
    "wide floats": POINTS.astype(np.longdouble) / 3,
    "huge integers": np.array([[2**60, 1], [3, 4]]),
    "huge unsigned": np.array([[2**64 - 1, 1]], dtype=np.uint64),
    "huge int": [[2**70 + 1, 1], [2, 3]],
    "beyond the range": [[10**400, 1], [2, 3]],
    "shape (0,)": np.empty(0),
    "shape (2, 0)": np.empty((2, 0)),
    "shape (3,)": np.zeros(3),
    "shape (5, 1)": np.zeros((5, 1)),
    "shape (5, 4)": np.zeros((5, 4)),
    "NaN inside": np.array([[0, np.nan], [1, 2]]),
    "infinity inside": np.array([[0, 1], [np.inf, 2]]),
    "dates": np.array([["2020-01-01", "2021-01-01"]], dtype="M8[D]"),
    "durations": np.array([[1, 2]], dtype="m8[s]"),
    "structures": np.zeros(3, dtype=[("x", "f8"), ("y", "f8")]),
    "voids": np.zeros((3, 2), dtype="V8"),
    "masked some": np.ma.masked_array(POINTS, mask=POINTS > 50),
    "type": int,
    "module": np,
    "ellipsis": ...,
    "triangulation": delone.Delaunay(POINTS),
}


def calls(x):
    """All that takes points of the plane."""
    tri = delone.Delaunay(POINTS)
    return {
        "Delaunay": lambda: delone.Delaunay(x).simplices,
        "Voronoi": lambda: delone.Voronoi(x).vertices,
        "ConstrainedDelaunay": lambda: delone.ConstrainedDelaunay(x, [[0, 1]]).simplices,
        "insert": lambda: [c := delone.ConstrainedDelaunay(POINTS), c.insert(x), c.points][2],
        "ConvexHull": lambda: delone.ConvexHull(x).simplices,
        "Hints": lambda: delone.Hints(x).triangulate(POINTS).simplices,
        "triangulate": lambda: delone.Hints(POINTS).triangulate(x).simplices,
        "LinearInterpolator": lambda: delone.LinearInterpolator(x, POINTS[:, 0])(POINTS),
        "add_points": lambda: [tri.add_points(x), tri.points][1],
        "Voronoi.add_points": lambda: [v := delone.Voronoi(POINTS), v.add_points(x), v.points][2],
        "ConvexHull.add_points": lambda: [h := delone.ConvexHull(POINTS), h.add_points(x), h.points][2],
        "find_simplex": lambda: tri.find_simplex(x),
        "nearest": lambda: tri.nearest(x),
        "k_nearest": lambda: tri.k_nearest(x, 3),
        "lift_points": lambda: tri.lift_points(x),
        "plane_distance": lambda: tri.plane_distance(x),
        "interpolator": lambda: delone.LinearInterpolator(POINTS, POINTS[:, 0])(x),
    }


@pytest.mark.parametrize("name", SAME)
def test_the_same_points(name):
    expected = calls(POINTS)
    for what, call in calls(SAME[name]).items():
        # A tuple has an array for each coordinate there, as in SciPy.
        if name == "tuples" and "nterpolator" in what:
            continue
        assert np.array_equal(call(), expected[what](), equal_nan=True), what


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_points(name):
    for what, call in calls(WRONG[name]).items():
        # Interpolation rounds, and has no value at NaN; what has one axis are points one after the other, or none.
        rounded = ["wide floats", "huge integers", "huge unsigned", "NaN inside", "infinity inside"]
        if what == "interpolator" and name in [*rounded, "empty list", "shape (0,)", "bytearray"]:
            call()
            continue
        if what == "find_simplex" and name in ("NaN inside", "infinity inside"):
            assert call().tolist().count(-1) >= 1
            continue
        if what == "LinearInterpolator" and name == "triangulation":
            continue
        with pytest.raises(REFUSED) as caught:
            call()
        assert str(caught.value), what


def test_data_frames():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(POINTS, columns=["x", "y"])
    expected = calls(POINTS)
    for what, call in calls(frame).items():
        assert np.array_equal(call(), expected[what](), equal_nan=True), what
    missing = pandas.DataFrame({"x": pandas.array([1, 2], dtype="Int64"), "y": pandas.array([1, None], dtype="Int64")})
    for wrong in (pandas.DataFrame({"x": [1, 2], "y": ["a", "b"]}), missing, frame[["x"]]):
        for call in calls(wrong).values():
            with pytest.raises(REFUSED):
                call()
    tri = delone.Delaunay(frame)
    tri.remove(frame["x"] > 50)
    assert tri.vertex_count == (POINTS[:, 0] <= 50).sum()


def test_extremes():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for size in (INFINITE, 1e300, 1e-300, 5e-324):
            for ndim in (2, 3):
                corners = np.vstack([np.zeros(ndim), np.eye(ndim), -np.eye(ndim)]) * size
                tri, hull, voronoi = delone.Delaunay(corners), delone.ConvexHull(corners), delone.Voronoi(corners)
                assert tri.nsimplex == 2**ndim and hull.nsimplex == 2**ndim and len(voronoi.regions) == 2 * ndim + 2
                assert np.allclose(np.linalg.norm(hull.equations[:, :-1], axis=1), 1)
                unit = delone.ConvexHull(np.sign(corners))
                with np.errstate(over="ignore", under="ignore"):
                    for mine, one, power in [(hull.area, unit.area, ndim - 1), (hull.volume, unit.volume, ndim)]:
                        expected = np.multiply.reduce([np.float64(size)] * power) * one
                        assert np.isclose(mine, expected, rtol=1e-12, atol=1e-323) or (mine, expected) == (np.inf, np.inf)
                tri.equations, tri.transform, tri.plane_distance(corners), tri.convex_hull, tri.vertex_neighbor_vertices
                # In front of all, far and near.
                assert tri.find_simplex(corners / 4).min() >= 0


def test_arguments_that_are_no_points():
    tri = delone.Delaunay(POINTS)
    for wrong in (None, "3", 2.5, 3.0, [3], True, np.True_, np.array([3]), np.float64(3), 1j):
        with pytest.raises(TypeError, match="k must be an integer"):
            tri.k_nearest([0, 0], wrong)
    for wrong in (0, -1, np.int8(-3), -(2**70)):
        with pytest.raises(ValueError, match="at least 1"):
            tri.k_nearest([0, 0], wrong)
    for huge in (2**62, 2**63, 2**64, 2**200):
        with pytest.raises(MemoryError):
            tri.k_nearest([0, 0], huge)
    assert tri.k_nearest([0, 0], np.uint8(2)).shape == tri.k_nearest([0, 0], np.array(2)).shape == (2,)
    flags = {
        "furthest_site": lambda x: delone.Delaunay(POINTS, furthest_site=x),
        "incremental": lambda x: delone.Voronoi(POINTS, incremental=x),
        "restart": lambda x: delone.Delaunay(POINTS).add_points(POINTS, restart=x),
        "rescale": lambda x: delone.LinearInterpolator(POINTS, POINTS[:, 0], rescale=x),
    }
    for (name, call), wrong in product(flags.items(), (None, "no", 2, 0.0, [], np.array([True]), POINTS)):
        with pytest.raises(TypeError, match=f"{name} must be True or False"):
            call(wrong)
    for call, right in product(flags.values(), (True, 0, np.False_, np.int8(1))):
        call(right)
    for wrong in (None, "1", 1j, [1.0], np.zeros(2), POINTS, {}):
        with pytest.raises(TypeError, match="fill_value"):
            delone.LinearInterpolator(POINTS, POINTS[:, 0], fill_value=wrong)
    for wrong in (
        None,
        "a",
        ["a"] * 12,
        np.zeros(11),
        np.zeros((2, 12)),
        5,
        [None] * 12,
        np.ma.array(np.zeros(12), mask=[True] * 12),
    ):
        with pytest.raises(REFUSED):
            delone.LinearInterpolator(POINTS, wrong)
    for wrong in (None, "far", 0, True, ["fill"]):
        with pytest.raises(ValueError, match="outside must be"):
            delone.LinearInterpolator(POINTS, POINTS[:, 0], outside=wrong)
    voronoi = delone.Voronoi(POINTS)
    for wrong in (5, "abc", [], [[]], [[0, 0], [1, 1]], [None], np.zeros((3, 3)), POINTS > 3, 1j, {}, np.zeros(4)):
        with pytest.raises(REFUSED):
            voronoi.cells(wrong)
    square = np.array([[0.0, 0], [100, 0], [100, 100], [0, 100]])
    for right in (square, [square], square[None], square.tolist(), (square.tolist(),), square.astype(np.int8)):
        assert len(voronoi.cells(right)) == 12
    for wrong in (None, POINTS, "x", delone.RegularTriangulation(POINTS)):
        with pytest.raises(TypeError, match="is drawn"):
            delone.plot(wrong)
