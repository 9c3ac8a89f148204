"""The cases of cases/ and of examples/: what they say of themselves, and running them. Used by gallery.py and book.py."""

import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import tomllib
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent


class CaseRun(typing.NamedTuple):
    name: str  # "friction/incline_over_newmark"
    title: str
    text: str  # the comment at its head, one paragraph
    folder: pathlib.Path  # of its results
    summary: dict  # summary.json

    def first_sentence(self):
        """Of the comment, without what stands in brackets; a colon ends it as well where it has said something by then."""
        text = re.sub(r" \([^()]*\)", "", self.text)
        sentence = re.split(r"(?<! St)[.] (?=[A-Z])", text)[0]
        head, colon, _ = sentence.partition(": ")
        enough = 40  # characters
        return (head if colon and len(head) > enough else sentence).rstrip(".") + "." if text else ""


def head_comment(source):
    lines = []
    for line in source.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").rstrip())
    return " ".join(lines)


def short_cases():
    """Names of the cases that a test may run: not those left to `make verify`, nor those whose verdict fails on purpose."""
    table = (ROOT / "tests/verification/cases.txt").read_text(encoding="utf-8")
    long = {line.split()[0] for line in table.splitlines() if line.startswith("cases/")}
    found = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "cases").rglob("*.toml"))
    return [path[len("cases/"):-len(".toml")] for path in found
            if path not in long and not path.startswith(("cases/sdnv100/stiffness/", "cases/sdnv100/plain/"))]


def file_of(name):
    """The file of a case by the name that `carom init --like` takes, relative to the repository."""
    path = pathlib.Path("cases") / f"{name}.toml"
    return path if (ROOT / path).exists() else pathlib.Path("examples") / f"{name}.toml"


def begun(carom, name, out):
    """The case of an example that a script of Gmsh makes the mesh for, with its mesh, in a folder of its own."""
    folder = out / f"{name}_case"
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([carom, "init", folder, "--like", name], check=True, capture_output=True)
    for script in folder.glob("*.geo"):
        subprocess.run(["gmsh", "-3", script, "-o", script.with_suffix(".msh"), "-v", "1"], check=True, capture_output=True)
    return folder / f"{folder.name}.toml"


def run(carom, name, out):
    """Runs one case into out/<name>; fails where it cannot be run at all."""
    path, folder = ROOT / file_of(name), out / name
    case = path if path.is_relative_to(ROOT / "cases") else begun(carom, name, out)
    done = subprocess.run([carom, "run", case, "--out", folder, "--threads", "1", "--quiet"], capture_output=True, text=True,
                          check=False)
    if not (folder / "summary.json").exists():
        raise SystemExit(f"{name}: {done.stderr}")
    source = path.read_text(encoding="utf-8")
    return CaseRun(name, tomllib.loads(source)["title"], head_comment(source), folder,
                   json.loads((folder / "summary.json").read_text(encoding="utf-8")))


def run_all(carom, names, out):
    """The runs in the order of their names, as many at a time as there are cores; says how far they are."""
    done = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lambda name: run(carom, name, out), names):
            done.append(found)
            print(f"[{len(done)}/{len(names)}] {found.name}: {found.summary['outcome']}", flush=True)
    return done
