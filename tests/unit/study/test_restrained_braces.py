"""Buckling-restrained braces of a project: what is refused, warned of, and tabulated."""

from __future__ import annotations

import re

import numpy as np
import pytest
from cases.conftest import HERE
from messages import says

from edesign import check_project
from edesign.archive.dataset import Group
from edesign.assess.quantities import lacking, located_quantity
from edesign.errors import InputError
from edesign.frame.frame import build_frame
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import Project, parse_project
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.dampers.device_names import names_of_dampers
from edesign.report.response.restrained_braces import restrained_tables
from edesign.study.analysis.history import run_history
from edesign.study.analysis.lateral_patterns import floor_masses
from edesign.study.analysis.modal import fundamental_period
from edesign.study.analysis.structure import make_frame
from edesign.study.check.advice import frame_warnings
from edesign.study.results.warnings import warnings_of

TEXT = (HERE / "brb_frame" / "project.yaml").read_text(encoding="utf-8").replace("../records", str(HERE / "records"))
RISING = "{kind: rising, bays: 1, storeys: all, law: brb, scale: [1.7, 1.4, 0.8]}"


def changed(*changes: tuple[str, str]) -> Project:
    text = TEXT
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return parse_project(text, HERE / "brb_frame" / "brb.yaml", BuildingSections())


