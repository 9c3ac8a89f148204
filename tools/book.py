#!/usr/bin/python3
"""The verification book: every check of every case, run anew, and the pages of docs/ that hold tables of comparisons, as
out/book/verification.html and verification.pdf.

Usage: book.py CAROM
"""

import argparse
import base64
import html
import mimetypes
import pathlib
import re
import subprocess
import sys
import time

import book_tables
import case_pictures
import case_runs
import markdown
from case_runs import ROOT

CHAPTERS = ("sdnv100", "schemes", "taylor_bar", "locking", "verification", "trials")  # of docs/

STYLE = """
body { font: 10.5pt/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 62rem; padding: 1.5rem; color: #1d2429; background: #fff; }
h1 { font-size: 1.9rem; } h2 { margin-top: 2.5rem; border-bottom: 1px solid #ccd1d4; } h3 { margin: 1.6rem 0 .3rem; }
table { border-collapse: collapse; font-size: 8.5pt; width: 100%; margin: .6rem 0; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid #dde1e3; padding: .2rem .45rem; text-align: left; vertical-align: top; overflow-wrap: anywhere; }
td.number, th.number { text-align: right; white-space: nowrap; } td:first-child { white-space: nowrap; }
.pass { color: #1f6f43; white-space: nowrap; } .fail { color: #a32c22; font-weight: 600; white-space: nowrap; }
code { font-size: .92em; } pre { background: #f4f5f6; padding: .6rem; overflow-x: auto; white-space: pre-wrap; }
img { max-width: 100%; } img.case { float: right; width: 15rem; margin: 0 0 .6rem 1rem; border: 1px solid #dde1e3; }
h3, table { clear: both; } table.sums { font-size: 9pt; } .sums th, .sums :is(td, .number) { white-space: normal; overflow-wrap: normal; } .sums td:first-child { min-width: 14rem; } .sources { font-size: 8.5pt; color: #5b666d; } nav ol { columns: 2; } .soft { color: #5b666d; }
@media print { body { max-width: none; padding: 0; } h2 { break-before: page; } h3 { break-after: avoid; } tr { break-inside: avoid; } a { color: inherit; } }
"""

WIDTH, HEIGHT = 460, 280  # of the pictures


def picture_of(path):
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<img class="case" alt="" src="data:image/png;base64,{data}">'


def case_section(found, text, elsewhere, picture, sources):
    checks, scheme = found.summary["checks"], found.summary["scheme"]
    body = (book_tables.check_table(checks, sources) if checks
            else '<p class="soft">No checks of its own: its verdict is compared with nothing but the books.</p>')
    rest = f'{"The rest as" if text else "As"} in {elsewhere}.' if elsewhere else ""
    words = f'{html.escape(text)} <span class="soft">{html.escape(rest)}</span>'
    cells = found.summary["mesh"]["cells"]
    return (f'<h3 id="{book_tables.anchor(found.name)}">{html.escape(found.title)}</h3>{picture_of(picture) if picture else ""}<p>{words}</p>'
            f'<p class="soft">cases/{found.name}.toml · {cells} cell{"" if cells == 1 else "s"} · {html.escape(scheme["name"])} · '
            f'{scheme["steps"]} steps · {html.escape(found.summary["outcome"])}: {html.escape(found.summary["message"])}</p>{body}')


def folder_section(folder, runs, pictures):
    """The cases of a folder; what several of them say, and sources of their values, once."""
    sources, parts = [], [f'<h2 id="folder-{folder}">cases/{folder}</h2>']
    texts = book_tables.said_once([(found.name.split("/", 1)[1], found.text) for found in runs])
    for found, (text, elsewhere) in zip(runs, texts):
        parts.append(case_section(found, text, elsewhere, pictures.get(found.name), sources))
    return "\n".join([*parts, book_tables.source_list(sources)])


def with_pictures(text):
    """Pictures of docs/ inside of the page; links to other files of the project as text."""
    def inside(match):
        path = ROOT / "docs" / match.group(1)
        data = base64.b64encode(path.read_bytes()).decode()
        return f'src="data:{mimetypes.guess_type(path.name)[0]};base64,{data}"'

    text = re.sub(r'src="([^":]+)"', inside, text)
    return re.sub(r'<a href="(?!https?:|#)[^"]*">(.*?)</a>', r"\1", text, flags=re.DOTALL)


