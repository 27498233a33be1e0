"""The design of viscous dampers: frame with dashpots at hand, sizing, bounds, and what it alone archives."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.dashpot import dashpot
from edesign.damper.harmonic import complex_stiffness
from edesign.errors import InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.designs import ViscousDesign
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.bounds import Bound
from edesign.study.design.building import per_storey, read_law
from edesign.study.design.designer import Designer
from edesign.study.design.estimate import Action, FrameEstimate
from edesign.study.design.fully_stressed import StoreySizes, storey_sizes
from edesign.study.design.loop import Search
from edesign.study.design.plausibility import estimate_warnings, short_of_target
from edesign.study.design.reach import REACHABLE
from edesign.study.design.results import of_storeys
from edesign.study.design.viscous.dashpot_modes import DashpotModes
from edesign.study.design.viscous.model import Vibration, ViscousModel
from edesign.study.design.viscous.plausibility import viscous_warnings
from edesign.study.design.viscous.results import VISCOUS
from edesign.study.design.viscous.sizing import (
    MOST,
    ViscousSizing,
    coefficient_unit,
    largest_viscous_damping,
    size_viscous,
    sized_viscous,
)


class ViscousDesigner(Designer[ViscousSizing]):
    """The sizing and verification of a design of viscous dampers.

    Raises:
        InputError: the law is no viscous dashpot, or has layers; or its amplitude is needed and not known.
    """

    words = {"target": "target damping ratio", "coefficient": "factor on the coefficients of all dampers"}
    results = VISCOUS
    model: ViscousModel

    def __init__(
        self,
        project: AnalysisFile,
        name: str,
        spec: ViscousDesign,
        progress: Callable[[str], None],
        beside: Standing = NOTHING_BESIDE,
    ) -> None:
        super().__init__(project, name, spec, progress, beside)
        self.spec = spec
        found = read_law(self.building, name, spec, dashpot)
        if found.alpha < 1.0 and spec.amplitude is None and self.action is None:
            message = (
                f"this key is missing (or `level`): with alpha = {found.alpha:g} damping follows the amplitude"
                " [E-KEY-02]"
            )
            raise InputError(f"designs.{name}.amplitude: {message}")
        self.model = ViscousModel(self.building, spec, found, self.action)

    @property
    def target(self) -> float:
        """The damping ratio; nan: a drift."""
        return math.nan if self.spec.damping is None else self.spec.damping

    def largest(self, target: float) -> float:
        """Return the largest damping ratio that dampers may reach."""
        return max(REACHABLE * largest_viscous_damping(self.model), target)

    def sized(self, target: float, factor: float) -> ViscousSizing:
        """Size the dampers for a target, with a factor on their coefficients."""
        return size_viscous(self.model, target, factor)

    def least(self) -> tuple[ViscousSizing, StoreySizes, Callable[[np.ndarray], ViscousSizing]] | None:
        """Return what a search for the least sum of coefficients starts from; None: the distribution is another."""
        model = self.model
        if self.spec.distribution != "least_coefficient":
            return None
        assert self.action is not None, "check_design wants a level"
        first = self.make(1.0)
        start = first.vibration
        unit, weight = coefficient_unit(model, model.weight(start), start.omega)
        inherent = 2.0 * self.action.inherent_damping  # omega c / k_S of the damping ratio of a storey by itself
        sizes = storey_sizes(self.building, first.size, unit, weight, inherent, MOST)
        return first, sizes, lambda x: self.braced(lambda: sized_viscous(model, x * unit, start))

    def device(self, sizing: ViscousSizing) -> dict[str, Any]:
        """Return the keys of a device of the project file that say how large the dampers of a sizing are."""
        size: dict[str, Any] = {"scale": per_storey(self.model.of_device(sizing.size) / self.model.dashpot.c)}
        if math.isfinite(sizing.vibration.roof):
            size["design_deformation"] = per_storey(of_storeys(self.building, sizing.vibration.deformation))
        return size

    def modes(self, sizing: ViscousSizing) -> DashpotModes:
        """Return the complex modes with linear dashpots."""
        return sizing.vibration.modes

    def frequency(self, sizing: ViscousSizing) -> float:
        """Return the frequency of the first mode with the dampers of a sizing, Hz."""
        return sizing.vibration.omega / (2.0 * math.pi)

    def state(self, sizing: ViscousSizing) -> Vibration:
        """Return the vibration with the linear dashpots of a sizing."""
        return sizing.vibration

    def bound(
        self, sizing: ViscousSizing, action: Action, name: str, factor: float, temperature_C: float | None
    ) -> Bound:
        """Estimate the response with a bound of the coefficients, at the amplitude of its own spectrum."""
        model = self.model
        vibration = model.in_agreement(factor * sizing.size, sizing.vibration, action)
        period, damping = 2.0 * math.pi / vibration.omega, vibration.modes.first_damping
        return Bound(name, factor, None, factor, period, damping, model.estimate(vibration, action))

    def further(self, group: Group, done: Search[ViscousSizing], found: FrameEstimate | None) -> list[str]:
        """Add the damping by the law itself; return what is implausible, a sentence each."""
        sizing = done.chosen.sizing
        group.attributes["law_damping_strain_energy"] = self._law_damping(sizing)
        warnings = [*short_of_target(sizing), *viscous_warnings(self.model, sizing, found)]
        if found is not None and self.spec.distribution == "least_coefficient":
            warnings += estimate_warnings(self.spec, done, float(found.drift.max()))
        return warnings

    def _law_damping(self, sizing: ViscousSizing) -> float:
        """Damping of the first mode by the law's own steady vibration in the core, behind its brace."""
        model, vibration = self.model, sizing.vibration
        law, omega = self.building.law.law, vibration.omega
        scale = model.at_places(sizing.size) / model.dashpot.c
        brace = np.zeros(scale.size) if model.braces is None else model.braces
        # whatever the amplitude, a linear law is the same
        deformation = vibration.deformation if math.isfinite(vibration.roof) else np.ones(scale.size)
        stiffness = np.array(
            [
                s * complex_stiffness(law, u, omega / (2.0 * math.pi), k / s)
                for s, u, k in zip(scale, deformation, brace, strict=True)
            ]
        )
        return model.first_damping(stiffness)
