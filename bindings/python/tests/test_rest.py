"""Voronoi diagrams, hulls, interpolation, pictures, interruption."""

import os
import signal
import threading
import time

import delone
import matplotlib
import numpy as np
import pytest
import scipy.interpolate
import scipy.spatial

matplotlib.use("Agg")


def random_points(n, ndim, seed=0):
    return np.random.default_rng(seed).random((n, ndim))


def shapes(vertices, lists):
    """Lists of vertices by coordinates, without order."""

    def key(v):
        return "infinity" if v < 0 else tuple(np.round(vertices[v], 6).tolist())

    return {frozenset(key(v) for v in one) for one in lists if len(one)}


@pytest.mark.parametrize("ndim", [2, 3])
def test_voronoi_as_scipy(ndim):
    points = random_points(120, ndim)
    ours, theirs = delone.Voronoi(points), scipy.spatial.Voronoi(points)
    # Vertices far away are not the same to six places.
    near = [np.abs(v.vertices).max(axis=1) < 5 for v in (ours, theirs)]
    mine, other = (np.round(v.vertices[k], 6) for v, k in zip((ours, theirs), near, strict=True))
    assert {tuple(v) for v in mine.tolist()} == {tuple(v) for v in other.tolist()}
    assert {tuple(sorted(p)) for p in ours.ridge_points.tolist()} == {tuple(sorted(p)) for p in theirs.ridge_points.tolist()}

    def ridges(v):
        return {tuple(sorted(p)): len(r) for p, r in zip(v.ridge_points.tolist(), v.ridge_vertices, strict=True)}

    assert ridges(ours) == ridges(theirs)
    for p in range(len(points)):
        mine = ours.regions[ours.point_region[p]]
        other = theirs.regions[theirs.point_region[p]]
        assert len(mine) == len(other), p
        assert (-1 in mine) == (-1 in other)
    assert len(ours.ridge_dict) == len(ours.ridge_points)
    assert "120 points" in repr(ours)


def test_a_grid_has_square_cells():
    grid = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
    voronoi = delone.Voronoi(grid)
    assert len(voronoi.vertices) == 12
    assert sorted(len(region) for region in voronoi.regions)[-6:] == [4] * 6
    cubes = np.stack(np.meshgrid(*[np.arange(3.0)] * 3), axis=-1).reshape(-1, 3)
    voronoi = delone.Voronoi(cubes)
    assert len(voronoi.vertices) == 8
    assert max(len(region) for region in voronoi.regions) == 8
    assert sorted(map(len, voronoi.ridge_vertices)) == [3] * 24 + [4] * 6


def test_cells_tile_their_region():
    voronoi = delone.Voronoi(random_points(200, 2))

    def area(ring):
        x, y = ring.T
        return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2

    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    hole = [[0.4, 0.4], [0.4, 0.6], [0.6, 0.6], [0.6, 0.4]]
    for region, expected in [(square, 1.0), ([square, hole], 0.96), (np.array(square, float), 1.0)]:
        cells = voronoi.cells(region)
        assert len(cells) == 200
        assert np.isclose(sum(area(ring) for cell in cells for ring in cell), expected)
    assert all(len(cell) == 1 for cell in voronoi.cells())
    assert delone.Voronoi([[0, 0], [0, 0], [1, 1]]).cells()[1] == []
    with pytest.raises(ValueError, match="ring 0 of the region"):
        voronoi.cells([[0, 0], [1, 1], [1, 0], [0, 1]])
    with pytest.raises(NotImplementedError):
        delone.Voronoi(random_points(10, 3)).cells()


@pytest.mark.parametrize("n", [0, 1, 2, 3])
def test_small_voronoi_diagrams(n):
    for ndim in (2, 3):
        voronoi = delone.Voronoi(random_points(n, ndim))
        assert len(voronoi.point_region) == n
        if ndim == 2:
            assert len(voronoi.cells()) == n


@pytest.mark.parametrize("ndim", [2, 3])
def test_hulls_as_scipy(ndim):
    points = random_points(500, ndim)
    ours, theirs = delone.ConvexHull(points), scipy.spatial.ConvexHull(points)
    assert set(ours.vertices.tolist()) == set(theirs.vertices.tolist())
    assert {tuple(sorted(s)) for s in ours.simplices.tolist()} == {tuple(sorted(s)) for s in theirs.simplices.tolist()}
    assert np.isclose(ours.area, theirs.area) and np.isclose(ours.volume, theirs.volume)
    assert (points @ ours.equations[:, :-1].T + ours.equations[:, -1] < 1e-12).all()
    if ndim == 2:
        start = theirs.vertices.tolist().index(ours.vertices[0])
        assert ours.vertices.tolist() == np.roll(theirs.vertices, -start).tolist()
    line = delone.ConvexHull(np.arange(5.0)[:, None] * np.ones(ndim))
    assert line.nsimplex == 0 and line.volume == 0.0 and line.area == 0.0
    assert "facets" in repr(ours)


