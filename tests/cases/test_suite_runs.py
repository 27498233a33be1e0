"""Projects under suites that are fitted to the spectrum: plan, archive, levels, criteria, mistakes."""

from __future__ import annotations

import csv
import os
import signal
from pathlib import Path

import numpy as np
import pytest
from cases import suite_project
from messages import says

from edesign import load_project
from edesign.archive.reader import Archive, open_archive
from edesign.cli.main import main
from edesign.errors import Interrupted
from edesign.ground_motion.intensity import displacement, velocity
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.study.run.progress import Progress
from edesign.study.run.run import run_project

A_G_S = 0.2 * STANDARD_GRAVITY * 1.2  # type 1, ground B, Table 3.2
GAMMA_MCE = (0.02 / 0.10) ** (-1 / 3)  # thesis Eq. 5.5


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("suite")
    assert main(["run", str(suite_project.write(folder)), "--quiet"]) == 0
    return folder / "project.h5"


def records(opened: Archive) -> dict[str, np.ndarray]:
    return {
        name: opened.group(f"records/set/{name}").variables["matched_acceleration"].values
        for name in opened.names("records/set")
    }


def test_a_history_of_a_suite_is_one_of_each_recording(archive: Path) -> None:
    with open_archive(archive) as opened:
        parts = [f"{level}.{name}" for level in ("dbe", "mce") for name in ("first", "second", "third")]
        assert opened.names("analyses") == ["modes", "push", *parts]
        attributes = opened.group_attributes("analyses/mce.second")
        assert attributes["record"] == "set/second" and attributes["level"] == "MCE"
        assert attributes["record_origin"] == "file" and attributes["match_method"] == "frequency"


def test_levels_scale_the_fitted_record_by_their_importance_factor(archive: Path) -> None:
    """The spectrum of the MCE is gamma_I times that of the DBE, and so is the record: fitted once."""
    with open_archive(archive) as opened:
        for name, fitted in records(opened).items():
            low, high = (opened.group(f"analyses/{level}.{name}") for level in ("dbe", "mce"))
            assert low.attributes["scale_factor"] == 1.0
            assert high.attributes["scale_factor"] == pytest.approx(GAMMA_MCE, rel=1e-12)
            for group, gamma in ((low, 1.0), (high, GAMMA_MCE)):
                applied = group.variables["ground_acceleration"].values
                assert applied == pytest.approx(gamma * fitted, rel=1e-12, abs=0.0)  # of one step: all samples


def test_original_and_fitted_record_are_archived_with_their_origin(archive: Path) -> None:
    with open_archive(archive) as opened:
        origins = {
            name: opened.group_attributes(f"records/set/{name}")["origin"] for name in opened.names("records/set")
        }
        assert origins == {"first": "file", "second": "file", "third": "simulated"}
        assert opened.group_attributes("records/set")["origins"] == {"file": 2, "simulated": 1}
        group = opened.group("records/set/first")
        with (archive.parent / "first.csv").open(encoding="ascii") as file:
            given = np.array([float(row["acceleration_m_s2"]) for row in csv.DictReader(file)])
        assert np.array_equal(group.variables["acceleration"].values, given)
        assert group.attributes["event"] == "One" and group.attributes["year"] == 2001
        assert group.attributes["misfit_after"]["rms"] < 0.1 * group.attributes["misfit_before"]["rms"]


@pytest.mark.slow
def test_show_draws_the_records_of_a_run(archive: Path, tmp_path: Path) -> None:
    assert main(["show", str(archive), "--figures", str(tmp_path), "--format", "png"]) == 0
    expected = {f"{name}.png" for name in ("set_before", "set_after", "set_mean", "first", "second", "third")}
    assert expected < {path.name for path in tmp_path.iterdir()}  # others are of the response


def test_fitted_records_end_at_rest(archive: Path) -> None:
    """1 mm/s and 1 mm: far below what the motion has (about 0.1 m/s); integrated here by the trapezoidal rule."""
    with open_archive(archive) as opened:
        for samples in records(opened).values():
            v = np.concatenate(([0.0], np.cumsum(0.5 * 0.01 * (samples[1:] + samples[:-1]))))
            assert abs(v[-1]) < 1e-3 and velocity(samples, 0.01) == pytest.approx(v, abs=1e-12)
            assert abs(displacement(samples, 0.01)[-1]) < 1e-3


def test_a_reversed_suite_is_fitted_alike(tmp_path: Path, archive: Path) -> None:
    """A fit does not depend on the sign of a motion: the ground goes to the other side, bit by bit."""
    written = "match: {method: frequency, periods: [0.1 s, 2 s]}}"
    turned = "processing: [{reverse: true}], match: {method: frequency, periods: [0.1 s, 2 s]}}"
    path = suite_project.write(tmp_path, (written, turned))
    assert main(["run", str(path), "--only", "dbe", "--quiet"]) == 0
    (run,) = tmp_path.glob("*.h5")
    with open_archive(archive) as one, open_archive(run) as other:
        for name, fitted in records(one).items():
            assert np.array_equal(records(other)[name], -fitted)
            motion = other.group(f"analyses/dbe.{name}")
            assert str(motion.attributes["record_source"]).endswith("; reversed")
            assert np.array_equal(motion.variables["ground_acceleration"].values, -fitted)


