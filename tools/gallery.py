#!/usr/bin/python3
"""Runs what people do with Carom and makes a page with its pictures: out/gallery/index.html, docs/gallery.md.

Usage: gallery.py CAROM [--docs]. With --docs the page of docs/ and its pictures are written as well. Exit code 1 where a run is
not good.
"""

import argparse
import base64
import html
import pathlib
import shutil
import sys

import case_pictures
import case_runs
from case_runs import ROOT

# Case as `carom init --like` names it, what the colours show, which share of the time.
PICTURES = (
    ("tutorial/phone", "von Mises stress", 0.5),
    ("gallery/bottle", "von Mises stress", 0.25),
    ("gallery/crash_box", "equivalent plastic strain", 1.0),
    ("taylor_bar/rigid_wall", "equivalent plastic strain", 1.0),
    ("erosion/rigid_ball", "equivalent plastic strain", 0.2),
    ("gallery/hinge", "von Mises stress", 0.7),
    ("gallery/pile", "speed", 0.6),
    ("gears/involute", "von Mises stress", 0.5),
    ("balls/oblique", "speed", 0.5),
    ("roller/strip", "speed", 0.14),
    ("spinning_blocks/oblique_two_pass", "speed", 0.12),
    ("rigid_bodies/block_on_free_box", "speed", 0.7),
    ("edges/rolling", "speed", 0.5),
    ("torsion_bar/large_twist", "speed", 0.5),
    ("friction/deformable_bathe", "speed", 0.5),
    ("hertz/impact_solid", "von Mises stress", 0.5),
    ("free_bar/small_central_differences", "speed", 0.6),
    ("sdnv100/current", "von Mises stress", 0.5),
)
WIDTH, HEIGHT = 640, 400

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Gallery · Carom</title>
<style>
body {{ font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 76rem; padding: 1.5rem; }}
ul {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 21rem), 1fr)); gap: 1.5rem; padding: 0; list-style: none; }}
img {{ width: 100%; border: 1px solid #8884; border-radius: 6px; background: #fff; }}
h2 {{ font-size: 1rem; margin: .4rem 0 .2rem; }}
p {{ margin: 0; }}
small {{ opacity: .7; }}
</style>
</head>
<body>
<h1>Gallery</h1>
<p>Real runs; a click on a picture opens the report, where the bodies move. <code>carom init mine --like gallery/bottle</code> begins a
case with one of them.</p>
<ul>
{entries}
</ul>
</body>
</html>
"""


def pictures(runs, folder):
    """A PNG of each run; their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / (found.name.replace("/", "_") + ".png") for found in runs]
    case_pictures.take_all([(found.folder / "report.html", path, (quantity, share))
                            for found, path, (_, quantity, share) in zip(runs, paths, PICTURES)], WIDTH, HEIGHT)
    return paths


def write_page(runs, paths, out):
    entries = []
    for found, path in zip(runs, paths):
        picture = base64.b64encode(path.read_bytes()).decode()
        report = (found.folder / "report.html").relative_to(out)
        entries.append(f'<li><a href="{report}"><img alt="" src="data:image/png;base64,{picture}"></a>'
                       f"<h2>{html.escape(found.title)}</h2><p>{html.escape(found.first_sentence())}</p>"
                       f"<small>{case_runs.file_of(found.name)}</small></li>")
    (out / "index.html").write_text(PAGE.format(entries="\n".join(entries)), encoding="utf-8")


def write_docs(runs, paths):
    images = ROOT / "docs/images/gallery"
    shutil.rmtree(images, ignore_errors=True)
    images.mkdir(parents=True)
    lines = ["# Gallery", "", "Made by `make gallery` from real runs; in their reports the bodies move. A case of one's own begins with one of these by "
             "`carom init`, which writes the case with its mesh, or with the script of Gmsh that makes it. Small cases that show one thing "
             "and are compared with its theory stand in [cases/](../cases/README.md), each with a picture in the verification book "
             "(`make book`).", ""]
    for found, path in zip(runs, paths):
        (images / path.name).write_bytes(path.read_bytes())
        file = case_runs.file_of(found.name)
        lines += [f"### {found.title}", "", f"[![{found.title}](images/gallery/{path.name})](../{file})", "",
                  " ".join([found.first_sentence(), f"The case is [{file}](../{file})."]).strip(), "",
                  "```console", f"carom init mine --like {found.name}", "```", ""]
    (ROOT / "docs/gallery.md").write_text("\n".join(lines), encoding="utf-8")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("carom", type=pathlib.Path)
    options.add_argument("--docs", action="store_true")
    given = options.parse_args()
    out = ROOT / "out/gallery"
    runs = case_runs.run_all(given.carom.resolve(), [name for name, _, _ in PICTURES], out)
    paths = pictures(runs, out / "pictures")
    write_page(runs, paths, out)
    if given.docs:
        write_docs(runs, paths)
    print(f"written: {(out / 'index.html').relative_to(ROOT)}")
    bad = [found.name for found in runs if found.summary["outcome"] != "good"]
    if bad:
        print("not good: " + ", ".join(bad), file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
