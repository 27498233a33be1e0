"""The design of hysteretic dampers: frame with loops at hand, sizing, bounds, and what it alone archives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.hysteresis import hysteresis
from edesign.errors import AnalysisError, InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import SET_IN, restrained_misfits
from edesign.project.dampers.designs import DESIGNED_BRACES, HystereticDesign
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.bounds import Bound
from edesign.study.design.building import law_at, make_building, per_storey, read_law
from edesign.study.design.condensed import LinearModes
from edesign.study.design.designer import Designer
from edesign.study.design.estimate import Action, FrameEstimate
from edesign.study.design.hysteretic.model import HystereticModel, SecantVibration
from edesign.study.design.hysteretic.results import HYSTERETIC, store_curve
from edesign.study.design.hysteretic.sizing import (
    LARGEST_SHARE,
    HystereticSizing,
    largest_hysteretic_damping,
    size_hysteretic,
)
from edesign.study.design.hysteretic.vibration import secant_vibration
from edesign.study.design.loop import Search
from edesign.study.design.optimum import optimum_warnings
from edesign.study.design.plausibility import short_of_target
from edesign.study.design.reach import REACHABLE
from edesign.study.design.relaxation import AGREEMENT
from edesign.study.design.results import of_storeys

_MOST_TURNS = 50  # of braces and the frame that stands by them; given shears take two


class HystereticDesigner(Designer[HystereticSizing]):
    """The sizing and verification of a design of hysteretic dampers.

    Raises:
        InputError: the law does not yield or slip, or has layers.
    """

    words = {
        "target": "damping ratio, or share of the storey shears",
        "yield_force": "factor on the yield forces of all dampers",
    }
    results = HYSTERETIC
    model: HystereticModel

    def __init__(
        self,
        project: AnalysisFile,
        name: str,
        spec: HystereticDesign,
        progress: Callable[[str], None],
        beside: Standing = NOTHING_BESIDE,
    ) -> None:
        restrained = law_at(project, spec.law, None).restrained is not None  # the law of a file, too
        for run in spec.runs if restrained else ():
            for key, message in restrained_misfits(run.kind, spec.brace, DESIGNED_BRACES).items():
                raise InputError(f"designs.{name}.{key}: {message}")
        if spec.carries_gravity and not restrained:
            raise InputError(f"designs.{name}.carries_gravity: {SET_IN.format(spec.law)}")
        super().__init__(project, name, spec, progress, beside)
        self.spec = spec
        if spec.damping is None:
            self.target_word = "share of the storey shears"
        self._carried: tuple[float, ...] | None = None
        self.model = self._model()

    def _model(self) -> HystereticModel:
        loop = read_law(self.building, self.name, self.spec, hysteresis)
        return HystereticModel(self.building, self.spec, loop, self.action)

    @property
    def target(self) -> float:
        """The damping ratio, the share of the storey shears, or the least share of an optimum."""
        spec = self.spec
        found = spec.optimum.range[0] if spec.optimum is not None else spec.damping or spec.shear_share
        assert found is not None, "check_design wants a target"
        return found

    def largest(self, target: float) -> float:
        """Return the largest share of the storey shears, or the damping ratio that dampers may reach."""
        if self.spec.optimum is not None:
            return self.spec.optimum.range[1]
        if self.spec.damping is None:
            return LARGEST_SHARE
        return max(REACHABLE * largest_hysteretic_damping(self.model), target)

    def sized(self, target: float, factor: float) -> HystereticSizing:
        """Size the dampers for a target, with a factor on their yield forces.

        Braces that carry gravity loads are part of the frame that they are sized in, so both are found in turns.

        Raises:
            AnalysisError: the braces that were found and those that stand in the frame do not agree.
        """
        found = size_hysteretic(self.model, target, factor)
        if not self.spec.carries_gravity:
            return found
        for _ in range(_MOST_TURNS):
            before = found.size
            self.take(found)
            found = size_hysteretic(self.model, target, factor)
            if float(np.max(np.abs(found.size - before) / before)) <= AGREEMENT:
                return found
        raise AnalysisError(
            f"braces and the gravity loads that they carry did not agree to {AGREEMENT:g} within {_MOST_TURNS} turns"
            " [E-DESIGN-02]"
        )

    def take(self, sizing: HystereticSizing) -> None:
        """Let the frame stand by the braces of a sizing, where they carry gravity loads."""
        scale = self.device(sizing)["scale"]
        if not self.spec.carries_gravity or scale == self._carried:
            return
        self._carried = scale
        self.building = make_building(self.project, self.name, self.spec, self.building.beside, {"scale": scale})
        self.model = self._model()

    def device(self, sizing: HystereticSizing) -> dict[str, Any]:
        """Return the keys of a device of the project file that say how large the dampers of a sizing are."""
        size = {"scale": per_storey(self.model.of_device(sizing.size) / self.model.loop.yield_force)}
        if self.building.law.restrained is None:  # modes count a restrained brace as it is before it yields
            size["design_deformation"] = per_storey(of_storeys(self.building, sizing.vibration.deformation))
        return size

    def modes(self, sizing: HystereticSizing) -> tuple[LinearModes, LinearModes]:
        """Return the modes with dampers that do not yield, and with their secants."""
        return self.model.elastic_modes(sizing.size), sizing.vibration.modes

    def frequency(self, sizing: HystereticSizing) -> float:
        """Return the frequency of the first mode with the dampers of a sizing, Hz."""
        return 1.0 / sizing.vibration.period

    def state(self, sizing: HystereticSizing) -> SecantVibration:
        """Return the vibration with the secants of a sizing."""
        return sizing.vibration

    def bound(
        self, sizing: HystereticSizing, action: Action, name: str, factor: float, temperature_C: float | None
    ) -> Bound:
        """Estimate the response with a bound of the forces, at the amplitude of its own spectrum."""
        vibration = secant_vibration(self.model, factor * sizing.size, action)
        response = self.model.estimate(vibration, action)
        return Bound(name, factor, None, factor, vibration.period, vibration.damping, response)

    def store_steps(self, group: Group, done: Search[HystereticSizing], status: str) -> None:
        """Add the curve over the share of the storey shears."""
        if status != "interrupted":
            store_curve(group, self.model, done.chosen.sizing)

    def further(self, group: Group, done: Search[HystereticSizing], found: FrameEstimate | None) -> list[str]:
        """Return what is implausible, a sentence each."""
        spec, sizing = self.spec, done.chosen.sizing
        warnings = short_of_target(sizing)
        if spec.optimum is not None and spec.verify is not None and done.chosen.outcome is not None:
            warnings += optimum_warnings(done.rounds, spec.optimum.range, spec.optimum.least, spec.verify.precision)
        strain = self.model.core_strain(sizing.vibration.secants.stroke)
        warnings += self._strained(strain, "at the amplitude of the design")
        if found is not None:
            warnings += self._strained(found.dampers.get("core_strain"), "in the estimate")
        return warnings

    def _strained(self, strain: np.ndarray | None, where: str) -> list[str]:
        """A warning where cores strain beyond what the manufacturer's values are known for."""
        restrained = self.building.law.restrained
        if restrained is None or strain is None or float(strain.max()) <= restrained.tested_strain:
            return []
        known = f"omega and beta are known up to {100.0 * restrained.tested_strain:g} %"
        return [f"cores strain by {100.0 * float(strain.max()):.3g} % {where}, and {known}"]
