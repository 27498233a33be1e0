"""What the braces that buckle went through, analysis by analysis."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.response.histories import names_of
from edesign.report.tables.table import Table, number

COLUMNS = (  # header, variable, sign with which its largest value is shown, unit in SI
    ("compression [kN]", "brace_axial_force_min", -1.0, 1e3),
    ("tension [kN]", "brace_axial_force_max", 1.0, 1e3),
    ("shortening / yield", "brace_ductility_min", -1.0, 1.0),
    ("elongation / yield", "brace_ductility_max", 1.0, 1.0),
    ("deflection [mm]", "brace_deflection_max", 1.0, 1e-3),
    ("damage", "brace_damage_final", 1.0, 1.0),
    ("broken [% of the section]", "brace_broken_share_final", 1.0, 0.01),
)


def brace_table(groups: Mapping[str, Group]) -> Table:
    """Return the extremes of the brace of each analysis that shortened most over its yield elongation.

    Args:
        groups: results of analyses by name; those without braces that buckle are left out.
    """
    found = {name: group for name, group in groups.items() if "brace_ductility_min" in group.variables}
    shown = [column for column in COLUMNS if any(column[1] in group.variables for group in found.values())]
    table = Table(
        "Braces that buckle", ("analysis", "brace", *(column[0] for column in shown)), left=2, name="buckling_braces"
    )
    for name, group in found.items():
        braces, every = names_of(group, "buckling_brace"), names_of(group, "brace")
        worst = int(np.argmin(group.variables["brace_ductility_min"].values))
        for at in dict.fromkeys((worst, *_broken(group))):
            cells = []
            for _, variable, sign, unit in shown:
                stored = group.variables.get(variable)
                names = braces if stored is not None and stored.dims[0] == "buckling_brace" else every
                value = None
                if stored is not None:  # an extreme of the other sign: it was never in tension, or in compression
                    value = max(sign * float(stored.values[names.index(braces[at])]), 0.0)
                cells.append(number(value, scale=unit))
            table.rows.append([name, braces[at], *cells])
    if table.rows:
        table.notes.append(
            "The brace of each analysis that shortened most, and those of which fibres have broken. Yield: f_y L / E."
        )
    return table


def _broken(group: Group) -> list[int]:
    """Positions of the braces of which fibres have broken."""
    share = group.variables.get("brace_broken_share_final")
    return [] if share is None else np.flatnonzero(share.values > 0.0).tolist()
