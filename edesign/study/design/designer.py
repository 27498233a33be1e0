"""The parts of one design at hand: building, elastomer, action, and what is made of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from edesign.archive.dataset import Group
from edesign.damper.sizing import largest_damping
from edesign.errors import InputError
from edesign.project.dampers import Dampers
from edesign.project.designs import BraceRatio, Design, SimplifiedDesign, StrainEnergyDesign
from edesign.project.project import Project
from edesign.study.design.bounds import analyse_bounds
from edesign.study.design.building import Building, law_at, make_building, sized_dampers
from edesign.study.design.damping import modal_damping
from edesign.study.design.device_text import devices_text
from edesign.study.design.elastomer import Elastomer, elastomer, law_moduli
from edesign.study.design.estimate import Action, make_action
from edesign.study.design.loop import Round, RoundOutcome, Search, search
from edesign.study.design.results import store_bounds, store_estimate, store_iterations, store_rounds, store_sizing
from edesign.study.design.simplified import simplified_warnings, size_simplified
from edesign.study.design.sizing import Sizing
from edesign.study.design.strain_energy import size_by_strain_energy
from edesign.study.design.verification import Judge, Respond, judged, kept_outcome

_REACHABLE = 0.95  # of the largest damping: towards it the stiffness grows without limit
_LARGEST_FACTOR = 10.0  # on area or thickness
_CHANGED = {
    "target": "target damping ratio, or beta",
    "area": "factor on the area and stiffness of all dampers",
    "thickness": "factor on the thickness and area of all layers",
}


class Designer:
    """A design with its building, elastomer and action at hand."""

    def __init__(
        self, project: Project, name: str, spec: Design, folder: Path, progress: Callable[[str], None]
    ) -> None:
        self.name, self.spec, self.project, self.progress = name, spec, project, progress
        self.building: Building = make_building(project, name, spec)
        self.material_at = partial(elastomer, project, name, spec, folder)
        self.material = self.material_at(spec.temperature)
        self.action: Action | None = make_action(project, spec)

    @property
    def changed(self) -> str:
        """What the loop changes."""
        return self.spec.verify.change if self.spec.verify is not None else "target"

    def make(self, value: float) -> Sizing:
        """The dampers for a value of what the loop changes."""
        spec = self.spec
        area = value if self.changed == "area" else 1.0
        thickness = value if self.changed == "thickness" else 1.0
        if isinstance(spec, SimplifiedDesign):
            assert self.action is not None, "check_design wants a level"
            cold = None if spec.low_temperature is None else self.material_at(spec.low_temperature)
            least = value if self.changed == "target" else None
            return size_simplified(self.building, spec, self.material, cold, self.action, least, area, thickness)
        target = math.nan if spec.damping is None else spec.damping
        if self.changed == "target" and spec.damping is not None:
            target = value
        args = (self.building, spec, self.material, self.action, target, area, thickness)
        return size_by_strain_energy(*args)

    def range(self) -> tuple[float, float]:
        """First and largest value of what the loop changes."""
        spec = self.spec
        if self.changed != "target":
            return 1.0, _LARGEST_FACTOR
        if isinstance(spec, SimplifiedDesign):
            return spec.beta
        if spec.damping is None:
            return math.nan, math.nan
        ratio = math.inf
        if spec.braces_in_target and isinstance(spec.brace, BraceRatio):
            ratio = spec.brace.ratio
        moduli = self.material(self.building.frame.modes().first_frequency)
        limit = _REACHABLE * largest_damping(moduli.loss_factor, ratio)
        return spec.damping, max(limit, spec.damping)

    def search(
        self, respond: Respond | None, judge: Judge | None, resume: Group | None, keep: Callable[[Group], None] | None
    ) -> Search:
        """All rounds."""
        start, largest = self.range()
        verify = self.spec.verify
        if verify is None or respond is None or judge is None:
            sizing = self.make(start)
            only = Round(1, self._value(sizing, start), sizing)
            return Search((only,), only, sizing.reason)

        def outcome(sizing: Sizing, number: int, value: float) -> RoundOutcome:
            found = kept_outcome(resume, number, value, sizing)
            if found is not None:
                self.progress(f"round {number} is already there")
                return found
            self.progress(f"round {number}, {_CHANGED[self.changed]} {value:.4g}")
            return judged(respond(self.dampers(sizing), number), judge)

        def kept(rounds: Sequence[Round]) -> None:
            if keep is not None:
                last = rounds[-1]
                keep(self.group(Search(tuple(rounds), last, "the design is not complete"), "interrupted"))

        limits = (start, largest, verify.rounds, verify.precision)
        return search(self.make, outcome, *limits, kept, self._value)

    def dampers(self, sizing: Sizing) -> Dampers:
        """The project's dampers with those of a sizing."""
        building = self.building
        brace = None if sizing.brace is None else sizing.brace / building.attachment
        return sized_dampers(building, self.spec, sizing.area, sizing.thickness, brace)

    def group(self, done: Search, status: str) -> Group:
        """Everything that was found."""
        spec, building, sizing = self.spec, self.building, done.chosen.sizing
        group = Group(attributes=labels(spec) | {"status": status, "reason": done.reason})
        store_sizing(group, building, spec, sizing)
        store_iterations(group, done.rounds)
        store_rounds(group, building, done.rounds, _CHANGED[self.changed])
        group.attributes["chosen_round"] = done.chosen.number
        warnings = [warning for item in sizing.iterations for warning in item.moduli.warnings]
        warnings += self._law_moduli(group, sizing)
        if self.action is not None:
            store_estimate(group, building, sizing, self.action)
            if isinstance(spec, SimplifiedDesign):
                warnings += simplified_warnings(spec, self.action, sizing)
            if spec.bounds is not None:
                found = analyse_bounds(building, sizing, spec.bounds, self._bound_material, self.action)
                store_bounds(group, building, found)
        group.attributes["warnings"] = list(dict.fromkeys(warnings))
        group.attributes["devices"] = devices_text(self.dampers(sizing))
        return group

    def _value(self, sizing: Sizing, value: float) -> float:
        """The value that a sizing really has: the simplified method may take a larger beta than it is asked for."""
        return sizing.target if self.changed == "target" else value

    def _bound_material(self, temperature_C: float | None) -> Elastomer:
        return self.material if temperature_C is None else self.material_at(temperature_C)

    def _law_moduli(self, group: Group, sizing: Sizing) -> list[str]:
        """Add what the law itself says at the strain and frequency of the design."""
        law = law_at(self.project, self.spec.law, self.spec.temperature)
        try:
            moduli = law_moduli(law, self.spec.strain, sizing.frequency)
        except InputError as error:
            return [str(error)]
        frame = self.building.frame
        # areas are those of the design, so stiffness changes as the modulus does
        stiffness = sizing.complex_stiffness(self.building, moduli=moduli)
        damping = modal_damping(frame, frame.modes(), stiffness).strain_energy[0]
        group.attributes |= {
            "law_G_storage_Pa": moduli.G_storage,
            "law_loss_factor": moduli.loss_factor,
            "law_damping_strain_energy": float(damping),
        }
        return []


def labels(spec: Design) -> dict[str, Any]:
    """Attributes that say which design it is."""
    found: dict[str, Any] = {"method": spec.method, "law": spec.law, "kind": spec.kind, "bays": str(spec.bays)}
    found["state"] = spec.state
    if isinstance(spec, StrainEnergyDesign):
        found |= {"distribution": spec.distribution, "braces_in_target": spec.braces_in_target}
    return found
