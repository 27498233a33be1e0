"""Errors of a load cell that a gain and a zero leave: curvature of its reading over the force, and reversibility."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import ForceChannel
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, size
from edesign.estimation.parameters import Parameter

_CLASS = 0.05  # standard deviation of a share of the largest force, as of a gain
_MOST = 0.45  # of it: a reading rises with the force


def _share(name: str) -> Parameter:
    return size(name, "", _CLASS, -_MOST, _MOST)


def _of_force(s: Sizes) -> dict[str, float]:
    return {"F_r": s.force}


def _odd(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force * (1.0 + p["a"] * np.abs(force) / p["F_r"]))


def _even(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force * (1.0 + p["a"] * force / p["F_r"]))


def _late(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["h"] / p["F_r"] * rayleigh(force))


def rayleigh(force: np.ndarray) -> np.ndarray:
    """Return the response (n,) N^2 of Rayleigh's law to a force from rest at zero, of unit size.

    It is F |F| where the force is larger than ever before. After a turning point F_1 it departs by
    (F - F_1)^2 / 2, to that side to which the force goes. Where the force comes back to the turning point before, the
    loop between both is closed and forgotten (Madelung's rules).

    Args:
        force: (n,) N.

    Source: Rayleigh (1887), Phil. Mag. 23, 225-245; Bertotti (1998), Hysteresis in Magnetism, Academic Press, 2.1.
    """
    found = np.empty(force.size)
    steps = np.sign(np.diff(force, prepend=0.0))
    moved = np.flatnonzero(steps)
    edges = [0, *(moved[1:][np.diff(steps[moved]) != 0.0]).tolist(), force.size]
    corners: list[tuple[float, float]] = []  # turning points that are remembered, with the response there
    for first, end in zip(edges[:-1], edges[1:], strict=True):
        way, side = force[first:end], 1.0 if force[end - 1] >= (force[first - 1] if first else 0.0) else -1.0
        at = 0
        while at < way.size:
            if not corners:
                found[first + at : end] = way[at:] * np.abs(way[at:])
                break
            turned, there = corners[-1]
            closes = corners[-2][0] if len(corners) > 1 else -turned
            last = int(np.searchsorted(side * way, side * closes, side="right"))
            found[first + at : first + last] = there + 0.5 * side * (way[at:last] - turned) ** 2
            at = max(at, last)
            if at < way.size:
                del corners[-2:]
        corners.append((float(way[-1]), float(found[end - 1])))
    return found


_LINEARITY = EffectForm(
    "linearity",
    "odd",
    "instrument",
    "reading of the load cell that curves with the force, alike to both sides,",
    "too much or too little force at the peaks of the force, by its square, at all amplitudes and frequencies",
    "ISO 376:2011, table 2 (interpolation error); VDI/VDE/DKD 2638:2008 (linearity of force transducers)",
    (ForceChannel(_odd),),
    lambda s: (_share("a"),),
    lambda s: ((_CLASS,),),
    _of_force,
    meanings={"a": "share by which the largest force reads too much, beside a gain; negative: too little"},
)
_EVEN = replace(
    _LINEARITY,
    form="even",
    title="reading of the load cell that curves with the force to one side",
    signature="a force to the same side at both peaks of the force: even multiples of the frequency alone",
    mechanisms=(ForceChannel(_even),),
    meanings={"a": "share by which the largest force reads too far to the positive side; negative: to the other"},
)
_REVERSIBILITY = EffectForm(
    "reversibility",
    "rayleigh",
    "instrument",
    "hysteresis of the load cell",
    "loops over the force itself, whose width goes with the square of the force: the same at all rates",
    "ISO 376:2011, table 2 (reversibility error); Rayleigh (1887), Phil. Mag. 23, 225-245 (its course)",
    (ForceChannel(_late, remembers=True),),
    lambda s: (_share("h"),),
    lambda s: ((_CLASS,),),
    _of_force,
    meanings={
        "h": "difference of the readings at zero after the largest force to either side, as a share of it; negative: "
        "readings are ahead"
    },
)
FORMS = (_LINEARITY, _EVEN, _REVERSIBILITY)
