#!/usr/bin/python3
"""Measures the program and writes docs/performance.md.

Usage: performance.py [--only SECTION,SECTION] [--page]. Sections: machine, kernels, steps, scaling, implicit, profiles,
peers; the machine is measured in every call. What was measured lies in build/performance.json, where sections that are
not measured again stay as they were; --page writes the page from it alone. Programs: build/release.
"""

import argparse
import importlib
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA = ROOT / "build/performance.json"
PAGE = ROOT / "docs/performance.md"
SECTIONS = ("machine", "kernels", "steps", "scaling", "implicit", "profiles", "peers")


class Bench:
    """What the sections work with: programs, a folder, a line on the terminal of what is being measured."""

    def __init__(self, folder):
        self.root = ROOT
        self.folder = folder
        self.section = ""
        self.begin = time.monotonic()

    def program(self, name):
        return ROOT / "build/release" / name

    def say(self, text):
        print(f"[{time.monotonic() - self.begin:5.0f} s] {self.section}: {text}", flush=True)


def commit():
    """Abbreviated commit, with a + where sources of the program differ from it."""
    git = lambda *words: subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=True).stdout
    return git("rev-parse", "--short=12", "HEAD").strip() + ("+" if git("status", "--porcelain", "--", "src") else "")


def write_page(data):
    lines = ["# Performance", "",
             "Written by `make bench`; what is measured, and how, stands in `bench/`. Everything is measured twice; "
             "the better figure is shown, with the spread, (larger - smaller) / smaller, in percent in brackets. "
             "Figures are to compare with each other, not with those of another machine or day."]
    for name in SECTIONS:
        if name in data:
            section = importlib.import_module(f"sections.{name}")
            found = {other: record["found"] for other, record in data.items()}
            lines += ["", f"## {section.TITLE}", "", *section.page(found[name], found), "",
                      f"Commit `{data[name]['commit']}`, {data[name]['date']}, {data[name]['seconds']:.0f} s."]
    PAGE.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--only", default=",".join(SECTIONS))
    options.add_argument("--page", action="store_true")
    given = options.parse_args()
    wanted = given.only.split(",")
    if set(wanted) - set(SECTIONS):
        options.error(f"sections are {', '.join(SECTIONS)}")
    data = json.loads(DATA.read_text(encoding="utf-8")) if DATA.exists() else {}
    if not given.page:
        with tempfile.TemporaryDirectory(dir=DATA.parent) as folder:
            bench = Bench(pathlib.Path(folder))
            for name in SECTIONS:
                if name in wanted or name == "machine":
                    bench.section, begin = name, time.monotonic()
                    found = importlib.import_module(f"sections.{name}").measure(
                        bench, {other: record["found"] for other, record in data.items()})
                    data[name] = {"found": found, "commit": commit(), "date": time.strftime("%Y-%m-%d"),
                                  "seconds": time.monotonic() - begin}
                    DATA.write_text(json.dumps(data, indent=1), encoding="utf-8")
    data = json.loads(DATA.read_text(encoding="utf-8"))
    write_page(data)
    print(f"written: {PAGE.relative_to(ROOT)}")


if __name__ == "__main__":
    sys.exit(main())
