#!/usr/bin/python3
"""What a step costs from Python over the command line, interleaved: `step()` once for each step, and `until`.

Usage: PYTHONPATH=build/release/python bench/python_step.py build/release/carom [--pairs N] [--threads N]. Each pair is
one run of each kind, in turns; the command line's time is its own (summary.json, steps). Prints medians of the ratios
within pairs, and the extra time of one step.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import carom


def block(divisions, end):
    """A steel block on a plane, explicit steps, no files of fields."""
    return carom.Case({
        "title": "block", "units": "SI",
        "mesh": {"block": [{"origin": [0.0, 0.0, 1e-4], "size": [0.1, 0.1, 0.2], "divisions": divisions,
                            "groups": {"cells": "BLOCK", "zmin": "FOOT", "zmax": "TOP"}}]},
        "materials": {"steel": {"law": "linear_elastic", "E": 2.1e11, "nu": 0.3, "rho": 7800.0}},
        "part": [{"name": "block", "cells": "BLOCK", "material": "steel"}],
        "initial": [{"part": "block", "velocity": [0.0, 0.0, -2.0]}],
        "contact": [{"name": "floor", "kind": "plane", "group": "FOOT", "point": [0.0, 0.0, 0.0],
                     "normal": [0.0, 0.0, 1.0], "measure": "area", "stiffness": 1e13}],
        "scheme": {"kind": "central_differences"}, "time": {"end": end}, "output": {"fields": []},
        "probe": [{"name": "top", "group": "TOP", "quantities": ["displacement", "velocity"]}]})


def by_steps(case, folder, threads):
    """Seconds of the loop that users write."""
    run = case.start(folder / "steps", threads=threads)
    begin = time.perf_counter()
    while run.time < run.end and not run.at_end:
        run.step()
    seconds = time.perf_counter() - begin
    run.finish()
    return seconds


def at_once(case, folder, threads):
    """Seconds of one call."""
    run = case.start(folder / "until", threads=threads)
    begin = time.perf_counter()
    run.until(run.end)
    seconds = time.perf_counter() - begin
    run.finish()
    return seconds


def command_line(program, folder, threads):
    """Its seconds of steps, and their number."""
    subprocess.run([program, "run", folder / "case.toml", "--out", folder / "cli", "--quiet", "--threads", str(threads)],
                   check=True)
    summary = json.loads((folder / "cli/summary.json").read_text())
    return summary["cost"]["phases"]["steps"], summary["scheme"]["steps"]


def measure(program, divisions, end, pairs, threads):
    """One line for one mesh."""
    case = block(divisions, end)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.toml").write_text(case.resolved())
        rows = []
        for i in range(pairs):
            kinds = [lambda: command_line(program, folder, threads), lambda: by_steps(case, folder, threads),
                     lambda: at_once(case, folder, threads)]
            turn = [0, 1, 2][i % 3:] + [0, 1, 2][:i % 3]
            seconds = {k: kinds[k]() for k in turn}
            rows.append((seconds[0][0], seconds[1], seconds[2]))
            steps = seconds[0][1]
    cells = divisions[0] * divisions[1] * divisions[2]
    line = f"{cells:8} cells {steps:6} steps, {1e6 * statistics.median(r[0] for r in rows) / steps:8.1f} us a step"
    for k, kind in ((1, "step()"), (2, "until()")):
        ratio = statistics.median(r[k] / r[0] for r in rows) - 1
        least = min(r[k] for r in rows) / min(r[0] for r in rows) - 1
        extra = statistics.median(r[k] - r[0] for r in rows) / steps
        line += f"; {kind}: {100 * ratio:+.2f} % (of least {100 * least:+.2f} %), {1e6 * extra:+.2f} us"
    print(line, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--pairs", type=int, default=9)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--cells", type=int, choices=(1000, 100000), action="append")
    arguments = parser.parse_args()
    program = pathlib.Path(arguments.program).resolve()
    for cells in arguments.cells or (1000, 100000):
        divisions, end = ([8, 8, 16], 4e-3) if cells == 1000 else ([36, 36, 77], 1e-4)
        measure(program, divisions, end, arguments.pairs, arguments.threads)


if __name__ == "__main__":
    sys.exit(main())
