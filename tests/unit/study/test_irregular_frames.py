"""Frames with gaps, setbacks, hinges and braces: equilibrium of what is recorded, and a place for it in the archive."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.study.frames import project

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.study.run.analyses import run_analysis

SETBACK = """\
edesign: 1
title: Braced frame with a setback, a missing column and hinged beams
frame:
  bays: [6 m, 5 m, 7 m]
  storeys: [4.5 m, 3.5 m, 3 m]
  supports: {default: pinned, D: roller}
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
  braces:
    - {bays: 2, storeys: 1-2, kind: cross, section: rod, material: S275}
    - {bays: 1, storeys: 3, kind: falling, section: rod, material: S275}
  missing:
    columns: [{lines: D, storeys: 2-3}, {lines: B, storeys: 1}]
    beams: [{bays: 3, floors: 2-3}]
  releases: [{beams: {bays: 1, floors: 1}, ends: both}]
sections:
  rod: {area: 20 cm^2}
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams: [{floors: all, G: 15 kN/m, Q: 9 kN/m}]
masses: {from_loads: {}}
damping: {kind: rayleigh, ratio: 3 %}
integration: {method: hht, time_step: 0.01 s}
records:
  wave: {file: wave.csv, acceleration_unit: g, time_step: 0.05 s}
analyses:
  - {name: modes, kind: modal, modes: 3}
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: triangular, roof_drift: 1 %, steps: 50}
  - {name: shake, kind: history, record: wave, free_vibration: 1 s}
outputs:
  members: [C_A_1, D_2_1_f]
  sections: [{member: B_1_1}]
  fibres: [{member: C_A_2, points: [1, 5], layers: top}, {member: C_A_2, points: 5, layers: [1, 24]}]
