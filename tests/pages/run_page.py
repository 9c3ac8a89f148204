#!/usr/bin/python3
"""Does what a page of the manual says, so that the page is wrong no longer than a test takes.

Usage: run_page.py CAROM PAGE [--module FOLDER]. FOLDER holds the Python module. Works in a folder of its own, where `cases`
and `examples` are those of the repository:

- a block with a file's name, ```toml title="drop.toml"`, is that file;
- `title="drop.toml, added"` goes to the end of it, `title="drop.toml, in place of [time]"` takes the place of that section;
- `title="drop.toml, lines of it"` are lines that this file has, one after the other;
- each command of a block ```sh` is called and has to end with 0, or with N where `# exit code N` follows it; `cd` holds for what follows;
- the lines of a block ```text` are among what the commands before it have said, numbers and spaces aside; `...` is anything;
- blocks ```toml` and ```python` without a name are refused: nothing would test them.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")
EXIT_CODE = re.compile(r" # exit code (\d+)$")


class PageError(Exception):
    """What is wrong with a page."""


def commands_of(block):
    """The commands of a block of sh and the exit codes that they end with."""
    for line in block.replace("\\\n", "").splitlines():
        if line.strip() and not line.startswith("#"):
            code = EXIT_CODE.search(line)
            yield line, int(code[1]) if code else 0


def with_section(text, header, section):
    """A case with a section in the place of its own one of that header."""
    pattern = re.compile(rf"^{re.escape(header)}\n.*?(?=^\[|\Z)", re.DOTALL | re.MULTILINE)
    if len(pattern.findall(text)) != 1:
        raise PageError(f"{header} is not there once")
    return pattern.sub(lambda _: section.rstrip("\n") + "\n\n", text)


def words_of(line):
    """What of a line is compared: no numbers, since machines differ in them, and no more than one space."""
    return " ".join(NUMBER.sub("#", line).split())


class Folder:
    """Where a page is done."""

    def __init__(self, path, program, module):
        self.here = path
        self.said = ""
        (path / "bin").mkdir()
        (path / "bin" / "carom").symlink_to(program)
        for name in ("cases", "examples"):
            (path / name).symlink_to(ROOT / name)
        self.environment = dict(os.environ, PATH=f"{path / 'bin'}:/usr/bin:/bin", PYTHONPATH=str(module), COLUMNS="120")

    def do(self, language, title, block):
        if language == "sh" and title is None:
            self.said = "".join(self.call(line, code) for line, code in commands_of(block))
        elif language == "text" and title is None:
            self.expect(block)
        elif title is None:
            raise PageError(f"a block of {language} without the name of a file, which nothing tests:\n{block}")
        else:
            self.write(title, block)

    def write(self, title, block):
        name, _, how = title.partition(", ")
        file = self.here / name
        if not how:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block)
        elif how == "lines of it":
            if block not in file.read_text():
                raise PageError(f"{name} has not the lines\n{block}")
        elif how == "added":
            file.write_text(file.read_text() + "\n" + block)
        elif how.startswith("in place of "):
            file.write_text(with_section(file.read_text(), how.removeprefix("in place of "), block))
        else:
            raise PageError(f"title=\"{title}\": neither a file nor what becomes of one")

    def call(self, line, code):
        print(f"$ {line}", flush=True)
        if line.startswith("cd "):
            self.here = (self.here / line.removeprefix("cd ")).resolve(strict=True)
            return ""
        done = subprocess.run(["bash", "-c", line], cwd=self.here, env=self.environment, check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        if done.returncode != code:
            raise PageError(f"{line}\nends with {done.returncode}, not {code}, and says\n{done.stdout}")
        return done.stdout

    def expect(self, block):
        said = {words_of(line) for line in self.said.splitlines()}
        for line in block.splitlines():
            if line.strip() not in ("", "...") and words_of(line) not in said:
                raise PageError(f"nothing has said\n{line}\nbut\n{self.said}")


def blocks_of(text):
    """Language, title and text of the blocks of a page."""
    blocks = [(language, title or None, block) for language, title, block in BLOCK.findall(text)]
    if 2 * len(blocks) != len(re.findall(r"^ *```", text, re.MULTILINE)):
        raise PageError("a block of code without a language, or within a list")
    if not any(language == "sh" for language, _, _ in blocks):
        raise PageError("no commands")
    return blocks


def do_page(text, program, module):
    with tempfile.TemporaryDirectory() as folder:
        place = Folder(pathlib.Path(folder), program, module)
        for block in blocks_of(text):
            place.do(*block)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--module", type=pathlib.Path, default=pathlib.Path())
    given = parser.parse_args()
    try:
        do_page(given.page.read_text(), given.program.resolve(), given.module.resolve())
    except PageError as error:
        print(f"{given.page}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
