"""How dampers are distributed over the height in proportion to something of the frame."""

from __future__ import annotations

import numpy as np

from edesign.study.design.building import Building, storey_shears


def pattern_of(building: Building, distribution: str) -> np.ndarray:
    """Return a distribution over the storeys with dampers, (s,) N/m, whose mean is that of their stiffnesses.

    Args:
        building: the frame with its places.
        distribution: storey_stiffness, uniform, strain_energy or storey_shear.

    Source: storey_stiffness: thesis Eq. 5.9. uniform: equal in all storeys. In proportion to the first mode without
        dampers, Hwang, Lin and Wu (2013), Structure and Infrastructure Engineering 9(1): strain_energy to the shear
        strain energy of the storey, storey_shear to its shear.
    """
    stiffness = building.designed_stiffness
    if distribution == "storey_stiffness":
        return stiffness
    if distribution == "uniform":
        return np.full(stiffness.size, stiffness.mean() or 1.0)  # 0: the frame stands by its dampers alone
    chosen = building.storeys - 1
    lead = building.frame.modes().lead
    if distribution == "storey_shear":
        share = storey_shears(building.frame.at_floors(lead.loads))[chosen]
    else:
        share = building.computed_stiffness[chosen] * lead.storeys[chosen] ** 2
    return np.asarray(share * (stiffness.mean() / share.mean()))
