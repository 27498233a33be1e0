"""Channels UPN and UPE of EN 10365 and DIN 1026, and pairs of them back to back for braces (data/channels.csv).

Sizes, areas, second moments and centroids are those of the package structuralcodes, whose polygons have the taper and
all radii. A single channel that a gusset holds by its web bends under an axial force, and twists under loads beside
its shear centre. What it resists then is not in the checks, so that members cannot have it. A pair whose gusset stands
between the webs has neither: its centroid is in the gusset.
"""

from __future__ import annotations

import csv
import math
import re
from functools import cache
from importlib import resources

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.section_names import SectionName, SectionNames

_MM = 1e-3
_PAIR = re.compile(r"2\s*(UPN|UPE)\s*-?\s*(\d{1,3})\s*[xX×*/]\s*(\d{1,2}(?:[.,]\d)?)", re.IGNORECASE)
_FAMILY = re.compile(r"(?:2\s*)?(UPN|UPE)\b|(?:2\s*)?(UPN|UPE)\s*\d", re.IGNORECASE)


@cache
def channel_names() -> SectionNames:
    """Return the names of all single channels."""
    return SectionNames(tuple(_table()))


def channel_name(name: str) -> str | None:
    """Return the catalogue's name of a single channel, `UPN200`; None if there is no such one.

    Args:
        name: as somebody writes it: `UPN 200`, `upe-200`.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family not in ("UPN", "UPE") or len(parts.sizes) != 1:
        return None
    return channel_names().canonical(f"{parts.family}{parts.sizes[0]:g}")


def pair_name(name: str) -> str | None:
    """Return the name of two channels back to back, `2UPN200x10` with a gap of 10 mm; None if there are no such ones.

    Args:
        name: as somebody writes it: `2 UPN 200 x 10`, `2UPN200/10`.
    """
    found = _PAIR.fullmatch(name.strip())
    if found is None or (one := channel_name(found[1] + found[2])) is None:
        return None
    return f"2{one}x{float(found[3].replace(',', '.')):g}"


def near_channel(name: str) -> str:
    """Return what there is near a name of channels that is none, or why a single one is refused; "" of other names.

    Args:
        name: as somebody writes it.
    """
    if _FAMILY.match(name.strip()) is None:
        return ""
    if (one := channel_name(name)) is not None:
        why = "the web of a single channel is beside its centroid and its shear centre, which no check knows"
        return f"{why}; braces may be pairs with the gusset between them, such as `2{one}x10` with a gap of 10 mm"
    return "channels are UPN50 to UPN400 and UPE80 to UPE400; braces may be pairs such as `2UPN200x10`, gap in mm"


@cache
def channel(name: str) -> SteelSection:
    """Return a single channel for tables; its shear areas are nan, as no member has it.

    Args:
        name: of the catalogue.
    """
    h, b, tw, tf, r, A, I_y, I_z, _, W_pl_y = _row(name)
    sizes, I_t = {"h": h, "b": b, "tw": tw, "tf": tf, "r": r}, _torsion(h, b, tw, tf)
    return SteelSection.of(name, "U", **sizes, A=A, I_y=I_y, I_z=I_z, I_t=I_t, W_el_y=2.0 * I_y / h, W_pl_y=W_pl_y)


def gravity_centre(name: str) -> float:
    """Return the distance of the centroid of a single channel from the back of its web, m.

    Args:
        name: of the catalogue.
    """
    return _row(name)[8]


@cache
def channel_pair(name: str) -> SteelSection:
    """Return two channels back to back as one section, with the properties that an axial force asks for.

    They act as one where packings join them at most every 15 radii of gyration of one channel (EN 1993-1-1, 6.4.4,
    Table 6.9). The plane of the gusset is the plane of the webs: y is across it.

    Args:
        name: by `pair_name`.

    Source: parallel axes; I_t of thin walls, (2 b t_f3 + (h - 2 t_f) t_w3) / 3 each; I_w = 0, on the safe side.
    """
    one, _, gap = name[1:].partition("x")
    h, b, tw, tf, r, A, I_y, I_z, centre, _ = _row(one)
    half = 0.5 * _MM * float(gap)
    sizes, I_t = {"h": h, "b": b, "tw": tw, "tf": tf, "r": r}, 2.0 * _torsion(h, b, tw, tf)
    across = 2.0 * (I_z + A * (centre + half) ** 2)
    return SteelSection.of(name, "2U", **sizes, A=2.0 * A, I_y=2.0 * I_y, I_z=across, I_t=I_t)


def packing_distance(name: str) -> float:
    """Return the largest distance of packings with which a pair acts as one, 15 radii of gyration of one channel, m.

    Args:
        name: by `pair_name`.

    Source: EN 1993-1-1:2005, 6.4.4(1), Table 6.9.
    """
    _, _, _, _, _, A, I_y, I_z, _, _ = _row(name[1:].partition("x")[0])
    return 15.0 * math.sqrt(min(I_y, I_z) / A)


def _torsion(h: float, b: float, tw: float, tf: float) -> float:
    return (2.0 * b * tf**3 + (h - 2.0 * tf) * tw**3) / 3.0


def _row(name: str) -> tuple[float, ...]:
    """Return h, b, t_w, t_f, r in m, A m2, I_y, I_z m4, centroid from the back m, W_pl,y m3."""
    units = (*[_MM] * 5, _MM**2, _MM**4, _MM**4, _MM, _MM**3)
    return tuple(value * unit for value, unit in zip(_table()[name], units, strict=True))


@cache
def _table() -> dict[str, tuple[float, ...]]:
    text = resources.files("edesign.frame.sections").joinpath("data/channels.csv").read_text(encoding="utf-8")
    rows = csv.reader(line for line in text.splitlines() if not line.startswith("#"))
    next(rows)
    return {name: tuple(map(float, cells)) for name, *cells in rows}
