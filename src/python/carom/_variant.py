"""A run of a comparison: what `carom run CASE --out FOLDER --threads 1 --quiet` does, in an interpreter."""

from __future__ import annotations

import argparse
import sys

from carom.case import load
from carom.errors import CaseError, Error, RunError


def main() -> None:
    """Ends the process with the exit code of the command line."""
    parser = argparse.ArgumentParser()
    parser.add_argument("command", choices=["run"])
    parser.add_argument("case")
    parser.add_argument("--out", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--quiet", action="store_true")
    arguments = parser.parse_args()
    try:
        run = load(arguments.case).start(arguments.out, threads=arguments.threads)
        try:
            result = run.finish()
        except RunError:
            result = run.stop()
        sys.exit({"good": 0, "failed": 1}.get(result.verdict, 3))
    except CaseError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except Error as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(3)
