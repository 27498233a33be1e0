"""What every damper law must do, whatever its equation: true tangents, steps that leave no trace, exact steps that
agree with the integrated equations, oddness, no influence of sampling, bounds of parameters.

Smooth random motions from rest (damper_motions); the dampers are those of damper_examples.
"""

from __future__ import annotations

import re
from math import inf

import numpy as np
import pytest
from damper_examples import EXAMPLES
from damper_motions import Motion

from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.errors import InputError

Array = np.ndarray

BOTH = (
    "kelvin_voigt",
    "zener",
    "generalised_maxwell",
    "fractional_kelvin",
    "fractional_zener",
    "viscous",
    "maxwell",
    "fractional_maxwell",
    "linearised",
    "bouc_wen",
    "modified_bouc_wen",
    "maxwell_power",
    "mgmm",
)
"""Laws with an exact step and differential equations."""
TIGHT = 1e-10
"""Tolerance of SUNDIALS where its error would hide what is looked at."""


def damper(law: str, **changes: float) -> CoreDamper:
    return Damper(LAWS[law], EXAMPLES[law] | changes).core


def force(law: str, motion: Motion, method: str = "best", tolerance: float = 1e-6, **changes: float) -> Array:
    t = motion.time
    return damper(law, **changes).force(t, motion.u(t), motion.v(t), method, tolerance)


def test_every_law_has_an_example() -> None:
    assert set(EXAMPLES) == set(LAWS)
    for law in EXAMPLES:
        peak = np.max(np.abs(force(law, Motion(7e-3, seed=1))))
        assert 50e3 < peak < 300e3, law  # N, of the size they are meant to be


def difference(
    core: CoreDamper,
    state: Array,
    h: float,
    before: tuple[float, float],
    after: tuple[float, float],
    unknown: int,
    width: float,
) -> float:
    """Central difference of the force at the end of a step, to its deformation (0) or velocity (1)."""
    sides = []
    for change in (width, -width):
        moved = (after[0] + change, after[1]) if unknown == 0 else (after[0], after[1] + change)
        sides.append(core.step(state, h, before, moved, tolerance=TIGHT)[1])
    return (sides[0] - sides[1]) / (2.0 * width)


@pytest.mark.parametrize("law", LAWS)
def test_tangent_and_repeated_steps(law: str) -> None:
    """Derivatives of a step against central differences, at states that a random history reaches; every trial from a
    state gives the same to the last bit, whatever was tried before, and does not touch that state.

    Differences over two widths show where there is a kink within reach (yielding, a reversal at the end of the step, a
    dashpot at rest) and no derivative to compare with; these must be few.
    """
    core, rng = damper(law), np.random.default_rng(20)
    state, before = core.start(), (0.0, 0.0)
    kinks, compared, h = 0, 0, 0.01
    for _ in range(60):
        after = (before[0] + rng.uniform(-2e-3, 2e-3), rng.uniform(-0.3, 0.3))
        if abs(after[0]) > 12e-3:
            after = (0.9 * before[0], after[1])
        committed = state.copy()
        trial, value, slopes = core.step(state, h, before, after, tolerance=TIGHT)
        stiffness = max(abs(value) / 5e-3, abs(slopes[0]), abs(slopes[1]) / h)
        for i, width in enumerate((2e-7, 2e-7 / h)):
            wide, narrow = (difference(core, state, h, before, after, i, w) for w in (width, 0.4 * width))
            allowed = 1e-4 * stiffness * (1.0 if i == 0 else h)
            if abs(wide - narrow) > 0.3 * allowed:
                kinks += 1
                continue
            compared += 1
            assert slopes[i] == pytest.approx(narrow, abs=allowed, rel=0.0)
        again = core.step(state, h, before, after, tolerance=TIGHT)
        np.testing.assert_array_equal(again[0], trial)
        assert again[1:] == (value, slopes)
        np.testing.assert_array_equal(state, committed)
        state, before = trial, after
    assert kinks < 0.15 * compared


