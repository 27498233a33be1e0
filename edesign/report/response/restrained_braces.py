"""Buckling-restrained braces: what analyses ask of them, and the forces that what holds them is designed for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.project.notation.frames import frames_of_line
from edesign.project.notation.names import bay_of, beam_name, line_index, line_name, plain_line
from edesign.report.drawing.captions import some_names
from edesign.report.response.histories import groups_alike, names_of
from edesign.report.tables.column import col, text
from edesign.report.tables.items import Place, at
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, KN_M, MM, ONE, PERCENT, M

LARGEST = "core_strain_max"
"""Variable that only analyses with buckling-restrained braces have."""
_KNOWN = (
    "damper_length",
    "damper_yield_force",
    "damper_yield_deformation",
    "damper_adjusted_tension",
    "damper_adjusted_compression",
)  # of each brace, whatever it goes through
QUALIFYING = 200
"""Cumulative plastic deformation / yield deformation that a brace has to stand in the tests (AISC 341-16, K3.4c)."""


Row = dict[str, str | float]
"""A row by the headers of its table, SI."""

DEMAND = TableSpec[Row](
    "restrained_brace_demand",
    "Buckling-restrained braces: largest demand in {analyses}",
    (
        text("brace"),
        col("T", KN),
        col("T/T_adj", ONE, digits=3),
        col("C", KN),
        col("C/C_adj", ONE, digits=3),
        col("strain", PERCENT, digits=3),
        col("strain/given", ONE, digits=3),
        col("mu", ONE, digits=3),
        col("sum mu", ONE, digits=3),
    ),
    notes=(
        "T_adj = omega R_y P_ysc and C_adj = beta omega R_y P_ysc are the adjusted strengths; given: the largest "
        "strain that omega and beta are known at.",
        "mu: deformation / yield deformation; sum mu: plastic deformations either way / yield deformation, of which "
        f"braces stand at least {QUALIFYING} in their tests (AISC 341-16, K3.4).",
    ),
    named_by_title=True,
)
STRENGTHS = TableSpec[Place](
    "restrained_braces",
    "Buckling-restrained braces: strengths for the design of connections, beams and columns{of}",
    (
        text("brace", "name"),
        col("L_wp", M, at("damper_length")),
        col("P_ysc", KN, at("damper_yield_force")),
        col("u_y", MM, at("damper_yield_deformation")),
        col("T_adj", KN, at("damper_adjusted_tension")),
        col("C_adj", KN, at("damper_adjusted_compression")),
    ),
    notes=("AISC 341-16, F4.2a: T_adj = omega R_y P_ysc, C_adj = beta omega R_y P_ysc, P_ysc = F_ysc A_sc.",),
)
BEAMS = TableSpec[Row](
    "chevron_beams",
    "Beams above chevrons of buckling-restrained braces, with both braces at adjusted strength{of}",
    (text("beam"), col("up", KN), col("along", KN), col("moment", KN_M)),
    notes=(
        "AISC 341-16, F4.4a. up: the compressed brace pushes more than the other one pulls; along: what both bring "
        "into the beam; moment: of `up` in the middle of a beam on hinges, without other loads.",
    ),
)
COLUMNS = TableSpec[Row](
    "restrained_brace_columns",
    "Columns with all buckling-restrained braces at adjusted strength, gravity not included{of}",
    (text("column"), col("compression", KN, negligible=1.0), col("tension", KN, negligible=1.0)),
    notes=("AISC 341-16, F4.3: E_cl, the axial forces of the columns; add those of the gravity loads.",),
)


def restrained_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of the buckling-restrained braces of all analyses, one set for those with the same braces.

    Args:
        groups: results of analyses by name; those that failed, or have no such braces, are left out.
    """

    def shown(group: Group) -> tuple[str, ...]:
        numbers = [f"{value:.9g}" for variable in _KNOWN for value in _values(group, variable)]
        return (*names_of(group, "damper"), *numbers)

    restrained = {
        name: group
        for name, group in groups.items()
        if LARGEST in group.variables and group.attributes.get("status") == "completed"
    }
    alike, tables = groups_alike(restrained, shown), []
    for several in alike:
        one = next(iter(several.values()))
        of = f" ({some_names(several)})" if len(alike) > 1 else ""
        tables += [
            DEMAND.of(_demands(several), analyses=some_names(several)),
            STRENGTHS.of(_braces(one), of=of),
            BEAMS.of(_beams(one), of=of),
            COLUMNS.of(_columns(one), of=of),
        ]
    return [table for table in tables if table.rows]


