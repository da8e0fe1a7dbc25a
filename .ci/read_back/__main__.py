"""Reads what delone writes with programs that others wrote, and gives it what they write.

The table is that of the program: each format of docs/reference/formats.md, each content, each direction has a judge
here, or a reason why there is none.

    python .ci/read_back PROGRAM FOLDER [FORMAT...]
"""

import re
import sys
import traceback
from pathlib import Path

import curved
import judged
import kept
import shapes
import solvers
import written

PAGE = Path(__file__).resolve().parents[2] / "docs/reference/formats.md"


def table():
    """Rows of the page: the first ending of a format, what is read from it, what is written to it."""
    for line in PAGE.read_text().splitlines():
        if found := re.match(r"\| `(\w+)`.*?\|.*?\| *(.*?) *\| *(.*?) *\|$", line):
            ending, *contents = found.groups()
            yield ending, *([part.strip() for part in cell.split(", ")] if cell else [] for cell in contents)


def main():
    """Judges all rows, or those of the formats that are named."""
    chosen = set(sys.argv[3:])
    faults, passed, over = [], 0, []
    for ending, reads, writes in table():
        if chosen and ending not in chosen:
            continue
        for direction, contents, judges, needs in (
            ("reads", reads, judged.JUDGES, judged.NEEDS),
            ("writes", writes, written.JUDGES, written.NEEDS),
        ):
            for content in contents:
                row = f"{ending}: {direction} {content}"
                if content not in judges:
                    faults.append(f"{row}: no judge")
                elif needs.get((content, ending), True) is None:
                    over.append(row)
                else:
                    try:
                        judges[content](ending)
                        passed += 1
                    except (Exception, SystemExit):  # meshio ends the program. A judge that cannot read is a fault of the row.
                        faults.append(f"{row}:\n{traceback.format_exc()}")
    if not chosen:
        for judge in (*kept.JUDGES, *shapes.JUDGES, *solvers.JUDGES, *curved.JUDGES):
            try:
                judge()
                passed += 1
            except Exception:
                faults.append(f"{judge.__name__}:\n{traceback.format_exc()}")
    print(*faults, sep="\n")
    for row in over:
        print(f"passed over, for want of a package: {row}")
    print(f"{passed} judgments, {len(faults)} faults")
    sys.exit(bool(faults))


main()
