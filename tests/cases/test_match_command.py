"""`edesign match` and `edesign spectrum` as a user calls them: tables, files, figures, mistakes."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from cases import suite_project
from messages import says

from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.errors import ArchiveError
from edesign.ground_motion.formats.csv_record import read_csv
from edesign.ground_motion.suite import TAKEN
from edesign.project.notation.units import STANDARD_GRAVITY

SITE = ["--a-gr", "0.2g", "--ground", "B"]
FIT = ["--method", "frequency", "--periods", "0.1s", "2s"]


def test_match_writes_archive_tables_csv_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    suite = suite_project.write_suite(tmp_path)
    archive, out, figures = tmp_path / "out.h5", tmp_path / "csv", tmp_path / "figures"
    words = ["match", str(suite), *SITE, *FIT, "--t1", "0.5s", "--archive", str(archive)]
    assert main([*words, "--csv", str(out), "--figures", str(figures), "--format", "png"]) == 0
    output, errors = capsys.readouterr()
    assert "[3/3] third: rms misfit" in errors
    for text in ("simulated", "Arias", "3.2.3.1.2(4)c", "met", f"archive: {archive}"):
        assert text in output
    assert sorted(path.name for path in figures.iterdir()) == sorted(
        f"{name}.png" for name in ("set_before", "set_after", "set_mean", "first", "second", "third")
    )
    with open_archive(archive) as opened:
        for name in ("first", "second", "third"):
            group = opened.group(f"records/set/{name}")
            record = read_csv(out / f"{name}.csv", "m/s^2")
            assert np.array_equal(record.acceleration, group.variables["matched_acceleration"].values)
            assert (out / f"{name}.csv").read_text().startswith("time_s,acceleration_m_s2\n")
    assert main(["show", str(archive), "--json"]) == 0
    (suite_entry,) = json.loads(capsys.readouterr().out)["records"]
    assert [record["origin"] for record in suite_entry["records"]] == ["file", "file", "simulated"]
    assert suite_entry["criteria"][0]["clause"] == "3.2.3.1.2(4)a"
    assert all(record["misfit_after"]["rms"] < 0.05 for record in suite_entry["records"])
    assert main(["show", str(archive)]) == 0
    assert "3.2.3.1.2(4)b" in capsys.readouterr().out


def test_scale_keeps_the_shape(tmp_path: Path) -> None:
    suite, archive = suite_project.write_suite(tmp_path), tmp_path / "out.h5"
    words = ["match", str(suite), *SITE, "--method", "scale", "--periods", "0.1s", "2s", "--t1", "0.5s", "--quiet"]
    assert main([*words, "--archive", str(archive)]) == 0
    with open_archive(archive) as opened:
        factor = opened.group_attributes("records/set")["suite_factor"]
        assert factor > 1.0
        for name in ("first", "second", "third"):
            group = opened.group(f"records/set/{name}")
            n = group.variables["acceleration"].values.size
            matched = group.variables["matched_acceleration"].values[:n]
            expected = factor * group.attributes["match_scale"] * group.variables["acceleration"].values
            assert matched == pytest.approx(expected, rel=1e-12)
        verdicts = opened.group_attributes("records/set")["criteria"]
        assert all(verdict["passed"] is not False for verdict in verdicts)


def test_periods_outside_of_the_fit_are_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """2 T1 = 3 s, fitted up to 2 s."""
    suite = suite_project.write_suite(tmp_path)
    assert main(["match", str(suite), *SITE, *FIT, "--t1", "1.5s", "--archive", str(tmp_path / "out.h5")]) == 0
    assert "fitted were 0.1 s to 2 s only" in capsys.readouterr().out


def test_the_best_of_a_library_are_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    suite, archive = suite_project.write_suite(tmp_path), tmp_path / "out.h5"
    words = ["match", str(suite), *SITE, *FIT, "--archive", str(archive), "--select", "2"]
    assert main(words) == 2
    assert says(capsys.readouterr().err, "--select: --t1, E-CLI-03")
    assert main([*words, "--t1", "0.5s"]) == 0
    assert "The best 2 of 3" in capsys.readouterr().out
    with open_archive(archive) as opened:
        assert len(opened.names("records/set")) == 2
        verdicts = {item["clause"]: item["passed"] for item in opened.group_attributes("records/set")["criteria"]}
        assert verdicts["3.2.3.1.2(4)a"] is False  # two records are too few


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nowhere.yaml", *SITE], "nowhere.yaml: E-FILE-01"),
        (["set.yaml"], "--ground"),
        (["set.yaml", "--ground", "B"], "--a-gr: E-CLI-03"),
        (["set.yaml", "--ground", "Q", "--a-gr", "0.2g"], "--ground: `Q` E-VALUE-03"),
        (["set.yaml", "--ground", "B", "--a-gr", "0.2"], "--a-gr: E-UNIT-01"),
        (["set.yaml", "--ground", "B", "--country", "grece", "--zone", "3"], "grece"),
        (["set.yaml", *SITE, "--country", "greece", "--zone", "3"], "--zone: --a-gr E-CLI-02"),
        (["set.yaml", *SITE, "--t1", "1e9s"], "--t1: E-CLI-04"),
        (["set.yaml", *SITE, "--max-per-event", "1"], "--max-per-event: E-CLI-01"),
        (["set.yaml", *SITE, "--method", "wavelet"], "did you mean `wavelets`?"),
        (["set.yaml", *SITE, "--periods", "2s", "1s"], "periods"),
        (["set.yaml", *SITE, "--periods", "0.1", "1"], "--periods: E-UNIT-01"),
        (["set.yaml", *SITE, "--periods", "0.01s", "1s"], "0.02 s E-MATCH-02"),
        (["set.yaml", *SITE, "--scale-bounds", "2", "1"], "scale_bounds"),
        (["set.yaml", *SITE, "--no-simulated-records"], "set.yaml:6:5: third: E-SUITE-05"),
        (["set.yaml", *SITE, "--folder", "nowhere"], "nowhere: E-FILE-01"),
        (["set.yaml", *SITE, "--unit", "g"], "--unit, --time-step, --layout, --component, --column: E-CLI-01"),
        (["set.yaml", "first.csv", *SITE], "set.yaml: E-CLI-05"),
        (["first.csv", *SITE], "first.csv: --unit E-CLI-03"),
        (["first.csv", "FIRST.txt", *SITE, "--unit", "g"], "FIRST.txt: E-FILE-09"),
        (["first.csv", "copy.csv", *SITE, "--unit", "g"], "copy.csv: first.csv; E-FILE-09"),
        (["target.csv", *SITE, "--unit", "g"], "target.csv: E-FILE-10"),
        (["..csv", *SITE, "--unit", "g"], "..csv: E-FILE-10"),
        (["taken.yaml", *SITE], "taken.yaml:4:10: records[0].id: E-NAME-03"),
        (["motion.AT2", *SITE, "--unit", "g"], "--unit, E-CLI-01"),
        (["first.csv", *SITE, "--unit", "g", "--no-simulated-records"], "--no-simulated-records: E-CLI-01"),
        (["huge.csv", *SITE, "--unit", "g", "--time-step", "0.01s"], "huge.csv: E-UNIT-03"),
        (["tiny.csv", *SITE, "--unit", "g", "--time-step", "0.01s"], "tiny.csv: E-UNIT-03"),
        (["first.csv", "first.csv", *SITE, "--unit", "g"], "first.csv: E-FILE-09"),
        (["set.yaml", *SITE, "--format", "gif"], "--format: `gif` E-CLI-04"),
        (["set.yaml", *SITE, "--level", "DBE"], "--level: --project; E-CLI-01"),
        (["empty.csv", *SITE, "--unit", "g"], "empty.csv: E-REC-21"),
        (["nan.csv", *SITE, "--unit", "g", "--time-step", "0.01s"], "nan.csv:2: E-TABLE-08"),
        (["short.csv", *SITE, "--unit", "g", "--time-step", "0.01s"], "0.04 s E-MATCH-02"),
    ],
)
def test_mistakes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    suite_project.write_suite(tmp_path)
    monkeypatch.chdir(tmp_path)
    Path("empty.csv").write_text("")
    Path("nan.csv").write_text("0\nnan\n0\n")
    Path("short.csv").write_text("0\n0.1\n0\n-0.1\n0\n")
    Path("huge.csv").write_text("0\n1e300\n0\n")
    Path("tiny.csv").write_text("0\n1e-300\n0\n")
    for name in ("FIRST.txt", "copy.csv", "target.csv", "..csv"):
        Path(name).write_text(Path("first.csv").read_text())
    Path("motion.AT2").write_text("A\nB\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n0.0 0.1 0.0\n")
    taken = "{id: period, file: first.csv, acceleration_unit: g}"
    Path("taken.yaml").write_text(f"edesign_suite: 1\ntitle: Taken\nrecords:\n  - {taken}\n")
    before = sorted(tmp_path.iterdir())
    code = main(["match", *words])
    errors = capsys.readouterr().err
    assert code in (2, 3) and says(errors, said) and "Traceback" not in errors and "edesign itself" not in errors
    assert sorted(tmp_path.iterdir()) == before  # nothing half-written


def test_a_recording_that_cannot_be_fitted_does_not_take_the_others_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    suite_project.write_suite(tmp_path)
    monkeypatch.chdir(tmp_path)
    Path("short.csv").write_text("0\n0.1\n0\n-0.1\n0\n")
    words = ["match", "first.csv", "short.csv", *SITE, *FIT, "--unit", "m/s^2", "--time-step", "0.01s"]
    assert main(words) == 3
    assert says(capsys.readouterr().err, "short E-MATCH-02")
    with open_archive("records_matched.h5") as opened:
        assert opened.group_attributes("records/records/short")["status"] == "failed"
        assert opened.group_attributes("records/records/first")["status"] == "completed"


def test_the_archive_has_no_other_names_of_its_own_than_those_that_are_taken(tmp_path: Path) -> None:
    """A recording of such a name would take the place of a variable of its suite."""
    archive = tmp_path / "out.h5"
    words = ["match", str(suite_project.write_suite(tmp_path)), *SITE, "--method", "scale", "--periods", "0.1s", "2s"]
    assert main([*words, "--archive", str(archive), "--quiet"]) == 0
    with open_archive(archive) as opened:
        suite = opened.group("records/set")
        assert set(TAKEN) == {*suite.coords, *suite.variables}


def test_folders_are_looked_at_before_the_fit(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    suite, archive = suite_project.write_suite(tmp_path), tmp_path / "out.h5"
    for option in ("--csv", "--figures"):
        words = ["match", str(suite), *SITE, *FIT, "--archive", str(archive), option, str(tmp_path / "first.csv")]
        assert main(words) == 4
        output, errors = capsys.readouterr()
        assert says(errors, "first.csv E-FILE-06") and not output and not archive.exists()


@pytest.mark.slow
def test_files_that_cannot_be_written_leave_the_tables(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    suite, archive, out = suite_project.write_suite(tmp_path), tmp_path / "out.h5", tmp_path / "csv"
    (out / "second.csv").mkdir(parents=True)  # no file can take its place
    words = ["match", str(suite), *SITE, *FIT, "--archive", str(archive), "--csv", str(out)]
    assert main(words) == 5
    output, errors = capsys.readouterr()
    assert f"archive: {archive}" in output and "second.csv: cannot be written" in errors
    assert sorted(path.name for path in out.iterdir()) == ["first.csv", "second.csv"]  # nothing half-written


def test_a_disk_that_is_full_leaves_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(writer: ArchiveWriter, path: str, group: object) -> None:
        raise ArchiveError("the disk is full [E-FILE-06]")

    suite = suite_project.write_suite(tmp_path)
    monkeypatch.setattr(ArchiveWriter, "write", full)
    words = ["match", str(suite), *SITE, "--method", "scale", "--archive", str(tmp_path / "out.h5")]
    assert main(words) == 4
    assert "the disk is full" in capsys.readouterr().err and not list(tmp_path.glob("out*"))


def test_several_samples_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A table of eight samples a line is refused until the layout is said, and then it is the record it was."""
    suite_project.write_suite(tmp_path)
    monkeypatch.chdir(tmp_path)
    record = read_csv("first.csv", "m/s^2")
    words = [f"{value!r}" for value in record.acceleration.tolist()]
    Path("rows.txt").write_text("\n".join(" ".join(words[k : k + 8]) for k in range(0, len(words), 8)))
    table = ["--unit", "m/s^2", "--time-step", f"{record.time_step!r} s"]
    for command in (["spectrum", "rows.txt", *SITE], ["match", "rows.txt", *SITE, *FIT, "--archive", "out.h5"]):
        assert main([*command, *table]) == 2
        assert "write `layout: rows` (--layout rows)" in capsys.readouterr().err
        assert main([*command, *table, "--layout", "rows"]) == 0
        capsys.readouterr()
    with open_archive("out.h5") as opened:
        assert np.array_equal(
            opened.group("records/records/rows").variables["acceleration"].values, record.acceleration
        )
    assert main(["spectrum", "first.csv", *SITE, "--unit", "m/s^2", "--component", "1"]) == 2
    assert says(capsys.readouterr().err, "--component: E-CLI-01")
    assert main(["spectrum", "suite.yaml", *SITE, "--layout", "rows"]) == 2
    assert says(capsys.readouterr().err, "--layout, --component, --column: E-CLI-01")


