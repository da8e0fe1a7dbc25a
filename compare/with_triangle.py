"""Constrained triangulations beside Shewchuk's Triangle: seconds for the same graphs, alternating, the minimum counts.

Of Triangle the call on arrays is timed (`pc`: segments, and the whole hull), of this project the program's construction on one
thread. Triangle is free for non-commercial use only: it is measured, not used. Needs: pip install triangle numpy.

python compare/with_triangle.py [--sizes 100000,1000000] [--runs 3] [--graphs planar-subset,planar-grid,long,koch]
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import numpy as np
import triangle


def read(path):
    """The vertices and segments of a .poly file, its lines numbered from 0."""
    lines = [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]
    count = int(lines[0][0])
    vertices = np.array([line[1:3] for line in lines[1 : count + 1]], dtype=float)
    segments = int(lines[count + 1][0])
    ends = np.array([line[1:3] for line in lines[count + 2 : count + 2 + segments]], dtype=int)
    return vertices, ends


def ours(delone, folder):
    """Seconds of construction, and the number of triangles."""
    arguments = ["triangulate", folder / "g.poly", "--fill", "all", "-o", folder / "t.npy", "--stats", folder / "s.json"]
    subprocess.run([delone, "-q", "--threads", "1", *arguments], check=True)
    stats = json.loads((folder / "s.json").read_text())
    return stats["seconds"]["build"], stats["simplices"]


def apart(vertices, segments):
    """The same of Triangle, in a process of its own: it crashes on some grids."""
    with ProcessPoolExecutor(1) as process:
        try:
            return process.submit(theirs, vertices, segments).result()
        except BrokenProcessPool:
            return math.inf, 0


def theirs(vertices, segments):
    """Seconds of Triangle, and the number of triangles."""
    start = time.perf_counter()
    triangles = triangle.triangulate({"vertices": vertices, "segments": segments}, "pcQ")["triangles"]
    return time.perf_counter() - start, len(triangles)


def main():
    """Times both, interleaved."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="100000,1000000")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--graphs", default="planar-subset,planar-grid,long,koch")
    args = parser.parse_args()
    delone = Path(__file__).resolve().parent.parent / "target/release/delone"
    if not delone.exists():
        sys.exit(f"error: {delone} is not there\nhelp: cargo build --release")
    print(f"{'graph':14} {'points':>8} {'segments':>8} {'delone s':>9} {'Triangle s':>10} {'ratio':>6}")
    for graph in args.graphs.split(","):
        for size in map(int, args.sizes.split(",")):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                subprocess.run([delone, "-q", "generate", graph, "-n", str(size), "-o", folder / "g.poly"], check=True)
                vertices, segments = read(folder / "g.poly")
                times = [(ours(delone, folder), apart(vertices, segments)) for _ in range(args.runs)]
            (us, count), (them, other) = (min(column) for column in zip(*times, strict=True))
            if them == math.inf:
                print(f"{graph:14} {len(vertices):8} {len(segments):8} {us:9.3f} {'crashes':>10}")
                continue
            remark = "" if count == other else f"  {count} and {other} triangles"
            print(f"{graph:14} {len(vertices):8} {len(segments):8} {us:9.3f} {them:10.3f} {them / us:6.1f}{remark}")


if __name__ == "__main__":
    main()
