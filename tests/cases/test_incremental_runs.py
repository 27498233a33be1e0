"""Runs of incremental studies: collapse ends a chain, nothing finished is lost, and the order changes nothing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cases.incremental_portal import LEVELS, histories, same, study, write
from cases.small_frame import environment

from edesign.archive.reader import open_archive
from edesign.assess.incremental import collect_stripes
from edesign.cli.main import main
from edesign.errors import AnalysisError, Interrupted
from edesign.frame.project_file import load_study
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.archive.study_tables import plan_table, study_tables
from edesign.report.capacity.incremental_figures import incremental_figures
from edesign.report.capacity.incremental_tables import incremental_tables
from edesign.study.run import analyses
from edesign.study.run.progress import Progress
from edesign.study.run.run import RunSummary, run_study

DRIFT = "interstorey_drift"


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> RunSummary:
    """One after the other, without interruption."""
    return run_study(study(tmp_path_factory.mktemp("ida")), backend="serial")


def fallen(summary: RunSummary) -> int:
    """The step at which both chains collapse."""
    found = next(i for i, level in enumerate(LEVELS) if _state(summary, f"bare.ida.shake.{level}") == "collapsed")
    assert 1 <= found <= 3, "the frame stands at the lowest intensity and falls before the last but one"
    return found


def _state(summary: RunSummary, name: str) -> str:
    return next(outcome.status for outcome in summary.outcomes if outcome.name == name)


def equal(one: Path, other: Path) -> bool:
    a, b = histories(one), histories(other)
    return list(a) == list(b) and all(same(a[name], b[name]) for name in a)


def stop_at(name: str, how: signal.Signals = signal.SIGINT, event: str = "start") -> Callable[[Progress], None]:
    """A listener that interrupts the run when an analysis begins, or ends."""

    def listen(report: Progress) -> None:
        if report.event == event and report.analysis == name:
            os.kill(os.getpid(), how)

    return listen


def test_collapse_ends_a_chain_and_is_no_failure(done: RunSummary) -> None:
    """Under gravity the yielding portal falls; at lower intensities it stands, and higher ones are not run."""
    first = fallen(done)
    groups = histories(done.archive)
    assert list(groups) == [f"{variant}.ida.shake.{level}" for variant in ("bare", "same") for level in LEVELS]
    states = [str(group.attributes["status"]) for group in groups.values()]
    assert states == 2 * (["completed"] * first + ["collapsed"] + ["skipped"] * (5 - first))
    assert [outcome.status for outcome in done.outcomes[4:]] == states
    assert done.failed == ()
    with open_archive(done.archive) as opened:
        assert opened.attributes["status"] == "completed"
    collapsed, skipped = list(groups.values())[first], list(groups.values())[5]
    assert collapsed.attributes["collapsed"] is True
    assert str(collapsed.attributes["reason"]).startswith("collapsed: drift of storey 1 reached 8")
    ends = [abs(collapsed.variables[f"storey_drift_{end}"].values[0]) for end in ("max", "min")]
    assert 0.08 < max(ends) < 0.09  # the step beyond the limit
    assert "residual_storey_drift" not in collapsed.variables
    assert skipped.attributes["reason"] == f"collapsed at {LEVELS[first]}" and not skipped.variables
    for group, level in zip(groups.values(), 2 * LEVELS, strict=True):
        assert group.attributes["intensity"] == pytest.approx(float(level[:-1]) * STANDARD_GRAVITY, rel=1e-15)
        assert (group.attributes["record"], group.attributes["kind"]) == ("shake", "history")
        assert "time" not in group.coords, "nothing over time is kept"
    values = collect_stripes(groups, "ida", "same", (DRIFT,))[DRIFT].values[0]
    assert np.isfinite(values[:first]).all() and np.isinf(values[first:]).all()


def test_the_order_changes_nothing(done: RunSummary, tmp_path: Path) -> None:
    """Two threads, in which chains overtake each other, and one variant alone: the same bits."""
    assert equal(done.archive, run_study(study(tmp_path), workers=2).archive)
    alone = histories(run_study(study(tmp_path), only=["same.ida"], workers=2).archive)
    assert list(alone) == [f"same.ida.shake.{level}" for level in LEVELS]
    full = histories(done.archive)
    assert all(
        np.array_equal(variable.values, full[name].variables[key].values)
        for name, group in alone.items()
        for key, variable in group.variables.items()
    )


@pytest.mark.parametrize("workers", [1, 2])
def test_a_stop_keeps_what_was_finished_and_the_next_run_goes_on(
    done: RunSummary, tmp_path: Path, workers: int
) -> None:
    """The run ends after the collapse of one chain: it is not computed again, and the archive is that of one run."""
    shaken, at = study(tmp_path), f"same.ida.shake.{LEVELS[fallen(done)]}"
    with pytest.raises(Interrupted):
        run_study(shaken, progress=stop_at(at), backend="serial")
    begun: list[str] = []

    def listen(report: Progress) -> None:
        if report.event == "start":
            begun.append(report.analysis)

    again = run_study(shaken, progress=listen, workers=workers)
    assert begun == [at], "of what is left only the history that was interrupted is computed"
    assert equal(done.archive, again.archive) and not again.failed
    reused = [outcome for outcome in again.outcomes if outcome.reused]
    assert [outcome.status for outcome in reused].count("collapsed") == 1
    assert {outcome.name: outcome.reason for outcome in again.outcomes} == {
        outcome.name: outcome.reason for outcome in done.outcomes
    }


def test_a_kill_loses_nothing_that_was_finished(done: RunSummary, tmp_path: Path) -> None:
    at = f"same.ida.shake.{LEVELS[fallen(done)]}"
    call = (
        "import signal; from pathlib import Path; from cases.test_incremental_runs import stop_at, study, run_study; "
        f"run_study(study(Path({str(tmp_path)!r})), progress=stop_at({at!r}, signal.SIGKILL), backend='serial')"
    )
    tests = str(Path(__file__).parents[1])
    path = os.pathsep.join([environment()["PYTHONPATH"], tests])
    killed = subprocess.run([sys.executable, "-c", call], env=environment() | {"PYTHONPATH": path}, check=False)
    assert killed.returncode == -signal.SIGKILL
    expected = list(histories(done.archive))
    finished = histories(tmp_path / "out.h5.partial")
    assert set(finished) == set(expected[: fallen(done) + 1] + expected[6 : 6 + fallen(done)])
    again = run_study(load_study(tmp_path / "study.yaml"), backend="serial")
    assert equal(done.archive, again.archive)
    assert sum(outcome.reused for outcome in again.outcomes) == 4 + len(finished)


@pytest.mark.slow
def test_a_failure_without_collapse_does_not_end_a_chain(
    done: RunSummary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What failed is tried again after an interruption; if it collapses then, what was found above counts no more."""
    first = fallen(done)
    failing, above = f"bare.ida.shake.{LEVELS[first]}", f"bare.ida.shake.{LEVELS[first + 1]}"
    true = analyses.run_analysis

    def run(project: object, spec: object, **more: object) -> object:
        if getattr(spec, "name", "") == failing:
            raise AnalysisError("out of order [E-CORE-12]")
        return true(project, spec, **more)  # type: ignore[arg-type]

    shaken = study(tmp_path)
    monkeypatch.setattr(analyses, "run_analysis", run)
    with pytest.raises(Interrupted):
        run_study(shaken, progress=stop_at(above, event="end"), backend="serial")
    summary = run_study(shaken, archive_path=tmp_path / "other.h5", backend="serial")
    assert [(outcome.name, outcome.reason) for outcome in summary.failed] == [(failing, "out of order [E-CORE-12]")]
    assert _state(summary, above) in ("completed", "collapsed")
    with open_archive(summary.archive) as opened:
        assert opened.attributes["status"] == "failed"
        assert f"{failing}: failed: out of order [E-CORE-12]" in plan_table(opened).notes
    monkeypatch.undo()
    assert histories(tmp_path / "out.h5.partial")[above].attributes["status"] != "skipped"
    assert equal(done.archive, run_study(shaken, backend="serial").archive)


