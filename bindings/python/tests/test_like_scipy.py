"""Attributes, changes, options and pictures, beside SciPy; what is degenerate, beside fractions."""

import copy
import pickle
from fractions import Fraction
from itertools import pairwise

import delone
import matplotlib
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

matplotlib.use("Agg")
CLASSES = ["Delaunay", "Voronoi", "ConvexHull"]


def random_points(n, ndim, seed=0):
    return np.random.default_rng(seed).random((n, ndim))


def as_set(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def public(what):
    return {name for name in dir(what) if not name.startswith("_")}


@pytest.mark.parametrize("name", CLASSES)
@pytest.mark.parametrize("ndim", [2, 3])
def test_all_that_scipy_has_is_here(name, ndim):
    points = random_points(30, ndim)
    ours, theirs = (getattr(package, name)(points) for package in (delone, scipy.spatial))
    assert not public(theirs) - public(ours)
    for attribute in public(theirs):
        mine, other = getattr(ours, attribute), getattr(theirs, attribute)
        if isinstance(other, np.ndarray):
            assert mine.shape == other.shape and mine.dtype.kind in (other.dtype.kind, "b"), attribute
        elif not callable(other) and not isinstance(other, float):
            assert type(mine) is type(other), attribute


@pytest.mark.parametrize("name", CLASSES)
@pytest.mark.parametrize("ndim", [2, 3])
def test_points_are_added_until_it_is_closed(name, ndim):
    def parts(what):
        if name == "Voronoi":
            return [*map(sorted, what.regions), sorted(as_set(what.ridge_points)), what.vertices.tobytes()]
        return sorted(as_set(what.simplices))

    make = getattr(delone, name)
    rng = np.random.default_rng(ndim)
    for points in [rng.random((200, ndim)), rng.integers(0, 4, (200, ndim)).astype(float)]:
        for restart in (False, True):
            what = make(points[:1], incremental=True)
            for start, end in pairwise([1, 2, 4, 7, 50, 51, 51, 200]):
                what.add_points(points[start:end], restart=restart)
                if name == "ConvexHull":
                    whole = make(points[:end])
                    assert as_set(what.simplices) == as_set(whole.simplices)
                    assert np.isclose(what.volume, whole.volume) and np.isclose(what.area, whole.area)
                    assert set(what.vertices) == set(whole.vertices)
            assert parts(what) == parts(make(points, incremental=True))
            assert what.npoints == 200 and (what.points == points).all()
    what.close()
    what.close()
    with pytest.raises(RuntimeError, match="closed"):
        what.add_points(points)
    assert what.npoints == 200
    if name == "Delaunay":
        with pytest.raises(RuntimeError, match="closed"):
            what.remove(0)
        for other in (what.copy(), pickle.loads(pickle.dumps(what))):
            with pytest.raises(RuntimeError, match="closed"):
                other.add_points(points)


@pytest.mark.parametrize("name", CLASSES)
def test_copies_change_by_themselves(name):
    points = random_points(40, 2)
    what = getattr(delone, name)(points)
    for other in (copy.copy(what), copy.deepcopy(what), pickle.loads(pickle.dumps(what))):
        other.add_points(points + 1)
        assert (what.npoints, other.npoints) == (40, 80)
        if name == "Voronoi":
            assert (len(what.cells()), len(other.cells())) == (40, 80)
            assert (what.triangulation.npoints, other.triangulation.npoints) == (40, 80)


@pytest.mark.parametrize("ndim", [2, 3])
def test_facets_as_scipy(ndim):
    points = random_points(200, ndim)
    ours, theirs = delone.ConvexHull(points), scipy.spatial.ConvexHull(points)

    def across(hull):
        """For each facet and corner of it, by points, the facet that is a neighbor there."""
        facets = [tuple(sorted(row)) for row in hull.simplices.tolist()]
        rows = zip(hull.simplices.tolist(), hull.neighbors.tolist(), strict=True)
        return {(facets[k], corner): facets[n] for k, row in enumerate(rows) for corner, n in zip(*row, strict=True)}

    assert across(ours) == across(theirs)
    planes = [dict(zip(map(frozenset, h.simplices.tolist()), h.equations, strict=True)) for h in (ours, theirs)]
    assert all(np.allclose(plane, planes[1][facet], rtol=0, atol=1e-12) for facet, plane in planes[0].items())
    assert np.isclose(ours.area, theirs.area, rtol=1e-12) and np.isclose(ours.volume, theirs.volume, rtol=1e-12)
    assert (ours.min_bound == theirs.min_bound).all() and (ours.max_bound == theirs.max_bound).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_facets_that_a_point_sees(ndim):
    points = random_points(60, ndim)
    for eye in ([0.5] * ndim, [1.5] + [0.5] * (ndim - 1), [-3.0] * ndim):
        given = np.vstack([points, [eye]])
        seen = delone.ConvexHull(given, qhull_options="QG60")
        theirs = scipy.spatial.ConvexHull(given, qhull_options="QG60")
        assert as_set(seen.simplices) == as_set(theirs.simplices)
        assert as_set(seen.simplices[seen.good]) == as_set(theirs.simplices[theirs.good])
        unseen = delone.ConvexHull(given, qhull_options="QG-60 Pp")
        assert (unseen.good == ~seen.good).all()
        seen.add_points(points * 1.01)
        assert seen.good.shape == (seen.nsimplex,) and 60 not in seen.vertices
    cube = np.array(np.meshgrid(*[[0.0, 1.0]] * ndim)).reshape(ndim, -1).T
    level = delone.ConvexHull(np.vstack([cube, [[2.0] + [1.0] * (ndim - 1)]]), qhull_options=f"QG{len(cube)}")
    # Those in whose plane it is do not see it.
    assert level.good.sum() == ndim - 1


@pytest.mark.parametrize("ndim", [2, 3])
def test_points_on_the_hull_that_are_no_corners(ndim):
    grid = np.array(np.meshgrid(*[np.arange(4.0)] * ndim)).reshape(ndim, -1).T
    points = np.vstack([grid, grid[:3], grid[:1] + 0.5])
    assert delone.ConvexHull(points).coplanar.shape == scipy.spatial.ConvexHull(points).coplanar.shape == (0, 3)
    hull = delone.ConvexHull(points, qhull_options="Qc")
    on_border = ((points == 0) | (points == 3)).any(axis=1)
    expected = set(np.flatnonzero(on_border)) - set(hull.vertices)
    assert set(hull.coplanar[:, 0]) == expected
    # A point from which facets are seen is none of the hull.
    aside = np.vstack([points, [[9.0] * ndim]])
    assert (delone.ConvexHull(aside, qhull_options=f"Qc QG{len(points)}").coplanar == hull.coplanar).all()
    for point, facet, corner in hull.coplanar:
        assert hull.equations[facet, :-1] @ points[point] + hull.equations[facet, -1] == 0
        assert corner in hull.simplices[facet]


def exact_transform(corners):
    """The matrix of barycentric coordinates in fractions, by Cramer's rule, or None if it is flat."""
    ndim = corners.shape[1]
    last = [Fraction(x) for x in corners[-1].tolist()]
    sides = [[Fraction(x) - z for x, z in zip(row, last, strict=True)] for row in corners[:-1].tolist()]
    if ndim == 2:
        (a, b), (c, d) = sides
        whole, minors = a * d - b * c, [[d, -c], [-b, a]]
    else:

        def cross(p, q):
            return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

        minors = [cross(sides[1], sides[2]), cross(sides[2], sides[0]), cross(sides[0], sides[1])]
        whole = sum(x * y for x, y in zip(sides[0], minors[0], strict=True))
    return [[x / whole for x in row] for row in minors] if whole else None


@pytest.mark.parametrize("ndim", [2, 3])
def test_transforms_are_right_or_nan(ndim):
    rng = np.random.default_rng(ndim)
    third = np.linspace(0, 1, 7)[:, None] * np.array([0.1, 0.3, 0.7][:ndim])
    sets = [
        rng.random((60, ndim)),
        np.vstack([third, rng.random((5, ndim))]),
        np.round(rng.random((40, ndim)), 1),
        rng.random((40, ndim)) * 1e-200,
        rng.random((40, ndim)) * [1e-150, 1e150, 1][:ndim],
        np.vstack([rng.random((20, ndim)) * 1e-100, rng.random((20, ndim))]),
        rng.random((40, ndim)) + 1e9,
        rng.random((40, ndim)) * 1e-4 + 1e12,
        rng.random((40, ndim)) * 1e308,
    ]
    if ndim == 2:
        # Corners a, b, c of which two halves of one side differ by the rounding of a tenth.
        sets.append(np.array([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3], [0.1 + 0.2, 0.7], [0.7, 0.7 - 1e-16]]))
    eps, flat, total = Fraction(2) ** -52, 0, 0
    for points in sets:
        tri = delone.Delaunay(points)
        for row, transform in zip(tri.simplices, tri.transform, strict=True):
            exact, corners = exact_transform(points[row]), [list(map(Fraction, p)) for p in points[row].tolist()]
            largest = [max(abs(p[axis]) for p in corners) for axis in range(ndim)]
            change = max(sum(abs(x) * eps * size for x, size in zip(line, largest, strict=True)) for line in exact)
            total += 1
            if np.isnan(transform).any():
                flat += 1
                assert np.isnan(transform).all()
                # In space sums of products are larger than what is left of them.
                assert change * (1 if ndim == 2 else 10**6) > Fraction(1, 1100) or np.abs(points).max() > 1e300
                continue
            assert change < Fraction(1, 900) and (transform[-1] == points[row[-1]]).all()
            mine = [list(map(Fraction, line)) for line in transform[:-1].tolist()]
            for corner in corners:
                away = [x - z for x, z in zip(corner, corners[-1], strict=True)]
                for line, other in zip(mine, exact, strict=True):
                    assert abs(sum((m - x) * d for m, x, d in zip(line, other, away, strict=True))) < Fraction(1, 50)
    assert 0 < flat < total / 2


