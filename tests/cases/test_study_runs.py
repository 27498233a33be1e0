"""`edesign run study.yaml` as a user calls it: designs, histories, interruptions anywhere, failures, back ends."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases.small_frame import command, edesign, environment, place_of
from cases.small_frame import write as write_project
from cases.small_study import PLANNED, SUITE, write
from limited import limited

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.cli.main import main
from edesign.errors import AnalysisError, InputError, Interrupted
from edesign.frame.project_file import load_study
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.ground_motion.response_spectrum import psa
from edesign.report.archive.summary import summarise
from edesign.study.run import run as runs
from edesign.study.run import study_designs
from edesign.study.run.backends.call import Call, Control, Result, Results
from edesign.study.run.backends.serial import SerialBackend
from edesign.study.run.progress import Progress
from edesign.study.run.run import run_study

UNREACHABLE = ("damping: 4 %", "damping: 30 %")
HOPELESS = ("levels: DBE, most: 2 %", "levels: DBE, most: 0.1 %")


def everything(path: Path) -> dict[str, Any]:
    """All that is in an archive but the group `provenance` and times: values as bytes, attributes as they are."""
    with open_archive(path) as archive:
        found: dict[str, Any] = {}
        for place in ["/", *_places(archive, "")]:
            if place == "provenance":
                continue
            group = archive.group(place)
            for name, variable in (group.coords | group.variables).items():
                values = np.asarray(variable.values)
                content = values.tolist() if values.dtype.kind in "OUS" else (values.dtype.str, values.tobytes())
                found[f"{place}:{name}"] = (variable.dims, variable.unit, variable.long_name, content)
            found[place] = _timeless(group)
        return found


def _places(archive: Archive, parent: str) -> Iterator[str]:
    for name in archive.names(parent or "/"):
        place = f"{parent}/{name}".lstrip("/")
        yield place
        yield from _places(archive, place)


def _timeless(group: Group) -> dict[str, Any]:
    statistics = group.attributes.get("statistics")
    if not isinstance(statistics, dict):
        return dict(group.attributes)
    return {**group.attributes, "statistics": {key: value for key, value in statistics.items() if key != "cpu_s"}}


def same(first: dict[str, Any], other: Path) -> None:
    """An archive holds the same to the last bit."""
    second = everything(other)
    assert list(first) == list(second)
    for name, content in first.items():
        assert repr(content) == repr(second[name]), name  # nan is nan


def statuses(path: Path) -> dict[str, str]:
    """Status of each analysis of a plan, as `edesign show --json` prints it."""
    return {item["name"]: item["status"] for item in summarise(path)["analyses"]}


@dataclass(frozen=True)
class CommandResult:
    """What a call of the command line came to."""

    code: int
    out: str
    err: str


Caller = Callable[..., CommandResult]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Caller:
    """The command line in this process, which spares the start of another."""

    def run(*words: str | Path) -> CommandResult:
        capsys.readouterr()
        code = main([str(word) for word in words])
        return CommandResult(code, *capsys.readouterr())

    return run


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("study"))


@pytest.fixture(scope="module")
def reported(study: Path) -> subprocess.CompletedProcess[str]:
    """The run that is not disturbed."""
    return edesign("run", study)


@pytest.fixture(scope="module")
def archive(study: Path, reported: subprocess.CompletedProcess[str]) -> Path:
    assert reported.returncode == 0, reported.stderr
    return study.parent / "out.h5"


@pytest.fixture(scope="module")
def whole(archive: Path) -> str:
    """All that the command prints of the archive."""
    return edesign("show", archive, "--all").stdout


@pytest.fixture(scope="module")
def undisturbed(archive: Path) -> dict[str, Any]:
    """Everything in the archive of that run."""
    return everything(archive)


def test_a_run_makes_designs_and_histories_and_judges_them(
    reported: subprocess.CompletedProcess[str], archive: Path, whole: str
) -> None:
    lines = reported.stderr.splitlines()
    first = next(at for at, line in enumerate(lines) if line.startswith("[1/29] bare.modes: completed"))
    rounds = [at for at, line in enumerate(lines) if line.startswith("design added: round 1 of at most ")]
    assert rounds[0] < first and lines[rounds[0]].endswith(", target damping 4 %")
    assert f"[{PLANNED}/{PLANNED}] damped.35C.DBE.first: completed" in reported.stderr
    assert "Traceback" not in reported.stderr and not archive.with_name("out.h5.partial").exists()
    for title in ("Verdicts", "What governs", "analyses  ", "All tables"):
        assert title in reported.stdout
    assert max(map(len, reported.stdout.splitlines()[3:-2])) <= 80  # all but paths
    for title in ("Mean response", "Design added: strain energy", "Criteria", "Rehabilitation objectives", "Analyses"):
        assert title in whole
    with open_archive(archive) as opened:
        assert opened.attributes["status"] == "completed" and opened.attributes["kind"] == "study"
        assert len(opened.names("analyses")) == PLANNED and opened.names("designs") == ["added"]
        design = opened.group("designs/added")
        groups = {name: opened.group(f"analyses/{name}") for name in opened.names("analyses")}
    met, target = (design.variables[name].values for name in ("round_met", "round_target"))
    assert 1 < met.size <= 6 and met[0] == 0 and 1 in met
    chosen = int(design.attributes["chosen_round"]) - 1
    assert target[chosen] == min(target[met == 1])  # the smallest damping that meets the criterion
    drifts = [_drift(groups[f"damped.DBE.{name}"]) for name in ("first", "second", "third")]
    assert np.mean(drifts) <= 0.02 < np.mean([_drift(groups[f"bare.DBE.{name}"]) for name in ("first", "second")])
    judged = design.variables["verdict_value"].values[chosen, 0]
    assert judged == pytest.approx(np.mean(drifts), rel=1e-12)  # rounds are judged by the histories of the study


def _drift(group: Group) -> float:
    return float(max(np.max(np.abs(group.variables[f"storey_drift_{end}"].values)) for end in ("max", "min")))


def test_a_variant_and_a_history_at_a_temperature_are_the_same(archive: Path) -> None:
    with open_archive(archive) as opened:
        warm, history = (opened.group(f"analyses/{name}") for name in ("warm.DBE.first", "damped.35C.DBE.first"))
        own = opened.group("analyses/damped.DBE.first")
    assert warm.variables["storey_drift_max"].values.tobytes() == history.variables["storey_drift_max"].values.tobytes()
    assert own.variables["storey_drift_max"].values.tobytes() != warm.variables["storey_drift_max"].values.tobytes()
    assert (history.attributes["variant"], history.attributes["temperature_C"]) == ("damped", 35.0)


def test_the_mean_spectrum_is_checked_at_the_period_of_every_variant(
    reported: subprocess.CompletedProcess[str], archive: Path, whole: str
) -> None:
    """EN 1998-1, 3.2.3.1.2(4)c. T1 is that of the modal analysis of the variant; the ratio is computed here anew."""
    with open_archive(archive) as opened:
        suite = opened.group("records/set")
        members = [opened.group(f"records/set/{name}") for name in opened.names("records/set")]
        periods = {
            name: float(opened.group(f"analyses/{name}.modes").variables["period"].values[0])
            for name in ("bare", "damped", "upper", "warm")
        }
        target = elastic_spectrum(load_study(archive.parent / "study.yaml").base.hazard)
    names = {"bare": "bare frame", "damped": "damped", "upper": "upper", "warm": "warm, damped at 35 degC"}
    found = {c["text"]: c for c in suite.attributes["criteria"] if c["clause"] == "3.2.3.1.2(4)c"}
    assert len(found) == 5  # and damped at 10 degC
    for name, period in periods.items():
        grid = np.geomspace(0.2 * period, 2.0 * period, 201)
        spectra = []
        for member in members:
            samples = member.variables["matched_acceleration"].values
            step = float(np.diff(member.coords["matched_time"].values[:2])[0])
            spectra.append(psa(samples, step, grid, 0.05))
        ratio = float(np.min(np.mean(spectra, axis=0) / target.acceleration(grid)))
        text = f"from {0.2 * period:.3g} s to {2.0 * period:.3g} s (0.2 T_1 to 2 T_1), {names[name]}"
        (one,) = (c for key, c in found.items() if key.endswith(text))
        assert one["value"] == pytest.approx(ratio, rel=1e-6) and one["passed"] is (ratio >= 0.9)
        said = f"records set: not met: 3.2.3.1.2(4)c, {one['text']}: {ratio:.3g}, required 0.9"
        assert (said in reported.stderr) is not one["passed"] and one["text"][:50] in whole
    assert {c["passed"] for c in found.values()} == {True, False}  # the shortest period passes, that of the bare fails


def test_scaling_beyond_the_usual_is_reported_by_run_and_archive(
    reported: subprocess.CompletedProcess[str], archive: Path, whole: str
) -> None:
    """The factors at the MCE are match_scale (1.54 to 1.59) times suite_factor (1.5) times gamma_I (1.71): above 3."""
    with open_archive(archive) as opened:
        (said,) = opened.group_attributes("records/set")["warnings"]
        of = {name: opened.group_attributes(f"records/set/{name}") for name in opened.names("records/set")}
        level = opened.group_attributes("analyses/bare.MCE.first")["scale_factor"]
    assert said.startswith("MCE: 3 of 3 records are scaled beyond the usual 1/3 to 3 (FEMA P-751, 3.3.1.4): ")
    for name, about in of.items():
        assert f"{name} by {about['match_scale'] * about['suite_factor'] * level:.3g}" in said
    assert f"records set: {said}" in reported.stderr and f"set: {said}" in " ".join(whole.split())


def test_details_are_kept_of_the_records_that_are_named(archive: Path) -> None:
    with open_archive(archive) as opened:
        whole, plain = (opened.group(f"analyses/damped.DBE.{name}").variables for name in ("first", "second"))
    kept = {"damper_force", "energy", "storey_shear", "member_bending_moment"}
    assert kept <= set(whole) and not kept & set(plain) and "floor_displacement" in plain
    assert whole["floor_displacement"].values.shape[0] == (500 + 1) // 2  # every second of 0 to 4.98 s in 0.01 s


def test_check_reports_what_a_run_would_do(study: Path, call: Caller) -> None:
    checked = call("check", study)
    assert checked.code == 0 and checked.out.endswith("ok, with 8 warnings\n") and checked.err == ""
    assert "design added, first round: the dampers reach 5" in checked.out  # thin layers; the design counts on 20 %
    for text in ("designs: added (strain_energy)", "variants: bare, damped, upper, warm", "bare.DBE (3)"):
        assert text in " ".join(checked.out.split())
    assert "records:    set (3 from files)" in checked.out and "variant warm: damper law rubber" in checked.out


def test_show_prints_the_same_as_the_run(
    reported: subprocess.CompletedProcess[str], archive: Path, call: Caller
) -> None:
    shown = call("show", archive)
    lines = reported.stdout.splitlines()
    assert shown.code == 0 and shown.out.splitlines()[2:] == lines[2:-1]  # all but the path and the time
    assert "of which had no room here: edesign show" in " ".join(shown.out.split())
    assert "\nWhat governs\n" in shown.out and "\nUse of members under" in shown.out
    whole = call("show", archive, "--all")
    assert "diff. of damped at 35 degC, DBE: over the 1 record that bare, DBE has too" in whole.out
    assert set(statuses(archive).values()) == {"completed"} and len(statuses(archive)) == PLANNED


def test_a_part_of_the_plan_goes_into_its_own_archive(
    study: Path, undisturbed: dict[str, Any], tmp_path: Path, call: Caller
) -> None:
    """Without the design, which bare frames do not need; the same to the last bit."""
    folder = tmp_path / "part"
    shutil.copytree(study.parent, folder, ignore=shutil.ignore_patterns("*.h5*"))
    part_run = call("run", folder / "study.yaml", "--only", "bare.DBE")
    assert part_run.code == 0 and "design" not in part_run.err and not (folder / "out.h5").exists()
    part, full = everything(folder / "out.bare.DBE.h5"), undisturbed
    names = [name for name in part if name.startswith("analyses/") and ":" not in name]
    assert names == [f"analyses/bare.DBE.{name}" for name in ("first", "second", "third")]
    assert all(repr(part[name]) == repr(full[name]) for name in part if name.startswith("analyses/"))


KILLED = """\
import os, signal, sys
from edesign.frame.project_file import load_study
from edesign.study.run.run import run_study

