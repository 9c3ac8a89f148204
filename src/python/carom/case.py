"""Cases: trees of dicts and lists with the keys of a case file (docs/case_format.md)."""

from __future__ import annotations

import copy as _copy
import os
from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _carom
from carom._arguments import unknown
from carom.mesh import Mesh
from carom.run import Run


class Check:
    """What is known of a case before it runs; str() is what `carom check` prints."""

    text: str
    """The lines of `carom check`."""
    warnings: list[str]
    """What is doubtful."""
    notes: list[str]
    """What was chosen or mended."""

    def __init__(self, text: str, warnings: list[str], notes: list[str]) -> None:
        """Made by Case.check."""
        self.text, self.warnings, self.notes = text, warnings, notes

    def __str__(self) -> str:
        """The lines of `carom check`."""
        return self.text

    def __bool__(self) -> bool:
        """True when there are no warnings."""
        return not self.warnings


class Case(MutableMapping[str, Any]):
    """A case as a tree of dicts and lists, with the keys that its file has: `case["initial"][0]["velocity"]`.

    Numbers may be numpy's, lists may be tuples or arrays. What is wrong is said when the case is checked or started,
    as for a file. A function of time may be a callable: `case["functions"]["pulse"] = lambda t: ...`.
    """

    def __init__(self, tree: Mapping[str, Any], file: str | os.PathLike[str] = "case.toml") -> None:
        """A case from a tree, which is copied. file: names it in messages; relative paths of meshes and of initial
        states are looked for in its folder."""
        self._tree: dict[str, Any] = _copy.deepcopy(dict(tree))
        self._file = os.fspath(file)
        self._source: _carom.Source | None = None
        self._mesh: Mesh | None = None
        self._mesh_text: str | None = None

    def __getitem__(self, key: str) -> Any:
        """A section or value of the case. Raises KeyError, which lists those there are."""
        if key not in self._tree:
            raise unknown("section or value", key, self._tree)
        return self._tree[key]

    def __setitem__(self, key: str, value: Any) -> None:
        """Sets a section or value."""
        self._tree[key] = value

    def __delitem__(self, key: str) -> None:
        """Leaves a section out."""
        del self._tree[key]

    def __iter__(self) -> Iterator[str]:
        """The keys of the sections."""
        return iter(self._tree)

    def __len__(self) -> int:
        """The number of sections."""
        return len(self._tree)

    def __repr__(self) -> str:
        """File and title."""
        return f"<carom.Case {self._file}: {self._tree.get('title', 'no title')}>"

    @property
    def file(self) -> str:
        """The file it was read from, or its name in messages."""
        return self._file

    @property
    def end(self) -> float:
        """Time at which the last stage ends, in the case's unit."""
        stages = self._tree.get("stage") or [self._tree]
        last = stages[-1]
        return float((last if "end" in last else self._tree["time"])["end"])

    @property
    def mesh(self) -> Mesh | None:
        """The mesh of arrays that the case has been given; None while it has that of its [mesh] section."""
        return self._mesh

    @mesh.setter
    def mesh(self, mesh: Mesh | None) -> None:
        """Replaces the file or blocks of [mesh]; its other keys (order, refine, unused) hold on. The arrays are read
        now: what becomes of them later does not matter. Raises CaseError for arrays that make no mesh."""
        self._mesh_text = None if mesh is None else mesh._text()
        self._mesh = mesh

    def function(self, name: str, f: Callable[[float], float]) -> Callable[[float], float]:
        """Makes [functions.name] the callable f(t), for loads, supports and obstacles that name it. Returns f.

        t is the time in the case's unit. f gives the same finite number whenever it is asked for the same time, and
        has no jumps where motions are imposed (their integrals are made by quadrature). It is called a few times a
        step, with the lock of the interpreter; what it raises ends the run and comes out of the step. Such a case can
        be run by this program alone: `carom resume` and `carom.resume` refuse its folder.
        """
        if not callable(f):
            raise TypeError("f: something that can be called with a time")
        self._tree.setdefault("functions", {})[name] = f
        return f

    def friction_law(self, contact: str, mu: Callable[..., ArrayLike]) -> Callable[..., ArrayLike]:
        """Makes mu(pressure, slip_rate, position, time) the coefficient of friction of a contact. Returns mu.

        It is called with arrays over all rows of the contact that are near touching: normal pressure (n,) (of measure =
        "node": force), size of the relative tangential velocity (n,), places (n, 3), all at the beginning of a step,
        and the time then; in the case's units. It gives n coefficients >= 0, or one for all. They hold for that step, in
        every scheme and enforcement: where they change, the error falls with the step, to first order. A row that was
        not there has no pressure and does not slide. mu gives the same values whenever it is asked the same, since steps
        may be made again, and is called with the lock of the interpreter; what it raises ends the run and comes out of
        the step. Friction's work is booked as that of any other. Such a case can be run by this program alone, as with
        functions of time. Raises KeyError, which lists the contacts.
        """
        if not callable(mu):
            raise TypeError("mu: something that can be called with pressure, slip rate, position and time")
        entry = self._contact(contact)
        entry.pop("friction", None)
        entry["friction_law"] = mu
        return mu

    def contact_law(self, contact: str, pressure: Callable[[NDArray[np.float64]], ArrayLike], depth: float,
                    tolerance: float = 1e-4) -> None:
        """Makes pressure(depths) the law of a contact with a rigid obstacle or of an interface, in the place of a
        stiffness: normal stress over penetration (of measure = "node": force), with enforcement = "penalty".

        pressure is called now, with arrays of depths from 0 to `depth`, and gives as many pressures: 0 at 0, positive
        beyond, not falling. The case keeps a table of them (its keys `depths` and `pressures`), dense enough to be off by
        no more than `tolerance` of the pressure at `depth`, and goes on straight beyond: so it can be written, resumed
        and sent to other processes. Stored energy and tangent are those of the table, exactly; stable steps allow for its
        largest slope. Raises ValueError for a law that is none, and KeyError, which lists the contacts.
        """
        entry = self._contact(contact)
        depths, pressures = _table_of(pressure, float(depth), tolerance)
        for key in ("stiffness", "stiffness_factor"):
            entry.pop(key, None)
        entry["depths"], entry["pressures"] = depths.tolist(), pressures.tolist()

    def _contact(self, name: str) -> dict[str, Any]:
        contacts = self._tree.get("contact", [])
        for entry in contacts:
            if entry.get("name") == name:
                return entry  # type: ignore[no-any-return]
        raise unknown("contact", name, (str(c.get("name")) for c in contacts))

    def copy(self) -> Case:
        """A case of its own, with the same values, functions and mesh."""
        other = Case({})
        other.__dict__.update(self.__dict__)
        other._tree = _copy.deepcopy(self._tree)
        return other

    def __getstate__(self) -> dict[str, Any]:
        """For other processes; the lines that values were written in stay behind."""
        return {**self.__dict__, "_source": None}

    def check(self, folder: str | os.PathLike[str] | None = None) -> Check:
        """Reads, resolves and examines the case without running it, as `carom check`. folder: where results would go,
        for the disk they need. Raises CaseError."""
        return Check(*_carom.check(self._prepared(), "" if folder is None else os.fspath(folder)))

    def start(self, folder: str | os.PathLike[str] | None = None, threads: int = 0) -> Run:
        """A run of the case as it is now, at its initial state.

        folder: results folder that is written as the command line does; None: nothing is written. threads: cores, 0
        for all; results do not depend on it. Raises CaseError, OutputError, and RunError where there is no way to
        start.
        """
        return Run(self._prepared(), "" if folder is None else os.fspath(folder), threads=threads)

    def resolved(self) -> str:
        """The case as a text of TOML with all defaults written out. Raises CaseError."""
        return self._prepared().resolved

    def _prepared(self) -> _carom.PreparedCase:
        """The case as the solver takes it. Raises CaseError."""
        tree, functions, frictions = self._plain("case.mesh.msh")
        return _carom.prepare(tree, self._source, self._file, functions, frictions, self._mesh_text)

    def _plain(self, mesh_file: str) -> tuple[dict[str, Any], dict[str, Callable[..., Any]], dict[str, Callable[..., Any]]]:
        """The tree as a file could hold it, a mesh of arrays being in `mesh_file`, and the functions of time and laws of
        friction that none could."""
        tree = dict(self._tree)
        functions, frictions = {}, {}
        if isinstance(tree.get("functions"), dict):
            functions = {name: f for name, f in tree["functions"].items() if callable(f)}
            tree["functions"] = {name: {"kind": "called"} if name in functions else f
                                 for name, f in tree["functions"].items()}
        if self._mesh_text is not None:
            kept = {key: value for key, value in tree.get("mesh", {}).items() if key not in ("file", "block")}
            tree["mesh"] = {"file": mesh_file, **kept}
        if isinstance(tree.get("contact"), list):
            tree["contact"] = [dict(entry) if isinstance(entry, dict) else entry for entry in tree["contact"]]
            for entry in tree["contact"]:
                if isinstance(entry, dict) and callable(entry.get("friction_law")):
                    frictions[entry.get("name", "")] = entry["friction_law"]
                    entry["friction_law"] = "called"
        return tree, functions, frictions


