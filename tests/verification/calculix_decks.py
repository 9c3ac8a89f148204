#!/usr/bin/env python3
"""Runs the dynamic and contact decks of CalculiX' own tests with Carom and with ccx, and writes docs/calculix_decks.md.

    python3 calculix_decks.py build/release/carom [--only NAME] [--page FILE]

The decks are those of the Debian package calculix-ccx-test with *DYNAMIC or *CONTACT PAIR in them. Both programs are
asked for the displacements of the same dozen nodes; the largest difference at any time that ccx prints is taken
relative to the largest displacement. Each program has a minute. Exit code 1 if a deck that agreed (AGREE below) does not.
"""

import argparse
import bisect
import csv
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
PAGE = ROOT / "docs/calculix_decks.md"
LIMIT = 60  # s
NODES = 12
CLOSE = 0.05  # relative to the largest displacement
SET = "CAROMPROBE"
# Decks that agree; losing one is a regression.
AGREE = ("beamdynamic", "beamnldye", "beamnldyp", "beamnldype", "contact4", "contactenergy", "cubespring", "friction1",
         "hueeber1", "hueeber2", "hueeber3", "hueeber4", "beamnldy_100")
# Decks whose one large increment is no solution yet: the same in a hundred.
FINER = {"beamnldy_100": ("beamnldy", ".5E-5,.5E-5", ".5E-7,.5E-5")}
REMARKS = {
    "beamcontact": "A contact 35 times stiffer than a cell, which the verdict of Carom warns of.",
    "beamdynamic": "The load doubles between two steps.",
    "beamnldy": "One increment for the whole step, which is too long for Carom; see beamnldy_100.",
    "beamnldy_100": "beamnldy with 100 increments.",
    "beamnldynodirect": "One increment in Carom; ccx chooses others.",
    "contact4": "One element of second order on each side.",
}


def text_of(path):
    data = gzip.open(path).read() if path.suffix == ".gz" else path.read_bytes()
    return data.decode("latin-1")


def decks():
    """{name: text} of the decks that are meant."""
    found = {}
    for path in sorted([*DECKS.glob("*.inp"), *DECKS.glob("*.inp.gz")]):
        text = text_of(path)
        if re.search(r"^\*(DYNAMIC|CONTACT\s*PAIR)", text, re.MULTILINE | re.IGNORECASE):
            found[path.name.split(".inp")[0]] = text
    for name, (of, old, new) in FINER.items():
        found[name] = found[of].replace(old, new)
    return dict(sorted(found.items()))


def used_nodes(text):
    """Numbers of the nodes of solid and plane elements, in increasing order; included files are not looked at."""
    nodes, keyword, is_new = set(), "", True
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("**") or not line:
            continue
        if line.startswith("*"):
            keyword, is_new = line.upper().replace(" ", ""), True
            continue
        if keyword.startswith("*ELEMENT,") and re.search(r"TYPE=(C3D|CP|CAX)", keyword):
            fields = [field.strip() for field in line.split(",") if field.strip()]
            nodes.update(int(field) for field in (fields[1:] if is_new else fields) if field.lstrip("-").isdigit())
            is_new = not line.endswith(",")
    return sorted(nodes)