def _demands(groups: Mapping[str, Group]) -> Iterator[Row]:
    """The largest demand on each brace in any of the analyses, with the share of its capacity."""

    def largest(of: Callable[[Group], np.ndarray]) -> np.ndarray:
        return np.max([of(group) for group in groups.values()], axis=0)

    def size(name: str) -> np.ndarray:
        return largest(lambda group: np.asarray(peak(group, name)))

    one = next(iter(groups.values()))
    tension = np.maximum(largest(lambda group: _values(group, "damper_force_max")), 0.0)
    compression = np.maximum(largest(lambda group: -_values(group, "damper_force_min")), 0.0)
    strain, ductility = size("core_strain"), size("core_ductility")
    cumulated = largest(lambda group: _values(group, "cumulative_ductility_final"))
    columns = {
        "T": tension,
        "T/T_adj": tension / _values(one, "damper_adjusted_tension"),
        "C": compression,
        "C/C_adj": compression / _values(one, "damper_adjusted_compression"),
        "strain": strain,
        "strain/given": strain / _values(one, "damper_tested_core_strain"),
        "mu": ductility,
        "sum mu": cumulated,
    }
    for brace in _braces(one):
        yield {"brace": brace.name} | {header: float(values[brace.number]) for header, values in columns.items()}


def _beams(group: Group) -> Iterator[Row]:
    """The forces of adjusted braces on the beams that they meet in the middle."""
    braces, heights = {brace.name: brace.number for brace in _braces(group)}, _values(group, "storey_height")
    tension, compression = (_values(group, f"damper_adjusted_{side}") for side in ("tension", "compression"))
    for name, i in braces.items():
        other = braces.get(f"{name[:-2]}_f")
        if not (place := bay_of(name)) or name[0] != "V" or place[3] != "r" or other is None:
            continue
        frame, bay, storey, _ = place
        length = float(_values(group, "damper_length")[i])
        sine = float(heights[storey - 1]) / length
        cosine = float(np.sqrt(1.0 - sine**2))
        # whichever of the two is compressed
        up = max(compression[i] - tension[other], compression[other] - tension[i]) * sine
        along = max(compression[i] + tension[other], compression[other] + tension[i]) * cosine
        moment = up * 2.0 * length * cosine / 4.0
        yield {"beam": beam_name(bay, storey, frame), "up": up, "along": along, "moment": moment}


def _lines(columns: Sequence[tuple[str, str]]) -> list[str]:
    """The lines of a frame from the left, by those of its columns, whose names come storey by storey.

    Letters say their place. Of other names those of the storey with most columns stand in their order.
    """
    if all(plain_line(line) for line, _ in columns):
        return [line_name(i) for i in range(1 + max((line_index(line) for line, _ in columns), default=0))]
    storeys: dict[str, list[str]] = {}
    for line, storey in columns:
        storeys.setdefault(storey, []).append(line)
    return max(storeys.values(), key=len)


def _columns(group: Group) -> Iterator[Row]:
    """The axial forces of the columns with all braces at adjusted strength at once, swaying either way.

    Diagonals push and pull at the nodes at their ends; both braces of a chevron at the beam, each of whose ends takes
    half. Braces between two nodes anywhere are not counted.
    """
    columns = [name.split("_") for name in names_of(group, "column")]
    lines = _lines([(line, storey) for _, line, storey in columns])
    heights, lengths = _values(group, "storey_height"), _values(group, "damper_length")
    tension, compression = (_values(group, f"damper_adjusted_{side}") for side in ("tension", "compression"))
    down: dict[
        tuple[str, int], np.ndarray
    ] = {}  # on the node of a line and floor, swaying to the right and to the left

    def add(line: str, floor: int, forces: np.ndarray) -> None:
        down[line, floor] = down.get((line, floor), np.zeros(2)) + forces

    for brace in _braces(group):
        i, kind, place = brace.number, brace.name[0], bay_of(brace.name)
        if place is None:
            continue
        frame, bay, storey, way = place
        of_frame = [line for line in lines if not frame or frame in frames_of_line(line)]
        left, right = of_frame[bay - 1], of_frame[bay]
        rises = kind == "R" or (kind == "V" and way == "r")
        pulls = np.array([tension[i], -compression[i]] if rises else [-compression[i], tension[i]])
        pulls *= heights[storey - 1] / lengths[i]
        add(left if rises else right, storey - 1, -pulls)
        for line in (left, right) if kind == "V" else (right if rises else left,):
            add(line, storey, pulls / (2.0 if kind == "V" else 1.0))
    for _, line, storey_text in columns:
        sums = sum((forces for (at, floor), forces in down.items() if at == line and floor >= int(storey_text)), 0.0)
        pressed, pulled = max(float(np.max(sums)), 0.0), max(-float(np.min(sums)), 0.0)
        if pressed or pulled:
            yield {"column": f"C_{line}_{storey_text}", "compression": pressed, "tension": pulled}


def _braces(group: Group) -> list[Place]:
    """Every damper that is a buckling-restrained brace."""
    known = np.isfinite(_values(group, "damper_yield_force"))
    return [Place("", group, "damper", int(i)) for i in np.flatnonzero(known)]


def _values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)
