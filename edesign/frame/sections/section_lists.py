"""Sections to choose from: what a family stands for, and which of its sections are worth trying."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache

from edesign.errors import InputError
from edesign.frame.sections.angles import angle_name, angle_names
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.channels import pair_name
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.restrained_core import FAMILY, core_name
from edesign.frame.sections.section_names import SectionNames
from edesign.frame.sections.steel_section import SteelSection, steel_section
from edesign.frame.sections.tapered import tapered_name, tapered_names

_THICKNESSES = (2.5, 3, 3.2, 3.6, 4, 5, 6, 6.3, 8, 10, 12, 12.5, 16, 20)
_SQUARE = {
    40: (2.5, 5),
    50: (2.5, 6.3),
    60: (3, 8),
    70: (3, 8),
    80: (3.2, 8),
    90: (3.6, 8),
    100: (3.6, 10),
    120: (4, 12.5),
    140: (5, 12.5),
    150: (5, 16),
    160: (5, 16),
    180: (5, 16),
    200: (5, 16),
    250: (5, 16),
    300: (6, 16),
    350: (8, 16),
    400: (8, 20),
}
"""Least and largest thickness of hot finished squares, mm, by their sides. Source: EN 10210-2:1997, Annex B."""
_ROUND_THICKNESSES = (2.6, 2.9, 3.2, 3.6, 4, 4.5, 5, 5.6, 6.3, 7.1, 8, 10, 11, 12.5, 14.2, 16)
_ROUND = {
    48.3: (2.6, 6.3),
    60.3: (2.6, 8),
    76.1: (2.9, 8),
    88.9: (2.9, 8),
    101.6: (3.6, 8),
    114.3: (3.6, 8),
    139.7: (3.6, 10),
    168.3: (5, 12.5),
    193.7: (5, 16),
    219.1: (4.5, 16),
    244.5: (5, 16),
    273: (5, 16),
    323.9: (5, 16),
    355.6: (6.3, 16),
    406.4: (10, 16),
    457: (10, 16),
    508: (10, 16),
}
"""Least and largest thickness of hot finished circular sections, mm, by their diameters.

Source: sizes of Celsius 355 CHS (Tata Steel), a programme of EN 10210-2.
"""
SQUARES = "SHS"
_OTHER_HOLLOW = ("RHS", "CFSHS", "CFRHS", "CFCHS", "HSS")
_AS_GOOD = ("I_y", "I_z", "W_pl_y", "W_pl_z")
_PROPERTIES = {"I": (*_AS_GOOD, "A_vz"), "L": ("I_y", "I_z"), "2U": ("I_y", "I_z"), "BRB": ("A",)}
"""By which a section is as good as another, where that is not `_AS_GOOD`."""


@cache
def hollow_names() -> SectionNames:
    """Return the names of the hollow sections that have a list of sizes: hot finished, square and circular."""
    lists = ((SQUARES, _SQUARE, _THICKNESSES), ("CHS", _ROUND, _ROUND_THICKNESSES))
    return SectionNames(
        [
            f"{family}{size:g}x{t:g}"
            for family, sizes, thicknesses in lists
            for size, (least, most) in sizes.items()
            for t in thicknesses
            if least <= t <= most
        ]
    )


def sections_of(asked: str) -> tuple[SteelSection, ...]:
    """Return the sections that a name stands for: a family, a pattern such as `HEB3*`, or one section.

    Args:
        asked: `HEB`, `SHS`, `CHS` (hot finished), `IPE3*`, `SHS160*`, `HEB300`, `SHS200x10`; `L`, `L100x100x10` of
            braces; `IPN`.

    Raises:
        InputError: there is none.
    """
    if (known := BuildingSections().canonical(asked)) is not None:
        return (steel_section(known),)
    if (known := angle_name(asked) or tapered_name(asked) or pair_name(asked) or core_name(asked)) is not None:
        return (steel_section(known),)
    if asked.upper() in _OTHER_HOLLOW:
        raise InputError(
            f"`{asked}` has no list of sizes; name the sections one by one, such as `RHS200x100x8` [E-SECT-03]"
        )
    if asked.upper() == FAMILY:
        raise InputError(
            f"`{asked}` has no list of sizes; name the areas of cores in cm2 one by one, such as `BRB25` [E-SECT-03]"
        )
    lists = (profile_names, angle_names, tapered_names, hollow_names)
    names = next((found for of in lists if (found := of().chosen(asked))), [])
    if not names:
        raise InputError(
            f"there is no section or family `{asked}`; {BuildingSections().near(asked)}; other families are "
            f"{', '.join(family for of in lists[1:] for family in of().families)} [E-NAME-01]"
        )
    return tuple(map(steel_section, names))


def family_of(section: str) -> str:
    """Return the family of a section: `HEB` of HEB300, `SHS` of SHS200x10, `UPN` of 2UPN200x10."""
    return section.lstrip("2 ").rstrip("0123456789.x ").upper()


def efficient(
    sections: Iterable[SteelSection], cost: Callable[[SteelSection], float] = lambda of: of.A
) -> list[SteelSection]:
    """Return the sections that no cheaper one equals in all inertias and moduli, I sections in shear area too.

    Of squares the small ones with thick walls are left out so.

    Args:
        sections: to choose from.
        cost: of a length of a section; by default its area, as mass is.
    """
    found: list[SteelSection] = []
    for section in sorted(sections, key=lambda of: (cost(of), of.name)):
        keys = _PROPERTIES.get(section.kind, _AS_GOOD)
        if not any(all(getattr(other, key) >= getattr(section, key) for key in keys) for other in found):
            found.append(section)
    return found
