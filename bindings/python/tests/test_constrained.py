"""Constrained triangulations against their definition, and what is refused."""

import copy
import pickle
import warnings
from fractions import Fraction
from itertools import combinations, pairwise

import delone
import matplotlib
import numpy as np
import pytest

matplotlib.use("Agg")

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]]
RINGS = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]


def exactly(p):
    return tuple(Fraction(float(x)) for x in p)


def turn(p, q, r):
    (px, py), (qx, qy), (rx, ry) = map(exactly, (p, q, r))
    return (qx - px) * (ry - py) - (qy - py) * (rx - px)


def in_circle(p, q, r, s):
    """Positive inside of the circle of three counter-clockwise points."""
    at = exactly(s)
    rows = [(x - at[0], y - at[1]) for x, y in map(exactly, (p, q, r))]
    (a, b, c) = [(x, y, x * x + y * y) for x, y in rows]
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def crosses(p, q, r, s):
    return turn(p, q, r) * turn(p, q, s) < 0 and turn(r, s, p) * turn(r, s, q) < 0


def planar(seed, size=9, count=25):
    """Points of a small grid, many on lines, some twice, and segments that do not cross."""
    random = np.random.default_rng(seed)
    points = random.integers(0, size, (count, 2)).astype(float)
    segments = []
    for a, b in random.integers(0, count, (3 * count, 2)).tolist():
        if not any(crosses(points[a], points[b], points[c], points[d]) for c, d in segments):
            segments.append([a, b])
    return points, segments


def check_by_definition(tri):
    """Positive triangles that tile the hull, whose edges are those of the segments and else Delaunay."""
    points, triangles = tri.points, tri.all_triangles.tolist()
    constraints = set(map(tuple, tri.constraints.tolist()))
    across = {}
    for a, b, c in triangles:
        assert turn(points[a], points[b], points[c]) > 0
        for edge, apex in (((a, b), c), ((b, c), a), ((c, a), b)):
            assert edge not in across
            across[edge] = apex
    for (a, b), c in across.items():
        d = across.get((b, a))
        if d is None:
            assert all(turn(points[a], points[b], p) >= 0 for p in points)
        elif (min(a, b), max(a, b)) not in constraints:
            assert in_circle(points[a], points[b], points[c], points[d]) <= 0
    used = {v for triangle in triangles for v in triangle}
    assert {tuple(points[v]) for v in used} == {tuple(p) for p in points}
    first = {}
    for index, p in enumerate(points.tolist()):
        first.setdefault(tuple(p), index)
    covered = set()
    for a, b in tri.segments.tolist():
        if a >= 0:
            on = [v for v in used if turn(points[a], points[b], points[v]) == 0]
            direction = np.subtract(points[b], points[a])
            ahead = {v: float(np.dot(points[v] - points[a], direction)) for v in on}
            inner = sorted((v for v in on if 0 <= ahead[v] <= ahead[b]), key=ahead.get)
            covered |= {(min(p), max(p)) for p in pairwise(inner)}
    assert covered == constraints


def area(points, triangles):
    p, q, r = (points[triangles[:, k]] for k in range(3))
    return float(np.sum((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]) / 2)


def as_set(triangles):
    return {tuple(np.roll(t, -int(np.argmin(t))).tolist()) for t in np.asarray(triangles)}


@pytest.mark.parametrize("seed", range(12))
def test_the_definition(seed):
    points, segments = planar(seed)
    tri = delone.ConstrainedDelaunay(points, segments)
    check_by_definition(tri)
    tri.check()
    # Neither order nor direction of segments shows, nor that of points.
    other = delone.ConstrainedDelaunay(points, np.array(segments)[::-1, ::-1])
    assert as_set(other.triangles) == as_set(tri.triangles)
    order = np.random.default_rng(seed).permutation(len(points))
    place = np.argsort(order)
    other = delone.ConstrainedDelaunay(points[order], place[np.array(segments)])

    def places(tri):
        return {frozenset(map(tuple, tri.points[t].tolist())) for t in tri.triangles}

    assert places(other) == places(tri)


