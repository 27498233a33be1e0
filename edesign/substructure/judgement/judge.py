"""How good a test was: tracking, and with the file of the test the error of the building's response."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.calibration.signals.noise import smooth
from edesign.core.errors import CoreError
from edesign.errors import InputError
from edesign.project.reading.problems import unknown_name
from edesign.project.substructure.programme import CommandTest, RtsTest
from edesign.project.substructure.quantities import MOST_DELAY
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.advice.expectation import LinearModel, force_delay
from edesign.substructure.computed_structure import Direct
from edesign.substructure.drive import Drive
from edesign.substructure.indicators import Tracking, Undetermined, tracking
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.response_error import peak_error, response_error
from edesign.substructure.indicators.tracking_error import nrms_root
from edesign.substructure.judgement.measured import MeasuredRecord, clipped, read_measured
from edesign.substructure.laboratory import TestedDamper
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.stability.margins import critical_delays, delay_factor
from edesign.substructure.virtual_tests import VirtualLaboratory

REPRODUCED = 0.05
"""Root of squared error over squared target, by which the numerical part under the measured force may miss the recorded
target. Noise of the load cell and another method of integration leave less than 1 %; a force of the wrong sign, unit
or channel leaves all of it.
"""


@dataclass(frozen=True)
class JudgedResponse:
    """Judgement of the response of the structure that a test gives.

    Attributes:
        test: of the file.
        driven_by: the ground motion, in words.
        reproduced: root of squared error over squared target, of the numerical part under the measured force,
            or the applied one where the record has it.
        corrected: whether the force is corrected to that of the target.
        response_error, peak_error: of the deformation whose force the structure gets against the direct analysis: that
            which is measured, or the target if the force is corrected. Root of squared error over squares, relative
            error of the peak.
        target_error: root of squared error over squares, of the recorded target against the direct analysis.
        force_nrms, force_nrms_root: of the law under the measured displacement against the measured force, without and
            with a root.
        critical_delay: at which the loop would have become unstable, s; inf: at none.
        delay_factor: of it over the measured delay and that of the force, or over the delay that a correction leaves in
            the force; see `delay_factor`.
        covered: largest direct deformation while the record lasts, over the largest of all.
        time: (n,) s at main steps; target, measured, force, direct_deformation, by_force, law_force: (n,) SI.
    """

    test: str
    driven_by: str
    reproduced: float
    corrected: bool
    response_error: float
    peak_error: float
    target_error: float
    force_nrms: float
    force_nrms_root: float
    critical_delay: float
    delay_factor: float
    covered: float
    time: np.ndarray
    target: np.ndarray
    measured: np.ndarray
    force: np.ndarray
    direct_deformation: np.ndarray
    by_force: np.ndarray
    law_force: np.ndarray


@dataclass(frozen=True)
class QualityCriterion:
    """Criterion that a good test keeps.

    Attributes:
        name: in words.
        value: of the test, dimensionless.
        limit: of the file; the value may not be above it, or with `at_least` not below.
    """

    name: str
    value: float
    limit: float
    at_least: bool = False

    @property
    def determined(self) -> bool:
        """True if the test has the value."""
        return not math.isnan(self.value)

    @property
    def met(self) -> bool:
        """True if the criterion is kept; not if the value is not known."""
        return self.value >= self.limit if self.at_least else self.value <= self.limit


@dataclass(frozen=True)
class Judgement:
    """Judgement of a test, by responses and criteria.

    Attributes:
        source: the record.
        test: that was recorded; None without a file of substructure tests.
        step: between its samples, s.
        samples: how many.
        tracking: of the specimen.
        response: None without a file, and of a test of the kind `command`, which has none.
        criteria: of that file.
        notes: what to mind, for people.
    """

    source: Path
    test: RtsTest | CommandTest | None
    step: float
    samples: int
    tracking: Tracking
    response: JudgedResponse | None
    criteria: tuple[QualityCriterion, ...]
    notes: tuple[str, ...]

    @property
    def good(self) -> bool | None:
        """True if all criteria are met; None: there are none."""
        return all(one.met for one in self.criteria) if self.criteria else None

    @property
    def verdict(self) -> str:
        """Verdict in one sentence."""
        if self.test is not None and self.response is None:
            return "no verdict: a command has no response of a structure"
        if not self.criteria:
            return "no verdict: the file of the test (--rts) says what a good one is"
        bad = [one.name if one.determined else f"{one.name} (not determined)" for one in self.criteria if not one.met]
        return f"not good: {' and '.join(bad)}" if bad else "good: all criteria are met"


def judge(path: Path | str, file: RtsFile | None = None, test: str | None = None) -> Judgement:
    """Judge a test by its record.

    Args:
        path: CSV with time, target, displacement, and force if there is one.
        file: of substructure tests, from `load_rts_file`; None: tracking alone is judged.
        test: of the file; None: as `chosen_test` finds it.

    Raises:
        InputError: the record cannot be read, or is not of that test; the message says why.
    """
    record = read_measured(path, "target", "displacement", *(("force",) if file is not None else ()))
    for name in ("displacement", "force"):
        if name in record.channels and (level := clipped(record[name])) is not None:
            scale, unit = (1e3, "mm") if name == "displacement" else (1e-3, "kN")
            raise InputError(
                f"{record.path}: the {name} is cut off at {scale * level:.4g} {unit}: its sensor's range? [E-MEAS-03]"
            )
    force, applied = (record.channels.get(name) for name in ("force", "applied_force"))
    followed = tracking(record["target"], record["displacement"], record.step, force, applied=applied)
    chosen = None if file is None else chosen_test(file, record.path, test)
    response = _response(record, file, chosen, followed) if file is not None and isinstance(chosen, RtsTest) else None
    return Judgement(
        source=record.path,
        test=chosen,
        step=record.step,
        samples=record.time.size,
        tracking=followed,
        response=response,
        criteria=() if file is None or response is None else _criteria(file, response),
        notes=_notes(record, followed, response),
    )


def chosen_test(file: RtsFile, path: Path, name: str | None = None) -> RtsTest | CommandTest:
    """Return the test that a record is of.

    Unless it is named, it is the test whose name the file has, alone or before `_`, as `edesign rts run --csv` names
    files; the longest such name, if there are several. A file with another name is of the only test of the kind `rts`.

    Args:
        name: of the test; None: it is not said.

    Raises:
        InputError: there is none of that name, or a name is needed.
    """
    tests = {one.name: one for one in file.tests if isinstance(one, (RtsTest, CommandTest))}
    if name is not None:
        if name not in tests:
            raise InputError(f"{file.path}: {unknown_name('test of the kind `rts` or `command`', name, tests)}")
        return tests[name]
    alike = [one for one in tests if path.stem == one or path.stem.startswith(f"{one}_")]
    in_loop = [one for one in tests.values() if isinstance(one, RtsTest)]
    if alike:
        return tests[max(alike, key=len)]
    if len(in_loop) != 1:
        which = f"--test NAME: which of {', '.join(tests)}?" if tests else "there is no test of the kind `rts`"
        raise InputError(f"{path}: of which test of {file.path} is it? {which} [E-MEAS-04]")
    return in_loop[0]


def _response(record: MeasuredRecord, file: RtsFile, test: RtsTest, followed: Tracking) -> JudgedResponse:
    laboratory = VirtualLaboratory(file)
    drive = laboratory.drive(test)
    whole = laboratory.direct(drive)
    structure = laboratory.laboratory.structure
    assert structure is not None and drive.ground is not None
    time = _shared_time(record, drive)
    target, measured, force = (_at(record, one, time) for one in ("target", "displacement", "force"))
    corrected = "applied_force" in record.channels
    applied, answered = (_at(record, "applied_force", time), target) if corrected else (force, measured)
    by_force = _by_force(record, laboratory, applied, drive.ground[: time.size])
    _refuse_another_test(record, target, by_force, whole, file.loop.main_step)
    direct = whole.deformation[: time.size]
    law = _law_force(laboratory.damper, time, measured)
    part = structure.part
    crossings = critical_delays(LinearModel.of(laboratory, whole.deformation, part).whole, 0.5 / file.loop.main_step)
    critical = min((one.delay for one in crossings if one.delay > 0.0), default=math.inf)
    late = followed.correlation_delay + force_delay(laboratory)
    if corrected:
        late = _delay_of_applied_force(laboratory, time, target, applied)
    return JudgedResponse(
        test=test.name,
        driven_by=drive.source,
        reproduced=nrms_root(target, by_force),
        corrected=corrected,
        response_error=response_error(answered, direct),
        peak_error=peak_error(answered, direct),
        target_error=response_error(target, direct),
        force_nrms=nrms_root(force, law) ** 2,
        force_nrms_root=nrms_root(force, law),
        critical_delay=critical,
        delay_factor=delay_factor(critical, late, file.loop.main_step),
        covered=float(np.max(np.abs(direct)) / np.max(np.abs(whole.deformation))),
        time=time,
        target=target,
        measured=measured,
        force=force,
        direct_deformation=direct,
        by_force=by_force,
        law_force=law,
    )


def _delay_of_applied_force(
    laboratory: VirtualLaboratory, time: np.ndarray, target: np.ndarray, applied: np.ndarray
) -> float:
    """Of a corrected force behind that of the law under the target, s, and half a step if it is held; NaN: unknown."""
    over_step = force_delay(laboratory) - laboratory.laboratory.sensors.force_delay
    try:
        law = _law_force(laboratory.damper, time, target)
        return correlation_delay(law, applied, laboratory.file.loop.main_step).delay + over_step
    except Undetermined:
        return math.nan


def _shared_time(record: MeasuredRecord, drive: Drive) -> np.ndarray:
    """Main steps (n,) s that record and test have both; the test begins at 0."""
    first, last = float(record.time[0]), float(record.time[-1])
    step = float(drive.time[1])
    if first > 0.5 * max(step, record.step):
        raise InputError(
            f"{record.path}: the record begins at {first:.4g} s; time counts from the beginning of the ground motion, "
            "at which the specimen is at rest [E-MEAS-05]"
        )
    shared = drive.time[drive.time <= last + 0.5 * step]
    if shared.size < 2:
        raise InputError(
            f"{record.path}: the record ends at {last:.4g} s, before the ground motion has begun [E-MEAS-05]"
        )
    return np.asarray(shared)


def _at(record: MeasuredRecord, channel: str, time: np.ndarray) -> np.ndarray:
    """A channel (n,) at main steps: its own samples where they are these, else linear between them."""
    return np.interp(time, record.time, record[channel])


def _by_force(
    record: MeasuredRecord, laboratory: VirtualLaboratory, force: np.ndarray, ground: np.ndarray
) -> np.ndarray:
    try:
        return laboratory.computed.by_force(force, ground)
    except CoreError as error:
        raise InputError(
            f"{record.path}: the numerical part cannot take the measured force: {error}; unit, sign or channel of the "
            "force, or another structure? [E-MEAS-04]"
        ) from error


def _refuse_another_test(
    record: MeasuredRecord, target: np.ndarray, by_force: np.ndarray, direct: Direct, step: float
) -> None:
    """Refuse a record whose target is shifted, or has nothing to do with the test."""
    path = record.path
    try:
        shift = correlation_delay(direct.deformation[: target.size], target, step).delay
    except Undetermined:
        if nrms_root(target, by_force) <= REPRODUCED:
            return  # a test that went wrong is still that test
        raise InputError(
            f"{path}: the target is not that of this test: it neither follows the direct analysis nor from the "
            "measured force; another record, scale or structure? [E-MEAS-04]"
        ) from None
    if abs(shift) > _longest_shift(target, step):
        raise InputError(
            f"{path}: the target is {abs(shift):.4g} s {'late' if shift > 0.0 else 'early'} against that of the test; "
            "time counts from the beginning of the ground motion [E-MEAS-05]"
        )


def _longest_shift(target: np.ndarray, step: float) -> float:
    """Half a period of the target's root-mean-square frequency, s: a wrong response is not shifted by more."""
    speed = float(np.sqrt(np.mean(np.diff(target) ** 2))) / step
    size = float(np.sqrt(np.mean(target**2)))
    return math.pi * size / speed if speed > 0.0 else math.inf


