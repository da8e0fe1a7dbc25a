"""Points in boxes that repeat, beside definitions: copies for SciPy, sums, and crystals that are known."""

import copy
import itertools
from fractions import Fraction

import delone
import numpy as np
import pytest
import shapely
from delone import pyvoro
from scipy.spatial import ConvexHull, Voronoi

CUBE = np.eye(3) * 4.0
TILTED = np.array([[4.0, 0, 0], [1, 3, 0], [-1, 1, 5]])


def crystal(basis, cells, constant):
    shifts = np.array(list(itertools.product(range(cells), repeat=3)), float)
    return (shifts[:, None] + np.array(basis)).reshape(-1, 3) * constant, [cells * constant] * 3


SC, BCC = [[0, 0, 0]], [[0, 0, 0], [0.5, 0.5, 0.5]]
FCC = [[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]]


@pytest.mark.parametrize("box", [CUBE, TILTED])
@pytest.mark.parametrize("n", [1, 2, 5, 40])
def test_cells_are_those_of_enough_copies(box, n):
    fractions = np.random.default_rng(n).random((n, 3))
    points = fractions @ box
    p = delone.Periodic(points, box)
    shifts = np.array(list(itertools.product((-2, -1, 0, 1, 2), repeat=3)))
    shifts = shifts[np.argsort(np.abs(shifts).sum(axis=1), kind="stable")]
    reference = Voronoi(((fractions[None] + shifts[:, None]).reshape(-1, 3)) @ box)
    volumes = [ConvexHull(reference.vertices[reference.regions[reference.point_region[i]]]).volume for i in range(n)]
    np.testing.assert_allclose(p.volumes, volumes, rtol=1e-9)
    assert p.volumes.sum() == pytest.approx(abs(np.linalg.det(box)), rel=1e-13)
    # Faces: to which point, how large, and where the copy is.
    areas = np.zeros((n, n))
    np.add.at(areas, (np.repeat(np.arange(n), np.diff(p.nlist.indptr)), p.nlist.indices), p.nlist.areas)
    np.testing.assert_allclose(areas, areas.T, atol=1e-9)
    np.testing.assert_allclose(areas.sum(axis=1), p.areas)
    of = np.repeat(np.arange(n), np.diff(p.nlist.indptr))
    np.testing.assert_allclose(points[p.nlist.indices] + p.nlist.offsets @ box - points[of], p.nlist.vectors, atol=1e-12)
    # Simplices fill the box, and corners are where they are said to be.
    corners = points[p.simplices] + p.offsets @ box
    sizes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert np.abs(sizes).sum() == pytest.approx(abs(np.linalg.det(box)))
    assert (p.neighbors >= 0).all() and len(p.edges) == n + len(p.simplices)


@pytest.mark.parametrize(("basis", "faces"), [(SC, 6), (BCC, 14), (FCC, 12)])
@pytest.mark.parametrize("constant", [1.0, 0.3, 3.639])
def test_crystals_of_decimals(basis, faces, constant):
    points, box = crystal(basis, 3, constant)
    p = delone.Periodic(points, box, grid="auto")
    assert (np.diff(p.nlist.indptr) == faces).all()
    np.testing.assert_allclose(p.volumes, constant**3 / len(basis), rtol=1e-14)
    assert p.step is not None and p.rounding < 1e-14


def test_polyhedra_are_closed_and_convex():
    points = np.random.default_rng(1).random((30, 3)) * 4
    p = delone.Periodic(points, CUBE, radii=np.full(30, 0.5))
    for (corners, faces), volume, centroid in zip(p.polyhedra(), p.volumes, p.centroids, strict=True):
        assert ConvexHull(corners).volume == pytest.approx(volume, rel=1e-9)
        sides = [(face[i - 1], face[i]) for face in faces for i in range(len(face))]
        assert len(set(sides)) == len(sides) and set(sides) == {(b, a) for a, b in sides}
        assert (ConvexHull(corners).equations[:, :3] @ centroid + ConvexHull(corners).equations[:, 3] < 0).all()


