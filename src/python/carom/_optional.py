"""Packages that some methods need and most scripts do without."""

from __future__ import annotations

import importlib
from typing import Any


def needed(module: str, wants: str, install: str) -> Any:
    """The module; ImportError that says who wants it and how to install it where it is not there."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{wants} needs {module}, which is not installed ({install})") from error
