"""The explicit step, set-up and memory as models and threads grow."""

import decks
from measure import carom, low_and_spread, lower, plain, run, table

TITLE = "Growth with cells and threads"
SECONDS = {10_000: 2.0, 50_000: 2.0, 500_000: 3.0, 4_000_000: 8.0}  # of steps


def models():
    """{cells in words: bar}"""
    full = lambda across, along, **keys: decks.Bar("Bar", "HEXA8", across, along, formulation="full", **keys)
    return {"10 k": full(8, 156), "50 k": full(14, 256), "500 k": full(30, 556), "4 M": full(60, 1112),
            "500 k, irregular, from a file": full(30, 556, moved=True)}


def seconds(cells):
    return next(time for least, time in reversed(SECONDS.items()) if cells >= 0.9 * least)


def once(bench, path, threads, cells):
    cost, _, _ = carom(bench.program("carom"), path, threads=threads, stepping=seconds(cells))
    step = cost.per_step()
    return {"processor": step[0] / cells, "wall": step[1] / cells, "first": cost.marks[0].wall,
            "first_processor": cost.marks[0].processor / cells,
            "memory": cost.memory / cells}


def measure(bench, _):
    found = {}
    for name, bar in models().items():
        bench.say(f"{name}: writing the case")
        path, cells = bar.write(bench.folder, steps=20000), bar.cells()
        rounds = {1: [], 2: []}
        checks = []
        for turn in range(2):
            for threads, of in rounds.items():
                bench.say(f"{name}, threads: {threads}, round {turn + 1}")
                of.append(once(bench, path, threads, cells))
            bench.say(f"{name}: carom check, round {turn + 1}")
            checks.append(run([bench.program("carom"), "check", path]).wall)
        found[name] = {"cells": cells, "check": low_and_spread(checks),
                       "threads": {threads: lower(of) for threads, of in rounds.items()}}
    return found


def page(own, _):
    rows, others = [], []
    for name, model in own.items():
        alone = model["threads"]["1"]
        for threads, found in model["threads"].items():
            rows.append([name, threads, plain(found["processor"], 1e9), plain(found["wall"], 1e9),
                         f"{alone['wall'][0] / found['wall'][0]:.2f}"])
            others.append([name, threads, plain(found["first_processor"], 1e6, 2), plain(found["first"], 1.0, 2),
                           f"{alone['first'][0] / found['first'][0]:.2f}", plain(found["memory"], 1.0, 0),
                           plain(model["check"], 1.0, 2) if threads == "1" else ""])
    return ["The bar of HEXA8 with 8 points, elastic, as above. The irregular one has its inner nodes moved, nodes "
            "and cells in random order in a file of Gmsh, so that nothing can be saved on cells of the same shape. "
            "Lower of two, spread in percent in brackets.", "",
            *table(["cells", "threads", "ns per cell and step, processor", "clock", "times one thread"], rows), "",
            "Set-up: from the start of the process until its first step has ended, processor time over the cells and "
            "clock. Memory: the most at a time over the cells, about 30 MB of the program included. `carom check`: "
            "clock, on all cores.", "",
            *table(["cells", "threads", "set-up [us per cell]", "set-up, clock [s]", "times one thread",
                    "memory [bytes per cell]", "`carom check` [s]"], others)]
