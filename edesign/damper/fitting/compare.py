"""Several laws fitted to the same tests: which one suffices, if one does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.damper.fitting.cross_validation import CrossValidation, cross_validate
from edesign.damper.fitting.fit import FOLLOWS, Fit
from edesign.damper.fitting.forces import fit_forces
from edesign.damper.law import Law

if TYPE_CHECKING:
    from edesign.damper.testing.measured_histories import DamperTest

ENOUGH = 1.1
"""A law is as near as the best one where its error on held-out tests is at most this times that one's."""


@dataclass(frozen=True)
class Compared:
    """A law among others.

    Attributes:
        fit: to all tests.
        held_out: cross-validation; None where it was not asked for.
        aic, bic: Akaike's and Schwarz's criterion above the least of the laws compared.
    """

    fit: Fit
    held_out: CrossValidation | None
    aic: float
    bic: float

    @property
    def parameters(self) -> int:
        """Number of parameters that were fitted, those at bounds included."""
        return len(self.fit.free) + len(self.fit.at_bound)


@dataclass(frozen=True)
class Comparison:
    """Laws fitted to the same tests.

    Attributes:
        laws: in the order given.
        independent: number of independent errors that the criteria count.
    """

    laws: tuple[Compared, ...]
    independent: float

    @property
    def nearest(self) -> Compared:
        """The law of the fewest parameters that predicts held-out tests nearly as well as the best law does.

        Without cross-validation, the law of the least BIC.
        """
        if any(item.held_out is None for item in self.laws):
            return min(self.laws, key=lambda item: item.bic)
        errors = {id(item): item.held_out.mean for item in self.laws if item.held_out is not None}
        good = [item for item in self.laws if errors[id(item)] <= ENOUGH * min(errors.values())]
        return min(good, key=lambda item: (item.parameters, errors[id(item)]))

    @property
    def sufficient(self) -> Compared | None:
        """The nearest law if it follows the tests, also those that are held out; None: none of the laws does."""
        nearest = self.nearest
        held_out = nearest.held_out is None or math.sqrt(nearest.held_out.mean) <= FOLLOWS
        return nearest if nearest.fit.follows and held_out else None


def compare_laws(
    laws: Sequence[Law],
    tests: Sequence[DamperTest],
    *,
    starts_of: Mapping[str, Mapping[str, float]] | None = None,
    held_out: bool = True,
    folds: int | None = None,
    **options: Any,
) -> Comparison:
    """Fit several laws to the same tests.

    Args:
        tests: with measured forces.
        held_out: whether to cross-validate.
        folds: as of cross_validate.
        **options: of fit_forces.
        options: of fit_forces.
    """
    known = dict(starts_of or {})
    fits = [fit_forces(law, tests, known.get(law.name), **options) for law in laws]
    validations = [
        cross_validate(law, tests, known.get(law.name), folds=folds, whole=fit, **options) if held_out else None
        for law, fit in zip(laws, fits, strict=True)
    ]
    return comparison(fits, validations)


def comparison(fits: Sequence[Fit], validations: Sequence[CrossValidation | None]) -> Comparison:
    """Compare fits to the same tests.

    Args:
        fits: of the laws.
        validations: of each fit; None: it was not cross-validated.

    Source: AIC = N ln(S / N) + 2 p, BIC = N ln(S / N) + p ln N (Burnham & Anderson, 2002, section 2.3), S / N the mean
    square of errors relative to the tests' forces; N counts the independent errors of the best fit, not samples.
    """
    best = min(fits, key=lambda fit: fit.cost)
    independent = max(best.independent, 2.0)
    scores = []
    for fit in fits:
        count = len(fit.free) + len(fit.at_bound) + 1  # and the variance
        misfit = independent * math.log(max(float(np.mean([e**2 for e in fit.rms_error.values()])), 1e-30))
        scores.append((misfit + 2.0 * count, misfit + count * math.log(independent)))
    least = [min(score[i] for score in scores) for i in (0, 1)]
    return Comparison(
        tuple(
            Compared(fit, validation, score[0] - least[0], score[1] - least[1])
            for fit, validation, score in zip(fits, validations, scores, strict=True)
        ),
        independent,
    )
