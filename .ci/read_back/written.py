"""Every format that delone writes, with every content that it can hold, read by a program that others wrote.

A judge is a function of the file's ending, named for its contents, that raises where the reader sees something else.
"""

import collections
import contextlib
import io
import itertools
import json
import re
import xml.etree.ElementTree as ElementTree

import geopandas
import meshio
import numpy as np
import pandas
import pyvista
import rasterio
import shapely
import solvers
import trimesh
from PIL import Image
from world import FOLDER, area_of_squares, ball, expected, flat, normal, points, rings, run, squares, tetrahedra, triangles

try:
    import triangle
except ImportError:
    triangle = None

GEOMETRIES = ("geojson", "fgb", "gpkg")


def by_meshio(name):
    """A mesh as meshio reads it, which prints empty lines."""
    with contextlib.redirect_stdout(io.StringIO()):
        return meshio.read(FOLDER / name)


def by_triangle(*names):
    """Tables of Triangle's files, as the package triangle reads them."""
    return triangle.loads(**{name.split(".")[-1]: (FOLDER / name).read_text() for name in names})


def well_known(name):
    """The geometries of well-known text, a line each, or binary, as shapely reads them."""
    path = FOLDER / name
    if name.endswith("wkt"):
        return shapely.from_wkt(path.read_text().splitlines())
    whole = shapely.from_wkb(path.read_bytes())
    return np.array(getattr(whole, "geoms", [whole]))


def geometries(name):
    """The geometries of any such format."""
    return well_known(name) if name.split(".")[-1] in ("wkt", "wkb") else geopandas.read_file(FOLDER / name).geometry.to_numpy()


def picture(name, least):
    """A picture that is not blank: pixels by Pillow, shapes of SVG by an XML parser, which are at least so many."""
    if name.endswith("svg"):
        shapes = [
            part
            for part in ElementTree.parse(FOLDER / name).iter()
            if part.tag.split("}")[-1] in ("path", "polygon", "line", "circle", "polyline")
        ]
        # Paths have many shapes, each of which begins with a move.
        assert sum(len(re.split("[Mm]", part.get("d", ""))) for part in shapes) >= least, f"{len(shapes)} shapes"
        return
    with Image.open(FOLDER / name) as image:
        gray = np.asarray(image.convert("L"))
    assert (gray[:-80] < 200).sum() > least, "a blank picture"


def points_of(kind):
    """A set that has a name, beside its coordinates as NumPy reads them."""
    for dimension, name in ((2, "uniform"), (3, "cube")):
        run("generate", name, "-n", 60, "-o", f"made.{kind}")
        run("generate", name, "-n", 60, "-o", "made.npy")
        made = np.load(FOLDER / "made.npy")
        file = FOLDER / f"made.{kind}"
        if kind == "csv":
            read = pandas.read_csv(file)[list("xyz")[:dimension]].to_numpy()
        elif kind == "npy":
            read = made
        elif kind == "bin":
            read = np.fromfile(file).reshape(made.shape)
        elif kind == "node":
            read = np.loadtxt(file, skiprows=1)[:, 1 : dimension + 1]
        elif kind == "ply":
            read = by_meshio(file.name).points[:, :dimension]
        elif kind == "obj":
            read = np.array([line.split()[1:] for line in file.read_text().splitlines() if line[0] == "v"], float)[:, :dimension]
        else:
            read = shapely.get_coordinates(geometries(file.name), include_z=dimension == 3)
        assert read.shape == made.shape and np.array_equal(read, made), f"points of {dimension} coordinates"


def numbers_of(kind):
    """Interpolated values, and NaN outside of the hull."""
    queries = flat.mean(axis=0) + np.array([[0, 0], [9.5, -20], [1e6, 0]])
    np.save(FOLDER / "queries.npy", queries)
    run("interpolate", "points.npy", "--queries", "queries.npy", "-o", f"values.{kind}")
    read = np.load(FOLDER / "values.npy") if kind == "npy" else pandas.read_csv(FOLDER / "values.csv").iloc[:, -1].to_numpy()
    assert read.shape == (3,) and np.isnan(read).tolist() == [False, False, True]
    assert (np.abs(read[:2] - 460) <= 60).all(), read


