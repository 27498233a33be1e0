"""What supports and foundations carry under histories: extremes of the reactions, each with what acts with it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import partial

from edesign.assess.member_uses import SupportForces, in_words, rule_of, support_forces
from edesign.assess.sets import HistorySet
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.project.frame.member_design import AcrossBracing, FrameDesign
from edesign.project.notation.names import node_name
from edesign.report.assessment.measure_tables import label
from edesign.report.response.use_tables import NOTHING
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_M

SUPPORTS = TableSpec[SupportForces](
    "support_forces",
    "{whose}: reactions of supports",
    (text("support"), text("extreme")),  # and V, H, M, and the history
    keys=2,
    each="Reactions of supports",
)
SUPPORTED = re.compile(r"C_(?P<line>[^_]+)_1")
WAYS = {"most compression": 1.0, "least compression": -1.0}
NOTE = (
    "Gravity included. V upwards on the structure: negative is uplift. H and M are magnitudes, and act with V at the "
    "instant of the extreme"
)
MEANS = ", {count} motions: means of the extremes and of what acts with each ({code}), not of one step"


ACROSS = (
    "With across: V with the vertical reaction of the seismic action across in the elastic design of the building, "
    "which acts both ways, with its factor beside that along the frame and gamma_Rd Omega of foundations."
)
ONE_BRACING = "Columns above {names} belong to a bracing across, whose forces are not in these reactions."


def support_tables(
    sets: Iterable[HistorySet], hazard: Hazard | None, design: FrameDesign | None = None
) -> Iterator[Table]:
    """Return the table of each set of histories, for the design of foundations and column bases.

    Args:
        sets: those of archives that do not know the extremes are left out.
        hazard: of the file, whose code says what counts of several motions.
        design: of a frame that is taken out of a building, with what its elastic design found; None: there is none.
    """
    elastic = {} if design is None else design.elastic_use
    across = {_below(name): of.across for name, of in elastic.items() if of.across is not None and _below(name)}
    rules = rules_in_force(hazard)
    for found in sets:
        rows = support_forces(found, rules)
        if not rows:
            continue
        axes = ("",) if len(rows[0].H) == 1 else ("_x", "_y")
        columns: list[Column[SupportForces]] = [col("V", KN, "V", 4)]
        columns += [_of("H", axis, at) for at, axis in enumerate(axes)]
        columns += [_of("M", axis, at) for at, axis in enumerate(axes)]
        mean = rule_of(found, rules) == "mean"
        note = f"{NOTE}{MEANS.format(count=found.motions, code=in_words(rules)) if mean else ''}."
        lacking = [name for name in dict.fromkeys(row.support for row in rows) if (of := across.get(name)) and not of.V]
        note += f" {ONE_BRACING.format(names=', '.join(lacking))}" if lacking else ""
        if any(of.V for of in across.values()):
            columns.append(col("with across", KN, partial(_with, across), 4, optional=True))
            note += f" {ACROSS}"
        columns.append(text("largest in" if mean else "history", "history", broken=1))
        yield SUPPORTS.of(rows, more=columns, whose=label(found), notes=wrapped(note))


def _below(column: str) -> str:
    """The support below a column of the first storey, "" of others: C_A2_1 -> A2.0."""
    match = SUPPORTED.fullmatch(column)
    return "" if match is None else node_name(match["line"], 0)


def _with(across: Mapping[str, AcrossBracing], row: SupportForces) -> float | None:
    """The extreme of V with the reaction of the seismic action across; None: it is of shear or moment, or none acts."""
    of, way = across.get(row.support), WAYS.get(row.extreme)
    return None if of is None or of.V is None or way is None else row.V + way * of.V


def _of(symbol: str, axis: str, at: int) -> Column[SupportForces]:
    return col(
        f"{symbol}{axis}", KN if symbol == "H" else KN_M, lambda row: getattr(row, symbol)[at], 4, negligible=NOTHING
    )
