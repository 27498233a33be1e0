"""Tables of records: where they come from, what matching changed, and the criteria of the code."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.codes.ec8 import SET_RULES
from edesign.ground_motion.component_pairs import NAMES
from edesign.ground_motion.plausibility import unusual_scales
from edesign.ground_motion.record_choice import choice_lines
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.tables.table import Table, formatted, marked, number
from edesign.study.results.kinds import RECORDS

MATCH_COLUMNS = (  # header, which of before and after, measure, unit of the header in SI
    ("PGA [g]", "pga", STANDARD_GRAVITY),
    ("PGV [m/s]", "pgv", 1.0),
    ("PGD [m]", "pgd", 1.0),
    ("Arias [m/s]", "arias", 1.0),
    ("D5-95 [s]", "duration_5_95", 1.0),
)
CRITERIA = "criteria_of_sets_of_records"
"""Name of the tables of criteria, in files too."""
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
    choices: list[Table] = []
    warnings: list[str] = []
    names = archive.names(RECORDS)
    for name in names:
        place = f"{RECORDS}/{name}"
        if archive.group_attributes(place).get("suite"):
            suite = archive.view(place)
            warnings += [f"{name}: {text}" for text in suite.attributes.get("warnings", ())]
            prefix = f"{name}/" if len(names) > 1 else ""  # of a single suite it would only widen the tables
            groups |= {f"{prefix}{member}": archive.view(f"{place}/{member}") for member in archive.names(place)}
            if "choice" in suite.attributes:
                choice = suite.attributes["choice"]
                members = {member: groups[f"{prefix}{member}"] for member in archive.names(place)}
                simulated = [key for key, group in members.items() if group.attributes["origin"] == "stand-in"]
                choices.append(choice_table(choice, simulated, name))
                choices += [refused_table(name, choice["refused"])] if choice["refused"] else []
            if "pair" in suite.attributes:
                choices.append(pair_table(name, suite.attributes["pair"]))
            if "criteria" in suite.attributes:
                tables.append(criteria_table(name, suite.attributes))
        else:
            groups[name] = archive.view(place)
    if not groups:
        return []
    fitted = {name: group for name, group in groups.items() if "match_method" in group.attributes}
    changed = {name: group for name, group in fitted.items() if group.attributes["match_method"] != "scale"}
    first = [origins_table(groups)]
    first[0].notes += warnings
    of_fit = [changes_table(changed), misfit_table(changed)] if changed else []
    if len(changed) < len(fitted):
        of_fit.append(scaled_table({name: group for name, group in fitted.items() if name not in changed}))
    return [*first, *choices, *of_fit, *tables]


def choice_table(facts: Mapping[str, Any], stand_ins: Collection[str], name: str = "") -> Table:
    """Return the chosen recordings with their factors, the misfit of their mean, and the candidates left out.

    Args:
        facts: from `choice_facts`, and of a project's choice what the archive has beside them.
        stand_ins: names of those that are simulated.
        name: of the record in the project.
    """
    factors = facts["factors"]
    title = f"{name}: the best" if name else "The best"
    table = Table(f"{title} {len(factors)} of {facts['compared']}", ("record", "factor"))
    table.rows = [[recording, formatted(factor, ".3f")] for recording, factor in factors.items()]
    table.notes += choice_lines(facts)
    table.notes += unusual_scales(factors, set(stand_ins))
    return table


def refused_table(name: str, refused: Sequence[Mapping[str, str]]) -> Table:
    """Return the candidates of a choice that were left out, and why.

    Args:
        name: name of the record of the project.
        refused: the candidates with the reason of each.
    """
    table = Table(f"{name}: candidates left out", ("candidate", "why"), left=2, sentences=1)
    table.each = ("Candidates left out", name)
    table.name = "candidates_left_out"
    table.rows = [[item["name"], item["reason"]] for item in refused]
    return table


def origins_table(groups: Mapping[str, Group]) -> Table:
    """Return where each record comes from, and its measures as recorded; reasons of failures stand below."""
    headers = [header for header, _, _ in MATCH_COLUMNS]
    table = Table(
        "Records, as recorded",
        ("record", "origin", *headers, "end v [mm/s]", "from"),
        left=2,
        name="records_as_recorded",
    )
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
    table = Table("Scaled original -> matched", columns, name="record_scaling")
    for name, group in groups.items():
        before, after = group.attributes["before"], group.attributes["after"]
        cells = [_pair(before[key], after[key], unit) for _, key, unit in MATCH_COLUMNS]
        ends = [number(after[key], 2, 1e-3, NEGLIGIBLE) for key in ("end_velocity", "end_displacement")]
        table.rows.append([name, number(group.attributes["match_scale"], DIGITS), *cells, *ends])
    return table


def pair_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return how a pair of components was scaled, and how near their combined spectrum is to the target.

    Args:
        name: name of the pair.
        about: attributes of the archived pair.
    """
    columns = ("pair", "spectrum", "factor", "misfit rms [%]", "largest [%]", "at T [s]")
    table = Table(f"{name}: both components by one factor", columns, left=2)
    table.each = ("Both components by one factor", name)
    table.name = "pair_factors"
    misfit = about["misfit"]
    values = [number(misfit[key], DIGITS, unit) for key, unit in (("rms", 0.01), ("largest", 0.01), ("at_period", 1.0))]
    table.rows.append([name, NAMES[about["spectrum"]], number(about["factor"], DIGITS), *values])
    if about["factor"] != about["best_factor"]:
        best, bound = (number(about[key], DIGITS) for key in ("best_factor", "factor"))
        table.notes.append(f"the best factor would be {best}; its bound {bound} was used")
    return table


