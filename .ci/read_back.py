"""Reads what delone writes with programs that others wrote: meshio, trimesh, pyvista, geopandas (GDAL), shapely, Pillow,
rasterio.

Usage: python read_back.py DELONE FOLDER: the program, and a folder to work in. Every format is written from the same points,
and every reader must see the same triangles.
"""

import json
import subprocess
import sys
from pathlib import Path

import ezdxf
import geopandas
import laspy
import meshio
import numpy as np
import pandas
import pyogrio
import pyvista
import rasterio
import shapely
import trimesh
from PIL import Image

delone, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)


def run(*words):
    subprocess.run([delone, "-q", *map(str, words)], check=True, cwd=folder)


def same(triangles, points, expected):
    """Whether triangles, by the coordinates of their corners, are those expected."""

    def normal(corners):
        corners = np.round(np.asarray(corners, dtype=float)[..., :2], 4)
        return sorted(sorted(map(tuple, triangle)) for triangle in corners.tolist())

    assert normal(np.asarray(points)[np.asarray(triangles)]) == expected, "other triangles"


# Terrain in projected coordinates, far from the origin, and the same without heights.
rng = np.random.default_rng(1)
points = rng.uniform((637_000.0, 849_000.0, 400.0), (637_900.0, 849_700.0, 520.0), (500, 3)).round(3)
np.save(folder / "points.npy", points)
np.save(folder / "flat.npy", points[:, :2])
run("triangulate", "points.npy", "-o", "mesh.npy")
triangles = np.load(folder / "mesh.npy")
assert triangles.dtype == np.int64 and triangles.shape[1] == 3
corners = np.round(points[triangles][..., :2], 4)
expected = sorted(sorted(map(tuple, triangle)) for triangle in corners.tolist())

for source in ["points", "flat"]:
    for kind in ["ply", "obj", "stl", "vtu", "geojson", "wkt", "wkb", "svg", "png", "node", "ele", "off"]:
        run("triangulate", f"{source}.npy", "-o", f"{source}.{kind}")
    run("triangulate", f"{source}.npy", "--wkt", "collection", "-o", f"{source}-whole.wkt")
    heights = points[:, 2] if source == "points" else np.zeros(len(points))
    for kind in ["ply", "obj", "vtu", "off"]:
        mesh = meshio.read(folder / f"{source}.{kind}")
        same(mesh.cells_dict["triangle"], mesh.points, expected)
        assert np.array_equal(mesh.points[:, 2], heights), f"meshio: heights of {kind}"
        print(f"meshio reads {source}.{kind}")
    for kind in ["msh", "inp"]:
        run("triangulate", f"{source}.npy", "-o", f"{source}.{kind}")
        mesh = meshio.read(folder / f"{source}.{kind}")
        same(mesh.cells_dict["triangle"], mesh.points, expected)
        assert kind == "msh" or np.array_equal(mesh.points[:, :2], points[:, :2]), "meshio: points of inp"
        assert mesh.points.shape[1] == 2 or np.array_equal(np.sort(mesh.points[:, 2]), np.sort(heights))
        assert "region_0" in mesh.cell_sets and "marker_1" in {**mesh.cell_sets, **mesh.point_sets}
        print(f"meshio reads {source}.{kind}")
    for kind in ["ply", "obj", "stl", "off"]:
        mesh = trimesh.load(folder / f"{source}.{kind}", process=False)
        assert len(mesh.faces) == len(triangles), f"trimesh: {kind}"
        assert abs(mesh.area - trimesh.Trimesh(np.c_[points[:, :2], heights], triangles).area) < 1.0
        print(f"trimesh reads {source}.{kind}")
    for kind in ["ply", "obj", "stl", "vtu"]:
        mesh = pyvista.read(folder / f"{source}.{kind}")
        assert mesh.n_cells == len(triangles), f"pyvista: {kind}"
        print(f"pyvista reads {source}.{kind}")
    frame = geopandas.read_file(folder / f"{source}.geojson")
    text, whole, binary = (folder / f"{source}{kind}" for kind in [".wkt", "-whole.wkt", ".wkb"])
    collections = [shapely.from_wkt(whole.read_text()), shapely.from_wkb(binary.read_bytes())]
    lines = geopandas.GeoSeries.from_wkt(text.read_text().splitlines())
    for polygons in [frame.geometry, lines, *(collection.geoms for collection in collections)]:
        rings = [np.array(polygon.exterior.coords)[:3] for polygon in polygons]
        same(np.arange(3 * len(rings)).reshape(-1, 3), np.concatenate(rings), expected)
    assert all(collection.has_z == (source == "points") for collection in collections)
    print(f"geopandas reads {source}.geojson and {text.name}, shapely {whole.name} and {binary.name}")
    with Image.open(folder / f"{source}.png") as picture:
        picture.verify()
    print(f"Pillow reads {source}.png")