@pytest.mark.parametrize("n", [0, 1, 2, 3, 10, 3000])
def test_without_segments_it_is_delaunay(n):
    points = np.random.default_rng(n).integers(0, 60, (n, 2)).astype(float)
    plain = delone.Delaunay(points)
    for segments in (None, [], np.empty((0, 2), dtype=np.int32), np.empty((0, 2)), [[k, k] for k in range(n)]):
        tri = delone.ConstrainedDelaunay(points, segments)
        for name in (
            "simplices",
            "neighbors",
            "convex_hull",
            "edges",
            "duplicates",
            "points",
            "vertex_count",
            "span",
            "nsimplex",
        ):
            mine, other = getattr(tri, name), getattr(plain, name)
            assert np.array_equal(mine, other) and getattr(mine, "dtype", 0) == getattr(other, "dtype", 0), name
        assert np.array_equal(tri.min_bound, plain.min_bound) and np.array_equal(tri.max_bound, plain.max_bound)
        assert tri.inside.all() and tri.constraints.shape == (0, 2) and not tri.constrained.any()
        queries = np.random.default_rng(5).random((500, 2)) * 70 - 5
        for name in ("find_simplex", "nearest"):
            assert np.array_equal(getattr(tri, name)(queries), getattr(plain, name)(queries))
        assert np.array_equal(tri.k_nearest(queries, 3), plain.k_nearest(queries, 3))


def test_what_is_inside():
    fills = {"all": 16.0, "even-odd": 14.0, "nonzero": 16.0, "seeds": 16.0}
    for fill, expected in fills.items():
        tri = delone.ConstrainedDelaunay(SQUARE, RINGS, fill=fill)
        assert area(tri.points, tri.triangles) == expected and tri.fill == fill
        assert tri.triangles is tri.simplices and tri.nsimplex == tri.inside.sum() == len(tri.neighbors)
        assert area(tri.points, tri.all_triangles) == 16
    assert delone.ConstrainedDelaunay(SQUARE, RINGS, fill="nonzero").windings.tolist().count(2) == 1
    clockwise = RINGS[:4] + [[b, a] for a, b in RINGS[4:]]
    assert delone.ConstrainedDelaunay(SQUARE, clockwise, fill="nonzero").nsimplex == 7
    tri = delone.ConstrainedDelaunay(SQUARE, RINGS, holes=[[2, 2]])
    assert tri.fill == "seeds" and area(tri.points, tri.triangles) == 14
    for row, (triangle, across) in enumerate(zip(tri.simplices.tolist(), tri.neighbors.tolist(), strict=True)):
        for k, beyond in enumerate(across):
            edge = {*triangle} - {triangle[k]}
            assert beyond < 0 or (edge <= set(tri.simplices[beyond].tolist()) and row in tri.neighbors[beyond])
            assert tri.constrained[row, k] == (tuple(sorted(edge)) in set(map(tuple, tri.constraints.tolist())))
            # All constraints are borders here.
            assert (beyond < 0) == tri.constrained[row, k]
    assert delone.ConstrainedDelaunay(SQUARE, RINGS[:3] + RINGS[4:], fill="seeds").nsimplex == 1
    assert delone.ConstrainedDelaunay(SQUARE, RINGS[:3], fill="seeds", keep_concavities=True).nsimplex == 8


def test_regions():
    tri = delone.ConstrainedDelaunay(SQUARE, RINGS, regions=[[2, 2, 7.5], [0.5, 0.25, -1.0], [2, 1.5, 3]])
    inner = tri.regions == 0
    assert inner.sum() == 1 and (tri.regions == 1).sum() == 7
    assert tri.attributes[inner] == 7.5 and (tri.attributes[~inner] == -1).all()
    assert tri.rivals.tolist() == [[0, 2]] and len(np.unique(tri.parts)) == 2
    tri = delone.ConstrainedDelaunay(SQUARE, RINGS, regions=[[2, 2]], holes=[])
    assert sorted(tri.attributes[~np.isnan(tri.attributes)]) == [0.0] and (tri.regions == -1).sum() == 7
    # A segment through a seed makes the question senseless, and it says so.
    tri.insert([2, 2])
    with pytest.raises(ValueError, match=r"seed of region 0 at \(2, 2\)"):
        tri.insert_segment(6, tri.nearest([2, 2]))
        _ = tri.simplices


