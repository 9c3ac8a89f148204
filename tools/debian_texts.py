#!/usr/bin/python3
"""Copyright and changelog as Debian's packages have them.

Usage: debian_texts.py VERSION FOLDER
"""

import email.utils
import gzip
import pathlib
import subprocess
import sys
import textwrap
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

COPYRIGHT = """Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: carom

Files: *
Copyright: 2026 the Carom developers
License: GPL-3.0+

Files: usr/bin/carom
Copyright: 2026 the Carom developers
 dygraphs: Dan Vanderkam and the authors of dygraphs (MIT), built in for the curves of reports
 three.js: the authors of three.js (MIT), built in for the view of reports
License: GPL-3.0+

Files: usr/share/doc/carom/html/*
Copyright: 2026 the Carom developers
 Material for MkDocs: Martin Donath (MIT), scripts and style sheets of the pages
License: GPL-3.0+

License: GPL-3.0+
 On Debian systems the text of the GNU General Public License, version 3, stands in
 /usr/share/common-licenses/GPL-3.
"""


def date():
    """Of the commit, so that a package can be made again; of today outside of a repository."""
    done = subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%ct"], capture_output=True, text=True, check=False)
    return email.utils.formatdate(int(done.stdout) if done.returncode == 0 else time.time())


def main():
    version, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "copyright").write_text(COPYRIGHT, encoding="utf-8")
    lines = [f"carom ({version}) unstable; urgency=medium", ""]
    for path in sorted((ROOT / "changelog.d").glob("*.md")):
        if path.name != "README.md":
            words = " ".join(path.read_text(encoding="utf-8").split())
            lines += textwrap.wrap(words, 78, initial_indent="  * ", subsequent_indent="    ")
    lines += ["", f" -- The Carom developers <carom@example.org>  {date()}", ""]
    with gzip.GzipFile(folder / "changelog.gz", "wb", 9, mtime=0) as stream:
        stream.write("\n".join(lines).encode())


if __name__ == "__main__":
    main()
