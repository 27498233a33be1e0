"""How long calls of the core end early: they ask now and then, in the thread that called them."""

from __future__ import annotations

import threading
from types import TracebackType
from typing import Any

from edesign.core._edcore import ffi, lib
from edesign.stopping import Stopped, stop_requested


class _Raised(threading.local):
    """What was raised in this thread while the core asked, such as Ctrl-C by the handler of its signal."""

    error: BaseException | None = None


_raised = _Raised()


def _keep(kind: type[BaseException], error: BaseException, traceback: TracebackType) -> None:
    _raised.error = error


# Python runs the handlers of signals only between steps of its own code. This is one, and so Ctrl-C during a long call
# is seen here; as any error that the question brings, it ends the call and is raised behind it.
@ffi.def_extern(error=1, onerror=_keep)
def edesign_stop_asked(data: Any) -> int:
    """Answer the core whether its call shall end.

    Args:
        data: not used.
    """
    return stop_requested()


STOP = ffi.new("ed_stop *", (lib.edesign_stop_asked, ffi.NULL))
"""Whom calls of the core ask."""


def raise_if_stopped(status: int) -> None:
    """Raise what ended a call of the core early.

    Args:
        status: that the call returned.

    Raises:
        KeyboardInterrupt: by Ctrl-C; `Stopped` by a request of `edesign.stopping.stoppable`.
    """
    error = _raised.error
    if error is not None:
        _raised.error = None
        raise error
    if status == lib.ED_E_STOPPED:
        raise Stopped