def chapter(name):
    source = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    text = markdown.markdown(source, extensions=["tables", "fenced_code"])
    for level in (4, 3, 2, 1):  # its title becomes a chapter of the book
        text = re.sub(rf"<(/?)h{level}>", rf"<\1h{level + 1}>", text)
    return source.splitlines()[0].lstrip("# "), with_pictures(text)


FIRST_PAGE = """
<p>Value: what was computed, to the second digit of what it may be off by; below that it is a zero. Theory: what it stands against. Error: three
digits, in percent of the theory where that is not about zero (less than five times what is allowed). The numbers of the sources lead to the list at the end of their chapter. Balances that
every run has to close (energy, momentum: its verdict) are not among the values; a run whose verdict fails is named with its message.</p>
"""


def book(runs, version, pictures):
    folders = {}
    for found in runs:
        folders.setdefault(found.name.split("/")[0], []).append(found)
    checks = [check for found in runs for check in found.summary["checks"]]
    passed = sum(check["pass"] for check in checks)
    good = sum(found.summary["outcome"] == "good" for found in runs)
    git = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=12", "HEAD"], capture_output=True, text=True, check=False)
    chapters = [chapter(name) for name in CHAPTERS]
    contents = [(f"folder-{folder}", f"cases/{folder}") for folder in folders]
    contents += [(f"chapter-{name}", title) for name, (title, _) in zip(CHAPTERS, chapters)]
    parts = [
        "<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">', "<title>Verification · Carom</title>",
        f"<style>{STYLE}</style></head><body>", "<h1>Carom · verification</h1>",
        f"<p>{html.escape(version)}, commit {html.escape(git.stdout.strip() or 'unknown')}, {time.strftime('%Y-%m-%d')}. "
        f"{len(runs)} cases run anew, {good} of them good; {passed} of {len(checks)} values within what is allowed.</p>",
        book_tables.summary_table(runs), FIRST_PAGE,
        "<nav><ol>", *(f'<li><a href="#{key}">{html.escape(title)}</a></li>' for key, title in contents), "</ol></nav>"]
    parts += [folder_section(folder, found, pictures) for folder, found in folders.items()]
    for name, (_, text) in zip(CHAPTERS, chapters):
        parts.append(text.replace("<h2>", f'<h2 id="chapter-{name}">', 1))
    return "\n".join([*parts, "</body></html>"]), passed == len(checks)


def pictures_of(runs, folder):
    """By name of a case the picture of its run."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / (found.name.replace("/", "_") + ".png") for found in runs]
    there = case_pictures.take_all([(found.folder / "report.html", path, None) for found, path in zip(runs, paths)], WIDTH, HEIGHT)
    return {found.name: path for found, path, is_there in zip(runs, paths, there) if is_there}


def print_pdf(page):
    """By Chromium; fails where it writes nothing."""
    pdf = page.with_suffix(".pdf")
    pdf.unlink(missing_ok=True)
    subprocess.run(["/usr/bin/chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                    "--no-pdf-header-footer", f"--print-to-pdf={pdf}", page.as_uri()], capture_output=True, check=True)
    if not pdf.exists():
        raise SystemExit(f"chromium wrote no {pdf.name}")
    return pdf


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("carom", type=pathlib.Path)
    given = options.parse_args()
    carom, out = given.carom.resolve(), ROOT / "out/book"
    out.mkdir(parents=True, exist_ok=True)
    runs = case_runs.run_all(carom, case_runs.short_cases(), out / "cases")
    version = subprocess.run([carom, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    text, all_passed = book(runs, version, pictures_of(runs, out / "pictures"))
    page = out / "verification.html"
    page.write_text(text, encoding="utf-8")
    for path in (page, print_pdf(page)):
        print(f"written: {path.relative_to(ROOT)}, {path.stat().st_size / 1e6:.1f} MB")
    return 0 if all_passed else 1


if __name__ == "__main__":
    sys.exit(main())
