"""`edesign fit`: files, tables, and mistakes."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
import typer
import yaml
from damper_examples import EXAMPLES
from fit_campaign import measured
from support.messages import says

from edesign.cli import main as command
from edesign.cli.fit import fit
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.specimen import Specimen

SPECIMEN = ["--layers", "2", "--layer-area", "41400 mm^2", "--layer-thickness", "12 mm"]
CSV = "temperature_C,shear_strain_percent,frequency_Hz,G_storage_MPa,G_eq_MPa,loss_factor\n"


@pytest.fixture(autouse=True)
def _registered(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command, whether `edesign` has it already or not."""
    if not any(item.callback is fit for item in command.app.registered_commands):
        app = typer.Typer(pretty_exceptions_enable=False)
        app.command()(fit)
        app.callback()(lambda: None)
        monkeypatch.setattr(command, "app", app)


@pytest.fixture
def campaign(tmp_path: Path) -> Path:
    tests = measured("zener", EXAMPLES["zener"])
    named = [replace(test, name=f"test_{i}") for i, test in enumerate(tests)]
    named[-1] = replace(named[-1], use="validate")
    choice = LawChoice("zener", {"k0": "4 kN/mm", "k1": "5 kN/mm", "c1": "1 kN*s/mm"}, True)
    write_campaign(tmp_path / "campaign", Specimen("prototype", 2, 0.0414, 0.012), named, choice)
    return tmp_path / "campaign" / "campaign.yaml"


