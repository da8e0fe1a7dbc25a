"""Behavior that users of scipy.spatial.Delaunay rely on, beside SciPy itself."""

import copy
import pickle
from fractions import Fraction

import delone
import numpy as np
import pytest
import scipy.spatial


def random_points(n, ndim, seed=0):
    return np.random.default_rng(seed).random((n, ndim))


def as_set(simplices):
    return {tuple(sorted(row)) for row in np.asarray(simplices).tolist()}


@pytest.mark.parametrize(("n", "ndim"), [(3, 2), (10, 2), (2000, 2), (4, 3), (10, 3), (1500, 3)])
def test_the_same_simplices_as_scipy(n, ndim):
    points = random_points(n, ndim, seed=n)
    ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
    assert as_set(ours.simplices) == as_set(theirs.simplices)
    assert as_set(ours.convex_hull) == as_set(theirs.convex_hull)
    for name in ["simplices", "neighbors", "convex_hull", "vertex_to_simplex", "transform", "equations", "coplanar"]:
        mine, other = getattr(ours, name), getattr(theirs, name)
        assert mine.shape == other.shape, name
        assert mine.dtype == other.dtype, name
    assert (ours.ndim, ours.npoints, ours.nsimplex) == (theirs.ndim, theirs.npoints, theirs.nsimplex)
    assert (ours.min_bound == theirs.min_bound).all() and (ours.max_bound == theirs.max_bound).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_simplices_are_positive_and_neighbors_consistent(ndim):
    tri = delone.Delaunay(random_points(500, ndim))
    corners = tri.points[tri.simplices]
    sides = corners[:, 1:] - corners[:, :1]
    # In space the first three are counter-clockwise seen from the fourth.
    assert (np.linalg.det(sides) * (1 if ndim == 2 else -1) > 0).all() or (np.linalg.det(sides) > 0).all()
    for t, row in enumerate(tri.neighbors):
        for k, u in enumerate(row):
            facet = set(tri.simplices[t]) - {tri.simplices[t, k]}
            if u >= 0:
                assert facet <= set(tri.simplices[u])
                assert t in tri.neighbors[u]
            else:
                assert tuple(sorted(facet)) in as_set(tri.convex_hull)


@pytest.mark.parametrize("ndim", [2, 3])
def test_neighbors_of_vertices(ndim):
    points = random_points(300, ndim)
    ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
    (starts, found), (other_starts, other) = ours.vertex_neighbor_vertices, theirs.vertex_neighbor_vertices
    for k in range(len(points)):
        assert set(found[starts[k] : starts[k + 1]]) == set(other[other_starts[k] : other_starts[k + 1]])
    rows = ours.vertex_to_simplex
    assert all(k in ours.simplices[rows[k]] for k in range(len(points)))


@pytest.mark.parametrize("far", [0, 1000])
@pytest.mark.parametrize("furthest", [False, True])
@pytest.mark.parametrize("ndim", [2, 3])
def test_equations_hold(ndim, furthest, far):
    if furthest and ndim == 3:
        pytest.skip("in the plane alone")
    points = random_points(100, ndim) + far
    tri = delone.Delaunay(points, furthest_site=furthest)
    assert tri.equations.shape == (tri.nsimplex, ndim + 2) and tri.nsimplex > 5
    for row, equation in zip(tri.simplices, tri.equations, strict=True):
        corners = [[Fraction(x) for x in corner] for corner in points[row].tolist()]
        lifted = [[*corner, sum(x * x for x in corner)] for corner in corners]
        sides = [[x - y for x, y in zip(corner, lifted[0], strict=True)] for corner in lifted[1:]]
        normal = [(-1) ** k * determinant([side[:k] + side[k + 1 :] for side in sides]) for k in range(ndim + 1)]
        size = sum(float(x) ** 2 for x in normal) ** 0.5 * (-1 if (normal[-1] > 0) != furthest else 1)
        assert np.allclose(equation[:-1], [float(x) / size for x in normal], rtol=0, atol=1e-12 if not far else 1e-3)
        offset = -sum(float(x) / size * float(y) for x, y in zip(normal, lifted[0], strict=True))
        assert np.isclose(equation[-1], offset, rtol=1e-9 if not far else 1e-2, atol=1e-12)