@pytest.mark.parametrize(
    ("old", "new", "at", "said"),
    [
        ("kind: rising", "kind: chevron", "", "dampers.devices[0]: kind `chevron_braces` E-DAMPER-05"),
        ("law: brb, scale: [1.7", "law: brb, brace: {stiffness: 1 kN/mm}, scale: [1.7", "", "[0]: brace E-KEY-03"),
        ("alpha: 0.4 %", "alpha: 4 %", "4 %", "dampers.laws.brb.parameters.alpha 0.04 0.02 E-CORE-02"),
        ("[0.5 %, 1 %, 2 %]", "[1 %, 0.5 %, 2 %]", "[1 %", "dampers.laws.brb.parameters.strain E-CORE-02"),
        ("[1.12, 1.28, 1.46]", "[1.12, 1.28]", "[0.5", "parameters.strain 3 of `strain`, 2 of `omega` E-VALUE-04"),
        ("[1.12, 1.28, 1.46]", "[1.12, 0.9, 1.46]", "[1.12, 0.9", "parameters.omega `0.9` E-VALUE-02"),
        ("beta: [", "beta1: 1.1, beta: [", "1.1, beta", "parameters.beta1 `beta` E-KEY-03"),
        ("[1.12, 1.28, 1.46]", "[1.12, 1.5, 1.3]", "[1.12, 1.5", "parameters.omega omega3 omega2 E-CORE-02"),
        ("[0.5 %, 1 %, 2 %]", "[0.5 %, 1 %, 2]", "[0.5", "parameters.strain `2` E-VALUE-02"),
        ("    brb:\n", "    brb:\n      effects: [{name: ageing, form: linear, parameters: {rate: 0, n: 1}}]\n",
         "[{name", "dampers.laws.brb.effects E-DAMPER-01"),
        ("KF: 1.35", "KF: 1.6", "1.6", "dampers.laws.brb.parameters.KF 1.47 E-CORE-02"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_place(old: str, new: str, at: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        make_frame(changed((old, new)), dampers=True)
    message = str(caught.value)
    assert says(message, said), message
    line, column = map(int, re.findall(r"brb\.yaml:(\d+):(\d+)", message)[0])
    assert TEXT.replace(old, new).splitlines()[line - 1][column - 1 :].startswith(at)


def test_a_beam_that_is_missing_cannot_be_met() -> None:
    with pytest.raises(InputError, match=r"devices\[1\].kind.*`B_3_2`.*E-DAMPER-05"):
        changed(("  releases:", "  missing: {beams: [{floors: 2, bays: 3}]}\n  releases:"))


def test_chevrons_split_their_beams() -> None:
    project = changed()
    frame = project.frame
    assert [name for name in frame.beam_members if name.startswith("B_3")] == [
        f"B_3_{floor}_{half}" for floor in (1, 2, 3) for half in (1, 2)
    ]
    assert frame.nodes["B_3_1"] == (15.5, 4.0)
    assert names_of_dampers(frame, project.dampers)[3:5] == ("V_3_1_r", "V_3_1_f")
    model = build_frame(project)
    assert floor_masses(model).sum() == pytest.approx(model.mass, rel=1e-12)  # those in the middle of beams too


def test_periods_count_the_braces_and_rayleigh_damping_is_warned_of() -> None:
    assert fundamental_period(changed()) == pytest.approx((0.412,), abs=0.001)
    assert "damping: " not in check_project(changed())["warnings"]
    reported = check_project(changed(("kind: modal, ratio: 2 %, modes: 3", "kind: rayleigh, ratio: 2 %")))["warnings"]
    assert reported.startswith("damping: the stiffness that `rayleigh` is proportional to")


def test_a_law_that_no_device_has_says_nothing_of_the_frame() -> None:
    """Laws of buckling-restrained braces stand in a project for its designs, too."""
    rayleigh = ("kind: modal, ratio: 2 %, modes: 3", "kind: rayleigh, ratio: 2 %")
    pads = "    pad: {type: friction, parameters: {mu: 1, N: 100 kN, k: 200 kN/mm}}\n  devices:\n"
    unused = changed(
        rayleigh,
        ("  devices:\n", f"{pads}    - {{kind: storey, bays: 1, storeys: all, law: pad}}\n"),
        (f"    - {RISING}\n", ""),
        ("    - {kind: chevron_braces, bays: 3, storeys: all, law: brb, scale: [1.0, 0.8, 0.5]}\n", ""),
        ("outputs:", "# outputs:"),
    )
    reported = check_project(unused)
    assert reported["period"].endswith(" s under gravity, without its dampers")  # the pads
    assert "buckling-restrained" not in reported.get("warnings", "")
    assert frame_warnings(unused, {}, ["brb"])[-1].startswith("damping: the stiffness")  # a design adds them


def test_neither_layers_nor_their_size() -> None:
    """Who gives a prototype and a scale is warned of the prototype, which the brace cannot have."""
    prototype = "    brb:\n      prototype: {layers: 2, layer_area: 100 cm^2, layer_thickness: 10 mm}\n"
    with pytest.raises(InputError, match=r"laws\.brb\.prototype.*E-DAMPER-01"):
        make_frame(changed(("    brb:\n", prototype)), dampers=True)
    with pytest.raises(InputError, match=r"devices\[0\]\.layers.*E-DAMPER-01"):
        changed((RISING, RISING.replace("scale: [1.7, 1.4, 0.8]", "layers: 2")))


@pytest.fixture(scope="module")
def shaken() -> tuple[Project, Group]:
    """So hard that cores strain beyond their table."""
    project = changed(("scale: 2, free", "scale: 6, free"))
    return project, run_history(project, project.analyses[2])  # type: ignore[arg-type]


def test_strains_beyond_the_table_are_warned_of(shaken: tuple[Project, Group]) -> None:
    _, group = shaken
    reported = [warning for warning in warnings_of(group) if warning.kind == "core_strain"]
    strain = np.maximum(
        group.variables["core_strain_max"].values, -np.asarray(group.variables["core_strain_min"].values)
    )
    assert len(reported) == 1 and reported[0].ratio == pytest.approx(np.max(strain) / 0.02)
    assert "beyond the largest strain that omega and beta are given at" in reported[0].text


def test_criteria_take_their_quantities(shaken: tuple[Project, Group]) -> None:
    project, group = shaken
    for name, limit, variable in (
        ("core_strain", "2.5 %", "core_strain_max"),
        ("cumulative_ductility", "200", "cumulative_ductility_final"),
    ):
        side = {"side": "tension"} if name == "core_strain" else {}
        asked = QuantityCriterion.model_validate({"name": "x", "quantity": name, "most": limit, "storeys": "2", **side})
        found = located_quantity(group, asked, project)
        values = np.asarray(group.variables[variable].values)[[1, 5, 6]]
        assert found is not None and found.value == pytest.approx(np.max(values))
        assert found.storey == 2
    plain = Group(coords=group.coords, variables={"damper_storey": group.variables["damper_storey"]})
    assert lacking(plain, asked, project) == "no damper is a buckling-restrained brace"


def test_tables(shaken: tuple[Project, Group]) -> None:
    _, group = shaken
    demand, strength, beams, columns = restrained_tables({"shake": group, "other": Group()})
    assert [row[0] for row in demand.texts] == [str(name) for name in group.coords["damper"].values]
    force = float(group.variables["damper_force_max"].values[0])
    assert float(demand.texts[0][1]) == pytest.approx(force / 1e3, rel=1e-3)
    assert float(demand.texts[0][2]) == pytest.approx(force / (1.1 * 1.46 * 1.7 * 262e3), rel=1e-2)
    # by hand: P = 262 kN, T = 1.1 1.46 P, C = 1.12 T; (C - T) sin, (C + T) cos at 4 m over 3.5 m
    tension, length = 1.1 * 1.46 * 262.0, np.hypot(3.5, 4.0)
    row = strength.texts[3]
    assert [float(cell) for cell in row[1:]] == pytest.approx(
        [length, 262.0, 262e3 / (1.35 * 200e9 * 1e-3 / length) * 1e3, tension, 1.12 * tension], rel=1e-3
    )
    up, along = 0.12 * tension * 4.0 / length, 2.12 * tension * 3.5 / length
    assert beams.texts[0][0] == "B_3_1"
    assert [float(cell) for cell in beams.texts[0][1:]] == pytest.approx([up, along, up * 7.0 / 4.0], rel=1e-3)
    # diagonals from A up to B at 4 and 3.5 m over 6 m; sway to the right pulls them, to the left presses them
    each = {1: 1.7 * 4.0 / np.hypot(6.0, 4.0), 2: 1.4 * 3.5 / np.hypot(6.0, 3.5), 3: 0.8 * 3.5 / np.hypot(6.0, 3.5)}
    found = {row[0]: [float(cell) for cell in row[1:]] for row in columns.texts}
    for storey in (1, 2, 3):
        above = sum(share for at, share in each.items() if at >= storey)
        assert found[f"C_B_{storey}"] == pytest.approx([above * tension, 1.12 * above * tension], rel=1e-3)
    assert found["C_A_1"] == pytest.approx(
        [1.12 * (each[2] + each[3]) * tension, (each[2] + each[3]) * tension], rel=1e-3
    )
    assert "C_A_3" not in found
    # chevrons, the compressed brace at the right when swaying to the right: lower ends at floors 1 and 2, half of what
    # lifts the beams at floors 1 to 3
    sines = {1: 1.0 * 4.0 / np.hypot(3.5, 4.0), 2: 0.8 * 3.5 / np.hypot(3.5, 3.5), 3: 0.5 * 3.5 / np.hypot(3.5, 3.5)}
    lift = 0.5 * 0.12 * sum(sines.values())
    lower_ends = sines[2] + sines[3]
    assert found["C_D_1"] == pytest.approx(
        [(1.12 * lower_ends - lift) * tension, (lower_ends + lift) * tension], rel=1e-3
    )
    assert not restrained_tables({"bare": Group()})
