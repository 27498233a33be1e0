"""The rig: play in its pins, flexible parts in series with the specimen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, either
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import MotionChannel, Rig, RigValues
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, shape, size
from edesign.estimation.parameters import Parameter

_CLOSES = 0.03
"""Share of the largest force that closes a joint: below it is a clearance that is crossed, above it a soft part."""
_CLEARANCE = 5.0
"""Times as stiff as before is a joint that has closed: what is stiffer yet has had a clearance."""
_OPENS = 0.05  # of the stiffness before is left in a joint that opens: with less the damper would stand still
_JOINTS = "piecewise linear joints: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936"


def _play(s: Sizes) -> Parameter:
    return size("play", "m", 0.05 * s.displacement, 0.0, 0.5 * s.displacement)


def _stiffness(s: Sizes, centre: float = 20.0, least: float = 1.5) -> Parameter:
    # its force is proportional to 1 / stiffness: searches from too flexible are short, from too stiff they jump
    return shape("stiffness", "N/m", centre * s.stiffness, least * s.stiffness, 1e4 * s.stiffness)


def _closes(s: Sizes) -> Parameter:
    return shape("F_c", "N", 0.3 * s.force, _CLOSES * s.force, 1.5 * s.force, spread=0.8)


def _joint(p: Values) -> RigValues:
    k = p["stiffness"]
    return RigValues(p["ratio"] * k, play=2.0 * p["F_c"] / k, play_stiffness=k)


def _follow(p: Values, test: Experiment, motion: Motion) -> Motion:
    """Return what follows through a play: it rests until the clearance is crossed, whatever its force."""
    points, index = motion.turning_points
    half = 0.5 * p["play"]
    own = np.empty_like(points)
    own[0] = min(max(0.0, points[0] - half), points[0] + half)
    rises = np.diff(points) > 0.0
    ends = np.concatenate(([0], np.flatnonzero(rises[1:] != rises[:-1]) + 1, [points.size - 1]))
    for first, last in zip(ends[:-1], ends[1:], strict=True):
        way = slice(first + 1, last + 1)
        own[way] = (
            np.maximum(own[first], points[way] - half) if rises[first] else np.minimum(own[first], points[way] + half)
        )
    own = own[index]
    # it either rests or goes along: differences over the corners would smooth them
    along = (own == motion.displacement - half) | (own == motion.displacement + half)
    velocity = np.where(along, motion.velocity, 0.0)
    # where the clearance is closed early in a step, a cubic from rest would be faster in it than what follows is, and
    # a law that remembers its largest velocity would not forget that: it begins with what makes the velocity linear
    before = np.flatnonzero(~along[:-1] & along[1:])
    mean, after = (np.diff(own) / motion.steps)[before], velocity[before + 1]
    ratio = np.divide(mean, after, out=np.zeros_like(after), where=after != 0.0)
    velocity[before] = after * np.clip(2.0 * ratio - 1.0, 0.0, 1.0)
    return Motion(motion.time, own, velocity, np.where(along, motion.acceleration, 0.0))


_GAP = EffectForm(
    "play",
    "gap",
    "rig",
    "clearance of the pins in series with the specimen",
    "a step of no force where the force changes its sign; the same length at all amplitudes",
    "Nordin & Gutman (2002), Automatica 38, 1633-1649, section 2.1 (dead zone)",
    (Rig(lambda p: RigValues(p["stiffness"], play=p["play"])),),
    lambda s: (_play(s), _stiffness(s, 100.0, 2.0)),
    lambda s: tuple(
        (play * s.displacement, k * s.stiffness)
        for play, k in ((0.02, 1000.0), (0.02, 30.0), (0.1, 100.0), (0.004, 300.0), (0.0005, 3000.0))
    ),
    proportional=False,
    meanings={
        "play": "clearance from end to end",
        "stiffness": "of the rig beyond the clearance; of `closing` within it",
        "F_c": "force under which the clearance is crossed",
        "ratio": "how many times as stiff the joint is once closed",
    },
)
_SEATED = replace(
    _GAP,
    form="gap_seated",
    title="clearance of the pins, crossed under a small force, in series with the specimen",
    signature="force that hesitates where it changes its sign; the same length at all amplitudes",
    source=_JOINTS,
    mechanisms=(Rig(lambda p: RigValues(p["stiffness"], play=p["play"], play_stiffness=2.0 * p["F_c"] / p["play"])),),
    parameters=lambda s: (
        shape("play", "m", 0.02 * s.displacement, 1e-4 * s.displacement, 0.5 * s.displacement),
        _stiffness(s, 100.0, 2.0),
        shape("F_c", "N", 0.2 * _CLOSES * s.force, 1e-4 * s.force, _CLOSES * s.force),
    ),
    starts=lambda s: tuple(
        (play * s.displacement, k * s.stiffness, 0.2 * _CLOSES * s.force)
        for play, k in ((0.02, 1000.0), (0.02, 30.0), (0.1, 100.0), (0.004, 300.0))
    ),
)
_BACKLASH = replace(
    _GAP,
    form="backlash",
    title="backlash of the pins between the measured motion and the specimen",
    signature="the force rests after every reversal of the motion, over one length at all amplitudes",
    source="Krasnosel'skii & Pokrovskii (1989), Systems with Hysteresis, section 2.1 (play operator)",
    mechanisms=(MotionChannel(_follow, of="specimen"),),
    parameters=lambda s: (_play(s),),
    starts=lambda s: tuple((play * s.displacement,) for play in (0.02, 0.1, 0.004, 0.0005)),
    refined=6,  # it rests and goes along within a step
)
_CLOSING_PLAY = replace(
    _GAP,
    form="closing",
    title="clearance of the pins that closes under a force, in series with the specimen",
    signature="a soft part of one length where the force changes its sign",
    source=_JOINTS,
    mechanisms=(Rig(_joint),),
    parameters=lambda s: (
        _stiffness(s, 10.0, 0.1),
        _closes(s),
        shape("ratio", "", 20.0, _CLEARANCE, 1e3),
    ),
    starts=lambda s: tuple(
        (soft * s.stiffness, part * s.force, 20.0) for soft, part in ((10.0, 0.1), (3.0, 0.1), (10.0, 0.3))
    ),
)
_FLEXIBLE = EffectForm(
    "series_flexibility",
    "linear",
    "rig",
    "flexible parts of the rig in series with the specimen",
    "forces too small where the specimen is stiffest (fast, cold), in proportion to the square of its stiffness",
    "two springs in series",
    (Rig(lambda p: RigValues(p["stiffness"])),),
    lambda s: (_stiffness(s),),
    lambda s: ((20.0 * s.stiffness,),),
    meanings={
        "stiffness": "of the parts in series, at small forces; of `power` the secant at the force F_r",
        "t_r": "damping of the parts over their stiffness",
        "e0": "stretch of the parts at which they are twice as stiff, by the secant",
        "n": "power of the approach: 3/2 of spheres (Hertz), more of rough surfaces",
        "F_c": "force that closes the joint, either way",
        "ratio": "how many times as stiff it is once closed; below 1: a joint that opens",
    },
)
_DAMPED = replace(
    _FLEXIBLE,
    form="damped",
    title="flexible parts of the rig in series with the specimen that lose work",
    signature="as series_flexibility.linear, and less of it the faster the force changes",
    source="Kelvin and Voigt's element in series: Christensen (1982), Theory of Viscoelasticity, 1.6",
    mechanisms=(Rig(lambda p: RigValues(p["stiffness"], damping=p["stiffness"] * p["t_r"])),),
    parameters=lambda s: (
        _stiffness(s),
        Parameter("t_r", "s", 0.0, 1.0 / s.frequency, 0.0, 0.02 / s.frequency),
    ),
    starts=lambda s: ((20.0 * s.stiffness, 0.02 / s.frequency),),
)
_STIFFENING = replace(
    _FLEXIBLE,
    form="stiffening",
    title="parts of the rig in series with the specimen that stiffen with the force",
    signature="as series_flexibility.linear, and more of it at small forces than at large ones",
    source="joints that close: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936",
    mechanisms=(Rig(lambda p: RigValues(p["stiffness"], cubic=1.0 / p["e0"] ** 2)),),
    parameters=lambda s: (
        _stiffness(s),
        shape("e0", "m", 0.05 * s.displacement, 1e-4 * s.displacement, 10.0 * s.displacement),
    ),
    starts=lambda s: (
        (20.0 * s.stiffness, 0.05 * s.displacement),
        (10.0 * s.stiffness, 0.02 * s.displacement),
    ),
)
_POWER = replace(
    _FLEXIBLE,
    form="power",
    title="contacts of the rig in series with the specimen that stiffen with a power of their approach",
    signature="as series_flexibility.linear, and ever more of it at small forces",
    source="Johnson (1985), Contact Mechanics, section 4.2 (Hertz); rough surfaces: Greenwood & Williamson (1966)",
    mechanisms=(Rig(lambda p: RigValues(p["stiffness"], cubic=(p["stiffness"] / p["F_r"]) ** 2, power=p["n"])),),
    parameters=lambda s: (_stiffness(s), shape("n", "", 1.5, 1.05, 12.0, spread=0.7)),
    starts=lambda s: tuple((20.0 * s.stiffness, n) for n in (1.5, 4.0)),
    constants=lambda s: {"F_r": 0.5 * s.force},
)
_CLOSING = replace(
    _FLEXIBLE,
    form="closing",
    title="a joint of the rig in series with the specimen that closes or opens under a force",
    signature="as series_flexibility.linear up to a force, and less of it beyond, or more",
    source=_JOINTS,
    mechanisms=(Rig(_joint),),
    parameters=lambda s: (_stiffness(s), _closes(s), shape("ratio", "", 1.0, _OPENS, _CLEARANCE, spread=0.8)),
    starts=lambda s: tuple(
        (20.0 * s.stiffness, part * s.force, ratio)
        for part, ratio in ((0.15, 2.0), (0.4, 2.0), (0.75, 2.0), (0.3, 0.4))
    ),
)

FORMS = (
    *(
        either(form, form.title.replace("the pins", "the damper's own pins"))
        for form in (_GAP, _SEATED, _BACKLASH, _CLOSING_PLAY)
    ),
    *(
        either(form, form.title.replace("the rig", "the damper itself"))
        for form in (_FLEXIBLE, _DAMPED, _STIFFENING, _POWER, _CLOSING)
    ),
)
