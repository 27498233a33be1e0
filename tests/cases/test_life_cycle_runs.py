"""A study that asks how often limits are passed in the life of a building: run, tables, and the report's page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cases.incremental_portal import write

from edesign.archive.reader import open_archive
from edesign.codes.interpolation import log_log
from edesign.frame.project_file import load_study
from edesign.report.capacity.incremental_results import read_incremental
from edesign.report.capacity.incremental_tables import incremental_tables
from edesign.report.tables.text import plain
from edesign.study.run.run import run_study

ABOUT = """records: [shake, fast, slow], intensity: spectral_acceleration, period: 0.8 s, level: MCE,
    levels: [0.05 g, 0.2 g, 0.5 g, 1 g, 1.5 g, 2 g, 3 g, 4 g, 6 g, 8 g], collapse_drift: 8 %, free_vibration: 2 s,
    limits: {LS: {interstorey_drift: 2.5 %}},
    life_cycle: {hazard_curve: {levels: {DBE: 475 years, MCE: 2475 years}}, years: 50 years, dispersion: 0.2,
                 losses: {LS: 30 %, collapse: 100 %}, discount: 3 %}"""


def run(folder: Path, about: str) -> Path:
    """The archive of a study of three motions."""
    path = write(folder, about)
    t = np.arange(400) * 0.01
    text = (folder / "project.yaml").read_text(encoding="utf-8")
    for name, frequency in (("fast", 14.0), ("slow", 6.0)):
        motion = np.sin(np.pi * t / 4.0) ** 2 * (np.sin(frequency * t) + 0.4 * np.sin(2.7 * frequency * t + 0.5))
        (folder / f"{name}.csv").write_text("\n".join(map(str, motion)), encoding="utf-8")
        entry = f"  {name}: {{file: {name}.csv, acceleration_unit: m/s^2, time_step: 0.01 s}}\n"
        text = text.replace("  still:", entry + "  still:")
    text = text.replace("levels: {MCE: {probability: 2 %}}", "levels: {DBE: {gamma_I: 1}, MCE: {probability: 2 %}}")
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    return run_study(load_study(path), backend="serial").archive


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run(tmp_path_factory.mktemp("life"), ABOUT)


def test_a_loss_without_collapses_is_a_lower_bound(tmp_path: Path) -> None:
    """At these intensities no record collapses; what those that pass LS cost is 0.3 times its rate."""
    first = ABOUT.replace(", 1.5 g, 2 g, 3 g, 4 g, 6 g, 8 g]", "]").replace("2.5 %", "1 %")
    with open_archive(run(tmp_path, first)) as opened:
        ((results),) = read_incremental(opened)
        tables = {table.title: table for table in incremental_tables(opened)}
    bare = results.life_cycle[0]
    assert bare.loss is not None and bare.uncounted == ("collapse",) and set(bare.exceedances) == {"LS"}
    assert bare.loss.annual == pytest.approx(0.3 * bare.exceedances["LS"].rate, rel=1e-12)
    losses = tables["ida: expected loss, of the value of the building"]
    assert losses.texts[0][1].startswith(">= ") and losses.texts[0][3:] == ["100"]
    assert "bare: a lower bound, without a loss of collapse" in " ".join(losses.notes)


def test_rates_follow_the_hazard_of_en_1998_1(archive: Path) -> None:
    """With k = 3, H = 1/475 (im / S_e)^-3: the rate is H(theta) exp(k^2 beta^2 / 2), EN 1998-1, 2.1(4), and Cornell et
    al. (2002). The MCE of 2 % in 50 years is 1.71 times the reference; 2475 years take 1.7334 by the law of 475 years.
    """
    with open_archive(archive) as opened:
        ((results),) = read_incremental(opened)
    assert [one.variant for one in results.life_cycle] == ["bare", "same"]
    first = results.life_cycle[0]
    assert first.curve is not None and first.loss is not None
    (k,) = first.curve.exponents
    assert k == pytest.approx(3.0, rel=0.03)  # (0.1 / 0.02)^(1/3) for the 2475 / 475 of Poisson's process
    fits = {one.limit: one.fit for one in results.fragilities if one.variant == "bare"}
    for limit, found in first.exceedances.items():
        fit = fits[limit]
        assert fit is not None
        beta = np.hypot(fit.beta, 0.2)
        rate = log_log(np.array(fit.theta), first.curve.intensity, first.curve.rate)
        expected = rate * np.exp(0.5 * (k * beta) ** 2)
        assert found.rate == pytest.approx(float(expected), rel=1e-9)
    rates = {name: found.rate for name, found in first.exceedances.items()}
    assert first.loss.annual == pytest.approx(0.3 * rates["LS"] + 0.7 * rates["collapse"], rel=1e-12)


def test_tables(archive: Path) -> None:
    with open_archive(archive) as opened:
        tables = {table.title: table for table in incremental_tables(opened)}
    rates = tables["ida: exceedance of limits"]
    assert [row[:2] for row in rates.texts][:2] == [["bare", "LS"], ["bare", "collapse"]]
    assert any("for modelling is added" in note for note in rates.notes)
    losses = tables["ida: expected loss, of the value of the building"]
    assert [row[0] for row in losses.rows] == ["bare", "same"]
    assert all(len(line) <= 100 for table in (rates, losses) for line in plain(table).splitlines())