# STL has single precision: the mesh is moved to where that is enough, and the title tells by how much.
title = (folder / "points.stl").read_bytes()[:80].decode().split()
moved = np.array([float(x) for x in title[-3:]])
stl = trimesh.load(folder / "points.stl", process=False)
worst = np.abs(stl.vertices - moved - points[triangles].reshape(-1, 3)).max()
assert worst < 1e-3, f"STL is {worst} off"

# Degrees with heights in metres, and a turned lattice, whose border has triangles an ulp wide: nothing turns over.
track = np.c_[np.cumsum(rng.uniform(-4e-5, 4e-5, (900, 2)), axis=0) + (7.62, 51.96), rng.uniform(50, 90, 900)].round(6)
lattice = np.indices((25, 25)).reshape(2, -1).T @ [[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]]
for name, hard in [("track", track), ("lattice", lattice)]:
    np.save(folder / f"{name}.npy", hard)
    run("triangulate", f"{name}.npy", "-o", f"{name}.stl")
    mesh = trimesh.load(folder / f"{name}.stl", process=False)
    assert (mesh.face_normals[:, 2] > 0).all() and (mesh.area_faces > 0).all(), f"triangles of {name}.stl turn over"
    assert len(mesh.faces) > 0.9 * 2 * len(hard), f"{name}.stl lost triangles"
print("trimesh: no triangle of STL turns over")
run("triangulate", "lattice.npy", "--drop-slivers", 1e-9, "-o", "whole.ply", "-o", "whole.obj")
for kind in ["ply", "obj"]:
    mesh = trimesh.load(folder / f"whole.{kind}", process=False)
    assert len(mesh.faces) == 2 * 24 * 24 and mesh.area_faces.min() > 0.4, f"slivers in whole.{kind}"
# Shapes without an area are no blank sheets.
run("generate", "ball", "-n", 50, "-o", "few.npy")
run("alpha", "few.npy", "--dim", 3, "--alpha", 0, "-o", "points-3.png")
run("alpha", "track.npy", "--alpha", 0, "-o", "points-2.png")
for name in ["points-2.png", "points-3.png"]:
    with Image.open(folder / name) as picture:
        assert (np.asarray(picture.convert("L"))[:-80] < 128).sum() > 500, f"{name} is blank"
# A bay of the hull so narrow that no number is in it, and shapely's areas of what is meshed.
ring = [[0.1, 0.01], [0.2, 0.02], [0.3, 0.03], [1.2, -0.98], [0.1, 0.01]]
narrow = shapely.Polygon(ring)
(folder / "narrow.wkt").write_text(narrow.wkt)
run("mesh", "narrow.wkt", "-o", "narrow.geojson")
assert abs(geopandas.read_file(folder / "narrow.geojson").area.sum() - narrow.area) < 1e-12, "a mesh of another area"

# Tetrahedra, hulls and cells.
run("generate", "ball", "-n", 300, "-o", "ball.npy")
run("triangulate", "ball.npy", "--dim", 3, "-o", "ball.vtu", "-o", "ball.npy.npy", "-o", "ball.msh", "-o", "ball.inp")
cells = np.load(folder / "ball.npy.npy")
assert np.array_equal(meshio.read(folder / "ball.vtu").cells_dict["tetra"], cells)
assert pyvista.read(folder / "ball.vtu").n_cells == len(cells)
for kind in ["msh", "inp"]:
    mesh = meshio.read(folder / f"ball.{kind}")
    corners = mesh.points[mesh.cells_dict["tetra"]]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1])
    assert len(corners) == len(cells) and volumes.min() > 0, f"meshio: tetrahedra of {kind}"
