#!/usr/bin/env python3
"""Print the two tables of SDNV100 (Code_Aster manual V5.03.100, modelling A) beside Carom's results.

    python3 tools/sdnv100_tables.py out/sdnv100

reads <folder>/as_published and <folder>/current (probes.csv, energy.csv, summary.json). Standard library only.
"""

import csv
import json
import math
import pathlib
import sys

WIDTH = 97

# quantity, time [s], reference of the manual, Code_Aster in the manual, marks on (Code_Aster, time)
POINTS = [
    ("DZ at B", "B.displacement_z", 4.0e-5, -2.0e-3, -1.999e-3, ""),
    ("DZ at B", "B.displacement_z", 8.0e-5, -1.0e-3, -0.987e-3, ""),
    ("DZ at B", "B.displacement_z", 1.2e-4, 3.0e-3, 2.948e-3, ""),
    ("VZ at B", "B.velocity_z", 4.0e-5, -1.0e2, -9.999e2, "[1]"),
    ("VZ at B", "B.velocity_z", 8.0e-5, 1.0e2, 1.052e2, ""),
    ("VZ at A", "A.velocity_z", 1.2e-4, 1.0e2, 0.988e2, "[2]"),
    ("VZ at B", "B.velocity_z", 1.2e-4, 1.0e2, 1.079e2, "[2]"),
]
MENDED_POINTS = [
    ("VZ at B", "B.velocity_z", 4.0e-5, -1.0e2, -9.999e1, "[1]"),
    ("VZ at A", "A.velocity_z", 1.32e-4, 1.0e2, 0.988e2, "[2]"),
    ("VZ at B", "B.velocity_z", 1.32e-4, 1.0e2, 1.079e2, "[2]"),
]
# term, manual, today's value of Code_Aster's own test, mark
ENERGIES = [
    ("ENER_CIN", -2.65620e2, -265.61970899411, ""),
    ("ENER_TOT", 1.21507e1, 12.150682708322, ""),
    ("TRAV_LIAI", 5.92346e-1, -0.59234613044, "[3]"),
    ("DISS_SCH", 2.54061e2, 254.06137241623, ""),
]
FOOTNOTES = [
    "[1] Misprint of the manual: -9.999e+2 stands for -9.999e+1.",
    "[2] Misprint of the manual, probably of the time: its data give these velocities at 1.32e-4 s.",
    "[3] Misprint of the manual: the sign was lost; the work is negative.",
    "Code_Aster's mesh file is rounded to single precision; on it (cases/sdnv100/current_msh.toml) Carom",
    "gives all the digits of its energies.",
]


class TableError(Exception):
    """The results cannot be read; the message says which and how to make them."""


def read_rows(path):
    """Rows of a results table as dictionaries; lines with '#' are comments."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        raise TableError(f"{path}: {error.strerror}; run the case first, `make demo` runs both") from error


def value(rows, column, time, path):
    """Value of a column at a time, which must be a step of the run."""
    row = min(rows, key=lambda r: abs(float(r["time"]) - time), default=None)
    if row is None or not math.isclose(float(row["time"]), time, rel_tol=1e-9):
        raise TableError(f"{path}: no row at t = {time:g} s; the run is incomplete or has another step")
    if column not in row:
        raise TableError(f"{path}: no column {column}")
    return float(row[column])


def percent(found, reference):
    difference = 100.0 * (found - reference) / abs(reference)
    return f"{difference:+.3f}" if abs(difference) >= 5.0e-4 else f"{difference:+.0e}"


def outcome_line(folder):
    path = folder / "summary.json"
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
        return f"outcome: {summary['outcome']}; {summary['message']}"
    except (OSError, ValueError, KeyError) as error:
        raise TableError(f"{path}: {error}") from error


def table_line(name, time, reference, aster, carom, differences):
    """A reference or a value of Code_Aster may carry a mark: "5.92346e-01[3]"."""
    texts = [text + ("" if text.endswith("]") else "   ") for text in (reference, aster)]
    return (f"{name:<14}{time:>9}{texts[0]:>16}{texts[1]:>18}{carom:>18}"
            + "".join(f"{difference:>11}" for difference in differences))


def table_head(name, reference, aster):
    return table_line(name, "time [s]", reference, aster, "Carom", ["to ref. %", "to C_A %"])


def point_lines(folder, points):
    path = folder / "probes.csv"
    rows = read_rows(path)
    lines = []
    for name, column, time, reference, aster, mark in points:
        carom = value(rows, column, time, path)
        lines.append(table_line(name, f"{time:.2e}", f"{reference:.3e}", f"{aster:.3e}{mark}", f"{carom:.9e}",
                                [percent(carom, reference), percent(carom, aster)]))
    return lines


def energy_lines(folder):
    path = folder / "energy.csv"
    rows = read_rows(path)
    lines = [table_head("energy [J]", "manual", "Code_Aster now")]
    for term, manual, today, mark in ENERGIES:
        carom = value(rows, term, 1.4e-4, path)
        lines.append(table_line(term, "1.40e-04", f"{manual:.5e}{mark}", f"{today:.11g}", f"{carom:.11g}",
                                [percent(carom, manual), percent(carom, today)]))
    return lines


def tables(out):
    published, current = out / "as_published", out / "current"
    return [
        "SDNV100: impact of a beam on a rigid wall (Code_Aster manual V5.03.100, modelling A)",
        "=" * WIDTH,
        "Table 1. Quarter beam, nu = 0.3, guided laterally, contact element of zero thickness, 1e14 Pa/m.",
        "Displacement DZ [m], with the initial +2 mm, and velocity VZ [m/s]; A: foot, B: free end.",
        "",
        table_head("as printed", "reference", "Code_Aster"),
        *point_lines(published, POINTS),
        "misprints mended:",
        *point_lines(published, MENDED_POINTS),
        outcome_line(published),
        "-" * WIDTH,
        "Table 2. Full beam, nu = 0, 1e10 N/m under each foot node: the model of the manual's energies.",
        "",
        *energy_lines(current),
        outcome_line(current),
        "=" * WIDTH,
        "Last columns: difference of Carom to the reference and to Code_Aster (C_A), in percent.",
        *FOOTNOTES,
    ]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        print("\n".join(tables(pathlib.Path(sys.argv[1]))))
    except TableError as error:
        sys.exit(f"sdnv100_tables: {error}")


if __name__ == "__main__":
    main()
