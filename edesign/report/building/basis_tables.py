"""What the design of a building rests on as tables: steels, loads and masses of floors, overstrength, joints."""

from __future__ import annotations

import numpy as np

from edesign.codes.criterion import ROUNDING
from edesign.codes.ec8.strong_column import LEAST_RATIO
from edesign.report.building.results import BuildingResults
from edesign.report.tables.table import Table, finite, formatted, number, whole
from edesign.space.archived import SELECTION
from edesign.space.structure.frame import AXES


def materials_table(results: BuildingResults) -> Table:
    """Return the steels."""
    table = Table("Steel", ("name", "f_y [MPa]", "E [GPa]", "nu", "density [kg/m³]"), formulas=(), name="steel")
    columns = [results.values("materials", name) for name in ("material", "fy", "E", "nu", "density")]
    for name, fy, E, nu, density in zip(*columns, strict=True):
        cells = [number(fy, 4, 1e6), number(E, 4, 1e9), number(nu, 2), number(density, 4)]
        table.rows.append([str(name), *cells])
    return table


def floors_table(results: BuildingResults) -> Table:
    """Return load and mass of each floor, from the roof down, and of the building."""
    cases = [str(case) for case in results.values("floors", "case")]
    headers = ("floor", "level [m]", *(f"{case} [kN]" for case in cases), "mass [t]", "x [m]", "y [m]", "radius [m]")
    table = Table("Loads and masses of the floors", headers, name="floor_loads")
    loads, mass = results.values("floors", "load"), results.values("floors", "mass")
    columns = [results.values("floors", name) for name in ("floor", "level", "x", "y", "gyration")]
    for floor, level, x, y, gyration in reversed(list(zip(*columns, strict=True))):
        k = int(floor)
        cells = [number(float(load), 4, 1e3, negligible=0.5) for load in loads[:, k]]
        place = [number(finite(value), 4) for value in (x, y, gyration)]
        table.rows.append(
            [
                whole(k) if k else "base",
                formatted(level, ".2f"),
                *cells,
                number(float(mass[k]), 4, 1e3, negligible=0.5),
                *place,
            ]
        )
    totals = [number(float(load.sum()), 5, 1e3) for load in loads]
    table.rows.append(["all", "", *totals, number(float(mass.sum()), 5, 1e3), "", "", ""])
    table.notes.append(
        "loads downwards, G with the self weight; x, y: centre of mass; radius: of gyration about it. The base carries "
        "the lower half of the first storey, which has no mass in the model."
    )
    return table


def overstrength_table(results: BuildingResults) -> Table:
    """Return the least and the largest overstrength of the dissipative members of each storey, from the roof down."""
    columns: list[str] = []
    cells: dict[int, list[str]] = {}
    found = []
    for axis in AXES:
        name = f"overstrength_{axis}"
        found.append([results.values(name, of) for of in ("storey", "ratio", "member")])
        columns += [f"least {axis}", "of", f"largest {axis}"]
    storeys = sorted({int(k) for of in found for k in of[0]}, reverse=True)
    for k in storeys:
        cells[k] = []
        for storey, ratio, member in found:
            here = np.flatnonzero(storey == k)
            if not here.size:
                cells[k] += ["-", "-", "-"]
                continue
            least = here[ratio[here].argmin()]
            largest = number(finite(float(ratio[here].max())), 3)
            cells[k] += [number(finite(float(ratio[least])), 3), str(member[least]), largest]
    title = "Overstrength of the dissipative members: resistance over effect in the seismic design situation"
    table = Table(title, ("storey", *columns), [[whole(k), *cells[k]] for k in storeys], formulas=())
    table.notes.append("the least ratio of a direction is its Omega (EN 1998-1, 6.6.3(1)P, 6.7.4(1))")
    return table


def selection_table(results: BuildingResults) -> Table:
    """Return the section that `edesign design` chose for each group of members, and the check that governs it."""
    table = Table(
        "Sections chosen",
        ("group", "before", "chosen", "mass [t]", "its next lighter section would break"),
        name="sections_chosen",
    )
    table.left, table.sentences, table.formulas = 3, 4, (4,)
    if not results.has(SELECTION):
        return table
    columns = [results.values(SELECTION, name) for name in ("group", "before", "after", "mass", "held_by")]
    for name, before, after, mass, held_by in zip(*columns, strict=True):
        table.rows.append([str(name), str(before), str(after), number(float(mass), 4, 1e3), str(held_by)])
    before, after = (results.number(name, SELECTION) for name in ("mass_before_kg", "mass_kg"))
    table.notes.append(f"steel: {number(after, 4, 1e3)} t, with the sections before {number(before, 4, 1e3)} t")
    certified = "no single and no double exchange of sections is lighter and meets all checks"
    table.notes.append(certified if results.number("certified", SELECTION) else "the search was cut short")
    return table


def joints_table(results: BuildingResults) -> Table:
    """Return the weakest joint of each floor in each direction of a moment frame, from the roof down."""
    headers = ("floor", "direction", "node", "sum M_Rc [kN*m]", "sum M_Rb [kN*m]", "ratio", "")
    table = Table("Joints: the weakest of each floor", headers, left=3, formulas=(), name="joints")
    if not results.has("joints"):
        return table
    names = ("node", "axis", "M_Rc", "M_Rb", "ratio", "exempt")
    node, axis, M_Rc, M_Rb, ratio, exempt = (results.values("joints", name) for name in names)
    floor = np.array([int(str(name).rpartition(".")[2]) if "." in str(name) else 0 for name in node])
    limit = LEAST_RATIO
    for k in sorted(set(floor.tolist()), reverse=True):
        for along in AXES:
            here = np.flatnonzero((floor == k) & (axis == along))
            if here.size:
                n = int(here[np.where(exempt[here] > 0, np.inf, ratio[here]).argmin()])
                met = "exempt" if exempt[n] else "met" if ratio[n] >= limit * (1.0 - ROUNDING) else "NOT MET"
                cells = [number(float(of[n]), 4, 1e3) for of in (M_Rc, M_Rb)]
                table.rows.append([whole(k), along, str(node[n]), *cells, number(float(ratio[n]), 3), met])
    table.notes.append(f"at least {limit} (EN 1998-1, 4.4.2.3(4)); joints at the roof are exempt")
    return table
