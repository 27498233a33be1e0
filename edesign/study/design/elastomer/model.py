"""Dampers with layers of elastomer: complex stiffness, size and strain, by the properties of the elastomer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from edesign.damper import sizing
from edesign.project.dampers.designs import ElastomerDesign, SimplifiedDesign
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import ModalDamping, modal_damping, strain_energy_damping
from edesign.study.design.device_model import DeviceModel, Sizing
from edesign.study.design.elastomer.material import Material, Moduli
from edesign.study.design.estimate import Action, SpectralPeaks


@dataclass(frozen=True)
class Iteration:
    """One step of a method.

    Attributes:
        frequency: at which properties were taken, Hz.
        moduli: of the elastomer there.
        stiffness: k_D of the storeys with dampers, (s,) N/m.
        next_frequency: of the first mode with these dampers, Hz.
        damping: that they add to it, Eq. 5.6.
        values: what else the method looks at, by name.
    """

    frequency: float
    moduli: Moduli
    stiffness: np.ndarray
    next_frequency: float
    damping: float
    values: Mapping[str, float]


@dataclass(frozen=True)
class StrainStep:
    """One step of the strain towards the one that is reached.

    Attributes:
        strain: at which properties were taken.
        moduli: of the elastomer there, at the frequency of the frame with its dampers.
        reached: effective strain of these dampers.
    """

    strain: float
    moduli: Moduli
    reached: float


@dataclass(frozen=True, eq=False, kw_only=True)
class ElastomerSizing(Sizing):
    """Dampers with layers of elastomer of a size.

    Attributes:
        moduli: of the elastomer.
        frequency: of the first mode, Hz.
        thickness: of a layer, m.
        area: of a layer, (s,) m2.
        strain: at which the properties were taken.
        strain_steps: on the way to it; none where it was given.
    """

    moduli: Moduli
    frequency: float
    thickness: float
    area: np.ndarray
    strain: float
    strain_steps: tuple[StrainStep, ...] = ()


@dataclass(frozen=True)
class Layers:
    """Layers of elastomer at the strain, frequency and temperature at which they count.

    Attributes:
        stiffness: complex, of the dampers at each place with their braces, (d,) N/m.
        braces: stiffness of the braces in it, (d,) N/m; None: rigid.
        thickness: of a layer, m.
    """

    stiffness: np.ndarray
    braces: np.ndarray | None
    thickness: float


class ElastomerModel(DeviceModel[ElastomerDesign, Layers]):
    """Dampers with layers of elastomer and their braces in the frame of a design.

    Args:
        building: the frame with its places.
        action: the spectrum; None: there is none.
        material_at: the elastomer at a temperature (degC; None: that of the design).

    Attributes:
        material: the elastomer at the temperature of the design.
        share: what the strain of histories is of the estimated one, where they are followed.
        modal_damping: the damping that the dampers of a sizing add to each mode, with braces or (False) alone.
    """

    def __init__(
        self,
        building: Building,
        spec: ElastomerDesign,
        action: Action | None,
        material_at: Callable[[float | None], Material],
    ) -> None:
        super().__init__(building, spec, action)
        self.material_at = material_at
        self.material = material_at(spec.temperature)
        self.share = 1.0
        self.modal_damping = cache(self._modal_damping)

    @property
    def brace_ratio(self) -> float | None:
        """Stiffness of the braces of a storey over that of the storey; None: rigid."""
        return self.spec.alpha if isinstance(self.spec, SimplifiedDesign) else super().brace_ratio

    @property
    def layers(self) -> int:
        """The number of layers of one damper, as given or as in the prototype of the law."""
        found = self.spec.layers if self.spec.layers is not None else self.building.law.layers
        assert found is not None, "the elastomer wants a prototype"
        return found

    @property
    def thickness(self) -> float:
        """Thickness of the layers, m, as given or as it keeps the strain limit at the target drift in all storeys."""
        spec, building = self.spec, self.building
        if spec.layer_thickness is not None:
            return spec.layer_thickness
        assert spec.drift is not None and spec.strain_limit is not None, "check_design wants them"
        heights = building.heights[building.storeys - 1][building.place_storey]
        return max(
            sizing.layer_thickness(spec.drift, float(height), spec.strain_limit, float(cosine))
            for height, cosine in zip(heights, building.cosine, strict=True)
        )

    def areas(self, k_D: np.ndarray, thickness: float, G_storage: float) -> np.ndarray:
        """Return the area of one layer in each storey with dampers, (s,) m2.

        Args:
            k_D: horizontal storage stiffness of the dampers of each storey, (s,) N/m.
            thickness: of a layer, m.
            G_storage: storage modulus of the elastomer, Pa.

        Source: thesis Eq. 5.14.
        """
        return sizing.layer_area(k_D, thickness, G_storage, self.layers, self.spec.number * self.building.attachment())

    def total_area(self, area: np.ndarray) -> float:
        """Return the area of all layers of all dampers, m2.

        Args:
            area: of one layer in each storey with dampers, (s,) m2.
        """
        return float(self.layers * self.spec.number * area[self.building.place_storey].sum())

    def stiffness(self, k_D: np.ndarray, loss_factor: float, braces: bool = True) -> np.ndarray:
        """Return the complex stiffness of the dampers at each place, (d,) N/m.

        Args:
            k_D: horizontal storage stiffness of the dampers of each storey, (s,) N/m.
            braces: whether their braces are in series.
        """
        dampers = self.at_places(k_D) * (1.0 + 1.0j * loss_factor)
        series = self.braces if braces else None
        return dampers if series is None else sizing.in_series(dampers, series)

    def of(self, found: ElastomerSizing, braces: bool = True, moduli: Moduli | None = None) -> np.ndarray:
        """Return the complex stiffness K' + i K'' of the dampers of a sizing at each place, (d,) N/m.

        Args:
            braces: whether their braces are in series.
            moduli: of the elastomer; None: those of the design.
        """
        moduli = moduli or found.moduli
        return self.stiffness(found.size * (moduli.G_storage / found.moduli.G_storage), moduli.loss_factor, braces)

    def _modal_damping(self, found: ElastomerSizing, braces: bool = True) -> ModalDamping:
        return modal_damping(self.building.frame, self.bare, self.of(found, braces))

    def complex_stiffness(self, state: Layers) -> np.ndarray:
        """Return the complex stiffness of dampers and braces at each place, (d,) N/m."""
        return state.stiffness

    def storage(self, state: Layers) -> np.ndarray:
        """Return the stiffness of dampers and braces at each place with which the modes are found, (d,) N/m."""
        return state.stiffness.real

    def added_damping(self, state: Layers, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio that the dampers add to each of the modes with their storage, (n,)."""
        return strain_energy_damping(modes, state.stiffness)

    def demands(
        self, state: Layers, modes: LinearModes, peaks: SpectralPeaks
    ) -> tuple[np.ndarray, Mapping[str, np.ndarray]]:
        """Return the largest force of the dampers at each place, (d,) N, and the strain of their layers."""
        deformation = peaks.combined(modes.dampers)
        share = 1.0 if state.braces is None else np.abs(1.0 - state.stiffness / state.braces)  # in the elastomer
        return deformation * np.abs(state.stiffness), {"strain": deformation * share / state.thickness}

    def estimated_strain(self, k_D: np.ndarray, loss_factor: float, thickness: float, braces: bool = True) -> float:
        """Return the effective strain of dampers at the peaks that the response spectrum estimates.

        Args:
            k_D: storage stiffness of the dampers of each storey, (s,) N/m.
            thickness: of a layer, m.
            braces: whether their braces are in series.
        """
        assert self.action is not None, "check_design wants a level"
        state = Layers(self.stiffness(k_D, loss_factor, braces), self.braces if braces else None, thickness)
        return effective_strain(self.at_places(k_D), self.estimate(state, self.action).dampers["strain"])


def effective_strain(stiffness: np.ndarray, strain: np.ndarray) -> float:
    """Return the one strain whose properties stand for dampers that strain differently.

    The mean of the strains, each weighted with the energy of its damper. With it the sums of stored and of lost energy
    are right to first order: both are proportional to G(gamma) V gamma^2, and the terms in the slope of G cancel.

    Args:
        stiffness: storage stiffness of each damper, (d,) N/m, in proportion to the volume V of its elastomer.
        strain: amplitude of each, (d,).
    """
    energy = stiffness * strain**2
    return float(energy @ strain / energy.sum())
