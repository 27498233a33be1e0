"""Ctrl-C and SIGTERM as a request to stop, which the work asks for at good moments."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def stop_on_signals(
    stop: threading.Event | None = None, critical: Callable[[], bool] = lambda: False
) -> Iterator[threading.Event]:
    """Let the first Ctrl-C (or SIGTERM) set an event, and a second one raise KeyboardInterrupt.

    Args:
        stop: the event; made here if None.
        critical: True holds the second one back, as while an archive is written.
    """
    stop = threading.Event() if stop is None else stop
    if threading.current_thread() is not threading.main_thread():
        yield stop
        return

    def handle(number: int, frame: FrameType | None) -> None:
        if stop.is_set() and not critical():
            raise KeyboardInterrupt
        stop.set()

    previous = {number: signal.signal(number, handle) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stop
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
