"""delone.scipy: wrong calls raise what they raise in SciPy."""

import types

import delone.scipy as spatial
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

NAMES = ["Delaunay", "Voronoi", "ConvexHull", "HalfspaceIntersection", "tsearch", "QhullError"]
THEIRS = types.SimpleNamespace(
    **{name: getattr(scipy.spatial, name) for name in NAMES},
    **{name: getattr(scipy.interpolate, name) for name in ("LinearNDInterpolator", "CloughTocher2DInterpolator", "griddata")},
)
RANDOM = np.random.default_rng(53)
P = RANDOM.random((20, 2))
Q = RANDOM.random((20, 3))
V = RANDOM.random(20)
BOX = np.array([[1.0, 0, -1], [-1, 0, -1], [0, 1, -1], [0, -1, -1]])
CENTRE = np.zeros(2)
NAN = np.where(np.arange(20)[:, None] == 3, np.nan, P)
INF = np.where(np.arange(20)[:, None] == 3, np.inf, P)
MASKED = np.ma.array(P, mask=P > 0.9)


class Odd:
    """What is no number."""


def assigned(tri, **parts):
    for name, value in parts.items():
        setattr(tri, name, value)
    return tri


def grown(s, kind=None, **options):
    return getattr(s, kind or "Delaunay")(P, incremental=True, **options)


#: The shape of points is wrong, or there are not enough.
SHAPES = {
    "nothing": lambda s, kind: kind([]),
    "no coordinates": lambda s, kind: kind(np.empty((5, 0))),
    "one coordinate": lambda s, kind: kind(P[:, :1]),
    "a number": lambda s, kind: kind(1.0),
    "None": lambda s, kind: kind(None),
    "an object": lambda s, kind: kind(Odd()),
    "objects": lambda s, kind: kind([[Odd(), Odd()]] * 4),
    "a dictionary": lambda s, kind: kind({1: 2}),
    "a set": lambda s, kind: kind({1, 2}),
    "a string": lambda s, kind: kind("points"),
    "bytes": lambda s, kind: kind(b"points"),
    "strings": lambda s, kind: kind([["a", "b"]] * 4),
    "nones": lambda s, kind: kind([[None, None]] * 4),
    "ragged": lambda s, kind: kind([[1, 2], [3]]),
    "dates": lambda s, kind: kind(np.full((4, 2), "nat", dtype="datetime64[s]").astype("V8")),
    "NaN": lambda s, kind: kind(NAN),
    "infinite": lambda s, kind: kind(INF),
    "masked": lambda s, kind: kind(MASKED),
    "two": lambda s, kind: kind(P[:2]),
    "equal": lambda s, kind: kind(np.ones((9, 2))),
    "on a line": lambda s, kind: kind(np.repeat(V, 2).reshape(-1, 2)),
    "options 3": lambda s, kind: kind(P, qhull_options=3),
    "options list": lambda s, kind: kind(P, qhull_options=["Qt"]),
    "options unknown": lambda s, kind: kind(P, qhull_options="Nonsense"),
    "Qz for more": lambda s, kind: kind(P, incremental=True, qhull_options="Qz"),
    "Qbb for more": lambda s, kind: kind(P, incremental=True, qhull_options="Qt Qbb"),
    "seen from nowhere": lambda s, kind: kind(P, qhull_options="QG99"),
    "no arguments": lambda s, kind: kind(),
    "too many arguments": lambda s, kind: kind(P, False, False, None, None, None),
    "an unknown name": lambda s, kind: kind(P, nonsense=1),
    "many flags": lambda s, kind: kind(P, incremental=np.array([True, False])),
}

#: Points that are added.
ADDED = {
    "strings": [["a", "b"]],
    "NaN": [[np.nan, 0.5]],
    "infinite": [[np.inf, 0.5]],
    "None": None,
    "a number": 3.0,
    "a row": [0.5, 0.5],
    "three coordinates": np.zeros((2, 3)),
    "nothing": [],
    "ragged": [[1, 2], [3]],
    "an object": Odd(),
    "numbers by name": np.zeros(5, dtype=[("x", float), ("y", float)]),
}
#: What is no array; SciPy takes nothing else in some places.
NO_ARRAYS = [None, 0, 1.5, np.nan, "x", b"x", [], [[]], [[1, 2], [3]], {1, 2}, {1: 2}, Odd(), range(20), (V,), True]