@pytest.mark.parametrize("ndim", [2, 3])
def test_what_scipy_calls_degenerate_has_no_transform(ndim):
    # All on one side of a plane, but for rounding.
    rng = np.random.default_rng(0)
    points = rng.random((60, ndim))
    points[:, -1] = (points[:, 0] / 3 + 0.1) * 3
    ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(np.vstack([points, [[5.0] * ndim]]))
    assert ours.nsimplex > 5
    assert np.isnan(ours.transform).all()
    degenerate = np.isnan(theirs.transform).all(axis=(1, 2))
    both = delone.Delaunay(theirs.points)
    rows = {tuple(sorted(row)): k for k, row in enumerate(both.simplices.tolist())}
    for row in theirs.simplices[degenerate].tolist():
        if tuple(sorted(row)) in rows:
            assert np.isnan(both.transform[rows[tuple(sorted(row))]]).all()


def test_pictures_of_scipy():
    import matplotlib.pyplot as plt

    points = random_points(30, 2)
    for figure in [
        scipy.spatial.delaunay_plot_2d(delone.Delaunay(points)),
        scipy.spatial.voronoi_plot_2d(delone.Voronoi(points)),
        scipy.spatial.voronoi_plot_2d(delone.Voronoi(points, furthest_site=True)),
        scipy.spatial.convex_hull_plot_2d(delone.ConvexHull(points)),
    ]:
        figure.canvas.draw()
        plt.close(figure)
    assert (scipy.spatial.tsearch(delone.Delaunay(points), points.mean(axis=0)[None]) >= 0).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_interpolators_of_scipy(ndim):
    points, queries = random_points(200, ndim), random_points(500, ndim, seed=1)
    values = np.sin(5 * points[:, 0])
    tri = delone.Delaunay(points)
    given = tri.to_scipy()
    assert isinstance(given, scipy.spatial.Delaunay)
    theirs = scipy.spatial.Delaunay(points)
    kinds = [scipy.interpolate.LinearNDInterpolator, scipy.interpolate.CloughTocher2DInterpolator][: 4 - ndim]
    for kind in kinds:
        assert np.allclose(kind(given, values)(queries), kind(theirs, values)(queries), equal_nan=True, atol=1e-6)
    assert (given.find_simplex(queries) == tri.find_simplex(queries)).all()
    assert (given.vertex_to_simplex >= 0).all() and len(given.convex_hull) == len(tri.convex_hull)
    tri.remove(0)
    assert given.npoints == 200 and 0 in given.simplices
    with pytest.raises(RuntimeError):
        given.add_points(queries)
    # Their own class alone is taken, and what else is given does not pass for numbers.
    with pytest.raises((TypeError, IndexError)):
        scipy.interpolate.LinearNDInterpolator(tri, values)
    with pytest.raises(ValueError, match="without simplices"):
        delone.Delaunay(points[:2]).to_scipy()