def test_finding_among_what_is_inside():
    tri = delone.ConstrainedDelaunay(SQUARE, RINGS, fill="even-odd")
    grid = np.stack(np.meshgrid(np.arange(-1, 5.25, 0.25), np.arange(-1, 5.25, 0.25)), axis=-1)
    found = tri.find_simplex(grid)
    assert found.shape == grid.shape[:-1]
    for q, row in zip(grid.reshape(-1, 2), found.ravel(), strict=True):
        holds = [all(turn(tri.points[t[k - 1]], tri.points[t[k]], q) >= 0 for k in range(3)) for t in tri.simplices]
        assert holds[row] if row >= 0 else not any(holds), q
    # The corners of the hole are on the border, and so are its sides.
    assert (tri.find_simplex(SQUARE) >= 0).all() and tri.locate([2, 1]) >= 0 and tri.locate([2, 1.5]) == -1
    assert tri.nearest([2, 1.9]) == 6 or tri.nearest([2, 1.9]) in (4, 5)


def test_crossings():
    points, segments = [[0, 0], [2, 2], [0, 2], [2, 0]], [[0, 1], [2, 3]]
    with pytest.raises(delone.CrossingError, match=r"segments 0 and 1 cross near \(1, 1\)") as caught:
        delone.ConstrainedDelaunay(points, segments)
    for error in (caught.value, pickle.loads(pickle.dumps(caught.value))):
        assert isinstance(error, ValueError)
        assert {error.first, error.second} == {0, 1} and error.near == (1.0, 1.0) and error.count == 1
        assert "cross near" in str(error)
    tri = delone.ConstrainedDelaunay(points, segments, crossings="split")
    assert tri.points[4].tolist() == [1, 1] and len(tri.constraints) == 4 and tri.npoints == 5
    assert tri.report["crossings"] == 1 == tri.report["added_points"]
    assert tri.chain(0).tolist() == [0, 4, 1] and tri.segments.tolist() == segments
    many = np.random.default_rng(0).random((60, 2))
    tri = delone.ConstrainedDelaunay(many, np.arange(60).reshape(30, 2), crossings="split")
    tri.check()
    assert tri.npoints == 60 + tri.report["added_points"] > 100
    other = pickle.loads(pickle.dumps(tri))
    assert np.array_equal(other.points, tri.points) and as_set(other.triangles) == as_set(tri.triangles)


def test_points_and_segments_come_and_go():
    random = np.random.default_rng(3)
    tri = delone.ConstrainedDelaunay(random.integers(0, 12, (30, 2)))
    for step in range(60):
        try:
            match step % 4:
                case 0:
                    tri.insert(random.integers(0, 12, 2))
                case 1 | 2:
                    tri.insert_segment(*random.integers(0, tri.npoints, 2).tolist())
                case 3:
                    tri.remove(int(random.integers(0, tri.npoints)), ends=("refuse", "join", "drop")[step % 3])
        except (ValueError, IndexError) as error:
            assert str(error)
        tri.check()
    present = np.flatnonzero(tri.segments[:, 0] >= 0)
    assert len(present) > 5
    again = pickle.loads(pickle.dumps(tri))
    for other in (again, tri.copy(), copy.copy(tri), copy.deepcopy(tri)):
        for name in ("points", "segments", "constraints", "duplicates"):
            mine = getattr(tri, name)
            assert np.array_equal(np.sort(getattr(other, name), axis=0), np.sort(mine, axis=0)), name
        assert as_set(other.triangles) == as_set(tri.triangles)
        for segment in present.tolist():
            other.remove_segment(segment)
        assert len(other.constraints) == 0 and (other.segments == -1).all()
        alive = np.unique(tri.edges)
        plain = delone.Delaunay(tri.points[alive])
        assert as_set(other.triangles) == as_set(alive[plain.simplices])
    assert len(tri.constraints) >= len(present)


