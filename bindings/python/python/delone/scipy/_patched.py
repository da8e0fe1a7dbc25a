"""Programs of others with Delone in SciPy's place."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Any

import scipy.interpolate
import scipy.spatial

from ._halfspaces import HalfspaceIntersection
from ._interpolate import CloughTocher2DInterpolator, LinearNDInterpolator, griddata
from ._spatial import ConvexHull, Delaunay, Voronoi

#: What stands for what. SciPy's compiled modules keep their own, which they ask whether something is one of theirs.
_OURS = {
    id(theirs): (theirs, ours)
    for theirs, ours in [
        (scipy.spatial.Delaunay, Delaunay),
        (scipy.spatial.Voronoi, Voronoi),
        (scipy.spatial.ConvexHull, ConvexHull),
        (scipy.spatial.HalfspaceIntersection, HalfspaceIntersection),
        (scipy.interpolate.LinearNDInterpolator, LinearNDInterpolator),
        (scipy.interpolate.CloughTocher2DInterpolator, CloughTocher2DInterpolator),
        (scipy.interpolate.griddata, griddata),
    ]
}
_KEPT = ("delone", "scipy.spatial._", "scipy.interpolate._", "scipy.spatial.qhull", "scipy.interpolate.interpnd")

#: How many contexts there are, and what they have changed; the last one that ends undoes it all.
_lock = Lock()
_contexts = 0
_changed: list[tuple[dict[str, Any], str, Any, Any]] = []


@contextmanager
def patched() -> Iterator[None]:
    """Within it SciPy's classes are those of `delone.scipy`, wherever modules that are loaded have their names.

    For programs that import from SciPy and cannot be changed. What they import within it, they have from Delone too, also
    afterwards; so it is best put around a whole program. It is for all threads at once, and of several contexts the last that
    ends gives SciPy's classes back.

    Examples
    --------
    >>> import delone.scipy, scipy.spatial
    >>> with delone.scipy.patched():
    ...     type(scipy.spatial.Delaunay([[0, 0], [1, 0], [0, 1]])).__module__
    'delone.scipy._spatial'
    """
    _enter()
    try:
        yield
    finally:
        _leave()


def _enter() -> None:
    """Changes what modules have by now."""
    global _contexts
    with _lock:
        _contexts += 1
        for name, module in list(sys.modules.items()):
            # Modules may be lazy: only what they have is looked at.
            names = getattr(module, "__dict__", None)
            if not isinstance(names, dict) or name.startswith(_KEPT):
                continue
            for attribute, value in list(names.items()):
                found = _OURS.get(id(value))
                if found and found[0] is value:
                    names[attribute] = found[1]
                    _changed.append((names, attribute, *found))


def _leave() -> None:
    """Of the last one: gives names back."""
    global _contexts
    with _lock:
        _contexts -= 1
        if _contexts:
            return
        for names, attribute, theirs, ours in reversed(_changed):
            if names.get(attribute) is ours:
                names[attribute] = theirs
        _changed.clear()
