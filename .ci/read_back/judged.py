"""Every format that delone reads, with every content that it takes, written by a program that others wrote.

A judge is a function of the file's ending, named for its contents, that raises where delone sees something else.
"""

import ezdxf
import geopandas
import laspy
import meshio
import numpy as np
import pandas
import pyvista
import rasterio
import rasterio.shutil
import shapely
from world import (
    FOLDER,
    area_of_squares,
    ball,
    flat,
    path,
    places,
    points,
    ring,
    run,
    segments,
    squares,
    tetrahedra,
    triangles,
)
from written import by_meshio, geometries

try:
    import pye57
except ImportError:
    pye57 = None
try:
    import pypcd4
except ImportError:
    pypcd4 = None

UTM = "EPSG:25832"

# Kinds of elements of SU2.
KINDS_OF_SU2 = {"line": 3, "triangle": 5, "quad": 9, "tetra": 10}


def write_elements(file, corners, kind, cells, markers=None):
    """Writes Medit's format by meshio, and SU2's as its manual says, which meshio 5.3.5 does not. Lines are grouped by marker."""
    if file.suffix == ".mesh":
        data = {"medit:ref": [np.zeros(len(cells), int) if markers is None else np.array(markers)]}
        meshio.write(file, meshio.Mesh(corners, [(kind, cells)], cell_data=data), file_format="medit")
        return
    own = KINDS_OF_SU2[kind]
    rows = [f"{own} {' '.join(map(str, row))}\n" for row in np.asarray(cells).tolist()]
    text = f"NDIME= {corners.shape[1]}\nNELEM= {0 if markers else len(rows)}\n{'' if markers else ''.join(rows)}"
    text += f"NPOIN= {len(corners)}\n" + "".join(" ".join(map(repr, row)) + "\n" for row in corners.tolist())
    for number in sorted(set(markers or [])):
        group = [row for row, marker in zip(rows, markers, strict=True) if marker == number]
        text += f"MARKER_TAG= {number}\nMARKER_ELEMS= {len(group)}\n{''.join(group)}"
    file.write_text(text)


def frame(shapes, kind, **columns):
    """Features in a file that GDAL writes."""
    made = geopandas.GeoDataFrame(columns, geometry=list(shapes), crs=UTM)
    drivers = {"geojsonl": "GeoJSONSeq", "gpx": "GPX", "dxf": "DXF"}
    # An index would put the features of FlatGeobuf into another order.
    options = {"SPATIAL_INDEX": "NO"} if kind == "fgb" else {}
    made = made.to_crs(4326) if kind in ("geojsonl", "gpx") else made
    made.to_file(FOLDER / f"other.{kind}", driver=drivers.get(kind), **options)
    return made


