"""Designs of viscous dampers in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project

from edesign.project.dampers.designs import DriftAmplitude, RoofAmplitude, ViscousDesign
from edesign.project.dampers.verification import ViscousVerify
from edesign.project.reading.base import Model

LAWS = """
dampers:
  laws:
    oil: {type: viscous_power, parameters: {c: 300 kN*(s/m)^0.35, alpha: 0.35}}
    rubber: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 200 kN*s/m}}
    layers:
      type: viscous
      parameters: {c: 200 kN*s/m}
      prototype: {layers: 2, layer_area: 0.01 m^2, layer_thickness: 10 mm}
"""
GOOD = "method: viscous, law: oil, kind: chevron, bays: 1, damping: 15 %, level: DBE"
LEAST = "method: viscous, law: oil, kind: chevron, bays: 1, distribution: least_coefficient, level: DBE, drift: 1 %"


def test_design_in_si() -> None:
    spec = design(f"{GOOD}, amplitude: {{drift: 1.2 %}}, brace: {{ratio: 4}}", shear_project(2, LAWS))
    assert isinstance(spec, ViscousDesign)
    assert (spec.damping, spec.distribution, spec.amplitude) == (
        0.15,
        "storey_stiffness",
        DriftAmplitude(drift="1.2 %"),
    )  # type: ignore[arg-type]
    spec = design(f"{GOOD}, amplitude: {{roof_displacement: 120 mm}}", shear_project(2, LAWS))
    assert isinstance(spec, ViscousDesign) and spec.amplitude == RoofAmplitude(roof_displacement="0.12 m")  # type: ignore[arg-type]
    assert isinstance(design(LEAST, shear_project(2, LAWS)), ViscousDesign)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (GOOD.replace("viscous,", "viscus,"), "did you mean `viscous`?"),
        (GOOD.replace("oil", "oils"), "designs.tried.law: there is no damper law `oils`; did you mean `oil`?"),
        (
            GOOD.replace("oil", "rubber"),
            "is of type `kelvin_voigt`; viscous dampers are of type `viscous`, `viscous_po",
        ),
        (GOOD.replace("oil", "layers"), "has a `prototype`; viscous dampers have no layers"),
        (GOOD.replace(", damping: 15 %", ""), "designs.tried.damping: this key is missing"),
        (GOOD.replace("level: DBE", "amplitude: spectrum"), "designs.tried.level: this key is missing; `amplitude"),
        (GOOD + ", amplitude: big", "designs.tried.amplitude: `big` is unknown (allowed: `spectrum`"),
        (GOOD + ", amplitude: {drift: 10 mm}", "designs.tried.amplitude.drift: `10 mm` has the unit `mm`, but a ratio"),
        (GOOD + ", amplitude: {roof: 1 m}", "amplitude.roof: unknown key; did you mean `roof_displacement`?"),
        (GOOD + ", brace: {ratio: 1e-300}", "brace.ratio: `1e-300` is out of range: a ratio at least 0.001"),
        (GOOD + ", distribution: storey_shears", "did you mean `storey_shear`?"),
        (GOOD + ", strain: 20 %", "designs.tried.strain: unknown key"),
        (GOOD + ", bounds: {temperatures: [0 degC, 30 degC]}", "a viscous law changes with its coefficient alone"),
        (
            GOOD + ", verify: {records: shake, criteria: c, change: area}",
            "`area` is unknown; did you mean `target`? (allowed: `target`, `coeff",
        ),
        (GOOD + ", drift: 1 %", "designs.tried.drift: a drift has no part in the sizing for a damping"),
        (LEAST.replace(", drift: 1 %", ""), "designs.tried.drift: this key is missing; `distribution: least_coeff"),
        (LEAST + ", damping: 15 %", "meets a drift with the least coefficients, whatever the damping"),
        (LEAST + ", verify: {records: shake, criteria: c}", "has no target damping to change; choose `coefficient`"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2, LAWS))
    assert said in message and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [ViscousDesign, ViscousVerify, RoofAmplitude, DriftAmplitude])
def test_every_key_is_documented(model: type[Model]) -> None:
    docs = THESIS.parents[2] / "docs" / "how_to"
    text = "".join((docs / f"{page}.md").read_text(encoding="utf-8") for page in ("damper_design", "viscous_design"))
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
