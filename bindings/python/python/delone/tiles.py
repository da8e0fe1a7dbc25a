"""More points than memory: tiles, the same triangles to the last tie as in memory.

Cut the plane into regions, triangulate the points of each region by themselves, and join what is undecided:

    cuts = tiles.Cuts(sample, 128)
    for node in cuts.nodes:
        tile = tiles.triangulate(its_points, cuts.region(node), node=node)      # on any machine
    seam = tiles.join([tile.border, ...], cuts.region(1))

All of it pickles, and runs in Rust without Python's lock. `delone.dask` and `delone.spark` do it on clusters.

From files to a folder of files, as the program does it, and resumable: `build`, and `open` for what is there.

    store = tiles.build("survey.laz", "tiles", memory="4G", heights=True)
    points, triangles = store.window((500, 900, 600, 1000))
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._delone import Border, Fingerprint
from ._points import as_index, as_numbers, as_points
from ._store import Store, Summary, build
from ._store import open_folder as open

__all__ = [
    "PLANE",
    "Border",
    "Cuts",
    "Fingerprint",
    "Region",
    "Seam",
    "Store",
    "Summary",
    "Tile",
    "build",
    "fingerprint",
    "join",
    "open",
    "triangulate",
]

Region = tuple[tuple[float, float], tuple[float, float]]
"""The least corner of a box, inside, and the greatest, outside. They may be infinite."""

PLANE: Region = ((-np.inf, -np.inf), (np.inf, np.inf))
"""The region of all points."""


class Cuts:
    """A tree of cuts of the plane, by x or by y: node 1 is the plane, and node k is cut into nodes 2 k and 2 k + 1.

    Parameters
    ----------
    sample : array_like of shape (n, 2)
        Some of the points, taken at random: tiles get equally many of them. A million is much.
    tiles : int
        How many tiles there should be at the most. Where equal points are many there are fewer.

    Examples
    --------
    >>> import numpy as np
    >>> from delone import tiles
    >>> cuts = tiles.Cuts(np.random.default_rng(1).random((1000, 2)), 4)
    >>> cuts.nodes, cuts.parts(1)
    ([4, 5, 6, 7], [4, 5, 6, 7])
    >>> int(cuts.tile_of([[0.1, 0.1]])[0])
    4
    """

    def __init__(self, sample: ArrayLike, tiles: int) -> None:
        """As the class says."""
        count = as_index(tiles, "tiles")
        if count < 1:
            raise ValueError(f"tiles must be at least 1, not {count}")
        self._core = _delone.Cuts.from_sample(as_points(sample, "sample", 2), count)

    @classmethod
    def from_cuts(cls, cuts: Iterable[tuple[int, int, float]]) -> Cuts:
        """From nodes, axes (0: x, 1: y) and places of cuts, as `cuts` has them. Raises ValueError for what is no tree of cuts."""
        made = cls.__new__(cls)
        made._core = _delone.Cuts.from_cuts([(int(node), int(axis), float(at)) for node, axis, at in cuts])
        return made

    @property
    def cuts(self) -> list[tuple[int, int, float]]:
        """Node, axis and place of each cut, by node. A point is in the lesser half if its coordinate is less than the place."""
        return self._core.cuts()

    @property
    def nodes(self) -> list[int]:
        """The nodes that are tiles."""
        return self._core.tiles()

    def tile_of(self, points: ArrayLike) -> NDArray[np.uint32]:
        """The node of the tile that each point is in. O(log k) a point, for k tiles."""
        return self._core.tile_of(as_points(points, "points", 2))

    def region(self, node: int) -> Region:
        """The region of a node."""
        low, high = self._core.region(as_index(node, "node"))
        return (low[0], low[1]), (high[0], high[1])

    def parts(self, node: int = 1, levels: int = 32) -> list[int]:
        """The nodes some levels below a node, or the tiles above: all together they are its region. None for a tile."""
        return self._core.parts(as_index(node, "node"), as_index(levels, "levels"))

    def __len__(self) -> int:
        """The number of tiles."""
        return len(self.nodes)

    def __repr__(self) -> str:
        """Its number of tiles."""
        return f"<Cuts into {len(self)} tiles>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Its cuts."""
        return type(self).from_cuts, (self.cuts,)


