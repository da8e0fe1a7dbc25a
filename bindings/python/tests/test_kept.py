"""Meshes that there are stay as they are where nothing has to change: triangles, materials, data."""

import pickle
import warnings

import delone
import numpy as np
import pytest
from delone.triangle import triangulate


def grid(side=8, rising=True):
    """Unit squares cut along one diagonal."""
    x, y = np.meshgrid(np.arange(side + 1), np.arange(side + 1))
    points = np.column_stack([x.ravel(), y.ravel()]).astype(float)
    a = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    b, c, d = a + 1, a + side + 2, a + side + 1
    halves = [[a, b, c], [a, c, d]] if rising else [[a, b, d], [b, c, d]]
    return points, np.concatenate([np.column_stack(half) for half in halves])


def rows(triangles):
    """Triangles without order."""
    return set(map(tuple, np.sort(triangles, axis=1).tolist()))


@pytest.mark.parametrize("rising", [True, False])
def test_a_good_grid_stays(rising):
    points, triangles = grid(rising=rising)
    for wanted in ({"min_angle": 0}, {"min_angle": 30}, {"max_area": 0.5}):
        made = delone.mesh(points, triangles=triangles, **wanted)
        made.check()
        assert rows(made.triangles) == rows(triangles)
        assert made.parents.dtype == np.int64
        assert (np.sort(triangles[made.parents], axis=1) == np.sort(made.triangles, axis=1)).all()
        assert len(made.segments) == 32 and (made.segment_origin == -1).all()
    for switches in ("r", "rq30"):
        assert rows(triangulate({"vertices": points, "triangles": triangles}, switches)["triangles"]) == rows(triangles)


def test_only_what_is_marked_changes():
    points, triangles = grid()
    first = delone.mesh(points, triangles=triangles)
    corner = (first.points[first.triangles].mean(axis=1) < 2).all(axis=1)
    finer = first.refine(marked=corner)
    finer.check()
    far = (finer.points[finer.triangles] > 4).any(axis=(1, 2))
    assert rows(finer.triangles[far]) <= rows(triangles)
    assert len(finer.triangles) > len(triangles) + corner.sum() / 2
    assert finer.area == pytest.approx(64)
    # Data of old triangles go to new ones, twice.
    finest = finer.refine(marked=finer.areas > 0.4)
    centers = first.points[first.triangles].mean(axis=1)
    through = centers[finer.parents[finest.parents]]
    assert np.abs(through - finest.points[finest.triangles].mean(axis=1)).max() < 1.5


def test_materials_are_kept_with_their_areas():
    points, triangles = grid(4, rising=False)
    materials = np.where(points[triangles][:, :, 0].mean(axis=1) < 1.5, 3.0, 7.5)
    made = delone.mesh(points, triangles=triangles, attributes=materials, min_angle=32, max_area=0.1)
    made.check()
    for material in (3.0, 7.5):
        given = (materials == material).sum() / 2
        assert made.areas[made.attributes == material].sum() == pytest.approx(given)
    again = made.refine(max_area=0.02)
    assert again.areas[again.attributes == 3.0].sum() == pytest.approx((materials == 3.0).sum() / 2)
    copy = pickle.loads(pickle.dumps(again))
    assert (copy.triangles == again.triangles).all() and (copy.attributes == again.attributes).all()


def test_segments_and_repeated_points():
    points, triangles = grid(2)
    # Every triangle has corners of its own, as in files of surfaces.
    apart, corners = points[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3)
    made = delone.mesh(apart, triangles=corners, min_angle=0)
    assert len(made.triangles) == 8 and len(made.segments) == 8
    assert (np.sort(made.parents) == np.arange(8)).all()
    wall = delone.mesh(points, [[1, 4], [0, 1]], triangles=triangles, min_angle=0)
    origins = wall.segment_origin
    assert sorted(map(sorted, wall.segments[origins >= 0].tolist())) == [[0, 1], [1, 4]]
    assert sorted(origins.tolist()) == [-1] * 7 + [0, 1]


