"""Points that are nearly known beforehand."""

from __future__ import annotations

from numpy.typing import ArrayLike

from . import _delone
from ._delaunay import Delaunay
from ._points import as_points, owned


class Hints:
    """Triangulates many sets of points that are near the same centers, each in about linear time.

    Source: Devillers, "Delaunay triangulation of imprecise points, preprocess and actually get a fast query time". The
    result is the same as that of `Delaunay`.

    Examples
    --------
    >>> import delone, numpy as np
    >>> centers = np.random.default_rng(1).random((1000, 2))
    >>> hints = delone.Hints(centers)
    >>> tri = hints.triangulate(centers + 1e-3)
    >>> tri.vertex_count
    1000
    """

    def __init__(self, centers: ArrayLike) -> None:
        """Preprocesses centers."""
        array = as_points(centers, "centers")
        self._shape = array.shape
        self._core = _delone.Hints(array)

    def triangulate(self, points: ArrayLike) -> Delaunay:
        """The triangulation of points, the k-th of which is near the k-th center."""
        return Delaunay._of(self._core.triangulate(owned(as_points(points, columns=self._shape[1]))))
