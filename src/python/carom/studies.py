"""Many runs side by side."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import pathlib
import pickle
import sys
import time
import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from carom.case import Case
from carom.result import Result


@dataclass(frozen=True)
class Outcome:
    """What has become of one run of a study."""

    given: Any
    """What it was called with."""
    value: Any
    """What it has returned; None where it failed."""
    error: str
    """Why it failed: the last lines of the traceback, or how its process ended; "" where it did not."""
    seconds: float
    """How long it took on the clock."""

    @property
    def failed(self) -> bool:
        """Is there no value?"""
        return bool(self.error)


def _finish(case: Case) -> Result:
    """Runs a case to its end on one core, without a folder: what `study` does with cases."""
    return case.start(threads=1).finish()


def study(work: Iterable[Any], run: Callable[[Any], Any] = _finish, *, jobs: int = 0, progress: bool = True,
          keep: str | os.PathLike[str] | None = None) -> list[Outcome]:
    """Calls `run` with each of `work`, each in a process of its own, so many at a time, and waits for all.

    work: cases, or whatever `run` takes. run: a function of a module (or of the script, below its
    `if __name__ == "__main__":` the study is started), which returns what is wanted of a run, such as
    `case.start(threads=1).finish().energy["kinetic"].max()`; without it cases are brought to their ends and the Result is
    kept. jobs: processes at a time, 0 for all cores. progress: a line on stderr after each, with how many are done, have
    failed, and the time that is left.

    A run that raises, or whose process is ended (for want of memory, say), does not concern the others: its Outcome says
    why. keep: a file in which every outcome is kept as soon as it is there; a study that is called again with the same
    file makes only what is missing in it or failed, by position, and refuses a file of other work. So nothing is lost by
    Ctrl-C, which ends the processes.

    The outcomes stand in the order of the work. Raises TypeError for what cannot be sent to another process (a function
    of a notebook, a lambda), before anything is run, and ValueError for a file of another study.
    """
    items = list(work)
    sent = [_sent(run, item) for item in items]
    kept = _Kept(None if keep is None else pathlib.Path(keep), sent)
    outcomes: dict[int, Outcome] = {i: Outcome(items[i], value, "", seconds) for i, (value, seconds) in kept.found.items()}
    shown = _Progress(len(items), len(outcomes), progress)
    waiting = [i for i in range(len(items)) if i not in outcomes]
    running: dict[Any, _Process] = {}
    try:
        while waiting or running:
            while waiting and len(running) < (jobs or os.cpu_count() or 1):
                process = _Process(waiting.pop(0), sent)
                running[process.answer] = process
            for answer in multiprocessing.connection.wait(list(running)):
                process = running.pop(answer)
                outcome = outcomes[process.item] = process.outcome(items[process.item])
                if not outcome.failed:
                    kept.add(process.item, outcome)
                shown.add(outcome.failed)
    finally:
        for process in running.values():
            process.end()
        shown.end()
    return [outcomes[i] for i in range(len(items))]


def _sent(run: Callable[[Any], Any], item: Any) -> bytes:
    try:
        return pickle.dumps((run, item))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise TypeError(f"{error}: every run is made by another process, which has to find the function in a module, and "
                        "what it is called with has to be something that can be pickled") from error


def _work(sent: bytes, answer: Any) -> None:
    """What the processes do."""
    try:
        run, item = pickle.loads(sent)
        reply = pickle.dumps((run(item), ""))
    except BaseException:
        reply = pickle.dumps((None, traceback.format_exc(limit=-3)))
    answer.send_bytes(reply)


class _Process:
    """One run on its way."""

    _context = multiprocessing.get_context("spawn")

    def __init__(self, item: int, sent: list[bytes]) -> None:
        """item: its position."""
        self.item, self._begin = item, time.monotonic()
        self.answer, theirs = self._context.Pipe(duplex=False)
        self._process = self._context.Process(target=_work, args=(sent[item], theirs), daemon=True)
        self._process.start()
        theirs.close()

    def outcome(self, given: Any) -> Outcome:
        """Of a process that has answered or ended."""
        try:
            value, error = pickle.loads(self.answer.recv_bytes())
            self._process.join()
        except EOFError:
            self._process.join()
            code = self._process.exitcode or 0
            value, error = None, ("its process was ended by signal " + str(-code) if code < 0 else
                                  f"its process ended without an answer, with exit code {code}")
        self.answer.close()
        return Outcome(given, value, error, time.monotonic() - self._begin)

    def end(self) -> None:
        """Breaks it off."""
        self._process.terminate()
        self._process.join()


class _Kept:
    """The file of a study: what it was of, then a position, a value and a time for each that is done."""

    def __init__(self, path: pathlib.Path | None, sent: list[bytes]) -> None:
        """path: None: nothing is kept."""
        self._path = path
        self.found: dict[int, tuple[Any, float]] = {}
        if path is None:
            return
        if path.exists():
            with path.open("rb") as file:
                if pickle.load(file) != sent:
                    raise ValueError(f"{path} is of another study: remove it, or name another file")
                try:
                    while True:
                        item, value, seconds = pickle.load(file)
                        self.found[item] = (value, seconds)
                except (EOFError, pickle.UnpicklingError):
                    pass  # broken off while it was written
            self._write({item: (value, seconds) for item, (value, seconds) in self.found.items()}, sent)
        else:
            self._write({}, sent)

    def _write(self, found: dict[int, tuple[Any, float]], sent: list[bytes]) -> None:
        assert self._path is not None
        beside = self._path.with_name(self._path.name + ".tmp")
        with beside.open("wb") as file:
            pickle.dump(sent, file)
            for item, (value, seconds) in found.items():
                pickle.dump((item, value, seconds), file)
        beside.replace(self._path)

    def add(self, item: int, outcome: Outcome) -> None:
        """At once."""
        if self._path is not None:
            with self._path.open("ab") as file:
                pickle.dump((item, outcome.value, outcome.seconds), file)


class _Progress:
    """The line on stderr; on a terminal it is written over."""

    def __init__(self, count: int, done: int, is_shown: bool) -> None:
        """done: from a file."""
        self._count, self._done, self._kept, self._failed = count, done, done, 0
        self._is_shown, self._begin = is_shown, time.monotonic()

    def add(self, failed: bool) -> None:
        """One more; the time that is left goes by the pace so far."""
        self._done += 1
        self._failed += failed
        seconds = time.monotonic() - self._begin
        left = seconds / (self._done - self._kept) * (self._count - self._done)
        text = f"{self._done} of {self._count} done"
        if self._failed:
            text += f", {self._failed} failed"
        if self._done < self._count:
            text += f", about {_duration(left)} left"
        else:
            text += f" in {_duration(seconds)}"
        if self._is_shown:
            terminal = sys.stderr.isatty()
            print(("\r\033[K" if terminal else "") + text, end="" if terminal else "\n", file=sys.stderr, flush=True)

    def end(self) -> None:
        """Leaves the line."""
        if self._is_shown and sys.stderr.isatty():
            print(file=sys.stderr)


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"
