"""Meshes for solvers, by the programs that read them: places, triangles, regions, markers and names come back as they were.

Beside each file the program writes tables of Triangle, which tell what must be in it.
"""

import collections
import itertools

import meshio
import numpy as np
import py2dm
import pyvista
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from world import FOLDER, ball, run, tetrahedra

try:
    import gmsh
except ImportError:
    gmsh = None
try:
    import skfem
except ImportError:
    skfem = None

# Two plates side by side, far from the origin, in decimals: the border is 1, the inlet 2, the outlet 3, and 9 is between them.
CORNERS = [(0, 0), (1, 0.1), (2.2, 0), (2, 1), (1, 1.3), (0, 1)]
SIDES = [(1, 2, 0), (2, 3, 0), (3, 4, 3), (4, 5, 0), (5, 6, 0), (6, 1, 2), (2, 5, 9)]
NAMES = {2: "inlet", 3: "open sea", 9: "weld"}
REGIONS = {1: "steel", 2: "soft wood"}
KINDS = ("mesh", "su2", "2dm", "14", "bdf", "xdmf")

nodes = "".join(f"{i} {637000.1 + x!r} {-849000.7 + y!r}\n" for i, (x, y) in enumerate(CORNERS, 1))
sides = "".join(f"{i} {a} {b} {marker}\n" for i, (a, b, marker) in enumerate(SIDES, 1))
names = "".join(f"# boundary {number} {name}\n" for number, name in NAMES.items())
names += "".join(f"# region {number} {name}\n" for number, name in REGIONS.items())
regions = "2\n1 637000.5 -849000.2 1 -1\n2 637001.6 -849000.2 2 -1\n"
(FOLDER / "plates.poly").write_text(f"6 2 0 0\n{nodes}7 1\n{sides}0\n{regions}{names}")
(FOLDER / "unnamed.poly").write_text(f"6 2 0 0\n{nodes}7 1\n{sides}0\n{regions}")


def place(point):
    """A point as a key."""
    return tuple(float(x) + 0.0 for x in point[:2])


def wanted(kind, source="plates.poly"):
    """Writes a file, and gives the region of each triangle and the marker of each side by their places."""
    outputs = [f"plates.{other}" for other in dict.fromkeys(["node", "ele", "edge", kind])]
    run("mesh", source, "--max-area", 0.05, *[word for name in outputs for word in ("-o", name)])
    node, ele, edge = (np.loadtxt(FOLDER / f"plates.{other}", skiprows=1) for other in ("node", "ele", "edge"))
    places = {int(row[0]): place(row[1:]) for row in node}
    width = ele.shape[1] - 2
    cells = {frozenset(places[int(i)] for i in row[1:4]): int(row[width + 1]) for row in ele}
    lines = {frozenset(places[int(i)] for i in row[1:3]): int(row[3]) for row in edge if row[3] != 0}
    assert set(cells.values()) == {1, 2} and set(lines.values()) == {1, 2, 3, 9} and len(cells) > 40
    return cells, lines


def rows(points, elements, numbers, corners):
    """The number of each element by the places of its corners."""
    found = {frozenset(place(points[i]) for i in row[:corners]): int(n) for row, n in zip(elements, numbers, strict=True)}
    assert len(found) == len(elements), "an element is there twice"
    return found


def by_meshio(name):
    """A mesh as meshio reads it."""
    return meshio.read(FOLDER / name)


def all_cells(mesh, kind, corners, data):
    """The cells of a kind with their numbers, of all blocks."""
    found = {}
    for block, numbers in zip(mesh.cells, mesh.cell_data[data], strict=True):
        if block.type == kind:
            found |= rows(mesh.points, block.data, numbers, corners)
    return found


def near(found, expected, bound):
    """Elements whose coordinates are so near to those expected, as a part of these, that each has one."""
    keys = np.array([sorted(key) for key in expected]), np.array([sorted(key) for key in found])
    keys = [key[np.lexsort(key.reshape(len(key), -1).T)] for key in keys]
    assert keys[0].shape == keys[1].shape and (np.abs(keys[0] - keys[1]) <= bound * np.abs(keys[0])).all(), "other places"
    assert collections.Counter(found.values()) == collections.Counter(expected.values()), "other numbers"


