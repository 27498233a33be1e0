"""Whether a law is of the wrong kind: another one explains, without any effect, what it leaves of the force.

A law that cannot follow its tests asks for effects that no rig has. So laws of other kinds are fitted to the same
tests. One of them is chosen by an information criterion, and both are held against each other on the tests for
validation, to which neither was fitted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibrate.dampers.trial import APART
from edesign.calibrate.result import Calibration, LawKind
from edesign.damper.damper import Damper
from edesign.damper.fitting import Fit, fit_forces, prediction_errors
from edesign.damper.fitting.compare import ENOUGH, comparison
from edesign.damper.fitting.fit import FOLLOWS
from edesign.damper.law import Law
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.device_cycles import Run, predicted_runs, runs_of
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import EdesignError, InputError

RIVALS = (
    *("viscous", "viscous_power", "kelvin_voigt", "maxwell", "maxwell_power", "zener"),
    *("fractional_kelvin", "fractional_zener", "generalised_maxwell", "elastic_plastic", "bouc_wen"),
)
"""Laws of every kind that are fitted within seconds: dashpots, springs beside them, relaxation by one time, by two and
by a power of the frequency, and hysteresis without rate."""

SLOW_RIVALS = ("mgmm",)
"""Laws that are asked where none of the others explains nearly all."""

VERY_STRONG = 10.0
"""Difference of BIC: evidence beyond it is very strong (Kass & Raftery 1995, J. Am. Stat. Assoc. 90, 773-795)."""

# The numbers below are chosen, not derived: they were tried on seven virtual campaigns with 1 % of noise.
_MOST_OF_IT, _ALL_OF_IT = 0.5, 0.95
"""Shares of the excess over noise in the validation tests: a rival removes the first at least; beyond the second the
slow rivals are not asked."""
_STARTS, _BRANCHES = 2, 2
"""Starts and branches of a rival's fit: what a first look can afford; more would only make rivals better."""
_APART = 0.1
"""Difference of exponents and of shares from which on they are told as signs; no verdict depends on it."""
_TOLD = 2
"""Signs that are told."""


def law_kind(
    campaign: Campaign, found: Calibration, workers: int = 1, tell: Callable[[str], None] = lambda line: None
) -> LawKind | None:
    """Ask whether the law of a campaign is of the wrong kind.

    Laws are compared at one temperature, that of most tests, as not every law knows of it.

    Args:
        campaign: tests, and the law with its parameters.
        found: by the calibration.
        workers: threads.
        tell: told what is done.

    Returns:
        None: it follows its tests within what devices of one kind may differ by (15 %, ASCE/SEI 7-22, 18.6.1.4), or
        no other law does clearly better.
    """
    if campaign.law is None or not _asked(found):
        return None
    fitted, validating = (_at_one_temperature(campaign, use) for use in ("fit", "validate"))
    if len(fitted) < 2 or not validating:
        return None
    tell("asking whether another kind of law explains what is left")
    law = LAWS[campaign.law.type]
    start = read_parameters(law, campaign.law.parameters or {})
    try:
        own = fit_forces(law, fitted, start, starts=1, workers=workers)
    except EdesignError:
        return None
    rivals: list[Fit] = []
    kind = None
    for names in (RIVALS, SLOW_RIVALS):
        rivals += [fit for name in names if name != law.name and (fit := _fit(name, fitted, workers)) is not None]
        kind = _better(own, rivals, fitted, validating, found)
        if kind is not None and kind.share > _ALL_OF_IT:
            break
    return kind


def _asked(found: Calibration) -> bool:
    """Whether the law, fitted again, does not follow the tests, or leaves what no known effect explains.

    A search that ended with its time says nothing of effects that it did not try, for which a law of many parameters
    can make up.
    """
    refit = found.errors["refit"]
    fitted = [math.sqrt(refit.tests[one.of_test]) for one in found.tests if one.use == "fit"]
    unexplained = found.ending == "complete" and found.verdict in ("partly_explained", "unexplained")
    return found.ending != "interrupted" and (float(np.mean(fitted)) > FOLLOWS or unexplained)


def _at_one_temperature(campaign: Campaign, use: str) -> tuple[DamperTest, ...]:
    fitted = [test.temperature_C for test in campaign.used_for("fit")]
    near = [sum(abs(one - other) <= APART for other in fitted) for one in fitted]
    degrees = fitted[int(np.argmax(near))]
    return tuple(t for t in campaign.tests if t.use == use and abs(t.temperature_C - degrees) <= APART)


def _fit(name: str, tests: Sequence[DamperTest], workers: int) -> Fit | None:
    law = LAWS[name]
    try:
        return fit_forces(law, tests, starts=_STARTS, branches=_BRANCHES if law.branch else 1, workers=workers)
    except EdesignError:  # a law that cannot be fitted explains nothing
        return None


