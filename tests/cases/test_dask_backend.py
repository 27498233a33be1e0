"""The dask back end on real schedulers and worker processes of this machine: equal results, deaths, strangers."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from cases.small_frame import write
from unit.study import toy_calls
from unit.study.toy_calls import WAIT, Listener, await_file, check_mixed, mixed_calls, process_of, run_all, same

import edesign
from edesign.errors import AnalysisError, InputError
from edesign.frame.project_file import load_project
from edesign.study.check.check import check_inputs
from edesign.study.motions.motions import project_motions
from edesign.study.plan.plan import make_plan
from edesign.study.run.backends import Backend, Call, Result, make_backend

distributed = pytest.importorskip("distributed")
pytest.importorskip("cryptography")  # a cluster of this machine has certificates of its own

ROOT = Path(edesign.__file__).parents[1]
TESTS = ROOT / "tests"


@pytest.fixture(scope="module")
def backend() -> Iterator[Backend]:
    """Two worker processes."""
    with make_backend("dask", 2) as made:
        yield made


def test_values_and_failures_are_those_of_one_process(backend: Backend) -> None:
    found = run_all(backend, [*mixed_calls(), Call("unsendable", toy_calls.unsendable)])
    assert "internal error" in found.pop("unsendable").reason
    check_mixed(found)


def test_an_analysis_gives_the_same_bits(backend: Backend, tmp_path: Path) -> None:
    project = load_project(write(tmp_path))
    plan = make_plan(project)
    motions = project_motions(project, check_inputs(project, [task.spec for task in plan]), lambda: None)
    calls = [Call(task.name, toy_calls.analysis, (project, task.spec, motions.get(task.record or ""))) for task in plan]
    here, there = run_all(make_backend("serial"), calls), run_all(backend, calls)
    assert set(here) == set(there) == {"modes", "push", "shake"}
    for name, result in here.items():
        assert not result.reason and not there[name].reason
        assert result.value is not None and result.value.attributes["status"] == "completed"
        same(result, there[name])


def test_workers_compute_with_one_thread_of_linear_algebra(backend: Backend) -> None:
    assert set(run_all(backend, [Call("blas", toy_calls.blas_threads)])["blas"].value or []) == {1}


def test_only_this_run_is_let_in(backend: Backend) -> None:
    """Every port on which this process and its workers listen: no answer without TLS, no scheduler without its key."""
    ports = _listening_ports()
    assert len(ports) >= 3  # the scheduler, two workers
    for port in ports:
        assert _plain_answer(port) in (b"", b"HTTP/1.1 404 Not Found"), port
    address = backend._address  # type: ignore[attr-defined]
    assert address.startswith("tls://")
    stranger = distributed.Security.temporary()
    for other, security in ((address.replace("tls://", "tcp://"), None), (address, stranger), (address, None)):
        with pytest.raises((OSError, TypeError, ValueError)):
            distributed.Client(other, timeout=2.0, security=security, set_as_default=False)


def _listening_ports() -> set[int]:
    """Ports of TCP on which this process or a child of it listens (/proc, state 0A)."""
    family = {os.getpid()}
    parents = {int(path.name): path / "stat" for path in Path("/proc").iterdir() if path.name.isdigit()}
    for _ in range(3):  # workers are children of this process or of a server that forks
        for pid, stat in parents.items():
            with contextlib.suppress(OSError):
                if int(stat.read_text().rpartition(")")[2].split()[1]) in family:
                    family.add(pid)
    sockets = set()
    for pid in family:
        with contextlib.suppress(OSError):
            sockets |= {os.readlink(entry) for entry in Path(f"/proc/{pid}/fd").iterdir() if entry.is_symlink()}
    rows = [line.split() for name in ("tcp", "tcp6") for line in Path(f"/proc/net/{name}").read_text().splitlines()[1:]]
    return {int(row[1].rpartition(":")[2], 16) for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in sockets}


def _plain_answer(port: int) -> bytes:
    """The first line that somebody gets who asks without TLS for pages of dask."""
    try:
        with socket.create_connection(("127.0.0.1", port), timeout=5.0) as connection:
            connection.sendall(b"GET /json/counts.json HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            return connection.recv(4096).partition(b"\r\n")[0]
    except (ConnectionError, TimeoutError):
        return b""


def test_works_run_at_the_same_time_and_report_their_progress(backend: Backend, tmp_path: Path) -> None:
    """Each waits until all have begun, in processes of their own; they end when the first has reported its progress."""
    listener = Listener()
    calls = [Call(name, toy_calls.until_stopped, (tmp_path, name)) for name in "abc"]
    results = backend.results(calls, _stop_at_progress(listener, {"a", "b"}), listener.started)
    assert sorted(result.key for result in results if result.interrupted) == ["a", "b"]
    assert {path.name for path in tmp_path.iterdir()} == {"a.began", "a.ended", "b.began", "b.ended"}
    assert sorted(listener.begun) == ["a", "b"]  # nothing begins after a stop
    assert run_all(backend, [Call("later", toy_calls.after, (tmp_path, 3))])["later"].value == 3


def test_closing_the_generator_ends_what_runs(backend: Backend, tmp_path: Path) -> None:
    listener = Listener()
    calls = [Call("first", toy_calls.after, (tmp_path / "b.began", 1))]
    calls += [Call(name, toy_calls.until_stopped, (tmp_path, name)) for name in "bcd"]
    results = backend.results(calls, listener, listener.started)
    assert next(results).value == 1
    results.close()
    assert (tmp_path / "b.ended").exists() and not (tmp_path / "d.began").exists()


def test_a_killed_worker_loses_nothing(backend: Backend, tmp_path: Path) -> None:
    """The process of a work is killed while it runs; the work is done by another."""
    listener, mark = Listener(), tmp_path / "mark"
    calls = [Call(f"w{i}", toy_calls.process, (tmp_path, f"w{i}", mark)) for i in range(3)]
    victim = 0

    def started(key: str) -> None:
        nonlocal victim
        listener.started(key)
        if not victim:
            victim = process_of(tmp_path, key)
            os.kill(victim, signal.SIGKILL)
            mark.touch()

    found = {result.key: result for result in backend.results(calls, listener, started)}
    assert sorted(found) == ["w0", "w1", "w2"] == sorted(listener.begun)
    assert all(not result.reason and result.value not in (None, victim) for result in found.values())


@pytest.mark.slow
def test_a_work_that_kills_its_workers_fails_alone(backend: Backend, tmp_path: Path) -> None:
    calls = [
        Call("always", toy_calls.dies, (tmp_path, "always", 99)),
        Call("once", toy_calls.dies, (tmp_path, "once", 1)),
    ]
    found = run_all(backend, [*calls, *mixed_calls()])
    assert found.pop("once").value == "once after 1"
    always = found.pop("always")
    assert always.value is None and "the process that computed it died each time" in always.reason
    check_mixed(found)


@pytest.mark.slow
def test_a_scheduler_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Without workers, with one that dies, with a stranger among them, and at last without itself."""
    from edesign.study.run.backends import dask_cluster, dask_session

    place = tmp_path / "scheduler.json"
    waits = Call("never", toy_calls.until_stopped, (tmp_path, "never"))
    with _process(tmp_path, ROOT, "dask_scheduler", "--port", "0", "--scheduler-file", place) as scheduler:
        await_file(place, least=1)  # it is there before it is written
        address = json.loads(place.read_text(encoding="utf-8"))["address"]
        with (
            monkeypatch.context() as patched,
            pytest.raises(InputError, match=f"{address} has no workers.*E-CLUSTER-01"),
        ):
            patched.setattr(dask_cluster, "JOIN", 0.2)
            make_backend("dask", 1, address).__enter__()
        worker = ("--scheduler-file", place, "--nthreads", "1", "--no-dashboard", "--no-nanny")
        with _process(tmp_path, ROOT, "dask_worker", *worker) as process, make_backend("dask", 1, address) as backend:
            monkeypatch.setattr(dask_session, "ALONE_FOR", 0.2)
            with pytest.raises(AnalysisError, match=f"{address} has had no workers.*E-CLUSTER-01"):
                list(backend.results([waits], Listener(), lambda key: process.kill()))
        with _process(tmp_path, ROOT, "dask_worker", *worker), make_backend("dask", 1, address) as backend:
            check_mixed(run_all(backend, mixed_calls()))
            with _process(tmp_path, _stranger(tmp_path), "dask_worker", *worker, "--name", "stranger"):
                _refused(backend, tmp_path)
            results: list[Result] = []
            calls = [Call("done", toy_calls.after, (tmp_path, 1)), waits]
            with pytest.raises(AnalysisError, match=f"{address} was lost.*E-CLUSTER-01"):
                for result in backend.results(calls, Listener(), lambda key: None):
                    results.append(result)
                    scheduler.kill()
            assert [result.value for result in results] == [1]
    output, errors = capfd.readouterr()
    assert output == errors == ""


