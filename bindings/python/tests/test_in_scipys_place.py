"""delone.scipy: what callers of SciPy rely on, beside SciPy itself."""

import collections
import copy
import functools
import itertools
import pickle
import sys
import threading
import types

import delone
import delone.scipy as spatial
import matplotlib
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

matplotlib.use("Agg")
RANDOM = np.random.default_rng(52)
CLASSES = ["Delaunay", "Voronoi", "ConvexHull"]
CUBE = np.array(list(itertools.product([0.0, 1.0], repeat=3)))
GRID = np.stack(np.meshgrid(*[np.linspace(0, 1, 5)] * 3), -1).reshape(-1, 3)


def turned(points, seed):
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return points @ turn


@pytest.mark.parametrize("name", CLASSES)
@pytest.mark.parametrize("ndim", [2, 3, 4])
def test_classes_are_those_of_both(name, ndim):
    points = RANDOM.random((40, ndim))
    made, theirs = getattr(spatial, name)(points), getattr(scipy.spatial, name)
    assert isinstance(made, theirs) and isinstance(made, getattr(spatial, name)) and issubclass(type(made), theirs)
    assert isinstance(theirs(points), getattr(spatial, name)), "what SciPy has made counts too"
    assert isinstance(made, getattr(delone, name)) == (ndim < 4)
    assert not isinstance(getattr(delone, name)(points[:, :2]), theirs)
    area = functools.singledispatch(lambda shape: "another")
    area.register(theirs, lambda shape: "SciPy's")
    assert area(made) == "SciPy's"


