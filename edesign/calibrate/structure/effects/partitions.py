"""Partitions and cladding: stiffness that the declared frame does not have, until they break."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.links import BreakingSpring, Link
from edesign.calibrate.unknown import Unknown


class _Partitions(StructuralEffect):
    name: ClassVar[str] = "partitions"
    signature: ClassVar[str] = (
        "the measured frequencies are higher than those of the frame; where partitions break they fall after the "
        "largest drift and stay low in later tests"
    )
    source: ClassVar[str] = "Chopra, Dynamics of Structures, 11.1; FEMA P-58-1, 3.8 (drift fragilities of partitions)"


def _storeys(building: Building) -> range:
    return range(1 if building.isolated else 0, building.floors)


class Uniform(_Partitions):
    """Every storey is stiffer by a share r."""

    form = "uniform"
    title = "added stiffness in all storeys"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        return (Unknown("r", "", -0.8, 10.0, 0.5),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((0.1,),) if len(_storeys(setting.building)) else ()

    def building(self, p: Values, building: Building) -> Building:
        factor = np.ones(building.floors)
        factor[list(_storeys(building))] += p["r"]
        return replace(building, stiffness=building.stiffness * factor)


class Storey(_Partitions):
    """One storey is stiffer by a share r."""

    def __init__(self, storey: int) -> None:
        self.storey = storey
        self.form = f"storey_{storey + 1}"
        self.title = f"added stiffness in storey {storey + 1}"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        return (Unknown("r", "", -0.8, 10.0, 0.5),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((0.1,),)

    def building(self, p: Values, building: Building) -> Building:
        factor = np.ones(building.floors)
        factor[self.storey] += p["r"]
        return replace(building, stiffness=building.stiffness * factor)


class Lost(_Partitions):
    """Every storey has r k exp(-(M/d)^2) u beside its own, with M its largest drift ever."""

    form = "lost"
    title = "added stiffness that is lost with the largest drift"
    remembers: ClassVar[bool] = True

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        drift = float(np.max(setting.drift[list(_storeys(setting.building))]))
        return (
            Unknown("r", "", 1e-3, 10.0, 0.5, logarithmic=True),
            Unknown("d", "m", 0.02 * drift, 20.0 * drift, drift, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        storeys = list(_storeys(setting.building))
        if not storeys:
            return ()
        drift = float(np.max(setting.drift[storeys]))
        return tuple((0.2, share * drift) for share in (0.15, 0.5, 1.5))

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return [BreakingSpring(i, p["r"] * float(building.stiffness[i]), p["d"]) for i in _storeys(building)]


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    storeys = _storeys(setting.building)
    return (Uniform(), Lost(), *(Storey(i) for i in storeys if len(storeys) > 1))
