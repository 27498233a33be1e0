"""The specimen was mounted crooked: a pre-shear or a dead load that stays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, ForceChannel, MotionChannel, Placement
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.form import Values, Words, size


def _sheared(p: Values, test: Experiment, motion: Motion) -> Motion:
    return replace(motion, displacement=motion.displacement + p["offset"])


def _tared(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force - force[0])


def _pushed_over(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force - p["P_over_h"] * motion.displacement)


_PRE_SHEAR = EffectForm(
    "static_offset",
    "pre_shear",
    "rig",
    "shear of the specimen before its displacement was set to zero",
    "a constant force of the elastic part alone, larger where the specimen is stiffer; bent loops if not linear",
    "relaxation to the long-term modulus: Ferry, Viscoelastic Properties of Polymers, chapter 1",
    (MotionChannel(_sheared, of="specimen"),),
    lambda s: (size("offset", "m", 0.1 * s.displacement, -s.displacement, s.displacement),),
    lambda s: ((0.05 * s.displacement,),),
    meanings={
        "offset": "shear of the specimen where the record says zero; negative: to the other side",
        "q": "square of the axial load over that at which the specimen buckles",
        "P_over_h": "axial load over the height of the specimen; negative: it pulls",
    },
)
_TARED = replace(
    _PRE_SHEAR,
    form="pre_shear_tared",
    title="shear of the specimen before displacement and force were set to zero",
    signature="no force at rest, and loops that are not alike on both sides: even harmonics",
    mechanisms=(*_PRE_SHEAR.mechanisms, ForceChannel(_tared)),
    starts=lambda s: ((0.15 * s.displacement,),),
    proportional=False,
)
_AXIAL = replace(
    _PRE_SHEAR,
    form="axial_load",
    title="axial load on the specimen, which softens its springs and thickens its losses",
    signature="less stiffness and more damping by the same share, in all tests alike",
    source="Koh & Kelly (1988), Int. J. Mech. Sci. 30, 933-943",
    mechanisms=(
        CoreEffect("constant", Placement.SPRINGS, lambda p, test: 1.0 - p["q"]),
        CoreEffect("constant", Placement.DASHPOTS, lambda p, test: 1.0 + p["q"]),
    ),
    parameters=lambda s: (size("q", "", 0.3, 0.0, 0.9),),
    starts=lambda s: ((0.05,),),
)
_P_DELTA = replace(
    _PRE_SHEAR,
    form="p_delta",
    title="axial load on the specimen, which pushes it over",
    signature="a spring of negative stiffness, neither relaxing nor softening",
    source="equilibrium",
    mechanisms=(ForceChannel(_pushed_over, of="carriage"),),
    parameters=lambda s: (size("P_over_h", "N/m", 0.1 * s.stiffness, -s.stiffness, s.stiffness),),
    starts=lambda s: ((0.05 * s.stiffness,),),
    negative=Words(
        "axial load on the specimen, which pulls it straight",
        "a spring of positive stiffness, neither relaxing nor softening",
    ),
)

FORMS = (_PRE_SHEAR, _TARED, _AXIAL, _P_DELTA)