@pytest.mark.parametrize("name", CLASSES)
@pytest.mark.parametrize("ndim", [2, 3])
def test_copies_and_pickles_keep_the_class_and_what_was_assigned(name, ndim):
    made = getattr(spatial, name)(RANDOM.random((40, ndim)))
    made.mine = "kept"
    for other in (copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
        assert type(other) is type(made) and other.mine == "kept"
        assert np.array_equal(other.points, made.points) and other.points.flags.writeable
    derived = type("Derived", (getattr(spatial, name),), {})
    assert isinstance(derived(RANDOM.random((9, ndim))), derived) and not isinstance(made, derived)


@pytest.mark.parametrize("ndim", [2, 3])
def test_all_that_scipys_have_can_be_assigned(ndim):
    tri = spatial.Delaunay(RANDOM.random((40, ndim)))
    before = tri.simplices.copy()
    for name in ("simplices", "neighbors", "equations", "coplanar", "good"):
        setattr(tri, name, "anything")
        assert getattr(tri, name) == "anything"
    tri.add_points(RANDOM.random((1, ndim)))
    assert len(tri.simplices) > len(before), "after a change they are made again"
    tri.points[0] = 0.5


@pytest.mark.parametrize("ndim", [2, 3])
def test_flat_input_is_an_error_of_qhull(ndim):
    flat = np.column_stack([RANDOM.random((20, ndim - 1)), np.zeros(20)])
    for points in (flat, flat[:1], np.repeat(flat[:1], 9, axis=0), CUBE[:2, :ndim]):
        for name in CLASSES:
            with pytest.raises(scipy.spatial.QhullError, match="do not span"):
                getattr(spatial, name)(points)
            with pytest.raises(scipy.spatial.QhullError):
                getattr(scipy.spatial, name)(points)
        with pytest.raises(scipy.spatial.QhullError):
            spatial.LinearNDInterpolator(points, np.zeros(len(points)))
    # By rounding alone it is not flat.
    if ndim == 3:
        with pytest.raises(scipy.spatial.QhullError, match="do not span"):
            spatial.ConvexHull(turned(flat, 5))


WRONG = {
    "nothing": np.empty((0, 2)),
    "a number": 3.0,
    "a row": np.zeros(6),
    "NaN": np.array([[0, 0], [1, 0], [0, np.nan], [1, 1]]),
    "infinite": np.array([[0, 0], [1, 0], [0, np.inf], [1, 1]]),
    "words": [["a", "b"], ["c", "d"]],
    "cube": np.zeros((2, 2, 2)),
    "None": None,
    "ragged": [[0, 0], [1], [2, 3]],
    "masked": np.ma.array(np.eye(4, 2), mask=np.eye(4, 2, dtype=bool)),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("what", WRONG)
@pytest.mark.parametrize("name", CLASSES)
def test_what_scipy_refuses_is_refused_as_the_same(name, what):
    # SciPy's hull ends the process for three dimensions of an array.
    other = "Delaunay" if what == "cube" else name
    with pytest.raises(Exception) as theirs:
        getattr(scipy.spatial, other)(WRONG[what])
    with pytest.raises(Exception) as ours:
        getattr(spatial, name)(WRONG[what])
    assert isinstance(ours.value, theirs.type), (ours.value, theirs.value)


@pytest.mark.parametrize("name", CLASSES)
def test_wrong_arguments_are_told(name):
    make = getattr(spatial, name)
    for args, options in [((), {}), ((CUBE,), {"no_such": 1}), ((CUBE, False, False, "Qt", 5, 6), {})]:
        with pytest.raises(TypeError):
            make(*args, **options)


@pytest.mark.parametrize("merge", [-1.0, np.nan, np.inf, 99.0])
def test_lengths_that_cannot_be_are_value_errors(merge):
    with pytest.raises(ValueError, match="merge"):
        spatial.ConvexHull(CUBE, merge=merge)
    with pytest.raises(ValueError, match="merge"):
        delone.ConvexHull(CUBE[:, :2], merge=merge)
    if not merge > 1:
        with pytest.raises(ValueError, match="merge"):
            spatial.Voronoi(CUBE, merge=merge)
    with pytest.raises(TypeError, match="merge"):
        spatial.ConvexHull(CUBE, merge=[])


def test_numbers_are_rounded_as_numpy_does():
    points = RANDOM.random((30, 2))
    for other in (
        points.astype(np.longdouble) / 3,
        points.astype(object),
        np.ma.array(points),
        (points * 2**60).astype(np.int64),
    ):
        assert np.array_equal(spatial.Delaunay(other).points, np.asarray(other, dtype=float))
    assert spatial.LinearNDInterpolator(points, np.ma.array(points[:, 0]))(0.5, 0.5) == pytest.approx(0.5)


def test_both_sides_of_a_facet_name_it_alike():
    tri = spatial.Delaunay(RANDOM.random((300, 3)))
    facets = collections.Counter(f for s in tri.simplices.tolist() for f in itertools.combinations(s, 3))
    single = {f for f, n in facets.items() if n == 1}
    assert single == set(map(tuple, tri.convex_hull.tolist())) and set(facets.values()) == {1, 2}
    for row, (corners, others) in enumerate(zip(tri.simplices, tri.neighbors, strict=True)):
        for k, other in enumerate(others):
            if other >= 0:
                assert row in tri.neighbors[other] and set(np.delete(corners, k)) <= set(tri.simplices[other])
    # What follows from the rows is of these rows.
    at = RANDOM.random((200, 3)) * 0.6 + 0.2
    found = tri.find_simplex(at)
    maps = tri.transform[found]
    first = np.einsum("nij,nj->ni", maps[:, :3], at - maps[:, 3])
    weights = np.column_stack([first, 1 - first.sum(axis=1)])
    assert (weights > -1e-9).all()
    assert np.allclose(np.einsum("nk,nkj->nj", weights, tri.points[tri.simplices[found]]), at)
    assert (tri.plane_distance(at)[np.arange(200), found] > -1e-12).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_scipys_compiled_code_takes_triangulations(ndim):
    points = RANDOM.random((200, ndim))
    values = np.sin(3 * points[:, 0]) + points[:, 1]
    at = RANDOM.random((500, ndim))
    tri = spatial.Delaunay(points)
    ours, theirs = (scipy.interpolate.LinearNDInterpolator(t, values)(at) for t in (tri, scipy.spatial.Delaunay(points)))
    assert np.allclose(ours, theirs, equal_nan=True, rtol=0, atol=1e-12)
    assert np.allclose(spatial.LinearNDInterpolator(tri, values)(at), theirs, equal_nan=True, rtol=0, atol=1e-12)
    if ndim == 2:
        linear = spatial.LinearNDInterpolator(points, values)
        smooth = [scipy.interpolate.CloughTocher2DInterpolator(t, v)(at) for t, v in ((tri, values), (linear.tri, linear.values))]
        theirs = scipy.interpolate.CloughTocher2DInterpolator(points, values, tol=1e-12)(at)
        for found in (smooth[0], smooth[1][..., 0], spatial.CloughTocher2DInterpolator(points, values, tol=1e-12)(at)):
            assert np.allclose(found, theirs, equal_nan=True, rtol=0, atol=1e-5)
    assert np.array_equal(spatial.tsearch(tri, at), tri.find_simplex(at))


def test_clough_tocher_has_linear_functions_as_they_are():
    points = RANDOM.random((300, 2)) * [1000.0, 0.01]
    at = points[:100] * 0.3 + points[100:200] * 0.7
    for values in (points @ [3.0, -500.0] + 7, np.stack([points @ [1.0, 1e4], points @ [2.0, 0.0]], axis=1)):
        expected = values[:100] * 0.3 + values[100:200] * 0.7
        for options in ({}, {"rescale": True}):
            f = spatial.CloughTocher2DInterpolator(points, values, **options)
            assert np.allclose(f(at), expected, rtol=1e-12, atol=1e-12 * np.abs(values).max())
            assert isinstance(f, scipy.interpolate.CloughTocher2DInterpolator) and isinstance(f.tri, spatial.Delaunay)
    complex_values = points @ [1.0 + 2.0j, 3.0j]
    assert np.allclose(spatial.CloughTocher2DInterpolator(points, complex_values)(at), at @ [1.0 + 2.0j, 3.0j])
    with pytest.raises(ValueError):
        spatial.CloughTocher2DInterpolator(points, np.zeros(7))
    assert np.isnan(spatial.CloughTocher2DInterpolator(points, np.full(300, np.nan))(at)).all()


@pytest.mark.parametrize("method", ["linear", "nearest", "cubic"])
@pytest.mark.parametrize("ndim", [1, 2, 3, 4])
def test_griddata_is_as_scipys(method, ndim):
    points = RANDOM.random((80, ndim))
    values = np.cos(points.sum(axis=1))
    at = RANDOM.random((40, ndim))
    for form in (lambda p: p, lambda p: tuple(p.T)):
        for options in ({}, {"rescale": True, "fill_value": -1.0}):
            try:
                expected = scipy.interpolate.griddata(form(points), values, form(at), method=method, **options)
            except ValueError:
                with pytest.raises(ValueError):
                    spatial.griddata(form(points), values, form(at), method=method, **options)
                continue
            found = spatial.griddata(form(points), values, form(at), method=method, **options)
            assert found.shape == expected.shape
            assert np.allclose(found, expected, equal_nan=True, rtol=0, atol=1e-4)
    with pytest.raises(ValueError):
        spatial.griddata(points, values, at, method="no such")


@pytest.mark.parametrize("seed", range(10))
def test_turned_grids_have_the_corners_of_their_box(seed):
    points = turned(GRID, seed) * 10.0 ** (seed - 5) + seed
    hull = spatial.ConvexHull(points)
    assert (len(hull.vertices), len(hull.simplices), len(hull.facets)) == (8, 12, 6)
    assert len(np.unique(hull.equations, axis=0)) == 6
    size = np.abs(points).max()
    assert (points @ hull.equations[:, :3].T + hull.equations[:, 3]).max() < 1e-12 * size
    exact = spatial.ConvexHull(points, merge=None)
    assert len(exact.simplices) > 12 and np.isclose(exact.volume, hull.volume) and np.isclose(exact.area, hull.area)
    theirs = scipy.spatial.ConvexHull(points)
    assert np.isclose(theirs.volume, hull.volume) and np.isclose(theirs.area, hull.area)
    for facet in hull.facets:
        assert len(facet) == 4 and len(set(facet.tolist())) == 4
    for row, others in enumerate(hull.neighbors):
        for k, other in enumerate(others):
            assert len(set(np.delete(hull.simplices[row], k)) & set(hull.simplices[other])) == 2
    with_points = spatial.ConvexHull(points, qhull_options="Qc")
    assert len(with_points.coplanar) == 98 - 8


@pytest.mark.parametrize("seed", range(5))
def test_points_that_are_added_may_take_corners_away(seed):
    points = turned(GRID, seed)
    whole = spatial.ConvexHull(points)
    parts = spatial.ConvexHull(points[:40], incremental=True)
    parts.add_points(points[40:])
    assert np.array_equal(parts.simplices, whole.simplices)


LATTICES = {
    "sc": (np.eye(3), 6),
    "bcc": (np.array([[-1, 1, 1], [1, -1, 1], [1, 1, -1.0]]) / 2, 14),
    "fcc": (np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0.0]]) / 2, 12),
    "hex": (np.array([[1, 0, 0], [-0.5, 3**0.5 / 2, 0], [0, 0, 1.6]]), 8),
}


