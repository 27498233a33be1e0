"""The rules of a code for pairs of components that act on a model in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes.motion_sets import DAMPING, SetCheck, SetRules
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.codes.spectrum import Spectrum
from edesign.ground_motion.pairs import turned
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import PERIODS, psa, rotated_spectra


@dataclass(frozen=True)
class FirstPeriods:
    """First periods of a building in both directions.

    Attributes:
        x: along x, s.
        y: along y, s.
        shortest: the period that with all longer ones holds 90 % of the mass in both directions, s; None: not known.
    """

    x: float
    y: float
    shortest: float | None = None


@dataclass(frozen=True)
class _Set:
    """Motions that are compared with the target, unscaled."""

    where: str
    rules: SetRules
    T_1: float | None
    periods: np.ndarray
    spectra: np.ndarray
    peaks: np.ndarray

    def check(self, target: Spectrum, factor: float) -> SetCheck:
        return self.rules.check(self.periods, factor * self.spectra, factor * self.peaks, target, self.T_1)


class PairSpectra:
    """Spectra of pairs as a code compares them, ready for its rules.

    Along a direction the components of a pair at all its angles count alike, so that of n pairs n spectra are compared.
    """

    def __init__(
        self,
        pairs: Sequence[tuple[Record, Record]],
        angles: Sequence[float],
        target: Spectrum,
        first_periods: FirstPeriods | None,
        matched: bool,
    ) -> None:
        """Compute the spectra.

        Args:
            pairs: components along x and y at the angle zero.
            angles: by which they are turned, rad.
            target: the elastic spectrum.
            first_periods: of the building; None leaves the mean spectrum unchecked.
            matched: whether their shapes were fitted.
        """
        self._target = target.with_damping(DAMPING)
        rules = target.set_rules.of(matched)
        self._rule, self._orientation = rules.pairs, None
        if self._rule.compared == "each direction":
            periods = (None, None) if first_periods is None else (first_periods.x, first_periods.y)
            grids = [PERIODS if T_1 is None else rules.check_periods(T_1) for T_1 in periods]
            self._sets = [
                _Set(f", along {axis}", rules, T_1, grid, *_components(pairs, angles, grid, side))
                for side, (axis, T_1, grid) in enumerate(zip("xy", periods, grids, strict=True))
            ]
            return
        longest = None if first_periods is None else max(first_periods.x, first_periods.y)
        if first_periods is not None:
            rules = _over_both(rules, first_periods)
        grid = PERIODS if longest is None else rules.check_periods(longest)
        rotated = np.array(
            [
                rotated_spectra(x.acceleration, y.acceleration, x.time_step, [0.0, *grid], DAMPING, (100,))[0]
                for x, y in pairs
            ]
        )
        self._sets = [_Set(", of the maximum direction", rules, longest, grid, rotated[:, 1:], rotated[:, 0])]
        if longest is not None:
            along = [np.mean(_components(pairs, angles, grid, side)[0], axis=0) for side in (0, 1)]
            self._orientation = float(np.max(np.abs(along[0] - along[1]) / (along[0] + along[1])))

    @property
    def needed(self) -> list[float]:
        """The factors on all pairs that the rules for their mean ask for, one each."""
        found = []
        for each in self._sets:
            check = each.check(self._target, 1.0)
            if each.rules.has_zero_period:
                found.append(self._target.zero_period / float(np.mean(each.peaks)))
            if check.worst_ratio is not None:
                found.append(each.rules.least_ratio / check.worst_ratio)
        return found

    def criteria(self, factor: float) -> tuple[RuleCheck, ...]:
        """Return what the rules say."""
        checks = [each.check(self._target, factor) for each in self._sets]
        last = -2 if self._sets[0].rules.clauses.stationary else -1  # what does not depend on spectra stands there
        found = [checks[0].criteria[0]]
        for each, check in zip(self._sets, checks, strict=True):
            found += [replace(one, text=one.text + each.where) for one in check.criteria[1:last]]
        if self._orientation is not None:
            text = (
                f"largest difference of the mean spectrum along a direction from that of all components, "
                f"{self._sets[0].rules.band_text}"
            )
            detail = "sites near a fault have its normal and its parallel as directions instead"
            found.append(at_most(self._rule.orientation, text, self._rule.tolerance, self._orientation, detail))
        return (*found, *checks[0].criteria[last:])


def _components(
    pairs: Sequence[tuple[Record, Record]], angles: Sequence[float], periods: np.ndarray, side: int
) -> tuple[np.ndarray, np.ndarray]:
    """Spectra (n_pairs, n_T) and peaks (n_pairs,) of the components along x (0) or y (1), means over the angles."""
    spectra, peaks = [], []
    for x, y in pairs:
        acting = [turned(x.acceleration, y.acceleration, angle)[side] for angle in angles]
        spectra.append(np.mean([psa(motion, x.time_step, periods, DAMPING) for motion in acting], axis=0))
        peaks.append(float(np.mean([np.max(np.abs(motion)) for motion in acting])))
    return np.array(spectra), np.array(peaks)


def _over_both(rules: SetRules, first_periods: FirstPeriods) -> SetRules:
    """The rules with a band for both directions: from a multiple of the shorter first period to one of the longer."""
    both, _ = rules.over((first_periods.x, first_periods.y))
    if first_periods.shortest is None:
        return replace(both, note=f"{both.note}; modes that hold 90 % of the mass were not looked at")
    if first_periods.shortest >= both.shortest:
        return both
    note = "from the period that holds 90 % of the mass; T_1 is the longer first one"
    return replace(both, shortest=first_periods.shortest, note=note)
