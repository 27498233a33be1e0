"""Flexibility of the rig between the displacement transducer and the specimen."""

from __future__ import annotations

from typing import ClassVar

from edesign.calibrate.dampers.effect import Form, Series
from edesign.calibrate.dampers.trial import Sizes, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

CLOSES = 0.03
"""Share of the largest force that closes a joint: below it is a clearance that is crossed, above it a soft part."""
CLEARANCE = 5.0
"""Times as stiff as before is a joint that has closed: what is stiffer yet has had a clearance."""
_OPENS = 0.05  # of the stiffness before is left in a joint that opens: with less the damper would stand still


class Linear(Form):
    """A spring in series: the specimen deforms by u - F / stiffness."""

    name: ClassVar[str] = "series_flexibility"
    form: ClassVar[str] = "linear"
    kind: ClassVar[Kind] = "rig"
    title: ClassVar[str] = "flexible parts of the rig in series with the specimen"
    signature: ClassVar[str] = (
        "forces too small where the specimen is stiffest (fast, cold), in proportion to the square of its stiffness"
    )
    source: ClassVar[str] = "two springs in series"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = sizes.stiffness
        return (Unknown("stiffness", "N/m", 1.5 * k, 1e4 * k, 20.0 * k, logarithmic=True),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        # its force goes with 1 / stiffness: searches from too flexible are short, from too stiff they jump
        return ((20.0 * sizes.stiffness,),)

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"])


class Stiffening(Linear):
    """A spring in series that stiffens: F = stiffness e (1 + (e/e0)^2), e its stretch, as bolted joints and bearings
    do.
    """

    form: ClassVar[str] = "stiffening"
    title: ClassVar[str] = "parts of the rig in series with the specimen that stiffen with the force"
    signature: ClassVar[str] = "as series_flexibility.linear, and more of it at small forces than at large ones"
    source: ClassVar[str] = "joints that close: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (*super().unknowns(sizes), Unknown("e0", "m", 1e-4 * u, 10.0 * u, 0.05 * u, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (
            (20.0 * sizes.stiffness, 0.05 * sizes.displacement),
            (10.0 * sizes.stiffness, 0.02 * sizes.displacement),
        )

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], bend=1.0 / p["e0"] ** 2)

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """One spring: that does not stiffen."""
        return ((Linear(), p),)


class Damped(Linear):
    """A spring in series with a dashpot beside it: F = stiffness (e + t_r e'), as grout, pads and bolted joints lose
    work.
    """

    form: ClassVar[str] = "damped"
    title: ClassVar[str] = "flexible parts of the rig in series with the specimen that lose work"
    signature: ClassVar[str] = "as series_flexibility.linear, and less of it the faster the force changes"
    source: ClassVar[str] = "Kelvin and Voigt's element in series: Christensen (1982), Theory of Viscoelasticity, 1.6"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("t_r", "s", 0.0, 1.0 / sizes.frequency, 0.02 / sizes.frequency))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((20.0 * sizes.stiffness, 0.02 / sizes.frequency),)

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], damping=p["stiffness"] * p["t_r"])

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """One spring: that loses no work."""
        return ((Linear(), p),)


class Power(Linear):
    """Bodies in contact: the force goes with a power of their approach, 3/2 as of spheres (Hertz), or more: F = F_r
    (e/e_r)^n, e_r = F_r/stiffness, F_r half the largest force.
    """

    form: ClassVar[str] = "power"
    title: ClassVar[str] = "contacts of the rig in series with the specimen that stiffen with a power of their approach"
    signature: ClassVar[str] = "as series_flexibility.linear, and ever more of it at small forces"
    source: ClassVar[str] = (
        "Johnson (1985), Contact Mechanics, section 4.2 (Hertz); rough surfaces: Greenwood & Williamson (1966)"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("n", "", 1.05, 12.0, 1.5, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((20.0 * sizes.stiffness, n) for n in (1.5, 4.0))

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"F_r": 0.5 * sizes.force}

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], bend=(p["stiffness"] / p["F_r"]) ** 2, power=p["n"])

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """One spring: n = 1."""
        return ((Linear(), p),)


class Closing(Linear):
    """A joint that closes: stiffness up to a force F_c, `ratio` times as stiff beyond, as where shims bed in; below 1
    it opens or slips there, as a bolted one.
    """

    form: ClassVar[str] = "closing"
    title: ClassVar[str] = "a joint of the rig in series with the specimen that closes or opens under a force"
    signature: ClassVar[str] = "as series_flexibility.linear up to a force, and less of it beyond, or more"
    source: ClassVar[str] = "piecewise linear joints: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        force = sizes.force
        return (
            *super().unknowns(sizes),
            Unknown("F_c", "N", CLOSES * force, 1.5 * force, 0.3 * force, logarithmic=True),
            Unknown("ratio", "", _OPENS, CLEARANCE, 2.0, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        own = ((0.15, 2.0), (0.4, 2.0), (0.75, 2.0), (0.3, 0.4))
        return tuple((20.0 * sizes.stiffness, share * sizes.force, ratio) for share, ratio in own)

    def series(self, p: Values) -> Series:
        k = p["stiffness"]
        return Series(p["ratio"] * k, play=2.0 * p["F_c"] / k, within=k)

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """One spring: ratio = 1."""
        return ((Linear(), p),)


class Lopsided(Linear):
    """A spring in series that is `back` times as stiff where it is pushed together, as a bolted joint that gapes."""

    form: ClassVar[str] = "lopsided"
    title: ClassVar[str] = "flexible parts of the rig in series with the specimen, stiffer to one side"
    signature: ClassVar[str] = "as series_flexibility.linear, on one side of the loops more than on the other"
    source: ClassVar[str] = "piecewise linear joints: Ibrahim & Pettit (2005), J. Sound Vib. 279, 857-936"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("back", "", 0.02, 50.0, 1.0, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((20.0 * sizes.stiffness, back) for back in (3.0, 1.0 / 3.0))

    def series(self, p: Values) -> Series:
        return Series(p["stiffness"], back=p["back"])

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """One spring: back = 1."""
        return ((Linear(), p),)


FORMS = (Linear, Damped, Stiffening, Power, Closing, Lopsided)
