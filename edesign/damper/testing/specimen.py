"""The specimen of a damper test: layers of an elastomer in shear, side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from edesign.errors import InputError

LARGE_STRAIN = 3.0
"""Of elastomers in dampers: natural rubber breaks at 5 to 7, and laws are tested up to 0.5 to 2."""
_WIDEST = 500.0
"""Side of a layer as a square over its thickness: bearings of bridges, with the thinnest layers for their size, have up
to 200; a slip of a unit makes it 30 times as much or more."""

Value = TypeVar("Value", float, np.ndarray)


@dataclass(frozen=True)
class Specimen:
    """A damper of equal layers in parallel, all sheared by the same deformation.

    Attributes:
        name: of the specimen.
        layers: how many share the force.
        layer_area: of one layer, m2.
        layer_thickness: of one layer, m.
    """

    name: str
    layers: int
    layer_area: float
    layer_thickness: float

    def __post_init__(self) -> None:
        if self.layers < 1:
            raise InputError(f"specimen {self.name}: at least one layer is needed, not {self.layers} [E-TEST-01]")
        for what, value, unit in (("area", self.layer_area, "m2"), ("thickness", self.layer_thickness, "m")):
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(
                    f"specimen {self.name}: the {what} of a layer is {value:g} {unit}; it must be above 0 [E-TEST-01]"
                )

    @property
    def area(self) -> float:
        """Area that carries the force, m2."""
        return self.layers * self.layer_area

    def strain(self, displacement: Value) -> Value:
        """Return the shear strain of a displacement.

        Args:
            displacement: m.
        """
        return displacement / self.layer_thickness

    def displacement(self, strain: Value) -> Value:
        """Return the displacement of a shear strain, m.

        Args:
            strain: dimensionless.
        """
        return strain * self.layer_thickness

    def stress(self, force: Value) -> Value:
        """Return the shear stress of a force, Pa.

        Args:
            force: N.
        """
        return force / self.area

    def stiffness(self, shear_modulus: Value) -> Value:
        """Return the stiffness that a shear modulus gives, N/m.

        Args:
            shear_modulus: Pa.
        """
        return shear_modulus * self.area / self.layer_thickness


def layer_warning(area: float, thickness: float) -> str:
    """Return what is unlikely about the size of a layer, "" if nothing is.

    Args:
        area: m2.
        thickness: m.
    """
    side = math.sqrt(area)
    if thickness <= side <= _WIDEST * thickness:
        return ""
    size = f"a layer of {1e6 * area:.6g} mm2, as a square {1e3 * side:.6g} mm wide, is {1e3 * thickness:.6g} mm thick"
    return f"{size}: {'it bends rather than shears; ' if side < thickness else ''}are the units right?"
