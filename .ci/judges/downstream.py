"""Tests of packages that call SciPy's triangulations, run by SciPy and with `delone.scipy` in its place.

    python .ci/judges/downstream.py FOLDER

Whatever passes by SciPy must pass with Delone, but for what `ARBITRARY` has. Prints what passes more or less, and exits with 1
if anything is less. Packages are those that this Python has; tests that are not installed along come from the source of that
version.
"""

import importlib.metadata
import importlib.util
import io
import json
import os
import re
import subprocess
import sys
import tarfile
import urllib.parse
import urllib.request
import xml.etree.ElementTree
from pathlib import Path

HERE = Path(__file__).parent

#: Tests by package: those installed with it, and those in its source.
INSTALLED = {
    "pointpats": ["tests"],
    "libpysal": [
        "graph/tests/test_triangulation.py",
        "cg/tests/test_ashapes.py",
        "cg/tests/test_voronoi.py",
        "weights/tests/test_gabriel.py",
    ],
    "verde": ["tests/test_scipy.py", "tests/test_mask.py", "tests/test_chain.py"],
    "colour": ["volume/tests"],
    "adaptive": ["tests/test_learnernd.py", "tests/test_triangulation.py", "tests/test_learners.py"],
}
IN_SOURCE = {
    "scikit-image": ["tests/skimage/morphology/test_convex_hull.py", "tests/skimage/transform/test_geometric.py"],
    "alphashape": ["tests"],
    "MetPy": ["tests/interpolate"],
}
#: Patterns of tests that pass by arbitrary choices alone, each with the reason.
ARBITRARY = {
    r"test_learner_performance_is_invariant_under_scaling\[Learner2D": (
        "points of a lattice are scaled by a random factor, so that four are on one circle but for rounding: either diagonal "
        "may be Delaunay, and the learner's next point is beside it"
    ),
}


def source_of(package, folder):
    """The source of the version that is installed."""
    version = importlib.metadata.version(package)
    with urllib.request.urlopen(f"https://pypi.org/pypi/{package}/json", timeout=120) as answer:
        files = json.load(answer)["releases"][version]
    where = next(file["url"] for file in files if file["packagetype"] == "sdist")
    # Mirrors name places beside their own.
    where = urllib.parse.urljoin(f"https://pypi.org/simple/{package}/", where)
    with urllib.request.urlopen(where, timeout=300) as answer, tarfile.open(fileobj=io.BytesIO(answer.read())) as archive:
        archive.extractall(folder, filter="data")
    return next(folder.iterdir())


def passing(paths, folder, place):
    """The names of the tests that pass, by SciPy or in its place."""
    folder.mkdir(parents=True, exist_ok=True)
    report = folder / f"{place}.xml"
    report.unlink(missing_ok=True)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "--tb=short",
        "-p",
        "no:cacheprovider",
        f"--junitxml={report}",
        "--timeout=300",
    ]
    # What its authors expect to fail sometimes counts for neither.
    command += ["-W", "ignore", "-o", "xfail_strict=true", *(["-p", "in_place"] if place == "delone" else []), *map(str, paths)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")]))}
    with open(folder / f"{place}.log", "w") as log:
        subprocess.run(command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT, timeout=1800)
    if not report.exists():
        return set()
    cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
    return {f"{case.get('classname')}::{case.get('name')}" for case in cases if not len(case)}


def judge(package, paths, folder):
    """What passes by SciPy and not with Delone."""
    theirs, ours = (passing(paths, folder, place) for place in ("scipy", "delone"))
    less = sorted(name for name in theirs - ours if not any(re.search(pattern, name) for pattern in ARBITRARY))
    print(f"{package}: {len(theirs)} pass by SciPy, {len(ours)} with Delone, {len(ours - theirs)} of them by Delone alone")
    for name in less:
        print(f"  fails: {name}")
    if not theirs:
        print(f"  nothing passes by SciPy: see {folder}/scipy.log")
    return less


def main(folder):
    """All packages."""
    tests = {"functions": [HERE / "downstream_functions.py"]}
    for package, paths in INSTALLED.items():
        found = importlib.util.find_spec(package)
        if found is None:
            print(f"{package} is not installed")
        else:
            tests[package] = [Path(found.origin).parent / path for path in paths]
    for package, paths in IN_SOURCE.items():
        try:
            source = source_of(package, folder / package / "source")
        except (OSError, StopIteration, importlib.metadata.PackageNotFoundError) as error:
            print(f"{package} is not to be had: {error}")
        else:
            tests[package] = [source / path for path in paths]
    less = [name for package, paths in tests.items() for name in judge(package, paths, folder / package)]
    sys.exit(1 if less else 0)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