def write_points(kind):
    """Writes the points, and gives how far coordinates may be off: a step of the file's numbers."""
    file = FOLDER / f"other.{kind}"
    if kind == "csv":
        names = {"id": np.arange(len(points)), "X_COORD": points[:, 0], "Y_COORD": points[:, 1], "Z_VAL": points[:, 2]}
        pandas.DataFrame(names).to_csv(file, index=False, quoting=2)
    elif kind == "pts":
        np.savetxt(file, points, header=str(len(points)), comments="")
    elif kind == "npy":
        np.save(file, np.asfortranarray(points))
    elif kind == "npz":
        np.savez_compressed(file, ids=np.arange(5), points=points)
    elif kind == "bin":
        # Nothing in the file tells how many numbers a point has.
        flat.tofile(file)
    elif kind == "node":
        meshio.write(file, meshio.Mesh(points, [("tetra", np.arange(4)[None])]), file_format="tetgen")
    elif kind == "poly":
        rows = "".join(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(flat.tolist()))
        file.write_text(f"{len(flat)} 2 0 0\n{rows}0 0\n0\n")
    elif kind == "las":
        tile().write(file)
    elif kind == "ept":
        return write_ept()
    elif kind == "e57":
        file.unlink(missing_ok=True)
        scan = pye57.E57(str(file), mode="w")
        columns = {f"cartesian{axis}": points[:, k].copy() for k, axis in enumerate("XYZ")}
        scan.write_scan_raw(columns, rotation=np.array([1.0, 0, 0, 0]), translation=np.zeros(3))
        scan.close()
    elif kind == "ptx":
        # Columns, rows, the place and the axes of the scanner, a matrix, and rows of places with an intensity.
        head = "500\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        file.write_text(head + "".join(f"{x!r} {y!r} {z!r} 0.5\n" for x, y, z in points.tolist()))
    elif kind == "lammpstrj":
        bounds = "".join(f"{low!r} {high!r}\n" for low, high in zip(points.min(0).tolist(), points.max(0).tolist(), strict=True))
        head = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(points)}\nITEM: BOX BOUNDS pp pp pp\n{bounds}"
        head += "ITEM: ATOMS id type x y z\n"
        file.write_text(head + "".join(f"{i} 1 {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points.tolist(), 1)))
    elif kind == "extxyz":
        head = f'{len(points)}\nLattice="900 0 0 0 700 0 0 0 120" Properties=species:S:1:pos:R:3 pbc="T T T"\n'
        file.write_text(head + "".join(f"Si {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()))
    elif kind == "ply":
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]))
    elif kind == "obj":
        file.write_text("# by hand\n" + "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()))
    elif kind in ("off", "vtu"):
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]))
    elif kind == "msh":
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]), file_format="gmsh", binary=False)
    elif kind in ("mesh", "su2"):
        write_elements(file, points, "triangle", triangles)
    elif kind == "stl":
        pyvista.PolyData.from_regular_faces(points, triangles).save(file)
        return 0.05
    elif kind in ("vtp", "vtk"):
        pyvista.PolyData(points).save(file, binary=kind == "vtp")
    elif kind == "pcd":
        columns = [points[:, k] for k in range(3)]
        pypcd4.PointCloud.from_points(columns, ("x", "y", "z"), (np.float64,) * 3).save(file)
    elif kind == "geojson":
        frame(shapely.points(points), kind)
    elif kind in ("geojsonl", "gpx"):
        frame(shapely.points(points), kind)
        return None
    elif kind in ("fgb", "gpkg", "shp"):
        frame(shapely.points(points), kind)
    elif kind == "dxf":
        drawing = ezdxf.new("R2010")
        for place in points.tolist():
            drawing.modelspace().add_point(place)
        drawing.saveas(file)
    elif kind == "wkt":
        file.write_text(shapely.to_wkt(shapely.MultiPoint(points), rounding_precision=-1))
    elif kind == "wkb":
        shape = shapely.set_srid(shapely.MultiPoint(points), 25832)
        file.write_bytes(shapely.to_wkb(shape, include_srid=True, byte_order=0))
    else:
        raise NotImplementedError(kind)
    return 1e-8