def test_furthest_sites_as_scipy():
    points = random_points(400, 2)
    ours, theirs = (package.Delaunay(points, furthest_site=True) for package in (delone, scipy.spatial))
    assert as_set(ours.simplices) == as_set(theirs.simplices) and ours.furthest_site
    assert as_set(ours.convex_hull) == as_set(theirs.convex_hull)
    queries = random_points(300, 2, seed=1) * 1.4 - 0.2
    mine, other = ours.find_simplex(queries), theirs.find_simplex(queries)
    assert ((mine < 0) == (other < 0)).all()
    inside = mine >= 0
    assert (np.sort(ours.simplices[mine[inside]]) == np.sort(theirs.simplices[other[inside]])).all()
    rows = {tuple(sorted(row)): k for k, row in enumerate(theirs.simplices.tolist())}
    for row, near in zip(ours.simplices.tolist(), ours.neighbors.tolist(), strict=True):
        k = rows[tuple(sorted(row))]
        at = [theirs.simplices[k].tolist().index(v) for v in row]
        expected = [tuple(sorted(theirs.simplices[n])) if n >= 0 else None for n in theirs.neighbors[k, at]]
        assert [tuple(sorted(ours.simplices[n])) if n >= 0 else None for n in near] == expected
    # All points are in each circle.
    assert (ours.plane_distance(points) < 1e-12).all()
    copies = [ours.copy(), pickle.loads(pickle.dumps(ours))]
    ours.add_points([[3.0, 3.0]])
    assert 400 in ours.simplices and all(len(c.simplices) == theirs.nsimplex for c in copies)
    for few in ([[0, 0]], [[0, 0], [1, 1]], [[0, 0], [1, 1], [2, 2]]):
        assert delone.Delaunay(few, furthest_site=True).find_simplex([0.0, 0.0]) == -1


