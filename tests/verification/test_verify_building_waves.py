"""Waves that reach the column bases of a building one after the other.

References: plane frames under the same waves; the same motion of all supports where the wave is fast; translation and
turn of a rigid floor on supports that move late, integrated here; a wave seen with the axes of the plan exchanged.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_basements import CELLAR
from verification.test_verify_building_model import STEP, completed, displacement, motion, under_gravity
from verification.test_verify_building_supports import FIRST, on, on_plane, table
from verification.test_verify_shaken_buildings import stiffness

from edesign.archive.dataset import Group
from edesign.core import Channel, Response
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.delayed import delayed_by
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.wave_passage import WavePassage
from edesign.space.nonlinear import build_building
from edesign.study.analysis.structure import make_frame
from edesign.study.analysis.wave_passage import DelayedSupports
from edesign.study.motions.applied import GroundMotion


def passing(
    frame: FrameModel, channels: list[Channel], x: np.ndarray, y: np.ndarray | None = None, **wave: object
) -> tuple[Response, Group]:
    """A history of a frame or building under gravity in which a wave passes below it; without one all at once."""
    passage = WavePassage.model_validate(wave) if wave else None
    spec = HistoryAnalysis.model_construct(name="passing", record="made", wave_passage=passage)
    records = [None if samples is None else Record("made", samples, STEP, "made here") for samples in (x, y)]
    assert records[0] is not None
    late = DelayedSupports(spec, frame, GroundMotion(records[0], across=records[1]))
    analysis, _ = under_gravity(frame)
    analysis.install_dampers()
    analysis.rayleigh(0.3, 0.002, "initial")
    response = completed(analysis.history(x, STEP, channels=channels, along_y=y, supports=late.motions))
    group = Group()
    late.store(group, frame)
    return response, group


def watched(frame: FrameModel, direction: int, lines: tuple[str, ...], count: float) -> list[Channel]:
    """Floors, drifts of lines and the reactions of the first frame along a direction."""
    found = [displacement(f"floor {floor.number}", floor.movers[direction][0]) for floor in frame.floors]
    for storey in frame.storeys:
        drifts = {at.line: at.ratio for at in storey.drifts[direction]}
        found += [displacement(f"drift {storey.number} {i}", drifts[line]) for i, line in enumerate(lines)]
    shares = [(-c / count, *rest) for n in frame.supports for c, *rest in frame.reaction(n, direction)]
    return [*found, Channel("shear", tuple(tuple(term) for term in shares))]  # type: ignore[misc]


@pytest.mark.parametrize("soft", [False, True], ids=["fixed", "springs"])
@pytest.mark.parametrize("along", ["x", "y"])
def test_a_row_of_plane_frames(along: str, soft: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """1e-9, of frames that yield."""
    in_space = "{@u@: 60 MN/m, uz: 300 MN/m, @r@: 40 MN*m/rad}" if soft else "fixed"
    in_plane = "{horizontal: 60 MN/m, vertical: 300 MN/m, rotation: 40 MN*m/rad}" if soft else "fixed"
    whole = on(in_space, along)
    plane, space = make_frame(on_plane(whole, in_plane, along, monkeypatch)), build_building(whole)
    record, direction = motion(1, 1.5), "xy".index(along)
    expected, told = passing(plane, watched(plane, 0, FIRST[along], 1.0), record, velocity="150 m/s")
    ground = (record, None) if along == "x" else (np.zeros_like(record), record)
    channels = watched(space, direction, FIRST[along], 2.0)
    found, also = passing(space, channels, *ground, velocity="150 m/s", direction=f"{90 * direction} deg")
    for name, values in expected.values.items():
        scale = max(expected.peak(other) for other in expected.values if other[:5] == name[:5])
        np.testing.assert_allclose(found.values[name], values, rtol=0, atol=1e-9 * scale, err_msg=name)
    assert expected.energy_final["hysteretic"] > 0.2 * expected.energy_final["input"]
    assert found.energy_final["input"] == pytest.approx(2.0 * expected.energy_final["input"], rel=1e-8)
    apart = also.variables["foot_displacement_largest"].values
    assert sorted(set(apart[:, direction].round(12))) == sorted(
        told.variables["foot_displacement_largest"].values.round(12)
    )
    assert not apart[:, 1 - direction].any()


def test_a_fast_wave_reaches_all_supports_at_once() -> None:
    """At 3e8 m/s the last support is late by 4e-8 s, which moves it by 1e-8 of what floors move; 1e-6 of the shear."""
    space = build_building(on("fixed", "x"))
    channels = [*watched(space, 0, FIRST["x"], 1.0), displacement("roof y", space.floors[-1].movers[1][0])]
    pair = motion(1), motion(2)
    expected, found = (
        passing(space, channels, *pair)[0],
        passing(space, channels, *pair, velocity="3e8 m/s", direction="30 deg")[0],
    )
    for name, values in expected.values.items():
        np.testing.assert_allclose(found.values[name], values, rtol=0, atol=1e-6 * expected.peak(name), err_msg=name)


def test_a_floor_turns_over_a_wave_across_its_way() -> None:
    """A wave along x that shakes along y reaches the columns at 6 m later: the floor turns, as a rigid body on springs.

    Integrated by hand with the same rule, average acceleration; 1e-8: its columns are exact cantilevers.
    """
    space = build_building(table("fixed"))
    (floor,), record, delay = space.floors, motion(3), 0.03
    channels = [displacement("y", floor.movers[1][0]), displacement("turn", floor.turn)]
    wave = {"velocity": f"{6.0 / delay} m/s", "direction": "0 deg"}
    found, _ = passing(space, channels, np.zeros_like(record), record, **wave)
    k_x, k_y, k_t = stiffness("HEB200")
    mass, arm = 32e3, 3.0
    polar, turning = mass * (arm**2 + 2.5**2), 4.0 * (k_x * 2.5**2 + k_y * arm**2 + k_t)
    late = delayed_by(record, STEP, delay)
    sway = on_late_supports(mass, 4.0 * k_y, 2.0 * k_y, -mass * record, late)
    turn = on_late_supports(polar, turning, 2.0 * k_y * arm, np.zeros_like(record), late)
    for name, expected in (("y", sway), ("turn", turn)):
        np.testing.assert_allclose(found.values[name], expected, rtol=0, atol=1e-8 * np.abs(expected).max())


def on_late_supports(m: float, k: float, drag: float, force: np.ndarray, late: tuple[np.ndarray, ...]) -> np.ndarray:
    """Displacement of one degree under a force, some of whose springs, `drag` of `k`, stand on supports that move.

    Damping is 0.3 of the mass and 0.002 of the stiffness, on the velocity beyond that of slow supports.
    """
    c, applied, slow = 0.3 * m + 0.002 * k, force + drag * late[0], drag / k * late[1]
    u = v = 0.0
    a = (applied[0] + c * slow[0]) / m
    found = [u]
    for push, base in zip(applied[1:], slow[1:], strict=True):
        effective = push + c * base + m * (4.0 * u / STEP**2 + 4.0 * v / STEP + a) + c * (2.0 * u / STEP + v)
        new = effective / (k + 2.0 * c / STEP + 4.0 * m / STEP**2)
        a = 4.0 * (new - u) / STEP**2 - 4.0 * v / STEP - a
        u, v = new, 2.0 * (new - u) / STEP - v
        found.append(u)
    return np.array(found)


def test_delays_of_column_lines() -> None:
    """Of a wave at an angle by the place along it; those that are given by selections, of which later ones count."""
    grid = building(table("fixed").text).grid
    slanted = WavePassage.model_validate({"velocity": "100 m/s", "direction": "30 deg"}).delays_of(grid)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    expected = {"A1": 0.0, "A2": 0.05 * s, "B1": 0.06 * c, "B2": 0.06 * c + 0.05 * s}
    assert slanted == pytest.approx(expected, abs=1e-15)
    back = WavePassage.model_validate({"velocity": "100 m/s", "direction": "180 deg"}).delays_of(grid)
    assert back == pytest.approx({"A1": 0.06, "A2": 0.06, "B1": 0.0, "B2": 0.0}, abs=1e-15)
    given = WavePassage.model_validate({"delays": {"B": "20 ms", "B2": "30 ms"}}).delays_of(grid)
    assert given == {"A1": 0.0, "A2": 0.0, "B1": 0.02, "B2": 0.03}


@pytest.mark.parametrize(("rigid", "rz"), [("all", "free"), ("2-3", "fixed")])
def test_walls_of_a_basement_move_with_the_ground_beside_them(rigid: str, rz: str) -> None:
    """Walls on springs at each column line, of which the ground reaches each late, hold the floor as rigid ones do.

    A rigid floor turns as the body that is nearest to its walls. 1e-3: walls of 1e11 N/m give by 5e-4 of the turns.
    """
    text = CELLAR.replace("@rigid@", rigid)
    wave, found = {"velocity": "200 m/s", "direction": "30 deg"}, []
    for walls in ("{floors: 1}", f"{{floors: 1, ux: 1e11 N/m, uy: 1e11 N/m, rz: {rz}}}"):
        frame = build_building(building(text.replace("{floors: 1}", walls, 1)))
        channels = [displacement(f"turn {floor.number}", floor.turn) for floor in frame.floors if floor.turn]
        for floor in frame.floors:
            channels += [displacement(f"{axis} {floor.number}", floor.movers[at][0]) for at, axis in enumerate("xy")]
        response, group = passing(frame, channels, motion(1), motion(2), **wave)
        found.append(response)
        delays = dict(zip(group.coords["foot"].values, group.variables["foot_delay"].values, strict=True))
        assert all(
            delays[name] == delays[f"{name[:-2]}.0"] for name in delays if name[-2:] == ".1" and name[0] in "ABC"
        )
    assert found[0].peak("x 1") > 0.02
    for name, values in found[1].values.items():
        np.testing.assert_allclose(found[0].values[name], values, rtol=0, atol=1e-3 * found[1].peak(name), err_msg=name)
