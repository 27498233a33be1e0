"""Dampers of other designs that stand in the frame of a design while it is sized."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.project.dampers.dampers import DamperLaw, Dampers, Device


@dataclass(frozen=True)
class Standing:
    """The dampers of a design that is made, as they stand in the frame of another one.

    Attributes:
        laws: those that its dampers have, at their temperatures.
        devices: with the sizes that were found.
        stiffness: complex, of all dampers of a place with their brace, N/m, by the name of the place: at the amplitude
            and the frequency of the design that found them.
    """

    laws: Mapping[str, DamperLaw] = field(default_factory=dict)
    devices: tuple[Device, ...] = ()
    stiffness: Mapping[str, complex] = field(default_factory=dict)


NOTHING_BESIDE = Standing()


def standing(dampers: Dampers, names: Sequence[str], stiffness: np.ndarray) -> Standing:
    """Return the dampers of a design as others see them.

    Args:
        names: of its places, (d,).
        stiffness: complex, of the dampers there, (d,) N/m.
    """
    used = dampers.used_laws
    laws = {name: law for name, law in dampers.laws.items() if name in used}
    return Standing(laws, dampers.devices, dict(zip(names, stiffness.tolist(), strict=True)))


def standing_of(several: Sequence[Standing]) -> Standing:
    """Return the dampers of several designs, of which no two have a place in common."""
    found = NOTHING_BESIDE
    for one in several:
        found = Standing(
            {**found.laws, **one.laws}, (*found.devices, *one.devices), {**found.stiffness, **one.stiffness}
        )
    return found