@dataclass(frozen=True, eq=False)
class Tile:
    """The triangulation of the points of a region, and what of it is final."""

    points: NDArray[np.float64]
    """The vertices, shape (v, 2), along a curve: what is near in the plane is near in the array."""
    order: NDArray[np.int64]
    """For each vertex the row of its point in the input; of equal points the first."""
    triangles: NDArray[np.uint32]
    """The triangles that no point outside of the region can change, shape (t, 3): rows of `points`, counter-clockwise."""
    duplicates: NDArray[np.int64]
    """The rows of input points that equal an earlier one, and the rows of these, shape (k, 2)."""
    fingerprint: Fingerprint
    """That of `triangles`."""
    border: Border
    """What is still to be decided, for `join`."""


@dataclass(frozen=True, eq=False)
class Seam:
    """What joining borders decides, and what it leaves."""

    triangles: NDArray[np.uint64]
    """The triangles that are final now and were not before, shape (t, 3): ids of borders, counter-clockwise."""
    fingerprint: Fingerprint
    """That of `triangles`."""
    border: Border
    """What is still to be decided; of the plane the hull, and nothing is open."""


def _sides(region: Sequence[Sequence[float]], what: str = "region") -> list[list[float]]:
    sides = as_numbers(region, what)
    if sides.shape != (2, 2):
        raise ValueError(
            f"{what} must be the least and the greatest corner of a box, ((x, y), (x, y)), not of shape {sides.shape}"
        )
    if np.isnan(sides).any():
        raise ValueError(f"{what} has a side that is NaN")
    listed: list[list[float]] = sides.astype(np.float64).tolist()
    return listed


def triangulate(
    points: ArrayLike, region: Sequence[Sequence[float]] = PLANE, *, node: int = 1, ids: ArrayLike | None = None
) -> Tile:
    """Triangulates the points of a region: all that are in it.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        All points of the region.
    region : ((x, y), (x, y))
        Its corners, as `Cuts.region` gives them.
    node : int
        The node of the tile: the border names vertex k of it `node << 32 | k`.
    ids : array_like of n integers, optional
        Names for the points by which borders and seams shall know them instead, from 0 to 2**64 - 1.

    Raises
    ------
    ValueError
        For points that are not in the region, or no numbers.

    Examples
    --------
    >>> import numpy as np
    >>> from delone import tiles
    >>> points = np.random.default_rng(1).random((10_000, 2))
    >>> cuts = tiles.Cuts(points, 4)
    >>> own = cuts.tile_of(points)
    >>> made = []
    >>> for node in cuts.nodes:
    ...     rows = np.flatnonzero(own == node)
    ...     made.append(tiles.triangulate(points[rows], cuts.region(node), ids=rows))
    >>> seam = tiles.join([tile.border for tile in made])
    >>> total = sum((tile.fingerprint for tile in made), seam.fingerprint)
    >>> import delone
    >>> total == tiles.fingerprint(points, delone.Delaunay(points).simplices)
    True
    """
    array = as_points(points, "points", 2)
    sides = _sides(region)
    if ids is None:
        made = _delone.triangulate_tile(array, sides, as_index(node, "node"))
    else:
        names = as_numbers(ids, "ids")
        if names.dtype.kind not in "iu" and names.size:
            raise TypeError(f"ids must be integers, not {names.dtype}")
        if names.shape != (len(array),):
            raise ValueError(f"ids must have the shape ({len(array)},), one for each point, not {names.shape}")
        if names.size and names.dtype.kind == "i" and names.min() < 0:
            raise ValueError("ids must not be negative")
        made = _delone.triangulate_tile(array, sides, np.ascontiguousarray(names, dtype=np.uint64))
    return Tile(*made)


def join(borders: Iterable[Border], region: Sequence[Sequence[float]] = PLANE) -> Seam:
    """Joins the borders of parts that make a region: of all its tiles, of its halves, or of whatever it is cut into.

    Each part is there once, whole, also if it has no point. O(b log b) for b points of borders.

    Raises
    ------
    ValueError
        For borders with a point outside of the region, or with one that another border has.
    """
    return Seam(*_delone.join_borders(list(borders), _sides(region)))


def fingerprint(points: ArrayLike, triangles: ArrayLike) -> Fingerprint:
    """The fingerprint of a set of triangles: the same whatever their order, that of their corners, and the program they are from.

    Fingerprints of disjoint sets add up. As text it is what `delone triangulate --fingerprint` prints.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Coordinates.
    triangles : array_like of shape (t, 3)
        Rows of points.
    """
    rows = as_numbers(triangles, "triangles")
    if rows.ndim != 2 or rows.shape[1] != 3 or rows.dtype.kind not in "iu":
        raise ValueError(f"triangles must be integers of shape (t, 3), not {rows.dtype} of shape {rows.shape}")
    return Fingerprint.of(as_points(points, "points", 2), np.ascontiguousarray(rows, dtype=np.int64))
