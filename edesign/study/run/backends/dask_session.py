"""Calls under way on a dask cluster: which are handed out, what comes back, and what becomes of killed workers."""

from __future__ import annotations

import contextlib
import pickle
import time
import uuid
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError
from dataclasses import replace
from queue import Empty, SimpleQueue
from typing import Any

from distributed import Client, Future
from distributed.scheduler import KilledWorker

from edesign.errors import AnalysisError, InputError
from edesign.study.run.backends.call import Call, Control, Result, Results, internal_error, log
from edesign.study.run.backends.dask_worker import Share, pack, run_remote
from edesign.study.run.backends.state import program_state

ASK_EVERY = 0.2  # s, for a request to stop
COUNT_EVERY = 1.0  # s, the workers
ALONE_FOR = 120.0  # s without any worker, after which a run gives up
END_WITHIN = 60.0  # s for what runs to see that it shall stop
ATTEMPTS = 3  # to reach all workers while some come and go
DIED = (
    "the process that computed it died each time, and it was computed alone in the end: "
    "not enough memory (fewer histories in `outputs`, a longer time step), or killed from outside"
)


class Session:
    """One request for results on a cluster.

    Only as many calls are with the scheduler as there are threads on the workers, so nothing waits on a worker that may
    die, and a stop has little to take back. dask computes anew what was lost with a worker. A call that has been on
    several workers as they died is not guilty for that: another may have been beside it. It is put aside and run alone
    when all others have ended; if workers die again, it fails.
    """

    def __init__(
        self, client: Client, address: str, calls: Sequence[Call], control: Control, started: Callable[[str], None]
    ) -> None:
        self.client = client
        self.control = control
        self.started = started
        self.share = f"edesign-{uuid.uuid4().hex}"
        self.waiting = deque(calls)
        self.suspects: deque[Call] = deque()
        self.running: dict[Future, Call] = {}
        self._address = address
        self._alone = False
        self._stopping = False
        self._events: SimpleQueue[Any] = SimpleQueue()
        self._begun: set[str] = set()
        self._ended: set[str] = set()
        self._threads = 0
        self._counted = self._peopled = -float("inf")
        self._pickles, self._packed = pack(list(calls))

    def __enter__(self) -> Session:
        self.client.subscribe_topic(self.share, self._hear)
        plugin = Share(self.share, program_state(), self._pickles)
        for attempt in range(ATTEMPTS):
            try:
                self.client.register_plugin(plugin, name=self.share)
                break
            except OSError as error:  # a worker left
                if attempt == ATTEMPTS - 1 or self.client.status != "running":
                    raise self._lost() from error
        self._peopled = time.monotonic()
        return self

    def __exit__(self, kind: type[BaseException] | None, *error: object) -> None:
        impatient = kind is not None and issubclass(kind, KeyboardInterrupt)
        if self.client.status != "running":
            return
        with contextlib.suppress(Exception):  # what cannot be reached has ended, or ends with its process
            self._stop()
            if not impatient:
                self._await_running()
        with contextlib.suppress(Exception):
            self.client.cancel(list(self.running))
            self.client.unsubscribe_topic(self.share)

    def results(self) -> Results:
        """Yield the results of the calls as they come."""
        while self.waiting or self.suspects or self.running:
            if self.control.stopped():
                self._stop()
            self._hand_out()
            try:
                event = self._events.get(timeout=ASK_EVERY)
            except Empty:
                self._check_connection()
                continue
            if isinstance(event, Future):
                result = self._take(event)
                if result is not None:
                    yield result
            else:
                self._report(*event)

    def _hand_out(self) -> None:
        threads = self._count_threads()
        while self.waiting and len(self.running) < threads:
            self._submit(self.waiting.popleft())
        if self.suspects and not self.waiting and not self.running:
            self._alone = True
            self._submit(self.suspects.popleft())

    def _submit(self, call: Call) -> None:
        future = self.client.submit(
            run_remote, self.share, call.key, self._packed[call.key], key=f"{call.key}-{uuid.uuid4().hex}", pure=False
        )
        self.running[future] = call
        future.add_done_callback(self._events.put)

    def _take(self, future: Future) -> Result | None:
        """Return the result of a call that has ended, None if that is to be computed anew."""
        call = self.running.pop(future)
        try:
            result: Result = pickle.loads(future.result())
        except KilledWorker:
            if self._alone:
                result = Result(call.key, reason=DIED)
            else:
                self.suspects.append(call)
                return None
        except (CancelledError, OSError) as error:
            raise self._lost() from error
        except InputError:  # a worker of another program
            raise
        except Exception as error:  # one call must not take the others with it
            self._check_connection()
            log.exception("analysis %s", call.key)
            result = Result(call.key, reason=internal_error(error))
        if result.interrupted and not self._stopping:
            result = replace(result, value=None, interrupted=False, reason=internal_error(LookupError(self.share)))
        self._report(call.key, 0, 0)
        self._ended.add(call.key)
        return result

    def _await_running(self) -> None:
        end = time.monotonic() + END_WITHIN
        while self.running and self._count_threads() and time.monotonic() < end:
            with contextlib.suppress(Empty):
                event = self._events.get(timeout=ASK_EVERY)
                if isinstance(event, Future):
                    self.running.pop(event)

    def _hear(self, event: tuple[float, Any]) -> None:
        self._events.put(event[1])

    def _report(self, key: str, done: int, total: int) -> None:
        """Pass on what a worker reported; a call that is computed anew does not begin again."""
        if key in self._ended:
            return
        if key not in self._begun:
            self._begun.add(key)
            self.started(key)
        if total:
            self.control.progress(key, done, total)

    def _stop(self) -> None:
        """Hand out no more, and take the share from the workers, which ends what runs there."""
        self.waiting.clear()
        self.suspects.clear()
        if not self._stopping:
            self._stopping = True
            with contextlib.suppress(OSError):  # of a worker that left; the others were reached
                self.client.unregister_worker_plugin(self.share)

    def _count_threads(self) -> int:
        now = time.monotonic()
        if now - self._counted >= COUNT_EVERY:
            self._check_connection()
            try:
                self._threads = sum(self.client.nthreads().values())
            except OSError as error:
                raise self._lost() from error
            self._counted = now
            if self._threads:
                self._peopled = now
            elif now - self._peopled > ALONE_FOR:
                raise AnalysisError(
                    f"the scheduler {self._address} has had no workers for {ALONE_FOR:.0f} s [E-CLUSTER-01]"
                )
        return self._threads

    def _check_connection(self) -> None:
        if self.client.status != "running":
            raise self._lost()

    def _lost(self) -> AnalysisError:
        return AnalysisError(f"the connection to the dask scheduler {self._address} was lost [E-CLUSTER-01]")
