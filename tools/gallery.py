#!/usr/bin/python3
"""Runs one case of each kind and makes a page with their pictures: out/gallery/index.html, docs/gallery.md.

Usage: gallery.py CAROM [--docs]. With --docs the page of docs/ and its pictures are written as well.
"""

import argparse
import base64
import html
import pathlib

import case_pictures
import case_runs
from case_runs import ROOT

# Case, what the colours show, which share of the time.
PICTURES = (
    ("sdnv100/current", "von Mises stress", 0.5),
    ("free_bar/small_central_differences", "speed", 0.6),
    ("taylor_bar/rigid_wall", "equivalent plastic strain", 1.0),
    ("shock_bar/viscous", "speed", 0.6),
    ("hertz/two_spheres", "von Mises stress", 1.0),
    ("hertz/impact_solid", "von Mises stress", 0.5),
    ("hertz/impact_central_differences", "von Mises stress", 0.5),
    ("tetrahedra/bars", "velocity z", 0.5),
    ("impact_bar/plane_strip", "velocity y", 0.62),
    ("spinning_blocks/oblique_two_pass", "speed", 0.12),
    ("spinning_blocks/free_block", "speed", 0.7),
    ("rigid_bodies/block_on_free_box", "speed", 0.7),
    ("roller/strip", "speed", 0.14),
    ("torsion_bar/large_twist", "speed", 0.5),
    ("friction/deformable_bathe", "speed", 0.5),
    ("patch_test/surface_to_surface_penalty", "stress zz", 1.0),
    ("interface_friction/imposed_slide", "displacement, length", 0.5),
    ("springs/block_on_springs", "displacement z", 0.5),
    ("snap_through/block", "displacement z", 1.0),
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
<p>Real runs of the cases in <code>cases/</code>; a click on a picture opens the report, where the bodies move.</p>
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
                       f"<small>cases/{found.name}.toml</small></li>")
    (out / "index.html").write_text(PAGE.format(entries="\n".join(entries)), encoding="utf-8")


def write_docs(runs, paths):
    images = ROOT / "docs/images/gallery"
    images.mkdir(parents=True, exist_ok=True)
    lines = ["# Gallery", "", "Made by `make gallery` from real runs; each is a case of `cases/` and its own test. In their reports the "
             "bodies move.", ""]
    for found, path in zip(runs, paths):
        (images / path.name).write_bytes(path.read_bytes())
        lines += [f"### {found.title}", "", f"[![{found.title}](images/gallery/{path.name})](../cases/{found.name}.toml)", "",
                  found.first_sentence(), ""]
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


if __name__ == "__main__":
    main()
