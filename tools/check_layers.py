#!/usr/bin/python3
"""Checks that includes in src/ point down only, that the files of a folder do not include each other in circles, and that
sums and decisions over values are made in src/parallel alone.

Usage: check_layers.py [ROOT]. Reads the tables of ROOT/docs/layers.md (level of each folder; folders that may use a
library's header), the #include lines of ROOT/src and the DEPENDS lists of its CMakeLists.txt files. Prints each
offence as file:line and exits with 1 if there is any.
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
# Sums of the standard library, and its decisions by a predicate that takes a value.
REDUCTION = re.compile(r"\bstd::(accumulate|inner_product|reduce|transform_reduce)\b"
                       r"|\b((?:all|any|none)_of)\([^;]*\]\((?:const )?double\b")


def read_tables(page):
    """Levels {folder: level} and confined headers {prefix: folders} from the tables of docs/layers.md."""
    levels, confined = {}, {}
    for line in page.read_text().splitlines():
        if match := re.match(r"\| (\d+) \| `(\w+)` \|", line):
            levels[match[2]] = int(match[1])
        elif match := re.match(r"\| `([^`]+)` \| ((?:`\w+`(?:, )?)+) \|", line):
            confined[match[1]] = re.findall(r"`(\w+)`", match[2])
    return levels, confined


def declared_links(cmake_file):
    """Folders that a CMakeLists.txt links: the words after DEPENDS and every target named carom_<folder>."""
    text = re.sub(r"#.*", "", cmake_file.read_text()) if cmake_file.is_file() else ""
    links = set(re.findall(r"\bcarom_(\w+)\b", text))
    for words in re.findall(r"DEPENDS([^)]*)", text):
        links |= set(re.split(r"\bLIBRARIES\b", words)[0].split())
    return links


def offence(folder, target, levels, links):
    """Why a file of `folder` may not include a file of `target`, or None."""
    if target == folder:
        return None
    if levels[target] >= levels[folder]:
        return f"{folder} (level {levels[folder]}) may not include {target} (level {levels[target]})"
    if target not in links:
        return f"{folder} includes {target}, which its CMakeLists.txt does not name in DEPENDS"
    return None


def check_file(path, folder, levels, confined, links):
    """Yields (line number, message) for each offending include of one file."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not (match := INCLUDE.match(line)):
            continue
        header = match[1] or match[2]
        target = header.split("/")[0]
        if match[1] and target in levels and "/" in header:
            if message := offence(folder, target, levels, links):
                yield number, message
        for prefix, folders in confined.items():
            if header.startswith(prefix) and folder not in folders:
                yield number, f"<{header}> belongs behind {' or '.join(folders)}, not in {folder}"


def reductions(path):
    """Yields (line number, message) for each sum of values, or decision about all of them, that a file makes itself."""
    text = re.sub(r"//.*", "", path.read_text())
    for match in REDUCTION.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, (
            f"{match[1] or match[2]} over values belongs behind parallel, where the order of sums is fixed and ranks "
            "can share them: sum_of, dot, largest_of, is_zero, is_finite, parallel_sum or parallel_max")


def included_files(directory):
    """{file of a folder: the files of it that its header or source includes}, named without their ends.

    What stands in x_impl.hpp is of x.
    """
    graph = {}
    for path in sorted(directory.rglob("*.[ch]pp*")):
        name = path.name.split(".")[0].removesuffix("_impl")
        found = graph.setdefault(name, set())
        for line in path.read_text().splitlines():
            match = INCLUDE.match(line)
            if match and match[1] and match[1].startswith(directory.name + "/"):
                found.add(match[1].split("/")[-1].split(".")[0].removesuffix("_impl"))
        found.discard(name)
    return graph


def circle(graph):
    """Names that include each other one after the other, the first again at the end; empty where there are none."""
    done, path = set(), []

    def walk(name):
        if name in path:
            return path[path.index(name) :] + [name]
        if name in done:
            return []
        path.append(name)
        for other in sorted(graph.get(name, ())):
            if found := walk(other):
                return found
        path.pop()
        done.add(name)
        return []

    return next((found for name in sorted(graph) if (found := walk(name))), [])


def check(root):
    """All offences below root/src as lines of text."""
    levels, confined = read_tables(root / "docs/layers.md")
    if not levels:
        return [f"{root}/docs/layers.md: no table of levels found"]
    lines = []
    for directory in sorted(path for path in (root / "src").iterdir() if path.is_dir()):
        if directory.name not in levels:
            lines.append(f"src/{directory.name}: folder without a level in docs/layers.md")
            continue
        links = declared_links(directory / "CMakeLists.txt")
        for link in sorted(links & levels.keys()):
            if levels[link] >= levels[directory.name] and link != directory.name:
                lines.append(f"src/{directory.name}/CMakeLists.txt: links {link}, which is not below it")
        if names := circle(included_files(directory)):
            lines.append(f"src/{directory.name}: files include each other in a circle: {' -> '.join(names)}")
        for path in sorted(directory.rglob("*.[ch]pp*")):
            found = [*check_file(path, directory.name, levels, confined, links)]
            if levels[directory.name] > levels["parallel"]:
                found += reductions(path)
            lines += [f"{path.relative_to(root)}:{number}: {message}" for number, message in sorted(found)]
    return lines


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    lines = check(root)
    print("\n".join(lines) if lines else "layers: includes point down, no files include each other in a circle, sums are behind parallel")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
