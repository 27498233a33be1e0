"""The case `user_spectrum` against an oscillator of this test's own, and other codes in the place of its table."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import suite_project
from cases.conftest import HERE, copied_study
from messages import says
from scipy.signal import lfilter

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.frame.project_file import load_study
from edesign.project.notation.units import STANDARD_GRAVITY as G
from edesign.study.run.run import run_study

CASE = HERE / "user_spectrum"


def own_psa(ground: np.ndarray, step: float, period: float, ratio: float = 0.05) -> float:
    """Pseudo-acceleration of an oscillator under straight lines between samples, by its exact recurrence, m/s2."""
    omega = 2.0 * np.pi / period
    matrix = np.array([[0.0, 1.0], [-(omega**2), -2.0 * ratio * omega]])
    values, vectors = np.linalg.eig(matrix)
    exact = (vectors * np.exp(values * step)) @ np.linalg.inv(vectors)
    solve = np.linalg.inv(matrix)
    load = np.array([0.0, -1.0])
    ramp = solve @ (solve @ (exact - np.eye(2)) / step - np.eye(2)) @ load  # of the later sample
    rest = solve @ (exact - np.eye(2)) @ load - ramp  # of the earlier one
    # x_k+1 = E x_k + rest a_k + ramp a_k+1, as a recurrence of the displacement alone
    E = exact.real
    trace, determinant = np.trace(E), np.linalg.det(E)
    first, second = rest.real, ramp.real
    b = [second[0], first[0] + E[0, 1] * second[1] - E[1, 1] * second[0], E[0, 1] * first[1] - E[1, 1] * first[0]]
    displacement = lfilter(b, [1.0, -trace, determinant], ground)
    return float(omega**2 * np.max(np.abs(displacement)))


def table(T: np.ndarray) -> np.ndarray:
    """The uniform hazard spectrum of the case from 0.1 s on by hand: 0.45 g to 0.5 s, then 0.225 g / T."""
    return np.where(T <= 0.5, 0.45, 0.225 / T) * G


def test_the_record_is_scaled_to_the_table(archive_of: Callable[[str], Path]) -> None:
    """One factor makes the ratios of record to table 1 in the mean of their logarithms, over 100 periods of the fit.

    Between samples this test takes straight lines and the program a band-limited motion, which from 0.4 s on, 20
    samples, differ by less than 1 %.
    """
    with open_archive(archive_of("user_spectrum")) as archive:
        group = archive.group("records/motion")
    time, T = group.coords["matched_time"].values, np.geomspace(0.4, 2.0, 100)
    fine = np.linspace(time[0], time[-1], 10 * (time.size - 1) + 1)  # so that peaks between samples are met
    ground = np.interp(fine, time, group.variables["matched_acceleration"].values)
    ratios = np.array([own_psa(ground, float(fine[1] - fine[0]), period) for period in T]) / table(T)
    assert float(np.exp(np.mean(np.log(ratios)))) == pytest.approx(1.0, abs=0.01)
    at = group.coords["period"].values
    np.testing.assert_allclose(group.variables["target"].values, table(at), rtol=1e-12)


def test_levels_are_factors_on_the_table(archive_of: Callable[[str], Path]) -> None:
    """An elastic frame under 1.5 times the motion moves 1.5 times as far, and so do the ordinates of the level."""
    with open_archive(archive_of("user_spectrum")) as archive:
        low, high = (archive.group(f"analyses/{name}") for name in ("uhs", "rare"))
        action = {name: archive.group(f"hazard/levels/{name}") for name in archive.names("hazard/levels")}
        text = str(archive.view().variables["hazard_text_spectrum_file"].values)
    assert high.attributes["scale_factor"] == pytest.approx(1.5 * low.attributes["scale_factor"], rel=1e-12)
    moved = [group.variables["floor_displacement"].values for group in (low, high)]
    np.testing.assert_allclose(moved[1], 1.5 * moved[0], rtol=1e-6, atol=1e-9)
    assert list(action) == ["UHS475", "rare"] and "T_R = 475 years" in action["UHS475"].attributes["facts"]
    elastic = [group.variables["elastic"].values for group in action.values()]
    np.testing.assert_allclose(elastic[1], 1.5 * elastic[0], rtol=1e-12)
    assert action["rare"].coords["period"].values[-1] <= 4.0  # the table ends there
    assert text == (CASE / "uhs.csv").read_text(encoding="utf-8")


def test_dampers_and_targets_under_the_table(tmp_path: Path) -> None:
    """With eta of EN 1998-1 by hand: 15 % (5 % of the frame and 10 % of the dampers) and 10 % of the target.

    The dampers hardly change the first mode (T by 4e-5), whose displacement of the roof is Gamma phi S_d.
    """
    with open_archive(run_study(load_study(copied_study("user_spectrum", tmp_path))).archive) as archive:
        design, modes = archive.group("designs/oil"), archive.group("analyses/bare.modes")
        targets = {name: archive.group(f"analyses/bare.push.n2.{name}") for name in ("UHS475", "rare")}
        about = archive.group_attributes("hazard")
    assert (about["damping_correction"], about["corner_periods"]) == ("ec8", {"T_C": 0.5})
    T = float(design.variables["period"].values.flat[0])
    S_d = table(np.array(T)) * (T / (2.0 * np.pi)) ** 2 * np.sqrt(10.0 / 20.0)
    roof = modes.variables["participation_factor_x"].values[0] * modes.variables["floor_shape"].values[0, -1]
    assert design.attributes["roof_displacement_m"] == pytest.approx(float(roof * S_d), rel=1e-3)
    for name, factor in (("UHS475", 1.0), ("rare", 1.5)):
        found = {key: float(targets[name].variables[f"n2_{key}"].values) for key in ("T", "S_e")}
        assert found["S_e"] == pytest.approx(factor * table(np.array(found["T"])) * np.sqrt(10.0 / 15.0), rel=1e-9)


def test_a_band_beyond_the_table_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("project.yaml", "uhs.csv"):
        text = (CASE / name).read_text(encoding="utf-8").replace("../records/", "")
        (tmp_path / name).write_text(text.replace("periods: [0.4 s, 2 s]", "periods: [0.4 s, 4.1 s]"), encoding="utf-8")
    shutil.copy(HERE / "records" / "motion.csv", tmp_path / "motion.csv")
    assert main(["check", str(tmp_path / "project.yaml")]) == 2
    assert says(capsys.readouterr().err, "records.motion.match: 4.1 s, 4 s; E-MATCH-01")


OTHERS = {
    "asce7-22": """\
  code: asce7-22
  S_DS: 0.45 g
  S_D1: 0.225 g
  T_L: 6 s
  R: 8
  levels: {UHS475: {earthquake: DE}, rare: {earthquake: MCE_R}}
