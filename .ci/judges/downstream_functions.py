"""What public functions of packages without tests of their own say: run by SciPy, and with Delone in its place."""

import numpy as np
import pytest

CUBIC = {
    "sc": (np.eye(3), 6),
    "bcc": (np.array([[-1, 1, 1], [1, -1, 1], [1, 1, -1.0]]) / 2, 12),
    "fcc": (np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0.0]]) / 2, 14),
    "hcp": (np.array([[1, 0, 0], [-0.5, 3**0.5 / 2, 0], [0, 0, 1.633]]), 8),
}


@pytest.mark.parametrize("name", CUBIC)
@pytest.mark.parametrize("constant", [2.87, 3.61, 4.05, 5.43])
def test_ase_brillouin_zones(name, constant):
    """ASE's zones have the faces of their lattice."""
    from ase.dft.bz import bz_vertices

    axes, faces = CUBIC[name]
    assert len(bz_vertices(np.linalg.inv(axes * constant).T)) == faces


@pytest.mark.parametrize("name", CUBIC)
def test_pymatgen_brillouin_zones(name):
    """So have pymatgen's."""
    from pymatgen.core import Lattice

    axes, faces = CUBIC[name]
    assert len(Lattice(axes * 2.87).get_brillouin_zone()) == faces


@pytest.mark.parametrize(("name", "neighbors"), [("fcc", 12), ("bcc", 14)])
def test_pymatgen_voronoi_neighbors(name, neighbors):
    """Atoms have as many neighbours as their lattice says."""
    from pymatgen.analysis.local_env import VoronoiNN
    from pymatgen.core import Lattice, Structure

    structure = Structure(Lattice(CUBIC[name][0] * 3.61), ["Cu"], [[0, 0, 0]])
    assert VoronoiNN().get_cn(structure, 0) == neighbors


def test_pymatgen_wulff_shapes():
    """A crystal's shape has a volume, and its faces all of the surface."""
    from pymatgen.analysis.wulff import WulffShape
    from pymatgen.core import Lattice

    shape = WulffShape(Lattice.cubic(4.05), [(1, 0, 0), (1, 1, 1), (1, 1, 0)], [0.9, 0.8, 0.95])
    assert shape.volume == pytest.approx(3.4, rel=0.2)
    assert sum(shape.area_fraction_dict.values()) == pytest.approx(1)


def test_pymatgen_phase_diagrams():
    """Stable compounds are on the hull."""
    from pymatgen.analysis.phase_diagram import PDEntry, PhaseDiagram
    from pymatgen.core import Composition

    entries = {"Li": -1.9, "Fe": -8.3, "O2": -9.9, "Li2O": -14.3, "FeO": -14.0, "Fe2O3": -33.0, "LiFeO2": -26.5}
    diagram = PhaseDiagram([PDEntry(Composition(name), energy) for name, energy in entries.items()])
    assert {entry.name for entry in diagram.stable_entries} >= {"Li", "Fe", "O2", "Li2O", "Fe2O3"}


def test_geovoronoi_regions():
    """Regions tile the square."""
    shapely = pytest.importorskip("shapely")
    from geovoronoi import voronoi_regions_from_coords

    points = np.random.default_rng(1).random((50, 2))
    regions, members = voronoi_regions_from_coords(points, shapely.box(0, 0, 1, 1))
    assert sorted(i for group in members.values() for i in group) == list(range(50))
    assert sum(region.area for region in regions.values()) == pytest.approx(1)


@pytest.mark.parametrize("seed", range(5))
def test_trimesh_hulls_and_spheres(seed):
    """Hulls of turned parts are convex to trimesh, with the faces that they have; the least sphere holds all points."""
    trimesh = pytest.importorskip("trimesh")
    grid = np.stack(np.meshgrid(*[np.linspace(0, 1, 6)] * 3), -1).reshape(-1, 3)
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    hull = trimesh.convex.convex_hull(grid @ turn)
    assert hull.is_watertight and hull.is_convex and hull.volume == pytest.approx(1)
    points = np.random.default_rng(seed).normal(size=(100, 3))
    center, radius = trimesh.nsphere.minimum_nsphere(points)
    assert np.linalg.norm(points - center, axis=1).max() == pytest.approx(radius)


def test_alphashape_of_a_ball_is_closed():
    """A shape in space is closed."""
    alphashape = pytest.importorskip("alphashape")
    points = np.random.default_rng(2).normal(size=(300, 3))
    assert alphashape.alphashape(points, 0.5).is_watertight