CALLS = {
    # Questions to triangulations.
    "find a string": lambda s: s.Delaunay(P).find_simplex("x"),
    "find strings": lambda s: s.Delaunay(P).find_simplex([["a", "b"]]),
    "find strings of a row": lambda s: s.Delaunay(P).find_simplex(["a", "b"]),
    "find a number": lambda s: s.Delaunay(P).find_simplex(0.5),
    "find None": lambda s: s.Delaunay(P).find_simplex(None),
    "find nones": lambda s: s.Delaunay(P).find_simplex([[Odd(), 1]]),
    "find nothing": lambda s: s.Delaunay(P).find_simplex([]),
    "find in space": lambda s: s.Delaunay(P).find_simplex(Q),
    "find ragged": lambda s: s.Delaunay(P).find_simplex([[1, 2], [3]]),
    "find without arguments": lambda s: s.Delaunay(P).find_simplex(),
    "find with a string for a tolerance": lambda s: s.Delaunay(P).find_simplex(P, tol="x"),
    "find with many flags": lambda s: s.Delaunay(P).find_simplex(P, bruteforce=np.array([1, 0])),
    "find with an unknown name": lambda s: s.Delaunay(P).find_simplex(P, nonsense=1),
    "tsearch a number": lambda s: s.tsearch(s.Delaunay(P), 0.5),
    "tsearch in nothing": lambda s: s.tsearch(None, P),
    "distance in space": lambda s: s.Delaunay(P).plane_distance(Q),
    "distance of strings": lambda s: s.Delaunay(P).plane_distance(np.array([["a", "b"]])),
    "lift a number": lambda s: s.Delaunay(P).lift_points(np.float64(1)),
    # Changes.
    "add after close": lambda s: (lambda t: (t.close(), t.add_points(P)))(grown(s)),
    "add after close to a diagram": lambda s: (lambda t: (t.close(), t.add_points(P)))(grown(s, "Voronoi")),
    "add after close to a hull": lambda s: (lambda t: (t.close(), t.add_points(P)))(grown(s, "ConvexHull")),
    "add with many flags": lambda s: grown(s).add_points(P, restart=np.array([1, 0])),
    "add without arguments": lambda s: grown(s).add_points(),
    "assign points": lambda s: setattr(s.Delaunay(P), "points", P),
    "assign points of a diagram": lambda s: setattr(s.Voronoi(P), "points", P),
    "assign points of a hull": lambda s: setattr(s.ConvexHull(P), "points", P),
    "assign a transform": lambda s: setattr(s.Delaunay(P), "transform", None),
    "assign half-spaces": lambda s: setattr(s.HalfspaceIntersection(BOX, CENTRE), "halfspaces", BOX),
    "an unknown attribute": lambda s: s.Delaunay(P).nonsense,
    "delete an unknown attribute": lambda s: delattr(s.Delaunay(P), "nonsense"),
    "find among strings": lambda s: assigned(s.Delaunay(P), simplices="abc").find_simplex(P),
    "find among lists": lambda s: assigned(s.Delaunay(P), neighbors=[[1, 2, 3]]).find_simplex(P),
    "find among floats": lambda s: (lambda t: assigned(t, simplices=t.simplices * 1.0).find_simplex(P))(s.Delaunay(P)),
    "find without dimension": lambda s: assigned(s.Delaunay(P), ndim=3).find_simplex(P),
    "find with bounds of words": lambda s: assigned(s.Delaunay(P), min_bound="low").find_simplex(P),
    # Half-spaces.
    "half-lines": lambda s: s.HalfspaceIntersection(np.array([[1.0, -1], [-1, -1]]), np.zeros(1)),
    "half-spaces of nothing": lambda s: s.HalfspaceIntersection(np.empty((0, 3)), CENTRE),
    "half-spaces of one number": lambda s: s.HalfspaceIntersection(np.ones((3, 1)), np.zeros(0)),
    "half-spaces of no numbers": lambda s: s.HalfspaceIntersection(np.ones((3, 0)), np.zeros(0)),
    "half-spaces that are a row": lambda s: s.HalfspaceIntersection(V, CENTRE),
    "hull of half-spaces with Qz": lambda s: s.HalfspaceIntersection(BOX, CENTRE, qhull_options="Qz"),
    "a hull with Qz": lambda s: s.ConvexHull(P, qhull_options="Qz"),
    "a hull with Qu": lambda s: s.ConvexHull(P, qhull_options="Qu"),
    "add half-spaces of four": lambda s: s.HalfspaceIntersection(BOX, CENTRE, True).add_halfspaces(np.ones((2, 4))),
    "half-spaces with NaN": lambda s: s.HalfspaceIntersection(BOX * np.nan, CENTRE),
    "half-spaces of words": lambda s: s.HalfspaceIntersection(BOX.astype(str).astype("U1"), np.array(["a", "b"])),
    "masked half-spaces": lambda s: s.HalfspaceIntersection(np.ma.array(BOX, mask=BOX == 1), CENTRE),
    "a masked point": lambda s: s.HalfspaceIntersection(BOX, np.ma.array(CENTRE, mask=[1, 0])),
    "a point of three": lambda s: s.HalfspaceIntersection(BOX, np.zeros(3)),
    "a point that is a number": lambda s: s.HalfspaceIntersection(BOX, np.float64(0)),
    "a point of two axes": lambda s: s.HalfspaceIntersection(BOX, CENTRE[None]),
    "a point outside": lambda s: s.HalfspaceIntersection(BOX, CENTRE + 2),
    "a point on the border": lambda s: s.HalfspaceIntersection(BOX, np.array([1.0, 0])),
    "a point of NaN": lambda s: s.HalfspaceIntersection(BOX, CENTRE * np.nan),
    "too few half-spaces": lambda s: s.HalfspaceIntersection(BOX[:2], CENTRE),
    "half-spaces, options 3": lambda s: s.HalfspaceIntersection(BOX, CENTRE, qhull_options=3),
    "half-spaces, options unknown": lambda s: s.HalfspaceIntersection(BOX, CENTRE, qhull_options="Nonsense"),
    "half-spaces without a point": lambda s: s.HalfspaceIntersection(BOX),
    "add half-spaces of two": lambda s: s.HalfspaceIntersection(BOX, CENTRE, True).add_halfspaces(np.zeros((1, 2))),
    "add half-spaces of words": lambda s: s.HalfspaceIntersection(BOX, CENTRE, True).add_halfspaces(np.array([["a", "b", "c"]])),
    "add half-spaces after close": lambda s: (lambda t: (t.close(), t.add_halfspaces(BOX)))(
        s.HalfspaceIntersection(BOX, CENTRE, True)
    ),
    # griddata.
    "griddata, unknown method": lambda s: s.griddata(P, V, P, method="nonsense"),
    "griddata, method of a number": lambda s: s.griddata(P, V, P, method=3),
    "griddata, cubic in space": lambda s: s.griddata(Q, V, Q, method="cubic"),
    "griddata, points of nothing": lambda s: s.griddata(np.empty((0, 2)), V[:0], P),
    "griddata, a triangulation": lambda s: s.griddata(s.Delaunay(P), V, P),
    "griddata, None": lambda s: s.griddata(None, V, P),
    "griddata, no points": lambda s: s.griddata((), V, P),
    "griddata, nearest of words": lambda s: s.griddata(P, V, [["a", "b"]], method="nearest"),
    "griddata, xi None": lambda s: s.griddata(P, V, None),
    "griddata, xi of three": lambda s: s.griddata(P, V, (V, V, V)),
    "griddata, xi of two lengths": lambda s: s.griddata(P, V, (V, V[:3])),
    "griddata, fill": lambda s: s.griddata(P, V, P, fill_value="x"),
    "griddata, on a line": lambda s: s.griddata(np.ones((5, 2)), V[:5], P),
}


