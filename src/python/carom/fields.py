"""Fields: values at all nodes or cells, now and at the instants that were kept."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from carom import _carom
from carom._arguments import unknown
from carom._optional import needed
from carom.mesh import Mesh


@dataclass(frozen=True)
class FieldKind:
    """What the values of a field are (docs/quantities.md)."""

    name: str
    """As in `output.fields` of a case."""
    place: str
    """"nodes" or "cells": what the rows of its arrays belong to."""
    components: tuple[str, ...]
    """Of the columns, in their order: () of a number, ("x", "y", "z"), ("xx", "yy", "zz", "xy", "yz", "zx"), or ("1",
    "2", "3") of principal values, the largest first."""
    unit: str
    """In the case's system of units, "" where there is none."""
    meaning: str
    """A phrase."""


@dataclass(frozen=True)
class Cells:
    """The cells that the rows of fields belong to, in their order: part by part."""

    numbers: NDArray[np.int64]
    """(cells,), in the mesh file."""
    parts: NDArray[np.int32]
    """(cells,), the position of their part in the case, from 0."""
    types: NDArray[np.str_]
    """(cells,), "hexa8" and so on."""
    rows: NDArray[np.int32]
    """(cells,), where they stand in `mesh.cells[type]`."""


class NodalForces(NamedTuple):
    """What one contact exerts on each node that it touches."""

    nodes: NDArray[np.int32]
    """(n,), ascending rows of `run.mesh.points`."""
    numbers: NDArray[np.int64]
    """(n,), their numbers in the mesh file."""
    force: NDArray[np.float64]
    """(n, 3), x y z, in the case's unit of force."""


def _field_kind(name: str, units: str) -> FieldKind:
    """Of a field by its name. units: the comment of the tables that names them."""
    is_at_nodes, components, unit, meaning = _carom.kind_of(name, units)
    return FieldKind(name, "nodes" if is_at_nodes else "cells", tuple(components), unit, meaning)


class _Source(Protocol):
    """Where frames stand."""

    def times(self) -> list[float]: ...

    def values(self, frame: int, name: str) -> NDArray[Any]: ...