run("hull", "ball.npy", "--dim", 3, "-o", "hull.stl", "-o", "hull.ply")
for kind in ["stl", "ply"]:
    assert trimesh.load(folder / f"hull.{kind}").is_watertight, f"the hull in {kind} has holes"
run("voronoi", "flat.npy", "-o", "cells.geojson")
frame = geopandas.read_file(folder / "cells.geojson")
low, high = points[:, :2].min(0), points[:, :2].max(0)
assert frame.geometry.is_valid.all() and abs(frame.area.sum() / np.prod(high - low) - 1) < 1e-9

# Cells whole, in pieces and gone, in every format of geometries: those of GeoJSON, bit for bit.
middle, edge = (low + high) / 2, low + 0.8 * (high - low)
notch = shapely.box(*low, *edge).difference(shapely.box(*middle, edge[0] + 1, middle[1] + 1))
(folder / "notch.geojson").write_text(shapely.to_geojson(notch))
for order, key in [([], "site"), (["--order", 2], "sites")]:
    words = ["flat.npy", "--clip", "notch.geojson", *order]
    run("voronoi", *words, "-o", "cells.geojson", "-o", "cells.csv", "-o", "cells.wkt", "-o", "cells.wkb")
    run("voronoi", *words, "--wkt", "collection", "-o", "cells-whole.wkt")
    shapes = [
        shapely.from_geojson(json.dumps(feature["geometry"])) if feature["geometry"] else shapely.Polygon()
        for feature in json.loads((folder / "cells.geojson").read_text())["features"]
    ]
    assert {shape.geom_type for shape in shapes} == {"Polygon", "MultiPolygon"} and any(shape.is_empty for shape in shapes)
    table = geopandas.read_file(folder / "cells.csv")
    about = geopandas.read_file(folder / "cells.geojson")
    assert list(table.columns[:2]) == [key, "area"] and np.array_equal(table["area"].astype(float), about["area"])
    # Lists are apart by spaces.
    assert [str(sites).split() for sites in table[key]] == [str(sites).strip("[]").replace(",", " ").split() for sites in about[key]]
    lines = shapely.from_wkt((folder / "cells.wkt").read_text().splitlines())
    whole = shapely.from_wkt((folder / "cells-whole.wkt").read_text()).geoms
    binary = shapely.from_wkb((folder / "cells.wkb").read_bytes()).geoms
    column = shapely.from_wkt(pandas.read_csv(folder / "cells.csv").wkt)
    for name, read in [("csv", table.geometry), ("csv by pandas", column), ("wkt", lines), ("collection", whole), ("wkb", binary)]:
        assert np.array_equal(shapely.to_wkb(list(read)), shapely.to_wkb(shapes)), f"cells in {name}"
    print(f"geopandas and shapely read cells, {key}")

# The system of coordinates goes through.
feature = json.loads((folder / "flat.geojson").read_text())
feature["crs"] = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
(folder / "known.geojson").write_text(json.dumps(feature))
run("triangulate", "known.geojson", "-o", "passed.geojson")
assert geopandas.read_file(folder / "passed.geojson").crs.to_epsg() == 25832
run("voronoi", "known.geojson", "-o", "passed.wkb", "-o", "passed-cells.geojson")
assert shapely.get_srid(shapely.from_wkb((folder / "passed.wkb").read_bytes())) == 25832
assert geopandas.read_file(folder / "passed-cells.geojson").crs.to_epsg() == 25832

