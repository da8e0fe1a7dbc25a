"""Terrain models beside SciPy, rasterio and shapely, and beside the bytes of the program."""

import hashlib
import os
import subprocess
import warnings
from pathlib import Path

import delone
import numpy as np
import pytest
import scipy.interpolate

RIDGE = {"type": "LineString", "coordinates": [[10, 10, 50], [90, 60, 55]]}
LAKE = {"type": "Polygon", "coordinates": [[[20, 70], [50, 72], [40, 95], [20, 70]]]}
AREA = {"type": "Polygon", "coordinates": [[[5, 5], [95, 10], [80, 92], [5, 5]]]}


def survey(count=2000, seed=3):
    """Points with heights, all numbers short as text."""
    x, y = np.random.default_rng(seed).integers(0, 100_000, (2, count)) / 1000
    return np.column_stack([x, y, np.round(10 + 5 * np.sin(x / 9) + y / 10, 3)])


def write_text(path, points):
    np.savetxt(path, points, delimiter=",", header="x,y,z", comments="", fmt="%.3f")


def same(a, b):
    return np.array_equal(a, b, equal_nan=True)


def centers(transform, shape):
    a, _, c, _, e, f = transform
    return np.meshgrid(c + a * (np.arange(shape[1]) + 0.5), f + e * (np.arange(shape[0]) + 0.5))


def test_heights_are_those_of_scipy():
    points = survey()
    heights, transform = delone.dtm(points, cell=2.0)
    assert transform == (2.0, 0.0, 0.0, 0.0, -2.0, 100.0) and heights.shape == (50, 50)
    tri = delone.Delaunay(points[:, :2])
    linear = scipy.interpolate.LinearNDInterpolator(points[:, :2], points[:, 2])(*centers(transform, heights.shape))
    # SciPy may cut cocircular points along the other diagonal; where both have heights they are near.
    assert np.nanmax(np.abs(heights - linear)) < 1.0 and np.nanmedian(np.abs(heights - linear)) < 1e-12
    again, where = delone.rasterize(tri, points[:, 2], cell=2.0)
    assert where == transform and same(again, heights)
    assert same(delone.dtm(points[:, :2], points[:, 2], cell=2.0)[0], heights)
    for ours, theirs in (("natural", "sibson"), ("laplace", "laplace"), ("nearest", "nearest")):
        expected, _ = delone.rasterize(tri, points[:, 2], cell=2.0, method=theirs)
        assert same(delone.dtm(points, cell=2.0, method=ours)[0], expected), ours
    smooth, _ = delone.dtm(points, cell=2.0, method="smooth")
    f = delone.NaturalNeighborInterpolator(tri, points[:, 2], "smooth")
    inside = ~np.isnan(smooth)
    assert np.allclose(smooth[inside], f(np.column_stack([q[inside] for q in centers(transform, smooth.shape)])))


def test_shapes_may_be_files_mappings_arrays_or_geometries(tmp_path):
    shapely = pytest.importorskip("shapely")
    geopandas = pytest.importorskip("geopandas")
    points = survey()
    wanted = {}
    for name, shape in (("breaklines", RIDGE), ("flat", LAKE), ("clip", AREA)):
        path = tmp_path / f"{name}.geojson"
        path.write_text(str(shape).replace("'", '"'))
        geometry = shapely.geometry.shape(shape)
        array = np.array(shape["coordinates"] if name == "breaklines" else shape["coordinates"][0], dtype=float)
        of_file, transform = delone.dtm(points, cell=1.0, **{name: path})
        assert not same(of_file, delone.dtm(points, cell=1.0)[0])
        ways = [shape, str(path), [path], array, array.tolist(), [array], geometry, [geometry], geopandas.GeoSeries([geometry])]
        ways.append(geopandas.GeoDataFrame({"name": ["a"]}, geometry=[geometry]))
        for way in ways:
            assert same(delone.dtm(points, cell=1.0, **{name: way})[0], of_file), (name, type(way))
        wanted[name] = (of_file, transform)
    clipped, transform = wanted["clip"]
    x, y = centers(transform, clipped.shape)
    area = shapely.geometry.shape(AREA)
    away = shapely.distance(shapely.points(x, y), area.boundary) > 1e-9
    assert (np.isnan(clipped) == ~shapely.contains_xy(area, x, y))[away].all() and away.sum() > 9900
    lake = shapely.contains_xy(shapely.geometry.shape(LAKE), *centers(*[wanted["flat"][1], clipped.shape]))
    assert len(np.unique(wanted["flat"][0][lake])) == 1 and lake.sum() > 100


