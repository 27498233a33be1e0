"""The results of a building as plain data: what `edesign show --json` prints."""

from __future__ import annotations

from edesign.archive.reader import Archive
from edesign.report.building.checks import worked_data, worked_worst
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.deflections import worst_beams
from edesign.report.building.tables.foundations import foundation_summary
from edesign.report.building.tables.lateral import lateral_summary
from edesign.report.tables.number import finite
from edesign.space.archived import SELECTION
from edesign.space.structure.frame import AXES


def building_summary(archive: Archive) -> dict[str, object]:
    """Return the results of a building for JSON, SI units: modes, base shears, storeys, rules, groups, verdict.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    results = BuildingResults(archive)
    found: dict[str, object] = finite(results.group().attributes) | {"passed": bool(results.number("passed"))}
    found["modes"] = [
        {"period_s": mode["period"], **{name: mode[f"effective_mass_ratio_{name}"] for name in ("x", "y", "rz")}}
        for mode in results.rows("modes", "mode")
    ]
    for axis in AXES:
        names = tuple(results.group(f"storeys_{axis}").variables)
        found[f"storeys_{axis}"] = _rows(results, f"storeys_{axis}", "storey", names)
    found["rules"] = [
        {name: finite(rule[name]) for name in ("clause", "text", "required", "value")}
        | {"passed": {1: True, 0: False}.get(rule["passed"]), "detail": rule["detail"]}
        for rule in results.rows("criteria", "rule")
    ]
    found["groups"] = [
        {
            "group": worst.group,
            "section": worst.section,
            "utilisation": finite(worst.utilisation),
            "passed": not worst.utilisation > 1.0,
            "check": worst.name,
            "clause": worst.clause,
            "member": worst.member,
            "combination": calculation.combination,
            "calculation": worked_data(calculation),
        }
        for worst, calculation in worked_worst(results)
    ]
    found["deflections"] = [
        {
            "group": worst.group,
            "loads": worst.load,
            "beam": worst.beam,
            "span_m": worst.span,
            "deflection_m": worst.deflection,
            "limit": worst.limit,
        }
        for worst in worst_beams(results.group("deflections"))
    ]
    found["lateral_cases"] = lateral_summary(results)
    found["foundations"] = foundation_summary(results.group("foundations"))
    found |= _basis(results)
    return found


def _basis(results: BuildingResults) -> dict[str, object]:
    """Steels, floors, overstrength, joints, and how the sections were chosen."""
    steels = _rows(results, "materials", "material", ("fy", "E", "nu", "density"))
    floors = _rows(results, "floors", "floor", ("level", "mass", "x", "y", "gyration"))
    cases = [str(case) for case in results.values("floors", "case")]
    for floor, loads in zip(floors, results.values("floors", "load").T.tolist(), strict=True):
        floor["load"] = dict(zip(cases, loads, strict=True))
    found: dict[str, object] = {"materials": steels, "floors": floors}
    for axis in AXES:
        found[f"overstrength_{axis}"] = _rows(results, f"overstrength_{axis}", "member", ("storey", "ratio"))
    if results.has("joints"):
        found["joints"] = _rows(results, "joints", "joint", ("node", "axis", "M_Rc", "M_Rb", "ratio", "exempt"))
    if results.has(SELECTION):
        rows = _rows(results, SELECTION, "group", ("before", "after", "mass", "held_by"))
        found["selection"] = dict(results.group(SELECTION).attributes) | {"groups": rows}
    return found


def _rows(results: BuildingResults, group: str, key: str, names: tuple[str, ...]) -> list[dict[str, object]]:
    """The values along a dimension, a mapping each."""
    return [{name: finite(row[name]) for name in (key, *names)} for row in results.rows(group, key)]
