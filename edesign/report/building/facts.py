"""A building in words, from the text of its file in the archive."""

from __future__ import annotations

from itertools import groupby

from edesign.codes.ntc2018.drift import limit_state_of_drift
from edesign.ground_motion.hazard import action_of, national_of, national_values
from edesign.project.actions.hazard import NtcHazard
from edesign.project.actions.hazard_base import YEAR
from edesign.project.building.building import Building
from edesign.project.building.design import Design, Drift
from edesign.project.building.members import BraceRun
from edesign.report.building.results import BuildingResults
from edesign.space.structure.design_block import design_of, rules_of, system_of
from edesign.space.structure.frame import AXES

Rows = list[tuple[str, str]]
_SYSTEMS = {
    "moment_frame": "moment frame",
    "concentric_diagonal": "concentric bracing with diagonals",
    "concentric_v": "concentric V bracing",
    "eccentric": "eccentric bracing with seismic links",
    "buckling_restrained": "buckling-restrained braces",
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
            link = f" with links of {run.link:g} m" if isinstance(run, BraceRun) and run.link is not None else ""
            groups.setdefault(run.group, f"{run.group} {run.section} {run.material}{link}")
        if groups:
            rows.append((kind.capitalize(), ", ".join(groups.values())))
    return rows


def design_rows(building: Building, results: BuildingResults) -> Rows:
    """Return the settings of the design; of those that the file leaves to the program or the country, what was found.

    Args:
        building: with its block `design`.

    Raises:
        ArchiveError: a result is missing.
        InputError: a file of the country is not at hand.
    """
    design = design_of(building)
    factors, drift = design.partial_factors, design.drift
    rows = [("Codes", ", ".join(_codes(design)))]
    rules = rules_of(design)
    rows += _importance(building)
    rows.append(("Ductility class", rules.ductility[design.ductility_class]))
    for axis in AXES:
        system = system_of(design, axis)
        table = "Table 7.3.II of NTC 2018" if rules.clauses else "Table 6.2 of EN 1998-1"
        by = f", by {table}" if system.q == "table" else ", as given"
        by += f" ({system.q_source})" if system.q_source is not None else ""
        rows.append((f"System along {axis}", f"{_SYSTEMS[system.type]}, q = {results.number(f'q_{axis}'):.4g}{by}"))
    rows.append(("Regularity", _regularity(design, results)))
    rigid = building.diaphragms.numbers(1, building.n_storeys)
    torsion = f"{100 * design.accidental_torsion:g} % of the plan" if design.accidental_torsion and rigid else "none"
    directions = "SRSS" if design.directions == "srss" else f"{100 * float(design.directions):g} % of the other"
    rows.append(("Natural modes", _modes(design, results)))
    modal = f"{design.combination.upper()}; directions: {directions}; accidental eccentricity: {torsion}"
    rows.append(("Combination of modes", modal))
    capped = "at most the elastic one" if design.displacement == "elastic_cap" else "without the elastic cap"
    rows.append(("Displacements", "mu_d d_e" if rules.clauses else f"q d_e, {capped}"))
    rows.append(("Drift limit", "none" if drift.limit == "none" else _drift(building, drift)))
    partial = [f"gamma_{name} = {value:g}" for name, value in vars(factors).items()]
    if any(load.G2 for load in building.loads.items) and building.design_hazard is not None:
        of_actions = national_of(building.design_hazard).action_factors
        partial.append(f"gamma_G2 = {of_actions.G2_sup:g}, favourable {of_actions.G2_inf:g}")
    rows.append(("Partial factors", ", ".join(partial)))
    rows.append(("Overstrength", f"gamma_ov = {design.overstrength:g}"))
    if left := _left_to_the_country(building):
        rows.append(("National values", f"{', '.join(left)}: {_whose(building)}"))
    return rows


def _importance(building: Building) -> Rows:
    """The level of the design with its importance class and factor, or the class of use."""
    hazard, level = building.design_hazard, building.design_level
    if hazard is None or level is None:
        return []
    if isinstance(hazard, NtcHazard):
        return [("Class of use", f"{hazard.class_of_use}, nominal life {hazard.nominal_life / YEAR:g} years")]
    return [("Level of the design", f"{level}: {action_of(hazard).facts(level)}")]


def _drift(building: Building, drift: Drift) -> str:
    """The kind of elements that drifts are limited for, and the action."""
    elements = f"{drift.limit.replace('_', ' ')} elements"
    if not isinstance(building.hazard, NtcHazard):
        return f"{elements}, nu = {drift.nu:g}"
    use = building.hazard.class_of_use
    return f"{elements}, {limit_state_of_drift(use)} in class of use {use}"


def _regularity(design: Design, results: BuildingResults) -> str:
    """Whether the building counts as regular, and who says so."""
    found = results.group().attributes
    texts = []
    for where in ("plan", "elevation"):
        asked, name = getattr(design, f"regular_in_{where}"), f"regular_in_{where}"
        if asked != "auto":
            texts.append(f"{'' if asked else 'not '}regular in {where}, as the file says")
        elif name in found:
            texts.append(f"{'' if found[name] else 'not '}regular in {where}, as found")
        else:  # an archive of an earlier version
            texts.append(f"in {where} as the rules for the building find it")
    return "; ".join(texts)


def _modes(design: Design, results: BuildingResults) -> str:
    """How many modes count, and their share of the mass."""
    shares = [results.values("modes", f"effective_mass_ratio_{axis}") for axis in AXES]
    masses = " and ".join(f"{100.0 * share.sum():.1f} % along {axis}" for share, axis in zip(shares, AXES, strict=True))
    why = ", all that the building has" if design.modes == "auto" else ", as given"
    return f"{shares[0].size}{why}: {masses} of the mass"


def _whose(building: Building) -> str:
    """Whose national values count."""
    hazard = building.design_hazard
    if hazard is None:
        return "recommended"
    return national_values(hazard) or f"of {national_of(hazard).country}"


def _left_to_the_country(building: Building) -> list[str]:
    """What the block `design` does not give and the country decides."""
    given = building.design
    assert given is not None, "design_of wants it"
    factors = type(given.partial_factors).model_fields.keys() - given.partial_factors.model_fields_set
    left = [f"gamma_{name}" for name in vars(given.partial_factors) if name in factors]
    left += ["gamma_ov"] if "overstrength" not in given.model_fields_set else []
    by_country = not rules_of(given).clauses and given.drift.limit != "none"
    return left + (["nu"] if by_country and "nu" not in given.drift.model_fields_set else [])


def _codes(design: Design) -> list[str]:
    """The codes of a design; actions are of NTC 2018 where its seismic rules are."""
    names = vars(design.code) | ({"actions": "ntc-2018"} if rules_of(design).clauses else {})
    return list(dict.fromkeys(map(_code, names.values())))


def _code(name: object) -> str:
    if name == "ntc-2018":
        return "NTC 2018"
    number, _, year = str(name).partition("-")
    return f"{ {'en1990': 'EN 1990', 'ec3': 'EN 1993-1-1', 'ec8': 'EN 1998-1'}.get(number, number) }:{year}"


def _lengths(values: tuple[float, ...]) -> str:
    runs = [(value, len(list(run))) for value, run in groupby(values)]
    return ", ".join(f"{count} x {value:g} m" if count > 1 else f"{value:g} m" for value, count in runs)