def test_a_record_that_cannot_be_scaled_fails_with_its_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path, "variants: bare, records: [still, shake], intensity: pga, levels: [0.01 g, 0.02 g]")
    assert main(["run", str(path), "--quiet"]) == 3
    assert "2 of 8 analyses failed" in capsys.readouterr().err
    found = histories(tmp_path / "out.h5")
    assert [group.attributes["status"] for group in found.values()] == ["failed", "failed", "completed", "completed"]
    still = found["bare.ida.still.0.01g"].attributes
    assert str(still["reason"]).endswith("[E-IDA-01]")
    assert still["intensity"] == 0.01 * STANDARD_GRAVITY
    with open_archive(tmp_path / "out.h5") as opened:
        fragility = incremental_tables(opened)[0]
    assert "bare: 2 analyses without a result are left out" in fragility.notes


def test_tables_and_figures_of_the_archive(done: RunSummary) -> None:
    """One record has no dispersion; the study says so, and where limits are reached."""
    first = fallen(done)
    with open_archive(done.archive) as opened:
        table = plan_table(opened)
        rows = {row[0]: dict(zip(table.headers, row, strict=True)) for row in table.texts}
        assert list(rows) == ["bare.modes", "bare.gravity", "same.modes", "same.gravity", "bare.ida", "same.ida"]
        ida = rows["same.ida"]
        states = [ida[key] for key in ("planned", "completed", "collapsed", "skipped")]
        assert states == ["6", str(first), "1", str(5 - first)]
        # of the study nothing is to be reported; the columns, which are given by their A and I_y, are slender
        assert all("buckling" in note for note in table.notes)
        fragility, needed = study_tables(opened)[-2:]
        assert [row[:2] for row in fragility.texts] == [
            [variant, limit] for variant in ("bare", "same") for limit in ("LS", "collapse")
        ]
        assert fragility.headers[-1] == "theta / MCE"
        half_way = 0.5 * sum(float(LEVELS[i][:-1]) for i in (first - 1, first))
        assert needed.texts[1] == ["bare", "collapse", *3 * [f"{half_way:.3g}".ljust(4, "0")]]
        drawn = {name: figure for name, _, figure in incremental_figures(opened)}
    assert list(drawn) == ["incremental_ida_interstorey_drift", "fragility_ida"]
    assert drawn["incremental_ida_interstorey_drift"].axes[0].get_title("left") == "bare: 1 of 1 records collapse"


def test_while_a_run_goes_on_its_stripes_stand_together(done: RunSummary, tmp_path: Path) -> None:
    with pytest.raises(Interrupted):
        run_study(study(tmp_path), progress=stop_at(f"same.ida.shake.{LEVELS[0]}"), backend="serial")
    with open_archive(tmp_path / "out.h5.partial") as opened:
        table = plan_table(opened)
        assert [row[:3] for row in table.texts[4:]] == [["bare.ida", "6", "1"], ["same.ida", "6", "0"]]
        assert len(incremental_tables(opened)) == 2
