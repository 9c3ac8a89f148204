"""The errors of Carom. All derive from `carom.Error`."""

from __future__ import annotations


class Error(Exception):
    """Base of all errors of Carom."""


class CaseError(Error):
    """The case or its mesh is wrong; raised before anything is run.

    str() is the whole message: place, key, what was found, what was expected, how to mend it.
    """

    file: str = ""
    """File that the user wrote, or the name of a case that was made in Python."""
    line: int = 0
    """Line in it, from 1; 0 where it is not known, or the value was set in Python."""
    column: int = 0
    """Column, from 1; 0 as for line."""
    key: str = ""
    """Dotted path of the key, such as `materials.steel.E`."""
    found: str = ""
    """What stands there."""
    expected: str = ""
    """What should."""
    suggestion: str = ""
    """How to mend it, or ''."""


class RunError(Error):
    """The run cannot go on; `finish` or `stop` closes it, `restore` takes it back to where it could."""

    step: int = 0
    """Number of the last step that was made."""
    time: float = 0.0
    """Time reached, in the case's unit."""


class OutputError(Error):
    """Results could not be written."""

    path: str = ""
    """The file or folder."""


class CheckpointError(Error):
    """A checkpoint or snapshot cannot be gone on from; the message says why."""
