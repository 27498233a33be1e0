"""The design of dampers of elastomer: elastomer at hand, sizing by its method, and what it alone archives."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.sizing import largest_damping
from edesign.errors import InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.designs import ElastomerDesign, SimplifiedDesign, StrainEnergyDesign
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.bounds import Bound
from edesign.study.design.building import law_at, per_storey
from edesign.study.design.damping import ModalDamping
from edesign.study.design.designer import Designer
from edesign.study.design.elastomer.distribution import MOST, area_weight
from edesign.study.design.elastomer.frequency_consistent import AtFrequency, agreed, at_consistent_frequency
from edesign.study.design.elastomer.material import Moduli, law_moduli, material
from edesign.study.design.elastomer.model import ElastomerModel, ElastomerSizing, Layers, effective_strain
from edesign.study.design.elastomer.plausibility import elastomer_warnings
from edesign.study.design.elastomer.results import ELASTOMER, store_steps
from edesign.study.design.elastomer.simplified import simplified_warnings, size_simplified, static_drift
from edesign.study.design.elastomer.strain_consistent import at_consistent_strain, history_strain
from edesign.study.design.elastomer.strain_energy import size_by_strain_energy
from edesign.study.design.estimate import Action, FrameEstimate
from edesign.study.design.fully_stressed import StoreySizes, storey_sizes
from edesign.study.design.loop import Round, Search
from edesign.study.design.plausibility import estimate_warnings
from edesign.study.design.reach import REACHABLE
from edesign.study.design.relaxation import Relaxation
from edesign.study.design.results import of_storeys


class ElastomerDesigner(Designer[ElastomerSizing]):
    """The sizing and verification of a design of dampers with layers of elastomer.

    Raises:
        InputError: the law has no layers.
    """

    words = {
        "target": "target damping ratio, or beta",
        "area": "factor on the area and stiffness of all dampers",
        "thickness": "factor on the thickness and area of all layers",
    }
    results = ELASTOMER
    model: ElastomerModel

    def __init__(
        self,
        project: AnalysisFile,
        name: str,
        spec: ElastomerDesign,
        folder: Path,
        progress: Callable[[str], None],
        beside: Standing = NOTHING_BESIDE,
    ) -> None:
        if law_at(project, spec.law, spec.temperature).layers is None:
            message = f"the law `{spec.law}` has no `prototype`: it has no layers to be sized [E-DESIGN-03]"
            raise InputError(f"designs.{name}.law: {message}")
        if spec.level is None and spec.verify is not None and spec.verify.levels:
            spec = spec.model_copy(update={"level": spec.verify.levels[0]})  # of what is estimated beside the sizing
        super().__init__(project, name, spec, progress, beside)
        self.spec = spec
        if isinstance(spec, SimplifiedDesign):
            self.target_word = "beta"
        self.model = ElastomerModel(self.building, spec, self.action, partial(material, project, name, spec, folder))
        self._relaxed, self._relax = math.nan, Relaxation()

    @property
    def target(self) -> float:
        """Least beta of the simplified method, else the damping ratio; nan: a drift."""
        if isinstance(self.spec, SimplifiedDesign):
            return self.spec.beta[0]
        return math.nan if self.spec.damping is None else self.spec.damping

    def largest(self, target: float) -> float:
        """Return the largest beta of the simplified method, else the damping ratio that dampers may reach."""
        spec = self.spec
        if isinstance(spec, SimplifiedDesign):
            return spec.beta[1]
        ratio = float(self.model.ratios.min()) if spec.counts_braces else math.inf
        strain = spec.strain if isinstance(spec.strain, float) else self.make(target).strain
        moduli = self.model.material(strain)(self.model.bare.first_frequency)
        return max(REACHABLE * largest_damping(moduli.loss_factor, ratio), target)

    def sized(self, target: float, factor: float) -> ElastomerSizing:
        """Size the dampers for a target, with a factor on areas or thicknesses."""
        factors = (factor, 1.0) if self.changed == "area" else (1.0, factor)
        if isinstance(self.spec, SimplifiedDesign):
            return size_simplified(self.model, self.spec, target, *factors)
        return size_by_strain_energy(self.model, self.spec, target, *factors)

    def least(
        self,
    ) -> tuple[ElastomerSizing, StoreySizes, Callable[[np.ndarray], ElastomerSizing]] | None:
        """Return what a search for the least area starts from; None: one number changes the dampers."""
        spec, building = self.spec, self.building
        if not (isinstance(spec, StrainEnergyDesign) and spec.distribution == "least_area" and self.changed == "area"):
            return None
        assert self.action is not None, "check_design wants a level"
        first, unit = self.make(1.0), building.designed_stiffness
        inherent = 2.0 * self.action.inherent_damping / first.moduli.loss_factor
        sizes = storey_sizes(building, first.size, unit, area_weight(building), inherent, MOST)
        return (
            first,
            sizes,
            lambda x: self.braced(lambda: size_by_strain_energy(self.model, spec, math.nan, given=x * unit)),
        )

    def device(self, sizing: ElastomerSizing) -> dict[str, Any]:
        """Return the keys of a device of the project file that say how large the dampers of a sizing are."""
        model = self.model
        size: dict[str, Any] = {
            "layers": model.layers,
            "layer_area": per_storey(sizing.area),
            "layer_thickness": sizing.thickness,
            "strain_limit": self.spec.strain_limit,
        }
        if isinstance(self.spec.strain, str):  # the modes of the variant count at the strain that was found
            alone, braced = (model.of(sizing, braces) for braces in (False, True))
            behind = sizing.strain * sizing.thickness * np.abs(alone / braced)
            size["design_deformation"] = per_storey(of_storeys(self.building, behind))
        return size

    def modes(self, sizing: ElastomerSizing) -> list[ModalDamping]:
        """Return the modes with dampers alone, and with dampers and braces."""
        return [self.model.modal_damping(sizing, braces) for braces in (False, True)]

    def frequency(self, sizing: ElastomerSizing) -> float:
        """Return the frequency of the first mode with the dampers of a sizing, Hz."""
        return sizing.frequency

    def state(self, sizing: ElastomerSizing) -> Layers:
        """Return the layers of a sizing with the properties that it counts on."""
        return Layers(self.model.of(sizing), self.model.braces, sizing.thickness)

    def bound(
        self, sizing: ElastomerSizing, action: Action, name: str, factor: float, temperature_C: float | None
    ) -> Bound:
        """Estimate the response with a bound of the properties; where the strain is followed, each has its own."""
        model = self.model
        elastomer = model.material if temperature_C is None else model.material_at(temperature_C)

        def ratio(moduli: Moduli) -> float:
            return factor * moduli.G_storage / sizing.moduli.G_storage

        def solve(strain: float) -> tuple[AtFrequency, FrameEstimate]:
            k_D, start = lambda moduli: ratio(moduli) * sizing.size, sizing.frequency
            at = agreed(at_consistent_frequency(model, elastomer(strain), k_D, start))
            return at, model.estimate(Layers(at.stiffness, model.braces, sizing.thickness), action)

        def reached(found: tuple[AtFrequency, FrameEstimate]) -> float:
            return model.share * effective_strain(model.at_places(sizing.size), found[1].dampers["strain"])

        at, response = at_consistent_strain(
            model, solve, lambda found: found[0].last.moduli, reached, sizing.strain
        ).found
        period = 2.0 * np.pi / at.modes.first_omega
        return Bound(name, factor, temperature_C, ratio(at.last.moduli), period, at.last.damping, response)

    def taken_strain(self, sizing: ElastomerSizing) -> float:
        """Return the strain of histories at which the properties of a sizing were taken; nan where it is not theirs."""
        return sizing.strain if self.spec.strain == "histories" else math.nan

    def strain(self, sizing: ElastomerSizing, histories: Sequence[Group]) -> float:
        """Return the effective strain of the layers in histories of a sizing."""
        return history_strain(self.model.at_places(sizing.size), histories)

    def settled(self, last: Round[ElastomerSizing]) -> bool:
        """Return whether the strain agrees with the histories, and adapt the estimated share if it does not."""
        if not super().settled(last):
            return False
        verify, outcome = self.spec.verify, last.outcome
        if self.spec.strain != "histories" or verify is None or outcome is None:
            return True
        taken, reached = last.sizing.strain, outcome.strain
        if not math.isfinite(reached) or abs(reached - taken) <= verify.precision * taken:
            return True
        if self._relaxed != last.changed:  # strains of other dampers say nothing of how those of these change
            self._relaxed, self._relax = last.changed, Relaxation()
        following = self._relax(np.log([taken]), np.log([reached]))
        self.model.share *= float(np.exp(following[0])) / taken
        return False

    def store_steps(self, group: Group, done: Search[ElastomerSizing], status: str) -> None:
        """Add lateral forces, and the steps of the strain."""
        store_steps(group, self.model, done.rounds)

    def further(self, group: Group, done: Search[ElastomerSizing], found: FrameEstimate | None) -> list[str]:
        """Add the law's own moduli, and the estimated strain; return what is implausible, a sentence each."""
        spec, sizing = self.spec, done.chosen.sizing
        warnings = [*sizing.moduli.warnings, *self._law_moduli(group, sizing)]
        if self.action is not None and found is not None:
            if isinstance(spec, SimplifiedDesign):
                warnings += simplified_warnings(spec, self.action, sizing)
                warnings += estimate_warnings(self.spec, done, min(static_drift(step) for step in sizing.iterations))
            elif spec.distribution == "least_area":
                warnings += estimate_warnings(self.spec, done, float(found.drift.max()))
        in_histories = math.nan if done.chosen.outcome is None else done.chosen.outcome.strain
        if found is not None:
            k_D = self.model.at_places(sizing.size)
            group.attributes["estimated_strain"] = effective_strain(k_D, found.dampers["strain"])
        return [*warnings, *elastomer_warnings(self.model, sizing, found, in_histories)]

    def _law_moduli(self, group: Group, sizing: ElastomerSizing) -> list[str]:
        """Add what the law itself says at the strain and frequency of the design."""
        law = law_at(self.project, self.spec.law, self.spec.temperature)
        try:
            moduli = law_moduli(law, sizing.strain, sizing.frequency)
        except InputError as error:
            return [str(error)]
        # areas are those of the design, so stiffness changes as the modulus does
        damping = self.model.first_damping(self.model.of(sizing, moduli=moduli))
        group.attributes |= {
            "law_G_storage_Pa": moduli.G_storage,
            "law_loss_factor": moduli.loss_factor,
            "law_damping_strain_energy": damping,
        }
        return []
