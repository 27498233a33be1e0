"""Tables of the ground under the columns: footings, what they do to the first mode, and waves that pass."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.footings import DIRECTIONS
from edesign.report.table import Table, number

FORMULAS = {
    "pais_kausel": "Pais & Kausel 1988",
    "gazetas": "Gazetas 1991",
}
_WORDS = ("horizontal", "vertical", "rocking")
SHOWN = 40
"""Rows of the table of feet at most: a page of them can be read."""


def ground_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of footings, and of feet that a wave reaches one after the other; none where there are none.

    Args:
        groups: results by the name of the analysis.
    """
    tables = [*_footings(groups), _passage(groups)]
    return [table for table in tables if table.rows]


def _footings(groups: Mapping[str, Group]) -> list[Table]:
    on_footings = {name: group for name, group in groups.items() if "footing" in group.coords}
    if not on_footings:
        return []
    return [_soils(on_footings), _impedances(on_footings), _first_mode(on_footings), _work(on_footings)]


def _soils(groups: Mapping[str, Group]) -> Table:
    group = next(iter(groups.values()))
    table = Table("Footings", ["footing", "static stiffness by", "G [MPa]", "G / G_0", "V_s [m/s]", "T [s]", "a_0"])
    columns = ("shear_modulus", "modulus_ratio", "wave_velocity", "period", "a_0")
    values = [group.variables[f"footing_{name}"].values for name in columns]
    for i, name in enumerate(group.coords["footing"].values):
        cells = [number(float(of[i]), 3, scale) for of, scale in zip(values, (1e6, 1.0, 1.0, 1.0, 1.0), strict=True)]
        formula = str(group.variables["footing_formula"].values[i])
        table.rows.append([str(name), FORMULAS.get(formula, formula), *cells])
    table.notes.append(
        "Stiffness and damping are those at the period T; a_0 = omega B / V_s, B half of the shorter side."
    )
    return table


def _impedances(groups: Mapping[str, Group]) -> Table:
    group = next(iter(groups.values()))
    table = Table(
        "Stiffness and damping of footings",
        ["footing", "direction", "K static", "K at T", "radiation [%]", "soil [%]", "dashpot"],
    )
    soil = group.variables["footing_soil_damping"].values
    for i, name in enumerate(group.coords["footing"].values):
        for word, direction in zip(_WORDS, DIRECTIONS, strict=True):
            of = {
                what: float(group.variables[f"footing_{what}_{direction}"].values[i])
                for what in ("static_stiffness", "stiffness", "radiation_damping", "dashpot")
            }
            table.rows.append(
                [
                    str(name),
                    word,
                    number(of["static_stiffness"], 4, 1e6),
                    number(of["stiffness"], 4, 1e6),
                    number(100.0 * of["radiation_damping"], 3),
                    number(100.0 * float(soil[i]), 3),
                    number(of["dashpot"] or None, 4, 1e6),
                ]
            )
    table.notes.append(
        "K in MN/m and MN m/rad, dashpots in MN s/m and MN m s/rad: 2 K (radiation + soil) / omega. A footing that "
        "lifts off has no vertical dashpot."
    )
    return table


def _first_mode(groups: Mapping[str, Group]) -> Table:
    table = Table(
        "First mode on fixed feet and on footings",
        ["analysis", "T fixed [s]", "T [s]", "ratio", "one mass: ratio", "damping [%]", "one mass: damping [%]"],
    )
    for name, group in groups.items():
        of = group.attributes
        if "fixed_base_period_s" not in of:
            continue
        fixed, ratio = _of(of, "fixed_base_period_s"), _of(of, "period_ratio")
        damping, closed = _of(of, "foundation_damping"), _of(of, "closed_foundation_damping")
        table.rows.append(
            [
                name,
                number(fixed, 4),
                number(None if fixed is None or ratio is None else fixed * ratio, 4),
                number(ratio, 4),
                number(_of(of, "closed_period_ratio"), 4),
                number(None if damping is None else 100.0 * damping, 3),
                number(None if closed is None else 100.0 * closed, 3),
            ]
        )
    table.notes.append(
        "Damping by the soil alone: complex eigenvalue of the frame. One mass at the effective height of the first "
        "mode on a rigid base: Veletsos & Meek 1974, and NIST GCR 12-917-21, Eq. 2-10, ASCE/SEI 7-16, 19.3."
    )
    return table


def _of(attributes: Mapping[str, object], name: str) -> float | None:
    value = attributes.get(name)
    return None if value is None else float(np.asarray(value))


def _work(groups: Mapping[str, Group]) -> Table:
    table = Table("Work on the dashpots of footings", ["footing"])
    histories = {name: group for name, group in groups.items() if "footing_work_final" in group.variables}
    if not histories:
        return table
    table = Table("Work on the dashpots of footings, kJ", ["footing", *histories])
    names = next(iter(histories.values())).coords["footing"].values
    for i, footing in enumerate(names):
        cells = [number(float(of.variables["footing_work_final"].values[i]), 4, 1e3) for of in histories.values()]
        table.rows.append([str(footing), *cells])
    table.notes.append("It is part of the energy of the dampers in the balance.")
    return table


def _passage(groups: Mapping[str, Group]) -> Table:
    """How late the ground motion reaches the feet of columns, and how far that moves them apart."""
    table = Table(
        "Feet under a wave that passes",
        ["analysis", "foot", "delay [ms]", "largest displacement [mm]", "at the end [mm]"],
        left=2,
    )
    for name, group in groups.items():
        if "foot_delay" not in group.variables:
            continue
        columns = [group.variables[f"foot_{what}"].values for what in ("delay", "displacement_largest")]
        final = group.variables["foot_displacement_final"].values
        for i, foot in enumerate(group.coords["foot"].values):
            cells = [number(float(of[i]), 4, 1e-3, negligible=1e-9) for of in (*columns, final)]
            table.rows.append([name, str(foot), *cells])
    table.notes.append("Displacements of the ground at the foot relative to the ground that the motion reaches first.")
    if len(table.rows) > SHOWN:
        table.notes.append(f"The first {SHOWN} of {len(table.rows)} feet.")
        del table.rows[SHOWN:]
    return table