def test_changes_one_by_one():
    tri = delone.ConstrainedDelaunay([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 2]])
    assert tri.insert([2, 2]) == 4 and tri.insert([2, 2]) == 4 and tri.insert([[0, 0], [1, 3]]).tolist() == [0, 5]
    assert tri.chain(0).tolist() == [0, 4, 2] and tri.constraints.tolist() in ([[0, 4], [2, 4]], [[2, 4], [0, 4]])
    tri.remove(4)
    with pytest.raises(delone.CrossingError, match=r"segments 0 and 1 cross near \(2, 2\)"):
        tri.insert_segment(1, 5)
    assert tri.chain(0).tolist() == [0, 2] and tri.vertex_count == 5
    assert tri.insert_segment(3, 5) == 1
    with pytest.raises(ValueError, match="1 segments end or meet at vertex 5"):
        tri.remove(5)
    tri.remove(5, ends="drop")
    assert tri.segments.tolist() == [[0, 2], [-1, -1]]
    for call in (tri.chain, tri.remove_segment):
        for none in (1, 2, -1, 2**70):
            with pytest.raises(IndexError, match=f"there is no segment {none}"):
                call(none)
        for wrong in (None, 1.0, "1", True, [1]):
            with pytest.raises(TypeError, match="must be an integer"):
                call(wrong)
    for none in (4, 5, 6, -1, 2**70):
        for call in (
            tri.remove,
            lambda v: tri.insert_segment(0, v),
            lambda v: tri.sees(v, 0),
            lambda v: tri.first_constraint([0, v], 0),
        ):
            with pytest.raises((IndexError, TypeError, ValueError), match=r"is no vertex|beyond"):
                call(none)
    with pytest.raises(ValueError, match="no length"):
        tri.insert_segment(1, 1)
    with pytest.raises(ValueError, match="ends must be one of"):
        tri.remove(1, ends="gone")
    with pytest.raises(ValueError, match="point 1 has the y coordinate nan"):
        tri.insert([[5, 5], [0, np.nan]])
    assert tri.vertex_count == 4 and tri.npoints == 6
    assert tri.insert_segment(0, 1) == 2 and tri.insert_segment(1, 2) == 3
    tri.remove_segment(0)
    tri.remove(1, ends="join")
    assert tri.segments.tolist() == [[-1, -1], [-1, -1], [0, 2], [-1, -1]] and tri.nsimplex == 1


def test_lines_of_sight():
    points, segments = planar(4, size=7, count=20)
    tri = delone.ConstrainedDelaunay(points, segments)
    vertices = np.unique(tri.edges)
    seen = tri.sees(vertices[:, None], vertices)
    assert seen.shape == (len(vertices),) * 2 and (seen == seen.T).all() and seen.diagonal().all()
    first = tri.first_constraint(vertices[:, None], vertices)
    assert ((first[..., 0] < 0) == seen).all() and first.shape == (*seen.shape, 2)
    known = set(map(tuple, tri.constraints.tolist()))
    assert {tuple(sorted(e)) for e in first[~seen].tolist()} <= known
    ends = {v for edge in known for v in edge}

    def between(a, b, v):
        p, q, r = points[a], points[b], points[v]
        return turn(p, q, r) == 0 and 0 < np.dot(r - p, q - p) < np.dot(q - p, q - p)

    for (i, a), (j, b) in combinations(enumerate(vertices.tolist()), 2):
        blocked = any(crosses(points[a], points[b], points[c], points[d]) for c, d in known)
        blocked |= (a, b) in known or any(between(a, b, v) for v in ends)
        assert seen[i, j] == (not blocked), (a, b)
    assert tri.sees(0, 0) and tri.sees(0, []).shape == (0,)


