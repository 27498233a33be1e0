"""What a sizing of dampers results in, whatever the method, and the stiffness of dampers and braces at their places."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.damper import sizing
from edesign.project.dampers.designs import ElastomerDesign
from edesign.study.design.building import Building
from edesign.study.design.elastomer.material import Moduli


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
    values: dict[str, float]


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


@dataclass(frozen=True)
class Sizing:
    """Dampers with layers of elastomer as a method sizes them.

    Attributes:
        target: damping ratio, or beta of the simplified method; nan: none.
        stiffness: k_D, horizontal storage stiffness of the dampers alone in each storey with dampers, (s,) N/m.
        moduli: of the elastomer.
        frequency: of the first mode, Hz.
        thickness: of a layer, m.
        area: of a layer, (s,) m2.
        brace: horizontal stiffness of the braces of each storey with dampers, (s,) N/m; None: rigid.
        iterations: how it was found.
        reason: why it is not good; empty if it is.
        strain: at which the properties were taken.
        strain_steps: on the way to it; none where it was given.
    """

    target: float
    stiffness: np.ndarray
    moduli: Moduli
    frequency: float
    thickness: float
    area: np.ndarray
    brace: np.ndarray | None
    iterations: tuple[Iteration, ...]
    reason: str = ""
    strain: float = math.nan
    strain_steps: tuple[StrainStep, ...] = ()

    def complex_stiffness(self, building: Building, braces: bool = True, moduli: Moduli | None = None) -> np.ndarray:
        """Return the complex stiffness K' + i K'' of the dampers at each place, (d,) N/m.

        Args:
            building: the frame with its places.
            braces: whether their braces are in series.
            moduli: of the elastomer; None: those of the design.
        """
        moduli = moduli or self.moduli
        k_D = self.stiffness * (moduli.G_storage / self.moduli.G_storage)
        return place_stiffness(building, k_D, moduli.loss_factor, self.brace if braces else None)


def place_stiffness(building: Building, k_D: np.ndarray, loss_factor: float, brace: np.ndarray | None) -> np.ndarray:
    """Return the complex stiffness of the dampers at each place, (d,) N/m.

    Args:
        building: the frame with its places.
        k_D: horizontal storage stiffness of the dampers of each storey, (s,) N/m.
        loss_factor: of the elastomer.
        brace: horizontal stiffness of the braces of each storey, (s,) N/m; None: rigid.
    """
    dampers = building.at_places(k_D) * (1.0 + 1.0j * loss_factor)
    return dampers if brace is None else sizing.in_series(dampers, building.at_places(brace))


def layers(building: Building, spec: ElastomerDesign) -> int:
    """Return the number of layers of one damper, as given or as in the prototype of the law.

    Args:
        building: the frame with its places and the law.
        spec: the design.
    """
    found = spec.layers if spec.layers is not None else building.law.layers
    assert found is not None, "the elastomer wants a prototype"
    return found


def layer_thickness(building: Building, spec: ElastomerDesign) -> float:
    """Return the thickness of the layers, m, as given or as the storey with the largest demand needs it.

    A layer of this thickness keeps the strain limit at the target drift.

    Args:
        building: the frame with its places.
        spec: the design.
    """
    if spec.layer_thickness is not None:
        return spec.layer_thickness
    assert spec.drift is not None and spec.strain_limit is not None, "check_design wants them"
    heights = building.heights[building.storeys - 1][building.place_storey]
    return max(
        sizing.layer_thickness(spec.drift, float(height), spec.strain_limit, float(cosine))
        for height, cosine in zip(heights, building.cosine, strict=True)
    )


def layer_areas(
    building: Building, spec: ElastomerDesign, k_D: np.ndarray, thickness: float, G_storage: float
) -> np.ndarray:
    """Return the area of one layer in each storey with dampers, (s,) m2.

    Args:
        building: the frame with its places.
        spec: the design.
        k_D: horizontal storage stiffness of the dampers of each storey, (s,) N/m.
        thickness: of a layer, m.
        G_storage: storage modulus of the elastomer, Pa.

    Source: thesis Eq. 5.14.
    """
    dampers = spec.number * building.attachment()
    return sizing.layer_area(k_D, thickness, G_storage, layers(building, spec), dampers)


def total_area(building: Building, spec: ElastomerDesign, area: np.ndarray) -> float:
    """Return the area of all layers of all dampers, m2.

    Args:
        building: the frame with its places.
        spec: the design.
        area: of one layer in each storey with dampers, (s,) m2.
    """
    return float(layers(building, spec) * spec.number * area[building.place_storey].sum())
