"""Other programs, built and run on the same structures, against which edesign is verified and timed."""

from __future__ import annotations

import ctypes
import importlib.util
import sys
from pathlib import Path


def _own_blas() -> Path | None:
    """Return the BLAS that comes with OpenSeesPy, on machines that have none of their own.

    Its LAPACK asks for `libblas.so.3` without saying where it lies, so that `import openseespy` fails there. A library
    that is loaded already is found by its name.
    """
    package = importlib.util.find_spec("openseespylinux") if sys.platform == "linux" else None
    try:
        ctypes.CDLL("libblas.so.3")
    except OSError:
        folders = package.submodule_search_locations or () if package is not None else ()
        return next((blas for folder in folders for blas in Path(folder, "lib").glob("libblas.so.3")), None)
    return None


_BLAS = _own_blas()
LOADED_FIRST = {} if _BLAS is None else {"LD_PRELOAD": str(_BLAS)}
"""Environment of processes that import OpenSeesPy without this package."""
if _BLAS is not None:
    ctypes.CDLL(str(_BLAS), mode=ctypes.RTLD_GLOBAL)
