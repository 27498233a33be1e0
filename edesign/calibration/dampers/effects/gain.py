"""Gain of a channel, and inertia of what moves with the load cell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, either
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.filters import second_order
from edesign.calibration.dampers.mechanisms import ForceChannel, MotionChannel
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, shape, size
from edesign.estimation.parameters import Parameter

_CLASS = 0.05  # standard deviation of a gain


def _amplified(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray((1.0 + p["g"]) * force)


def _reduced(p: Values, test: Experiment, motion: Motion) -> Motion:
    return motion.scaled(1.0 / (1.0 + p["g"]))


FORCE = EffectForm(
    "gain",
    "force",
    "instrument",
    "gain of the force channel",
    "proportional to the force itself, by the same share in all tests",
    "ISO 376:2011 (calibration of load cells); Doebelin, Measurement Systems, chapter 2",
    (ForceChannel(_amplified),),
    lambda s: (size("g", "", _CLASS, -0.5, 1.0),),
    lambda s: ((_CLASS,),),
    meanings={"g": "share by which the channel reads too much; negative: too little"},
)
DISPLACEMENT = replace(
    FORCE,
    form="displacement",
    title="gain of the displacement channel",
    signature="that of a gain of the force where the law is linear; by its tangent where it is not",
    mechanisms=(MotionChannel(_reduced),),
)


def _mass(s: Sizes) -> Parameter:
    mass = s.force / s.acceleration
    return size("mass", "kg", 0.1 * mass, 0.0, 10.0 * mass)  # it may carry what the elastomer holds back


def _heavy(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["mass"] * motion.acceleration)


def _sprung(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["mass"] * second_order(motion, motion.acceleration, p["f"], p["zeta"]))


_MASS = EffectForm(
    "inertia",
    "mass",
    "instrument",
    "inertia of moving mass in the force channel",
    "proportional to the acceleration: a negative stiffness that grows with the square of the frequency",
    "ISO 22762-1:2018, 6.2.1 (correction for inertia); Newton's second law",
    (ForceChannel(_heavy, of="carriage"),),
    lambda s: (_mass(s),),
    lambda s: ((0.02 * s.force / s.acceleration,),),
    meanings={
        "mass": "that moves between load cell and specimen",
        "f": "own frequency of the mass on its fixture",
        "zeta": "damping ratio of it",
    },
)
_SPRUNG = replace(
    _MASS,
    form="sprung",
    title="inertia of moving mass on a fixture that gives, in the force channel",
    source="Chopra, Dynamics of Structures, section 1.7 (motion of the support)",
    mechanisms=(ForceChannel(_sprung, of="carriage"),),
    parameters=lambda s: (
        _mass(s),
        shape("f", "Hz", 10.0 * s.frequency, s.frequency, 100.0 * s.frequency, spread=1.0),
        shape("zeta", "", 0.1, 0.01, 0.5),  # more is a filter
    ),
    starts=lambda s: ((0.02 * s.force / s.acceleration, 10.0 * s.frequency, 0.2),),
    refined=4,  # it oscillates between samples of a fit
)

FORMS = (
    FORCE,
    DISPLACEMENT,
    either(_MASS, "inertia of the damper's own moving mass"),
    either(_SPRUNG, "inertia of the damper's own moving mass, on a part of it that gives"),
)
