"""What a run has come to."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np

from carom import _carom, _html
from carom._arguments import whole
from carom.curves import Curves
from carom.fields import Frames, read_frames


class Result:
    """What `Run.finish` and `Run.stop` give; knows nothing of the run any more."""

    verdict: str
    """"good": all checks and items of the verdict passed; "failed": one did not; "stopped": before the end; "error"."""
    message: str
    """One sentence about it."""
    contact: Curves
    """Contacts, as contact.csv: "floor.force_z"."""
    probes: Curves
    """Probes, as probes.csv: "top.displacement_z"."""
    history: Curves
    """Both in one."""
    energy: Curves
    """The ledger, as energy.csv: "kinetic", "strain", "imbalance", "momentum_x", ..."""
    parts: Curves
    """Energies and momentum of every part, as parts.csv: "glass.kinetic_energy", "glass.momentum_z"."""
    exact: Curves
    """The exact solution, where the case has [exact]; else empty."""
    summary: dict[str, Any]
    """All of summary.json (docs/results.md)."""
    folder: str
    """The results folder, "" where there is none."""

    def __init__(self, summary: str, contact: Curves, probes: Curves, energy: Curves, parts: Curves, exact: Curves,
                 folder: str) -> None:
        """summary: the text of summary.json."""
        self._summary_text, self.summary = summary, json.loads(summary)
        self.verdict, self.message = self.summary["outcome"], self.summary["message"]
        self.contact, self.probes, self.history = contact, probes, _joined([contact, probes])
        self.energy, self.parts, self.exact, self.folder = energy, parts, exact, folder

    @property
    def frames(self) -> Frames:
        """The fields that the run has written into its folder. Raises FileNotFoundError where there are none."""
        if not self.folder:
            raise FileNotFoundError("this run had no folder; Run.record keeps fields in memory")
        return read_frames(self.folder)

    @property
    def items(self) -> list[dict[str, Any]]:
        """Items of the verdict: name, value, limit, pass, explanation."""
        return self.summary["verdict"]

    @property
    def checks(self) -> list[dict[str, Any]]:
        """The [[check]] entries of the case: name, time, value, reference, difference, pass, ..."""
        return self.summary["checks"]

    @property
    def warnings(self) -> list[str]:
        """What is doubtful about the case and the run."""
        return self.summary["warnings"]

    @property
    def notes(self) -> list[str]:
        """What was chosen or mended."""
        return self.summary["notes"]

    @property
    def figures(self) -> list[tuple[str, str, str]]:
        """The key figures of the report: title, value with its unit, remark."""
        found = _carom.key_figures(self._summary_text, self.energy._table, self.contact._table, self.probes._table)
        return [(title, value, remark) for title, value, remark in found]

    def to_markdown(self) -> str:
        """Key figures, checks, largest values of contacts, probes and parts, and energies at the end as tables in Markdown,
        as `carom report --format markdown` prints them. Filtered curves are known where there is a folder."""
        return self._tables("markdown")

    def to_latex(self) -> str:
        """The same tables as `tabular`s of LaTeX, which need no package."""
        return self._tables("latex")

    def to_csv(self) -> str:
        """The same tables as comma-separated values, with empty lines between."""
        return self._tables("csv")

    def _tables(self, form: str) -> str:
        of_run = [curves._table for curves in (self.energy, self.contact, self.probes, self.parts)]
        return _carom.tables(self.folder, self._summary_text, of_run, form)

    def view(self, height: int = 640, most_bytes: int = 4_000_000) -> View:
        """The bodies in motion, for a notebook: the view of the report as a page of its own in a frame, which needs no
        network. height: of the frame, in pixels; most_bytes: what the page may take, libraries included.

        Raises FileNotFoundError where the run has had no folder, and RuntimeError where that has no frames."""
        if not self.folder:
            raise FileNotFoundError("the view is made of the frames in a results folder, and this run had none: "
                                    'case.start("out")')
        return View(_carom.view_page(self.folder, whole("most_bytes", most_bytes, "a number of bytes")), height)

    def __repr__(self) -> str:
        """Verdict and message."""
        return f"<carom.Result: {self.verdict}: {self.message}>"

    def _repr_html_(self) -> str:
        """For notebooks: verdict, what did not pass, key figures, contact forces and energies."""
        failed = [f"{item['name']}: {item['value']:.3g}, and the limit is {item['limit']:.3g} ({item['explanation']})"
                  for item in self.items if not item["pass"]]
        failed += [f"check {check['name']}: {check['value']:.6g}, reference {check['reference']:.6g}"
                   for check in self.checks if not check["pass"] and check["value"] is not None]
        return _html.page(_html.banner(self.verdict, self.summary["case"]["title"], self.message), _html.listed(failed),
                          _html.figures(self.figures), _pictures(self.contact, self.energy),
                          _html.folded(f"{len(self.warnings)} warnings", self.warnings),
                          _html.folded(f"{len(self.notes)} notes", self.notes))


class View:
    """A page with the bodies in motion; a notebook shows it in a frame."""

    html: str
    """The page, which can be written to a file."""

    def __init__(self, html: str, height: int) -> None:
        """Made by Result.view."""
        self.html, self._height = html, height

    def _repr_html_(self) -> str:
        """The frame."""
        return _html.frame(self.html, self._height)


def _pictures(contact: Curves, energy: Curves) -> str:
    """Sizes of the contact forces, and the energies that are not nothing."""
    def unit(of: Curves, name: str) -> str:
        return of.unit(name) if name in of else ""

    forces = {name[:-len(".force_x")]: np.sqrt(sum(contact[name[:-1] + axis]**2 for axis in "xyz"))
              for name in contact if name.endswith(".force_x")}
    terms = ("kinetic", "strain", "contact_stored", "plastic", "friction", "external_work", "support_work")
    energies = {name.replace("_", " "): energy[name] for name in terms if name in energy}
    largest = max((np.abs(y).max(initial=0.0) for y in energies.values()), default=0.0)
    energies = {name: y for name, y in energies.items() if np.abs(y).max(initial=0.0) > 1e-9 * largest}
    if "time" not in energy:
        return ""
    first = next((name for name in contact if name.endswith(".force_x")), "")
    time_unit = unit(energy, "time")
    return (_html.chart("Contact forces", unit(contact, first), contact["time"], time_unit, forces) if forces else "") + \
        _html.chart("Energies", unit(energy, "kinetic"), energy["time"], time_unit, energies)


def read_results(folder: str | os.PathLike[str]) -> Result:
    """The result of a run that has ended, from its folder. Raises FileNotFoundError where it has no summary.json: then the
    run is going on, or has been broken off."""
    folder = os.fspath(folder)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as summary:
        contact, probes, energy, parts, exact = (Curves(*_carom.read_table(os.path.join(folder, f"{name}.csv")))
                                                 for name in ("contact", "probes", "energy", "parts", "exact"))
        return Result(summary.read(), contact, probes, energy, parts, exact, folder)


def _joined(tables: list[Curves]) -> Curves:
    """Tables, of which some may be empty, as one, whose first column is the time."""
    columns: list[str] = []
    rows, units = [], ""
    for table in tables:
        names, values = table._table
        if names:
            rows.append(values[:, 1:] if columns else values)
            columns += names[1:] if columns else names
            units = table._units
    return Curves(columns, np.hstack(rows) if rows else None, units)
