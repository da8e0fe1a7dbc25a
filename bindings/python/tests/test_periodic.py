"""Points in boxes that repeat, beside definitions: copies for SciPy, sums, and crystals that are known."""

import copy
import itertools

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
        (dict(box=[1, 1, 1], grid="fine"), "grid must be"),
        (dict(box=[1, 1, 1], grid=-1.0), "grid must be"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        delone.Periodic([[0.0, 0, 0]], **arguments)


def test_a_diagram_takes_a_box():
    points = np.random.default_rng(6).random((20, 3))
    v = delone.Voronoi(points, box=[1, 1, 1], periodic=(True, True, False))
    assert v.volumes.sum() == pytest.approx(1, rel=1e-14) and len(v.nlist.indptr) == 21
    assert (v.in_box.faces.indices < 0).any() and (v.nlist.indices >= 0).all()
    assert copy.copy(v).points is v.points and "in a box" in repr(v)
    with pytest.raises(AttributeError, match="polyhedra"):
        _ = v.vertices
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