# Rasters: values, places and systems, and those that others write.
np.savetxt(folder / "points.csv", points, delimiter=",", header="x,y,z", comments="")
run("dtm", "points.csv", "--cell", 5, "--epsg", 25832, "-o", "dem.tif", "-o", "dem.asc", "-o", "dem.npy")
heights = np.load(folder / "dem.npy")
for kind in ["tif", "asc"]:
    with rasterio.open(folder / f"dem.{kind}") as raster:
        read = raster.read(1, masked=True).filled(np.nan)
        assert np.array_equal(np.isnan(read), np.isnan(heights)), f"rasterio: cells of {kind}"
        assert np.nanmax(np.abs(read - heights)) < 1e-3, f"rasterio: values of {kind}"
        assert raster.transform.a == 5 and raster.transform.e == -5 and raster.transform.c % 5 == 0
        assert kind == "asc" or raster.crs.to_epsg() == 25832
    print(f"rasterio reads dem.{kind}")
run("contours", "dem.tif", "--interval", 20, "--bands", "-o", "bands.geojson")
frame = geopandas.read_file(folder / "bands.geojson")
assert frame.geometry.is_valid.all() and frame.crs.to_epsg() == 25832
assert (frame.upper - frame.lower == 20).all() and not frame.geometry.union_all().is_empty
assert abs(frame.area.sum() - frame.geometry.union_all().area) < 1e-6 * frame.area.sum()
run("contours", "points.npy", "--interval", 20, "-o", "lines.geojson")
frame = geopandas.read_file(folder / "lines.geojson")
assert frame.geometry.is_simple.all() and (frame.elevation % 20 == 0).all()
print("geopandas reads contours")
print("all formats are read by others")

# And what others write is read here.
cloud = pyvista.PolyData(points)
grid = pyvista.UnstructuredGrid({pyvista.CellType.VERTEX: np.arange(len(points)).reshape(-1, 1)}, points)
surface = pyvista.PolyData.from_regular_faces(points, triangles)
cloud.save(folder / "other.vtp")
grid.save(folder / "other.vtu")
grid.save(folder / "other-legacy.vtk")
grid.save(folder / "other-text.vtk", binary=False)
surface.save(folder / "other.ply")
meshio.write(folder / "other.off", meshio.Mesh(points, [("triangle", triangles)]))
meshio.write(folder / "meshio.vtu", meshio.Mesh(points, [("triangle", triangles)]))
np.savez(folder / "other.npz", ids=np.arange(5), points=points)
np.savez_compressed(folder / "packed.npz", points=points)
np.save(folder / "columns.npy", points.T)
np.save(folder / "fortran.npy", np.asfortranarray(points))
table = pandas.DataFrame({"id": np.arange(len(points)), "X_COORD": points[:, 0], "Y_COORD": points[:, 1], "Z_VAL": points[:, 2]})
table.to_csv(folder / "other.csv.gz", index=False, quoting=2)
table.to_csv(folder / "decimal.csv", sep=";", decimal=",", encoding="utf-8-sig")
known = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*points.T), crs=25832)
known.to_file(folder / "other.geojson", driver="GeoJSON")
known.to_wkt().to_csv(folder / "wkt.csv")
shape = shapely.MultiPoint(points)
(folder / "other.wkt").write_text(shapely.to_wkt(shape, rounding_precision=-1))
(folder / "other.wkb").write_bytes(shapely.to_wkb(shapely.set_srid(shape, 25832), include_srid=True, byte_order=0))
las = laspy.create(point_format=6, file_version="1.4")
las.header.offsets, las.header.scales = points.min(0), [0.001] * 3
las.xyz = points
las.write(folder / "other.las")
las.write(folder / "other.laz")
names = "other.vtp other.vtu other-legacy.vtk other-text.vtk other.ply other.off meshio.vtu other.npz packed.npz columns.npy"
names += " fortran.npy other.csv.gz decimal.csv other.geojson wkt.csv other.wkt other.wkb other.las other.laz"
for name in names.split():
    run("triangulate", name, "-o", "again.ply")
    read = meshio.read(folder / "again.ply").points
    # This writer of PLY has single precision, tiles have steps.
    precision = {"other.ply": 0.1, "other.las": 0.01, "other.laz": 0.01}.get(name, 1e-6)
    assert read.shape == points.shape and np.abs(read - points).max() <= precision, name
    print(f"delone reads {name}")

