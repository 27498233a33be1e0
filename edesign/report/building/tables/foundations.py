"""Reactions of the supports of a building and design actions on foundations, from its archive."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.building.results import BuildingResults, Row, part
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import MORE, Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, ONE, Unit
from edesign.space.checks.foundations import COMPONENTS
from edesign.space.structure.frame import AXES

F_X, F_Y, F_Z, M_X, M_Y, _ = range(len(COMPONENTS))
KNM = Unit("kNm", 1e3)


def _acting(header: str, value: Callable[[Row], Any], unit: Unit = KN) -> Column[Row]:
    """A column of forces or moments on a support; the title says the unit."""
    return col(header, unit, value, negligible=0.05, silent=True)


def _size(component: int) -> Callable[[Row], float]:
    """The largest magnitude over all combinations."""
    return lambda support: float(np.abs([support["least"], support["largest"]])[:, :, component].max())


def _of_its_base(axis: int) -> Callable[[Row], str]:
    return lambda support: "*" * bool(support["of_foot"][axis])


def _largest(component: int) -> Callable[[Row], float]:
    """The largest magnitude over the persistent combinations."""
    return lambda support: float(np.abs(support["acting"])[:, component].max())


REACTIONS = TableSpec[Row](
    "supports",
    "Supports: F_z on the frame by action, upwards, kN",
    (text("support"), MORE, *(_acting(f"E_{axis}", part("seismic", i, F_Z)) for i, axis in enumerate(AXES))),
    formulas=True,
)
FOUNDATIONS = TableSpec[Row](
    "foundations",
    "Foundations: design actions, kN and kNm",
    (
        text("support"),
        *(col(f"f_{axis}", ONE, part("factor", i), 3, mark=_of_its_base(i)) for i, axis in enumerate(AXES)),
        _acting("F_z,d", lambda support: support["least"][:, F_Z].min()),
        _acting("to", lambda support: support["largest"][:, F_Z].max()),
        _acting("F_x,d", _size(F_X)),
        _acting("F_y,d", _size(F_Y)),
        _acting("M_x,d", _size(M_X), KNM),
        _acting("M_y,d", _size(M_Y), KNM),
    ),
    notes=(
        "d: G + psi_2 Q with f_x E_x and f_y E_y, f = gamma_Rd Omega (EN 1998-1, 4.4.2.6(4)); F_z acts upwards on the "
        "frame",
    ),
    signs=("*: Omega of the hinge at the column base (4.4.2.6(5)), otherwise that of the direction",),
    formulas=True,
)


PERSISTENT = TableSpec[Row](
    "persistent_reactions",
    "Foundations: reactions in persistent combinations, kN and kNm",
    (
        text("support"),
        _acting("F_z,d", lambda support: support["acting"][:, F_Z].min()),
        text("in", lambda support: support["least_in"]),
        _acting("to", lambda support: support["acting"][:, F_Z].max()),
        *(_acting(f"{name},d", _largest(k)) for name, k in (("F_x", F_X), ("F_y", F_Y))),
        *(_acting(f"{name},d", _largest(k), KNM) for name, k in (("M_x", M_X), ("M_y", M_Y))),
    ),
    notes=("on the frame, F_z upwards; of the others the largest magnitude; without sway imperfections",),
    formulas=True,
)


def reaction_table(results: BuildingResults) -> Table:
    """Return the vertical reactions of the supports by action."""
    cases = results.values("foundations", "case")
    more = [_acting(str(case), part("static", i, F_Z)) for i, case in enumerate(cases)]
    return REACTIONS.of(results.rows("foundations", "support"), more=more)


def persistent_table(results: BuildingResults) -> Table:
    """Return the extremes of the reactions in persistent combinations; empty in archives that have none."""
    if "acting" not in results.group("foundations").variables:
        return PERSISTENT.of(())
    supports = results.rows("foundations", "support")
    names = results.values("foundations", "persistent")
    for support in supports:
        support["least_in"] = str(names[int(support["acting"][:, F_Z].argmin())])
    return PERSISTENT.of(supports)


def foundation_table(results: BuildingResults) -> Table:
    """Return the factors on the seismic action at each support, and the design actions over all combinations."""
    supports, of_base = results.rows("foundations", "support"), _of_base_hinge(results.group("foundations"))
    for support in supports:
        support["of_foot"] = of_base[:, support.number]
    return FOUNDATIONS.of(supports, notes=_beyond_elastic(results))


def _beyond_elastic(results: BuildingResults) -> list[str]:
    """Say where the design actions are more than those of the elastic spectrum."""
    largest = results.values("foundations", "factor").max(axis=1)
    beyond = [
        f"f_{axis} up to {factor:.2f} with q = {q:g}"
        for axis, factor in zip(AXES, largest, strict=True)
        if factor > (q := results.number(f"q_{axis}")) * (1.0 + 1e-9)  # rounding
    ]
    if not beyond:
        return []
    return wrapped(
        f"More than the elastic action, f > q: {' and '.join(beyond)}. 4.4.2.6(4) limits Omega to q and not gamma_Rd "
        "Omega, and is taken as it stands; forces of members stop at the elastic action."
    )


def foundation_summary(of: Group) -> list[dict[str, object]]:
    """Return the reactions of each support by action, and its least and largest design actions, for JSON in SI."""
    names, of_base = of.coords, _of_base_hinge(of)

    def parts(values: np.ndarray) -> dict[str, float]:
        return {name: float(value) for name, value in zip(COMPONENTS, values, strict=True)}

    return [
        {
            "support": str(support),
            **{str(case): parts(of.variables["static"].values[i, k]) for i, case in enumerate(names["case"].values)},
            **_extremes(of, k),
            **{f"E_{axis}": parts(of.variables["seismic"].values[i, k]) for i, axis in enumerate(names["axis"].values)},
            **{
                f"gamma_Rd_Omega_{axis}": float(of.variables["factor"].values[i, k])
                for i, axis in enumerate(names["axis"].values)
            },
            **{f"Omega_of_foot_{axis}": bool(of_base[i, k]) for i, axis in enumerate(names["axis"].values)},
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


def _extremes(of: Group, k: int) -> dict[str, object]:
    """The least and the largest reactions of a support in persistent combinations."""
    known = of.variables.get("acting")
    if known is None:
        return {}
    values = known.values[:, k]
    found = {"least": values.min(axis=0), "largest": values.max(axis=0)}
    return {"persistent": {name: dict(zip(COMPONENTS, map(float, row), strict=True)) for name, row in found.items()}}


def _of_base_hinge(of: Group) -> np.ndarray:
    """Whether Omega is that of the column base, by direction and support; archives of older versions do not say so."""
    known = of.variables.get("of_foot")
    return np.zeros(of.variables["factor"].values.shape) if known is None else known.values
