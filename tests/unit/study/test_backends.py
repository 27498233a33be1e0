"""Back ends on this process: results, failures, stop, closing; arguments that travel come out as they went in."""

from __future__ import annotations

import dataclasses
import pickle
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import suite_project
from unit.study import toy_calls
from unit.study.toy_calls import Listener, check_mixed, mixed_calls, run_all

from edesign.errors import InputError
from edesign.frame.project_file import load_project
from edesign.study.check.check import check_inputs
from edesign.study.motions.motions import project_motions
from edesign.study.plan.plan import make_plan
from edesign.study.run.backends import Backend, Call, make_backend
from edesign.study.run.backends.state import refusal

PROJECTS = Path(__file__).parents[3] / "projects"


@pytest.fixture(params=["serial", "threads of 1", "threads of 3"])
def backend(request: pytest.FixtureRequest) -> Backend:
    name, _, workers = request.param.partition(" of ")
    return make_backend(name, int(workers or 1))


def test_values_and_failures(backend: Backend) -> None:
    with backend:
        check_mixed(run_all(backend, mixed_calls()))


def test_one_thread_of_linear_algebra(backend: Backend) -> None:
    """More would sum in another order, and results would depend on the machine."""
    from threadpoolctl import threadpool_limits

    with backend, threadpool_limits(limits=2, user_api="blas"):
        assert set(run_all(backend, [Call("blas", toy_calls.blas_threads)])["blas"].value or []) == {1}


def test_the_serial_one_keeps_the_order_and_waits_to_be_asked() -> None:
    backend, listener = make_backend("serial"), Listener()
    results = backend.results(mixed_calls(), listener, listener.started)
    assert listener.begun == []
    assert next(results).key == "numbers 0" and listener.begun == ["numbers 0"]
    assert listener.reported == [("numbers 0", 1, 2), ("numbers 0", 2, 2)]
    assert [result.key for result in results] == [work.key for work in mixed_calls()][1:]


def test_results_come_as_they_are_ready(tmp_path: Path) -> None:
    """The first work waits for a mark that is made when the result of the second is there."""
    mark, listener = tmp_path / "mark", Listener()
    calls = [Call("slow", toy_calls.after, (mark, 1)), Call("quick", toy_calls.after, (tmp_path, 2))]
    keys = []
    for result in make_backend("threads", 2).results(calls, listener, listener.started):
        keys.append(result.key)
        mark.touch()
    assert keys == ["quick", "slow"]


def test_a_stop_ends_what_runs_and_begins_nothing(backend: Backend, tmp_path: Path) -> None:
    listener = Listener()

    def started(key: str) -> None:
        listener.started(key)
        if len(listener.begun) == getattr(backend, "workers", 1):
            listener.stop.set()

    calls = [Call(name, toy_calls.until_stopped, (tmp_path, name)) for name in "abcdef"]
    results = list(backend.results(calls, listener, started))
    running = list("abc")[: getattr(backend, "workers", 1)]
    assert sorted(result.key for result in results) == running and all(result.interrupted for result in results)
    assert listener.begun == running
    assert list(backend.results(calls, listener, started)) == []


def test_closing_the_generator_waits_for_what_runs(tmp_path: Path) -> None:
    listener, both = Listener(), threading.Event()

    def started(key: str) -> None:
        listener.started(key)
        if {"a", "b"} <= set(listener.begun):
            both.set()

    calls = [Call("first", toy_calls.after, (tmp_path, 1))]
    calls += [Call(name, toy_calls.until_stopped, (tmp_path, name)) for name in "abcdef"]
    results = make_backend("threads", 2).results(calls, listener, started)
    assert next(results).value == 1
    assert both.wait(toy_calls.WAIT)
    results.close()
    for name in "ab":
        assert not (tmp_path / f"{name}.began").exists() or (tmp_path / f"{name}.ended").exists()
    assert set(listener.begun) == {"first", "a", "b"} and not listener.stopped()


def test_an_error_of_the_listener_is_not_taken_for_one_of_the_work() -> None:
    def started(key: str) -> None:
        raise OSError("nobody listens")

    for backend in (make_backend("serial"), make_backend("threads", 2)):
        with pytest.raises(OSError, match="nobody listens"):
            list(backend.results(mixed_calls(), Listener(), started))


def test_works_that_cannot_be_distinguished_are_refused(backend: Backend) -> None:
    with pytest.raises(ValueError, match="same key"):
        list(backend.results([Call("a", toy_calls.fails, ("x",))] * 2, Listener(), print))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("thread",), "`threads`.*E-NAME-01"),
        (("threads", 0), "0 workers.*E-CLUSTER-02"),
        (("threads", 2, "tcp://here:1"), "scheduler.*E-CLUSTER-02"),
    ],
)
def test_what_cannot_be_chosen(arguments: tuple[Any, ...], words: str) -> None:
    with pytest.raises(InputError, match=words):
        make_backend(*arguments)


def test_dask_that_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("edesign.study.run.backends.dask")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"edesign\[cluster\].*E-CLI-06"):
        make_backend("dask", 2)


def test_a_worker_of_another_state_is_named_with_what_differs() -> None:
    here = {"edesign": "a" * 64, "numpy": "2.1.0"}
    assert refusal("tcp://w:1", here, dict(here)) == ""
    message = refusal("tcp://w:1", here, {"edesign": "b" * 64, "numpy": "2.2.0"})
    assert "worker tcp://w:1" in message and "numpy is 2.2.0 there, 2.1.0 here" in message
    assert f"checksum {'b' * 12} there, {'a' * 12} here" in message
    assert "edesign is missing there" in refusal("tcp://w:1", here, {"edesign": "missing", "numpy": "2.1.0"})


@pytest.mark.parametrize("fitted", [False, True])
def test_projects_and_motions_travel_unchanged(fitted: bool, tmp_path: Path) -> None:
    """Other processes get pickles: values, the text, and the places in it that messages name."""
    path = suite_project.write(tmp_path) if fitted else PROJECTS / "thesis_one_storey" / "project.yaml"
    project = load_project(path)
    copy = pickle.loads(pickle.dumps(project))
    assert copy == project and (copy.path, copy.text, copy.checksum) == (project.path, project.text, project.checksum)
    assert copy.where("analyses", 1, "name") == project.where("analyses", 1, "name") != str(project.path)
    plan = make_plan(project)
    assert [pickle.loads(pickle.dumps(task.spec)) for task in plan] == [task.spec for task in plan]
    found = check_inputs(project, [task.spec for task in plan])
    motions = project_motions(project, found, lambda: (0.5,))
    assert motions and all((motion.match is not None) == fitted for motion in motions.values())
    for motion in motions.values():
        _identical(motion, pickle.loads(pickle.dumps(motion)))


def _identical(one: Any, other: Any) -> None:
    assert type(one) is type(other)
    if dataclasses.is_dataclass(one):
        for item in dataclasses.fields(one):
            _identical(getattr(one, item.name), getattr(other, item.name))
    elif isinstance(one, np.ndarray):
        assert one.dtype == other.dtype and one.tobytes() == other.tobytes()
    else:
        assert one == other


def test_dask_on_this_machine_without_certificates_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rather than to let other users of the machine in; a scheduler elsewhere needs none of its own."""
    distributed = pytest.importorskip("distributed")

    def missing() -> None:
        raise ImportError("Using `Security.temporary` requires `cryptography`")

    monkeypatch.setattr(distributed.Security, "temporary", missing)
    with (
        pytest.raises(InputError, match="cryptography.*E-CLI-06"),
        make_backend("dask", 2),
    ):
        pass
