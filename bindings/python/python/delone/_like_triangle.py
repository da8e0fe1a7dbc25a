"""From the dictionaries of the package `triangle` to a mesh, and back.

Attributes of new vertices are linear on the triangulation of what was given, or on the mesh that is refined; so they are a
function of the place. Cost: a location for each new vertex.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._constrained import ConstrainedDelaunay
from ._points import as_numbers, as_points, as_segments
from ._sides import all_edges, keys_of, pairs_of, rows_of, set_apart, sides_of
from ._switches import Switches
from ._wishes import PLAIN, Test, Wishes

_KEYS = (
    *("vertices", "vertex_attributes", "vertex_markers"),
    *("triangles", "triangle_attributes", "triangle_max_area"),
    *("segments", "segment_markers", "holes", "regions"),
    *("neighbors", "edges", "edge_markers"),
)

#: The columns that seeds may have; there are as many as in the last of these.
_SEEDS = {"holes": (2,), "regions": (3, 4)}
_NO_HOLES, _NO_REGIONS = np.empty((0, 2)), np.empty((0, 4))

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass
class Given:
    """What a dictionary describes, as far as switches want it."""

    vertices: Floats
    vertex_attributes: Floats
    vertex_markers: Ints
    segments: Ints
    segment_markers: Ints
    holes: Floats
    regions: Floats
    #: Holes and regions as they were given, for the result.
    seeds: dict[str, Floats]
    #: Of the mesh that is refined; none if there is none.
    triangles: Ints
    triangle_attributes: Floats
    triangle_areas: Floats | None

    @classmethod
    def of(cls, tri: Mapping[str, ArrayLike], switches: Switches) -> Given:
        """Reads and checks it."""
        unknown = [key for key in tri if key not in _KEYS]
        if unknown:
            raise KeyError(f"{unknown[0]!r} is none of the keys {', '.join(_KEYS)}")
        vertices = as_points(tri.get("vertices", np.empty((0, 2))), "vertices", 2)
        n = len(vertices)
        if n < 3:
            raise ValueError(f"vertices: there must be at least three, not {n}")
        segments = as_segments(tri.get("segments"), n) if switches.poly else np.empty((0, 2), np.int64)
        m = len(segments)
        markers = tri.get("segment_markers") if switches.poly else None
        areas, triangles = None, np.empty((0, 3), np.int64)
        if switches.refine:
            triangles = _triangles(tri, n)
            if switches.areas and "triangle_max_area" in tri:
                areas = _rows(tri, "triangle_max_area", len(triangles))[:, 0]
                areas = np.where(areas > 0, areas, np.inf)
        seeds = {key: _seeds(tri[key], key) for key in _SEEDS if key in tri} if switches.poly else {}
        holes = _NO_HOLES if switches.no_holes else seeds.get("holes", _NO_HOLES)
        return cls(
            vertices,
            _rows(tri, "vertex_attributes", n),
            _markers(tri.get("vertex_markers"), "vertex_markers", n),
            segments,
            _markers(markers, "segment_markers", m),
            holes,
            seeds.get("regions", _NO_REGIONS),
            seeds,
            triangles,
            _rows(tri, "triangle_attributes", len(triangles)) if switches.refine else np.empty((0, 0)),
            areas,
        )


def _rows(tri: Mapping[str, ArrayLike], key: str, count: int) -> Floats:
    """Numbers for so many; one row each."""
    if key not in tri:
        return np.empty((count, 0))
    array = as_numbers(tri[key], key)
    array = array.reshape(-1, 1) if array.ndim == 1 else array
    if array.ndim != 2 or len(array) != count or (key == "triangle_max_area" and array.shape[1] != 1):
        raise ValueError(f"{key} must have a row for each of {count}; its shape is {array.shape}")
    return array.astype(np.float64)


def _markers(values: ArrayLike | None, key: str, count: int) -> Ints:
    if values is None:
        return np.zeros(count, np.int64)
    array = as_numbers(values, key)
    if array.size != count or array.ndim not in (1, 2):
        raise ValueError(f"{key} must have one number for each of {count}; its shape is {array.shape}")
    if array.size and (np.abs(array.astype(np.float64)) >= 2**31).any():
        raise ValueError(f"{key} holds numbers of more than 32 bits")
    return array.astype(np.int64).ravel()


def _seeds(values: ArrayLike, key: str) -> Floats:
    array, columns = as_numbers(values, key), _SEEDS[key]
    array = array.reshape(0, columns[0]) if array.shape == (0,) else array
    if array.ndim != 2 or array.shape[1] not in columns:
        raise ValueError(f"{key} must have {' or '.join(map(str, columns))} columns; the shape is {array.shape}")
    places = as_points(array[:, :2], key, 2)
    rest = array[:, 2:].astype(np.float64)
    return np.column_stack([places, rest, np.zeros((len(array), columns[-1] - array.shape[1]))])


def _triangles(tri: Mapping[str, ArrayLike], count: int) -> Ints:
    """The corners of a mesh to refine."""
    if "triangles" not in tri:
        raise ValueError("switch r: there are no triangles to refine")
    array = as_numbers(tri["triangles"], "triangles")
    if array.ndim != 2 or array.shape[1] not in (3, 6) or (array.dtype.kind not in "iu" and array.size):
        raise ValueError(f"triangles must have 3 or 6 integers each, not {array.dtype} of the shape {array.shape}")
    corners = array[:, :3].astype(np.int64)
    if corners.size and not 0 <= corners.min() <= corners.max() < count:
        row = int(np.argmax(((corners < 0) | (corners >= count)).any(axis=1)))
        raise ValueError(f"triangle {row} has the corners {corners[row].tolist()}, and there are {count} vertices")
    return corners


class Made(NamedTuple):
    """The mesh of what was given."""

    core: _delone.Mesh
    #: For each of its segments that which was given, or -1 or `BETWEEN`; None if they are the same.
    origins: Ints | None
    #: What was there before.
    old: Old
    #: The attributes of its regions.
    of_regions: Floats


def refined(given: Given, switches: Switches, refine_if: Test | None) -> Made:
    """The mesh that switches want."""
    if switches.refine:
        return _refined_again(given, switches, refine_if)
    old = Old(given)
    wishes = _wishes(switches, "seeds" if switches.poly else "all", refine_if)
    wishes["holes"] = np.ascontiguousarray(old.inside(given.holes))
    # Of two in one part the last one counts.
    regions = old.inside(given.regions)[::-1]
    if len(regions):
        areas = regions[:, 3] if switches.areas else np.zeros(len(regions))
        wishes["regions"] = np.column_stack([regions[:, :2], np.where(areas > 0, areas, np.inf)])
    return Made(_delone.Mesh(given.vertices, given.segments, True, wishes), None, old, regions[:, 2])


def _refined_again(given: Given, switches: Switches, refine_if: Test | None) -> Made:
    """The triangles that were given stay until a vertex comes near; where they overlap they are made anew, with a warning."""
    old = Old(given)
    is_kept = _once_with_area(given)
    triangles = np.ascontiguousarray(given.triangles[is_kept])
    attributes = given.triangle_attributes
    segments, origins = sides_of(triangles, given.segments, attributes[is_kept] if attributes.size else attributes)
    wishes = _wishes(switches, "even-odd", refine_if)
    if given.triangle_areas is not None:
        wishes["of"] = old.triangulation._core
        wishes["max_areas"] = np.append(given.triangle_areas, np.inf)[old.rows]
    vertices = set_apart(given.vertices, np.concatenate([triangles.ravel(), given.segments.ravel()]))
    try:
        core = _delone.Mesh(vertices, segments, True, {**wishes, "triangles": triangles})
    except ValueError as error:
        if not str(error).startswith("triangle "):
            raise
        warnings.warn(f"{error}: all triangles are made anew", stacklevel=4)
        core = _delone.Mesh(vertices, segments, True, wishes)
    return Made(core, origins, old, np.empty(0))


def _once_with_area(given: Given) -> NDArray[np.bool_]:
    """Which triangles have corners that are not exactly on a line, and are there for the first time. Triangle leaves others, and
    they hold nothing."""
    corners = given.vertices[given.triangles]
    (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    first = rows_of(given.triangles, given.triangles) == np.arange(len(given.triangles))
    return np.asarray((ux * vy != uy * vx) & first)


def _wishes(switches: Switches, fill: str, refine_if: Test | None) -> Wishes:
    return {
        **PLAIN,
        "fill": fill,
        "keep_concavities": switches.convex and fill == "seeds",
        "min_angle": switches.min_angle,
        "max_area": switches.max_area,
        "max_vertices": switches.max_vertices,
        "keep": ("nothing", "border", "constraints")[min(switches.keep, 2)],
        "conforming": switches.conforming,
        "refine_if": refine_if,
    }


class Old:
    """A triangulation of what was given, on which attributes are linear; made if it is needed."""

    def __init__(self, given: Given) -> None:
        """Of what was given."""
        self._given = given

    @cached_property
    def triangulation(self) -> ConstrainedDelaunay:
        """With the segments, and with all edges of a mesh that is refined."""
        own = self._given.segments
        if len(self._given.triangles):
            own = pairs_of(np.unique(keys_of(np.concatenate([all_edges(self._given.triangles), np.sort(own, axis=1)]))))
        return ConstrainedDelaunay(self._given.vertices, own, crossings="split")

    @cached_property
    def _first(self) -> Ints:
        """For each vertex the first one that equals it."""
        first = np.arange(len(self._given.vertices))
        pairs = self.triangulation.duplicates
        first[pairs[:, 0]] = pairs[:, 1]
        return first

    @cached_property
    def rows(self) -> Ints:
        """For each triangle the one that was given, or their number where none was."""
        given = self._first[self._given.triangles]
        rows = rows_of(self.triangulation.all_triangles.astype(np.int64), given)
        return np.where(rows < 0, len(given), rows)

    def inside(self, seeds: Floats) -> Floats:
        """Those that are in the hull; Triangle does not mind others."""
        return seeds[self.triangulation.find_simplex(seeds[:, :2]) >= 0] if len(seeds) else seeds

    def rows_at(self, places: Floats) -> Ints:
        """The triangles that were given at places; their number for none."""
        return np.append(self.rows, len(self._given.triangles))[self.triangulation.find_simplex(places)]

    def attributes(self, points: Floats) -> Floats:
        """Attributes of all points, of which the first ones have them already."""
        known = self._given.vertex_attributes
        count = known.shape[1]
        if not count:
            return np.empty((len(points), 0))
        all_points, triangles = self.triangulation.points, self.triangulation.all_triangles
        at_crossings = self._at_crossings(all_points[len(known) :])
        values = np.concatenate([known, at_crossings])
        new = points[len(known) :]
        found = self.triangulation.find_simplex(new)
        if not len(new):
            return known
        weights = _barycentric(all_points[triangles[found]], new)
        linear = np.einsum("pk,pkc->pc", weights, values[triangles[found]])
        outside = found < 0
        if outside.any():
            # Rounded, a point of the border may be.
            linear[outside] = self._along_hull(new[outside], values)
        return np.concatenate([known, linear])

    def _at_crossings(self, points: Floats) -> Floats:
        """Linear along the first segment that has a point there."""
        known = self._given.vertex_attributes
        values = np.zeros((len(points), known.shape[1]))
        is_known, first = np.zeros(len(points), bool), len(known)
        if not len(points):
            return values
        for segment, (a, b) in enumerate(self._given.segments.tolist()):
            chain = self.triangulation.chain(segment) if self._first[a] != self._first[b] else np.empty(0, np.int64)
            inner = chain[chain >= first]
            inner = inner[~is_known[inner - first]]
            values[inner - first] = _along(self.triangulation.points[inner], self.triangulation.points[[a, b]], known[[a, b]])
            is_known[inner - first] = True
        return values

    def _along_hull(self, points: Floats, values: Floats) -> Floats:
        """Linear along the nearest edge of the hull."""
        hull, all_points = self.triangulation.convex_hull, self.triangulation.points
        result = np.empty((len(points), values.shape[1]))
        for row, p in enumerate(points):
            a, b = all_points[hull[:, 0]], all_points[hull[:, 1]]
            part = np.clip(((p - a) * (b - a)).sum(axis=1) / ((b - a) ** 2).sum(axis=1), 0, 1)
            nearest = int(np.argmin(((a + part[:, None] * (b - a) - p) ** 2).sum(axis=1)))
            u, v = hull[nearest]
            result[row] = values[u] + part[nearest] * (values[v] - values[u])
        return result


def arrays_of(given: Given, switches: Switches, made: Made) -> dict[str, NDArray[Any]]:
    """What switches want of the mesh; nothing that is empty."""
    attributes = np.ascontiguousarray(made.old.attributes(made.core.points())) if given.vertex_attributes.size else None
    found: dict[str, NDArray[Any]] = made.core.like_triangle(
        switches, given.vertex_markers, given.segments, given.segment_markers, made.origins, attributes
    )
    if switches.refine and not switches.jettison and "vertices" in found:
        found["vertices"][: len(given.vertices)] = given.vertices
    more = {} if switches.no_triangles else {"triangle_attributes": _triangle_attributes(given, switches, made)}
    if switches.poly and not switches.no_segments:
        more |= given.seeds
    return found | {key: array for key, array in more.items() if array.size}


def _triangle_attributes(given: Given, switches: Switches, made: Made) -> Floats:
    """Those of regions, or of the triangles that were there at the centroids."""
    if switches.refine and given.triangle_attributes.size:
        known = given.triangle_attributes
        centroids = made.core.points()[made.core.arrays()[0]].mean(axis=1)
        # Rounded, one may be outside of all.
        return np.concatenate([known, np.zeros((1, known.shape[1]))])[made.old.rows_at(centroids)]
    if switches.refine or not switches.attributes or not len(given.regions):
        return np.empty((0, 0))
    return np.asarray(np.nan_to_num(np.append(made.of_regions, 0.0)[made.core.regions(), None]))


def _along(points: Floats, ends: Floats, values: Floats) -> Floats:
    step = ends[1] - ends[0]
    part = np.clip((points - ends[0]) @ step / (step @ step), 0, 1)
    return np.asarray(values[0] + part[:, None] * (values[1] - values[0]))


def _barycentric(corners: Floats, points: Floats) -> Floats:
    """Of points in triangles, not negative, with the sum 1."""
    a, b, c = (corners[:, k] - points for k in range(3))
    twice = np.column_stack(
        [b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0], c[:, 0] * a[:, 1] - c[:, 1] * a[:, 0], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]]
    )
    twice = np.maximum(twice, 0)
    total = twice.sum(axis=1, keepdims=True)
    return np.asarray(np.divide(twice, total, out=np.full_like(twice, 1 / 3), where=total > 0))
