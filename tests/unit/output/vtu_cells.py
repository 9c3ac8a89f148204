"""Reads meshes with VTK and judges their cells: vtu_cells.py VOLUME FILE...

In each file the corners of every face that VTK makes of a solid are to run so that its normal looks out of the cell, the
nodes behind the corners are to stand in the middle of theirs, as VTK's own parametric coordinates have them, and the
volumes (areas of plane cells) inside of VTK's faces (edges) are to add up to VOLUME.
"""

import sys

from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def points_of(cell):
    return [cell.GetPoints().GetPoint(i) for i in range(cell.GetNumberOfPoints())]


def looks_outward(cell):
    points = points_of(cell)
    centre = [sum(x) / len(points) for x in zip(*points)]
    for f in range(cell.GetNumberOfFaces()):
        x = points_of(cell.GetFace(f))
        normal = cross(minus(x[1], x[0]), minus(x[2], x[0]))
        if dot(normal, minus(x[0], centre)) <= 0.0:
            return False
    return True


def is_straight(cell):
    """Every node is where the corners' map sends its parametric coordinates: on a straight cell, in the middle."""
    weights = [0.0] * cell.GetNumberOfPoints()
    parametric = cell.GetParametricCoords()
    points = points_of(cell)
    for i, x in enumerate(points):
        found = [0.0, 0.0, 0.0]
        cell.InterpolateFunctions(parametric[3 * i : 3 * i + 3], weights)
        for w, y in zip(weights, points):
            found = [p + w * q for p, q in zip(found, y)]
        if max(abs(p) for p in minus(found, x)) > 1e-12:
            return False
    for e in range(cell.GetNumberOfEdges()):
        x = points_of(cell.GetEdge(e))
        if len(x) == 3 and max(abs(2.0 * m - a - b) for a, b, m in zip(*x)) > 1e-12:
            return False
    return True


def size(cell):
    """Flux of the position through the flat faces by their corners, which come first, or through the edges."""
    total = 0.0
    for f in range(cell.GetNumberOfFaces()):
        face = cell.GetFace(f)
        x = points_of(face)[: face.GetNumberOfEdges()]
        for b, c in zip(x[1:], x[2:]):
            total += dot(x[0], cross(minus(b, x[0]), minus(c, x[0]))) / 6.0
    for e in range(cell.GetNumberOfEdges() if cell.GetCellDimension() == 2 else 0):
        a, b = points_of(cell.GetEdge(e))[:2]
        total += 0.5 * (a[0] * b[1] - a[1] * b[0])
    return total


def judge(path, volume):
    reader = vtkHDFReader() if path.endswith(".vtkhdf") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        sys.exit(f"{path}: no cells")
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        if not looks_outward(cell):
            sys.exit(f"{path}: cell {c} of VTK type {cell.GetCellType()} has a face that looks inward")
        if not is_straight(cell):
            sys.exit(f"{path}: cell {c} of VTK type {cell.GetCellType()} has its nodes in another order")
    total = sum(size(grid.GetCell(c)) for c in range(grid.GetNumberOfCells()))
    if abs(total - volume) > 1e-9 * volume:
        sys.exit(f"{path}: size {total}, expected {volume}")


for file in sys.argv[2:]:
    judge(file, float(sys.argv[1]))