""",
    "ntc-2018": """\
  code: ntc-2018
  nominal_life: 50 years
  class_of_use: II
  ground: A
  behaviour_factor: 4
  levels:
    UHS475: {limit_state: SLV, a_g: 0.18 g, F_0: 2.5, T_C_star: 0.5 s}
    rare: {limit_state: SLC, a_g: 0.25 g, F_0: 2.6, T_C_star: 0.6 s}
""",
}


FITTED = ("match: {method: scale,", "match: {level: UHS475, method: scale,")
ONE_LEVEL = ("record: motion, level: rare", "record: motion, level: UHS475")


def write_with(code: str, folder: Path, *changes: tuple[str, str]) -> Path:
    """The project with another code, in a folder."""
    text = (CASE / "project.yaml").read_text(encoding="utf-8")
    start, end = text.index("  code: user"), text.index("records:")
    text = text[:start] + OTHERS[code] + text[end:]
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    shutil.copy(HERE / "records" / "motion.csv", folder / "motion.csv")
    (folder / "project.yaml").write_text(text.replace("../records/motion.csv", "motion.csv"), encoding="utf-8")
    return folder / "project.yaml"


def run_with(code: str, folder: Path, *changes: tuple[str, str]) -> tuple[int, Path]:
    return main(["run", str(write_with(code, folder, *changes)), "--quiet"]), folder / "project.h5"


def spectra(archive: Path) -> dict[str, Group]:
    with open_archive(archive) as opened:
        return {name: opened.group(f"hazard/levels/{name}") for name in opened.names("hazard/levels")}


def test_asce_7_in_its_place(tmp_path: Path) -> None:
    """From T_0 = 0.1 s on the two-period spectrum is that of the table."""
    status, archive = run_with("asce7-22", tmp_path)
    assert status == 0
    with open_archive(archive) as opened:
        group = opened.group("records/motion")
    np.testing.assert_allclose(group.variables["target"].values, table(group.coords["period"].values), rtol=1e-9)
    design = spectra(archive)["rare"]
    ratio = design.variables["design"].values / design.variables["elastic"].values
    np.testing.assert_allclose(ratio, 1.0 / 8.0, rtol=1e-12)


@pytest.mark.parametrize("code", ["asce7-22", "ntc-2018"])
def test_spectrum_of_a_project(tmp_path: Path, capsys: pytest.CaptureFixture[str], code: str) -> None:
    """`edesign spectrum` writes the level's ordinates; 1 s at `rare`: 1.5 x 0.225 g, and 0.25 x 2.6 x 0.6 g."""
    write_with(code, tmp_path, *((FITTED, ONE_LEVEL) if code == "ntc-2018" else ()))
    table = tmp_path / "table.csv"
    options = ["--level", "rare", "--periods", "1s", "2s", "--points", "2", "--csv", str(table)]
    assert main(["spectrum", "--project", str(tmp_path / "project.yaml"), *options]) == 0
    header, row, _ = table.read_text(encoding="utf-8").splitlines()
    found = dict(zip(header.split(","), map(float, row.split(",")), strict=True))
    expected = {"asce7-22": 1.5 * 0.225, "ntc-2018": 0.25 * 2.6 * 0.6}[code]
    assert found["Se [g]"] == pytest.approx(expected, rel=1e-9)
    assert found["Sd [g]"] == pytest.approx(expected / {"asce7-22": 8.0, "ntc-2018": 4.0}[code], rel=1e-9)
    assert "rare" in capsys.readouterr().out


