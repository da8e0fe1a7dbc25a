"""Polygons with holes to triangles: arrays, shapely's geometries, GeoJSON."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from . import _delone
from ._geometries import as_mapping, box_of, column_of, geometry_type
from ._points import as_choice, as_flag, as_points, as_segments
from ._welded import welded_rings

#: Rings, as they are given.
_Rings = list[Any]
#: The parts of a polygon, each a shell and its holes.
_Parts = list[_Rings]
#: Corners, where rings begin, where parts begin among the rings, and where polygons begin among the parts.
_Flat = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]


class PolygonTriangles(NamedTuple):
    """The triangles inside of a polygon."""

    #: The corners of all rings as they were given, one ring after the other, and then points made where sides crossed: (n, 2).
    points: NDArray[np.float64]
    #: Triangles by indices of points, counter-clockwise, (m, 3); of equal points the first one is meant.
    triangles: NDArray[np.int32]

    @property
    def area(self) -> float:
        """The sum of the areas, rounded."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        return float((ux * vy - uy * vx).sum() / 2)


class RaggedTriangles(NamedTuple):
    """The triangles inside of many polygons, in arrays of all."""

    #: The points of all polygons, (n, 2).
    points: NDArray[np.float64]
    #: Triangles by indices among the points of all polygons, (m, 3).
    triangles: NDArray[np.int64]
    #: Where the points of each polygon begin, and where all end: (number of polygons + 1,).
    point_offsets: NDArray[np.int64]
    #: Where the triangles of each polygon begin, and where all end.
    triangle_offsets: NDArray[np.int64]


def triangulate_polygon(
    polygon: Any, *, fill: str = "even-odd", crossings: str = "refuse", weld: float | None = None
) -> PolygonTriangles:
    """Triangulates the inside of one polygon. Its triangles are those of the constrained Delaunay triangulation.

    Parameters
    ----------
    polygon
        A ring as an array of shape (n, 2); a list of rings, in any order and direction; or what has a `__geo_interface__`, as
        shapely's geometries, or is such a mapping, as in GeoJSON: Polygon, MultiPolygon, Feature, or a GeometryCollection of
        these, which is taken as one. Rings may be closed or not, touch, and share sides. Heights are left out.
    fill : str
        What is inside: "even-odd" what an odd number of rings is around, "nonzero" what rings wind around in sum,
        counter-clockwise less clockwise, "positive" where this is more than zero, "negative" where it is less,
        "shells-minus-holes" what the first ring is around and no other, for each polygon of a geometry.
    crossings : str
        What happens where sides cross: "refuse" is a CrossingError, "split" makes points there.
    weld : float, optional
        A distance: corners and sides nearer to each other become one first, as `delone.weld` has it. Points, and sides that an
        error names, are then those of the welded rings.

    Examples
    --------
    >>> import delone
    >>> square, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [3, 1], [3, 3], [1, 3]]
    >>> inside = delone.triangulate_polygon([square, hole])
    >>> len(inside.triangles), inside.area
    (8, 12.0)
    """
    flat = _flat([_parts_of(polygon, "polygon")], ["polygon"])
    points, triangles, _, _ = _triangulated(flat, fill, crossings, weld, True)
    return PolygonTriangles(points, triangles)


@overload
def triangulate_polygons(
    polygons: Any, *, fill: str = "even-odd", crossings: str = "refuse", weld: float | None = None, ragged: Literal[False] = False
) -> list[PolygonTriangles]: ...
@overload
def triangulate_polygons(
    polygons: Any, *, fill: str = "even-odd", crossings: str = "refuse", weld: float | None = None, ragged: Literal[True]
) -> RaggedTriangles: ...
def triangulate_polygons(
    polygons: Any, *, fill: str = "even-odd", crossings: str = "refuse", weld: float | None = None, ragged: bool = False
) -> list[PolygonTriangles] | RaggedTriangles:
    """Triangulates the insides of many polygons, each alone, on all cores.

    Parameters
    ----------
    polygons
        What holds polygons: a list, an array, a FeatureCollection; geopandas' GeoSeries and GeoDataFrame, of which rows without a
        polygon have no triangles. Each of them as for
        `triangulate_polygon`. Lists and arrays of shapely's geometries are fastest.
    fill, crossings : str
        As for `triangulate_polygon`. Errors name the polygon.
    weld : float, optional
        As for `triangulate_polygon`; polygons are welded to each other, too.
    ragged : bool
        All in arrays, instead of a list of PolygonTriangles, whose arrays are parts of these.

    Examples
    --------
    >>> import delone
    >>> square, triangle = [[0, 0], [4, 0], [4, 4], [0, 4]], [[5, 0], [9, 0], [9, 4]]
    >>> [len(inside.triangles) for inside in delone.triangulate_polygons([square, triangle])]
    [2, 1]
    >>> delone.triangulate_polygons([square, triangle], ragged=True).triangles.tolist()[2]
    [4, 5, 6]
    """
    is_ragged = as_flag(ragged, "ragged")
    given = _members(polygons)
    flat = _flat_of_shapely(given)
    if flat is None:
        names = [f"polygon {k}" for k in range(len(given))]
        flat = _flat([_parts_of(one, name) for one, name in zip(given, names, strict=True)], names)
    points, triangles, point_offsets, triangle_offsets = _triangulated(flat, fill, crossings, weld, False)
    if is_ragged:
        shift = np.repeat(point_offsets[:-1], np.diff(triangle_offsets))
        return RaggedTriangles(points, triangles + shift[:, None], point_offsets, triangle_offsets)
    parts = zip(pairwise(point_offsets.tolist()), pairwise(triangle_offsets.tolist()), strict=True)
    return [PolygonTriangles(points[p:q], triangles[t:u]) for (p, q), (t, u) in parts]


