#!/usr/bin/python3
"""Makes the manual: the pages of docs/ and what they link to as a site that is read from a disk or from any server of files,
with a search that works in both cases and without the network.

Usage: manual.py [--root ROOT] [--out FOLDER]. The first page, docs/README.md, is the navigation. Fails where a link leads
nowhere, to a heading that is not there or out to the network for anything that a page needs, and where a page of docs/ is
missing from the navigation.
"""

import argparse
import html.parser
import json
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).parent / "manual"))
from pages import ManualError, Pages, names_in, page_name  # noqa: E402

OWN = pathlib.Path(__file__).resolve().parent / "manual"


def absent(pages):
    """The pages of docs/ that the navigation does not have."""
    wanted = {str(page_name(source)) for source in pages.sources if source.parts[0] == "docs"}
    return sorted(wanted - names_in(pages.navigation()))


def settings(pages, folder, out):
    """What mkdocs is told: JSON, which is YAML as well."""
    palette = [{"media": f"(prefers-color-scheme: {scheme})", "scheme": name, "primary": "blue grey", "accent": "teal",
                "toggle": {"icon": f"material/{icon}", "name": f"Switch to {other} colours"}}
               for scheme, name, icon, other in (("light", "default", "weather-night", "dark"),
                                                 ("dark", "slate", "weather-sunny", "light"))]
    return {
        "site_name": "Carom", "docs_dir": str(folder / "pages"), "site_dir": str(out), "use_directory_urls": False,
        "strict": True, "nav": pages.navigation(), "plugins": ["search"], "extra_css": ["style.css"],
        "extra": {"generator": False},
        "theme": {"name": "material", "custom_dir": str(folder / "theme"), "font": False, "palette": palette,
                  "features": ["navigation.tabs", "navigation.top", "navigation.indexes", "toc.follow"],
                  "icon": {"logo": "material/circle-double"}},
        "markdown_extensions": ["tables", "md_in_html", {"toc": {"permalink": True}}, "pymdownx.superfences",
                                {"pymdownx.betterem": {"smart_enable": "all"}},
                                {"pymdownx.highlight": {"guess_lang": False}}],
    }


def search_from_disk(out):
    """The index and the worker of the search as a script."""
    index = (out / "search" / "search_index.json").read_text()
    (worker,) = (out / "assets" / "javascripts" / "workers").glob("search.*.js")
    code = json.dumps(worker.read_text()).replace("</", "<\\/")
    (out / "search" / "from_disk.js").write_text(
        f"var __search = {{\n  index: Promise.resolve({index}),\n"
        f"  worker: URL.createObjectURL(new Blob([{code}], {{type: \"text/javascript\"}})),\n}};\n")


class Page(html.parser.HTMLParser):
    """The places of a page that links may lead to, where its links lead, and what it needs to be shown."""

    def __init__(self, text):
        super().__init__()
        self.places, self.links, self.needs = {"", "__skip"}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.places |= {given.get("id"), given.get("name")}
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        elif tag in ("link", "script", "img"):
            self.needs += [value for key, value in attrs if key in ("href", "src")]


def offences(out):
    """What is wrong with the links of a site, as lines of text."""
    pages = {path: Page(path.read_text()) for path in sorted(out.rglob("*.html")) if path.name != "404.html"}
    lines = []
    for path, page in pages.items():
        name = path.relative_to(out)
        lines += [f"{name}: needs the network: {need}" for need in page.needs if urllib.parse.urlsplit(need).netloc]
        for link in [link for link in page.links + page.needs if not urllib.parse.urlsplit(link).scheme]:
            target, _, place = urllib.parse.unquote(link).partition("#")
            found = (path.parent / target).resolve() if target else path
            if not found.exists():
                lines.append(f"{name}: dead link: {link}")
            elif place and place not in pages.get(found, page).places:
                lines.append(f"{name}: no such heading: {link}")
    return sorted(set(lines))


def make(root, out):
    """Makes the site; ManualError where something is wrong with it."""
    folder = out.with_name(out.name + "_sources")
    for old in (folder, out):
        shutil.rmtree(old, ignore_errors=True)
    pages = Pages(root)
    if absent(pages):
        raise ManualError(f"docs/README.md leads to none of {', '.join(absent(pages))}")
    pages.write(folder / "pages")
    shutil.copy(OWN / "style.css", folder / "pages")
    (folder / "theme").mkdir()
    shutil.copy(OWN / "main.html", folder / "theme")
    (folder / "mkdocs.yml").write_text(json.dumps(settings(pages, folder, out), indent=1))
    done = subprocess.run(["/usr/bin/mkdocs", "build", "--config-file", folder / "mkdocs.yml"], check=False,
                          capture_output=True, text=True)
    if done.returncode != 0:
        said = (done.stdout + done.stderr).splitlines()
        raise ManualError("\n".join(line for line in said if not line.startswith("INFO")))
    for unused in [*out.rglob("*.map"), out / "sitemap.xml", out / "sitemap.xml.gz"]:
        unused.unlink(missing_ok=True)
    shutil.rmtree(out / "assets" / "javascripts" / "lunr")  # the search in other languages
    search_from_disk(out)
    wrong = offences(out)
    if wrong:
        raise ManualError("\n".join(wrong))
    return len(pages.sources) + len(pages.files)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/manual"))
    given = parser.parse_args()
    try:
        count = make(given.root.resolve(), given.out.resolve())
    except ManualError as error:
        print(f"manual: {error}", file=sys.stderr)
        return 1
    print(f"manual: {count} pages and pictures, first page: {given.out / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
