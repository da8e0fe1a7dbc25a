"""Terrain models of points with heights: of arrays or files, as an array or as files."""

from __future__ import annotations

import json
import os
import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from numbers import Number
from typing import Any, Literal, TypedDict, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._geometries import as_mapping, column_of, geometry_type, system_of
from ._points import as_choice, as_flag, as_names, as_number_in, as_numbers, as_points
from ._store import as_bytes, as_classes
from ._terrain import Rule, Transform, as_heights, as_longest

Path = str | os.PathLike[str]
Method = Literal["linear", "natural", "laplace", "nearest", "smooth", "farin"]

_METHODS = ("linear", "natural", "laplace", "nearest", "smooth", "farin")
#: Whether it is text of GeoJSON or the name of a file, and that.
_Shapes = tuple[bool, str]


class Wanted(TypedDict):
    """How a model is made; `_delone.dtm` takes it."""

    cell: float | None
    extent: tuple[float, float, float, float] | None
    origin: tuple[float, float]
    like: str | None
    method: str
    duplicates: str
    max_edge: tuple[float, bool] | None
    breaklines: list[_Shapes]
    flat: list[_Shapes]
    clip: list[_Shapes]
    classes: list[int]
    all_classes: bool
    columns: list[str]
    output: list[str]
    nodata: float | None
    compress: str
    interval: float | None
    epsg: int | None
    memory: int | None


