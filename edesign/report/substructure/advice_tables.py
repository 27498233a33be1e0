"""What is said of substructure tests before they are run, as tables."""

from __future__ import annotations

import math

from edesign.report.tables.table import Table, number, whole
from edesign.report.tables.text import wrapped
from edesign.substructure.advice.advice import Advice, TestAdvice
from edesign.substructure.advice.expectation import EFFECTIVE_AMPLITUDE, MOVES_SPECIMEN, ExpectedTest, Linearisation
from edesign.substructure.advice.transfers import EXACTLY
from edesign.substructure.advice.unstable_runs import AGREES, growth_in_words

MODES_SHOWN = 6
CYCLE, DISCRETE = "LIMIT CYCLE", "DISCRETE ONLY"
"""Verdicts between stable and unstable."""
ALMOST_NONE = 5e-6
"""Ratio that two digits of a percent do not show."""
MOST_LOSS = 10.0
"""Loss factor above which a specimen is told as a dashpot."""
ROUNDING = 1e-6
"""Of the complex stiffness: a storage stiffness below it is none."""


def advice_tables(advice: Advice) -> list[Table]:
    """Return modes, stability, damping, expected errors, needs of the rig, and the recommendation.

    Tables of the loop stand for the test in which a delay goes wrong first; they are left out where there is no loop.
    """
    found = [expected_table(advice), needs_table(advice), conclusion(advice)] if advice.tests else [conclusion(advice)]
    test = advice.governing
    if test is not None:
        damping = damping_table(test)
        of_loop = [modes_table(advice, test), stability_table(advice, test), *([damping] if damping.rows else [])]
        found = [*of_loop, *found]
    return found


def modes_table(advice: Advice, test: TestAdvice) -> Table:
    """Return natural modes, the specimen's share of them, and the response of the rig at their frequencies.

    Args:
        advice: the result of the check of a file of tests.
        test: the check of one test.
    """
    table = Table(
        f"Modes of the structure, test {test.name}",
        ("mode", "bare [Hz]", "f [Hz]", "damping", "k_E/k", "rig [ms]", "|rig|", "critical [ms]", "factor"),
    )
    for mode in test.modes[:MODES_SHOWN]:
        table.rows.append(
            [
                f"{mode.number}{'*' if mode.number == test.first else ''}",
                number(mode.without_specimen),
                number(mode.frequency),
                f"{_percent(mode.damping)} %",
                f"{_percent(mode.share)} %",
                number(mode.rig_delay, 3, 1e-3),
                number(mode.rig_amplitude, 3),
                _unless_infinite(mode.critical_delay, 1e-3),
                _unless_infinite(mode.delay_factor),
            ]
        )
    if len(test.modes) > MODES_SHOWN:
        table.notes += wrapped(f"the first {MODES_SHOWN} of {len(test.modes)} modes")
    table.notes += wrapped(
        "bare: without the specimen; k_E/k: share of a mode's stiffness that is the specimen's; rig, |rig|: its delay "
        "and amplitude at f; critical: delay of the force at which the mode becomes unstable; factor: delay factor, "
        "that over the delay of rig and force"
    )
    table.notes += [*wrapped(_first(test)), *wrapped(_linearised(test))]
    if advice.force_delay > 0.0:
        late = number(advice.force_delay, 3, 1e-3)
        table.notes += wrapped(f"the force is {late} ms later still: its sensor, and half a step if it is held over it")
    return table


def _first(test: TestAdvice) -> str:
    if test.first == 0:
        return "no delay of the force makes a mode unstable"
    return f"*: mode {test.first} becomes unstable first, at {number(test.critical_delay, 4, 1e-3)} ms"


def _linearised(test: TestAdvice) -> str:
    """How the law was linearised, in words."""
    at = test.linearisation
    amplitude, frequency = number(at.amplitude, 3, 1e-3), number(at.frequency)
    return (
        f"law linearised at {amplitude} mm, {EFFECTIVE_AMPLITUDE:g} of the largest direct deformation (effective "
        f"amplitude: Schnabel, Lysmer & Seed 1972); at {frequency} Hz, the first mode that moves the specimen: "
        f"{specimen_in_words(at)}"
    )


