"""Other programs, built and run on the same structures, against which edesign is verified and timed."""

from __future__ import annotations

import ctypes
import importlib.util
import sys
from pathlib import Path


def _offer_blas() -> None:
    """Load the BLAS that comes with OpenSeesPy.

    Its LAPACK asks for `libblas.so.3` without saying where it lies, so that `import openseespy` fails on a machine that
    has no BLAS of its own. A library that is loaded already is found by its name.
    """
    package = importlib.util.find_spec("openseespylinux") if sys.platform == "linux" else None
    for folder in package.submodule_search_locations or () if package is not None else ():
        for blas in Path(folder, "lib").glob("libblas.so.3"):
            ctypes.CDLL(str(blas), mode=ctypes.RTLD_GLOBAL)


_offer_blas()