def test_radii_make_power_cells():
    points = [[0.0, 0, 0], [2.0, 0, 0]]
    p = delone.Periodic(points, [4, 1, 1], radii=[1, 0.5])
    # The radical plane: (d^2 + r^2 - s^2) / 2 d from the larger one, on both sides.
    width = 2 * (4 + 1 - 0.25) / 4
    np.testing.assert_allclose(p.volumes, [width, 4 - width])
    assert delone.Periodic(points, [4, 1, 1], radii=[10, 0.5]).hidden.tolist() == [1]


def test_the_plane_and_mixed_axes():
    points = np.random.default_rng(2).random((20, 2))
    p = delone.Periodic(points, [1, 1])
    assert p.simplices.shape == (40, 3) and (p.neighbors >= 0).all()
    strip = delone.Periodic(points, [1, 1], periodic=(True, False))
    assert (strip.neighbors == -1).any() and (strip.offsets[..., 1] == 0).all()
    with pytest.raises(NotImplementedError, match="space"):
        p.polyhedra()
    with pytest.raises(NotImplementedError, match="plane"):
        delone.Periodic(np.eye(3), [1, 1, 1]).polygons()
    with pytest.raises(NotImplementedError, match="plane"):
        _ = delone.Periodic(np.eye(3), [1, 1, 1]).perimeters


@pytest.mark.parametrize("box", [[3, 4], (4, 3, 1), [[4, 1], [0.5, 3.125]]])
@pytest.mark.parametrize("periodic", [True, (True, False), (False, True), False])
@pytest.mark.parametrize("n", [1, 2, 30])
def test_cells_of_the_plane(box, periodic, n):
    fractions = np.random.default_rng(n).random((n, 2))
    axes = delone.Periodic(np.zeros((1, 2)), box).box
    points = fractions @ axes
    v = delone.Voronoi(points, box=box, periodic=periodic)
    cells = [shapely.Polygon(rings[0]) for rings in v.cells()]
    assert all(cell.is_valid and cell.buffer(1e-9).contains(shapely.Point(p)) for cell, p in zip(cells, points, strict=True))
    np.testing.assert_allclose([cell.area for cell in cells], v.areas)
    np.testing.assert_allclose([cell.length for cell in cells], v.perimeters)
    np.testing.assert_allclose([cell.centroid.coords[0] for cell in cells], v.centroids, atol=1e-9)
    assert v.volumes is v.areas and v.areas.sum() == pytest.approx(12, rel=1e-13)
    of = np.repeat(np.arange(n), np.diff(v.nlist.indptr))
    moved = points[v.nlist.indices] + v.nlist.offsets @ axes - points[of]
    np.testing.assert_allclose(moved, v.nlist.vectors, atol=1e-12)
    sums = np.bincount(np.repeat(np.arange(n), np.diff(v.in_box.faces.indptr)), v.in_box.faces.lengths)
    np.testing.assert_allclose(sums, v.perimeters)
    if periodic is True:
        shifts = np.array(list(itertools.product((0, -1, 1, -2, 2), repeat=2)))
        reference = Voronoi(((fractions[None] + shifts[:, None]).reshape(-1, 2)) @ axes)
        rings = [reference.vertices[reference.regions[reference.point_region[i]]] for i in range(n)]
        np.testing.assert_allclose(v.areas, [ConvexHull(ring).volume for ring in rings], rtol=1e-9)
        # All copies of the cells tile: no two overlap.
        copies = [shapely.affinity.translate(cell, *(shift @ axes)) for cell in cells for shift in shifts[:25]]
        assert shapely.union_all(copies).area == pytest.approx(25 * 12, rel=1e-9)
    with pytest.raises(ValueError, match="leave region out"):
        v.cells((0, 0, 1, 1))


def test_freud_finds_the_same_cells_in_the_plane():
    freud = pytest.importorskip("freud")
    points = np.zeros((300, 3), dtype=np.float32)
    points[:, :2] = np.random.default_rng(4).random((300, 2)) * 8 - 4
    voronoi = freud.locality.Voronoi()
    voronoi.compute((freud.box.Box(8, 8, xy=0.25, is2D=True), points))
    v = delone.Voronoi(points[:, :2].astype(np.float64), box=(8, 8, 2))
    np.testing.assert_allclose(v.volumes, voronoi.volumes, rtol=1e-4)
    near = v.nlist.filter(min_area=1e-3)
    pairs = sorted(zip(np.repeat(np.arange(300), np.diff(near.indptr)).tolist(), near.indices.tolist(), strict=True))
    weights = voronoi.nlist.weights > 1e-3
    assert pairs == sorted(map(tuple, np.asarray(voronoi.nlist[:])[weights].tolist()))
    np.testing.assert_allclose(np.sort(near.lengths), np.sort(voronoi.nlist.weights[weights]), atol=1e-4)


