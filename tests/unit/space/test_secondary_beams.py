"""Secondary beams with a section: weight, list and checks, written out for IPE240 of S355 over 6 m."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, design_of
from test_own_load_cases import BRACED

from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.space.check import check_building
from edesign.space.checks.secondary_beams import DEFLECTION
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.secondary_beams import secondary_beams

AREA = "areas: [{G: 3 kN/m^2, Q: 2 kN/m^2, category: B, spans: x"
FLOOR = BRACED.replace(
    AREA, AREA + ", secondary_beams: 2, secondary_section: IPE 240, secondary_material: S355"
).replace("S275: {fy: 275 MPa}}", "S275: {fy: 275 MPa}, S355: {fy: 355 MPa}}")
WEIGHING = FLOOR.replace("self_weight: false", "self_weight: true")
IPE240 = steel_section("IPE240")
WEIGHT = IPE240.A * 7850.0 * 9.80665


def test_weight_comes_to_the_beams_along_the_span() -> None:
    """Two beams of 0.301 kN/m over 6 m: 0.904 kN at both thirds of either beam along x, and in the masses."""
    assert pytest.approx(0.301e3, rel=2e-3) == WEIGHT
    light, heavy = (space_frame(building(text)) for text in (FLOOR, WEIGHING))
    members = [member.name for member in heavy.members]
    for name in ("BX_1_1_1", "BX_2_1_1"):
        own = [
            heavy.cases["G"].point_member == members.index(name),
            light.cases["G"].point_member == members.index(name),
        ]
        more = heavy.cases["G"].point_force[own[0], 2] - light.cases["G"].point_force[own[1], 2]
        assert more == pytest.approx([-0.5 * WEIGHT * 6.0] * 2)
    more = heavy.cases["G"].point_force[:, 2].sum() - light.cases["G"].point_force[:, 2].sum()
    assert more == pytest.approx(-2.0 * WEIGHT * 6.0)
    assert np.allclose(heavy.cases["G"].uniform, light.cases["G"].uniform)


def test_the_list_of_beams() -> None:
    (beam,) = secondary_beams(building(WEIGHING))
    assert (beam.number, beam.length, beam.strip) == (2, 6.0, 2.0)
    assert beam.G == pytest.approx(3e3 * 2.0 + WEIGHT) and beam.Q == {"B": pytest.approx(4e3)}
    assert "2 beams IPE240 S355 of 6 m every 2 m: 0.37 t" in check_building(building(WEIGHING))["secondary"]


def test_bending_shear_and_deflection() -> None:
    """G = 3 x 2 + 0.301 = 6.301, Q = 4 kN/m: w = 1.35 x 6.301 + 1.5 x 4 = 14.51 kN/m.

    M = 14.51 x 36 / 8 = 65.3 kN m of W_pl f_y = 366.6 cm3 x 355 MPa = 130.1 kN m: 0.502.
    V = 43.5 kN of A_v f_y / sqrt(3) = 19.14 cm2 x 205 MPa = 392 kN: 0.111.
    v = 5 x 10.301 x 6^4 / (384 x 210e6 x 3892e-8) = 21.3 mm = span / 282 of all, 4 / 10.301 of it of Q: span / 726.
    """
    limits = "serviceability: {beams: {total: 1/250, live: 1/800}, sway:"
    design = design_of(WEIGHING.replace("serviceability: {sway:", limits))
    rules = {rule.text: rule for rule in design.criteria if "secondary" in rule.text}
    name = "secondary beams IPE240 over 6 m"
    assert rules[f"{name}, M_Ed / M_c,Rd"].value == pytest.approx(0.502, rel=3e-3)
    assert rules[f"{name}, V_Ed / V_c,Rd"].value == pytest.approx(0.111, rel=5e-3)
    total, live = (rules[f"deflection of {name} over span, {of}"] for of in ("all loads", "variable loads alone"))
    assert 1.0 / total.value == pytest.approx(282.0, rel=3e-3) and total.passed
    assert 1.0 / live.value == pytest.approx(726.0, rel=3e-3) and not live.passed and live.clause == DEFLECTION


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (", secondary_material: S355", "", "secondary_material.*a section and a material together"),
        ("secondary_section: IPE 240", "secondary_section: IPE 245", "of IPE the catalogue has near it"),
        ("secondary_material: S355", "secondary_material: S365", "did you mean `S355`"),
        ("secondary_beams: 2, ", "", "there are none"),
    ],
)
def test_refused(old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        building(FLOOR.replace(old, new, 1))
