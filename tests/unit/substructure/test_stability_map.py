"""Stable delays of the rig, and the map of them, against closed forms and against runs of the loop on both sides."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from linear_specimens import linear_specimen
from messages import says
from unit.substructure.delayed_oscillator import critical_delay

from edesign.cli.main import main
from edesign.project.substructure import parse_rts_file
from edesign.report.substructure.map_figures import map_figure
from edesign.substructure.advice.expectation import LinearModel
from edesign.substructure.advice.stability_map import RANGE, StabilityMap, governing_map
from edesign.substructure.stability.loop import Loop, pure_delay
from edesign.substructure.stability.stable_delays import stable_delays
from edesign.substructure.stability.sweep import sweep
from edesign.substructure.stability.whole import WholeStructure
from edesign.substructure.virtual_tests import VirtualLaboratory

TURN = 2.0 * math.pi
MASS, SPRING, SPECIMEN, DAMPING = 100e3, 20e6, 8e6, 0.05
COMPENSATORS = """\
  none: {kind: none}
  polynomial: {kind: polynomial, delay: 12 ms}
  inverse: {kind: inverse, delay: 12 ms}
  modified_ats: {kind: modified_ats}
  smith: {kind: smith, delay: 12 ms, stiffness: 8 kN/mm, damping: 0 N*s/m}
  pi_phase_lead: {kind: pi_phase_lead, proportional: 0.6, integral: 60 /s, lead: 20 ms, lag: 1 ms}
