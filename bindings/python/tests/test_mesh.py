"""Meshes: what was asked for holds, measured here and not by the library, and what is wrong is told."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from fractions import Fraction
from pathlib import Path

import delone
import numpy as np
import pytest

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]]
RINGS = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
UNIT = [[0, 0], [1, 0], [1, 1], [0, 1]]


def turn(p, q, r):
    (px, py), (qx, qy), (rx, ry) = ([Fraction(float(x)) for x in p] for p in (p, q, r))
    return (qx - px) * (ry - py) - (qy - py) * (rx - px)


def angles(mesh):
    """The angles at the corners, in degrees, (t, 3); and the lengths across."""
    corners = mesh.points[mesh.triangles]
    found = []
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        found.append(np.degrees(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))))
    lengths = np.linalg.norm(corners[:, [1, 2, 0]] - corners[:, [2, 0, 1]], axis=2)
    return np.stack(found, axis=1), lengths


def check(mesh, points, segments):
    """A mesh of these points and segments, by its arrays alone."""
    points = np.asarray(points, dtype=float)
    assert (mesh.points[: len(points)] == points).all()
    for array, kind in (
        (mesh.points, np.float64),
        (mesh.triangles, np.int64),
        (mesh.neighbors, np.int64),
        (mesh.regions, np.int64),
        (mesh.segments, np.int64),
        (mesh.segment_origin, np.int64),
    ):
        assert array.dtype == kind and not array.flags.writeable
    corners = mesh.points.tolist()
    assert all(turn(*(corners[v] for v in t)) > 0 for t in mesh.triangles.tolist())
    across = {}
    for row, (a, b, c) in enumerate(mesh.triangles.tolist()):
        for k, edge in enumerate(((b, c), (c, a), (a, b))):
            assert edge not in across
            across[edge] = (row, k)
    for (a, b), (row, k) in across.items():
        assert mesh.neighbors[row, k] == across.get((b, a), (-1, 0))[0]
    # All of the border is constraints, and each is on its segment, in its direction.
    fixed = {tuple(sorted(edge)) for edge in mesh.segments.tolist()}
    assert len(fixed) == len(mesh.segments) == len(mesh.segment_origin)
    assert fixed >= {tuple(sorted(edge)) for edge in across if edge[::-1] not in across}
    scale = np.abs(mesh.points).max(initial=0)
    for (a, b), origin in zip(mesh.segments.tolist(), mesh.segment_origin.tolist(), strict=True):
        if origin >= 0:
            first, last = points[np.asarray(segments)[origin]]
            step = last - first
            for p in mesh.points[[a, b]]:
                beside = abs(step[0] * (p - first)[1] - step[1] * (p - first)[0]) / np.linalg.norm(step)
                assert beside <= 1e-14 * scale
            assert (mesh.points[b] - mesh.points[a]) @ step > 0
    mesh.check()
    report = mesh.report
    assert report.inside + report.on_constraints <= len(mesh.points) - len(points)
    assert (np.diff(report.left) > 0).all() and len(report.left) == len(report.reasons)
    if len(mesh.triangles):
        found, _ = angles(mesh)
        assert report.smallest_angle == pytest.approx(found.min(), abs=1e-6)
        assert report.largest_angle == pytest.approx(found.max(), abs=1e-6)
        assert report.angles.sum() == 3 * len(found) and report.smallest_angles.sum() == len(found)
        assert (
            np.abs(np.histogram(found, np.arange(0, 181, 10))[0] - report.angles) <= np.isclose(found % 10, 0, atol=1e-6).sum()
        ).all()


def planar(seed):
    """Points, and segments that do not cross, with a frame around."""
    random = np.random.default_rng(seed)
    points = np.concatenate([[[0, 0], [1, 0], [1, 1], [0, 1]], random.random((12, 2)) * 0.9 + 0.05])
    segments = [[0, 1], [1, 2], [2, 3], [3, 0]]
    for a, b in random.integers(4, 16, (30, 2)).tolist():
        if a != b and not any(
            turn(points[a], points[b], points[c]) * turn(points[a], points[b], points[d]) < 0
            and turn(points[c], points[d], points[a]) * turn(points[c], points[d], points[b]) < 0
            for c, d in segments
        ):
            segments.append([a, b])
    return points, segments


@pytest.mark.parametrize("seed", range(12))
def test_angles_and_areas_hold(seed):
    points, segments = planar(seed)
    angle, area = (0, 10, 20, 25, 30, 33)[seed % 6], (0.02, np.inf)[seed % 2]
    mesh = delone.mesh(points, segments, fill="all", min_angle=angle, max_area=area)
    check(mesh, points, segments)
    assert mesh.area == pytest.approx(1)
    bad = (angles(mesh)[0].min(axis=1) < angle) | (mesh.areas > area)
    assert set(np.flatnonzero(bad)) <= set(mesh.report.left.tolist())
    assert set(mesh.report.reasons) <= {"input angle", "cascade"}
    assert set(range(len(segments))) >= set(mesh.segment_origin.tolist())


def test_holes_and_fills():
    for wanted, area in (({"holes": [[2, 2]]}, 14), ({}, 14), ({"fill": "all"}, 16), ({"fill": "nonzero"}, 16)):
        mesh = delone.mesh(SQUARE, RINGS, min_angle=30, max_area=0.2, **wanted)
        check(mesh, SQUARE, RINGS)
        assert mesh.area == pytest.approx(area) and mesh.areas.max() <= 0.2
        assert angles(mesh)[0].min() >= 30 - 1e-9 and not len(mesh.report.left)
    assert delone.mesh(UNIT).area == 1
    assert len(delone.mesh(UNIT).triangles) == 2 and (delone.mesh(UNIT).segment_origin == -1).all()


def test_regions_have_attributes_and_areas():
    points = [*UNIT, [0.5, 0], [0.5, 1]]
    segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]]
    mesh = delone.mesh(points, segments, regions=[[0.2, 0.5, 7, 0.005], [0.8, 0.5, 9, 0]])
    check(mesh, points, segments)
    left = mesh.points[mesh.triangles].mean(axis=1)[:, 0] < 0.5
    assert (mesh.regions == np.where(left, 0, 1)).all() and (mesh.attributes == np.where(left, 7, 9)).all()
    assert mesh.areas[left].max() <= 0.005 < 0.02 < mesh.areas[~left].max()
    one = delone.mesh(points, segments, regions=[[0.2, 0.5]])
    assert set(one.regions.tolist()) == {0, -1} and np.isnan(one.attributes[one.regions < 0]).all()


def test_sizes():
    for length in (0.1, np.float32(0.25)):
        mesh = delone.mesh(UNIT, size=length)
        check(mesh, UNIT, [])
        assert angles(mesh)[1].max() <= float(length)
        assert angles(delone.mesh(UNIT, max_edge=length))[1].max() <= float(length)
    graded = delone.mesh(UNIT, size=lambda x, y: 0.05 + 0.2 * x)
    centroids, longest = graded.points[graded.triangles].mean(axis=1), angles(graded)[1].max(axis=1)
    check(graded, UNIT, [])
    assert (longest <= (0.05 + 0.2 * centroids[:, 0]) * (1 + 1e-9)).all()
    # Linear between the points: the same field.
    linear = delone.mesh(UNIT, size=[0.05, 0.25, 0.25, 0.05])
    centroids, longest = linear.points[linear.triangles].mean(axis=1), angles(linear)[1].max(axis=1)
    assert (longest <= (0.05 + 0.2 * centroids[:, 0]) * (1 + 1e-9)).all()
    assert len(linear.triangles) == pytest.approx(len(graded.triangles), rel=0.05)
    assert len(delone.mesh(UNIT, size=lambda x, y: np.inf).triangles) == 2


def test_refining_again():
    coarse = delone.mesh(SQUARE, RINGS, holes=[[2, 2]], regions=[[0.5, 0.5, 3]], max_area=1, min_angle=25)
    low = coarse.points[coarse.triangles].mean(axis=1)[:, 1] < 1
    fine = coarse.refine(min_angle=25, max_areas=np.where(low, 0.05, np.inf))
    check(fine, SQUARE, RINGS)
    assert (fine.points[: len(coarse.points)] == coarse.points).all() and fine.area == pytest.approx(14)
    assert (fine.attributes == 3).all()
    corners, centroids = coarse.points[coarse.triangles[low]], fine.points[fine.triangles].mean(axis=1)
    inside = np.ones((len(centroids), len(corners)), bool)
    for k in range(3):
        p, q = corners[:, k], corners[:, (k + 1) % 3]
        step, to = q - p, centroids[:, None] - p
        inside &= step[:, 0] * to[..., 1] - step[:, 1] * to[..., 0] > 0
    assert fine.areas[inside.any(axis=1)].max() <= 0.05
    assert len(fine.triangles) > 2 * len(coarse.triangles)
    same = coarse.refine(min_angle=0)
    assert (same.points == coarse.points).all()
    assert {frozenset(t) for t in same.triangles.tolist()} == {frozenset(t) for t in coarse.triangles.tolist()}
    with pytest.raises(ValueError, match=r"max_areas must have the shape"):
        coarse.refine(max_areas=[1.0])
    with pytest.raises(ValueError, match=r"max_areas\[0\] is nan; it must be positive"):
        coarse.refine(max_areas=np.full(len(low), np.nan))


@pytest.mark.parametrize("seed", range(4))
def test_refining_again_starts_from_the_triangles_that_there_are(seed):
    """Points on slanted borders are rounded; beside them nothing comes back, and small angles of segments are not cut again."""
    random = np.random.default_rng(seed)
    points, segments = random.random((120, 2)), random.integers(0, 120, (24, 2))
    coarse = delone.mesh(points, segments, crossings="split", fill="all", min_angle=25)
    for angle in (0, 10, 25):
        same = coarse.refine(min_angle=angle)
        assert (same.points == coarse.points).all() and same.area == pytest.approx(coarse.area)
        assert {frozenset(t) for t in same.triangles.tolist()} == {frozenset(t) for t in coarse.triangles.tolist()}
        assert same.report.smallest_angle == coarse.report.smallest_angle > 0
    fine = coarse.refine(min_angle=25, max_area=coarse.area / 5000)
    check(fine, points, segments)
    assert fine.area == pytest.approx(coarse.area)
    assert np.delete(fine.areas, fine.report.left).max() <= coarse.area / 5000
    again = fine.refine(min_angle=25, max_area=coarse.area / 5000)
    assert (again.points == fine.points).all()


def test_what_is_kept():
    inner = [*UNIT, [0.4, 0.5], [0.6, 0.5]]
    segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]]
    for keep, at_border, at_all in (("nothing", False, False), ("border", True, False), ("constraints", True, True)):
        mesh = delone.mesh(inner, segments, keep=keep, max_edge=0.15, min_angle=0, fill="all")
        counts = np.bincount(mesh.segment_origin, minlength=5)
        assert (counts[:4] == 1).all() == at_border and (counts == 1).all() == at_all
        assert ("kept" in mesh.report.reasons) == (keep != "nothing")


def test_conforming_is_delaunay():
    points, segments = planar(3)
    mesh = delone.mesh(points, segments, fill="all", conforming=True, min_angle=0)
    check(mesh, points, segments)
    ends = mesh.points[mesh.segments]
    middle, square = ends.mean(axis=1), ((ends[:, 0] - ends[:, 1]) ** 2).sum(axis=1) / 4
    distance = ((mesh.points[:, None] - middle) ** 2).sum(axis=2)
    assert (distance >= square * (1 - 1e-9)).all()


def test_marked_triangles_are_refined_and_others_stay():
    coarse = delone.mesh(UNIT, max_area=0.002, min_angle=25)
    marked = np.linalg.norm(coarse.points[coarse.triangles].mean(axis=1) - 0.3, axis=1) < 0.1
    fine = coarse.refine(marked=marked, min_angle=25)
    assert (fine.points[: len(coarse.points)] == coarse.points).all()
    parents = fine.parents
    assert (parents >= 0).all() and (fine.areas <= np.where(marked, coarse.areas / 2, np.inf)[parents]).all()
    # Areas of children make up those of their parents, far from where anything changed.
    kept = {tuple(sorted(t)) for t in fine.triangles.tolist()} & {tuple(sorted(t)) for t in coarse.triangles.tolist()}
    assert len(kept) > 0.7 * len(coarse.triangles)
    assert 2 < np.isin(parents, np.flatnonzero(marked)).sum() / marked.sum() < 6
    again = coarse.refine(marked=np.flatnonzero(marked), min_angle=25)
    assert (again.triangles == fine.triangles).all()
    assert (coarse.parents == -1).all() and len(coarse.parents) == len(coarse.triangles)
    assert len(coarse.refine(marked=[], min_angle=25).triangles) == len(coarse.triangles)
    for wrong, error in [([len(coarse.triangles)], IndexError), ([-1], IndexError), ([True], ValueError), ([0.5], TypeError)]:
        with pytest.raises(error, match="marked"):
            coarse.refine(marked=wrong)


def test_budgets():
    mesh = delone.mesh(UNIT, max_area=0.001, max_vertices=7)
    assert len(mesh.points) == 11 and set(mesh.report.reasons) == {"budget"}
    with pytest.raises(ValueError, match="min_angle is 60"):
        delone.mesh(UNIT, min_angle=60)
    assert delone.mesh(UNIT, min_angle=35, max_area=0.1).report.smallest_angle >= 35
    assert "budget" in delone.mesh(UNIT, min_angle=50, max_area=0.01).report.reasons
    points, segments = planar(1)
    steep = delone.mesh(points, segments, min_angle=35, max_vertices=500)
    assert len(steep.points) <= len(points) + 500


def test_smoothing_keeps_what_was_asked_for():
    plain = delone.mesh(SQUARE, RINGS, min_angle=25, max_area=0.05)
    smooth = delone.mesh(SQUARE, RINGS, min_angle=25, max_area=0.05, smooth=5)
    check(smooth, SQUARE, RINGS)
    assert smooth.areas.max() <= 0.05 and angles(smooth)[0].min() >= 25 - 1e-9
    assert angles(smooth)[0].min(axis=1).mean() > angles(plain)[0].min(axis=1).mean()


def test_crossings():
    bow, ring = [[0, 0], [1, 1], [1, 0], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    with pytest.raises(delone.CrossingError, match="segments 0 and 2 cross") as caught:
        delone.mesh(bow, ring)
    assert caught.value.near == (0.5, 0.5)
    mesh = delone.mesh(bow, ring, crossings="split", max_area=0.01)
    check(mesh, bow, ring)
    assert mesh.area == pytest.approx(0.5)


def test_of_segments_that_overlap_the_first_counts():
    points = [[0, 0], [2, 0], [1, 0], [1, 1]]
    segments = [[2, 0], [0, 1], [1, 3], [3, 0], [0, 1]]
    mesh = delone.mesh(points, segments, fill="nonzero")
    assert dict(zip(map(tuple, mesh.segments.tolist()), mesh.segment_origin.tolist(), strict=True)) == {
        (2, 0): 0,
        (2, 1): 1,
        (1, 3): 2,
        (3, 0): 3,
    }


@pytest.mark.parametrize(
    ("points", "segments"),
    [(np.empty((0, 2)), None), ([[1, 2]], None), ([[0, 0], [1, 1], [2, 2]], [[0, 2]]), ([[1, 1]] * 4, [[0, 3]])],
)
@pytest.mark.parametrize("wanted", [{}, {"max_area": 0.1}, {"size": lambda x, y: 0.1}, {"max_edge": 1.0}, {"conforming": True}])
def test_nothing_to_mesh(points, segments, wanted):
    mesh = delone.mesh(points, segments, **wanted)
    assert mesh.triangles.shape == mesh.neighbors.shape == (0, 3) and mesh.segments.shape == (0, 2)
    assert mesh.report.smallest_angle == 0 and mesh.area == 0 and len(mesh.points) == len(points)


@pytest.mark.parametrize(
    ("wanted", "error", "words"),
    [
        ({"points": [[0, np.nan], [1, 0], [0, 1]]}, ValueError, "point 0 has the y coordinate nan"),
        ({"points": [0, 1, 2]}, ValueError, "must have the shape"),
        ({"points": [[0, 0, 0]]}, ValueError, "2 coordinates"),
        ({"points": [["a", "b"]]}, TypeError, "real numbers"),
        ({"segments": [[0, 7]]}, IndexError, "segment 0 ends at point 7"),
        ({"segments": [[0, -1]]}, IndexError, "point -1"),
        ({"segments": [[0.0, 1.0]]}, TypeError, "integers"),
        ({"segments": [0, 1]}, ValueError, "shape"),
        ({"holes": [[9, 9]]}, ValueError, "hole 0 at .9, 9. is outside of the hull"),
        ({"holes": [[0, 0]]}, ValueError, "hole 0"),
        ({"holes": [[np.inf, 0]]}, ValueError, "not finite"),
        ({"regions": [[9, 9, 1, 1]]}, ValueError, "region 0 at .9, 9. is outside of the hull"),
        ({"regions": [[1]]}, ValueError, "regions must have the shape"),
        ({"holes": [[2, 2]], "fill": "all"}, ValueError, "for fill='seeds'"),
        ({"fill": "odd"}, ValueError, "fill must be one of"),
        ({"keep": "all"}, ValueError, "keep must be one of"),
        ({"crossings": "ignore"}, ValueError, "crossings must be one of"),
        ({"conforming": "no"}, TypeError, "conforming must be True or False"),
        ({"min_angle": np.nan}, ValueError, "min_angle is NaN"),
        ({"min_angle": -1}, ValueError, "min_angle is -1"),
        ({"min_angle": "20"}, TypeError, "min_angle"),
        ({"min_angle": 60, "max_vertices": 10}, ValueError, "min_angle is 60"),
        ({"max_area": 0}, ValueError, "max_area is 0.0; it must be positive"),
        ({"max_area": np.nan}, ValueError, "max_area is nan"),
        ({"max_area": [1]}, TypeError, "max_area must be a number"),
        ({"max_area": 1e-300}, MemoryError, "vertices"),
        ({"max_edge": -1}, ValueError, "max_edge is -1.0"),
        ({"max_edge": 1e-200}, MemoryError, "vertices"),
        ({"max_vertices": -1}, ValueError, "max_vertices"),
        ({"max_vertices": 1.5}, TypeError, "max_vertices must be an integer"),
        ({"smooth": -1}, ValueError, "smooth"),
        ({"size": 0}, ValueError, "size is 0.0"),
        ({"size": [1, 2, 3]}, ValueError, r"size must have the shape \(7,\)"),
        ({"size": [1, 2, 3, 4, 0, 6, 7]}, ValueError, r"size\[4\] is 0.0"),
        ({"size": [1, 2, 3, 4, np.inf, 6, 7]}, ValueError, r"size\[4\] is inf"),
        ({"size": lambda x, y: np.nan}, ValueError, "the size wanted at .* is NaN"),
        ({"size": lambda x, y: -1}, ValueError, "is -1; it must be positive"),
        ({"size": lambda x, y: "a"}, TypeError, "real number"),
        ({"size": lambda x: 1}, TypeError, "positional argument"),
    ],
)
def test_what_is_refused(wanted, error, words):
    points, segments = wanted.pop("points", SQUARE), wanted.pop("segments", RINGS)
    with pytest.raises(error, match=words):
        delone.mesh(points, segments if len(np.shape(points)) == 2 and len(points) > 4 else None, **wanted)


class Odd(Exception):
    pass


def test_exceptions_of_a_size_are_passed_on():
    calls = []

    def size(x, y):
        calls.append((x, y))
        if len(calls) == 10:
            raise Odd("here")
        return 0.05

    with pytest.raises(Odd, match="here"):
        delone.mesh(UNIT, size=size)
    assert len(calls) == 10 and all(type(x) is float and 0 <= x <= 1 for x, _ in calls)


def test_copies_and_words():
    mesh = delone.mesh(SQUARE, RINGS, holes=[[2, 2]], max_area=0.3)
    for one in (mesh, mesh.refine(max_areas=np.full(len(mesh.triangles), 0.1))):
        again = pickle.loads(pickle.dumps(one))
        assert (again.points == one.points).all() and (again.triangles == one.triangles).all()
    assert repr(mesh).startswith("<delone.Mesh: ")
    with pytest.raises(TypeError, match=r"delone\.mesh makes meshes"):
        delone.Mesh()


@pytest.mark.parametrize("wanted", [{"max_area": 1e-7}, {"size": lambda x, y: 1e-3 + 1e-9 * x}])
def test_ctrl_c_ends_it(wanted):
    points = np.random.default_rng(1).random((200_000, 2))
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    try:
        timer.start()
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            delone.mesh(points, min_angle=33, **wanted)
        assert time.monotonic() - begin < 10
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


def test_others_go_on_meanwhile():
    points = np.random.default_rng(2).random((100_000, 2))
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    delone.mesh(points, min_angle=30)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(begin < at < end for at in ticks) >= 0.2 * (end - begin) / 0.005


def test_poissons_equation_converges(tmp_path):
    for name in ("skfem", "matplotlib"):
        pytest.importorskip(name)
    example = Path(__file__).parents[1] / "examples" / "poisson.py"
    command = [sys.executable, str(example), str(tmp_path / "poisson.png")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "the power of 2" in done.stdout or "the power of 1.9" in done.stdout
    assert (tmp_path / "poisson.png").stat().st_size > 10_000


def test_edges_have_the_length_that_is_wanted():
    for growth in (1.1, 1.2, 1.5):
        made = delone.mesh(SQUARE, RINGS, edge=0.2, growth=growth, min_angle=28)
        check(made, SQUARE, RINGS)
        found, lengths = angles(made)
        assert found.min() >= 28 and len(made.report.left) == 0
        assert 0.17 < lengths.mean() < 0.21 and lengths.max() < 0.3
        quality = 4 * 3**0.5 * made.areas / (lengths**2).sum(axis=1)
        assert abs(quality.mean() - made.shapes.quality_mean) < 1e-9
        assert made.shapes.quality_p5 == pytest.approx(np.sort(quality)[len(quality) // 20])
        assert made.shapes.quality_mean > 0.97 and 1 < made.shapes.step_p95 < 1.4
    order = np.random.default_rng(1).permutation(7)
    rank = np.argsort(order)
    again = delone.mesh(np.array(SQUARE)[order], rank[np.array(RINGS)], edge=0.2, growth=1.5, min_angle=28)
    places = [sorted(map(tuple, mesh.points.tolist())) for mesh in (made, again)]
    assert places[0] == places[1]


def test_wanted_lengths_differ_by_place():
    def length(x, y):
        return 0.02 + 0.2 * np.hypot(x, y)

    made = delone.mesh(UNIT, edge=np.inf, size=length, min_angle=28)
    by_points = delone.mesh(UNIT, edge=1, size=[length(*p) for p in UNIT], min_angle=28)
    for mesh in (made, by_points):
        _, lengths = angles(mesh)
        wanted = length(*mesh.points[mesh.triangles].mean(axis=1).T)
        assert 0.8 < np.median(lengths.mean(axis=1) / wanted) < 1.2
        assert mesh.shapes.quality_mean > 0.9
    finer = made.refine(edge=0.05, min_angle=28)
    assert len(finer.triangles) > len(made.triangles) and np.array_equal(finer.points[: len(made.points)], made.points)
    with pytest.raises(ValueError, match="give edge"):
        delone.mesh(UNIT, growth=1.5)
    for bad in ({"edge": 0}, {"edge": -1}, {"edge": np.nan}, {"edge": 0.1, "growth": 1}, {"edge": 0.1, "growth": np.nan}):
        with pytest.raises(ValueError, match=r"edge|growth"):
            delone.mesh(UNIT, **bad)
    with pytest.raises(ValueError, match=r"size|length"):
        delone.mesh(UNIT, edge=0.1, size=lambda x, y: float("nan"))
    with pytest.raises(ZeroDivisionError):
        delone.mesh(UNIT, edge=0.1, size=lambda x, y: 1 / 0)
    with pytest.raises(MemoryError):
        delone.mesh(UNIT, edge=1e-9)
