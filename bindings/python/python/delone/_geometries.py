"""Points and polygons that come as geometries: shapely's, columns of geopandas, mappings of GeoJSON, boxes."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: What shapely calls kinds of geometries.
_POINT, _MULTI_POINT = 0, 4


def as_mapping(given: Any) -> Mapping[str, Any] | None:
    """A geometry as GeoJSON has it, if it is one."""
    if isinstance(given, Mapping):
        return given
    found = getattr(given, "__geo_interface__", None)
    return found if isinstance(found, Mapping) else None


def geometry_type() -> Any:
    """The class of shapely's geometries; None while nobody has imported it, and none can be given."""
    return getattr(sys.modules.get("shapely"), "Geometry", None)


def column_of(given: Any) -> Any:
    """The column of geometries that a table has, and other things as they are."""
    kind = geometry_type()
    is_geometry = kind is None or isinstance(given, (kind, type))
    return given if is_geometry or not hasattr(given, "geom_type") else getattr(given, "geometry", given)


def system_of(given: Any) -> Any:
    """The system of coordinates that a column of geometries names, if it names one."""
    return getattr(given, "crs", None)


def coordinates(given: Any, what: str) -> NDArray[np.float64] | None:
    """x and y of points that are geometries, a row each; None for what is no geometry. Heights are left out.

    Raises TypeError for lines and polygons, ValueError for what is missing or empty.
    """
    kind = geometry_type()
    if kind is not None:
        given = column_of(given)
        if isinstance(given, kind):
            return _of_shapely(np.array([given], dtype=object), what)
        if not isinstance(given, (Mapping, str, bytes)) and (hasattr(given, "geom_type") or _begins_with(given, kind)):
            array = np.empty(len(given), dtype=object)
            array[:] = list(given)
            return _of_shapely(array, what)
    mapping = as_mapping(given)
    return None if mapping is None or "type" not in mapping else np.array(_positions(mapping, what), dtype=float).reshape(-1, 2)


def _begins_with(given: Any, kind: Any) -> bool:
    """Whether a list or an array of objects begins with such a thing, after what is missing."""
    if isinstance(given, np.ndarray):
        if given.dtype.kind != "O" or given.ndim != 1:
            return False
    elif not isinstance(given, (list, tuple)):
        return False
    return isinstance(next((one for one in given if one is not None), None), kind)


def _of_shapely(array: NDArray[Any], what: str) -> NDArray[np.float64]:
    shapely = sys.modules["shapely"]
    kinds = shapely.get_type_id(array)
    wrong = np.flatnonzero((kinds == -1) | shapely.is_empty(array))
    if len(wrong):
        raise ValueError(f"{what}: geometry {wrong[0]} is missing or empty; give what is there, as with notna() and ~is_empty")
    wrong = np.flatnonzero((kinds != _POINT) & (kinds != _MULTI_POINT))
    if len(wrong):
        raise TypeError(f"{what} must be points; geometry {wrong[0]} is a {array[wrong[0]].geom_type}")
    found: NDArray[np.float64] = shapely.get_coordinates(array)
    return found


def _positions(mapping: Mapping[str, Any], what: str) -> list[tuple[float, float]]:
    """The positions of points in a mapping."""
    kind = mapping.get("type")
    if kind == "Feature":
        return _positions(as_mapping(mapping.get("geometry")) or {}, what)
    for collection, members in (("FeatureCollection", "features"), ("GeometryCollection", "geometries")):
        if kind == collection:
            found = (_positions(as_mapping(member) or {}, what) for member in mapping.get(members) or ())
            return [position for positions in found for position in positions]
    if kind in ("Point", "MultiPoint"):
        given = mapping.get("coordinates")
        rows: Any = [given] if kind == "Point" else given
        if isinstance(rows, Iterable) and all(isinstance(row, (list, tuple, np.ndarray)) and len(row) > 1 for row in rows):
            return [(row[0], row[1]) for row in rows]
        raise ValueError(f"{what}: a {kind} must have coordinates, not {given!r}")
    raise TypeError(f"{what} must be points, not {f'a {kind}' if kind else 'nothing'}")


def box_of(given: Any) -> NDArray[np.float64] | None:
    """The corners of a box that is given by four numbers, the least x and y and the largest; None for all else."""
    if isinstance(given, (list, tuple, np.ndarray)) and len(given) == 4 and all(np.ndim(x) == 0 for x in given):
        try:
            x0, y0, x1, y1 = (float(x) for x in given)
        except (TypeError, ValueError):
            return None
        if not (x0 < x1 and y0 < y1):
            raise ValueError(f"a box is its least x and y, and then the largest ones; not {tuple(given)}")
        return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    return None
