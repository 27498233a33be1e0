"""A design that no variant has is not made, and equal variants give equal results: a study tells of both."""

from __future__ import annotations

from pathlib import Path

from cases.small_study import write

from edesign.building.project_file import load_study
from edesign.study.check.advice import study_warnings
from edesign.study.run.study_plan import make_study_plan


def test_a_design_without_a_variant_is_told(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")

    def told() -> list[str]:
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "no variant" in one]

    assert told() == []
    start = text.index("  added:\n")
    block = text[start : text.index("\nvariants:")].rstrip()
    path.write_text(text.replace(block, f"{block}\n{block.replace('added:', 'spare:', 1)}"), encoding="utf-8")
    assert told() == ["design spare: no variant has it, so it is not made; write `design: spare` at a variant"]


def test_variants_that_are_the_same_are_told(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8")

    def told() -> list[str]:
        study = load_study(path)
        return [one for one in study_warnings(study, make_study_plan(study), {}) if "are the same" in one]

    assert told() == []
    same = "variants `twin`, `bare` are the same: each analysis of one gives the results of the other"
    other = "{dampers: none, values: {materials.S275.E: 200 GPa}}"
    for twin, expected in (("{dampers: none}", [same]), (other, [])):
        path.write_text(text.replace("\nvariants:\n", f"\nvariants:\n  twin: {twin}\n"), encoding="utf-8")
        assert told() == expected