# Lines of VTK's files are segments, and their triangles and tetrahedra are judged.
corners = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0], [1, 1, 0], [3, 2, 0], [2, 2.5, 0]], float)
ring, path = [0, 1, 2, 3, 0], [4, 5, 6]
ends = np.array([list(side) for chain in (ring, path) for side in zip(chain, chain[1:])])
cells = {pyvista.CellType.LINE: ends, pyvista.CellType.TRIANGLE: np.array([[0, 1, 4], [1, 2, 5]])}
drawn = pyvista.PolyData(corners, lines=np.hstack([[len(ring), *ring], [len(path), *path]]))
drawn.field_data["who"], drawn.field_data["time"] = ["somebody", "x" * 70], np.array([1.5])
for how in (True, False):
    for thing, kind in ((drawn, "vtp"), (drawn, "vtk"), (pyvista.UnstructuredGrid(cells, corners), "vtu")):
        thing.save(folder / f"lines.{kind}", binary=how)
        run("triangulate", f"lines.{kind}", "-o", "again.poly")
        rows = [line.split() for line in (folder / "again.poly").read_text().splitlines()]
        read = {frozenset(map(int, row[1:3])) for row in rows[len(corners) + 2 :] if len(row) >= 3}
        assert read == {frozenset(side) for side in ends.tolist()}, f"lines of {kind}: {read}"
meshio.write(folder / "lines.vtk", meshio.Mesh(corners, [("line", ends)]), file_format="vtk42")
run("triangulate", "lines.vtk", "-o", "again.poly")
run("triangulate", "ball.npy", "--dim", 3, "-o", "again.vtu")
pyvista.read(folder / "again.vtu").save(folder / "again.vtk")
run("check", "again.vtk", "again.vtk", "--dim", 3)
print("delone reads lines and tetrahedra of VTK's files")

# Rasters of all kinds of numbers, in tiles and strips, with what GeoTIFF can say of them.
cells = np.round(400 + 50 * np.sin(np.arange(90)[:, None] / 9) * np.cos(np.arange(130) / 7))
place = rasterio.transform.from_origin(637_000, 849_700, 2, 2)
kinds = [("int16", "lzw", 1, True), ("uint16", "deflate", 2, True), ("float32", "deflate", 3, False), ("float64", "none", 1, False)]
kinds += [("int32", "packbits", 1, True), ("uint8", "deflate", 2, False), ("float32", "lzw", 3, True)]
for number, (kind, compress, predictor, tiled) in enumerate(kinds):
    values = (cells - 300 if kind == "uint8" else cells).astype(kind)
    missing = 0 if kind.startswith("u") else -9999
    values[3, 5] = missing
    profile = dict(driver="GTiff", dtype=kind, width=130, height=90, count=1, crs="EPSG:25832", transform=place)
    profile |= dict(nodata=missing, tiled=tiled, compress=compress)
    profile |= dict(blockxsize=64, blockysize=32) if tiled else {}
    profile |= dict(predictor=predictor) if predictor > 1 else {}
    with rasterio.open(folder / "other.tif", "w", **profile) as raster:
        raster.write(values, 1)
    run("triangulate", "other.tif", "-o", "again.geojson", "-o", "again.obj")
    read = np.array([line.split()[1:] for line in (folder / "again.obj").read_text().splitlines() if line[0] == "v"], float)
    assert len(read) == 130 * 90 - 1 and (read[0] == [637_001, 849_699, values[0, 0]]).all(), kind
    assert np.array_equal(read[:, 2], values.ravel()[np.arange(130 * 90) != 3 * 130 + 5].astype(float)), kind
    assert geopandas.read_file(folder / "again.geojson").crs.to_epsg() == 25832
    print(f"delone reads GeoTIFF of {kind}, {compress}")