def rotation(seed):
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.sign(np.linalg.det(q))


def test_small_faces_are_no_neighbors():
    # Hexagonal close packing and turned crystals: coordinates that no decimals are.
    axes = np.array([[1, 0, 0], [0.5, 3**0.5 / 2, 0], [0, 0, (8 / 3) ** 0.5]])
    basis = np.array([[0, 0, 0], [1 / 3, 1 / 3, 0.5]])
    grid = np.array(list(itertools.product(range(5), repeat=3)))
    hcp = (grid[:, None] + basis[None]).reshape(-1, 3) @ axes
    fcc = (grid[:, None] + np.array(FCC)[None]).reshape(-1, 3)
    for points, box in [(hcp, 5 * axes), *((fcc @ rotation(seed), 5 * rotation(seed)) for seed in range(3))]:
        v = delone.Voronoi(points, box=box)
        assert np.diff(v.nlist.indptr).max() > 12
        for near in (v.nlist.filter(min_area=1e-6), v.nlist.filter(min_relative_area=1e-6)):
            assert (np.diff(near.indptr) == 12).all()
            lengths = np.linalg.norm(near.vectors, axis=1)
            np.testing.assert_allclose(lengths, lengths[0], rtol=1e-12)
        assert v.volumes.sum() == pytest.approx(np.linalg.det(box), rel=1e-13)
    assert v.nlist.filter().indices.tolist() == v.nlist.indices.tolist()
    assert len(v.nlist.filter(min_area=9).indices) == 0
    with pytest.raises(ValueError, match="min_area must be"):
        v.nlist.filter(min_area=-1)
    with pytest.raises(ValueError, match="min_relative_area must be"):
        v.nlist.filter(min_relative_area=np.nan)


def test_copies_are_duplicates():
    p = delone.Periodic([[0.5, 0.5, 0.5], [2.5, 0.5, -1.5]], [1, 1, 1])
    assert p.duplicates.tolist() == [[1, 0]] and p.duplicate_offsets.tolist() == [[2, 0, -2]]
    assert p.volumes.tolist() == [1.0, 0.0] and np.isnan(p.centroids[1]).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (dict(box=[1, 1]), "3 sides"),
        (dict(box=[1, -1, 1]), "the side -1.0 along axis 1"),
        (dict(box=[1, 1, np.nan, 0, 0, 0]), "the side nan along axis 2"),
        (dict(box=[1, 1, 1, np.nan, 0, 0]), "axis 1 of the lattice"),
        (dict(box=np.eye(3)[[1, 0, 2]]), "left-handed"),
        (dict(box=np.zeros((3, 3))), "axis 0 of the lattice"),
        (dict(box=[1, 1, 1], periodic=(True, False)), "periodic must be"),
        (dict(box=[1, 1, 1], radii=[1, 2]), "radii must have the shape"),
        (dict(box=[1, 1, 1], radii=[-1]), "point 0 has the radius -1"),
        (dict(box=[1, 1, 1], radii=[np.nan]), "radii: point 0"),
        (dict(box=[1, 1, 1], radii=[1e200]), "point 0 has the radius 1e\\+200, the square"),
        (dict(box=[1, 1, 1], periodic=False, grid=1e-300), "axis 0 of the lattice"),
        (dict(box=[1, 1, 1], grid="fine"), "grid must be"),
        (dict(box=[1, 1, 1], grid=-1.0), "grid must be"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        delone.Periodic([[0.0, 0, 0]], **arguments)


@pytest.mark.parametrize("grid", [None, "auto", 0.1])
@pytest.mark.parametrize(("side", "origin"), [(0.55, 0.0), (0.5, 0.0123), (1.25, -0.77)])
def test_walls_are_where_they_are(grid, side, origin):
    points = (np.array(list(itertools.product(range(4), repeat=3))) + 1) * 0.1
    v = delone.Voronoi(points, box=[side] * 3, periodic=False, grid=grid, origin=[origin] * 3)
    assert v.volumes.sum() == pytest.approx(side**3, rel=1e-13)
    corners = np.vstack([corners for corners, _ in v.in_box.polyhedra()])
    np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], [[origin] * 3, [origin + side] * 3], atol=1e-15)


