"""Buckling-restrained braces: what analyses ask of them, and the forces that what holds them is designed for."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.project.notation.names import line_name
from edesign.report.drawing.captions import some_names
from edesign.report.response.histories import groups_alike, names_of
from edesign.report.tables.table import Table, number

LARGEST = "core_strain_max"
"""Variable that only analyses with buckling-restrained braces have."""
STRENGTHS = (
    ("damper_length", 1.0),
    ("damper_yield_force", 1e3),
    ("damper_yield_deformation", 1e-3),
    ("damper_adjusted_tension", 1e3),
    ("damper_adjusted_compression", 1e3),
)
"""What is said of each brace, and the unit it is shown in, in SI."""
QUALIFYING = 200
"""Cumulative plastic deformation / yield deformation that a brace has to stand in the tests (AISC 341-16, K3.4c)."""


def restrained_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of the buckling-restrained braces of all analyses, one set for those with the same braces.

    Args:
        groups: results of analyses by name; those that failed, or have no such braces, are left out.
    """

    def told(group: Group) -> tuple[str, ...]:
        numbers = [f"{value:.9g}" for variable, _ in STRENGTHS for value in _values(group, variable)]
        return (*names_of(group, "damper"), *numbers)

    restrained = {
        name: group
        for name, group in groups.items()
        if LARGEST in group.variables and group.attributes.get("status") == "completed"
    }
    alike, tables = groups_alike(restrained, told), []
    for several in alike:
        one = next(iter(several.values()))
        made = [demand_table(several), strength_table(one), beam_table(one), column_table(one)]
        tables += made
        if len(alike) > 1:
            for table in made[1:]:
                table.title += f" ({some_names(several)})"
    return [table for table in tables if table.rows]


def demand_table(groups: Mapping[str, Group]) -> Table:
    """Return the largest demand on each brace in any of the analyses, with the share of its capacity.

    Args:
        groups: results of one analysis at least, of the same braces.
    """
    columns = ("brace", "T [kN]", "T/T_adj", "C [kN]", "C/C_adj", "strain [%]", "strain/given", "mu", "sum mu")
    table = Table(f"Buckling-restrained braces: largest demand in {some_names(groups)}", columns)

    def largest(of: Callable[[Group], np.ndarray]) -> np.ndarray:
        return np.max([of(group) for group in groups.values()], axis=0)

    def size(name: str) -> np.ndarray:
        return largest(lambda group: np.asarray(peak(group, name)))

    one = next(iter(groups.values()))
    tension = np.maximum(largest(lambda group: _values(group, "damper_force_max")), 0.0)
    compression = np.maximum(largest(lambda group: -_values(group, "damper_force_min")), 0.0)
    strain, ductility = size("core_strain"), size("core_ductility")
    cumulated = largest(lambda group: _values(group, "cumulative_ductility_final"))
    shares = (
        tension / _values(one, "damper_adjusted_tension"),
        compression / _values(one, "damper_adjusted_compression"),
        strain / _values(one, "damper_tested_core_strain"),
    )
    for i, name in _braces(one):
        cells = (
            number(float(tension[i]), scale=1e3),
            number(float(shares[0][i]), 3),
            number(float(compression[i]), scale=1e3),
            number(float(shares[1][i]), 3),
            number(float(strain[i]), 3, scale=0.01),
            number(float(shares[2][i]), 3),
            number(float(ductility[i]), 3),
            number(float(cumulated[i]), 3),
        )
        table.rows.append([name, *cells])
    table.notes += [
        "T_adj = omega R_y P_ysc and C_adj = beta omega R_y P_ysc are the adjusted strengths; given: the largest "
        "strain that omega and beta are known at.",
        "mu: deformation / yield deformation; sum mu: plastic deformations either way / yield deformation, of which "
        f"braces stand at least {QUALIFYING} in their tests (AISC 341-16, K3.4).",
    ]
    return table


def strength_table(group: Group) -> Table:
    """Return yield force and adjusted strengths of each brace, for its connections, the beams and the columns."""
    columns = ("brace", "L_wp [m]", "P_ysc [kN]", "u_y [mm]", "T_adj [kN]", "C_adj [kN]")
    table = Table(
        "Buckling-restrained braces: strengths for the design of connections, beams and columns",
        columns,
        name="restrained_braces",
    )
    for i, name in _braces(group):
        cells = [number(float(_values(group, variable)[i]), scale=unit) for variable, unit in STRENGTHS]
        table.rows.append([name, *cells])
    table.notes.append("AISC 341-16, F4.2a: T_adj = omega R_y P_ysc, C_adj = beta omega R_y P_ysc, P_ysc = F_ysc A_sc.")
    return table


