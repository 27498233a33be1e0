"""A function of many things, here and in forked processes: predictions of short tests hold the interpreter's lock for
most of their time, so that threads would wait for each other.
"""

from __future__ import annotations

import io
import os
import pickle
import signal
import time
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from multiprocessing import get_all_start_methods, get_context
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from threadpoolctl import ThreadpoolController

T = TypeVar("T")
S = TypeVar("S")

_NUMBER = 4  # bytes
_WORTH = 6.0  # times what a process costs that does nothing, of work for which one is begun

_busy = False  # items are at work: functions of an item that come here have this process alone


def side_by_side(function: Callable[[T], S], items: Iterable[T], workers: int, known: Sequence[object] = ()) -> list[S]:
    """The function of each item, in their order.

    Args:
        function: any; a process has what this one had at its call, and what it changes there is lost.
        items: its arguments.
        workers: processes, this one among them.
        known: what results refer to and is not copied into them.
    """
    global _busy
    given = list(items)
    if _busy or workers < 2 or len(given) < 2 or "fork" not in get_all_start_methods():
        return [function(item) for item in given]
    queue = _queue(len(given))
    by_id = {id(thing): thing for thing in known}
    others: list[tuple[Any, Connection]] = []
    _busy = True
    try:
        with _blas().limit(limits=1, user_api="blas"):
            others = [_beside(function, given, queue, by_id) for _ in range(min(workers, len(given)) - 1)]
            found = _work(function, given, queue)
            for _, end in others:
                found |= _received(end, by_id)
    finally:
        _busy = False
        os.close(queue)
        for process, end in others:
            process.kill()
            process.join()
            end.close()
    results = []
    for index, item in enumerate(given):
        if index not in found:  # a process was killed, for want of memory, say
            found[index] = function(item), None
        result, error = found[index]
        if error is not None:
            raise error
        results.append(result)
    return results


def brief_side_by_side(function: Callable[[T], S], items: Iterable[T], workers: int) -> list[S]:
    """The same of items that take about as long as each other: if that is short, it is all done here."""
    given = list(items)
    if _busy or workers < 2:
        return [function(item) for item in given]
    begun = time.perf_counter()
    first = [function(item) for item in given[:1]]
    left = (time.perf_counter() - begun) * (len(given) - 1)
    return first + side_by_side(function, given[1:], workers if left > _WORTH * _cost() else 1)


@cache
def _cost() -> float:
    """Of a process that does nothing, s: a few ms, or tens of them on a virtual machine."""
    begun = time.perf_counter()
    side_by_side(lambda _: None, range(2), 2)
    return time.perf_counter() - begun


_Found = dict[int, tuple[Any, Exception | None]]
"""Result or error of each item."""


@cache
def _blas() -> ThreadpoolController:
    return ThreadpoolController()


def _queue(n: int) -> int:
    """The end of a pipe from which processes read which item is next; it holds some ten thousand."""
    end, begin = os.pipe()
    os.write(begin, b"".join(index.to_bytes(_NUMBER, "little") for index in range(n)))
    os.close(begin)
    return end


def _work(function: Callable[[Any], Any], items: Sequence[Any], queue: int) -> _Found:
    found: _Found = {}
    while number := os.read(queue, _NUMBER):
        index = int.from_bytes(number, "little")
        try:
            found[index] = function(items[index]), None
        except Exception as error:  # is raised where the work was asked for
            found[index] = None, error
            break
    return found


def _beside(
    function: Callable[[Any], Any], items: Sequence[Any], queue: int, known: Mapping[int, object]
) -> tuple[Any, Connection]:
    """A process that works on the items, and where its results come from."""
    fork = get_context("fork")
    here, there = fork.Pipe(duplex=False)

    def run() -> None:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # the parent says what is to be said
        data = io.BytesIO()
        _Pickler(data, known).dump(_work(function, items, queue))
        there.send_bytes(data.getvalue())

    process = fork.Process(target=run, daemon=True)
    with warnings.catch_warnings():
        # Python 3.12 warns of threads beside a fork: those of the BLAS, which knows of forks
        warnings.simplefilter("ignore", DeprecationWarning)
        process.start()
    there.close()
    return process, here


def _received(end: Connection, known: Mapping[int, object]) -> _Found:
    try:
        data = end.recv_bytes()
    except EOFError:
        return {}
    found: _Found = _Unpickler(io.BytesIO(data), known).load()
    return found


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
