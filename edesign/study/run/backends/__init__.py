"""Back ends of a run: where and how many calls are computed at the same time. Results do not depend on them."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean
from edesign.study.run.backends.call import Backend, Call, Control, Result
from edesign.study.run.backends.serial import SerialBackend
from edesign.study.run.backends.threads import ThreadsBackend

BACKENDS = ("serial", "threads", "dask")

__all__ = ["BACKENDS", "Backend", "Control", "Result", "Call", "make_backend"]


def make_backend(name: str, workers: int = 1, scheduler: str | None = None) -> Backend:
    """Return a back end by its name.

    Args:
        name: "serial", "threads" or "dask".
        workers: number of threads (one is that of the caller, so that Ctrl-C reaches it at once), or of processes on
            this machine; a given scheduler has its own.
        scheduler: address of a dask scheduler, such as tcp://10.0.0.1:8786; None makes one on this machine.

    Returns:
        The back end, a context manager: processes are started when it is entered.

    Raises:
        InputError: there is no such back end, its packages are not installed, or it has no use for a scheduler.
    """
    if name not in BACKENDS:
        raise InputError(
            f"there is no back end {name!r}{did_you_mean(name, BACKENDS)} (there are: {', '.join(BACKENDS)})"
            " [E-NAME-01]"
        )
    if workers < 1:
        raise InputError(f"{workers} workers: at least one is needed [E-CLUSTER-02]")
    if name != "dask":
        if scheduler is not None:
            raise InputError(
                f"the back end {name!r} has no scheduler; with {scheduler} it must be 'dask' [E-CLUSTER-02]"
            )
        return SerialBackend() if name == "serial" or workers == 1 else ThreadsBackend(workers)
    try:
        from edesign.study.run.backends.dask_cluster import DaskBackend
    except ModuleNotFoundError as error:
        if str(error.name).partition(".")[0] not in ("dask", "distributed"):
            raise
        raise InputError(
            f"the back end 'dask' needs the package {error.name}: pip install 'edesign[cluster]' "
            "(or: pip install dask distributed) [E-CLI-06]"
        ) from error
    return DaskBackend(workers, scheduler)
