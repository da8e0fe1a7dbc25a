"""Triangulation of more points than one memory holds, on Dask: a map over tiles and a tree of joins.

    import dask.array as da
    import delone.dask

    points = da.from_zarr("survey.zarr")                    # shape (n, 2); or delone.dask.from_las(["a.laz", "b.laz"])
    made = delone.dask.triangulate(points, tiles=64)
    made.triangles                                         # dask.array of shape (nan, 3): rows of points
    made.fingerprint.compute()

Works with whatever scheduler is set: a `dask.distributed.Client`, processes, or threads. What a worker loses is made again from
the points. Needs the package `dask`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import dask
import dask.array as da
import numpy as np
from dask.delayed import Delayed
from numpy.typing import NDArray

from . import tiles as _tiles
from ._points import as_index, as_points

__all__ = ["TiledTriangulation", "from_las", "triangulate"]

_SAMPLE = 1_000_000
_TILE = 1_000_000
_LEVELS = 4


@dataclass(frozen=True, eq=False)
class TiledTriangulation:
    """A triangulation that is still to be computed: all of it or a part."""

    cuts: _tiles.Cuts
    """The tiles."""
    triangles: da.Array
    """All triangles, shape (nan, 3), int64: rows of the points, counter-clockwise. A chunk for each tile, then for each seam."""
    tiles: dict[int, Delayed]
    """For each node that is a tile, the `delone.tiles.Tile` of its points; `order` has their rows."""
    seams: dict[int, Delayed]
    """For each node that joins others, the `delone.tiles.Seam`; its ids are rows of the points."""
    fingerprint: Delayed
    """The `delone.tiles.Fingerprint` of all triangles: computing it computes all of them, and keeps none."""


def triangulate(points: Any, tiles: int | None = None) -> TiledTriangulation:
    """Triangulates points that are in chunks: the same triangles as in one memory.

    The points are read for a sample and then put into tiles; also for their number, where chunks do not say it. The cuts are made
    at once, all else when it is computed.

    Parameters
    ----------
    points : dask.array of shape (n, 2), or array_like
        Chunks may have any number of rows, unknown ones too.
    tiles : int, optional
        How many tiles. Without it there are a million points in each, about.

    Raises
    ------
    ValueError
        For points of another shape; when computed, for coordinates that are not finite.

    Examples
    --------
    >>> import dask.array as da
    >>> import numpy as np
    >>> import delone
    >>> import delone.dask
    >>> points = np.random.default_rng(1).random((20_000, 2))
    >>> made = delone.dask.triangulate(da.from_array(points, chunks=(3000, 2)), tiles=8)
    >>> made.fingerprint.compute() == delone.tiles.fingerprint(points, delone.Delaunay(points).simplices)
    True
    """
    array = points if isinstance(points, da.Array) else da.from_array(as_points(points, "points", 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"points must have the shape (n, 2), not {array.shape}")
    # Chunks are made float64 where they are read: what is no number, and integers that are no float64, are refused there.
    array = array.rechunk({1: 2})
    chunks = list(array.to_delayed().ravel())
    sizes = array.chunks[0]
    if any(np.isnan(size) for size in sizes):
        sizes = dask.compute(*[dask.delayed(len)(chunk) for chunk in chunks])
    starts = np.cumsum([0, *sizes])
    total = int(starts[-1])
    wanted = max(1, -(-total // _TILE)) if tiles is None else as_index(tiles, "tiles")
    # Whatever the chunks are, a row is in the sample or is not.
    share = min(1.0, max(_SAMPLE, 100 * wanted) / max(total, 1))
    taken = dask.compute(*[dask.delayed(_sample)(chunk, int(start), share) for chunk, start in zip(chunks, starts, strict=False)])
    cuts = _tiles.Cuts(np.concatenate([np.empty((0, 2)), *taken]), wanted)
    nodes = cuts.nodes
    split = dask.delayed(_split, nout=len(nodes))
    parts = [split(chunk, int(start), cuts) for chunk, start in zip(chunks, starts, strict=False)]
    leaf = dask.delayed(_leaf)
    made = {node: leaf([part[k] for part in parts], cuts.region(node)) for k, node in enumerate(nodes)}
    borders = {node: dask.delayed(_border)(tile) for node, tile in made.items()}
    seams: dict[int, Delayed] = {}
    _join(cuts, 1, borders, seams)
    blocks = [dask.delayed(_of_tile)(tile) for tile in made.values()] + [dask.delayed(_of_seam)(seam) for seam in seams.values()]
    triangles = da.concatenate([da.from_delayed(block, (np.nan, 3), np.int64) for block in blocks], allow_unknown_chunksizes=True)
    prints = [dask.delayed(_print)(part) for part in [*made.values(), *seams.values()]]
    return TiledTriangulation(cuts, triangles, made, seams, dask.delayed(_sum)(prints))


def from_las(paths: str | Iterable[str], *, chunk: int = 5_000_000, classes: Iterable[int] | None = None) -> da.Array:
    """The points of LAS and LAZ files, one file after the other, in chunks that are read when they are computed.

    Parameters
    ----------
    paths : str or iterable of str
        The files; workers must find them under the same names.
    chunk : int
        Points in a chunk at the most.
    classes : iterable of int, optional
        Only points of these classes: 2 is ground. The numbers of rows are unknown then.

    Returns
    -------
    dask.array
        x and y in the units of the files, shape (n, 2). Needs the package `laspy` with a backend for LAZ.
    """
    import laspy

    wanted = None if classes is None else [as_index(number, "a class") for number in classes]
    blocks = []
    for path in [paths] if isinstance(paths, str) else paths:
        with laspy.open(path) as file:
            count = file.header.point_count
        for start in range(0, count, as_index(chunk, "chunk")):
            rows = min(chunk, count - start)
            block = dask.delayed(_from_las)(path, start, rows, wanted)
            blocks.append(da.from_delayed(block, (rows if wanted is None else np.nan, 2), np.float64))
    if not blocks:
        return da.empty((0, 2))
    return da.concatenate(blocks, allow_unknown_chunksizes=True)


def _from_las(path: str, start: int, count: int, classes: list[int] | None) -> NDArray[np.float64]:
    import laspy

    with laspy.open(path) as file:
        file.seek(start)
        points = file.read_points(count)
    if len(points) != count:
        raise ValueError(f"{path} ends after {start + len(points)} points, and its header says more")
    rows = slice(None) if classes is None else np.isin(points.classification, classes)
    return np.column_stack([points.x, points.y]).astype(np.float64)[rows]


def _join(cuts: _tiles.Cuts, node: int, borders: dict[int, Delayed], seams: dict[int, Delayed]) -> Delayed:
    """The border of a node, of up to 16 parts at once."""
    if node in borders:
        return borders[node]
    parts = [_join(cuts, part, borders, seams) for part in cuts.parts(node, _LEVELS)]
    seams[node] = dask.delayed(_tiles.join)(parts, cuts.region(node))
    return dask.delayed(_border)(seams[node])


def _sample(chunk: NDArray[np.float64], start: int, share: float) -> NDArray[np.float64]:
    rows = np.arange(start, start + len(chunk), dtype=np.uint64)
    # The hash of a row: a stride would meet the columns of a grid.
    rows = (rows ^ (rows >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    rows = (rows ^ (rows >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    chosen = (rows >> np.uint64(11)) < np.uint64(share * 2.0**53)
    return as_points(chunk, f"points from row {start} on", 2)[chosen if share < 1.0 else slice(None)]


def _split(chunk: NDArray[np.float64], start: int, cuts: _tiles.Cuts) -> list[tuple[NDArray[np.float64], NDArray[np.int64]]]:
    """The points of a chunk and their rows, for each tile."""
    points = as_points(chunk, f"points from row {start} on", 2)
    own = cuts.tile_of(points)
    order = np.argsort(own, kind="stable")
    sorted_ = own[order]
    ends = [(np.searchsorted(sorted_, node, "left"), np.searchsorted(sorted_, node, "right")) for node in cuts.nodes]
    return [(points[order[a:b]], order[a:b] + start) for a, b in ends]


def _leaf(parts: list[tuple[NDArray[np.float64], NDArray[np.int64]]], region: _tiles.Region) -> _tiles.Tile:
    points = np.concatenate([np.empty((0, 2)), *(part[0] for part in parts)])
    rows = np.concatenate([np.empty(0, np.int64), *(part[1] for part in parts)])
    tile = _tiles.triangulate(points, region, ids=rows)
    return _tiles.Tile(tile.points, rows[tile.order], tile.triangles, rows[tile.duplicates], tile.fingerprint, tile.border)


def _border(part: _tiles.Tile | _tiles.Seam) -> _tiles.Border:
    return part.border


def _print(part: _tiles.Tile | _tiles.Seam) -> _tiles.Fingerprint:
    return part.fingerprint


def _sum(prints: list[_tiles.Fingerprint]) -> _tiles.Fingerprint:
    return sum(prints, _tiles.Fingerprint())


def _of_tile(tile: _tiles.Tile) -> NDArray[np.int64]:
    return tile.order[tile.triangles]


def _of_seam(seam: _tiles.Seam) -> NDArray[np.int64]:
    return seam.triangles.astype(np.int64)