def interpolations(name):
    def make(s, points=P, values=V, **options):
        return getattr(s, name)(points, values, **options)

    return {
        "a number for values": lambda s: make(s, values=3.0),
        "a string for values": lambda s: make(s, values="abc"),
        "strings for values": lambda s: make(s, values=["a"] * 20),
        "objects for values": lambda s: make(s, values=[Odd()] * 20),
        "nones for values": lambda s: make(s, values=np.array([None, "x"] * 10, dtype=object)),
        "complex objects for values": lambda s: make(s, values=np.array([1j] * 20, dtype=object)),
        "few values": lambda s: make(s, values=V[:3]),
        "no values": lambda s: make(s, values=[]),
        "ragged values": lambda s: make(s, values=[[1, 2], [3]] * 10),
        "masked and few": lambda s: make(s, values=np.ma.array(V[:3])),
        "points of words": lambda s: make(s, [["a", "b"]] * 20),
        "points of None": lambda s: make(s, None),
        "a number for points": lambda s: make(s, 3.0),
        "a row of points": lambda s: make(s, V),
        "NaN": lambda s: make(s, NAN),
        "infinite": lambda s: make(s, INF),
        "on a line": lambda s: make(s, (V, V)),
        "no coordinates": lambda s: make(s, ()),
        "coordinates of two lengths": lambda s: make(s, (V, V[:3])),
        "a coordinate": lambda s: make(s, (V,)),
        "fill x": lambda s: make(s, fill_value="x"),
        "fill None": lambda s: make(s, fill_value=None),
        "fill with a list": lambda s: make(s, fill_value=[1, 2]),
        "fill with a complex number": lambda s: make(s, fill_value=1j),
        "fill with an object": lambda s: make(s, fill_value=Odd()),
        "complex values, fill x": lambda s: make(s, values=V * 1j, fill_value="x"),
        "rescale a triangulation": lambda s: make(s, s.Delaunay(P), rescale=True),
        "rescale, many flags": lambda s: make(s, rescale=np.array([1, 0])),
        "without values": lambda s: getattr(s, name)(P),
        "an unknown name": lambda s: make(s, nonsense=1),
        "at a number": lambda s: make(s)(0.5),
        "at a numpy number": lambda s: make(s)(np.array(0.5)),
        "at nothing": lambda s: make(s)(),
        "at no coordinates": lambda s: make(s)(()),
        "at three coordinates": lambda s: make(s)(1, 2, 3),
        "at points of space": lambda s: make(s)(Q),
        "at an odd number": lambda s: make(s)([1.0, 2.0, 3.0]),
        "at a string": lambda s: make(s)("x"),
        "at strings": lambda s: make(s)([["a", "b"]]),
        "at strings of coordinates": lambda s: make(s)("a", "b"),
        "at None": lambda s: make(s)(None),
        "at nones": lambda s: make(s)([[Odd(), Odd()]]),
        "at two lengths": lambda s: make(s)(V, V[:3]),
        "at ragged points": lambda s: make(s)([[1, 2], [3]]),
        "with an unknown option": lambda s: make(s)(P, nonsense=1),
    }