def _stranger(folder: Path) -> Path:
    """A folder with an edesign that has one more table."""
    stranger = folder / "stranger"
    shutil.copytree(ROOT / "edesign", stranger / "edesign", ignore=shutil.ignore_patterns("__pycache__"))
    (stranger / "edesign" / "codes" / "factor.csv").write_text("1.0000001\n", encoding="utf-8")
    return stranger


def _refused(backend: Backend, folder: Path) -> None:
    """Calls go on being computed until the stranger has joined, then it is named."""
    end = time.monotonic() + WAIT
    with pytest.raises(InputError, match=r"the worker tcp://\S+ would give results of another program: the code"):
        while time.monotonic() < end:
            run_all(backend, [Call("quick", toy_calls.after, (folder, 1))])


def test_there_is_no_scheduler(monkeypatch: pytest.MonkeyPatch) -> None:
    from edesign.study.run.backends import dask_cluster

    monkeypatch.setattr(dask_cluster, "CONNECT", 0.5)
    for address in ("tcp://127.0.0.1:9", "nonsense://x"):
        with (
            pytest.raises(InputError, match=f"no dask scheduler at {address}: .*E-CLUSTER-01"),
            make_backend("dask", 1, address),
        ):
            pass


INTERRUPTED = """\
import sys
from pathlib import Path
from unit.study.toy_calls import Listener, after, until_stopped
from edesign.study.run.backends import Call, make_backend
from edesign.study.run.interrupt import stop_on_signals

if __name__ == "__main__":
    folder, listener = Path(sys.argv[1]), Listener()
    calls = [Call("done", after, (folder, 1))] + [Call(name, until_stopped, (folder, name)) for name in "abc"]
    with stop_on_signals(listener.stop), make_backend("dask", 2) as backend:
        for result in backend.results(calls, listener, listener.started):
            print(result.key, result.interrupted, flush=True)
"""


