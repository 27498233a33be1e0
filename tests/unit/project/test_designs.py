"""Designs in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project, thesis_project
from messages import says

from edesign.project.checks.designs import design_warnings
from edesign.project.dampers.designs import (
    Bounds,
    BraceRatio,
    Extremes,
    FixedProperties,
    SimplifiedDesign,
    StrainEnergyDesign,
)
from edesign.project.dampers.verification import Verify
from edesign.project.reading.base import Model

GOOD = "method: strain_energy, law: rubber, kind: chevron, bays: 1, strain: 20 %, layer_thickness: 20 mm, damping: 5 %"
SIMPLE = (
    "method: simplified, law: rubber, kind: chevron, bays: 1, strain: 20 %, drift: 1 %, strain_limit: 50 %, level: DBE"
)


def test_design_in_si() -> None:
    spec = design(
        f"{GOOD}, temperature: 293.15 K, properties: {{G_storage: 1 MPa, loss_factor: 0.3}}", shear_project(2)
    )
    assert isinstance(spec, StrainEnergyDesign)
    assert (spec.strain, spec.layer_thickness, spec.damping, spec.temperature) == (0.2, 0.02, 0.05, 20.0)
    assert spec.properties == FixedProperties(G_storage="1 MPa", loss_factor=0.3)  # type: ignore[arg-type]
    assert (spec.brace, spec.braces_in_target, spec.storey_stiffness, spec.frequency) == (
        "rigid",
        None,
        "computed",
        None,
    )


def test_verification_of_one_or_several_records() -> None:
    verify = "verify: {records: table_5_6, levels: [DBE, MCE], criteria: drift}"
    spec = design(GOOD.replace("rubber", "elastomer") + f", {verify}", thesis_project())
    assert spec.verify is not None and spec.verify.records == ("table_5_6",) and spec.verify.levels == ("DBE", "MCE")


def test_unusual_alpha_is_reported() -> None:
    spec = design(f"{SIMPLE}, alpha: 5", shear_project(1))
    assert isinstance(spec, SimplifiedDesign)
    assert design_warnings(spec) == ["alpha = 5 is outside the recommended 10 to 30 (thesis 5.3.4)"]
    assert design_warnings(design(SIMPLE, shear_project(1))) == []


@pytest.mark.parametrize(
    "text",
    [
        GOOD.replace("20 %", "spectrum") + ", properties: law",
        GOOD + ", bounds: {upper: 1.2}",
        SIMPLE.replace(", level: DBE", ""),
    ],
)
def test_level_of_the_verification_is_that_of_the_design(text: str) -> None:
    spec = design(f"{text}, verify: {{records: shake, criteria: c, levels: DBE}}", shear_project(2))
    assert isinstance(spec, (StrainEnergyDesign, SimplifiedDesign)) and spec.level is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (GOOD.replace("strain_energy", "strain_enery"), "designs.tried.method `strain_energy` E-VALUE-03"),
        (GOOD.replace("rubber", "ruber"), "designs.tried.law `rubber` E-NAME-01"),
        (GOOD.replace("rubber", "sizeless"), "designs.tried.law `prototype` E-DESIGN-03"),
        (GOOD.replace("bays: 1", "bays: 2"), "designs.tried.bays E-NAME-01"),
        (GOOD + ", storeys: 1-3", "designs.tried.storeys 1 to 2 E-NAME-01"),
        (GOOD + ", storey_stiffness: [1 kN/mm]", "designs.tried.storey_stiffness E-VALUE-04"),
        (GOOD.replace("20 %", "spectrm"), "designs.tried.strain `spectrum` E-VALUE-03"),
        (GOOD.replace("20 %", "20 mm"), "designs.tried.strain E-UNIT-02"),
        (GOOD.replace("20 %", "[spectrum]"), "designs.tried.strain E-VALUE-01"),
        (GOOD.replace("20 %", "spectrum"), "designs.tried.level `strain: spectrum` E-KEY-02"),
        (GOOD.replace("20 %", "histories") + ", level: DBE", "designs.tried.strain `verify` E-KEY-03"),
        (
            GOOD.replace("20 %", "spectrum") + ", level: DBE, properties: {G_storage: 1 MPa, loss_factor: 0.3}",
            "designs.tried.strain E-DESIGN-03",
        ),
        (GOOD.replace("layer_thickness: 20 mm", "drift: 1 %"), "designs.tried.layer_thickness `strain_limit` E-KEY-02"),
        (GOOD + ", drift: 1 %, strain_limit: 50 %", "designs.tried.strain_limit E-KEY-03"),
        (GOOD + ", level: MCE", "designs.tried.level E-NAME-01"),
        (GOOD.replace(", damping: 5 %", ""), "designs.tried.damping E-KEY-02"),
        (GOOD + ", braces_in_target: true", "designs.tried.braces_in_target E-DAMPER-02"),
        (GOOD + ", brace: {ratios: 7}", "designs.tried.brace.ratios `ratio` E-KEY-01"),
        (GOOD + ", distribution: uniform, target_in: storeys", "designs.tried.target_in E-DESIGN-06"),
        (GOOD + ", distribution: least_area", "designs.tried.level E-KEY-02"),
        (GOOD + ", properties: {table: thesis}", "designs.tried.properties.table `thesis_appendix_a` E-VALUE-03"),
        (GOOD + ", properties: {G_storage: 1 MPa}", "designs.tried.properties.loss_factor E-KEY-02"),
        (GOOD + ", frequency: [1 Hz, 0.5 Hz]", "designs.tried.frequency E-VALUE-04"),
        (GOOD + ", bounds: {upper: 1.2}", "designs.tried.level E-KEY-02"),
        (GOOD + ", level: DBE, bounds: {upper: 0.8}", "designs.tried.bounds.upper E-VALUE-02"),
        (
            GOOD + ", level: DBE, bounds: {lower_factors: {test: 1.2}}",
            "designs.tried.bounds.lower_factors.test E-VALUE-02",
        ),
        (
            GOOD + ", level: DBE, bounds: {lower: 0.9, lower_factors: {test: 0.9}}",
            "designs.tried.bounds.lower_factors E-KEY-03",
        ),
        (
            GOOD + ", level: DBE, bounds: {temperatures: [30 degC, 20 degC]}",
            "designs.tried.bounds.temperatures E-VALUE-04",
        ),
        (GOOD + ", verify: {records: shak, criteria: c}", "designs.tried.verify.records `shake` E-NAME-01"),
        (GOOD + ", verify: {records: shake, criteria: c, levels: MCE}", "designs.tried.verify.levels E-NAME-01"),
        (SIMPLE.replace(", level: DBE", ""), "designs.tried.level E-KEY-02"),
        (SIMPLE + ", beta: [5, 0.5]", "designs.tried.beta E-VALUE-04"),
        (SIMPLE + ", low_temperature: 0 degC", "designs.tried.temperature E-KEY-02"),
        (SIMPLE + ", temperature: 10 degC, low_temperature: 20 degC", "designs.tried.low_temperature E-VALUE-04"),
        (SIMPLE + ", damping: 5 %", "designs.tried.damping E-KEY-01"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2))
    assert says(message, said) and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [StrainEnergyDesign, SimplifiedDesign, Bounds, Extremes, Verify, BraceRatio])
def test_every_key_is_documented(model: type[Model]) -> None:
    text = (THESIS.parents[2] / "docs" / "how_to" / "damper_design.md").read_text(encoding="utf-8")
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
