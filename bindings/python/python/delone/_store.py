"""Folders of tiles: more points than memory, from files to files."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._geometries import box_of
from ._points import as_flag, as_index, as_names, as_number_in, as_points

if TYPE_CHECKING:
    from .tiles import Cuts

#: Bytes of a unit of memory.
_UNITS = {"": 1, "K": 1 << 10, "M": 1 << 20, "G": 1 << 30, "T": 1 << 40}
#: The largest number of bytes, of points and of tiles: that of NumPy's integers.
_MOST = 2**63 - 1


class Plan(TypedDict):
    """A run; `_delone.Store.build` takes it."""

    paths: list[str]
    folder: str
    memory: int
    tile: int | None
    workers: int | None
    heights: bool
    neighbors: bool
    resume: bool
    classes: list[int]
    columns: list[str]


@dataclass(frozen=True)
class Summary:
    """The counts of a folder of tiles."""

    points: int
    """The points of the input."""
    duplicates: int
    """Those that equal an earlier one."""
    vertices: int
    """The points that differ."""
    triangles: int
    """The triangles of tiles and seams."""
    of_seams: int
    """The triangles of seams alone."""
    hull: int
    """The vertices of the hull."""
    border: int
    """The points of the borders of tiles."""
    fingerprint: _delone.Fingerprint
    """The fingerprint of the set of triangles."""


class Store:
    """A folder of tiles that is done; `build` and `open` give it."""

    def __init__(self, core: _delone.Store) -> None:
        """From the Rust half."""
        self._core = core

    @property
    def folder(self) -> Path:
        """The folder."""
        return Path(self._core.folder)

    @property
    def has_heights(self) -> bool:
        """Whether points have heights."""
        return self._core.heights

    @property
    def summary(self) -> Summary:
        """What it has."""
        points, duplicates, vertices, triangles, of_seams, hull, border = self._core.counts()
        return Summary(points, duplicates, vertices, triangles, of_seams, hull, border, self._core.fingerprint())

    @property
    def cuts(self) -> Cuts:
        """The cuts of the plane into tiles; `cuts.nodes` are the tiles."""
        from .tiles import Cuts

        return Cuts.from_cuts(self._core.cuts().cuts())

    def points(self, node: int) -> NDArray[np.float64]:
        """The points of a tile along a curve, shape (n, 2), or with heights (n, 3)."""
        return self._core.points(as_index(node, "node"))

    def triangles(self, node: int) -> NDArray[np.int64]:
        """The triangles of a tile, counter-clockwise, as rows of its points; those of seams are not among them."""
        return self._core.triangles(as_index(node, "node"))

    def verify(self) -> None:
        """Proves by exact decisions that these are the triangles of all points, and that no file was changed.

        Raises ValueError with the file and the fault.
        """
        self._core.verify()

    def window(self, box: Sequence[float] | None = None) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Points and triangles: all that may meet a box (x0, y0, x1, y1), or all there are. Triangles are rows of the points."""
        corners = None if box is None else box_of(tuple(box))
        if box is not None and corners is None:
            raise ValueError(f"a box is its least x and y, and then the largest ones; not {box!r}")
        sides = [[-np.inf, -np.inf], [np.inf, np.inf]] if corners is None else [corners[0].tolist(), corners[2].tolist()]
        return self._core.window(sides)

    def locate(self, places: ArrayLike) -> NDArray[np.uint64]:
        """The triangle that each place is in or on, by the names of its corners, counter-clockwise, shape (n, 3).

        A name is the node of the tile times 2**32, plus the row in its points; outside of the hull all are 2**64 - 1.
        """
        return self._core.locate(as_points(places, "places", 2))

    def overview(self, count: int) -> NDArray[np.float64]:
        """About so many of the points, at equal steps along the curve of each tile."""
        number = as_index(count, "count")
        if number < 1:
            raise ValueError(f"count must be at least 1, not {number}")
        return self._core.overview(number)

    def __repr__(self) -> str:
        """Its folder and its number of triangles."""
        return f"<Store {str(self.folder)!r} of {self.summary.triangles} triangles>"


