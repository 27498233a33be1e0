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
        super().__init__(with_code(getattr(lib, status), message))
        self.status = status


def with_code(status: int, message: str) -> str:
    """Return a message of the core with the code that its status has in docs/reference/messages/core.md."""
    return f"{message} [E-CORE-{abs(status):02d}]"


def status_name(status: int) -> str:
    """Return the name of a status of the core."""
    return str(ffi.string(lib.ed_status_name(status)).decode(errors="replace"))
