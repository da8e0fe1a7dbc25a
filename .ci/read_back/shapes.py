"""Shapes that are hard for a reader: triangles an ulp wide, cells in pieces, single precision, all kinds of numbers."""

import json

import geopandas
import meshio
import numpy as np
import pandas
import pyvista
import rasterio
import shapely
import trimesh
from PIL import Image
from world import FOLDER as folder
from world import flat, path, points, ring, rng, run, triangles
from world import places as corners
from world import segments as ends


def single_precision():
    """A mesh of STL is moved to where single precision is enough, and the title tells by how much."""
    run("triangulate", "points.npy", "-o", "mesh-points.stl")
    title = (folder / "mesh-points.stl").read_bytes()[:80].decode().split()
    moved = np.array([float(x) for x in title[-3:]])
    stl = trimesh.load(folder / "mesh-points.stl", process=False)
    worst = np.abs(stl.vertices - moved - points[triangles].reshape(-1, 3)).max()
    assert worst < 1e-3, f"STL is {worst} off"


def no_triangle_turns_over():
    """Degrees with heights in meters, and a turned lattice, whose border has triangles an ulp wide."""
    track = np.c_[np.add(np.cumsum(rng.uniform(-4e-5, 4e-5, (900, 2)), axis=0), (7.62, 51.96)), rng.uniform(50, 90, 900)].round(6)
    lattice = np.indices((25, 25)).reshape(2, -1).T @ [[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]]
    for name, hard in [("track", track), ("lattice", lattice)]:
        np.save(folder / f"{name}.npy", hard)
        run("triangulate", f"{name}.npy", "-o", f"{name}.stl")
        mesh = trimesh.load(folder / f"{name}.stl", process=False)
        assert (mesh.face_normals[:, 2] > 0).all() and (mesh.area_faces > 0).all(), f"triangles of {name}.stl turn over"
        assert len(mesh.faces) > 0.9 * 2 * len(hard), f"{name}.stl lost triangles"
    run("triangulate", "lattice.npy", "--drop-slivers", 1e-9, "-o", "whole.ply", "-o", "whole.obj")
    for kind in ["ply", "obj"]:
        mesh = trimesh.load(folder / f"whole.{kind}", process=False)
        assert len(mesh.faces) == 2 * 24 * 24 and mesh.area_faces.min() > 0.4, f"slivers in whole.{kind}"


def shapes_without_area():
    """Pictures of shapes without an area are no blank sheets."""
    run("generate", "ball", "-n", 50, "-o", "few.npy")
    run("alpha", "few.npy", "--dim", 3, "--alpha", 0, "-o", "points-3.png")
    run("alpha", "track.npy", "--alpha", 0, "-o", "points-2.png")
    for name in ["points-2.png", "points-3.png"]:
        with Image.open(folder / name) as picture:
            assert (np.asarray(picture.convert("L"))[:-80] < 128).sum() > 500, f"{name} is blank"


def a_narrow_bay():
    """A bay of the hull so narrow that no number is in it."""
    ring = [[0.1, 0.01], [0.2, 0.02], [0.3, 0.03], [1.2, -0.98], [0.1, 0.01]]
    narrow = shapely.Polygon(ring)
    (folder / "narrow.wkt").write_text(narrow.wkt)
    run("mesh", "narrow.wkt", "-o", "narrow.geojson")
    assert abs(geopandas.read_file(folder / "narrow.geojson").area.sum() - narrow.area) < 1e-12, "a mesh of another area"


def cells_in_pieces():
    """Cells whole, in pieces and gone, in every format of geometries: those of GeoJSON, bit for bit."""
    low, high = flat.min(0), flat.max(0)
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
        assert [str(sites).split() for sites in table[key]] == [
            str(sites).strip("[]").replace(",", " ").split() for sites in about[key]
        ]
        lines = shapely.from_wkt((folder / "cells.wkt").read_text().splitlines())
        whole = shapely.from_wkt((folder / "cells-whole.wkt").read_text()).geoms
        binary = shapely.from_wkb((folder / "cells.wkb").read_bytes()).geoms
        column = shapely.from_wkt(pandas.read_csv(folder / "cells.csv").wkt)
        for name, read in [
            ("csv", table.geometry),
            ("csv by pandas", column),
            ("wkt", lines),
            ("collection", whole),
            ("wkb", binary),
        ]:
            assert np.array_equal(shapely.to_wkb(list(read)), shapely.to_wkb(shapes)), f"cells in {name}"


def lines_of_all_versions():
    """Lines of text and binary files of VTK, of both versions, and tetrahedra of its legacy files."""
    cells = {pyvista.CellType.LINE: ends, pyvista.CellType.TRIANGLE: np.array([[0, 1, 4], [1, 2, 5]])}
    drawn = pyvista.PolyData(corners, lines=np.hstack([[len(chain), *chain] for chain in (ring, path)]))
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


def rasters_of_all_kinds():
    """Rasters in tiles and strips, with what GeoTIFF can say of their numbers."""
    cells = np.round(400 + 50 * np.sin(np.arange(90)[:, None] / 9) * np.cos(np.arange(130) / 7))
    place = rasterio.transform.from_origin(637_000, 849_700, 2, 2)
    kinds = [
        ("int16", "lzw", 1, True),
        ("uint16", "deflate", 2, True),
        ("float32", "deflate", 3, False),
        ("float64", "none", 1, False),
    ]
    kinds += [("int32", "packbits", 1, True), ("uint8", "deflate", 2, False), ("float32", "lzw", 3, True)]
    for kind, compress, predictor, tiled in kinds:
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


JUDGES = [
    single_precision,
    no_triangle_turns_over,
    shapes_without_area,
    a_narrow_bay,
    cells_in_pieces,
    lines_of_all_versions,
    rasters_of_all_kinds,
]
