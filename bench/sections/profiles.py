"""Where the time of steps goes: the top entries of a profile."""

import re
import shutil
import subprocess

import decks
from measure import run, table
from sections import implicit
from sections.reasons import REASONS

TITLE = "Profiles"
ENTRIES = 10
SECONDS = 8.0  # of steps
# What only calls what it is given, so that the entry is named after that.
CALLERS = {"parallel_for", "parallel_sum", "parallel_sums", "parallel_each", "for_each_chunk", "sum_over_chunks"}


def cases(bench):
    """{what is profiled: its case}"""
    steps = decks.bars()[0].write(bench.folder, steps=20000)
    return {"explicit, 16 x 16 x 320": steps,
            **{f"implicit, 8 x 8 x 160, `{kind}`": implicit.case(bench, "8 x 8 x 160", kind)
               for kind in implicit.KINDS}}


def short_name(symbol):
    """The function without its arguments and those of its templates; of a loop over cells or nodes what it is for."""
    names = re.findall(r"carom::((?:\(anonymous namespace\)::)?[\w:~]+)(?=[<(]|$| )", symbol)
    names = [name.replace("(anonymous namespace)::", "") for name in names]
    own = [name for name in names if name.split("::")[-1] not in CALLERS and not re.match(r"^__|.*__vector", name)]
    if own and names[0].split("::")[-1] in CALLERS:
        own = [name for name in own if f"carom::{name}(" in symbol.replace("(anonymous namespace)::", "")] or own
    return own[0] if own else re.split(r"[<(]", symbol)[0].strip()


def top(text):
    """[(name, share in percent)] of the most of a report of perf."""
    shares = {}
    for line in text.splitlines():
        found = re.match(r" *([0-9.]+)% +(\S+) +\[(.)\] +(.*)", line)
        if found:
            library = re.match(r"lib[a-z]+", found[2])
            is_named = library is None or library[0] == "libc"
            name = "kernel of the system" if found[3] == "k" else short_name(found[4]) if is_named else library[0]
            shares[name] = shares.get(name, 0.0) + float(found[1])
    return sorted(shares.items(), key=lambda entry: -entry[1])[:ENTRIES]


def output(command, text=""):
    """What a command that is on no terminal makes of a text."""
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def measure(bench, _):
    if not shutil.which("perf"):
        return {}
    found = {}
    for name, case in cases(bench).items():
        bench.say(name)
        data = bench.folder / "perf.data"
        run(["perf", "record", "-q", "-e", "cpu-clock", "-F", "997", "-o", data,
             bench.program("carom"), "run", case, "--out", bench.folder / "out", "--threads", "1"], stepping=SECONDS)
        report = ["perf", "report", "-i", data, "--stdio", "--no-children", "--no-demangle", "--sort", "dso,sym"]
        found[name] = top(output(["c++filt"], output(report)))
    return found


def page(own, _):
    if not own:
        return ["`perf` is not installed here: nothing was measured."]
    lines = ["Samples of the processor's clock over runs of one thread, set-up and eight seconds of steps or the "
             "whole run, by function with what is inlined there; the top ten, and why they are called."]
    name_of = lambda entry: f"`{entry}`" if "::" in entry or "_" in entry else entry
    for name, entries in own.items():
        lines += ["", f"{name[0].upper()}{name[1:]}:", "",
                  *table(["function", "% of the samples", "why"],
                         [[name_of(entry), f"{share:.1f}", REASONS.get(entry, "")] for entry, share in entries])]
    return lines
