"""The test that separates two look-alikes best, where their forces are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from irregular_motion import STIFFNESS, U, motion, sizes, trial

from edesign.calibrate.dampers.effects import hardening
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.next_test import next_test
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import Evidence, Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import Candidate
from edesign.calibrate.search.selection import Adopted, Selection
from edesign.damper.laws import LAWS


def _models(alike: bool) -> tuple[DamperProblem, Selection]:
    """A spring with a cubic one beside it, and the same with a fifth power, equal at the largest deformation so far."""
    size = sizes()
    tests = tuple(trial(motion(order + 1), order) for order in range(2))
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 1.0}, tests, size)
    form = candidate_of(hardening.Power(), size, Left())
    assert form is not None

    def judged(power: float) -> Judged:
        model = Model(solid, (1.0,) * 2, (form,), held=True)
        x = model.coordinates(None, [(form, np.array([0.5 * STIFFNESS, power]))])
        return Judged(fit(model, x, most_steps=0))

    cubic, fifth = judged(3.0), judged(5.0)
    bare = Judged(fit(Model(solid, (1.0,) * 2, held=True), np.empty(0)))
    evidence = Evidence(0.9, 1.4, 99.0, 2, 2)
    candidate: Candidate = cubic.fitted.model.effects[0]
    others = {"fifth": fifth, "refit": bare} if alike else {"refit": bare}
    return solid, Selection(bare, bare, cubic, (Adopted(candidate, cubic.fitted.parts[0][1], evidence, bare, others),))


@pytest.mark.parametrize("workers", [1, 2])
def test_two_powers_differ_most_in_the_largest_cycles(workers: int) -> None:
    problem, found = _models(alike=True)
    told = next_test(problem, found, workers)
    assert told is not None and told.separates == ("hardening", "fifth")
    # a sine of 1.3 times the largest deformation, force s + s^3 / 2 against s + s^5 / 2: means of powers of a
    # sine over a period; half a cycle of twelve grows, and there is a dashpot of next to nothing
    s = 1.3 * np.sin(2.0 * np.pi * (np.arange(1000) + 0.5) / 1000.0)
    expected = np.sum((0.5 * s**3 - 0.5 * s**5) ** 2) / np.sum((s + 0.5 * s**3) ** 2)
    assert told.difference == pytest.approx(expected, rel=0.05)
    largest = problem.sizes.displacement
    assert told.text.startswith(f"12 cycles of {1e3 * 1.3 * largest:.3g} mm")
    assert told.difference > told.largest > 0.0 and largest > 0.5 * U


def test_a_look_alike_that_is_the_law_fitted_again_asks_for_no_test() -> None:
    assert next_test(*_models(alike=False)) is None