def test_furthest_sites_have_regions_as_in_scipy():
    points = random_points(300, 2)
    ours, theirs = (package.Voronoi(points, furthest_site=True) for package in (delone, scipy.spatial))
    assert ours.furthest_site and len(ours.vertices) == len(theirs.vertices)
    assert as_set(ours.ridge_points) == as_set(theirs.ridge_points)
    has_region = ours.point_region >= 0
    assert set(np.flatnonzero(has_region)) == set(delone.ConvexHull(points).vertices)
    for p in np.flatnonzero(has_region):
        mine, other = ours.regions[ours.point_region[p]], theirs.regions[theirs.point_region[p]]
        mine, other = (
            np.sort(np.round(v.vertices[[k for k in r if k >= 0]], 6), axis=0) for v, r in ((ours, mine), (theirs, other))
        )
        assert mine.shape == other.shape and np.allclose(mine, other, atol=1e-5)
        # In order: the middle of two that follow each other is on the border of the region.
        ring = [k for k in ours.regions[ours.point_region[p]] if k >= 0]
        for a, b in pairwise(ring):
            far = np.linalg.norm(points - ours.vertices[[a, b]].mean(axis=0), axis=1)
            assert np.isclose(far.max(), far[p])


def test_regions_of_rounded_rings_end():
    """Vertices of equal bits are one, so that a ring may come to a vertex twice: it is the star of its point, and no longer."""
    for n in range(3, 60):
        turns = np.arange(n) / n * 2 * np.pi
        for center in ((0.0, 0.0), (1.0, 0.0), (500000.0, 5200000.0)):
            points = np.stack([np.cos(turns), np.sin(turns)], axis=1) + center
            for furthest in (False, True):
                voronoi = delone.Voronoi(points, furthest_site=furthest)
                degrees = np.bincount(voronoi.triangulation.simplices.ravel(), minlength=n)
                for p, degree in enumerate(degrees):
                    region = voronoi.regions[voronoi.point_region[p]] if degree else []
                    assert len(region) <= degree + 1, (n, center, furthest)
                    assert all(a != b for a, b in pairwise(region))


@pytest.mark.parametrize("furthest", [False, True])
def test_regions_are_counter_clockwise(furthest):
    voronoi = delone.Voronoi(random_points(100, 2), furthest_site=furthest)
    count = 0
    for region in voronoi.regions:
        x, y = voronoi.vertices[[v for v in region if v >= 0]].T
        if len(x) > 2:
            # Convex, and so are those that go on to infinity, as far as they are known.
            ax, ay = np.diff(x), np.diff(y)
            assert (ax[:-1] * ay[1:] - ay[:-1] * ax[1:] > 0).all()
            count += 1
    assert count > (2 if furthest else 50)