def indices_of(kind):
    """Corners of the hull, by the one that GEOS sees."""
    run("hull", "flat.npy", "-o", f"corners.{kind}")
    file = FOLDER / f"corners.{kind}"
    corners = np.load(file) if kind == "npy" else np.loadtxt(file, delimiter=",", skiprows=0, dtype=int)
    hull = shapely.convex_hull(shapely.MultiPoint(flat))
    assert shapely.Polygon(flat[corners.ravel()]).equals(hull), "another hull"


def answers_of(kind):
    """Answers to queries, with the attributes, the places and the system of these."""
    queries = geopandas.GeoDataFrame(
        {"name": ["Å", "b,c", None], "count": [1, 2, 3]}, geometry=geopandas.points_from_xy(*flat[[3, 7, 8]].T), crs=25832
    )
    queries.to_file(FOLDER / "asked.gpkg")
    run("nearest", "flat.npy", "--epsg", 25832, "--queries", "asked.gpkg", "-o", f"answers.{kind}")
    if kind == "csv":
        read = pandas.read_csv(FOLDER / "answers.csv")
    else:
        read = geopandas.read_file(FOLDER / f"answers.{kind}")
        assert read.crs == queries.crs, "another system"
        assert np.array_equal(shapely.get_coordinates(read.geometry), flat[[3, 7, 8]]), "other places"
    assert read.nearest.tolist() == [3, 7, 8] and read["count"].tolist() == [1, 2, 3]
    assert read.name.tolist()[:2] == ["Å", "b,c"] and pandas.isna(read.name[2])


def beside(name, kind):
    """Outputs that tables of Triangle are read with."""
    others = {"poly": ["node"], "ele": ["node"], "edge": ["node"], "neigh": ["node", "ele"]}.get(kind, [])
    return [word for other in others for word in ("-o", f"{name}.{other}")]


def triangles_of(kind):
    """Triangles of points with heights and without."""
    if kind in solvers.KINDS:
        solvers.triangles_of(kind)
        return
    for source, heights in (("points", points[:, 2]), ("flat", np.zeros(len(points)))):
        name = f"mesh-{source}.{kind}"
        run("triangulate", f"{source}.npy", "-o", name, *beside(f"mesh-{source}", kind))
        if kind == "npy":
            assert np.load(FOLDER / name).dtype == np.int64 and normal(np.load(FOLDER / name), points) == expected
        elif kind in ("ply", "obj", "vtu", "off", "msh", "inp"):
            mesh = by_meshio(name)
            assert normal(mesh.cells_dict["triangle"], mesh.points) == expected
            # A mesh of elements is without the points that no triangle has, in an order of its own.
            assert mesh.points.shape[1] == 2 or np.array_equal(np.sort(mesh.points[:, 2]), np.sort(heights)), "other heights"
            if kind in ("msh", "inp"):
                assert "region_0" in mesh.cell_sets and "marker_1" in {**mesh.cell_sets, **mesh.point_sets}
            if kind in ("ply", "obj", "off"):
                surface = trimesh.load(FOLDER / name, process=False)
                assert len(surface.faces) == len(triangles) and np.allclose(surface.vertices[:, 2], heights)
            if kind in ("ply", "obj", "vtu"):
                assert pyvista.read(FOLDER / name).n_cells == len(triangles)
        elif kind == "stl":
            surface = trimesh.load(FOLDER / name, process=False)
            assert len(surface.faces) == len(triangles) == pyvista.read(FOLDER / name).n_cells
            assert abs(surface.area - trimesh.Trimesh(np.c_[flat, heights], triangles).area) < 1.0
        elif kind in ("node", "poly", "ele", "neigh", "edge"):
            tables_of_triangle(f"mesh-{source}", kind)
        elif kind in ("svg", "png"):
            picture(name, 900)
        else:
            read = geometries(name)
            assert normal(*rings(read)) == expected and all(shapely.has_z(read)) == (source == "points")
    if kind == "wkt":
        run("triangulate", "points.npy", "--wkt", "collection", "-o", "whole.wkt")
        assert normal(*rings(shapely.from_wkt((FOLDER / "whole.wkt").read_text()).geoms)) == expected