def test_scaling_beyond_the_usual_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    suite, archive = suite_project.write_suite(tmp_path), tmp_path / "out.h5"
    site = ["--a-gr", "9g", "--ground", "B", "--method", "scale", "--periods", "0.1s", "2s", "--t1", "0.5s"]
    words = ["match", str(suite), *site, "--scale-bounds", "0.1", "100", "--select", "3", "--archive", str(archive)]
    assert main(words) == 0
    output = " ".join(capsys.readouterr().out.split())
    assert output.count("3 of 3 records are scaled beyond the usual 1/3 to 3") == 2  # of the choice and of the fit
    with open_archive(archive) as opened:
        about = [opened.group_attributes(f"records/set/{name}") for name in ("first", "second", "third")]
        (said,) = opened.group_attributes("records/set")["warnings"]
    assert all(f"by {one['match_scale'] * one['suite_factor']:.3g}" in said for one in about)
    assert "(simulated)" in said and f"set: {said}" in output


def test_a_unit_that_cannot_be_right_gets_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The file is in m/s2 and peaks at some; declared as g that is more than 3 g."""
    suite_project.write_suite(tmp_path)
    monkeypatch.chdir(tmp_path)
    record = read_csv("first.csv", "m/s^2")
    peak, samples = record.pga, record.acceleration
    scaled = [f"{i * 0.01:.2f},{value * 4.0 / peak!r}" for i, value in enumerate(samples.tolist())]
    Path("metres.csv").write_text("\n".join(scaled))
    assert main(["match", "metres.csv", *SITE, *FIT, "--unit", "g"]) == 0
    assert "is the unit right" in capsys.readouterr().out


def test_spectrum_prints_writes_and_draws(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The plateau of type 1 on ground C is 2.5 x 1.15 x 0.36 g = 1.035 g; the design one with q = 4 a quarter."""
    table, figure = tmp_path / "s.csv", tmp_path / "s.svg"
    words = ["spectrum", "--country", "greece", "--zone", "3", "--ground", "C", "--q", "4", "--periods", "0.3s", "0.6s"]
    assert main([*words, "--points", "3", "--csv", str(table), "--figure", str(figure)]) == 0
    assert "1.035" in capsys.readouterr().out
    with table.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["Se [m/s2]"]) for row in rows] == pytest.approx([1.035 * STANDARD_GRAVITY] * 3, rel=1e-12)
    assert [float(row["Sd [g]"]) for row in rows] == pytest.approx([1.035 / 4] * 3, rel=1e-12)
    drawn = figure.read_text(encoding="utf-8")
    assert drawn.startswith("<?xml") and "EN 1998-1:2004 design, q = 4" in drawn