def test_functions_of_triangles():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    made = delone.mesh(square, refine_if=lambda corners, area: area > 0.001 + 0.02 * corners[:, 0].min())
    assert (made.areas <= 0.001 + 0.02 * made.points[made.triangles][:, :, 0].min(axis=1)).all()
    capped = delone.mesh(square, refine_if=lambda corners, area: True, max_vertices=100)
    assert len(capped.points) == 104 and set(capped.report.reasons) == {"budget"}
    with pytest.raises(ZeroDivisionError):
        delone.mesh(square, refine_if=lambda corners, area: 1 / 0)
    with pytest.raises(TypeError, match="refine_if must be a function"):
        delone.mesh(square, refine_if=3)
    data = {"vertices": square, "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
    fine = triangulate(data, "pqu", refine=lambda corners, area: area > 0.01)
    assert len(fine["triangles"]) > 100
    for switches, function in (("pq", lambda corners, area: True), ("pqu", None)):
        with pytest.raises(ValueError, match="go together"):
            triangulate(data, switches, refine=function)


def test_triangles_that_cannot_be_kept():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    for triangles, error, words in (
        ([[0, 1, 2], [0, 1, 3]], ValueError, "triangles cross each other .* near"),
        ([[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]], ValueError, "triangle . near .* crosses"),
        ([[0, 1, 1]], ValueError, "no area"),
        ([[0, 1, 2], [0, 2, 3], [2, 3, 0]], ValueError, "triangle 2 has the corners of an earlier one"),
        ([[0, 1, 4]], IndexError, "triangle 0 has the corners"),
        ([[0.5, 1, 2]], TypeError, "three integers"),
    ):
        with pytest.raises(error, match=words):
            delone.mesh(square, triangles=triangles)
    nested = [[0, 0], [9, 0], [0, 9], [1, 1], [3, 1], [1, 3]]
    with pytest.raises(ValueError, match="overlaps"):
        delone.mesh(nested, triangles=[[0, 1, 2], [3, 4, 5]])
    with pytest.raises(TypeError, match="bool"):
        delone.mesh(square, refine_if=lambda corners, area: "no")
    with pytest.raises(delone.CrossingError, match="segments 1 and 2 cross"):
        delone.mesh(square, [[0, 1], [0, 2], [1, 3]], triangles=[[0, 1, 2]])
    with pytest.raises(ValueError, match="say nothing of triangles"):
        delone.mesh(square, triangles=[[0, 1, 2]], fill="all")
    with pytest.raises(ValueError, match="give these, too"):
        delone.mesh(square, attributes=[1])
    with pytest.raises(ValueError, match="one number each"):
        delone.mesh(square, triangles=[[0, 1, 2]], attributes=[1, 2])
    # In Triangle's place there is a mesh, and a warning.
    with pytest.warns(UserWarning, match="made anew"):
        made = triangulate({"vertices": square, "triangles": [[0, 1, 2], [0, 2, 3], [0, 1, 3]]}, "r")
    assert len(made["triangles"])
    # Triangles without area hold nothing.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        given = [[0, 1, 2], [0, 2, 3], [0, 2, 2]]
        assert len(triangulate({"vertices": square, "triangles": given}, "r")["triangles"]) == 2


def test_meshes_are_made_coarser():
    made = delone.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], max_area=0.002)
    right = made.points[made.triangles].mean(axis=1)[:, 0] > 1
    coarse = made.coarsen(marked=right).coarsen(marked=[])
    coarse.check()
    assert len(coarse.triangles) < len(made.triangles) - right.sum() / 4
    assert coarse.area == pytest.approx(2) and coarse.report.smallest_angle >= 20
    assert rows(made.triangles[~right]) <= rows(coarse.triangles)
    assert len(coarse.points) == len(made.points)
    assert len(np.unique(coarse.triangles)) < len(np.unique(made.triangles))
    copy = pickle.loads(pickle.dumps(coarse))
    assert (copy.triangles == coarse.triangles).all()
    finer = coarse.refine(max_area=0.001)
    finer.check()
    assert finer.areas.max() <= 0.001
    for marked, error in (([True], ValueError), ([-1], IndexError), ([0.5], TypeError)):
        with pytest.raises(error):
            made.coarsen(marked=marked)
    with pytest.raises(ValueError, match="60"):
        made.coarsen(marked=[0], min_angle=60)


def test_points_that_nothing_uses_split_nothing():
    points, triangles = grid(3)
    centers = [[1.5, 1.25], [0.25, 0.5]]
    for more, corners in (
        (np.concatenate([points, centers]), triangles),
        (np.concatenate([centers, points]), triangles + 2),
        (np.concatenate([points[:1], centers, points[1:]]), np.where(triangles > 0, triangles + 2, 0)),
    ):
        made = delone.mesh(more, triangles=corners, min_angle=0)
        assert rows(made.triangles) == rows(corners) and (made.points == more).all()
        finer = made.refine(max_area=0.1)
        assert (finer.points[: len(more)] == more).all() and finer.area == pytest.approx(9)
        assert finer.areas.min() > 0


