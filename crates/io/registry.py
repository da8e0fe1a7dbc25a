"""Writes the tables of systems by their EPSG numbers, src/crs/registry.rs, from the database of PROJ, or checks them.

    python registry.py [DATABASE]            writes the tables; DATABASE is a proj.db, that of pyproj if none is named
    python registry.py --check [DATABASE]    says what is otherwise in the database, which may be of an earlier release

Numbers and kinds of systems are facts of the EPSG registry (https://epsg.org), which PROJ's database has as tables.
"""

import re
import sqlite3
import sys
from pathlib import Path

TABLES = Path(__file__).parent / "src/crs/registry.rs"
# Columns that a line of the tables has at most.
WIDTH = 116


def kinds(database):
    """All numbers of systems, and those of each kind."""

    def numbers(query):
        return {int(row[0]) for row in database.execute(query) if str(row[0]).isdigit()}

    def all_of(table, condition="1"):
        return numbers(f"SELECT code FROM {table} WHERE auth_name = 'EPSG' AND {condition}")

    def in_feet(table):
        return numbers(
            f"SELECT s.code FROM {table} s JOIN axis a ON a.coordinate_system_auth_name = s.coordinate_system_auth_name"
            " AND a.coordinate_system_code = s.coordinate_system_code AND a.coordinate_system_order = 1"
            " JOIN unit_of_measure u ON u.auth_name = a.uom_auth_name AND u.code = a.uom_code"
            " WHERE s.auth_name = 'EPSG' AND u.name LIKE '%foot%'"
        )

    geodetic, projected, vertical, compound = map(all_of, ("geodetic_crs", "projected_crs", "vertical_crs", "compound_crs"))
    feet = in_feet("projected_crs") | in_feet("vertical_crs")
    return {
        "GEOGRAPHIC": (
            "Systems of longitude and latitude, with or without a height above the ellipsoid",
            all_of("geodetic_crs", "type LIKE 'geographic%'"),
            geodetic | projected | vertical | compound,
        ),
        "COMPOUND": ("Systems that are a horizontal and a vertical one", compound, geodetic | projected | vertical | compound),
        "FEET": ("Projected systems and systems of heights in feet", feet, projected | vertical),
    }


def runs(own, known):
    """The first and the last number of each run, which goes over numbers that nothing has."""
    found = []
    for number in sorted(known):
        if number not in own:
            is_open = False
        elif found and is_open:
            found[-1][1] = number
        else:
            found.append([number, number])
            is_open = True
    return found


def text(database):
    """The tables as Rust."""
    metadata = dict(database.execute("SELECT key, value FROM metadata"))
    version, date = metadata["EPSG.VERSION"].lstrip("v"), metadata["EPSG.DATE"]
    parts = [
        "//! Kinds of systems by their numbers in the EPSG registry, which are facts for everyone. Written by `registry.py`.",
        f"//!\n//! Version {version} of the registry, of {date}. Runs go over numbers that nobody has.\n",
    ]
    for name, (what, own, known) in kinds(database).items():
        parts.append(f"/// {what}: the first and the last of each run.")
        parts.append(f"#[rustfmt::skip]\npub(super) const {name}: &[(u16, u16)] = &[")
        line = "   "
        for first, last in runs(own, known):
            pair = f" ({first}, {last}),"
            if len(line) + len(pair) > WIDTH:
                parts.append(line)
                line = "   "
            line += pair
        parts.append(f"{line}\n];\n")
    return "\n".join(parts).rstrip() + "\n"


def release(version):
    """The numbers of a version, in order."""
    return tuple(map(int, re.findall(r"\d+", version)))


def check(database):
    """What the tables say of the numbers of a database that is not later than they are."""
    written = TABLES.read_text()
    ours = re.search(r"Version ([\d.]+)", written).group(1)
    theirs = dict(database.execute("SELECT key, value FROM metadata"))["EPSG.VERSION"]
    if release(theirs) > release(ours):
        print(f"the registry's version {theirs} is later than that of the tables, {ours}: write them anew")
        return 0
    faults = 0
    for name, (_, own, known) in kinds(database).items():
        table = re.search(rf"const {name}.*?\n\];", written, re.DOTALL).group(0)
        pairs = [tuple(map(int, pair)) for pair in re.findall(r"\((\d+), (\d+)\)", table)]
        wrong = [n for n in sorted(known) if (n in own) != any(first <= n <= last for first, last in pairs)]
        print(f"{name}: {len(known)} numbers of version {theirs}, {len(wrong)} otherwise in the tables {wrong[:10]}")
        faults += len(wrong)
    return faults


def main():
    """Writes or checks."""
    words = sys.argv[1:]
    is_check = "--check" in words
    paths = [word for word in words if word != "--check"]
    if not paths:
        import pyproj

        paths = [str(Path(pyproj.datadir.get_data_dir()) / "proj.db")]
    with sqlite3.connect(f"file:{paths[0]}?mode=ro", uri=True) as database:
        if is_check:
            sys.exit(bool(check(database)))
        TABLES.write_text(text(database))


main()