def specimen_in_words(at: Linearisation) -> str:
    """Return stiffness and loss factor of a specimen, or its dashpot where a loss factor says little."""
    if abs(at.stiffness.imag) <= MOST_LOSS * abs(at.stiffness.real):
        return f"{number(at.stiffness.real, 4, 1e6)} kN/mm, loss factor {number(at.loss_factor, 3)}"
    storage = number(at.stiffness.real, 4, 1e6, negligible=ROUNDING * abs(at.stiffness))
    dashpot = at.stiffness.imag / (2.0 * math.pi * at.frequency)
    return f"storage stiffness {storage} kN/mm, equivalent dashpot {number(dashpot, 4, 1e6)} kN s/mm"


def stability_table(advice: Advice, test: TestAdvice) -> Table:
    """Return verdict and margins of each compensator.

    Args:
        advice: the result of the check of a file of tests.
        test: the check of one test.
    """
    table = Table(
        f"Stability with rig and compensator, test {test.name}",
        ("compensator", "verdict", "gain", "residual [ms]", "margin [ms]", "factor", "modelled as"),
        left=2,
        sentences=6,
    )
    for one in test.expected:
        table.rows.append([one.compensator, _verdict(one), *_margins(one), _modelled_as(one)])
    table.notes += wrapped(
        "gain: gain margin, the factor on the force that makes the loop unstable; residual: delay that the compensator "
        "leaves, at the mode that becomes unstable first; margin: further delay of the rig until it does; factor: "
        "delay factor, (residual + margin) / residual, of which the residual is a main step at least; required: "
        + f"{number(advice.delay_margin, 3)}; modelled as: the compensator in the linear loop, {EXACTLY} or, if it "
        "adapts, with the coefficients alpha_0, alpha_1, alpha_2 or the delay to which it converges"
    )
    for one in test.expected:
        if one.stability is not None and not one.stable:
            at = test.linearisation.amplitude
            table.notes += wrapped(f'UNSTABLE with "{one.compensator}": {growth_in_words(at, one)}')
        elif one.stability is not None and not one.stability.stable:
            table.notes += wrapped(
                f'{DISCRETE} with "{one.compensator}": the loop sampled at main steps is stable, as it is run, but its '
                "continuous-time model is not, and margins and errors are those of that model"
            )
    if any(one.grows_below > 0.0 for one in test.expected):
        table.notes += wrapped(
            f"{CYCLE}: stable at the amplitude of the test, unstable at small amplitude: the specimen keeps vibrating "
            "at an amplitude in between; see the advice"
        )
    return table


def _verdict(one: ExpectedTest) -> str:
    if not one.stable:
        return "UNSTABLE"
    if one.stability is not None and not one.stability.stable:
        return DISCRETE
    return CYCLE if one.grows_below > 0.0 else "stable"


def _margins(one: ExpectedTest) -> list[str]:
    if one.stability is None:
        return ["-", "-", "-", "-"]
    return [
        _unless_infinite(one.stability.gain_margin) if one.stable == one.stability.stable else "-",
        "-" if math.isnan(one.delay_left) else number(one.delay_left, 3, 1e-3, negligible=ALMOST_NONE),
        _unless_infinite(one.stability.delay_margin, 1e-3) if one.stable == one.stability.stable else "-",
        _unless_infinite(one.delay_factor) if one.stable else "-",
    ]


def _modelled_as(one: ExpectedTest) -> str:
    return f"{one.modelled_as}; held by its limits" if one.limited else one.modelled_as