def test_the_mean_of_the_suite_satisfies_the_code(archive: Path) -> None:
    with open_archive(archive) as opened:
        attributes = opened.group_attributes("records/set")
        mean = np.mean([np.max(np.abs(samples)) for samples in records(opened).values()])
        assert mean >= A_G_S * (1 - 1e-9)
        verdicts = {criterion["clause"]: criterion for criterion in attributes["criteria"]}
        assert verdicts["3.2.3.1.2(4)a"]["passed"] is True and verdicts["3.2.3.1.2(4)a"]["value"] == 3
        assert verdicts["3.2.3.1.2(4)b"]["passed"] is True
        assert verdicts["3.2.3.1.2(4)b"]["value"] == pytest.approx(mean, rel=1e-12)
        assert verdicts["3.2.3.1.2(4)c"]["passed"] is True


def test_one_analysis_of_the_suite_gives_the_same_as_all(archive: Path, tmp_path: Path) -> None:
    """The common factor belongs to the whole suite, even where only one of its histories is asked for."""
    assert main(["run", str(suite_project.write(tmp_path)), "--quiet", "--only", "dbe.third"]) == 0
    with open_archive(archive) as full, open_archive(tmp_path / "project.dbe.third.h5") as one:
        assert one.names("analyses") == ["dbe.third"]
        first, second = (opened.group("analyses/dbe.third").variables["base_shear_max"] for opened in (full, one))
        assert first.values == second.values


def test_workers_do_not_change_the_results(archive: Path, tmp_path: Path) -> None:
    assert main(["run", str(suite_project.write(tmp_path)), "--quiet", "--workers", "2", "--only", "mce"]) == 0
    with open_archive(archive) as full, open_archive(tmp_path / "project.mce.h5") as again:
        assert len(again.names("analyses")) == 3
        first, second = records(full), records(again)
        assert all(np.array_equal(first[name], second[name]) for name in first)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("record: set, level: DBE", "record: set", "analyses[2].level E-KEY-02"),
        ("level: DBE}", "level: DBF}", "there is no level `DBF`; did you mean `DBE`?"),
        ("level: DBE}", "level: DBE, pga: 0.3 g}", "analyses[2].pga E-KEY-03"),
        ("suite: set.yaml", "suite: sets.yaml", "records.set.suite E-FILE-01"),
        ("suite: set.yaml", "suite: set.yaml, folders: [nowhere]", "records.set.folders[0] E-FILE-01"),
        ("suite: set.yaml", "suite: set.yaml, only: [frist]", "there is no recording `frist`; did you mean `first`?"),
        ("suite: set.yaml", "suite: set.yaml, simulated_records: false", "records.set third: E-SUITE-05"),
        ("[0.1 s, 2 s]", "[2 s, 0.1 s]", "records.set.match.periods E-VALUE-04"),
        ("[0.1 s, 2 s]", "[0.1 s, 30 s]", "records.set.match: second: 30 s E-MATCH-02"),
        ("[0.1 s, 2 s]", "[0.01 s, 2 s]", "records.set.match: third: 0.01 s E-MATCH-02"),
        ("spectrum: 1", "spectrum: 1\n  damping: 100 %", "hazard.damping E-VALUE-02"),
        ("suite: set.yaml", "suite: set.yaml, only: [first, first]", "records.set.only[1] E-NAME-02"),
        ("name: push,", "name: dbe.first,", "analyses[2].name: `dbe.first` `dbe` E-NAME-02"),
        ("suite: set.yaml", "suite: project.yaml", "edesign E-FILE-05"),
        ("method: frequency", "method: fourier", "records.set.match.method E-VALUE-03"),
        ("a_gR: 0.2 g", "country: greece, zone: 4", "hazard.zone"),
        (
            "kind: history, record: set, level: DBE",
            "kind: history, record: sett, level: DBE",
            "analyses[2].record E-NAME-01",
        ),
    ],
)
def test_a_mistake_is_reported_before_anything_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    if old == "a_gR: 0.2 g":
        new = new.replace(", ", "\n  ")
    assert main(["run", str(suite_project.write(tmp_path, (old, new)))]) == 2
    errors = capsys.readouterr().err
    assert says(errors, said) and "Traceback" not in errors and not list(tmp_path.glob("*.h5*"))


def test_a_match_without_hazard_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = suite_project.write(tmp_path)
    text = path.read_text(encoding="utf-8")
    path.write_text(text[: text.index("hazard:")] + text[text.index("records:\n") :], encoding="utf-8")
    assert main(["check", str(path)]) == 2
    assert says(capsys.readouterr().err, "records.set.match E-HAZ-05")


def test_a_suite_is_no_project(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(suite_project.write_suite(tmp_path))]) == 2
    errors = capsys.readouterr().err
    assert errors.count("\n") == 1 and says(errors, "edesign_suite E-FILE-05")


@pytest.mark.parametrize("workers", [1, 2])
def test_a_stop_during_the_fit_starts_no_analysis(tmp_path: Path, workers: int) -> None:
    """Nothing is kept that could be used later, and nothing is fitted again on the way out."""
    heard: list[str] = []

    def listen(report: Progress) -> None:
        heard.append(report.analysis)
        if report.event == "advance":
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted, match="before an analysis was finished"):
        run_project(load_project(suite_project.write(tmp_path)), progress=listen, workers=workers)
    assert set(heard) == {"matching"} and not list(tmp_path.glob("*.h5*"))
