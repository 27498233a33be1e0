"""Calls in the processes of a dask cluster: one on this machine, or one that a scheduler elsewhere leads."""

from __future__ import annotations

import logging
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from multiprocessing import resource_tracker

import dask
import distributed

from edesign.errors import InputError
from edesign.study.run.backends.call import Call, Control, Results, check_keys
from edesign.study.run.backends.dask_session import Session
from edesign.study.run.backends.state import program_state, refusal

CONNECT = 30.0  # s
JOIN = 60.0  # s, for the first worker
DEATHS = 1  # of workers of our own on which a call may have been before it is looked at alone


class DaskBackend:
    """A back end that runs calls on the workers of a dask scheduler.

    Args:
        workers: processes of a cluster on this machine, each of one thread.
        scheduler: address of a running one; then its workers are used, as many as there are at any time.
    """

    name = "dask"

    def __init__(self, workers: int, scheduler: str | None) -> None:
        self.workers = workers
        self.scheduler = scheduler
        self._stack = ExitStack()
        self._client: distributed.Client | None = None
        self._address = ""

    def __enter__(self) -> DaskBackend:
        with ExitStack() as stack:
            stack.enter_context(_silence())
            address, security = self.scheduler, None
            if address is None:
                security = _certificates()
                address = stack.enter_context(_cluster(self.workers, security)).scheduler_address
            self._client = stack.enter_context(_connect(address, security))
            self._address = address
            try:
                self._client.wait_for_workers(1, timeout=JOIN)
            except TimeoutError:
                raise InputError(
                    f"the scheduler {address} has no workers; start some: dask worker {address} --nthreads 1"
                    " [E-CLUSTER-01]"
                ) from None
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *error: object) -> None:
        self._client = None
        self._stack.close()

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        """Yield the results of calls as they are ready; see `Backend`.

        Args:
            calls: with unique keys.
            control: receives the progress and is asked whether to stop.
            started: called with the key of each call that starts.

        Raises:
            InputError: a worker's program is not that of this process.
            AnalysisError: the scheduler or all workers were lost.
        """
        check_keys(calls)
        if self._client is None:
            raise RuntimeError("the back end must be entered first")
        if not calls or control.stopped():
            return
        _check_workers(self._client)
        with Session(self._client, self._address, calls, control, started) as session:
            yield from session.results()


def _certificates() -> distributed.Security:
    """A key and a certificate of this run, in memory only: whoever has them is of the run, all others are refused.

    A port of this machine is open to all its users, and whoever a scheduler or worker listens to can run code.

    Raises:
        InputError: the package that makes them is not installed.
    """
    try:
        return distributed.Security.temporary()
    except ImportError as error:
        raise InputError(
            "the back end 'dask' on this machine needs the package cryptography, so that no other user can run code in "
            "its processes: pip install 'edesign[cluster]' (or: pip install cryptography), or use 'threads' [E-CLI-06]"
        ) from error


@contextmanager
def _cluster(workers: int, security: distributed.Security) -> Iterator[distributed.LocalCluster]:
    # The thread that this one starts inherits the mask, and so do the workers that it starts now and later: Ctrl-C in
    # a terminal goes to all processes, but only this one is to act on it.
    resource_tracker.ensure_running()  # which unblocks the signal when it is started
    previous = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        with dask.config.set({f"distributed.{part}.http.routes": [] for part in ("scheduler", "worker")}):
            cluster = distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                protocol="tls://",
                security=security,
                dashboard_address="127.0.0.1:0",
                silence_logs=logging.CRITICAL,
                scheduler_kwargs={"allowed_failures": DEATHS, "dashboard": False},
            )
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, previous)
    with cluster:
        yield cluster


def _connect(address: str, security: distributed.Security | None) -> distributed.Client:
    try:
        return distributed.Client(address, timeout=CONNECT, set_as_default=False, security=security)
    except (OSError, ValueError, TypeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"there is no dask scheduler at {address}: {reason} [E-CLUSTER-01]") from error


def _check_workers(client: distributed.Client) -> None:
    """Refuse workers of another program before anything is computed; those that join later refuse themselves."""

    def state() -> dict[str, str]:  # travels as it is, so that a worker without edesign can answer
        try:
            from edesign.study.run.backends.state import program_state
        except Exception as error:  # however an installation may be broken
            return {"edesign": f"missing or of another version ({error})"}
        return dict(program_state())

    for worker, found in client.run(state, on_error="return").items():
        if isinstance(found, OSError):  # it left
            continue
        message = refusal(worker, program_state(), found if isinstance(found, dict) else {"edesign": str(found)})
        if message:
            raise InputError(message)


@contextmanager
def _silence() -> Iterator[None]:
    """Keep what distributed logs about closed connections and killed workers from the terminal."""
    if logging.getLogger("edesign").isEnabledFor(logging.INFO):  # --debug
        yield
        return
    logging.getLogger("distributed.http.proxy")  # of a module that is imported later, and reports what it has not
    loggers = [
        logger
        for name, logger in logging.root.manager.loggerDict.items()
        if isinstance(logger, logging.Logger) and name.partition(".")[0] in ("distributed", "tornado", "asyncio")
    ]
    before = [logger.disabled for logger in loggers]
    with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1GB"}):
        for logger in loggers:
            logger.disabled = True
        try:
            yield
        finally:
            for logger, disabled in zip(loggers, before, strict=True):
                logger.disabled = disabled
