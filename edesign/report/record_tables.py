"""Tables of records: where they come from, what matching changed, and the criteria of the code."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.codes.ec8 import SET_RULES
from edesign.ground_motion.plausibility import unusual_scales
from edesign.project.units import STANDARD_GRAVITY
from edesign.report.table import Table, number
from edesign.study.kinds import RECORDS

if TYPE_CHECKING:
    from edesign.study.match import Choice

MATCH_COLUMNS = (  # header, which of before and after, measure, unit of the header in SI
    ("PGA [g]", "pga", STANDARD_GRAVITY),
    ("PGV [m/s]", "pgv", 1.0),
    ("PGD [m]", "pgd", 1.0),
    ("Arias [m/s]", "arias", 1.0),
    ("D5-95 [s]", "duration_5_95", 1.0),
)
DIGITS = 3
NEGLIGIBLE = 1e-7  # m, m/s: far below what any recorder resolves


def record_tables(archive: str | os.PathLike[str]) -> list[Table]:
    """Return the tables of all records of an archive.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    with open_archive(archive) as opened:
        return tables_of(opened)


def tables_of(archive: Archive) -> list[Table]:
    """Return the tables of all records of an open archive; [] if it has none."""
    groups: dict[str, Group] = {}
    tables: list[Table] = []
    warnings: list[str] = []
    names = archive.names(RECORDS)
    for name in names:
        place = f"{RECORDS}/{name}"
        if archive.group_attributes(place).get("suite"):
            suite = archive.view(place)
            warnings += [f"{name}: {text}" for text in suite.attributes.get("warnings", ())]
            prefix = f"{name}/" if len(names) > 1 else ""  # of a single suite it would only widen the tables
            groups |= {f"{prefix}{member}": archive.view(f"{place}/{member}") for member in archive.names(place)}
            if "criteria" in suite.attributes:
                tables.append(criteria_table(name, suite.attributes))
        else:
            groups[name] = archive.view(place)
    if not groups:
        return []
    fitted = {name: group for name, group in groups.items() if "match_method" in group.attributes}
    first = [origins_table(groups)]
    first[0].notes += warnings
    return [*first, *([changes_table(fitted), misfit_table(fitted)] if fitted else []), *tables]


def choice_table(choice: Choice) -> Table:
    """Return the chosen recordings with their factors, and how near their mean is to the target."""
    found = choice.selection
    table = Table(f"The best {len(found.chosen)} of {choice.of}", ("record", "factor"))
    table.rows = [[name, f"{factor:.3f}"] for name, factor in zip(choice.recordings, found.factors, strict=True)]
    how = "all choices were compared" if found.exhaustive else "greedy search with exchanges"
    table.notes.append(
        f"scaled mean / target - 1: {100 * found.deviation:.1f} % rms, {100 * found.largest_deviation:.1f} % at most; "
        f"scatter {100 * found.scatter:.0f} %; {how}"
    )
    stand_ins = {name for name, item in choice.recordings.items() if item.origin == "stand-in"}
    factors = dict(zip(choice.recordings, found.factors.tolist(), strict=True))
    table.notes += unusual_scales(factors, stand_ins)
    for criterion in found.after.failed:
        table.notes.append(f"scaled only, not met: {criterion.clause}, {criterion.text}: {criterion.value:.3g}")
    return table


def origins_table(groups: Mapping[str, Group]) -> Table:
    """Return where each record comes from, and its measures as recorded; reasons of failures stand below."""
    headers = [header for header, _, _ in MATCH_COLUMNS]
    table = Table("Records, as recorded", ("record", "origin", *headers, "end v [mm/s]", "from"), left=2)
    for name, group in groups.items():
        about = group.attributes
        cells = [number(about["recorded"][key], DIGITS, unit) for _, key, unit in MATCH_COLUMNS]
        end = number(about["recorded"]["end_velocity"], DIGITS, 1e-3, NEGLIGIBLE)
        table.rows.append([name, str(about["origin"]), *cells, end, str(about["detail"])])
        if about["reason"]:
            table.notes.append(str(about["reason"]))
        table.notes += [f"{name}: {text}" for text in (*about["doubts"], *about.get("warnings", ()))]
    return table