def _triangulated(
    flat: _Flat, fill: str, crossings: str, weld: float | None, is_one: bool
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]:
    rule = as_choice(fill, _RULES, "fill")
    split = as_choice(crossings, ("refuse", "split"), "crossings") == "split"
    corners, rings, parts, polygons = flat
    if weld is not None:
        corners, rings = welded_rings(corners, rings, weld)
    return _delone.triangulate_polygons(corners, (rings, parts, polygons), rule, split, is_one)


def _offsets(lengths: Any) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(lengths, dtype=np.int64)])


def _flat(polygons: list[_Parts], names: list[str]) -> _Flat:
    rings = [
        _ring(ring, f"{name}, ring {k}")
        for name, parts in zip(names, polygons, strict=True)
        for k, ring in enumerate(ring for part in parts for ring in part)
    ]
    corners = np.concatenate(rings) if rings else np.empty((0, 2))
    by_part = _offsets([len(part) for parts in polygons for part in parts])
    return np.ascontiguousarray(corners), _offsets([len(r) for r in rings]), by_part, _offsets([len(p) for p in polygons])


def _ring(ring: Any, what: str) -> NDArray[np.float64]:
    if isinstance(ring, (list, tuple)) and not ring:
        return np.empty((0, 2))
    return as_points(ring, what, 2)


def _flat_of_shapely(given: list[Any]) -> _Flat | None:
    """Polygons of shapely without a look at each; `None` where others are among them."""
    kind = geometry_type()
    if kind is None or not given or not all(isinstance(one, kind) for one in given):
        return None
    shapely = sys.modules["shapely"]
    array = np.empty(len(given), dtype=object)
    array[:] = given
    if not np.isin(shapely.get_type_id(array), (3, 6)).all():
        return None
    parts, polygon_of_part = shapely.get_parts(array, return_index=True)
    rings, part_of_ring = shapely.get_rings(parts, return_index=True)
    corners, ring_of_corner = shapely.get_coordinates(rings, return_index=True)
    by_ring = np.bincount(ring_of_corner, minlength=len(rings))
    by_part = np.bincount(part_of_ring, minlength=len(parts))
    by_polygon = np.bincount(polygon_of_part, minlength=len(given))
    return np.ascontiguousarray(corners), _offsets(by_ring), _offsets(by_part), _offsets(by_polygon)


def _members(polygons: Any) -> list[Any]:
    """The polygons that something holds."""
    polygons = column_of(polygons)
    if geometry_type() is not None and not isinstance(polygons, geometry_type()) and hasattr(polygons, "geom_type"):
        # A row of a column that has no polygon has no triangles.
        nothing = sys.modules["shapely"].Polygon()
        return [nothing if one is None else one for one in polygons]
    if not isinstance(polygons, (Mapping, list, tuple)) and hasattr(polygons, "__array__"):
        array = np.asarray(polygons)
        if array.dtype.kind != "O" and array.ndim < 3:
            raise TypeError(f"an array of the shape {array.shape} is no list of polygons; see triangulate_polygon for one")
        if array.ndim != 2:
            return list(array) if array.ndim else _members(array.item())
    mapping = as_mapping(polygons)
    if mapping is None:
        if isinstance(polygons, (str, bytes)) or not isinstance(polygons, Iterable):
            raise TypeError(f"polygons must be a list of polygons, not {polygons!r}")
        return list(polygons)
    kind = mapping.get("type")
    for collection, members in (("FeatureCollection", "features"), ("GeometryCollection", "geometries")):
        if kind == collection:
            return list(_required(mapping, members, "polygons"))
    raise TypeError(f"a {kind} is no list of polygons; see triangulate_polygon for one")


def rings_of_region(region: Any) -> _Rings | None:
    """The rings of a region that is a box, a geometry or a column of geometries; None for arrays and lists of rings."""
    box = box_of(region)
    if box is not None:
        return [box]
    region = column_of(region)
    if hasattr(region, "geom_type") and as_mapping(region) is not None and hasattr(region, "__len__"):
        members = [member for member in region if member is not None]
        return [ring for member in members for ring in _rings_of(member, "region")]
    mapping = as_mapping(region)
    if mapping is None:
        return None
    if mapping.get("type") == "FeatureCollection":
        # A row without a polygon, as in a column of geometries.
        members = [
            one for one in _members(mapping) if not (isinstance(one, Mapping) and "geometry" in one and one["geometry"] is None)
        ]
        return [ring for member in members for ring in _rings_of(member, "region")]
    return _rings_of(mapping, "region")