# Features with attributes: what is written here is read by GDAL, with types, values, rings and systems.
sites = known.assign(number=np.arange(len(points)), name=[f"Å {i}" for i in range(len(points))], size=points[:, 2] / 8)
sites = sites.assign(even=sites.number % 2 == 0, where=None)
sites.loc[::7, "where"] = "here"
sites.to_file(folder / "sites.geojson")
run("voronoi", "sites.geojson", "--clip", "hull", "-o", "sites.fgb", "-o", "sites.gpkg", "-o", "sites.json")
cells = geopandas.read_file(folder / "sites.json")
for kind in ["fgb", "gpkg"]:
    read = geopandas.read_file(folder / f"sites.{kind}")
    assert read.crs == known.crs and list(read.columns) == list(cells.columns), f"{kind}: {list(read.columns)}"
    assert np.array_equal(shapely.to_wkb(read.geometry), shapely.to_wkb(cells.geometry)), f"rings in {kind}"
    for column in read.columns.drop("geometry"):
        assert read[column].equals(cells[column].astype(read[column].dtype)), f"{column} in {kind}"
    assert [str(read[column].dtype) for column in ["site", "area", "size", "even"]] == ["int64", "float64", "float64", "bool"]
    run("triangulate", "points.npy", "-o", f"mesh.{kind}")
    mesh = geopandas.read_file(folder / f"mesh.{kind}")
    indexed = pyogrio.read_info(folder / f"mesh.{kind}")["capabilities"]["fast_spatial_filter"]
    assert indexed == (kind == "gpkg"), f"the index of {kind}"
    middle = shapely.box(*(mesh.total_bounds.reshape(2, 2).mean(axis=0) + [[-9, -9], [9, 9]]).ravel())
    near = geopandas.read_file(folder / f"mesh.{kind}", bbox=middle.bounds)
    assert 0 < len(near) == mesh.intersects(middle).sum() < len(mesh), f"a part of {kind}"
    rings = [np.array(polygon.exterior.coords)[:3] for polygon in mesh.geometry]
    same(np.arange(3 * len(rings)).reshape(-1, 3), np.concatenate(rings), expected)
    assert mesh.geometry.has_z.all() and mesh.crs is None
    run("contours", "dem.tif", "--interval", 20, "--bands", "-o", f"bands.{kind}")
    bands = geopandas.read_file(folder / f"bands.{kind}")
    assert bands.crs.to_epsg() == 25832 and set(bands.geom_type) == {"MultiPolygon"}
    assert np.array_equal(shapely.to_wkb(bands.geometry), shapely.to_wkb(geopandas.read_file(folder / "bands.geojson").geometry))
    print(f"geopandas reads cells, triangles and contours in {kind}")
# Programs that change the layer keep its index true.
more = bands.iloc[:1].translate(1e6)
pyogrio.write_dataframe(more.to_frame("geometry"), folder / "bands.gpkg", layer="contours", append=True)
added = geopandas.read_file(folder / "bands.gpkg", bbox=tuple(more.total_bounds))
assert len(added) == 1 and pyogrio.read_info(folder / "bands.gpkg")["features"] == len(bands) + 1, "a feature more"
print("GDAL adds a feature to a GeoPackage")
# Lines are a layer beside the triangles: edges that cover each line, with its attributes.
ways = geopandas.GeoDataFrame(
    {"name": ["high", "low"], "lanes": [2, 1]},
    geometry=[shapely.LineString([(0, 0), (10, 1), (20, 0)]), shapely.LineString([(0, 5), (20, 6)])],
    crs=25832,
)
ways.to_file(folder / "ways.gpkg")
for command in (["triangulate"], ["mesh", "--max-area", 9]):
    run(*command, "ways.gpkg", "-o", "edges.gpkg")
    edges = geopandas.read_file(folder / "edges.gpkg", layer="lines")
    assert edges.crs == ways.crs and set(edges.geom_type) == {"LineString"} and edges.lanes.dtype == "int64"
    for row in ways.itertuples():
        found = edges[(edges.name == row.name) & (edges.lanes == row.lanes)]
        assert abs(found.length.sum() - row.geometry.length) < 1e-9 and row.geometry.hausdorff_distance(found.union_all()) < 1e-9
    assert len(edges) == sum(edges.name.isin(ways.name)) and len(geopandas.read_file(folder / "edges.gpkg", layer="triangles")) > 3
print("geopandas reads lines with their attributes")

