"""Several calls at the same time, in threads; the core leaves Python's lock while it computes."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

from edesign.one_thread import one_thread
from edesign.study.run.backends.call import Call, Control, LocalBackend, Result, Results, check_keys, perform

ASK_EVERY = 0.2  # s, for a request to stop


class ThreadsBackend(LocalBackend):
    """A back end that runs calls in threads."""

    name = "threads"

    def __init__(self, workers: int) -> None:
        self.workers = workers

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        """Yield the results as they are ready, those ready at one time in the order of the calls; see `Backend`.

        Args:
            calls: with unique keys.
            control: receives the progress and is asked whether to stop.
            started: called with the key of each call that starts.
        """
        check_keys(calls)
        own = _Closable(control)

        def begin(call: Call) -> Result | None:
            if own.stopped():
                return None
            started(call.key)
            return perform(call, own)

        with one_thread(), ThreadPoolExecutor(self.workers, thread_name_prefix="edesign") as pool:
            waiting: dict[Future[Result | None], int] = {pool.submit(begin, call): i for i, call in enumerate(calls)}
            try:
                while waiting:
                    done, _ = wait(waiting, timeout=ASK_EVERY, return_when=FIRST_COMPLETED)
                    for future in sorted(done, key=waiting.__getitem__):
                        del waiting[future]
                        result = future.result()
                        if result is not None:
                            yield result
                    if own.stopped():
                        for future in [future for future in waiting if future.cancel()]:
                            del waiting[future]
            finally:  # left by an error or Ctrl-C: the others need not go on
                own.closing.set()
                for future in waiting:
                    future.cancel()


class _Closable:
    """A control that also stops when nobody wants the results any more."""

    def __init__(self, control: Control) -> None:
        self.closing = threading.Event()
        self.progress = control.progress
        self._stopped = control.stopped

    def stopped(self) -> bool:
        return self.closing.is_set() or self._stopped()
