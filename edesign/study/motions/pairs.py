"""Pairs of components made ready for histories in three dimensions: fitted to the spectrum by the rule of its code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.codes.motion_sets import PairRule
from edesign.codes.rule_check import RuleCheck
from edesign.codes.spectrum import Spectrum
from edesign.errors import EdesignError, InputError
from edesign.ground_motion.component_pairs import PairFit, judged
from edesign.ground_motion.hazard import elastic_spectrum, rules_in_force
from edesign.ground_motion.matching import Match, MatchOptions
from edesign.ground_motion.matching.match import check_band, check_record
from edesign.ground_motion.matching.raising import least_factor, raised
from edesign.ground_motion.pair_matching import match_pair, on_one_axis
from edesign.ground_motion.pairs import HoldsPairs, Pair, find_pairs
from edesign.ground_motion.record import Record
from edesign.ground_motion.sources import Found
from edesign.one_thread import one_thread
from edesign.project.records.pairs import InSpace, OnePair, SuitePairs
from edesign.project.records.records import CombinedSpectrum, level_of_fit, record_of
from edesign.stopping import in_threads
from edesign.study.motions.fitted import fitted_once
from edesign.study.motions.pair_criteria import FirstPeriods, PairSpectra

UNTURNED = (0.0,)


@dataclass(frozen=True)
class PairMotion:
    """A pair and its fit to the spectrum.

    Of a single recording and of a pair `name`, `parts`, `found`, `match`, `record` and `scale` are alike.

    Attributes:
        pair: as recorded.
        matches: fit of both components, that of the set included; None: the pair is used as recorded.
        fit: how near the combined spectrum of both is to the target; None: each component was fitted by itself.
        failure: why it could not be fitted, "" if it could.
    """

    pair: Pair
    matches: tuple[Match, Match] | None = None
    fit: PairFit | None = None
    failure: str = ""

    @property
    def name(self) -> str:
        """Reference of the pair."""
        return self.pair.name

    @property
    def parts(self) -> tuple[str, ...]:
        """References of the recordings that it is made of."""
        return tuple(f"{record_of(self.name)}/{found.record.name}" for found in self.pair.found)

    @property
    def found(self) -> Found:
        """The first component as recorded."""
        return self.pair.components[0]

    @property
    def match(self) -> Match | None:
        """The fit of the first component; None if the pair is used as recorded."""
        return None if self.matches is None else self.matches[0]

    @property
    def record(self) -> Record:
        """The first component before the scaling of the analysis.

        Raises:
            InputError: the pair could not be fitted.
        """
        return self.records[0]

    @property
    def scale(self) -> float:
        """The constant factor on the first component, that of the set included."""
        return self.factors[0]

    @property
    def factors(self) -> tuple[float, ...]:
        """The constant factors of both components and of the vertical one, those of the set included.

        A vertical component has the factor of both; where these differ, their geometric mean. Its shape stays.
        """
        first, second = (1.0, 1.0) if self.matches is None else (one.scale * one.suite_factor for one in self.matches)
        upwards = first if first == second else float(np.sqrt(first * second))
        return (first, second) if self.pair.vertical is None else (first, second, upwards)

    @property
    def records(self) -> tuple[Record, ...]:
        """All components on one time axis, before the factor of a level: both horizontal ones, then the vertical one.

        Raises:
            InputError: the pair could not be fitted.
        """
        if self.failure:
            raise InputError(self.failure)
        if self.matches is None:
            return tuple(found.record for found in self.pair.found)
        given = [(match.matched, match.lead) for match in self.matches]
        if self.pair.vertical is not None:
            given.append((self.pair.vertical.record.scaled(self.factors[-1]), 0.0))
        return tuple(on_one_axis(given))


@dataclass(frozen=True)
class PairSet:
    """The pairs of a record, and what the code says of them.

    Attributes:
        name: of the record.
        spec: what the file says.
        motions: its pairs.
        rule: of the code for pairs.
        angles: by which histories turn them from x towards y, rad.
        target: the spectrum that they are fitted to; None: they are used as recorded.
        spectrum: of both components that was compared; None: each component by itself.
        suite_factor: on all pairs, with which the rules for their mean are met; part of the matches.
        criteria: of the code.
    """

    name: str
    spec: SuitePairs | OnePair
    motions: tuple[PairMotion, ...]
    rule: PairRule
    angles: tuple[float, ...] = UNTURNED
    target: Spectrum | None = None
    spectrum: CombinedSpectrum | None = None
    suite_factor: float = 1.0
    criteria: tuple[RuleCheck, ...] = ()


def prepare_pairs(
    file: HoldsPairs,
    name: str,
    first_periods: FirstPeriods | None = None,
    workers: int = 1,
    angles: Sequence[float] = UNTURNED,
    read: Mapping[str, Found] | None = None,
) -> PairSet:
    """Read the pairs of a record and fit them to the spectrum of the hazard, as the file says.

    Args:
        first_periods: of the building, for the rules of the code on the mean spectrum; None leaves them open.
        workers: pairs that are fitted at the same time, in threads; the results do not depend on it.
        angles: by which the pairs are turned in histories, rad; for the rules of the code.
        read: components that were read already, as for `find_pairs`.

    Returns:
        The pairs with their fits; those that could not be fitted have a `failure`.

    Raises:
        InputError: a pair cannot be read, or is none.
    """
    pairs, fit = find_pairs(file, name, read), _fit_of(file, name)
    unfitted = _plain_set(file, name, [PairMotion(pair) for pair in pairs], angles)
    if fit is None:
        return unfitted
    target, options = fit
    fitted_to = partial(_fitted, target=target, options=options, spectrum=unfitted.spectrum)
    with one_thread():
        motions = list(in_threads(fitted_to, pairs, workers))
    found = replace(unfitted, motions=tuple(motions))
    spectra = _spectra(found, options, first_periods)
    if spectra is None:
        return found
    factor = least_factor(spectra.needed)
    return replace(
        found,
        motions=tuple(_raised(motion, factor, target) for motion in motions),
        suite_factor=factor,
        criteria=spectra.criteria(factor),
    )


def judged_pairs(
    file: HoldsPairs,
    name: str,
    motions: Sequence[PairMotion],
    first_periods: FirstPeriods | None = None,
    angles: Sequence[float] = UNTURNED,
) -> PairSet:
    """Return the pairs of a record that `prepare_pairs` made ready, with what the code says of them.

    Args:
        first_periods: as for `prepare_pairs`.
        angles: likewise.
    """
    found, fit = _plain_set(file, name, motions, angles), _fit_of(file, name)
    spectra = None if fit is None else _spectra(found, fit[1], first_periods)
    if spectra is None:
        return found
    factor = next(match.suite_factor for motion in motions if (match := motion.match) is not None)
    return replace(found, suite_factor=factor, criteria=spectra.criteria(1.0))


def _plain_set(file: HoldsPairs, name: str, motions: Sequence[PairMotion], angles: Sequence[float]) -> PairSet:
    """The pairs of a record with the rule for them, not compared with it yet."""
    spec, fit, rule = _spec(file, name), _fit_of(file, name), rules_in_force(file.hazard).pairs
    found = PairSet(name, spec, tuple(motions), rule, tuple(angles))
    if fit is None:
        return found
    target, options = fit
    return replace(found, target=target, spectrum=spec.spectrum or _spectrum_of(rule, options.method == "scale"))


def _spectra(pairs: PairSet, options: MatchOptions, first_periods: FirstPeriods | None) -> PairSpectra | None:
    """What the code compares of the pairs that could be fitted; None: there are none, or one pair, which is no set."""
    fitted = [motion for motion in pairs.motions if not motion.failure]
    if pairs.target is None or not fitted or isinstance(pairs.spec, OnePair):
        return None
    acting = [along_axes(pairs.spec, motion.records[0], motion.records[1]) for motion in fitted]
    return PairSpectra(acting, pairs.angles, pairs.target, first_periods, options.method != "scale")


def _spec(file: HoldsPairs, name: str) -> SuitePairs | OnePair:
    spec = file.records[name]
    assert isinstance(spec, InSpace), "who has others does not ask"
    return spec


def check_pair_fits(file: HoldsPairs, name: str, pairs: Sequence[Pair]) -> None:
    """Check that pairs reach over the band that they are fitted over, before any is fitted.

    Args:
        file: with the pairs and the hazard.
        name: of their record.
        pairs: as recorded.

    Raises:
        InputError: a step is too long or a record too short; the message has a line for each.
    """
    fit = _fit_of(file, name)
    if fit is None:
        return
    target, options = fit
    faults: list[str] = []
    for record in (found.record for pair in pairs for found in pair.components):
        try:
            check_band(target, options)
            check_record(record, options)
        except InputError as error:
            faults.append(f"{file.where('records', name, 'match')}: records.{name}.match: {error}")
    if faults:
        raise InputError("\n".join(faults))


def _fit_of(file: HoldsPairs, name: str) -> tuple[Spectrum, MatchOptions] | None:
    """The spectrum that pairs are fitted to, and how; None: they are used as recorded."""
    spec, hazard = file.records[name], file.hazard
    if spec.match is None or hazard is None:
        return None
    match = spec.match
    options = MatchOptions(match.method, match.periods, hazard.damping, scale_bounds=match.scale_bounds)
    return elastic_spectrum(hazard, level_of_fit(spec, hazard)), options


def _spectrum_of(rule: PairRule, scaled: bool) -> CombinedSpectrum | None:
    """The combined spectrum that a code's rule compares; None: each component by itself."""
    if rule.compared == "maximum direction":
        return "rotd100"
    return "geometric_mean" if scaled else None


def _fitted(pair: Pair, target: Spectrum, options: MatchOptions, spectrum: CombinedSpectrum | None) -> PairMotion:
    first, second = (found.record for found in pair.components)
    try:
        found = fitted_once(match_pair, first, second, target, options, spectrum)
    except EdesignError as error:
        return PairMotion(pair, failure=f"{pair.name} cannot be fitted to the spectrum: {error}")
    return PairMotion(pair, found.matches, found.fit)


def _raised(motion: PairMotion, factor: float, target: Spectrum) -> PairMotion:
    """The pair with the factor of its set."""
    if motion.matches is None or factor == 1.0:
        return motion
    first, second = motion.matches
    higher = replace(motion, matches=(raised(first, factor), raised(second, factor)))
    x, y = higher.records[:2]
    fit = None if motion.fit is None else judged(motion.fit, x, y, target)
    return replace(higher, fit=fit)


def along_axes(spec: SuitePairs | OnePair, first: Record, second: Record) -> tuple[Record, Record]:
    """Return the components along x and y of the building at the angle zero.

    Args:
        spec: what the file says.
    """
    return (first, second) if spec.components == ("x", "y") else (second, first)
