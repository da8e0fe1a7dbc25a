"""Geometries as sites, regions and lines; tables of geopandas in and out."""

import warnings

import delone
import numpy as np
import pytest

shapely = pytest.importorskip("shapely")
geopandas = pytest.importorskip("geopandas")

import delone.geo  # noqa: E402

SITES = np.random.default_rng(53).random((40, 2))


def frame(**columns):
    points = geopandas.points_from_xy(*SITES.T)
    index = [f"row {k}" for k in range(len(SITES))]
    return geopandas.GeoDataFrame({"n": np.arange(len(SITES)), **columns}, geometry=points, crs=25832, index=index)


@pytest.mark.parametrize(
    "given",
    [
        lambda: frame(),
        lambda: frame().geometry,
        lambda: frame().geometry.values,
        lambda: np.asarray(frame().geometry),
        lambda: list(frame().geometry),
        lambda: shapely.MultiPoint(SITES),
        lambda: {"type": "MultiPoint", "coordinates": SITES.tolist()},
        lambda: frame().__geo_interface__,
        lambda: shapely.GeometryCollection(list(frame().geometry)).__geo_interface__,
        lambda: geopandas.GeoSeries(shapely.points(np.column_stack([SITES, SITES[:, :1]]))),
    ],
)
def test_points_are_taken_as_geometries(given):
    expected = delone.Delaunay(SITES)
    made = delone.Delaunay(given())
    assert (made.points == SITES).all() and (made.simplices == expected.simplices).all()
    assert (delone.Neighbors(given()).nearest(given()) == np.arange(len(SITES))).all()
    interpolator = delone.LinearInterpolator(SITES, SITES[:, 0])
    assert np.allclose(interpolator(given()), SITES[:, 0])
    assert len(delone.Voronoi(given()).cells()) == len(SITES)


def test_what_is_no_point_is_named():
    missing = frame().geometry.copy()
    missing.iloc[3] = None
    with pytest.raises(ValueError, match="geometry 3 is missing or empty"):
        delone.Delaunay(missing)
    with pytest.raises(TypeError, match="geometry 1 is a LineString"):
        delone.Delaunay([shapely.Point(0, 0), shapely.LineString([(0, 0), (1, 1)])])
    with pytest.raises(TypeError, match="must be points, not a Polygon"):
        delone.Delaunay(shapely.box(0, 0, 1, 1).__geo_interface__)
    with pytest.raises(ValueError, match="must have coordinates"):
        delone.Delaunay({"type": "MultiPoint", "coordinates": [[1]]})


REGION = shapely.Polygon([(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)], [[(0.4, 0.4), (0.6, 0.4), (0.6, 0.6), (0.4, 0.6)]])


@pytest.mark.parametrize(
    "region",
    [
        REGION,
        shapely.MultiPolygon([REGION, shapely.box(1, 1, 2, 2)]),
        REGION.__geo_interface__,
        {"type": "Feature", "properties": {}, "geometry": REGION.__geo_interface__},
        geopandas.GeoSeries([REGION, None]),
        geopandas.GeoDataFrame({"a": [1]}, geometry=[REGION]),
        (0.1, 0.2, 0.8, 0.9),
        [0, 0, 1, 1],
        np.array([0.0, 0.0, 1.0, 1.0]),
    ],
)
def test_regions_are_taken_as_geometries(region):
    if isinstance(region, (tuple, list, np.ndarray)):
        area = (region[2] - region[0]) * (region[3] - region[1])
    elif isinstance(region, dict):
        area = REGION.area
    else:
        area = geopandas.GeoSeries(region).area.sum() if isinstance(region, shapely.Geometry) else region.area.sum()
    cells = delone.geo.voronoi(frame(), region)
    assert cells.area.sum() == pytest.approx(area)
    assert cells[cells.geometry.notna()].is_valid.all()
    order = delone.OrderVoronoi(SITES, 1)
    assert order.areas(region).sum() == pytest.approx(area)


def test_boxes_are_least_and_largest():
    for box in [(1, 0, 0, 1), (0, 0, 0, 1), (0, 0, np.nan, 1)]:
        with pytest.raises(ValueError, match="a box is"):
            delone.Voronoi(SITES).cells(box)