def test_coarsening_down_to_one_triangle_keeps_it():
    made = delone.mesh([[0, 0], [3, 0], [0, 3]], max_area=2, min_angle=0, keep="border")
    assert len(made.triangles) == 3 and made.coarsen(marked=[0, 1, 2], min_angle=0).area == 4.5
    halves = [[0, 1, 2], [1, 3, 2]]
    square = [[0, 0], [3, 0], [0, 3], [3, 3]]
    both = delone.mesh(square, triangles=halves, attributes=[1, 2], max_area=2, min_angle=0, keep="constraints")
    coarse = both.coarsen(marked=np.arange(len(both.triangles)), min_angle=0)
    assert [float(coarse.areas[coarse.attributes == k].sum()) for k in (1, 2)] == [4.5, 4.5]


def test_layers_are_counted_after_refinement_too():
    sides = [[0, 1], [1, 2], [2, 3], [3, 0]]
    walls = delone.Layers(0.01, 5, growth=1.4, segments=[0, 2])
    made = delone.mesh([[0, 0], [6, 0], [6, 1], [0, 1]], sides, edge=0.2, min_angle=28, layers=walls)
    finer = made.refine(marked=np.flatnonzero(~made.is_layer)[:9])
    assert finer.report.layers == made.report.layers
    with pytest.raises(ValueError, match="empty"):
        delone.mesh([[0, 0], [6, 0], [6, 1], [0, 1]], sides, layers=delone.Layers(0.01, segments=[]))


def test_quadrilaterals():
    made = delone.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], edge=0.1)
    corners, pairs, left = made.quads
    assert sorted([*pairs.ravel().tolist(), *left.tolist()]) == list(range(len(made.triangles)))
    x, y = made.points[corners].transpose(2, 0, 1)
    areas = ((x * np.roll(y, -1, axis=1)) - (y * np.roll(x, -1, axis=1))).sum(axis=1) / 2
    assert areas == pytest.approx(made.areas[pairs].sum(axis=1))
    walls = set(map(frozenset, made.segments.tolist()))
    assert not walls & set(map(frozenset, corners[:, [0, 2]].tolist()))
    assert len(left) < 0.2 * len(made.triangles)
    points, triangles = grid(4)
    assert len(delone.mesh(points, triangles=triangles).quads.corners) == 16


def test_quadrilaterals_alone():
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]
    made = delone.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], sides, edge=0.1)
    for smooth in (0, 5):
        quads = made.all_quads(smooth=smooth)
        assert len(quads.corners) == 4 * len(made.quads.corners) + 3 * len(made.quads.triangles)
        p = quads.points[quads.corners]
        u, v = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
        assert (u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0] > 0).all() and len(quads.left) == 0
        x, y = p.transpose(2, 0, 1)
        areas = ((x * np.roll(y, -1, axis=1)) - (y * np.roll(x, -1, axis=1))).sum(axis=1) / 2
        assert areas.sum() == pytest.approx(2)
        if smooth == 0:
            assert (quads.points[: len(made.points)] == made.points).all()
            whole = np.bincount(quads.triangles, areas, minlength=len(made.triangles))
            pairs = made.quads.pairs
            assert whole[pairs].sum(axis=1) == pytest.approx(made.areas[pairs].sum(axis=1))
        ends = np.sort(np.concatenate([quads.corners[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
        found, counts = np.unique(ends, axis=0, return_counts=True)
        alone = set(map(frozenset, found[counts == 1].tolist()))
        halves = list(map(frozenset, quads.segments.tolist()))
        border = {half for half, origin in zip(halves, quads.segment_origin.tolist(), strict=True) if origin < 4}
        assert alone == border and set(halves) <= set(map(frozenset, found.tolist()))
        middles = quads.points[quads.segments[0::2, 1]]
        assert (middles == quads.points[made.segments].mean(axis=1)).all()
    with pytest.raises(OverflowError):
        made.all_quads(smooth=-1)


def test_lengths_of_edges_make_all_anew():
    points, triangles = grid(2)
    made = delone.mesh(points / 2, triangles=triangles, edge=0.1, min_angle=30)
    made.check()
    assert made.shapes.quality_mean > 0.97 and made.area == pytest.approx(1)


def test_nodes_of_second_order_split_nothing() -> None:
    square = {"vertices": [[0, 0], [1, 0], [1, 1], [0, 1]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
    for first in ("po2", "pq30a0.2o2"):
        old = delone.triangle.triangulate(square, first)
        for switches in ("r", "rp", "rq30", "rj", "rpqaAe", "rq30o2en"):
            new = delone.triangle.triangulate(old, switches)
            assert len(new["triangles"]) == len(old["triangles"])
            if "j" not in switches:
                assert (new["vertices"][: len(old["vertices"])] == old["vertices"]).all()
        fine = delone.triangle.triangulate(old, "ra0.01")
        corners = fine["vertices"][fine["triangles"][:, :3]]
        (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        areas = (ux * vy - uy * vx) / 2
        assert len(areas) > 100 and areas.min() > 0 and areas.max() <= 0.01 and abs(areas.sum() - 1) < 1e-12
