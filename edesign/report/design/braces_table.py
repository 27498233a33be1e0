"""The sections of the braces of a design: their length and slenderness, and how far the dampers use them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.judged_designs import brace_forces
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.report.tables.column import col, count, text
from edesign.report.tables.items import Place, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KG, KN, ONE, M


class _Braces(NamedTuple):
    """The braces of a storey, under estimated forces or those of histories.

    Attributes:
        whose: the estimate, or a variant and its level.
        storey: of the design.
        section: name.
        force: N_Ed of a brace, N.
    """

    whose: str
    storey: Place
    section: str
    force: float

    @property
    def use(self) -> float:
        """N_Ed / N_b,Rd."""
        return self.force / self.storey.known("brace_resistance")


BRACES = TableSpec[_Braces](
    "braces_of_dampers",
    "Braces of design {design}{chosen}",
    (
        text("", "whose"),
        count("storey", lambda one: int(one.storey.name)),
        text("section", "section"),
        col("L", M, lambda one: one.storey.known("brace_length")),
        col("slenderness", ONE, lambda one: one.storey.known("brace_slenderness"), 3),
        col("N_Ed", KN, "force"),
        col("N_b,Rd", KN, lambda one: one.storey.known("brace_resistance")),
        col("use", ONE, "use", 3),
        col("mass", KG, lambda one: one.storey.known("brace_mass")),
    ),
    formulas=True,
    keys=2,
)


def braces_table(
    group: Group,
    sets: Sequence[HistorySet],
    variants: Mapping[str, float],
    rules: SetRules,
    raised: RaisedDevices = RaisedDevices(),  # noqa: B008 - frozen
) -> Table:
    """Return the check of the braces under the estimated forces, and under those of histories.

    Args:
        variants: that have the design, by name.
        rules: of the code in force, for statistics over motions.
        raised: factors of the code, with the law by which the forces of histories follow them.
    """
    if "brace_section" not in group.variables:
        return Table("")
    about = group.attributes
    rows = list(_rows(group, sets, variants, rules, raised))
    factors = group.variables["brace_force_factor"].values
    ends = dict.fromkeys(f"{value:.3g}" for value in (factors.min(), factors.max()))
    level = f" at {about['brace_level']}" if about.get("brace_level") else ""
    notes = [
        f"N_Ed: of one brace, by the forces of the dampers{level} times {' to '.join(ends)}, of histories times the "
        "factor by their own stroke and velocity; gravity is not carried",
        f"N_b,Rd: EN 1993-1-1, 6.3.1, {about['brace_material']}, buckling length "
        f"{float(str(about['brace_length_factor'])):g} L about both axes",
        "mass: of all braces of the storey, between nodes",
    ]
    if _verified(group):
        notes.append("design: with the forces of the histories of its verification")
    beyond = [f"{one.whose}, storey {one.storey.name}" for one in rows if one.use > 1.0]
    if beyond:
        notes += wrapped(f"Not held: {'; '.join(beyond)}.")
    return BRACES.of(
        rows, notes=notes, design=about.get("name", ""), chosen=", chosen from lists" if about["brace_chosen"] else ""
    )


def _rows(
    group: Group, sets: Sequence[HistorySet], variants: Mapping[str, float], rules: SetRules, raised: RaisedDevices
) -> Iterator[_Braces]:
    found = [(f"{one.variant}, {one.level}".rstrip(", "), one) for one in sets if one.variant in variants]
    first = "design" if _verified(group) else "estimate"
    forces = {whose: brace_forces(group, one, rules, raised) for whose, one in found}
    for storey in places({"": group}, "storey"):
        section = str(group.variables["brace_section"].values[storey.number])
        yield _Braces(first, storey, section, storey.known("brace_force"))
        for whose, force in forces.items():
            if force is not None:
                yield _Braces(whose, storey, section, float(force[storey.number]))


def _verified(group: Group) -> bool:
    """Whether the braces were chosen or checked by forces of histories."""
    return bool(np.any(group.variables["brace_history_share"].values != 1.0))
