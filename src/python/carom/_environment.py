"""What numerical libraries read from the environment while they load (src/linalg/process_environment.hpp)."""

from __future__ import annotations

import contextlib
import os
import warnings
from typing import Iterator


def _deserved_kernels() -> str | None:
    """Value of OPENBLAS_CORETYPE that this processor deserves; OpenBLAS 0.3.21 takes new ones for old."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            flags = set(next((line for line in file if line.startswith("flags")), "").split())
    except OSError:
        return None
    if {"avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512cd"} <= flags:
        return "SKYLAKEX"
    return "HASWELL" if {"avx2", "fma"} <= flags else None


@contextlib.contextmanager
def prepared() -> Iterator[None]:
    """The environment that the command line gives itself, while the extension is loaded. What is set stays."""
    wanted = {}
    if "GOMP_SPINCOUNT" not in os.environ and "OMP_WAIT_POLICY" not in os.environ:
        wanted["GOMP_SPINCOUNT"] = "1000"
    if "OPENBLAS_CORETYPE" not in os.environ and (kernels := _deserved_kernels()):
        wanted["OPENBLAS_CORETYPE"] = kernels
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name in wanted:
            del os.environ[name]


def warn_of_kernels() -> None:
    """Says so where another module has made OpenBLAS choose kernels that the command line would not."""
    from carom import _carom
    loaded, better = _carom.blas_kernels()
    if better and _deserved_kernels() == better:
        warnings.warn(f"OpenBLAS was loaded before carom and has chosen its kernels for {loaded}: implicit runs are "
                      f"slower, and their last digits may differ from the command line's. Import carom before numpy, "
                      f"or set OPENBLAS_CORETYPE={better}.", RuntimeWarning, stacklevel=3)
