#!/usr/bin/python3
"""Checks and runs the examples of docs/case_format.md, examples/format/*.toml: without a warning, with a good end.

Usage: format_examples.py CAROM. Works on a copy, since one of them begins where another has ended.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples" / "format"
LAST = "initial_state"  # begins where support.displacement has ended


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copytree(EXAMPLES, pathlib.Path(folder) / "format")
        for case in sorted(copy.glob("*.toml"), key=lambda path: (path.stem == LAST, path.stem)):
            for command in (["check", case.name], ["run", case.name, "--quiet"]):
                done = subprocess.run([program, *command], cwd=copy, check=False, capture_output=True, text=True)
                if done.returncode != 0:
                    failed.append(case.name)
                    print(f"{' '.join(command)} ends with {done.returncode}\n{done.stdout}{done.stderr}", flush=True)
                    break
    print(f"failed: {', '.join(failed)}" if failed else "all examples are good")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
