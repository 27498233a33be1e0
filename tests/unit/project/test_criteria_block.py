"""The blocks `criteria` and `objectives`: what they mean, and that what is wrong in them is reported with its place."""

from __future__ import annotations

import pytest
from messages import says
from unit.assess.assessed import FRAME, Part, part

from edesign.ground_motion.hazard import objective_level
from edesign.project import parse_project
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.checks.criteria import check_criteria
from edesign.project.criteria.criteria import HingeCriterion, MeasureCriterion, PerformanceCriterion
from edesign.project.reading.yaml_file import check_model

THESIS = """\
criteria:
  - {name: columns at DBE, plastic_hinges: none, of: columns, variants: damped, levels: DBE}
  - {name: columns at MCE, performance: IO, by: members, of: columns, variants: [damped], statistic: median}
  - {name: drift at DBE, measure: interstorey_drift, least: 0.7 %, most: 1.3 %, variants: damped, levels: DBE}
  - {name: base shear, measure: column_base_shear, most: 1.02 MN, statistic: 84 %}
  - {name: hinges, measure: beam_plastic_rotation_rad, most: 20 mrad, storeys: 1-2, members: [B_1_1, B_1_2]}
objectives: [h, l]
"""


def problems_of(text: str) -> list[str]:
    """All problems, as `line:column key: message`."""
    found, problems = check_model(text, Part, "study file", "criteria:")
    if found is not None:
        project = parse_project(FRAME)
        dampers = {"bare": (), "damped": ("V_1_1", "V_1_2")}
        kept: tuple[HistoryKind, ...] = ("floors", "supports")
        check_criteria((), found.criteria, found.objectives, project, tuple(dampers), problems, kept, dampers)
    return [f"{p.mark.line}:{p.mark.column} {p}" for p in problems.found]


def test_members_of_a_kind_that_does_not_stand() -> None:
    text = "criteria: [{name: a, measure: beam_plastic_rotation, most: 20 mrad, members: B_1_1}]\n"
    found, problems = check_model(text, Part, "study file", "criteria:")
    assert found is not None
    project = parse_project(FRAME.replace("frame:\n", "frame:\n  missing: {beams: [{floors: all}]}\n", 1))
    check_criteria((), found.criteria, (), project, (), problems)
    assert problems.found == []  # the verdict says that it does not apply


def test_the_three_kinds_of_criteria() -> None:
    assert problems_of(THESIS) == []
    columns, minor, drift, shear, hinges = part(THESIS).criteria
    assert isinstance(columns, HingeCriterion) and (columns.of, columns.rotation) == ("columns", 0.001)
    assert isinstance(minor, PerformanceCriterion)
    assert (minor.performance, minor.by, minor.of, minor.statistic) == ("IO", "members", "columns", "median")
    assert isinstance(drift, MeasureCriterion) and isinstance(shear, MeasureCriterion)
    assert (drift.least, drift.most) == pytest.approx((0.007, 0.013), rel=1e-15)
    assert (drift.variants, drift.levels) == (("damped",), ("DBE",))
    assert (shear.measure, shear.most, shear.statistic) == ("column_base_shear_N", 1.02e6, "84%")
    assert shear.variants == () and shear.levels == ()  # all
    assert isinstance(hinges, MeasureCriterion) and hinges.most == pytest.approx(0.02, rel=1e-15)
    assert hinges.storeys.numbers(1, 2) == (1, 2) and hinges.members == ("B_1_1", "B_1_2")


