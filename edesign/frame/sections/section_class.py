"""The class of a steel section under its forces, EN 1993-1-1, 5.5, part by part."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.codes.ec3.classes import (
    angle_limits,
    class_of_part,
    elastic_stress_ratio,
    epsilon,
    internal_part_limits,
    outstand_limits,
    plastic_part_in_compression,
    tubular_limits,
)
from edesign.errors import InputError
from edesign.frame.sections.steel_section import SteelSection


@dataclass(frozen=True)
class PartClass:
    """A part of a section.

    Attributes:
        part: web, flange or wall.
        slenderness: c/t, of a circular section d/t.
        limits: the largest of classes 1, 2 and 3.
    """

    part: str
    slenderness: float
    limits: tuple[float, float, float]

    @property
    def number(self) -> int:
        """The class, 1 to 4."""
        return class_of_part(self.slenderness, self.limits)


@dataclass(frozen=True)
class SectionClass:
    """The class of a section: the highest of its parts that are compressed."""

    section: str
    parts: tuple[PartClass, ...]

    @property
    def number(self) -> int:
        """The class, 1 to 4."""
        return max(part.number for part in self.parts)

    def required(self, highest: int, where: str = "") -> SectionClass:
        """Return itself if its class is not above `highest`.

        Args:
            highest: class that is allowed.
            where: begins the message.

        Raises:
            InputError: a part is of a higher class; the message names it, its c/t and the limit.
        """
        for part in self.parts:
            if part.number > highest:
                raise InputError(
                    f"{where}{self.section} is of class {part.number}, allowed is {highest}: c/t of its {part.part} is "
                    f"{part.slenderness:.1f}, the limit is {part.limits[highest - 1]:.1f} (EN 1993-1-1, Table 5.2)"
                    " [E-EC3-03]"
                )
        return self


def section_class(
    section: SteelSection, yield_stress: float, N_Ed: float = 0.0, about_y: bool = True, about_z: bool = False
) -> SectionClass:
    """Return the class of a section in bending and compression.

    The flat parts are h - 2 t_f - 2 r and (b - t_w - 2 r)/2 of an I section, h - 3 t and b - 3 t of an RHS
    (EN 1993-1-5, Table 4.1). Those of welded sections reach up to the other plates. Legs of an angle count with their
    whole length, as in Table 5.2, sheet 3; channels of a pair count one by one. Flanges, and both pairs of walls
    under biaxial bending, count as uniformly compressed.

    Args:
        section: by `steel_section`.
        yield_stress: f_y, Pa.
        N_Ed: axial force, positive in tension, N.
        about_y: whether it is bent about y; without bending tension gives class 1.
        about_z: whether it is bent about z.

    Returns:
        The class of the section and of each flat part.

    Raises:
        InputError: the yield stress is not greater than zero.
    """
    eps = epsilon(yield_stress)
    compressed = N_Ed < 0.0 or about_y or about_z
    if section.kind == "CHS":
        parts = [PartClass("wall", section.h / section.tw, tubular_limits(eps))] if compressed else []
        return SectionClass(section.name, tuple(parts) or (_free("wall"),))
    if section.kind == "BRB":
        return SectionClass(section.name, (_free("core"),))  # its casing holds it
    if section.kind == "L":
        if not compressed:
            return SectionClass(section.name, (_free("leg"),))
        one, two = angle_limits(eps)
        longest, t = max(section.h, section.b), section.tw
        legs = PartClass("legs together", 0.5 * (section.b + section.h) / t, two)
        return SectionClass(section.name, (PartClass("leg", longest / t, one), legs))
    if not compressed:
        return SectionClass(section.name, (_free("web"), _free("flange")))
    if section.kind == "2U":
        web, flange = section.h - 2.0 * (section.tf + section.r), section.b - section.tw - section.r
        inside = PartClass("web", web / section.tw, internal_part_limits(eps))
        return SectionClass(section.name, (inside, PartClass("flange", flange / section.tf, outstand_limits(eps))))
    if section.kind == "I":
        web, flange = section.h - 2.0 * (section.tf + section.r), 0.5 * (section.b - section.tw) - section.r
        if section.parts:
            web = next(size for name, size, _ in section.parts if name == "web")
        limits = _web_limits(section, yield_stress, N_Ed, web, section.tw, bent=about_y)
        if about_z and not about_y and N_Ed >= 0.0:
            limits = internal_part_limits(eps, 0.0, -1.0)  # at the neutral axis
        if section.parts:
            flat = [
                PartClass(name, ratio, outstand_limits(eps) if outstand else internal_part_limits(eps))
                for name, ratio, outstand in section.parts
                if name != "web"
            ]
            return SectionClass(section.name, (PartClass("web", web / section.tw, limits), *flat))
        return SectionClass(
            section.name,
            (
                PartClass("web", web / section.tw, limits),
                PartClass("flange", flange / section.tf, outstand_limits(eps)),
            ),
        )
    walls = []
    sides = (
        ("web", section.h, section.tw, section.tf, about_y, about_z),
        ("flange", section.b, section.tf, section.tw, about_z, about_y),
    )
    for part, side, t, across, bent, other in sides:
        c = side - (2.0 * across if section.welded else 3.0 * t)
        limits = internal_part_limits(eps)
        if bent and not other:
            limits = _web_limits(section, yield_stress, N_Ed, c, 2.0 * t, bent=True)
        walls.append(PartClass(part, c / t, limits))
    return SectionClass(section.name, tuple(walls))


def _web_limits(
    section: SteelSection, yield_stress: float, N_Ed: float, depth: float, thickness: float, bent: bool
) -> tuple[float, float, float]:
    eps = epsilon(yield_stress)
    if not bent:
        return internal_part_limits(eps)
    alpha = plastic_part_in_compression(-N_Ed, depth, thickness, yield_stress)
    return internal_part_limits(eps, alpha, elastic_stress_ratio(-N_Ed, section.A, yield_stress))


def _free(part: str) -> PartClass:
    return PartClass(part, 0.0, (1.0, 1.0, 1.0))
