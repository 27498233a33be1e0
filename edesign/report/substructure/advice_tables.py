"""What is said of substructure tests before they are run, as tables."""

from __future__ import annotations

import math
import textwrap

from edesign.report.table import Table, number
from edesign.report.text import PAPER
from edesign.substructure.advice.advice import Advice, TestAdvice
from edesign.substructure.advice.expectation import EFFECTIVE_AMPLITUDE, MOVES_SPECIMEN, ExpectedTest, Linearisation
from edesign.substructure.advice.unstable_runs import growth_in_words

MODES_SHOWN = 6
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
    """Return natural modes, the specimen's share of them, and what the rig does at their frequencies."""
    table = Table(
        f"Modes of the structure, test {test.name}",
        ("mode", "bare [Hz]", "f [Hz]", "damping", "k_E/k", "rig [ms]", "|rig|", "limit [ms]", "factor"),
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
                _unless_infinite(mode.margin_factor),
            ]
        )
    if len(test.modes) > MODES_SHOWN:
        table.notes += lines(f"the first {MODES_SHOWN} of {len(test.modes)} modes")
    table.notes += lines(
        "bare: without the specimen; k_E/k: share of a mode's stiffness that is the specimen's; rig, |rig|: its delay "
        "and amplitude at f; limit: delay of the force at which the mode grows; factor: over the delay of the rig"
    )
    table.notes += [*lines(_first(test)), *lines(_linearised(test))]
    if advice.force_delay > 0.0:
        late = number(advice.force_delay, 3, 1e-3)
        table.notes += lines(f"the force is late by {late} ms more: its sensor, and half a step if it is held over it")
    return table


def lines(text: str) -> list[str]:
    """Return a text as lines of a page."""
    return textwrap.wrap(text, PAPER)


def _first(test: TestAdvice) -> str:
    if test.first == 0:
        return "no delay of the force makes a mode grow"
    return f"*: mode {test.first} goes first, at {number(test.critical_delay, 4, 1e-3)} ms"


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
    """Return verdict and margins of each compensator."""
    table = Table(
        f"Stability with rig and compensator, test {test.name}",
        ("compensator", "verdict", "gain", "left [ms]", "margin [ms]", "factor", "taken"),
        left=2,
        sentences=6,
    )
    for one in test.expected:
        table.rows.append([one.compensator, _verdict(one), *_margins(one), _taken(one)])
    table.notes += lines(
        "gain: factor on the force that makes it grow; left: delay at the mode that goes first; margin: further delay "
        "until it goes; factor: (left + margin) / left, left being a main step at least; asked for: "
        + number(advice.delay_margin, 3)
    )
    for one in test.expected:
        if one.stability is not None and not one.stable:
            at = test.linearisation.amplitude
            table.notes += lines(f'UNSTABLE with "{one.compensator}": {growth_in_words(at, one)}')
        elif one.stability is not None and not one.stability.stable:
            table.notes += lines(
                f'NO MARGIN with "{one.compensator}": stable in main steps, but the continuous loop grows, of which '
                "margins and errors are told"
            )
    if any(one.grows_below > 0.0 for one in test.expected):
        table.notes += lines("SMALL GROW: stable at the amplitude of the test, but not near rest; see the advice")
    return table


def _verdict(one: ExpectedTest) -> str:
    if not one.stable:
        return "UNSTABLE"
    if one.stability is not None and not one.stability.stable:
        return "NO MARGIN"
    return "SMALL GROW" if one.grows_below > 0.0 else "stable"


def _margins(one: ExpectedTest) -> list[str]:
    if one.stability is None:
        return ["-", "-", "-", "-"]
    return [
        _unless_infinite(one.stability.gain_margin) if one.stable == one.stability.stable else "-",
        "-" if math.isnan(one.delay_left) else number(one.delay_left, 3, 1e-3, negligible=ALMOST_NONE),
        _unless_infinite(one.stability.delay_margin, 1e-3) if one.stable == one.stability.stable else "-",
        _unless_infinite(one.margin_factor) if one.stable else "-",
    ]


def _taken(one: ExpectedTest) -> str:
    return f"{one.as_what}; held by its limits" if one.limited else one.as_what


def damping_table(test: TestAdvice) -> Table:
    """Return the damping that the loop leaves each mode that moves the specimen, beside the simple formula."""
    table = Table(
        f"Damping of the modes in the loop, test {test.name}",
        ("compensator", "mode", "itself [%]", "in the loop [%]", "error [%]", "-p omega tau/2 [%]"),
    )
    for one in test.expected:
        modes = one.stability.modes if one.stability is not None else ()
        for mode in [mode for mode in modes if mode.share >= MOVES_SPECIMEN][:MODES_SHOWN]:
            values = (mode.damping, mode.loop_damping, mode.damping_error, mode.simple_damping_error)
            table.rows.append([one.compensator, str(mode.number), *(_percent(value) for value in values)])
    table.notes += lines("p: k_E/k; tau: delay of rig, compensator and force at the mode (thesis Eq. 6.6)")
    return table


def expected_table(advice: Advice) -> Table:
    """Return the expected errors of each test with each compensator."""
    table = Table(
        "Expected errors",
        ("test", "compensator", "tracking rms [%]", "peak [%]", "response rms [%]", "peak [%]"),
        left=2,
    )
    for test in advice.tests:
        for one in test.expected:
            tracking = [_percent(one.tracking_rms), _percent(one.tracking_peak)]
            response = [_percent(one.response_rms), _percent(one.response_peak)]
            name = f"{one.compensator}*" if one.grows_below > 0.0 else one.compensator
            table.rows.append([test.name, name, *tracking, *(response if one.stable else ["grows", "-"])])
    table.notes += lines(
        "tracking: measured less target; response: deformation of the damper against the direct analysis; accepted: "
        f"{_percent(advice.response_error)} %; without noise, and as if the rig had no limits"
    )
    if any(one.grows_below > 0.0 for test in advice.tests for one in test.expected):
        table.notes += lines("*: need not hold, as small motions grow")
    return table


def needs_table(advice: Advice) -> Table:
    """Return what the tests need of the rig, in brackets as percentage of its limits."""
    table = Table("What the rig must do", ("test", "specimen [mm]", "stroke [mm]", "velocity [m/s]", "force [kN]"))
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
    table.notes += lines("of the direct analysis or the given target; in brackets: share of the limit of the rig")
    if too_much := [need.test for need in advice.needs if not need.possible]:
        table.notes += lines(f"TOO MUCH for the rig: {', '.join(too_much)}")
    return table


def conclusion(advice: Advice) -> Table:
    """Return the abort level and the recommended compensator with its reason; no columns."""
    choice = f'recommended: "{advice.recommended}"' if advice.recommended else "no compensator is recommended"
    said = [choice, advice.recommendation.reason]
    if advice.abort is not None:
        said.append(f"abort at {number(advice.abort.displacement, 3, 1e-3)} mm: {advice.abort.reason}")
    return Table("Advice", notes=[line for text in (*said, *advice.warnings) for line in lines(text)])


def _used(share: float) -> str:
    return f" ({100.0 * share:.0f} %)" if share > 0.0 else ""


def _percent(value: float) -> str:
    if math.isnan(value):
        return "-"
    return "inf" if math.isinf(value) else number(value, 3, 0.01, negligible=ALMOST_NONE)


def _unless_infinite(value: float, scale: float = 1.0) -> str:
    return "-" if math.isinf(value) or math.isnan(value) else number(value, 3, scale)
