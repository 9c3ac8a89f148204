#!/usr/bin/python3
"""Runs cases by carom and by carom-mpi on several ranks and compares the results folders byte by byte.

Usage: same_bits.py CAROM CAROM_MPI [CASE...] [--ranks 2,3] [--threads 1,2] [--limit SECONDS].
Without cases: all of cases/. Of summary.json all but the cost and the number of threads is compared; report.html is made
from the other files and shows the cost. A case whose run by carom takes longer than the limit is left out, and counted.
Exits with 1 if any byte differs.
"""

import argparse
import filecmp
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Threads that wait give their core to others: there may be more of them than cores.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}


def on_ranks(ranks, *command):
    return [ROOT / "tools/on_ranks", str(ranks), *map(str, command)]


def run(command, limit=None):
    """The exit code, or None when the limit has passed."""
    try:
        return subprocess.run(list(map(str, command)), env=os.environ | ENVIRONMENT, capture_output=True,
                              timeout=limit).returncode
    except subprocess.TimeoutExpired:
        return None


def summary_of(folder):
    summary = json.loads((folder / "summary.json").read_text())
    summary.pop("cost")
    summary["program"].pop("threads")
    return summary


def differences(one, other):
    """Names of the files that differ or that only one of the folders has."""
    names = {str(path.relative_to(folder)) for folder in (one, other) for path in folder.rglob("*") if path.is_file()}
    names -= {"report.html", "summary.json"}
    found = [name for name in sorted(names)
             if not (one / name).is_file() or not (other / name).is_file()
             or not filecmp.cmp(one / name, other / name, shallow=False)]
    return found + (["summary.json"] if summary_of(one) != summary_of(other) else [])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("carom", type=pathlib.Path)
    parser.add_argument("carom_mpi", type=pathlib.Path)
    parser.add_argument("cases", nargs="*", type=pathlib.Path)
    parser.add_argument("--ranks", default="2")
    parser.add_argument("--threads", default="1", help="of each rank")
    parser.add_argument("--limit", type=float, default=None)
    given = parser.parse_args()
    cases = given.cases or sorted((ROOT / "cases").rglob("*.toml"))
    bad = left_out = same = 0
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            alone = run([given.carom, "run", case, "--out", folder / "alone", "--quiet"], given.limit)
            if alone is None:
                left_out += 1
                continue
            for ranks, threads in itertools.product(given.ranks.split(","), given.threads.split(",")):
                out = folder / f"{ranks}_{threads}"
                limit = given.limit and 10.0 * given.limit
                code = run(on_ranks(ranks, given.carom_mpi, "run", case, "--out", out, "--quiet", "--threads", threads),
                           limit)
                found = ["it does not end"] if code is None else [] if code == alone else [f"exit code {code}, {alone} alone"]
                found += differences(folder / "alone", out) if code is not None and (out / "summary.json").is_file() else []
                same += not found
                bad += bool(found)
                if found:
                    print(f"{case} on {ranks} ranks of {threads} threads: {', '.join(found)}", flush=True)
    print(f"{same} runs with the same bytes, {bad} with others; {left_out} cases took longer than the limit")
    return 1 if bad or same == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
