"""Sections of a SAP2000 model as those of the catalogue."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cache

from edesign.errors import InputError
from edesign.exchange.sap2000.model import Section
from edesign.exchange.sap2000.written import free_identifier, quantity
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.steel_section import SteelSection, steel_section

CLOSE = 0.01
"""Share by which area and second moment of area may differ from the catalogue's: tables round, mills roll fillets of
other radii. W14X176 of AISC differs by 0.8 % in area; the next mass of a series by 4 % and more."""
WORTH_TELLING = 1e-3
"""Difference that is reported: what rounding in tables of three digits does."""
_SIZES_CLOSE = 0.005  # of depth, width and thicknesses, which tables give to 0.1 mm or 0.01 in


@dataclass(frozen=True)
class Known:
    """A section of the catalogue, and how far the model's is from it.

    Attributes:
        apart: largest difference of area and second moment of area, a share.
    """

    name: str
    apart: float


def known_section(section: Section, fillets: bool = True) -> Known | None:
    """Return the section of the catalogue that a section is by its name or its sizes; None: there is none.

    The names that are tried are that in the file of sections that it comes from, its own one, and its first word. A
    name alone does not count: area and second moment of area must be close to those of the catalogue.

    Args:
        fillets: whether root fillets of rolled sections count.
    """
    words = [section.catalogue, section.name, section.name.split()[0] if section.name.split() else ""]
    for name in dict.fromkeys(words):
        found = _named(name)
        if found is not None and (apart := _apart(section, found, fillets)) <= CLOSE:
            return Known(found.name, apart)
    sizes = (section.depth, section.width, section.web, section.flange)
    if section.shape != "I/Wide Flange" or not section.equal_flanges or not all(sizes):
        return None
    near = [
        Known(one.name, apart)
        for one in _rolled()
        if all(abs(a / b - 1.0) < _SIZES_CLOSE for a, b in zip(sizes, (one.h, one.b, one.tw, one.tf), strict=True))
        and (apart := _apart(section, one, fillets)) <= CLOSE
    ]
    return min(near, key=lambda known: known.apart, default=None)


def _named(name: str) -> SteelSection | None:
    try:
        return steel_section(name) if name else None
    except InputError:
        return None


def own_name(section: Section, taken: Collection[str]) -> str:
    """Return the name of a section that the catalogue has not, among the own sections of a file.

    Args:
        taken: names of those that are there.
    """
    name = f"{section.name}_own" if is_catalogue_name(section.name) else section.name
    return free_identifier(name, set(taken))


def plates_text(section: Section) -> str:
    """Return an I section of three plates as a file of edesign has it; "": it is none."""
    plates = (section.depth, section.width, section.flange, section.web)
    area = 2.0 * section.width * section.flange + (section.depth - 2.0 * section.flange) * section.web
    of_plates = section.shape == "I/Wide Flange" and section.equal_flanges and all(plates)
    if not of_plates or abs(area / section.area - 1.0) >= 1e-3:
        return ""
    keys = ("height", "width", "flange", "web")
    return "{" + ", ".join(f"{key}: {quantity(size, 'm')}" for key, size in zip(keys, plates, strict=True)) + "}"


def is_catalogue_name(name: str) -> bool:
    """Whether the catalogue has a section of a name."""
    return _named(name) is not None


def _apart(section: Section, known: SteelSection, fillets: bool) -> float:
    area, inertia = known.A, known.I_y
    if known.kind == "I" and not fillets:
        area = 2.0 * known.b * known.tf + known.h_w * known.tw
        inertia = (known.b * known.h**3 - (known.b - known.tw) * known.h_w**3) / 12.0
    pairs = ((section.area, area), (section.I33, inertia))
    return max(abs(value / of - 1.0) for value, of in pairs)


@cache
def _rolled() -> tuple[SteelSection, ...]:
    return tuple(steel_section(name) for name in profile_names())