def test_spectrum_says_what_is_simulated_or_questionable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    suite_project.write_suite(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert main(["spectrum", "set.yaml", *SITE, "--points", "2"]) == 0
    output = capsys.readouterr().out
    assert "third: simulated, M 6.5, 20 km, v_s30 500 m/s, seed 3" in output and "first: simulated" not in output
    Path("a,b.csv").write_text("".join(f"{i * 0.01:.2f},{value}\n" for i, value in enumerate((0, 40, 0, -40, 0))))
    assert main(["spectrum", "a,b.csv", *SITE, "--unit", "g", "--points", "2", "--csv", "s.csv"]) == 0
    assert "a,b: the peak is 40 g" in capsys.readouterr().out
    with Path("s.csv").open(encoding="utf-8") as file:
        assert "a,b [g]" in next(csv.reader(file))


def test_the_behaviour_factor_of_a_project_gives_its_design_spectrum(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Type 1, ground B: 2.5 x 1.2 x 0.2 g = 0.6 g on the plateau, a third of it with q = 3."""
    project = suite_project.write(tmp_path, ("a_gR: 0.2 g", "a_gR: 0.2 g\n  behaviour_factor: 3"))
    words = ["spectrum", "--project", str(project), "--periods", "0.2s", "0.4s", "--points", "2"]
    assert main(words) == 0
    table = capsys.readouterr().out
    assert "Sd [g]" in table and table.split("\n")[3].split()[-1] == "0.2"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--ground", "C", "--a-gr", "0.36g", "--figure", "s.gif"], "s.gif: E-FILE-08"),
        (["--ground", "C", "--a-gr", "0.36g", "--q", "0.5"], "q"),
        (["--ground", "C", "--a-gr", "0.36g", "--gamma", "2"], None),
        (["--ground", "C", "--a-gr", "0.36g", "--gamma", "V"], "--gamma"),
        (["--ground", "C", "--a-gr", "0.36g", "--type", "3"], "--type"),
        (["--ground", "C", "--a-gr", "0.36g", "--csv", "/dev/null/s.csv"], "/dev/null E-FILE-06"),
        (["--ground", "C", "--a-gr", "0.36g", "--periods", "1s", "1s"], "--periods"),
    ],
)
def test_spectrum_mistakes(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    said: str | None,
) -> None:
    monkeypatch.chdir(tmp_path)
    code = main(["spectrum", *words])
    errors = capsys.readouterr().err
    assert (
        (code == 0 and not errors)
        if said is None
        else (code in (2, 4) and says(errors, said) and "itself" not in errors)
    )
    assert not list(tmp_path.iterdir())
