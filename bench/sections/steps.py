"""Whole explicit steps of every element, by the program itself."""

import decks
from measure import benchmarks, carom, lower, rate, table

TITLE = "Explicit steps"
SECONDS = 1.2  # of steps of each run


def once(bench, path, isas, kernel):
    """Seconds of a step of the case for each instruction set, and of a cell in the kernel beside it."""
    found = {}
    if kernel:
        entry, = benchmarks(bench.program("bench_kernels"), path, "--benchmark_min_time=0.2",
                            f"--benchmark_filter=/force/{isas[0]}$").values()
        found["kernel"] = 1.0 / entry["items_per_second"]
    for isa in isas:
        cost, summary, _ = carom(bench.program("carom"), path, isa=isa, stepping=SECONDS)
        found[isa] = cost.per_step()[0]
        found["cells"] = summary["mesh"]["cells"]
    return found


def measure(bench, everything):
    isas = everything["machine"]["isas"]
    paths = {bar.title: bar.write(bench.folder, steps=20000) for bar in decks.bars()}
    sliding = bench.folder / "sliding.toml"
    sliding.write_text(decks.sliding(20000), encoding="ascii")
    paths["two blocks of HEXA8, sliding on each other"] = sliding
    rounds = {title: [] for title in paths}
    for turn in range(2):
        for number, (title, path) in enumerate(paths.items(), start=1):
            bench.say(f"{title}, round {turn + 1} ({number} of {len(paths)})")
            rounds[title].append(once(bench, path, isas, path != sliding))
    return {title: lower(both) for title, both in rounds.items()}


def page(own, everything):
    best, other = everything["machine"]["isas"][0], everything["machine"]["isas"][-1]
    rows = []
    for title, found in own.items():
        cells, step = found["cells"][0], found[best]
        share = f"{100 * found['kernel'][0] * cells / step[0]:.0f}" if "kernel" in found else ""
        rows.append([title, f"{cells:,}", rate(step, cells, 2), f"{1e9 * step[0] / cells:.1f}", share,
                     f"{step[0] / found[other][0]:.2f}"])
    return ["`carom run` on one thread: a bar of 16 x 16 x 320 HEXA8, or of other cells, goes against a rigid plane "
            "with penalty contact; stable step chosen by the program, ledger and curves at every step, no fields. "
            "Bars that yield are stretched as well, so that all their cells flow. The first 1.2 s of steps of a run "
            "of some 13,000; processor time between the first step and the last, so that set-up is left out. Higher "
            "of two, spread in percent in brackets. Share of the kernel: its time, measured just before the run, over "
            "that of the step.", "",
            *table(["element, law", "cells", "M cell-steps/s", "ns per cell and step", "% in the kernel",
                    f"{other} over {best}"], rows)]
