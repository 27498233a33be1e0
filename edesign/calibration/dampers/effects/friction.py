"""Friction: of the guides of the rig, or of the damper's seals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, either
from edesign.calibration.dampers.effects.gas_spring import FLUID
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, ForceChannel
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, shape, share, size
from edesign.estimation.parameters import Parameter

_SEALED = (*FLUID, "fractional_maxwell")
_JUMPS = "a force of one size against the motion: jumps at every reversal, the same at all amplitudes and frequencies"


def _friction(s: Sizes, part: float = 0.1) -> Parameter:
    # friction gives no energy: never below zero
    return size("F_c", "N", part * s.force, 0.0, 0.5 * s.force)


def _velocity(name: str, s: Sizes, centre: float, least: float, most: float) -> Parameter:
    return shape(name, "m/s", centre * s.velocity, least * s.velocity, most * s.velocity)


def _loaded(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + (p["F_c"] + p["mu"] * np.abs(force)) * np.tanh(motion.velocity / p["v0"]))


_COULOMB = EffectForm(
    "friction",
    "coulomb",
    "rig",
    "Coulomb friction in the guides",
    _JUMPS,
    "Coulomb (1785); Andersson et al. (2007), Tribology International 40, 580-587, Eq. 4",
    (CoreEffect("friction.coulomb"),),
    # the slower v0, the nearer to the sign of the velocity; towards the largest velocity it is a dashpot
    lambda s: (_friction(s), _velocity("v0", s, 0.02, 1e-4, 0.3)),
    lambda s: tuple((0.03 * s.force, v0 * s.velocity) for v0 in (0.02, 0.1, 0.002)),
    meanings={
        "F_c": "friction force of sliding; of `loaded` that without a force of the damper",
        "v0": "velocity below which it smooths out",
        "x0": "way over which it builds up after a reversal",
        "n": "sharpness of its bend: 1 Dahl's, a large one elastic-plastic",
        "s": "share by which it is larger at rest",
        "v_s": "velocity over which that share falls",
        "mu": "share of the damper's force that it has besides",
    },
)
_PRESLIDING = replace(
    _COULOMB,
    form="presliding",
    title="friction that builds up over a way, in the guides",
    source="Dahl (1968), Aerospace Corp. TOR-0158(3107-18)-1; Dahl (1976), AIAA Journal 14, 1675-1682",
    mechanisms=(CoreEffect("friction.presliding"),),
    # where the way is as long as the largest motion there is no sliding left: a spring and a lossy one at that
    parameters=lambda s: (
        _friction(s),
        shape("x0", "m", 0.02 * s.displacement, 1e-4 * s.displacement, 0.5 * s.displacement),
        shape("n", "", 2.0, 1.0, 100.0, spread=1.2),
    ),
    starts=lambda s: tuple((0.03 * s.force, x0 * s.displacement, n) for n in (1.0, 8.0) for x0 in (0.02, 0.1)),
)
_STRIBECK = replace(
    _COULOMB,
    form="stribeck",
    title="friction in the guides that is larger near rest",
    source="Armstrong-Helouvry, Dupont & Canudas de Wit (1994), Automatica 30, 1083-1138, section 2.1",
    mechanisms=(CoreEffect("friction.stribeck"),),
    parameters=lambda s: (_friction(s), share("s", 0.0, 0.7, 3.0), _velocity("v_s", s, 0.1, 1e-3, 0.5)),
    starts=lambda s: tuple((0.03 * s.force, 0.5, v_s * s.velocity) for v_s in (0.1, 0.02)),
)
_LOADED = replace(
    _COULOMB,
    form="loaded",
    title="friction in the guides that grows with the force",
    signature="a force against the motion that jumps at every reversal, more at large forces than at small ones",
    source="Coulomb (1785), the load of the guides a share of the damper's force",
    mechanisms=(ForceChannel(_loaded, of="carriage"),),
    parameters=lambda s: (share("mu", 0.0, 0.1, 0.5), _friction(s, 0.03), _velocity("v0", s, 0.02, 1e-4, 0.3)),
    starts=lambda s: tuple((0.03, 0.01 * s.force, v0 * s.velocity) for v0 in (0.02, 0.1, 0.002)),
    proportional=False,
)

FORMS = (
    either(_COULOMB, "Coulomb friction in the damper, as of its seals", usual_in=_SEALED),
    either(
        _PRESLIDING,
        "friction that builds up over a way in the damper, as of seals or a part that yields",
        usual_in=_SEALED,
    ),
    either(_STRIBECK, "friction in the damper, as of its seals, that is larger near rest", usual_in=_SEALED),
    either(
        _LOADED,
        "friction in the damper, as of its seals, that grows with the force",
        (CoreEffect("friction.loaded"),),
        usual_in=_SEALED,
    ),
)