def test_the_empty_region_is_where_scipy_has_one():
    points = random_points(40, 2)
    for options, incremental in [(None, False), (None, True), ("Qbb Qc Qz", False), ("Qbb Qc", False), ("Qz", False)]:
        ours, theirs = (
            package.Voronoi(points, incremental=incremental, qhull_options=options) for package in (delone, scipy.spatial)
        )
        assert len(ours.regions) == len(theirs.regions)
        assert ours.regions.count([]) == theirs.regions.count([])
        assert [sorted(ours.regions[r]) == [] for r in ours.point_region] == [False] * 40
        offset = int(not incremental and options != "Qbb Qc")
        assert ours.point_region.tolist() == list(range(offset, 40 + offset))


@pytest.mark.parametrize("name", CLASSES)
def test_options_of_qhull(name):
    make, points = getattr(delone, name), random_points(10, 2)
    for good in ["", "Qbb Qc", "Qt Q12 Pp", b"Qx Qs", None, "QJ", "QJ1e-9 Pp", "Qz", "Q0", "QJ i", "Qt i", "o Fv", "s p Tv Pg"]:
        make(points, qhull_options=good)
    for bad, message in [
        ("Qbb bananas", "'bananas' is not supported: no such option"),
        ("Qu", "furthest_site=True"),
        ("C-0", "tolerance"),
        ("E0.1 A-0.9", "tolerance"),
        ("QV2", "not told apart"),
        ("Qi", "not listed"),
        ("QR3", "nothing is random"),
        ("QB0:0", "scale the points"),
        ("d Qt", "'d' is not supported"),
        ("Qt,Qz", "'Qt,Qz'"),
        ("Q", "'Q'"),
    ]:
        with pytest.raises(ValueError, match=message):
            make(points, qhull_options=bad)
    for wrong in (5, ["Qt"], True, 1.5):
        with pytest.raises(TypeError, match="must be a string"):
            make(points, qhull_options=wrong)
    if name == "ConvexHull":
        with pytest.raises(ValueError, match="QG10"):
            make(points, qhull_options="QG10")
    else:
        with pytest.raises(ValueError, match="only ConvexHull"):
            make(points, qhull_options="QG4")
        with pytest.raises(ValueError, match="nothing is joggled"):
            make(points[[0, 1, 2, 1]], qhull_options="QJ")
        what = make(points, qhull_options="QJ")
        with pytest.raises(ValueError, match="nothing is joggled"):
            what.add_points(points[:1])
        assert what.npoints == 10


def test_indices_are_integers_or_a_mask():
    points = random_points(50, 2)
    kept = np.arange(50) >= 5
    expected = as_set(np.flatnonzero(kept)[delone.Delaunay(points[kept]).simplices])
    for gone in [~kept, (~kept).tolist(), range(5), {0, 1, 2, 3, 4}, (k for k in range(5)), np.arange(5, dtype=np.uint64)]:
        tri = delone.Delaunay(points)
        tri.remove(gone)
        assert as_set(tri.simplices) == expected
    tri.remove([])
    tri.remove(np.zeros(50, dtype=bool))
    tri.remove(np.array([], dtype=int))
    assert as_set(tri.simplices) == expected
    for wrong in [
        [1.5],
        1.5,
        [1.0],
        True,
        None,
        "7",
        ["7"],
        [None],
        [[7, 8]],
        np.array(7.0),
        [7j],
        np.ma.array([7]),
        slice(7),
        {},
    ]:
        with pytest.raises((TypeError, IndexError)):
            tri.remove(wrong)
    for wrong in [True, [True, False], np.ones(49, dtype=bool), np.ones((50, 1), dtype=bool)]:
        with pytest.raises(IndexError, match=r"mask must have the shape \(50,\)"):
            tri.remove(wrong)
    for wrong in [-1, 50, 2**40, 2**64, [2**70], [-(2**70)], 0, ~kept, np.uint64(2**64 - 1)]:
        with pytest.raises(IndexError, match="is no vertex"):
            tri.remove(wrong)
    assert as_set(tri.simplices) == expected
