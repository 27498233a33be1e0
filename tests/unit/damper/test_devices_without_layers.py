"""Devices without layers of elastomer: checked, fitted, judged and calibrated in displacement and force."""

from __future__ import annotations

import json
from math import gamma
from pathlib import Path

import numpy as np
import pytest
import yaml
from messages import says

from edesign.cli import main as command
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import load_campaign, write_campaign
from edesign.damper.testing.device_cycles import runs_of
from edesign.errors import InputError
from edesign.report.damper.measured_figures import measured_figure

C, ALPHA = 200e3, 0.4  # N (s/m)^0.4
SINES = ((0.5, 0.02), (1.0, 0.02), (0.5, 0.04), (1.0, 0.04), (0.7, 0.03))  # Hz, m; the last one validates
LAW = "law: {type: viscous_power, parameters: {c: 200 kN*s^0.4/m^0.4, alpha: 0.4}}\n"


def campaign(folder: Path, head: str) -> Path:
    """Sines of F = c |v|^alpha sgn v in closed form, with noise of 100 N."""
    random, lines = np.random.default_rng(5), []
    for i, (frequency, x0) in enumerate(SINES):
        w = 2.0 * np.pi * frequency
        t = np.arange(0.0, 5.0 / frequency, 1.0 / (100.0 * frequency))
        v = x0 * w * np.cos(w * t)
        force = C * np.abs(v) ** ALPHA * np.sign(v) + 100.0 * random.standard_normal(t.size)
        columns = np.column_stack([t, 1e3 * x0 * np.sin(w * t), 1e-3 * force])
        headers = "time_s,displacement_mm,force_kN"
        np.savetxt(folder / f"sine_{i}.csv", columns, "%.9g", ",", header=headers, comments="")
        use = "validate" if i == len(SINES) - 1 else "fit"
        lines.append(f"  - {{file: sine_{i}.csv, temperature: 20 degC, use: {use}, start: in_motion}}\n")
    path = folder / "campaign.yaml"
    path.write_text(head + "acceptance: {device: viscous}\ntests:\n" + "".join(lines), encoding="utf-8")
    return path


@pytest.mark.parametrize(("head", "name"), [("", "specimen"), ("specimen: {name: FVD 12}\n", "FVD 12")])
def test_check_reports_displacements(tmp_path: Path, capsys: pytest.CaptureFixture[str], head: str, name: str) -> None:
    assert command.main(["check", str(campaign(tmp_path, head))]) == 0
    shown = capsys.readouterr().out
    assert f"{name}: no layers" in shown and "20 to 40 mm largest displacement" in shown and "strain" not in shown


def test_fit_recovers_the_dashpot(tmp_path: Path) -> None:
    path, out = campaign(tmp_path, "law: {type: viscous_power}\n"), tmp_path / "out"
    assert command.main(["fit", str(path), "-q", "-o", str(out)]) == 0
    data = yaml.safe_load((out / "law.yaml").read_text(encoding="utf-8"))
    errors = json.loads((out / "fit.json").read_text(encoding="utf-8"))["standard_error"]
    values = read_parameters(LAWS[data["type"]], data["parameters"])
    # 100 N of some 200 kN on 2000 samples: 1e-5 of the force; three standard errors, reported and expected
    assert values == pytest.approx({"c": C, "alpha": ALPHA}, rel=3e-4)
    assert abs(values["alpha"] - ALPHA) < 3.0 * errors["alpha"]
    assert "prototype" not in data and data["tested"]["deformation"] == "20 to 40 mm"
    assert command.main(["check", str(out / "law.yaml")]) == 0