def determinant(rows):
    """Of fractions, along the first row."""
    if len(rows) == 1:
        return rows[0][0]
    return sum((-1) ** k * x * determinant([row[:k] + row[k + 1 :] for row in rows[1:]]) for k, x in enumerate(rows[0]))


@pytest.mark.parametrize("ndim", [2, 3])
def test_many_simplices_are_as_few(ndim):
    # So many are worth threads.
    whole = delone.Delaunay(random_points(20_500, ndim))
    for first in (0, 12_345, whole.nsimplex - 5):
        part = np.ascontiguousarray(whole.simplices[first : first + 5])
        assert (delone._delone.transforms(whole.points, part) == whole.transform[first : first + 5]).all()
        assert (delone._delone.lifted_equations(whole.points, part, False) == whole.equations[first : first + 5]).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_find_simplex_as_scipy(ndim):
    points = random_points(800, ndim)
    ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
    queries = random_points(3000, ndim, seed=9) * 1.4 - 0.2
    mine, other = ours.find_simplex(queries), theirs.find_simplex(queries)
    assert ((mine < 0) == (other < 0)).all()
    inside = mine >= 0
    assert (np.sort(ours.simplices[mine[inside]]) == np.sort(theirs.simplices[other[inside]])).all()
    assert ours.find_simplex(queries.reshape(30, 100, ndim)).shape == (30, 100)
    assert ours.find_simplex(queries[0]).shape == ()
    assert ours.find_simplex(np.empty((0, ndim))).shape == (0,)
    # On vertices and on edges.
    assert (ours.simplices[ours.find_simplex(points)] == np.arange(800)[:, None]).any(axis=1).all()
    grid = delone.Delaunay(np.stack(np.meshgrid(*[np.arange(5.0)] * ndim), axis=-1).reshape(-1, ndim))
    assert (grid.find_simplex(grid.points) >= 0).all()
    assert (grid.find_simplex(grid.points[grid.edges].mean(axis=1)) >= 0).all()
    assert (grid.find_simplex(grid.points[grid.simplices].mean(axis=1)) == np.arange(grid.nsimplex)).all()