@pytest.mark.parametrize("ndim", [2, 3])
def test_interpolation_as_scipy(ndim):
    points = random_points(400, ndim)
    queries = random_points(2000, ndim, seed=1) * 1.2 - 0.1
    for values in [np.sin(5 * points[:, 0]), random_points(400, 3, seed=2), np.exp(1j * points[:, 0])]:
        ours = delone.LinearInterpolator(points, values)
        theirs = scipy.interpolate.LinearNDInterpolator(points, values)
        assert np.allclose(ours(queries), theirs(queries), equal_nan=True, atol=1e-9)
        axes = [queries[:, k].reshape(50, 40) for k in range(ndim)]
        assert np.allclose(ours(*axes), theirs(*axes), equal_nan=True, atol=1e-9)
    stretched = points * np.array([1.0, 1e4, 1.0][:ndim])
    ours = delone.LinearInterpolator(stretched, points[:, 0], rescale=True)
    theirs = scipy.interpolate.LinearNDInterpolator(stretched, points[:, 0], rescale=True)
    assert np.allclose(ours(stretched * 0.9), theirs(stretched * 0.9), equal_nan=True, atol=1e-6)


def test_interpolation_outside():
    points, values = random_points(50, 2), np.arange(50.0)
    tri = delone.Delaunay(points)
    assert np.isnan(delone.LinearInterpolator(tri, values)([5.0, 5.0]))
    assert delone.LinearInterpolator(tri, values, fill_value=-1)([5.0, 5.0]) == -1
    near = delone.LinearInterpolator(tri, values, outside="nearest")
    assert near([5.0, 5.0]) == tri.nearest([5.0, 5.0])
    assert np.isnan(near([np.nan, 0.0]))
    assert np.allclose(near(points), values)
    for wrong in [dict(values=values[1:]), dict(values=["a"] * 50), dict(values=values, outside="x")]:
        with pytest.raises((TypeError, ValueError)):
            delone.LinearInterpolator(points, **wrong)
    with pytest.raises(ValueError, match="2 of coordinates"):
        near(1.0, 2.0, 3.0)
    with pytest.raises(ValueError, match="last axis"):
        near([1.0, 2.0, 3.0])


def test_pictures():
    import matplotlib.pyplot as plt

    for what in [
        delone.Delaunay(random_points(30, 2)),
        delone.Delaunay(random_points(30, 3)),
        delone.Delaunay([[0, 0], [1, 1], [2, 2]]),
        delone.Voronoi(random_points(30, 2)),
    ]:
        axes = delone.plot(what)
        axes.figure.canvas.draw()
        plt.close(axes.figure)
    tri = delone.Delaunay(random_points(30, 2))
    assert tri._repr_svg_().startswith("<svg") and delone.Delaunay(random_points(30, 3))._repr_svg_() is None
    assert delone.Delaunay([[1, 1]])._repr_svg_().endswith("</svg>")


def test_ctrl_c_ends_a_long_build(request):
    # Who starts tests in the background may have told them to ignore the signal.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    points = random_points(1_000_000, 3)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    start = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(20):
            delone.Delaunay(points)
    assert time.monotonic() - start < 0.3 + 1.0


def test_other_threads_run_meanwhile():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.001):
            ticks.append(1)

    ticking = threading.Thread(target=tick)
    ticking.start()
    delone.Delaunay(random_points(300_000, 2)).find_simplex(random_points(100_000, 2))
    stop.set()
    ticking.join()
    assert len(ticks) > 5


def test_cocircular_points_of_any_kind_share_a_vertex():
    angle = np.radians(30.0)
    # Rotated by Pythagorean triples, so that corners of squares are on one circle exactly.
    turn = np.array([[3.0, -4.0], [4.0, 3.0]])
    grid = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2) @ turn.T / 8 + np.cos(angle)
    grid = np.round(grid * 2**40) / 2**40
    assert len(delone.Voronoi(grid).vertices) == 49


def test_hulls_and_shapes_are_drawn() -> None:
    import matplotlib.pyplot as plt

    random = np.random.default_rng(5)
    for n in (2, 3):
        points = random.random((40, n))
        for kind in (delone.ConvexHull, delone.AlphaComplex):
            axes = delone.plot(kind(points))
            assert axes.has_data()
            plt.close(axes.figure)
    mesh = delone.mesh([[0, 0], [2, 0], [0, 2]], [[0, 1], [1, 2], [2, 0]], max_edge=0.5)
    axes = delone.plot(mesh)
    [segments] = axes.collections
    assert len(axes.lines) == 2 and len(segments.get_segments()) == len(mesh.segments) > 3
    plt.close(axes.figure)
    empty = delone.plot(delone.Delaunay(np.empty((0, 3))))
    assert empty.name == "3d"
    plt.close(empty.figure)
