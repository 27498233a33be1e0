"""Rolled I sections with tapered flanges, IPN of DIN 1025-1, for elastic buildings (data/tapered.csv).

Sizes, areas, second moments and plastic moduli are those of the package structuralcodes, whose polygons have the taper
of 14 % and both radii. t_f is the thickness at a quarter of the width, with which clauses count.
"""

from __future__ import annotations

import csv
from dataclasses import replace
from functools import cache
from importlib import resources

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.i_steel_section import i_steel_section
from edesign.frame.sections.section_names import SectionName, SectionNames

_MM = 1e-3
FAMILIES = {"IPN": "IPN", "INP": "IPN"}
"""The family by its names in several countries."""


@cache
def tapered_names() -> SectionNames:
    """Return the names of all sections with tapered flanges."""
    return SectionNames(tuple(_table()))


def tapered_name(name: str) -> str | None:
    """Return the catalogue's name of a section with tapered flanges, `IPN300`; None if there is no such one.

    Args:
        name: as somebody writes it: `IPN 300`, `INP300`.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family not in FAMILIES:
        return None
    return tapered_names().canonical(f"{FAMILIES[parts.family]}{'x'.join(f'{size:g}' for size in parts.sizes)}")


def near_tapered(name: str) -> str:
    """Return what there is near a section with tapered flanges that the catalogue lacks, as a clause; "" of others.

    Args:
        name: as somebody writes it.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family not in FAMILIES:
        return ""
    return f"{tapered_names().near(f'IPN{parts.sizes[0]:g}')}; tapered flanges are for elastic buildings alone"


@cache
def tapered(name: str) -> SteelSection:
    """Return a section with tapered flanges.

    Args:
        name: of the catalogue.

    Source: A_vz EN 1993-1-1, 6.2.6(3)a with t_f; A_z = h t_w and A_y = 5/6 of the flanges as of parallel ones; I_t the
        mills' formula of parallel flanges, which is up to a tenth too small; I_w = I_z (h - t_f)2 / 4.
    """
    h, b, tw, tf, r, _, A, I_y, I_z, W_pl_y, W_pl_z = _table()[name]
    h, b, tw, tf, r = (_MM * size for size in (h, b, tw, tf, r))
    A, I_y, I_z, W_pl_y, W_pl_z = A * _MM**2, I_y * _MM**4, I_z * _MM**4, W_pl_y * _MM**3, W_pl_z * _MM**3
    return replace(
        i_steel_section(name, h, b, tw, tf, r),
        A=A,
        A_vz=max(A - 2.0 * b * tf + (tw + 2.0 * r) * tf, (h - 2.0 * tf) * tw),
        I_y=I_y,
        I_z=I_z,
        I_w=I_z * (h - tf) ** 2 / 4.0,
        W_el_y=2.0 * I_y / h,
        W_el_z=2.0 * I_z / b,
        W_pl_y=W_pl_y,
        W_pl_z=W_pl_z,
    )


@cache
def _table() -> dict[str, tuple[float, ...]]:
    """Return h, b, t_w, t_f, r_1, r_2 in mm, and A, I_y, I_z, W_pl,y, W_pl,z in mm2, mm4 and mm3 of each section."""
    text = resources.files("edesign.frame.sections").joinpath("data/tapered.csv").read_text(encoding="utf-8")
    rows = csv.reader(line for line in text.splitlines() if not line.startswith("#"))
    next(rows)
    return {name: tuple(map(float, cells)) for name, *cells in rows}