_RULES = ("even-odd", "nonzero", "positive", "negative", "shells-minus-holes")
_INSIDES = ("Polygon", "MultiPolygon")


def _has_inside(given: Any) -> bool:
    """Whether this is a polygon, or begins with one."""
    kind = geometry_type()
    given = column_of(given)
    if kind is not None and isinstance(given, kind):
        return given.geom_type in _INSIDES
    if isinstance(given, (list, tuple)) or hasattr(given, "geom_type"):
        first = next((one for one in given if one is not None), None)
        return kind is not None and isinstance(first, kind) and first.geom_type in _INSIDES
    mapping = as_mapping(given)
    if mapping is None:
        return False
    for member in ("features", "geometries"):
        members = mapping.get(member)
        if isinstance(members, (list, tuple)):
            return bool(members) and _has_inside(members[0])
    if mapping.get("type") == "Feature":
        return _has_inside(mapping.get("geometry"))
    return mapping.get("type") in _INSIDES


def points_and_segments(given: Any, segments: Any) -> tuple[NDArray[np.float64], NDArray[np.int64], bool]:
    """Points and the segments between them, as arrays of their own; of polygons the corners and sides, and that they are such."""
    if not _has_inside(given):
        points = np.array(as_points(given, columns=2), order="C")
        return points, np.array(as_segments(segments, len(points))), False
    if segments is not None:
        raise TypeError("segments are for points; polygons have sides of their own")
    if isinstance(given, (list, tuple)):
        rings = [ring for k, one in enumerate(given) if one is not None for ring in _rings_of(one, f"polygon {k}")]
    else:
        rings = rings_of_region(given) or []
    corners, starts, _, _ = _flat([[rings]], ["polygons"])
    # The last corner of a closed ring is the first one again.
    first, last = starts[:-1], starts[1:] - 1
    is_closed = (last > first) & (corners[first] == corners[np.maximum(last, first)]).all(axis=1)
    lengths = np.diff(starts) - is_closed
    starts = _offsets(lengths)
    sides = np.arange(starts[-1])
    following = sides + 1
    following[starts[1:][lengths > 0] - 1] = starts[:-1][lengths > 0]
    return np.delete(corners, last[is_closed], axis=0), np.column_stack([sides, following]), True


def _required(mapping: Mapping[str, Any], name: str, what: str) -> Any:
    value = mapping.get(name)
    if value is None or isinstance(value, (str, bytes)) or not isinstance(value, (Iterable, np.ndarray)):
        raise TypeError(f"{what}: a {mapping.get('type')} must have {name}, not {value!r}")
    return value


def _rings_of(given: Any, what: str) -> _Rings:
    """The rings of a polygon, not looked at yet; of all polygons of one geometry."""
    return [ring for part in _parts_of(given, what) for ring in part]


def _parts_of(given: Any, what: str) -> _Parts:
    """The parts of a polygon, each a shell and its holes."""
    mapping = as_mapping(given)
    if mapping is not None:
        return _parts_of_mapping(mapping, what)
    if given is None or isinstance(given, (str, bytes)) or not isinstance(given, (Iterable, np.ndarray)):
        raise TypeError(f"{what} must be a ring, a list of rings or a geometry, not {given!r}")
    if isinstance(given, np.ndarray) and given.dtype.kind != "O":
        return [list(given)] if given.ndim == 3 else [[given]]
    rings = given if isinstance(given, (list, tuple)) else list(given)
    # A ring if it begins with a point, which begins with a number.
    first = rings[0] if len(rings) else None
    is_ring = first is not None and (np.ndim(first) == 0 or (len(first) > 0 and np.ndim(first[0]) == 0))
    return [[rings]] if is_ring else [list(rings)]


def _parts_of_mapping(mapping: Mapping[str, Any], what: str) -> _Parts:
    kind = mapping.get("type")
    if kind == "Feature":
        geometry = as_mapping(mapping.get("geometry"))
        if geometry is None:
            raise TypeError(f"{what}: a Feature without a geometry")
        return _parts_of_mapping(geometry, what)
    if kind == "GeometryCollection":
        members = [as_mapping(member) for member in _required(mapping, "geometries", what)]
        return [part for member in members for part in _parts_of_mapping(member or {}, what)]
    if kind in ("Polygon", "MultiPolygon"):
        coordinates = _required(mapping, "coordinates", what)
        polygons = coordinates if kind == "MultiPolygon" else [coordinates]
        wrong = [polygon for polygon in polygons if not isinstance(polygon, (list, tuple, np.ndarray))]
        if wrong:
            raise TypeError(f"{what}: a {kind} must have lists of rings, not {wrong[0]!r}")
        return [[_plane(ring) for ring in polygon] for polygon in polygons]
    raise TypeError(f"{what}: a {kind} has no inside" if isinstance(kind, str) else f"{what}: a mapping that is no geometry")


def _plane(ring: Any) -> Any:
    """Without heights. What is no array is for those who say so."""
    try:
        array = np.asarray(ring)
    except ValueError:
        return ring
    return array[:, :2] if array.ndim == 2 and array.shape[1] > 2 else ring
