"""Heights at points of the plane: rasters, contours, and fewer points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _delone
from ._constrained import ConstrainedDelaunay
from ._delaunay import Delaunay
from ._points import as_choice, as_flag, as_index, as_numbers, as_points, as_segments

Transform = tuple[float, float, float, float, float, float]
Rule = Literal["lowest", "first", "highest", "mean"]


def rasterize(
    points: ArrayLike | Delaunay | ConstrainedDelaunay,
    z: ArrayLike | None = None,
    transform: Sequence[float] | None = None,
    shape: tuple[int, int] | None = None,
    *,
    cell: float | None = None,
    method: Literal["linear", "sibson", "natural", "laplace", "nearest"] = "linear",
    max_edge: float | None = None,
    max_edge_anywhere: float | None = None,
    duplicates: Rule = "lowest",
    nodata: float = np.nan,
    dtype: DTypeLike = np.float64,
    as_xarray: bool = False,
) -> Any:
    """A raster of heights: a value for the center of each cell that is in a triangle or on its border, which is exact.

    With the conventions of rasterio: row 0 comes first in files and is the northern one where the step of rows is negative, and
    `transform` maps columns and rows to the corner of a cell. All threads are used.

    Parameters
    ----------
    points : array_like of shape (n, 2), or Delaunay, or ConstrainedDelaunay
        The points, or their triangulation. Of a constrained one the triangles inside count, for "linear".
    z : array_like of shape (n,)
        The heights, which must be finite. Without it points have the shape (n, 3), and the third column is heights.
    transform : affine.Affine, or (a, b, c, d, e, f)
        x = a * column + c, y = e * row + f, without rotation: b and d are zero. With `shape`.
    shape : (rows, columns)
        The number of cells. Without `transform` they share the box of the points.
    cell : float
        Instead of both: the size of square cells, whose edges are multiples of it, such that they hold all points.
    method : "linear", "sibson", "laplace" or "nearest"
        How heights come about; all have values in the same cells. "natural", natural neighbors, is "sibson".
    max_edge : float, optional
        Triangles with a longer edge are left out, from the hull inwards: gaps in the middle stay filled.
    max_edge_anywhere : float, optional
        Instead: triangles with a longer edge are left out wherever they are.
    duplicates : "lowest", "first", "highest" or "mean"
        Which height a place has at which there are several points.
    nodata : number
        What is in cells without a height.
    dtype : float64 or float32
        What the result holds.
    as_xarray : bool
        Whether an `xarray.DataArray` is wanted, with the centers of cells as coordinates y and x.

    Returns
    -------
    array of shape (rows, columns)
        With `transform` and `shape`. The DataArray with `as_xarray` in all cases: its `attrs` have `transform` and `nodata`.
    (array, transform)
        With `cell`, or `shape` alone.

    Examples
    --------
    >>> import delone
    >>> corners, heights = [[0, 0], [4, 0], [4, 4], [0, 4]], [0.0, 4.0, 8.0, 4.0]
    >>> delone.rasterize(corners, heights, (2, 0, 0, 0, -2, 4), (2, 2))
    array([[4., 6.],
           [2., 4.]])
    >>> values, transform = delone.rasterize(corners, heights, cell=2.0)
    >>> transform
    (2.0, 0.0, 0.0, 0.0, -2.0, 4.0)

    A picture whose axes are x and y: ``plt.imshow(values, extent=extent)``.

    >>> values, (a, _, c, _, e, f) = delone.rasterize(corners, heights, shape=(2, 4), method="natural")
    >>> rows, columns = values.shape
    >>> extent = (c, c + a * columns, f + e * rows, f)
    >>> extent
    (0.0, 4.0, 0.0, 4.0)
    """
    as_xarray = as_flag(as_xarray, "as_xarray")
    method_ = as_choice(method, ("linear", "sibson", "natural", "laplace", "nearest"), "method")
    method_ = "sibson" if method_ == "natural" else method_
    kind = np.dtype(dtype)
    if kind.kind != "f" or kind.itemsize > 8:
        raise TypeError(f"dtype must be float64 or float32, not {kind}; round and convert the result for integers")
    if cell is None:
        if shape is None:
            raise ValueError("where are the cells? give transform and shape, or shape alone, or cell")
        rows, columns = _shape(shape)
    elif transform is not None or shape is not None:
        raise ValueError("cell is instead of transform and shape")
    sheet, mask, heights, at = _sheet(points, z, duplicates)
    if isinstance(sheet, _delone.Constrained) and method_ != "linear":
        raise ValueError(f'method must be "linear" for a ConstrainedDelaunay, not {method_!r}')
    longest = as_longest(max_edge, max_edge_anywhere)
    if cell is None:
        a, c, e, f = _spread(at, rows, columns) if transform is None else _transform(transform)
        values, xs, ys, _, _ = _delone.paint(sheet, method_, heights, (c, f, a, e), (columns, rows), None, mask, longest)
        made: Transform = (a, 0.0, c, 0.0, e, f)
    else:
        if not len(at):
            raise ValueError("no points, so no cells; give transform and shape for an empty raster")
        size = float(cell)
        place = (*at.min(axis=0).tolist(), *at.max(axis=0).tolist())
        values, xs, ys, corner, step = _delone.paint(sheet, method_, heights, place, (0, 0), size, mask, longest)
        made = (step[0], 0.0, corner[0], 0.0, step[1], corner[1])
    if not np.isnan(nodata):
        values[np.isnan(values)] = nodata
    with np.errstate(over="ignore", under="ignore"):
        values = values.astype(kind, copy=False)
    if as_xarray:
        return _to_xarray(values, xs, ys, made, nodata)
    return (values, made) if transform is None else values


def _to_xarray(
    values: NDArray[Any], xs: NDArray[np.float64], ys: NDArray[np.float64], transform: Transform, nodata: float
) -> Any:
    try:
        import xarray
    except ImportError as error:
        raise ImportError("as_xarray needs the package xarray: pip install xarray") from error
    attributes = {"transform": transform, "nodata": nodata}
    return xarray.DataArray(values, coords={"y": ys, "x": xs}, dims=("y", "x"), attrs=attributes)


class ContourLine(NamedTuple):
    """A line at one height, as shapely and GeoPandas take it: it has a `__geo_interface__`."""

    level: float
    """The height."""
    points: NDArray[np.float64]
    """The points, (k, 2), with the higher ground on the left. A closed line ends where it begins."""

    @property
    def is_closed(self) -> bool:
        """Whether it ends where it begins; others go from border to border."""
        return bool((self.points[0] == self.points[-1]).all())

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A LineString of GeoJSON."""
        return {"type": "LineString", "coordinates": self.points.tolist()}