@overload
def dtm(
    points: ArrayLike | Path | Sequence[Path],
    z: ArrayLike | None = None,
    *,
    cell: float | None = None,
    extent: Sequence[float] | None = None,
    origin: Sequence[float] = (0.0, 0.0),
    like: Path | None = None,
    method: Method = "linear",
    duplicates: Rule = "lowest",
    max_edge: float | None = None,
    max_edge_anywhere: float | None = None,
    breaklines: Any = None,
    flat: Any = None,
    clip: Any = None,
    classes: Sequence[int] | None = None,
    all_classes: bool = False,
    columns: Sequence[str] = (),
    epsg: int | None = None,
    memory: int | str | None = None,
    output: None = None,
) -> tuple[NDArray[np.float64], Transform]: ...
@overload
def dtm(
    points: ArrayLike | Path | Sequence[Path],
    z: ArrayLike | None = None,
    *,
    cell: float | None = None,
    extent: Sequence[float] | None = None,
    origin: Sequence[float] = (0.0, 0.0),
    like: Path | None = None,
    method: Method = "linear",
    duplicates: Rule = "lowest",
    max_edge: float | None = None,
    max_edge_anywhere: float | None = None,
    breaklines: Any = None,
    flat: Any = None,
    clip: Any = None,
    classes: Sequence[int] | None = None,
    all_classes: bool = False,
    columns: Sequence[str] = (),
    epsg: int | None = None,
    memory: int | str | None = None,
    output: Path | Sequence[Path],
    nodata: float | None = None,
    compress: Literal["deflate", "lzw", "none"] = "deflate",
    interval: float | None = None,
) -> None: ...
def dtm(
    points: ArrayLike | Path | Sequence[Path],
    z: ArrayLike | None = None,
    *,
    cell: float | None = None,
    extent: Sequence[float] | None = None,
    origin: Sequence[float] = (0.0, 0.0),
    like: Path | None = None,
    method: Method = "linear",
    duplicates: Rule = "lowest",
    max_edge: float | None = None,
    max_edge_anywhere: float | None = None,
    breaklines: Any = None,
    flat: Any = None,
    clip: Any = None,
    classes: Sequence[int] | None = None,
    all_classes: bool = False,
    columns: Sequence[str] = (),
    epsg: int | None = None,
    memory: int | str | None = None,
    output: Path | Sequence[Path] | None = None,
    nodata: float | None = None,
    compress: Literal["deflate", "lzw", "none"] = "deflate",
    interval: float | None = None,
) -> tuple[NDArray[np.float64], Transform] | None:
    """A terrain model: heights of cells, as an array or in files. The files have the bytes that the program `delone dtm` writes.

    All threads are used. What might surprise is a `UserWarning`: heights or systems of coordinates that are left out, lines that
    cross at two heights.

    Parameters
    ----------
    points : array_like of shape (n, 3), or of shape (n, 2) with `z`; or a path, or several
        Points with heights, or files of them: LAS and LAZ, text, npy, GeoJSON, GeoPackage and others.
    z : array_like of shape (n,)
        The heights of an array of x and y.
    cell : float, optional
        The side of a cell; without it there is about one point a cell. Cells begin at multiples of it from `origin`.
    extent : (x0, y0, x1, y1), optional
        The area that cells cover, instead of that of the points.
    like : path, optional
        A raster (tif or asc) whose cells are taken.
    method : "linear", "natural", "laplace", "nearest", "smooth" or "farin"
        How heights between points come about.
    duplicates : "lowest", "first", "highest" or "mean"
        Which height a place has at which there are several points.
    max_edge, max_edge_anywhere : float, optional
        Triangles with a longer edge are left out: from the hull inwards, or wherever they are.
    breaklines : paths or geometries, optional
        Lines that must be edges, with their own heights or, without, those of the surface below. A geometry is an array of shape
        (k, 2) or (k, 3), one of shapely or geopandas, or a mapping of GeoJSON; lists of all these are taken. The systems of files
        and of geopandas, by their numbers, are compared with that of the points.
    flat : paths or geometries, optional
        Polygons that are level, water say: at the one height that they have, or at the lowest of the surface along their border.
        An array is a ring.
    clip : paths or geometries, optional
        Polygons outside of which there are no heights.
    classes, all_classes
        Of LAS files ground (class 2) is taken, unless these say otherwise.
    columns : names, optional
        The columns of text that are x, y and z.
    epsg : int, optional
        The system of the coordinates by its number, which files say.
    memory : int or text, optional
        The bytes that may be taken, as in "500M" or "4G": work is done in tiles on disk, beside the output. Heights are the same,
        bit for bit. For files without breaklines and level polygons, and for the methods without gradients.
    output : path or paths, optional
        Files by their extensions: rasters (tif, asc, npy), hillshades (png) and contours (geojson, fgb, gpkg). All of them are
        written, or none.
    nodata, compress, interval
        Of files: the number for no data, "deflate", "lzw" or "none" for tif, and the distance of contours in height.

    Returns
    -------
    (array, transform)
        Heights of shape (rows, columns), from north to south, NaN where there is none; the transform is that of rasterio.
    None
        With `output`.

    Examples
    --------
    >>> import delone
    >>> corners = [[0, 0, 0], [4, 0, 4], [4, 4, 8], [0, 4, 4]]
    >>> delone.dtm(corners, cell=2.0)
    (array([[4., 6.],
           [2., 4.]]), (2.0, 0.0, 0.0, 0.0, -2.0, 4.0))
    >>> ridge = [[0, 2, 9], [4, 2, 9]]
    >>> heights, _ = delone.dtm(corners, cell=1.0, breaklines=ridge, clip=[[0, 0], [4, 0], [4, 4]])
    >>> heights[1].round(2).tolist()
    [nan, nan, 7.75, 8.25]
    """
    if interval is not None and not float(interval) > 0:
        raise ValueError(f"interval must be positive, not {interval!r}")
    if cell is not None and like is not None:
        raise ValueError("give cell or like, not both")
    points = _listed(points)
    is_path, classes = _is_path(points), as_classes(classes)
    if output is None and (nodata is not None or interval is not None):
        raise ValueError("nodata and interval are of files: give output too")
    if not is_path and (classes or all_classes or len(columns) > 0):
        raise ValueError("classes and columns are of files, and the points are an array")
    if classes and all_classes:
        raise ValueError("give classes or all_classes, not both")
    wanted: Wanted = {
        "cell": None if cell is None else float(cell),
        "extent": None if extent is None else _extent(extent),
        "origin": _pair(origin),
        "like": None if like is None else os.fspath(like),
        "method": as_choice(method, _METHODS, "method"),
        "duplicates": as_choice(duplicates, ("lowest", "first", "highest", "mean"), "duplicates"),
        "max_edge": as_longest(max_edge, max_edge_anywhere),
        "breaklines": list(_shapes(breaklines, "breaklines", "LineString")),
        "flat": list(_shapes(flat, "flat", "Polygon")),
        "clip": list(_shapes(clip, "clip", "Polygon")),
        "classes": classes,
        "all_classes": as_flag(all_classes, "all_classes"),
        "columns": as_names(columns, "columns"),
        "output": [] if output is None else _outputs(output),
        "nodata": None if nodata is None else float(nodata),
        "compress": as_choice(compress, ("deflate", "lzw", "none"), "compress"),
        "interval": None if interval is None else float(interval),
        "epsg": None if epsg is None else as_number_in(epsg, "epsg", 1, 2**32 - 1),
        "memory": None if memory is None else as_bytes(memory),
    }
    if memory is not None and (not is_path or wanted["breaklines"] or wanted["flat"]):
        raise ValueError("memory is for points of files, without breaklines and level polygons")
    if is_path:
        if z is not None:
            raise ValueError("the heights of files are in them: leave z out")
        given, paths = None, _paths(points)  # type: ignore[arg-type]
    else:
        given, paths = _with_heights(points, z), []  # type: ignore[arg-type]
    values, corner, step, remarks = _delone.dtm(given, paths, wanted)
    for remark in remarks:
        warnings.warn(remark, stacklevel=2)
    if values is None:
        return None
    return values, (step[0], 0.0, corner[0], 0.0, step[1], corner[1])