@pytest.mark.parametrize("name", LATTICES)
def test_cells_of_lattices_have_the_faces_that_they_have(name):
    axes, faces = LATTICES[name]
    steps = np.array(list(itertools.product([-1, 0, 1], repeat=3)))
    rng = np.random.default_rng(len(name))
    for k in range(100):
        cell = axes * rng.uniform(0.5, 9.0)
        sites = steps @ cell @ np.linalg.qr(rng.normal(size=(3, 3)))[0]
        diagram = spatial.Voronoi(sites)
        own = [ridge for pair, ridge in zip(diagram.ridge_points, diagram.ridge_vertices, strict=True) if 13 in pair]
        assert len(own) == faces and all(-1 not in ridge for ridge in own), (k, len(own))
        hull = spatial.ConvexHull(diagram.vertices[diagram.regions[diagram.point_region[13]]])
        assert len(hull.facets) == faces and np.isclose(hull.volume, abs(np.linalg.det(cell)))


def half_spaces(ndim, count, seed):
    normals = np.random.default_rng(seed).normal(size=(count, ndim))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.column_stack([normals, -np.random.default_rng(seed + 1).uniform(1, 2, count)])


@pytest.mark.parametrize("ndim", [2, 3, 4])
def test_half_spaces_meet_where_scipy_says(ndim):
    for seed in range(5):
        given = half_spaces(ndim, 60, seed)
        ours, theirs = (package.HalfspaceIntersection(given, np.zeros(ndim)) for package in (spatial, scipy.spatial))
        assert isinstance(ours, scipy.spatial.HalfspaceIntersection)
        order = [np.lexsort(made.intersections.T.round(9)) for made in (ours, theirs)]
        assert np.allclose(ours.intersections[order[0]], theirs.intersections[order[1]], rtol=1e-9)
        assert np.array_equal(ours.dual_vertices, theirs.dual_vertices)
        assert np.isclose(ours.dual_volume, theirs.dual_volume) and np.isclose(ours.dual_area, theirs.dual_area)
        assert {frozenset(f) for f in ours.dual_facets} == {frozenset(f) for f in theirs.dual_facets}
        assert (given[:, :-1] @ ours.intersections.T + given[:, -1:]).max() < 1e-9
        more = half_spaces(ndim, 10, seed + 100)
        grown = spatial.HalfspaceIntersection(given, np.zeros(ndim), incremental=True)
        grown.add_halfspaces(more)
        whole = spatial.HalfspaceIntersection(np.vstack([given, more]), np.zeros(ndim))
        assert np.allclose(np.sort(grown.intersections, axis=0), np.sort(whole.intersections, axis=0))


