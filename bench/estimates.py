#!/usr/bin/env python3
"""What `carom check` foretells of runs, against what they take: steps, and seconds on one core.

    python3 bench/estimates.py build/release/carom CASE.toml...     those given; without any, all of cases/
    --limit 60                                                      seconds after which a run is left

The last line says how many are within a factor of 1.5, runs of less than 1 s left out for their time, which `check` calls
"less than 1 s". Runs that stop are judged by steps alone.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile

SECONDS = {"d": 86400.0, "h": 3600.0, "min": 60.0, "s": 1.0}
FACTOR = 1.5
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


def foretold(program, case):
    """Steps and seconds; None for seconds of less than one."""
    found = subprocess.run([program, "check", case], capture_output=True, text=True, env=ONE_THREAD, check=False).stdout
    steps = sum(int(n) for n in re.findall(r"(\d+) steps? from", found))
    cost = re.search(r"cost +about ([\d.]+) (\w+) on one core", found)
    return steps, float(cost[1]) * SECONDS[cost[2]] if cost else None


def taken(program, case, limit):
    """Steps and seconds of the run, and its exit code; None where it was left."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        try:
            code = subprocess.run([program, "run", case, "--out", out, "--threads", "1", "--quiet"], capture_output=True,
                                  env=ONE_THREAD, timeout=limit, check=False).returncode
        except subprocess.TimeoutExpired:
            return None
        summary = out / "summary.json"
        if not summary.exists():
            return None
        said = json.loads(summary.read_text())
    return said["scheme"]["steps"], said["cost"]["wall_seconds"], code


def is_near(a, b):
    return max(a, b) <= FACTOR * min(a, b)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--limit", type=float, default=60.0)
    options = parser.parse_intermixed_args()
    cases = options.cases or sorted(str(path) for path in pathlib.Path("cases").glob("*/*.toml"))
    steps_near, seconds_near = [], []
    print(f"{'case':52s} {'steps':>8s} {'foretold':>8s} {'s':>8s} {'foretold':>8s}")
    for case in cases:
        steps, seconds = foretold(options.program, case)
        run = taken(options.program, case, options.limit)
        if run is None:
            print(f"{case[-52:]:52s} refused, or more than {options.limit:g} s")
            continue
        print(f"{case[-52:]:52s} {run[0]:8d} {steps:8d} {run[1]:8.2f} {'' if seconds is None else f'{seconds:g}':>8s}"
              f"{'' if run[2] < 2 else '  stopped'}", flush=True)
        steps_near.append(is_near(run[0], steps))
        if run[1] >= 1.0 and run[2] < 2:
            seconds_near.append(is_near(run[1], seconds or 1.0))
    print(f"within a factor of {FACTOR:g}: steps of {sum(steps_near)} of {len(steps_near)}, "
          f"time of {sum(seconds_near)} of {len(seconds_near)} that take a second or more")


if __name__ == "__main__":
    main()
