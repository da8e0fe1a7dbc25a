"""Options of Qhull, for those who come from SciPy: what each means here, or why it is refused."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from ._errors import qhull_error

#: What these ask for holds anyway, or they say what Qhull is to do where rounding misleads it, or what its program prints.
_HARMLESS = re.compile(r"Qbb|QbB|Qs|Qt|Qv|Qx|Q\d\d?|Pp|Po|Pg|[finops]|F[A-Za-z]|T[acfsvz]")

_REFUSED = [
    (r"Qu", "give furthest_site=True instead"),
    (r"QV.*", "facets that are good for a vertex are not told apart"),
    (r"QG.*", "only ConvexHull tells good facets, by QGn and QG-n for the point n"),
    (r"Qi", "points inside are not listed as coplanar"),
    (r"QR.*|Qr", "nothing is random: the result is a function of the points"),
    (r"Qb.*|QB.*", "coordinates are not scaled or dropped; scale the points instead"),
    (r"[ACERUVW]-?[\d.].*", "it sets a tolerance, and decisions are exact"),
]


@dataclass(frozen=True)
class Options:
    """What the options that are not refused ask for."""

    #: Qz: a region of no point in a Voronoi diagram, which comes first.
    at_infinity: bool = False
    #: Qc: to list the points on facets that are no corners.
    coplanar: bool = False
    #: QJ: points that are joggled are all corners, so none may be equal. Nothing else needs a joggle.
    distinct: bool = False
    #: QGn: the point from which facets are to be seen, which is left out; and whether to tell those that are seen.
    seen_from: int | None = None
    seen: bool = True


def parse(given: str | bytes | None, usual: str, is_hull: bool = False) -> Options:
    """Reads options; `usual` ones if none are given, as SciPy has them."""
    if given is not None and not isinstance(given, (str, bytes)):
        raise TypeError(f"qhull_options must be a string, not {given!r}")
    text = given.decode("ascii", "replace") if isinstance(given, bytes) else usual if given is None else given
    return _of_words(text, is_hull)


@lru_cache(maxsize=64)
def _of_words(text: str, is_hull: bool) -> Options:
    """What words ask for; they are few, and read once."""
    words = text.split()
    seen_from, seen = None, True
    for word in words:
        view = re.fullmatch(r"QG(-?)(\d+)", word)
        if view and is_hull:
            seen_from, seen = int(view[2]), not view[1]
        elif not (_HARMLESS.fullmatch(word) or word in ("Qz", "Qc") or re.fullmatch(r"QJ[\d.e-]*", word)):
            known = (reason for pattern, reason in _REFUSED if re.fullmatch(pattern, word))
            raise qhull_error(f"qhull_options: {word!r} is not supported: {next(known, 'no such option is known')}")
    joggled = any(word.startswith("QJ") for word in words)
    return Options("Qz" in words, "Qc" in words, joggled, seen_from, seen)