def test_cells_keep_rows_columns_and_system():
    sites = frame(name=[f"town {k}" for k in range(len(SITES))])
    sites.iloc[5, sites.columns.get_loc("geometry")] = None
    sites.iloc[7, sites.columns.get_loc("geometry")] = sites.geometry.iloc[6]
    cells = delone.geo.voronoi(sites)
    assert isinstance(cells, geopandas.GeoDataFrame) and cells.crs == sites.crs
    assert cells.drop(columns="geometry").equals(sites.drop(columns="geometry")) and cells.index.equals(sites.index)
    assert cells.geometry.isna().to_numpy().nonzero()[0].tolist() == [5, 7]
    there = cells.geometry.notna()
    assert cells[there].contains(sites[there].geometry).all()
    series = delone.geo.voronoi(sites.geometry)
    assert isinstance(series, geopandas.GeoSeries) and series.equals(cells.geometry)
    assert delone.geo.voronoi(sites[:0]).empty
    other = geopandas.GeoSeries([REGION], crs=25833)
    with pytest.raises(ValueError, match=r"the coordinates of the region are .*33N, those of the sites .*32N"):
        delone.geo.voronoi(sites, other)
    assert delone.geo.voronoi(sites, other.set_crs(25832, allow_override=True)).area.sum() == pytest.approx(REGION.area)
    with pytest.raises(TypeError, match="must be a GeoDataFrame"):
        delone.geo.voronoi(SITES)
    with pytest.raises(TypeError, match="sites must be points"):
        delone.geo.voronoi(geopandas.GeoSeries([REGION]))


def test_triangles_keep_rows_columns_and_system():
    polygons = geopandas.GeoDataFrame(
        {"use": ["farm", "nothing", "wood"]},
        geometry=[REGION, None, shapely.MultiPolygon([shapely.box(2, 2, 3, 3), shapely.box(4, 4, 5, 5)])],
        crs=25832,
        index=["a", "b", "c"],
    )
    triangles = delone.geo.triangulate(polygons)
    assert triangles.crs == polygons.crs
    assert triangles.dissolve(by="use").area.to_dict() == pytest.approx({"farm": REGION.area, "wood": 2.0})
    assert set(triangles.index) == {"a", "c"} and (triangles.loc["c"].use == "wood").all()
    assert delone.geo.triangulate(polygons.geometry[1:2]).empty
    assert [len(made.triangles) for made in delone.triangulate_polygons(polygons)] == [8, 0, 4]


def test_lines_are_points_and_segments():
    ring = shapely.box(0, 0, 4, 4)
    collection = shapely.GeometryCollection([shapely.Point(1, 1), shapely.LineString([(2, 0), (2, 4)])])
    column = geopandas.GeoSeries([ring, None, collection, shapely.MultiPoint([(3, 3), (3, 1)])])
    points, segments, row = delone.geo.lines(column)
    assert row.tolist() == [0] * 5 + [2] * 3 + [3] * 2
    assert segments.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4], [6, 7]]
    made = delone.ConstrainedDelaunay(points, segments)
    assert len(made.points) == len(points) and made.check() is None
    empty = delone.geo.lines(geopandas.GeoSeries([], dtype="geometry"))
    assert [len(part) for part in empty] == [0, 0, 0] and empty[1].shape == (0, 2)


def test_polygons_stand_for_points_and_segments() -> None:
    ring, hole = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0.2, 0.2), (0.4, 0.2), (0.3, 0.4)]
    polygon = shapely.Polygon(ring, [hole])
    column = geopandas.GeoSeries([polygon, None, shapely.box(1, 0, 2, 1)])
    for given, area in [
        (polygon, 0.98),
        (column, 1.98),
        (column.__geo_interface__, 1.98),
        ([polygon, shapely.box(2, 0, 3, 1)], 1.98),
    ]:
        made = delone.mesh(given, min_angle=25, max_area=0.05)
        assert made.area == pytest.approx(area) and made.report.smallest_angle >= 25
        inside = delone.ConstrainedDelaunay(given)
        assert shapely.area(shapely.polygons(inside.points[inside.simplices])).sum() == pytest.approx(area)
    flat = delone.mesh([*ring, *hole], [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]], max_area=0.05)
    # Shapely has holes the other way around, and the mesh is a function of the set.
    assert np.array_equal(np.sort(flat.points, axis=0), np.sort(delone.mesh(polygon, max_area=0.05).points, axis=0))
    assert delone.mesh(shapely.Polygon()).area == 0
    with pytest.raises(TypeError, match="sides of their own"):
        delone.mesh(polygon, [[0, 1]])
    with pytest.raises(TypeError, match="polygon 1: a Point has no inside"):
        delone.ConstrainedDelaunay([polygon, shapely.Point(0, 0)])


def test_regions_in_another_system_are_told():
    far = shapely.box(500_000, 5_000_000, 500_001, 5_000_001)
    with pytest.warns(UserWarning, match="beside all sites, which are in ETRS89"):
        made = delone.geo.voronoi(frame(), far)
    assert (~shapely.is_missing(np.asarray(made.geometry))).sum() >= 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        delone.geo.voronoi(frame(), geopandas.GeoSeries([far], crs=25832))  # somebody says so
        delone.geo.voronoi(frame(), (0.2, 0.2, 0.8, 0.8))


def test_what_is_no_region_is_told():
    with pytest.raises(TypeError, match="the name of a file"):
        delone.geo.voronoi(frame(), "country.gpkg")
    with pytest.raises(ValueError, match="not 40; rows are points, so transpose it"):
        delone.Delaunay(SITES.T)
    with pytest.raises(TypeError, match="is drawn, not ndarray"):
        delone.plot(SITES)
