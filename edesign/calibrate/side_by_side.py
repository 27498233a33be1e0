"""A function of many things in forked processes: predictions of short tests hold the interpreter's lock for most of
their time, so that threads would wait for each other.
"""

from __future__ import annotations

import io
import pickle
import signal
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_all_start_methods, get_context
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

T = TypeVar("T")
S = TypeVar("S")

_job: tuple[Callable[[Any], Any], Sequence[Any], Mapping[int, object]]
"""Function, items, and what need not be sent back, in a forked process."""


def side_by_side(function: Callable[[T], S], items: Iterable[T], workers: int, known: Sequence[object] = ()) -> list[S]:
    """The function of each item, in their order.

    Args:
        function: any; a process has what this one had at its call, and what it changes there is lost.
        items: its arguments.
        workers: processes.
        known: what results refer to and is not copied into them.
    """
    given = list(items)
    if workers < 2 or len(given) < 2 or "fork" not in get_all_start_methods():
        return [function(item) for item in given]
    by_id = {id(thing): thing for thing in known}
    with warnings.catch_warnings():
        # Python 3.12 warns of threads beside a fork: those of the BLAS, which knows of forks
        warnings.simplefilter("ignore", DeprecationWarning)
        try:
            with ProcessPoolExecutor(
                min(workers, len(given)),
                mp_context=get_context("fork"),
                initializer=_begin,
                initargs=(function, given, by_id),
            ) as pool:
                return [_Unpickler(io.BytesIO(found), by_id).load() for found in pool.map(_result, range(len(given)))]
        except BrokenProcessPool:  # a process was killed, for want of memory, say
            return [function(item) for item in given]


def _begin(function: Callable[[Any], Any], items: Sequence[Any], known: Mapping[int, object]) -> None:
    global _job
    _job = (function, items, known)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # the parent says what is to be said
    threadpool_limits(limits=1, user_api="blas")


def _result(index: int) -> bytes:
    function, items, known = _job
    data = io.BytesIO()
    _Pickler(data, known).dump(function(items[index]))
    return data.getvalue()


class _Pickler(pickle.Pickler):
    """Known things by their place in memory, which a fork keeps."""

    def __init__(self, data: io.BytesIO, known: Mapping[int, object]) -> None:
        super().__init__(data, protocol=pickle.HIGHEST_PROTOCOL)
        self.known = known

    def persistent_id(self, thing: object) -> int | None:
        return id(thing) if id(thing) in self.known else None


class _Unpickler(pickle.Unpickler):
    def __init__(self, data: io.BytesIO, known: Mapping[int, object]) -> None:
        super().__init__(data)
        self.known = known

    def persistent_load(self, place: int) -> object:
        return self.known[place]
