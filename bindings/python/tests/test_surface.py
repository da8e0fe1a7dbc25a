"""Interpolation beside SciPy, weights, gradients, rasters, contours, simplification."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import delone
import numpy as np
import pytest
import scipy.interpolate

METHODS = ["sibson", "laplace", "smooth", "farin"]


def random_points(n, ndim, seed=0):
    return np.random.default_rng(seed).random((n, ndim))


def plane(x):
    return x @ np.arange(1.0, 1.0 + x.shape[-1]) - 3


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize("method", METHODS)
def test_natural_neighbors_have_planes_and_values(ndim, method):
    points, queries = random_points(300, ndim), random_points(1000, ndim, 1) * 1.2 - 0.1
    f = delone.NaturalNeighborInterpolator(points, plane(points), method)
    linear = scipy.interpolate.LinearNDInterpolator(points, plane(points))
    assert np.allclose(f(queries), linear(queries), equal_nan=True, atol=1e-9)
    assert np.allclose(f(*queries.T), f(queries), equal_nan=True, rtol=0, atol=0)
    assert np.array_equal(f(points), plane(points))
    assert np.allclose(f.gradients(), np.arange(1.0, 1.0 + ndim), atol=1e-8)
    assert f(queries.reshape(10, 100, ndim)).shape == (10, 100) and f(points[0]).shape == (1,)


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize("method", METHODS)
def test_columns_are_alone(ndim, method):
    points, queries = random_points(200, ndim), random_points(500, ndim, 1) * 1.2 - 0.1
    tri = delone.Delaunay(points)
    values = np.stack([np.sin(5 * points[:, 0]), points[:, 1] ** 2, plane(points)], axis=1)
    f = delone.NaturalNeighborInterpolator(tri, values, method)
    each = [delone.NaturalNeighborInterpolator(tri, column, method)(queries) for column in values.T]
    assert f.tri is tri and np.array_equal(f(queries), np.stack(each, axis=1), equal_nan=True)
    complex_ = delone.NaturalNeighborInterpolator(tri, values[:, 0] + 1j * values[:, 1], method)
    inside = ~np.isnan(each[0])
    assert np.array_equal(complex_(queries)[inside], (each[0] + 1j * each[1])[inside])
    assert np.isnan(complex_(queries)[~inside]).all()
    cube = delone.NaturalNeighborInterpolator(tri, values[:, :2].repeat(2, 1).reshape(-1, 2, 2), method)
    assert cube(queries).shape == (500, 2, 2) and cube.gradients().shape == (200, 2, 2, ndim)
    assert np.allclose(complex_.gradients(), f.gradients()[:, 0] + 1j * f.gradients()[:, 1])
    assert delone.NaturalNeighborInterpolator(tri, values[:, :0], method)(queries).shape == (500, 0)
    again = pickle.loads(pickle.dumps(f))
    assert np.array_equal(again(queries), f(queries), equal_nan=True)


def test_gradients_that_are_given():
    points, queries = random_points(200, 2), random_points(500, 2, 1) * 0.8 + 0.1
    x, y = points.T
    values, slopes = x**2 - 3 * x * y + 2 * y**2, np.stack([2 * x - 3 * y, 4 * y - 3 * x], axis=1)
    wanted = queries[:, 0] ** 2 - 3 * queries[:, 0] * queries[:, 1] + 2 * queries[:, 1] ** 2
    f = delone.NaturalNeighborInterpolator(points, values, "farin", gradients=slopes)
    assert np.nanmax(abs(f(queries) - wanted)) < 1e-12 and np.array_equal(f.gradients(), slopes)
    stretch = np.array([1.0, 1000.0])
    g = delone.NaturalNeighborInterpolator(points * stretch, values, "farin", rescale=True, gradients=slopes / stretch)
    assert np.nanmax(abs(g(queries * stretch) - wanted)) < 1e-9 and np.allclose(g.gradients(), slopes / stretch)
    h = delone.NaturalNeighborInterpolator(points, values * (1 + 2j), "farin", gradients=slopes * (1 + 2j))
    assert np.nanmax(abs(h(queries) - wanted * (1 + 2j))) < 1e-12
    with pytest.raises(ValueError, match=r'for method="smooth"'):
        delone.NaturalNeighborInterpolator(points, values, gradients=slopes)
    with pytest.raises(ValueError, match=r"shape \(200, 2\)"):
        delone.NaturalNeighborInterpolator(points, values, "smooth", gradients=slopes.T)
    slopes[7] = np.nan
    with pytest.raises(ValueError, match="point 7 is not finite"):
        delone.NaturalNeighborInterpolator(points, values, "smooth", gradients=slopes)
    with pytest.raises(TypeError, match="as the values are"):
        delone.NaturalNeighborInterpolator(points, values, "smooth", gradients=slopes * 1j)


@pytest.mark.parametrize("ndim", [2, 3])
def test_weights(ndim):
    points, queries = random_points(200, ndim), random_points(500, ndim, 1) * 1.2 - 0.1
    tri, values = delone.Delaunay(points), np.sin(5 * points)
    inside = tri.find_simplex(queries) >= 0
    for f in [
        delone.LinearNDInterpolator(tri, values),
        *(delone.NaturalNeighborInterpolator(tri, values, method) for method in METHODS[:2]),
    ]:
        weights = f.weights(queries)
        assert weights.shape == (500, 200) and (weights.data >= 0).all()
        assert np.allclose(weights.sum(axis=1), inside, atol=1e-14)
        assert np.allclose((weights @ values)[inside], f(queries)[inside], atol=1e-14)
    near = delone.NaturalNeighborInterpolator(tri, values, outside="nearest")
    assert np.allclose(near.weights(queries).sum(axis=1), 1)
    assert np.array_equal(near(queries)[~inside], values[tri.nearest(queries[~inside])])
    with pytest.raises(ValueError, match="not finite"):
        near.weights([[np.nan] * ndim])
    with pytest.raises(ValueError, match="coordinates in"):
        near.weights([[1.0] * 5])


def test_linear_beside_griddata_and_regular_grids():
    points, queries = random_points(500, 2), random_points(2000, 2, 1)
    values = np.cos(points[:, 0] * 4) * points[:, 1]
    theirs = scipy.interpolate.griddata(points, values, queries, method="linear")
    assert np.allclose(delone.LinearNDInterpolator(points, values)(queries), theirs, equal_nan=True, atol=1e-12)
    assert delone.LinearInterpolator is delone.LinearNDInterpolator
    # On a lattice natural neighbors are near what is bilinear for a function that is.
    axis = np.arange(12.0)
    x, y = (side.ravel() for side in np.meshgrid(axis, axis, indexing="ij"))
    f = delone.NaturalNeighborInterpolator(np.stack([x, y], axis=1), x * y)
    grid = scipy.interpolate.RegularGridInterpolator((axis, axis), (x * y).reshape(12, 12))
    inner = queries * 9 + 1
    assert abs(f(inner) - grid(inner)).max() < 0.05


def test_fill_and_what_is_nan():
    points, values = random_points(50, 2), np.arange(50.0)
    values[:25] = np.nan
    queries = np.concatenate([random_points(200, 2, 1), [[5, 5], [np.nan, 0], [np.inf, 0]]])
    for make in [delone.LinearNDInterpolator, delone.NaturalNeighborInterpolator]:
        result = make(points, values, fill_value=-7)(queries)
        inside = delone.Delaunay(points).find_simplex(queries[:-2]) >= 0
        assert (result[:-2][~inside] == -7).all() and (result[-3:] == -7).all()
        assert (result[:-2][inside] != -7).all() and np.isnan(result).any()
        assert np.isnan(make(points, values, outside="nearest")([np.nan, 0]))
        assert make([[0, 0], [2, 0], [4, 0]], [0.0, 2.0, 4.0])([[1, 0], [1, 1]]).tolist()[0] == 1.0
        for none in ([], np.empty((0, 2))):
            if len(np.shape(none)) == 2:
                assert np.isnan(make(none, [])([[1.0, 2.0]])).all()
            assert make(points, values)(np.empty((0, 2))).shape == (0,)


def test_what_is_refused():
    points, values = random_points(50, 2), np.arange(50.0)
    make = delone.NaturalNeighborInterpolator
    for match, *arguments in [
        ("method must be one of", points, values, "cubic"),
        ("50 points need as many", points, values[1:]),
        ("masked", points, np.ma.masked_array(values, values > 0.5)),
        ("masked", np.ma.masked_array(points, points > 0.5), values),
        ("not finite", np.where(points > 0.9, np.nan, points), values),
        ("2 or 3 coordinates", random_points(50, 4), values),
        ("Rescaling is not supported", delone.Delaunay(points), values, "sibson", np.nan, True),
    ]:
        with pytest.raises(ValueError, match=match):
            make(*arguments)
    with pytest.raises(TypeError, match="values must be numbers"):
        make(points, ["a"] * 50)
    with pytest.raises(TypeError, match="fill_value"):
        make(points, values, fill_value="x")
    tri = delone.Delaunay(points)
    f = make(tri, values)
    tri.add_points([[2, 2]])
    with pytest.raises(ValueError, match="make an interpolator anew"):
        f(0.5, 0.5)


def test_threads_share_a_triangulation():
    points, queries = random_points(30_000, 2), random_points(50_000, 2, 1)
    f = delone.NaturalNeighborInterpolator(points, plane(points), "smooth")
    one = f(queries)
    with ThreadPoolExecutor(4) as pool:
        assert all(np.array_equal(other, one, equal_nan=True) for other in pool.map(f, [queries] * 4))


def test_rasters():
    points = random_points(500, 2) * [40, 30] + [1000.3, 2000.7]
    tri, z = delone.Delaunay(points), plane(points)
    f = delone.LinearNDInterpolator(tri, z)
    whole, transform = delone.rasterize(tri, z, cell=0.5)
    a, b, c, d, e, f_ = transform
    assert (a, b, d, e) == (0.5, 0, 0, -0.5) and c % 0.5 == 0 and f_ % 0.5 == 0
    rows, columns = np.indices(whole.shape)
    at = np.stack([c + (columns + 0.5) * a, f_ + (rows + 0.5) * e], axis=-1)
    assert np.allclose(whole, f(at), equal_nan=True, atol=1e-9)
    assert np.array_equal(delone.rasterize(points, z, transform, whole.shape), whole, equal_nan=True)
    for method in ["sibson", "laplace", "nearest"]:
        other = delone.rasterize(tri, z, transform, whole.shape, method=method)
        assert np.array_equal(np.isnan(other), np.isnan(whole))
        if method == "nearest":
            known = ~np.isnan(whole)
            assert np.array_equal(other[known], z[tri.nearest(at[known])])
        else:
            assert np.allclose(other, whole, equal_nan=True, atol=1e-8)
    short = delone.rasterize(tri, z, transform, whole.shape, max_edge=2.0, nodata=-9999, dtype="float32")
    assert short.dtype == np.float32 and ((short == -9999).sum() > np.isnan(whole).sum())
    south_up = delone.rasterize(tri, z, (0.5, 0, c, 0, 0.5, f_ - 0.5 * len(whole)), whole.shape)
    assert np.allclose(south_up[::-1], whole, equal_nan=True, atol=1e-9)


def left_out(tri, longest, anywhere):
    """The triangles that go for their length, by definition: next to nothing or to one that went, or wherever they are."""
    corners = tri.points[tri.simplices]
    is_long = (np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2) > longest).any(axis=1)
    gone = is_long & anywhere
    while True:
        beside = ((tri.neighbors < 0) | gone[tri.neighbors]).any(axis=1)
        if (gone >= (is_long & beside)).all():
            return gone
        gone |= is_long & beside


@pytest.mark.parametrize("is_constrained", [False, True])
@pytest.mark.parametrize("anywhere", [False, True])
def test_long_triangles(anywhere, is_constrained):
    """A lake in the middle of many points, a bay, and a point far away."""
    shapely = pytest.importorskip("shapely")
    points = random_points(3000, 2) * 40
    dry = np.linalg.norm(points - 20, axis=1) > 8
    dry &= np.linalg.norm(points - [40, 10], axis=1) > 9
    points = np.vstack([points[dry], [[20, 90]]])
    z, longest = plane(points), 3.0
    if is_constrained:
        tri = delone.ConstrainedDelaunay(points, [[0, 1]], fill="all", crossings="split")
    else:
        tri = delone.Delaunay(points)
    gone = left_out(tri, longest, anywhere)
    assert 0 < gone.sum() < len(gone) and (gone != left_out(tri, longest, not anywhere)).any()
    which = {"max_edge_anywhere" if anywhere else "max_edge": longest}
    if not is_constrained:
        whole, transform = delone.rasterize(tri, z, cell=0.5)
        rows, columns = np.indices(whole.shape)
        at = np.stack([transform[2] + (columns + 0.5) / 2, transform[5] - (rows + 0.5) / 2], axis=-1)
        found = tri.find_simplex(at)
        expected = np.where((found < 0) | gone[found], np.nan, whole)
        assert np.array_equal(delone.rasterize(points, z, transform, whole.shape, **which), expected, equal_nan=True)
    bands = delone.contours(tri, z, interval=5.0, bands=True, **which)
    area = shapely.area(shapely.polygons(tri.points[tri.simplices[~gone]])).sum()
    assert abs(sum(shapely.geometry.shape(band).area for band in bands) - area) < 1e-8
    assert len(delone.contours(tri, z, interval=5.0, **which)) > 0


def test_rasters_with_affine_and_xarray():
    affine, xarray = pytest.importorskip("affine"), pytest.importorskip("xarray")
    points = random_points(100, 2) * 10
    transform = affine.Affine(1, 0, 0, 0, -1, 10)
    values = delone.rasterize(points, points[:, 0], transform, (10, 10))
    made = delone.rasterize(points, points[:, 0], cell=1, as_xarray=True)
    assert isinstance(made, xarray.DataArray) and np.array_equal(made.values, values, equal_nan=True)
    assert made.x.values.tolist() == [k + 0.5 for k in range(10)] and made.y.values[0] == 9.5
    assert affine.Affine(*made.attrs["transform"]) == transform
    assert abs(made.sel(x=5.5, y=4.5).item() - 5.5) < 1e-12


def test_rasters_of_what_is_inside():
    square = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [3, 3], [1, 3]]
    rings = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    tri = delone.ConstrainedDelaunay(square, rings, holes=[[2, 2]])
    values = delone.rasterize(tri, np.arange(8.0), (1, 0, 0, 0, -1, 4), (4, 4))
    assert np.isnan(values).sum() == 4 and np.isnan(values[1:3, 1:3]).all()
    bands = delone.contours(tri, np.zeros(8), levels=[-1], bands=True)
    assert len(bands) == 1 and [len(ring) for ring in bands[0].polygons[0]] == [5, 5]
    with pytest.raises(ValueError, match="linear"):
        delone.rasterize(tri, np.arange(8.0), cell=1, method="sibson")


def test_rasters_in_the_box_of_the_points():
    points = random_points(300, 2)
    z = 2 * points[:, 0] - points[:, 1]
    values, transform = delone.rasterize(points, z, shape=(20, 30))
    (west, south), (east, north) = points.min(axis=0), points.max(axis=0)
    assert values.shape == (20, 30) and (transform[2], transform[5]) == (west, north)
    assert np.allclose([west + 30 * transform[0], north + 20 * transform[4]], [east, south])
    x, y = west + (np.arange(30) + 0.5) * (east - west) / 30, north - (np.arange(20) + 0.5) * (north - south) / 20
    inside = ~np.isnan(values)
    assert inside.sum() > 500 and np.allclose(values[inside], (2 * x[None, :] - y[:, None])[inside])
    alone, same = delone.rasterize(np.column_stack([points, z]), shape=(20, 30), method="natural")
    assert same == transform and np.array_equal(
        alone, delone.rasterize(points, z, transform, (20, 30), method="sibson"), equal_nan=True
    )
    assert len(delone.contours(np.column_stack([points, z]), interval=0.5)) == len(delone.contours(points, z, interval=0.5)) > 0
    for match, given in [("has no heights", delone.Delaunay(points)), (r"shape \(n, 3\), not \(300, 2\)", points)]:
        with pytest.raises(ValueError, match=match):
            delone.rasterize(given, shape=(20, 30))


def test_rasters_that_are_refused():
    points, z = random_points(50, 2), np.arange(50.0)
    for match, arguments in [
        ("give transform and shape, or shape alone, or cell", dict()),
        ("no box to share", dict(shape=(0, 2))),
        ("instead of transform", dict(cell=1, shape=(2, 2))),
        ("must not rotate", dict(transform=(1, 2, 3, 4, 5, 6), shape=(2, 2))),
        ("six numbers", dict(transform=(1, 2), shape=(2, 2))),
        ("rows, columns", dict(transform=(1, 0, 0, 0, -1, 0), shape=(2,))),
        ("rows, columns", dict(transform=(1, 0, 0, 0, -1, 0), shape=(-2, 2))),
        ("size of a cell", dict(transform=(0, 0, 0, 0, -1, 0), shape=(2, 2))),
        ("size of a cell", dict(cell=-1)),
        ("max_edge must be positive", dict(cell=1, max_edge=0)),
        ("max_edge_anywhere must be positive", dict(cell=1, max_edge_anywhere=-1)),
        ("not both", dict(cell=1, max_edge=1, max_edge_anywhere=1)),
        ("method must be", dict(cell=1, method="smooth")),
    ]:
        with pytest.raises(ValueError, match=match):
            delone.rasterize(points, z, **arguments)
    with pytest.raises(TypeError, match="dtype"):
        delone.rasterize(points, z, cell=1, dtype=int)
    with pytest.raises(MemoryError, match="cells"):
        delone.rasterize(points, z, (1, 0, 0, 0, -1, 0), (2**30, 2**30))
    for match, at, heights in [
        ("point 3 has the height nan", points, np.where(z == 3, np.nan, z)),
        (r"shape \(50,\)", points, z[1:]),
        ("masked", points, np.ma.masked_array(z, z > 3)),
        ("no points", np.empty((0, 2)), []),
        ("2 coordinates", random_points(50, 3), z),
        ("of the plane", delone.Delaunay(random_points(50, 3)), z),
    ]:
        with pytest.raises(ValueError, match=match):
            delone.rasterize(at, heights, cell=1)


def test_contours():
    shapely = pytest.importorskip("shapely")
    points = random_points(400, 2)
    z = np.sin(6 * points[:, 0]) + np.cos(5 * points[:, 1])
    lines = delone.contours(points, z, interval=0.25, base=0.1)
    f = delone.LinearNDInterpolator(points, z)
    for level, line in lines:
        assert line.shape[1] == 2 and abs((level - 0.1) / 0.25 - round((level - 0.1) / 0.25)) < 1e-9
        heights = f(line)
        assert np.nanmax(abs(heights - level), initial=0) < 1e-9
    assert {line.is_closed for line in lines} == {True, False}
    bands = delone.contours(delone.Delaunay(points), z, interval=0.25, base=0.1, bands=True)
    areas = [shapely.geometry.shape(band) for band in bands]
    assert all(area.is_valid for area in areas)
    hull = shapely.MultiPoint(points).convex_hull.area
    assert abs(sum(area.area for area in areas) - hull) < 1e-9
    assert [band.lower for band in bands] == sorted(band.lower for band in bands)
    both = delone.contours(points, z, [0.1, 0.6])
    assert sorted({level for level, _ in both}) == [0.1, 0.6]
    assert shapely.geometry.shape(both[0]).length > 0
    assert delone.contours(points, z, 99.0) == [] and delone.contours(np.empty((0, 2)), [], 1.0) == []


def test_contours_that_are_refused():
    points, z = random_points(50, 2), np.arange(50.0)
    for match, arguments in [
        ("either levels", dict()),
        ("either levels", dict(levels=[1], interval=2)),
        ("finite", dict(levels=[np.nan])),
        ("interval of contours", dict(interval=0)),
        ("number of levels", dict(interval=1e-9)),
        ("list of numbers", dict(levels=[[1, 2]])),
        ("max_edge", dict(levels=[1], max_edge=-1)),
    ]:
        with pytest.raises(ValueError, match=match):
            delone.contours(points, z, **arguments)


def test_simplify():
    points = random_points(3000, 2)
    z = np.sin(6 * points[:, 0]) + np.cos(5 * points[:, 1])
    left = delone.simplify(points, z, max_error=0.02)
    assert left.error <= 0.02 and 10 < len(left.indices) < 1500
    mesh = delone.Delaunay(points[left.indices])
    assert {frozenset(t) for t in left.triangles.tolist()} == {frozenset(t) for t in mesh.simplices.tolist()}
    off = abs(delone.LinearNDInterpolator(mesh, z[left.indices])(points) - z)
    assert abs(np.nanmax(off) - left.error) < 1e-9
    shuffled = np.random.default_rng(5).permutation(3000)
    again = delone.simplify(points[shuffled], z[shuffled], max_error=0.02)
    assert set(shuffled[again.indices]) == set(left.indices) and again.error == left.error
    fewer = delone.simplify(points, z, max_points=100)
    assert len(fewer.indices) == 100 and fewer.error > left.error
    # An edge that was asked for is there, also where its ends are given twice.
    twice = np.concatenate([points, points[:2]])
    held = delone.simplify(twice, np.concatenate([z, z[:2]]), max_points=50, segments=[[3000, 3001]])
    edges = {frozenset(t[[i, i - 1]].tolist()) for t in held.indices[held.triangles] for i in range(3)}
    path = [frozenset(e) for e in edges if e <= {0, 1}]
    assert path == [frozenset({0, 1})]


def test_simplify_refuses_and_takes_little():
    points, z = random_points(50, 2), np.arange(50.0)
    for match, arguments in [
        ("how far", dict()),
        ("largest error", dict(max_error=-1)),
        ("largest error", dict(max_error=np.nan)),
        ("negative", dict(max_points=-1)),
        ("two indices", dict(max_error=1, segments=[1, 2])),
    ]:
        with pytest.raises(ValueError, match=match):
            delone.simplify(points, z, **arguments)
    with pytest.raises(IndexError, match="point 99"):
        delone.simplify(points, z, max_error=1, segments=[[0, 99]])
    with pytest.raises(delone.CrossingError):
        delone.simplify([[0, 0], [1, 1], [0, 1], [1, 0]], np.zeros(4), max_error=1, segments=[[0, 1], [2, 3]])
    line = delone.simplify([[0, 0], [1, 1], [2, 2]], np.zeros(3), max_error=1)
    assert line.indices.tolist() == [0, 1, 2] and line.triangles.shape == (0, 3)
    assert len(delone.simplify(np.empty((0, 2)), [], max_error=1).indices) == 0


@pytest.mark.parametrize("ndim", [2, 3])
def test_the_order_of_queries_does_not_show(ndim):
    points, queries = random_points(2000, ndim), random_points(3000, ndim, 1) * 1.2 - 0.1
    order = np.random.default_rng(2).permutation(3000)
    for method in METHODS:
        f = delone.NaturalNeighborInterpolator(points, np.sin(9 * points), method)
        alone = np.concatenate([f(queries[k : k + 50]) for k in range(0, 3000, 50)])
        assert np.array_equal(f(queries), alone, equal_nan=True)
        assert np.array_equal(f(queries[order]), alone[order], equal_nan=True)
        assert (f.weights(queries[order]) != f.weights(queries)[order]).nnz == 0


def everyday_terrains():
    """What is surveyed, scanned and gridded: coordinates with few digits, turned, far from the origin."""
    random = np.random.default_rng(1).random((400, 2))
    lattice = np.stack(np.meshgrid(np.arange(16.0), np.arange(16.0)), axis=-1).reshape(-1, 2)
    for far in ((0, 0), (500000, 5200000)):
        for step in (0.1, 0.3, 1 / 3):
            yield lattice * step + far
        for degrees in (1, 17, 30, 45, 61):
            sin, cos = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
            yield lattice @ np.array([[cos, sin], [-sin, cos]]) + far
        for digits in (2, 3):
            yield np.round(random * 100 + far, digits)
    yield np.floor(random * 60)


def test_contours_are_valid_to_shapely():
    shapely = pytest.importorskip("shapely")
    refused = 0
    for number, points in enumerate(everyday_terrains()):
        tri = delone.Delaunay(points)
        x, y = ((points - points.mean(axis=0)) / np.ptp(points, axis=0)).T
        smooth = 10 + 8 * np.sin(7 * x) * np.cos(5 * y) + 3 * x
        for heights, interval in ((smooth, 0.5), (np.floor(smooth), 1), (np.floor(smooth * 3), 2)):
            bands = [shapely.geometry.shape(band) for band in delone.contours(tri, heights, interval=interval, bands=True)]
            assert shapely.is_valid(bands).all(), number
            if not shapely.coverage_is_valid(bands):
                # It refuses one where exact arithmetic finds nothing: an almost straight border beside a point where bands touch.
                assert len(shapely.STRtree(bands).query(bands, predicate="overlaps")[0]) == 0, number
                refused += 1
            hull = shapely.MultiPoint(points).convex_hull.area
            assert abs(shapely.union_all(bands).area - hull) < 1e-9 * hull, number
            found = delone.contours(tri, heights, interval=interval)
            lines, levels = [shapely.LineString(line.points) for line in found], np.array([line.level for line in found])
            assert shapely.is_simple(lines).all(), number
            for predicate in ("crosses", "overlaps"):
                one, other = shapely.STRtree(lines).query(lines, predicate=predicate)
                # Lines of one level may touch, at a saddle.
                wrong = levels[one] != levels[other] if predicate == "crosses" else one >= 0
                assert not wrong.any(), (number, predicate)
    assert refused <= 1


@pytest.mark.parametrize("ndim", [2, 3])
def test_calls_are_those_of_scipy(ndim):
    random = np.random.default_rng(3)
    points, values = random_points(100, ndim), random.random((100, 2))
    ours = delone.LinearNDInterpolator(tuple(points.T), values)
    theirs = scipy.interpolate.LinearNDInterpolator(tuple(points.T), values)
    shapes = [(), (1,), (2,), (3,), (5, 1), (1, 4), (2, 2), (ndim,), (2, 3, 1), (0,)]
    for _ in range(300):
        parts = [random.uniform(0.2, 0.8, shapes[random.integers(len(shapes))]) for _ in range(ndim)]
        whole = random.uniform(0.2, 0.8, (*shapes[random.integers(len(shapes))], ndim))
        pair = random.uniform(0.2, 0.8, ndim * 2)
        calls = [
            parts,
            [tuple(parts)],
            [whole],
            [whole.tolist()],
            [pair],
            [list(pair)],
            [tuple(pair[:ndim])],
            [tuple(whole.tolist())],
        ]
        for arguments in calls:
            if isinstance(arguments[0], list) and np.size(arguments[0]) == 0:
                continue
            try:
                expected = theirs(*arguments)
            except (ValueError, IndexError):
                with pytest.raises(ValueError):
                    ours(*arguments)
                continue
            found = ours(*arguments)
            assert found.shape == expected.shape
            assert np.allclose(found, expected, equal_nan=True, atol=1e-12)


def test_values_on_the_border_and_beyond():
    sin, cos = np.sin(0.3), np.cos(0.3)
    points = np.array([(x, y) for x in range(6) for y in range(6)], float) @ np.array([[cos, sin], [-sin, cos]])
    values = plane(points)
    hull = delone.ConvexHull(points)
    for method in METHODS:
        f = delone.NaturalNeighborInterpolator(points, values, method)
        beyond = delone.NaturalNeighborInterpolator(points, values, method, outside="hull")
        for i, j in hull.simplices:
            share = np.linspace(0, 1, 101)[:, None]
            edge = points[i] + share * (points[j] - points[i])
            assert np.allclose(f(edge), plane(edge), atol=1e-9)
            away = edge[1:-1] + 1e-9 * (edge[1:-1] - points.mean(axis=0))
            assert np.allclose(beyond(away), plane(edge[1:-1]), atol=1e-7)
        assert np.isnan(f([[9.0, 9.0]])).all() and np.isfinite(beyond([[9.0, 9.0], [-50, 3]])).all()
    weights = delone.LinearNDInterpolator([[0, 0], [4, 0], [0, 4]], [0, 1, 2], outside="hull").weights([[1.0, -7.0]])
    assert weights.toarray().tolist() == [[0.75, 0.25, 0.0]]


def test_duplicates_have_one_rule():
    corners = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 2], [2, 2], [2, 2]]
    z = [0.0, 0.0, 0.0, 0.0, 7.0, 3.0, 8.0]
    place, shape = (4 / 3, 0, 0, 0, -4 / 3, 4), (3, 3)
    for rule, height in {"lowest": 3.0, "first": 7.0, "highest": 8.0, "mean": 6.0}.items():
        for points in (corners, delone.Delaunay(corners), delone.ConstrainedDelaunay(corners, [[0, 1]], fill="all")):
            values = delone.rasterize(points, z, place, shape, duplicates=rule)
            assert values[1, 1] == pytest.approx(height, rel=1e-12)
            assert delone.contours(points, z, levels=[height - 0.5], duplicates=rule)
            assert not delone.contours(points, z, levels=[height + 0.5], duplicates=rule)
    assert delone.rasterize(corners, z, place, shape)[1, 1] == pytest.approx(3.0, rel=1e-12)
    assert z[4] == 7.0
    with pytest.raises(ValueError, match="duplicates must be one of"):
        delone.rasterize(corners, z, place, shape, duplicates="middle")
