"""Other programs beside Carom: CalculiX in the same run where it is installed, and published or earlier figures."""

import re
import shutil
import sys

from measure import carom, lower, run, table

TITLE = "Peers"
ACROSS, ALONG, END = 8, 160, 1.4e-4  # of the bar of CalculiX
SIZE = ("--across", ACROSS, "--along", ALONG)
EXPLICIT_ENDS = (4e-6, 1.8e-5)  # s, before the bar touches
SOLVES = re.compile(r"^ *iteration *\d+", re.MULTILINE)
STEP = re.compile(r"SELECTED time increment: *(\S+)")

HERE = "built from source (gfortran -O3, double precision, August 2026), one core of this kind of machine"
# program and formulation, million cell-steps per second, the bar of ours beside it, where the figure is from
FIGURES = (
    ("OpenRadioss, Isolid 17 (8 points), elastic, 10,000 cells", 0.55, "HEXA8 full, elastic", HERE),
    ("OpenRadioss, Isolid 17, elastic, 270,000 cells", 0.51, "HEXA8 full, elastic", HERE),
    ("OpenRadioss, Isolid 14 (2 x 2 x 2), elastic", 0.36, "HEXA8 full, elastic", HERE),
    ("OpenRadioss, Isolid 1 (one point), elastic, 10,000 cells", 2.39, "HEXA8 one point, elastic", HERE),
    ("OpenRadioss, Isolid 24 (HEPH), elastic, 10,000 cells", 1.87, "HEXA8 one point, elastic", HERE),
    ("OpenRadioss, Isolid 17, Taylor bar", 0.52, "HEXA8 mean dilatation, J2", HERE),
    ("OpenRadioss, Isolid 1, Taylor bar", 2.3, "HEXA8 one point, J2", HERE),
    ("CalculiX 2.20, C3D8 explicit, elastic", 0.08, "HEXA8 full, elastic",
     "Debian's package, the same kind of machine"),
    ("Carina.jl, HEXA8, neo-Hookean", 0.687, "HEXA8 full, neo-Hookean", "published, one core of a Ryzen 9900X"),
    ("Sierra/SM, composite tetrahedron", 0.13, "TETRA10 mean dilatation, elastic", "published, per rank"),
)


def deck(bench, name, *options):
    """A deck of CalculiX."""
    path = bench.folder / f"{name}.inp"
    run([sys.executable, bench.root / "bench/peers/calculix_free_bar.py", *options, path])
    return path


def calculix(bench, path):
    cost = run(["ccx", "-i", path.stem], {"OMP_NUM_THREADS": "1"}, folder=bench.folder)
    if cost.code or "Job finished" not in cost.text:
        raise RuntimeError(f"CalculiX: {cost.text[-1000:]}")
    return cost


def implicit(bench):
    bench.say("CalculiX, implicit")
    cost = calculix(bench, deck(bench, "implicit", *SIZE, "--end", END))
    found = {"calculix": {"processor": cost.processor, "memory": cost.memory, "solves": len(SOLVES.findall(cost.text))}}
    path = bench.folder / "free_bar.toml"
    shutil.copy(bench.root / "cases/free_bar/newmark.toml", path)
    rounds = []
    for turn in range(2):
        bench.say(f"Carom, implicit, round {turn + 1}")
        cost, summary, _ = carom(bench.program("carom"), path)
        rounds.append({"processor": cost.processor, "memory": cost.memory})
    return {**found, "steps": summary["scheme"]["steps"],
            "carom": lower(rounds)}


def explicit(bench):
    """Seconds of CalculiX for a step and cell, from two runs whose steps it chooses itself."""
    times, steps = [], []
    for end in EXPLICIT_ENDS:
        bench.say(f"CalculiX, explicit, to {end} s")
        cost = calculix(bench, deck(bench, "explicit", *SIZE, "--explicit", "--step", "1e-7", "--end", end))
        times.append(cost.processor)
        steps.append(end / float(STEP.search(cost.text)[1]))
    return (times[1] - times[0]) / (steps[1] - steps[0]) / (ACROSS**2 * ALONG)


def measure(bench, _):
    return {"implicit": implicit(bench), "explicit": explicit(bench)} if shutil.which("ccx") else {}


def implicit_lines(found):
    own, other = found["carom"], found["calculix"]
    rows = [["CalculiX", f"{other['processor']:.1f}", f"{1e-6 * other['memory']:.0f}", ""],
            ["Carom", f"{own['processor'][0]:.2f}", f"{1e-6 * own['memory'][0]:.0f}",
             f"{other['processor'] / own['processor'][0]:.0f}"]]
    return [f"The free bar of `cases/free_bar/newmark.toml`, {ACROSS} x {ACROSS} x {ALONG} cells, {found['steps']} "
            "implicit steps, the same penalty ([bench/peers](../bench/peers/README.md)); CalculiX once, "
            f"{other['solves']} Newton iterations; whole runs on one thread:", "",
            *table(["", "processor [s]", "memory [MB]", "times less than CalculiX"], rows), ""]


def page(own, everything):
    lines = [] if own else ["CalculiX is not installed here: it was not measured.", ""]
    figures = list(FIGURES)
    if own:
        lines += implicit_lines(own["implicit"])
        figures = [figure for figure in FIGURES if not figure[0].startswith("CalculiX")]
        figures.insert(0, ("CalculiX, C3D8 explicit, elastic", 1e-6 / own["explicit"], "HEXA8 full, elastic",
                           "measured in this run, before the bar touches"))
    steps = everything.get("steps", {})
    isa = everything["machine"]["isa"]
    rows = []
    for title, rate, bar, source in figures:
        if bar in steps:
            ours = 1e-6 * steps[bar]["cells"][0] / steps[bar][isa][0]
            rows.append([title, f"{rate:.3g}", f"{bar}: {ours:.2f}", f"{ours / rate:.0f}", source])
    return lines + ["Explicit steps, million cell-steps per second on one core. What was not measured in this run is "
                    "from another day or machine; ratios to it are rough:", "",
                    *table(["program", "its rate", "ours", "times", "source of its rate"], rows)]