def test_what_moves_is_told():
    p = delone.Periodic([[0.1, 0.1, 0.1]], [0.5, 0.5, 0.54], grid=0.1)
    assert p.volumes.sum() == pytest.approx(0.125) and p.rounding == pytest.approx(0.04)


@pytest.mark.parametrize("periodic", [None, 2, "xyz", [None] * 3])
def test_axes_are_truths(periodic):
    with pytest.raises(TypeError, match="periodic must be True"):
        delone.Periodic([[0.0, 0, 0]], [1, 1, 1], periodic)


@pytest.mark.parametrize("grid", [True, [0.1], b"auto"])
def test_steps_are_numbers(grid):
    with pytest.raises(TypeError, match="grid must be"):
        delone.Periodic([[0.0, 0, 0]], [1, 1, 1], grid=grid)


def test_a_diagram_takes_a_box():
    points = np.random.default_rng(6).random((20, 3))
    v = delone.Voronoi(points, box=[1, 1, 1], periodic=(True, True, False))
    assert v.volumes.sum() == pytest.approx(1, rel=1e-14) and len(v.nlist.indptr) == 21
    assert (v.in_box.faces.indices < 0).any() and (v.nlist.indices >= 0).all()
    assert copy.copy(v).points is v.points and "in a box" in repr(v)
    for name in ("vertices", "regions", "ridge_vertices", "ridge_dict", "triangulation", "point_region"):
        with pytest.raises(AttributeError, match=f"have no {name}: see in_box"):
            getattr(v, name)
    assert (v.min_bound == points.min(axis=0)).all() and (v.max_bound == points.max(axis=0)).all()
    with pytest.raises(NotImplementedError, match="make them anew"):
        v.add_points([[0.5, 0.5, 0.5]])
    v.close()
    for other in (dict(furthest_site=True), dict(merge="auto")):
        with pytest.raises(ValueError, match="without a box"):
            delone.Voronoi(points, box=[1, 1, 1], **other)
    with pytest.raises(ValueError, match="give box="):
        delone.Voronoi(points, periodic=(True, True, False))
    assert delone.Voronoi(points[:, :2], box=[1, 1]).areas.sum() == pytest.approx(1, rel=1e-14)
    plain = delone.Voronoi(points)
    with pytest.raises(AttributeError, match="give box="):
        _ = plain.volumes
    with pytest.raises(ValueError, match="for points in a box"):
        delone.Voronoi(points, radii=np.ones(20))


@pytest.mark.parametrize("periodic", [(False, False, False), (True, False, True), (True, True, True)])
def test_cells_as_pyvoro_gives_them(periodic):
    points = np.random.default_rng(3).random((50, 3)) * [2, 3, 4] + [1, -1, 5]
    limits = [[1, 3], [-1, 2], [5, 9]]
    cells = pyvoro.compute_voronoi(points, limits, 1.0, radii=[], periodic=periodic)
    assert sum(cell["volume"] for cell in cells) == pytest.approx(24, rel=1e-13)
    walls = set()
    for i, cell in enumerate(cells):
        assert ConvexHull(np.array(cell["vertices"])).volume == pytest.approx(cell["volume"], rel=1e-9)
        for face in cell["faces"]:
            other = face["adjacent_cell"]
            if other < 0:
                walls.add(other)
                axis, end = divmod(-1 - other, 2)
                assert all(cell["vertices"][v][axis] == limits[axis][end] for v in face["vertices"])
            else:
                assert any(back["adjacent_cell"] == i for back in cells[other]["faces"])
        assert all(v in cell["adjacency"][w] for v, row in enumerate(cell["adjacency"]) for w in row)
        assert all(len(row) >= 3 for row in cell["adjacency"])
    assert walls == {-1 - 2 * axis - end for axis in range(3) for end in (0, 1) if not periodic[axis]}


