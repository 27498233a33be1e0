"""Axial forces that beams collect: by hand, and against a frame whose floors are not rigid."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL, building

from edesign.archive.dataset import Group
from edesign.frame.frame import build_frame
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.analysis.analyses import PushoverAnalysis
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.space.analysis.bracing import bracing
from edesign.space.nonlinear.build import build_building
from edesign.space.structure.geometry import space_frame
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.pushover import run_pushover
from edesign.study.results.collectors import Collectors

TEXT = """\
edesign: 1
title: Springs and braces between stiff beams
frame:
  bays: [6 m, 8 m, 4 m]
  storeys: [3.5 m, 3 m]
  diaphragms: all
  columns: [{lines: all, storeys: all, section: HEB300, material: elastic}]
  beams: [{floors: all, section: stiff, material: elastic}]
  braces:
    - {bays: 2, storeys: all, kind: chevron, section: SHS100x5, material: elastic}
    - {bays: 3, storeys: 1, kind: rising, section: SHS100x5, material: elastic}
sections: {stiff: {area: 40 m^2, inertia: 1e-4 m^4}}
materials: {elastic: {law: elastic, E: 210 GPa}}
loads:
  beams: [{floors: all, bays: all, G: 0 kN/m, Q: 0 kN/m}]
  gravity: {G: 1, Q: 0}
masses:
  directions: horizontal
  given:
    - {lines: A, floors: all, mass: 15 t}
    - {lines: B, floors: all, mass: 35 t}
    - {lines: C, floors: all, mass: 30 t}
    - {lines: D, floors: all, mass: 10 t}
design: {}
elements: {geometry: {columns: linear, braces: linear}}
dampers:
  laws: {spring: {type: elastic_plastic, parameters: {k: 30 kN/mm, Fy: 1e6 kN, b: 0}}}
  devices:
    - {storeys: all, bays: 1, kind: chevron, law: spring, brace: rigid, number: 1}
    - {storeys: 2, bays: 3, kind: falling, law: spring, brace: rigid, number: 1}
