"""What processes cost: processor time, time of the clock, memory, and when their steps end."""

import csv
import json
import os
import re
import subprocess
import tempfile
import time
import typing

TIME_LIMIT = 900.0  # s, of one process
STEP = re.compile(rb"step (\d+) ")


class Mark(typing.NamedTuple):
    """A step that has been seen to end: its number, and processor and clock time since the beginning, s."""
    step: int
    processor: float
    wall: float


class Cost(typing.NamedTuple):
    processor: float  # s, user and system
    wall: float  # s
    memory: float  # bytes, the most at a time
    marks: list
    text: str  # what was printed
    code: int

    def per_step(self):
        """Processor and clock time of a step, from the first and the last that were seen: set-up, and what is written
        at the end, are left out."""
        first, last = self.marks[0], self.marks[-1]
        steps = last.step - first.step
        return (last.processor - first.processor) / steps, (last.wall - first.wall) / steps


def processor_time(pid):
    """Processor time that a running process has taken so far, s: the clock that clock_getcpuclockid names."""
    return time.clock_gettime((~pid << 3) | 2)


def chunks(terminal):
    """What comes out of a terminal until its other end is closed."""
    while True:
        try:
            chunk = os.read(terminal, 65536)
        except OSError:
            return
        if not chunk:
            return
        yield chunk


def run(command, environment=None, folder=None, stepping=TIME_LIMIT):
    """Runs a command on a terminal, where carom shows its steps ten times a second; asks it to stop `stepping` seconds
    after the first of them."""
    begin = time.monotonic()
    terminal, its_end = os.openpty()
    with subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=its_end, stderr=its_end,
                          cwd=folder, env={**os.environ, **(environment or {})}) as process:
        os.close(its_end)
        marks, text, limit = [], b"", TIME_LIMIT
        for chunk in chunks(terminal):
            now = time.monotonic() - begin
            found = STEP.findall(chunk)
            if found:
                limit = limit if marks else now + stepping
                marks.append(Mark(int(found[-1]), processor_time(process.pid), now))
            else:
                text += chunk
            if now > limit:
                process.terminate()
                limit = 2.0 * TIME_LIMIT
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    os.close(terminal)
    return Cost(usage.ru_utime + usage.ru_stime, time.monotonic() - begin, 1024.0 * usage.ru_maxrss, marks,
                text.decode().replace("\r\n", "\n"), process.returncode)


def carom(program, case, threads=1, isa="", stepping=TIME_LIMIT):
    """Runs a case: what it costs, its summary, and the rows of energy.csv."""
    with tempfile.TemporaryDirectory(dir=case.parent) as folder:
        cost = run([program, "run", case, "--out", folder, "--threads", threads], {"CAROM_ISA": isa} if isa else None,
                   stepping=stepping)
        try:
            with open(f"{folder}/summary.json", encoding="utf-8") as file:
                summary = json.load(file)
        except OSError:
            summary = {"outcome": "nothing was run"}
        if summary["outcome"] not in ("good", "failed", "stopped"):
            raise RuntimeError(f"{case.name}: {cost.text[-2000:]}")
        with open(f"{folder}/energy.csv", encoding="utf-8", newline="") as file:
            return cost, summary, list(csv.DictReader(line for line in file if not line.startswith("#")))


def benchmarks(program, *arguments):
    """{name: {key: value}} of a program of Google Benchmark."""
    text = run([program, *arguments, "--benchmark_format=json"]).text
    found = json.loads(text[text.index("\n{") if not text.startswith("{") else 0:])
    return {entry["name"]: entry for entry in found["benchmarks"]}


def lower(rounds):
    """{key: [lower, spread]} of what two rounds have measured, each {key: number}."""
    return {key: low_and_spread([values[key] for values in rounds]) for key in rounds[0]}


def low_and_spread(values):
    """Lower of two figures, and the spread (larger - lower) / lower."""
    low, high = min(values), max(values)
    return [low, (high - low) / low if low else 0.0]


def high_and_spread(values):
    """Likewise the higher of two."""
    low, high = min(values), max(values)
    return [high, (high - low) / low]


def rate(seconds, count=1.0, digits=1):
    """`count` per second, in millions, with the spread in percent, from [lower, spread] of the seconds."""
    return f"{1e-6 * count / seconds[0]:.{digits}f} ({100 * seconds[1]:.0f})"


def plain(figure, scale=1.0, digits=1):
    """A figure times a scale, with its spread in percent."""
    return f"{scale * figure[0]:,.{digits}f} ({100 * figure[1]:.0f})"


def table(head, rows):
    """Lines of a table."""
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]
