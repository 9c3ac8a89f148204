"""Meshes as arrays."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _carom
from carom._arguments import unknown
from carom._optional import needed

_MESHIO = {"point1": "vertex", "line2": "line", "line3": "line3", "tria3": "triangle", "tria6": "triangle6",
           "quad4": "quad", "quad8": "quad8", "quad9": "quad9", "tetra4": "tetra", "tetra10": "tetra10",
           "pyra5": "pyramid", "pyra13": "pyramid13", "penta6": "wedge", "penta15": "wedge15", "hexa8": "hexahedron",
           "hexa20": "hexahedron20", "hexa27": "hexahedron27"}
"""Names of the types in meshio."""
_VTK = {"point1": 1, "line2": 3, "line3": 21, "tria3": 5, "tria6": 22, "quad4": 9, "quad8": 23, "quad9": 28,
        "tetra4": 10, "tetra10": 24, "pyra5": 14, "pyra13": 27, "penta6": 13, "penta15": 26, "hexa8": 12, "hexa20": 25,
        "hexa27": 29}
"""Numbers of the types in VTK."""


class Mesh:
    """Points, cells by type, and groups. Nodes and cells count from 0 here, and from 1 in a case (`node = 1` of a probe
    is row 0)."""

    points: NDArray[np.float64]
    """(n, 3), in the case's unit of length."""
    cells: dict[str, NDArray[np.int32]]
    """For each type ("hexa8", "quad4", "line2", ...) the rows of nodes, in VTK's order."""
    node_groups: dict[str, NDArray[np.int32]]
    """Rows of points by name."""
    cell_groups: dict[str, dict[str, NDArray[np.int32]]]
    """By name and type, rows of cells."""

    def __init__(self, points: ArrayLike, cells: Mapping[str, ArrayLike],
                 node_groups: Mapping[str, ArrayLike] | None = None,
                 cell_groups: Mapping[str, ArrayLike | Mapping[str, ArrayLike]] | None = None) -> None:
        """cell_groups: by name, rows of cells by type, or rows alone where the mesh has one type of cells of the highest
        dimension, which are then meant. A group of faces needs the faces as cells (of type "quad4", ...), or is a
        group of nodes. Wrong shapes are said when the mesh is given to a case."""
        self.points = np.asarray(points, dtype=np.float64)
        self.cells = {name: np.asarray(rows) for name, rows in cells.items()}
        self.node_groups = {name: np.asarray(rows) for name, rows in (node_groups or {}).items()}
        self.cell_groups = {name: self._by_type(name, rows) for name, rows in (cell_groups or {}).items()}

    @classmethod
    def _of(cls, data: _carom.MeshData, nodes: int) -> Mesh:
        """Views of a mesh of the solver, whose first `nodes` are the user's."""
        mesh = cls.__new__(cls)
        mesh.points, mesh.cells = data.points[:nodes], data.cells
        mesh.node_groups, mesh.cell_groups = data.node_groups, data.cell_groups
        return mesh

    def _by_type(self, group: str, rows: ArrayLike | Mapping[str, ArrayLike]) -> dict[str, NDArray[Any]]:
        if isinstance(rows, Mapping):
            return {name: np.asarray(of_type) for name, of_type in rows.items()}
        solids = [name for name in self.cells if name[:4] in ("hexa", "tetr", "pyra", "pent")] or list(self.cells)
        if len(solids) != 1:
            raise ValueError(f"cell_groups[{group!r}]: the mesh has cells of types {', '.join(solids)}; give rows for "
                             "each of them, as {type: rows}")
        return {solids[0]: np.asarray(rows)}

    def _text(self) -> str:
        """What a mesh file would hold. Raises CaseError for arrays that make no mesh."""
        for name, rows in [*self.cells.items(), *self.node_groups.items(),
                           *((f"{g}.{t}", r) for g, of in self.cell_groups.items() for t, r in of.items())]:
            if rows.size and not np.issubdtype(rows.dtype, np.integer):
                raise TypeError(f"{name}: whole numbers are needed, these are {rows.dtype}")
        return _carom.mesh_text(self.points, list(self.cells.items()), self.node_groups, self.cell_groups)

    def nodes_of(self, group: str) -> NDArray[np.int32]:
        """Rows of the points of a node group and of the cells of a cell group of this name, sorted. Raises KeyError."""
        if group not in self.node_groups and group not in self.cell_groups:
            raise unknown("group", group, [*self.node_groups, *self.cell_groups])
        found = [np.asarray(self.node_groups.get(group, []), dtype=np.int32)]
        found += [np.ravel(self.cells[name][rows]) for name, rows in self.cell_groups.get(group, {}).items()]
        return np.unique(np.concatenate(found)).astype(np.int32)

    def to_meshio(self, **point_data: ArrayLike) -> Any:
        """As a meshio.Mesh, with arrays over the points by name. Raises ImportError where meshio is not installed."""
        meshio = needed("meshio", "to_meshio", "apt install python3-meshio")
        return meshio.Mesh(self.points, [(_MESHIO[name], rows) for name, rows in self.cells.items()],
                           point_data={name: np.asarray(values) for name, values in point_data.items()},
                           point_sets={name: np.asarray(rows) for name, rows in self.node_groups.items()},
                           cell_sets={name: [np.asarray(of.get(kind, []), dtype=np.int64) for kind in self.cells]
                                      for name, of in self.cell_groups.items()})

    @classmethod
    def from_meshio(cls, mesh: Any) -> Mesh:
        """From a meshio.Mesh: its points, cells, point_sets and cell_sets. Raises ValueError for cells that Carom does
        not know."""
        types = {theirs: ours for ours, theirs in _MESHIO.items()}
        blocks: dict[str, list[NDArray[Any]]] = {}
        first = []
        for block in mesh.cells:
            if block.type not in types:
                raise ValueError(f"cells of type {block.type}; there are {', '.join(types)}")
            rows = blocks.setdefault(types[block.type], [])
            first.append(sum(len(of_type) for of_type in rows))
            rows.append(np.asarray(block.data))
        groups: dict[str, dict[str, list[NDArray[Any]]]] = {}
        for name, sets in mesh.cell_sets.items():
            for block, offset, rows in zip(mesh.cells, first, sets):
                if rows is not None and len(rows):
                    groups.setdefault(name, {}).setdefault(types[block.type], []).append(np.asarray(rows) + offset)
        points = np.asarray(mesh.points, dtype=np.float64)
        if points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        return cls(points, {name: np.concatenate(rows) for name, rows in blocks.items()}, dict(mesh.point_sets),
                   {name: {t: np.concatenate(rows) for t, rows in of.items()} for name, of in groups.items()})

    def to_pyvista(self, **point_data: ArrayLike) -> Any:
        """As a pyvista.UnstructuredGrid, with arrays over the points by name. Raises ImportError where PyVista is not
        installed."""
        pyvista = needed("pyvista", "to_pyvista", "Debian 12 has no package of it")
        grid = pyvista.UnstructuredGrid({_VTK[name]: rows for name, rows in self.cells.items()}, self.points)
        for name, values in point_data.items():
            grid.point_data[name] = np.asarray(values)
        return grid

    def __repr__(self) -> str:
        """Numbers of nodes and cells, and the groups."""
        cells = ", ".join(f"{len(rows)} {name}" for name, rows in self.cells.items())
        return f"<carom.Mesh: {len(self.points)} points, {cells}; groups {', '.join([*self.node_groups, *self.cell_groups])}>"


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Reads a mesh file (Gmsh 2.2 and 4.1, MED 2.2 to 4). Nodes and cells come in the order in which the solver has
    them, which is another than the file's. Raises CaseError."""
    data = _carom.read_mesh(os.fspath(path))
    return Mesh._of(data, len(data.points))
