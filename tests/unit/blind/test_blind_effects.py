"""Every form of every hidden effect: it changes what is recorded, by as much as was asked for, and again the same."""

from __future__ import annotations

import numpy as np
import pytest

from blind import law
from blind.effects import EFFECTS
from blind.effects.base import Effect
from blind.laboratory import observe, predicted
from blind.plan import UNLISTED
from blind.programme import Trial
from blind.signals import SIGNALS
from blind.size import CLOSE, Unreachable, fit_size

FORMS = [form for forms in EFFECTS.values() for form in forms] + list(UNLISTED.values())
TARGET = 0.003


def short_tests() -> list[Trial]:
    """Six tests of 3 s, two of them to validate, at six temperatures."""
    rng = np.random.default_rng(11)
    t = np.arange(1801) / 600.0
    kinds = ["swelling", "random", "sine", "random", "earthquake", "staircase"]
    uses = ["fit", "fit", "validate", "fit", "validate", "fit"]
    warmth = [20.0, 25.0, 30.0, 35.0, 33.0, 22.0]
    return [
        Trial(i, 6, use, "", SIGNALS[kind](rng, t, 6.0)[0], 1.0 / 600.0, 2, temperature, 300.0)
        for i, (kind, use, temperature) in enumerate(zip(kinds, uses, warmth, strict=True))
    ]


TESTS = short_tests()


def sized(form: type[Effect]) -> tuple[Effect, float]:
    """The first draw that can reach the target, which it says it has."""
    for seed in range(5, 15):
        effect = form(np.random.default_rng(seed), TESTS)
        try:
            return effect, fit_size(law.TABLE_4_2, TESTS, effect, TARGET)
        except Unreachable:
            continue
    raise AssertionError("no draw reaches the target")


@pytest.mark.parametrize("form", FORMS, ids=lambda form: f"{form.name}-{form.form}")
def test_size_hits_its_target(form: type[Effect]) -> None:
    """NRMS of the tests to validate at the samples, computed here anew: within the tolerance of the search."""
    effect, said = sized(form)
    x, force = observe(law.TABLE_4_2, TESTS, [effect])
    error = power = 0.0
    for test, u, f, alone in zip(TESTS, x, force, predicted(law.TABLE_4_2, TESTS, x), strict=True):
        assert u.shape == f.shape == test.x.shape
        assert np.all(np.isfinite(f)) and np.all(np.isfinite(u))
        if test.use == "validate":
            error += np.sum((f - alone)[:: test.every] ** 2)
            power += np.sum(f[:: test.every] ** 2)
    assert error / power == pytest.approx(TARGET, rel=1.1 * CLOSE)
    assert said == pytest.approx(error / power, rel=1e-3)
    assert 0.0 < effect.size <= effect.most
    assert all(np.isfinite(value) for value, _ in effect.true_parameters().values())


@pytest.mark.parametrize(
    "form", [form for form in FORMS if form.joint is Effect.joint], ids=lambda form: f"{form.name}-{form.form}"
)
def test_same_draw_same_effect(form: type[Effect]) -> None:
    tests = [test for test in TESTS if form.memory or test.use == "validate"]
    first, second = (form(np.random.default_rng(9), TESTS) for _ in range(2))
    assert first.true_parameters() == second.true_parameters()
    for one, other in zip(observe(law.TABLE_4_2, tests, [first]), observe(law.TABLE_4_2, tests, [second]), strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_every_effect_has_forms_of_one_name_and_kind() -> None:
    assert len(EFFECTS) == 20 and len(UNLISTED) >= 8
    assert not set(EFFECTS) & set(UNLISTED)
    for name, forms in EFFECTS.items():
        assert 3 <= len(forms) <= 4
        assert {form.name for form in forms} == {name}
        assert len({form.kind for form in forms}) == 1
        assert len({form.form for form in forms}) == len(forms)
    assert {form.kind for form in FORMS} == {"damper", "rig", "instrument"}


def test_effects_of_two_places_act_together() -> None:
    """Force gain over friction over a damper with a spring beside it: each once, in the order of the line."""
    hardening, friction, gain = (
        EFFECTS[name][0](np.random.default_rng(2), TESTS) for name in ("hardening", "friction", "gain")
    )
    alone = observe(law.TABLE_4_2, TESTS, [hardening, friction])[1]
    both = observe(law.TABLE_4_2, TESTS, [gain, friction, hardening])[1]
    factor = 1.0 + gain.true_parameters()["error"][0]
    since = gain.true_parameters()["since"][0]
    for test, a, b in zip(TESTS, alone, both, strict=True):
        assert b == pytest.approx(a * (factor if test.index >= since else 1.0), rel=1e-12, abs=1e-12)
