"""`edesign test`, `characterise`, `fit` in the hands of a careless laboratory: one clear message, nothing half done."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from support.messages import says

from edesign.cli import main as command
from edesign.damper.testing.campaign import load_campaign, write_campaign
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import ArchiveError, StageFailed

SPECIMEN = ["--layers", "2", "--layer-area", "41400 mm^2", "--layer-thickness", "12 mm"]
RIG = [*SPECIMEN, "--temperature", "20 degC"]
HEADERS = "time_s,displacement_mm,force_kN"
CAMPAIGN = """specimen: {name: p, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
law: {type: zener}
tests:
  - {file: a.csv, temperature: 20 degC}
"""
PROGRAMME = """specimen: {name: p, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
law: {type: zener, parameters: {k0: 4 kN/mm, k1: 5 kN/mm, c1: 1 kN*s/mm}}
sampling_rate: 100 Hz
tests:
  - {type: sine, strain: 10 %, frequency: 1 Hz, temperature: 20 degC}
"""
T = np.arange(2000) / 100.0
SINE, COSINE = np.sin(2.0 * np.pi * T), np.cos(2.0 * np.pi * T)


def write(path: Path, force: np.ndarray, headers: str = HEADERS, separator: str = ",") -> Path:
    rows = [separator.join(f"{x:.9g}" for x in row) for row in zip(T, 3.0 * SINE, force, strict=True)]
    path.write_text("\n".join([headers.replace(",", separator), *rows, ""]))
    return path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "a.csv", 12.0 * SINE + 1.5 * COSINE)
    (tmp_path / "c.yaml").write_text(CAMPAIGN)
    (tmp_path / "p.yaml").write_text(PROGRAMME)
    return tmp_path


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """The message of a command that ends with exit code 2."""
    assert command.main(list(words)) == 2
    error = capsys.readouterr().err
    assert "Traceback" not in error and "edesign itself" not in error
    return error


@pytest.mark.parametrize("force", [np.zeros(T.size), np.full(T.size, 5.0)])
def test_a_force_that_does_not_change(folder: Path, capsys: pytest.CaptureFixture[str], force: np.ndarray) -> None:
    write(folder / "a.csv", force)
    for words in (("characterise", "a.csv", *RIG), ("fit", "c.yaml")):
        assert says(refused(capsys, *words), f"a.csv: {force[0]:g} N E-TEST-06")


@pytest.mark.parametrize("factor", ["e300", "e-300"])
def test_numbers_beyond_all_units(folder: Path, capsys: pytest.CaptureFixture[str], factor: str) -> None:
    rows = [f"{t:g},{3.0 * s:.6f}{factor},{12.0 * s:.6f}{factor}" for t, s in zip(T, SINE, strict=True)]
    (folder / "a.csv").write_text("\n".join([HEADERS, *rows]))
    for words in (("characterise", "a.csv", *RIG), ("fit", "c.yaml")):
        assert says(refused(capsys, *words), "a.csv: E-TEST-07")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"{HEADERS},\n0,1,2,\n1,2,3,4\n", "a.csv:1: 4 E-TABLE-05"),
        ("time_s displacement_mm force_kN\n0,1 2\n1 2 3\n", "a.csv:1: one E-TABLE-05"),
        (f"{HEADERS}\n0,0,1,5,2,5\n0,1,1,6,2,7\n", "a.csv:2: 6 3 decimal E-TABLE-07"),
        (f"{HEADERS}\n0,1,2\n1_0,2,3\n", "a.csv:3, column 1 (`time_s`): `1_0` E-TABLE-08"),
    ],
)
def test_tables_that_are_none(folder: Path, capsys: pytest.CaptureFixture[str], text: str, said: str) -> None:
    (folder / "a.csv").write_text(text)
    assert says(refused(capsys, "characterise", "a.csv", *RIG), said)


def test_a_test_file_is_no_property_table(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert says(refused(capsys, "fit", "a.csv", "--law", "zener", *SPECIMEN), "a.csv campaign E-PROPS-04")


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ("{type: {a: 1}}", ":2:13: law.type: E-LAW-01"),
        ("{type: zener, parameters: {k0: 1 kN/mm, k1: 2, c1: 1 kN*s/mm}}", ":2:50: law.parameters.k1: E-UNIT-01"),
        ("{type: zener, parameters: {k0: 1 kN/mm, kk: 2 kN/mm}}", "law.parameters.kk: E-LAW-02"),
        (
            "{type: fractional_zener, parameters: {k0: 1 kN/mm, a: 1 s^alpha, b: 0.5 s^alpha, alpha: 0.5}}",
            ":2:43: law.parameters: b = 0.5 above a",
        ),
    ],
)
def test_laws_in_files(folder: Path, capsys: pytest.CaptureFixture[str], law: str, said: str) -> None:
    for name, command_name in (("c.yaml", "fit"), ("p.yaml", "test")):
        lines = (folder / name).read_text().splitlines()
        lines[1] = f"law: {law}"
        (folder / name).write_text("\n".join(lines) + "\n")
        error = refused(capsys, command_name, name)
        assert says(error, said) and f"{name}:2:" in error


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("1 Hz,", "1e-9 Hz,", "10000000 E-PROG-01"),
        ("1 Hz,", "60 Hz,", "1.67 E-PROG-01"),
        ("10 %", "50", "tests[0].strain: `50` E-VALUE-02"),
        ("10 %", "[" + ", ".join(f"{i / 10} %" for i in range(1, 1002)) + "]", "1001 1000 E-PROG-01"),
    ],
)
def test_programmes_nobody_can_run(
    folder: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    (folder / "p.yaml").write_text(PROGRAMME.replace(old, new))
    error = refused(capsys, "test", "p.yaml", "-o", "out")
    assert says(error, said) and "p.yaml" in error
    assert not (folder / "out").exists()


def test_devices_that_store_or_dissipate_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A dashpot has no loss factor: it is printed, valid JSON, and left out of the table."""
    write(folder / "dash.csv", 5.0 * COSINE)
    write(folder / "reversed.csv", -12.0 * SINE - 1.5 * COSINE)
    words = ["characterise", "a.csv", "dash.csv", "reversed.csv", *RIG]
    assert command.main([*words, "-o", "table.csv", "--figures", "figures"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "dash: left out of the table" in said and "sign of force or displacement reversed?" in said
    assert len((folder / "table.csv").read_text().splitlines()) == 2
    assert command.main([*words, "--json", "--per-cycle"]) == 0
    found = json.loads(capsys.readouterr().out, parse_constant=lambda name: pytest.fail(name))["tests"]["dash"]["mean"]
    # force 5 kN in phase with the velocity: G'' = 5 kN / 0.0828 m2 / 25 %
    assert found["G_loss"] == pytest.approx(5e3 / 0.0828 / 0.25, rel=1e-3)


def test_an_infinite_loss_factor_is_null_in_json() -> None:
    from edesign.damper.testing.properties import Properties
    from edesign.report.damper.measured_tables import properties_data

    row = Properties(0.1, 1.0, 20.0, 0.0, 1e6, 1e6, float("inf"), (5, 15))
    data = json.loads(json.dumps(properties_data({"a": row}, {}), allow_nan=False))
    assert data["tests"]["a"]["mean"]["loss_factor"] is None


def test_files_of_one_name(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two tests never count as one."""
    assert says(refused(capsys, "characterise", "a.csv", "a.csv", *RIG), "a.csv: E-FILE-09")
    write(folder / "a.txt", 24.0 * SINE + 3.0 * COSINE)
    assert command.main(["characterise", "a.csv", "a.txt", *RIG, "--json"]) == 0
    assert set(json.loads(capsys.readouterr().out)["tests"]) == {"a.csv", "a.txt"}
    (folder / "c.yaml").write_text(CAMPAIGN + "  - {file: a.txt, temperature: 20 degC}\n")
    assert [test.name for test in load_campaign(folder / "c.yaml").tests] == ["a.csv", "a.txt"]


def test_properties_of_a_campaign_with_sweeps(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Tests without a steady amplitude are left out with a note."""
    growing = np.sin(T**2) * T
    rows = [f"{t:.9g},{u:.9g},{4.0 * u:.9g}" for t, u in zip(T, growing, strict=True)]
    (folder / "sweep.csv").write_text("\n".join([HEADERS, *rows]))
    (folder / "c.yaml").write_text(CAMPAIGN + "  - {file: sweep.csv, temperature: 20 degC}\n")
    words = ["fit", "c.yaml", "--law", "kelvin_voigt", "--fix", "c=0 kN*s/mm", "--against", "properties"]
    assert command.main([*words, "--json", "--starts", "1"]) == 0
    shown = capsys.readouterr()
    assert says(shown.err, "note: sweep.csv: E-TEST-08")
    assert json.loads(shown.out)["samples"] == 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--start", "k1=5 kN/mm", "--start", "k1=6 kN/mm"], "--start k1: E-CLI-04"),
        (["--free", "k0", "--fix", "k0=1 kN/mm"], "--free k0: --fix E-CLI-02"),
        (["--start", "k1=1e300 kN/mm"], "--start k1: `1e300 E-UNIT-03"),
        (
            ["--law", "fractional_zener", "--start", "a=1 s^alpha", "--start", "b=0.5 s^alpha", "--start", "alpha=0.5"],
            "`b`: 0.5 a = 1 E-FIT-03",
        ),
    ],
)
def test_contradicting_options(folder: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str) -> None:
    assert says(refused(capsys, "fit", "c.yaml", *words), said)


@pytest.mark.parametrize(
    "words", [["--start", "a=100 s^alpha"], ["--fix", "a=100 s^alpha"], ["--fix", "b=1e-6 s^alpha"]]
)
def test_one_of_two_ordered_parameters_is_enough(
    folder: Path, capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    """The other one of a < b starts where the law has a force."""
    options = ["--law", "fractional_zener", *words, words[0], "alpha=0.5", "--starts", "1", "--json", "-q"]
    assert command.main(["fit", "c.yaml", *options]) == 0
    found = json.loads(capsys.readouterr().out)["parameters"]
    assert found["b"] > found["a"]


def test_a_reversed_sign_is_reported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(folder / "a.csv", -12.0 * SINE - 1.5 * COSINE)
    assert command.main(["fit", "c.yaml", "--starts", "1", "--json", "-q"]) == 0
    warnings = json.loads(capsys.readouterr().out)["doubts"]
    assert any("test a: the device gives energy" in warning for warning in warnings)
    assert any("does not follow the tests" in warning for warning in warnings)


def test_no_warning_about_a_device_that_is_fine(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["fit", "c.yaml", "--law", "kelvin_voigt", "--starts", "1", "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["doubts"] == []
    assert found["parameters"]["k"] == pytest.approx(4e6, rel=1e-6)


def test_the_end_of_the_search_is_no_bound(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A pure dashpot wants a Maxwell spring without end, for which the law has no bound."""
    write(folder / "a.csv", 5.0 * COSINE)
    assert command.main(["fit", "c.yaml", "--starts", "1", "--json", "-q"]) == 0
    warnings = json.loads(capsys.readouterr().out)["doubts"]
    assert "k0 ended at its bound 0" in warnings
    assert any(warning.startswith("k1 ran off to") for warning in warnings)


def test_places_are_checked_before_the_work(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fit that takes minutes is not lost for a folder that cannot be made."""

    def no_work(*_: object, **__: object) -> None:
        raise AssertionError("the work has begun")

    monkeypatch.setattr("edesign.damper.fitting.law_fit.fit_forces", no_work)
    monkeypatch.setattr("edesign.cli.test.run_programme", no_work)
    monkeypatch.setattr("edesign.cli.characterise.properties", no_work)
    code = ArchiveError.exit_code
    assert command.main(["fit", "c.yaml", "-q", "-o", "a.csv/x"]) == code
    assert command.main(["fit", "c.yaml", "-q", "--figures", "a.csv"]) == code
    assert command.main(["test", "p.yaml", "-q", "-o", "a.csv/x"]) == code
    assert command.main(["characterise", "c.yaml", "--figures", "a.csv/x"]) == code
    assert command.main(["characterise", "c.yaml", "-o", "a.csv/x.csv"]) == code


def test_an_interrupted_replacement_leaves_no_mixed_campaign(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """campaign.yaml must not name new and old tests side by side."""
    tests = [DamperTest(name, T, 3e-3 * SINE, 12e3 * SINE) for name in ("one", "two")]
    specimen = Specimen("p", 2, 0.0414, 0.012)
    path = write_campaign(folder / "out", specimen, tests).path
    assert path.exists()

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("edesign.damper.testing.campaign.write_test", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_campaign(folder / "out", specimen, tests)
    assert not path.exists()


def test_tests_beyond_the_fitted_temperatures(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(folder / "b.csv", 10.0 * SINE + 1.5 * COSINE)
    (folder / "c.yaml").write_text(CAMPAIGN + "  - {file: b.csv, temperature: 35 degC, use: validate}\n")
    assert command.main(["fit", "c.yaml", "--starts", "1"]) == 0
    assert "note: test b is at 35 degC, those fitted at 20 degC" in capsys.readouterr().err


def test_cross_validation_reports_what_was_left_out(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = CAMPAIGN
    for name, celsius in (("b", 28), ("d", 35)):
        write(folder / f"{name}.csv", (13.0 - 0.1 * celsius) * SINE + 1.5 * COSINE)
        text += f"  - {{file: {name}.csv, temperature: {celsius} degC}}\n"
    (folder / "c.yaml").write_text(text)
    words = ["fit", "c.yaml", "--starts", "1", "--cross-validate"]
    assert command.main([*words, "--temperature", "ferry"]) == StageFailed.exit_code
    shown = capsys.readouterr()
    assert says(shown.err, "cross-validation zener failed: a: temperature: E-FIT-05") and "zener: errors" in shown.out
    assert command.main(words) == 0
    assert "zener: held out 3/3" in capsys.readouterr().err


def test_a_result_is_printed_though_its_files_cannot_be_written(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise ArchiveError("law.yaml: cannot be written: No space left on device [E-FILE-06]")

    monkeypatch.setattr("edesign.cli.fit.write_text", full)
    assert command.main(["fit", "c.yaml", "--starts", "1", "--json", "-q", "-o", "out"]) == ArchiveError.exit_code
    shown = capsys.readouterr()
    assert json.loads(shown.out)["law"] == "zener"
    assert "No space left" in shown.err
