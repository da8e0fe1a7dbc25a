"""The switches of Triangle: what each means here, or why it is refused."""

from __future__ import annotations

import re
from dataclasses import dataclass

#: These choose algorithms that give the same, or what is printed or written to files.
_HARMLESS = "ziFlsXCQVhgvI"
_NUMBER = re.compile(r"\d*\.?\d*(?:[eE][-+]?\d+)?")


@dataclass
class Switches:
    """What is wanted."""

    poly: bool = False
    refine: bool = False
    #: Whether a function is asked.
    asks: bool = False
    min_angle: float = 0.0
    max_area: float | None = None
    #: Areas of regions or, where a mesh is refined, of its triangles.
    areas: bool = False
    attributes: bool = False
    convex: bool = False
    conforming: bool = False
    #: How often Y was said.
    keep: int = 0
    max_vertices: int | None = None
    no_holes: bool = False
    jettison: bool = False
    second_order: bool = False
    edges: bool = False
    neighbors: bool = False
    no_markers: bool = False
    no_vertices: bool = False
    no_triangles: bool = False
    no_segments: bool = False


_FLAGS = {
    "p": "poly",
    "r": "refine",
    "u": "asks",
    "A": "attributes",
    "c": "convex",
    "D": "conforming",
    "O": "no_holes",
    "j": "jettison",
    "e": "edges",
    "n": "neighbors",
    "B": "no_markers",
    "N": "no_vertices",
    "E": "no_triangles",
    "P": "no_segments",
}


def parse(opts: str) -> Switches:
    """Reads switches; a minus and spaces between them do not count."""
    if not isinstance(opts, str):
        raise TypeError(f"switches must be a string, not {opts!r}")
    found, at = Switches(), 0
    while at < len(opts):
        letter = opts[at]
        at += 1
        word = _NUMBER.match(opts, at) if letter in "qaSo" else None
        number = word[0] if word else ""
        at += len(number)
        if letter in _FLAGS:
            setattr(found, _FLAGS[letter], True)
        elif letter == "q":
            found.min_angle = _angle(number)
        elif letter == "a":
            found.areas |= not number
            found.max_area = _area(number) if number else found.max_area
        elif letter == "S":
            if number and not number.isdigit():
                raise ValueError(f"switch S: {number} is no number of vertices")
            found.max_vertices = int(number or 0)
        elif letter == "Y":
            found.keep += 1
        elif letter == "o":
            if number not in ("1", "2"):
                raise ValueError(f"switch o: the order must be 1 or 2, not {number!r}")
            found.second_order = number == "2"
        elif letter not in _HARMLESS + "- ":
            raise ValueError(f"there is no switch {letter!r}, in {opts!r}")
    return found


def _read(number: str, letter: str) -> float:
    try:
        return float(number)
    except ValueError:
        raise ValueError(f"switch {letter}: {number!r} is no number") from None


def _angle(number: str) -> float:
    """The usual one if nothing is said."""
    angle = _read(number, "q") if number else 20.0
    if not 0 <= angle < 60:
        raise ValueError(f"switch q: {number} degrees; it must be from 0 to less than 60")
    return angle


def _area(number: str) -> float:
    area = _read(number, "a")
    if area <= 0:
        raise ValueError(f"switch a: the largest area is {number}; it must be positive")
    return area
