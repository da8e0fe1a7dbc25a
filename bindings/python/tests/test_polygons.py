"""Polygons of all kinds to triangles: areas, arrays, shapely, GeoJSON, and what is refused."""

import pickle
import subprocess
import sys
from types import SimpleNamespace

import delone
import numpy as np
import pytest

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]
HOLE = [[1, 1], [3, 1], [3, 3], [1, 3]]
CLOSED = [[*SQUARE, SQUARE[0]], [*HOLE, HOLE[0]]]
FAR = [[5, 0], [9, 0], [9, 4]]
POLYGON = {"type": "Polygon", "coordinates": CLOSED}
MULTI = {"type": "MultiPolygon", "coordinates": [CLOSED, [[*FAR, FAR[0]]]]}
HIGH = {"type": "Polygon", "coordinates": [[[x, y, 7.0] for x, y in ring] for ring in CLOSED]}

#: The same square with a hole.
SAME = {
    "lists": [SQUARE, HOLE],
    "tuples": (tuple(map(tuple, SQUARE)), tuple(map(tuple, HOLE))),
    "closed": CLOSED,
    "arrays": [np.array(SQUARE), np.array(HOLE, dtype=np.float32)],
    "array": np.array([SQUARE, HOLE]),
    "fortran": np.asfortranarray(np.array([SQUARE, HOLE], dtype=float)),
    "objects": np.array([None, None], dtype=object),
    "the hole first": [HOLE, SQUARE],
    "clockwise": [SQUARE[::-1], HOLE],
    "iterator": None,
    "mapping": POLYGON,
    "heights": HIGH,
    "feature": {"type": "Feature", "properties": {}, "geometry": POLYGON},
    "collection": {"type": "GeometryCollection", "geometries": [POLYGON]},
    "interface": SimpleNamespace(__geo_interface__=POLYGON),
    "an empty ring": [SQUARE, HOLE, []],
}
SAME["objects"][:] = [np.array(SQUARE), np.array(HOLE)]


def areas(found):
    return [one.area for one in found]


@pytest.mark.parametrize("name", SAME)
def test_one_polygon(name):
    inside = delone.triangulate_polygon(iter([SQUARE, HOLE]) if name == "iterator" else SAME[name])
    assert inside.area == 12 and len(inside.triangles) == 8
    assert inside.triangles.dtype == np.int32 and inside.points.dtype == np.float64
    points, triangles = inside
    p, q, r = (points[triangles[:, k]] for k in range(3))
    assert (np.cross(np.c_[q - p, 0 * p[:, :1]], np.c_[r - p, 0 * p[:, :1]])[:, 2] > 0).all()
    if name != "iterator":
        assert areas(delone.triangulate_polygons([SAME[name], FAR])) == [12, 8]
    assert pickle.loads(pickle.dumps(inside)).area == 12


def test_corners_are_those_given():
    inside = delone.triangulate_polygon(CLOSED)
    assert inside.points.tolist() == np.concatenate(CLOSED).tolist()
    # Not the one that closes a ring.
    assert set(inside.triangles.ravel().tolist()) == {0, 1, 2, 3, 5, 6, 7, 8}
    assert delone.triangulate_polygon(SQUARE).area == delone.triangulate_polygon(np.array(SQUARE)).area == 16
    assert delone.triangulate_polygon(MULTI).area == 20


def test_fills_and_crossings():
    bow = [[0, 0], [2, 2], [2, 0], [0, 2]]
    with pytest.raises(delone.CrossingError, match=r"^segments 0 and 2 cross near \(1, 1\)$"):
        delone.triangulate_polygon(bow)
    with pytest.raises(delone.CrossingError, match=r"^polygon 1: segments 0 and 2 cross") as caught:
        delone.triangulate_polygons([SQUARE, bow])
    assert (caught.value.first, caught.value.second, caught.value.near) == (0, 2, (1.0, 1.0))
    inside = delone.triangulate_polygon(bow, crossings="split")
    assert inside.area == 2 and inside.points[4].tolist() == [1, 1]
    twice = [SQUARE, [[x + 2, y] for x, y in SQUARE]]
    assert delone.triangulate_polygon(twice, crossings="split").area == 16
    assert delone.triangulate_polygon(twice, crossings="split", fill="nonzero").area == 24
    # By rings in opposite directions holes have winding 0, and where they overlap it is -1.
    square, hole, other = (
        [np.multiply([[0, 0], [1, 0], [1, 1], [0, 1]], 10)],
        [[2, 2], [2, 6], [6, 6], [6, 2]],
        [[4, 4], [4, 8], [8, 8], [8, 4]],
    )
    for fill, area in (("even-odd", 76), ("nonzero", 76), ("positive", 72), ("negative", 4)):
        found = delone.triangulate_polygon([*square, hole, other], crossings="split", fill=fill)
        assert found.area == area
    for name, call in (("fill", {"fill": "all"}), ("crossings", {"crossings": "join"})):
        with pytest.raises(ValueError, match=f"{name} must be one of"):
            delone.triangulate_polygon(SQUARE, **call)
        with pytest.raises(ValueError, match=f"{name} must be one of"):
            delone.triangulate_polygons([], **call)
    with pytest.raises(TypeError, match="ragged must be True or False"):
        delone.triangulate_polygons([SQUARE], ragged=None)


