"""Runs that reached their end though their loop is unstable: it grows slowly, or only about one amplitude."""

from __future__ import annotations

import math
from collections.abc import Iterator

from edesign.errors import InputError
from edesign.substructure.advice.expectation import Bench, ExpectedTest
from edesign.substructure.virtual_tests import DIVERGED, TestResults, VirtualLaboratory


def growing_runs(laboratory: VirtualLaboratory, results: TestResults) -> Iterator[str]:
    """Yield a warning for each run that is done and too wrong, where the linearised loop says why: its motions grow.

    A run ends as unstable when it has grown by a factor; a record can end before. A law that softens ends in a limit
    cycle instead, and one that is linearised at one amplitude may not grow at another.

    Args:
        laboratory: of the file.
        results: of a test.
    """
    limit, direct, structure = laboratory.file.criteria.response_error, results.direct, laboratory.laboratory.structure
    wrong = [run for run in results.runs if run.outcome == "done" and run.response_error > limit]
    if not wrong or direct is None or structure is None:
        return
    try:
        bench = Bench.of(laboratory, direct.deformation, structure.part)
        response = bench.under(results.drive)
        for run in wrong:
            compensator = bench.compensator(run.compensator, direct.deformation)
            found = bench.expected(run.compensator, response, direct.deformation, compensator)
            if not found.stable:
                yield (
                    f'test {run.test}: the run with "{run.compensator}" reached its end, but its linearised loop is '
                    f"unstable: {growth_in_words(bench.linearisation.amplitude, found)}"
                )
    except InputError:  # the structure itself does not come to rest, or a part is not finite: nothing can be said
        return


def growth_in_words(amplitude: float, found: ExpectedTest) -> str:
    """Return how fast motions of an unstable test grow.

    Args:
        amplitude: at which the law is linearised, m.
        found: the test.
    """
    growth = found.stability.growth if found.stability is not None else 0.0
    if growth <= 0.0:
        return found.as_what
    return (
        f"motions of {1e3 * amplitude:.3g} mm grow by {growth:.3g} per second, {DIVERGED:g} times in "
        f"{math.log(DIVERGED) / growth:.3g} s"
    )
