"""The run: order, failures, interruption and resume. The core is replaced by known numbers, the archive is real."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support.messages import says
from unit.cli.small_project import STEPS, Core, fail, project

from edesign.archive.reader import open_archive
from edesign.archive.writer import partial_path
from edesign.errors import ArchiveError, InputError, Interrupted
from edesign.study.run import analyses, run
from edesign.study.run.progress import Progress
from edesign.study.run.run import run_project


def use(monkeypatch: pytest.MonkeyPatch, core: Core) -> Core:
    monkeypatch.setattr(analyses, "run_analysis", core)
    monkeypatch.setattr(run, "check_inputs", lambda *_: {})  # the small project has no frame
    monkeypatch.setattr(run, "project_warnings", lambda *_: [])
    return core


def results(path: Path) -> dict[str, bytes]:
    with open_archive(path) as archive:
        return {
            name: archive.group(f"analyses/{name}").variables["base_shear"].values.tobytes()
            for name in archive.names("analyses")
        }


def interrupt() -> None:
    """What Ctrl-C does."""
    os.kill(os.getpid(), signal.SIGINT)


def test_all_analyses_are_archived_in_the_order_of_the_plan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    core = use(monkeypatch, Core())
    summary = run_project(project(tmp_path, "dbca"))
    assert core.ran == list("dbca") and summary.archive == tmp_path / "small.h5" and not summary.failed
    assert [outcome.name for outcome in summary.outcomes] == list("dbca")
    with open_archive(summary.archive) as archive:
        assert archive.names("analyses") == list("dbca")
        attributes = archive.attributes
        assert attributes["status"] == "completed" and attributes["complete"] == 1
        assert attributes["planned"] == list("dbca") and attributes["project_file"] == "project.yaml"
        assert str(archive.group().variables["project_text"].values) == "title: small"
        # sha256 of "title: small", from sha256sum
        assert attributes["project_checksum"] == "6b976c5580c000f7cb09851387e968603dc8e85ec86c45171026b1ccacc39043"
        assert {"created", "python_version", "numpy_version", "h5py_version"} <= archive.group_attributes(
            "provenance"
        ).keys()
        analysis = archive.group_attributes("analyses/b")
        assert (analysis["record"], analysis["level"], analysis["variant"]) == ("el_centro", "DBE", None)


def test_a_failed_analysis_is_recorded_and_the_others_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def bug() -> None:
        raise ZeroDivisionError("division by zero")

    use(monkeypatch, Core({("b", 7): fail, ("c", 0): bug}))
    summary = run_project(project(tmp_path))
    assert [outcome.status for outcome in summary.outcomes] == ["completed", "failed", "failed", "completed"]
    with open_archive(summary.archive) as archive:
        assert archive.attributes["status"] == "failed" and archive.complete
        assert archive.names("analyses") == list("abcd")
        assert archive.group_attributes("analyses/b")["reason"] == "step 7 at 0.07 s: no convergence [E-CORE-08]"
        assert "ZeroDivisionError: division by zero" in str(archive.group_attributes("analyses/c")["reason"])


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_keeps_finished_analyses_and_the_next_run_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: int
) -> None:
    use(monkeypatch, Core())
    whole = results(run_project(project(tmp_path), tmp_path / "whole.h5").archive)

    finished = threading.Event()

    def slow() -> None:  # with two workers "d" runs beside "c" and must not be finished when the signal comes
        assert finished.wait(20)
        time.sleep(0.6)

    def late() -> None:
        assert finished.wait(20)
        interrupt()
        time.sleep(0.3)

    core = use(monkeypatch, Core({("c", 5): late, ("d", 5): slow}))

    def listen(report: Progress) -> None:
        if report.event == "end" and report.analysis == "b":
            finished.set()

    handler = signal.getsignal(signal.SIGINT)
    with pytest.raises(Interrupted, match=r"2 of 4 analyses are finished and kept in .*small\.h5\.partial.* goes on"):
        run_project(project(tmp_path), progress=listen, workers=workers)
    assert signal.getsignal(signal.SIGINT) is handler
    assert not (tmp_path / "small.h5").exists()
    with open_archive(partial_path(tmp_path / "small.h5")) as archive:
        assert not archive.complete and archive.names("analyses") == ["a", "b"]

    core = use(monkeypatch, Core())
    summary = run_project(project(tmp_path), workers=workers)
    assert sorted(core.ran) == ["c", "d"]
    assert [outcome.reused for outcome in summary.outcomes] == [True, True, False, False]
    assert "2 of 4 analyses are reused" in summary.notes[0]
    assert results(summary.archive) == whole  # bitwise
    assert not partial_path(summary.archive).exists()


def test_interrupted_before_anything_was_finished_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    use(monkeypatch, Core({("a", 5): interrupt}))
    with pytest.raises(Interrupted, match="before an analysis was finished"):
        run_project(project(tmp_path))
    assert list(tmp_path.iterdir()) == []


def test_a_second_ctrl_c_does_not_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def twice() -> None:
        interrupt()
        interrupt()
        time.sleep(1)
        raise AssertionError("not stopped")

    use(monkeypatch, Core({("b", 3): twice}))
    with pytest.raises(Interrupted, match="1 of 4"):
        run_project(project(tmp_path))


def test_a_changed_project_starts_afresh_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core({("c", 5): interrupt}))
    with pytest.raises(Interrupted):
        run_project(project(tmp_path))
    core = use(monkeypatch, Core())
    summary = run_project(project(tmp_path, text="title: small\nmasses: other"))
    assert core.ran == list("abcd") and "analysis checksum" in summary.notes[0] and "afresh" in summary.notes[0]


HEADS = ("title: other", "title: small\ndocument: {client: Another}", "# a comment\ntitle: small")


@pytest.mark.parametrize("text", HEADS)
def test_an_interrupted_run_goes_on_under_another_title(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    use(monkeypatch, Core({("c", 5): interrupt}))
    with pytest.raises(Interrupted):
        run_project(project(tmp_path))
    core = use(monkeypatch, Core())
    run_project(project(tmp_path, text=text), overwrite=True)  # without `source_file` the title says whose it is
    assert core.ran == list("cd")


@pytest.mark.parametrize("text", HEADS)
def test_another_head_runs_nothing_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    use(monkeypatch, Core())
    run_project(project(tmp_path))
    before = results(tmp_path / "small.h5")
    core = use(monkeypatch, Core())
    reported: list[Progress] = []
    summary = run_project(project(tmp_path, text=text), progress=reported.append)
    assert core.ran == [] and all(outcome.reused for outcome in summary.outcomes) and len(summary.outcomes) == 4
    assert "head of small.h5 was renewed" in reported[0].message and summary.notes == (reported[0].message,)
    assert results(tmp_path / "small.h5") == before and not partial_path(tmp_path / "small.h5").exists()
    with open_archive(tmp_path / "small.h5") as archive:
        assert str(archive.group().variables["project_text"].values) == text
        assert archive.complete and not archive.damage and "head_renewed" in archive.group_attributes("provenance")

    same = use(monkeypatch, Core())  # the same again is what the user wants to run again
    run_project(project(tmp_path, text=text))
    fresh = use(monkeypatch, Core())
    run_project(project(tmp_path, text="title: third"), fresh=True)
    changed = use(monkeypatch, Core())
    run_project(project(tmp_path, text="title: third\nloads: other"))
    assert same.ran == fresh.ran == changed.ran == list("abcd")


def test_a_failed_run_is_run_again_under_another_head(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core({("b", 1): fail}))
    assert run_project(project(tmp_path)).failed
    core = use(monkeypatch, Core())
    assert not run_project(project(tmp_path, text=HEADS[1])).failed
    assert core.ran == list("abcd")


def test_fresh_reuses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core({("c", 5): interrupt}))
    with pytest.raises(Interrupted):
        run_project(project(tmp_path))
    core = use(monkeypatch, Core())
    run_project(project(tmp_path), fresh=True)
    assert core.ran == list("abcd")


def test_results_do_not_depend_on_the_number_of_workers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core())
    one = run_project(project(tmp_path), tmp_path / "1.h5", workers=1)
    three = run_project(project(tmp_path), tmp_path / "3.h5", workers=3)
    assert results(one.archive) == results(three.archive) and list(results(three.archive)) == list("abcd")


def test_only_selects_and_spares_the_full_archive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core())
    full = run_project(project(tmp_path)).archive.read_bytes()
    core = use(monkeypatch, Core())
    summary = run_project(project(tmp_path), only=["c"])
    assert core.ran == ["c"] and summary.archive == tmp_path / "small.c.h5"
    assert (tmp_path / "small.h5").read_bytes() == full
    with pytest.raises(InputError, match="'x' .*: a, b, c, d.*E-NAME-01"):
        run_project(project(tmp_path), only=["x"])


@pytest.mark.parametrize("workers", [1, 2])
def test_a_disk_that_fills_up_stops_the_run_and_keeps_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: int
) -> None:
    from edesign.archive.pieces import PieceFile

    use(monkeypatch, Core())
    append, calls = PieceFile.append, []

    def full(self: PieceFile, images: Mapping[str, bytes]) -> None:
        calls.append(1)
        if len(calls) == 3:  # the root, the first analysis, then no more
            raise OSError(28, "No space left on device")
        append(self, images)

    monkeypatch.setattr(PieceFile, "append", full)
    with pytest.raises(ArchiveError, match=r"small\.h5: .* the disk is full.*E-FILE-06"):
        run_project(project(tmp_path), workers=workers)
    assert not (tmp_path / "small.h5").exists()
    assert len(results(partial_path(tmp_path / "small.h5"))) == 1


def test_an_unwritable_archive_is_an_error_before_anything_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    core = use(monkeypatch, Core())
    with pytest.raises(ArchiveError, match="nowhere .*E-FILE-06"):
        run_project(project(tmp_path), tmp_path / "nowhere" / "a.h5")
    assert core.ran == []


def test_progress_reports_every_analysis_from_start_to_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, Core({("b", 7): fail}))
    reports: list[Progress] = []
    run_project(project(tmp_path, "ab"), progress=reports.append)
    assert [r.event for r in reports if r.analysis == "a"] == ["start"] + ["advance"] * STEPS + ["end"]
    assert reports[-1].message == "failed: step 7 at 0.07 s: no convergence [E-CORE-08]" and (
        reports[-1].index,
        reports[-1].count,
    ) == (2, 2)
    fractions = [r.fraction for r in reports if r.event == "advance" and r.analysis == "a"]
    np.testing.assert_allclose(fractions, np.arange(1, STEPS + 1) / STEPS, rtol=1e-15)


def test_the_run_works_outside_the_main_thread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Signal handlers can only be set in the main thread; a notebook server may run elsewhere."""
    use(monkeypatch, Core())
    done: list[Path] = []
    thread = threading.Thread(target=lambda: done.append(run_project(project(tmp_path)).archive))
    thread.start()
    thread.join(30)
    assert done == [tmp_path / "small.h5"]


def test_a_partial_file_that_is_deleted_meanwhile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    partial = partial_path(tmp_path / "small.h5")
    use(monkeypatch, Core({("b", 5): partial.unlink}))
    summary = run_project(project(tmp_path, "abc"))
    assert summary.notes == ("small.h5.partial was deleted during the run, and was written again",)
    assert list(results(summary.archive)) == list("abc") and not partial.exists()


def test_another_partial_file_in_its_place_meanwhile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message says where the analyses of this run are."""
    partial = partial_path(tmp_path / "small.h5")

    def replaced() -> None:
        partial.unlink()
        partial.write_bytes(b"other")

    use(monkeypatch, Core({("b", 5): replaced}))
    with pytest.raises(ArchiveError) as raised:
        run_project(project(tmp_path, "abc"))
    kept = tmp_path / "small.h5.1.partial"
    said = str(raised.value)
    assert says(said, f"{partial}: 1 of 3 {kept} E-ARCH-06") and said.count("[E-") == 1
    assert partial.read_bytes() == b"other" and list(results(kept)) == ["a", "b"]
