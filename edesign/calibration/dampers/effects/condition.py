"""Declared conditions of the tests, as gas pressure, voltage or axial load, and what of the damper depends on them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.effects import gas_spring, viscous
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, ForceChannel, LawParameters, Mechanism, Placement
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Condition, Sizes
from edesign.calibration.form import Values, shape, size
from edesign.damper.law import Law

CONDITION = "condition"
"""Name of the effect."""

_FEWEST = 3  # tests fitted to: one for the law, one for the slope, one that shows how tests scatter
_LEAST = 0.1  # of a factor, which it keeps in every test of the campaign
_LINEAR = (
    "phenomenological: first order in the condition; Spencer, Dyke, Sain & Carlson (1997), J. Eng. Mech. ASCE 123, "
    "230-238 (parameters of an MR damper linear in its voltage)"
)
_PUSHED = "equilibrium of the rod: Dixon (2007), The Shock Absorber Handbook, Wiley, section 5.11"


def _away(p: Values, test: Experiment, name: str) -> float:
    """Return x = (q - q_mean)/(q_max - q_min), of the tests fitted to."""
    return (test.conditions[name] - p["q_mean"]) / p["q_range"]


def _pushed(name: str, p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["offset"] * _away(p, test, name))


def _factor(name: str, p: Values, test: Experiment) -> float:
    return 1.0 + p["b"] * _away(p, test, name)


def _other(
    name: str, parameter: str, p: Values, test: Experiment, law: Law, values: dict[str, float]
) -> dict[str, float]:
    return {**values, parameter: values[parameter] * _factor(name, p, test)}


def _filled(name: str, p: Values, test: Experiment) -> Values:
    return {"P": p["P"] * test.conditions[name] / p["q_mean"]}


def _thickened(name: str, p: Values, test: Experiment) -> Values:
    """Return c of a dashpot that is F_V at V at the mean of the condition."""
    return {"c": viscous.coefficient(p)["c"] * (1.0 + p["b_v"] * _away(p, test, name))}


def of_conditions(s: Sizes, parameters: Sequence[str]) -> tuple[EffectForm, ...]:
    """Return the forms of each condition that differs between the tests fitted to.

    Args:
        s: sizes of the campaign.
        parameters: names of those of the law.
    """
    shown = [one for one in s.conditions if one.span > 0.0] if sum(s.fitted) >= _FEWEST else []
    return tuple(form for one in shown for form in _forms(one, parameters))


def _forms(one: Condition, parameters: Sequence[str]) -> tuple[EffectForm, ...]:
    # the factor stays positive in every test, in those that are compared only too
    most = (1.0 - _LEAST) / one.reach
    named = f"{one.name}, {one.lowest:.4g} to {one.highest:.4g}"

    def form(what: str, title: str, signature: str, mechanism: Mechanism) -> EffectForm:
        return EffectForm(
            CONDITION,
            f"{what}_of_{one.name}",
            "damper",
            f"{title} that depends on {named}",
            signature,
            _LINEAR,
            (mechanism,),
            lambda s: (size("b", "", 1.0, -most, most),),
            lambda s: ((0.2,), (-0.2,)),
            lambda s: {"q_mean": one.mean, "q_range": one.span},
            meanings={"b": "share that is gained from the smallest condition to the largest; negative: lost"},
        )

    def of_parameter(parameter: str) -> EffectForm:
        mechanism = LawParameters(partial(_other, one.name, parameter))
        signature = f"{parameter} of the law another from test to test, in proportion to the condition"
        return form(parameter, f"{parameter} of the law", signature, mechanism)

    push: Callable[..., np.ndarray] = partial(_pushed, one.name)
    constant = EffectForm(
        CONDITION,
        f"force_of_{one.name}",
        "damper",
        f"constant force that depends on {named}",
        "a constant force in each test, in proportion to the condition",
        _PUSHED,
        (ForceChannel(push, of="carriage"),),
        lambda s: (size("offset", "N", 0.2 * s.force, -2.0 * s.force, 2.0 * s.force),),
        lambda s: ((0.1 * s.force,),),
        lambda s: {"q_mean": one.mean, "q_range": one.span},
        meanings={"offset": "force that is gained from the smallest condition to the largest; negative: lost"},
    )
    factor = form(
        "factor",
        "factor of the force",
        "a factor of the force, constant within a test, in proportion to the condition",
        CoreEffect("constant", factor=partial(_factor, one.name)),
    )
    both = EffectForm(
        CONDITION,
        f"factor_and_dashpot_of_{one.name}",
        "damper",
        f"factor of the force and a viscous force beside it, both of which depend on {named}",
        "loops that are higher and thicker with the condition, each by a share of its own, as of a fluid in a field",
        _LINEAR,
        (
            CoreEffect("constant", factor=partial(_factor, one.name)),
            CoreEffect("velocity_exponent.dashpot", more=viscous.coefficient, own=partial(_thickened, one.name)),
        ),
        lambda s: (
            size("b", "", 1.0, -most, most),
            size("F_V", "N", 0.3 * s.force, 0.0, 2.0 * s.force),
            shape("alpha", "", 0.7, 0.1, 3.0, 0.7),
            size("b_v", "", 1.0, -most, most),
        ),
        lambda s: tuple((b, 0.08 * s.force, 1.0, b) for b in (0.5, -0.5)),
        lambda s: {"q_mean": one.mean, "q_range": one.span, "V": s.velocity},
        proportional=False,
        meanings={
            "b": "share that the force gains from the smallest condition to the largest; negative: loses",
            "F_V": "viscous force at the largest velocity of the tests fitted to and the mean condition",
            "alpha": "exponent of the velocity",
            "b_v": "share that it gains from the smallest condition to the largest; negative: loses",
        },
        refined=4,  # as of a dashpot
    )
    gas = replace(
        gas_spring.FORM,
        name=CONDITION,
        form=f"gas_of_{one.name}",
        title=f"gas that is compressed by the rod, its pressure in proportion to {named}",
        signature="a constant force and a stiffness in each test, both in proportion to the condition, at all rates",
        mechanisms=(replace(gas_spring.FORM.core_effects[0], own=partial(_filled, one.name)),),
        constants=lambda s: {**gas_spring.FORM.constants(s), "q_mean": one.mean},
    )
    return (
        constant,
        *([gas] if one.positive else []),
        both,
        *placed(factor, Placement.WHOLE, Placement.SPRINGS, Placement.DASHPOTS),
        *map(of_parameter, parameters),
    )
