#!/usr/bin/env python3
"""Print displacement and velocity of the foot A and the free end B of the free bar: CalculiX beside Carom.

    python3 bench/peers/compare_free_bar.py free_bar.dat out/free_bar/probes.csv

The .dat file is that of the deck written by calculix_free_bar.py. Standard library only.
"""

import csv
import math
import re
import sys

HEADING = re.compile(r"\s*(displacements|velocities).*for set (\w+) and time\s+(\S+)")


def read_calculix(path):
    """{(place, quantity, time in nanoseconds): z component}"""
    values, key = {}, None
    with open(path, encoding="ascii") as file:
        for line in file:
            heading = HEADING.match(line)
            if heading:
                quantity = "displacement_z" if heading[1] == "displacements" else "velocity_z"
                key = (heading[2], quantity, round(1.0e9 * float(heading[3])))
            elif key and line.strip():
                values[key] = float(line.split()[3])
                key = None
    return values


def read_carom(path, calculix):
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        columns = {key[:2] for key in calculix}
        return {(*column, round(1.0e9 * float(row["time"]))): float(row[f"{column[0]}.{column[1]}"])
                for row in rows for column in columns}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    calculix = read_calculix(sys.argv[1])
    carom = read_carom(sys.argv[2], calculix)
    for column in sorted({key[:2] for key in calculix}):
        common = sorted(key for key in calculix if key[:2] == column and key in carom)
        print(f"{column[0]} {column[1]}: {'time [s]':>10}{'CalculiX':>16}{'Carom':>16}")
        for key in common[9::10]:
            print(f"{'':>18}{1.0e-9 * key[2]:>10.1e}{calculix[key]:>16.6e}{carom[key]:>16.6e}")
        squares = [(calculix[key] - carom[key]) ** 2 for key in common]
        print(f"{'':>18}root mean square of the difference: {math.sqrt(sum(squares) / len(squares)):.3e}")


if __name__ == "__main__":
    main()
