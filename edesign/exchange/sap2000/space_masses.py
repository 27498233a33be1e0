"""The masses of a SAP2000 model as the block of a building file."""

from __future__ import annotations

from collections import defaultdict

from edesign.exchange.sap2000.grid import Grid
from edesign.exchange.sap2000.model import Sap2000Model
from edesign.exchange.sap2000.read_loads import nodal_masses
from edesign.exchange.sap2000.taken_loads import TakenLoads, mass_factors
from edesign.exchange.sap2000.written import number_text, quantity
from edesign.project.building.names import ColumnLine
from edesign.project.notation.axes import PLAIN_AXES
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.extract.selections import selection


def masses_text(model: Sap2000Model, grid: Grid, taken: TakenLoads, left_out: list[str]) -> list[str]:
    """Return the block `masses` of a building file; empty without masses above the base.

    Args:
        model: in SI.
        grid: on which it stands.
        taken: its load patterns, from which masses in the middle of beams must follow.
        left_out: gets a sentence on vertical masses.

    Raises:
        InputError: a mass is of a kind that buildings do not have.
    """
    masses = nodal_masses(model)
    uneven = [j for j, m in masses.items() if abs(m[0] - m[1]) > 1e-9 * max(m[0], m[1])]
    above = {j: float(m[0]) for j, m in masses.items() if _level(grid, j) > 0 and m[0] > 0.0}
    if uneven and any(_level(grid, joint) > 0 for joint in uneven):
        joint = next(joint for joint in uneven if _level(grid, joint) > 0)
        raise model.error("joint", joint, "its masses along X and Y differ, which buildings do not have [E-SAP-15]")
    if not above:
        return []
    if any(masses[joint][2] > 0.0 for joint in above):
        left_out.append("vertical masses: masses of buildings act horizontally")
    if any(joint in grid.middles for joint in above):
        every = {j: above.get(j, 0.0) for j in model.joints if grid.is_used(j) and _level(grid, j) > 0}
        factors = mass_factors(model, taken, every, STANDARD_GRAVITY)
        if factors is None:
            joint = next(joint for joint in above if joint in grid.middles)
            raise model.error(
                "joint",
                joint,
                "it has a mass in the middle of a beam that does not follow from the loads there [E-SAP-15]",
            )
        Q = ", ".join(f"{name}: {number_text(value)}" for name, value in factors.items() if name != "G")
        Q = f", Q: {{{Q}}}" if Q else ""
        return ["masses:", f"  from_loads: {{G: {number_text(factors['G'])}{Q}}}", ""]
    by_mass: dict[tuple[str, int], list[ColumnLine]] = defaultdict(list)
    for joint, mass in above.items():
        i, j, floor = grid.points[joint]
        by_mass[quantity(mass, "t"), floor].append(ColumnLine(i, j, PLAIN_AXES))
    merged: dict[tuple[str, tuple[ColumnLine, ...]], list[int]] = defaultdict(list)
    for (text, floor), lines in by_mass.items():
        merged[text, tuple(sorted(lines))].append(floor)
    numbers = list(range(1, len(grid.z)))
    return [
        "masses:",
        "  given:",
        *(
            f"    - {{at: [{', '.join(map(str, lines))}], "
            f"floors: {selection(sorted(floors), numbers, str)}, mass: {mass}}}"
            for (mass, lines), floors in merged.items()
        ),
        "",
    ]


def _level(grid: Grid, joint: str) -> int:
    """The floor of a joint."""
    point = grid.points.get(joint)
    return point[2] if point is not None else grid.point(grid.middles[joint][0])[2]