def changes_table(groups: Mapping[str, Group]) -> Table:
    """Return the measures of the scaled original and of the matched record, before -> after."""
    headers = [header for header, _, _ in MATCH_COLUMNS]
    columns = ("record", "scale", *headers, "end v [mm/s]", "end u [mm]")
    table = Table("Scaled original -> matched", columns)
    for name, group in groups.items():
        before, after = group.attributes["before"], group.attributes["after"]
        cells = [_pair(before[key], after[key], unit) for _, key, unit in MATCH_COLUMNS]
        ends = [number(after[key], 2, 1e-3, NEGLIGIBLE) for key in ("end_velocity", "end_displacement")]
        table.rows.append([name, number(group.attributes["match_scale"], DIGITS), *cells, *ends])
    return table


def misfit_table(groups: Mapping[str, Group]) -> Table:
    """Return how near each spectrum is to the target before and after, and how much the motion changed."""
    columns = (
        "record",
        "method",
        "rms [%]",
        "largest [%]",
        "at T [s]",
        "Arias ratio",
        "D5-95 ratio",
        "Husid diff.",
        "corr.",
    )
    table = Table(f"Misfit to the target spectrum{_band(groups)}, and change of the motion", columns, left=2)
    for name, group in groups.items():
        about = group.attributes
        before, after, shape = about["misfit_before"], about["misfit_after"], about["shape"]
        cells = [_pair(before[key], after[key], 0.01) for key in ("rms", "largest")]
        changes = [shape[key] for key in ("arias_ratio", "duration_ratio", "husid_difference", "correlation")]
        row = [name, str(about["match_method"]), *cells, number(after["at_period"], DIGITS)]
        table.rows.append([*row, *(f"{value:.2f}" for value in changes)])
        table.notes += [f"{name}: {note}" for note in about["match_notes"]]
    return table


def criteria_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return the criteria of the code one by one."""
    table = Table(
        f"{name}: {about.get('criteria_of', SET_RULES.code)}",
        ("clause", "criterion", "required", "found", "verdict"),
        left=2,
    )
    for found in about["criteria"]:
        verdict = {True: "met", False: "NOT MET", None: "-"}[found["passed"]]
        values = [_with_unit(found[key], found["unit"]) for key in ("required", "value")]
        text = found["text"] + (f" ({found['detail']})" if found["detail"] else "")
        table.rows.append([found["clause"], text, *values, verdict])
    factor = about.get("suite_factor", 1.0)
    if factor != 1.0:
        of_mean = about.get("criteria_of_mean", (SET_RULES.clauses.zero_period, SET_RULES.clauses.mean))
        missed = any(found["passed"] is False for found in about["criteria"] if found["clause"] in of_mean)
        why = "the most allowed, and a criterion is missed" if missed else "so that the mean satisfies the criteria"
        table.notes.append(f"all records times {factor:.4f}, {why}")
    return table


def _band(groups: Mapping[str, Group]) -> str:
    """The band of the fit, where it is the same for all."""
    bands = {(group.coords["period"].values[0], group.coords["period"].values[-1]) for group in groups.values()}
    return " from {:.4g} s to {:.4g} s".format(*bands.pop()) if len(bands) == 1 else ""


def _pair(before: float, after: float, unit: float) -> str:
    return f"{number(before, DIGITS, unit)} -> {number(after, DIGITS, unit)}"


def _with_unit(value: float | None, unit: str) -> str:
    if value is None:
        return "-"
    return f"{value:.0f}" if not unit and value == int(value) else f"{number(value, 4)} {unit}".strip()
