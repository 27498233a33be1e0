"""Steel cores of buckling-restrained braces, by their area: `BRB25` has one of 25 cm2."""

from __future__ import annotations

from functools import cache

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.section_names import SectionName

FAMILY = "BRB"
_CM2 = 1e-4


def core_name(name: str) -> str | None:
    """Return the name of a buckling-restrained brace by the area of its core in cm2, `BRB25`; None of other names.

    Args:
        name: as somebody writes it: `BRB 25`, `brb12.5`.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family != FAMILY or len(parts.sizes) != 1 or not parts.sizes[0] > 0.0:
        return None
    return f"{FAMILY}{parts.sizes[0]:g}"


@cache
def core(name: str) -> SteelSection:
    """Return the steel core of a buckling-restrained brace: its area alone, as its casing keeps it from buckling.

    Args:
        name: by `core_name`.
    """
    return SteelSection.of(name, "BRB", A=_CM2 * float(name.removeprefix(FAMILY)))
