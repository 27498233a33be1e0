"""Hollow sections of steel: square, rectangular and circular.

Hot finished (EN 10210-2), cold formed (EN 10219-2), or American in inches (HSS of ASTM A500).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction

from edesign.errors import InputError
from edesign.frame.sections.section import Spot, fillets
from edesign.frame.sections.section_names import SectionName

_MM, _INCH = 1e-3, 0.0254
_SIZES = {"SHS": 2, "RHS": 3, "CHS": 2}
_EXAMPLES = "`SHS200x10`, `RHS200x100x8`, `CHS168.3x8` (mm; cold formed: `CFSHS200x10`)"
_HSS_SIZE = r"(?:\d+-)?\d+/\d+|\d+\.?\d*|\.\d+"
_HSS = re.compile(rf"HSS\s*({_HSS_SIZE})((?:\s*[X×*]\s*(?:{_HSS_SIZE}))*)")
_HSS_EXAMPLES = "`HSS8x6x1/2`, `HSS6.625x0.280` (inches, nominal thickness)"
_MOST_INCHES = 50.0  # of a side; the widest tubes of ASTM A500 have 34 in, and sizes in mm begin above
DESIGN_THICKNESS = 0.93
"""Share of the nominal thickness that a wall of ASTM A500 counts with. Source: AISC 360-16, B4.2."""


@dataclass(frozen=True)
class HollowSection:
    """A hollow section of one wall thickness, in SI.

    Attributes:
        name: `SHS200x10`.
        h, b: height and width; of a circular one its diameter, m.
        t: thickness of the wall, m.
        round: whether it is circular.
        cold_formed: otherwise hot finished.
        american: of ASTM A500; `t` is then the design thickness.

    Source: EN 10210-2:2006 and EN 10219-2:2006, Annex B. Corners of ASTM A500 with outer radius 2 t and inner radius t
        are those of the AISC Steel Construction Manual, Part 1.
    """

    name: str
    h: float
    b: float
    t: float
    round: bool
    cold_formed: bool
    american: bool = False

    @property
    def r_o(self) -> float:
        """Outer radius of the corners, m; 0 of a circular section."""
        if self.round:
            return 0.0
        if not self.cold_formed:
            return 1.5 * self.t
        if self.american:
            return 2.0 * self.t
        return (2.0 if self.t <= 6e-3 else 2.5 if self.t <= 10e-3 else 3.0) * self.t

    @property
    def r_i(self) -> float:
        """Inner radius of the corners, m; 0 of a circular section."""
        if self.round:
            return 0.0
        return self.r_o - self.t if self.cold_formed else self.t

    @property
    def A(self) -> float:
        """Area, m2."""
        if self.round:
            return math.pi * self.t * (self.h - self.t)
        return 2.0 * self.t * (self.b + self.h - 2.0 * self.t) - (4.0 - math.pi) * (self.r_o**2 - self.r_i**2)

    @property
    def I_t(self) -> float:
        """Torsion constant, m4."""
        t = self.t
        if self.round:
            return 2.0 * self.inertia(self.h, self.h)
        r = 0.5 * (self.r_o + self.r_i)
        around = 2.0 * (self.b + self.h - 2.0 * t) - 2.0 * r * (4.0 - math.pi)
        enclosed = (self.b - t) * (self.h - t) - r**2 * (4.0 - math.pi)
        return t**3 * around / 3.0 + 4.0 * enclosed**2 * t / around

    def inertia(self, depth: float, width: float) -> float:
        """Return the second moment of area about the axis at right angles to `depth`, m4.

        Args:
            depth: of the section across the axis, m.
            width: of the section along the axis, m.
        """
        t = self.t
        if self.round:
            return math.pi / 64.0 * (depth**4 - (depth - 2.0 * t) ** 4)
        walls = (width * depth**3 - (width - 2.0 * t) * (depth - 2.0 * t) ** 3) / 12.0
        outer, inner = self._corners(depth)
        return (
            walls
            - sum(pair.inertia + pair.area * pair.centre**2 for pair in outer)
            + sum(pair.inertia + pair.area * pair.centre**2 for pair in inner)
        )

    def plastic_modulus(self, depth: float, width: float) -> float:
        """Return the plastic section modulus about the axis at right angles to `depth`, m3.

        Args:
            depth: of the section across the axis, m.
            width: of the section along the axis, m.
        """
        t = self.t
        if self.round:
            return (depth**3 - (depth - 2.0 * t) ** 3) / 6.0
        walls = (width * depth**2 - (width - 2.0 * t) * (depth - 2.0 * t) ** 2) / 4.0
        outer, inner = self._corners(depth)
        return (
            walls
            + sum(pair.area * abs(pair.centre) for pair in inner)
            - sum(pair.area * abs(pair.centre) for pair in outer)
        )

    def shear_area(self, along: float, across: float) -> float:
        """Return A_v for a force along the side `along`, m2.

        Args:
            along: side along the force, m.
            across: the other side, m.

        Source: EN 1993-1-1:2005, 6.2.6(3)f and g.
        """
        return 2.0 * self.A / math.pi if self.round else self.A * along / (along + across)

    def elastic_shear_area(self, along: float, across: float) -> float:
        """Return the shear area of the elastic deformation, m2: I2 / integral (S/t)2 dA of the thin-walled section.

        Args:
            along: side along the force, m.
            across: the other side, m.
        """
        if self.round:
            return 0.5 * self.A
        t, H, B = self.t, along - self.t, across - self.t
        inertia = t * H**2 * (H / 6.0 + B / 2.0)
        flanges = t * H**2 * B**3 / 24.0
        webs = 2.0 * t * H**3 * (B**2 / 16.0 + B * H / 24.0 + H**2 / 120.0)
        return inertia**2 / (flanges + webs)

    def _corners(self, depth: float) -> tuple[tuple[Spot, Spot], tuple[Spot, Spot]]:
        """What the roundings take from the outer rectangle, and what they add to the wall inside, below and above."""
        return fillets(0.5 * depth, self.r_o), fillets(0.5 * depth - self.t, self.r_i)


def hollow_section(name: str) -> HollowSection | None:
    """Return a hollow section by its name; None if the name is not of a hollow section.

    Args:
        name: as `SHS200x10`, or `HSS8x6x1/2` in inches.

    Raises:
        InputError: the sizes in the name are not those of a hollow section.
    """
    if name.strip().upper().startswith("HSS"):
        return _american(name)
    parts = SectionName.of(name)
    if parts is None:
        return None
    cold = parts.family.startswith("CF")
    family = parts.family[2:] if parts.family[:2] in ("CF", "HF") else parts.family
    if family not in _SIZES:
        return None
    sizes = parts.sizes
    if family == "SHS" and len(sizes) == 3 and sizes[0] == sizes[1]:
        sizes = sizes[1:]
    if len(sizes) != _SIZES[family]:
        raise InputError(f"`{name}` has {len(sizes)} sizes; hollow sections are written {_EXAMPLES} [E-SECT-02]")
    *sides, t = (size * _MM for size in sizes)
    h, b = max(sides), min(sides)
    found = HollowSection(
        "CF" * cold + family + "x".join(f"{size:g}" for size in sizes), h, b, t, family == "CHS", cold
    )
    if not t > 0.0 or 2.0 * max(t, found.r_o) > b:
        what = "walls" if found.round else "corners"
        raise InputError(
            f"`{name}`: {what} of {t / _MM:g} mm do not fit into {b / _MM:g} mm; sizes are {_EXAMPLES} [E-SECT-02]"
        )
    return found


def _american(name: str) -> HollowSection:
    """Return a section of ASTM A500 by its sizes in inches: two of a circular one, else three, the thickness last."""
    found = _HSS.fullmatch(name.strip().upper())
    written = re.findall(_HSS_SIZE, "X".join(found.groups())) if found else []
    try:
        sizes = [sum(float(Fraction(part)) for part in size.split("-")) for size in written]
    except ZeroDivisionError:
        sizes = []
    if len(sizes) not in (2, 3):
        raise InputError(
            f"`{name}` has not two or three sizes; American hollow sections are written {_HSS_EXAMPLES} [E-SECT-02]"
        )
    *sides, t = sizes
    if max(sides) > _MOST_INCHES or not 0.0 < 4.0 * t <= min(sides):
        raise InputError(
            f"`{name}`: sizes of HSS are in inches, such as {_HSS_EXAMPLES}; in mm write {_EXAMPLES} [E-SECT-02]"
        )
    called = "HSS" + "x".join(f"{size:g}" for size in (*sorted(sides, reverse=True), t))
    h, b = max(sides) * _INCH, min(sides) * _INCH
    return HollowSection(called, h, b, DESIGN_THICKNESS * t * _INCH, len(sides) == 1, cold_formed=True, american=True)
