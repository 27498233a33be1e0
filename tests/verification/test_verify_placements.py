"""Equations and placements of amendments against the operators of the calibration, in numpy on samples."""

from __future__ import annotations

import damper_amendments as definitions
import numpy as np
import pytest

from edesign.calibrate.dampers.acting import Acting, LawForce, changed_by
from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import friction, hardening, mullins, payne
from edesign.calibrate.dampers.inside import without_dashpots
from edesign.calibrate.dampers.trial import Motion, Trial
from edesign.core.damper import Placement
from edesign.damper.amendments import Amendment
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters

LAWS = {"mgmm": read_parameters(law("mgmm"), "thesis_table_4_2"), "kelvin_voigt": {"k": 3e6, "c": 2e5}}
FORMS: dict[tuple[str, str], Form] = {
    ("payne", "whole"): payne.Whole(),
    ("payne", "exponential"): payne.Exponential(),
    ("payne", "network"): payne.Network(),
    ("mullins", "path"): mullins.Path(),
    ("mullins", "maximum"): mullins.Maximum(),
    ("mullins", "damage"): mullins.Damage(),
}


def trial() -> Trial:
    """A sine that grows and falls, from rest at zero."""
    t = np.arange(500) * 0.01
    w, b = 2.0 * np.pi * 0.617, 2.0 * np.pi / 5.0
    size, rate, bend = 0.5 * (1.0 - np.cos(b * t)), 0.5 * b * np.sin(b * t), 0.5 * b * b * np.cos(b * t)
    u, v = size * np.sin(w * t), size * w * np.cos(w * t) + rate * np.sin(w * t)
    a = (bend - size * w * w) * np.sin(w * t) + 2.0 * rate * w * np.cos(w * t)
    motion = Motion(t, 9e-3 * u, 9e-3 * v, 9e-3 * a)
    return Trial("t", "fit", 0, motion, np.zeros_like(t), np.full(t.size, 20.0))


TRIAL = trial()


def force(name: str, amendment: Amendment | None = None) -> np.ndarray:
    """Of a law with an amendment or none (n,) N."""
    motion, amendments = TRIAL.motion, () if amendment is None else (amendment,)
    return Damper(law(name), LAWS[name], amendments=amendments).force(motion.time, motion.displacement, motion.velocity)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("kind", FORMS)
@pytest.mark.parametrize("placement", ["whole", "springs", "dashpots"])
def test_a_factor_of_one_side_is_that_of_the_calibration(
    name: str, kind: tuple[str, str], placement: Placement
) -> None:
    amendment, values, motion = definitions.example(*kind, placement), LAWS[name], TRIAL.motion
    form, p = FORMS[kind], {"recovery": 0.0, **amendment.values}
    if placement == "springs":  # dashpots by the power 0 of the factor
        form, p = form.sparing_loss(), {**p, "loss": 0.0}
    elif placement == "dashpots":
        form = form.of_loss()
    of = without_dashpots(law(name), values)
    assert of is not None
    springs = Damper(law(name), of).force(motion.time, motion.displacement, motion.velocity)
    whole = force(name)
    relaxes = values["c1"] / values["k1"] if name == "mgmm" else None
    given = LawForce(whole, relaxes, lambda: springs, lambda: whole, lambda _: whole)
    found = changed_by([Acting(form, p, {})], TRIAL, motion, given)
    expected = np.asarray(found.factor * whole + found.parallel)
    peak = np.max(np.abs(expected))
    # rounding; in the MGMM without dashpots the calibration leaves 1e-9 of c1
    assert np.max(np.abs(force(name, amendment) - expected)) < (1e-9 if relaxes else 1e-12) * peak
    assert np.max(np.abs(expected - whole)) > 0.01 * peak


@pytest.mark.parametrize(
    ("kind", "form"),
    [
        (("friction", "coulomb"), friction.Tanh()),
        (("friction", "presliding"), friction.Presliding()),
        (("friction", "stribeck"), friction.Stribeck()),
        (("hardening", "exponential"), hardening.Exponential()),
    ],
)
def test_a_force_is_that_of_the_calibration(kind: tuple[str, str], form: Form) -> None:
    amendment, whole = definitions.example(*kind), force("kelvin_voigt")
    p = amendment.values
    rubs = form.carriage(p, TRIAL, TRIAL.motion, whole)
    expected = form.parallel(p, TRIAL, TRIAL.motion, {}) if rubs is None else rubs
    assert expected is not None
    found = force("kelvin_voigt", amendment) - whole
    assert np.max(np.abs(found - expected)) < 1e-12 * np.max(np.abs(whole))  # rounding
    assert np.max(np.abs(np.asarray(expected))) > 0.01 * np.max(np.abs(whole))
