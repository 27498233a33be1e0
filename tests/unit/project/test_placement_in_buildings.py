"""Placements in studies of buildings: what is refused, which places are alike, and what the devices say."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from building_examples import DAMPED

from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.project.dampers.device_names import names_of_design
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation.grid import BayPlace
from edesign.project.study.study import Study
from edesign.study.design.device_text import devices_text
from edesign.study.placement.candidates import make_candidates, make_stacks
from edesign.study.placement.placement import check_placement

BUILDING = (
    DAMPED.partition("  devices:")[0]
    + """\
damping: {kind: rayleigh, ratio: 3 %, periods: [1.2 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s}
records: {pairs: {suite: fema_p695_far_field, only: 1, components: [x, y], match: {method: scale}}}
"""
)
STUDY = """\
edesign_study: 1
title: Two storeys, placed
project: building.yaml
designs:
  edges:
    method: placement
    kind: rising
    places:
      - {along: x, frames: [X1, X3], bays: 1, tied: true}
      - {along: y, frames: C, bays: all, storeys: 1}
    catalogue: {small: {law: oil, scale: 2, cost: 1}, large: {law: oil, scale: 5, cost: 1.6, kind: chevron}}
    verify: {records: pairs, levels: DBE, criteria: drift, eccentricity: [0, +x+y]}
variants: {damped: {design: edges}}
criteria: [{name: drift, measure: interstorey_drift, most: 1 %, levels: DBE}]
"""


def study_of(folder: Path, *changes: tuple[str, str]) -> Study:
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "building.yaml").write_text(BUILDING, encoding="utf-8")
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    return load_study(folder / "study.yaml")


def placement(study: Study) -> PlacementDesign:
    spec = study.designs["edges"]
    assert isinstance(spec, PlacementDesign)
    return spec


PLACES = STUDY.partition("    places:\n")[2].partition("    catalogue")[0]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (f"    places:\n{PLACES}", "    bays: all\n", r"designs.edges.bays: .* give `places`.*E-KEY-03"),
        (f"    places:\n{PLACES}", "", r"designs.edges.places: this key is missing: .*E-KEY-02"),
        ("frames: [X1, X3]", "frames: [X1, X4]", r"places\[0\].frames.*no frame `X4` along x; they are 1 to 3"),
        ("frames: C", "frames: 2", r"places\[1\].frames.*no frame `2` along y"),
        ("bays: 1, tied", "bays: 3, tied", r"places\[0\].bays: there is no bay 3 along x"),
        ("storeys: 1}", "storeys: 1-3}", r"places\[1\].storeys: there is no storey 3"),
        ("    kind: rising\n", "    kind: rising\n    storeys: 3\n", r"designs.edges.storeys: there is no storey 3"),
        (
            "{along: y, frames: C, bays: all, storeys: 1}",
            "{along: x, frames: 1-2, bays: 1-2}",
            r"places\[1\]: bay 1 of frame X1 in storey 1 is a candidate of an entry before.*E-NAME-02",
        ),
        (
            "    verify:",
            "    limits: {mirrored: true}\n    verify:",
            r"mirrored: bay 1 along x has its mirror image in bay 2, which is no candidate.*E-NAME-01",
        ),
        ("    verify:", "    limits: {storey_groups: [1-3]}\n    verify:", r"storey_groups\[0\]: there is no storey 3"),
        ("eccentricity: [0, +x+y]", "eccentricity: [0, 0]", r"verify.eccentricity\[1\]: `0` stands here twice"),
        ("law: oil, scale: 2", "law: tar, scale: 2", r"catalogue.small.law: there is no damper law `tar`"),
    ],
)
def test_wrong_placements_are_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        study_of(tmp_path, (old, new))


def test_a_brace_that_is_in_no_catalogue_is_refused_at_its_item(tmp_path: Path) -> None:
    brace = "scale: 2, cost: 1, brace: {section: SHS1x1, material: S275}"
    study = study_of(tmp_path, ("scale: 2, cost: 1", brace))
    said = r"^designs.edges.catalogue.small.*SHS1x1.*\(at frame X1, bay 1, storey 1\).*E-PLACE-01"
    with pytest.raises(InputError, match=said):
        check_placement(study.base, "edges", placement(study), 2)


def test_places_that_are_alike(tmp_path: Path) -> None:
    """Tied frames share their positions, other frames have their own; the bays of a frame are alike."""
    study = study_of(tmp_path)
    spec = placement(study)
    tied, own = make_stacks(study.base, spec)
    assert tied.places == tuple(BayPlace(frame, 1, storey) for storey in (1, 2) for frame in ("X1", "X3"))
    assert own.places == (BayPlace("YC", 1, 1), BayPlace("YC", 2, 1))
    loose = placement(study_of(tmp_path, (", tied: true", "")))
    assert [one.places[0].frame for one in make_stacks(study.base, loose)] == ["X1", "X3", "YC"]
    found = names_of_design(study.base.grid, spec)
    assert found[:4] == ("RX_1_1_1", "RX_3_1_1", "RX_1_1_2", "RX_3_1_2") and len(found) == 2 * (4 + 2)


def test_devices_of_a_layout_stand_in_runs_by_direction(tmp_path: Path) -> None:
    study = study_of(tmp_path)
    candidates = make_candidates(study.base, "edges", placement(study))
    assert candidates.space.size == 27
    runs = yaml.safe_load(devices_text(candidates.dampers((2, 0, 1))))["devices"]
    assert [{key: run[key] for key in ("kind", "along", "frames", "bays", "storeys", "scale")} for run in runs] == [
        {"kind": "rising", "along": "y", "frames": "YC", "bays": "1-2", "storeys": 1, "scale": 2.0},
        {"kind": "chevron", "along": "x", "frames": ["X1", "X3"], "bays": 1, "storeys": 1, "scale": 5.0},
    ]


def test_mirrored_diagonals_lean_both_ways_in_each_frame(tmp_path: Path) -> None:
    changes = [("frames: [X1, X3], bays: 1", "frames: [X1, X3], bays: all")]
    changes.append(("    verify:", "    limits: {mirrored: true}\n    verify:"))
    study = study_of(tmp_path, *changes)
    candidates = make_candidates(study.base, "edges", placement(study))
    kinds = {place: candidates.kind(1, place) for place in candidates.equipped((1, 0, 1))}
    assert {kind for place, kind in kinds.items() if place.bay == 1} == {"rising"}
    assert {kind for place, kind in kinds.items() if place.bay == 2} == {"falling"} and len(kinds) == 6