def compared(call):
    """What SciPy and we raise."""
    with pytest.raises(Exception) as theirs:
        call(THEIRS)
    with pytest.raises(Exception) as ours:
        call(spatial)
    assert isinstance(ours.value, theirs.type), (ours.value, theirs.value)
    assert str(ours.value).strip(), "the error says something"


pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.mark.parametrize("what", SHAPES)
@pytest.mark.parametrize("name", ["Delaunay", "Voronoi", "ConvexHull"])
def test_points_that_are_wrong(name, what):
    compared(lambda s: SHAPES[what](s, getattr(s, name)))


@pytest.mark.parametrize("what", ADDED)
@pytest.mark.parametrize("name", ["Delaunay", "Voronoi", "ConvexHull"])
def test_points_that_are_added_wrongly(name, what):
    if name == "ConvexHull" and what in ("NaN", "infinite"):
        # SciPy's hull is silently wrong then.
        with pytest.raises(scipy.spatial.QhullError):
            grown(spatial, name).add_points(ADDED[what])
        return
    compared(lambda s: grown(s, name).add_points(ADDED[what]))


@pytest.mark.parametrize("given", NO_ARRAYS, ids=lambda given: type(given).__name__)
def test_what_is_no_array_where_scipy_takes_arrays(given):
    for call in (
        lambda s: s.Delaunay(P).plane_distance(given),
        lambda s: s.Delaunay(P).lift_points(given),
        lambda s: s.HalfspaceIntersection(given, CENTRE),
        lambda s: s.HalfspaceIntersection(BOX, given),
        lambda s: s.HalfspaceIntersection(BOX, CENTRE, True).add_halfspaces(given),
    ):
        with pytest.raises(AttributeError):
            call(THEIRS)
        try:
            call(spatial)
        except Exception as ours:
            # Lists are taken where they are right.
            assert isinstance(ours, AttributeError), ours


@pytest.mark.parametrize("what", CALLS)
def test_calls_that_are_wrong(what):
    compared(CALLS[what])


@pytest.mark.parametrize("what", interpolations(""))
@pytest.mark.parametrize("name", ["LinearNDInterpolator", "CloughTocher2DInterpolator"])
def test_interpolations_that_are_wrong(name, what):
    compared(interpolations(name)[what])
