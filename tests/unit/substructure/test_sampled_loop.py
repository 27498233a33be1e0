"""The loop in main steps against closed forms, a state matrix assembled by hand, and the growth of runs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from linear_specimens import linear_specimen
from unit.substructure.delayed_oscillator import critical_delay

from edesign.cli.main import main
from edesign.core.substructure import SubstructureLoop
from edesign.project.substructure import parse_rts_file
from edesign.substructure.advice.expectation import ExpectedTest, LinearModel
from edesign.substructure.advice.sampled_rig import sampled_rig
from edesign.substructure.advice.stability_map import governing_map
from edesign.substructure.compensation.compensators import none
from edesign.substructure.stability.sampled import SampledLoop, SampledPlant, SampledStability
from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.recursion import METHODS, unchecked_recursion
from edesign.substructure.virtual_tests import VirtualLaboratory

STEP, SUB_STEPS = 1e-3, 5
MASS = 100e3
ALPHA = (1.0, 30e-3, 4.5e-4)
"""1, s, s2: the inverse series of a rig that is 30 ms late."""
NONE, IDEAL = "kind: none", "kind: ideal"
DASHPOT = 3e4
"""N s/m; with alpha_2 it makes frequencies near half the rate of the loop grow."""
SERIES = "kind: fixed_alpha, alpha: [1.0, 30 ms, 4.5e-4 s^2]"
LATE = "kind: delay, delay: 30 ms"
CASES: dict[str, dict[str, str]] = {
    "alpha_2": {"compensator": SERIES, "rig": LATE},
    "held, unseen, a late sensor": {
        "compensator": "kind: polynomial, delay: 10 ms, order: 2",
        "rig": "kind: second_order, frequency: 15 Hz, damping: 0.5, delay: 11.3 ms",
        "loop": ", force: held, unseen_delay: 1 step",
        "sensors": "force_delay: 1.7 ms",
    },
    "flexible and corrected": {
        "rig": "kind: first_order, time_constant: 20 ms, delay: 5 ms, "
        "flexibility: {stiffness: 30 kN/mm, corrected: true}",
    },
    "servo-hydraulic": {
        "rig": "kind: servo_hydraulic, proportional_gain: 30 /s, valve_time_constant: 5 ms, oil_stiffness: 40 kN/mm",
    },
    "smith": {"compensator": "kind: smith, delay: 20 ms, stiffness: 6 kN/mm, damping: 0 N*s/m", "rig": LATE},
    "controller": {
        "compensator": "kind: pi_phase_lead, proportional: 0.6, integral: 30 /s, lead: 10 ms, lag: 1 ms",
        "rig": "kind: second_order, frequency: 25 Hz, damping: 0.6, delay: 4 ms",
    },
}


def laboratory(
    folder: Path,
    springs: tuple[float, ...],
    specimen: tuple[float, float],
    compensator: str = NONE,
    *,
    rig: str = IDEAL,
    loop: str = "",
    sensors: str = "",
    method: str = "newmark_explicit",
    law: str = "kelvin_voigt, parameters: {{k: {k!r} N/m, c: {c!r} N*s/m}}",
    sub_steps: int = SUB_STEPS,
) -> VirtualLaboratory:
    """Storeys of 100 t with the specimen beside the lowest spring, under a pulse.

    Args:
        folder: of record and file.
        springs: of the storeys, N/m.
        specimen: spring (N/m) and dashpot (N s/m).
        compensator, rig, loop, sensors, method: keys of the file.
        law: of the specimen, with k and c in it.
        sub_steps: in a main step.
    """
    time = np.arange(11) * 0.01
    pulse = np.column_stack([time, np.sin(np.pi * time / 0.1)])
    np.savetxt(folder / "pulse.csv", pulse, "%.9f", ",", header="time,acc", comments="")
    k, c = specimen
    text = (
        f"edesign_rts: 1\nstructure: {{masses: [{', '.join([f'{MASS} kg'] * len(springs))}], "
        f"stiffnesses: [{', '.join(f'{one!r} N/m' for one in springs)}], damping: {{kind: modal, ratio: 0.02}}}}\n"
        f"specimen: {{law: {{type: {law.format(k=k, c=c)}}}}}\n"
        f"rig: {{{rig}}}\nsensors: {{{sensors}}}\nloop: {{main_step: 1 ms, sub_steps: {sub_steps}{loop}}}\n"
        f"integration: {{method: {method}}}\ncompensators: {{one: {{{compensator}}}}}\n"
        "tests:\n  - {name: pulse, kind: rts, record: pulse, free_vibration: 2 s}\n"
        "records:\n  pulse: {file: pulse.csv, acceleration_unit: m/s^2, columns: {time: time, acceleration: acc}}\n"
    )
    return VirtualLaboratory(parse_rts_file(text, folder / "rts.yaml"))


def expected(one: VirtualLaboratory) -> ExpectedTest:
    drive = one.drives["pulse"]
    direct = one.direct(drive)
    model = LinearModel.of(one, direct.deformation, one.laboratory.structure.part)  # type: ignore[union-attr]
    return model.expected("one", drive, direct, model.compensator("one", direct.deformation))


def sampled(one: VirtualLaboratory) -> SampledStability:
    found = expected(one)
    assert found.sampled is not None and found.stable == found.sampled.stable
    return found.sampled


def growth_of_a_run(one: VirtualLaboratory, seconds: float) -> float:
    """Rate, 1/s, between two stretches of the end of a run that nothing aborts."""
    lab, loop = one.laboratory, one.file.loop
    machine = SubstructureLoop(
        loop.main_step,
        loop.sub_steps,
        one.compensators["one"],
        lab.rig,
        one.damper.values,
        sensors=lab.sensors,
        numerical=one.in_loop(),
        rig_stiffness=lab.rig_stiffness,
        corrected=lab.corrected,
        unseen_delay=0 if one.file.compensators["one"].kind == "none" else loop.unseen_delay,
    )
    ground = np.zeros(max(round(seconds / STEP) + 1, 3000))
    pulse = one.drives["pulse"].ground
    ground[: pulse.size] = pulse  # type: ignore[union-attr]
    x = machine.run(ground).deformation
    n = x.size
    tenth = n // 10
    early, late = (float(np.max(np.abs(x[n - k * tenth : n - (k - 1) * tenth]))) for k in (2, 1))
    return math.log(late / early) / (STEP * tenth)


def two_storeys(frequency: float, share: float = 0.4) -> tuple[tuple[float, float], float]:
    """Springs of two equal storeys whose first mode has a frequency (Hz), less the specimen's share; and that."""
    k = (2.0 * math.pi * frequency / (2.0 * math.sin(math.pi / 10.0))) ** 2 * MASS
    return ((1.0 - share) * k, k), share * k