def beam_table(group: Group) -> Table:
    """Return the forces of adjusted braces on the beams that they meet in the middle."""
    columns = ("beam", "up [kN]", "along [kN]", "moment [kN m]")
    table = Table(
        "Beams above chevrons of buckling-restrained braces, with both braces at adjusted strength",
        columns,
        name="chevron_beams",
    )
    braces, heights = dict((name, i) for i, name in _braces(group)), _values(group, "storey_height")
    tension, compression = (_values(group, f"damper_adjusted_{side}") for side in ("tension", "compression"))
    for name, i in braces.items():
        kind, bay, storey, *way = name.split("_")
        other = braces.get(f"V_{bay}_{storey}_f")
        if kind != "V" or way != ["r"] or other is None:
            continue
        length = float(_values(group, "damper_length")[i])
        sine = float(heights[int(storey) - 1]) / length
        cosine = float(np.sqrt(1.0 - sine**2))
        # whichever of the two is compressed
        up = max(compression[i] - tension[other], compression[other] - tension[i]) * sine
        along = max(compression[i] + tension[other], compression[other] + tension[i]) * cosine
        moment = up * 2.0 * length * cosine / 4.0
        table.rows.append([f"B_{bay}_{storey}", *(number(float(value), scale=1e3) for value in (up, along, moment))])
    if table.rows:
        table.notes.append(
            "AISC 341-16, F4.4a. up: the compressed brace pushes more than the other one pulls; along: what both bring "
            "into the beam; moment: of `up` in the middle of a beam on hinges, without other loads."
        )
    return table


def column_table(group: Group) -> Table:
    """Return the axial forces of the columns with all braces at adjusted strength at once, swaying either way.

    Diagonals push and pull at the nodes at their ends; both braces of a chevron at the beam, each of whose ends takes
    half. Braces between two nodes anywhere are not counted.
    """
    table = Table(
        "Columns with all buckling-restrained braces at adjusted strength, gravity not included",
        ("column", "compression [kN]", "tension [kN]"),
        name="restrained_brace_columns",
    )
    columns = [name.split("_") for name in names_of(group, "column")]
    heights, lengths = _values(group, "storey_height"), _values(group, "damper_length")
    tension, compression = (_values(group, f"damper_adjusted_{side}") for side in ("tension", "compression"))
    down: dict[
        tuple[str, int], np.ndarray
    ] = {}  # on the node of a line and floor, swaying to the right and to the left

    def add(line: str, floor: int, forces: np.ndarray) -> None:
        down[line, floor] = down.get((line, floor), np.zeros(2)) + forces

    for i, name in _braces(group):
        kind, *place = name.split("_")
        if kind == "N":
            continue
        bay, storey = int(place[0]), int(place[1])
        left, right = line_name(bay - 1), line_name(bay)
        rises = kind == "R" or (kind == "V" and place[2] == "r")
        pulls = np.array([tension[i], -compression[i]] if rises else [-compression[i], tension[i]])
        pulls *= heights[storey - 1] / lengths[i]
        add(left if rises else right, storey - 1, -pulls)
        for line in (left, right) if kind == "V" else (right if rises else left,):
            add(line, storey, pulls / (2.0 if kind == "V" else 1.0))
    for _, line, storey_text in columns:
        sums = sum((forces for (at, floor), forces in down.items() if at == line and floor >= int(storey_text)), 0.0)
        pressed, pulled = max(float(np.max(sums)), 0.0), max(-float(np.min(sums)), 0.0)
        if pressed or pulled:
            cells = (number(value, scale=1e3, negligible=1.0) for value in (pressed, pulled))
            table.rows.append([f"C_{line}_{storey_text}", *cells])
    if table.rows:
        table.notes.append("AISC 341-16, F4.3: E_cl, the axial forces of the columns; add those of the gravity loads.")
    return table


def _braces(group: Group) -> list[tuple[int, str]]:
    """Position and name of every damper that is a buckling-restrained brace."""
    known = np.isfinite(_values(group, "damper_yield_force"))
    return [(i, name) for i, name in enumerate(names_of(group, "damper")) if known[i]]


def _values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)