@pytest.mark.parametrize("ndim", [2, 3])
def test_transform_as_scipy(ndim):
    points = random_points(400, ndim)
    ours, theirs = delone.Delaunay(points), scipy.spatial.Delaunay(points)
    queries = random_points(200, ndim, seed=3)

    def shares(tri):
        found = tri.find_simplex(queries)
        kept = found >= 0
        found, at = found[kept], queries[kept]
        maps = tri.transform[found, :ndim]
        some = np.einsum("nij,nj->ni", maps, at - tri.transform[found, ndim])
        return np.sort(np.column_stack([some, 1 - some.sum(axis=1)]), axis=1)

    assert np.allclose(shares(ours), shares(theirs), atol=1e-9)
    # Where corners are in the same order, entry by entry.
    rows = {tuple(row): k for k, row in enumerate(ours.simplices.tolist())}
    same = [(rows[tuple(row)], k) for k, row in enumerate(theirs.simplices.tolist()) if tuple(row) in rows]
    assert len(same) > 10
    mine, other = (list(column) for column in zip(*same, strict=True))
    assert np.allclose(ours.transform[mine], theirs.transform[other], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("ndim", [2, 3])
def test_planes_of_lifted_simplices(ndim):
    tri = delone.Delaunay(random_points(100, ndim))
    queries = random_points(50, ndim, seed=2) * 0.6 + 0.2
    found = tri.find_simplex(queries)
    # Straight up the highest plane is that of the simplex; planes are above the points in their circles.
    distances = tri.plane_distance(queries)
    above = distances / -tri.equations[:, -2]
    assert (above[found >= 0].argmax(axis=-1) == found[found >= 0]).all()
    corners = tri.points[tri.simplices]
    sides = corners[:, 1:] - corners[:, :1]
    centers = corners[:, 0] + np.linalg.solve(2 * sides, (sides**2).sum(axis=2)[..., None])[..., 0]
    radii = np.linalg.norm(centers - corners[:, 0], axis=1)
    inside = np.linalg.norm(queries[:, None] - centers, axis=2) < radii
    assert ((distances > 0) == inside).all()
    assert np.allclose(np.linalg.norm(tri.equations[:, :-1], axis=1), 1.0)
    assert tri.lift_points(queries).shape == (50, ndim + 1)


@pytest.mark.parametrize("ndim", [2, 3])
def test_flat_simplices_have_no_transform(ndim):
    points = np.vstack([random_points(20, ndim), [[0.5] * ndim, [0.5 + 1e-300] + [0.5] * (ndim - 1)]])
    assert delone.Delaunay(points).transform.shape[1:] == (ndim + 1, ndim)
    tiny = np.vstack([np.zeros(ndim), np.eye(ndim)]) * 5e-324
    assert delone.Delaunay(tiny).nsimplex == 1
    assert np.isnan(delone.Delaunay(tiny).transform[0, :ndim]).any()


@pytest.mark.parametrize("ndim", [2, 3])
def test_points_come_and_go(ndim):
    points = random_points(400, ndim)
    tri = delone.Delaunay(points[:200], incremental=True)
    tri.add_points(points[200:])
    assert as_set(tri.simplices) == as_set(delone.Delaunay(points).simplices)
    gone = list(range(0, 400, 3))
    tri.remove(gone)
    kept = np.setdiff1d(np.arange(400), gone)
    whole = delone.Delaunay(points[kept])
    assert as_set(tri.simplices) == as_set(kept[whole.simplices])
    assert (tri.vertex_to_simplex[gone] == -1).all() and tri.vertex_count == len(kept)
    assert tri.npoints == 400
    with pytest.raises(IndexError, match="point 3 is no vertex"):
        tri.remove([1, 3])
    with pytest.raises(ValueError, match="point 1 is to be removed twice"):
        tri.remove([1, 1])
    assert tri.vertex_count == len(kept)
    tri.remove(np.int64(1))
    assert tri.vertex_count == len(kept) - 1
    tri.add_points(points[:1], restart=True)
    assert tri.nearest(points[0]) == 400
    assert 0 not in tri.simplices and len(tri.duplicates) == 0
    tri.add_points(np.empty((0, ndim)))
    for other in [tri.copy(), pickle.loads(pickle.dumps(tri))]:
        assert as_set(other.simplices) == as_set(tri.simplices)
    tri.remove(400)
    assert tri.nearest(points[0]) != 400


@pytest.mark.parametrize("ndim", [2, 3])
def test_copies_and_pickles(ndim):
    tri = delone.Delaunay(random_points(100, ndim))
    tri.remove([5, 7])
    for other in [pickle.loads(pickle.dumps(tri)), copy.copy(tri), copy.deepcopy(tri), tri.copy()]:
        assert as_set(other.simplices) == as_set(tri.simplices)
        other.remove(9)
        assert other.vertex_count == tri.vertex_count - 1
    assert "98 vertices" in repr(tri)


@pytest.mark.parametrize("ndim", [2, 3])
def test_arrays_of_all_kinds(ndim):
    points = np.random.default_rng(4).integers(0, 1000, (60, ndim))
    expected = as_set(delone.Delaunay(points.astype(float)).simplices)
    frozen = points.astype(float)
    frozen.flags.writeable = False
    wide = np.zeros((60, 2 * ndim))
    wide[:, ::2] = points
    kinds = [
        points,
        points.astype(np.int32),
        points.astype(np.uint16),
        points.astype(np.float32),
        points.tolist(),
        frozen,
        wide[:, ::2],
        np.asfortranarray(points.astype(float)),
        points.astype(">f8"),
        points.astype(np.float16),
    ]
    # Doubles that do not begin at a multiple of eight.
    odd = np.frombuffer(b"x" + points.astype(float).tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(60, ndim)
    assert not odd.flags.aligned
    kinds.append(odd)
    for given in kinds:
        delone.Delaunay(points).find_simplex(given)
        assert as_set(delone.Delaunay(given).simplices) == expected
    mine = points.astype(float)
    tri = delone.Delaunay(mine)
    mine[:] = 0
    assert tri.points.any()
    with pytest.raises(ValueError, match="read-only"):
        tri.points[0, 0] = 1


def test_what_is_refused():
    with pytest.raises(ValueError, match=r"shape \(n, 2\) or \(n, 3\), not \(3,\)"):
        delone.Delaunay([1, 2, 3])
    with pytest.raises(ValueError, match="2 or 3 coordinates each, not 4"):
        delone.Delaunay(np.zeros((5, 4)))
    with pytest.raises(ValueError, match=r"\(0,\)"):
        delone.Delaunay([])
    with pytest.raises(ValueError, match="point 1 has the y coordinate nan"):
        delone.Delaunay([[0, 0], [1, np.nan], [2, 2]])
    with pytest.raises(ValueError, match="point 2 has the z coordinate -inf"):
        delone.Delaunay([[0, 0, 0], [1, 1, 1], [2, 2, -np.inf]])
    with pytest.raises(TypeError, match="real numbers, not object"):
        delone.Delaunay(np.array([[1, None], [2, 3]], dtype=object))
    with pytest.raises(TypeError, match="complex"):
        delone.Delaunay(np.zeros((4, 2), dtype=complex))
    with pytest.raises(TypeError, match="<U"):
        delone.Delaunay([["a", "b"], ["c", "d"]])
    with pytest.raises(ValueError, match="masked"):
        delone.Delaunay(np.ma.masked_array(np.zeros((4, 2)), mask=True))
    with pytest.raises(ValueError, match="beyond 2\\*\\*53"):
        delone.Delaunay(np.array([[0, 0], [2**60 + 1, 0], [0, 1]]))
    with pytest.raises(ValueError, match="inhomogeneous"):
        delone.Delaunay([[1, 2], [3]])
    with pytest.raises(NotImplementedError):
        delone.Delaunay(np.zeros((4, 3)), furthest_site=True)
    tri = delone.Delaunay(random_points(10, 2))
    with pytest.raises(ValueError, match="2 coordinates in its last axis"):
        tri.find_simplex([[1, 2, 3]])
    with pytest.raises(ValueError, match="point 0 has the x coordinate nan"):
        tri.nearest([np.nan, 0])
    with pytest.raises(ValueError, match="2 coordinates each, not 3"):
        tri.add_points(np.zeros((2, 3)))
    with pytest.raises(ValueError, match="at least 1"):
        tri.k_nearest([0, 0], 0)
    with pytest.raises(IndexError, match="point -1 is no vertex"):
        tri.remove(-1)


@pytest.mark.parametrize("ndim", [2, 3])
def test_what_scipy_gives_up_on(ndim):
    for points in [
        np.empty((0, ndim)),
        np.ones((1, ndim)),
        np.ones((5, ndim)),
        np.arange(6.0)[:, None] * np.ones(ndim),
    ]:
        tri = delone.Delaunay(points)
        assert tri.simplices.shape == (0, ndim + 1) and tri.neighbors.shape == (0, ndim + 1)
        assert tri.convex_hull.shape == (0, ndim)
        assert (tri.find_simplex(np.zeros((3, ndim))) == -1).all()
        assert len(tri.nearest(np.zeros((3, ndim)))) == 3
        assert tri.coplanar.shape[1] == 3 and tri.transform.shape == (0, ndim + 1, ndim)
        assert isinstance(repr(tri), str)
    line = delone.Delaunay(np.arange(6.0)[:, None] * np.ones(ndim))
    assert line.span == 1 and len(line.edges) == 5
    flat = delone.Delaunay(np.column_stack([random_points(20, 2), np.zeros(20)]))
    assert flat.span == 2 and flat.nsimplex == 0 and len(flat.edges) > 19
    assert delone.Delaunay([[1e-300, 0], [1e300, 0], [0, 1e300], [1e-300, 1e-300]]).nsimplex > 0


def test_duplicates_are_reported():
    points = np.array([[0, 0], [1, 0], [0, 1], [1, 0], [0.0, -0.0]])
    tri = delone.Delaunay(points)
    assert tri.duplicates.tolist() == [[3, 1], [4, 0]]
    assert tri.coplanar.tolist() == [[3, 0, 1], [4, 0, 0]]
    # As SciPy has it, the simplex of the one that they equal.
    assert tri.vertex_to_simplex.tolist() == [0, 0, 0, 0, 0]
    # They go with their vertex, and do not come back.
    tri.remove(1)
    assert tri.duplicates.tolist() == [[4, 0]]
    other = pickle.loads(pickle.dumps(tri))
    assert other.duplicates.tolist() == [[4, 0]] and other.vertex_count == 2
    other.remove([0, 2])
    assert pickle.loads(pickle.dumps(other)).vertex_count == 0


@pytest.mark.parametrize("ndim", [2, 3])
def test_nearest_as_a_tree(ndim):
    points = random_points(500, ndim)
    tri, tree = delone.Delaunay(points), scipy.spatial.cKDTree(points)
    queries = random_points(400, ndim, seed=5) * 2 - 0.5
    assert (tri.nearest(queries) == tree.query(queries)[1]).all()
    assert (tri.k_nearest(queries, 4) == tree.query(queries, 4)[1]).all()
    assert tri.k_nearest(queries[:2], 501)[:, -1].tolist() == [-1, -1]
    assert tri.nearest(queries[0]).shape == () and tri.k_nearest(queries[0], 2).shape == (2,)


@pytest.mark.parametrize("ndim", [2, 3])
def test_hints(ndim):
    centers = random_points(300, ndim)
    hints = delone.Hints(centers)
    for seed in range(3):
        points = centers + 0.01 * random_points(300, ndim, seed)
        assert as_set(hints.triangulate(points).simplices) == as_set(delone.Delaunay(points).simplices)
    with pytest.raises(ValueError, match="299 points for 300 centers"):
        hints.triangulate(centers[1:])


def test_threads_do_not_show(monkeypatch):
    import subprocess
    import sys

    program = (
        "import delone, numpy, hashlib; r = numpy.random.default_rng(1);"
        "a, b = delone.Delaunay(r.random((200000, 2))), delone.Delaunay(r.random((130000, 3)));"
        "print(hashlib.sha256(a.simplices.tobytes() + b.simplices.tobytes()).hexdigest())"
    )
    answers = set()
    for threads in ["1", "3"]:
        monkeypatch.setenv("RAYON_NUM_THREADS", threads)
        answers.add(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout)
    assert len(answers) == 1


def test_several_threads_may_ask_at_once():
    from concurrent.futures import ThreadPoolExecutor

    tri = delone.Delaunay(random_points(50_000, 2))
    queries = random_points(50_000, 2, seed=1)
    with ThreadPoolExecutor(8) as threads:
        found = list(threads.map(lambda _: tri.find_simplex(queries), range(32)))
    assert all((one == found[0]).all() for one in found)


def test_numbers_near_the_largest():
    most = np.finfo(float).max
    points = [[-most, -most], [most, -most], [most, most], [-most, most], [0, 1]]
    assert delone.Delaunay(points).nsimplex == 4
    assert len(delone.Voronoi(points).cells()) == 5
    with pytest.raises(MemoryError):
        delone.Delaunay(points).k_nearest([0, 0], 2**62)
    with pytest.raises(ValueError, match="xi: point 1 has the y coordinate inf"):
        delone.Delaunay(points).nearest([[0, 0], [0, np.inf]])
