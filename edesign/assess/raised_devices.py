"""What histories ask of dampers of a design, raised by the factors of a code: stroke, velocity, force by the law."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.device_factors import NONE, DeviceFactors
from edesign.damper.factored import force_ratio
from edesign.frame.devices import DeviceLaw


@dataclass(frozen=True)
class RaisedDevices:
    """What raises the values that dampers of a design are ordered with, and that their braces hold.

    Attributes:
        factors: of a code, or of the study.
        law: of the dampers, by which their force follows; None: it is not known, and the force is left out.
        note: where the factors come from.
    """

    factors: DeviceFactors = NONE
    law: DeviceLaw | None = None
    note: str = ""

    @property
    def raises(self) -> bool:
        """Whether stroke or velocity have a factor."""
        return (self.factors.stroke, self.factors.velocity) != (1.0, 1.0)

    def of(self, design: Group, storey: int, values: Mapping[str, float | None]) -> dict[str, float]:
        """Return values with their factors; none where all factors are 1.

        Args:
            design: designs/NAME of an archive.
            storey: which of those with dampers, from 0.
            values: of one damper, SI, by name.
        """
        if not self.raises:
            return {}
        stroke, velocity = self.factors.stroke, self.factors.velocity
        by = {"stroke": stroke, "velocity": velocity, "core_strain": stroke, "strain": stroke}
        found = {name: factor * value for name, factor in by.items() if (value := values.get(name)) is not None}
        force, ratio = values.get("force"), self.ratio(design, storey, values)
        return found if force is None or math.isnan(ratio) else found | {"force": force * ratio}

    def ratio(self, design: Group, storey: int, values: Mapping[str, float | None]) -> float:
        """Return the force of a damper of a storey at the raised stroke and velocity over that at those of histories.

        Args:
            values: stroke (m) and velocity (m/s) of one damper.

        Returns:
            The ratio by the law of the damper; nan where it is not known.
        """
        if not self.raises:
            return 1.0
        stroke, velocity = values.get("stroke"), values.get("velocity")
        if self.law is None or stroke is None:
            return math.nan
        scale = float(_deformation_scale(design, self.law)[storey])
        speed = None if velocity is None else scale * velocity
        return force_ratio(self.law.law, scale * stroke, speed, self.factors.stroke, self.factors.velocity)


def _deformation_scale(design: Group, law: DeviceLaw) -> np.ndarray:
    """Deformation of the law over that of the dampers of each storey, (s,): of cores by length, layers by thickness."""
    ones, restrained = np.ones(design.coords["storey"].values.size), law.restrained
    if restrained is not None and "device_yield_deformation" in design.variables:
        return restrained.yield_deformation / np.asarray(design.variables["device_yield_deformation"].values)
    if law.layer_thickness is not None and "layer_thickness_m" in design.attributes:
        return ones * law.layer_thickness / float(str(design.attributes["layer_thickness_m"]))
    return ones
