"""Runs that reached their end though their loop is unstable: at a limit of the rig, or growing slowly.

A run ends as unstable when it has grown by a factor. A loop that grows ends in a limit cycle where the rig is at its
limits, or where a law softens; a record can end before; and a law that is linearised at one amplitude may not grow at
another. Only the linearised loop separates such runs from those that an earthquake drove there.
"""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.errors import InputError
from edesign.substructure.advice.expectation import ExpectedTest, LinearModel
from edesign.substructure.advice.recommendation import ADAPTIVE
from edesign.substructure.met_limits import in_words
from edesign.substructure.virtual_test import DIVERGED, VirtualTest, without_result
from edesign.substructure.virtual_tests import TestResults, VirtualLaboratory

AGREES = 2.0
"""Errors of runs over those expected, at most. What is left out is that an error beside a large motion meets another
stiffness than the motion does. Of a force |v|^alpha sign v it is (1 + alpha)/2 of the equivalent one: half of it for
friction, so that an error at resonance is up to twice as large. Source: incremental-input describing function, Gelb &
Vander Velde (1968), Multiple-Input Describing Functions and Nonlinear System Design, chapter 6."""


def with_unstable_loops(laboratory: VirtualLaboratory, results: TestResults) -> TestResults:
    """Return the results with what the linearised loop says of runs that it may explain.

    A run that met a limit is `unstable` if its loop is: only the limit holds it. One that met none and is too wrong
    keeps its outcome, with a warning how fast its motions grow; or that its loop is stable, and much less was expected.

    Args:
        laboratory: that made them.
    """
    most = laboratory.file.criteria.response_error
    asked = [run for run in results.runs if _met_a_limit(run) or _is_too_wrong(run, most)]
    if not asked:
        return results
    structure, direct = laboratory.laboratory.structure, results.direct
    part = structure.part if structure is not None and direct is not None else None
    motion = results.drive.wanted if direct is None else direct.deformation
    try:
        model = LinearModel.of(laboratory, motion, part)
        found = {
            run.compensator: model.expected(
                run.compensator, results.drive, direct, model.compensator(run.compensator, motion)
            )
            for run in asked
        }
    except InputError:  # structure without damping, specimen at rest, a part that is not finite: nothing can be said
        return results
    amplitude = model.linearisation.amplitude
    kinds = {name: one.kind for name, one in laboratory.file.compensators.items()}
    runs = []
    for run in results.runs:
        if run.compensator in found:
            adapts = ", an adaptation that need not settle" if kinds[run.compensator] in ADAPTIVE else ""
            run = _with_warning(run, amplitude, found[run.compensator], adapts)
        runs.append(run)
    return replace(results, runs=tuple(runs))


def _met_a_limit(run: VirtualTest) -> bool:
    return bool(run.saturated) and run.outcome in ("done", "saturated")


def _is_too_wrong(run: VirtualTest, most: float) -> bool:
    return run.outcome == "done" and run.response_error > most


def _with_warning(run: VirtualTest, amplitude: float, expected: ExpectedTest, why_else: str) -> VirtualTest:
    if expected.stable:
        return _unexpected(run, expected.response_rms, why_else)
    if run.saturated:
        return without_result(run, "unstable", f"limited by {in_words(run.saturated)}")
    return _warned(run, f"reached its end, but its linearised loop is unstable: {growth_in_words(amplitude, expected)}")


def _unexpected(run: VirtualTest, expected: float, why_else: str) -> VirtualTest:
    if run.outcome != "done" or not run.response_error > AGREES * expected:
        return run
    met = f", {in_words(run.saturated)}" if run.saturated else ""
    return _warned(
        run,
        f"is {100.0 * run.response_error:.3g} % wrong, and {100.0 * expected:.3g} % was expected of its loop, which "
        f"is stable when linearised. What that leaves out: errors meet another stiffness than motions{why_else}{met}",
    )


def _warned(run: VirtualTest, what: str) -> VirtualTest:
    return replace(run, warnings=(*run.warnings, f'test {run.test}: the run with "{run.compensator}" {what}'))


def growth_in_words(amplitude: float, found: ExpectedTest) -> str:
    """Return how fast motions of an unstable test grow.

    Args:
        amplitude: at which the law is linearised, m.
    """
    growth, sampled = found.stability.growth if found.stability is not None else 0.0, found.sampled
    at = ""
    if sampled is not None and sampled.growth > 0.0:
        at = f" at {sampled.frequency:.4g} Hz" if growth <= 0.0 else ""
        growth = sampled.growth
    if growth <= 0.0:
        return "motions grow in main steps" if sampled is not None and not sampled.stable else found.modelled_as
    said = (
        f"motions of {1e3 * amplitude:.3g} mm grow by {growth:.3g} per second{at}, {DIVERGED:g} times in "
        f"{math.log(DIVERGED) / growth:.3g} s"
    )
    return f"{said}. Only main steps make them grow; shorter ones need not help" if at else said
