"""The study of the case `brb_frame`: areas of cores for given storey shears, and what histories ask of them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import HERE

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_study
from edesign.report.archive.document import page_text
from edesign.report.archive.study_tables import study_tables
from edesign.report.tables.table import Table
from edesign.study.run.run import run_study

SHEAR = np.array([444e3, 355e3, 200e3])
HEIGHTS = np.array([4.0, 3.5, 3.5])
F_YSC = 262e6


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("restrained")
    for name in ("records", "brb_frame"):
        shutil.copytree(HERE / name, folder / name)
    return run_study(load_study(folder / "brb_frame" / "study.yaml")).archive


def read(archive: Path, *names: str) -> list[Group]:
    with open_archive(archive) as opened:
        return [opened.group(name) for name in names]


def orders(archive: Path) -> list[Table]:
    with open_archive(archive) as opened:
        return [table for table in study_tables(opened) if table.title.startswith("Largest values of one damper")]


def test_areas_by_hand(archive: Path) -> None:
    # A_sc = share V / (n F_ysc cos theta): a diagonal of 6 m, and two braces of a chevron of 3.5 m each
    diagonals, chevrons = read(archive, "designs/diagonals", "designs/chevrons")
    cosine = 6.0 / np.hypot(6.0, HEIGHTS)
    np.testing.assert_allclose(diagonals.variables["device_core_area"].values, SHEAR / (F_YSC * cosine), rtol=1e-9)
    share, cosine = float(str(chevrons.attributes["share"])), 3.5 / np.hypot(3.5, HEIGHTS)
    expected = share * SHEAR / (2.0 * F_YSC * cosine)
    np.testing.assert_allclose(chevrons.variables["device_core_area"].values, expected, rtol=1e-9)
    assert list(chevrons.variables["device_count"].values) == [2, 2, 2]


@pytest.mark.parametrize("name", ["diagonals", "chevrons"])
def test_variants_have_the_braces_of_their_design(archive: Path, name: str) -> None:
    design, modes, history = read(archive, f"designs/{name}", f"analyses/{name}.modes", f"analyses/{name}.DBE.motion")
    np.testing.assert_allclose(modes.variables["period"].values, design.variables["elastic_period"].values, rtol=1e-6)
    storey = history.variables["damper_storey"].values.astype(int) - 1
    area = design.variables["device_core_area"].values
    np.testing.assert_allclose(history.variables["damper_yield_force"].values, F_YSC * area[storey], rtol=1e-9)
    strength = design.variables["device_adjusted_compression"].values
    np.testing.assert_allclose(history.variables["damper_adjusted_compression"].values, strength[storey], rtol=1e-9)
    assert np.all(-history.variables["damper_force_min"].values <= strength[storey] / 1.1)  # R_y is for connections


def test_devices_to_order(archive: Path) -> None:
    table = orders(archive)[0]
    design, history = read(archive, "designs/diagonals", "analyses/diagonals.DBE.motion")
    rows = [row for row in table.texts if row[0] == "diagonals, DBE"]
    columns = {header: [float(row[i]) for row in rows] for i, header in enumerate(table.headers) if i > 0}
    area = SHEAR / (F_YSC * 6.0 / np.hypot(6.0, HEIGHTS))
    printed = pytest.approx
    assert columns["A_sc [mm2]"] == printed(1e6 * area, rel=1e-3)
    assert columns["T_adj [kN]"] == printed(1e-3 * 1.46 * 1.1 * F_YSC * area, rel=1e-3)
    assert columns["C_adj [kN]"] == printed(1e-3 * 1.12 * 1.46 * 1.1 * F_YSC * area, rel=1e-3)
    strain = np.maximum(history.variables["core_strain_max"].values, -history.variables["core_strain_min"].values)
    assert columns["max strain [%]"] == printed(100.0 * strain, rel=1e-3)
    assert columns["max cum. [-]"] == printed(history.variables["cumulative_ductility_final"].values, rel=1e-3)
    estimate = [float(row[table.headers.index("mean strain [%]")]) for row in table.texts if row[0] == "estimate"]
    assert estimate == printed(100.0 * design.variables["estimated_device_core_strain"].values, rel=1e-3)


@pytest.mark.parametrize(("bound", "factor"), [("lower", 0.9), ("upper", 1.2)])
def test_strengths_of_a_bound(archive: Path, bound: str, factor: float) -> None:
    """All forces have the factor of a bound, the adjusted strengths too; the core that is ordered stays."""
    design, history = read(archive, "designs/diagonals", f"analyses/diagonals_{bound}.DBE.motion")
    table = orders(archive)[0]
    rows = [row for row in table.texts if row[0] == f"diagonals_{bound}, DBE"]
    printed = {header: np.array([float(row[i]) for row in rows]) for i, header in enumerate(table.headers) if i > 0}
    assert printed["A_sc [mm2]"] == pytest.approx(1e6 * design.variables["device_core_area"].values, rel=1e-3)
    for column, side in (("T_adj [kN]", "tension"), ("C_adj [kN]", "compression")):
        of_model = history.variables[f"damper_adjusted_{side}"].values
        assert printed[column] == pytest.approx(1e-3 * of_model, rel=1e-3)  # four digits
        assert of_model == pytest.approx(factor * design.variables[f"device_adjusted_{side}"].values, rel=1e-9)
    assert "T_adj and C_adj have the bound of a variant; what is ordered is without." in table.notes


def test_report(archive: Path) -> None:
    text = page_text(archive)
    assert "Devices to order" in text and "AISC 341-16, F4.2a" in text
