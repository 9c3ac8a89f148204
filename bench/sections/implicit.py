"""Implicit runs by factorisation and by iteration."""

import decks
from measure import carom, lower, plain, table

TITLE = "Implicit runs"
KINDS = ("multigrid", "cholmod", "cg")  # of [solver]
BARS = {"8 x 8 x 160": (8, 160), "16 x 16 x 320": (16, 320)}
THREADS = (1, 2)
NEWMARK = 'kind = "newmark"\n\n[solver]\nkind = "{}"'
STEP, END = 2e-6, 1.4e-4


def case(bench, size, kind, end=END):
    """The free bar, a deck of its own folder for each kind of solver."""
    folder = bench.folder / kind
    folder.mkdir(exist_ok=True)
    bar = decks.Bar("Free bar", "HEXA8", *BARS[size], gap=0.002)
    return bar.write(folder, scheme=NEWMARK.format(kind), end=end, step=STEP)


def once(bench, path, threads):
    cost, summary, rows = carom(bench.program("carom"), path, threads=threads)
    return {"processor": cost.processor, "wall": cost.wall, "memory": cost.memory,
            "iterations": sum(int(row["iterations"]) for row in rows), "steps": summary["scheme"]["steps"]}


def measure(bench, _):
    rounds = {}
    for turn in range(2):
        for size in BARS:
            for kind in KINDS:
                for threads in THREADS:
                    bench.say(f"{size}, {kind}, threads: {threads}, round {turn + 1}")
                    found = once(bench, case(bench, size, kind), threads)
                    rounds.setdefault(f"{size}/{kind}/{threads}", []).append(found)
    return {key: lower(both) for key, both in rounds.items()}


def page(own, _):
    rows = []
    for key, found in own.items():
        size, kind, threads = key.split("/")
        alone = own[f"{size}/{kind}/1"]
        rows.append([size, f"`{kind}`", threads, f"{found['steps'][0]}", f"{found['iterations'][0]:,}",
                     plain(found["processor"]), plain(found["wall"]), f"{alone['wall'][0] / found['wall'][0]:.2f}",
                     plain(found["memory"], 1e-6, 0)])
    return ["The free bar: 100 m/s against a rigid plane 2 mm away, penalty contact, Newmark, steps of 2e-6 s to "
            "1.4e-4 s (Courant numbers of about 5 and 9), whole runs with set-up. Lower of two, spread in percent in "
            "brackets.", "",
            *table(["cells", "`solver.kind`", "threads", "steps", "iterations", "processor [s]", "clock [s]",
                    "times one thread", "memory [MB]"], rows)]