def test_files_are_those_that_rasterio_reads(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    points = survey()
    heights, transform = delone.dtm(points, cell=1.0, clip=AREA)
    names = [tmp_path / name for name in ("a.tif", "a.png", "a.geojson", "a.npy")]
    assert delone.dtm(points, cell=1.0, clip=AREA, epsg=25832, nodata=-9999, compress="lzw", output=names) is None
    assert all(name.exists() for name in names)
    with rasterio.open(names[0]) as raster:
        assert raster.crs.to_epsg() == 25832 and raster.transform[:6] == transform and raster.nodata == -9999
        assert raster.compression.value == "LZW"
        found = raster.read(1)
    assert same(np.where(found == -9999, np.nan, found), heights.astype(np.float32))
    assert same(np.load(names[3]), heights)
    again, where = delone.dtm(points, like=names[0], clip=AREA)
    assert where == transform and same(again, heights)
    part, where = delone.dtm(points, cell=1.0, extent=(20, 30, 40, 50))
    assert where == (1.0, 0.0, 20.0, 0.0, -1.0, 50.0) and part.shape == (20, 20)
    moved, where = delone.dtm(points, cell=1.0, extent=(20, 30, 40, 50), origin=(0.5, 0.25))
    assert where == (1.0, 0.0, 19.5, 0.0, -1.0, 50.25) and moved.shape == (21, 21)


def test_bytes_do_not_depend_on_the_machine(tmp_path):
    """The sum of what `delone dtm` writes of the same points."""
    write_text(tmp_path / "p.csv", survey())
    delone.dtm(tmp_path / "p.csv", cell=0.5, method="natural", output=tmp_path / "a.npy")
    sum_ = hashlib.sha256((tmp_path / "a.npy").read_bytes()).hexdigest()
    assert sum_ == "176d4c68a6f0d470bab372ef204b387c2f59033ae6988abead72584f542368e5"


@pytest.mark.skipif("DELONE" not in os.environ, reason="the program is named by DELONE")
@pytest.mark.parametrize("method", ["linear", "natural", "laplace", "nearest", "smooth", "farin"])
def test_bytes_are_those_of_the_program(tmp_path, method):
    write_text(tmp_path / "p.csv", survey())
    for name, shape in (("ridge", RIDGE), ("lake", LAKE), ("area", AREA)):
        (tmp_path / f"{name}.geojson").write_text(str(shape).replace("'", '"'))
    line = f"""-q dtm p.csv --cell 1 --method {method} --breaklines ridge.geojson --flat lake.geojson --clip area.geojson
        --duplicates mean --max-edge 20 --nodata -7 --interval 2 --epsg 25832 -o a.tif -o a.asc -o a.png -o a.geojson"""
    subprocess.run([os.environ["DELONE"], *line.split()], cwd=tmp_path, check=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        delone.dtm(
            tmp_path / "p.csv",
            cell=1.0,
            method=method,
            breaklines=RIDGE,
            flat=tmp_path / "lake.geojson",
            clip=np.array(AREA["coordinates"][0]),
            duplicates="mean",
            max_edge=20,
            nodata=-7,
            interval=2,
            epsg=25832,
            output=[tmp_path / name for name in ("b.tif", "b.asc", "b.png", "b.geojson")],
        )
    for extension in ("tif", "asc", "png", "geojson"):
        assert (tmp_path / f"a.{extension}").read_bytes() == (tmp_path / f"b.{extension}").read_bytes(), extension


def test_ground_of_lidar():
    tile = Path(__file__).parents[3] / "data" / "autzen_trim.laz"
    laspy = pytest.importorskip("laspy")
    las = laspy.read(tile)
    ground = las.xyz[las.classification == 2]
    heights, transform = delone.dtm(tile, cell=10)
    assert same(heights, delone.dtm(ground, cell=10)[0])
    part = (transform[2], transform[5] - 100, transform[2] + 100, transform[5])
    everything, _ = delone.dtm(tile, extent=part, cell=10, all_classes=True)
    assert everything.shape[0] == 10
    two, _ = delone.dtm([tile], cell=10, classes=[2])
    assert same(two, heights)


def test_remarks_are_warnings(tmp_path):
    points = survey()
    sloping = {"type": "Polygon", "coordinates": [[[20, 70, 1], [50, 72, 2], [40, 95, 3], [20, 70, 1]]]}
    with pytest.warns(UserWarning, match="polygon 0 is to be level and has heights from 1 to 3"):
        delone.dtm(points, cell=1.0, flat=sloping)
    cross = [[[10, 60, 0], [90, 10, 100]], [[10, 10, 0], [90, 60, 0]]]
    with pytest.warns(UserWarning, match="lines cross at heights that differ"):
        delone.dtm(points, cell=1.0, breaklines=[np.array(line, dtype=float) for line in cross])
    with pytest.warns(UserWarning, match="larger than the area"):
        delone.dtm(points, cell=1000.0)
    with pytest.warns(UserWarning, match=r"a\.asc: nothing in it says"):
        delone.dtm(points, cell=1.0, epsg=25832, output=tmp_path / "a.asc")


def test_refusals(tmp_path):
    points = survey(100)
    line = tmp_path / "line.geojson"
    line.write_text('{"type": "LineString", "coordinates": [[1, 2], [3, 4]]}')
    refusals = [
        (ValueError, "3 coordinates each, not 2", {"points": points[:, :2]}),
        (ValueError, "shape", {"points": points[:, :2], "z": points[:5, 2]}),
        (ValueError, "on one line", {"points": [[0, 0, 1], [1, 1, 2], [2, 2, 3]]}),
        (ValueError, "there are no points", {"points": np.empty((0, 3))}),
        (ValueError, "method must be one of", {"method": "cubic"}),
        (ValueError, "duplicates must be one of", {"duplicates": "last"}),
        (ValueError, "cell or like", {"cell": 1.0, "like": "a.tif"}),
        (ValueError, "must be positive", {"max_edge": -1}),
        (ValueError, "not both", {"max_edge": 1, "max_edge_anywhere": 1}),
        (ValueError, "size of a cell", {"cell": 0.0}),
        (ValueError, "at most 1.7", {"cell": 1e-6}),
        (ValueError, "extent must be", {"extent": (0, 0, 0, 1)}),
        (ValueError, r"line\.geojson: there is no polygon", {"flat": line}),
        (ValueError, r"line\.geojson: there is no polygon", {"clip": line}),
        (ValueError, "there is no line", {"breaklines": {"type": "Point", "coordinates": [1, 2]}}),
        (ValueError, "not finite|NaN|JSON", {"breaklines": [[0.0, float("nan")], [1.0, 2.0]]}),
        (TypeError, "paths or geometries", {"breaklines": 7}),
        (FileNotFoundError, r"nowhere\.csv: ", {"points": tmp_path / "nowhere.csv"}),
        (FileNotFoundError, r"nowhere\.tif: ", {"like": tmp_path / "nowhere.tif"}),
        (FileNotFoundError, "folder", {"output": tmp_path / "folder" / "a.tif"}),
        (ValueError, "no format has this extension", {"output": tmp_path / "a.unknown"}),
        (ValueError, r"a\.csv: ", {"output": tmp_path / "a.csv"}),
        (ValueError, "leave z out", {"points": "a.csv", "z": [1.0]}),
        (ValueError, "interval must be positive", {"interval": 0, "output": tmp_path / "a.geojson"}),
    ]
    for kind, words, wanted in refusals:
        with pytest.raises(kind, match=words):
            delone.dtm(**{"points": points, **wanted})
    assert list(tmp_path.iterdir()) == [line]


@pytest.mark.parametrize(
    ("wishes", "error", "words"),
    [
        ({"epsg": -1}, ValueError, "epsg must be an integer from 1"),
        ({"epsg": 2**40}, ValueError, "epsg must be an integer from 1"),
        ({"output": []}, ValueError, "output must be a path"),
        ({"output": ["a.tif", "./a.tif"]}, ValueError, "a.tif twice"),
        ({"nodata": 0.0}, ValueError, "give output too"),
        ({"interval": 5.0}, ValueError, "give output too"),
        ({"classes": [2]}, ValueError, "of files"),
        ({"columns": ["x", "y", "z"]}, ValueError, "of files"),
        ({"origin": (1.0,)}, ValueError, "origin must be x and y"),
        ({"extent": "0011"}, ValueError, "extent must be"),
        ({"clip": {"type": "Point", "coordinates": [1, 2]}}, ValueError, "clip must be polygons"),
        ({"flat": {"type": "LineString", "coordinates": [[1, 2], [3, 4]]}}, ValueError, "flat must be polygons"),
        ({"clip": {"type": "Polygon", "coordinates": []}}, ValueError, "clip must be polygons"),
        ({"breaklines": {"type": "LineString", "coordinates": [[1, np.nan], [3, 4]]}}, ValueError, "breaklines: .* neither NaN"),
    ],
)
def test_arguments_that_are_wrong_are_named(tmp_path, monkeypatch, wishes, error, words):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=words):
        delone.dtm(survey(50), cell=5.0, **wishes)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("wishes", "error", "words"),
    [
        ({"classes": [300]}, ValueError, "a class must be an integer from 0 to 255"),
        ({"classes": [2], "all_classes": True}, ValueError, "not both"),
        ({"memory": -1}, ValueError, "memory must be an integer from 1"),
        ({"memory": "9" * 400 + "T"}, ValueError, "memory must be a number of bytes"),
        ({"columns": "xyz"}, TypeError, "columns must be names"),
        ({"columns": [1, 2, 3]}, TypeError, "columns must be names"),
    ],
)
def test_arguments_of_files_that_are_wrong_are_named(tmp_path, wishes, error, words):
    write_text(tmp_path / "points.csv", survey(50))
    with pytest.raises(error, match=words):
        delone.dtm(tmp_path / "points.csv", cell=5.0, **wishes)
    wrong = {key: value for key, value in wishes.items() if key != "all_classes"}
    if len(wrong) == len(wishes):
        with pytest.raises(error, match=words):
            delone.tiles.build(tmp_path / "points.csv", tmp_path / "tiles", **wishes)
    assert [path.name for path in tmp_path.iterdir()] == ["points.csv"]


