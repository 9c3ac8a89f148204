"""The sweeps over the cells of every element and law, beside the limits of the machine."""

import decks
from measure import benchmarks, low_and_spread, rate, table

TITLE = "Kernels"


def measure(bench, everything):
    """For each bar: [lower, spread] of the seconds of a cell by "<size>/<sweep>/<isa>", flops and bytes by sweep."""
    isas = everything["machine"]["isas"]
    bars, found = decks.bars(), {}
    for bar in bars:
        found[bar.title] = {"cells": bar.cells(), "rounds": {}, "flops": {}, "bytes": {}}
    for turn in range(2):
        for number, bar in enumerate(bars, start=1):
            bench.say(f"{bar.title}, round {turn + 1} ({number} of {len(bars)})")
            paths = {deck.write(bench.folder, steps=1): size for deck, size in ((bar, "large"), (bar.small(), "small"))}
            entries = benchmarks(bench.program("bench_kernels"), *paths, "--benchmark_min_time=0.1",
                                 f"--benchmark_filter=/({'|'.join(isas)})$")
            for path, size in paths.items():
                for name, entry in entries.items():
                    stem, sweep, isa = name.split("/")
                    if stem != path.stem:
                        continue
                    own = found[bar.title]
                    own["rounds"].setdefault(f"{size}/{sweep}/{isa}", []).append(1.0 / entry["items_per_second"])
                    if size == "large":
                        own["flops"][sweep], own["bytes"][sweep] = entry["flops_per_cell"], entry["bytes_per_cell"]
    for own in found.values():
        own["seconds"] = {key: low_and_spread(values) for key, values in own.pop("rounds").items()}
    return found


def rows(found, machine, sweep):
    best, other = machine["isas"][0], machine["isas"][-1]
    peak, triad = 1e9 * machine["peaks"][best][0], 1e9 * machine["triads"]["1"][0]
    for title, own in found.items():
        large, small = own["seconds"][f"large/{sweep}/{best}"], own["seconds"][f"small/{sweep}/{best}"]
        flops, size = own["flops"][sweep], own["bytes"][sweep]
        yield [title, rate(large, digits=2), rate(small, digits=2),
               f"{large[0] / own['seconds'][f'large/{sweep}/{other}'][0]:.2f}", f"{flops:,.0f}", f"{size:,.0f}",
               f"{flops / size:.0f}", f"{100 * flops / large[0] / peak:.0f}", f"{100 * flops / small[0] / peak:.0f}",
               f"{100 * size / large[0] / triad:.0f}"]


def page(own, everything):
    machine = everything["machine"]
    best, other = machine["isas"][0], machine["isas"][-1]
    head = ["element, law", "M cells/s", "in cache", f"{other} over {best}", "flops of a cell", "bytes",
            "flops per byte", "% of the peak", "in cache", "% of the triad"]
    balance = machine["peaks"][best][0] / machine["triads"]["1"][0]
    return ["One core. Flops are counted by a number type that goes through the same templates: additions, "
            "subtractions, multiplications, divisions and square roots, each one (`bench/flops.cpp`). Bytes are those "
            "of the arrays if each were read once, and what is written once too: coordinates, displacements, forces, "
            "node numbers, history of the points. The bars are those of the next section, 5,120 to 163,840 cells; in "
            "cache: about a thousand. Displacements are random and strain the cells by about a hundredth, so that "
            f"bodies that can yield do. Rates: higher of two, spread in percent in brackets. From {balance:.1f} flops "
            "per byte on a kernel cannot be limited by the memory of this machine: all kernels that have no history "
            "are beyond that.", "",
            "Internal force with energies and history, what an explicit step calls:", "",
            *table(head, rows(own, machine, "force")), "",
            "Action of the tangent, what an iteration of an implicit step calls:", "",
            *table(head, rows(own, machine, "tangent")), "",
            "The peak asks for a fused operation in every cycle and unit; sums, divisions, square roots, logarithms "
            "of the laws and the gather and scatter of the nodes have no such pairs."]