def _table_of(pressure: Callable[[NDArray[np.float64]], ArrayLike], depth: float,
              tolerance: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Depths from above 0 on and pressures, with points where a straight line would miss the law."""
    if not (np.isfinite(depth) and depth > 0.0):
        raise ValueError(f"depth: {depth}, and a depth > 0 is wanted")

    def at(depths: NDArray[np.float64]) -> NDArray[np.float64]:
        found = np.asarray(pressure(depths), dtype=np.float64)
        if found.shape != depths.shape or not np.isfinite(found).all():
            raise ValueError("pressure: one finite number is wanted for each depth")
        return found

    x = np.linspace(0.0, depth, 65)
    p = at(x)
    most = 20_000
    if abs(p[0]) > 1e-12 * abs(p[-1]):
        raise ValueError(f"pressure: {p[0]:g} at depth 0, where bodies only touch, and 0 is wanted")
    while len(x) < most:
        middle = (x[1:] + x[:-1]) / 2.0
        between = at(middle)
        missed = np.abs(between - (p[1:] + p[:-1]) / 2.0) > tolerance * p[-1]
        if not missed.any():
            break
        places = np.flatnonzero(missed) + 1
        x, p = np.insert(x, places, middle[missed]), np.insert(p, places, between[missed])
    else:
        raise ValueError(f"pressure: {most} points do not follow it to {tolerance:g}: it jumps, or has an infinite slope")
    if not (p[1:] > 0.0).all() or (np.diff(p) < 0.0).any():
        raise ValueError("pressure: positive and not falling with the depth is wanted")
    return x[1:], p[1:]


def load(path: str | os.PathLike[str], accept: Sequence[str] = ()) -> Case:
    """Reads a case file, or a deck of Abaqus or CalculiX (docs/decks.md). The tree holds what is written there, of a deck
    what it means; defaults are filled when the case is checked or started (`Case.resolved` shows them).

    accept: keywords of a deck that are lost without stopping, as `--accept`; what is lost is among the notes of the
    check and of the run. Raises CaseError with file, line, column and key."""
    tree, source = _carom.read(os.fspath(path), list(accept))
    case = Case(tree, path)
    case._source = source
    return case