def damping_table(test: TestAdvice) -> Table:
    """Return the damping that the loop leaves each mode that moves the specimen, beside the simple formula."""
    table = Table(
        f"Damping of the modes in the loop, test {test.name}",
        ("compensator", "mode", "structure [%]", "in the loop [%]", "error [%]", "-p omega tau/2 [%]"),
    )
    for one in test.expected:
        modes = one.stability.modes if one.stability is not None else ()
        for mode in [mode for mode in modes if mode.share >= MOVES_SPECIMEN][:MODES_SHOWN]:
            values = (mode.damping, mode.loop_damping, mode.damping_error, mode.simple_damping_error)
            table.rows.append([one.compensator, whole(mode.number), *(_percent(value) for value in values)])
    table.notes += wrapped(
        "structure: damping ratio without the delays of the loop; p: k_E/k; tau: delay of rig, compensator and force "
        "at the mode"
    )
    return table


def expected_table(advice: Advice) -> Table:
    """Return the expected errors of each test with each compensator."""
    table = Table(
        "Expected errors",
        ("test", "compensator", "tracking rms [%]", "peak [%]", "response rms [%]", "peak [%]"),
        left=2,
        name="expected_errors",
    )
    for test in advice.tests:
        for one in test.expected:
            tracking = [_percent(one.tracking_rms), _percent(one.tracking_peak)]
            response = [_percent(one.response_rms), _percent(one.response_peak)]
            name = f"{one.compensator}*" if one.grows_below > 0.0 else one.compensator
            table.rows.append([test.name, name, *tracking, *(response if one.stable else ["grows", "-"])])
    table.notes += wrapped(
        "tracking: measured less target; response: deformation whose force the structure gets, against the direct "
        f"analysis; accepted: {_percent(advice.response_error)} %; as if the rig had no limits"
    )
    shares = [f"{test.name} {_percent(test.nonlinear)} %" for test in advice.tests if not math.isnan(test.nonlinear)]
    if shares:
        table.notes += wrapped(
            f"share of the specimen's force that is not linear: {', '.join(shares)}. Rig and specimen are moved as the "
            "structure itself moves; what their force then changes is of the linearised loop, and of laws far from "
            f"linear right within a factor of some {AGREES:g}"
        )
    if any(one.grows_below > 0.0 for test in advice.tests for one in test.expected):
        table.notes += wrapped("*: need not hold, as small motions are unstable")
    return table


def needs_table(advice: Advice) -> Table:
    """Return the displacement, velocity and force that tests need, with their percentage of the rig's limits."""
    table = Table(
        "What the rig must do",
        ("test", "specimen [mm]", "stroke [mm]", "velocity [m/s]", "force [kN]"),
        name="rig_demand",
    )
    for need in advice.needs:
        table.rows.append(
            [
                need.test,
                number(need.deformation, 4, 1e-3),
                number(need.stroke, 4, 1e-3) + _used(need.stroke_use),
                number(need.velocity, 3) + _used(need.velocity_use),
                number(need.force, 4, 1e3) + _used(need.force_use),
            ]
        )
    table.notes += wrapped("of the direct analysis or the given target; in brackets: share of the limit of the rig")
    if too_much := [need.test for need in advice.needs if not need.possible]:
        table.notes += wrapped(f"TOO MUCH for the rig: {', '.join(too_much)}")
    return table


def conclusion(advice: Advice) -> Table:
    """Return the abort level and the recommended compensator with its reason; no columns."""
    choice = f'recommended: "{advice.recommended}"' if advice.recommended else "no compensator is recommended"
    said = [choice, advice.recommendation.reason]
    if advice.abort is not None:
        said.append(f"abort at {number(advice.abort.displacement, 3, 1e-3)} mm: {advice.abort.reason}")
    return Table("Advice", notes=[line for text in (*said, *advice.warnings) for line in wrapped(text)], name="advice")


def _used(share: float) -> str:
    return f" ({100.0 * share:.0f} %)" if share > 0.0 else ""


def _percent(value: float) -> str:
    if math.isnan(value):
        return "-"
    return "inf" if math.isinf(value) else number(value, 3, 0.01, negligible=ALMOST_NONE)


def _unless_infinite(value: float, scale: float = 1.0) -> str:
    return "-" if math.isinf(value) or math.isnan(value) else number(value, 3, scale)
