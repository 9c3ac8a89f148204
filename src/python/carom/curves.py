"""Curves of a run, and contact at an instant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom import _carom
from carom._arguments import unknown
from carom._optional import needed


class Curves(Mapping[str, NDArray[np.float64]]):
    """Columns of numbers over time, by name: `curves["time"]`, `curves["top.displacement_z"]`.

    A mapping from names to arrays of one length, in the case's units. The arrays are copies: they stay as they are.
    """

    def __init__(self, columns: list[str], rows: NDArray[np.float64] | None, units: str = "") -> None:
        """columns: the names; rows: (steps, columns), None where there are none; units: the comment of tables that names
        them."""
        self._at = {name: i for i, name in enumerate(columns)}
        self._rows, self._units = np.empty((0, len(columns))) if rows is None else rows, units

    @property
    def _table(self) -> tuple[list[str], NDArray[np.float64]]:
        return list(self._at), self._rows

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """The column of this name. Raises KeyError, which lists the names there are."""
        if name not in self._at:
            raise unknown("column", name, self._at)
        return self._rows[:, self._at[name]]

    def unit(self, name: str) -> str:
        """The unit of a column, "" where it has none. Raises KeyError."""
        self[name]
        return _carom.unit_of_column(name, self._units)

    def to_pandas(self) -> Any:
        """As a pandas.DataFrame whose index is the time (where the first column is that); `attrs["units"]` has the units
        of the columns. Raises ImportError where pandas is not installed."""
        pandas = needed("pandas", "to_pandas", "apt install python3-pandas")
        frame = pandas.DataFrame(self._rows.copy(), columns=list(self._at))
        frame.attrs["units"] = {name: self.unit(name) for name in self}
        return frame.set_index("time") if "time" in self._at else frame

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter(self._at)

    def __len__(self) -> int:
        """The number of columns."""
        return len(self._at)

    def __contains__(self, name: object) -> bool:
        """Is there a column of this name?"""
        return name in self._at

    def __repr__(self) -> str:
        """The names, and the number of rows."""
        return f"<carom.Curves: {len(self._rows)} rows of {', '.join(self._at)}>"


@dataclass(frozen=True)
class ContactState:
    """One contact at the end of the last step, as contact.csv says it; None where that says nothing of it."""

    force: NDArray[np.float64] | None = None
    """Resultant force on the body of the contact's group, x, y, z."""
    impulse: NDArray[np.float64] | None = None
    """Its integral over time."""
    moment: NDArray[np.float64] | None = None
    """Moment about the contact's moment_point, or else about the centre of an obstacle with an imposed rotation."""
    penetration: float | None = None
    """Largest penetration of closed rows."""
    closed: int | None = None
    """Number of closed rows."""
    closings: int | None = None
    """How often the contact went from open everywhere to closed somewhere."""
    displacement: NDArray[np.float64] | None = None
    """Displacement of the obstacle's centre, if it moves."""
    velocity: NDArray[np.float64] | None = None
    """Velocity of it."""
    angular_velocity: NDArray[np.float64] | None = None
    """Angular velocity of an obstacle that turns."""


_VECTORS = ("force", "impulse", "moment", "displacement", "velocity", "angular_velocity")


def contact_states(columns: list[str], row: NDArray[np.float64]) -> dict[str, ContactState]:
    """The contacts of a row of contact.csv by name (of self-contact also `<contact>.<part>_on_<part>`)."""
    values: dict[str, dict[str, float]] = {}
    for column, value in zip(columns[1:], row[1:]):
        name, _, quantity = column.rpartition(".")
        values.setdefault(name, {})[quantity] = float(value)
    states = {}
    for name, of in values.items():
        given: dict[str, object] = {vector: np.array([of[f"{vector}_{axis}"] for axis in "xyz"])
                                    for vector in _VECTORS if f"{vector}_x" in of}
        if "closed" in of:
            given.update(penetration=of["penetration"], closed=int(of["closed"]), closings=int(of["closings"]))
        states[name] = ContactState(**given)  # type: ignore[arg-type]
    return states
