"""Reactions of the supports of a building and design actions on foundations, from its archive."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.tables.table import Table, marked, number
from edesign.space.checks.foundations import COMPONENTS


def reaction_table(of: Group) -> Table:
    """Return the vertical reactions of the supports by action."""
    static, seismic = of.variables["static"].values, of.variables["seismic"].values
    cases = [str(case) for case in of.coords["case"].values]
    table = Table(
        "Supports: F_z on the frame by action, upwards, kN",
        ("support", *cases, "E_x", "E_y"),
        formulas=(),
        name="supports",
    )
    table.units = ("", *("kN" for _ in table.columns[1:]))
    for k, support in enumerate(of.coords["support"].values):
        table.rows.append([str(support), *map(_force, (*static[:, k, 2], *seismic[:, k, 2]))])
    return table


def foundation_table(of: Group) -> Table:
    """Return the factors on the seismic action at each support, and the design actions over all combinations."""
    least = of.variables["least"].values.min(axis=0)
    largest = of.variables["largest"].values.max(axis=0)
    size = np.maximum(np.abs(least), np.abs(largest))
    factor, of_foot = of.variables["factor"].values, _of_foot(of)
    table = Table(
        "Foundations: design actions, kN and kNm",
        ("support", "f_x", "f_y", "F_z,d", "to", "F_x,d", "F_y,d", "M_x,d", "M_y,d"),
        units=("", "", "", "kN", "kN", "kN", "kN", "kNm", "kNm"),
        formulas=(),
        name="foundations",
    )
    for k, support in enumerate(of.coords["support"].values):
        factors = [marked(number(factor[axis, k], 3), "*" * bool(of_foot[axis, k])) for axis in (0, 1)]
        actions = map(_force, (least[k, 2], largest[k, 2], *size[k, [0, 1, 3, 4]]))
        table.rows.append([str(support), *factors, *actions])
    table.notes.append(
        "d: G + psi_2 Q with f_x E_x and f_y E_y, f = gamma_Rd Omega (EN 1998-1, 4.4.2.6(4)); F_z acts upwards on the "
        "frame"
    )
    if of_foot.any():
        table.notes.append("*: Omega of the hinge at the foot (4.4.2.6(5)), otherwise that of the direction")
    return table


def foundation_summary(of: Group) -> list[dict[str, object]]:
    """Return the reactions of each support by action, and its least and largest design actions, for JSON in SI."""
    names, of_foot = of.coords, _of_foot(of)

    def parts(values: np.ndarray) -> dict[str, float]:
        return {name: float(value) for name, value in zip(COMPONENTS, values, strict=True)}

    return [
        {
            "support": str(support),
            **{str(case): parts(of.variables["static"].values[i, k]) for i, case in enumerate(names["case"].values)},
            **{f"E_{axis}": parts(of.variables["seismic"].values[i, k]) for i, axis in enumerate(names["axis"].values)},
            **{
                f"gamma_Rd_Omega_{axis}": float(of.variables["factor"].values[i, k])
                for i, axis in enumerate(names["axis"].values)
            },
            **{f"Omega_of_foot_{axis}": bool(of_foot[i, k]) for i, axis in enumerate(names["axis"].values)},
            "design": [
                {
                    "combination": str(row),
                    "least": parts(of.variables["least"].values[i, k]),
                    "largest": parts(of.variables["largest"].values[i, k]),
                }
                for i, row in enumerate(names["combination"].values)
            ],
        }
        for k, support in enumerate(names["support"].values)
    ]


def _of_foot(of: Group) -> np.ndarray:
    """Whether Omega is that of the foot, by direction and support; archives of older versions do not say so."""
    known = of.variables.get("of_foot")
    return np.zeros(of.variables["factor"].values.shape) if known is None else known.values


def _force(value: float) -> str:
    return number(value, 4, 1e3, negligible=0.05)