def two_storeys_by_hand(one: VirtualLaboratory, k: float, c: float, delay: float) -> np.ndarray:
    """Roots of the loop of two storeys: explicit Newmark, alpha_2 on the acceleration, a rig that is a pure delay.

    The state: x, v and a before the force F of this instant counts, F, the F before, and commands in sub-steps.
    Velocity and acceleration of the target come from the force extrapolated to the end of the step.
    """
    part = one.laboratory.structure.part  # type: ignore[union-attr]
    M, C, K, to = part.mass, part.damping, part.stiffness, part.interface
    late = round(delay / STEP * SUB_STEPS)
    places = late + 2
    effective = M + 0.5 * STEP * C

    def instant(x: np.ndarray, v: np.ndarray, a: np.ndarray, force: float) -> tuple[np.ndarray, np.ndarray]:
        """v and a at x, from those a step ago."""
        now = np.linalg.solve(effective, -(C @ (v + 0.5 * STEP * a) + K @ x + to * force))
        return v + 0.5 * STEP * (a + now), now

    def advance(state: np.ndarray) -> np.ndarray:
        x, v, a, (force, before), sent = np.split(state, [2, 4, 6, 8])
        v, a = instant(x, v, a, force)
        x = x + STEP * v + 0.5 * STEP**2 * a
        v_end, a_end = instant(x, v, a, 2.0 * force - before)
        command = ALPHA[0] * to @ x + ALPHA[1] * to @ v_end + ALPHA[2] * to @ a_end
        line = list(sent)  # the last one first
        for j in range(1, SUB_STEPS + 1):
            line.insert(0, sent[0] + (command - sent[0]) * j / SUB_STEPS)
        moved, moved_before = line[late], line[late + 1]
        met = k * moved + c * (moved - moved_before) / (STEP / SUB_STEPS)
        return np.concatenate([x, v, a, [met, force], line[:places]])

    return np.linalg.eigvals(np.column_stack([advance(unit) for unit in np.eye(8 + places)]))