#: Segments, and what is said of them.
WRONG_SEGMENTS = [
    ([[0, 7]], IndexError, "segment 0 ends at point 7, and there are 7 points, counted from 0"),
    ([[0, 1], [-1, 2]], IndexError, "segment 1 ends at point -1"),
    (np.array([[0, 2**64 - 1]], dtype=np.uint64), IndexError, "ends at point 18446744073709551615"),
    ([[0.0, 1.0]], TypeError, "must hold integers"),
    ([[True, False]], TypeError, "must hold integers"),
    ([["0", "1"]], TypeError, "real numbers"),
    ([[0, None]], TypeError, "real numbers"),
    ([[0, 2**70]], ValueError, "beyond"),
    (np.array([[0, 0.5]], dtype=object), TypeError, "must hold integers"),
    ([0, 1], ValueError, r"shape \(m, 2\), two indices of points each, not \(2,\)"),
    ([[0, 1, 2]], ValueError, r"not \(1, 3\)"),
    ([[[0, 1]]], ValueError, r"not \(1, 1, 2\)"),
    ([[0, 1], [2]], ValueError, "inhomogeneous"),
    (np.ma.masked_array([[0, 1]], mask=[[True, False]]), ValueError, "masked"),
    (5, ValueError, "shape"),
    ("ab", TypeError, "real numbers"),
]


@pytest.mark.parametrize(("segments", "kind", "words"), WRONG_SEGMENTS)
def test_what_is_no_segments(segments, kind, words):
    with pytest.raises(kind, match=words):
        delone.ConstrainedDelaunay(SQUARE, segments)


def test_what_is_refused():
    make = delone.ConstrainedDelaunay
    for points, words in [
        ([[0, 0], [1, np.nan], [2, 2]], "point 1 has the y coordinate nan"),
        (np.zeros((4, 3)), "2 coordinates each, not 3"),
        ([], r"shape .*not \(0,\)"),
        ([1, 2], r"not \(2,\)"),
    ]:
        with pytest.raises(ValueError, match=words):
            make(points)
    for wrong in ("ALL", None.__class__, 3, "evenodd", ["all"], np.str_("x")):
        with pytest.raises(ValueError, match="fill must be one of 'all'"):
            make(SQUARE, RINGS, fill=wrong)
    for wrong in ("join", None, True, 0):
        with pytest.raises(ValueError, match="crossings must be one of 'refuse', 'split'"):
            make(SQUARE, RINGS, crossings=wrong)
    with pytest.raises(ValueError, match="for fill='seeds', not 'all'"):
        make(SQUARE, RINGS, fill="all", holes=[[2, 2]])
    with pytest.raises(ValueError, match="for fill='seeds', not 'all'"):
        make(SQUARE, RINGS, keep_concavities=True)
    with pytest.raises(TypeError, match="keep_concavities must be True or False"):
        make(SQUARE, RINGS, keep_concavities="no")
    for name in ("holes", "regions"):
        what = name[:-1]
        for seed, words in [
            ([[2, 1]], rf"the seed of {what} 0 at \(2, 1\) is on a constraint"),
            ([[2, 2], [4, 4]], f"the seed of {what} 1 .* is on an end of a constraint"),
            ([[5, 5]], "is outside of the hull"),
            ([[2, np.inf]], f"{name}: point 0 has the y coordinate inf"),
            ([2, 2], "shape"),
            (np.zeros((1, 5)), "5"),
        ]:
            with pytest.raises(ValueError, match=words):
                make(SQUARE, RINGS, **{name: seed})
    with pytest.raises(ValueError, match=r"regions\[:, :3\]"):
        make(SQUARE, RINGS, regions=[[2, 2, 1, 0.5]])
    tri = make(SQUARE, RINGS)
    for name in ("points", "triangles", "report", "inside"):
        with pytest.raises(AttributeError):
            setattr(tri, name, None)
    with pytest.raises(ValueError, match="read-only"):
        tri.points[0] = 1