def strings_of_sms(name):
    """Triangles and strings of nodes as py2dm reads them."""
    with py2dm.Reader(FOLDER / name) as read:
        places = {node.id: place(node.pos) for node in read.iter_nodes()}
        step = 2 if "second" in name else 1
        cells = {frozenset(places[i] for i in e.nodes[::step]): e.materials[0] for e in read.iter_elements()}
        lines = {}
        for string in read.iter_node_strings():
            corners = string.nodes[::step]
            lines |= {frozenset((places[a], places[b])): string.name for a, b in itertools.pairwise(corners)}
    return cells, lines


def grid_of_adcirc(name):
    """Triangles and boundaries of a grid, as ADCIRC's manual has them."""
    lines = iter((FOLDER / name).read_text().splitlines()[1:])
    count, points = map(int, next(lines).split()[:2])
    read = [next(lines).split() for _ in range(points)]
    places = {int(row[0]): place(row[1:]) for row in read}
    corners = [[int(i) for i in next(lines).split()[2:]] for _ in range(count)]
    cells = {frozenset(places[i] for i in row) for row in corners}
    directed = {side for a, b, c in corners for side in ((a, b), (b, c), (c, a))}
    boundaries = {}
    for what in ("open", "land"):
        number = int(next(lines).split()[0])
        next(lines)
        for _ in range(number):
            head = next(lines)
            string = [int(next(lines)) for _ in range(int(head.split()[0]))]
            sides = list(itertools.pairwise(string))
            assert all(side in directed and side[::-1] not in directed for side in sides), "turned"
            name = head.split(" boundary ")[1].split(" ", 1)[1]
            boundaries |= {frozenset((places[a], places[b])): (what, name) for a, b in sides}
    assert next(lines, None) is None, "more follows"
    return cells, boundaries


def by_gmsh(name):
    """The numbers of triangles and lines by entity, as Gmsh reads them, and names of groups."""
    if gmsh is None:
        return None
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(FOLDER / name))
        counts = {entity: sum(map(len, gmsh.model.mesh.getElements(*entity)[1])) for entity in gmsh.model.getEntities()}
        groups = {gmsh.model.getPhysicalName(*group): group for group in gmsh.model.getPhysicalGroups()}
    finally:
        gmsh.finalize()
    return counts, groups


def triangles_of(kind):
    """Two plates of a solver: triangles by region, sides by marker, and their names."""
    name = f"plates.{kind}"
    if kind == "2dm":
        cells, lines = wanted(kind)
        read, strings = strings_of_sms(name)
        called = {"1": 1, "inlet": 2, "open_sea": 3, "weld": 9}
        assert read == cells and {side: called[string] for side, string in strings.items()} == lines
        return
    if kind == "14":
        cells, lines = wanted(kind)
        read, boundaries = grid_of_adcirc(name)
        called = {1: ("land", "marker_1"), 2: ("land", "inlet"), 3: ("open", "open sea")}
        assert read == set(cells) and boundaries == {side: called[number] for side, number in lines.items() if number != 9}
        return
    # To meshio the tags of SU2 are numbers.
    cells, lines = wanted(kind, "unnamed.poly" if kind == "su2" else "plates.poly")
    mesh = by_meshio(name)
    data = {"mesh": "medit:ref", "su2": "su2:tag", "bdf": "nastran:ref", "xdmf": "region", "vtu": "region", "ply": "region"}[kind]
    if kind == "bdf":
        near(all_cells(mesh, "triangle", 3, data), cells, 5e-14)
        assert all(f'"{name}"' in (FOLDER / "plates.bdf").read_text() for name in [*NAMES.values(), *REGIONS.values()])
    elif kind == "su2":
        assert set(all_cells(mesh, "triangle", 3, data)) == set(cells) and all_cells(mesh, "line", 2, data) == lines
        run("mesh", "plates.poly", "-o", "named.su2")
        tags = [line.split("= ")[1] for line in (FOLDER / "named.su2").read_text().splitlines() if line.startswith("MARKER_TAG")]
        assert tags == ["1", "inlet", "open_sea", "weld"], tags
    else:
        assert all_cells(mesh, "triangle", 3, data) == cells
    if kind == "mesh":
        assert all_cells(mesh, "line", 2, data) == lines
    if kind == "vtu":
        assert all_cells(mesh, "line", 2, "marker") == lines and not mesh.cell_data["marker"][0].any()
        grid = pyvista.read(FOLDER / name)
        assert grid.n_cells == len(cells) + len(lines) and set(grid.cell_data["marker"]) == {0, 1, 2, 3, 9}
    if kind == "xdmf":
        reader = vtkXdmfReader()
        reader.SetFileName(str(FOLDER / name))
        reader.Update()
        grid = pyvista.wrap(reader.GetOutputDataObject(0))
        found = rows(grid.points, grid.cells_dict[5], grid.cell_data["region"], 3)
        assert grid.points.dtype == np.float64 and found == cells, "VTK sees another mesh"
    if kind in ("mesh", "bdf") and (seen := by_gmsh(name)):
        tags = collections.Counter(cells.values())
        assert {tag: seen[0][2, tag] for tag in tags} == tags
        assert kind == "bdf" or {tag: seen[0][1, tag] for tag in (1, 2, 3, 9)} == collections.Counter(lines.values())


