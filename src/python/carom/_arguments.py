"""What is said of arguments that are of no use."""

from __future__ import annotations

import difflib
import operator
from collections.abc import Iterable
from typing import Any, TypeVar

_Value = TypeVar("_Value")


def whole(name: str, value: Any, wanted: str) -> int:
    """The whole number; TypeError that says what is wanted where it is none."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: {value!r}, and {wanted} is wanted") from None


def number(name: str, value: Any, wanted: str) -> float:
    """The number; TypeError that says what is wanted where it is none."""
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{name}: {value!r}, and {wanted} is wanted")


def unknown(what: str, name: object, known: Iterable[str], remedy: str = "") -> KeyError:
    """An error with the names that there are, and the one that was meant by its looks."""
    names = list(known)
    near = difflib.get_close_matches(str(name), names, n=1)
    meant = f"; did you mean {near[0]!r}?" if near else ""
    return KeyError(f"there is no {what} {name!r}; there are {', '.join(names) or 'none'}{meant}{remedy}")


class Named(dict[str, _Value]):
    """Things by name, which says what there is where a name is wrong."""

    def __init__(self, what: str, things: dict[str, _Value]) -> None:
        """what: they are, in an error: "contact"."""
        super().__init__(things)
        self._what = what

    def __missing__(self, name: str) -> _Value:
        """KeyError that lists the names."""
        raise unknown(self._what, name, self)
