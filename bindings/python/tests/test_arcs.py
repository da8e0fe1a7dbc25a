"""Segments that are chords of arcs: new points on the circles, and elements of second order."""

import copy
import math
import pickle

import delone
import numpy as np
import pytest

SQUARE = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
AROUND = [[1, 0], [0, 1], [-1, 0], [0, -1]]
POINTS = SQUARE + AROUND
SEGMENTS = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
CENTERS = [[np.nan, np.nan]] * 4 + [[0, 0]] * 4
AREA = 16 - math.pi


def jacobians(nodes: "delone.SecondOrder", at: tuple[float, float]) -> np.ndarray:
    """Of all elements at barycentric coordinates, by shape functions."""
    u, v = at
    w = 1 - u - v
    along_u = np.array([1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v])
    along_v = np.array([1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)])
    places = nodes.points[nodes.triangles]
    first, second = (np.einsum("j,tjd->td", along, places) for along in (along_u, along_v))
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]


def curved_area(nodes: "delone.SecondOrder") -> float:
    return float(sum(jacobians(nodes, at).sum() for at in ((0.5, 0), (0.5, 0.5), (0, 0.5))) / 6)


@pytest.mark.parametrize("wanted", [{"edge": 0.3}, {"max_area": 0.05}, {}, {"edge": 0.3, "layers": delone.Layers(0.02, 3)}])
def test_points_are_on_the_circle(wanted) -> None:
    made = delone.mesh(POINTS, SEGMENTS, centers=CENTERS, min_angle=25, **wanted)
    made.check()
    assert made.points[:8].tolist() == POINTS
    assert sorted(set(made.segment_origin.tolist())) == list(range(8))
    on_arcs = made.points[made.segments[made.segment_origin >= 4]].reshape(-1, 2)
    assert np.abs(np.hypot(*on_arcs.T) - 1).max() < 4e-16
    assert abs(made.area / AREA - 1) < 0.01
    nodes = made.second_order
    assert nodes.points[: len(made.points)].tolist() == made.points.tolist()
    assert abs(curved_area(nodes) / AREA - 1) < 2e-6
    for u in range(9):
        for v in range(9 - u):
            assert jacobians(nodes, (u / 8, v / 8)).min() > 0
    # Nodes are shared: as many as there are edges.
    assert len(np.unique(nodes.triangles[:, 3:])) == len(nodes.points) - len(made.points)


def test_meshes_are_refined_again_and_copied() -> None:
    made = delone.mesh(POINTS, SEGMENTS, centers=CENTERS, min_angle=25)
    fine = made.refine(max_area=0.005, min_angle=25)
    on_arcs = fine.points[fine.segments[fine.segment_origin >= 4]].reshape(-1, 2)
    assert len(on_arcs) > 100 and np.abs(np.hypot(*on_arcs.T) - 1).max() < 4e-16
    assert abs(curved_area(fine.second_order) / AREA - 1) < 1e-7
    assert fine.parents.min() >= -1
    for other in (pickle.loads(pickle.dumps(fine)), copy.deepcopy(fine)):
        assert (other.points == fine.points).all() and (other.triangles == fine.triangles).all()
        assert (other.segment_origin == fine.segment_origin).all()
    coarse = fine.coarsen(marked=np.ones(len(fine.triangles), bool))
    assert len(coarse.triangles) < len(fine.triangles)
    assert abs(curved_area(coarse.second_order) / AREA - 1) < 1e-7


def test_layers_follow_chosen_arcs() -> None:
    layers = delone.Layers(0.01, 4, segments=[4, 5, 6, 7])
    made = delone.mesh(POINTS, SEGMENTS, centers=CENTERS, edge=0.3, layers=layers)
    centroids = made.points[made.triangles[made.is_layer]].mean(axis=1)
    assert made.report.layers.rows == 4 and np.hypot(*centroids.T).max() < 1.1
    fine = delone.mesh(POINTS, SEGMENTS, centers=CENTERS, edge=0.05, layers=layers)
    on_arcs = fine.points[fine.segments[fine.segment_origin >= 4]].reshape(-1, 2)
    assert len(on_arcs) > 200 and np.abs(np.hypot(*on_arcs.T) - 1).max() < 4e-16


def test_polygons_have_arcs() -> None:
    shapely = pytest.importorskip("shapely")
    disk = delone.mesh(shapely.Polygon(AROUND), centers=[[0, 0]] * 4, edge=0.1)
    assert abs(disk.area / math.pi - 1) < 0.002


@pytest.mark.parametrize(
    ("centers", "error", "words"),
    [
        ([[0, 0]], ValueError, r"shape \(8, 2\)"),
        ([[9, 9]] * 8, ValueError, "segment 0 is no chord"),
        ([*CENTERS[:7], [0.5, -0.5]], ValueError, "segment 7.*half a turn"),
        ([*CENTERS[:7], [np.inf, 0]], ValueError, "segment 7.*finite"),
        ([*CENTERS[:7], [np.nan, 0]], ValueError, "segment 7.*finite"),
        ([["a", 1]] * 8, TypeError, "real numbers"),
    ],
)
def test_what_is_no_arc_is_named(centers, error, words) -> None:
    with pytest.raises(error, match=words):
        delone.mesh(POINTS, SEGMENTS, centers=centers)


def test_flat_arcs_over_other_segments_bound_areas() -> None:
    turn = 0.2
    radius = 0.5 / math.sin(turn / 2)
    cap = radius**2 * (turn - math.sin(turn)) / 2
    deep = radius * math.cos(turn / 2)
    below, above, straight = [0.5, -deep], [0.5, deep], [np.nan, np.nan]
    for centers, expected in (([below, straight], cap), ([above, below], 2 * cap)):
        made = delone.mesh([[0, 0], [1, 0]], [[0, 1], [1, 0]], centers=centers, edge=0.02)
        made.check()
        assert abs(made.area / expected - 1) < 0.01
        assert set(made.segment_origin.tolist()) == {0, 1}


def test_crossings_name_given_segments() -> None:
    points = [*POINTS, [-1.5, 0.1], [1.5, 0.3]]
    with pytest.raises(delone.CrossingError) as caught:
        delone.mesh(points, [*SEGMENTS, [8, 9]], centers=[*CENTERS, [np.nan, np.nan]])
    assert 8 in (caught.value.first, caught.value.second)
    split = delone.mesh(points, [*SEGMENTS, [8, 9]], centers=[*CENTERS, [np.nan, np.nan]], crossings="split", fill="all")
    split.check()
    with pytest.raises(ValueError, match="straight"):
        delone.mesh(AROUND, [[0, 1]], centers=[[0, 0]], triangles=[[0, 1, 2]])
