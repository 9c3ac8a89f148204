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
img { max-width: 100%; } nav ol { columns: 2; } p.soft { color: #5b666d; }
@media print { body { max-width: none; padding: 0; } h2 { break-before: page; } h3 { break-after: avoid; } tr { break-inside: avoid; } a { color: inherit; } }
"""

COLUMNS = (("Quantity", ""), ("time", "number"), ("value", "number"), ("theory", "number"), ("error", "number"),
           ("allowed", "number"), ("", ""), ("source of the theory", ""))


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}g}"


def check_row(check):
    is_relative = check["tolerance_kind"] == "relative"
    reference, difference = check["reference"], check["difference"]
    if difference is None:
        error = "–"
    elif is_relative:
        error = f"{100 * difference / abs(reference):.2g} %"
    else:
        error = number(difference, 2)
    allowed = f"{100 * check['tolerance']:.2g} %" if is_relative else number(check["tolerance"], 2)
    cells = (check["name"], number(check["time"], 6), number(check["value"], 9), number(reference, 9), error, allowed)
    mark = '<span class="pass">✓</span>' if check["pass"] else '<span class="fail">✗ fails</span>'
    row = "".join(f'<td class="{style}">{html.escape(cell)}</td>' for cell, (_, style) in zip(cells, COLUMNS))
    return f"<tr>{row}<td>{mark}</td><td>{html.escape(check['source'])}</td></tr>"


def case_section(found):
    head = "".join(f'<th class="{style}">{title}</th>' for title, style in COLUMNS)
    checks = found.summary["checks"]
    scheme = found.summary["scheme"]
    body = (f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(check_row(c) for c in checks)}</tbody></table>" if checks
            else '<p class="soft">No checks of its own: its verdict is compared with nothing but the books.</p>')
    return (f"<h3>{html.escape(found.title)}</h3><p>{html.escape(found.text)}</p>"
            f'<p class="soft">cases/{found.name}.toml · {found.summary["mesh"]["cells"]} cells · {html.escape(scheme["name"])} · '
            f'{scheme["steps"]} steps · {html.escape(found.summary["outcome"])}: {html.escape(found.summary["message"])}</p>{body}')


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


def book(runs, version):
    folders = {}
    for found in runs:
        folders.setdefault(found.name.split("/")[0], []).append(found)
    checks = [check for found in runs for check in found.summary["checks"]]
    passed = sum(check["pass"] for check in checks)
    git = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=12", "HEAD"], capture_output=True, text=True, check=False)
    chapters = [chapter(name) for name in CHAPTERS]
    contents = [(f"case-{folder}", f"cases/{folder}") for folder in folders]
    contents += [(f"chapter-{name}", title) for name, (title, _) in zip(CHAPTERS, chapters)]
    parts = [
        "<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">', "<title>Verification · Carom</title>",
        f"<style>{STYLE}</style></head><body>", "<h1>Carom · verification</h1>",
        f"<p>{html.escape(version)}, commit {html.escape(git.stdout.strip() or 'unknown')}, {time.strftime('%Y-%m-%d')}. "
        f"{len(runs)} cases run anew; {passed} of {len(checks)} checks passed. Value: what was computed. Theory: exact solution, published "
        "value or independent computation, as its source says. Errors are relative to the theory where they are in percent.</p>",
        "<nav><ol>", *(f'<li><a href="#{key}">{html.escape(title)}</a></li>' for key, title in contents), "</ol></nav>"]
    for folder, found in folders.items():
        parts.append(f'<h2 id="case-{folder}">cases/{folder}</h2>')
        parts += [case_section(one) for one in found]
    for name, (_, text) in zip(CHAPTERS, chapters):
        parts.append(text.replace("<h2>", f'<h2 id="chapter-{name}">', 1))
    return "\n".join([*parts, "</body></html>"]), passed == len(checks)


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
    text, all_passed = book(runs, version)
    page = out / "verification.html"
    page.write_text(text, encoding="utf-8")
    for path in (page, print_pdf(page)):
        print(f"written: {path.relative_to(ROOT)}, {path.stat().st_size / 1e6:.1f} MB")
    return 0 if all_passed else 1


if __name__ == "__main__":
    sys.exit(main())
