"""What all judges do: run the program in a folder, gather what is wrong, tell it, and say so by the exit status."""

import contextlib
import io
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np
import shapely


def quiet_read(path):
    """A mesh as meshio reads it, which prints empty lines."""
    with contextlib.redirect_stdout(io.StringIO()):
        return meshio.read(path)


def uncovered(polygons, region):
    """What is wrong with polygons that are to be a coverage, with the area of a region if there is one."""
    faults = []
    invalid = int((~shapely.is_valid(polygons)).sum())
    if invalid:
        faults.append(f"{invalid} of {len(polygons)} invalid")
    if not shapely.coverage_is_valid(polygons):
        faults.append("no coverage")
    try:
        union = shapely.union_all(polygons)
    except shapely.GEOSException:
        return [*faults, "the union raises"]
    if region is not None:
        room = 1e-9 * region.area + 8 * np.spacing(np.abs(region.bounds).max()) * region.length
        if not abs(union.area - region.area) <= room:
            faults.append(f"the union has the area {union.area} of {region.area}")
    return faults


class Judge:
    """Runs the program on named inputs, and counts."""

    def __init__(self, what):
        """Reads PROGRAM FOLDER [SET...] from the command line."""
        self.what = what
        self.program, self.folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
        self.folder.mkdir(parents=True, exist_ok=True)
        self.runs = self.bad = 0

    def chosen(self, sets):
        """The sets by name, or those of them that the command line names."""
        return [(name, made) for name, made in sets.items() if not sys.argv[3:] or name in sys.argv[3:]]

    def run(self, *arguments):
        """What the program says is wrong, if it fails."""
        command = [self.program, *arguments, "-q"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        return [done.stderr.strip().splitlines()[0]] if done.returncode else []

    def told(self, name, faults):
        """Counts a run, and prints its faults."""
        self.runs += 1
        if faults:
            self.bad += 1
            print(f"{name}: {'; '.join(faults)}")

    def end(self):
        """The verdict."""
        print(f"{self.what}: {self.runs} judged, {self.bad} with a fault")
        sys.exit(self.bad > 0)