def loop_of(
    one: VirtualLaboratory, part: LinearPart, specimen: tuple[float, float], method: str, force: str = "extrapolated"
) -> SampledStability:
    """Without compensator, whatever the step."""
    rig = sampled_rig(one.laboratory, linear_specimen(*specimen), STEP, SUB_STEPS)
    plant = SampledPlant(unchecked_recursion(part, STEP, method, force), rig, STEP, np.zeros(0, dtype=complex))
    return SampledLoop(plant, none()).stability()


def oscillator(stiffness: float, damping: float = 0.0) -> LinearPart:
    """100 t, N/m and N s/m of the numerical part."""
    one = np.ones((1, 1))
    return LinearPart(MASS * one, damping * one, stiffness * one, np.ones(1), np.ones(1), ("1",))


@pytest.fixture(scope="module")
def ideal(tmp_path_factory: pytest.TempPathFactory) -> VirtualLaboratory:
    return laboratory(tmp_path_factory.mktemp("ideal"), (20e6,), (8e6, 0.0))


@pytest.mark.parametrize("method", ["newmark_explicit", "central_difference"])
@pytest.mark.parametrize("omega_dt", [1.99, 2.01])
def test_the_limit_of_central_differences_counts_the_specimen(
    ideal: VirtualLaboratory, method: str, omega_dt: float
) -> None:
    """omega dt = 2 (Chopra, Dynamics of Structures, 5.3.2), half of the spring being in an ideal rig.

    Beyond, z + 1/z = 2 - (omega dt)^2.
    """
    k = MASS * (omega_dt / STEP) ** 2
    found = loop_of(ideal, oscillator(0.5 * k), (0.5 * k, 0.0), method)
    assert found.stable == (omega_dt < 2.0)
    if not found.stable:
        assert found.growth == pytest.approx(2.0 * math.acosh(omega_dt / 2.0) / STEP, rel=1e-6)
        assert found.frequency == pytest.approx(0.5 / STEP)


@pytest.mark.parametrize("late", [0, 1, 7])
def test_a_held_force_makes_a_mass_on_the_specimen_grow(tmp_path: Path, late: int) -> None:
    """m x'' = -F, F = k x some steps ago, held: z^d (z - 1)^2 + (omega dt)^2/2 (z + 1) = 0.

    Without delay |z|^2 = 1 + (omega dt)^2/2. Nothing but the specimen holds the mass, so the numerical part alone has a
    double root at z = 1.
    """
    one = laboratory(tmp_path, (20e6,), (8e6, 0.0), rig=f"kind: delay, delay: {late * STEP} s" if late else IDEAL)
    omega = 2.0 * math.pi * 3.0
    found = loop_of(one, oscillator(0.0), (MASS * omega**2, 0.0), "exact", "held")
    half = 0.5 * (omega * STEP) ** 2
    polynomial = np.polyadd(np.polymul([1.0, -2.0, 1.0], [1.0] + [0.0] * late), [half, half])
    z = max(np.roots(polynomial), key=abs)
    assert found.unstable_roots == 2
    assert found.growth == pytest.approx(math.log(abs(z)) / STEP, rel=1e-6)
    assert found.frequency == pytest.approx(abs(np.angle(z)) / STEP / (2.0 * math.pi), rel=1e-6)
    if not late:
        assert found.growth == pytest.approx(0.5 * math.log1p(half) / STEP, rel=1e-6)


@pytest.mark.parametrize(("delay", "ok"), [(0.95, True), (1.05, False)])
def test_the_delay_that_takes_the_damping(tmp_path: Path, delay: float, ok: bool) -> None:
    """Short steps come to the closed form of a continuous loop (Wallace, Sieber et al. 2005)."""
    k, omega = 8e6, math.sqrt(28e6 / MASS)
    damping = 2.0 * 0.01 * MASS * omega
    critical = critical_delay(MASS, damping, 20e6, k).delay
    one = laboratory(tmp_path, (20e6,), (k, 0.0), rig=f"kind: delay, delay: {delay * critical!r} s")
    assert loop_of(one, oscillator(20e6, damping), (k, 0.0), "exact").stable == ok


