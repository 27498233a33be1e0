"""What is said of substructure tests before they are run, as tables."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from edesign.report.tables.cell import Value
from edesign.report.tables.column import bounded, col, count, known, text
from edesign.report.tables.number import finite, significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import HZ, KN, KN_MM, M_S, MM, MS, ONE, PERCENT
from edesign.substructure.advice.advice import Advice, TestAdvice
from edesign.substructure.advice.expectation import (
    EFFECTIVE_AMPLITUDE,
    MOVES_SPECIMEN,
    ExpectedTest,
    Linearisation,
    ModeAdvice,
)
from edesign.substructure.advice.needs import Need
from edesign.substructure.advice.transfers import EXACTLY
from edesign.substructure.advice.unstable_runs import AGREES, growth_in_words
from edesign.substructure.stability.margins import LoopMode

MODES_SHOWN = 6
CYCLE, DISCRETE = "LIMIT CYCLE", "DISCRETE ONLY"
"""Verdicts between stable and unstable."""
ALMOST_NONE = 5e-6
"""Ratio that two digits of a percent do not show."""
MOST_LOSS = 10.0
"""Loss factor above which a specimen is named a dashpot."""
ROUNDING = 1e-6
"""Of the complex stiffness: a storage stiffness below it is none."""


class _Mode(NamedTuple):
    mode: ModeAdvice
    goes_first: bool


class _LoopMode(NamedTuple):
    compensator: str
    mode: LoopMode


class _Expected(NamedTuple):
    test: str
    one: ExpectedTest


def _verdict(one: ExpectedTest) -> str:
    if not one.stable:
        return "UNSTABLE"
    if one.stability is not None and not one.stability.stable:
        return DISCRETE
    return CYCLE if one.grows_below > 0.0 else "stable"


def _margin(name: str) -> Callable[[ExpectedTest], float | None]:
    """A margin of the loop, where it belongs to the verdict."""
    return lambda one: (
        bounded(f"stability.{name}")(one) if one.stability and one.stable == one.stability.stable else None
    )


def _delay_left(one: ExpectedTest) -> float | None:
    return None if one.stability is None or math.isnan(one.delay_left) else one.delay_left


def _delay_factor(one: ExpectedTest) -> float | None:
    return finite(one.delay_factor) if one.stability is not None and one.stable else None


def _modelled_as(one: ExpectedTest) -> str:
    return f"{one.modelled_as}; at its limits" if one.limited else one.modelled_as


def _response_rms(row: _Expected) -> Value:
    return known("response_rms")(row.one) if row.one.stable else "grows"


def _response_peak(row: _Expected) -> float | None:
    return known("response_peak")(row.one) if row.one.stable else None


def _share_of_limit(use: str) -> Callable[[Need], str]:
    """How much of a limit of the rig is used, where it has one."""
    return lambda need: f" ({100.0 * share:.0f} %)" if (share := getattr(need, use)) > 0.0 else ""


MODES = TableSpec[_Mode](
    "modes_of_test",
    "Modes of the structure, test {test}",
    (
        count("mode", "mode.number", mark=lambda row: "*" if row.goes_first else ""),
        col("bare", HZ, "mode.without_specimen"),
        col("f", HZ, "mode.frequency"),
        col("damping", PERCENT, known("mode.damping"), 3, negligible=ALMOST_NONE, silent=True, mark=lambda row: " %"),
        col("k_E/k", PERCENT, known("mode.share"), 3, negligible=ALMOST_NONE, silent=True, mark=lambda row: " %"),
        col("rig", MS, "mode.rig_delay", 3),
        col("|rig|", ONE, "mode.rig_amplitude", 3),
        col("critical", MS, bounded("mode.critical_delay"), 3),
        col("factor", ONE, bounded("mode.delay_factor"), 3),
    ),
    named_by_title=True,
)
STABILITY = TableSpec[ExpectedTest](
    "stability_of_test",
    "Stability with rig and compensator, test {test}",
    (
        text("compensator"),
        text("verdict", _verdict),
        col("gain", ONE, _margin("gain_margin"), 3),
        col("residual", MS, _delay_left, 3, negligible=ALMOST_NONE),
        col("margin", MS, _margin("delay_margin"), 3),
        col("factor", ONE, _delay_factor, 3),
        text("modelled as", _modelled_as, broken=1),
    ),
    keys=2,
    named_by_title=True,
)
DAMPING = TableSpec[_LoopMode](
    "damping_in_loop",
    "Damping of the modes in the loop, test {test}",
    (
        text("compensator"),
        count("mode", "mode.number"),
        col("structure", PERCENT, known("mode.damping"), 3, negligible=ALMOST_NONE),
        col("in the loop", PERCENT, known("mode.loop_damping"), 3, negligible=ALMOST_NONE),
        col("error", PERCENT, known("mode.damping_error"), 3, negligible=ALMOST_NONE),
        col("-p omega tau/2", PERCENT, known("mode.simple_damping_error"), 3, negligible=ALMOST_NONE),
    ),
    notes=wrapped(
        "structure: damping ratio without the delays of the loop; p: k_E/k; tau: delay of rig, compensator and force "
        "at the mode"
    ),
    named_by_title=True,
)
EXPECTED = TableSpec[_Expected](
    "expected_errors",
    "Expected errors",
    (
        text("test"),
        text("compensator", "one.compensator", mark=lambda row: "*" if row.one.grows_below > 0.0 else ""),
        col("tracking rms", PERCENT, known("one.tracking_rms"), 3, negligible=ALMOST_NONE),
        col("peak", PERCENT, known("one.tracking_peak"), 3, negligible=ALMOST_NONE),
        col("response rms", PERCENT, _response_rms, 3, negligible=ALMOST_NONE),
        col("peak", PERCENT, _response_peak, 3, negligible=ALMOST_NONE),
    ),
    keys=2,
)
NEEDS = TableSpec[Need](
    "rig_demand",
    "What the rig must do",
    (
        text("test"),
        col("specimen", MM, "deformation"),
        col("stroke", MM, mark=_share_of_limit("stroke_use")),
        col("velocity", M_S, digits=3, mark=_share_of_limit("velocity_use")),
        col("force", KN, mark=_share_of_limit("force_use")),
    ),
    notes=wrapped("of the direct analysis or the given target; in brackets: share of the limit of the rig"),
)
ADVICE = TableSpec[None]("advice", "Advice", ())


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
    notes = wrapped(f"the first {MODES_SHOWN} of {len(test.modes)} modes") if len(test.modes) > MODES_SHOWN else []
    notes += wrapped(
        "bare: without the specimen; k_E/k: share of a mode's stiffness that is the specimen's; rig, |rig|: its delay "
        "and amplitude at f; critical: delay of the force at which the mode becomes unstable; factor: delay factor, "
        "that over the delay of rig and force"
    )
    notes += [*wrapped(_first(test)), *wrapped(_linearised(test))]
    if advice.force_delay > 0.0:
        late = _milliseconds(advice.force_delay, 3)
        notes += wrapped(f"the force is {late} ms later still: its sensor, and half a step if it is held over it")
    shown = (_Mode(mode, mode.number == test.first) for mode in test.modes[:MODES_SHOWN])
    return MODES.of(shown, notes=notes, test=test.name)


def _first(test: TestAdvice) -> str:
    if test.first == 0:
        return "no delay of the force makes a mode unstable"
    return f"*: mode {test.first} becomes unstable first, at {_milliseconds(test.critical_delay)} ms"


def _linearised(test: TestAdvice) -> str:
    """How the law was linearised, in words."""
    at = test.linearisation
    amplitude, frequency = significant(at.amplitude / MM.si, 3), significant(at.frequency)
    return (
        f"law linearised at {amplitude} mm, {EFFECTIVE_AMPLITUDE:g} of the largest direct deformation (effective "
        f"amplitude: Schnabel, Lysmer & Seed 1972); at {frequency} Hz, the first mode that moves the specimen: "
        f"{specimen_in_words(at)}"
    )


def specimen_in_words(at: Linearisation) -> str:
    """Return stiffness and loss factor of a specimen, or its dashpot where a loss factor says little."""
    if abs(at.stiffness.imag) <= MOST_LOSS * abs(at.stiffness.real):
        return f"{significant(at.stiffness.real / KN_MM.si)} kN/mm, loss factor {significant(at.loss_factor, 3)}"
    none = abs(at.stiffness.real) < ROUNDING * abs(at.stiffness)
    storage = "0" if none else significant(at.stiffness.real / KN_MM.si)
    dashpot = at.stiffness.imag / (2.0 * math.pi * at.frequency)
    return f"storage stiffness {storage} kN/mm, equivalent dashpot {significant(dashpot / KN_MM.si)} kN s/mm"


def stability_table(advice: Advice, test: TestAdvice) -> Table:
    """Return verdict and margins of each compensator.

    Args:
        advice: the result of the check of a file of tests.
        test: the check of one test.
    """
    notes = wrapped(
        "gain: gain margin, the factor on the force that makes the loop unstable; residual: delay that the compensator "
        "leaves, at the mode that becomes unstable first; margin: further delay of the rig until it does; factor: "
        "delay factor, (residual + margin) / residual, of which the residual is a main step at least; required: "
        f"{significant(advice.delay_margin, 3)}; modelled as: the compensator in the linear loop, {EXACTLY} or, if "
        "it adapts, with the coefficients alpha_0, alpha_1, alpha_2 or the delay to which it converges"
    )
    for one in test.expected:
        if one.stability is not None and not one.stable:
            at = test.linearisation.amplitude
            notes += wrapped(f'UNSTABLE with "{one.compensator}": {growth_in_words(at, one)}')
        elif one.stability is not None and not one.stability.stable:
            notes += wrapped(
                f'{DISCRETE} with "{one.compensator}": the loop sampled at main steps is stable, as it is run, but its '
                "continuous-time model is not, and margins and errors are those of that model"
            )
    if any(one.grows_below > 0.0 for one in test.expected):
        notes += wrapped(
            f"{CYCLE}: stable at the amplitude of the test, unstable at small amplitude: the specimen keeps vibrating "
            "at an amplitude in between; see the advice"
        )
    return STABILITY.of(test.expected, notes=notes, test=test.name)


def damping_table(test: TestAdvice) -> Table:
    """Return the damping that the loop leaves each mode that moves the specimen, beside the simple formula."""
    rows: list[_LoopMode] = []
    for one in test.expected:
        modes = one.stability.modes if one.stability is not None else ()
        rows += [_LoopMode(one.compensator, mode) for mode in modes if mode.share >= MOVES_SPECIMEN][:MODES_SHOWN]
    return DAMPING.of(rows, test=test.name)


def expected_table(advice: Advice) -> Table:
    """Return the expected errors of each test with each compensator."""
    rows = [_Expected(test.name, one) for test in advice.tests for one in test.expected]
    notes = wrapped(
        "tracking: measured less target; response: deformation whose force the structure gets, against the direct "
        f"analysis; accepted: {_percent(advice.response_error)} %; as if the rig had no limits"
    )
    shares = [f"{test.name} {_percent(test.nonlinear)} %" for test in advice.tests if not math.isnan(test.nonlinear)]
    if shares:
        notes += wrapped(
            f"share of the specimen's force that is not linear: {', '.join(shares)}. Rig and specimen are moved as the "
            "structure itself moves; what their force then changes is of the linearised loop, and of laws far from "
            f"linear right within a factor of some {AGREES:g}"
        )
    if any(row.one.grows_below > 0.0 for row in rows):
        notes += wrapped("*: need not hold, as small motions are unstable")
    return EXPECTED.of(rows, notes=notes)


def needs_table(advice: Advice) -> Table:
    """Return the displacement, velocity and force that tests need, with their percentage of the rig's limits."""
    too_much = [need.test for need in advice.needs if not need.possible]
    return NEEDS.of(advice.needs, notes=wrapped(f"TOO MUCH for the rig: {', '.join(too_much)}") if too_much else [])


def conclusion(advice: Advice) -> Table:
    """Return the abort level and the recommended compensator with its reason; no columns."""
    choice = f'recommended: "{advice.recommended}"' if advice.recommended else "no compensator is recommended"
    said = [choice, advice.recommendation.reason]
    if advice.abort is not None:
        said.append(f"abort at {significant(advice.abort.displacement / MM.si, 3)} mm: {advice.abort.reason}")
    return ADVICE.of([], notes=[line for text in (*said, *advice.warnings) for line in wrapped(text)])


def _percent(ratio: float) -> str:
    return "0" if ratio < ALMOST_NONE else significant(ratio / PERCENT.si, 3)


def _milliseconds(delay: float, digits: int = 4) -> str:
    return significant(delay / MS.si, digits)
