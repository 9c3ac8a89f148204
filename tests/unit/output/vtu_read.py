"""Reads the frames of an index with VTK and compares every number: vtu_read.py INDEX nx ny nz hexahedra|mixed STEP...

The expected numbers are computed here from the rules in output_vtu.cpp (unit cubes, x fastest; entry i of a field is
scale * (i + 1/3) with scale = step + 1, negated for the stress and doubled for the energy density, which is there in
single precision as well; points have their number modulo 251, cells theirs less 7). Equality is exact: binary data
lose nothing, deflated or not. `mixed`: behind the cubes come the face z = 0 of the first one and that face's first edge.
"""

import os
import struct
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_LINE, VTK_QUAD
from vtkmodules.vtkIOHDF import vtkHDFReader
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
        sys.exit(f"{what}: {str(found)[:80]}, expected {str(expected)[:80]}, or values behind differ")


def read(path):
    errors = []
    reader = vtkHDFReader() if path.endswith(".vtkhdf") else vtkXMLUnstructuredGridReader()
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


def frames(index):
    """Times and files, as the index has them; what XDMF says of the arrays is compared with what VTK reads."""
    root = ElementTree.parse(index).getroot()
    if index.endswith(".pvd"):
        return [(float(s.get("timestep")), s.get("file")) for s in root.find("Collection").findall("DataSet")]
    grids = root.find("Domain").find("Grid").findall("Grid")
    for grid in grids:
        check_items(os.path.dirname(index), grid)
    return [(float(g.find("Time").get("Value")), g.get("Name")) for g in grids]


def check_items(folder, grid):
    found = read(folder + "/" + grid.get("Name"))
    fields = {"Node": found.GetPointData(), "Cell": found.GetCellData()}
    kinds = {"vtkDoubleArray": ("Float", "8"), "vtkFloatArray": ("Float", "4"), "vtkIntArray": ("Int", "4"),
             "vtkUnsignedCharArray": ("UChar", "1")}
    same("arrays", len(grid.findall("Attribute")), sum(f.GetNumberOfArrays() for f in fields.values()))
    for attribute in grid.findall("Attribute"):
        array = fields[attribute.get("Center")].GetArray(attribute.get("Name"))
        item = attribute.find("DataItem")
        shape = [array.GetNumberOfTuples()] + ([array.GetNumberOfComponents()] if array.GetNumberOfComponents() > 1 else [])
        same(attribute.get("Name"), item.get("Dimensions"), " ".join(str(n) for n in shape))
        same(attribute.get("Name"), (item.get("NumberType"), item.get("Precision")), kinds[array.GetClassName()])
    for item in grid.iter("DataItem"):
        if not os.path.exists(folder + "/" + item.text.split(":")[0]):
            sys.exit(f"{item.text}: no such file")
    same("cells", int(grid.find("Topology").get("NumberOfElements")), found.GetNumberOfCells())


def main():
    index, shape, steps = sys.argv[1], [int(n) for n in sys.argv[2:5]], [int(n) for n in sys.argv[6:]]
    sets = frames(index)
    if [time for time, _ in sets] != [0.1 * step for step in steps]:
        sys.exit(f"{index}: wrong times")
    for (_, file), step in zip(sets, steps):
        check_frame(os.path.dirname(index) + "/" + file, shape, sys.argv[5] == "mixed", step + 1.0)


main()
