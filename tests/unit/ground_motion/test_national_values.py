"""National parameters that a file states: they replace those of its country, and nothing else changes."""

from __future__ import annotations

import pytest
from building_examples import SMALL
from building_examples import building as changed

from edesign.codes.ec8.national import national_parameters
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, factor_of_level, national_of, vertical_spectrum
from edesign.project.actions.hazard import EC8Hazard, Level
from edesign.project.building import parse_building
from edesign.project.reading.problems import FileProblems
from edesign.space.structure.design_block import design_of

GREECE = {"code": "ec8-2004", "country": "greece", "zone": "3", "ground": "B", "spectrum": 1}


def hazard(**national: object) -> EC8Hazard:
    return EC8Hazard.model_validate({**GREECE, "levels": {"L": Level(importance_class="III")}, "national": national})


def test_without_values_the_parameters_are_those_of_the_country() -> None:
    assert national_of(hazard()).parameters == national_parameters("greece").parameters


def test_stated_values_replace_those_of_the_country_entry_by_entry() -> None:
    stated = hazard(
        lower_bound_factor=0.1,
        importance_factors={"III": 1.3},
        psi={"B": [0.8, 0.6, 0.4]},
        action_factors={"xi": 0.925},
        resistance_factors={"M1": 1.1},
        vertical={"ratio": 0.7},
        material_overstrength=1.1,
    )
    found, before = national_of(stated), national_parameters("greece")
    assert (found.beta, found.gamma_ov, found.gamma_pb) == (0.1, 1.1, before.gamma_pb)
    assert factor_of_level(stated, "L") == found.gamma_I("III") == 1.3
    assert found.gamma_I("IV") == before.gamma_I("IV")
    assert (found.psi["B"].psi_2, found.psi["C"]) == (0.4, before.psi["C"])
    assert (found.action_factors.xi, found.action_factors.G_sup) == (0.925, 1.35)
    assert dict(found.gamma_M) == {"M0": 1.0, "M1": 1.1, "M2": 1.25}
    assert vertical_spectrum(stated).parameters.ratio == 0.7
    assert found.vertical(2) == before.vertical(2)
    assert found.a_gR("3") == before.a_gR("3")
    assert found.parameters["lower_bound_factor"].origin == "file"
    assert found.parameters["lower_bound_factor"].clause == before.parameters["lower_bound_factor"].clause


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{beta: 0.2}", r"national.beta"),
        ("{importance_factors: {II: 1.1}}", r"gamma_I of class II is 1.0 by definition"),
        ("{importance_factors: {V: 1.1}}", r"V"),
        ("{psi: {B: [0.5, 0.3, 0.6]}}", r"psi_1 = 0.3 is less than psi_2 = 0.6"),
        ("{psi: {B: 0.3}}", r"psi_0, psi_1 and psi_2 are needed"),
        ("{low_ductility_q: 3}", r"low_ductility_q"),
        ("{material_overstrength: 0.9}", r"material_overstrength"),
        ("{vertical: {T_B: 0.5 s}}", r"T_B <= T_C <= T_D"),
    ],
)
def test_wrong_values_are_named_at_their_line(text: str, message: str) -> None:
    written = SMALL.replace("a_gR: 0.24 g,", f"a_gR: 0.24 g, national: {text},")
    with pytest.raises((FileProblems, InputError), match=message) as error:
        checked_hazard(parse_building(written))
    assert "building.yaml:15:" in str(error.value)


def test_what_the_design_leaves_to_the_country_has_its_value() -> None:
    national = (
        "a_gR: 0.24 g,",
        "a_gR: 0.24 g, national: {resistance_factors: {M1: 1.1}, action_factors: {Q: 1.6},"
        " material_overstrength: 1.1, displacement_reduction: {III: 0.45}},",
    )
    level = ("{probability: 10 %}", "{importance_class: III}")
    found = design_of(changed(SMALL, national, level))
    assert (found.partial_factors.M0, found.partial_factors.M1) == (1.0, 1.1)
    assert (found.partial_factors.G, found.partial_factors.Q) == (1.35, 1.6)
    assert (found.overstrength, found.drift.nu) == (1.1, 0.45)
    own = ("  ductility_class: medium", "  ductility_class: medium\n  overstrength: 1.2\n  partial_factors: {M1: 1.05}")
    mine = design_of(changed(SMALL, national, level, own))
    assert (mine.overstrength, mine.partial_factors.M1, mine.partial_factors.Q) == (1.2, 1.05, 1.6)
    assert design_of(changed(SMALL, level)).drift.nu == 0.4  # class III, recommended
