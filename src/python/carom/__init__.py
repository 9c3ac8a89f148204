"""Carom from Python: impact dynamics of deformable solids.

A case is read (`load`) or made of dicts (`Case`), examined (`Case.check`), started (`Case.start`), stepped
(`Run.step`, `Run.until`) and brought to its end (`Run.finish`). Results have the same bits as those of the command
line. All numbers are in the units of the case; nothing is ever converted.
"""

from carom import _environment  # before the libraries of the extension are loaded

with _environment.prepared():
    from carom._carom import Snapshot, version
_environment.warn_of_kernels()

from carom.case import Case, Check, load
from carom.commands import Comparison, LawCurve, Variant, compare, material
from carom.curves import ContactState, Curves
from carom.errors import CaseError, CheckpointError, Error, OutputError, RunError
from carom.fields import Cells, FieldKind, Frames, NodalForces, read_frames
from carom.mesh import Mesh, read_mesh
from carom.result import Result, View, read_results
from carom.run import Run, resume
from carom.studies import Outcome, study

__version__ = version()
__all__ = ["Case", "CaseError", "Cells", "Check", "CheckpointError", "Comparison", "ContactState", "Curves", "Error",
           "FieldKind", "Frames", "LawCurve", "Mesh", "NodalForces", "Outcome", "OutputError", "Result", "Run",
           "RunError", "Snapshot", "Variant", "View", "compare", "load", "material", "read_frames", "read_mesh",
           "read_results", "resume", "study", "version"]
