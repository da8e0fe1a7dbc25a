#!/usr/bin/env python3
"""Judges tables of tiles as GeoPandas and PROJ read them: places, heights, and the system of coordinates.

.ci/judges/tables.py PROGRAM FOLDER [SET...]
"""

import shutil

import geopandas
import numpy as np
import pyproj
from judging import Judge

# Systems that a number alone defines; one that it does not; none.
SYSTEMS = [4326, 4258, 4269, 25832, 32601, 32760, 26910, 2056, None]


def judge_table(folder, points, system):
    """What is wrong with the tables of a folder."""
    faults = []
    found, rows_of = [], []
    for path in sorted(folder.glob("points-*.parquet")):
        table = geopandas.read_parquet(path)
        known = None if table.crs is None else pyproj.CRS(table.crs)
        expected = None if system in (None, 2056) else pyproj.CRS(system)
        if (known is None) != (expected is None):
            faults.append(f"the system is {known}")
        elif known is not None:
            # Places are longitude before latitude, whatever the order of the axes is.
            place = [[500_000.0, 400_000.0]] if expected.is_projected else [[9.0, 48.0]]
            there = [
                pyproj.Transformer.from_crs(crs, "OGC:CRS84", always_xy=True).transform(*np.transpose(place))
                for crs in (known, expected)
            ]
            if not np.allclose(*there, rtol=0, atol=1e-9):
                faults.append(f"{known.name} is elsewhere than EPSG:{system}")
            if system != 4326 and known.to_epsg() != system:
                faults.append(f"{known.name} is EPSG:{known.to_epsg()}")
        if table.geometry.has_z.all() != (points.shape[1] == 3) or table.geometry.isna().any():
            faults.append("places are not what they were")
        columns = [table.geometry.x, table.geometry.y, *([table.geometry.z] if points.shape[1] == 3 else [])]
        found.append(np.column_stack(columns))
        rows_of.append(table["row"].to_numpy())
        if not (found[-1][:, :2] == table[["x", "y"]].to_numpy()).all():
            faults.append("x and y differ from the places")
    rows, places = np.concatenate(rows_of), np.concatenate(found)
    if len(rows) != len(points) or not (places == points[rows]).all():
        faults.append("points differ")
    return faults


def main():
    """Judges all sets."""
    judge = Judge("tables")
    sets = {"plane": np.random.default_rng(1).random((900, 2)), "heights": np.random.default_rng(2).random((900, 3))}
    for name, points in judge.chosen(sets):
        np.save(judge.folder / "points.npy", points)
        for system in SYSTEMS:
            shutil.rmtree(judge.folder / "tiles", ignore_errors=True)
            more = [] if system is None else ["--epsg", str(system)]
            more += ["--heights"] if points.shape[1] == 3 else []
            faults = judge.run("tiles", "points.npy", "-o", "tiles", "--parquet", "--tile", "300", *more)
            judge.told(f"{name}, {system}", faults or judge_table(judge.folder / "tiles", points, system))
    judge.end()


if __name__ == "__main__":
    main()
