"""The design of dampers of elastomer: elastomer at hand, sizing by its method, and everything kept."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.sizing import largest_damping
from edesign.errors import InputError
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.designs import BraceRatio, ElastomerDesign, SimplifiedDesign, StrainEnergyDesign
from edesign.project.project import Project
from edesign.study.design.building import law_at, per_storey, sized_dampers
from edesign.study.design.damping import modal_damping
from edesign.study.design.designer import REACHABLE, Designer, labels
from edesign.study.design.device_text import devices_text
from edesign.study.design.elastomer.bounds import analyse_bounds
from edesign.study.design.elastomer.least_area import storey_sizes
from edesign.study.design.elastomer.material import Material, law_moduli, material
from edesign.study.design.elastomer.own_strain import history_strain
from edesign.study.design.elastomer.plausibility import elastomer_warnings
from edesign.study.design.elastomer.results import (
    store_elastomer_bounds,
    store_elastomer_estimate,
    store_elastomer_iterations,
    store_elastomer_rounds,
    store_elastomer_sizing,
    store_strain_steps,
)
from edesign.study.design.elastomer.simplified import simplified_warnings, size_simplified, static_drift
from edesign.study.design.elastomer.sizing import Sizing, layers
from edesign.study.design.elastomer.strain_energy import size_by_strain_energy
from edesign.study.design.fully_stressed import StoreySizes
from edesign.study.design.loop import LARGEST_FACTOR, Round, Search
from edesign.study.design.relaxation import Relaxation
from edesign.study.design.results import of_storeys


class ElastomerDesigner(Designer[Sizing]):
    """The sizing and verification of a design of dampers with layers of elastomer.

    Raises:
        InputError: the law has no layers.
    """

    words = {
        "target": "target damping ratio, or beta",
        "area": "factor on the area and stiffness of all dampers",
        "thickness": "factor on the thickness and area of all layers",
    }

    def __init__(
        self, project: Project, name: str, spec: ElastomerDesign, folder: Path, progress: Callable[[str], None]
    ) -> None:
        if law_at(project, spec.law, spec.temperature).layers is None:
            message = f"the law `{spec.law}` has no `prototype`: it has no layers to be sized"
            raise InputError(f"designs.{name}.law: {message}")
        if spec.level is None and spec.verify is not None and spec.verify.levels:
            spec = spec.model_copy(update={"level": spec.verify.levels[0]})  # of what is estimated beside the sizing
        super().__init__(project, name, spec, progress)
        self.spec = spec
        self.material_at = partial(material, project, name, spec, folder)
        self.material = self.material_at(spec.temperature)
        self.share = 1.0  # of the estimated strain that the histories have
        self._relaxed, self._relax = math.nan, Relaxation()

    def make(self, value: float) -> Sizing:
        """Size the dampers for a value of the quantity that the loop changes."""
        spec = self.spec
        area = value if self.changed == "area" else 1.0
        thickness = value if self.changed == "thickness" else 1.0
        if isinstance(spec, SimplifiedDesign):
            assert self.action is not None, "check_design wants a level"
            cold = None if spec.low_temperature is None else self.material_at(spec.low_temperature)
            least = value if self.changed == "target" else None
            factors = (least, area, thickness, self.share)
            return size_simplified(self.building, spec, self.material, cold, self.action, *factors)
        target = math.nan if spec.damping is None else spec.damping
        if self.changed == "target" and spec.damping is not None:
            target = value
        args = (self.building, spec, self.material, self.action, target, area, thickness, self.share)
        return size_by_strain_energy(*args)

    def range(self) -> tuple[float, float]:
        """Return the first and the largest value of the quantity that the loop changes."""
        spec = self.spec
        if self.changed != "target":
            return 1.0, LARGEST_FACTOR
        if isinstance(spec, SimplifiedDesign):
            return spec.beta
        if spec.damping is None:
            return math.nan, math.nan
        ratio = math.inf
        if spec.braces_in_target and isinstance(spec.brace, BraceRatio):
            ratio = spec.brace.ratio
        strain = spec.strain if isinstance(spec.strain, float) else self.make(spec.damping).strain
        moduli = self.material(strain)(self.building.frame.modes().first_frequency)
        limit = REACHABLE * largest_damping(moduli.loss_factor, ratio)
        return spec.damping, max(limit, spec.damping)

    def least(self) -> tuple[Sizing, StoreySizes] | None:
        """Return the dampers of the least estimated area, and their sizes; None: one number changes the dampers."""
        spec = self.spec
        if not (isinstance(spec, StrainEnergyDesign) and spec.distribution == "least_area" and self.changed == "area"):
            return None
        assert self.action is not None, "check_design wants a level"
        first = self.make(1.0)
        return first, storey_sizes(self.building, first.stiffness, first.moduli.loss_factor, self.action)

    def made(self, sizes: np.ndarray) -> Sizing:
        """Return dampers of the stiffness sizes (s,) times that of their storey."""
        spec, building = self.spec, self.building
        assert isinstance(spec, StrainEnergyDesign)
        wanted = sizes * building.designed_stiffness
        return size_by_strain_energy(
            building, spec, self.material, self.action, math.nan, share=self.share, given=wanted
        )

    def dampers(self, sizing: Sizing) -> Dampers:
        """Return the project's dampers with those of a sizing."""
        building = self.building
        brace = None if sizing.brace is None else sizing.brace / building.attachment()
        size: dict[str, object] = {
            "layers": layers(building, self.spec),
            "layer_area": per_storey(sizing.area),
            "layer_thickness": sizing.thickness,
            "strain_limit": self.spec.strain_limit,
        }
        if isinstance(self.spec.strain, str):  # the modes of the variant count at the strain that was found
            alone, braced = (sizing.complex_stiffness(building, braces) for braces in (False, True))
            behind = sizing.strain * sizing.thickness * np.abs(alone / braced)
            size["design_deformation"] = per_storey(of_storeys(building, behind))
        return sized_dampers(building, self.spec, brace, size)

    def size(self, sizing: Sizing) -> Mapping[str, float | np.ndarray]:
        """Return strain, layer thickness and layer areas of a sizing, by the name of the archived variable."""
        return {"strain": sizing.strain, "layer_thickness": sizing.thickness, "layer_area": sizing.area}

    def strain(self, sizing: Sizing, histories: Mapping[str, Group]) -> float:
        """Return the effective strain of the layers in the histories at the level of the design, else at the first.

        Args:
            sizing: the dampers of the round.
            histories: results of its histories, by name.
        """
        return history_strain(self.building.at_places(sizing.stiffness), self.at_level(histories))

    def settled(self, last: Round[Sizing]) -> bool:
        """Return whether the strain agrees with the histories, and adapt the estimated share if it does not."""
        verify, outcome = self.spec.verify, last.outcome
        if self.spec.strain != "histories" or verify is None or outcome is None:
            return True
        taken, reached = last.sizing.strain, outcome.strain
        if not math.isfinite(reached) or abs(reached - taken) <= verify.precision * taken:
            return True
        if self._relaxed != last.changed:  # strains of other dampers say nothing of how those of these change
            self._relaxed, self._relax = last.changed, Relaxation()
        following = self._relax(np.log([taken]), np.log([reached]))
        self.share *= float(np.exp(following[0])) / taken
        return False

    def group(self, done: Search[Sizing], status: str) -> Group:
        """Return the archived group of a design of dampers with layers of elastomer.

        Args:
            done: all rounds and the chosen one.
            status: completed, failed, interrupted or checked.
        """
        spec, building, sizing = self.spec, self.building, done.chosen.sizing
        group = Group(attributes=labels(spec) | {"status": status, "reason": done.reason})
        store_elastomer_sizing(group, building, spec, sizing)
        store_elastomer_iterations(group, done.rounds)
        store_strain_steps(group, done.rounds)
        store_elastomer_rounds(group, building, done.rounds, self.words[self.changed])
        group.attributes["chosen_round"] = done.chosen.number
        warnings = list(sizing.moduli.warnings)
        warnings += self._law_moduli(group, sizing)
        found = None
        if self.action is not None:
            found = store_elastomer_estimate(group, building, sizing, self.action)
            if isinstance(spec, SimplifiedDesign):
                warnings += simplified_warnings(spec, self.action, sizing)
                warnings += self.doubts(done, min(static_drift(step) for step in sizing.iterations))
            elif spec.distribution == "least_area":
                warnings += self.doubts(done, float(found.drift.max()))
            if spec.bounds is not None:
                bounds = analyse_bounds(building, sizing, spec, self._bound_material, self.action, self.share)
                store_elastomer_bounds(group, building, bounds)
        in_histories = math.nan if done.chosen.outcome is None else done.chosen.outcome.strain
        warnings += elastomer_warnings(building, spec, sizing, self.material, self.action, found, in_histories)
        group.attributes["warnings"] = list(dict.fromkeys(warnings))
        group.attributes["devices"] = devices_text(self.dampers(sizing))
        return group

    def _bound_material(self, temperature_C: float | None) -> Material:
        return self.material if temperature_C is None else self.material_at(temperature_C)

    def _law_moduli(self, group: Group, sizing: Sizing) -> list[str]:
        """Add what the law itself says at the strain and frequency of the design."""
        law = law_at(self.project, self.spec.law, self.spec.temperature)
        try:
            moduli = law_moduli(law, sizing.strain, sizing.frequency)
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
