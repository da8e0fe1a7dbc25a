"""Triangulation of more points than one memory holds, on Spark: one `groupBy` for the tiles, and one for each level of joins.

    import delone.spark

    made = delone.spark.triangulate(frame, tiles=64)       # columns id, x, y
    made.triangles.write.parquet("triangles")              # columns a, b, c: ids of points
    made.fingerprint()

No rounds until nothing changes, no state: what a worker loses is made again by Spark. Needs the packages `pyspark`, `pandas` and
`pyarrow`, and Java.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from pyspark.sql import DataFrame
from pyspark.sql import functions as F

from . import tiles as _tiles
from ._points import as_index, as_points

__all__ = ["TiledTriangulation", "triangulate"]

_SAMPLE = 1_000_000
_LEVELS = 4
_DONE = "node long, triangles binary, border binary, fingerprint string"


@dataclass(frozen=True, eq=False)
class TiledTriangulation:
    """A triangulation that Spark computes when it is asked for rows of it."""

    cuts: _tiles.Cuts
    """The tiles."""
    parts: DataFrame
    """A row for each tile and for each join: its node, its triangles and its border as bytes, its fingerprint. Persisted."""

    @property
    def triangles(self) -> DataFrame:
        """All triangles, counter-clockwise: columns a, b, c, the ids of their corners."""
        return self.parts.select("triangles").mapInPandas(_rows, "a long, b long, c long")

    def fingerprint(self) -> _tiles.Fingerprint:
        """The fingerprint of all triangles. Computes all of them."""
        texts = self.parts.select("fingerprint").collect()
        return sum((_tiles.Fingerprint(row[0]) for row in texts), _tiles.Fingerprint())


def triangulate(frame: DataFrame, tiles: int, *, x: str = "x", y: str = "y", id: str = "id") -> TiledTriangulation:
    """Triangulates the points of a data frame: the same triangles as in one memory.

    The frame is read for a sample, from which the tiles are cut at once, and once more when the result is computed: it should
    give the same rows both times.

    Parameters
    ----------
    frame : pyspark.sql.DataFrame
        A row for each point.
    tiles : int
        How many tiles, one task each, whatever `spark.sql.shuffle.partitions` is: a million points in each is a good number.
    x, y, id : str
        The columns of coordinates, and of names for the points: integers from 0 on, no two the same. Of points at one place the
        one with the least id is a vertex.

    Raises
    ------
    ValueError
        When computed, in the words of Spark: for coordinates that are null or not finite, for ids that are negative or null.
    """
    count = as_index(tiles, "tiles")
    points = frame.select(
        F.col(id).cast("long").alias("id"), F.col(x).cast("double").alias("x"), F.col(y).cast("double").alias("y")
    )
    total = points.count()
    share = min(1.0, max(_SAMPLE, 100 * count) / max(total, 1))
    taken = points.select("x", "y") if share == 1.0 else points.select("x", "y").sample(share, seed=1)
    cuts = _tiles.Cuts(_points(taken.toPandas()), count)

    def tile(batches: Iterator[pd.DataFrame]) -> Iterator[pd.DataFrame]:
        for batch in batches:
            yield batch.assign(node=cuts.tile_of(_points(batch)).astype(np.int64))

    def leaf(key: tuple[Any], rows: pd.DataFrame) -> pd.DataFrame:
        rows = rows.sort_values("id")
        ids = rows["id"].to_numpy(np.int64)
        made = _tiles.triangulate(_points(rows), cuts.region(int(key[0])), ids=ids)
        return _row(int(key[0]), ids[made.order[made.triangles]], made.border, made.fingerprint)

    def joined(key: tuple[Any], rows: pd.DataFrame) -> pd.DataFrame:
        borders = [_tiles.Border.from_bytes(bytes(data)) for data in rows.sort_values("node")["border"]]
        seam = _tiles.join(borders, cuts.region(int(key[0])))
        return _row(int(key[0]), seam.triangles.astype(np.int64), seam.border, seam.fingerprint)

    # As many partitions as groups: the usual 200 would start Python for each that is empty, once a level.
    located = points.mapInPandas(tile, "id long, x double, y double, node long").repartition(len(cuts), "node")
    open_ = located.groupBy("node").applyInPandas(leaf, _DONE).persist()
    done = open_
    for above in _levels(cuts):
        whole = F.create_map(*[F.lit(number) for pair in above.items() for number in pair])[F.col("node")]
        seams = open_.select("node", "border").withColumn("above", whole).where(F.col("above").isNotNull())
        seams = seams.repartition(len(set(above.values())), "above")
        seams = seams.groupBy("above").applyInPandas(joined, _DONE).persist()
        open_ = open_.where(whole.isNull()).unionAll(seams)
        done = done.unionAll(seams)
    return TiledTriangulation(cuts, done)


def _levels(cuts: _tiles.Cuts) -> list[dict[int, int]]:
    """The node that joins each part, level by level from the lowest."""
    levels: list[dict[int, int]] = []
    nodes = [1]
    while any(parts := {node: cuts.parts(node, _LEVELS) for node in nodes}.values()):
        level = {part: node for node, of in zip(nodes, parts, strict=True) for part in of}
        levels.append(level)
        nodes = list(level)
    return levels[::-1]


def _points(rows: pd.DataFrame) -> Any:
    return as_points(rows[["x", "y"]].to_numpy(np.float64), "points", 2)


def _row(node: int, triangles: Any, border: _tiles.Border, fingerprint: _tiles.Fingerprint) -> pd.DataFrame:
    data = np.ascontiguousarray(triangles, "<i8").tobytes()
    return pd.DataFrame({"node": [node], "triangles": [data], "border": [border.to_bytes()], "fingerprint": [str(fingerprint)]})


def _rows(batches: Iterator[pd.DataFrame]) -> Iterator[pd.DataFrame]:
    for batch in batches:
        for data in batch["triangles"]:
            yield pd.DataFrame(np.frombuffer(bytes(data), "<i8").reshape(-1, 3), columns=["a", "b", "c"])