class ContourBand(NamedTuple):
    """The area between two heights, as shapely and GeoPandas take it: it has a `__geo_interface__`."""

    lower: float
    """The lower height, which belongs to it; -inf below the first level."""
    upper: float
    """The upper height, which belongs to the next one; inf above the last level."""
    polygons: list[list[NDArray[np.float64]]]
    """Of each polygon a ring around it, counter-clockwise, then its holes, clockwise: (k, 2), the last point being the first."""

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A MultiPolygon of GeoJSON."""
        return {"type": "MultiPolygon", "coordinates": [[ring.tolist() for ring in rings] for rings in self.polygons]}


def contours(
    points: ArrayLike | Delaunay | ConstrainedDelaunay,
    z: ArrayLike | None = None,
    levels: ArrayLike | None = None,
    interval: float | None = None,
    base: float = 0.0,
    bands: bool = False,
    max_edge: float | None = None,
    duplicates: Rule = "lowest",
    *,
    max_edge_anywhere: float | None = None,
) -> list[Any]:
    """Lines of equal height, or the areas between them, of the surface that is linear in triangles.

    A point at a level counts as above it, so that lines never branch and never cross. Lines and areas fit each other exactly.

    Parameters
    ----------
    points : array_like of shape (n, 2), or Delaunay, or ConstrainedDelaunay
        The points, or their triangulation; of a constrained one the triangles inside count.
    z : array_like of shape (n,)
        The heights, which must be finite. Without it points have the shape (n, 3), and the third column is heights.
    levels : array_like of floats
        The heights of lines, in any order.
    interval, base : floats
        Instead of levels: lines at `base` and all that is multiples of `interval` away from it.
    bands : bool
        Whether the areas below, between and above the levels are wanted instead of lines.
    max_edge : float, optional
        Triangles with a longer edge are left out, from the hull inwards: gaps in the middle stay filled.
    max_edge_anywhere : float, optional
        Instead: triangles with a longer edge are left out wherever they are.
    duplicates : "lowest", "first", "highest" or "mean"
        Which height a place has at which there are several points.

    Returns
    -------
    list of ContourLine
        Pairs (level, points), by level.
    list of ContourBand
        With `bands`: triples (lower, upper, polygons), by height.

    Examples
    --------
    A pyramid.

    >>> import delone
    >>> corners = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]]
    >>> [(level, line)] = delone.contours(corners, [0, 0, 0, 0, 2], levels=[1])
    >>> level, line.tolist()
    (1.0, [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0], [1.0, 1.0]])
    >>> below, above = delone.contours(corners, [0, 0, 0, 0, 2], levels=[1], bands=True)
    >>> below.upper, [len(rings) for rings in below.polygons]
    (1.0, [2])
    """
    if (levels is None) == (interval is None):
        raise ValueError("give either levels, or interval with base")
    bands = as_flag(bands, "bands")
    given = None if levels is None else np.atleast_1d(as_numbers(levels, "levels")).astype(np.float64)
    if given is not None and given.ndim > 1:
        raise ValueError(f"levels must be a number or a list of numbers, not an array of the shape {given.shape}")
    longest = as_longest(max_edge, max_edge_anywhere)
    sheet, mask, heights, _ = _sheet(points, z, duplicates)
    wanted = (
        None if given is None else given.tolist(),
        0.0 if interval is None else float(interval),
        float(base),
        longest,
    )
    if bands:
        between, corners, rings, polygons, starts = _delone.contour_bands(sheet, heights, wanted, mask)
        parts = [_closed(ring) for ring in _cut(corners, rings)]
        whole = [parts[i:j] for i, j in zip(polygons[:-1].tolist(), polygons[1:].tolist(), strict=True)]
        each = zip(between.tolist(), starts[:-1].tolist(), starts[1:].tolist(), strict=True)
        return [ContourBand(lower, upper, whole[i:j]) for (lower, upper), i, j in each]
    heights_of, corners, starts, closed = _delone.contour_lines(sheet, heights, wanted, mask)
    lines = zip(heights_of.tolist(), _cut(corners, starts), closed.tolist(), strict=True)
    return [ContourLine(level, _closed(line) if is_closed else line) for level, line, is_closed in lines]


class Simplified(NamedTuple):
    """What is left of points with heights."""

    indices: NDArray[np.int64]
    """The points left, by index: corners of the hull, ends of segments and where they meet, then the others as chosen."""
    triangles: NDArray[np.int32]
    """The triangles between them, (m, 3), counter-clockwise, by the rows of `indices`."""
    error: float
    """The largest distance in height of any point given from the triangles."""


def simplify(
    points: ArrayLike,
    z: ArrayLike,
    max_error: float | None = None,
    max_points: int | None = None,
    segments: ArrayLike | None = None,
) -> Simplified:
    """Few of many points with heights, such that the triangles of these few are nowhere far from any of the others.

    Greedy insertion: the corners of the hull first, then round after round the point of each triangle that is furthest off in
    height, or with `max_points` always the furthest of all; when none is too far off, points that later ones made superfluous
    go. The result does not depend on the order of the points, nor on threads. O(log n) for each point that is chosen, and the
    points in its star.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        The points. Of equal points the first counts.
    z : array_like of shape (n,)
        The heights, which must be finite.
    max_error : float, optional
        How far the height of a point may be from the triangles, in the units of heights; 0 if there is `max_points` alone.
    max_points : int, optional
        How many points to stop at. The corners of the hull and the ends of segments stay, be they more.
    segments : array_like of integers, shape (m, 2), optional
        Pairs of indices of points; they are edges of what is left.

    Examples
    --------
    A roof: its ridge and its corners are all of it.

    >>> import delone, numpy as np
    >>> x, y = (axis.ravel() for axis in np.meshgrid(np.arange(5.0), np.arange(5.0)))
    >>> roof = delone.simplify(np.column_stack([x, y]), 2 - abs(x - 2), max_error=1e-9)
    >>> len(roof.indices), len(roof.triangles), roof.error
    (6, 4, 0.0)
    """
    if max_error is None and max_points is None:
        raise ValueError("how far? give max_error, max_points or both")
    if max_points is not None:
        max_points = as_index(max_points, "max_points")
        if max_points < 0:
            raise ValueError(f"max_points must not be negative, but is {max_points}")
        max_points = min(max_points, 2**62)
    at = as_points(points, columns=2)
    heights = as_heights(z, len(at))
    ends = as_segments(segments, len(at))
    return Simplified(*_delone.thin(at, heights, ends, 0.0 if max_error is None else float(max_error), max_points))


def _sheet(
    points: ArrayLike | Delaunay | ConstrainedDelaunay, z: ArrayLike | None, rule: Rule
) -> tuple[_delone.Triangulation | _delone.Constrained, NDArray[np.bool_] | None, NDArray[np.float64], NDArray[np.float64]]:
    """A triangulation, which of its triangles count, heights and points."""
    rule_ = as_choice(rule, ("lowest", "first", "highest", "mean"), "duplicates")
    if z is None:
        if isinstance(points, (Delaunay, ConstrainedDelaunay)):
            raise ValueError("z is missing: a triangulation has no heights")
        columns = np.asarray(points)
        if columns.ndim != 2 or columns.shape[1] != 3:
            raise ValueError(f"z is missing: give it, or points of the shape (n, 3), not {columns.shape}")
        points, z = columns[:, :2], columns[:, 2]
    if isinstance(points, ConstrainedDelaunay):
        mask = None if points.fill == "all" else np.ascontiguousarray(points.inside)
        return points._core, mask, _settled(points._core, as_heights(z, points.npoints), rule_), points.points
    if not isinstance(points, Delaunay):
        at = as_points(points, columns=2)
        heights = as_heights(z, len(at))
        core = Delaunay(at)._core
        return core, None, _settled(core, heights, rule_), at
    if points.furthest_site:
        raise ValueError("heights need a triangulation of nearest sites, not of furthest ones")
    if points.ndim != 2:
        raise ValueError("heights are at points of the plane: give x and y as points, and the heights as z")
    return points._core, None, _settled(points._core, as_heights(z, points.npoints), rule_), points.points


def _settled(core: _delone.Triangulation | _delone.Constrained, heights: NDArray[np.float64], rule: str) -> NDArray[np.float64]:
    """Heights of vertices, where points equal these."""
    pairs = core.duplicates()
    return _delone.settled(heights, pairs, rule) if len(pairs) else heights


def as_heights(z: ArrayLike, count: int) -> NDArray[np.float64]:
    array = as_numbers(z, "z")
    if array.shape != (count,):
        raise ValueError(f"z must have the shape ({count},), a height for each point, not {array.shape}")
    with np.errstate(over="ignore", under="ignore"):
        result: NDArray[np.float64] = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    known = np.isfinite(result)
    if not known.all():
        index = int(np.argmin(known))
        raise ValueError(f"z: point {index} has the height {result[index]}; leave out the points that have none")
    return result


def _transform(transform: Sequence[float]) -> tuple[float, float, float, float]:
    """The steps and the corner: a, c, e, f. An Affine has three more numbers, of its last row."""
    numbers = [float(x) for x in transform]
    if len(numbers) not in (6, 9) or numbers[6:] not in ([], [0.0, 0.0, 1.0]):
        raise ValueError(f"transform must be an affine.Affine or six numbers (a, b, c, d, e, f), not {transform!r}")
    a, b, c, d, e, f = numbers[:6]
    if b or d:
        order = "GDAL's order (c, a, b, f, d, e) differs"
        raise ValueError(f"transform must not rotate: b and d must be 0, not {b} and {d}; {order}")
    return a, c, e, f


def _spread(points: NDArray[np.float64], rows: int, columns: int) -> tuple[float, float, float, float]:
    """The steps and the corner of cells that share the box of points, as `_transform` has them."""
    if not len(points) or not rows or not columns:
        raise ValueError("no box to share: give transform and shape for an empty raster")
    (west, south), (east, north) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return (east - west) / columns, west, (south - north) / rows, north


def _shape(shape: tuple[int, int]) -> tuple[int, int]:
    if not isinstance(shape, Sequence) or len(shape) != 2:
        raise ValueError(f"shape must be (rows, columns), not {shape!r}")
    rows, columns = (as_index(n, "a number of cells") for n in shape)
    if min(rows, columns) < 0 or rows * columns >= 2**62:
        raise ValueError(f"shape must be (rows, columns), not negative and less than 2**62 cells, not {shape!r}")
    return rows, columns


def as_longest(max_edge: float | None, max_edge_anywhere: float | None) -> tuple[float, bool] | None:
    """The longest edge that triangles may have, and whether longer ones go wherever they are."""
    if max_edge is not None and max_edge_anywhere is not None:
        raise ValueError("give max_edge or max_edge_anywhere, not both")
    for name, value in (("max_edge", max_edge), ("max_edge_anywhere", max_edge_anywhere)):
        if value is not None:
            number = float(value)
            if not number > 0:
                raise ValueError(f"{name} must be positive, not {value!r}")
            return number, name == "max_edge_anywhere"
    return None


def _cut(rows: NDArray[np.float64], starts: NDArray[np.int64]) -> list[NDArray[np.float64]]:
    return [rows[i:j] for i, j in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True)]


def _closed(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.concatenate([ring, ring[:1]])
