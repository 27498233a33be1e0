"""A building in words, from the text of its file in the archive."""

from __future__ import annotations

from itertools import groupby

from edesign.project.building.building import Building
from edesign.project.building.design import Design

Rows = list[tuple[str, str]]
_SYSTEMS = {
    "moment_frame": "moment frame",
    "concentric_diagonal": "concentric bracing with diagonals",
    "concentric_v": "concentric V bracing",
}


def building_rows(building: Building) -> Rows:
    """Return plan, storeys, supports and members."""
    rows = [
        (f"Bays along {along}", f"{building.n_bays(along)}: {_lengths(building.widths(along))}") for along in ("x", "y")
    ]
    rows.append(
        ("Storeys", f"{building.n_storeys}: {_lengths(building.storey_heights)}; {building.levels[-1]:g} m in all")
    )
    if isinstance(building.supports, str):
        rows.append(("Supports", building.supports))
    for kind in ("columns", "beams", "braces"):
        groups: dict[str, str] = {}
        for run in getattr(building, kind):
            groups.setdefault(run.group, f"{run.group} {run.section} {run.material}")
        if groups:
            rows.append((kind.capitalize(), ", ".join(groups.values())))
    return rows


def design_rows(design: Design) -> Rows:
    """Return the settings of the design."""
    factors, drift = design.partial_factors, design.drift
    rows = [("Codes", ", ".join(_code(name) for name in vars(design.code).values()))]
    rows.append(("Ductility class", {"low": "DCL", "medium": "DCM", "high": "DCH"}[design.ductility_class]))
    for axis, system in (("x", design.systems.x), ("y", design.systems.y)):
        q = "q of Table 6.2" if system.q == "table" else f"q = {system.q:g}"
        rows.append((f"System along {axis}", f"{_SYSTEMS[system.type]}, {q}"))
    regular = (f"{'' if of else 'not '}regular in {where}" for of, where in (
        (design.regular_in_plan, "plan"), (design.regular_in_elevation, "elevation")))  # fmt: skip
    rows.append(("Regularity", ", ".join(regular)))
    torsion = f"{100 * design.accidental_torsion:g} % of the plan" if design.accidental_torsion else "none"
    directions = "SRSS" if design.directions == "srss" else f"{100 * float(design.directions):g} % of the other"
    modal = f"{design.combination.upper()}; directions: {directions}; accidental eccentricity: {torsion}"
    rows.append(("Combination of modes", modal))
    capped = "at most the elastic one" if design.displacement == "elastic_cap" else "without the elastic cap"
    rows.append(("Displacements", f"q d_e, {capped}"))
    limit = "none" if drift.limit == "none" else f"{drift.limit.replace('_', ' ')} elements, nu = {drift.nu:g}"
    rows.append(("Drift limit", limit))
    rows.append(("Partial factors", ", ".join(f"gamma_{name} = {value:g}" for name, value in vars(factors).items())))
    rows.append(("Overstrength", f"gamma_ov = {design.overstrength:g}"))
    return rows


def _code(name: object) -> str:
    number, _, year = str(name).partition("-")
    return f"{ {'en1990': 'EN 1990', 'ec3': 'EN 1993-1-1', 'ec8': 'EN 1998-1'}.get(number, number) }:{year}"


def _lengths(values: tuple[float, ...]) -> str:
    runs = [(value, len(list(run))) for value, run in groupby(values)]
    return ", ".join(f"{count} x {value:g} m" if count > 1 else f"{value:g} m" for value, count in runs)