"""
COMMAND = "kind: command, command: {type: sine, displacement: 5 mm, frequency: [1 Hz], cycles: 2}"
LAGGING = "kind: second_order, frequency: 25 Hz, damping: 0.6"


def oscillator(ratio: float = 1.0) -> tuple[float, float, float]:
    """Mass, damping and stiffness of the numerical part when its frequency is multiplied by a ratio."""
    return MASS / ratio**2, 2.0 * DAMPING * math.sqrt(MASS * SPRING) / ratio, SPRING


def laboratory(
    folder: Path, rig: str, delay: float, compensators: str = COMPENSATORS, ratio: float = 1.0, free: float = 2.0
) -> VirtualLaboratory:
    """One storey with a spring in the rig, under a pulse of 0.1 s."""
    mass, _, stiffness = oscillator(ratio)
    time = np.arange(11) * 0.01
    pulse = np.column_stack([time, np.sin(np.pi * time / 0.1)])
    np.savetxt(folder / "pulse.csv", pulse, "%.9f", ",", header="time,acc", comments="")
    text = (
        "edesign_rts: 1\n"
        f"structure: {{masses: [{mass!r} kg], stiffnesses: [{stiffness!r} N/m], "
        f"damping: {{kind: modal, ratio: {DAMPING}}}}}\n"
        f"specimen: {{law: {{type: kelvin_voigt, parameters: {{k: {SPECIMEN!r} N/m, c: 0 N*s/m}}}}}}\n"
        f"rig: {{{rig}, delay: {delay!r} s}}\nloop: {{main_step: 0.5 ms}}\ncompensators:\n{compensators}"
        f"tests:\n  - {{name: pulse, kind: rts, record: pulse, free_vibration: {free!r} s}}\n"
        "records:\n  pulse: {file: pulse.csv, acceleration_unit: m/s^2, columns: {time: time, acceleration: acc}}\n"
    )
    return VirtualLaboratory(parse_rts_file(text, folder / "rts.yaml"))


def motion_of(one: VirtualLaboratory) -> np.ndarray:
    return one.direct(one.drives["pulse"]).deformation


def map_of(one: VirtualLaboratory) -> StabilityMap:
    found = governing_map(one, {"pulse": motion_of(one)})
    assert found is not None and found[0] == "pulse"
    return found[1]


def regions(found: StabilityMap) -> dict[str, tuple[tuple[tuple[float, float], ...], ...]]:
    return {region.compensator: region.delays for region in found.regions}


def loop_of(p: float, zeta: float, delay: float = 0.0) -> Loop:
    """1 kg at 1 Hz, a share of its stiffness behind a pure delay."""
    one = np.ones((1, 1))
    specimen = linear_specimen(p * TURN**2)
    whole = WholeStructure(one, 2.0 * zeta * TURN * one, (1.0 - p) * TURN**2 * one, np.ones(1), specimen)
    return Loop(whole, rig=pure_delay(delay))


def closed_intervals(p: float, zeta: float, longest: float) -> list[tuple[float, float]]:
    """Stable delays of 1 kg: modulus and phase of k_N - w^2 + i c w = -k_E e^(-i w tau).

    The larger frequency makes it unstable once a turn, the smaller makes it stable (Walton & Marshall 1987).
    """
    k, k_N, c = p * TURN**2, (1.0 - p) * TURN**2, 2.0 * zeta * TURN
    squares = np.roots([1.0, c**2 - 2.0 * k_N, k_N**2 - k**2]).real
    delays = {}
    for square in squares[squares > 0.0]:
        w = math.sqrt(square)
        first = (math.atan2(c * w, square - k_N)) % TURN / w
        delays[w] = [first + n * TURN / w for n in range(200) if first + n * TURN / w <= longest]
    larger, smaller = max(delays), min(delays)
    returns = delays[smaller] if smaller < larger else []
    begins = [0.0, *returns]
    return [(begin, end) for begin, end in zip(begins, delays[larger], strict=False) if end > begin]


@pytest.mark.parametrize(("p", "zeta"), [(1.0, 0.05), (0.5, 0.02), (0.25, 0.05), (0.1, 0.02)])
def test_all_stable_delays_of_the_oscillator(p: float, zeta: float) -> None:
    """The first one ends at the critical delay; later pockets too, as the closed form has them."""
    loop = loop_of(p, zeta)
    longest = 1.7  # s, before the pockets overlap
    found = [one for one in stable_delays(loop, 0.0, longest) if one[1] < longest]
    wanted = closed_intervals(p, zeta, longest)
    assert found == pytest.approx(np.array(wanted[: len(found)]), rel=1e-9)
    assert found[0][1] == pytest.approx(critical_delay(1.0, 2.0 * zeta * TURN, (1.0 - p) * TURN**2, p * TURN**2).delay)


@pytest.mark.parametrize("delay", [0.1, 0.6, 1.2])
def test_stable_delays_do_not_depend_on_the_delay_that_they_are_counted_from(delay: float) -> None:
    wanted = np.array(stable_delays(loop_of(0.25, 0.05), 0.0, 1.7))
    found = np.array(stable_delays(loop_of(0.25, 0.05, delay), -delay, 1.7 - delay)) + delay
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(("inertia", "stable"), [(0.9, True), (1.1, False)])
def test_an_acceleration_that_outweighs_the_mass_leaves_no_stable_delay(inertia: float, stable: bool) -> None:
    """m x''(t) + k_E a_2 x''(t - tau) is of neutral type, and unstable with every delay if k_E a_2 > m (Hale 1977)."""
    loop = loop_of(0.5, 0.05)
    a2 = inertia / (0.5 * TURN**2)
    leading = replace(loop, rig=lambda s: 1.0 + 0.3 * s + a2 * s**2)
    found = stable_delays(leading, 0.0, 0.2, 200.0)
    assert bool(found) == stable


def test_the_map_without_compensation_is_the_closed_form(tmp_path: Path) -> None:
    """A pure delay and a spring: each frequency has its critical delay.

    The force over a step of 0.5 ms is extrapolated: its amplitude is (w T)^2 5/12 too large, 4e-4 at 10 Hz, beside a
    damping of 0.1 in the modulus that decides.
    """
    found = map_of(laboratory(tmp_path, "kind: delay", 0.012, "  none: {kind: none}\n"))
    assert found.least == 0.0 and found.delay == pytest.approx(0.012) and found.left_out == ()
    whole = math.sqrt((SPRING + SPECIMEN) / MASS) / TURN
    assert found.frequency == pytest.approx(whole, rel=1e-3)  # of the damped root
    ratios = np.geomspace(1.0 / RANGE, RANGE, found.frequencies.size)
    assert found.frequencies == pytest.approx(whole * ratios, rel=1e-3)
    for ratio, delays in zip(ratios.tolist(), regions(found)["none"], strict=True):
        (end,) = (end for begin, end in delays if begin <= 0.0 <= end)
        critical = critical_delay(*oscillator(ratio), SPECIMEN).delay
        assert end == pytest.approx(min(critical, 2.0 * found.largest), rel=0.005)


@pytest.mark.parametrize("rig", ["kind: delay", LAGGING])
def test_a_delay_in_the_rig_is_what_moves_the_roots(tmp_path: Path, rig: str) -> None:
    """Opened at the rig, the loop has the same verdict as the whole loop of a rig with that delay."""
    one = laboratory(tmp_path, rig, 0.006)
    motion = motion_of(one)
    part = one.laboratory.structure.part  # type: ignore[union-attr]
    model = LinearModel.of(one, motion, part)
    seen = 0
    for name, described in one.file.compensators.items():
        compensator = model.compensator(name, motion)
        stable = stable_delays(model.rig_delay_loop(name, compensator), -0.006, 0.15, 1000.0)
        for further in (-0.004, 0.012, 0.028, 0.047, 0.09):
            other = LinearModel.of(laboratory(tmp_path, rig, 0.006 + further), motion, part)
            same = compensator if described.kind == "modified_ats" else other.compensator(name, motion)
            inside = any(begin < further < end for begin, end in stable)
            if same.settles:
                assert (sweep(Loop(other.whole, other.seen(same)), 1000.0).unstable_roots == 0) == inside, name
                seen += 1
            elif further > 0.0:  # the count of the whole loop takes a compensator for granted that comes to rest
                assert not inside, name
    assert seen >= 20


@pytest.fixture(scope="module")
def lagging(tmp_path_factory: pytest.TempPathFactory) -> tuple[VirtualLaboratory, StabilityMap]:
    one = laboratory(tmp_path_factory.mktemp("map"), LAGGING, 0.004)
    return one, map_of(one)


def grows(one: VirtualLaboratory) -> bool:
    """Whether the free vibration after the pulse diverged, or is larger at the end than before."""
    (results,) = one.run()
    run = results.runs[0]
    if run.outcome != "done" or run.record is None:
        return True
    x, n = run.record.deformation, len(run.time)
    return bool(np.max(np.abs(x[int(0.85 * n) :])) > np.max(np.abs(x[int(0.55 * n) : int(0.7 * n)])))


@pytest.mark.parametrize("name", [line.strip().partition(":")[0] for line in COMPENSATORS.splitlines()])
@pytest.mark.parametrize("column", [8, 11])
def test_runs_on_both_sides_of_a_line_of_the_map(
    lagging: tuple[VirtualLaboratory, StabilityMap], tmp_path: Path, name: str, column: int
) -> None:
    """8 % of the delay to either side are some 0.5 % of damping: 60 periods multiply a motion by six, or divide it.

    An adaptive compensator runs with the coefficients that the map has frozen.
    """
    one, found = lagging
    line = next(line for line in COMPENSATORS.splitlines() if line.strip().startswith(f"{name}:"))
    if name == "modified_ats":
        motion = motion_of(one)
        model = LinearModel.of(one, motion, one.laboratory.structure.part)  # type: ignore[union-attr]
        a0, a1, a2 = model.compensator(name, motion).alpha.tolist()  # type: ignore[union-attr]
        line = f"  frozen: {{kind: fixed_alpha, alpha: [{a0!r}, {a1!r} s, {a2!r} s^2]}}"
    (end,) = (end for begin, end in regions(found)[name][column] if begin <= found.least <= end)
    assert found.least < end < 1.5 * found.largest
    ratio = float(np.geomspace(1.0 / RANGE, RANGE, found.frequencies.size)[column])
    free = 60.0 / found.frequencies[column]
    for share, unstable in ((0.92, False), (1.08, True)):
        delay = float(share * end - found.least)
        assert grows(laboratory(tmp_path, LAGGING, delay, f"{line}\n", ratio, float(free))) == unstable, share


def test_a_map_without_a_line_says_why(tmp_path: Path) -> None:
    """All critical delays are beyond a map of 0.1 ms."""
    one = laboratory(tmp_path, "kind: delay", 0.001, "  none: {kind: none}\n")
    found = replace(map_of(one), least=0.0, largest=1e-4)
    assert found.without_line(True) == ("none",) and found.without_line(False) == ()
    never = replace(found, regions=tuple(replace(region, delays=((),) * 17) for region in found.regions))
    assert never.without_line(False) == ("none",) and never.without_line(True) == ()
    drawn = map_figure("pulse", found, {"none": "none"}, None)
    assert any("No line: stable all over the map with none" in text.get_text() for text in drawn.axes[0].texts)
    assert map_of(one).without_line(True) == ()


def test_check_draws_the_map(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one = laboratory(tmp_path, LAGGING, 0.004)
    file, drawn = tmp_path / "rts.yaml", tmp_path / "map.svg"
    file.write_text(one.file.text, encoding="utf-8")
    assert main(["rts", "check", str(file), "--figure", str(drawn)]) == 0
    text = drawn.read_text(encoding="utf-8")
    assert all(f">{name}<" in text for name in ("without compensation", "smith", "pi_phase_lead", "pulse"))
    capsys.readouterr()
    assert main(["rts", "check", str(file), "--figure", str(tmp_path / "map.gif")]) == 2
    assert says(capsys.readouterr().err, "map.gif: .png, E-FILE-08")
    command = one.file.text.replace("kind: rts, record: pulse, free_vibration: 2.0 s", COMMAND)
    file.write_text(command, encoding="utf-8")
    assert main(["rts", "check", str(file), "--figure", str(tmp_path / "none.svg")]) == 2
    assert says(capsys.readouterr().err, "--figure: E-CLI-08") and not (tmp_path / "none.svg").exists()
