"""Designs of viscous dampers in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project
from messages import says

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
        (GOOD.replace("viscous,", "viscus,"), "designs.tried.method `viscous` E-VALUE-03"),
        (GOOD.replace("oil", "oils"), "designs.tried.law `oil` E-NAME-01"),
        (GOOD.replace("oil", "rubber"), "designs.tried.law `kelvin_voigt` `viscous` E-DESIGN-03"),
        (GOOD.replace("oil", "layers"), "designs.tried.law `prototype` E-DESIGN-03"),
        (GOOD.replace(", damping: 15 %", ""), "designs.tried.damping E-KEY-02"),
        (GOOD.replace("level: DBE", "amplitude: spectrum"), "designs.tried.level E-KEY-02"),
        (GOOD + ", amplitude: big", "designs.tried.amplitude `spectrum` E-VALUE-03"),
        (GOOD + ", amplitude: {drift: 10 mm}", "designs.tried.amplitude.drift E-UNIT-02"),
        (GOOD + ", amplitude: {roof: 1 m}", "designs.tried.amplitude.roof `roof_displacement` E-KEY-01"),
        (GOOD + ", brace: {ratio: 1e-300}", "designs.tried.brace.ratio 0.001 E-VALUE-02"),
        (GOOD + ", distribution: storey_shears", "designs.tried.distribution `storey_shear` E-VALUE-03"),
        (GOOD + ", strain: 20 %", "designs.tried.strain E-KEY-01"),
        (GOOD + ", bounds: {temperatures: [0 degC, 30 degC]}", "designs.tried.bounds.temperatures E-DESIGN-03"),
        (
            GOOD + ", verify: {records: shake, criteria: c, change: area}",
            "designs.tried.verify.change `target` E-VALUE-03",
        ),
        (GOOD + ", drift: 1 %", "designs.tried.drift E-DESIGN-06"),
        (LEAST.replace(", drift: 1 %", ""), "designs.tried.drift E-KEY-02"),
        (LEAST + ", damping: 15 %", "designs.tried.damping E-DESIGN-06"),
        (LEAST + ", verify: {records: shake, criteria: c}", "designs.tried.verify.change `coefficient` E-DESIGN-06"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2, LAWS))
    assert says(message, said) and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [ViscousDesign, ViscousVerify, RoofAmplitude, DriftAmplitude])
def test_every_key_is_documented(model: type[Model]) -> None:
    docs = THESIS.parents[2] / "docs" / "how_to"
    text = "".join((docs / f"{page}.md").read_text(encoding="utf-8") for page in ("damper_design", "viscous_design"))
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
