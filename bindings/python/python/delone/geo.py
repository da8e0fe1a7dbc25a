"""Tables of geopandas in, tables of geopandas out: rows keep their index, their columns and their system of coordinates.

Other classes of this package take columns of points too: ``delone.Delaunay(frame)``, ``Neighbors(frame).nearest(other)``.
Their answers are arrays in the order of the rows, so that they become columns: ``frame["height"] = interpolator(frame)``.

Needs geopandas and shapely.
"""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._geometries import system_of
from ._polygons import triangulate_polygons
from ._voronoi import Voronoi

try:
    import geopandas
    import shapely
except ImportError as error:
    raise ImportError("delone.geo needs the packages geopandas and shapely: pip install geopandas") from error

__all__ = ["lines", "triangulate", "voronoi"]


def voronoi(sites: Any, region: Any = None, *, merge: float | str | None = None) -> Any:
    """The Voronoi cells of sites, clipped, in the place of their points.

    Parameters
    ----------
    sites : GeoDataFrame or GeoSeries
        Points. Rows without one, and rows whose point equals an earlier one, have no cell: their geometry is missing.
    region
        What cells are clipped to: a polygon, a column or a table of them, or a box of four numbers. Without it the box of the
        points, a twentieth larger.
    merge : float or "auto", optional
        As for `Voronoi`.

    Returns
    -------
    GeoDataFrame or GeoSeries
        The same rows with all columns; geometries are polygons, or multipolygons where the region cuts a cell to pieces.

    Raises
    ------
    ValueError
        If the region is in another system of coordinates than the sites. A region that names none, and is beside all sites, is
        a warning.

    Examples
    --------
    >>> import delone.geo, geopandas
    >>> towns = geopandas.GeoDataFrame({"name": ["A", "B"]}, geometry=geopandas.points_from_xy([1, 3], [1, 1]), crs=25832)
    >>> cells = delone.geo.voronoi(towns, (0, 0, 4, 2))
    >>> cells.name.tolist(), cells.area.tolist(), cells.crs.to_epsg()
    (['A', 'B'], [4.0, 4.0], 25832)
    """
    if isinstance(region, (str, os.PathLike)):
        raise TypeError("region must be geometries or a box, not the name of a file: geopandas.read_file reads it")
    column = _column(sites, "sites")
    theirs = system_of(region)
    if column.crs is not None and theirs is not None and theirs != column.crs:
        raise ValueError(f"the coordinates of the region are {theirs.name}, those of the sites {column.crs.name}; see to_crs")
    array = np.asarray(column)
    is_there = ~(shapely.is_missing(array) | shapely.is_empty(array))
    if not (shapely.get_type_id(array[is_there]) == shapely.GeometryType.POINT).all():
        raise TypeError("sites must be points")
    cells = np.full(len(array), None, dtype=object)
    if is_there.any():
        cells[is_there] = _polygons(Voronoi(array[is_there], merge=merge).cells(region))
        if column.crs is not None and theirs is None and _are_apart(cells, array):
            warnings.warn(
                f"the region is beside all sites, which are in {column.crs.name}: is it in the same system?", stacklevel=2
            )
    return _with(sites, cells)


def triangulate(polygons: Any, *, fill: str = "even-odd", crossings: str = "refuse") -> Any:
    """The triangles inside of polygons, each polygon alone: a row for each, with the index and the columns of its polygon.

    Parameters
    ----------
    polygons : GeoDataFrame or GeoSeries
        Polygons and multipolygons. Rows without one have no triangles.
    fill, crossings : str
        As for `triangulate_polygon`.

    Examples
    --------
    >>> import delone.geo, geopandas
    >>> from shapely.geometry import box
    >>> lots = geopandas.GeoDataFrame({"use": ["farm"]}, geometry=[box(0, 0, 2, 2)], index=["a7"])
    >>> triangles = delone.geo.triangulate(lots)
    >>> triangles.use.tolist(), triangles.index.tolist(), triangles.area.tolist()
    (['farm', 'farm'], ['a7', 'a7'], [2.0, 2.0])
    """
    column = _column(polygons, "polygons")
    made = triangulate_polygons(column, fill=fill, crossings=crossings, ragged=True)
    rows = np.repeat(np.arange(len(column)), np.diff(made.triangle_offsets))
    corners = made.points[made.triangles[:, [0, 1, 2, 0]]]
    return _with(polygons.iloc[rows], shapely.polygons(corners) if len(rows) else np.empty(0, dtype=object))


