"""Cells of points in space with the names of pyvoro: ``from delone import pyvoro``.

What differs: cells are exact up to the rounding of their corners, so volumes add up to that of the box and both sides of a
face have it. `dispersion` is not needed and not used. Points outside of a box that does not repeat have what is left of their
cells inside of it, where pyvoro raises an error.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._periodic import Periodic
from ._points import as_numbers

__all__ = ["compute_voronoi"]


def compute_voronoi(
    points: ArrayLike,
    limits: ArrayLike,
    dispersion: float | None = None,
    radii: ArrayLike | None = None,
    periodic: Sequence[bool] = (False, False, False),
) -> list[dict[str, Any]]:
    """The cells of points in a box with these limits along each axis, as dictionaries.

    Each has the `volume`, the point as `original`, the `vertices`, for each vertex those that it is joined to in `adjacency`,
    and `faces` with their `vertices` and the `adjacent_cell`: a point, or -1 to -6 for the walls at the least and the largest
    x, then y, then z.

    Examples
    --------
    >>> from delone import pyvoro
    >>> cells = pyvoro.compute_voronoi([[1, 2, 3], [4, 5.5, 6]], [[0, 10], [0, 10], [0, 10]], 2.0)
    >>> round(sum(cell["volume"] for cell in cells), 9), len(cells[0]["faces"])
    (1000.0, 6)
    """
    box = as_numbers(limits, "limits")
    if box.shape != (3, 2):
        raise ValueError(f"limits must have the shape (3, 2), the least and the largest coordinate of each axis, not {box.shape}")
    # An empty list of pyvoro is no radii.
    weighted = radii is not None and np.size(as_numbers(radii, "radii")) > 0
    cells = Periodic(points, box[:, 1] - box[:, 0], periodic, radii if weighted else None, origin=box[:, 0])
    beyond, rows = cells.faces.indices.tolist(), cells.faces.indptr.tolist()
    polyhedra = zip(cells.polyhedra(), cells.volumes.tolist(), cells.points, rows, strict=False)
    return [
        {
            "volume": volume,
            "original": point,
            "vertices": [np.array(corner) for corner in corners],
            "adjacency": _adjacency(len(corners), faces),
            "faces": [{"adjacent_cell": beyond[row + i], "vertices": face.tolist()} for i, face in enumerate(faces)],
        }
        for (corners, faces), volume, point, row in polyhedra
    ]


def _adjacency(count: int, faces: Sequence[Any]) -> list[list[int]]:
    joined: list[list[int]] = [[] for _ in range(count)]
    for face in faces:
        for i, corner in enumerate(face.tolist()):
            # A side goes one way in one face, and the other way in the face beside it.
            joined[face[i - 1]].append(corner)
    return joined
