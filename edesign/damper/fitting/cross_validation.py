"""How well a law predicts tests that it was not fitted to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.damper.fitting.fit import Fit
from edesign.damper.fitting.forces import core_predict, fit_forces
from edesign.damper.fitting.loading import Predict, prepare
from edesign.damper.fitting.solve import Progress
from edesign.damper.fitting.starts import with_starts
from edesign.damper.law import Law
from edesign.damper.testing.nrms import nrms
from edesign.errors import InputError

if TYPE_CHECKING:
    from edesign.damper.testing.measured_histories import DamperTest


@dataclass(frozen=True)
class CrossValidation:
    """Errors of predictions of tests that were left out of the fit.

    Attributes:
        nrms: of each test when it was held out: squared errors over squared measurements, as a ratio.
        folds: how many fits.
    """

    nrms: dict[str, float]
    folds: int

    @property
    def mean(self) -> float:
        """Mean over the tests."""
        return float(np.mean(list(self.nrms.values())))

    @property
    def worst(self) -> tuple[str, float]:
        """The test that is predicted worst, and its error."""
        name = max(self.nrms, key=lambda key: self.nrms[key])
        return name, self.nrms[name]


def prediction_errors(fit: Fit, tests: Sequence[DamperTest], predict: Predict | None = None) -> dict[str, float]:
    """Return the NRMS (ratio) of a fitted law on tests, by their names.

    Args:
        tests: with measured forces.
        predict: force of parameters under a loading; None: the law in the core.
    """
    force = predict or core_predict(fit.law)
    loadings = with_starts(prepare(tests), tests, fit.law, fit.values_at, force)
    return {
        loading.name: nrms(force(fit.values_at(loading.temperature_C), loading)[loading.first :], loading.judged_force)
        for loading in loadings
    }


def cross_validate(
    law: Law,
    tests: Sequence[DamperTest],
    start: Mapping[str, float] | None = None,
    *,
    folds: int | None = None,
    whole: Fit | None = None,
    predict: Predict | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CrossValidation:
    """Leave tests out in turn, fit to the others, predict those left out.

    Args:
        tests: with measured forces.
        start: as of fit_forces.
        folds: parts of the tests that are left out in turn, test i in part i modulo `folds`; None: each test alone.
        whole: the fit to all tests, whose values are then the start: folds differ by little, and one descent does.
        predict: as of fit_forces.
        progress: of every fold that is done.
        **options: of fit_forces.
        options: of fit_forces.

    Raises:
        InputError: there are too few tests, or as of fit_forces.
    """
    count = len(tests) if folds is None else folds
    if len(tests) < 2:
        raise InputError(f"cross-validation: {len(tests)} test cannot be left out; at least 2 are needed [E-FIT-01]")
    if not 2 <= count <= len(tests):
        raise InputError(
            f"cross-validation: {count} folds of {len(tests)} tests; 2 to {len(tests)} are possible [E-FIT-01]"
        )
    begin = dict(start or {})
    if whole is not None:
        begin |= whole.values
        options = {**options, "starts": 1}
    errors: dict[str, float] = {}
    for fold in range(count):
        kept = [test for i, test in enumerate(tests) if i % count != fold]
        out = [test for i, test in enumerate(tests) if i % count == fold]
        try:
            found = fit_forces(law, kept, begin, predict=predict, **options)
        except InputError as error:
            raise InputError(f"cross-validation without {', '.join(test.name for test in out)}: {error}") from error
        errors |= prediction_errors(found, out, predict)
        if progress is not None:
            progress("held out", fold + 1, count)
    return CrossValidation({test.name: errors[test.name] for test in tests}, count)