def test_files_and_tables(campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, drawn = tmp_path / "out", tmp_path / "figures"
    words = ["fit", str(campaign), "--output", str(out), "--figures", str(drawn), "--cross-validate", "--starts", "2"]
    assert command.main(words) == 0
    text = capsys.readouterr().out
    assert "test_3 (validate)" in text and "held out" in text and "tested: shear strain" in text
    assert f"written: {out / 'law.yaml'}, fit.json" in text
    data = yaml.safe_load((out / "law.yaml").read_text())
    values = read_parameters(LAWS[data["type"]], data["parameters"])
    result = json.loads((out / "fit.json").read_text())
    assert values == pytest.approx(result["parameters"], rel=1e-8)
    for name, value in EXAMPLES["zener"].items():
        assert abs(values[name] - value) < 3.0 * result["standard_error"][name]
        number, unit = data["standard_errors"][name].split(" ")
        assert unit == data["parameters"][name].split(" ")[1]
        assert float(number) * 1e6 == pytest.approx(result["standard_error"][name], rel=0.01)
    assert data["tested"]["temperature"] == "20 degC"
    assert set(result["nrms_percent_held_out"]) == {"test_0", "test_1", "test_2"}
    assert set(result["nrms_percent_validation"]) == {"test_3"}
    assert sorted(path.name for path in drawn.iterdir()) == [f"zener_test_{i}.svg" for i in range(4)]


def test_laws_side_by_side(campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [
        "fit",
        str(campaign),
        "--law",
        "zener",
        "--law",
        "kelvin_voigt",
        "--starts",
        "1",
        "-o",
        str(tmp_path / "o"),
    ]
    assert command.main([*words, "--json"]) == 0
    assert [item["law"] for item in json.loads(capsys.readouterr().out)] == ["zener", "kelvin_voigt"]
    assert (tmp_path / "o" / "kelvin_voigt" / "law.yaml").exists()
    assert command.main(words) == 0
    assert "zener suffices" in capsys.readouterr().out


def test_start_and_fix(campaign: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["fit", str(campaign), "--start", "k1=6 kN/mm", "--fix", "k0=4.5 kN/mm", "--json", "--quiet"]
    assert command.main(words) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["parameters"]["k0"] == pytest.approx(4.5e6, rel=1e-12)
    assert result["held"] == {"k0": "fixed by the user"}
    assert result["fitted"] == ["k1", "c1"]


def test_a_property_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Kelvin-Voigt: G' the same at all frequencies, n in proportion to frequency."""
    rows = [f"20,{strain},{f},1.0,1.1,{0.2 * f}" for strain in (10, 30) for f in (0.5, 1.0, 2.0)]
    path = tmp_path / "table.csv"
    path.write_text(CSV + "\n".join(rows) + "\n")
    assert command.main(["fit", str(path), "--law", "kelvin_voigt", *SPECIMEN, "--json", "-q"]) == 0
    result = json.loads(capsys.readouterr().out)
    k = 1e6 * 2 * 0.0414 / 0.012
    assert result["parameters"]["k"] == pytest.approx(k, rel=1e-6)
    assert result["parameters"]["c"] == pytest.approx(0.2 * k / 6.283185307, rel=1e-4)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--law", "zenner"], "did you mean `zener`"),
        (["--law", "zener", "--law", "zener"], "--law: `zener` E-CLI-04"),
        (["--against", "force"], "did you mean `forces`"),
        (["--start", "k1=5"], "--start k1: E-UNIT-01"),
        (["--start", "k1=-5 kN/mm"], "--start k1: -5e+06 E-LAW-03"),
        (["--start", "k9=5 kN/mm"], "--start: `k9` E-CLI-04"),
        (["--law", "mgmm", "--start", "c_NL=1.585 kN*(s/mm)^0.374"], "c_NL: `alpha=...` E-CLI-03"),
        (["--law", "kelvin_voigt", "--fix", "k"], "--fix k: E-CLI-03"),
        (["--free", "k0", "--fix", "q"], "--fix: `q` E-CLI-04"),
        (["--loss", "soft"], "did you mean `soft_l1`"),
        (["--temperature", "gamma"], "20 degC E-FIT-05"),
        (["--folds", "2"], "--folds: --cross-validate E-CLI-01"),
        (["--format", "gif"], "--format: E-CLI-04"),
        (SPECIMEN, "--layers, E-CLI-02"),
        (["--law", "mgmm", "--start", "thesis_table_4_3"], "did you mean `thesis_table_4_2`"),
    ],
)
def test_mistakes(campaign: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str) -> None:
    assert command.main(["fit", str(campaign), *words]) == 2
    error = capsys.readouterr().err
    assert says(error, said) and "Traceback" not in error


def test_mistakes_in_files(campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = campaign.read_text().replace("use: fit", "use: validate")
    campaign.write_text(text)
    assert command.main(["fit", str(campaign)]) == 2
    assert says(capsys.readouterr().err, "campaign.yaml: E-CLI-08")
    assert command.main(["fit", str(tmp_path / "nowhere.yaml")]) == 2
    path = tmp_path / "table.csv"
    path.write_text(CSV + "20,10,1,1.0,1.1,0.2\n")
    assert command.main(["fit", str(path), "--law", "zener"]) == 2
    assert says(capsys.readouterr().err, "--layers, E-CLI-03")
    assert command.main(["fit", str(path), "--law", "zener", *SPECIMEN]) == 2
    assert says(capsys.readouterr().err, "3 E-FIT-01")
    assert command.main(["fit", str(path), "--law", "zener", *SPECIMEN, "--against", "forces"]) == 2
    assert command.main(["fit", str(path), *SPECIMEN]) == 2
    assert says(capsys.readouterr().err, "--law: E-CLI-03")


def test_how_a_file_is_read_does_not_say_that_it_is_left_out(
    campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = campaign.parent / "test_0.csv"
    path.write_text(path.read_text(encoding="utf-8").replace(",", ";"), encoding="utf-8")
    assert command.main(["fit", str(campaign), "--starts", "1", "--law", "kelvin_voigt"]) == 0
    reported = capsys.readouterr().err
    assert "note: test_0: read: semicolons between columns" in reported and "not fitted" not in reported


def test_a_test_file_is_distinguished_from_a_property_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.csv").write_text("time_s,displacement_mm,force_kN\n0,0,0\n1,1,1\n", encoding="utf-8")
    assert command.main(["fit", str(tmp_path / "a.csv")]) == 2
    assert says(capsys.readouterr().err, "a.csv: E-CLI-03")
