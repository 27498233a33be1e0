"""The design of hysteretic dampers: frame with loops at hand, sizing, optimum, bounds, and everything kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.hysteresis import hysteresis
from edesign.errors import InputError
from edesign.project.dampers.dampers import Dampers, restrained_misfits
from edesign.project.dampers.designs import DESIGNED_BRACES, HystereticDesign
from edesign.project.project import Project
from edesign.study.design.bounds import NAMES, Bound, property_factors
from edesign.study.design.building import law_at, per_storey, sized_dampers
from edesign.study.design.designer import REACHABLE, Designer, labels
from edesign.study.design.device_text import devices_text
from edesign.study.design.estimate import Action
from edesign.study.design.hysteretic.estimate import HystereticEstimate, bare_estimate, hysteretic_estimate
from edesign.study.design.hysteretic.model import HystereticFrame
from edesign.study.design.hysteretic.results import (
    store_hysteretic_bounds,
    store_hysteretic_curve,
    store_hysteretic_estimate,
    store_hysteretic_rounds,
    store_hysteretic_sizing,
    store_objectives,
)
from edesign.study.design.hysteretic.sizing import (
    LARGEST_SHARE,
    HystereticSizing,
    largest_hysteretic_damping,
    size_hysteretic,
)
from edesign.study.design.loop import LARGEST_FACTOR, Search
from edesign.study.design.optimum import optimum_warnings, search_optimum
from edesign.study.design.results import of_storeys
from edesign.study.design.verification import Judge, Respond


class HystereticDesigner(Designer[HystereticSizing]):
    """The sizing and verification of a design of hysteretic dampers.

    Raises:
        InputError: the law does not yield or slip, or has layers.
    """

    words = {
        "target": "damping ratio, or share of the storey shears",
        "yield_force": "factor on the yield forces of all dampers",
    }

    def __init__(self, project: Project, name: str, spec: HystereticDesign, progress: Callable[[str], None]) -> None:
        if law_at(project, spec.law, None).restrained is not None:  # the law of a file, too
            for key, message in restrained_misfits(spec.kind, spec.brace, DESIGNED_BRACES).items():
                raise InputError(f"designs.{name}.{key}: {message}")
        super().__init__(project, name, spec, progress)
        self.spec = spec
        self.frame = HystereticFrame(self.building, spec, self.read_law(hysteresis), self.action)

    def make(self, value: float) -> HystereticSizing:
        """Size the dampers for a value of the quantity that the loop changes."""
        if self.changed == "target":
            return size_hysteretic(self.frame, value)
        return size_hysteretic(self.frame, self._target, value)

    def range(self) -> tuple[float, float]:
        """Return the first and the largest value of the quantity that the loop changes."""
        if self.spec.optimum is not None:
            return self.spec.optimum.range
        target = self._target
        if self.changed != "target":
            return 1.0, LARGEST_FACTOR
        if self.spec.damping is None:
            return target, LARGEST_SHARE
        if self.spec.verify is None:
            return target, target
        return target, max(REACHABLE * largest_hysteretic_damping(self.frame), target)

    @property
    def _target(self) -> float:
        found = self.spec.shear_share if self.spec.damping is None else self.spec.damping
        assert found is not None, "check_design wants a target"
        return found

    def search(
        self, respond: Respond | None, judge: Judge | None, resume: Group | None, keep: Callable[[Group], None] | None
    ) -> Search[HystereticSizing]:
        """Size the dampers round by round until the criteria are met, or the objective of an optimum is least.

        Args:
            respond: runs the histories of a round; None: the design is not verified.
            judge: judges the histories of a round; None: the design is not verified.
            resume: the group that an earlier run kept; None: none.
            keep: called with the group after each round, for `resume`; None: nothing is kept.

        Returns:
            All rounds and the chosen one.
        """
        optimum, verify = self.spec.optimum, self.spec.verify
        if optimum is None or verify is None or respond is None or judge is None:
            return super().search(respond, judge, resume, keep)
        tried, limits = self.outcomes(respond, judge, resume), (verify.rounds, verify.precision)
        return search_optimum(self.make, tried, optimum.range, optimum.least, *limits, self.kept(keep))

    def dampers(self, sizing: HystereticSizing) -> Dampers:
        """Return the project's dampers with those of a sizing."""
        brace = None if sizing.brace is None else sizing.brace / self.building.attachment()
        scale = self.device_yield_force(sizing) / self.frame.loop.yield_force
        size = {"scale": per_storey(scale)}
        if self.building.law.restrained is None:  # modes count a restrained brace as it is before it yields
            amplitude = of_storeys(self.building, sizing.vibration.deformation)
            size["design_deformation"] = per_storey(amplitude)
        return sized_dampers(self.building, self.spec, brace, size)

    def size(self, sizing: HystereticSizing) -> Mapping[str, float | np.ndarray]:
        """Return the yield forces of the dampers of a sizing, by the name of the archived variable."""
        return {"device_yield_force": self.device_yield_force(sizing)}

    def device_yield_force(self, sizing: HystereticSizing) -> np.ndarray:
        """Return the yield or slip force of one damper in each storey with dampers, (s,) N."""
        return sizing.yield_force / (self.spec.number * self.building.attachment(1.0))

    def group(self, done: Search[HystereticSizing], status: str) -> Group:
        """Return the archived group of a design of hysteretic dampers.

        Args:
            done: all rounds and the chosen one.
            status: completed, failed, interrupted or checked.
        """
        spec, frame, sizing = self.spec, self.frame, done.chosen.sizing
        group = Group(attributes=labels(spec) | {"status": status, "reason": done.reason})
        store_hysteretic_sizing(group, frame, sizing, self.device_yield_force(sizing))
        if status != "interrupted":
            store_hysteretic_curve(group, frame, sizing)
        devices = [self.device_yield_force(r.sizing) for r in done.rounds]
        store_hysteretic_rounds(group, done.rounds, devices, self.words[self.changed])
        group.attributes["chosen_round"] = done.chosen.number
        group.attributes["warnings"] = []
        if spec.optimum is not None and spec.verify is not None and done.chosen.outcome is not None:
            store_objectives(group, done.rounds, spec.optimum)
            about = (spec.optimum.range, spec.optimum.least, spec.verify.precision)
            group.attributes["warnings"] = optimum_warnings(done.rounds, *about)
        strain = frame.core_strain(sizing.vibration.secants.stroke)
        group.attributes["warnings"] += self._strained(strain, "at the amplitude of the design")
        if self.action is not None:
            found = hysteretic_estimate(frame, sizing.yield_force, sizing.vibration, self.action)
            bare = bare_estimate(frame, self.action)
            store_hysteretic_estimate(group, self.building, spec.number, found, bare)
            group.attributes["warnings"] += self._strained(found.core_strain, "in the estimate")
            if spec.bounds is not None:
                store_hysteretic_bounds(group, self.building, self._bounds(sizing, self.action))
        group.attributes["devices"] = devices_text(self.dampers(sizing))
        return group

    def _strained(self, strain: np.ndarray | None, where: str) -> list[str]:
        """A warning where cores strain beyond what the manufacturer's values are known for."""
        restrained = self.building.law.restrained
        if restrained is None or strain is None or float(strain.max()) <= restrained.tested_strain:
            return []
        known = f"omega and beta are known up to {100.0 * restrained.tested_strain:g} %"
        return [f"cores strain by {100.0 * float(strain.max()):.3g} % {where}, and {known}"]

    def _bounds(self, sizing: HystereticSizing, action: Action) -> tuple[Bound[HystereticEstimate], ...]:
        """The response with lower, nominal and upper forces, each at the amplitude of its own spectrum."""
        assert self.spec.bounds is not None
        low, high = property_factors(self.spec.bounds)
        return tuple(
            self._bound(factor * sizing.yield_force, name, factor, action)
            for name, factor in zip(NAMES, (low, 1.0, high), strict=True)
        )

    def _bound(self, forces: np.ndarray, name: str, factor: float, action: Action) -> Bound[HystereticEstimate]:
        vibration = self.frame.vibration(forces, action)
        response = hysteretic_estimate(self.frame, forces, vibration, action)
        return Bound(name, factor, None, factor, vibration.period, vibration.damping, response)
