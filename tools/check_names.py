#!/usr/bin/python3
"""Checks that what the pages of docs/ say about the code stands where they say.

Usage: check_names.py [ROOT]. In every table of docs/*.md that has a column `stands in`, that column names a file of
src/ (`system/system.hpp`), and each word of code in the first column (`System`, `March::make_step`) is a word of that
file. Where docs/map.md is, it has such a row for every folder of src/. Prints each offence as file:line and exits with
1 if there is any.
"""

import pathlib
import re
import sys

HEAD = "stands in"
CODE = re.compile(r"`([^`]+)`")
WORD = re.compile(r"\w+")


def cells_of(line):
    """The cells of a row of a table, None for any other line."""
    return [cell.strip() for cell in line.strip()[1:-1].split("|")] if line.startswith("|") else None


def rows_of(text):
    """Line number, words of code and file of every row that says where something stands."""
    column = None
    for number, line in enumerate(text.splitlines(), 1):
        cells = cells_of(line)
        if cells is None:
            column = None
        elif HEAD in cells:
            column = cells.index(HEAD)
        elif column is not None and column < len(cells) and not set(line) <= set("|-: "):
            file = CODE.findall(cells[column])
            yield number, CODE.findall(cells[0]), file[0] if file else ""


def check_page(root, page):
    """Offences of one page as lines of text, and the folders that it tells of."""
    lines, folders = [], set()
    for number, names, file in rows_of(page.read_text()):
        place = f"{page.relative_to(root)}:{number}: "
        folders.add(file.split("/")[0])
        if not (root / "src" / file).is_file():
            lines.append(f"{place}no such file: src/{file}")
            continue
        words = set(WORD.findall((root / "src" / file).read_text()))
        lines += [f"{place}src/{file} has no {word}" for name in names for word in WORD.findall(name)
                  if word not in words]
    return lines, folders


def check(root):
    """All offences as lines of text."""
    lines = []
    for page in sorted((root / "docs").glob("*.md")):
        offences, folders = check_page(root, page)
        lines += offences
        if page.name == "map.md":
            lines += [f"docs/map.md: nothing of src/{folder.name}" for folder in sorted((root / "src").iterdir())
                      if folder.is_dir() and folder.name not in folders]
    return lines


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    lines = check(root)
    print("\n".join(lines) if lines else "names: all stand where the pages say")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
