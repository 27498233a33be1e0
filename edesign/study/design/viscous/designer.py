"""The design of viscous dampers: frame with dashpots at hand, sizing, bounds, and everything kept."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.dashpot import dashpot
from edesign.damper.harmonic import complex_stiffness
from edesign.errors import InputError
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.designs import ViscousDesign
from edesign.project.project import Project
from edesign.study.design.bounds import NAMES, Bound, property_factors
from edesign.study.design.building import per_storey, sized_dampers
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.designer import REACHABLE, Designer, labels
from edesign.study.design.device_text import devices_text
from edesign.study.design.estimate import Action
from edesign.study.design.fully_stressed import StoreySizes
from edesign.study.design.loop import LARGEST_FACTOR, Search
from edesign.study.design.results import of_storeys
from edesign.study.design.viscous.estimate import ViscousEstimate, viscous_estimate
from edesign.study.design.viscous.least_coefficient import storey_sizes
from edesign.study.design.viscous.model import ViscousFrame
from edesign.study.design.viscous.plausibility import viscous_warnings
from edesign.study.design.viscous.results import (
    store_viscous_bounds,
    store_viscous_estimate,
    store_viscous_iterations,
    store_viscous_rounds,
    store_viscous_sizing,
)
from edesign.study.design.viscous.sizing import ViscousSizing, largest_viscous_damping, size_viscous, sized_viscous


class ViscousDesigner(Designer[ViscousSizing]):
    """The sizing and verification of a design of viscous dampers.

    Raises:
        InputError: the law is no viscous dashpot, or has layers; or its amplitude is needed and not known.
    """

    words = {"target": "target damping ratio", "coefficient": "factor on the coefficients of all dampers"}

    def __init__(self, project: Project, name: str, spec: ViscousDesign, progress: Callable[[str], None]) -> None:
        super().__init__(project, name, spec, progress)
        self.spec = spec
        found = self.read_law(dashpot)
        if found.alpha < 1.0 and spec.amplitude is None and self.action is None:
            message = f"this key is missing (or `level`): with alpha = {found.alpha:g} damping follows the amplitude"
            raise InputError(f"designs.{name}.amplitude: {message}")
        self.frame = ViscousFrame(self.building, spec, found, self.action)

    def make(self, value: float) -> ViscousSizing:
        """Size the dampers for a value of the quantity that the loop changes."""
        target = math.nan if self.spec.damping is None else self.spec.damping
        if self.changed == "target":
            return size_viscous(self.frame, value if self.spec.damping is not None else target)
        return size_viscous(self.frame, target, value)

    def range(self) -> tuple[float, float]:
        """Return the first and the largest value of the quantity that the loop changes."""
        if self.changed != "target":
            return 1.0, LARGEST_FACTOR
        damping = self.spec.damping
        if damping is None:
            return math.nan, math.nan
        if self.spec.verify is None:
            return damping, damping
        return damping, max(REACHABLE * largest_viscous_damping(self.frame), damping)

    def least(self) -> tuple[ViscousSizing, StoreySizes] | None:
        """Return the dampers of the least estimated sum, and their sizes; None: the design has another distribution."""
        if self.spec.distribution != "least_coefficient":
            return None
        self._first = self.make(1.0)
        sizes, self._unit = storey_sizes(self.frame, self._first.coefficient, self._first.vibration)
        return self._first, sizes

    def made(self, sizes: np.ndarray) -> ViscousSizing:
        """Return dampers whose coefficients are sizes (s,) times those with omega c = k_S in the first round."""
        return sized_viscous(self.frame, sizes * self._unit, self._first.vibration)

    def dampers(self, sizing: ViscousSizing) -> Dampers:
        """Return the project's dampers with those of a sizing."""
        brace = None if sizing.brace is None else sizing.brace / self.building.attachment()
        scale = self.device_coefficient(sizing) / self.frame.dashpot.c
        size: dict[str, object] = {"scale": per_storey(scale)}
        if math.isfinite(sizing.vibration.roof):
            size["design_deformation"] = per_storey(of_storeys(self.building, sizing.vibration.deformation))
        return sized_dampers(self.building, self.spec, brace, size)

    def size(self, sizing: ViscousSizing) -> Mapping[str, float | np.ndarray]:
        """Return the coefficients of the dampers of a sizing, by the name of the archived variable."""
        return {"device_coefficient": self.device_coefficient(sizing)}

    def device_coefficient(self, sizing: ViscousSizing) -> np.ndarray:
        """Return the coefficient of one damper in each storey with dampers, (s,) N (s/m)^alpha."""
        return sizing.coefficient / (self.spec.number * self.building.attachment(self.frame.power))

    def group(self, done: Search[ViscousSizing], status: str) -> Group:
        """Return the archived group of a design of viscous dampers.

        Args:
            done: all rounds and the chosen one.
            status: completed, failed, interrupted or checked.
        """
        spec, frame, sizing = self.spec, self.frame, done.chosen.sizing
        group = Group(attributes=labels(spec) | {"status": status, "reason": done.reason})
        store_viscous_sizing(group, frame, sizing, self.device_coefficient(sizing))
        store_viscous_iterations(group, done.rounds)
        devices = [self.device_coefficient(r.sizing) for r in done.rounds]
        store_viscous_rounds(group, done.rounds, devices, self.words[self.changed])
        group.attributes["chosen_round"] = done.chosen.number
        group.attributes["law_damping_strain_energy"] = self._law_damping(sizing)
        found = None
        if self.action is not None:
            found = viscous_estimate(frame, sizing.coefficient, sizing.vibration, self.action)
            nothing = frame.undamped(0.0)
            bare = viscous_estimate(frame, 0.0 * sizing.coefficient, nothing, self.action)
            store_viscous_estimate(group, self.building, spec.number, found, bare)
            if spec.bounds is not None:
                store_viscous_bounds(group, self.building, self._bounds(sizing, self.action))
        group.attributes["warnings"] = list(viscous_warnings(frame, sizing, found))
        if found is not None and spec.distribution == "least_coefficient":
            group.attributes["warnings"] += self.doubts(done, float(found.drift.max()))
        group.attributes["devices"] = devices_text(self.dampers(sizing))
        return group

    def _law_damping(self, sizing: ViscousSizing) -> float:
        """Damping of the first mode by the law's own steady vibration in the core, behind its brace."""
        frame, vibration = self.frame, sizing.vibration
        law, omega = self.building.law.law, vibration.omega
        scale = frame.at_places(sizing.coefficient) / frame.dashpot.c
        brace = np.zeros(scale.size) if sizing.brace is None else self.building.at_places(sizing.brace)
        # whatever the amplitude, a linear law is the same
        deformation = vibration.deformation if math.isfinite(vibration.roof) else np.ones(scale.size)
        stiffness = np.array(
            [
                s * complex_stiffness(law, u, omega / (2.0 * math.pi), k / s)
                for s, u, k in zip(scale, deformation, brace, strict=True)
            ]
        )
        return float(strain_energy_damping(self.building.frame.modes(stiffness.real), stiffness)[0])

    def _bounds(self, sizing: ViscousSizing, action: Action) -> tuple[Bound[ViscousEstimate], ...]:
        """The response with lower, nominal and upper coefficients, each at the amplitude of its own spectrum."""
        assert self.spec.bounds is not None
        low, high = property_factors(self.spec.bounds)
        return tuple(
            self._bound(sizing, name, factor, action) for name, factor in zip(NAMES, (low, 1.0, high), strict=True)
        )

    def _bound(self, sizing: ViscousSizing, name: str, factor: float, action: Action) -> Bound[ViscousEstimate]:
        frame, coefficient = self.frame, factor * sizing.coefficient
        vibration = frame.in_agreement(coefficient, sizing.vibration, lambda modes: frame.spectral_roof(modes, action))
        response = viscous_estimate(frame, coefficient, vibration, action)
        period = 2.0 * math.pi / vibration.omega
        return Bound(name, factor, None, factor, period, vibration.modes.first_damping, response)