def test_ntc_2018_fits_to_one_limit_state(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Ground A, a_g F_0 = 0.45 g to T_C = 0.5 s, then 0.225 g / T: at SLV the table again, from T_B = 0.167 s on."""
    status, _ = run_with("ntc-2018", tmp_path)
    assert status == 2  # the levels differ in shape, and nothing says to which of them the record is fitted
    assert says(capsys.readouterr().err, "records.motion.match.level: `UHS475`, E-KEY-02")
    status, _ = run_with("ntc-2018", tmp_path, FITTED)
    assert status == 2
    assert says(capsys.readouterr().err, "analyses[2].level: `motion` `UHS475`, E-SCALE-02")
    status, archive = run_with("ntc-2018", tmp_path, FITTED, ONE_LEVEL)
    assert status == 0
    with open_archive(archive) as opened:
        group = opened.group("records/motion")
    at = group.coords["period"].values
    np.testing.assert_allclose(group.variables["target"].values, table(at), rtol=1e-9)
    found = spectra(archive)
    assert "T_R = 475 years" in found["UHS475"].attributes["facts"]
    assert found["UHS475"].attributes["corner_periods"]["T_D"] == pytest.approx(4 * 0.18 + 1.6, rel=1e-12)


def suite_with(code: str, folder: Path) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Attributes and criteria of the suite of `suite_project` under another code."""
    old = suite_project.HAZARD[: suite_project.HAZARD.index("records:")]
    new = "hazard:\n" + OTHERS[code].replace("UHS475", "DBE").replace("rare", "MCE")
    path = suite_project.write(folder, (old, new), ("  - {name: mce, kind: history, record: set, level: MCE}\n", ""))
    if code == "ntc-2018":
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace("match: {method", "match: {level: DBE, method"), encoding="utf-8")
    assert main(["run", str(path), "--quiet"]) == 0
    with open_archive(folder / "project.h5") as opened:
        about = opened.group_attributes("records/set")
        for member in opened.names("records/set"):
            assert opened.group_attributes(f"records/set/{member}")["suite_factor"] == about["suite_factor"]
    return about, about["criteria"]


def test_a_suite_is_checked_against_the_rules_of_asce_7(tmp_path: Path) -> None:
    """16.2.3.3: the mean of matched motions at least 110 % of the target; the factor on the suite sees to it."""
    about, criteria = suite_with("asce7-22", tmp_path)
    assert about["criteria_of"] == "ASCE/SEI 7-22"
    number, mean, use = criteria
    assert (number["required"], number["value"], number["passed"]) == (11, 3.0, False)
    assert mean["required"] == 1.1 and mean["passed"] and mean["value"] == pytest.approx(1.1, rel=1e-6)
    assert 1.0 < about["suite_factor"] < 1.5 and "maximum direction" in mean["detail"]
    assert use["detail"] == "the standard has no rule for fewer"


def test_a_suite_is_checked_against_the_rules_of_ntc_2018(tmp_path: Path) -> None:
    """3.2.3.6: between 0.9 and 1.3 of the target from 0.15 s to 2 s; the mean of the peaks is not asked for."""
    about, criteria = suite_with("ntc-2018", tmp_path)
    assert about["criteria_of"] == "NTC 2018"
    assert [found["clause"] for found in criteria] == [
        "NTC 2018, 7.3.5",
        "NTC 2018, 3.2.3.6",
        "NTC 2018, 3.2.3.6",
        "NTC 2018, 3.2.3.6",
        "NTC 2018, 7.3.5",
    ]
    least, greatest = criteria[1], criteria[2]
    assert "from 0.15 s to 2 s" in least["text"] and least["passed"] and greatest["passed"]
    assert 0.9 <= least["value"] <= greatest["value"] <= 1.3