def test_half_spaces_that_cannot_be():
    cube = np.vstack([np.column_stack([np.eye(3), -np.ones(3)]), np.column_stack([-np.eye(3), -np.ones(3)])])
    made = spatial.HalfspaceIntersection(cube, [0.0, 0.0, 0.5])
    assert len(made.intersections) == 8 and np.allclose(np.abs(made.intersections), 1)
    for point in ([0, 0, 1.0], [0, 0, 3.0]):
        with pytest.raises(scipy.spatial.QhullError, match="feasible"):
            spatial.HalfspaceIntersection(cube, point)
    for wrong in (np.zeros(3), np.zeros((2, 2, 2)), np.full((4, 4), np.nan)):
        with pytest.raises(ValueError):
            spatial.HalfspaceIntersection(wrong, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="interior_point"):
        spatial.HalfspaceIntersection(cube, [0.0, 0.0])
    # A half-space that leaves the point out is refused, and what there was stays.
    with pytest.raises(scipy.spatial.QhullError):
        made.add_halfspaces([1.0, 0.0, 0.0, 0.5])
    assert made.nineq == 6 and len(made.intersections) == 8
    made.close()
    with pytest.raises(RuntimeError):
        made.add_halfspaces(cube)


@pytest.mark.parametrize("away", [1e-3, 1e-6, 1e-9, 1e-12])
def test_half_spaces_seen_from_near_a_border(away):
    # A box with a cut corner; its corners are known.
    rows = [[*(np.eye(3)[k] * sign), -1.0] for k in range(3) for sign in (1, -1)]
    given = np.array([*rows, [1.0, 1.0, 1.0, -2.0]])
    corners = np.array([p for p in itertools.product([-1.0, 1.0], repeat=3) if sum(p) < 2] + [[1, 1, 0], [1, 0, 1], [0, 1, 1]])
    for point in ([1 - away, 0.2, 0.1], [away - 1, away - 1, 0.3], [2 / 3 - away] * 3):
        for merge in ("auto", None):
            found = spatial.HalfspaceIntersection(given, point, merge=merge).intersections
            nearest = np.linalg.norm(found[:, None] - corners[None], axis=2).min(axis=1)
            assert len(found) == len(corners) and nearest.max() < 1e-3 * away + 1e-9, (point, merge)


