"""Whether a run that met a limit of the rig is an unstable loop which that limit holds.

A loop that grows ends in a limit cycle where the rig is at its limits. Its motion is bounded, so the run comes to its
end, and only the linearised loop tells it from a stable one that an earthquake drove to a limit.
"""

from __future__ import annotations

from dataclasses import replace

from edesign.errors import InputError
from edesign.substructure.advice.expectation import Bench
from edesign.substructure.met_limits import in_words
from edesign.substructure.virtual_tests import TestResults, VirtualLaboratory, VirtualTest, without_result


def held_by_limits(laboratory: VirtualLaboratory, results: TestResults) -> TestResults:
    """Return the results with runs as `unstable` whose loop is unstable by itself, and only held by limits that it met.

    Args:
        laboratory: that made them.
        results: of a test.
    """
    if not any(_in_question(run) for run in results.runs):
        return results
    try:
        bench = _bench(laboratory, results)
        runs = tuple(_judged(bench, results, run) for run in results.runs)
    except InputError:  # the structure without damping, or a specimen at rest: nothing can be said of the loop
        return results
    return replace(results, runs=runs)


def _in_question(run: VirtualTest) -> bool:
    return bool(run.saturated) and run.outcome in ("done", "saturated")


def _bench(laboratory: VirtualLaboratory, results: TestResults) -> Bench:
    structure, direct = laboratory.laboratory.structure, results.direct
    if direct is None or structure is None:
        return Bench.of(laboratory, results.drive.wanted, None)
    return Bench.of(laboratory, direct.deformation, structure.part)


def _judged(bench: Bench, results: TestResults, run: VirtualTest) -> VirtualTest:
    if not _in_question(run):
        return run
    motion = results.drive.wanted if results.direct is None else results.direct.deformation
    compensator = bench.compensator(run.compensator, motion)
    if bench.expected(run.compensator, results.drive, motion, compensator).stable:
        return run
    return without_result(run, "unstable", f"held by {in_words(run.saturated)}")
