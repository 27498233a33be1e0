"""Physical quantities that values in files can be: their names, SI units, and the magnitudes that they can have."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    """A physical quantity: its name, its SI unit, an example to show, and the magnitudes that it can have.

    Attributes:
        least: magnitude, SI, below which only zero is allowed.
        most: largest magnitude, SI.
    """

    name: str
    unit: str
    example: str
    least: float = 1e-30
    most: float = 1e30
    """Of what has no bounds of its own: the product of ten such numbers is still one of double precision."""
    large: tuple[float, str] | None = None
    """From which number on people mean another unit than that of the example, and which."""

    def written(self, number: str) -> str:
        """Return a bare number with the unit that it is likely to have."""
        unit = self.example.split(" ", 1)[1]
        if self.large is not None and abs(float(number)) >= self.large[0]:
            unit = self.large[1]
        return f"{number} {unit}"


# The bounds are wide: what lies beyond them is a slip of the power or of the unit. Each says what it is taken from.
KINDS = (
    LENGTH := Kind("length", "m", "3.5 m", 1e-10, 4.1e7, (100.0, "mm")),  # atoms in iron, 2.5e-10 m; the equator
    AREA := Kind("area", "m^2", "100 cm^2", 1e-12, 1e6),  # squares of a micrometre and of a kilometre
    INERTIA := Kind("second moment of area", "m^4", "33740 cm^4", 1e-24, 1e12),  # their fourth powers
    FORCE := Kind("force", "N", "120 kN", 1e-9, 1e13),  # the finest balances; the weight of 1e12 kg
    LINE_LOAD := Kind("force per length", "N/m", "23 kN/m", 1e-9, 1e13),  # that force on a metre
    STIFFNESS := Kind("stiffness", "N/m", "120 kN/mm", 1e-6, 1e18),  # 1e18: E A / L of 1 km^2 of steel 0.2 m long
    STRESS := Kind("stress", "Pa", "275 MPa", 1e-6, 1e15, (1e6, "Pa")),  # a thousand times diamond, E = 1.2e12 Pa
    MASS := Kind("mass", "kg", "29.5 t", 1e-9, 1e12),  # a microgram; the heaviest buildings have 1e10 kg
    TIME := Kind("time", "s", "0.01 s", 1e-12, 1.5e17),  # below any sampling; the age of the Earth
    ACCELERATION := Kind("acceleration", "m/s^2", "0.32 g", 1e-10, 1e6),  # seismometers; shock tables reach 1e5 g
    Kind("volume", "m^3", "1 m^3"),
    MOMENT := Kind("moment", "N*m", "10 kN*m", 1e-12, 1e16),  # those forces at a millimetre and at a kilometre
    VELOCITY := Kind("velocity", "m/s", "360 m/s", 1e-12, 3e8),  # creep of a micrometre in ten days; light
    DENSITY := Kind("density", "kg/m^3", "7850 kg/m^3", 1e-6, 1e6),  # osmium has 22 590; the rest is for added mass
    Kind("mass per length", "kg/m", "77.6 kg/m"),
    FREQUENCY := Kind("frequency", "1/s", "1 Hz", 1e-12, 1e12),  # of times within 1e-12 s to 30 000 years
    Kind("temperature", "K", "293 K"),
    NUMBER := Kind("number without dimension", "dimensionless", "1"),
    # of one dimension with those above, which are named where another quantity is needed
    AREA_LOAD := Kind("force per area", "N/m^2", "4.5 kN/m^2", 1e-9, 1e13),  # that force on a square metre
    ROTATIONAL_STIFFNESS := Kind("rotational stiffness", "N*m/rad", "50 MN*m/rad", 1e-9, 1e18),  # as of stiffness
    ENERGY := Kind("energy", "J", "25 kJ", 1e-15, 1e18),  # those forces over a micrometre; a magnitude of 8.8
    ROTATION := Kind("rotation", "rad", "0.002 rad", 1e-12, 1e9),  # a hinge that shall never end may have any
    ANGLE := Kind("angle", "rad", "90 deg", 1e-6, 6.2832),  # below what any sensor is set to; a whole turn
)