def names_of_gmsh_and_abaqus():
    """Names are those of physical groups, sets and surfaces."""
    cells, lines = wanted("msh")
    mesh = by_meshio("plates.msh")
    for kind, corners, numbers in (("triangle", 3, cells), ("line", 2, lines)):
        assert all_cells(mesh, kind, corners, "gmsh:physical") == numbers
    called = {**{name: [number, 1] for number, name in NAMES.items()}, **{name: [number, 2] for number, name in REGIONS.items()}}
    assert {name: list(value) for name, value in mesh.field_data.items()} == {"marker_1": [1, 1], **called}
    if seen := by_gmsh("plates.msh"):
        assert seen[1] == {"marker_1": (1, 1), **{name: tuple(value[::-1]) for name, value in called.items()}}
    if skfem:
        read = skfem.Mesh.load(FOLDER / "plates.msh")
        counts = collections.Counter(lines.values())
        assert {name: len(read.boundaries[name]) for name in NAMES.values()} == {NAMES[n]: counts[n] for n in NAMES}
    cells, lines = wanted("inp")
    mesh = by_meshio("plates.inp")
    for number, name in ((1, "steel"), (2, "soft_wood")):
        block = next(block for block, part in zip(mesh.cells, mesh.cell_sets[name], strict=True) if len(part))
        found = rows(mesh.points, block.data, [number] * len(block.data), 3)
        assert found == {corners: n for corners, n in cells.items() if n == number}, f"other triangles in {name}"
    for number, name in ((1, "marker_1"), (2, "inlet"), (3, "open_sea"), (9, "weld")):
        ends = {end for side, n in lines.items() if n == number for end in side}
        assert {place(mesh.points[i]) for i in mesh.point_sets[name]} == ends, f"other nodes in {name}"
    text = (FOLDER / "plates.inp").read_text()
    surface = text.split("*SURFACE, TYPE=ELEMENT, NAME=weld\n")[1].split("*")[0].split()
    assert len(surface) == 2 * sum(number == 9 for number in lines.values())


def grids_and_faces():
    """Sides are cells of VTK; regions are values of faces."""
    triangles_of("vtu")
    triangles_of("ply")


def quads_in(name, kind):
    """Places of the corners of all triangles and quadrilaterals with regions, and the mesh of meshio if it reads that."""
    if kind == "2dm":
        with py2dm.Reader(FOLDER / name) as read:
            places = {node.id: place(node.pos) for node in read.iter_nodes()}
            return [([places[i] for i in element.nodes], element.materials[0]) for element in read.iter_elements()], None
    mesh = by_meshio(name)
    # Abaqus has sets in the place of numbers.
    data = {"msh": "gmsh:physical", "mesh": "medit:ref", "bdf": "nastran:ref", "vtu": "region"}.get(kind)
    blocks = [block.data for block in mesh.cells if block.type in ("triangle", "quad")]
    if kind == "inp":
        sets = {number: mesh.cell_sets[name] for number, name in ((1, "steel"), (2, "soft_wood"))}
        kinds = [block.type for block in mesh.cells]
        of = [next(n for n, parts in sets.items() if len(parts[k])) for k, kind in enumerate(kinds) if kind != "line"]
        numbers = [np.full(len(block), n) for block, n in zip(blocks, of, strict=True)]
    elif kind == "su2":
        numbers = [np.zeros(len(block)) for block in blocks]
    else:
        numbers = [n for b, n in zip(mesh.cells, mesh.cell_data[data], strict=True) if b.type in ("triangle", "quad")]
    found = [
        ([place(mesh.points[i]) for i in row], int(n))
        for block, all_numbers in zip(blocks, numbers, strict=True)
        for row, n in zip(block, all_numbers, strict=True)
    ]
    return found, mesh