def as_bytes(memory: int | str) -> int:
    """A number of bytes: an integer, or text as in "500M" and "4G"."""
    if isinstance(memory, str):
        found = re.fullmatch(r"\s*([0-9.]+)\s*([KMGT]?)(i?B)?\s*", memory, re.IGNORECASE)
        try:
            memory = int(float(found[1]) * _UNITS[found[2].upper()])  # type: ignore[index]
        except (OverflowError, TypeError, ValueError):
            raise ValueError(f'memory must be a number of bytes, as in "500M" or "4G", not {memory!r}') from None
    return as_number_in(memory, "memory", 1, _MOST)


def as_classes(classes: Iterable[int] | None) -> list[int]:
    """Classes of LAS files; none for all."""
    return [as_number_in(one, "a class", 0, 255) for one in (() if classes is None else classes)]


def build(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    *,
    memory: int | str = "1G",
    heights: bool = False,
    resume: bool = False,
    neighbors: bool = False,
    tile: int | None = None,
    workers: int | None = None,
    classes: Sequence[int] = (),
    columns: Sequence[str] = (),
) -> Store:
    """Triangulates the points of files in tiles on disk, as the program `delone tiles` does, with the same bytes.

    A run that was stopped, by Ctrl-C or at any other moment, goes on with `resume`.

    Parameters
    ----------
    paths : path or paths
        Files of points, which are one set in their order: npy, LAS and LAZ, text. Each is read twice.
    folder : path
        The folder of the tiles, which is made.
    memory : int or text
        The bytes that may be taken, as in "500M" or "4G", from "64M" on. It decides how many tiles there are.
    heights : bool
        Whether the heights of the points are kept.
    resume : bool
        Whether a run in the folder goes on; an empty folder begins one.
    neighbors : bool
        Whether the triangles across each edge are written too.
    tile, workers : int, optional
        The most points of a tile, and the tiles that are triangulated at once.
    classes, columns
        Of LAS files the classes that are taken, or all; of text the columns that are x, y and z.

    Raises
    ------
    ValueError
        For a folder that has tiles or other files, another input than that of the run to resume, and wrong points.

    Examples
    --------
    >>> import tempfile, numpy as np
    >>> from pathlib import Path
    >>> from delone import tiles
    >>> place = Path(tempfile.mkdtemp())
    >>> np.save(place / "points.npy", np.random.default_rng(1).random((5000, 2)))
    >>> store = tiles.build(place / "points.npy", place / "tiles", tile=1000)
    >>> store.summary.points, len(store.cuts) > 4
    (5000, True)
    >>> tiles.open(place / "tiles").verify()
    >>> points, triangles = store.window((0.4, 0.4, 0.6, 0.6))
    >>> triangles.shape[1]
    3
    """
    names = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    plan: Plan = {
        "paths": [os.fspath(path) for path in names],
        "folder": os.fspath(folder),
        "memory": as_bytes(memory),
        "tile": None if tile is None else as_number_in(tile, "tile", 0, _MOST),
        "workers": None if workers is None else as_number_in(workers, "workers", 0, _MOST),
        "heights": as_flag(heights, "heights"),
        "neighbors": as_flag(neighbors, "neighbors"),
        "resume": as_flag(resume, "resume"),
        "classes": as_classes(classes),
        "columns": as_names(columns, "columns"),
    }
    core, remarks = _delone.Store.build(plan)
    for remark in remarks:
        warnings.warn(remark, stacklevel=2)
    return Store(core)


def open_folder(folder: str | os.PathLike[str]) -> Store:
    """Opens a folder of tiles that `build` or the program made.

    Raises FileNotFoundError where there are no tiles, ValueError where they are not done or `tiles.json` is wrong.
    """
    return Store(_delone.Store.open(os.fspath(folder)))
