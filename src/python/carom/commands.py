"""What the commands `carom material` and `carom compare` do, as objects."""

from __future__ import annotations

import json
import math
import os
import pathlib
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _carom, _html
from carom._arguments import number, whole
from carom._optional import needed
from carom.case import Case, load
from carom.curves import Curves
from carom.result import Result, read_results

_Value = TypeVar("_Value")


class LawCurve(Curves):
    """What a law answers along a path of deformation, one row per point (docs/material_driver.md).

    Columns: `time`, `strain` (engineering strain or shear gamma; not of tables), `F_xx` ... `F_zz`, the Cauchy stress
    `stress_xx` ... `stress_zx`, `von_mises`, `energy` and `dissipation` per reference volume, and what the point
    remembers, by the names of docs/material_laws.md.
    """

    part: str
    """The part whose law and section were taken."""
    off_measured: float | None
    """Root mean square of the stress less the measured one, over what lies within the first leg of the path; not a number
    where nothing does, None without a measured curve."""

    def __init__(self, columns: list[str], rows: NDArray[np.float64], part: str, units: str,
                 off_measured: float | None) -> None:
        """Made by material."""
        super().__init__(columns, rows, units)
        self.part, self.off_measured = part, off_measured

    def unit(self, name: str) -> str:
        """The unit of a column, "" where it has none; energies per volume have that of stress. Raises KeyError."""
        return super().unit("von_mises" if name in ("energy", "dissipation") else name)


def material(case: Case | str | os.PathLike[str],
             path: str | os.PathLike[str] | Mapping[str, ArrayLike], *, part: str = "",
             to: float | Sequence[float] = 0.1, steps: int = 200, rate: float = 1.0,
             measured: str | os.PathLike[str] | tuple[ArrayLike, ArrayLike] | None = None,
             folder: str | os.PathLike[str] | None = None) -> LawCurve:
    """Follows a path of deformation with the law and the section of a part at a single point, as `carom material`: no
    mesh is read, nothing moves.

    case: a Case or the file of one. path: "uniaxial_stress", "uniaxial_strain", "simple_shear", a .csv file, or such a
    table as arrays: {"time": ..., "F_xx": ..., "F_xy": ...} or strain_xx and so on. part: its name, "" for the only one.
    to: engineering strains or shears at which the path turns, from 0; steps: from one of them to the next; rate: of that
    strain per unit of time. measured: a file of rows strain,stress, or both as arrays, from which the stress is off by
    `off_measured`. folder: where table and page of the command are written, None: nowhere.

    Raises CaseError for a case, part or path that is none, and RunError where the law gives no number.
    """
    if whole("steps", steps, "a number of steps, at least 1,") < 1:
        raise ValueError(f"steps: {steps}, and a number of steps is wanted, at least 1")
    if not number("rate", rate, "a rate of strain > 0") > 0.0:
        raise ValueError(f"rate: {rate}, and a rate of strain > 0 is wanted")
    table, name_of_path = None, "table of arrays"
    if not isinstance(path, Mapping):
        name_of_path = os.fspath(path)
    else:
        table = [(name, np.atleast_1d(np.asarray(values, dtype=np.float64))) for name, values in path.items()]
        if len({len(values) for _, values in table}) > 1:
            raise ValueError("path: columns of different lengths: "
                             + ", ".join(f"{name} {len(values)}" for name, values in table))
    pair, file = None, ""
    if isinstance(measured, tuple):
        pair = np.asarray(measured[0], dtype=np.float64), np.asarray(measured[1], dtype=np.float64)
        if pair[0].shape != pair[1].shape or pair[0].ndim != 1 or not pair[0].size:
            raise ValueError("measured: strains and stresses of one length are wanted")
    elif measured is not None:
        file = os.fspath(measured)
    return LawCurve(*_carom.material(_case_of(case)._prepared(), name_of_path, [float(x) for x in np.atleast_1d(to)],
                                     steps, rate, table, file, pair, part, "" if folder is None else os.fspath(folder)))


