"""The surface of a grid as ParaView shows it: vtu_hidden.py FILE POLYGONS AREA

Faces of cells that are there, and no others; FILE has unit cubes, so its area is a whole number.
"""

import sys

from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

reader = vtkHDFReader() if sys.argv[1].endswith(".vtkhdf") else vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
surface = vtkDataSetSurfaceFilter()
surface.SetInputConnection(reader.GetOutputPort())
triangles = vtkTriangleFilter()
triangles.SetInputConnection(surface.GetOutputPort())
measures = vtkMassProperties()
measures.SetInputConnection(triangles.GetOutputPort())
measures.Update()
found = (surface.GetOutput().GetNumberOfPolys(), round(measures.GetSurfaceArea(), 6))
if found != (int(sys.argv[2]), float(sys.argv[3])):
    sys.exit(f"{sys.argv[1]}: polygons and area {found}, not {sys.argv[2:]}")
