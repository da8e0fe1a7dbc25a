"""Regular triangulations of points with weights, and their power diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _delone
from ._kept import Kept
from ._points import as_numbers, as_points, as_queries

if TYPE_CHECKING:
    from collections.abc import Sequence


def as_weights(weights: ArrayLike | None, count: int, what: str = "weights", one: str = "weight") -> NDArray[np.float64]:
    """One finite float64 for each point."""
    if weights is None:
        return np.zeros(count)
    array = as_numbers(weights, what)
    if array.shape != (count,):
        raise ValueError(f"{what} must have the shape ({count},), one for each point, not {array.shape}")
    result: NDArray[np.float64] = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    if not np.isfinite(result).all():
        row = int(np.argmin(np.isfinite(result)))
        raise ValueError(f"{what}: point {row} has the {one} {array[row]}, which is not finite")
    return result


class RegularTriangulation(Kept):
    """The regular triangulation of points with weights, in the plane or in space.

    It is exact, and a function of the set of points with their weights alone: the dual of the power diagram, in which the
    distance of a site from x is |x - p|**2 - w. With equal weights it is the Delaunay triangulation.

    Parameters
    ----------
    points : array_like of floats, shape (n, 2) or (n, 3)
        The points. All must be finite.
    weights : array_like of floats, shape (n,), optional
        Squares of radii, in squared units of the coordinates; they may be negative. None is zeros.

    Attributes
    ----------
    points, weights : ndarray
        What was given.
    simplices, neighbors : ndarray of int32, shape (m, d + 1)
        Corners in positive order, and the simplices across from them, -1 outside.
    hidden : ndarray of int32
        The sites that are no vertices, because their power cells are empty.

    Raises
    ------
    TypeError, ValueError, MemoryError
        What is wrong with the points or the weights, and where.

    Examples
    --------
    >>> import delone
    >>> tri = delone.RegularTriangulation([[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]], [9, 9, 9, 9, 0.25])
    >>> tri.nsimplex, tri.hidden.tolist()
    (2, [4])
    >>> tri.set_weights([9, 9, 9, 9, 3])
    >>> tri.nsimplex, tri.hidden.tolist(), tri.nearest([[2, 2.1]]).tolist()
    (4, [], [4])
    """

    def __init__(self, points: ArrayLike, weights: ArrayLike | None = None) -> None:
        """Triangulates points with weights."""
        self._points = np.array(as_points(points), order="C")
        self._core = _delone.Regular(self._points, as_weights(weights, len(self._points)).copy())
        self._cache = {}

    _core: _delone.Regular

    @property
    def points(self) -> NDArray[np.float64]:
        """The points."""
        return self._points

    @property
    def weights(self) -> NDArray[np.float64]:
        """Their weights."""
        return self._core.weights

    def _both(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        return self._once("arrays", self._core.arrays)

    @property
    def simplices(self) -> NDArray[np.int32]:
        """The corners of the simplices."""
        return self._both()[0]

    @property
    def neighbors(self) -> NDArray[np.int32]:
        """The simplices across from each corner, -1 outside."""
        return self._both()[1]

    @property
    def nsimplex(self) -> int:
        """The number of simplices."""
        return len(self.simplices)

    @property
    def convex_hull(self) -> NDArray[np.int32]:
        """The facets of the hull."""
        return self._core.hull()

    @property
    def edges(self) -> NDArray[np.int32]:
        """All edges, each once."""
        return self._core.edges()

    @property
    def hidden(self) -> NDArray[np.int32]:
        """The sites whose power cells are empty; those that equal a vertex are not among them.

        Examples
        --------
        >>> import delone
        >>> corners = [[0, 0], [4, 0], [0, 4], [1, 1]]
        >>> delone.RegularTriangulation(corners, [9, 9, 9, 0]).hidden.tolist()
        [3]
        """
        return self._core.hidden()

    @property
    def duplicates(self) -> NDArray[np.int32]:
        """Sites that equal an earlier one, their weights too, each with this."""
        return self._core.duplicates()

    def nearest(self, xi: ArrayLike) -> NDArray[np.int64]:
        """The site with the least power |x - p|**2 - w at each point; -1 if there is none."""
        queries, shape = as_queries(xi, self._points.shape[1])
        return self._core.nearest(queries).reshape(shape)

    def set_weights(self, weights: ArrayLike) -> None:
        """Gives all sites other weights. What changes is repaired, or all is built anew where that is faster.

        Ctrl-C ends the wait, not the change: whoever asks next waits for its end.
        """
        new = as_weights(weights, len(self._points)).copy()
        self._forget()
        self._core.set_weights(new)


class PowerDiagram(RegularTriangulation):
    """The power diagram of sites with weights in the plane, clipped to a domain.

    Parameters
    ----------
    positions : array_like of floats, shape (n, 2)
        The sites.
    weights : array_like of floats, shape (n,), optional
        Squares of radii. None is zeros: a Voronoi diagram.
    domain : array_like of floats, shape (k, 2), or a sequence of such rings, optional
        A polygon, or a polygon with holes. None is the unit square.

    Examples
    --------
    Weights for prescribed areas:

    >>> import delone
    >>> import numpy as np
    >>> sites = np.random.default_rng(1).random((50, 2))
    >>> diagram = delone.PowerDiagram(sites)
    >>> diagram.adjust_weights() < 1e-9
    True
    >>> bool(np.allclose(diagram.integrals(), 1 / 50, rtol=1e-9))
    True

    A step of Newton's method, as it is done there:

    >>> from scipy.sparse.linalg import spsolve
    >>> wanted = np.linspace(0.9, 1.1, 50) / 50
    >>> missing = wanted - diagram.integrals()
    >>> step = np.append(spsolve(diagram.der_integrals_wrt_weights()[:-1, :-1], missing[:-1]), 0)
    >>> diagram.set_weights(diagram.weights + step)
    >>> bool(np.abs(diagram.integrals() - wanted).max() < np.abs(missing).max() / 10)
    True
    """

    def __init__(
        self,
        positions: ArrayLike,
        weights: ArrayLike | None = None,
        domain: ArrayLike | Sequence[ArrayLike] | None = None,
    ) -> None:
        """Makes the diagram of sites with weights."""
        super().__init__(as_points(positions, "positions", columns=2), weights)
        if domain is None:
            domain = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        rings: Any = domain
        is_one = np.ndim(rings[0][0]) == 0 if len(rings) and len(rings[0]) else True
        self._rings = [as_points(ring, "domain", columns=2) for ring in ([rings] if is_one else rings)]

    def _integrated(self) -> tuple[Any, ...]:
        return self._once("integrals", lambda: self._core.integrals(len(self._points), self._rings))

    def adjust_weights(self, areas: ArrayLike | None = None, tolerance: float = 1e-9) -> float:
        """Takes the weights for which the cells have these areas, in proportion; None is all the same.

        Newton's method, damped so that no cell is lost. Every site must have a cell without weights, so it must be in or near the
        domain and no other one at its point. After Ctrl-C the weights are as they were.

        Returns
        -------
        float
            By how much of itself an area is wrong at most: `tolerance`, or more where rounding does not allow that.

        Examples
        --------
        >>> import delone
        >>> corners = [[0, 0], [4, 0], [4, 4], [0, 4]]
        >>> cells = delone.PowerDiagram([[1, 1], [3, 1]], domain=corners)
        >>> cells = cells.adjust_weights([12, 4]) or cells
        >>> cells.integrals().round(6).tolist()
        [12.0, 4.0]
        """
        count = len(self._points)
        shares = np.ones(count) if areas is None else as_numbers(areas, "areas")
        if shares.shape != (count,):
            raise ValueError(f"areas must have the shape ({count},), one for each site, not {shares.shape}")
        wanted: NDArray[np.float64] = np.require(shares, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
        return self._core.adjust_weights(wanted, self._rings, tolerance)

    def integrals(self) -> NDArray[np.float64]:
        """The areas of the cells; zero for those that are empty.

        Examples
        --------
        >>> import delone
        >>> corners = [[0, 0], [4, 0], [4, 4], [0, 4]]
        >>> delone.PowerDiagram([[1, 1], [3, 1]], [4, 0], corners).integrals().tolist()
        [12.0, 4.0]
        """
        areas: NDArray[np.float64] = self._integrated()[0]
        return areas

    def centroids(self) -> NDArray[np.float64]:
        """The centers of mass of the cells; NaN for those that are empty."""
        centroids: NDArray[np.float64] = self._integrated()[3]
        return centroids

    def second_order_moments(self) -> NDArray[np.float64]:
        """The integrals over the cells of the squared distance from their sites."""
        moments: NDArray[np.float64] = self._integrated()[4]
        return moments

    def der_integrals_wrt_weights(self) -> Any:
        """The Jacobian of the areas by the weights: a symmetric `scipy.sparse.csr_array`, each row of which sums to zero."""
        from scipy.sparse import coo_array

        count = len(self._points)
        _, pairs, values, _, _ = self._integrated()
        own = np.zeros(count)
        np.subtract.at(own, pairs[:, 0], values)
        np.subtract.at(own, pairs[:, 1], values)
        rows = np.concatenate([pairs[:, 0], pairs[:, 1], np.arange(count)])
        columns = np.concatenate([pairs[:, 1], pairs[:, 0], np.arange(count)])
        return coo_array((np.concatenate([values, values, own]), (rows, columns)), shape=(count, count)).tocsr()