def test_paths_may_be_of_any_kind_of_list(tmp_path):
    write_text(tmp_path / "points.csv", survey(50))
    path = tmp_path / "points.csv"
    expected = delone.dtm(path, cell=5.0)[0]
    for paths in ({path}, (one for one in [path]), np.array([str(path)]), np.array([path], dtype=object)):
        assert same(delone.dtm(paths, cell=5.0)[0], expected)
    assert same(delone.dtm(path, cell=5.0, classes=np.array([2, 9]), columns=np.array(["x", "y", "z"]))[0], expected)


def test_systems_of_geometries_are_compared(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    area = geopandas.GeoDataFrame(geometry=[shapely.geometry.shape(AREA)], crs=25832)
    points = survey(200)
    clipped = delone.dtm(points, cell=5.0, epsg=25832, clip=area)[0]
    assert same(clipped, delone.dtm(points, cell=5.0, clip=AREA)[0])
    for wishes in ({"clip": area}, {"flat": area.geometry}, {"breaklines": area.boundary}):
        with pytest.raises(ValueError, match=r"EPSG:25832.* EPSG:2056"):
            delone.dtm(points, cell=5.0, epsg=2056, **wishes)
    # A ring of shapely is a polygon where polygons are wanted, and a line where lines are.
    ring = shapely.LinearRing(AREA["coordinates"][0])
    assert same(delone.dtm(points, cell=5.0, clip=ring)[0], clipped)
    line = delone.dtm(points, cell=5.0, breaklines=shapely.LineString(ring.coords))[0]
    assert same(delone.dtm(points, cell=5.0, breaklines=ring)[0], line)


def test_points_may_be_geometries_with_heights():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    points = survey(200)
    expected = delone.dtm(points, cell=5.0)[0]
    sites = geopandas.GeoSeries(shapely.points(points))
    for given in (sites, geopandas.GeoDataFrame(geometry=sites), shapely.MultiPoint(points)):
        assert same(delone.dtm(given, cell=5.0)[0], expected)
