#!/usr/bin/python3
"""Writes the pages of docs/ that follow from tables of the code: case_format.md, compatibility.md, decks.md,
material_laws.md, quantities.md.

Usage: docs.py [--root ROOT] PROGRAM... The programs are those of the tests that compare such a page with the one of the
repository (`*InTheRepositoryIsCurrent`): each leaves what differs in its TEST_TMPDIR, from where it goes to ROOT/docs.
Exits with 1 where a test fails on what it has written itself.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile


def run(program, folder):
    """The exit code and output of the tests of pages of one program, whose files go to a folder."""
    environment = dict(os.environ, TEST_TMPDIR=f"{folder}/")
    done = subprocess.run([program, "--gtest_filter=*InTheRepositoryIsCurrent"], env=environment, capture_output=True,
                          text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def write(program, docs):
    """Writes the pages of one program; their names, and what it says when it is not content with them."""
    with tempfile.TemporaryDirectory() as folder:
        code, output = run(program, folder)
        pages = sorted(pathlib.Path(folder).glob("*.md"))
        for page in pages:
            shutil.copyfile(page, docs / page.name)
        if code != 0 and pages:
            code, output = run(program, folder)
        return [page.name for page in pages], output if code != 0 else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent)
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    given = parser.parse_args()
    written, failures = [], []
    for program in given.programs:
        pages, failure = write(program.resolve(), given.root.resolve() / "docs")
        written += pages
        failures += [failure] if failure else []
    print(f"docs: written: {', '.join(written)}" if written else "docs: all pages are current")
    print("\n".join(failures), end="")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
