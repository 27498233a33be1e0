"""`edesign spectrum --code CODE --set KEY=VALUE`: actions of all codes without a project file."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.cli.main import main

ASCE = ["--code", "asce7-22", "--set", "S_DS=1.0g", "--set", "S_D1=0.6g", "--set", "T_L=8s"]
NTC = ["--code", "ntc-2018", "--ground", "C", "--set", "nominal_life=50 years", "--set", "class_of_use=II"]
SITE = [("limit_state", "SLV"), ("a_g", "0.26g"), ("F_0", "2.4"), ("T_C_star", "0.35s")]
NTC += [word for key, value in SITE for word in ("--set", f"levels.SLV.{key}={value}")]


def ordinates(words: list[str], path: Path) -> dict[float, float]:
    """Spectral acceleration by period, in g."""
    assert main(["spectrum", *words, "--csv", str(path), "--points", "3", "--periods", "0.06s", "0.96s"]) == 0
    rows = [line.split(",") for line in path.read_text().splitlines() if line[:1].isdigit()]
    return {round(float(row[0]), 4): float(row[1]) for row in rows}


def test_asce_7_by_its_equations(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """ASCE/SEI 7-22, 11.4.5.2: T_0 = 0.2 S_D1/S_DS = 0.12 s and T_S = 0.6 s."""
    found = ordinates(ASCE, tmp_path / "asce.csv")
    by_hand = {0.06: 1.0 * (0.4 + 0.6 * 0.06 / 0.12), 0.24: 1.0, 0.96: 0.6 / 0.96}
    assert found == pytest.approx(by_hand, rel=1e-6)


def test_ntc_2018_by_its_equations(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """NTC 2018, 3.2.3.2.1, subsoil C: S_S = 1.7 - 0.6 F_0 a_g/g, C_C = 1.05 T_C*^-0.33, T_B = T_C/3."""
    S, T_C = 1.7 - 0.6 * 2.4 * 0.26, 1.05 * 0.35**-0.33 * 0.35
    T_B, peak = T_C / 3.0, 0.26 * S * 2.4
    found = ordinates([*NTC, "--level", "SLV"], tmp_path / "ntc.csv")
    by_hand = {0.06: peak * (0.06 / T_B + (1.0 - 0.06 / T_B) / 2.4), 0.24: peak, 0.96: peak * T_C / 0.96}
    assert found == pytest.approx(by_hand, rel=1e-6)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--code", "asce7-22", "--set", "S_DS=1.0"], "--set S_DS: the bare number `1.0` needs a unit"),
        (["--code", "asce7-22", "--set", "S_SD=1g"], "--set S_SD: unknown key; did you mean `S_DS`?"),
        (["--code", "asce7-22", "--set", "S_DS"], "--set: `S_DS` is no KEY=VALUE"),
        (["--code", "asce7-22", "--a-gr", "0.2g"], "--a-gr: only with the code `ec8-2004`"),
        (["--code", "ec8-2004", "--set", "a_gR=0.2g"], "--set: only with a --code other than"),
        (["--code", "asce7-23"], "--code: `asce7-23`"),
        (["--code", "user"], "--code: spectra as tables stand in a project file"),
        (NTC[:-2], "--set levels.SLV.T_C_star: this key is missing"),
        ([*NTC, "--level", "SLD"], "SLD"),
    ],
)
def test_messages_name_the_option(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["spectrum", *words]) == 2
    assert said in capsys.readouterr().err
