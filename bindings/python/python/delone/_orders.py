"""Voronoi diagrams of higher order: where the same k points are nearest."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._merge import as_merge, length_of
from ._periodic import pieces
from ._points import as_index, as_points, as_queries
from ._voronoi import _rings


class OrderVoronoi:
    """The Voronoi diagram of order k of points in the plane: a region for each k points that are the nearest ones somewhere.

    Order 1 is the Voronoi diagram, order n - 1 of n points that of the furthest one. It is a function of the set of points
    alone: of points at one distance, and of four on one circle, the lexicographically largest counts as further away. So a
    region may be no more than a point or a segment where points are cocircular. Points that equal earlier ones are in no
    region.

    Making it takes about k * k * n steps, and memory for k numbers in each of at most (2 * k - 1) * n regions.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2)
        The points. All must be finite.
    k : int
        The order, from 1 to the number of distinct points.

    Attributes
    ----------
    points : (n, 2) array
        The points.
    k : int
        The order.
    regions : (r, k) array of int32
        The points that are nearest in each region, by increasing index; regions are sorted by them.
    bounded : (r,) array of bool
        Whether each region is bounded. Those that are not are the k-sets.
    circles : (c, 3) array of int32
        Three points on each circle whose center is a corner of regions, counter-clockwise.
    inside : (c, k - 1) array of int32
        The points inside of each circle, by increasing index: k - 1 of them, or k - 2 and then -1.
    circle_regions : (c, 3) array of int32
        The three regions around the center of each circle.
    vertices : (c, 2) array
        The centers, each the nearest number to the exact one; infinite where no float is as large.

    Raises
    ------
    TypeError, ValueError, MemoryError
        What is wrong with the points or the order, and where.

    Examples
    --------
    >>> import delone
    >>> pairs = delone.OrderVoronoi([[0, 0], [4, 0], [4, 4], [0, 3], [2, 1]], 2)
    >>> pairs.regions.tolist()
    [[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]]
    >>> pairs.regions[pairs.locate([[1, 0], [3, 4]])].tolist()
    [[0, 4], [2, 3]]
    >>> pairs.k_sets().tolist()
    [[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3]]
    >>> round(float(pairs.areas([[0, 0], [4, 0], [4, 4], [0, 4]]).sum()), 9)
    16.0
    """

    def __init__(self, points: ArrayLike, k: int) -> None:
        """Makes the diagram of points."""
        self.points: NDArray[np.float64] = np.array(as_points(points, columns=2), order="C")
        self.k = as_index(k, "k")
        if not 1 <= self.k <= len(self.points):
            raise ValueError(f"k must be at least 1 and at most the number of points, {len(self.points)}; it is {self.k}")
        self._core, arrays = _delone.Orders.of(self.points, self.k)
        self.regions, self.bounded, self.circles, self.inside, self.circle_regions, self.vertices = arrays

    @property
    def duplicates(self) -> NDArray[np.int32]:
        """Points that equal an earlier one, each with this."""
        return self._core.duplicates()

    def k_sets(self) -> NDArray[np.int32]:
        """The points of the unbounded regions: on one side of some line they are alone, up to points on the line."""
        found: NDArray[np.int32] = self.regions[~self.bounded]
        return found

    def locate(self, xi: ArrayLike) -> NDArray[np.int32]:
        """The region that each point is in, a row of `regions`; there always is one. On borders, of the points at one distance
        the lexicographically smallest are nearer."""
        queries, shape = as_queries(xi, 2)
        return self._core.locate(queries).reshape(shape)

    def cells(
        self, region: ArrayLike | Sequence[ArrayLike] | None = None, merge: float | str | None = None
    ) -> list[list[NDArray[np.float64]]]:
        """All regions, clipped: for each its rings, counter-clockwise, holes clockwise; none for those outside.

        `region` is a polygon of shape (m, 2), or a list of them, the first around the others, which are holes; a polygon of
        shapely or GeoJSON, or a column of them; or a box of four numbers, the least x and y and the largest. Without it
        regions are clipped to the box of the points, a twentieth larger. The diagram is not kept but made again for this.
        Sides up to the length `merge` are contracted, see `Voronoi`.
        """
        rings = self._border(region)
        return pieces(*self._core.cells(rings, length_of(as_merge(merge), *rings)))

    def areas(self, region: ArrayLike | Sequence[ArrayLike] | None = None) -> NDArray[np.float64]:
        """The areas of the clipped regions; see `cells`."""
        return self._core.areas(self._border(region))

    def _border(self, region: ArrayLike | Sequence[ArrayLike] | None) -> list[NDArray[np.float64]]:
        return _rings(region, self.points.min(axis=0), self.points.max(axis=0))

    def __repr__(self) -> str:
        """A line that says what there is."""
        return f"<delone.OrderVoronoi of order {self.k}: {len(self.points)} points, {len(self.regions)} regions>"