def scaled_table(groups: Mapping[str, Group]) -> Table:
    """Return the measures of records that were scaled only, and how near their spectra are to the target."""
    headers = [header for header, _, _ in MATCH_COLUMNS]
    columns = ("record", "scale", *headers, "misfit rms [%]", "largest [%]", "at T [s]")
    table = Table(
        f"Scaled records, and their misfit to the target spectrum{_band(groups)}", columns, name="record_misfit"
    )
    for name, group in groups.items():
        about = group.attributes
        after, misfit = about["after"], about["misfit_after"]
        factor = about["match_scale"] * about["suite_factor"]
        cells = [number(after[key], DIGITS, unit) for _, key, unit in MATCH_COLUMNS]
        values = [number(misfit[key], DIGITS, unit) for key, unit in (("rms", 0.01), ("largest", 0.01))]
        table.rows.append([name, number(factor, DIGITS), *cells, *values, number(misfit["at_period"], DIGITS)])
        table.notes += [f"{name}: {note}" for note in about["match_notes"]]
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
    table = Table(
        f"Misfit to the target spectrum{_band(groups)}, and change of the motion", columns, left=2, name="record_fit"
    )
    for name, group in groups.items():
        about = group.attributes
        before, after, shape = about["misfit_before"], about["misfit_after"], about["shape"]
        cells = [_pair(before[key], after[key], 0.01) for key in ("rms", "largest")]
        changes = [shape[key] for key in ("arias_ratio", "duration_ratio", "husid_difference", "correlation")]
        row = [name, str(about["match_method"]), *cells, number(after["at_period"], DIGITS)]
        table.rows.append([*row, *(formatted(value, ".2f") for value in changes)])
        table.notes += [f"{name}: {note}" for note in about["match_notes"]]
    return table


def criteria_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return the criteria of the code one by one.

    Args:
        name: name of the suite.
        about: attributes of the archived suite.
    """
    table = Table(
        f"{name}: {about.get('criteria_of', SET_RULES.code)}",
        ("clause", "criterion", "required", "found", "verdict"),
        left=2,
        sentences=1,
        each=("Criteria of sets of records", name),
        name=CRITERIA,
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
    return formatted(value, ".0f") if not unit and value == int(value) else marked(number(value, 4), "", unit)
