"""Reactions of the supports of a building and design actions on foundations, from its archive."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.table import Table, number
from edesign.space.checks.foundations import COMPONENTS


def foundation_table(of: Group) -> Table:
    """Return the table of supports: vertical reactions by action, and the design actions over all combinations."""
    cases = [str(case) for case in of.coords["case"].values]
    static, seismic = of.variables["static"].values, of.variables["seismic"].values
    least = of.variables["least"].values.min(axis=0)
    largest = of.variables["largest"].values.max(axis=0)
    size = np.maximum(np.abs(least), np.abs(largest))
    table = Table(
        "Foundations: F_z of the supports by action, and design actions, kN and kNm",
        ("support", *cases, "E_x", "E_y", "F_z,d", "to", "F_x,d", "F_y,d", "M_x,d", "M_y,d"),
    )
    for k, support in enumerate(of.coords["support"].values):
        values = [*static[:, k, 2], *seismic[:, k, 2], least[k, 2], largest[k, 2], *size[k, [0, 1, 3, 4]]]
        table.rows.append([str(support), *(number(value, 4, 1e3, negligible=0.05) for value in values)])
    factor = of.variables["factor"].values
    table.notes.append(
        "d: G + psi_2 Q with the seismic action times gamma_Rd Omega (EN 1998-1, 4.4.2.6(4)), "
        + ", ".join(
            f"{_range(values)} of E_{axis}" for axis, values in zip(of.coords["axis"].values, factor, strict=True)
        )
        + "; F_z acts upwards on the frame"
    )
    return table


def foundation_summary(of: Group) -> list[dict[str, object]]:
    """Return the reactions of each support by action, and its least and largest design actions, for JSON in SI."""
    names = of.coords

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


def _range(values: np.ndarray) -> str:
    low, high = (number(value, 3) for value in (values.min(), values.max()))
    return low if low == high else f"{low} to {high}"
