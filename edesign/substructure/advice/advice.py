"""What can be said of virtual or real substructure tests before any is run: from transfer functions, in seconds.

The law of the damper is linearised for each test, so the results are estimates, which
tests/unit/substructure/test_rts_advice.py holds against runs of the loop.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from edesign.errors import InputError
from edesign.project.substructure.programme import CommandTest, RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.advice.expectation import (
    UNSTABLE_RIG,
    ExpectedTest,
    Linearisation,
    LinearModel,
    ModeAdvice,
    force_delay,
)
from edesign.substructure.advice.needs import AbortLevel, Need, abort_level, needs_of
from edesign.substructure.advice.recommendation import Candidate, Recommendation, recommended
from edesign.substructure.advice.small_motions import cycle_rms, grows_below, smaller_models
from edesign.substructure.computed_structure import Direct
from edesign.substructure.drive import Drive
from edesign.substructure.virtual_test import lost_in_noise
from edesign.substructure.virtual_tests import VirtualLaboratory


@dataclass(frozen=True)
class TestAdvice:
    """Findings on a test before it is run.

    Attributes:
        name, kind, source: of the test.
        linearisation: of the damper; of a command test at its own amplitude.
        modes: of the structure; empty: the test has no loop.
        first: number of the mode that a delay of the force makes grow first; 0: none.
        expected: one for each compensator.
        nonlinear: share of the specimen's force in the structure itself that the linearised law does not give, of root
            mean squares; NaN: the test has no loop.
        unstable_pole: the unstable pole of a rig that the specimen makes unstable, in words; empty: it is stable.
    """

    name: str
    kind: str
    source: str
    linearisation: Linearisation
    modes: tuple[ModeAdvice, ...]
    first: int
    expected: tuple[ExpectedTest, ...]
    nonlinear: float = math.nan
    unstable_pole: str = ""

    @property
    def critical_delay(self) -> float:
        """Least critical delay, s; inf: no delay of the force makes the structure grow."""
        return min((mode.critical_delay for mode in self.modes), default=math.inf)


@dataclass(frozen=True)
class Advice:
    """Findings of `edesign rts check`.

    Attributes:
        tests: in the order of the file, those with a given command too.
        force_delay: of the force, beside that of the rig: sensor, and half a step if it is held, s.
        needs: of the rig against its limits.
        abort: the displacement at which a test should end; None: there is no test, or it hardly moves.
        recommendation: of a compensator.
        delay_margin: factor that is asked for.
        response_error: that is accepted.
        warnings: of unstable rigs, small motions that grow and motions in the noise, and of structure and law.
    """

    tests: tuple[TestAdvice, ...]
    force_delay: float
    needs: tuple[Need, ...]
    abort: AbortLevel | None
    recommendation: Recommendation
    delay_margin: float
    response_error: float
    warnings: tuple[str, ...]

    @property
    def governing(self) -> TestAdvice | None:
        """Test with a loop whose critical delay is least; None: there is no loop."""
        return min((test for test in self.tests if test.modes), key=lambda test: test.critical_delay, default=None)

    @property
    def recommended(self) -> str:
        """Name of the compensator; empty: none is good enough."""
        return self.recommendation.compensator


def advise(laboratory: VirtualLaboratory) -> Advice:
    """Return what can be said of the tests of a laboratory without running their loops.

    Whether a test is stable is said of the loop in main steps, except with a frame that may yield. For margins and
    errors the numerical part counts as integrated exactly. Limits of the rig are compared with what is needed, and not
    met here. For stability adaptive compensators have converged; for errors they adapt to the motion of the structure.

    Response errors come out as of runs for linear dampers, and within a factor of 1.3 for the thesis' elastomer. Of
    friction, of Bouc-Wen's law and of powers of the velocity they are of the first order: see `AGREES`.

    Raises:
        InputError: the structure is undamped or unstable by itself, or a record or command cannot be read.
    """
    prepared = [_prepared(laboratory, test) for test in laboratory.tests]
    found = tuple(_placed(laboratory, *one) for one in prepared)
    file = laboratory.file
    needs = needs_of(laboratory, [(test.name, drive, direct) for test, drive, direct in prepared])
    looped = [test.name for test in found if test.modes]
    steps = [one for test in laboratory.tests for one in laboratory.step_warnings(test)]
    sensors = laboratory.laboratory.sensors
    lost = [one for need in needs for one in lost_in_noise(need.test, sensors, need.deformation, need.force)]
    choice = _choice(file, found, needs) if not lost else Recommendation("", f"Nothing to choose by: {lost[0]}.", False)
    return Advice(
        tests=found,
        force_delay=force_delay(laboratory),
        needs=needs,
        abort=abort_level(needs, laboratory.laboratory.limits.stroke, looped) if found else None,
        recommendation=choice,
        delay_margin=file.criteria.delay_margin,
        response_error=file.criteria.response_error,
        warnings=(*_warnings(found), *steps, *lost, *laboratory.laboratory.warnings),
    )


def _prepared(
    laboratory: VirtualLaboratory, test: CommandTest | RtsTest
) -> tuple[CommandTest | RtsTest, Drive, Direct | None]:
    drive = laboratory.drives[test.name]
    return test, drive, laboratory.direct(drive) if drive.ground is not None else None


def _placed(
    laboratory: VirtualLaboratory, test: CommandTest | RtsTest, drive: Drive, direct: Direct | None
) -> TestAdvice:
    try:
        return _test(laboratory, test, drive, direct)
    except InputError as error:
        raise InputError(f"{laboratory.file.path}: test {test.name}: {error}") from error


def _test(
    laboratory: VirtualLaboratory, test: CommandTest | RtsTest, drive: Drive, direct: Direct | None
) -> TestAdvice:
    motion = direct.deformation if direct is not None else drive.target[:, 0]  # type: ignore[index]
    structure = laboratory.laboratory.structure
    part = structure.part if structure is not None and direct is not None else None
    model = LinearModel.of(laboratory, motion, part)
    modes = model.modes
    smaller = smaller_models(model) if not model.unstable_pole else ()
    expected = tuple(_expected(model, smaller, name, drive, direct, motion) for name in laboratory.file.compensators)
    least = min(modes, key=lambda mode: mode.critical_delay, default=None)
    first = least.number if least is not None and math.isfinite(least.critical_delay) else 0
    nonlinear = model.nonlinear_share(direct) if direct is not None else math.nan
    return TestAdvice(
        test.name, test.kind, drive.source, model.linearisation, modes, first, expected, nonlinear, model.unstable_pole
    )


def _expected(
    model: LinearModel,
    smaller: tuple[LinearModel, ...],
    name: str,
    drive: Drive,
    direct: Direct | None,
    motion: np.ndarray,
) -> ExpectedTest:
    compensator = model.compensator(name, motion)
    found = model.expected(name, drive, direct, compensator)
    if not found.stable:
        return found
    amplitude = grows_below(smaller, name, compensator, motion)
    return replace(found, grows_below=amplitude, cycle_rms=cycle_rms(amplitude, motion))


def _choice(file: RtsFile, tests: tuple[TestAdvice, ...], needs: tuple[Need, ...]) -> Recommendation:
    """The compensator for the tests that the rig can do."""
    weak = [need for need in needs if not need.possible]
    beyond = "; ".join(f"{need.test} ({need.beyond})" for need in weak)
    doable = tuple(test for test, need in zip(tests, needs, strict=True) if need.possible)
    if weak and not doable:
        return Recommendation("", f"No compensator helps: the rig is too weak for {beyond}.", accurate=False)
    candidates = [_candidate(name, one.kind, doable) for name, one in file.compensators.items()] if doable else []
    choice = recommended(candidates, file.criteria.delay_margin, file.criteria.response_error)
    if not weak:
        return choice
    said = f"{choice.reason} That is for the other tests: no compensator helps where the rig is too weak, in {beyond}."
    return replace(choice, reason=said)


def _warnings(tests: tuple[TestAdvice, ...]) -> Iterator[str]:
    for test in tests:
        if test.unstable_pole:
            yield (
                f"test {test.name}: {UNSTABLE_RIG}, whatever the compensator: {test.unstable_pole}. It takes a lower "
                "gain, a faster valve, stiffer oil, or a specimen with less damping"
            )
        if growing := [one for one in test.expected if one.grows_below > 0.0]:
            names = ", ".join(f'"{one.compensator}" below {1e3 * one.grows_below:.3g} mm' for one in growing)
            yield (
                f"test {test.name}: small motions grow with {names}: the law is stiffer there than at the amplitude of "
                "the test. The loop ends in a limit cycle, and the expected errors need not hold"
            )


def _candidate(name: str, kind: str, tests: tuple[TestAdvice, ...]) -> Candidate:
    """A compensator by its worst test; where no test has a loop, by its tracking."""
    looped = [test for test in tests if test.modes] or list(tests)
    found = [one for test in looped for one in test.expected if one.compensator == name]
    errors = [one.response_rms if one.stability is not None else one.tracking_rms for one in found]
    return Candidate(
        name,
        kind,
        stable=all(one.stable for one in found),
        delay_factor=min((one.delay_factor for one in found), default=math.inf),
        error=max(errors, default=math.nan),
        of_response=any(one.stability is not None for one in found),
        cycle_error=max((one.cycle_rms for one in found), default=0.0),
        reason=next((one.modelled_as for one in found if not one.stable and one.stability is None), ""),
    )