def area_of(corners):
    """The area, with less rounding near the corner of the plates."""
    x, y = np.array(corners).T - np.array([[637000.0], [-849000.0]])
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def all_quads_of(kind):
    """Quadrilaterals alone: convex, as large together as the triangles of each region, with no gaps, and with halves of sides."""
    cells, lines = wanted("msh")
    run("mesh", "plates.poly", "--max-area", 0.05, "--all-quads", "-o", f"all.{kind}")
    found, mesh = quads_in(f"all.{kind}", kind)
    areas = collections.Counter()
    for corners, number in found:
        assert len(corners) == 4, "a triangle"
        p = np.array(corners)
        u, v = np.roll(p, -1, axis=0) - p, np.roll(p, 1, axis=0) - p
        assert (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0).all(), "not convex"
        areas[0 if kind == "su2" else number] += area_of(corners)
    before = collections.Counter()
    for corners, number in cells.items():
        before[0 if kind == "su2" else number] += abs(area_of(list(corners)))
    assert areas.keys() == before.keys() and all(abs(areas[n] - before[n]) < 1e-5 for n in areas), "other areas"
    rounded = [[(round(x, 6), round(y, 6)) for x, y in corners] for corners, _ in found]
    sides = collections.Counter(frozenset((c[k], c[(k + 1) % 4])) for c in rounded for k in range(4))

    def rough(p):
        return round(p[0], 6), round(p[1], 6)

    halves = set()
    for side in lines:
        middle = rough(np.mean(list(side), axis=0).tolist())
        halves |= {frozenset((rough(end), middle)) for end in side}
    border = {side for side, count in sides.items() if count == 1}
    assert set(sides.values()) == {1, 2} and border <= halves <= sides.keys(), "gaps"
    if kind in ("msh", "mesh", "vtu"):
        data = {"msh": "gmsh:physical", "mesh": "medit:ref", "vtu": "marker"}[kind]
        markers = collections.Counter(all_cells(mesh, "line", 2, data).values())
        assert markers == {number: 2 * count for number, count in collections.Counter(lines.values()).items()}
    if kind == "msh" and skfem:
        read = skfem.MeshQuad.load(FOLDER / "all.msh")
        assert read.is_valid() and read.nelements == len(found), "scikit-fem sees another mesh"
    if kind == "vtu":
        quality = pyvista.read(FOLDER / "all.vtu").extract_cells_by_type(pyvista.CellType.QUAD)
        assert quality.n_cells == len(found)


