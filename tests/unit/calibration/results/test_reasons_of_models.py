"""Why a model that is ahead of the one that stands is not adopted."""

from __future__ import annotations

from curve_problem import CUBIC, CurveProblem

from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.models import Posterior
from edesign.calibration.search.search import Search
from edesign.calibration.search.settings import SETTINGS


def test_a_model_that_is_surely_ahead_is_not_said_to_be_ahead_by_less_than_the_rule_asks() -> None:
    """Where validation tests put another law in the place of that beside which the search judged."""
    found = Search(CurveProblem(truth=((CUBIC, (0.2,)),)), SETTINGS).run()
    fitter, models = unbounded(found.base.problem, SETTINGS), (found.base, found.best)
    assert fitter.compare(found.best, found.base).sure
    why = Posterior(fitter, found.base, models, judged_by="the law as declared").why_not(1)
    assert why == "not surely better than the law as declared, beside which the search judged it"
    assert Posterior(fitter, found.best, models[::-1], judged_by="the law as declared").why_not(1) == ""
