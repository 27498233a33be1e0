"""The search for a placement in a study file: what is read, and what is refused in words and with its place."""

from __future__ import annotations

import re

import pytest
from design_examples import THESIS, design, refusal, shear_project
from messages import says
from placement_examples import project_text

from edesign.frame.sections.profiles import profile_names
from edesign.project.checks.placement import placement_warnings
from edesign.project.dampers.device_names import names_of_design
from edesign.project.dampers.placement import CandidatePlaces, CatalogueItem, Costs, LayoutLimits, PlacementDesign
from edesign.project.dampers.verification import PlacementVerify
from edesign.project.loader import parse_project
from edesign.project.reading.base import Model

LAWS = """
dampers:
  laws:
    oil: {type: viscous, parameters: {c: 1 kN*s/m}}
    layers:
      type: viscous
      parameters: {c: 200 kN*s/m}
      prototype: {layers: 2, layer_area: 0.01 m^2, layer_thickness: 10 mm}
"""
A = "a: {law: oil, scale: 40, cost: 1}"
GOOD = (
    f"method: placement, kind: storey, bays: 1, catalogue: {{{A}}}, "
    "verify: {records: shake, levels: DBE, criteria: drift}"
)


def test_placement_in_si() -> None:
    spec = design(
        GOOD.replace(
            A, f"{A}, b: {{law: layers, layer_area: 100 cm^2, number: 2, cost: 2.5, kind: rising, brace: rigid}}"
        )
        + ", costs: {place: 0.5}, limits: {most_dampers: 4, continuous: true, storey_groups: [1-2]}",
        shear_project(2, LAWS),
    )
    assert isinstance(spec, PlacementDesign) and list(spec.catalogue) == ["a", "b"]
    assert (spec.catalogue["a"].scale, spec.catalogue["b"].layer_area, spec.catalogue["b"].number) == (40.0, 0.01, 2)
    assert (spec.costs.place, spec.costs.bay, spec.limits.most_dampers) == (0.5, 0.0, 4)
    assert (spec.monotone, spec.verify.budget) == (True, 500)
    frame = shear_project(2, LAWS).frame
    assert names_of_design(frame, spec) == ("S_1_1", "S_1_2", "R_1_1", "R_1_2")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("placement", "placements", "designs.tried.method `placement` E-VALUE-03"),
        ("law: oil", "law: oils", "designs.tried.catalogue.a.law `oil` E-NAME-01"),
        ("cost: 1", "cost: 0", "designs.tried.catalogue.a.cost E-VALUE-02"),
        ("cost: 1", "cost: 1 EUR", "designs.tried.catalogue.a.cost E-UNIT-02"),
        (", cost: 1", "", "designs.tried.catalogue.a.cost E-KEY-02"),
        ("scale: 40", "layers: 2", "designs.tried.catalogue.a.layers `oil` `prototype` E-DAMPER-03"),
        ("law: oil, scale: 40", "law: layers, scale: 2", "designs.tried.catalogue.a.scale `prototype` E-KEY-03"),
        ("scale: 40", "scale: [40, 20]", "designs.tried.catalogue.a.scale E-VALUE-01"),
        ("scale: 40", "scales: 40", "designs.tried.catalogue.a.scales `scale` E-KEY-01"),
        (
            "scale: 40",
            "scale: 40, brace: {stiffness: [1 kN/mm, 2 kN/mm]}",
            "designs.tried.catalogue.a.brace.stiffness E-VALUE-01",
        ),
        (
            "scale: 40",
            "scale: 40, brace: {section: HEB200, material: steel}",
            "designs.tried.catalogue.a.brace E-DAMPER-02",
        ),
        (A, f"{A}, b: {{law: oil, scale: 40, cost: 2}}", "designs.tried.catalogue.b `a` E-NAME-02"),
        (
            A,
            f"{A}, b: {{law: oil, scale: 40, design_deformation: 9 mm, cost: 2}}",
            "designs.tried.catalogue.b `a` E-NAME-02",
        ),
        (A, "a: {law: oil, scale: 1, cost: 1}, b: {law: oil, cost: 2}", "designs.tried.catalogue.b E-NAME-02"),
        (A, "", "designs.tried.catalogue E-VALUE-01"),
        ("bays: 1, ", "", "designs.tried.bays E-KEY-02"),
        ("bays: 1", "bays: 1, places: [{along: x, frames: 1, bays: 1}]", "designs.tried.places `bays` E-KEY-03"),
        ("bays: 1", "bays: 2", "designs.tried.bays 1 to 1 E-NAME-01"),
        ("bays: 1", "bays: 1, storeys: 1-3", "designs.tried.storeys E-NAME-01"),
        ("levels: DBE", "levels: DBF", "designs.tried.verify.levels `DBE` E-NAME-01"),
        ("records: shake", "records: shaker", "designs.tried.verify.records `shake` E-NAME-01"),
        ("criteria: drift", "criteria: drift, budget: 0", "designs.tried.verify.budget E-VALUE-02"),
        ("criteria: drift", "criteria: drift, rounds: 3", "designs.tried.verify.rounds E-KEY-01"),
        ("bays: 1", "bays: 1, limits: {storey_groups: [1-2, 2]}", "designs.tried.limits.storey_groups[1] E-NAME-02"),
        (
            "bays: 1",
            "bays: 1, storeys: 1, limits: {storey_groups: [1-2]}",
            "designs.tried.limits.storey_groups[0] E-NAME-01",
        ),
        ("bays: 1", "bays: 1, limits: {most_dampers: 0}", "designs.tried.limits.most_dampers E-VALUE-02"),
        (
            "bays: 1, catalogue: {a: {",
            "bays: 1, limits: {most_dampers: 2}, catalogue: {a: {number: 3, ",
            "designs.tried.limits.most_dampers E-VALUE-02",
        ),
        ("kind: storey", "kind: rising, limits: {mirrored: true}", "designs.tried.limits.mirrored E-PLACE-03"),
        ("kind: storey", "kind: storey, costs: {floor: 1}", "designs.tried.costs.floor E-KEY-01"),
        ("kind: storey", "kind: storey, level: MCE", "designs.tried.level E-NAME-01"),
    ],
)
def test_refusals(old: str, new: str, said: str) -> None:
    assert GOOD.count(old) == 1
    message = refusal(GOOD.replace(old, new), shear_project(2, LAWS))
    assert says(message, said) and "study.yaml:1:" in message, message


