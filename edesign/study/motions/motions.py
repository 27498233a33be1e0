"""Recordings made ready for the histories of a project: found, and where it says so fitted to the spectrum."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from edesign.codes.motion_sets import DAMPING
from edesign.codes.spectrum import Spectrum
from edesign.errors import EdesignError, InputError
from edesign.ground_motion.component_pairs import PairFit, fit_pair
from edesign.ground_motion.hazard import action_of, elastic_spectrum, factor_of_level
from edesign.ground_motion.matching import Match, MatchOptions, match_record
from edesign.ground_motion.matching.match import check_band, check_record, constant_factor
from edesign.ground_motion.matching.raising import raised, suite_factor
from edesign.ground_motion.record import Record
from edesign.ground_motion.record_choice import RecordChoice
from edesign.ground_motion.sources import Found
from edesign.one_thread import one_thread
from edesign.project.analysis.analyses import BuildingHistory
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.pairs import InSpace, SuitePairs
from edesign.project.records.records import PairRecord, Suite, component_references, record_of
from edesign.stopping import Stopped, in_threads, stoppable
from edesign.study.motions.fitted import fitted_once
from edesign.study.motions.pair_criteria import FirstPeriods
from edesign.study.motions.pairs import UNTURNED, PairMotion, prepare_pairs


@dataclass(frozen=True)
class Motion:
    """A recording and its fit to the spectrum.

    Attributes:
        name: reference of the recording.
        found: as recorded, and where it comes from.
        match: its fit to the spectrum of the hazard at gamma_I = 1; None if it is used as recorded.
        failure: why it could not be fitted, "" if it could.
    """

    name: str
    found: Found
    match: Match | None = None
    failure: str = ""

    @property
    def parts(self) -> tuple[str, ...]:
        """References of the recordings that it is made of."""
        return (self.name,)

    @property
    def scale(self) -> float:
        """The constant factor on the recording, that of its suite included."""
        return self.match.scale * self.match.suite_factor if self.match else 1.0

    @property
    def record(self) -> Record:
        """The record before the scaling of the analysis.

        Raises:
            InputError: it could not be fitted.
        """
        if self.failure:
            raise InputError(self.failure)
        return self.match.matched if self.match else self.found.record


AnyMotion = Motion | PairMotion
"""Of a single recording, or of a pair whose components act at once."""


def fit(reference: str, found: Found, target: Spectrum, options: MatchOptions) -> Motion:
    """Fit a recording to a spectrum; a failure is kept with its reason in the motion.

    Args:
        found: as recorded.
        target: the elastic spectrum.
        options: method, band, damping and bounds of the fit.
    """
    try:
        return Motion(reference, found, fitted_once(match_record, found.record, target, options))
    except EdesignError as error:
        reason = str(error).removeprefix(f"{found.record.name}: ")
        return Motion(reference, found, failure=f"{reference} cannot be fitted to the spectrum: {reason}")


def raise_suite(motions: Sequence[Motion], target: Spectrum, first_periods: Sequence[float] | None) -> list[Motion]:
    """Multiply the fitted records of a suite by the one factor with which their mean satisfies the code.

    Args:
        motions: the motions of the suite; those without a fit stay as they are.
        target: the elastic spectrum.
        first_periods: T1 of the structure by direction, s; None: not known.

    Source: the rules of the target's code for a set, such as EN 1998-1:2004, 3.2.3.1.2(4).
    """
    matches = [motion.match for motion in motions if motion.match is not None]
    if not matches:
        return list(motions)
    factor = suite_factor(matches, target.with_damping(DAMPING), first_periods)
    return [replace(motion, match=raised(motion.match, factor)) if motion.match else motion for motion in motions]


def prepare_motions(
    recordings: Mapping[str, Found],
    prepare: Callable[[str, Found], Motion],
    workers: int = 1,
    each: Callable[[Motion], None] = lambda motion: None,
    stop: Callable[[], bool] = lambda: False,
) -> dict[str, Motion]:
    """Process recordings, several at a time.

    Args:
        recordings: what was found, by reference.
        prepare: processes one recording.
        workers: threads.
        each: called with each motion in the order of `recordings`, as soon as it and those before it are ready.
        stop: asked before each; True leaves the rest out.

    Returns:
        Motions by reference, in the order of `recordings`.
    """

    def start(reference: str) -> Motion | None:
        try:
            with stoppable(stop):
                return None if stop() else prepare(reference, recordings[reference])
        except Stopped:
            return None

    motions: dict[str, Motion] = {}
    with one_thread():
        for reference, motion in zip(recordings, in_threads(start, recordings, workers), strict=True):
            if motion is None:
                break
            motions[reference] = motion
            each(motion)
    return motions


def project_motions(
    project: AnalysisFile,
    recordings: Mapping[str, Found],
    first_periods: Callable[[], tuple[float, ...] | None],
    workers: int = 1,
    each: Callable[[AnyMotion], None] = lambda motion: None,
    stop: Callable[[], bool] = lambda: False,
) -> dict[str, AnyMotion]:
    """Process and fit the recordings of a file as it says, suites as a whole.

    Args:
        recordings: what was found, by reference; of a suite all that the file takes from it.
        first_periods: gives T1 of the structure by direction (s) if a suite is fitted.
        workers: number of threads.
        each: called with each motion, as soon as it and those before it are ready.
        stop: asked before each recording; True leaves the rest out.

    Returns:
        The motions by reference, in the order of `recordings`; pairs, whose components are several of these, last.
    """

    def prepare(reference: str, found: Found) -> Motion:
        options = match_options(project, reference)
        if options is None or project.hazard is None:
            return Motion(reference, found)
        pair = pair_fit(project, reference, recordings)
        if pair is not None:
            options = replace(options, factor=pair.factor)
        return fit(reference, found, target_spectrum(project, reference), options)

    names = dict.fromkeys(map(record_of, recordings))
    pairs = [name for name in names if isinstance(project.records[name], InSpace)]
    single = {reference: found for reference, found in recordings.items() if record_of(reference) not in pairs}
    motions = prepare_motions(single, prepare, workers, each, stop)
    for name, spec in project.records.items():
        members = [motion for reference, motion in motions.items() if reference.startswith(f"{name}/")]
        if not isinstance(spec, Suite) or spec.match is None or project.hazard is None or not members:
            continue  # of chosen records that are scaled only, the choice has the common factor, within its bounds
        for motion in raise_suite(members, target_spectrum(project, name), first_periods()):
            motions[motion.name] = motion
    found: dict[str, AnyMotion] = dict(motions)
    try:
        for name in pairs:
            with stoppable(stop):
                T_1 = first_periods_of_pairs(project, name, first_periods)
                prepared = prepare_pairs(project, name, T_1, workers, turns(project, name), recordings)
            for ready in prepared.motions:
                found[ready.name] = ready
                each(ready)
    except Stopped:
        pass
    return found


def first_periods_of_pairs(
    project: AnalysisFile, name: str, first_periods: Callable[[], tuple[float, ...] | None]
) -> FirstPeriods | None:
    """Return the first periods that the code's rules for the mean of pairs need; None where it has none, or no pairs.

    Args:
        name: of the record.
        first_periods: gives those of the structure by direction, s.
    """
    needed = isinstance(project.records[name], SuitePairs) and match_options(project, name) is not None
    known = first_periods() if needed else None
    return None if known is None else FirstPeriods(*known)


def turns(project: AnalysisFile, name: str) -> tuple[float, ...]:
    """Return the angles by which the histories of a file turn a record, rad."""
    histories = (spec for spec in project.analyses if isinstance(spec, BuildingHistory))
    angles = (angle for spec in histories if record_of(spec.record) == name for angle in spec.angles)
    return tuple(dict.fromkeys(angles)) or UNTURNED


def match_options(project: AnalysisFile, reference: str) -> MatchOptions | None:
    """Return how the project fits a recording to the spectrum; None if it stays as recorded."""
    name, _, recording = reference.partition("/")
    spec, choice = project.records[name].match, project.record_choice(name)
    if project.hazard is None:
        return None
    damping = project.hazard.damping
    if spec is not None:
        return MatchOptions(method=spec.method, periods=spec.periods, scale_bounds=spec.scale_bounds, damping=damping)
    if not isinstance(choice, RecordChoice):
        return None
    return MatchOptions("scale", choice.fit_band, damping, factor=choice.factors[recording])


def target_spectrum(project: AnalysisFile, reference: str) -> Spectrum:
    """Return the spectrum that the project fits a recording to: one shape for all levels, or that of a level.

    Args:
        project: the project with the hazard.

    Raises:
        InputError: the hazard of the project is wrong, or its code has no vertical spectrum here.
    """
    assert project.hazard is not None, "match_options reports it"
    name = record_of(reference)
    match, level = project.records[name].match, project.fitted_level(name)
    if match is not None and match.component == "vertical":
        return action_of(project.hazard).vertical(level)
    return elastic_spectrum(project.hazard, level)


def pair_fit(project: AnalysisFile, reference: str, recordings: Mapping[str, Found]) -> PairFit | None:
    """Return how a pair of components is scaled; None for a single recording, or one that is not fitted.

    Args:
        reference: of the pair, or of one of its components.
        recordings: what was found, by reference, both components among them.

    Raises:
        InputError: a component does not reach over the band.
    """
    name = record_of(reference)
    spec, options = project.records[name], match_options(project, reference)
    if not isinstance(spec, PairRecord) or options is None or project.hazard is None:
        return None
    first, second = (recordings[place].record for place in component_references(name))
    return fit_pair(first, second, target_spectrum(project, name), options, spec.spectrum)


def expected_scale(project: AnalysisFile, reference: str, recordings: Mapping[str, Found]) -> float:
    """Return the factor with which the fit of a recording begins; 1 for one that is not fitted.

    Args:
        recordings: what was found, by reference.
    """
    options = match_options(project, reference)
    if options is None or project.hazard is None:
        return 1.0
    pair = pair_fit(project, reference, recordings)
    if pair is not None:
        return pair.factor
    return constant_factor(recordings[reference].record, target_spectrum(project, reference), options)


def check_fits(project: AnalysisFile, recordings: Mapping[str, Found]) -> None:
    """Check that recordings reach over the band that the project fits, before any is fitted.

    Args:
        recordings: what was found, by reference.

    Raises:
        InputError: a step is too long or a record too short; the message has a line for each.
    """
    faults = []
    for reference, found in recordings.items():
        options = match_options(project, reference)
        if options is None:
            continue
        try:
            check_band(target_spectrum(project, reference), options)
            check_record(found.record, options)
        except InputError as error:
            name = record_of(reference)
            faults.append(f"{project.where('records', name, 'match')}: records.{name}.match: {error}")
    if faults:
        raise InputError("\n".join(faults))


def level_factor(project: AnalysisFile, reference: str, level: str) -> float:
    """Return the factor of a hazard level on a fitted recording; 1 for one that is not fitted."""
    if project.hazard is None or match_options(project, reference) is None:
        return 1.0
    return factor_of_level(project.hazard, level)