def test_the_sheet_has_the_energy_of_a_power_of_the_velocity(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """W = 4 c 2^alpha Gamma(1 + alpha/2)^2 / Gamma(2 + alpha) x0^(1 + alpha) omega^alpha (Soong and Constantinou)."""
    path = campaign(tmp_path, LAW)
    assert command.main(["sheet", str(path)]) == 0
    assert "Met: all 6 criteria are met in all 5 runs." in capsys.readouterr().out
    factor = 4.0 * 2.0**ALPHA * gamma(1.0 + ALPHA / 2.0) ** 2 / gamma(2.0 + ALPHA)
    for (frequency, x0), test in zip(SINES, load_campaign(path).tests, strict=True):
        (found,) = runs_of(test)
        closed = factor * C * x0 ** (1.0 + ALPHA) * (2.0 * np.pi * frequency) ** ALPHA
        # sampling at 100 a cycle of a force that reverses steeply; the noise is a tenth of it
        assert np.asarray(found.loops.work) == pytest.approx(np.full(found.cycles, closed), rel=2e-3)


def test_a_calibration_finds_nothing_missing(tmp_path: Path) -> None:
    path, out = campaign(tmp_path, LAW), tmp_path / "out"
    words = ["calibrate", str(path), "--workers", "1", "-q", "-o", str(out)]
    assert command.main(words) == 0
    assert json.loads((out / "calibration.json").read_text(encoding="utf-8"))["verdict"] == "none"
    data = yaml.safe_load((out / "law.yaml").read_text(encoding="utf-8"))
    assert "prototype" not in data and data["tested"]["deformation"] == "20 to 40 mm"


@pytest.mark.parametrize("words", [["characterise"], ["fit", "--against", "properties"]])
def test_moduli_name_the_keys_that_they_need(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    assert command.main([words[0], str(campaign(tmp_path, LAW)), *words[1:]]) == 2
    said = capsys.readouterr().err
    assert "specimen: {layers: 2, layer_area: 41400 mm^2" in said and "`edesign sheet`" in said


def test_the_size_of_a_layer_asks_for_their_number(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"specimen\.layers: .*E-KEY-02"):
        load_campaign(campaign(tmp_path, "specimen: {layer_area: 41400 mm^2}\n"))


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    read = load_campaign(campaign(tmp_path, "specimen: {name: FVD 12}\n"))
    write_campaign(tmp_path / "again", read.specimen, read.tests, specimen_name=read.specimen_name)
    again = load_campaign(tmp_path / "again" / "campaign.yaml")
    assert (again.specimen, again.specimen_name, again.label) == (None, "FVD 12", "FVD 12")


PROGRAMME = (
    LAW + "sampling_rate: 100 Hz\ntests:\n  - {type: sine, SIZE, frequency: 1 Hz, cycles: 4, temperature_C: 20}\n"
)


def test_a_programme_in_displacements(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, out = tmp_path / "programme.yaml", tmp_path / "out"
    path.write_text(PROGRAMME.replace("SIZE", "displacement: 20 mm"), encoding="utf-8")
    assert command.main(["check", str(path)]) == 0
    assert "20 mm largest displacement" in capsys.readouterr().out
    assert command.main(["test", str(path), "-o", str(out)]) == 0
    assert "no moduli of a specimen without layers; `edesign sheet" in capsys.readouterr().out
    (test,) = load_campaign(out / "campaign.yaml").tests
    assert (test.name, test.title) == ("001_sine_20mm_1Hz_20C", "sine 20 mm 1 Hz")
    assert not (out / "properties.csv").exists()
    loop = measured_figure(test, None).axes[-1]
    assert (loop.get_xlabel(), loop.get_ylabel()) == ("displacement (mm)", "force (kN)")
    path.write_text(PROGRAMME.replace("SIZE", "strain: 20 %"), encoding="utf-8")
    assert command.main(["test", str(path), "-o", str(out)]) == 2
    assert says(capsys.readouterr().err, "tests[0].strain: `specimen.layers`, E-TEST-01")


@pytest.mark.parametrize("name", ["fit", "calibrate", "characterise", "sheet"])
def test_a_programme_in_place_of_a_campaign(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    path = tmp_path / "programme.yaml"
    path.write_text(PROGRAMME.replace("SIZE", "displacement: 20 mm"), encoding="utf-8")
    assert command.main([name, str(path)]) == 2
    said = capsys.readouterr().err
    assert f"this is a programme, and tests that were made are needed; `edesign test {path} --output DIR`" in said
    assert "unknown" not in said


def test_a_campaign_in_place_of_a_programme(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["test", str(campaign(tmp_path, LAW)), "-o", str(tmp_path / "out")]) == 2
    assert "E-FILE-05" in capsys.readouterr().err