def lines(geometries: Any) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Lines and polygons as points and segments, for `ConstrainedDelaunay`, `Mesh` and `simplify`.

    Parameters
    ----------
    geometries
        A column or a table of geopandas, or an array of shapely's geometries, of any kind. What is missing has no points.

    Returns
    -------
    points : (n, 2) array
        All positions, in the order of the geometries; those that are equal are not joined, as triangulations find them.
    segments : (m, 2) array
        The indices of points that are joined.
    row : (n,) array
        The row of the geometry that each point is of.

    Examples
    --------
    >>> import delone, delone.geo
    >>> from shapely.geometry import LineString, Point
    >>> points, segments, row = delone.geo.lines([LineString([(0, 0), (4, 0), (4, 4)]), Point(0, 4)])
    >>> segments.tolist(), row.tolist()
    ([[0, 1], [1, 2]], [0, 0, 0, 1])
    >>> len(delone.ConstrainedDelaunay(points, segments).simplices)
    2
    """
    array = np.asarray(geometries.geometry if hasattr(geometries, "geometry") else geometries, dtype=object)
    parts, row_of_part = _parts(array)
    points, part = shapely.get_coordinates(parts, return_index=True)
    is_point = shapely.get_type_id(parts) == shapely.GeometryType.POINT
    joined = (part[1:] == part[:-1]) & ~is_point[part[1:]]
    start = np.flatnonzero(joined)
    return points, np.stack([start, start + 1], axis=1), row_of_part[part]


def _are_apart(first: NDArray[Any], second: NDArray[Any]) -> bool:
    """Whether the boxes of geometries are apart; not if there are none."""
    (left, low, right, high), (west, south, east, north) = shapely.total_bounds(first), shapely.total_bounds(second)
    return bool(right < west or left > east or high < south or low > north)


def _parts(array: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """Points, lines and rings, and the geometry that each is of."""
    row = np.arange(len(array))
    # Collections may be in collections.
    while (shapely.get_type_id(array) >= shapely.GeometryType.MULTIPOINT).any():
        array, index = shapely.get_parts(array, return_index=True)
        row = row[index]
    is_area = shapely.get_type_id(array) == shapely.GeometryType.POLYGON
    rings, index = shapely.get_rings(array[is_area], return_index=True)
    parts, rows = np.concatenate([array[~is_area], rings]), np.concatenate([row[~is_area], row[is_area][index]])
    order = np.argsort(rows, kind="stable")
    return parts[order], rows[order]


def _column(given: Any, what: str) -> Any:
    """The geometries of a table or a column."""
    if not isinstance(given, (geopandas.GeoDataFrame, geopandas.GeoSeries)):
        raise TypeError(f"{what} must be a GeoDataFrame or a GeoSeries, not {type(given).__name__}")
    return given.geometry


def _with(given: Any, geometries: NDArray[Any]) -> Any:
    """A table with other geometries, or a column of them under the name and the index of another."""
    column = geopandas.GeoSeries(geometries, index=given.index, crs=given.crs)
    if isinstance(given, geopandas.GeoDataFrame):
        return given.set_geometry(column.rename(given.geometry.name))
    return column.rename(given.name)


def _polygons(cells: list[list[NDArray[np.float64]]]) -> NDArray[Any]:
    """Cells by their rings as polygons; those without rings are missing."""
    counts = np.array([len(rings) for rings in cells])
    made = np.full(len(cells), None, dtype=object)
    single = np.flatnonzero(counts == 1)
    if len(single):
        rings = [cells[i][0] for i in single]
        index = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
        made[single] = shapely.polygons(shapely.linearrings(np.concatenate(rings), indices=index))
    for i in np.flatnonzero(counts > 1):
        made[i] = _of_rings(cells[i])
    return made


def _of_rings(rings: list[NDArray[np.float64]]) -> Any:
    """A polygon with holes, or several: outer rings are counter-clockwise."""
    closed = [shapely.LinearRing(ring) for ring in rings]
    outer = [shapely.Polygon(ring) for ring in closed if ring.is_ccw]
    holes: list[list[Any]] = [[] for _ in outer]
    for hole in closed:
        if not hole.is_ccw:
            inside = shapely.Polygon(hole).representative_point()
            holes[next((k for k, polygon in enumerate(outer) if polygon.contains(inside)), 0)].append(hole)
    whole = [shapely.Polygon(polygon.exterior, own) for polygon, own in zip(outer, holes, strict=True)]
    return whole[0] if len(whole) == 1 else shapely.MultiPolygon(whole)
