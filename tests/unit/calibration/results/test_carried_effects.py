"""Effects as law files carry them: the ordinary path of a damper gives the force of the model, form by form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.law_file import carried, law_file
from edesign.calibration.results.result import LawFile
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.damper import Damper
from edesign.damper.temperature import GammaT, at
from edesign.estimation.noise import Noise

BETWEEN_TESTS = ("mullins", "degradation", "self_heating", "pinching")
"""Effects that remember earlier tests: the first test alone begins as a law file has it."""


EITHER = ("friction.coulomb", "friction.presliding", "friction.stribeck", "friction.loaded")
"""Forms of the rig that law files carry if they are of the damper."""


@pytest.mark.parametrize("law", ["kelvin_voigt", "mgmm", "viscous_power"])
def test_every_carried_form_gives_the_force_of_the_model(law):
    tests = problem(law, tests=5, degrees=(20.0, 30.0), threads=1)
    base = [one.centre for one in tests.base]
    own = GammaT() if law == "mgmm" else None
    seen = set()
    for effect in tests.effects:
        values = np.array(effect.starts[0])
        # of what may be of the damper too, the force by the reading of the search is that of the law file
        of_damper = effect if effect.kind == "damper" else replace(effect, data=effect.data.twin)
        found = carried(tests, of_damper, values) if of_damper.data is not None else None
        if found is None or effect.name == "extremes" or found.brace:  # in series: a project has it
            continue
        chosen = (0,) if effect.name in BETWEEN_TESTS else (0, 1)
        if effect.name == "ageing":  # as it is in the last test
            chosen = (4,)
        (forces,) = tests.model((effect,), ("fit", "validate")).forces(np.array([*base, *values]))
        for i in chosen:
            one = tests.experiments[i]
            law_values, _ = at(tests.law, tests.declared, one.temperature, found.temperature or own)
            damper = Damper(tests.law, law_values, 0.0, found.effects, one.temperature)
            motion = one.motion
            expected = forces[i]
            got = damper.force(motion.time, motion.displacement, motion.velocity, "fixed", tests.prediction._length)
            # Ferry's shift with p2 = 1e9 K is an exponential up to 1e-8 of the temperature
            assert got == pytest.approx(expected, abs=1e-7 * abs(expected).max()), (effect.label, i)
        seen.add(effect.label)
    assert {"payne.whole", "hardening.power", "ageing.linear", "temperature_law.exponential", *EITHER} <= seen
    assert ("offset.constant" in seen) == (law == "viscous_power")
    if law != "viscous_power":
        assert "payne.whole_dashpots" in seen
        assert ("temperature_law.gamma" if law == "mgmm" else "temperature_law.shift") in seen


def test_what_no_law_file_has_is_not_carried():
    tests = problem("mgmm", degrees=(20.0, 30.0), threads=1)
    shift = next(one for one in tests.effects if one.label == "temperature_law.shift_in_place")
    assert carried(tests, shift, np.array(shift.starts[0])) is None


def with_a_shift_in_place(validating: float) -> LawFile:
    """The law file of tests of a law that shifts in time with temperature; the last one, 28 degC away, otherwise so."""
    tests = problem("mgmm", degrees=(20.0, 30.0, 24.0, 48.0), threads=1)
    shift = next(one for one in tests.effects if one.label == "temperature_law.shift_in_place")
    values = np.array([*(one.centre for one in tests.base), *shift.starts[0]])
    (made,) = tests.model((shift,), ("fit", "validate")).forces(values)
    (plain,) = tests.model((), ("fit", "validate")).forces(values[: -len(shift.starts[0])])
    made[-1] = plain[-1] + validating * (made[-1] - plain[-1])
    tests = tests.with_experiments([replace(e, force=f) for e, f in zip(tests.experiments, made, strict=True)])
    fitter, noise = unbounded(tests, SETTINGS), Noise.white([100.0] * 3)
    final = fitter.fit((shift,), values, noise)
    refit = fitter.fit((), values[: len(tests.base)], noise)
    assert final is not None and refit is not None
    return law_file(tests, final, refit)


def test_where_the_rest_predicts_worse_the_law_file_has_the_refitted_law():
    found = with_a_shift_in_place(1.0)
    assert (found.stage, found.lacking) == ("refit", ("temperature_law.shift_in_place",))
    assert "the validation tests are predicted worse" in found.withheld


def test_where_the_rest_predicts_better_the_law_file_says_what_it_lacks():
    found = with_a_shift_in_place(0.0)  # no shift in the test that validates: the law of the others is the right one
    assert (found.stage, found.lacking, found.withheld) == ("corrected", ("temperature_law.shift_in_place",), "")
    assert found.validate < 1e-6