def tables_of_triangle(source, kind):
    """Files of Triangle, by the reader of the package triangle."""
    if kind == "node":
        assert np.array_equal(by_triangle(f"{source}.node")["vertices"], flat)
        return
    if kind == "edge":
        # The package triangle wants rays, which are of Voronoi diagrams.
        ends = {frozenset(edge) for edge in np.loadtxt(FOLDER / f"{source}.edge", skiprows=1, dtype=int)[:, 1:3].tolist()}
        assert ends == {frozenset(side) for row in triangles.tolist() for side in zip(row, row[1:] + row[:1], strict=True)}
        return
    read = by_triangle(f"{source}.poly") if kind == "poly" else by_triangle(f"{source}.node", f"{source}.{kind}")
    if kind == "ele":
        assert normal(read["triangles"], flat) == expected
    elif kind == "poly":
        border = shapely.polygonize([shapely.LineString(flat[side]) for side in read["segments"]])
        assert shapely.convex_hull(shapely.MultiPoint(flat)).equals(border.geoms[0]), "another hull"
    else:
        rows = by_triangle(f"{source}.node", f"{source}.ele")["triangles"]
        for row, others in zip(rows, read["triangle_neighbors"], strict=True):
            for corner, other in zip(row, others, strict=True):
                assert other < 0 or set(row) - set(rows[other]) == {corner}, "a neighbor that is not opposite"


def second_order_of(kind):
    """Triangles with a node on each edge, of a square: twice their number, and the area as it is."""
    if kind in solvers.KINDS:
        solvers.second_order_of(kind)
        return
    (FOLDER / "square.poly").write_text("4 2 0 0\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n")
    run("mesh", "square.poly", "--max-area", 0.3, "--second-order", "-o", f"second.{kind}", *beside("second", kind))
    if kind in ("vtu", "msh", "inp"):
        mesh = by_meshio(f"second.{kind}")
        rows, corners = mesh.cells_dict["triangle6"], mesh.points[:, :2]
        # Corners, then middles of the sides that follow each.
        for one, other, middle in ((0, 1, 3), (1, 2, 4), (2, 0, 5)):
            assert np.allclose(corners[rows[:, middle]], (corners[rows[:, one]] + corners[rows[:, other]]) / 2), "middles"
    elif kind in ("svg", "png"):
        picture(f"second.{kind}", 20)
        return
    else:
        if kind == "edge":
            assert len(np.loadtxt(FOLDER / "second.edge", skiprows=1)) > 12
            return
        read = by_triangle(
            "second.node" if kind != "poly" else "second.poly", *([] if kind in ("node", "poly") else [f"second.{kind}"])
        )
        if kind != "ele":
            assert len(read.get({"node": "vertices", "poly": "segments"}.get(kind, "triangle_neighbors"))) >= 4
            return
        rows, corners = read["triangles"], read["vertices"]
        # Triangle has the middle that is opposite to each corner.
        for one, other, middle in ((0, 1, 5), (1, 2, 3), (2, 0, 4)):
            assert np.allclose(corners[rows[:, middle]], (corners[rows[:, one]] + corners[rows[:, other]]) / 2), "middles"
    area = sum(shapely.Polygon(corners[row[:3]]).area for row in rows)
    assert abs(area - 4) < 1e-12 and rows.shape[1] == 6


def tetrahedra_of(kind):
    """Tetrahedra, or the border of all of them, with their volume."""
    if kind in solvers.KINDS:
        solvers.tetrahedra_of(kind)
        return
    name = f"solid.{kind}"
    run("triangulate", "ball.npy", "--dim", 3, "-o", name, *([] if kind in ("npy", "node") else ["-o", "solid.node"]))
    volume = np.abs(np.linalg.det(ball[tetrahedra][:, 1:] - ball[tetrahedra][:, :1])).sum() / 6
    if kind == "npy":
        assert np.array_equal(np.load(FOLDER / name), tetrahedra)
    elif kind in ("vtu", "msh", "inp", "ele"):
        mesh = by_meshio("solid.node" if kind == "ele" else name)
        corners = mesh.points[mesh.cells_dict["tetra"]]
        volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        assert len(corners) == len(tetrahedra) and (kind == "ele" or volumes.min() > 0)
        assert abs(np.abs(volumes).sum() - volume) < 1e-9
    elif kind in ("ply", "obj", "stl"):
        border = trimesh.load(FOLDER / name)
        assert border.is_watertight and abs(border.volume - volume) < 1e-5
    elif kind in ("svg", "png"):
        picture(name, 50)
    elif kind == "node":
        assert np.array_equal(np.loadtxt(FOLDER / name, skiprows=1)[:, 1:4], ball)
    elif kind == "neigh":
        rows = np.loadtxt(FOLDER / name, skiprows=1, dtype=int)[:, 1:]
        run("triangulate", "ball.npy", "--dim", 3, "-o", "solid.ele")
        cells = np.loadtxt(FOLDER / "solid.ele", skiprows=1, dtype=int)[:, 1:5]
        for row, others in zip(cells, rows, strict=True):
            for corner, other in zip(row, others, strict=True):
                assert other < 0 or set(row) - set(cells[other]) == {corner}, "a neighbor that is not opposite"
    else:
        edges = np.loadtxt(FOLDER / name, skiprows=1, dtype=int)[:, 1:3]
        pairs = {frozenset((row[i], row[j])) for row in tetrahedra.tolist() for i in range(4) for j in range(i)}
        assert {frozenset(edge) for edge in edges.tolist()} == pairs