def test_many_polygons():
    given = [SQUARE, [SQUARE, HOLE], MULTI, FAR, [], np.empty((0, 2)), {"type": "Polygon", "coordinates": []}]
    found = delone.triangulate_polygons(given)
    assert areas(found) == [16, 12, 20, 8, 0, 0, 0]
    ragged = delone.triangulate_polygons(given, ragged=True)
    assert ragged.points.shape == (ragged.point_offsets[-1], 2) and ragged.triangles.shape == (ragged.triangle_offsets[-1], 3)
    for k, one in enumerate(found):
        alone = delone.triangulate_polygon(given[k])
        assert np.array_equal(alone.points, one.points) and np.array_equal(alone.triangles, one.triangles)
        rows = slice(*ragged.triangle_offsets[k : k + 2])
        assert np.array_equal(ragged.points[ragged.triangles[rows]], one.points[one.triangles])
    collections = [
        {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": POLYGON, "properties": None}] * 2},
        {"type": "GeometryCollection", "geometries": [POLYGON, POLYGON]},
        SimpleNamespace(__geo_interface__={"type": "GeometryCollection", "geometries": [POLYGON, POLYGON]}),
        (POLYGON for _ in range(2)),
    ]
    for collection in collections:
        assert areas(delone.triangulate_polygons(collection)) == [12, 12]
    assert areas(delone.triangulate_polygons(np.array([SQUARE, HOLE]))) == [16, 4]
    for nothing in ([], (), iter([]), np.empty((0, 4, 2)), {"type": "FeatureCollection", "features": []}):
        assert delone.triangulate_polygons(nothing) == []
    empty = delone.triangulate_polygons([], ragged=True)
    assert empty.points.shape == (0, 2) and empty.triangles.shape == (0, 3) and empty.point_offsets.tolist() == [0]


def stars(count, corners=40, seed=0):
    """Star-shaped rings, and their areas."""
    random = np.random.default_rng(seed)
    angles = np.sort(random.random((count, corners)), axis=1) * 2 * np.pi
    rings = (random.random((count, corners)) + 0.2)[..., None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    x, y = rings[..., 0], rings[..., 1]
    return rings, (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1) / 2


def test_areas_are_kept():
    rings, expected = stars(3000)
    found = delone.triangulate_polygons(rings)
    assert np.allclose(areas(found), expected, rtol=1e-12)
    assert all(len(one.triangles) == 38 for one in found)
    again = delone.triangulate_polygons(list(rings[:50]))
    assert all(np.array_equal(a.triangles, b.triangles) for a, b in zip(again, found, strict=False))


def test_the_triangles_are_those_of_the_constrained_triangulation():
    for ring in stars(20, 30, seed=2)[0]:
        sides = np.column_stack([np.arange(30), np.roll(np.arange(30), -1)])
        tri = delone.ConstrainedDelaunay(ring, sides, fill="even-odd")
        assert np.array_equal(np.sort(tri.triangles, axis=0), np.sort(delone.triangulate_polygon(ring).triangles, axis=0))


#: What is no polygon, and what is said of it.
WRONG = {
    "None": (None, TypeError, "must be a ring, a list of rings or a geometry"),
    "text": ("POLYGON EMPTY", TypeError, "must be a ring"),
    "number": (5, TypeError, "must be a ring"),
    "NaN": ([[0, 0], [1, np.nan], [2, 2]], ValueError, "ring 0: point 1 has the y coordinate nan"),
    "infinity in the second ring": (
        [SQUARE, [[0, 0], [np.inf, 1], [2, 2]]],
        ValueError,
        "ring 1: point 1 has the x coordinate inf",
    ),
    "heights in arrays": (np.zeros((4, 3)), ValueError, "2 coordinates each, not 3"),
    "one number a point": ([[1], [2]], ValueError, "2 coordinates each, not 1"),
    "numbers": ([1, 2, 3], ValueError, r"not \(3,\)"),
    "too deep": ([[[[0, 0], [1, 0], [1, 1]]]], ValueError, r"not \(1, 3, 2\)"),
    "ragged": ([[0, 0], [1], [2, 2]], ValueError, "inhomogeneous"),
    "texts": ([["a", "b"]], TypeError, "real numbers"),
    "a point of text": (["ab", "cd"], TypeError, "real numbers"),
    "None among points": ([[0, 0], None, [1, 1]], (TypeError, ValueError), "real numbers|inhomogeneous"),
    "None among rings": ([SQUARE, None], TypeError, "real numbers"),
    "masked": (np.ma.masked_array(SQUARE, mask=[[True, False]] * len(SQUARE)), ValueError, "masked"),
    "complex": (np.zeros((3, 2), dtype=complex), TypeError, "complex"),
    "point": ({"type": "Point", "coordinates": [0, 0]}, TypeError, "a Point has no inside"),
    "line": ({"type": "LineString", "coordinates": SQUARE}, TypeError, "a LineString has no inside"),
    "mapping": ({"a": 1}, TypeError, "a mapping that is no geometry"),
    "no coordinates": ({"type": "Polygon"}, TypeError, "a Polygon must have coordinates, not None"),
    "coordinates of text": ({"type": "Polygon", "coordinates": "abc"}, TypeError, "must have coordinates, not 'abc'"),
    "coordinates that are none": ({"type": "Polygon", "coordinates": [1, 2]}, (TypeError, ValueError), "polygon"),
    "too deep in a mapping": ({"type": "Polygon", "coordinates": [CLOSED]}, ValueError, "polygon"),
    "too shallow in a mapping": ({"type": "MultiPolygon", "coordinates": CLOSED}, ValueError, "polygon"),
    "numbers in a mapping": ({"type": "MultiPolygon", "coordinates": [1, 2]}, TypeError, "polygon"),
    "ragged in a mapping": ({"type": "Polygon", "coordinates": [[[0, 0], [1]]]}, ValueError, "inhomogeneous"),
    "nowhere": ({"type": "Feature", "geometry": None}, TypeError, "a Feature without a geometry"),
    "a point in a collection": ({"type": "GeometryCollection", "geometries": [{"type": "Point"}]}, TypeError, "a Point has no"),
    "features": ({"type": "FeatureCollection", "features": []}, TypeError, "a FeatureCollection has no inside"),
    "an interface to nothing": (SimpleNamespace(__geo_interface__=None), TypeError, "must be a ring"),
    "type": (dict, TypeError, "must be a ring"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_polygon(name):
    given, kind, words = WRONG[name]
    with pytest.raises(kind, match=words):
        delone.triangulate_polygon(given)
    with pytest.raises(kind, match=words) as caught:
        delone.triangulate_polygons([SQUARE, given])
    assert name in ("ragged", "ragged in a mapping", "None among points", "text", "too deep") or "polygon 1" in str(caught.value)


def test_what_is_no_list_of_polygons():
    for wrong in (None, 5, "abc", b"abc", dict, POLYGON, MULTI, {"a": 1}, np.zeros((4, 2)), np.zeros(3), np.array(POLYGON)):
        with pytest.raises(TypeError, match="list of polygons"):
            delone.triangulate_polygons(wrong)
    for features in (None, 5, "abc"):
        with pytest.raises(TypeError, match="must have features"):
            delone.triangulate_polygons({"type": "FeatureCollection", "features": features})


def test_shapely():
    shapely = pytest.importorskip("shapely")
    rings, expected = stars(200)
    polygon = shapely.Polygon(SQUARE, [HOLE])
    given = [*shapely.polygons(rings), polygon, shapely.MultiPolygon([polygon, shapely.Polygon(FAR)])]
    given += [shapely.Polygon(), shapely.MultiPolygon(), shapely.force_3d(polygon, 7.0)]
    expected = [*expected, 12, 20, 0, 0, 12]
    found = delone.triangulate_polygons(given)
    assert np.allclose(areas(found), expected, rtol=1e-12)
    for form in (np.array(given, dtype=object), tuple(given), iter(given), shapely.GeometryCollection(given)):
        for one, other in zip(delone.triangulate_polygons(form), found, strict=True):
            assert np.array_equal(one.points, other.points) and np.array_equal(one.triangles, other.triangles)
    for one, other in zip(given, found, strict=True):
        alone = delone.triangulate_polygon(one)
        assert np.array_equal(alone.points, other.points) and np.array_equal(alone.triangles, other.triangles)
        # What is one is taken for no list.
        if not isinstance(one, shapely.MultiPolygon):
            with pytest.raises(TypeError, match="a Polygon is no list of polygons"):
                delone.triangulate_polygons(one)
    # Not among shapely's alone.
    assert areas(delone.triangulate_polygons([polygon, SQUARE, POLYGON])) == [12, 16, 12]
    assert areas(delone.triangulate_polygons([shapely.GeometryCollection([polygon])])) == [12]
    for wrong in (shapely.Point(0, 0), shapely.LineString(SQUARE), shapely.LinearRing(SQUARE), None):
        with pytest.raises(TypeError, match="polygon 1"):
            delone.triangulate_polygons([polygon, wrong])
    with np.errstate(invalid="ignore"):
        nowhere = shapely.polygons([[0, 0], [1, np.nan], [2, 2]])
    with pytest.raises(ValueError, match=r"polygon 1: point 1 has the y coordinate NaN, which is not finite"):
        delone.triangulate_polygons([polygon, nowhere])
    with pytest.raises(delone.CrossingError, match="polygon 1: segments"):
        delone.triangulate_polygons([polygon, shapely.Polygon([[0, 0], [2, 2], [2, 0], [0, 2]])])


def test_shapely_is_not_needed():
    program = (
        "import sys; sys.modules['shapely'] = None; import delone;"
        "print(len(delone.triangulate_polygons([[[0, 0], [1, 0], [1, 1]]])[0].triangles), 'pandas' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1", "False"]
