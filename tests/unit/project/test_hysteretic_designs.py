"""Designs of hysteretic dampers in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project
from messages import says

from edesign.project.dampers.designs import DriftAmplitude, HystereticDesign, Optimum
from edesign.project.dampers.verification import HystereticVerify
from edesign.project.reading.base import Model

LAWS = """
dampers:
  laws:
    pad: {type: friction, parameters: {mu: 0.3, N: 100 kN, k: 60 kN/mm}}
    brb:
      type: buckling_restrained
      parameters: {A_sc: 1000 mm^2, F_ysc: 262 MPa, E: 200 GPa, L_wp: 6.5 m, L_y: 4.4 m, KF: 1.35, alpha: 0.4 %,
                   strain: 2 %, omega: 1.46, beta: 1.12}
    rubber: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 200 kN*s/m}}
    layers:
      type: elastic_plastic
      parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0.03}
      prototype: {layers: 2, layer_area: 0.01 m^2, layer_thickness: 10 mm}
"""
GOOD = "method: hysteretic, law: pad, kind: chevron, bays: 1, shear_share: 30 %, level: DBE"
DAMPING = GOOD.replace("shear_share: 30 %", "damping: 10 %")
VERIFY = ", verify: {records: shake, levels: DBE, criteria: drift}"
OPTIMUM = GOOD.replace("shear_share: 30 %", "optimum: {range: [5 %, 80 %], least: mean}") + VERIFY


def test_design_in_si() -> None:
    spec = design(f"{DAMPING}, amplitude: {{drift: 1.2 %}}, equivalent_damping: average", shear_project(2, LAWS))
    assert isinstance(spec, HystereticDesign)
    assert (spec.damping, spec.distribution, spec.shear) == (0.1, "storey_shear", None)
    assert spec.amplitude == DriftAmplitude(drift="1.2 %")  # type: ignore[arg-type]
    spec = design(OPTIMUM, shear_project(2, LAWS))
    assert isinstance(spec, HystereticDesign) and spec.optimum is not None and spec.verify is not None
    assert (spec.optimum.range, spec.optimum.least, spec.verify.rounds) == ((0.05, 0.8), "mean", 12)
    without_level = DAMPING.replace(", level: DBE", ", amplitude: {roof_displacement: 90 mm}")
    assert isinstance(design(without_level, shear_project(2, LAWS)), HystereticDesign)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (GOOD.replace("hysteretic,", "hysteretik,"), "designs.tried.method `hysteretic` E-VALUE-03"),
        (GOOD.replace("pad", "pads"), "designs.tried.law `pad` E-NAME-01"),
        (GOOD.replace("pad", "rubber"), "designs.tried.law `kelvin_voigt` `friction` E-DESIGN-03"),
        (GOOD.replace("pad", "layers"), "designs.tried.law `prototype` E-DESIGN-03"),
        (GOOD.replace(", shear_share: 30 %", ""), "designs.tried.shear_share E-KEY-02"),
        (GOOD + ", damping: 10 %", "designs.tried.damping `shear_share` E-KEY-03"),
        (GOOD.replace("30 %", "30"), "designs.tried.shear_share E-VALUE-02"),
        (GOOD.replace("30 %", "3 kN"), "designs.tried.shear_share E-UNIT-02"),
        (GOOD.replace(", level: DBE", ""), "designs.tried.level `shear_share` E-KEY-02"),
        (DAMPING.replace(", level: DBE", ""), "designs.tried.level `amplitude: spectrum` E-KEY-02"),
        (GOOD + ", amplitude: {drift: 10 mm}", "designs.tried.amplitude.drift E-UNIT-02"),
        (GOOD + ", amplitude: {drift: 90 %}", "designs.tried.amplitude.drift 31.2 E-VALUE-02"),
        (GOOD + ", drift: 1 %", "designs.tried.drift E-DESIGN-06"),
        (GOOD + ", shear: base", "designs.tried.shear E-VALUE-03"),
        (GOOD + ", shear: [400 kN]", "designs.tried.shear E-VALUE-04"),
        (GOOD + ", shear: [400 kN, 0 kN]", "designs.tried.shear[1] E-VALUE-02"),
        (GOOD + ", shear: [400 kN, 3 mm]", "designs.tried.shear[1] length force E-UNIT-02"),
        (GOOD.replace("pad", "brb"), "designs.tried.kind `chevron_braces` E-DAMPER-05"),
        (
            GOOD.replace("pad", "brb").replace("chevron", "falling") + ", brace: {ratio: 5}",
            "designs.tried.brace E-KEY-03",
        ),
        (GOOD + ", equivalent_damping: avarage", "designs.tried.equivalent_damping `average` E-VALUE-03"),
        (GOOD + ", distribution: storey_shears", "designs.tried.distribution `storey_shear` E-VALUE-03"),
        (GOOD + ", bounds: {temperatures: [0 degC, 30 degC]}", "designs.tried.bounds.temperatures E-DESIGN-03"),
        (GOOD + VERIFY.replace("}", ", change: coefficient}"), "designs.tried.verify.change E-VALUE-03"),
        (OPTIMUM.replace(VERIFY, ""), "designs.tried.verify `optimum` E-KEY-02"),
        (OPTIMUM.replace("[5 %, 80 %]", "[80 %, 5 %]"), "designs.tried.optimum.range 0.8 0.05 E-VALUE-04"),
        (OPTIMUM.replace("[5 %, 80 %]", "[5 %, 180 %]"), "designs.tried.optimum.range[1] E-VALUE-02"),
        (
            OPTIMUM.replace("criteria: drift", "criteria: drift, change: yield_force"),
            "designs.tried.verify.change E-KEY-03",
        ),
        (OPTIMUM.replace("least: mean", "least: sum"), "designs.tried.optimum.least E-VALUE-03"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2, LAWS))
    assert says(message, said) and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [HystereticDesign, HystereticVerify, Optimum])
def test_every_key_is_documented(model: type[Model]) -> None:
    docs = THESIS.parents[2] / "docs" / "how_to"
    text = "".join((docs / f"{page}.md").read_text(encoding="utf-8") for page in ("damper_design", "hysteretic_design"))
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