@pytest.mark.parametrize("seed", range(60))
def test_planes_of_exact_facets_have_no_point_outside(seed):
    points = turned(GRID, seed)
    hull = spatial.ConvexHull(points, merge=None)
    assert np.isfinite(hull.equations).all()
    assert (points @ hull.equations[:, :3].T + hull.equations[:, 3]).max() < 1e-12


def test_values_may_be_others():
    points = RANDOM.random((50, 2))
    f = spatial.LinearNDInterpolator(points, points[:, 0])
    f.values = points[:, 1]
    assert f(0.5, 0.4) == pytest.approx(0.4)
    with pytest.raises(ValueError):
        f.values = points[1:, 1]
    tri = spatial.Delaunay(points)
    tri.good[0] = 0
    assert tri.good[0] == 0
    hull = spatial.ConvexHull(points)
    before = hull.simplices.copy()
    hull.vertices[:] = 0
    assert np.array_equal(hull.simplices, before) and hull.vertices.flags.c_contiguous


def test_options_that_only_qhull_has_are_left_to_it():
    points = RANDOM.random((30, 2))
    assert type(spatial.Delaunay(points, qhull_options="Qbb Qt Qc C-0")) is scipy.spatial.Delaunay
    assert isinstance(spatial.Delaunay(points, qhull_options="Qt Qbb Qc"), delone.Delaunay)
    twins = np.repeat(points, 2, axis=0)
    assert len(set(spatial.Delaunay(twins, qhull_options="QJ Pp").simplices.ravel())) == 60
    flat = np.column_stack([points, np.zeros(30)])
    assert len(spatial.ConvexHull(flat, qhull_options="QJ").simplices) > 0
    with pytest.raises(scipy.spatial.QhullError):
        spatial.Delaunay(points, qhull_options="no such option")


def test_furthest_sites_in_space_are_scipys():
    points = RANDOM.normal(size=(50, 3))
    centers = spatial.Voronoi(points, furthest_site=True).vertices
    radii = np.linalg.norm(centers[:, None] - points[None], axis=2).max(axis=1)
    assert np.isfinite(radii.min())
    assert isinstance(spatial.Voronoi(points[:, :2], furthest_site=True), delone.Voronoi)


def test_pictures_are_drawn():
    points = RANDOM.random((30, 2))
    for draw, name in [("delaunay_plot_2d", "Delaunay"), ("voronoi_plot_2d", "Voronoi"), ("convex_hull_plot_2d", "ConvexHull")]:
        figure = getattr(spatial, draw)(getattr(spatial, name)(points))
        assert figure.axes
        matplotlib.pyplot.close(figure)


def test_other_names_are_scipys():
    assert spatial.cKDTree is scipy.spatial.cKDTree and spatial.SphericalVoronoi is scipy.spatial.SphericalVoronoi
    assert spatial.distance is scipy.spatial.distance and spatial.RBFInterpolator is scipy.interpolate.RBFInterpolator
    with pytest.raises(AttributeError, match="no_such"):
        _ = spatial.no_such


def test_programs_of_others_have_ours_within_a_patch():
    program = types.ModuleType("a_program_of_others")
    source = "from scipy.spatial import Delaunay, ConvexHull as Hull\nimport scipy.interpolate\n"
    exec(source, program.__dict__)
    sys.modules[program.__name__] = program
    points = RANDOM.random((30, 2))
    kinds = program.Delaunay, program.Hull, scipy.interpolate.griddata
    try:
        before = scipy.spatial.Delaunay(points)
        with spatial.patched():
            assert program.Delaunay is spatial.Delaunay and program.Hull is spatial.ConvexHull
            assert scipy.spatial.Voronoi is spatial.Voronoi and scipy.interpolate.griddata is spatial.griddata
            assert isinstance(before, program.Delaunay)
            assert isinstance(program.Delaunay(points), delone.Delaunay)
            # Other threads too.
            seen = []
            thread = threading.Thread(target=lambda: seen.append(type(program.Hull(points))))
            thread.start()
            thread.join()
            assert seen == [spatial.ConvexHull]
            with spatial.patched():
                pass
            assert program.Delaunay is spatial.Delaunay
        assert kinds == (program.Delaunay, program.Hull, scipy.interpolate.griddata)
        with pytest.raises(ZeroDivisionError), spatial.patched():
            _ = 1 / 0
        assert scipy.spatial.Delaunay is kinds[0]
    finally:
        del sys.modules[program.__name__]