def test_freud_finds_the_same_neighbors():
    freud = pytest.importorskip("freud")
    points = np.random.default_rng(4).random((200, 3)).astype(np.float32).astype(np.float64) * 8 - 4
    p = delone.Periodic(points, [8, 8, 8])
    voronoi = freud.locality.Voronoi()
    voronoi.compute((freud.box.Box.cube(8), points))
    np.testing.assert_allclose(np.sort(p.volumes), np.sort(voronoi.volumes), rtol=1e-4)
    assert len(p.nlist.indices) == pytest.approx(len(voronoi.nlist), abs=4)


def face_of(points, box, i, beyond):
    """The area of the face between a point and a copy in exact fractions: its plane, cut by all copies of points nearby."""

    def copy_of(j, offset):
        return [
            Fraction(x) + sum(int(k) * Fraction(a) for k, a in zip(offset, axis, strict=True))
            for x, axis in zip(points[j].tolist(), box.T.tolist(), strict=True)
        ]

    here, there = copy_of(i, (0, 0, 0)), copy_of(*beyond)
    normal = [q - p for p, q in zip(here, there, strict=True)]
    # Two directions in the plane, and a square of it around its middle that holds the face.
    u = [normal[1], -normal[0], 0] if normal[0] or normal[1] else [1, 0, 0]
    v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2], normal[0] * u[1] - normal[1] * u[0]]
    long = [8 / float(sum(x * x for x in w)) ** 0.5 for w in (u, v)]
    corner = [[Fraction(s * long[0]), Fraction(t * long[1])] for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    middle = [(p + q) / 2 for p, q in zip(here, there, strict=True)]
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)))
    away = np.linalg.norm(points[None] + (shifts @ box)[:, None] - points[i], axis=2)
    for shift, j in zip(*np.nonzero(away < 4), strict=True):
        other = copy_of(j, shifts[shift])
        if other in (here, there):
            continue
        # Twice x (other - here) <= |other|^2 - |here|^2, in coordinates of the plane.
        n = [2 * (q - p) for p, q in zip(here, other, strict=True)]
        a, b = (sum(x * y for x, y in zip(n, w, strict=True)) for w in (u, v))
        c = sum(q * q - p * p - m * x for p, q, m, x in zip(here, other, middle, n, strict=True))
        sides = [a * s + b * t - c for s, t in corner]
        kept = []
        for k, (p, side) in enumerate(zip(corner, sides, strict=True)):
            before, beside = corner[k - 1], sides[k - 1]
            if beside * side < 0:
                kept.append([x + beside / (beside - side) * (y - x) for x, y in zip(before, p, strict=True)])
            if side <= 0:
                kept.append(p)
        corner = kept
    twice = sum(corner[k - 1][0] * corner[k][1] - corner[k - 1][1] * corner[k][0] for k in range(len(corner)))
    scale = sum(x * x for x in u) * sum(x * x for x in v)
    return float(twice) / 2 * float(scale) ** 0.5


@pytest.mark.parametrize("tilt", [(0, 0, 0), (0.5, -0.375, 0.75)])
def test_faces_that_freud_lacks_are_there(tilt):
    """freud skips faces for which Voro++ finds no normal, as sides are short: most below 1e-5 here, some much larger."""
    freud = pytest.importorskip("freud")
    box = freud.box.Box(10, 11, 12, *tilt)
    axes = np.array(box.to_matrix(), np.float64).T
    points = box.wrap((np.random.default_rng(0).random((2000, 3)) - 0.5) @ axes).astype(np.float64)
    p = delone.Periodic(points, axes)
    voronoi = freud.locality.Voronoi()
    voronoi.compute((box, points))
    np.testing.assert_allclose(p.volumes, voronoi.volumes, atol=1e-6)
    of = np.repeat(np.arange(len(points)), np.diff(p.nlist.indptr))
    theirs = set(map(tuple, voronoi.nlist[:].tolist()))
    ours = list(zip(of.tolist(), p.nlist.indices.tolist(), strict=True))
    assert theirs <= set(ours) and p.rounding == 0
    missing = [k for k, pair in enumerate(ours) if pair not in theirs]
    assert len(missing) > 20 and np.median(p.nlist.areas[missing]) < 1e-5
    for k in missing[:: len(missing) // 10]:
        i, j = ours[k]
        expected = face_of(points, axes, i, (j, p.nlist.offsets[k]))
        assert expected > 0 and p.nlist.areas[k] == pytest.approx(expected, rel=1e-5)