@pytest.mark.slow
def test_ctrl_c_in_a_terminal_reaches_all_processes_and_loses_nothing(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(INTERRUPTED, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, str(script), str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=_environment(ROOT),
        start_new_session=True,  # a process group of its own, as a shell gives to a command
    ) as process:
        try:
            await_file(tmp_path / "a.began")
            await_file(tmp_path / "b.began")
            os.killpg(process.pid, signal.SIGINT)
            output, errors = process.communicate(timeout=WAIT)  # workers have these pipes too: none is left
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == 0 and errors == ""
    lines = output.splitlines()
    assert lines[0] == "done False" and sorted(lines[1:]) == ["a True", "b True"]


@contextmanager
def _process(folder: Path, code: Path, module: str, *words: str | Path) -> Iterator[subprocess.Popen[bytes]]:
    """A part of a cluster, as its own command would start it, with edesign from a folder."""
    with (folder / f"{module}.log").open("ab") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{module}", *map(str, words)],
            stdout=log,
            stderr=log,
            cwd=folder,
            env=_environment(code),
        )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def _environment(code: Path) -> dict[str, str]:
    return os.environ | {"PYTHONPATH": os.pathsep.join([str(code), str(TESTS)]), "OPENBLAS_NUM_THREADS": "1"}


def _stop_at_progress(listener: Listener, keys: set[str]) -> Listener:
    """A listener that stops after the progress of some calls."""
    before = listener.progress

    def progress(key: str, done: int, total: int) -> None:
        before(key, done, total)
        if keys <= {reported for reported, *_ in listener.reported}:
            listener.stop.set()

    listener.progress = progress  # type: ignore[method-assign]
    return listener