def _better(
    own: Fit, rivals: Sequence[Fit], fitted: Sequence[DamperTest], validating: Sequence[DamperTest], found: Calibration
) -> LawKind | None:
    if not rivals:
        return None
    rival = comparison([own, *rivals], [None] * (1 + len(rivals))).nearest.fit
    evidence = _bic_above(own, rival)
    if rival is own or evidence < VERY_STRONG:
        return None
    before, after = (float(np.mean(list(prediction_errors(one, validating).values()))) for one in (own, rival))
    floor = found.noise_floor
    share = (before - after) / max(before - floor, 1e-300)
    if share < _MOST_OF_IT or after > ENOUGH * found.errors["corrected"].validate:
        return None
    return LawKind(
        rival=rival.law.name,
        title=rival.law.title,
        left=own.mean_rms_error,
        rival_left=rival.mean_rms_error,
        share=min(share, 1.0),
        bic=evidence,
        signs=tuple(_signs(own, fitted))[:_TOLD],
    )


def _bic_above(own: Fit, rival: Fit) -> float:
    """BIC of a law above that of another one, with as many independent errors as the law itself leaves.

    Errors of a law that misses the shape of the loops hang together over half a cycle; they are far fewer than those of
    one that leaves white noise, and the evidence is not more than they carry.
    """
    count = max(own.independent, 2.0)
    squares = [float(np.mean([error**2 for error in fit.rms_error.values()])) for fit in (own, rival)]
    parameters = [len(fit.free) + len(fit.at_bound) for fit in (own, rival)]
    return count * math.log(squares[0] / max(squares[1], 1e-30)) + (parameters[0] - parameters[1]) * math.log(count)


def _signs(own: Fit, tests: Sequence[DamperTest]) -> Iterator[str]:
    """How stiffness and damping of steady cycles differ from those of the law, fitted again, in the same motions."""
    pairs = [pair for test in tests for pair in _pairs(own.law, own, test)]
    if not pairs:
        return
    measured, predicted = (_Means.of([pair[i] for pair in pairs]) for i in (0, 1))
    shares = [float(np.mean(one.storage / one.size)) for one in (measured, predicted)]
    if abs(shares[0] - shares[1]) > _APART:
        own_share, law_share = (f"{100.0 * share:z.0f} %" for share in shares)
        yield f"k' is {own_share} of the dynamic stiffness |k*|, that of the law {law_share}"
    for over in ("frequency", "amplitude"):
        for part, name in (("storage", "k'"), ("loss", "k''")):
            one, other = measured.exponent(part, over), predicted.exponent(part, over)
            if one is not None and other is not None and abs(one - other) > _APART:
                yield f"{name} goes with the {over} to the power {one:z.2f}, that of the law {other:z.2f}"


def _pairs(law: Law, own: Fit, test: DamperTest) -> list[tuple[Run, Run]]:
    try:
        predicted = predicted_runs(test, Damper(law, own.values_at(test.temperature_C)))
        return list(zip(runs_of(test), predicted, strict=True))
    except InputError:  # no steady cycles
        return []


@dataclass(frozen=True)
class _Means:
    """Means of runs (n,) each: frequency in Hz, amplitude in m, k' and k'' in N/m."""

    frequency: np.ndarray
    amplitude: np.ndarray
    storage: np.ndarray
    loss: np.ndarray

    @staticmethod
    def of(runs: Sequence[Run]) -> _Means:
        parts = [(r.frequency, r.loops.amplitude, r.storage_stiffness, r.loss_stiffness) for r in runs]
        return _Means(*(np.array([float(np.mean(part[i])) for part in parts]) for i in range(4)))

    @property
    def size(self) -> np.ndarray:
        """|k*|."""
        return np.hypot(self.storage, self.loss)

    def exponent(self, part: str, over: str) -> float | None:
        """Slope of the logarithm of k' or k'' over that of frequency or amplitude, the other one held; None: it cannot
        be told, or there is none of that part.
        """
        values = getattr(self, part)
        if np.any(values < _APART * self.size):
            return None
        names = [name for name in ("frequency", "amplitude") if _varies(getattr(self, name))]
        if over not in names or values.size <= len(names):
            return None
        rows = np.column_stack([np.ones(values.size), *(np.log(getattr(self, name)) for name in names)])
        if np.linalg.matrix_rank(rows) < rows.shape[1]:
            return None
        return float(np.linalg.lstsq(rows, np.log(values), rcond=None)[0][1 + names.index(over)])


def _varies(values: np.ndarray) -> bool:
    return float(np.max(values)) > (1.0 + 2.0 * _APART) * float(np.min(values))
