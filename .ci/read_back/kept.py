"""What a file has beside its geometry goes through: attributes with their types, systems of coordinates, layers, blocks."""

import json

import ezdxf
import geopandas
import meshio
import numpy as np
import pandas
import pyogrio
import pyvista
import shapely
from world import FOLDER as folder
from world import expected, normal, points, run
from world import rings as of_three


def systems():
    """Systems of coordinates go from GeoJSON to GeoJSON and to well-known binary."""
    run("triangulate", "flat.npy", "-o", "flat.geojson")
    feature = json.loads((folder / "flat.geojson").read_text())
    feature["crs"] = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    (folder / "known.geojson").write_text(json.dumps(feature))
    run("triangulate", "known.geojson", "-o", "passed.geojson")
    assert geopandas.read_file(folder / "passed.geojson").crs.to_epsg() == 25832
    run("voronoi", "known.geojson", "-o", "passed.wkb", "-o", "passed-cells.geojson")
    assert shapely.get_srid(shapely.from_wkb((folder / "passed.wkb").read_bytes())) == 25832
    assert geopandas.read_file(folder / "passed-cells.geojson").crs.to_epsg() == 25832


def sites_and_cells():
    """Attributes of sites, with their types, are those of cells."""
    known = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*points.T), crs=25832)
    known.to_file(folder / "known.gpkg")
    run("dtm", "known.gpkg", "--cell", 5, "-o", "dem.tif")
    run("contours", "dem.tif", "--interval", 20, "--bands", "-o", "bands.geojson")
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
        middle = shapely.box(*np.add(mesh.total_bounds.reshape(2, 2).mean(axis=0), [[-9, -9], [9, 9]]).ravel())
        near = geopandas.read_file(folder / f"mesh.{kind}", bbox=middle.bounds)
        assert 0 < len(near) == mesh.intersects(middle).sum() < len(mesh), f"a part of {kind}"
        assert normal(*of_three(mesh.geometry)) == expected
        assert mesh.geometry.has_z.all() and mesh.crs is None
        run("contours", "dem.tif", "--interval", 20, "--bands", "-o", f"bands.{kind}")
        bands = geopandas.read_file(folder / f"bands.{kind}")
        assert bands.crs.to_epsg() == 25832 and set(bands.geom_type) == {"MultiPolygon"}
        assert np.array_equal(
            shapely.to_wkb(bands.geometry), shapely.to_wkb(geopandas.read_file(folder / "bands.geojson").geometry)
        )
    # Programs that change the layer keep its index true.
    more = bands.iloc[:1].translate(1e6)
    pyogrio.write_dataframe(more.to_frame("geometry"), folder / "bands.gpkg", layer="contours", append=True)
    added = geopandas.read_file(folder / "bands.gpkg", bbox=tuple(more.total_bounds))
    assert len(added) == 1 and pyogrio.read_info(folder / "bands.gpkg")["features"] == len(bands) + 1, "a feature more"
    print("GDAL adds a feature to a GeoPackage")


def lines():
    """Lines are a layer beside the triangles: edges that cover each line, with its attributes."""
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
            assert (
                abs(found.length.sum() - row.geometry.length) < 1e-9 and row.geometry.hausdorff_distance(found.union_all()) < 1e-9
            )
        assert (
            len(edges) == sum(edges.name.isin(ways.name))
            and len(geopandas.read_file(folder / "edges.gpkg", layer="triangles")) > 3
        )


def polygons():
    """Attributes of polygons, with their types, are those of their triangles."""
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


def drawings():
    """Drawings with blocks and layers, which are attributes."""
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


JUDGES = [systems, sites_and_cells, lines, polygons, drawings]
