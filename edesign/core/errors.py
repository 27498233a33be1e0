"""Errors of the numerical core with its own words and status."""

from __future__ import annotations

from edesign.core._edcore import ffi, lib
from edesign.errors import AnalysisError


class CoreError(AnalysisError):
    """The core refused a model or could not go on.

    Attributes:
        status: name of the status, for instance "ED_E_MECHANISM".
    """

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


def status_name(status: int) -> str:
    """Return the name of a status of the core."""
    return str(ffi.string(lib.ed_status_name(status)).decode(errors="replace"))