class Frames(Mapping[str, NDArray[Any]]):
    """Fields at the instants at which they were kept, in memory (`Run.record`) or in a results folder (`read_frames`).

    A mapping from names to arrays of (frames, rows) or (frames, rows, components), rows being nodes or cells:
    `frames["stress"][-1, :, 0]` is the stress xx of all cells in the last frame. `kinds` has place, components and unit
    of each. Arrays are read or put together when they are asked for; `at` gives one frame alone.
    """

    kinds: dict[str, FieldKind]
    """The fields, by their names."""
    mesh: Mesh
    """The mesh that the rows belong to; that of a folder has no groups."""
    cells: Cells
    """Number, part, type and place of the cells that fields have values of."""
    node_numbers: NDArray[np.int64]
    """(nodes,), in the mesh file."""

    def __init__(self, source: _Source, kinds: dict[str, FieldKind], mesh: Mesh, cells: Cells,
                 node_numbers: NDArray[np.int64]) -> None:
        """Made by Run.record and read_frames."""
        self._source, self.kinds, self.mesh, self.cells, self.node_numbers = source, kinds, mesh, cells, node_numbers

    @property
    def time(self) -> NDArray[np.float64]:
        """(frames,), in the case's unit."""
        return np.array(self._source.times(), dtype=np.float64)

    def at(self, name: str, frame: int) -> NDArray[Any]:
        """A field in one frame, (rows,) or (rows, components); frame: its position, from the end where it is negative.
        Raises KeyError, which lists the fields there are, and IndexError."""
        if name not in self.kinds:
            raise unknown("field", name, list(self.kinds))
        count = len(self._source.times())
        if not -count <= frame < count:
            raise IndexError(f"frame {frame} of {count}")
        values = self._source.values(frame % count, name)
        return values[:len(self.node_numbers)] if self.kinds[name].place == "nodes" else values

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A field in all frames. Raises KeyError, which lists the fields there are."""
        if name not in self.kinds:
            raise unknown("field", name, list(self.kinds))
        return np.array([self.at(name, frame) for frame in range(len(self._source.times()))])

    def __iter__(self) -> Iterator[str]:
        """The names of the fields."""
        return iter(self.kinds)

    def __len__(self) -> int:
        """The number of fields."""
        return len(self.kinds)

    def __contains__(self, name: object) -> bool:
        """Is there a field of this name?"""
        return name in self.kinds

    def to_xarray(self, names: Sequence[str] | None = None) -> Any:
        """As an xarray.Dataset: the fields over `time`, `node` or `cell` (their numbers in the mesh file) and `axis` (x y
        z), `component` (xx yy zz xy yz zx) or `principal` (1 2 3); with coordinates `x`, `y` and `z` of nodes (in the
        mesh) and `part` of cells, and attributes `units` and `long_name`. names: of the fields, None: all. Raises ImportError where xarray
        is not installed, and KeyError."""
        xarray = needed("xarray", "to_xarray", "apt install python3-xarray")
        third = {"x": "axis", "xx": "component", "1": "principal"}
        data = {}
        for name in self.kinds if names is None else names:
            values = self[name]
            kind = self.kinds[name]
            dimensions = ["time", kind.place[:-1], *(third[c] for c in kind.components[:1])]
            data[name] = (dimensions, values, {"units": kind.unit, "long_name": kind.meaning})
        coordinates: dict[str, Any] = {
            "time": self.time, "node": self.node_numbers, "cell": self.cells.numbers, "part": ("cell", self.cells.parts),
            **{axis: ("node", self.mesh.points[:, i]) for i, axis in enumerate("xyz")}}
        for name in data:
            for component in self.kinds[name].components[:1]:
                coordinates[third[component]] = list(self.kinds[name].components)
        return xarray.Dataset(data, coordinates)

    def __repr__(self) -> str:
        """How many frames, and the fields."""
        return f"<carom.Frames: {len(self._source.times())} of {', '.join(self.kinds)}>"


class _KeptFrames:
    """In memory; an observer of the run whose frames it keeps."""

    def __init__(self, names: Sequence[str]) -> None:
        """names: of the fields."""
        self._names, self._times, self._values = list(names), list[float](), list[dict[str, NDArray[Any]]]()

    def __call__(self, run: Any) -> None:
        """Keeps this instant; what is not before it, of a run that has been taken back, goes."""
        while self._times and self._times[-1] >= run.time:
            del self._times[-1], self._values[-1]
        self._times.append(run.time)
        self._values.append({name: run.field(name) for name in self._names})

    def times(self) -> list[float]:
        """Of the frames."""
        return self._times

    def values(self, frame: int, name: str) -> NDArray[Any]:
        """A field in one of them."""
        return self._values[frame][name]


class _FolderFrames:
    """In a results folder."""

    def __init__(self, frames: list[tuple[float, str]]) -> None:
        """frames: times and files."""
        self._frames = frames

    def times(self) -> list[float]:
        return [time for time, _ in self._frames]

    def values(self, frame: int, name: str) -> NDArray[Any]:
        return _carom.FrameFile(self._frames[frame][1]).array(name)


def _cells_of(data: _carom.MeshData, blocks: NDArray[np.int32], rows: NDArray[np.int32],
             parts: NDArray[np.int32]) -> Cells:
    """Cells by the position of their type in the mesh and their row there."""
    types = list(data.cells)
    numbers = np.empty(len(rows), dtype=np.int64)
    for block, of_type in enumerate(data.cell_numbers.values()):
        numbers[blocks == block] = of_type[rows[blocks == block]]
    return Cells(numbers, parts, np.array(types)[blocks], rows)


def read_frames(folder: str | os.PathLike[str]) -> Frames:
    """The frames of a results folder (docs/results.md), also of one that a run is still writing. The arrays have the
    precision of the files: numbers of 32 bits, or 64 with `output.precision = "double"`. As long as a run has not ended,
    nodes that springs and obstacles hang on follow those of the mesh.

    Raises FileNotFoundError where the folder has no frames, and RuntimeError for files that are damaged."""
    folder = os.fspath(folder)
    frames = _carom.frames_of(folder)
    if not frames:
        raise FileNotFoundError(f"{folder} has no frames: they are written by runs with a folder whose case has "
                                "output.fields")
    first = _carom.FrameFile(frames[0][1])
    data = first.mesh
    unit_comment = _units_of(folder)
    kinds = {}
    for name, is_at_nodes in first.fields.items():
        if name not in ("node_number", "cell_number", "part"):
            kinds[name] = _field_kind(name, unit_comment)
            assert (kinds[name].place == "nodes") == is_at_nodes
    numbers, parts = first.array("cell_number").astype(np.int64), first.array("part")
    types, rows = np.empty(len(parts), dtype="<U8"), np.empty(len(parts), dtype=np.int32)
    for name, positions in data.cell_numbers.items():
        types[positions], rows[positions] = name, np.arange(len(positions))
    nodes = first.array("node_number").astype(np.int64)[:_nodes_in(folder)]
    mesh = Mesh._of(data, len(nodes))
    return Frames(_FolderFrames(frames), kinds, mesh, Cells(numbers, parts, types, rows), nodes)


def _nodes_in(folder: str) -> int | None:
    """How many nodes the mesh has without those that springs and obstacles hang on; None where no summary says so."""
    try:
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as summary:
            return int(json.load(summary)["mesh"]["nodes"])
    except FileNotFoundError:
        return None


def _units_of(folder: str) -> str:
    """The comment that names the units, of the table that every run writes."""
    with open(os.path.join(folder, "energy.csv"), encoding="utf-8") as table:
        for line in table:
            if not line.startswith("#"):
                break
            if "units:" in line:
                return line[1:].strip()
    return ""
