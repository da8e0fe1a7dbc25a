"""Welding: what nearly touches becomes one; and the area that the author of a file meant."""

from __future__ import annotations

import pickle

import delone
import numpy as np
import pytest

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
BESIDE = [[1 + 1e-7, 0.5], [2, 0], [2, 1]]
RING = [[0, 1], [1, 2], [2, 3], [3, 0]]


def two():
    shapely = pytest.importorskip("shapely")
    return [shapely.Polygon(SQUARE), shapely.Polygon(BESIDE)]


def test_arrays_say_what_became_of_points_and_segments():
    points = np.array(SQUARE + BESIDE, dtype=float)
    segments = np.array([*RING, [4, 5], [5, 6], [6, 4]])
    welded = delone.weld(points, segments, tolerance=1e-6)
    assert welded.stays.tolist() == list(range(7))
    assert (welded.moved, welded.bends, welded.collapsed) == (0, 1, 0)
    # The corner of the triangle is on the right side of the square.
    assert welded.segments[1:3].tolist() == [[1, 4], [4, 2]]
    assert welded.origins.tolist() == [0, 1, 1, 2, 3, 4, 5, 6]
    again = delone.weld(welded.points, welded.segments, tolerance=1e-6)
    assert (again.moved, again.bends) == (0, 0)
    assert (again.segments == welded.segments).all()


def test_a_mesh_goes_on_across_the_gap_and_knows_its_sides():
    made = delone.mesh(two(), min_angle=25, weld=1e-6)
    assert len(made.report.left) == 0
    assert set(made.segment_origin.tolist()) == set(range(7))
    right = made.segments[made.segment_origin == 1]
    assert sorted({tuple(p) for p in made.points[right].reshape(-1, 2).tolist()})[1] == (1.0, 1.0)
    again = pickle.loads(pickle.dumps(made))
    assert (again.triangles == made.triangles).all()


def test_a_triangulation_has_its_welding():
    tri = delone.ConstrainedDelaunay(two(), weld=1e-6)
    assert tri.welded is not None
    assert tri.welded.bends == 1
    assert len(tri.constraints) == 8
    assert len(pickle.loads(pickle.dumps(tri)).constraints) == 8
    assert delone.ConstrainedDelaunay(two()).welded is None


def test_polygons_are_welded_to_each_other():
    one, other = delone.triangulate_polygons(two(), weld=1e-6)
    assert len(one.points) == 5
    assert set(map(tuple, one.points)) & set(map(tuple, other.points)) == {(1 + 1e-7, 0.5)}
    everything = delone.triangulate_polygons(two(), weld=10)
    assert [part.triangles.shape for part in everything] == [(0, 3), (0, 3)]


def test_an_arc_whose_chord_changes_is_straight():
    around = [[1, 0], [0, 1], [-1, 0], [0, -1], [1e-9, 1]]
    segments = [[0, 1], [4, 2], [2, 3], [3, 0]]
    made = delone.mesh(around, segments, centers=[[0, 0]] * 4, edge=0.2, weld=1e-6)
    straight = made.points[made.segments[made.segment_origin == 1]]
    assert np.abs(np.abs(straight).sum(axis=2) - 1).max() < 1e-15
    assert set(made.segment_origin.tolist()) == {0, 1, 2, 3}


def test_layers_follow_the_segments_that_were_given():
    points = [[0, 0], [4, 0], [4, 1], [0, 1], [2, 1e-9]]
    layers = delone.Layers(0.01, 3, segments=[0])
    made = delone.mesh(points, RING, layers=layers, edge=0.2, weld=1e-6)
    assert made.report.layers.triangles > 0
    assert 4 in made.segments[made.segment_origin == 0]


def test_a_crossing_is_of_segments_that_were_given():
    points = [[0, 0], [4, 4], [0, 4], [4, 0], [1, 1]]
    segments = [[0, 1], [2, 3]]
    for call in (delone.ConstrainedDelaunay, delone.mesh):
        with pytest.raises(delone.CrossingError, match="segments 0 and 1 cross") as caught:
            call(points, segments, weld=0.5)
        assert (caught.value.first, caught.value.second) == (0, 1)


@pytest.mark.parametrize("tolerance", [-1.0, float("nan"), float("inf")])
def test_a_tolerance_is_a_length(tolerance):
    for call in (lambda **k: delone.mesh(SQUARE, RING, **k), lambda **k: delone.triangulate_polygon(SQUARE, **k)):
        with pytest.raises(ValueError, match="at least 0 and finite"):
            call(weld=tolerance)
    with pytest.raises(TypeError, match="number"):
        delone.weld(SQUARE, tolerance=[1, 2])


def test_triangles_that_are_given_stay():
    with pytest.raises(ValueError, match="triangles that are given stay"):
        delone.mesh(SQUARE, triangles=[[0, 1, 2], [0, 2, 3]], weld=0.1)


def test_holes_are_of_their_own_shell():
    shapely = pytest.importorskip("shapely")
    square = [[0, 0], [9, 0], [9, 8], [0, 8]]
    holes = [[[1, 1], [5, 1], [5, 5], [1, 5]], [[3, 1], [7, 1], [7, 5], [3, 5]]]
    overlapping = {"type": "Polygon", "coordinates": [square, *holes]}
    of_rule = {"even-odd": 72 - 16, "shells-minus-holes": 72 - 24}
    for fill, area in of_rule.items():
        assert delone.triangulate_polygon(overlapping, fill=fill).area == area
        assert delone.triangulate_polygon([square, *holes], fill=fill).area == area
    island = shapely.MultiPolygon([shapely.Polygon(square, holes), shapely.box(2, 2, 3, 3)])
    for given in (island, island.__geo_interface__):
        assert delone.triangulate_polygon(given, fill="shells-minus-holes").area == 72 - 24 + 1
    assert [part.area for part in delone.triangulate_polygons([island] * 2, fill="shells-minus-holes")] == [49, 49]


def test_a_gap_that_is_too_narrow_is_told():
    points = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 1e-7], [2, 3]]
    sides = [*RING, [4, 5]]
    with pytest.warns(UserWarning, match=r"segments 0 and 4 are 1e-07 apart near \(2, 1e-07\).*weld=1e-6 joins them"):
        made = delone.mesh(points, sides, max_vertices=50, holes=[])
    assert len(made.report.left) > 0
    with pytest.warns(UserWarning, match="segments 0 and 4"):
        short = delone.mesh(points, sides, min_edge=0.1, holes=[])
    assert set(short.report.reasons) >= {"short"}
    assert len(delone.mesh(points, sides, weld=1e-6, holes=[]).report.left) == 0
