#!/usr/bin/python3
"""Which lines of src/ the unit tests run.

Usage: coverage.py [--at-least PERCENT] [--no-run] [--build FOLDER] [--jobs N]

Builds the preset `coverage`, runs the unit tests through ctest, and reads what GCC's counters saw by gcov: lines by
folder, files of which no line is run, functions that no test enters. A line of a header counts as run if any of its
instances is. Exit code 1 if fewer lines than --at-least are run, or if a test fails. --no-run reads the counters that
are there.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Counts:
    """Times that lines and functions of src/ were run."""

    def __init__(self, root):
        self.src = root / "src"
        self.lines = collections.defaultdict(collections.Counter)  # file: {line: times}
        self.functions = collections.defaultdict(dict)  # file: {first line: (name, times)}

    def add(self, report):
        """Takes in one report of gcov, as its JSON has it."""
        for file in report["files"]:
            path = pathlib.Path(os.path.normpath(os.path.join(report["current_working_directory"], file["file"])))
            if not path.is_relative_to(self.src):
                continue
            name = str(path.relative_to(self.src.parent))
            for line in file["lines"]:
                self.lines[name][line["line_number"]] += line["count"]
            for function in file["functions"]:
                begin = function["start_line"]
                known, times = self.functions[name].get(begin, (function["demangled_name"], 0))
                self.functions[name][begin] = (known, times + function["execution_count"])

    def by_folder(self):
        """{folder: (lines run, lines)}, and the sum of all under `all`."""
        sums = collections.defaultdict(lambda: [0, 0])
        for name, lines in self.lines.items():
            for folder in (name.split("/")[1], "all"):
                sums[folder][0] += sum(times > 0 for times in lines.values())
                sums[folder][1] += len(lines)
        return {folder: tuple(pair) for folder, pair in sums.items()}

    def never_run(self):
        """(file, line, function) of each function of which no instance was entered."""
        return [(name, begin, function) for name, known in sorted(self.functions.items())
                for begin, (function, times) in sorted(known.items()) if times == 0]


def gcov(notes):
    """The reports of gcov on one object file."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["gcov", "--json-format", "--stdout", notes], cwd=folder, capture_output=True, text=True,
                              check=True)
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


def read(root, build, jobs):
    """The counts of all object files in a build folder that have run."""
    counts = Counts(root)
    objects = sorted(build.rglob("*.gcno"))
    if not objects:
        raise SystemExit(f"coverage: no notes of the compiler (.gcno) in {build}; is it built with --coverage?")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for reports in pool.map(gcov, objects):
            for report in reports:
                counts.add(report)
    return counts


def table(counts):
    """Lines by folder and by file, and functions that nothing entered, as a page."""
    sums = counts.by_folder()
    rows = ["| folder | lines | run | |", "|---|---|---|---|"]
    for folder in [*sorted(set(sums) - {"all"}), "all"]:
        run, lines = sums.get(folder, (0, 0))
        rows.append(f"| {folder} | {lines} | {run} | {run / max(1, lines):.1%} |")
    rows += ["", "Files of which no line was run:", ""]
    rows += [f"- `{name}`" for name, lines in sorted(counts.lines.items()) if not any(lines.values())] or ["none"]
    rows += ["", "Functions that nothing entered:", ""]
    rows += [f"- `{name}:{begin}` `{function}`" for name, begin, function in counts.never_run()] or ["none"]
    return "\n".join(rows) + "\n"


def run_tests(build, jobs):
    """Builds, takes away old counters and runs the tests; whether all passed."""
    subprocess.run([ROOT / "tools/build", "coverage", "all"], check=True)
    for old in build.rglob("*.gcda"):
        old.unlink()
    done = subprocess.run(["ctest", "--preset", "coverage", "-L", "unit", "-j", str(jobs)], cwd=ROOT, check=False)
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="tree whose src/ is looked at")
    parser.add_argument("--build", type=pathlib.Path, help="folder of the build (build/coverage)")
    parser.add_argument("--at-least", type=float, default=95.0, help="bound in per cent of all lines")
    parser.add_argument("--no-run", action="store_true", help="read the counters that are there")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    root = options.root.resolve()
    build = (options.build or root / "build/coverage").resolve()
    passed = options.no_run or run_tests(build, options.jobs)
    counts = read(root, build, options.jobs)
    print(table(counts))
    run, lines = counts.by_folder().get("all", (0, 0))
    enough = 100.0 * run >= options.at_least * lines
    print(f"coverage: {run} of {lines} lines run, {run / max(1, lines):.1%}; "
          f"{'at least' if enough else 'below'} {options.at_least:g} %")
    return 0 if enough and passed else 1


if __name__ == "__main__":
    sys.exit(main())