def test_extremes():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for points in ([[1e-300, 0], [1e300, 0], [0, 1e300], [1e-300, 1e-300]], [[5e-324, 0], [0, 0], [0, 5e-324], [5e-324] * 2]):
            tri = delone.ConstrainedDelaunay(points, [[0, 2]], fill="even-odd")
            tri.check()
            assert tri.constraints.tolist() == [[0, 2]]
        for n in range(4):
            line = delone.ConstrainedDelaunay(np.arange(n)[:, None] * [1.0, 1.0], [[0, n - 1]] if n else None)
            assert line.nsimplex == 0 and len(line.constraints) == max(0, n - 1) and "0 triangles" in repr(line)
            for fill in ("all", "even-odd", "nonzero", "positive", "negative", "seeds"):
                other = delone.ConstrainedDelaunay(line.points, fill=fill)
                assert other.simplices.shape == other.neighbors.shape == other.constrained.shape == (0, 3)
                assert other.find_simplex([0, 0]) == -1 and other.attributes.shape == (0,)
        same = delone.ConstrainedDelaunay(np.ones((5, 2)), [[0, 4], [1, 2]])
        assert same.report["zero_length"] == 2 and (same.segments == -1).all() and len(same.duplicates) == 4


def test_what_becomes_of_segments_is_reported():
    points = [[0, 0], [1, 0], [2, 0], [3, 0], [1, 1], [1, 0]]
    tri = delone.ConstrainedDelaunay(points, [[0, 3], [3, 0], [0, 2], [1, 5], [4, 5]])
    assert tri.report["zero_length"] == 1 and tri.report["repeated"] == 1 and tri.report["through_vertices"] == 3
    assert tri.report["overlapping"] >= 1 and tri.segments.tolist() == [[0, 3], [3, 0], [0, 2], [-1, -1], [4, 1]]


def test_arrays_of_all_kinds():
    expected = delone.ConstrainedDelaunay(SQUARE, RINGS, holes=[[2, 2]]).simplices
    ends = np.array(RINGS)
    wide = np.zeros((7, 4), dtype=np.int64)
    wide[:, ::2] = ends
    for kind in (
        ends.astype(np.int8),
        ends.astype(np.uint64),
        ends.astype(">i4"),
        np.asfortranarray(ends),
        wide[:, ::2],
        tuple(RINGS),
    ):
        tri = delone.ConstrainedDelaunay(np.array(SQUARE, dtype=np.float32), kind, holes=np.array([[2, 2]], dtype=np.int16))
        assert np.array_equal(tri.simplices, expected) and tri.simplices.dtype == np.int32
    given, segments, holes = np.array(SQUARE, dtype=float), ends.copy(), np.array([[2.0, 2.0]])
    tri = delone.ConstrainedDelaunay(given, segments, holes=holes)
    given[:], segments[:], holes[:] = 0, 0, 9
    assert np.array_equal(pickle.loads(pickle.dumps(tri)).simplices, expected) and tri.points.any()


def test_several_threads_may_ask_at_once():
    from concurrent.futures import ThreadPoolExecutor

    points = np.random.default_rng(1).random((40_000, 2))
    ends = delone.Delaunay(points).edges[::7]
    queries = np.random.default_rng(2).random((20_000, 2))

    def ask(tri):
        return tri.find_simplex(queries), tri.nearest(queries[:500]), tri.sees(np.arange(2000), np.arange(2000, 4000)), tri.inside

    expected = ask(delone.ConstrainedDelaunay(points, ends, fill="even-odd"))
    tri = delone.ConstrainedDelaunay(points, ends, fill="even-odd")
    with ThreadPoolExecutor(8) as threads:
        for found in threads.map(lambda _: ask(tri), range(16)):
            assert all(np.array_equal(one, other) for one, other in zip(found, expected, strict=True))


def test_pictures():
    tri = delone.ConstrainedDelaunay(SQUARE, RINGS, fill="even-odd")
    axes = delone.plot(tri)
    assert len(axes.collections) == 1 and len(axes.lines) == 2
    assert tri._repr_svg_().count("<path") == 2
    line = delone.ConstrainedDelaunay([[0, 0], [1, 1]], [[0, 1]])
    delone.plot(line)
    assert "M" in line._repr_svg_() and delone.ConstrainedDelaunay(np.empty((0, 2)))._repr_svg_() is None
