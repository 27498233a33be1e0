"""Vertical elastic response spectrum, EN 1998-1:2004, 3.2.2.3."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.codes.ec8.action.elastic import ComponentSpectrum
from edesign.codes.ec8.action.parameters import VerticalParameters


@dataclass(frozen=True)
class VerticalSpectrum(ComponentSpectrum):
    """Elastic response spectrum S_ve(T) of the vertical component; no soil factor enters.

    Source: EN 1998-1:2004, 3.2.2.3(1)P, Eqs. 3.8-3.11.
    """

    parameters: VerticalParameters
    label: str = "EN 1998-1 elastic, vertical"

    @property
    def peak_factor(self) -> float:
        """The ratio a_vg / a_g."""
        return self.parameters.ratio