def surfaces_of(kind):
    """A hull in space: closed, with the volume that trimesh sees."""
    run("hull", "ball.npy", "--dim", 3, "-o", f"hull.{kind}")
    if kind in ("svg", "png"):
        picture(f"hull.{kind}", 50)
    elif kind == "vtu":
        hull = pyvista.read(FOLDER / "hull.vtu").extract_surface(algorithm="dataset_surface")
        assert hull.n_open_edges == 0 and abs(hull.volume - trimesh.convex.convex_hull(ball).volume) < 1e-6
    else:
        hull = trimesh.load(FOLDER / f"hull.{kind}")
        assert hull.is_watertight and abs(hull.volume - trimesh.convex.convex_hull(ball).volume) < 1e-6


def cells_of(kind):
    """Voronoi cells: valid, a coverage of their box, each around its site."""
    run("voronoi", "flat.npy", "-o", f"cells.{kind}")
    if kind in ("svg", "png"):
        picture(f"cells.{kind}", 500)
        return
    cells = shapely.from_wkt(pandas.read_csv(FOLDER / "cells.csv").wkt) if kind == "csv" else geometries(f"cells.{kind}")
    low, high = flat.min(0), flat.max(0)
    assert len(cells) == len(flat) and shapely.is_valid(cells).all() and shapely.coverage_is_valid(cells)
    assert abs(shapely.area(cells).sum() / np.prod(high - low) - 1) < 1e-9
    assert shapely.intersects_xy(cells, *flat.T).all(), "sites outside of their cells"


def volume_of(points, faces):
    """The volume inside of polygons, by the tetrahedra between the origin and their triangles."""
    rows = [(face[0], one, two) for face in faces for one, two in itertools.pairwise(face[1:])]
    return np.linalg.det(np.asarray(points, float)[rows]).sum() / 6


def polyhedra_of(kind):
    """Cells of a ball of points, and of a box that repeats: each closed, with its volume; they fill what they should."""
    low, high = ball.min(0), ball.max(0)
    for name, words, whole in (("clipped", (), np.prod(high - low)), ("repeated", ("--periodic", "2,2,2,0.5,0,-0.5"), 8)):
        file = f"{name}.{kind}"
        run("voronoi", "ball.npy", "--dim", 3, *words, "-o", file)
        run("voronoi", "ball.npy", "--dim", 3, *words, "-o", f"{name}.npy")
        numbers = np.load(FOLDER / f"{name}.npy")
        assert numbers.shape == (len(ball), 5) and abs(numbers[:, 0].sum() - whole) < 1e-9
        volumes = {}
        if kind == "csv":
            read = pandas.read_csv(FOLDER / file)
            assert np.array_equal(read.iloc[:, 1:].to_numpy(), numbers) and np.array_equal(read.site, np.arange(len(ball)))
        elif kind == "json":
            cells = json.loads((FOLDER / file).read_text())
            assert np.array_equal([cell["position"] for cell in cells], ball)
            volumes = {cell["site"]: volume_of(cell["vertices"], [f["corners"] for f in cell["faces"]]) for cell in cells}
        elif kind == "vtu":
            mesh = by_meshio(file)
            for block, sites, told in zip(mesh.cells, mesh.cell_data["site"], mesh.cell_data["volume"], strict=True):
                for faces, site, volume in zip(block.data, sites, told, strict=True):
                    volumes[site] = volume_of(mesh.points, faces)
                    assert abs(volume - volumes[site]) < 1e-9
            grid = pyvista.read(FOLDER / file)
            for number, site in enumerate(grid["site"]):
                surface = grid.extract_cells(number).extract_surface(algorithm="dataset_surface").triangulate()
                assert surface.n_open_edges == 0 and abs(surface.volume - volumes[site]) < 1e-9
        elif kind == "ply":
            mesh = trimesh.load(FOLDER / file, process=False)
            data = mesh.metadata["_ply_raw"]["face"]["data"]
            cells = collections.defaultdict(list)
            for face, site in zip(data["vertex_indices"], np.ravel(data["site"]), strict=True):
                cells[int(site)] += [(face[0], *pair) for pair in itertools.pairwise(face[1:])]
            for site, faces in cells.items():
                cell = trimesh.Trimesh(mesh.vertices, faces, process=False)
                assert cell.is_watertight and cell.is_winding_consistent
                volumes[site] = cell.volume
            assert pyvista.read(FOLDER / file).n_cells == len(data["site"])
        elif kind == "obj":
            scene = trimesh.load(FOLDER / file, split_objects=True, group_material=False)
            for title, cell in scene.geometry.items():
                assert cell.is_watertight and cell.is_winding_consistent
                volumes[int(title.removeprefix("site_"))] = cell.volume
        elif kind in ("svg", "png"):
            picture(file, 100)
        if kind not in ("csv", "npy", "svg", "png"):
            assert np.allclose([volumes[site] for site in range(len(ball))], numbers[:, 0], rtol=0, atol=1e-9)