def _law_force(damper: TestedDamper, time: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Force (n,) N of the law with its effects under the measured displacement, freed from noise that it would feel."""
    u, v, _, _ = smooth(time, displacement)
    return SizedDamper(damper.values, damper.scales).force(time, u, v)


def _criteria(file: RtsFile, response: JudgedResponse) -> tuple[QualityCriterion, ...]:
    return (
        QualityCriterion("target under the measured force", response.reproduced, REPRODUCED),
        QualityCriterion("error of the response", response.response_error, file.criteria.response_error),
        QualityCriterion("delay factor", response.delay_factor, file.criteria.delay_margin, at_least=True),
        QualityCriterion(
            "largest deformation that the record lasts for, over that of the test", response.covered, 1.0, True
        ),
    )


def _notes(record: MeasuredRecord, followed: Tracking, response: JudgedResponse | None) -> tuple[str, ...]:
    notes = [f"{name}: {why}" for name, why in followed.undetermined.items() if "no force" not in why]
    late = followed.correlation_delay
    if late < -record.step:
        notes.append(
            f"the displacement leads the target by {-1e3 * late:.3g} ms: the compensator asks for too much, or the two "
            "columns are swapped"
        )
    if late > MOST_DELAY:
        notes.append(f"the displacement is {late:.3g} s late, and no rig is: is one of the columns shifted?")
    if response is not None:
        notes += _of_force(response)
    if record.unread:
        notes.append(f"not read: {', '.join(f'`{header}`' for header in record.unread)}")
    return tuple(notes)


def _of_force(response: JudgedResponse) -> Iterable[str]:
    """What may be wrong with a force that does not make the recorded target."""
    if response.reproduced <= REPRODUCED:
        return
    if float(np.sum(response.force * response.law_force)) < 0.0:
        yield "the measured force has the opposite sign of the law's: F > 0 pulls back for x > 0"
    else:
        yield (
            "the measured force does not make the recorded target: unit or channel of the force, another structure, "
            "or a compensator that corrects the force (a column such as `applied_force_kN`)"
        )