@dataclass(frozen=True)
class Variant:
    """One run of a comparison; the numbers are those of docs/compare.md."""

    name: str
    """As its folder is called: "02_newmark_n50"."""
    label: str
    """What is varied: "newmark, 50 cells"."""
    scheme: str
    """Its time scheme."""
    enforcement: str
    """How contact is enforced."""
    stiffness: str | None
    """Of contacts, as it was asked for."""
    cells: int | None
    """Along the longest edge; of mesh files relative to the file's; None where they are not varied."""
    status: str
    """"passed", the items of the verdict that failed, or why there is nothing to compare."""
    notes: list[str]
    """Keys that were left out or chosen."""
    result: Result | None
    """Curves and summary; None where the run has not come to its end."""
    errors: dict[str, tuple[float, float]]
    """By quantity the L2 and the L1 error against the reference (differences to it, where that is a run)."""
    claimed_error: float
    """What the other runs say of the L2 error of the quantity that is ranked by; not a number where none can judge it."""
    peak_force: float
    """Largest magnitude of the compared contact forces."""
    energy_kept: float
    """1 minus the energy that the computation has lost, over the larger of initial and largest supplied energy."""
    penetration: float
    """Largest of all contacts."""
    courant: float
    """Largest step over shortest cell / fastest wave."""
    step: float
    """Largest step."""
    steps: int
    """How many."""
    cpu_seconds: float
    """Processor time of the run."""


@dataclass(frozen=True)
class Comparison:
    """What `compare` found: docs/compare.md says how errors and claims are meant."""

    variants: list[Variant]
    """In the order of the choices, also those that could not be run."""
    recommended: Variant | None
    """The one to take; None where nothing can be recommended."""
    headline: str
    """The recommendation in a sentence, or why there is none."""
    reasons: list[str]
    """Sentences with numbers."""
    quantity: str
    """The one that variants are ranked by: "force", else "velocity", ..."""
    reference: Variant | None
    """The run that the others are compared with; None: the exact solution of the case."""
    orders: dict[str, dict[str, dict[str, float]]]
    """Along "cells", "step" and "stiffness", by what the variants have in common: "order", "least" and "largest"."""
    folder: str
    """Where compare.html, compare.csv and the runs are; "" where nothing was kept."""
    tables: dict[str, str]
    """The variants as one table of text, by format: "text", "markdown", "latex", "csv", as `carom compare --format` prints it."""

    def to_markdown(self) -> str:
        """The table of the variants in Markdown, as `carom compare --format markdown` prints it."""
        return self.tables["markdown"]

    def to_latex(self) -> str:
        """The same as a `tabular` of LaTeX, which needs no package."""
        return self.tables["latex"]

    def to_csv(self) -> str:
        """The same as comma-separated values."""
        return self.tables["csv"]

    def to_pandas(self) -> Any:
        """As a pandas.DataFrame, one row per variant, whose index is the label. Raises ImportError where pandas is not
        installed."""
        pandas = needed("pandas", "to_pandas", "apt install python3-pandas")
        rows = []
        for variant in self.variants:
            row = {name: value for name, value in vars(variant).items() if name not in ("errors", "result", "notes")}
            for quantity, (l2, l1) in variant.errors.items():
                row.update({f"l2_{quantity}": l2, f"l1_{quantity}": l1})
            rows.append(row)
        return pandas.DataFrame(rows).set_index("label")

    def __repr__(self) -> str:
        """The recommendation."""
        return f"<carom.Comparison of {len(self.variants)}: {self.headline}>"

    def _repr_html_(self) -> str:
        """For notebooks: the recommendation, and the variants with error, claim, cost and verdict."""
        def text(value: float) -> str:
            return "" if math.isnan(value) else f"{value:.4g}"

        rows = [(v.label, text(v.errors.get(self.quantity, (math.nan,))[0]), text(v.claimed_error), text(v.energy_kept),
                 text(v.cpu_seconds), v.status) for v in self.variants]
        against = "the exact solution" if self.reference is None else self.reference.label
        head = ("variant", f"error of the {self.quantity}", "claimed", "energy kept", "CPU s", "verdict")
        return _html.page(_html.banner("recommended" if self.recommended else "none recommended", "", self.headline),
                          _html.listed(self.reasons), _html.table(head, rows), f"<p>Against: {escape(against)}</p>")


