"""Runs: stepping, looking on, saving and ending."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from carom import _carom, _html
from carom._arguments import Named, number, unknown, whole
from carom.curves import ContactState, Curves, contact_states
from carom.fields import Cells, FieldKind, Frames, NodalForces, _cells_of, _field_kind, _KeptFrames
from carom.mesh import Mesh
from carom.result import Result, _joined, _pictures

_Observer = TypeVar("_Observer", bound=Callable[["Run"], object])
_ENERGY, _CONTACT, _PROBES, _PARTS, _EXACT = range(5)


class Run(_carom.RunBase):
    """A run of a case: what `Case.start` and `resume` give.

    Runs know nothing of each other: there may be many, one after the other and side by side. Runs that are stepped by
    several threads of Python take turns, step by step; one run's steps use `threads` cores. What a run holds (files,
    the lock on its folder, threads) goes with it when nobody refers to it any more, finished or not.
    """

    def __init__(self, origin: _carom.PreparedCase | str, *more: Any, threads: Any) -> None:
        """Made by Case.start and resume."""
        super().__init__(origin, *more, whole("threads", threads, "a number of cores, or 0 for all,"))

    def step(self, n: int = 1) -> None:
        """Makes n steps, fewer where the run comes to its end.

        Raises RunError where the run cannot go on, OutputError where results cannot be written, and what a function of
        time or an observer raises. Ctrl-C is answered at the end of the step; the run can go on.
        """
        count = whole("n", n, "a number of steps")
        if count < 0:
            raise ValueError(f"n: {count}, and a number of steps is 0 or more")
        self._advance(np.inf, count)

    def until(self, time: float) -> None:
        """Steps to the first end of a step at or after `time` (in the case's unit), or to the end of the run.

        Steps are not shortened for it. Raises as step does.
        """
        end = number("time", time, "a number")
        if np.isnan(end):
            raise ValueError("time: not a number")
        self._advance(end, -1)

    def restore(self, snapshot: _carom.Snapshot) -> None:
        """Everything as it was when the snapshot was taken: the next steps have the same bits as they had then.

        The snapshot may be of another run of an equal case (functions of time may be others). Curves, frames and
        checkpoints that are later are removed from the results folder. Raises CheckpointError for another case.
        """
        if not isinstance(snapshot, _carom.Snapshot):
            raise TypeError(f"snapshot: {snapshot!r}, and what Run.save gives is wanted")
        self._restore(snapshot)

    def observe(self, observer: _Observer, every: int = 1) -> _Observer:
        """Has `observer(run)` called after every `every`-th step (counted from the start), and after the last.

        What the observer raises comes out of step, until or finish; the run can go on from there, where `unobserve`
        lets go of it. Returns the
        observer, so that it can be used as a decorator. Observers are not part of snapshots and checkpoints.
        """
        if not callable(observer):
            raise TypeError("observer: something that can be called with a run")
        every = whole("every", every, "a number of steps, at least 1,")
        self._observe(every)
        self.__dict__.setdefault("_observers", []).append((observer, every))
        return observer

    def unobserve(self, observer: _Observer) -> None:
        """Has it called no more. Raises ValueError where it does not observe this run."""
        observers = self.__dict__.get("_observers", [])
        for entry in observers:
            if entry[0] is observer:
                observers.remove(entry)
                self._forget(entry[1])
                return
        raise ValueError("it does not observe this run")

    def _show(self) -> None:
        """Called after steps that an observer waits for."""
        for observer, every in list(self.__dict__.get("_observers", ())):
            if self.steps % every == 0 or self.at_end:
                observer(self)

    @property
    def contact(self) -> dict[str, ContactState]:
        """The contacts at the end of the last step, by name: `run.contact["floor"].force[2]`. A name that is none is a
        KeyError that lists them."""
        return Named("contact", contact_states(*self._contact()))

    @property
    def history(self) -> Curves:
        """Curves of probes and contacts so far (every `output.curves_every` steps)."""
        return _joined([self._curves(_CONTACT), self._curves(_PROBES)])

    @property
    def energy(self) -> Curves:
        """The ledger of energies so far."""
        return self._curves(_ENERGY)

    def _curves(self, which: int) -> Curves:
        return Curves(*self._table(which), self._units())

    @property
    def parts(self) -> Curves:
        """Energies and momentum of every part so far: `run.parts["glass.kinetic_energy"]`."""
        return self._curves(_PARTS)

    @property
    def mesh(self) -> Mesh:
        """The mesh as it is run: views of its arrays, which hold it. Nodes of springs' and obstacles' carriers are left
        out of displacement, velocity and acceleration, and come last here."""
        data = self._mesh()
        nodes = len(self.displacement)
        return Mesh._of(data, nodes)

    @property
    def node_numbers(self) -> NDArray[np.int64]:
        """(nodes,), the numbers of the nodes in the mesh file."""
        return self._mesh().node_numbers[:len(self.displacement)]

    @property
    def cells(self) -> Cells:
        """The cells that the rows of fields belong to: part by part, not as in `mesh.cells`."""
        return _cells_of(self._mesh(), *self._cells())

    @property
    def fields(self) -> dict[str, FieldKind]:
        """The fields that `field` can be asked for, with place, components, unit and meaning. `contact_slip`, which is a
        sum over the steps, is there where the case asks for it in `output.fields` or in a probe."""
        return Named("field", {name: _field_kind(name, self._units()) for name in self._fields()})

    def field(self, name: str) -> NDArray[np.float64]:
        """A field of docs/quantities.md at the end of the last step: (nodes,) or (cells,), and (..., components) where it
        has several, x y z of vectors, xx yy zz xy yz zx of tensors; in the case's units (`fields[name].unit`). Rows of
        nodes are those of `mesh.points`, rows of cells those of `cells`. It is evaluated for the whole mesh, with 64
        bits; nothing of it is kept. Raises KeyError, which lists the fields there are."""
        if name not in self._fields():
            remedy = "; contact_slip wants to be in output.fields of the case" if name == "contact_slip" else ""
            raise unknown("field", name, self._fields(), remedy)
        return self._field(name)

    @property
    def stress(self) -> NDArray[np.float64]:
        """Cauchy stress of each cell, the mean over its reference volume: (cells, 6), xx yy zz xy yz zx, in the case's unit
        of stress; rows as in `cells`. The same as `field("stress")`."""
        return self.field("stress")

    def contact_force(self, name: str) -> NodalForces:
        """What one contact exerts on the nodes of the bodies at the end of the last step, node by node: rows of
        `mesh.points`, numbers in the mesh file, and forces of (n, 3), x y z, in the case's unit of force. Nodes of both
        sides are there; over those of the contact's group the forces add up to `contact[name].force`, over both sides
        of a pair to nothing. Nodes of rigid bodies have none, their forces act on the body. Raises KeyError, which lists
        the contacts."""
        if name not in self._contact_names():
            raise unknown("contact", name, self._contact_names())
        nodes, force = self._contact_at_nodes(name)
        return NodalForces(nodes, self.node_numbers[nodes], force)

    def record(self, names: Sequence[str], every: int = 1) -> Frames:
        """Keeps fields in memory: this instant, every `every`-th step from now on, and the last. Frames that a `restore`
        takes back go. They take 8 bytes a value. Raises KeyError for a field that the run does not have."""
        kinds = self.fields
        for name in names:
            self.field(name)
        kept = _KeptFrames(names)
        kept(self)
        self.observe(kept, every)
        return Frames(kept, {name: kinds[name] for name in names}, self.mesh, self.cells, self.node_numbers)

    def finish(self, folder: str | os.PathLike[str] | None = None) -> Result:
        """Steps to the end of the case, closes the run and judges it.

        folder: for a run without one, a results folder as the command line writes it: summary, report, all curves, a
        checkpoint; of the fields, those of the end alone. Raises as step does; then the run is not finished, but for
        OutputError from closing. After a RunError, stop() closes it.
        """
        self._advance(np.inf, -1)
        return self.stop(folder)

    def stop(self, folder: str | os.PathLike[str] | None = None) -> Result:
        """Closes the run where it is; before its end the verdict is "stopped" (or "error"). folder: as finish."""
        summary = self._close("" if folder is None else os.fspath(folder))
        contact, probes, parts, exact = (self._curves(which) for which in (_CONTACT, _PROBES, _PARTS, _EXACT))
        return Result(summary, contact, probes, self.energy, parts, exact, self.folder)

    def __repr__(self) -> str:
        """Where it is."""
        return f"<carom.Run: step {self.steps}, t = {self.time:g} of {self.end:g}>"

    def _repr_html_(self) -> str:
        """For notebooks: how far it is, what touches, contact forces and energies so far."""
        unit = self.energy.unit("time")
        figures = [("Contact " + name, f"{np.linalg.norm(state.force):.4g} {self._curves(_CONTACT).unit(name + '.force_x')}",
                    f"{state.closed} closed, penetration {state.penetration:.3g}" if state.closed else "open")
                   for name, state in self.contact.items() if state.force is not None]
        where = f"step {self.steps}, t = {self.time:.4g} of {self.end:.4g} {unit}"
        return _html.page(_html.banner("running", "", where),
                          _html.progress(min(1.0, self.time / self.end) if self.end > 0.0 else 1.0),
                          _html.figures(figures), _pictures(self._curves(_CONTACT), self.energy),
                          _html.folded(f"{len(self.warnings)} warnings", self.warnings))


def resume(folder: str | os.PathLike[str], end: float | None = None, threads: int = 0) -> Run:
    """Goes on with the run of a results folder from its last checkpoint, as `carom resume` does.

    end: another end than that of the case, in its unit of time. threads: cores, 0 for all. Raises CheckpointError where
    the folder cannot be gone on from, OutputError where another run holds it, and CaseError where the case has
    functions that a program computes: these are not in the folder; take snapshots instead (Run.save).
    """
    last = None if end is None else number("end", end, "a time")
    return Run(os.fspath(folder), last, threads=threads)
