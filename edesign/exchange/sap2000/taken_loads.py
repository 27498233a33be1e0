"""Load patterns of a SAP2000 model as permanent and variable loads of edesign."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from edesign.exchange.sap2000.model import LoadPattern, Sap2000Model
from edesign.exchange.sap2000.read_loads import nodal_weights

PERMANENT = ("dead", "super dead", "superdead")
VARIABLE = {
    "live": "B",
    "reducible live": "B",
    "reduce live": "B",
    "live reducible": "B",
    "roof live": "H",
    "snow": "snow",
}
"""Design types of variable loads, with the category of EN 1991-1-1, 6.3 that they are taken for."""


@dataclass
class TakenLoads:
    """Load patterns by what they are taken for.

    Attributes:
        permanent, variable: names of patterns.
        category: of variable patterns.
        left_out: sentences on others that have loads.
    """

    permanent: list[str] = field(default_factory=list)
    variable: list[str] = field(default_factory=list)
    category: dict[str, str] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)


def taken_loads(model: Sap2000Model) -> TakenLoads:
    """Sort the load patterns of a model by their design types; loads of wind, earthquakes and others are left out."""
    found = TakenLoads()
    for name, pattern in model.patterns.items():
        kind = pattern.kind.lower()
        if kind in PERMANENT:
            found.permanent.append(name)
        elif kind in VARIABLE:
            found.variable.append(name)
            found.category[name] = _category(pattern)
        elif count := _count(model, name):
            found.left_out.append(f"load pattern {name} of the type {pattern.kind}: {count} load{'s' * (count > 1)}")
    return found


def _category(pattern: LoadPattern) -> str:
    """The category in a name like Q_B, else that of the design type."""
    letter = pattern.name.removeprefix("Q_")
    if pattern.name.startswith("Q_") and (letter in tuple("ABCDEFGH") or letter == "snow"):
        return letter
    return VARIABLE[pattern.kind.lower()]


def _count(model: Sap2000Model, name: str) -> int:
    of = [load.pattern for load in model.joint_loads]
    of += [load.pattern for load in model.frame_loads] + [point.pattern for point in model.frame_points]
    return of.count(name) + (model.patterns[name].self_weight != 0.0)


def mass_factors(
    model: Sap2000Model, taken: TakenLoads, masses: dict[str, float], gravity: float
) -> dict[str, float] | None:
    """Return the factors of permanent loads and of each category with which loads give the masses of joints.

    Args:
        model: in SI.
        masses: kg, of all joints that loads may give one.
        gravity: acceleration, m/s2.

    Returns:
        Factors of `G` and of each category; None: no factors give these masses.
    """
    groups: dict[str, list[str]] = {"G": taken.permanent}
    for name in taken.variable:
        groups.setdefault(taken.category[name], []).append(name)
    columns = []
    for patterns in groups.values():
        total = dict.fromkeys(masses, 0.0)
        for pattern in patterns:
            for joint, weight in nodal_weights(model, pattern).items():
                if joint in total:
                    total[joint] += weight / gravity
        columns.append(list(total.values()))
    matrix, right = np.array(columns).T, np.array(list(masses.values()))
    factors = np.linalg.lstsq(matrix, right, rcond=None)[0]
    largest = np.abs(right).max(initial=0.0)
    if largest == 0.0 or np.abs(matrix @ factors - right).max() > _EXACT * largest or factors.min() < -_EXACT:
        return None
    return {name: max(round(float(factor), 12), 0.0) for name, factor in zip(groups, factors, strict=True)}


_EXACT = 1e-9
"""Share of the largest mass within which masses follow from loads: rounding of numbers in the file, with a margin."""
