"""Designs in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project, thesis_project

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
        False,
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
        (GOOD.replace("strain_energy", "strain_enery"), "did you mean `strain_energy`? (allowed: `strain_energy`"),
        (GOOD.replace("rubber", "ruber"), "designs.tried.law: there is no damper law `ruber`; did you mean `rubber`?"),
        (GOOD.replace("rubber", "sizeless"), "has no `prototype`: it has no layers that could be sized"),
        (GOOD.replace("bays: 1", "bays: 2"), "there is no bay 2"),
        (GOOD + ", storeys: 1-3", "there is no storey 3; storeys are numbered 1 to 2"),
        (GOOD + ", storey_stiffness: [1 kN/mm]", "1 values for a frame of 2 storeys"),
        (
            GOOD.replace("20 %", "spectrm"),
            "`spectrm` is unknown; did you mean `spectrum`? (a strain such as `20 %`, or",
        ),
        (GOOD.replace("20 %", "20 mm"), "designs.tried.strain: `20 mm` has the unit `mm`, but a ratio is"),
        (GOOD.replace("20 %", "[spectrum]"), "designs.tried.strain: a ratio is needed"),
        (
            GOOD.replace("20 %", "spectrum"),
            "level: this key is missing; `strain: spectrum` begins with the spectrum of",
        ),
        (GOOD.replace("20 %", "histories") + ", level: DBE", "strain: there are no histories without `verify`"),
        (
            GOOD.replace("20 %", "spectrum") + ", level: DBE, properties: {G_storage: 1 MPa, loss_factor: 0.3}",
            "designs.tried.strain: fixed properties do not change with the strain",
        ),
        (GOOD.replace("layer_thickness: 20 mm", "drift: 1 %"), "(or both `drift` and `strain_limit`)"),
        (GOOD + ", drift: 1 %, strain_limit: 50 %", "needs it left out"),
        (GOOD + ", level: MCE", "there is no level `MCE`"),
        (GOOD.replace(", damping: 5 %", ""), "designs.tried.damping: this key is missing"),
        (GOOD + ", braces_in_target: true", "the braces are rigid"),
        (GOOD + ", brace: {ratios: 7}", "unknown key; did you mean `ratio`?"),
        (GOOD + ", distribution: uniform, target_in: storeys", "Eq. 5.9 storey by storey"),
        (GOOD + ", distribution: least_area", "designs.tried.level: this key is missing"),
        (GOOD + ", properties: {table: thesis}", "`thesis` is unknown; did you mean `thesis_appendix_a`?"),
        (GOOD + ", properties: {G_storage: 1 MPa}", "loss_factor: this key is missing"),
        (GOOD + ", frequency: [1 Hz, 0.5 Hz]", "the band runs backwards"),
        (GOOD + ", bounds: {upper: 1.2}", "designs.tried.level: this key is missing; bounds"),
        (GOOD + ", level: DBE, bounds: {upper: 0.8}", "a factor of the upper bound must be at least 1, not 0.8"),
        (GOOD + ", level: DBE, bounds: {lower_factors: {test: 1.2}}", "lower bound must be at most 1"),
        (GOOD + ", level: DBE, bounds: {lower: 0.9, lower_factors: {test: 0.9}}", "`lower` is given; keep one"),
        (GOOD + ", level: DBE, bounds: {temperatures: [30 degC, 20 degC]}", "the lower temperature first"),
        (GOOD + ", verify: {records: shak, criteria: c}", "there is no record `shak`; did you mean `shake`?"),
        (GOOD + ", verify: {records: shake, criteria: c, levels: MCE}", "there is no level `MCE`"),
        (SIMPLE.replace(", level: DBE", ""), "designs.tried.level: this key is missing; the simplified method"),
        (SIMPLE + ", beta: [5, 0.5]", "the lower value first"),
        (SIMPLE + ", low_temperature: 0 degC", "designs.tried.temperature: this key is missing"),
        (SIMPLE + ", temperature: 10 degC, low_temperature: 20 degC", "it is above the design `temperature`"),
        (SIMPLE + ", damping: 5 %", "unknown key"),
    ],
)
def test_refusals(text: str, said: str) -> None:
    message = refusal(text, shear_project(2))
    assert said in message and "study.yaml:1:" in message, message


@pytest.mark.parametrize("model", [StrainEnergyDesign, SimplifiedDesign, Bounds, Extremes, Verify, BraceRatio])
def test_every_key_is_documented(model: type[Model]) -> None:
    text = (THESIS.parents[2] / "docs" / "how_to" / "damper_design.md").read_text(encoding="utf-8")
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