def _with_heights(points: ArrayLike, z: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if z is None and (positions := _in_space(points)) is not None:
        points = positions
    if z is not None:
        at = as_points(points, columns=2)
        return at, as_heights(z, len(at))
    array = as_points(points, columns=3)
    return np.ascontiguousarray(array[:, :2]), np.ascontiguousarray(array[:, 2])


def _in_space(points: Any) -> NDArray[np.float64] | None:
    """The positions of geometries that have heights, a row each; None for what is no geometry."""
    kind = geometry_type()
    column = column_of(points)
    if kind is None or not (isinstance(column, kind) or hasattr(column, "geom_type")):
        return None
    shapely = sys.modules["shapely"]
    found: NDArray[np.float64] = shapely.get_coordinates(np.asarray(column, dtype=object), include_z=True)
    return found


def _listed(points: Any) -> Any:
    """Paths of a set, of a generator or of an array as a list of them; other things as they are."""
    if isinstance(points, (Iterator, Set)):
        return list(points)
    return points.tolist() if isinstance(points, np.ndarray) and points.dtype.kind in "UO" and points.ndim == 1 else points


def _outputs(output: Path | Iterable[Path]) -> list[str]:
    paths = _paths(output)
    if not paths:
        raise ValueError("output must be a path or several; leave it out for an array")
    absolute = [os.path.abspath(path) for path in paths]
    for number, path in enumerate(absolute):
        if path in absolute[:number]:
            raise ValueError(f"output has {paths[number]} twice")
    return paths


def _is_path(given: Any) -> bool:
    """Whether something is a path, or a list of them."""
    if isinstance(given, (str, os.PathLike)):
        return True
    return isinstance(given, (list, tuple)) and len(given) > 0 and all(isinstance(one, (str, os.PathLike)) for one in given)


def _paths(given: Path | Iterable[Path]) -> list[str]:
    return [os.fspath(given)] if isinstance(given, (str, os.PathLike)) else [os.fspath(one) for one in given]


def _extent(extent: Sequence[float]) -> tuple[float, float, float, float]:
    numbers = [] if isinstance(extent, str) else [float(x) for x in extent]
    if len(numbers) != 4 or not (numbers[0] < numbers[2] and numbers[1] < numbers[3]) or not np.isfinite(numbers).all():
        raise ValueError(f"extent must be the least x and y, and then the largest ones; not {extent!r}")
    return numbers[0], numbers[1], numbers[2], numbers[3]


def _pair(origin: Sequence[float]) -> tuple[float, float]:
    numbers = [] if isinstance(origin, str) else [float(x) for x in origin]
    if len(numbers) != 2 or not np.isfinite(numbers).all():
        raise ValueError(f"origin must be x and y, not {origin!r}")
    return numbers[0], numbers[1]


def _shapes(given: Any, what: str, kind: str) -> Iterable[_Shapes]:
    """Files by their names, and geometries as GeoJSON; an array is a line or a ring."""
    if given is None:
        return
    if isinstance(given, (str, os.PathLike)):
        yield False, os.fspath(given)
        return
    mapping = as_mapping(column_of(given))
    if mapping is None and _is_rows(given):
        mapping = _geometry(as_numbers(given, what), what, kind)
    if mapping is not None:
        yield True, _text(mapping, system_of(given), what, kind)
        return
    if not isinstance(given, (list, tuple, np.ndarray)):
        raise TypeError(f"{what} must be paths or geometries, not {given!r}")
    for one in given:
        yield from _shapes(one, what, kind)


def _text(mapping: Mapping[str, Any], system: Any, what: str, kind: str) -> str:
    """GeoJSON of geometries, with their system where they name one by its number."""
    if mapping.get("type") == "LinearRing":
        ring = mapping["coordinates"]
        mapping = {"type": kind, "coordinates": ring if kind == "LineString" else [ring]}
    if kind == "Polygon" and not _has_polygon(mapping):
        raise ValueError(f"{what} must be polygons, and there is none in {mapping.get('type')!r}")
    number = getattr(system, "to_epsg", lambda: None)()
    if number is not None:
        named = {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{number}"}}
        mapping = {**mapping, "crs": named}
    try:
        return json.dumps(mapping, allow_nan=False, default=_plain)
    except ValueError as error:
        if "Circular" in str(error):
            raise
        raise ValueError(f"{what}: coordinates and attributes must be numbers, neither NaN nor infinite") from None


def _has_polygon(mapping: Any) -> bool:
    """Whether there is a polygon with corners in GeoJSON."""
    if not isinstance(mapping, Mapping):
        return False
    kind = mapping.get("type")
    if kind in ("Polygon", "MultiPolygon"):
        return len(mapping.get("coordinates") or ()) > 0
    members = mapping.get("features") or mapping.get("geometries") or [mapping.get("geometry")]
    return any(_has_polygon(as_mapping(member)) for member in members if member is not None)


def _is_rows(given: Any) -> bool:
    """Whether something is rows of numbers."""
    if isinstance(given, np.ndarray):
        return given.ndim == 2
    if not isinstance(given, (list, tuple)) or not given:
        return False
    is_row = (isinstance(row, (list, tuple, np.ndarray)) and len(row) > 0 and isinstance(row[0], Number) for row in given)
    return all(is_row)


def _geometry(rows: NDArray[Any], what: str, kind: str) -> dict[str, Any]:
    if rows.ndim != 2 or rows.shape[1] not in (2, 3):
        raise ValueError(f"{what}: an array must have the shape (k, 2) or (k, 3), not {rows.shape}")
    positions = rows.astype(np.float64).tolist()
    if kind == "LineString":
        return {"type": kind, "coordinates": positions}
    closed = positions if positions[:1] == positions[-1:] else [*positions, positions[0]]
    return {"type": kind, "coordinates": [closed]}


def _plain(value: Any) -> Any:
    """Numbers of NumPy in mappings of GeoJSON."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"{value!r} is not of GeoJSON")