def edges_of(kind):
    """A spanning tree: edges that join all points."""
    run("graph", "flat.npy", "--kind", "spanning-tree", "-o", f"edges.{kind}")
    if kind == "npy":
        ends = np.load(FOLDER / "edges.npy")
    elif kind == "csv":
        ends = pandas.read_csv(FOLDER / "edges.csv")[["from", "to"]].to_numpy()
    else:
        lines = geopandas.read_file(FOLDER / f"edges.{kind}")
        assert len(lines) == len(flat) - 1 and np.allclose(lines.length, lines["length"])
        assert shapely.line_merge(lines.union_all()).is_valid and len(
            set(map(tuple, shapely.get_coordinates(lines.geometry)))
        ) == len(flat)
        return
    assert ends.shape == (len(flat) - 1, 2) and len(np.unique(ends)) == len(flat)


def patches_of(kind):
    """Triangles of polygons, with their area, attributes and system."""
    geopandas.GeoDataFrame({"name": list("abc")}, geometry=squares, crs=25832).to_file(FOLDER / "squares.gpkg")
    run("polygons", "squares.gpkg", "-o", f"patches.{kind}")
    if kind in ("svg", "png"):
        picture(f"patches.{kind}", 8)
        return
    if kind in ("csv", "npy"):
        run("polygons", "squares.gpkg", "-o", "patches.obj")
        read = (
            np.load(FOLDER / "patches.npy") if kind == "npy" else pandas.read_csv(FOLDER / "patches.csv", header=None).to_numpy()
        )
        assert np.array_equal(read, by_meshio("patches.obj").cells_dict["triangle"]), f"{read.shape}"
        return
    if kind in ("obj", "vtu"):
        mesh = by_meshio(f"patches.{kind}")
        area = trimesh.Trimesh(mesh.points, mesh.cells_dict["triangle"], process=False).area
    elif kind in ("ply", "stl"):
        # meshio takes the first number of a face's property for all of them.
        area = trimesh.load(FOLDER / f"patches.{kind}").area
    else:
        area = shapely.area(geometries(f"patches.{kind}")).sum()
    assert abs(area - area_of_squares) < (1e-4 if kind == "stl" else 1e-9), f"area {area}"
    if kind in GEOMETRIES:
        read = geopandas.read_file(FOLDER / f"patches.{kind}")
        assert set(read.name) == set("abc") and read.crs.to_epsg() == 25832


def lines_of(kind):
    """The flake of Koch: a ring as segments, as one polygon, or as lines between points."""
    run("generate", "koch", "-n", 48, "-o", f"koch.{kind}")
    if kind == "poly":
        read = by_triangle("koch.poly")
        shape = shapely.polygonize([shapely.LineString(read["vertices"][side]) for side in read["segments"]]).geoms[0]
    else:
        shape = shapely.union_all(geometries(f"koch.{kind}"))
        shape = shape if shape.area else shapely.polygonize([shape]).geoms[0]
    assert shape.is_valid and shape.area > 0.3 and len(shape.exterior.coords) == 49, f"{shape.geom_type} of {shape.area}"


