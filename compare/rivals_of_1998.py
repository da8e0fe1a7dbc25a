"""The rivals of Devillers 1998, 5.5.3, in one table: seconds to triangulate the paper's five sets.

Shewchuk's Triangle (divide and conquer, incremental, Fortune's sweep) and Qhull (SciPy) beside the hierarchy with sampling,
the Delaunay tree, the history, conflict lists, and divide and conquer of this project. Needs: pip install triangle scipy.

python compare/rivals_of_1998.py [--sizes 5000,50000,500000] [--runs 3] [-o docs/results/rivals.csv]
python compare/rivals_of_1998.py --sets disks --noise 1 --sizes 1000,10000,100000,1000000 --nanoseconds -o rivals-disks.csv

The second are the instances of disks of Devillers 2011, §5, whose table has Triangle too.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import scipy.spatial
import triangle

SETS = ["uniform", "ellipse2", "ellipse", "parabola", "circle"]
# The program's options, or what makes others' triangles.
OURS = {
    "hierarchy + MSZ": ["--algorithm", "incremental", "--locate", "hierarchy"],
    "Delaunay tree": ["--algorithm", "incremental", "--locate", "delaunay-tree"],
    "history": ["--algorithm", "incremental", "--locate", "history"],
    "conflict lists": ["--algorithm", "incremental", "--locate", "conflict"],
    "divide and conquer": [],
}
OTHERS = {
    "Triangle": lambda p: triangle.triangulate({"vertices": p}, "Q")["triangles"],
    "Triangle, incremental": lambda p: triangle.triangulate({"vertices": p}, "Qi")["triangles"],
    "Triangle, sweep": lambda p: triangle.triangulate({"vertices": p}, "QF")["triangles"],
    "Qhull": lambda p: scipy.spatial.Delaunay(p).simplices,
}
# From so many points on they take minutes, on curves an hour.
SLOW = {"Triangle, incremental": 500_000, "Delaunay tree": 500_000}


def program(delone, folder, options):
    """Seconds of construction, and the number of triangles."""
    arguments = ["triangulate", folder / "p.npy", "-o", folder / "t.npy", "--stats", folder / "s.json"]
    subprocess.run([delone, "-q", "--threads", "1", *arguments, *options], check=True)
    stats = json.loads((folder / "s.json").read_text())
    return stats["seconds"]["build"], stats["simplices"]


def other(make, points):
    """The same of somebody else's."""
    start = time.perf_counter()
    triangles = make(points)
    return time.perf_counter() - start, len(triangles)


def main():
    """Times everybody, interleaved."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sets", default=",".join(SETS))
    parser.add_argument("--sizes", default="5000,50000,500000")
    parser.add_argument("--noise", help="move each point by up to so much")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--nanoseconds", action="store_true", help="of a point, not seconds of all")
    parser.add_argument("--delone", default="target/release/delone", help="the program")
    parser.add_argument("-o", "--output", help="a CSV file [default: standard output]")
    args = parser.parse_args()
    rows = [["set", "points", *OURS, *OTHERS]]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in args.sets.split(","):
            for n in map(int, args.sizes.split(",")):
                generate = ["generate", kind, "-n", str(n), "--seed", "1", "-o", folder / "p.npy"]
                generate += ["--noise", args.noise] if args.noise else []
                subprocess.run([args.delone, "-q", *generate], check=True)
                points = np.load(folder / "p.npy")
                runs = {what: [] for what in [*OURS, *OTHERS]}
                for _ in range(args.runs):
                    for what, options in OURS.items():
                        if n < SLOW.get(what, n + 1):
                            runs[what].append(program(args.delone, folder, options))
                    for what, make in OTHERS.items():
                        if n < SLOW.get(what, n + 1):
                            runs[what].append(other(make, points))
                # All of ours are the same; others may differ on nearly cocircular points, but not in number.
                counts = {what: run[0][1] for what, run in runs.items() if run}
                ours = counts["divide and conquer"]
                for what, count in counts.items():
                    if count != ours:
                        print(f"{kind}, {n}: {what} has {count} triangles, not {ours}", file=sys.stderr)
                unit, digits = (1e9 / n, 0) if args.nanoseconds else (1, 3)
                cells = [f"{min(run)[0] * unit:.{digits}f}" if run else "-" for run in runs.values()]
                rows.append([kind, str(n), *cells])
    if args.output:
        with open(args.output, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
    for row in rows:
        print("  ".join(f"{cell:>10}" for cell in row))


if __name__ == "__main__":
    main()
