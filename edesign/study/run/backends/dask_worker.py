"""What runs in the processes of dask workers."""

from __future__ import annotations

import logging
import pickle
import time
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from distributed import Worker, WorkerPlugin, get_worker

from edesign.errors import InputError
from edesign.study.run.backends.call import Call, Result, internal_error, log, perform
from edesign.study.run.backends.state import program_state, refusal

REPORT_EVERY = 0.5  # s, between reports of one call

Packed = bytes | int  # a pickle, or the number of one that all workers hold


class Share(WorkerPlugin):  # type: ignore[misc, unused-ignore]
    """The functions and arguments that calls share, sent once to each worker; taking it away stops the calls.

    Attributes:
        name: of this share, unique.
        state: of the program that wants the results.
        pickles: the arguments that several calls have.
        level: of edesign's log, so that a worker reports as much as the client would.
    """

    def __init__(self, name: str, state: Mapping[str, str], pickles: list[bytes]) -> None:
        self.name = name
        self.state = state
        self.pickles = pickles
        self.level = log.getEffectiveLevel()

    def setup(self, worker: Worker) -> None:
        """Prepare a worker; dask calls it there."""
        log.setLevel(self.level)
        logging.captureWarnings(True)  # this process has the terminal of the one that wants the results


class _RemoteControl:
    """Progress to the client through the scheduler, and the request to stop."""

    def __init__(self, share: str, key: str) -> None:
        self._worker = get_worker()
        self._share = share
        self._reported = time.monotonic()
        self._worker.log_event(share, [key, 0, 0])

    def progress(self, key: str, done: int, total: int) -> None:
        now = time.monotonic()
        if now - self._reported >= REPORT_EVERY:
            self._reported = now
            self._worker.log_event(self._share, [key, int(done), int(total)])

    def stopped(self) -> bool:
        return self._share not in self._worker.plugins


def run_remote(name: str, key: str, packed: tuple[Packed, ...]) -> bytes:
    """Run a call on this worker.

    Args:
        name: of the share.
        packed: its function and arguments.

    Returns:
        The pickle of the `Result`; pickles are bytes wherever they travel, so that arrays arrive as they left.

    Raises:
        InputError: this worker's program is not that of the client.
    """
    from threadpoolctl import threadpool_limits

    worker = get_worker()
    share = worker.plugins.get(name)
    if not isinstance(share, Share):
        return pickle.dumps(Result(key, interrupted=True))
    message = refusal(worker.address, share.state, program_state())
    if message:
        raise InputError(message)
    pickles = share.pickles
    run, *arguments = (pickle.loads(pickles[item] if isinstance(item, int) else item) for item in packed)
    threadpool_limits(limits=1, user_api="blas")  # for good: calls in other threads of this worker rely on it
    result = perform(Call(key, run, tuple(arguments)), _RemoteControl(name, key))
    return _pickled(result)


def _pickled(result: Result) -> bytes:
    try:
        return pickle.dumps(result, protocol=pickle.HIGHEST_PROTOCOL)
    except Exception as error:  # a value that cannot travel
        return pickle.dumps(replace(result, value=None, reason=internal_error(error)))


def pack(calls: list[Call]) -> tuple[list[bytes], dict[str, tuple[Packed, ...]]]:
    """Pickle functions and arguments; those that several calls share are pickled once.

    Returns:
        The pickles that are shared; by key of the call its function and arguments, numbers standing for shared ones.
    """
    users: dict[int, int] = {}
    for call in calls:
        for item in call.arguments:
            users[id(item)] = users.get(id(item), 0) + 1
    shared: list[bytes] = []
    places: dict[int, int] = {}

    def packed(item: Any) -> Packed:
        if id(item) in places:
            return places[id(item)]
        content = pickle.dumps(item, protocol=pickle.HIGHEST_PROTOCOL)
        if users.get(id(item), 0) < 2 or len(content) < 200:  # bytes: a number, a word, None
            return content
        shared.append(content)
        return places.setdefault(id(item), len(shared) - 1)

    return shared, {call.key: tuple(packed(item) for item in (call.run, *call.arguments)) for call in calls}
