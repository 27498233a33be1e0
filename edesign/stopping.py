"""Requests to stop, which work asks for while it goes on, also in other threads than the one that makes the request."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from types import FrameType
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")
StopRequest = Callable[[], bool]


class Stopped(KeyboardInterrupt):
    """A call ended early because a request of `stoppable` had become true; like Ctrl-C it is no error."""


class _Requests(threading.local):
    """Of one thread."""

    stop: StopRequest | None = None


_requests = _Requests()


@contextmanager
def stoppable(stop: StopRequest | None) -> Iterator[None]:
    """Let long calls of the core in this thread end with `Stopped` once a request is true.

    Args:
        stop: asked about five times a second, by such calls only; those of outer contexts count too. None: no request.
    """
    outer = _requests.stop
    if stop is not None:
        own = stop
        _requests.stop = own if outer is None else lambda: own() or outer()
    try:
        yield
    finally:
        _requests.stop = outer


def stop_requested() -> bool:
    """Say whether the thread is to stop.

    Returns:
        True if a request of this thread is true.
    """
    return _requests.stop is not None and _requests.stop()


def stop_if_requested() -> None:
    """Let long work in Python end as calls of the core do.

    Raises:
        Stopped: a request of this thread is true.
    """
    if stop_requested():
        raise Stopped


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold Ctrl-C back until the context ends, where an exception at any place would break what is called.

    HDF5 calls Python back for its file: an exception in there leaves the library in no state that it knows, and so does
    the end of the process while another thread is in it.
    """
    if threading.current_thread() is not threading.main_thread():
        with _whole:
            yield
        return
    before = signal.getsignal(signal.SIGINT)
    asked = False

    def hold(number: int, frame: FrameType | None) -> None:
        nonlocal asked
        asked = True

    if before not in (None, signal.SIG_IGN):
        signal.signal(signal.SIGINT, hold)
    try:
        yield
    finally:
        if before not in (None, signal.SIG_IGN):
            signal.signal(signal.SIGINT, before)
        if asked:
            signal.raise_signal(signal.SIGINT)


def end_uninterrupted() -> None:
    """Wait until no other thread is within `uninterrupted`, and let none begin it again: the process ends."""
    _whole.acquire()


_whole = threading.RLock()


def in_threads(
    work: Callable[[T], R], items: Iterable[T], workers: int, closing: threading.Event | None = None
) -> Iterator[R]:
    """Yield results in the order of the items, as soon as they and those before them are ready.

    An error or Ctrl-C, or a caller that wants no more results, ends what runs and leaves out what has not begun. The
    requests of the thread that calls count in the others.

    Args:
        items: to work on.
        workers: threads; with one the work is done in that of the caller.
        closing: is set when what runs shall end, for work that asks for it; made here if None.
    """
    if workers <= 1:
        yield from map(work, items)
        return
    closing = threading.Event() if closing is None else closing
    stop, closed = _requests.stop, closing.is_set

    def run(item: T) -> R:
        with stoppable(stop), stoppable(closed):
            return work(item)

    with ThreadPoolExecutor(workers) as pool:
        try:
            yield from pool.map(run, items)
        except BaseException:
            closing.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