def contours_of(kind):
    """Lines at steps of their interval, and valid bands that fill the hull."""
    run("contours", "points.npy", "--interval", 20, "-o", f"contours.{kind}")
    if kind in ("svg", "png"):
        picture(f"contours.{kind}", 10)
        return
    lines = geopandas.read_file(FOLDER / f"contours.{kind}")
    assert lines.geometry.is_simple.all() and (lines.elevation % 20 == 0).all() and len(lines) > 5
    run("contours", "points.npy", "--interval", 20, "--bands", "-o", f"bands.{kind}")
    bands = geopandas.read_file(FOLDER / f"bands.{kind}")
    hull = shapely.convex_hull(shapely.MultiPoint(flat))
    assert bands.geometry.is_valid.all() and abs(bands.area.sum() / hull.area - 1) < 1e-6


def filtrations_of(kind):
    """The values of triangles are the squares of their circumradii."""
    run("alpha", "flat.npy", "--filtration", f"filtration.{kind}")
    count = len(triangles)
    if kind == "npz":
        with np.load(FOLDER / "filtration.npz") as read:
            assert len(read["triangles"]) == count and read["triangles"].shape[1] == 3
            value = dict(zip(map(tuple, np.sort(read["triangles"], axis=1).tolist()), read["triangle_values"], strict=True))
    else:
        rows = [line.split(",") for line in (FOLDER / "filtration.csv").read_text().splitlines()]
        value = {tuple(sorted(map(int, row[1:]))): float(row[0]) for row in rows if len(row) == 4}
    assert len(value) == count
    for corners in (np.sort(triangles, axis=1)[:50]).tolist():
        one, two, three = flat[corners] - flat[corners[0]]
        sides = [np.hypot(*(two - one)), np.hypot(*(three - two)), np.hypot(*(three - one))]
        area = abs(two[0] * three[1] - two[1] * three[0]) / 2
        square = (np.prod(sides) / (4 * area)) ** 2
        assert abs(value[tuple(corners)] / square - 1) < 1e-6, "another circumradius"


def rasters_of(kind):
    """Cells of terrain in their places, with their system."""
    # A layer has its system as well-known text too, which is what can be said beside an ESRI grid.
    known = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*points.T), crs=25832)
    known.to_file(FOLDER / "known.gpkg")
    run("dtm", "known.gpkg", "--cell", 5, "-o", f"dem.{kind}", *([] if kind == "npy" else ["-o", "dem.npy"]))
    heights = np.load(FOLDER / "dem.npy")
    assert heights.shape > (100, 100) and np.nanmin(heights) > 400 and np.nanmax(heights) < 520
    if kind == "npy":
        return
    with rasterio.open(FOLDER / f"dem.{kind}") as raster:
        read = raster.read(1, masked=True).filled(np.nan)
        assert np.array_equal(np.isnan(read), np.isnan(heights)) and np.nanmax(np.abs(read - heights)) < 1e-3
        assert raster.transform.a == 5 and raster.transform.e == -5 and raster.transform.c % 5 == 0
        assert raster.crs.to_epsg() == 25832


def pictures_of(kind):
    """A picture of a triangulation."""
    run("draw", "flat.npy", "-o", f"drawn.{kind}")
    picture(f"drawn.{kind}", 500)


JUDGES = {
    "points": points_of,
    "numbers": numbers_of,
    "rows of indices": indices_of,
    "answers to queries": answers_of,
    "triangles": triangles_of,
    "elements of second order": second_order_of,
    "quadrilaterals": solvers.quads_of,
    "tetrahedra": tetrahedra_of,
    "surfaces in space": surfaces_of,
    "Voronoi cells": cells_of,
    "Voronoi cells in space": polyhedra_of,
    "edges": edges_of,
    "triangles of polygons": patches_of,
    "lines and polygons": lines_of,
    "contours": contours_of,
    "filtrations": filtrations_of,
    "rasters": rasters_of,
    "pictures": pictures_of,
}

# Judges that cannot be asked where a package is missing: the row is told as passed over.
NEEDS = {("triangles", kind): triangle for kind in ("node", "poly", "ele", "neigh", "edge")}
NEEDS |= {("elements of second order", kind): triangle for kind in ("node", "poly", "ele", "neigh", "edge")}
NEEDS |= {("lines and polygons", "poly"): triangle}
