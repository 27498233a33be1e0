"""Calls that do what a test wants, as functions that other processes find; what they report lies in a folder."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import AnalysisError
from edesign.project.analysis.analyses import Analysis
from edesign.project.project import Project
from edesign.study.motions.motions import Motion
from edesign.study.run.analyses import run_analysis
from edesign.study.run.backends import Backend, Call, Result

WAIT = 60.0  # s, until a test is taken to hang


def numbers(seed: int, shared: np.ndarray, *, progress: Callable[[int, int], None], stop: Callable[[], bool]) -> Group:
    """Numbers that depend on the arguments alone; shared ones may be written to."""
    shared += 0.0
    group = Group()
    group.add(
        "values", ("n",), np.cumsum(np.random.default_rng(seed).normal(size=shared.size) * shared), "1", "numbers"
    )
    progress(1, 2)
    progress(2, 2)
    return group


def fails(kind: str, **_: Any) -> None:
    """Fail on purpose, for want of memory, by a fault, or with what cannot be sent."""
    if kind == "known":
        raise AnalysisError("step 7: no convergence [E-CORE-01]")
    if kind == "memory":
        raise MemoryError
    raise ZeroDivisionError("division by zero")


def unsendable(**_: Any) -> Any:
    """Return what cannot be pickled."""
    return lambda: None


def until_stopped(folder: Path, name: str, *, progress: Callable[[int, int], None], stop: Callable[[], bool]) -> Group:
    """Call on until asked to stop, then say so."""
    (folder / f"{name}.began").touch()
    end = time.monotonic() + WAIT
    step = 0
    while not stop():
        assert time.monotonic() < end, "never stopped"
        step += 1
        progress(step, 10**6)
        time.sleep(0.01)
    (folder / f"{name}.ended").touch()
    return Group(attributes={"status": "interrupted"})


def after(mark: Path, value: int, **_: Any) -> int:
    """Wait for a file before ending."""
    await_file(mark)
    return value


def dies(folder: Path, name: str, times: int, **_: Any) -> str:
    """Take the process down the first few times, as the kernel does when memory is short."""
    count = len(list(folder.glob(f"{name}.death*")))
    if count < times:
        (folder / f"{name}.death{count}").touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return f"{name} after {count}"


def process(folder: Path, name: str, mark: Path, **_: Any) -> int:
    """Write the process id into a file, wait for another, return the id."""
    (folder / f"{name}.{os.getpid()}").touch()
    await_file(mark)
    return os.getpid()


def process_of(folder: Path, name: str) -> int:
    """Wait for what `process` writes."""
    end = time.monotonic() + WAIT
    while not (found := list(folder.glob(f"{name}.*"))):
        assert time.monotonic() < end, f"{name} never began"
        time.sleep(0.01)
    return int(found[0].suffix[1:])


def blas_threads(**_: Any) -> list[int]:
    """The threads that each BLAS of this process may use."""
    from threadpoolctl import threadpool_info

    return [library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"]


def await_file(path: Path, least: int = 0) -> None:
    """Wait until there is a file, of so many bytes at least."""
    end = time.monotonic() + WAIT
    while not (path.exists() and path.stat().st_size >= least):
        assert time.monotonic() < end, f"{path.name} never came"
        time.sleep(0.01)


def analysis(project: Project, spec: Analysis, motion: Motion | None, **control: Any) -> Group:
    """An analysis of a project."""
    return run_analysis(project, spec, motion=motion, **control)


class Listener:
    """A control that keeps the progress reported to it, and stops when a test says so."""

    def __init__(self) -> None:
        self.reported: list[tuple[str, int, int]] = []
        self.begun: list[str] = []
        self.stop = threading.Event()

    def progress(self, key: str, done: int, total: int) -> None:
        """Remember."""
        self.reported.append((key, done, total))

    def started(self, key: str) -> None:
        """Remember."""
        self.begun.append(key)

    def stopped(self) -> bool:
        """Whether a test said so."""
        return self.stop.is_set()


def run_all(backend: Backend, calls: Sequence[Call]) -> dict[str, Result]:
    """Results by key, each asked to have been reported as begun before."""
    listener = Listener()
    found: dict[str, Result] = {}
    for result in backend.results(calls, listener, listener.started):
        assert result.key in listener.begun and result.key not in found
        found[result.key] = result
    assert len(listener.begun) == len(set(listener.begun)), "begun twice"
    return found


def mixed_calls() -> list[Call]:
    """Six calls with numbers as their results, which share an argument, and four that fail."""
    shared = np.linspace(1.0, 2.0, 1000)
    calls = [Call(f"numbers {seed}", numbers, (seed, shared)) for seed in range(6)]
    return calls[:3] + [Call(kind, fails, (kind,)) for kind in ("known", "memory", "fault")] + calls[3:]


def check_mixed(found: dict[str, Result]) -> None:
    """Numbers as numpy gives them, bit by bit, and the reasons of the failures."""
    assert {key for key, result in found.items() if not result.reason} == {f"numbers {seed}" for seed in range(6)}
    for seed in range(6):
        expected = np.cumsum(np.random.default_rng(seed).normal(size=1000) * np.linspace(1.0, 2.0, 1000))
        result = found[f"numbers {seed}"]
        assert result.value is not None and not result.interrupted
        assert result.value.variables["values"].values.tobytes() == expected.tobytes()
    assert found["known"].reason == "step 7: no convergence [E-CORE-01]" and found["known"].value is None
    assert "not enough memory" in found["memory"].reason
    assert found["fault"].reason == "internal error, please report it (ZeroDivisionError: division by zero)"


def same(first: Result, second: Result) -> None:
    """The groups of two results are equal bit by bit but for the time they took."""
    one, other = first.value, second.value
    assert isinstance(one, Group) and isinstance(other, Group)
    assert list(one.variables) == list(other.variables) and list(one.coords) == list(other.coords)
    for name, a in (one.coords | one.variables).items():
        b = (other.coords | other.variables)[name]
        assert (a.dims, a.unit, a.long_name, a.values.dtype) == (b.dims, b.unit, b.long_name, b.values.dtype)
        assert a.values.tobytes() == b.values.tobytes(), a.long_name
    assert _timeless(one) == _timeless(other)


def _timeless(group: Group) -> dict[str, Any]:
    statistics = {k: v for k, v in group.attributes.get("statistics", {}).items() if k != "cpu_s"}
    return {**group.attributes, "statistics": statistics}