def tile():
    """The points as laspy has them, in millimetres."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.offsets, header.scales = points.min(0), [0.001] * 3
    las = laspy.LasData(header)
    las.xyz = points
    return las


def write_ept():
    """A folder of one tile, as Entwine makes them: its number of points by key, and the tile itself."""
    folder = FOLDER / "other-ept"
    (folder / "ept-hierarchy").mkdir(parents=True, exist_ok=True)
    (folder / "ept-data").mkdir(exist_ok=True)
    tile().write(folder / "ept-data/0-0-0-0.laz")
    (folder / "ept-hierarchy/0-0-0-0.json").write_text(f'{{"0-0-0-0": {len(points)}}}')
    low, side = points.min(0), np.ptp(points, axis=0).max() + 1
    bounds = ", ".join(map(repr, [*low.tolist(), *(low + side).tolist()]))
    schema = ", ".join(
        f'{{"name": "{axis}", "type": "signed", "size": 4, "scale": 0.001, "offset": {x!r}}}'
        for axis, x in zip("XYZ", low.tolist(), strict=True)
    )
    (folder / "ept.json").write_text(
        f'{{"bounds": [{bounds}], "boundsConforming": [{bounds}], "dataType": "laszip", "hierarchyType": "json", '
        f'"points": {len(points)}, "schema": [{schema}], "span": 128, "srs": {{}}, "version": "1.0.0"}}'
    )
    return 1e-8


def points_of(kind):
    """Points come out as they went in, in their order."""
    if kind in ("tif", "asc"):
        rasters_of(kind)
        return
    step = write_points(kind)
    name = "other-ept/ept.json" if kind == "ept" else f"other.{kind}"
    run("triangulate", name, "-o", "again.ply")
    read = by_meshio("again.ply").points
    assert len(read) == len(points), f"{read.shape}"
    if kind in ("bin", "poly"):
        assert np.array_equal(read[:, :2], flat) and not read[:, 2:].any()
        return
    if kind == "e57":
        scan = pye57.E57(str(FOLDER / "other.e57")).read_scan_raw(0)
        assert np.array_equal(read, np.transpose([scan[f"cartesian{axis}"] for axis in "XYZ"])), "not what pye57 reads"
        return
    if step is None:
        # Degrees, which GDAL reads too.
        geometry = geopandas.read_file(FOLDER / f"other.{kind}", **({"layer": "waypoints"} if kind == "gpx" else {})).geometry
        places, step = shapely.get_coordinates(geometry), 1e-12
        assert np.abs(read[:, :2] - places).max() <= step
        assert kind == "gpx" or np.array_equal(read[:, 2], points[:, 2]), "other heights"
    elif kind == "stl":
        # Points of a soup, each once, in the order of its triangles.
        assert np.abs(np.sort(read, axis=0) - np.sort(points, axis=0)).max() <= step
    else:
        assert np.abs(read - points).max() <= step, f"{np.abs(read - points).max()}"


def pieces_of(kind):
    """Points that are read piece by piece go into a folder of tiles, and come out of it again."""
    step = write_points(kind)
    name = "other-ept/ept.json" if kind == "ept" else f"other.{kind}"
    tiles = FOLDER / f"tiles-{kind}"
    if not tiles.exists():
        run("tiles", name, "-o", tiles.name, "--tile", 200)
    run("check", tiles.name)
    run("window", tiles.name, "-o", "again.ply")
    read = by_meshio("again.ply").points
    order = [np.lexsort(places.T[:2]) for places in (read, points)]
    assert read.shape[0] == len(points) and np.abs(read[order[0], :2] - points[order[1], :2]).max() <= step


def chains():
    """The ring and the path as lines, with their corners in space."""
    return [shapely.LineString(places[chain]) for chain in (ring, path)]


def by_place(rows, corners):
    """Segments by the places of their ends."""
    return {frozenset(map(tuple, np.round(corners[list(row)][:, :2], 9).tolist())) for row in rows}


def lines_of(kind):
    """Lines are segments, wherever they come from: those of a .poly file, by the places of their ends."""
    file, transformed = FOLDER / f"lines.{kind}", places
    if kind == "csv":
        pandas.DataFrame({"name": ["ring", "path"], "wkt": [line.wkt for line in chains()]}).to_csv(file, index=False)
    elif kind == "poly":
        rows = "".join(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(places[:, :2].tolist(), 1))
        sides = "".join(f"{i} {a + 1} {b + 1}\n" for i, (a, b) in enumerate(segments.tolist(), 1))
        file.write_text(f"{len(places)} 2 0 0\n{rows}{len(segments)} 0\n{sides}0\n")
    elif kind == "obj":
        rows = "".join(f"v {x} {y} {z}\n" for x, y, z in places.tolist())
        file.write_text(rows + "".join("l " + " ".join(str(i + 1) for i in chain) + "\n" for chain in (ring, path)))
    elif kind in ("vtp", "vtk"):
        drawn = pyvista.PolyData(places, lines=np.hstack([[len(chain), *chain] for chain in (ring, path)]))
        drawn.field_data["who"], drawn.field_data["time"] = ["somebody", "x" * 70], np.array([1.5])
        drawn.save(file, binary=kind == "vtp")
    elif kind == "vtu":
        cells = {pyvista.CellType.LINE: segments, pyvista.CellType.TRIANGLE: np.array([[0, 1, 4], [1, 2, 5]])}
        pyvista.UnstructuredGrid(cells, places).save(file)
    elif kind == "msh":
        groups = {f"gmsh:{what}": [np.arange(len(segments)) // 4 + 1] for what in ("physical", "geometrical")}
        mesh = meshio.Mesh(places, [("line", segments)], cell_data=groups)
        meshio.write(file, mesh, file_format="gmsh22", binary=False)
    elif kind in ("mesh", "su2"):
        write_elements(file, places, "line", segments, [1] * 4 + [2] * 2)
    elif kind == "dxf":
        drawing = ezdxf.new("R2010")
        for chain in (ring, path):
            drawing.modelspace().add_lwpolyline(places[chain][:, :2].tolist())
        drawing.saveas(file)
    elif kind == "wkt":
        file.write_text("\n".join(line.wkt for line in chains()))
    elif kind == "wkb":
        file.write_bytes(shapely.to_wkb(shapely.MultiLineString(chains())))
    else:
        lines = frame(chains(), kind, name=["ring", "path"])
        (FOLDER / f"other.{kind}").rename(file)
        for side in ("shx", "dbf", "prj", "cpg"):
            if kind == "shp":
                (FOLDER / f"other.{side}").rename(FOLDER / f"lines.{side}")
        # Degrees are written with seven digits, or nine.
        lines = geopandas.read_file(file) if kind == "geojsonl" else lines
        corners = shapely.get_coordinates(lines.geometry)
        transformed = np.concatenate([corners[:4], corners[5:]])
    run("triangulate", file.name, "-o", "again.poly")
    text = [line.split() for line in (FOLDER / "again.poly").read_text().splitlines()]
    count = int(text[0][0])
    corners = np.array([row[1:3] for row in text[1 : count + 1]], float)
    first = int(text[1][0])
    rows = [tuple(int(end) - first for end in row[1:3]) for row in text[count + 2 :] if len(row) >= 3]
    digits = 6 if kind == "gpx" else 9
    assert by_place(rows, np.round(corners, digits)) == by_place(segments, np.round(transformed, digits)), "other segments"
    if kind in ("msh", "mesh", "su2"):
        # Physical groups are markers, in whatever order segments are.
        assert sorted(row[3] for row in text[count + 2 :] if len(row) >= 4) == ["1"] * 4 + ["2"] * 2, "other markers"


def segments_of(kind):
    """Segments between the points of another file: the sides of the hull, and two more, which become edges."""
    np.save(FOLDER / "places.npy", places[:, :2])
    file = FOLDER / f"sides.{kind}"
    if kind == "csv":
        pandas.DataFrame(segments).to_csv(file, index=False, header=False)
    elif kind == "npy":
        np.save(file, segments)
    elif kind == "edge":
        file.write_text(f"{len(segments)} 0\n" + "".join(f"{i} {a} {b}\n" for i, (a, b) in enumerate(segments.tolist())))
    else:
        rows = "".join(f"{i} {a} {b}\n" for i, (a, b) in enumerate(segments.tolist()))
        file.write_text(f"0 2 0 0\n{len(segments)} 0\n{rows}0\n")
    run("triangulate", "places.npy", "--segments", file.name, "-o", "again.poly")
    text = [line.split() for line in (FOLDER / "again.poly").read_text().splitlines()]
    rows = {frozenset(map(int, row[1:3])) for row in text[len(places) + 2 :] if len(row) >= 3}
    assert rows == {frozenset(side) for side in segments.tolist()}, f"{rows}"


def polygons_of(kind):
    """A polygon with a hole, one of two parts, one alone: their triangles have the area that shapely sees."""
    if kind == "csv":
        pandas.DataFrame({"name": list("abc"), "wkt": [shape.wkt for shape in squares]}).to_csv(FOLDER / "other.csv", index=False)
    elif kind == "poly":
        # Osmosis: a name, rings with names, a hole by an exclamation mark.
        rings = [(polygon.exterior, "") for shape in squares for polygon in getattr(shape, "geoms", [shape])]
        rings += [(hole, "!") for hole in squares[0].interiors]
        parts = [
            "\n".join([f"{mark}{n}", *(f"   {x!r}   {y!r}" for x, y in part.coords), "END"])
            for n, (part, mark) in enumerate(rings, 1)
        ]
        (FOLDER / "other.poly").write_text("\n".join(["squares", *parts, "END", ""]))
    elif kind == "dxf":
        drawing = ezdxf.new("R2010")
        for shape in squares:
            for polygon in getattr(shape, "geoms", [shape]):
                for part in (polygon.exterior, *polygon.interiors):
                    drawing.modelspace().add_lwpolyline([*part.coords][:-1], close=True)
        drawing.saveas(FOLDER / "other.dxf")
    elif kind == "wkt":
        (FOLDER / "other.wkt").write_text("\n".join(shape.wkt for shape in squares))
    elif kind == "wkb":
        (FOLDER / "other.wkb").write_bytes(shapely.to_wkb(shapely.GeometryCollection(squares)))
    else:
        frame(squares, kind, name=list("abc"))
    run("polygons", f"other.{kind}", "-o", "again.wkt")
    area = area_of_squares
    if kind == "geojsonl":
        area = geopandas.read_file(FOLDER / "other.geojsonl").area.sum()
    elif kind == "dxf":
        # A drawing has rings alone: the hole is a polygon of its own.
        area += 2
    read = shapely.area(geometries("again.wkt")).sum()
    assert abs(read / area - 1) < 1e-9, f"area {read} of {area}"


def numbers_of(kind):
    """A value at each point, the first coordinate, is interpolated exactly."""
    values = flat[:, 0]
    if kind == "npy":
        np.save(FOLDER / "numbers.npy", values)
    else:
        pandas.DataFrame({"value": values}).to_csv(FOLDER / "numbers.csv", index=False)
    queries = flat.mean(axis=0) + np.array([[0, 0], [9.5, -20]])
    np.save(FOLDER / "queries.npy", queries)
    run("interpolate", "flat.npy", "--value", f"numbers.{kind}", "--queries", "queries.npy", "-o", "values.npy")
    assert np.abs(np.load(FOLDER / "values.npy") - queries[:, 0]).max() < 1e-8


def triangles_of(kind):
    """Triangles that others wrote are judged, with points of their own where the file has them."""
    file = FOLDER / f"mesh.{kind}"
    if kind == "npy":
        np.save(file, triangles)
    elif kind == "ele":
        rows = "".join(f"{i} {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(triangles.tolist(), 1))
        file.write_text(f"{len(triangles)} 3 0\n{rows}")
    elif kind in ("ply", "off", "vtu"):
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]))
    elif kind == "obj":
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]), file_format="obj")
    elif kind == "msh":
        meshio.write(file, meshio.Mesh(points, [("triangle", triangles)]), file_format="gmsh", binary=False)
    elif kind in ("mesh", "su2"):
        write_elements(file, flat, "triangle", triangles)
    else:
        pyvista.PolyData.from_regular_faces(points, triangles).save(file)
    run("check", "flat.npy", file.name)
    if kind in ("msh", "mesh", "su2", "vtu"):
        # Two triangles that make a convex quadrilateral are one cell. They are Delaunay, so it has the diagonal again.
        file = FOLDER / f"quads.{kind}"
        pairs, left = quads_of_triangles()
        if kind == "su2":
            write_elements(file, flat, "quad", pairs)
            more = [f"5 {' '.join(map(str, row))}" for row in left.tolist()]
            head, points_of_file = file.read_text().split("NPOIN=")
            head = head.replace(f"NELEM= {len(pairs)}", f"NELEM= {len(pairs) + len(left)}") + "\n".join(more)
            file.write_text(f"{head}\nNPOIN={points_of_file}")
        else:
            data = {"medit:ref": [np.zeros(len(pairs), int), np.zeros(len(left), int)]} if kind == "mesh" else None
            form = {"msh": {"file_format": "gmsh22", "binary": False}, "mesh": {"file_format": "medit"}, "vtu": {}}[kind]
            meshio.write(file, meshio.Mesh(points, [("quad", pairs), ("triangle", left)], cell_data=data), **form)
        run("check", "flat.npy", file.name)


def quads_of_triangles():
    """Neighbors in pairs wherever they make a convex quadrilateral, and the triangles that are left."""
    beside, free, pairs = {}, set(range(len(triangles))), []
    for i, row in enumerate(triangles.tolist()):
        for k in range(3):
            beside[row[k], row[(k + 1) % 3]] = (i, row[(k + 2) % 3])
    for (a, b), (i, c) in beside.items():
        if (b, a) not in beside:
            continue
        j, d = beside[b, a]
        corners = [a, d, b, c]
        p = flat[corners]
        u, v = np.roll(p, -1, axis=0) - p, np.roll(p, 1, axis=0) - p
        if i in free and j in free and (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 1e-9).all():
            free -= {i, j}
            pairs.append(corners)
    return np.array(pairs), triangles[sorted(free)]


def areas_of(kind):
    """The largest areas of triangles: the one that has a limit is made smaller."""
    (FOLDER / "one.node").write_text("4 2 0 0\n1 0 0\n2 4 0\n3 4 3\n4 0 3\n")
    (FOLDER / "one.ele").write_text("2 3 0\n1 1 2 3\n2 1 3 4\n")
    (FOLDER / f"one.{kind}").write_text("2\n1 0.5\n2 -1\n")
    run("mesh", "one.node", "--refine", "one.ele", "--areas", f"one.{kind}", "-o", "fine.wkt")
    pieces = geometries("fine.wkt")
    limited = shapely.intersects(shapely.centroid(pieces), shapely.Polygon([(0, 0), (4, 0), (4, 3)]))
    assert abs(shapely.area(pieces).sum() - 12) < 1e-12 and shapely.area(pieces[limited]).max() <= 0.5 < 6


def tetrahedra_of(kind):
    """Tetrahedra that others wrote are judged."""
    cells = meshio.Mesh(ball, [("tetra", tetrahedra)])
    file = FOLDER / f"cells.{kind}"
    if kind == "npy":
        np.save(file, tetrahedra)
    elif kind == "ele":
        meshio.write(FOLDER / "cells.node", cells, file_format="tetgen")
    elif kind == "msh":
        meshio.write(file, cells, file_format="gmsh", binary=False)
    elif kind in ("mesh", "su2"):
        write_elements(file, ball, "tetra", tetrahedra)
    else:
        pyvista.UnstructuredGrid({pyvista.CellType.TETRA: tetrahedra}, ball).save(file)
    run("check", "ball.npy", file.name, "--dim", 3)


def rasters_of(kind):
    """A raster by GDAL: all its values, in their places, without those that are no data, and its system."""
    cells = np.round(400 + 50 * np.sin(np.arange(90)[:, None] / 9) * np.cos(np.arange(130) / 7))
    cells[3, 5] = -9999
    if kind == "npy":
        np.save(FOLDER / "grid.npy", np.where(cells == -9999, np.nan, cells))
        run("contours", "grid.npy", "--interval", 10, "-o", "again.geojson")
        read = geopandas.read_file(FOLDER / "again.geojson")
        assert len(read) > 10 and (read.elevation % 10 == 0).all()
        return
    for side in FOLDER.glob("grid.*"):
        side.unlink()
    place = rasterio.transform.from_origin(637_000, 849_700, 2, 2)
    profile = dict(width=130, height=90, count=1, crs=UTM, transform=place, nodata=-9999)
    with rasterio.open(FOLDER / "grid.tif", "w", driver="GTiff", dtype="float64", **profile) as raster:
        raster.write(cells, 1)
    if kind == "asc":
        rasterio.shutil.copy(FOLDER / "grid.tif", FOLDER / "grid.asc", driver="AAIGrid")
    run("triangulate", f"grid.{kind}", "-o", "again.obj", "-o", "again.gpkg")
    read = np.array([line.split()[1:] for line in (FOLDER / "again.obj").read_text().splitlines() if line[0] == "v"], float)
    assert len(read) == cells.size - 1 and (read[0] == [637_001, 849_699, cells[0, 0]]).all()
    assert np.array_equal(read[:, 2], cells.ravel()[np.arange(cells.size) != 3 * 130 + 5])
    assert geopandas.read_file(FOLDER / "again.gpkg").crs.to_epsg() == 25832, "another system"


JUDGES = {
    "points": points_of,
    "points in pieces": pieces_of,
    "lines and polygons": lines_of,
    "segments": segments_of,
    "polygons": polygons_of,
    "numbers": numbers_of,
    "triangles": triangles_of,
    "areas of triangles": areas_of,
    "tetrahedra": tetrahedra_of,
    "rasters": rasters_of,
}

# Judges that cannot be asked where a package is missing: the row is told as passed over.
NEEDS = {("points", "e57"): pye57, ("points", "pcd"): pypcd4}