@pytest.mark.parametrize(
    ("bays", "reported"),
    [
        ("[6 m, 5 m, 6 m]", []),
        ("{count: 4, width: 6 m}", []),
        ("[6 m, 5 m, 7 m]", ["the frame is not symmetric: bay 1 is 6 m wide and bay 3 7 m"]),
    ],
)
def test_mirrored_in_a_frame_that_is_not_symmetric_is_reported(bays: str, reported: list[str]) -> None:
    project = parse_project(project_text(bays, "[4 m]"), "project.yaml", profile_names(), files=False)
    text = GOOD.replace("shake", "first").replace("bays: 1", "bays: all, limits: {mirrored: true}")
    spec = design(text, project)
    assert isinstance(spec, PlacementDesign)
    found = placement_warnings(spec, project)
    assert len(found) == len(reported) and all(part in text for part, text in zip(reported, found, strict=True))
    whole = spec.model_copy(update={"limits": LayoutLimits()})
    assert placement_warnings(whole, project) == []


@pytest.mark.parametrize(
    "model", [PlacementDesign, CandidatePlaces, CatalogueItem, Costs, LayoutLimits, PlacementVerify]
)
def test_every_key_is_documented(model: type[Model]) -> None:
    text = (THESIS.parents[2] / "docs" / "how_to" / "damper_placement.md").read_text(encoding="utf-8")
    missing = [name for name in model.model_fields if not re.search(rf"[`{{ ]{name}[`,:}}]", text)]
    assert missing == []
