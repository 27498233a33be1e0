"""What a form is called is true on both sides of zero that the bounds of its size allow: a walk through all forms."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import forms as damper_forms
from edesign.calibration.effect_list import _USUAL, _settings
from edesign.calibration.properties import arrangement, reading
from edesign.calibration.results.law_file import form_in_law_files, parameters_in_law_files
from edesign.calibration.search.problem import Effect
from edesign.calibration.structures.effects import forms as structure_forms
from edesign.estimation.model import PredictionError

EVERY: list[tuple[Any, Any]] = [
    *((form, _USUAL) for form in (*damper_forms(_USUAL), *arrangement.FORMS, *reading.FORMS)),
    *((form, sizes) for sizes in _settings() for form in structure_forms(sizes)),
]
MORE = re.compile(r"\b(harden|stiffen|more stiffness|second stiffness|contact)")
LESS = re.compile(r"\b(soften|degradation|less stiffness|opening|slips)")
PROBLEM = problem("kelvin_voigt", tests=5, degrees=(20.0, 35.0, 30.0, 25.0, 30.0))
DIRECTED = [
    effect
    for effect in PROBLEM.effects
    if effect.kind == "damper"
    and effect.parameters
    and (MORE.search(words := effect.data.form.title) or LESS.search(words))
]


def meaning(form: Any, name: str) -> str:
    known = parameters_in_law_files(form) if isinstance(form, EffectForm) and form_in_law_files(form) else {}
    return known[name].meaning if name in known else form.meanings.get(name, "")


@pytest.mark.parametrize(("form", "sizes"), EVERY, ids=lambda one: getattr(one, "label", ""))
def test_a_size_below_zero_has_words(form: Any, sizes: Any) -> None:
    """Title and signature for it, or a meaning that says what below zero is: a direction, as of a zero or a lag."""
    sized = form.parameters(sizes)[:1]
    if sized and sized[0].lower < 0.0:
        assert form.negative is not None or "negative" in meaning(form, sized[0].name)
    else:
        assert form.negative is None


def strength(effect: Effect, sign: float) -> float:
    """Root mean square of the force in the tests fitted to, of that without an effect, by its first start."""
    values = np.array(effect.starts[0])
    values[0] = sign * abs(values[0])
    base = np.array([one.centre for one in PROBLEM.base])
    (found,) = PROBLEM.model((effect,)).predict(np.concatenate((base, values))[np.newaxis])
    assert not isinstance(found, PredictionError)
    power = sum(float(one @ one) for one in found)
    return float(np.sqrt(power / sum(float(one @ one) for one in PROBLEM.model(()).measured)))


@pytest.mark.parametrize("effect", DIRECTED, ids=lambda one: one.label)
def test_what_is_called_hardening_makes_the_force_larger_and_softening_smaller(effect: Effect) -> None:
    """The force of a Kelvin-Voigt damper with a positive size, and with a negative one where there is such."""
    form = effect.data.form
    more, less = MORE.search(form.title), LESS.search(form.title)
    assert bool(more) != bool(less)
    sign = 1.0 if more else -1.0
    if effect.name == "mullins" and effect.form.partition("_")[0] in ("path", "elastic"):
        sign = -sign  # the virgin specimen is stronger, and the law is that of the worn one
    assert sign * (strength(effect, 1.0) - 1.0) > 1e-6
    if form.negative is not None:
        assert (LESS if more else MORE).search(effect.data.words([-1.0]).title)
        assert not (MORE if more else LESS).search(effect.data.words([-1.0]).title)
        assert sign * (strength(effect, -1.0) - 1.0) < -1e-6