"""


@pytest.fixture(scope="module")
def groups(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Group]:
    folder = tmp_path_factory.mktemp("setback")
    (folder / "wave.csv").write_text("\n".join(f"{0.3 * np.sin(2 * np.pi * i / 20):.6f}" for i in range(60)))
    made = project(SETBACK, folder / "project.yaml")
    return {spec.name: run_analysis(made, spec) for spec in made.analyses}


def test_all_analyses_complete(groups: dict[str, Group]) -> None:
    assert {name: group.attributes["reason"] for name, group in groups.items()} == dict.fromkeys(groups, "")
    assert all(group.attributes["status"] == "completed" for group in groups.values())


def test_lateral_equilibrium_of_every_storey(groups: dict[str, Group]) -> None:
    """The shear of a storey, in columns and braces, is the sum of the loads above it; at the base the base shear."""
    group = groups["push"]
    lateral = group.variables["lateral_load"].values
    shear = group.variables["storey_shear"].values
    shares = dict(zip(group.coords["loaded_node"].values, group.variables["lateral_load_share"].values, strict=True))
    for storey in (1, 2, 3):
        above = sum(share for node, share in shares.items() if int(node[1:]) >= storey)
        assert np.abs(shear[:, storey - 1] - above * lateral).max() < 1e-6 * lateral.max()
    assert np.abs(group.variables["base_shear"].values - lateral).max() < 1e-6 * lateral.max()
    assert lateral[-1] > 1e5


def test_vertical_equilibrium_under_gravity(groups: dict[str, Group]) -> None:
    """15 + 0.3 * 9 kN/m on 18 m at floor 1 and 11 m at floors 2 and 3; line B has no support."""
    group = groups["gravity"]
    assert list(group.coords["support"].values) == ["A0", "B0", "C0", "D0"]
    total = group.variables["reaction_y_final"].values.sum()
    assert total == pytest.approx(17.7e3 * (18 + 11 + 11), rel=1e-7)
    hinged = list(group.coords["member"].values).index("B_1_1")
    assert np.abs(group.variables["member_bending_moment_max"].values[hinged]).max() < 1e-3  # N m, of 5e4 if rigid
    assert group.variables["reaction_x_final"].values[3] == 0.0  # the roller


def test_the_roller_moves_and_drifts_are_of_lines_with_columns(groups: dict[str, Group]) -> None:
    group = groups["push"]
    largest, mean = group.variables["storey_drift_max"].values, group.variables["storey_drift"].values[-1]
    assert np.all(largest >= mean - 1e-12) and largest.max() > 0.01  # the drift of the whole
    # the first node of the roof goes to the target; without diaphragm the mean of the roof's nodes is a little off
    assert group.attributes["target_roof_displacement_m"] == pytest.approx(0.01 * 11.0)
    assert group.variables["roof_displacement"].values[-1] == pytest.approx(0.01 * 11.0, rel=0.05)


def test_braces_carry_axial_force_only(groups: dict[str, Group]) -> None:
    group = groups["shake"]
    at = list(group.coords["recorded_member"].values).index("D_2_1_f")
    axial = group.variables["member_axial_force"].values[:, at]
    assert np.abs(axial).max() > 1e3
    assert np.abs(axial.sum(axis=1)).max() < 1e-9 * np.abs(axial).max()  # the two ends balance
    assert np.all(group.variables["member_bending_moment"].values[:, at] == 0.0)
    brace = list(group.coords["brace"].values).index("D_2_1_f")
    peak = group.variables["brace_axial_force_max"].values[brace]
    assert peak == pytest.approx(axial[:, 1].max(), rel=6e-8)  # float32; tension pulls the end along the axis


def test_what_is_asked_for_besides_changes_no_envelope(groups: dict[str, Group], tmp_path: Path) -> None:
    """Member forces are recorded twice: extremes of all members, and histories of the members that are asked for."""
    (tmp_path / "wave.csv").write_text("\n".join(f"{0.3 * np.sin(2 * np.pi * i / 20):.6f}" for i in range(60)))
    made = project(SETBACK[: SETBACK.index("outputs:")], tmp_path / "project.yaml")
    plain = run_analysis(made, made.analyses[3])
    full = groups["shake"].variables
    extremes = [name for name in plain.variables if name.endswith(("_max", "_min"))]
    assert {"member_axial_force_max", "member_bending_moment_min"} <= set(extremes)
    for name in extremes:
        np.testing.assert_array_equal(full[name].values, plain.variables[name].values, err_msg=name)
    moments = full["member_bending_moment"].values[:, 0]  # C_A_1 is the first of both lists
    largest = full["member_bending_moment_max"].values[0]
    np.testing.assert_allclose(moments.max(axis=0), largest, rtol=6e-8)  # histories are float32


def test_a_fibre_that_is_asked_for_twice_is_kept_once(groups: dict[str, Group]) -> None:
    labels = ["C_A_2:1:24", "C_A_2:5:24", "C_A_2:5:1"]
    assert list(groups["shake"].coords["fibre"].values) == labels
    depths = groups["shake"].variables["fibre_depth"].values
    assert depths[0] == depths[1] == -depths[2] > 0.0


def test_every_group_goes_through_the_archive(groups: dict[str, Group], tmp_path: Path) -> None:
    with ArchiveWriter(tmp_path / "all.h5", Group()) as writer:
        for name, group in groups.items():
            writer.write(f"analyses/{name}", group)
        path = writer.finish()
    with open_archive(path) as archive:
        for name, group in groups.items():
            read = archive.group(f"analyses/{name}")
            assert set(read.variables) == set(group.variables) and set(read.coords) == set(group.coords)
            for key, variable in group.variables.items():
                np.testing.assert_array_equal(read.variables[key].values, variable.values, err_msg=key)
                assert read.variables[key].dims == variable.dims and variable.long_name


def test_the_same_project_gives_the_same_bits(groups: dict[str, Group], tmp_path: Path) -> None:
    (tmp_path / "wave.csv").write_text("\n".join(f"{0.3 * np.sin(2 * np.pi * i / 20):.6f}" for i in range(60)))
    made = project(SETBACK, tmp_path / "project.yaml")
    again = run_analysis(made, made.analyses[3])
    for key, variable in groups["shake"].variables.items():
        np.testing.assert_array_equal(again.variables[key].values, variable.values, err_msg=key)
