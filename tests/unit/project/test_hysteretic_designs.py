"""Designs of hysteretic dampers in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project

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
        (GOOD.replace("hysteretic,", "hysteretik,"), "did you mean `hysteretic`?"),
        (GOOD.replace("pad", "pads"), "designs.tried.law: there is no damper law `pads`; did you mean `pad`?"),
        (
            GOOD.replace("pad", "rubber"),
            "of type `kelvin_voigt`; hysteretic dampers are of type `friction`, `elastic_pl",
        ),
        (GOOD.replace("pad", "layers"), "has a `prototype`; hysteretic dampers have no layers"),
        (
            GOOD.replace(", shear_share: 30 %", ""),
            "shear_share: this key is missing; one target of `shear_share`, `dam",
        ),
        (GOOD + ", damping: 10 %", "designs.tried.damping: `shear_share` is given; a design has one target of"),
        (GOOD.replace("30 %", "30"), "designs.tried.shear_share: `30` is out of range"),
        (GOOD.replace("30 %", "3 kN"), "designs.tried.shear_share: `3 kN` has the unit `kN`, but a ratio"),
        (
            GOOD.replace(", level: DBE", ""),
            "designs.tried.level: this key is missing; `shear_share` needs the spectrum",
        ),
        (DAMPING.replace(", level: DBE", ""), "level: this key is missing; `amplitude: spectrum` needs the spectrum"),
        (GOOD + ", amplitude: {drift: 10 mm}", "designs.tried.amplitude.drift: `10 mm` has the unit `mm`, but a ratio"),
        (GOOD + ", amplitude: {drift: 90 %}", "designs.tried.amplitude.drift: 90 % is beyond 31.2 %, where the geome"),
        (GOOD + ", drift: 1 %", "designs.tried.drift: a drift has no part in the sizing of hysteretic dampers"),
        (GOOD + ", shear: base", "designs.tried.shear: `base` is unknown"),
        (GOOD + ", shear: [400 kN]", "designs.tried.shear: 1 values for a frame of 2 storeys; one for each is needed"),
        (GOOD + ", shear: [400 kN, 0 kN]", "designs.tried.shear[1]: `0 kN` must be greater than zero"),
        (GOOD + ", shear: [400 kN, 3 mm]", "designs.tried.shear[1]: `3 mm` is a length, but a force is needed"),
        (
            GOOD.replace("pad", "brb"),
            "designs.tried.kind: `chevron` acts horizontally, and a buckling-restrained brace",
        ),
        (
            GOOD.replace("pad", "brb").replace("chevron", "falling") + ", brace: {ratio: 5}",
            "designs.tried.brace: the ends of a buckling-restrained brace are in its `KF`",
        ),
        (GOOD + ", equivalent_damping: avarage", "did you mean `average`?"),
        (GOOD + ", distribution: storey_shears", "did you mean `storey_shear`?"),
        (GOOD + ", bounds: {temperatures: [0 degC, 30 degC]}", "a hysteretic law changes with its force alone"),
        (GOOD + VERIFY.replace("}", ", change: coefficient}"), "`coefficient` is unknown"),
        (OPTIMUM.replace(VERIFY, ""), "designs.tried.verify: this key is missing; an `optimum` is found by its hist"),
        (OPTIMUM.replace("[5 %, 80 %]", "[80 %, 5 %]"), "optimum.range: the range from 0.8 to 0.05 is empty"),
        (OPTIMUM.replace("[5 %, 80 %]", "[5 %, 180 %]"), "optimum.range[1]: `180 %` is out of range"),
        (OPTIMUM.replace("criteria: drift", "criteria: drift, change: yield_force"), "changes its share of the storey"),
        (OPTIMUM.replace("least: mean", "least: sum"), "optimum.least: `sum` is unknown"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2, LAWS))
    assert said in message and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [HystereticDesign, HystereticVerify, Optimum])
def test_every_key_is_documented(model: type[Model]) -> None:
    docs = THESIS.parents[2] / "docs" / "how_to"
    text = "".join((docs / f"{page}.md").read_text(encoding="utf-8") for page in ("damper_design", "hysteretic_design"))
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