def compare(case: Case | str | os.PathLike[str], *, scheme: str | Sequence[str] = (),
            enforcement: str | Sequence[str] = (), stiffness: float | str | Sequence[float | str] = (),
            cells: int | Sequence[int] = (), courant: float | Sequence[float] = (), refine: int | Sequence[int] = (),
            reference: str = "", folder: str | os.PathLike[str] | None = None, jobs: int = 0,
            progress: Callable[[int, int, str], object] | None = None) -> Comparison:
    """Runs every combination of the choices side by side and says which to take, as `carom compare` does.

    case: a Case or the file of one. scheme, enforcement: names, with keys where wanted ("newmark:beta=0.28");
    stiffness: of every contact; cells: along the longest edge of each block; courant: steps over shortest cell / fastest
    wave; refine: how often every cell is cut in halves. Without values a choice is that of the case. reference: text in
    the name of the run that the others are compared with, "": chosen. folder: keeps the runs, compare.csv, compare.json
    and compare.html; None: nothing is kept but what is returned. jobs: runs at a time, 0 for all cores; each is a
    process of its own on one core. progress(done, all, label): called after each.

    Raises CaseError where the case is wrong or no combination is allowed, ValueError for cases with functions that are
    Python's, and OutputError. Ctrl-C ends the runs.
    """
    given = _case_of(case)
    choices = _Choices(_list(scheme, str), _list(enforcement, str), _list(stiffness, str), _list(cells, int),
                       _list(courant, float), _list(refine, int))
    is_right = (all(n >= 1 for n in choices.cells), all(c > 0.0 for c in choices.courants),
                all(0 <= r <= 6 for r in choices.refinements))
    if not all(is_right):
        raise ValueError("cells are numbers from 1 on, courant numbers > 0, refine numbers from 0 to 6")
    if folder is not None:
        return _compared(given, choices, reference, pathlib.Path(folder), jobs, progress, is_kept=True)
    with tempfile.TemporaryDirectory(prefix="carom_compare_") as scratch:
        return _compared(given, choices, reference, pathlib.Path(scratch), jobs, progress, is_kept=False)


class _Choices(NamedTuple):
    """Values to be combined."""

    schemes: list[str]
    enforcements: list[str]
    stiffnesses: list[str]
    cells: list[int]
    courants: list[float]
    refinements: list[int]


def _compared(case: Case, choices: _Choices, reference: str, folder: pathlib.Path, jobs: int,
              progress: Callable[[int, int, str], object] | None, is_kept: bool) -> Comparison:
    mesh_file = folder / "case.mesh.msh"
    tree, functions, frictions = case._plain(str(mesh_file.resolve()))
    if functions or frictions:
        raise ValueError(f"{', '.join([*functions, *frictions])}: functions of time and laws of friction that are Python's "
                         "cannot be had by the processes that run the variants; write a table, or a number")
    if case._mesh_text is not None:
        folder.mkdir(parents=True, exist_ok=True)
        mesh_file.write_text(case._mesh_text, encoding="utf-8")
    home = str(pathlib.Path(__file__).resolve().parent.parent)
    program = [sys.executable, "-c", f"import sys; sys.path.insert(0, {home!r}); from carom._variant import main; main()"]
    text, tables = _carom.compare(tree, case._source, case.file, *choices, reference, program, str(folder),
                                  whole("jobs", jobs, "a number of processes, or 0 for all cores,"), progress)
    found = json.loads(text)
    variants = {v["name"]: _variant(v, folder / "variants" / v["name"], is_kept) for v in found["variants"]}
    advice = found["recommendation"]
    reasons = [reason.replace("--", "") for reason in advice["reasons"]]  # options of the command are arguments here
    return Comparison(list(variants.values()), variants.get(advice["variant"]), advice["headline"], reasons,
                      found["ranked_by"], variants.get(found["reference_run"]), found["orders"],
                      str(folder) if is_kept else "", tables)


def _variant(found: dict[str, Any], folder: pathlib.Path, is_kept: bool) -> Variant:
    def number(key: str) -> float:
        value = found.get(key)
        return math.nan if value is None else float(value)

    result = None
    if "steps" in found:
        result = read_results(folder)
        if not is_kept:
            result.folder = ""
    errors = {quantity: tuple(math.nan if of[kind] is None else of[kind] for kind in ("l2", "l1"))
              for quantity, of in found.get("errors", {}).items()}
    return Variant(found["name"], found["label"], found["scheme"], found["enforcement"], found["stiffness"],
                   found["cells"], found["status"], found["notes"], result, errors,  # type: ignore[arg-type]
                   number("claimed_error"), number("peak_force"), number("energy_kept"), number("penetration"),
                   number("courant"), number("step"), found.get("steps", 0), number("cpu_seconds"))


def _case_of(case: Case | str | os.PathLike[str]) -> Case:
    return case if isinstance(case, Case) else load(case)


def _list(values: Any, kind: Callable[[Any], _Value]) -> list[_Value]:
    """One value or several."""
    return [kind(x) for x in ([values] if isinstance(values, (str, int, float)) else values)]
