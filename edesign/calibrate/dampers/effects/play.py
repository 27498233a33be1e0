"""Play in the pins between actuator and specimen."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Series
from edesign.calibrate.dampers.effects import series_flexibility
from edesign.calibrate.dampers.effects.series_flexibility import CLEARANCE, CLOSES
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.dampers.turning_points import with_turning_points
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class _Play(Form):
    name: ClassVar[str] = "play"
    kind: ClassVar[Kind] = "rig"

    def _play(self, sizes: Sizes) -> Unknown:
        return Unknown("play", "m", 0.0, 0.5 * sizes.displacement, 0.1 * sizes.displacement)


class Gap(_Play):
    """Pins with a clearance, in series with the specimen: no force while they cross it, a stiff rig beyond it."""

    form: ClassVar[str] = "gap"
    title: ClassVar[str] = "clearance of the pins in series with the specimen"
    signature: ClassVar[str] = "a step of no force where the force changes its sign; the same length at all amplitudes"
    source: ClassVar[str] = "Nordin & Gutman (2002), Automatica 38, 1633-1649, section 2.1 (dead zone)"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = sizes.stiffness
        return (self._play(sizes), Unknown("stiffness", "N/m", 2.0 * k, 1e4 * k, 100.0 * k, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        clearances = ((0.02, 1000.0), (0.02, 30.0), (0.1, 100.0), (0.004, 300.0), (0.0005, 3000.0))
        return tuple((play * sizes.displacement, k * sizes.stiffness) for play, k in clearances)

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], play=p["play"])

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A flexible rig without clearance."""
        return ((series_flexibility.Linear(), p),)


class GapAside(Gap):
    """A clearance in which the pins begin aside, as where dead load or the last test has left them."""

    form: ClassVar[str] = "gap_aside"
    title: ClassVar[str] = "clearance of the pins in series with the specimen, at first not in its middle"
    signature: ClassVar[str] = "a step of no force where the force changes its sign, displaced to one side"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("aside", "", -1.0, 1.0, 0.5))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, side) for row in super().starts(sizes)[:-1] for side in (0.8, -0.8))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A flexible rig, and pins that begin in the middle."""
        return *super().simpler(p), (Gap(), p)

    def specimen(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return replace(motion, displacement=motion.displacement - 0.5 * p["aside"] * p["play"])


class GapSeated(Gap):
    """Pins that seat softly, in rubber or with burrs: the clearance is crossed under a small force, not under none."""

    form: ClassVar[str] = "gap_seated"
    title: ClassVar[str] = "clearance of the pins, crossed under a small force, in series with the specimen"
    signature: ClassVar[str] = "force that hesitates where it changes its sign; the same length at all amplitudes"
    source: ClassVar[str] = "piecewise linear joints: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u, force = sizes.displacement, sizes.force
        return (
            Unknown("play", "m", 1e-4 * u, 0.5 * u, 0.1 * u, logarithmic=True),
            super().unknowns(sizes)[1],
            Unknown("F_c", "N", 1e-4 * force, CLOSES * force, 0.3 * CLOSES * force, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        rows = super().starts(sizes)[:-1]
        return tuple((*row, share * CLOSES * sizes.force) for row in rows for share in (0.05, 0.4))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A flexible rig, and a clearance that is crossed under no force."""
        return *super().simpler(p), (Gap(), p)

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], play=p["play"], within=2.0 * p["F_c"] / p["play"])


class Closing(series_flexibility.Closing):
    """A clearance with dirt or soft liners in it: it closes under a force F_c and is then far stiffer."""

    name: ClassVar[str] = "play"
    title: ClassVar[str] = "clearance of the pins that closes under a force, in series with the specimen"
    signature: ClassVar[str] = "a soft part of one length where the force changes its sign"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        stiffness, closes, ratio = super().unknowns(sizes)
        return (
            replace(stiffness, lower=0.1 * sizes.stiffness),
            closes,
            replace(ratio, lower=CLEARANCE, upper=1e3, size=20.0),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, force = sizes.stiffness, sizes.force
        return tuple((soft * k, share * force, 20.0) for soft, share in ((10.0, 0.1), (3.0, 0.1), (10.0, 0.3)))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A flexible rig without clearance, and a clearance with nothing in it."""
        stiff = {"play": 2.0 * p["F_c"] / p["stiffness"], "stiffness": p["ratio"] * p["stiffness"]}
        return (series_flexibility.Linear(), p), (Gap(), stiff)


class Backlash(_Play):
    """The specimen follows through a play: it rests until the clearance is crossed, whatever its force."""

    form: ClassVar[str] = "backlash"
    refined: int = 6  # it rests and goes along within a step
    title: ClassVar[str] = "backlash between the measured motion and the specimen"
    signature: ClassVar[str] = "the force rests after every reversal of the motion, over one length at all amplitudes"
    source: ClassVar[str] = "Krasnosel'skii & Pokrovskii (1989), Systems with Hysteresis, section 2.1 (play operator)"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (self._play(sizes),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((play * sizes.displacement,) for play in (0.02, 0.1, 0.004, 0.0005))

    def specimen(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        points, index = with_turning_points(motion)
        own = follow(points, p["play"])[index]
        # it either rests or goes along: differences over the corners would smooth them
        half = 0.5 * p["play"]
        along = (own == motion.displacement - half) | (own == motion.displacement + half)
        velocity = np.where(along, motion.velocity, 0.0)
        _close(velocity, along, np.diff(own) / motion.steps)
        return Motion(motion.time, own, velocity, np.where(along, motion.acceleration, 0.0))


def _close(velocity: np.ndarray, along: np.ndarray, means: np.ndarray) -> None:
    """Where the clearance is closed early in a step, a cubic from rest would be faster in it than what follows is, and
    a law that remembers its largest velocity would not forget that: it begins with what makes the velocity linear.

    Args:
        velocity: (n,) m/s, changed.
        along: (n,) whether the specimen goes along.
        means: (n - 1,) of the velocity in each step, m/s.
    """
    before = np.flatnonzero(~along[:-1] & along[1:])
    after = velocity[before + 1]
    ratio = np.divide(means[before], after, out=np.zeros_like(after), where=after != 0.0)
    velocity[before] = after * np.clip(2.0 * ratio - 1.0, 0.0, 1.0)


def follow(displacement: np.ndarray, play: float) -> np.ndarray:
    """What follows a displacement (n,) m through a play end to end, as near to zero at first as the play lets it.

    Exact for a displacement that is monotone from sample to sample."""
    above, below = displacement - 0.5 * play, displacement + 0.5 * play
    rises = np.diff(displacement) > 0.0
    ends = np.concatenate(([0], np.flatnonzero(rises[1:] != rises[:-1]) + 1, [displacement.size - 1]))
    found = np.empty_like(displacement)
    at = found[0] = min(max(0.0, float(above[0])), float(below[0]))
    for first, last in itertools.pairwise(ends.tolist()):
        way = slice(first + 1, last + 1)
        found[way] = np.maximum(at, above[way]) if rises[first] else np.minimum(at, below[way])
        at = found[last]
    return found


FORMS = (Gap, GapAside, GapSeated, Closing, Backlash)