event, words = sys.argv[2], sys.argv[3]

def listen(report):
    if report.event == event and words in (report.analysis or report.message):
        os.kill(os.getpid(), signal.SIGKILL)

run_study(load_study(sys.argv[1]), progress=listen)
"""


@pytest.mark.parametrize(
    ("event", "words", "finished", "rounds"),
    [
        ("note", "round 3", 0, 2),
        pytest.param("start", "added.2.DBE.set/third", 0, 1, marks=pytest.mark.slow),
        pytest.param("end", "damped.MCE.second", 19, 0, marks=pytest.mark.slow),
    ],
)
def test_a_killed_run_goes_on_where_it_was(
    tmp_path: Path, undisturbed: dict[str, Any], call: Caller, event: str, words: str, finished: int, rounds: int
) -> None:
    """Killed during the rounds of the design, and during the histories."""
    path = write(tmp_path)
    killed = subprocess.run(
        [sys.executable, "-c", KILLED, str(path), event, words], check=False, env=environment(), timeout=60
    )
    assert killed.returncode == -signal.SIGKILL
    partial = tmp_path / "out.h5.partial"
    with open_archive(partial) as opened:
        assert not opened.complete and len(opened.names("analyses")) == finished
        assert opened.group_attributes("designs/added")["status"] == ("interrupted" if rounds else "completed")
    again = call("run", path)
    assert again.code == 0, again.err
    reused = f"continuing an interrupted run: {finished} of {PLANNED} analyses are reused, with designs/added"
    assert reused in again.err and not partial.exists()
    for number in range(1, rounds + 1):
        assert f"design added: round {number} is already there" in again.err
        assert f"added.{number}.DBE" not in again.err  # its histories are not computed again
    assert (f"design added: round {rounds + 1} of at most " in again.err) == bool(rounds)
    same(undisturbed, tmp_path / "out.h5")


@pytest.mark.slow
def test_ctrl_c_in_the_rounds_of_a_design_keeps_them(tmp_path: Path, call: Caller) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")
    process = subprocess.Popen(
        command("run", path), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment()
    )
    assert process.stderr is not None
    with limited(process):
        for line in process.stderr:
            if line.startswith("design added: round 2"):
                process.send_signal(signal.SIGINT)
                break
        _, errors = process.communicate(timeout=30)
    partial = tmp_path / "out.h5.partial"
    assert process.returncode == 130 and "Traceback" not in errors, errors
    assert "analyses are finished, with designs/added, and kept in " in errors and str(partial) in errors
    shown = call("show", partial)
    assert shown.code == 0 and "not complete" in shown.out
    path.write_text(text.replace("damping: 4 %", "damping: 4.5 %"), encoding="utf-8")
    other = call("run", path, "--only", "bare.gravity", "--archive", tmp_path / "out.h5")
    assert other.code == 0 and "not used (analysis checksum differs)" in other.err


@pytest.mark.slow
@pytest.mark.parametrize("how", [("threads", 2), ("dask", 2)])
def test_back_ends_give_the_same_bits(tmp_path: Path, undisturbed: dict[str, Any], how: tuple[str, int]) -> None:
    name, workers = how
    if name == "dask":
        pytest.importorskip("distributed")
        pytest.importorskip("cryptography")
    path = write(tmp_path)
    call = edesign("run", path, "--backend", name, "--workers", str(workers), "--quiet")
    assert call.returncode == 0 and call.stdout == call.stderr == ""
    same(undisturbed, tmp_path / "out.h5")


def test_a_design_that_cannot_be_ends_with_its_reason_and_the_rest_is_there(tmp_path: Path, call: Caller) -> None:
    ended = call("run", write(tmp_path, HOPELESS, ("rounds: 6", "rounds: 2")))
    assert ended.code == 3
    reason = "its design `added` failed: not met within 2 rounds; the last, with 0.064, misses: drift, DBE (2."
    (line,) = [line for line in ended.err.splitlines() if line.startswith("  damped.modes, ")]
    assert f"damped.modes, damped.gravity, upper.modes, upper.gravity and 17 more: {reason}" in line  # printed once
    found = statuses(tmp_path / "out.h5")
    assert all((status == "completed") == name.startswith("bare") for name, status in found.items())
    with open_archive(tmp_path / "out.h5") as opened:
        design = opened.group("designs/added")
        assert opened.attributes["status"] == "failed"
        assert opened.group_attributes("analyses/upper.MCE.first")["reason"].startswith(reason)
    assert design.attributes["status"] == "failed" and design.variables["round_met"].values.tolist() == [0, 0]
    assert "failed: not met within 2 rounds" in call("show", tmp_path / "out.h5", "--all").out


def test_a_target_no_damper_can_reach_is_reported_before_anything_is_run(tmp_path: Path, call: Caller) -> None:
    """Eq. 5.9: 2 zeta must be less than the loss factor; also behind a design whose rounds would come first."""
    path = write(tmp_path, UNREACHABLE)
    for name in ("check", "run"):
        reported = call(name, path)
        assert reported.code == 2 and reported.err.startswith(f"edesign: {place_of(path, 'method')}: ")
        assert all(part in reported.err for part in ("designs.added: ", " 30 % ", "E-DESIGN-04"))
        assert "matching" not in reported.err and not list(tmp_path.glob("out.h5*"))
    assert call("run", path, "--only", "bare.DBE", "--quiet").code == 0  # which needs no design


@pytest.mark.slow
def test_histories_that_collapse_are_missing_in_every_mean(tmp_path: Path, call: Caller) -> None:
    """The limit lies between the drifts of the bare frame at the MCE, so that some records end in collapse."""
    path = write(tmp_path, ("records: set, free_vibration: 1 s}", "records: set, collapse_drift: 5 %}"))
    ended = call("run", path)
    assert ended.code == 3
    found = statuses(tmp_path / "out.h5")
    failed = [name for name, status in found.items() if status == "failed"]
    assert failed and len(failed) < 3 and all(name.startswith("bare.MCE") for name in failed)
    assert set(found.values()) == {"completed", "failed"}
    for name in failed:
        assert f"{name}: collapsed: drift of storey 1 reached 5" in ended.err
    output = call("show", tmp_path / "out.h5", "--all").out
    missing = f"bare, MCE: failed, in no statistic ({len(failed)} of 3): {', '.join(failed)}"
    assert output.count(missing) >= 2  # of the mean and of the maximum
    assert f"bare, MCE: {3 - len(failed)} of 3" in output and "bare, DBE: 3 of 3" in output
    assert f"diff. of damped, MCE: over the {3 - len(failed)} record" in output


NAME = "RSN1_ONE.A_A-X180"


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """The study with its first recording below another folder, as the data base names it."""
    path = write(tmp_path)
    own = "file: first.csv, acceleration_unit: m/s^2"
    assert SUITE.count(own) == 1
    (tmp_path / "set.yaml").write_text(SUITE.replace(own, f"peer: {NAME}"), encoding="utf-8")
    deep = tmp_path / "mine" / "deep"
    deep.mkdir(parents=True)
    (tmp_path / "first.csv").rename(deep / f"{NAME}.time_acc.csv")
    return path


def test_recordings_in_other_folders(elsewhere: Path, call: Caller) -> None:
    words = ("run", elsewhere, "--only", "bare.DBE.first")
    missing = call(*words)
    tried = "[E-SUITE-05]\n    folders: none is given in which to look for"
    assert missing.code == 2 and f"{tried} {NAME}" in missing.err
    assert call(*words, "--folder", elsewhere.parent / "mine", "--quiet").code == 0
    with open_archive(elsewhere.parent / "out.bare.DBE.first.h5") as opened:
        group = opened.group("records/set/first")
    assert group.attributes["origin"] == "file" and group.variables["acceleration"].values.size == 200


def test_folders_that_are_wrong(elsewhere: Path, call: Caller) -> None:
    folder = elsewhere.parent
    (folder / "empty").mkdir()
    for place, said in (
        (folder / "mien", f"--folder: there is no folder {folder / 'mien'}"),
        (elsewhere, f"--folder: there is no folder {elsewhere}"),
        (folder / "empty", f"folders: no {NAME}.AT2 in {folder / 'empty'}"),
    ):
        reported = call("run", elsewhere, "--folder", place)
        assert reported.code == 2 and said in reported.err
    other = folder / "other"
    other.mkdir()
    reported = call("run", write_project(other), "--folder", folder / "mine")
    assert (
        reported.code == 2 and f"--folder: {other / 'project.yaml'} " in reported.err and "E-SUITE-11" in reported.err
    )
    assert not list(folder.rglob("*.h5*"))


class Losing(SerialBackend):
    """A back end that is lost when it has given a number of results."""

    def __init__(self, after: int, error: Exception) -> None:
        self.left, self.error = after, error

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        for result in super().results(calls, control, started):
            if not self.left:
                raise self.error
            self.left -= 1
            yield result


@pytest.mark.slow
@pytest.mark.parametrize(
    ("results", "finished", "error"),
    [
        (0, None, InputError("a worker is a stranger [E-CLUSTER-02]")),
        (4, 0, AnalysisError("the scheduler was lost [E-CLUSTER-01]")),
        (25, 7, AnalysisError("the scheduler was lost [E-CLUSTER-01]")),
    ],
)
def test_a_back_end_that_is_lost_takes_nothing_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, results: int, finished: int | None, error: Exception
) -> None:
    """Before the first round of the design is judged, in the second round, and during the histories."""
    path = write(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(runs, "make_backend", lambda *_: Losing(results, type(error)(str(error))))
        with pytest.raises(type(error)) as caught:
            run_study(load_study(path))
    partial = tmp_path / "out.h5.partial"
    assert partial.exists() == (finished is not None) and not (tmp_path / "out.h5").exists()
    if finished is None:
        assert str(caught.value) == str(error)
        return
    kept = f"{finished} of {PLANNED} analyses are finished, with designs/added, and kept in {partial}"
    assert str(caught.value) == f"the scheduler was lost; {kept} [E-CLUSTER-01]"
    summary = run_study(load_study(path))
    assert not summary.failed and len([item for item in summary.outcomes if item.reused]) == finished


class Failing(SerialBackend):
    """A back end whose process dies over one history of the first round, and over none later."""

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        for result in super().results(calls, control, started):
            dead = result.key == "added.1.DBE.set/second"
            yield Result(result.key, reason="not enough memory") if dead else result


@pytest.mark.slow
def test_a_history_that_fails_in_a_round_is_missing_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A mean over the two others would meet this limit; with one missing it cannot be met."""
    path = write(tmp_path, ("levels: DBE, most: 2 %", "levels: DBE, most: 5 %"))
    monkeypatch.setattr(runs, "make_backend", lambda *_: Failing())
    assert not run_study(load_study(path)).failed
    with open_archive(tmp_path / "out.h5") as opened:
        design = opened.group("designs/added")
    assert design.variables["round_failed_histories"].values.tolist()[:2] == [1, 0]
    assert design.variables["round_met"].values.tolist()[:2] == [0, 1]
    assert design.attributes["failed_histories"] == {"1": ["added.1.DBE.set/second"]}


