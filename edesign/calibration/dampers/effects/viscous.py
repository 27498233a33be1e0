"""Forces of the velocity that the law lacks: relaxation times, and dashpots with a power of the velocity."""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.mechanisms import CoreEffect, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Rows, Values, Words, shape, size

_LEAST, _MOST = 0.1, 3.0  # exponents: below is friction; above there is no damper
_LINEAR = (
    "linear in the amplitude; stiffness and damping off by what changes with frequency, and a residual that fades "
    "after a change of the mean"
)
_IN_PHASE = (
    "in phase with the velocity, largest where the deformation passes zero, with a power of amplitude times "
    "frequency; nothing at the tips"
)


def _branch_starts(s: Sizes) -> Rows:
    omega = 2.0 * math.pi / s.period
    times = (*(part * s.period for part in (0.01, 0.05, 0.2, 1.0, 5.0)), 0.3 * s.duration)
    # a force of a twentieth in the slowest motion; of less where the branch is fast
    return tuple((0.05 * s.stiffness * min(1.0 + 1.0 / (omega * t), 10.0), t) for t in times)


def coefficient(p: Values) -> Values:
    """Return c of a dashpot given by its force at a velocity V: c alone has a unit that depends on alpha."""
    return {"c": p["F_V"] / p["V"] ** p["alpha"]}


_MAXWELL = EffectForm(
    "relaxation_branch",
    "maxwell",
    "damper",
    "a relaxation time that the law lacks",
    _LINEAR,
    "Christensen (1982), Theory of Viscoelasticity, section 1.6; thesis Eq. 4.4",
    (CoreEffect("relaxation_branch.maxwell"),),
    lambda s: (
        size("k", "N/m", 0.5 * s.stiffness, -2.0 * s.stiffness, 50.0 * s.stiffness),
        shape("tau", "s", 0.2 * s.period, 1e-3 * s.period, 10.0 * max(s.duration, s.period)),  # beyond: a spring
    ),
    _branch_starts,
    negative=Words("a relaxation time of which the law has too much", _LINEAR),
)
_DASHPOT = EffectForm(
    "velocity_exponent",
    "dashpot",
    "damper",
    "viscous force with a power of the velocity that the law lacks",
    _IN_PHASE,
    "Constantinou & Symans (1993), Struct. Des. Tall Build. 2, 93-132; thesis Eq. 2.24",
    (CoreEffect("velocity_exponent.dashpot", more=coefficient),),
    lambda s: (
        size("F_V", "N", 0.3 * s.force, -2.0 * s.force, 2.0 * s.force),
        shape("alpha", "", 0.7, _LEAST, _MOST, 0.7),
    ),
    lambda s: tuple((0.08 * s.force, alpha) for alpha in (0.2, 0.5, 1.0, 2.0)),
    lambda s: {"V": s.velocity},
    refined=4,  # its force may jump where the velocity changes its sign
    meanings={"F_V": "its force at the largest velocity of the tests fitted to"},
    negative=Words("viscous force with a power of the velocity of which the law has too much", _IN_PHASE),
)
_POSITION = replace(
    _DASHPOT,
    form="position",
    title="viscous force that grows with the deformation",
    signature="in phase with the velocity, more of it at a larger deformation; nothing at the tips nor in the middle",
    source="damping by the depth of an impact: Hunt & Crossley (1975), J. Appl. Mech. 42, 440-445 (alpha = 1)",
    mechanisms=(CoreEffect("velocity_exponent.position", more=coefficient),),
    parameters=lambda s: (*_DASHPOT.parameters(s), shape("q", "", 1.0, 0.3, 4.0, spread=0.5)),
    starts=lambda s: tuple((0.08 * s.force, alpha, 1.0) for alpha in (0.2, 0.5, 1.0, 2.0)),
    constants=lambda s: {"V": s.velocity, "r": s.displacement},
    negative=Words(
        "viscous force that falls with the deformation",
        "in phase with the velocity, less of it at a larger deformation; nothing at the tips nor in the middle",
    ),
)
_FLOW = EffectForm(
    "velocity_exponent",
    "flow",
    "damper",
    "viscous force that saturates with the velocity",
    _IN_PHASE,
    "Eyring (1936), J. Chem. Phys. 4, 283-291",
    (CoreEffect("velocity_exponent.flow"),),
    lambda s: (
        size("f", "N", 0.1 * s.force, -s.force, s.force),
        shape("v0", "m/s", 0.1 * s.velocity, 1e-4 * s.velocity, s.velocity),
    ),
    lambda s: tuple((0.06 * s.force / math.asinh(1.0 / x), x * s.velocity) for x in (0.01, 0.1, 0.5)),
    negative=Words("viscous force that saturates with the velocity, of which the law has too much", _IN_PHASE),
)

FORMS = (_MAXWELL, *placed(_DASHPOT, Placement.WHOLE, Placement.INSIDE), _POSITION, _FLOW)