@pytest.mark.parametrize(
    ("criterion", "key", "said"),
    [
        ("{measure: interstory_drift, most: 1 %}", "criteria[0].measure", "`interstorey_drift` E-NAME-01"),
        ("{measure: interstorey_drift, most: 13 mm}", "criteria[0].most", "E-UNIT-02"),
        ("{measure: roof_displacement, most: 13 kN}", "criteria[0].most", "force E-UNIT-02"),
        ("{measure: column_axial_force, most: 1200}", "criteria[0].most", "E-UNIT-01"),
        ("{measure: beam_plastic_rotation, most: 2 %}", "criteria[0].most", "E-UNIT-02"),
        ("{measure: roof_drift, most: -1 %}", "criteria[0].most", "E-VALUE-02"),
        ("{measure: roof_drift}", "criteria[0].most", "E-KEY-02"),
        ("{measure: roof_drift, most: 1 %, least: 2 %}", "criteria[0].least", "E-VALUE-04"),
        ("{measure: roof_drift, most: 1 %, variants: dampd}", "criteria[0].variants", "`damped` E-NAME-01"),
        ("{measure: roof_drift, most: 1 %, levels: [DBE, DBF]}", "criteria[0].levels[1]", "`DBE` E-NAME-01"),
        ("{measure: roof_drift, most: 1 %, statistic: average}", "criteria[0].statistic", "`mean` E-VALUE-03"),
        ("{measure: roof_drift, most: 1 %, storeys: 2}", "criteria[0].storeys", "E-CRIT-04"),
        ("{measure: interstorey_drift, most: 1 %, storeys: 1-3}", "criteria[0].storeys", "E-NAME-01"),
        ("{measure: interstorey_drift, most: 1 %, members: C_A_1}", "criteria[0].members", "E-CRIT-04"),
        ("{measure: column_axial_force, most: 1 kN, members: C_C_1}", "criteria[0].members", "E-NAME-01"),
        ("{measure: column_axial_force, most: 1 kN, members: [B_1_1]}", "criteria[0].members[0]", "E-NAME-01"),
        ("{measure: roof_drift, most: 1 %, of: columns}", "criteria[0].of", "E-KEY-01"),
        ("{plastic_hinges: few}", "criteria[0].plastic_hinges", "E-VALUE-03"),
        ("{plastic_hinges: none, rotation: 1 %}", "criteria[0].rotation", "E-UNIT-02"),
        ("{performance: LF}", "criteria[0].performance", "`LS` E-VALUE-03"),
        ("{performance: LS, most: 1 %}", "criteria[0].most", "E-KEY-01"),
        ("{performance: SD}", "criteria[0].performance", "`standard: en1998-3` E-VALUE-03"),
        ("{performance: IO, standard: en1998-3}", "criteria[0].performance", "(`DL`, `SD`, `NC`) E-VALUE-03"),
        ("{performance: IO, standard: asce41}", "criteria[0].standard", "`asce41-17` E-VALUE-03"),
        ("{performance: IO, standard: asce41-17, by: drift}", "criteria[0].by", "`members` E-VALUE-03"),
        ("{quantityx: floor_acceleration, most: 1 g}", "criteria[0].quantityx", "`quantity` E-KEY-01"),
        ("{mesure: roof_drift, most: 1 %}", "criteria[0].mesure", "`measure` E-KEY-01"),
        ("{}", "criteria[0].measure", "E-KEY-02"),
        ("{quantity: flor_acceleration, most: 1 g}", "criteria[0].quantity", "`floor_acceleration` E-NAME-01"),
        ("{quantity: floor_acceleration, most: 1 kN}", "criteria[0].most", "force E-UNIT-02"),
        ("{quantity: floor_acceleration}", "criteria[0].most", "E-KEY-02"),
        ("{quantity: floor_acceleration, storeys: 1, most: 1 g}", "criteria[0].storeys", "`floors` E-CRIT-04"),
        ("{quantity: floor_acceleration, floors: 3, most: 1 g}", "criteria[0].floors", "1 to 2 E-NAME-01"),
        ("{quantity: floor_acceleration, side: tension, most: 1 g}", "criteria[0].side", "E-CRIT-04"),
        ("{quantity: base_shear, members: C_A_1, most: 1 kN}", "criteria[0].members", "E-CRIT-04"),
        ("{quantity: member_bending_moment, members: C_C_1, most: 1 kN*m}", "criteria[0].members", "E-NAME-01"),
        ("{quantity: beam_plastic_rotation, members: C_A_1, most: 1 mrad}", "criteria[0].members", "E-NAME-01"),
        ("{quantity: column_axial_force, side: pull, most: 1 kN}", "criteria[0].side", "`tension` E-VALUE-03"),
        ("{quantity: support_moment, lines: D, most: 1 kN*m}", "criteria[0].lines", "E-NAME-01"),
        ("{quantity: damper_force, dampers: V_2_1, most: 1 kN}", "criteria[0].dampers", "`V_1_1` E-NAME-01"),
        ("{quantity: energy_share, most: 20 %}", "criteria[0].term", "E-KEY-02"),
        ("{quantity: energy_share, term: heat, most: 20 %}", "criteria[0].term", "`dampers` E-VALUE-03"),
        ("{quantity: floor_spectral_acceleration, frequency: 5 Hz, most: 1 g}", "criteria[0].damping", "E-KEY-02"),
        ("{measure: roof_drift, most: 1 %, statistic: 0 %}", "criteria[0].statistic", "E-VALUE-02"),
        ("{measure: roof_drift, most: 1 %, statistic: mean, share: 80 %}", "criteria[0].share", "E-KEY-03"),
        ("{measure: roof_drift, most: 1 %, share: 120 %}", "criteria[0].share", "E-VALUE-02"),
        ("{measure: roof_drift, quantity: base_shear, most: 1 kN}", "criteria[0].measure", "E-KEY-01"),
    ],
)
def test_what_is_wrong_in_a_criterion(criterion: str, key: str, said: str) -> None:
    text = f"criteria:\n  - {criterion.replace('{', '{name: one, ', 1).replace(', }', '}')}\n"
    (found,) = problems_of(text)
    assert found.startswith("2:") and f" {key}: " in found and says(found, said), found


def test_criteria_that_contradict_each_other() -> None:
    text = (
        "criteria:\n"
        "  - {name: low, measure: roof_drift, most: 1 %, variants: damped}\n"
        "  - {name: other level, measure: roof_drift, least: 2 %, variants: bare}\n"
        "  - {name: other statistic, measure: roof_drift, least: 2 %, statistic: maximum}\n"
        "  - {name: high, measure: roof_drift, least: 2 %, most: 3 %, levels: [DBE, MCE]}\n"
    )
    (found,) = problems_of(text)
    assert found.startswith("5:5 criteria[3]: ")
    assert says(found, "`low` (criteria[0], line 2) damped at DBE 0.02 0.01 E-VALUE-04")


def test_names_and_objectives() -> None:
    text = "criteria:\n  - {name: a, performance: LS}\n  - {name: a, performance: CP}\nobjectives: [h, a, h]\n"
    found = problems_of(text)
    assert len(found) == 2
    assert says(found[0], "criteria[1].name E-NAME-02")
    assert says(found[1], "4:20 objectives[2]: `h` E-NAME-02")
    (found,) = problems_of("objectives: [m]\n")
    assert "objectives[0]" in found


def test_the_hazard_level_of_an_objective() -> None:
    hazard = parse_project(FRAME).hazard
    assert objective_level("h", hazard) == "DBE"  # 475 years: 1 - exp(-50/475) = 9.99 %
    assert objective_level("j", hazard) == "MCE"
    assert objective_level("d", hazard) is None  # `own` is a factor without a probability
    assert objective_level("h", None) is None