@pytest.mark.slow
def test_a_law_file_that_changed_makes_a_run_start_afresh(tmp_path: Path) -> None:
    """What an interrupted run left belongs to the other law."""
    own = (
        "      type: mgmm\n      parameters: thesis_table_4_2\n"
        "      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"
    )
    path = write(tmp_path, project=((own, "      file: law.yaml\n"),))
    law = (
        "type: mgmm\nparameters: thesis_table_4_2\nprototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: %s}"
    )

    def listen(report: Progress) -> None:
        if report.event == "end" and report.analysis == "damped.DBE.first":
            raise KeyboardInterrupt

    (tmp_path / "law.yaml").write_text(law % "12 mm", encoding="utf-8")
    with pytest.raises(Interrupted, match=f"15 of {PLANNED} analyses are finished, with designs/added, and kept in"):
        run_study(load_study(path), progress=listen)
    (tmp_path / "law.yaml").write_text(law % "13 mm", encoding="utf-8")
    summary = run_study(load_study(path))
    assert not any(item.reused for item in summary.outcomes)
    assert "not used (analysis checksum differs); starting afresh" in summary.notes[0]


@pytest.mark.slow
def test_a_stop_between_two_designs_starts_nothing_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first is kept, and the run that goes on makes the second."""
    second = (
        "  second:\n    {method: strain_energy, law: rubber, kind: chevron, bays: all, damping: 4 %, strain: 20 %, "
        "layer_thickness: 12 mm}\nvariants:\n  more: {design: second}\n  bare"
    )
    path = write(tmp_path, ("variants:\n  bare", second))
    begun: list[str] = []
    make = study_designs.run_design

    def stop_after(*arguments: Any) -> Any:
        result = make(*arguments)
        os.kill(os.getpid(), signal.SIGINT)
        return result

    with monkeypatch.context() as patched:
        patched.setattr(study_designs, "run_design", stop_after)
        with pytest.raises(Interrupted, match="0 of 31 analyses are finished, with designs/added, and kept in"):
            run_study(load_study(path), progress=lambda report: begun.append(report.analysis))
    assert not any(name.startswith(("bare", "more")) for name in begun)
    summary = run_study(load_study(path))
    assert not summary.failed and len(summary.outcomes) == PLANNED + 2
    with open_archive(tmp_path / "out.h5") as opened:
        assert opened.names("designs") == ["added", "second"]
