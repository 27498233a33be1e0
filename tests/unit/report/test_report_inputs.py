"""Assumptions follow from the project; mean profiles stand in one axis; checks have their source."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from unit.report.figure_archive import small_archive

from edesign.archive.reader import open_archive
from edesign.assess.verdicts import Verdict
from edesign.project import load_project
from edesign.project.criteria.criteria import MeasureCriterion, PerformanceCriterion
from edesign.project.notation.names import damper_place
from edesign.report.assessment.check_table import check_table
from edesign.report.inputs.assumptions import assumption_rows
from edesign.report.inputs.mass_table import mass_tables
from edesign.report.response.mean_profiles import mean_profile_figures

CASES = Path(__file__).parents[2] / "cases"
THESIS = Path(__file__).parents[3] / "projects" / "thesis_10_storey" / "project.yaml"


def said(project: Any) -> dict[str, str]:
    return dict(assumption_rows(project))


def test_assumptions_follow_from_the_project() -> None:
    project = load_project(THESIS)
    found = said(project)
    assert "P-Delta" in found["Second-order effects"] and "no diaphragms" in found["Floors"]
    assert (
        "horizontal motion alone" in found["Mass"] and "There is no vertical ground motion." in found["Ground motion"]
    )
    assert found["Inherent damping"] == (
        "Damping is proportional to the mass and to the stiffness of each moment: this second part falls where members "
        "yield. The part of the mass stays."
    )
    changed = project.with_values(
        {
            "elements.geometry.columns": "corotational",
            "frame.diaphragms": "all",
            "damping.stiffness": "initial",
            "validity.drift": "10 %",
        }
    )
    other = said(changed)
    assert "large displacements" in other["Second-order effects"] and "All floors are rigid" in other["Floors"]
    assert "its forces may grow" in other["Inherent damping"]
    assert "passes 10.0 %" in other["When an analysis has failed"]


@pytest.mark.parametrize(
    ("case", "topic", "words"),
    [
        ("buckling_braces", "Braces", "Braces buckle in the analysis"),
        ("leaning_column", "Second-order effects", "A leaning column has the loads"),
        ("footings_on_soil", "Ground and supports", "elastic half-space"),
        ("wave_passage", "Ground motion", "one after the other"),
        ("vertical_motion", "Ground motion", "vertical ground motion"),
        ("isolated_frame", "Dampers", "Isolators carry the gravity loads"),
        ("deteriorating_hinges", "Yielding", "lose strength and stiffness"),
        ("rigid_ends", "Connections", "rigid ends"),
    ],
)
def test_what_a_case_is_about_is_among_its_assumptions(case: str, topic: str, words: str) -> None:
    assert words in said(load_project(CASES / case / "project.yaml"))[topic]


def test_elastic_members_yield_in_their_hinges() -> None:
    plain = "whatever their forces are"
    project = load_project(CASES / "deteriorating_hinges" / "project.yaml")
    elastic = {f"materials.{name}": {"law": "elastic", "E": "210 GPa"} for name in ("S355", "S275")}
    assert "between the hinges and joints at their ends" in said(project.with_values(elastic))["Yielding"]
    assert plain not in said(project.with_values(elastic))["Yielding"]


def test_every_sentence_is_one() -> None:
    for path in sorted(CASES.glob("*/project.yaml")):
        rows = assumption_rows(load_project(path))
        assert rows, path.parent.name
        for topic, text in rows:
            assert text.endswith(".") and "  " not in text, (path.parent.name, topic)


def test_places_of_dampers_are_words() -> None:
    assert damper_place("V_2_5") == ("chevron", "bay 2") == damper_place("V_2_5_2")
    assert damper_place("V_2_5_r") == ("in place of chevron braces", "bay 2")
    assert damper_place("S_1_3") == ("between floors", "bay 1")
    assert damper_place("RY_A_1_5") == ("rising diagonal", "YA bay 1")
    assert damper_place("VX_12_2_5_f") == ("in place of chevron braces", "X12 bay 2")
    assert damper_place("N_A1.0_B1.1") == ("between nodes", "A1.0 to B1.1")
    assert damper_place("I_AB") == ("isolator", "line AB") and damper_place("N_A0_B1") == ("between nodes", "A0 to B1")
    assert damper_place("G_A_2") == ("beside the isolated base", "line A")


def test_means_of_all_variants_stand_in_one_axis(tmp_path: Path) -> None:
    with open_archive(small_archive(tmp_path)) as archive:
        ((name, caption, figure),) = mean_profile_figures(archive)
    assert name == "mean_profiles_DBE" and caption.startswith("Mean peaks over the height at DBE")
    drift = next(axis for axis in figure.axes if axis.get_xlabel() == "interstorey drift (%)")
    means = [line for line in drift.lines if line.get_marker() == "o"]
    # means of 1, 2, 3 times 1 % and 0.5 %, and of the two records of the other variant
    assert [list(line.get_xdata()) for line in means] == [pytest.approx([2.0, 1.0]), pytest.approx([0.65, 0.325])]
    assert len({line.get_color() for line in means}) == 2
    assert "interstorey drift up to bare 2.00, damped 0.650 %" in caption


def verdict(name: str, met: bool, value: float) -> Verdict:
    about = ("interstorey drift at most 1 %", "damped", "DBE", "mean", value, 0.01, "1", met, "")
    return Verdict(name, *about, "damped.DBE.Tabas1978_FER-L1", 3, "", 7, ())


def test_checks_print_source_demand_capacity_and_what_governs() -> None:
    drift = MeasureCriterion(name="drift", measure="interstorey_drift", most="1 %", source="client, letter of 3 May")
    level = PerformanceCriterion(name="level", performance="LS", by="drift")
    bare = MeasureCriterion(name="other", measure="interstorey_drift", most="1 %")
    verdicts = [verdict("drift", True, 0.008), verdict("level", False, 0.012), verdict("other", True, 0.005)]
    table = check_table(verdicts, (drift, level, bare))
    rows = [dict(zip(table.headers, row, strict=True)) for row in table.texts]
    assert [row["source"] for row in rows] == ["client, letter of 3 May", "FEMA 356, Table C1-3", "-"]
    assert rows[0] == {
        "check": "drift",
        "requirement": "interstorey drift at most 1 %",
        "source": "client, letter of 3 May",
        "variant": "damped",
        "level": "DBE",
        "demand": "0.8 % (mean of 7)",
        "capacity": "1 %",
        "D/C": "0.80",
        "verdict": "met",
        "governs": "storey 3, Tabas 1978 FER-L1",
    }
    assert any("does not say where the limit comes from" in note for note in table.notes)
    assert table.headers[3] == "verdict", "before all that is wide: a screen cuts the end of a table"
    alone = check_table([verdict("other", True, 0.005)], (bare,))
    assert "source" not in alone.headers and any("where the limit comes from" in note for note in alone.notes)


def test_masses_that_differ_by_rounding_are_those_of_one_table() -> None:
    """A node in the middle of a beam sums its loads in another order; 1 % more is another mass."""
    project = load_project(THESIS)
    factors = {"bare": 1.0, "halved beams": 1.0 + 4e-16, "heavier": 1.01}

    def frame(variant: str) -> SimpleNamespace:
        return SimpleNamespace(masses={node: 1234.5 * factors[variant] for node in project.frame.nodes})

    found: Any = SimpleNamespace(variants=list(factors), project=lambda variant: project, frame=frame)
    said = [table.title for table in mass_tables(found)]
    assert said == [f"Masses and weights of the floors, {names}" for names in ("bare, halved beams", "heavier")]
