"""What the report says of the settings of a design is what was found, not that the program was asked to find it."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import pytest
from building_examples import SMALL

from edesign.archive.reader import open_archive
from edesign.frame.building_file import load_building
from edesign.report.archive.document import page_text
from edesign.report.archive.summary import summarise
from edesign.report.archived import archived_building
from edesign.report.building.facts import design_rows
from edesign.report.building.results import BuildingResults
from edesign.report.export.facts import provenance_facts
from edesign.report.export.workbook import _origin
from edesign.study.run.building import run_building

EVEN = SMALL.replace("x: [6 m, 4 m]", "x: [5 m, 5 m]")
"""Symmetric in plan and of one plan over its height."""
SET_BACK = EVEN.replace("columns:", "setbacks: [{floors: 2, bays: {x: 1, y: all}}]\ncolumns:", 1).replace(
    "frames: [A, C], bays: 1, kind", "frames: [A, B], bays: 1, kind"
)
"""Floor 2 covers one of two bays: 50 % of the plan, and 20 % is allowed (EN 1998-1, 4.2.3.3(5)a)."""
FACTORS = EVEN.replace(
    "code: ec8-2004,", "code: ec8-2004, country: greece, national: {resistance_factors: {M0: 1.05, M1: 1.05}},"
)


def said(folder: Path, text: str) -> tuple[dict[str, str], Path]:
    """The rows on the settings, and the archive."""
    (folder / "small.yaml").write_text(text, encoding="utf-8")
    path, _ = run_building(load_building(folder / "small.yaml"))
    with open_archive(path) as archive:
        building = archived_building(archive)
        assert building is not None
        return dict(design_rows(building, BuildingResults(archive))), path


@pytest.mark.parametrize(("text", "elevation", "q"), [(EVEN, "regular", 4.0), (SET_BACK, "not regular", 0.8 * 4.0)])
def test_regularity_and_q_are_those_found(tmp_path: Path, text: str, elevation: str, q: float) -> None:
    """q = 4 of diagonals in DCM, Table 6.2, times 0.8 where the elevation is irregular (EN 1998-1, 4.2.3.1(7))."""
    rows, path = said(tmp_path, text)
    plan, up = rows["Regularity"].split("; ")
    assert up == f"{elevation} in elevation, as found"
    assert plan == ("regular in plan, as found" if text is EVEN else plan)
    assert rows["System along y"] == f"concentric bracing with diagonals, q = {q:.4g}, by Table 6.2 of EN 1998-1"
    assert rows["System along x"] == "moment frame, q = 4, as given"
    page = page_text(path)
    assert f"{elevation} in elevation, as found" in page
    # the cover states the input that the archive is of
    checksum = hashlib.sha256((tmp_path / "small.yaml").read_bytes()).hexdigest()
    assert f"input SHA-256 {checksum[:16]}" in page and "SHA-256 unknown" not in page
    assert page.count(checksum) >= 1  # in full under Provenance
    assert summarise(path)["archive"]["building_checksum"] == checksum
    with open_archive(path) as archive:
        assert _origin(provenance_facts(archive)).endswith(f"input SHA-256 {checksum}")


def test_what_the_file_claims_is_reported_as_its_claim(tmp_path: Path) -> None:
    text = EVEN.replace("ductility_class: medium", "ductility_class: medium\n  regular_in_plan: false\n  modes: 4")
    rows, _ = said(tmp_path, text)
    assert rows["Regularity"] == "not regular in plan, as the file says; regular in elevation, as found"
    assert rows["Natural modes"].startswith("4, as given: ")


def test_modes_that_count_are_reported_with_their_mass(tmp_path: Path) -> None:
    """Two rigid floors have three degrees each, and all modes have all of the mass."""
    rows, _ = said(tmp_path, EVEN)
    assert rows["Natural modes"] == ("6, all that the building has: 100.0 % along x and 100.0 % along y of the mass")


def test_factors_that_count_are_reported_and_not_defaults(tmp_path: Path) -> None:
    """As Italy has them, gamma_M0 = gamma_M1 = 1.05 (NTC 2018, Table 4.2.VII); `design` gives gamma_ov itself."""
    text = FACTORS.replace("ductility_class: medium", "ductility_class: medium\n  overstrength: 1.2")
    rows, _ = said(tmp_path, text)
    assert re.match(r"gamma_M0 = 1.05, gamma_M1 = 1.05, gamma_G = ", rows["Partial factors"])
    assert rows["Overstrength"] == "gamma_ov = 1.2"
    assert rows["National values"] == (
        "gamma_M0, gamma_M1, gamma_G, gamma_Q, nu: National Annex of Greece; recommended ones where its data file says "
        "nothing, but where `hazard: national` states them"
    )


def test_accidental_torsion_that_does_not_act_is_not_claimed(tmp_path: Path) -> None:
    """Static moments act on rigid floors, and there are none."""
    rows, path = said(tmp_path, EVEN.replace("storeys: [4 m, 3 m]", "storeys: [4 m, 3 m]\ndiaphragms: none"))
    assert rows["Combination of modes"].endswith("accidental eccentricity: none")
    assert "Accidental torsion is left out: no floor is rigid" in page_text(path)
