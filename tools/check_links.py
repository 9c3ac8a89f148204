#!/usr/bin/python3
"""Checks that the links between the repository's Markdown pages, and to its pictures and files, lead somewhere.

Usage: check_links.py [ROOT]. Prints each dead link as file:line and exits with 1 if there is any. Links to other sites
are not followed.
"""

import pathlib
import re
import sys

from check_words import listed_files

LINK = re.compile(r"\[[^\]]*\]\(([^)\s#]+)(?:#[^)]*)?\)")


def check(root):
    """All dead links as lines of text."""
    lines = []
    for name in listed_files(root):
        if name.suffix != ".md" or not (root / name).is_file():
            continue
        for number, line in enumerate((root / name).read_text().splitlines(), 1):
            lines += [f"{name}:{number}: dead link: {target}" for target in LINK.findall(line)
                      if ":" not in target and not (root / name.parent / target).exists()]
    return lines


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    lines = check(root)
    print("\n".join(lines) if lines else "links: all lead somewhere")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
