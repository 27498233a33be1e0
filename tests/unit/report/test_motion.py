"""The motion of a frame as it is drawn and as the page carries it."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path

import numpy as np
import pytest

from edesign.project import load_project
from edesign.report.motion.encoding import STEPS, Packed
from edesign.report.motion.frame_geometry import moving_frame
from edesign.report.motion.geometry import BELOW, GROUND, SIGN, Geometry, floor_shares
from edesign.report.motion.still import member_curve

COLUMN = Geometry({"A0": (0.0, 0.0), "A1": (0.0, 4.0)}, {"C_A_1": (0, 1), "D_1_1_r": (0, 1)}, (), (0.0, 4.0))


def test_series_come_back_as_they_were_put_in() -> None:
    """The whole way of the viewer, in numpy: within half a step of the largest value, zero stays zero."""
    rng = np.random.default_rng(5)
    tables = [1e-3 * rng.normal(size=(40, 3)).cumsum(axis=0), np.zeros((40, 2)), 1e6 * rng.normal(size=118)]
    packed = Packed()
    places = [packed.add(table) for table in tables]
    content = np.frombuffer(zlib.decompress(base64.b64decode(packed.text())), dtype=np.uint8)
    low, high = content.reshape(2, -1).astype(np.int32)
    steps = ((low | high << 8) + 0x8000) % 0x10000 - 0x8000
    for table, place in zip(tables, places, strict=True):
        n, w = place["n"], place["w"]
        found = steps[place["at"] : place["at"] + n * w].reshape(w, n).cumsum(axis=1).T * place["q"]
        # half a step, and the rounding of the step to six digits
        assert found == pytest.approx(table.reshape(n, w), abs=np.abs(table).max() * (0.5 / STEPS + 1e-6), rel=0.0)


def test_largest_jumps_fit_sixteen_bits() -> None:
    packed = Packed()
    packed.add(np.array([1.0, -1.0, 1.0]))
    content = np.frombuffer(zlib.decompress(base64.b64decode(packed.text())), dtype=np.uint8).reshape(2, -1)
    assert (content[0].astype(int) | content[1].astype(int) << 8).tolist() == [STEPS, 0x10000 - 2 * STEPS, 2 * STEPS]


def test_columns_bend_as_beam_theory_says() -> None:
    """Without loads between its ends a member is a cubic: sway of clamped ends, and of a cantilever (Timoshenko)."""
    clamped = np.array([[0.0, 0.0, 0.0], [0.08, 0.0, 0.0]])
    curve = member_curve(COLUMN, "C_A_1", clamped, 10.0)
    # u = D (3 s^2 - 2 s^3): 5/32 D at a quarter, D / 2 in the middle
    assert curve[[4, 8, 16], 0] == pytest.approx([0.8 * 5 / 32, 0.4, 0.8], abs=1e-12)
    cantilever = np.array([[0.0, 0.0, 0.0], [0.08, 0.0, -1.5 * 0.08 / 4.0]])  # the end turns by 3 D / (2 L), clockwise
    curve = member_curve(COLUMN, "C_A_1", cantilever, 10.0)
    # u = D (3 s^2 - s^3) / 2: 5/16 D in the middle
    assert curve[[8, 16], 0] == pytest.approx([0.25, 0.8], abs=1e-12)
    assert curve[:, 1] == pytest.approx(np.linspace(0.0, 4.0, 17), abs=1e-12)
    brace = member_curve(COLUMN, "D_1_1_r", clamped, 10.0)
    assert brace[:, 0] == pytest.approx(np.linspace(0.0, 0.8, 17), abs=1e-12)


def test_nodes_between_floors_move_with_both() -> None:
    found = floor_shares((0.0, 4.0, 7.0), [(0.0, 0.0), (0.0, 4.0), (3.0, 5.5), (0.0, 7.0)])
    assert found == [(0, 0.0), (1, 0.0), (1, pytest.approx(0.5)), (1, 1.0)]


ISOLATED = """\
edesign: 1
title: Two storeys
frame:
  bays: [6 m, 4 m]
  storeys: [4 m, 3 m]
  supports: {A: pinned, B: fixed, C: roller}
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: elastic, E: 210 GPa}
masses: {given: [{lines: all, floors: all, mass: 20 t}]}
analyses: [{name: modes, kind: modal, modes: 1}]
"""


def test_isolators_stand_between_the_ground_and_their_bases(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text(ISOLATED, encoding="utf-8")
    frame = load_project(tmp_path / "project.yaml").frame
    on_supports = moving_frame(frame, ("R_1_1",), ("T_2_1", "T_2_2", "T_1_3"))
    assert [support.kind for support in on_supports.supports] == ["pinned", "fixed", "roller"]
    assert on_supports.ground == 0.0 and on_supports.base == ()
    assert [mass.at.at for mass in on_supports.masses] == [(2.5, 7.0), (7.5, 7.0), (2.5, 4.0)]

    isolated = moving_frame(frame, ("I_A", "I_B", "I_C", "G_C", "G_C_2", "R_1_1"))
    places = list(isolated.nodes.values())
    assert isolated.supports == () and [places[i] for i in isolated.base] == [(0.0, 0.0), (6.0, 0.0), (10.0, 0.0)]
    assert isolated.ground == -BELOW * 10.0
    assert [damper.name for damper in isolated.dampers] == ["I_A", "I_B", "I_C", "G_C", "G_C_2", "R_1_1"]
    for damper, x in zip(isolated.dampers[:3], (0.0, 6.0, 10.0), strict=True):
        below, above = damper.body
        assert (below.at, below.nodes, above.at) == ((x, isolated.ground), GROUND, (x, 0.0))
        assert places[above.nodes[0]] == (x, 0.0) and damper.wide == SIGN * 10.0
    assert isolated.dampers[3].body[0].at[0] < isolated.dampers[4].body[0].at[0]
