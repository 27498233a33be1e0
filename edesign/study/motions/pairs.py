"""Pairs of components made ready for histories in three dimensions: fitted to the spectrum by the rule of its code."""

from __future__ import annotations

from collections.abc import Sequence
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
from edesign.one_thread import one_thread
from edesign.project.records.pairs import OnePair, SuitePairs
from edesign.project.records.records import CombinedSpectrum, level_of_fit
from edesign.stopping import in_threads
from edesign.study.motions.pair_criteria import FirstPeriods, PairSpectra


@dataclass(frozen=True)
class PairMotion:
    """A pair and its fit to the spectrum.

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
        target: the spectrum that they are fitted to; None: they are used as recorded.
        spectrum: of both components that was compared; None: each component by itself.
        suite_factor: on all pairs, with which the rules for their mean are met; part of the matches.
        criteria: of the code.
    """

    name: str
    spec: SuitePairs | OnePair
    motions: tuple[PairMotion, ...]
    rule: PairRule
    target: Spectrum | None = None
    spectrum: CombinedSpectrum | None = None
    suite_factor: float = 1.0
    criteria: tuple[RuleCheck, ...] = ()


def prepare_pairs(
    file: HoldsPairs,
    name: str,
    first_periods: FirstPeriods | None = None,
    workers: int = 1,
) -> PairSet:
    """Read the pairs of a record and fit them to the spectrum of the hazard, as the file says.

    Args:
        first_periods: of the building, for the rules of the code on the mean spectrum; None leaves them open.
        workers: pairs that are fitted at the same time, in threads; the results do not depend on it.

    Returns:
        The pairs with their fits; those that could not be fitted have a `failure`.

    Raises:
        InputError: a pair cannot be read, or is none.
    """
    spec, pairs, fit = file.records[name], find_pairs(file, name), _fit_of(file, name)
    rule = rules_in_force(file.hazard).pairs
    if fit is None:
        return PairSet(name, spec, tuple(PairMotion(pair) for pair in pairs), rule)
    target, options = fit
    spectrum = spec.spectrum or _spectrum_of(rule, options.method == "scale")
    fitted_to = partial(_fitted, target=target, options=options, spectrum=spectrum)
    with one_thread():
        motions = list(in_threads(fitted_to, pairs, workers))
    fitted = [motion for motion in motions if not motion.failure]
    found = PairSet(name, spec, tuple(motions), rule, target, spectrum)
    if not fitted or isinstance(spec, OnePair):  # one pair is no set
        return found
    acting = [along_axes(spec, motion.records[0], motion.records[1]) for motion in fitted]
    spectra = PairSpectra(acting, spec.angles, target, first_periods, options.method != "scale")
    factor = least_factor(spectra.needed)
    return replace(
        found,
        motions=tuple(_raised(motion, factor, target) for motion in motions),
        suite_factor=factor,
        criteria=spectra.criteria(factor),
    )


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
        found = match_pair(first, second, target, options, spectrum)
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