@pytest.mark.parametrize("law", LAWS)
def test_exact_step_offers_what_it_should(law: str) -> None:
    motion = Motion(8e-3, seed=2, duration=2.0)
    if law not in BOTH:
        with pytest.raises(CoreError, match="state"):
            force(law, motion, "ode")
        return
    exact = force(law, motion)
    integrated = force(law, motion, "ode", TIGHT)
    np.testing.assert_allclose(exact, integrated, atol=1e-8 * np.max(np.abs(integrated)), rtol=0.0)
    # SUNDIALS holds the error of each of its steps to its tolerance, here 1e-6; those of the steps within a relaxation
    # time add up
    usual = force(law, motion, "ode")
    np.testing.assert_allclose(usual, integrated, atol=5e-5 * np.max(np.abs(integrated)), rtol=0.0)


@pytest.mark.parametrize("law", sorted(set(LAWS) - {"asymmetric_viscous", "buckling_restrained"}))
def test_odd(law: str) -> None:
    motion = Motion(8e-3, seed=4, duration=2.0)
    t, u, v = motion.time, motion.u(motion.time), motion.v(motion.time)
    core = damper(law)
    # exact steps: the same operations with other signs
    np.testing.assert_array_equal(core.force(t, -u, -v), -core.force(t, u, v))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("step", [0.002, 0.02])
def test_sampling_of_a_path_does_not_matter(law: str, step: float) -> None:
    """The same cubics given by twice as many samples."""
    motion = Motion(8e-3, seed=6, duration=2.0, rate=1.0 / step)
    t, u, v = motion.time, motion.u(motion.time), motion.v(motion.time)
    finer = np.sort(np.append(t, 0.5 * (t[1:] + t[:-1])))
    finer_u, finer_v = np.empty_like(finer), np.empty_like(finer)
    finer_u[::2], finer_v[::2] = u, v
    finer_u[1::2] = 0.5 * (u[1:] + u[:-1]) + step / 8.0 * (v[:-1] - v[1:])
    finer_v[1::2] = 1.5 * (u[1:] - u[:-1]) / step - 0.25 * (v[1:] + v[:-1])
    core = damper(law)
    whole, halves = core.force(t, u, v, tolerance=1e-8), core.force(finer, finer_u, finer_v, tolerance=1e-8)[::2]
    np.testing.assert_allclose(halves, whole, atol=1e-6 * np.max(np.abs(whole)), rtol=0.0)


def outside(parameter: Parameter) -> list[float]:
    """Values that are not allowed."""
    found = []
    if parameter.lower > -inf:
        found.append(parameter.lower - 1.0)
        if not parameter.lower_allowed:
            found.append(parameter.lower)
    if parameter.upper < inf:
        found.append(parameter.upper + 1.0)
        if not parameter.upper_allowed:
            found.append(parameter.upper)
    return found


REFUSED = [
    (law.name, parameter.name, value)
    for law in LAWS.values()
    for parameter in law.all_parameters(EXAMPLES[law.name])
    for value in outside(parameter)
]


@pytest.mark.parametrize("law, name, value", REFUSED, ids=[f"{law}-{name}={value:g}" for law, name, value in REFUSED])
def test_refused_parameters_are_named(law: str, name: str, value: float) -> None:
    values = LAWS[law].complete(EXAMPLES[law]) | {name: value}
    text = rf"\b{re.escape(name)} = {re.escape(format(value, 'g'))}(\s|$)"
    with pytest.raises(InputError, match=text):
        LAWS[law].complete(values)
    with pytest.raises(CoreError, match=text):
        CoreDamper(law, list(values.values()))


@pytest.mark.parametrize("law", LAWS)
def test_what_is_no_number_or_missing_is_refused(law: str) -> None:
    values = LAWS[law].complete(EXAMPLES[law])
    for name in EXAMPLES[law]:
        for value in (float("nan"), inf):
            with pytest.raises(InputError, match=rf"\b{name}\b"):
                LAWS[law].complete(values | {name: value})
            with pytest.raises(CoreError):
                CoreDamper(law, list((values | {name: value}).values()))
    with pytest.raises(CoreError, match="needed|parameters"):
        CoreDamper(law, [])
    with pytest.raises(InputError, match="`no_such`.*E-LAW-02"):
        LAWS[law].complete(values | {"no_such": 1.0})