# And what GDAL and ezdxf write is read here, with the same attributes: of polygons, triangles have them.
squares = [shapely.box(x, x, x + 3, x + 3) for x in (0, 10, 20)]
squares[0] = squares[0].difference(shapely.box(1, 1, 2, 2))
squares[1] = shapely.MultiPolygon([squares[1], shapely.box(50, 0, 52, 2)])
areas = geopandas.GeoDataFrame(
    {
        "name": ["Å", 'b "c"', None],
        "count": [1, -(2**40), 3],
        "size": [0.5, None, 1e9 + 0.125],
        "good": [True, False, True],
        "day": pandas.to_datetime(["2024-01-02", "1999-12-31", None]).date,
    },
    geometry=squares,
    crs=25832,
)
about = ["name", "count", "size", "good", "day"]
areas.to_file(folder / "areas.geojson")
run("polygons", "areas.geojson", "-o", "areas-triangles.geojson")
triangulated = geopandas.read_file(folder / "areas-triangles.geojson")
assert len(triangulated) > 8 and abs(triangulated.area.sum() - areas.area.sum()) < 1e-9
for command in [("polygons",), ("triangulate",), ("mesh", "--max-area", 0.5)]:
    run(command[0], "areas.geojson", *command[1:], "-o", "areas.vtu", "-o", "areas-triangles.geojson")
    table = geopandas.read_file(folder / "areas-triangles.geojson")
    by_meshio, by_vtk = meshio.read(folder / "areas.vtu").cell_data, pyvista.read(folder / "areas.vtu").cell_data
    assert set(by_meshio) == set(by_vtk.keys()) == {"region", "count", "size"}, f"{set(by_meshio)}"
    for column in ["count", "size"]:
        assert np.array_equal(by_meshio[column][0], table[column].astype(float), equal_nan=True), f"{column} by meshio"
        assert np.array_equal(by_vtk[column], table[column].astype(float), equal_nan=True), f"{column} by VTK"
print("meshio and pyvista read attributes of triangles")
for kind in ["gpkg", "fgb", "shp"]:
    # An index would put the features of FlatGeobuf into another order.
    options = {"SPATIAL_INDEX": "NO"} if kind == "fgb" else {}
    areas.to_file(folder / f"areas.{kind}", **options)
    run("polygons", f"areas.{kind}", "-o", "again.geojson")
    read = geopandas.read_file(folder / "again.geojson")
    assert read.crs == areas.crs, f"the system of {kind}"
    own = [read[read.polygon == number].iloc[0] for number in (0, 1, 3)]
    assert abs(read.area.sum() - areas.area.sum()) < 1e-9, f"areas in {kind}"
    for row, area in zip(own, areas.itertuples(), strict=True):
        for column in about:
            one, other = row[column], getattr(area, column)
            both_missing = pandas.isna(one) and pandas.isna(other)
            assert both_missing or str(one) == str(other) or one == other, f"{column} in {kind}: {one}, {other}"
    print(f"delone reads areas.{kind}")
drawing = ezdxf.new("R2010")
space = drawing.modelspace()
for x, y, z in points[:50]:
    space.add_point((x, y, z), dxfattribs={"layer": "Höhen"})
arm = drawing.blocks.new("arm", base_point=(1, 0))
arm.add_line((1, 0), (3, 0))
# Beside all points: where two are, the lower height counts.
place = points[0, :2] + 0.5
inserted = space.add_blockref("arm", tuple(place.tolist()), dxfattribs={"xscale": 2, "rotation": 30})
ends = [list(end)[:2] for line in inserted.virtual_entities() for end in (line.dxf.start, line.dxf.end)]
drawing.saveas(folder / "other.dxf")
run("triangulate", "other.dxf", "-o", "again.ply")
read = meshio.read(folder / "again.ply").points
assert np.array_equal(read[:50], points[:50]) and np.abs(read[50:, :2] - ends).max() < 1e-9
run("voronoi", "other.dxf", "-o", "again.geojson")
assert list(geopandas.read_file(folder / "again.geojson").layer[:50]) == ["Höhen"] * 50
print("delone reads other.dxf")