def with_probes(text, nodes):
    """The deck with a set of nodes before the first step, and a request for their displacements in every step."""
    chosen = nodes[:: max(1, len(nodes) // NODES)][:NODES]
    lines = f"*NSET, NSET={SET}\n" + "".join(f"{node},\n" for node in chosen)
    text = re.sub(r"^\*STEP", lambda match: lines + match[0], text, count=1, flags=re.MULTILINE | re.IGNORECASE)
    request = f"*NODE PRINT, NSET={SET}, FREQUENCY=1\nU\n"
    return re.sub(r"^\*END\s*STEP", lambda match: request + match[0], text, flags=re.MULTILINE | re.IGNORECASE)


def call(words, folder):
    """(exit code, what it said); the code is None where it ran out of time."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, timeout=LIMIT, check=False, env=environment)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, (done.stdout + done.stderr).decode("utf-8", "replace")


def read_dat(path):
    """{time: {node: (ux, uy, uz)}} of the set in a .dat file of ccx."""
    times, now = {}, None
    for line in path.read_text(encoding="latin-1").splitlines():
        head = re.match(rf"\s*displacements .* for set {SET} and time\s+(\S+)", line)
        fields = line.split()
        if head:
            now = times.setdefault(float(head[1]), {})
        elif now is not None and len(fields) == 4 and fields[0].isdigit():
            now[int(fields[0])] = tuple(float(field) for field in fields[1:])
        elif fields:
            now = None
    return times


def read_probes(path):
    """(times, {node: three lists}) of the probes of the set in probes.csv."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    columns = {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}
    nodes = {}
    for name, values in columns.items():
        found = re.search(rf"{SET}\.(\d+).*displacement_([xyz])", name)
        if found:
            nodes.setdefault(int(found[1]), {})[found[2]] = values
    return columns["time"], {node: [axes[a] for a in "xyz"] for node, axes in nodes.items()}


def at_time(times, values, t):
    """Linear between the points."""
    i = min(max(bisect.bisect_left(times, t), 1), len(times) - 1)
    t0, t1 = times[i - 1], times[i]
    x = min(max((t - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 1.0
    return values[i - 1] + x * (values[i] - values[i - 1])


def difference(reference, times, nodes):
    """Largest difference of a component, relative to the largest displacement of ccx."""
    size = max((abs(u) for at in reference.values() for vector in at.values() for u in vector), default=0.0)
    worst = 0.0
    for t, at in reference.items():
        for node, vector in at.items():
            for own, u in zip(nodes[node], vector):
                worst = max(worst, abs(at_time(times, own, t) - u))
    return worst / size if size > 0.0 else worst


def reason(said):
    """Why Carom refused or stopped, on one line of a table."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    errors = [i for i, line in enumerate(lines) if line.startswith("error:")]
    if errors and "not carry over" in lines[errors[0]]:
        names = re.findall(r"\*([A-Z][A-Z \-]*):", "\n".join(lines[errors[0] + 1:]))
        return "needs " + ", ".join("*" + name for name in dict.fromkeys(names))
    if errors:
        return re.sub(r"^error: \S*?:(\d+:)?\s*", "", lines[errors[0]])[:160].replace("|", "/")
    failed = [line for line in lines if line.startswith(("FAILED", "failed"))]
    return (failed or lines or ["nothing"])[0][:160].replace("|", "/")


def judge(carom, name, text, folder):
    """(result, difference or None, remark)"""
    nodes = used_nodes(text)
    deck = folder / f"{name}.inp"
    deck.write_text(with_probes(text, nodes) if nodes else text, encoding="latin-1")
    out = folder / f"{name}_out"
    code, said = call([carom, "run", deck, "--out", out, "--quiet"], folder)
    if code == 2:
        return "refused", None, reason(said)
    if code is None:
        return "too long", None, f"more than {LIMIT} s"
    remark = "" if code == 0 else reason(said)
    if code == 3:
        return "stopped", None, remark
    code, _ = call(["ccx", "-i", name], folder)
    data = folder / f"{name}.dat"
    reference = read_dat(data) if data.exists() else {}
    if code is None or not reference:
        return "runs", None, (remark + " " if remark else "") + "(no displacements of ccx)"
    try:
        distance = difference(reference, *read_probes(out / "probes.csv"))
    except (KeyError, OSError) as error:
        return "runs", None, f"not compared: {error!r}"
    return ("agrees" if distance <= CLOSE else "differs"), distance, remark


def page(rows):
    kinds = ("agrees", "differs", "runs", "stopped", "too long", "refused")
    count = {kind: sum(row[1] == kind for row in rows) for kind in kinds}
    ended = count["agrees"] + count["differs"] + count["runs"]
    lines = [
        "# Decks of CalculiX", "",
        "Written by `tests/verification/calculix_decks.py` (`make verify`): the decks of CalculiX' own tests (Debian's",
        "`calculix-ccx-test`) with `*DYNAMIC` or `*CONTACT PAIR`, run by Carom and by ccx (2.20 in Debian 12). Compared",
        f"are the displacements of {NODES} nodes at every time that ccx prints: the largest difference, relative to the",
        f"largest displacement. *agrees*: at most {CLOSE:.0%}. *refused*: Carom says what it cannot carry over, and runs",
        "nothing.", "",
        f"Of {len(rows)} decks {ended} run to their end, {count['agrees']} agree, {count['differs']} differ, "
        f"{count['refused']} are refused,",
        f"{count['stopped']} stopped, {count['too long']} took too long.", "",
        "| deck | result | difference | remark |", "|---|---|---|---|"]
    for name, result, distance, remark in rows:
        remark = " ".join(filter(None, (REMARKS.get(name), remark)))
        lines.append(f"| {name} | {result} | {'' if distance is None else f'{distance:.2g}'} | {remark} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("carom", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--page", type=pathlib.Path, default=PAGE)
    options = parser.parse_args()
    if not DECKS.is_dir() or shutil.which("ccx") is None:
        print("calculix-ccx and calculix-ccx-test are not installed: nothing is judged", file=sys.stderr)
        return 2
    carom, rows = options.carom.resolve(), []
    with tempfile.TemporaryDirectory() as folder:
        for path in DECKS.iterdir():
            if ".inp" not in path.name and ".ref" not in path.name and path.is_file():
                shutil.copy(path, folder)
        for name, text in decks().items():
            if options.only in name:
                rows.append((name, *judge(carom, name, text, pathlib.Path(folder))))
                print(*rows[-1], flush=True)
    if not options.only:
        options.page.write_text(page(rows), encoding="utf-8")
    lost = [row[0] for row in rows if row[0] in AGREE and row[1] != "agrees"]
    if lost:
        print("no longer agree: " + ", ".join(lost), file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