def quads_of(kind):
    """Quadrilaterals: each is two of the triangles that there are without them. All are there once, and sides stay."""
    cells, lines = wanted("msh")
    run("mesh", "plates.poly", "--max-area", 0.05, "--quads", "-o", f"quads.{kind}")
    found, mesh = quads_in(f"quads.{kind}", kind)
    # 16 characters hold fewer digits than a double.
    exact = {(round(x, 6), round(y, 6)): (x, y) for cell in cells for x, y in cell}
    left = dict(cells)
    for corners, number in found:
        corners = [exact[round(x, 6), round(y, 6)] for x, y in corners]
        x, y = np.array(corners).T - np.array([[637000.0], [-849000.0]])
        assert (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0, "turned"
        ways = [[corners]]
        if len(corners) == 4:
            ways = [[corners[:3], corners[:1] + corners[2:]], [corners[1:], corners[:2] + corners[3:]]]
        split = next((way for way in ways if all(frozenset(part) in left for part in way)), None)
        assert split, f"no triangles of {corners}"
        regions = {left.pop(frozenset(part)) for part in split}
        assert len(regions) == 1 and (kind == "su2" or regions == {number}), "another region"
    assert not left and sum(len(corners) == 4 for corners, _ in found) > len(cells) / 4
    if kind in ("msh", "mesh", "vtu"):
        data = {"msh": "gmsh:physical", "mesh": "medit:ref", "vtu": "marker"}[kind]
        assert all_cells(mesh, "line", 2, data) == lines
    if kind == "vtu":
        assert pyvista.read(FOLDER / "quads.vtu").n_cells == len(found) + len(lines)
    if kind in ("msh", "mesh", "bdf") and (seen := by_gmsh(f"quads.{kind}")):
        assert sum(count for (dimension, _), count in seen[0].items() if dimension == 2) == len(found), "Gmsh sees another number"
    if kind == "inp":
        text = (FOLDER / "quads.inp").read_text()
        elements = {}
        for line in text.split("*NSET")[0].split("*ELEMENT")[1:]:
            for row in line.splitlines()[1:]:
                number, *corners = map(int, row.split(", "))
                elements[number] = corners
        for part in text.split("*SURFACE, TYPE=ELEMENT, NAME=")[1:]:
            name, *rows_of_surface = part.split("\n*")[0].splitlines()
            ends = set()
            for row in rows_of_surface:
                element, side = row.split(", S")
                corners, k = elements[int(element)], int(side) - 1
                ends.add(frozenset((corners[k], corners[(k + 1) % len(corners)])))
            number = {"marker_1": 1, "inlet": 2, "open_sea": 3, "weld": 9}[name]
            assert len(ends) == sum(n == number for n in lines.values()), f"sides of {name}"
    all_quads_of(kind)


def second_order_of(kind):
    """Triangles with six nodes, the middles of whose sides are where they should be."""
    run("mesh", "plates.poly", "--max-area", 0.1, "--second-order", "-o", f"second.{kind}", "-o", "second.ele")
    count = len(np.loadtxt(FOLDER / "second.ele", skiprows=1))
    if kind == "2dm":
        with py2dm.Reader(FOLDER / "second.2dm") as read:
            places = {node.id: np.array(node.pos[:2]) for node in read.iter_nodes()}
            sixes = np.array([[places[i] for i in element.nodes] for element in read.iter_elements()])
        sixes = sixes[:, [0, 2, 4, 1, 3, 5]]
    else:
        mesh = by_meshio(f"second.{kind}")
        sixes = mesh.points[mesh.cells_dict["triangle6"]][..., :2]
    assert sixes.shape == (count, 6, 2)
    for one, other, middle in ((0, 1, 3), (1, 2, 4), (2, 0, 5)):
        assert np.allclose(sixes[:, middle], (sixes[:, one] + sixes[:, other]) / 2, rtol=1e-13, atol=0), "middles"


def tetrahedra_of(kind):
    """Tetrahedra, with the triangles of their border where the format has both."""
    run("triangulate", "ball.npy", "--dim", 3, "-o", f"solid.{kind}")
    mesh = by_meshio(f"solid.{kind}")
    corners = mesh.points[mesh.cells_dict["tetra"]]
    assert len(corners) == len(tetrahedra) and (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0).all()
    wanted = {frozenset(map(tuple, ball[row].tolist())) for row in tetrahedra}
    found = {frozenset(map(tuple, row.tolist())) for row in corners}
    if kind == "bdf":
        volume = np.linalg.det(ball[tetrahedra][:, 1:] - ball[tetrahedra][:, :1])
        assert abs(np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() - np.abs(volume).sum()) < 1e-9
    else:
        assert found == wanted, "other tetrahedra"
    if kind in ("mesh", "su2"):
        assert len(mesh.cells_dict["triangle"]) > 50
    if kind in ("mesh", "bdf") and (seen := by_gmsh(f"solid.{kind}")):
        assert sum(count for (dimension, _), count in seen[0].items() if dimension == 3) == len(tetrahedra)


JUDGES = [names_of_gmsh_and_abaqus, grids_and_faces]
