"""Factors of codes on what damping devices must be able to do, and on what holds them.

ASCE/SEI 7-16 and FEMA 356 raise stroke and velocity by how many devices share a storey. EN 1998-1 raises the stroke of
isolators. No public text of these numbers could be read: compare them with your copy of the standard. Those of EN 15129
for dampers are not here: its text was not at hand, and what others quote of it could not be confirmed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from edesign.codes.ec8.analysis.isolation import GAMMA_X
from edesign.codes.names import unknown


@dataclass(frozen=True)
class DeviceFactors:
    """Factors on what histories ask of devices.

    Attributes:
        name: as in a study file; "" of numbers that the file gives.
        stroke: on the deformation of dampers.
        velocity: on their velocity.
        overstrength: on the force of the dampers, at the stroke and velocity times their factors, that braces and
            connections hold.
        isolator_stroke: on the deformation of isolators.
        clause: of the code.
    """

    name: str
    stroke: float = 1.0
    velocity: float = 1.0
    overstrength: float = 1.0
    isolator_stroke: float = 1.0
    clause: str = ""

    @property
    def unread(self) -> bool:
        """Whether the numbers are those of a standard that no text at hand confirmed."""
        return bool(self.clause)

    @property
    def on_dampers(self) -> bool:
        """Whether a factor on dampers, or on what holds them, is not 1."""
        return (self.stroke, self.velocity, self.overstrength) != (1.0, 1.0, 1.0)


NONE = DeviceFactors("none")
_ASCE7 = "ASCE/SEI 7-16, 18.2.4.6 (redundancy) and 18.2.1.2 (force-controlled elements)"
DEVICE_FACTORS: Mapping[str, DeviceFactors] = MappingProxyType(
    {
        found.name: found
        for found in (
            DeviceFactors("asce7", 1.3, 1.3, 1.2, clause=_ASCE7),
            DeviceFactors("asce7_redundant", overstrength=1.2, clause=_ASCE7),
            DeviceFactors("fema356", 2.0, 2.0, clause="FEMA 356, 9.3.1"),
            DeviceFactors("fema356_redundant", 1.3, 1.3, clause="FEMA 356, 9.3.1"),
            DeviceFactors("ec8", isolator_stroke=GAMMA_X, clause="EN 1998-1, 10.3(2)P"),
            NONE,
        )
    }
)
"""By name. ASCE/SEI 7 counts on redundancy where each storey has four devices in each direction, two of them on either
side of the centre of stiffness; FEMA 356 has 200 % without and 130 % with such devices."""
_BY_CODE: Mapping[str, str] = MappingProxyType({"asce7-16": "asce7", "asce7-22": "asce7", "ec8-2004": "ec8"})


def device_factors(name: str) -> DeviceFactors:
    """Return the factors of a name.

    Args:
        name: such as `asce7`.

    Raises:
        InputError: there are no such factors; the message names those there are.
    """
    if name not in DEVICE_FACTORS:
        raise unknown("set of device factors", name, DEVICE_FACTORS)
    return DEVICE_FACTORS[name]


def factors_of_code(code: str) -> DeviceFactors:
    """Return the factors that go with a code of the seismic action; none where it has none of its own.

    Args:
        code: such as "asce7-16".
    """
    return DEVICE_FACTORS[_BY_CODE[code]] if code in _BY_CODE else NONE
