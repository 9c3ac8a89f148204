"""The machine, and its limits: peak of multiplications and additions, and of the traffic with the memory."""

import os
import pathlib
import platform

from measure import benchmarks, high_and_spread, plain, table

TITLE = "The machine"


def words():
    """Processor, cores and memory in words."""
    model = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{model}, {len(os.sched_getaffinity(0))} cores, {memory:.0f} GiB"


def measure(bench, _):
    peaks, triads = {}, {}
    for _ in range(2):
        bench.say("peak of multiplications and additions, triad")
        for name, entry in benchmarks(bench.program("bench_peak")).items():
            peaks.setdefault(name.split("/")[1], []).append(entry["GFlop/s"])
        for name, entry in benchmarks(bench.program("bench_stream")).items():
            triads.setdefault(name.split(":")[1].split("/")[0], []).append(entry["GB/s"])
    return {"machine": words(), "isa": max(peaks), "isas": sorted(peaks)[:-3:-1],
            "peaks": {isa: high_and_spread(values) for isa, values in peaks.items()},
            "triads": {threads: high_and_spread(values) for threads, values in triads.items()}}


def page(own, _):
    peaks = [[f"multiplications and additions, x86-64-{isa}, one core [GFlop/s]", plain(figure)]
             for isa, figure in own["peaks"].items()]
    triads = [[f"STREAM triad, threads: {threads} [GB/s]", plain(figure)] for threads, figure in own["triads"].items()]
    return [f"{own['machine']}. Carom's kernels take the instruction set x86-64-{own['isa']} here.", "",
            *table(["limit", "higher of two (spread in percent)"], peaks + triads), "",
            "The peak is that of chains of dependent fused multiplications and additions that keep every unit busy "
            "(`bench/peak.cpp`; v2 has no fused ones). The triad counts 24 bytes per entry, as STREAM does."]
