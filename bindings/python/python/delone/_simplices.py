"""What follows from the corners of simplices: their neighbours, and the maps to barycentric coordinates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_EPS = float(np.finfo(np.float64).eps)
#: What a change of a point's coordinates in their last place may do to a barycentric coordinate, at most.
_MOST = 1 / 1000


def neighbors_of(simplices: NDArray[np.int32]) -> NDArray[np.int32]:
    """The simplices across from each corner, -1 where there is none; each facet belongs to at most two."""
    rows, corners = simplices.shape
    if not rows:
        return np.empty((0, corners), dtype=np.int32)
    facets = np.concatenate([np.delete(simplices, k, axis=1) for k in range(corners)])
    facets.sort(axis=1)
    order = np.lexsort(facets.T)
    in_order = facets[order]
    first = np.flatnonzero((in_order[1:] == in_order[:-1]).all(axis=1))
    result = np.full(rows * corners, -1, dtype=np.int32)
    one, other = order[first], order[first + 1]
    result[one], result[other] = other % rows, one % rows
    return np.ascontiguousarray(result.reshape(corners, rows).T)


def transforms(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Maps to barycentric coordinates of simplices, (n, ndim + 1, ndim) each: (n, ndim + 1, ndim).

    NaN unless it is proved that coordinates are right to a 50th for all points of a simplex. The determinant and its minors
    are sums of products. Rounding changes a minor by less than 2.5 eps, the determinant by less than 4 eps of the sum of the
    sizes of these; the first ones together are below the second one, divided by the sides. With `_MOST` for eps times
    these sizes times the largest coordinates, of which sides are at most twice, that is 2 * 2.5 + 2 * 4 thousandths, and
    four more for the rounding of what is done with a map.
    """
    count, ndim = len(corners), corners.shape[2]
    result = np.full((count, ndim + 1, ndim), np.nan)
    with np.errstate(all="ignore"):
        sides = corners[:, :-1] - corners[:, -1:]
        # By powers of two, which is exact: all axes and then all sides to one size, so that products stay in range.
        by_axis = np.frexp(np.abs(sides).max(axis=1, initial=0.0))[1][:, None, :]
        sides = np.ldexp(sides, -by_axis)
        by_side = np.frexp(np.abs(sides).max(axis=2, initial=0.0))[1][:, :, None]
        sides = np.ldexp(sides, -by_side)
        if ndim == 2:
            (ax, ay), (bx, by) = sides[:, 0].T, sides[:, 1].T
            minors = np.stack([np.stack([by, -bx], axis=1), np.stack([-ay, ax], axis=1)], axis=1)
            sizes = np.abs(minors)
        else:
            two = [(sides[:, k - 2], sides[:, k - 1]) for k in range(3)]
            minors = np.stack([np.cross(b, c) for b, c in two], axis=1)
            two = [(np.abs(b), np.abs(c)) for b, c in two]
            after, before = [1, 2, 0], [2, 0, 1]
            sizes = np.stack([b[:, after] * c[:, before] + b[:, before] * c[:, after] for b, c in two], axis=1)
        determinant = (sides[:, 0] * minors[:, 0]).sum(axis=1)[:, None, None]
        maps, sizes = (np.ldexp(m / determinant, -by_side - by_axis) for m in (minors, sizes))
        last_place = _EPS * np.abs(corners).max(axis=1, initial=0.0)
        sound = ((np.abs(sizes) * last_place[:, None, :]).sum(axis=2) < _MOST).all(axis=1)
        # Products that have underflowed are not known to the last bit.
        sound &= (np.abs(determinant[:, 0, 0]) > 1e-250) & np.isfinite(maps).all(axis=(1, 2))
    result[sound, :-1], result[sound, -1] = maps[sound], corners[sound, -1]
    return result
