"""Reads a results folder with VTK and compares every number: vtu_read.py FOLDER nx ny nz hexahedra|mixed STEP...

The expected numbers are computed here from the rules in output_vtu.cpp (unit cubes, x fastest; entry i of a field is
scale * (i + 1/3) with scale = step + 1, negated for the stress and doubled for the energy density, which is there in
single precision as well; points have their number modulo 251, cells theirs less 7). Equality is exact: raw binary data
lose nothing. `mixed`: behind the cubes come the face z = 0 of the first one and that face's first edge.
"""

import struct
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_LINE, VTK_QUAD
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def expected_grid(nx, ny, nz):
    def number(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    points = [(float(i), float(j), float(k)) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [
        tuple(number(i + di, j + dj, k + dk) for di, dj, dk in corners)
        for k in range(nz)
        for j in range(ny)
        for i in range(nx)
    ]
    return points, cells


def tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def values(count, components, scale):
    return [tuple(scale * (c + 1.0 / 3.0) for c in range(i * components, (i + 1) * components)) for i in range(count)]


def same(what, found, expected):
    if found != expected:
        sys.exit(f"{what}: {len(found)} entries, expected {len(expected)}, or values differ")


def read(path):
    errors = []
    reader = vtkXMLUnstructuredGridReader()
    reader.AddObserver(vtkCommand.ErrorEvent, lambda *_: errors.append(True))
    reader.SetFileName(path)
    reader.Update()
    if errors or reader.GetErrorCode():
        sys.exit(f"{path}: VTK cannot read it (error code {reader.GetErrorCode()})")
    return reader.GetOutput()


def check_frame(path, shape, is_mixed, scale):
    grid = read(path)
    points, cells = expected_grid(*shape)
    types = [VTK_HEXAHEDRON] * len(cells)
    if is_mixed:
        cells += [cells[0][:4], cells[0][:2]]
        types += [VTK_QUAD, VTK_LINE]
    same("points", tuples(grid.GetPoints().GetData()), points)
    same("cell types", [grid.GetCellType(c) for c in range(grid.GetNumberOfCells())], types)
    connectivity = [int(n) for (n,) in tuples(grid.GetCells().GetConnectivityArray())]
    ends = [int(n) for (n,) in tuples(grid.GetCells().GetOffsetsArray())]
    same("cells", [tuple(connectivity[a:b]) for a, b in zip(ends, ends[1:])], cells)
    on_points, on_cells = grid.GetPointData(), grid.GetCellData()
    if on_points.GetNumberOfArrays() != 2 or on_cells.GetNumberOfArrays() != 4:
        sys.exit("missing or unexpected arrays")
    same("displacement", tuples(on_points.GetArray("displacement")), values(len(points), 3, scale))
    same("stress", tuples(on_cells.GetArray("stress")), values(len(cells), 6, -scale))
    energy = values(len(cells), 1, 2 * scale)
    same("energy", tuples(on_cells.GetArray('energy <&"> density')), energy)
    in_single = [struct.unpack("f", struct.pack("f", e)) for (e,) in energy]
    same("in single precision", tuples(on_cells.GetArray("in single precision")), in_single)
    same("status", tuples(on_points.GetArray("status")), [(n % 251,) for n in range(len(points))])
    same("number", tuples(on_cells.GetArray("number")), [(c - 7,) for c in range(len(cells))])


def main():
    folder, shape, steps = sys.argv[1], [int(n) for n in sys.argv[2:5]], [int(n) for n in sys.argv[6:]]
    sets = ElementTree.parse(folder + "/fields.pvd").getroot().find("Collection").findall("DataSet")
    if [float(s.get("timestep")) for s in sets] != [0.1 * step for step in steps]:
        sys.exit("fields.pvd: wrong times")
    for data_set, step in zip(sets, steps):
        check_frame(folder + "/" + data_set.get("file"), shape, sys.argv[5] == "mixed", step + 1.0)


main()
