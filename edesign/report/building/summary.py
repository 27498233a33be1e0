"""The results of a building as plain data: what `edesign show --json` prints."""

from __future__ import annotations

from edesign.archive.reader import Archive
from edesign.report.building.checks import written_data, written_worst
from edesign.report.building.deflection_table import worst_beams
from edesign.report.building.foundation_table import foundation_summary
from edesign.report.building.results import BuildingResults
from edesign.report.tables.table import finite
from edesign.space.archived import SELECTION
from edesign.space.structure.frame import AXES


def building_summary(archive: Archive) -> dict[str, object]:
    """Return the results of a building for JSON, SI units: modes, base shears, storeys, rules, groups, verdict.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    results = BuildingResults(archive)
    summary = results.group()
    modes = results.group("modes")
    found: dict[str, object] = {
        name: finite(value) if isinstance(value, float) else value for name, value in summary.attributes.items()
    } | {"passed": bool(results.number("passed"))}
    found["modes"] = [
        {
            "period_s": float(results.values("modes", "period")[k]),
            **{name: float(results.values("modes", f"effective_mass_ratio_{name}")[k]) for name in ("x", "y", "rz")},
        }
        for k in range(modes.coords["mode"].values.size)
    ]
    for axis in AXES:
        group = results.group(f"storeys_{axis}")
        names = list(group.variables)
        found[f"storeys_{axis}"] = [
            {"storey": k + 1, **{name: float(group.variables[name].values[k]) for name in names}}
            for k in range(group.coords["storey"].values.size)
        ]
    rules = results.group("criteria")
    found["rules"] = [
        {
            "clause": str(rules.variables["clause"].values[k]),
            "text": str(rules.variables["text"].values[k]),
            "required": finite(rules.variables["required"].values[k]),
            "value": finite(rules.variables["value"].values[k]),
            "passed": {1: True, 0: False}.get(int(rules.variables["passed"].values[k])),
            "detail": str(rules.variables["detail"].values[k]),
        }
        for k in range(rules.coords["rule"].values.size)
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
            "calculation": written_data(calculation),
        }
        for worst, calculation in written_worst(results)
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
    columns = {name: results.values(group, name).tolist() for name in (key, *names)}
    return [
        {name: finite(value) if isinstance(value, float) else value for name, value in zip(columns, row, strict=True)}
        for row in zip(*columns.values(), strict=True)
    ]
