"""A mesh by Shewchuk's Triangle: the child that `compare -- --mesh` runs once for each measurement, in a folder of its own.

python with_triangle_mesh.py ANGLE MINIMUM [--write]

Reads points.npy, segments.npy and holes.npy of the working folder. Calls the C function `triangulate` of the package's library
itself, so that no conversion counts: what is timed is arrays to arrays of C, the constrained triangulation included, segments
and markers of the result not (switches `pzQPB` and `q`). It runs at least MINIMUM seconds in all; the median counts. Prints
seconds, bytes of peak memory above the input, vertices and triangles; `--write` leaves vertices.npy and triangles.npy. Exits
with 3 where the package is not installed.

Triangle is free for non-commercial use only: it is measured, not used. Needs: pip install triangle numpy.
"""

import ctypes
import statistics
import sys
import time
from pathlib import Path

try:
    import numpy as np
    from triangle import core
except ImportError:
    sys.exit(3)

DOUBLES, INTS = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_int)


class Arrays(ctypes.Structure):
    """What Triangle reads and writes."""

    _fields_ = [
        ("points", DOUBLES),
        ("point_attributes", DOUBLES),
        ("point_markers", INTS),
        ("point_count", ctypes.c_int),
        ("point_attribute_count", ctypes.c_int),
        ("triangles", INTS),
        ("triangle_attributes", DOUBLES),
        ("triangle_areas", DOUBLES),
        ("neighbors", INTS),
        ("triangle_count", ctypes.c_int),
        ("corner_count", ctypes.c_int),
        ("triangle_attribute_count", ctypes.c_int),
        ("segments", INTS),
        ("segment_markers", INTS),
        ("segment_count", ctypes.c_int),
        ("holes", DOUBLES),
        ("hole_count", ctypes.c_int),
        ("regions", DOUBLES),
        ("region_count", ctypes.c_int),
        ("edges", INTS),
        ("edge_markers", INTS),
        ("normals", DOUBLES),
        ("edge_count", ctypes.c_int),
    ]


def memory(field):
    """Bytes, of what the kernel says of this process."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith(field))


def mesh(library, given, switches):
    """Seconds, and the arrays."""
    out = Arrays()
    start = time.perf_counter()
    library.triangulate(switches, ctypes.byref(given), ctypes.byref(out), None)
    return time.perf_counter() - start, out


def release(library, out):
    """Gives back what Triangle has allocated."""
    for name, kind in Arrays._fields_:
        array = getattr(out, name)
        if kind in (DOUBLES, INTS) and array:
            library.trifree(array)


def main():
    """Measures."""
    angle, minimum = sys.argv[1], float(sys.argv[2])
    library = ctypes.CDLL(core.__file__)
    library.trifree.argtypes = [ctypes.c_void_p]
    library.trifree.restype = library.triangulate.restype = None
    points = np.ascontiguousarray(np.load("points.npy"), dtype=np.float64)
    segments = np.ascontiguousarray(np.load("segments.npy"), dtype=np.intc)
    holes = np.ascontiguousarray(np.load("holes.npy"), dtype=np.float64)
    given = Arrays()
    given.points, given.point_count = points.ctypes.data_as(DOUBLES), len(points)
    given.segments, given.segment_count = segments.ctypes.data_as(INTS), len(segments)
    given.holes, given.hole_count = holes.ctypes.data_as(DOUBLES), len(holes)
    switches = f"pzQPBq{angle}".encode()

    Path("/proc/self/clear_refs").write_text("5")
    before = memory("VmRSS")
    seconds, out = mesh(library, given, switches)
    bytes_used = memory("VmHWM") - before
    times = [seconds]
    while sum(times) < minimum:
        seconds, other = mesh(library, given, switches)
        times.append(seconds)
        release(library, other)
    print(statistics.median(times), bytes_used, out.point_count, out.triangle_count)
    if "--write" in sys.argv:
        np.save("vertices.npy", np.ctypeslib.as_array(out.points, (out.point_count, 2)))
        np.save("triangles.npy", np.ctypeslib.as_array(out.triangles, (out.triangle_count, 3)).astype(np.int64))


if __name__ == "__main__":
    main()
