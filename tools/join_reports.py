#!/usr/bin/python3
"""Joins the reports of several runs into one page.

Usage: join_reports.py OUT NAME...: OUT/report.html holds OUT/tables.txt and, each in a frame of its own, the pages
OUT/NAME/report.html. The page needs no other file and no network.
"""

import html
import pathlib
import sys

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>SDNV100 by Carom</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ margin: 0 auto; max-width: 86rem; padding: 1.5rem; font: 1rem/1.5 system-ui, sans-serif; }}
pre {{ overflow-x: auto; font-size: .85rem; line-height: 1.35; }}
iframe {{ width: 100%; height: 60rem; border: 1px solid #8886; border-radius: .5rem; }}
</style></head><body>
<h1>SDNV100: a beam strikes a rigid wall</h1>
<p>Both models behind the published tables, computed and set beside them.</p>
<pre>{tables}</pre>
{frames}
<script>
for (const frame of document.querySelectorAll("iframe")) {{
  const fit = () => {{ frame.style.height = frame.contentDocument.documentElement.scrollHeight + 16 + "px"; }};
  frame.addEventListener("load", () => {{ fit(); new ResizeObserver(fit).observe(frame.contentDocument.body); }});
}}
</script>
</body></html>
"""


def main(out, names):
    out = pathlib.Path(out)
    frames = [f'<h2 id="{name}">{name}</h2>\n'
              f'<iframe title="{name}" srcdoc="{html.escape((out / name / "report.html").read_text())}"></iframe>'
              for name in names]
    tables = html.escape((out / "tables.txt").read_text())
    (out / "report.html").write_text(PAGE.format(tables=tables, frames="\n".join(frames)))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