@pytest.mark.parametrize("frequency", [1.3, 1.9, 2.2, 3.0])
def test_the_roots_of_a_state_matrix_by_hand(tmp_path: Path, frequency: float) -> None:
    """Two storeys, a dashpot, alpha_2, a rig that is 30 ms late: count, growth and frequency.

    The continuous loop, which ends at half the rate, has no unstable root at any of these frequencies.
    """
    springs, k = two_storeys(frequency)
    one = laboratory(tmp_path, springs, (k, DASHPOT), SERIES, rig="kind: delay, delay: 30 ms")
    test, wanted = expected(one), two_storeys_by_hand(one, k, DASHPOT, 0.03)
    found = test.sampled
    assert found is not None and test.stability is not None and test.stability.stable
    assert found.unstable_roots == np.sum(np.abs(wanted) > 1.0 + 1e-9)
    assert test.stable == found.stable == (frequency < 1.5)
    if not found.stable:
        z = max(wanted, key=abs)
        assert found.growth == pytest.approx(math.log(abs(z)) / STEP, rel=1e-5)
        assert found.frequency == pytest.approx(abs(np.angle(z)) / STEP / (2.0 * math.pi), rel=1e-5)


@pytest.mark.parametrize(
    ("case", "method"), [*(("alpha_2", one) for one in METHODS), *((one, "exact") for one in list(CASES)[1:])]
)
def test_growth_of_runs(tmp_path: Path, case: str, method: str) -> None:
    """Every integrator and kind of rig. A run that has grown by e^300 ends with its fastest root alone.

    Its peaks lie up to a step from those of its envelope, which is 0.2 % of the growth here.
    """
    springs, k = two_storeys(2.2)
    one = laboratory(tmp_path, springs, (k, DASHPOT), method=method, **CASES[case])  # type: ignore[arg-type]
    found = sampled(one)
    grown = growth_of_a_run(one, 20.0 if found.stable else 300.0 / found.growth)
    assert grown == pytest.approx(found.growth, rel=0.003) if not found.stable else grown < 0.0


@pytest.mark.parametrize("sub_steps", [1, 2, 20, 60])
def test_sub_steps_are_those_of_runs(tmp_path: Path, sub_steps: int) -> None:
    """The specimen lags by half a sub-step behind a ramp; beyond 20 sub-steps what is left is 1e-3 of a main step."""
    springs, k = two_storeys(2.2)
    one = laboratory(tmp_path, springs, (k, DASHPOT), SERIES, rig=LATE, sub_steps=sub_steps)
    found = sampled(one)
    assert growth_of_a_run(one, 300.0 / found.growth) == pytest.approx(found.growth, rel=0.003)


def test_a_specimen_that_is_no_dashpot(tmp_path: Path) -> None:
    """A Maxwell element of half a main step: in a sub-step its force depends on the path between two positions.

    Of its frequencies those beyond 1.5 times the rate of sub-steps are left out: 1/25 of what a ramp passes on.
    """
    springs, _ = two_storeys(2.2)
    law = "maxwell, parameters: {{c0: {c!r} N*s/m, lambda: {k!r} s}}"
    one = laboratory(tmp_path, springs, (0.5e-3, 2.0 * DASHPOT), SERIES, rig=LATE, law=law)
    found = sampled(one)
    assert growth_of_a_run(one, 300.0 / found.growth) == pytest.approx(found.growth, rel=0.02)


def test_check_reports_what_only_main_steps_make_grow(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    springs, k = two_storeys(2.2)
    one = laboratory(tmp_path, springs, (k, DASHPOT), SERIES, rig=LATE)
    (tmp_path / "rts.yaml").write_text(one.file.text, encoding="utf-8")
    assert main(["rts", "check", str(tmp_path / "rts.yaml")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    growth = sampled(one).growth
    assert "one UNSTABLE" in said and f"grow by {growth:.3g} per second at 500 Hz" in said
    assert "Only main steps make them grow" in said and "Every compensator of the file leaves the test unstable" in said
    found = governing_map(one, {"pulse": one.direct(one.drives["pulse"]).deformation})
    assert found is not None and not found[1].is_stable("one")
