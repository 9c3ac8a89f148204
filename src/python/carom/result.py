"""What a run has come to."""

from __future__ import annotations

import json
from typing import Any

from carom.curves import Curves


class Result:
    """What `Run.finish` and `Run.stop` give; knows nothing of the run any more."""

    verdict: str
    """"good": all checks and items of the verdict passed; "failed": one did not; "stopped": before the end; "error"."""
    message: str
    """One sentence about it."""
    history: Curves
    """Probes and contacts, as probes.csv and contact.csv: "top.displacement_z", "floor.force_z"."""
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

    def __init__(
        self, summary: str, history: Curves, energy: Curves, parts: Curves, exact: Curves, folder: str
    ) -> None:
        """summary: the text of summary.json."""
        self.summary = json.loads(summary)
        self.verdict, self.message = _outcome(self.summary)
        self.history, self.energy, self.parts, self.exact, self.folder = history, energy, parts, exact, folder

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

    def __repr__(self) -> str:
        """Verdict and message."""
        return f"<carom.Result: {self.verdict}: {self.message}>"


def _outcome(summary: dict[str, Any]) -> tuple[str, str]:
    return summary["outcome"], summary["message"]
