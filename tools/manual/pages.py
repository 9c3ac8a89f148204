"""The Markdown of the repository as pages of the manual: which pages there are, how they hang together, what becomes of
their links.

docs/README.md is the first page and the navigation. Whatever its pages link to comes along: other pages, pictures, and
files of text as pages of their own.
"""

import os
import pathlib
import re

HOME = pathlib.PurePosixPath("docs/README.md")
FENCE = re.compile(r"^ *```")
LINK = re.compile(r"\[([^\[\]]*)\]\(([^)\s]+)\)")
TARGET = re.compile(r"\]\(([^)\s]+)\)")  # of a picture within a link as well
PICTURES = {".png", ".svg"}
LANGUAGES = {".cpp": "cpp", ".h": "c", ".py": "python", ".sh": "sh", ".toml": "toml", ".geo": "c"}


class ManualError(Exception):
    """What is wrong with the pages, one line per offence."""


def page_name(source):
    """Where a page of the repository stands in the manual: docs/ is its root, a README is the index of its folder."""
    if source == pathlib.PurePosixPath("README.md"):
        return pathlib.PurePosixPath("overview.md")
    parts = source.parts[1:] if source.parts[0] == "docs" else source.parts
    name = pathlib.PurePosixPath(*parts)
    if name.name == "README.md":
        return name.with_name("index.md")
    return name if name.suffix in {".md"} | PICTURES else name.with_name(name.name + ".md")


def outside_fences(text):
    """Pairs of a line and whether it is text: not a block of code, nor its fences."""
    inside = False
    for line in text.splitlines():
        fence = FENCE.match(line) is not None
        yield line, not inside and not fence
        inside = inside != fence


def is_of_repository(target):
    return ":" not in target and target[0] != "#"


def links_of(text):
    """The targets of all links of a page to other files of the repository."""
    for line, is_text in outside_fences(text):
        if is_text:
            yield from (target for target in TARGET.findall(line) if is_of_repository(target))


def resolved(source, target):
    """The file of the repository that a link of a page leads to."""
    return pathlib.PurePosixPath(os.path.normpath(source.parent / target.split("#")[0]))


def for_readers(line):
    """The first line of a block of code with the file's name alone, where the block quotes from it."""
    return line.replace(', lines of it"', '"') if FENCE.match(line) else line


def with_wide_lists(text):
    """The page with lists as Python's Markdown wants them: an empty line before, what belongs to an item four spaces in."""
    lines, in_list, has_gap, before = [], False, False, ""
    for line, is_text in outside_fences(text):
        begins = is_text and re.match(r"(?:- |1\. )", line) is not None
        if begins and before.strip() and (has_gap or not in_list):
            lines.append("")
        if begins:
            in_list, has_gap = True, False
        elif line[:1] not in ("", " ") and not before.strip():
            in_list = False
        has_gap = has_gap or not line.strip()
        lines.append("  " + line if in_list and line.startswith("  ") else line)
        before = line
    return "\n".join(lines) + "\n"


class Pages:
    """All pages of the manual, found from the first one on."""

    def __init__(self, root):
        self.root = root
        self.sources = set()
        self.files = set()
        self.folders = set()
        self.missing = []
        waiting = [HOME] + [page.relative_to(root) for page in sorted((root / "docs").rglob("*.md"))]
        while waiting:
            source = pathlib.PurePosixPath(waiting.pop())
            if source not in self.sources:
                self.sources.add(source)
                waiting += self._follow(source)
        if self.missing:
            raise ManualError("\n".join(self.missing))

    def _follow(self, source):
        """Pages that a page links to; what else it links to is noted."""
        pages = []
        for target in links_of((self.root / source).read_text()):
            found = resolved(source, target)
            if (self.root / found).is_dir():
                if (self.root / found / "README.md").is_file():
                    pages.append(found / "README.md")
                elif found.parts[0] == "docs":
                    self.folders.add(found)
            elif not (self.root / found).is_file():
                self.missing.append(f"{source}: dead link: {target}")
            elif found.suffix == ".md":
                pages.append(found)
            else:
                self.files.add(found)
        return pages

    def _is_left_out(self, found):
        """Whether a link leads to a folder that is no part of the manual."""
        return (self.root / found).is_dir() and found / "README.md" not in self.sources and found not in self.folders

    def _moved(self, source, target):
        """A link as the manual needs it."""
        found = resolved(source, target)
        page = page_name(found / "README.md" if (self.root / found).is_dir() else found)
        anchor = target.partition("#")[2]
        return os.path.relpath(page, page_name(source).parent) + ("#" + anchor if anchor else "")

    def _with_links(self, source, line):
        def without(match):
            away = is_of_repository(match[2]) and self._is_left_out(resolved(source, match[2]))
            return match[1] if away else match[0]

        def moved(match):
            return f"]({self._moved(source, match[1])})" if is_of_repository(match[1]) else match[0]

        return TARGET.sub(moved, LINK.sub(without, line))

    def text_of(self, source):
        """A page as the manual has it."""
        lines = [self._with_links(source, line) if is_text else for_readers(line)
                 for line, is_text in outside_fences((self.root / source).read_text())]
        return with_wide_lists("\n".join(lines))

    def title_of(self, source):
        return (self.root / source).read_text().splitlines()[0].removeprefix("# ")

    def in_folder(self, folder):
        """The pages of a folder that has no index of its own, in the order of their names."""
        return sorted(source for source in self.sources if source.parent == folder)

    def write(self, out):
        """Writes all pages, pictures and files below a folder."""
        for source in self.sources:
            put(out / page_name(source), self.text_of(source))
        for source in self.files:
            if source.suffix in PICTURES:
                (out / page_name(source)).parent.mkdir(parents=True, exist_ok=True)
                (out / page_name(source)).write_bytes((self.root / source).read_bytes())
            else:
                put(out / page_name(source), as_page(source, (self.root / source).read_text()))
        for folder in self.folders:
            listed = [f"- [{self.title_of(page)}]({page.name})" for page in self.in_folder(folder)]
            put(out / page_name(folder / "README.md"), "\n".join([f"# {folder.name.capitalize()}", "", *listed, ""]))

    def navigation(self):
        """The navigation that the first page is: headings, and below them pairs of a title and a page."""
        sections, current = [], []
        for line, is_text in outside_fences((self.root / HOME).read_text()):
            if is_text and line.startswith("## "):
                current = []
                sections.append({line[3:]: current})
            entry = re.match(r"- \[([^\]]*)\]\(([^)#\s]+)\)", line)
            if is_text and entry:
                current.append(self._entry(entry[1], resolved(HOME, entry[2])))
        return [{"Start": "index.md"}] + [section for section in sections if list(section.values())[0]]

    def _entry(self, title, found):
        if found in self.folders:
            index = [str(page_name(found / "README.md"))]
            return {title: index + [{self.title_of(page): str(page_name(page))} for page in self.in_folder(found)]}
        return {title: str(page_name(found / "README.md" if (self.root / found).is_dir() else found))}


def put(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def as_page(source, text):
    """A file of text as a page, for those who follow a link to it."""
    return f"# {source.name}\n\n`{source}`\n\n````{LANGUAGES.get(source.suffix, 'text')}\n{text}````\n"


def names_in(navigation):
    """The names of all pages of a navigation."""
    if isinstance(navigation, str):
        return {navigation}
    parts = navigation.values() if isinstance(navigation, dict) else navigation
    return set().union(*(names_in(part) for part in parts))
