#!/usr/bin/python3
"""Checks that no file of the repository holds an absolute path of somebody's machine or the address of a package
registry: what the project needs it names as a Debian package (tools/packages.txt).

Usage: check_words.py [ROOT]. Looks at the text files that git lists (tracked or new, not ignored); where ROOT is no git
repository, at all files. Prints each offence as file:line and exits with 1 if there is any.
"""

import pathlib
import re
import subprocess
import sys

# Each pattern is written so that it does not match itself.
OFFENCES = {
    "absolute path of a machine": re.compile(r"(?<![\w.}/])/(?:wor[k]|roo[t]|hom[e]|Users|mnt|tm[p]|var/tm[p])/\w"),
    "address of a package registry": re.compile(
        r"pypi[.]org|pythonhosted[.]org|npmjs[.]|yarnpkg[.]com|crates[.]io|rubygems[.]org|[.]pkg[.]dev|conan[.]io|"
        r"(?:deb|security|snapshot|ftp)[.]debian[.]org|archive[.]ubuntu[.]com|proxy[.]golang[.]org|anaconda[.]org"),
}


def listed_files(root):
    """Files to check, relative to root."""
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    answer = subprocess.run(command, capture_output=True, check=False) if (root / ".git").exists() else None
    if answer is None or answer.returncode != 0:
        return sorted(path.relative_to(root) for path in root.rglob("*") if path.is_file())
    return sorted({pathlib.Path(name) for name in answer.stdout.decode().split("\0") if name})


def check(root):
    """All offences as lines of text."""
    lines = []
    for name in listed_files(root):
        path = root / name
        if name == pathlib.Path("LICENSE") or not path.is_file():
            continue
        try:
            text = path.read_text()
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            lines += [f"{name}:{number}: {what}: {match[0]}" for what, pattern in OFFENCES.items()
                      if (match := pattern.search(line))]
    return lines


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    lines = check(root)
    print("\n".join(lines) if lines else "words: no machine paths, no registry addresses")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
