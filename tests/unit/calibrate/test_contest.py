"""Models that are fitted side by side, against least squares."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of

from edesign.calibrate.fit import fit
from edesign.calibrate.problem import Part, Use
from edesign.calibrate.search import contest
from edesign.calibrate.search.screening import screen


class _Rough(LinearProblem):
    """Off by a half everywhere."""

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        return [None if one is None else one + 0.5 for one in super().predict(base, parts, uses)]


class _Exact(LinearProblem):
    @cached_property
    def rough(self) -> LinearProblem:  # type: ignore[override]
        return _Rough(self.matrices, self.columns, self.measured, self.uses)


@pytest.mark.parametrize("most", [0, 6])  # fitted on from where they are; fitted well from the start
def test_models_ranked_by_rough_predictions_are_fitted_to_exact_ones(
    most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = linear(seed=7, hidden={"x": 3.0})
    problem = _Exact(given.matrices, given.columns, given.measured, given.uses)
    fitted = fit(model_of(problem), model_of(problem).coordinates())
    exact = fit(model_of(given), model_of(given).coordinates())
    monkeypatch.setattr(contest, "_WELL_FITTED", max(most, 1))
    monkeypatch.setattr(contest, "_HOPELESS", np.inf)
    signatures = screen(fitted, problem.candidates([]))
    expected = {s.candidate.name: s for s in screen(exact, given.candidates([]))}
    found = contest.fit_best(signatures)
    assert found
    for judged in found:
        like = expected[judged.fitted.model.effects[0].name]
        assert judged.fitted.model.problem is problem
        # of a linear problem the screening's estimate is exact but for the belief in the declared parameters
        assert judged.fitted.chi2 == pytest.approx(exact.chi2 - like.gain, rel=1e-3)
