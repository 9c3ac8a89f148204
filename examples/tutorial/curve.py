"""Draws the force of the floor over time from the tables of a results folder: no module is needed for that."""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402

with open(sys.argv[1] + "/contact.csv") as table:
    rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
column = next(name for name in rows[0] if name.endswith(".force_z"))
pyplot.plot([float(row["time"]) for row in rows], [float(row[column]) for row in rows])
pyplot.xlabel("time")
pyplot.ylabel(column)
pyplot.savefig("force.png")
