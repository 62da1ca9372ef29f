#!/usr/bin/env python3
"""docs/truth.md from the rows that the tests of tests/truth wrote.

usage: ledger.py --check ROWS | --write ROWS      ROWS: the file that YARS_LEDGER named (tests/truth/ledger.hpp)

--check compares the document with the rows. Numbers of YARS may differ by a fifth of the tolerance, which rounding and
other compilers need. Rows of tests that were skipped for want of the shared data keep their place in the document.
"""
import csv
import math
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = SOURCE / "docs/truth.md"
SHARED = (SOURCE.parent / "shared/data").is_dir()
FIELDS = ("topic", "term", "outside", "ours", "tolerance", "unit", "source", "why")
HEAD = """# Truth: YARS next to outside numbers

Each row holds one number of YARS against a number that is not ours. `ctest -L truth` checks all of them; it also writes
this page: `tests/truth/ledger.py --write build/release/truth.tsv`. A tolerance is the greatest difference that passes.
Rows whose source is a file need the folder `shared` next to the project.
"""


def number(text, tolerance):
    """The number with one decimal more than its tolerance needs."""
    decimals = max(0, math.ceil(-math.log10(float(tolerance))) + 1)
    shown = f"{float(text):.{decimals}f}"
    return shown.rstrip("0").rstrip(".") if "." in shown else shown


def cells(row):
    unit = f" {row['unit']}" if row["unit"] else ""
    tolerance = row["tolerance"]
    return [row["term"], number(row["outside"], tolerance) + unit, number(row["ours"], tolerance),
            f"{float(tolerance):.2g}", row["source"], row["why"]]


def rendered(rows):
    lines = [HEAD]
    for topic in sorted({row["topic"] for row in rows}):
        lines += [f"## {topic}", "| term | outside | YARS | tolerance | source | why this tolerance |",
                  "| --- | --- | --- | --- | --- | --- |"]
        lines += ["| " + " | ".join(cells(row)) + " |" for row in rows if row["topic"] == topic] + [""]
    return "\n".join(lines).rstrip("\n") + "\n"


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, FIELDS, dialect="excel-tab", quoting=csv.QUOTE_NONE))
    terms = [row["term"] for row in rows]
    for term in terms:
        if terms.count(term) > 1:
            sys.exit(f"{path}: expected each term once, found twice: {term}")
    return rows


def documented():
    """The cells of each row of the document, by term."""
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines() if DOCUMENT.is_file() else []
    table = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]
    return {row[0]: row for row in table if row[0] not in ("term", "---")}


def faults(rows):
    found = documented()
    for row in rows:
        wanted, there = cells(row), found.pop(row["term"], None)
        if there is None:
            yield f"no row: {row['term']}"
        elif wanted[:2] + wanted[3:] != there[:2] + there[3:]:
            yield f"expected {wanted}, found {there}"
        elif abs(float(row["ours"]) - float(there[2])) > 0.2 * float(row["tolerance"]):
            yield f"{row['term']}: expected YARS {wanted[2]}, found {there[2]}"
    if SHARED:
        yield from (f"a row that no test writes: {term}" for term in found)


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("--check", "--write"):
        sys.exit(__doc__)
    path = pathlib.Path(sys.argv[2])
    if not path.is_file():
        sys.exit(f"{path}: expected the rows of the tests of truth, found no file; run ctest -L truth")
    rows = rows_of(path)
    if sys.argv[1] == "--write":
        if not SHARED:
            sys.exit("docs/truth.md: expected the folder shared next to the project, without which rows would be lost")
        DOCUMENT.write_text(rendered(rows), encoding="utf-8")
        return
    wrong = list(faults(rows))
    if wrong:
        sys.exit("\n".join([*wrong, f"docs/truth.md differs: tests/truth/ledger.py --write {path}"]))


if __name__ == "__main__":
    main()
