"""Tables of the ground under the columns: footings, what they do to the first mode, and waves that pass."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.footings import DIRECTIONS
from edesign.report.drawing.captions import some_names
from edesign.report.response.histories import groups_alike, names_of
from edesign.report.tables.table import Table, number

FORMULAS = {
    "pais_kausel": "Pais & Kausel 1988",
    "gazetas": "Gazetas 1991",
}
_WORDS = ("horizontal", "vertical", "rocking")
SHOWN = 40
"""Rows of the tables of feet and histories at most: a page of them can be read."""
WORK = "footing_work_final"
"""Variable that only histories with footings have."""


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
    tables, alike = [], groups_alike(on_footings, _told)
    for several in alike:
        made = [_soils(one := next(iter(several.values()))), _impedances(one)]
        for table in made if len(alike) > 1 else ():
            table.title += f" ({some_names(several)})"
        tables += made
    return [*tables, first_mode_table(on_footings), _work(on_footings)]


def _told(group: Group) -> tuple[str, ...]:
    """What tables say of the footings of an analysis."""
    values = [
        f"{value:.4g}"
        for name, variable in group.variables.items()
        if name.startswith("footing_") and variable.dims == ("footing",) and name not in ("footing_formula", WORK)
        for value in variable.values
    ]
    return (*names_of(group, "footing"), *map(str, group.variables["footing_formula"].values), *values)


def _soils(group: Group) -> Table:
    table = Table(
        "Footings",
        ["footing", "static stiffness by", "G [MPa]", "G / G_0", "V_s [m/s]", "T [s]", "a_0"],
        name="footings",
    )
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


def _impedances(group: Group) -> Table:
    table = Table(
        "Stiffness and damping of footings",
        ["footing", "direction", "K static", "K at T", "radiation [%]", "soil [%]", "dashpot"],
        name="footing_stiffness",
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


def first_mode_table(groups: Mapping[str, Group]) -> Table:
    """Return period and damping of the first mode on fixed feet and on footings; no rows without footings."""
    table = Table(
        "First mode on fixed feet and on footings",
        ["analysis", "T fixed [s]", "T [s]", "ratio", "one mass: ratio", "damping [%]", "one mass: damping [%]"],
        name="footing_periods",
    )
    for name, group in groups.items():
        of = group.attributes
        if "period_ratio" not in of:  # an isolated frame has a period on a fixed base too
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
    """Work on the dashpots of each footing in each history; a frame of another variant may stand on others."""
    histories = {name: group for name, group in groups.items() if WORK in group.variables}
    footings = list(dict.fromkeys(footing for group in histories.values() for footing in names_of(group, "footing")))
    table = Table("Work on the dashpots of footings, kJ", ["analysis", *footings], name="footing_work")
    table.units = ("", *("kJ" for _ in footings))
    for name, group in histories.items():
        work = dict(zip(names_of(group, "footing"), group.variables[WORK].values.tolist(), strict=True))
        table.rows.append([name, *(number(work.get(footing), 4, 1e3) for footing in footings)])
    table.notes.append("It is part of the energy of the dampers in the balance.")
    return _cut(table, "histories")


def _passage(groups: Mapping[str, Group]) -> Table:
    """How late the ground motion reaches the feet of columns, and how far that moves them apart."""
    table = Table(
        "Feet under a wave that passes",
        ["analysis", "foot", "delay [ms]", "largest displacement [mm]", "at the end [mm]"],
        left=2,
        name="wave_passage",
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
    return _cut(table, "feet")


def _cut(table: Table, what: str) -> Table:
    """The table with as many rows as are shown, and a note of how many there are."""
    if len(table.rows) > SHOWN:
        table.notes.append(f"The first {SHOWN} of {len(table.rows)} {what}.")
        del table.rows[SHOWN:]
    return table