analyses: [{name: push, kind: pushover, pattern: uniform, roof_drift: 0.2 %, steps: 4, dampers: true}]
"""
"""Masses go with the beams beside each node: 10 t for 4 m. The push is uniform, so its forces do as well."""


def project(text: str = TEXT) -> Project:
    return parse_project(text, Path("frame.yaml"), BuildingSections(), files=False)


def pushed(text: str, monkeypatch: pytest.MonkeyPatch) -> tuple[Group, np.ndarray]:
    """The results of the push, and at its end the axial force on both sides of the middle of beams where it jumps."""
    seen: list[np.ndarray] = []
    axial = Collectors.axial

    def watched(self: Collectors, pulls: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        found = axial(self, pulls)
        seen.append(found[1][-1])
        return found

    monkeypatch.setattr(Collectors, "axial", watched)
    of = project(text)
    (push,) = of.analyses
    assert isinstance(push, PushoverAnalysis)
    return run_pushover(of, push), seen[-1]


def internal(group: Group, name: str) -> np.ndarray:
    """Largest axial force at both ends of a beam, tension positive; the push grows from nothing."""
    at = [str(one) for one in group.coords["member"].values].index(name)
    most, least = (np.asarray(group.variables[f"member_axial_force_{which}"].values)[at] for which in ("max", "min"))
    return np.where(np.abs(most) > np.abs(least), most, least) * np.array([-1.0, 1.0])


def test_half_of_the_force_at_each_side_of_a_chevron() -> None:
    """One bay of 6 m: a damper that pulls the beam to the left with 1 in its middle, and nothing else.

    The floor holds it with 1/6 per m to the right: -1/2 before the middle, +1/2 behind, nothing at the ends. The column
    that pushes its node with 1 to the right is in balance with 1/6 per m to the left: -1 beside it, -1/2 in the middle.
    """
    one_bay = (
        TEXT.replace("[6 m, 8 m, 4 m]", "[6 m]")
        .replace("[3.5 m, 3 m]", "[3.5 m]")
        .replace("    - {lines: C, floors: all, mass: 30 t}\n    - {lines: D, floors: all, mass: 10 t}\n", "")
        .replace("    - {storeys: 2, bays: 3, kind: falling, law: spring, brace: rigid, number: 1}\n", "")
    )
    start, end = one_bay.index("  braces:"), one_bay.index("sections:")
    of = project(one_bay[:start] + one_bay[end:])
    found = Collectors(build_frame(of, laws=device_laws(of)))
    assert [beam.name for beam in found.beams] == ["B_1_1"]
    assert found.quantity is not None
    (apex,) = [
        i for i, terms in enumerate(found.quantity.cells) if any(kind == "damper_force" for _, kind, *_ in terms)
    ]
    assert found.quantity.cells[apex] == ((-1.0, "damper_force", 0, 0),)
    of_damper, of_column = np.zeros((2, len(found.quantity.cells)))
    of_damper[apex] = -1.0  # a damper with the force 1
    of_column[1 - apex if apex < 2 else 0] = 1.0
    ends, middle = found.axial(np.stack([of_damper, of_column]))
    np.testing.assert_allclose(ends[0, 0], [0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(middle[0, 0], [-0.5, 0.5], rtol=1e-14)
    np.testing.assert_allclose(ends[1, 0], [-1.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(middle[1, 0], [-0.5, -0.5], rtol=1e-14)


def test_collected_forces_are_those_of_a_frame_whose_floors_are_not_rigid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beams of 40 m2 stretch so little that the frame moves as with rigid floors; there the model has their forces.

    It has the push on its nodes, which the rule spreads along the beams: forces agree in the mean of each beam. A
    damper of a chevron pushes the ends of its beam there: half of it is tension on one side of the middle, half is
    compression on the other, and the mean is that of the model.
    """
    rigid, middles = pushed(TEXT, monkeypatch)
    free, jumps = pushed(TEXT.replace("diaphragms: all", "diaphragms: none"), monkeypatch)
    scale = float(np.abs(rigid.variables["base_shear"].values).max())
    names = [str(one) for one in rigid.coords["collector"].values]
    assert names == ["B_1_1", "B_2_1_1", "B_2_1_2", "B_3_1", "B_1_2", "B_2_2_1", "B_2_2_2", "B_3_2"]
    for floor in (1, 2):
        beams = (f"B_1_{floor}",), (f"B_2_{floor}_1", f"B_2_{floor}_2"), (f"B_3_{floor}",)
        for halves in beams:
            first, second = (np.array([internal(group, name) for name in halves]) for group in (rigid, free))
            if halves == beams[0]:
                sides, half = middles[floor - 1], jumps[floor - 1]
                assert sides[0] - sides[1] == pytest.approx(half[0] - half[1], rel=1e-3)
                assert half[0] == pytest.approx(-half[1], rel=1e-9)
                first = np.array([first[0], sides])
            elif halves == beams[1]:  # what braces bring to the node between the halves
                jump = first[0, 1] - first[1, 0]
                assert jump == pytest.approx(second[0, 1] - second[1, 0], rel=1e-3)
                assert abs(jump) > 0.1 * scale
            assert first.mean() == pytest.approx(second.mean(), abs=1e-3 * scale)
            assert abs(first.mean()) > 5e-3 * scale


def test_pairs_of_braces_of_a_building_bring_what_they_do_in_its_elastic_design() -> None:
    """Crosses of which one diagonal acts: force by force `Bracing.to_collectors`, twice it in tension, else nothing."""
    whole = building(SMALL)
    frame = space_frame(whole)
    elastic = bracing(frame)
    found = Collectors(build_building(whole))
    assert found.quantity is not None
    number = {frame.members[at].name: i for i, at in enumerate(elastic.braces)}
    pairs = {key[1]: channel for key, channel in found._channel.items() if key[0] == "pair"}
    assert set(pairs) == set(number)
    beams = [frame.members[at].name for at in elastic.collectors]
    rows = [beams.index(beam.name) for beam in found.beams]
    expected = elastic.to_collectors.reshape(len(beams), -1, len(number))[rows][:, [0, -1]]
    for name, channel in pairs.items():
        pulls = np.zeros((2, len(found.quantity.cells)))
        pulls[:, channel] = 1.0, -1.0
        ends, _ = found.axial(pulls)
        np.testing.assert_allclose(ends[0], 2.0 * expected[:, :, number[name]], atol=1e-12)
        assert not ends[1].any()
