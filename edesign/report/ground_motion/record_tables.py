"""Tables of records: where they come from, what matching changed, and the criteria of the code."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import reduce
from operator import getitem, itemgetter
from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.assess.sets import history_sets
from edesign.codes.ec8 import SET_RULES
from edesign.codes.motion_sets import FOR_MEAN
from edesign.ground_motion.component_pairs import NAMES
from edesign.ground_motion.hazard import rules_in_force
from edesign.ground_motion.plausibility import unusual_scales
from edesign.ground_motion.record_choice import choice_lines
from edesign.ground_motion.sources import is_simulated
from edesign.report.archived import archived_hazard
from edesign.report.ground_motion.pair_tables import pairs_table
from edesign.report.tables.cell import Listed, Quantity, Verdict
from edesign.report.tables.column import Column, col, text, verdict
from edesign.report.tables.items import Analysis
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import M_S, MM, MM_S, ONE, PERCENT, G, M, S, Unit
from edesign.study.results.kinds import ANALYSES, RECORDS

DIGITS = 3
NEGLIGIBLE = 1e-7  # m, m/s: far below what any recorder resolves
_MEASURES = (
    ("PGA", G, "pga"),
    ("PGV", M_S, "pgv"),
    ("PGD", M, "pgd"),
    ("Arias", M_S, "arias"),
    ("D5-95", S, "duration_5_95"),
)
_VERDICTS = {True: Verdict("met", "good"), False: Verdict("not met", "bad"), None: None}


def _fact(*keys: str) -> Callable[[Analysis], Any]:
    """A fact of an archived record, such as `recorded`, `pga`."""
    return lambda record: reduce(getitem, keys, record.group.attributes)


def _change(of: tuple[str, str], key: str) -> Callable[[Analysis], Listed]:
    """The same before -> after."""
    return lambda record: Listed(tuple(record.group.attributes[kind][key] for kind in of), " -> ")


def _measures(value: Callable[[str], Callable[[Analysis], Any]]) -> tuple[Column[Analysis], ...]:
    return tuple(col(header, unit, value(key), DIGITS) for header, unit, key in _MEASURES)


def _quantity(found: Mapping[str, Any], key: str) -> Quantity:
    """A number of a criterion with its unit, whole ones without unit as they are."""
    value, unit = found[key], Unit(found["unit"])
    whole = value is not None and not unit.name and value == int(value)
    return Quantity(value, unit, form=".0f" if whole else "")


def _whole_scale(record: Analysis) -> float:
    about = record.group.attributes
    return float(about["match_scale"] * about["suite_factor"])


CHOICE = TableSpec[tuple[str, float]](
    "chosen_records",
    "{title}",
    (text("record", itemgetter(0)), col("factor", ONE, itemgetter(1), form=".3f")),
    named_by_title=True,
)
REFUSED = TableSpec[Mapping[str, str]](
    "candidates_left_out",
    "{whose}: candidates left out",
    (text("candidate", "name"), text("why", "reason", broken=1)),
    keys=2,
    each="Candidates left out",
)
ORIGINS = TableSpec[Analysis](
    "records_as_recorded",
    "Records, as recorded",
    (
        text("record", "name"),
        text("origin", _fact("origin")),
        *_measures(lambda key: _fact("recorded", key)),
        col("end v", MM_S, _fact("recorded", "end_velocity"), DIGITS, negligible=NEGLIGIBLE),
        text("from", _fact("detail")),
    ),
    keys=2,
)
CHANGES = TableSpec[Analysis](
    "record_scaling",
    "Scaled original -> matched",
    (
        text("record", "name"),
        col("scale", ONE, _fact("match_scale"), DIGITS),
        *_measures(lambda key: _change(("before", "after"), key)),
        col("end v", MM_S, _fact("after", "end_velocity"), 2, negligible=NEGLIGIBLE),
        col("end u", MM, _fact("after", "end_displacement"), 2, negligible=NEGLIGIBLE),
    ),
)
PAIR = TableSpec[Mapping[str, Any]](
    "pair_factors",
    "{whose}: both components by one factor",
    (
        text("pair", "name"),
        text("spectrum", lambda pair: NAMES[pair["spectrum"]]),
        col("factor", ONE, "factor", DIGITS),
        col("misfit rms", PERCENT, lambda pair: pair["misfit"]["rms"], DIGITS),
        col("largest", PERCENT, lambda pair: pair["misfit"]["largest"], DIGITS),
        col("at T", S, lambda pair: pair["misfit"]["at_period"], DIGITS),
    ),
    keys=2,
    each="Both components by one factor",
)
SCALED = TableSpec[Analysis](
    "record_misfit",
    "Scaled records, and their misfit to the target spectrum{band}",
    (
        text("record", "name"),
        col("scale", ONE, _whole_scale, DIGITS),
        *_measures(lambda key: _fact("after", key)),
        col("misfit rms", PERCENT, _fact("misfit_after", "rms"), DIGITS),
        col("largest", PERCENT, _fact("misfit_after", "largest"), DIGITS),
        col("at T", S, _fact("misfit_after", "at_period"), DIGITS),
    ),
)
MISFIT = TableSpec[Analysis](
    "record_fit",
    "Misfit to the target spectrum{band}, and change of the motion",
    (
        text("record", "name"),
        text("method", _fact("match_method")),
        col("rms", PERCENT, _change(("misfit_before", "misfit_after"), "rms"), DIGITS),
        col("largest", PERCENT, _change(("misfit_before", "misfit_after"), "largest"), DIGITS),
        col("at T", S, _fact("misfit_after", "at_period"), DIGITS),
        col("Arias ratio", ONE, _fact("shape", "arias_ratio"), form=".2f"),
        col("D5-95 ratio", ONE, _fact("shape", "duration_ratio"), form=".2f"),
        col("Husid diff.", ONE, _fact("shape", "husid_difference"), form=".2f"),
        col("corr.", ONE, _fact("shape", "correlation"), form=".2f"),
    ),
    keys=2,
)
CRITERIA = TableSpec[Mapping[str, Any]](
    "criteria_of_sets_of_records",
    "{whose}: {code}",
    (
        text("clause"),
        text("criterion", lambda found: found["text"] + (f" ({found['detail']})" if found["detail"] else ""), broken=1),
        text("required", lambda found: _quantity(found, "required")),
        text("found", lambda found: _quantity(found, "value")),
        verdict("verdict", lambda found: _VERDICTS[found["passed"]]),
    ),
    keys=2,
    each="Criteria of sets of records",
)


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
                simulated = [key for key, group in members.items() if is_simulated(group.attributes["origin"])]
                choices.append(choice_table(choice, simulated, name))
                choices += [REFUSED.of(choice["refused"], whose=name)] if choice["refused"] else []
            if "pair" in suite.attributes:
                choices.append(pair_table(name, suite.attributes["pair"]))
            if "pairs" in suite.attributes:
                choices.append(pairs_table(name, suite.attributes["pairs"]))
            if "criteria" in suite.attributes:
                tables.append(criteria_table(name, {**suite.attributes, "criteria": _criteria(archive, name, suite)}))
        else:
            groups[name] = archive.view(place)
    if not groups:
        return []
    fitted = {name: group for name, group in groups.items() if "match_method" in group.attributes}
    changed = {name: group for name, group in fitted.items() if group.attributes["match_method"] != "scale"}
    scaled = {name: group for name, group in fitted.items() if name not in changed}
    of_fit = [CHANGES.of(_records(changed)), _of_fit(MISFIT, changed)] if changed else []
    of_fit += [_of_fit(SCALED, scaled)] if scaled else []
    return [origins_table(groups, warnings), *choices, *of_fit, *tables]


def choice_table(facts: Mapping[str, Any], simulated: Collection[str], name: str = "") -> Table:
    """Return the chosen recordings with their factors, the misfit of their mean, and the candidates left out.

    Args:
        facts: from `choice_facts`, and of a project's choice what the archive has beside them.
        name: of the record in the project.
    """
    factors = facts["factors"]
    title = f"{name}: the best" if name else "The best"
    notes = [*choice_lines(facts), *unusual_scales(factors, set(simulated))]
    return CHOICE.of(factors.items(), title=f"{title} {len(factors)} of {facts['compared']}", notes=notes)


def origins_table(groups: Mapping[str, Group], warnings: Sequence[str]) -> Table:
    """Return where each record comes from, and its measures as recorded; reasons of failures stand below."""
    notes = []
    for name, group in groups.items():
        about = group.attributes
        notes += [str(about["reason"])] if about["reason"] else []
        notes += [f"{name}: {text}" for text in (*about["doubts"], *about.get("warnings", ()))]
    return ORIGINS.of(_records(groups), notes=[*notes, *warnings])


def pair_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return how a pair of components was scaled, and how near their combined spectrum is to the target.

    Args:
        about: attributes of the archived pair.
    """
    notes = []
    if about["factor"] != about["best_factor"]:
        best, bound = (significant(about[key], DIGITS) for key in ("best_factor", "factor"))
        notes.append(f"the best factor would be {best}; its bound {bound} was used")
    return PAIR.of([{**about, "name": name}], whose=name, notes=notes)


def criteria_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return the criteria of the code one by one.

    Args:
        name: name of the suite.
        about: attributes of the archived suite.
    """
    factor, notes = about.get("suite_factor", 1.0), []
    if factor != 1.0:
        of_mean = about.get("criteria_of_mean", (SET_RULES.clauses.zero_period, SET_RULES.clauses.mean))
        missed = any(found["passed"] is False for found in about["criteria"] if found["clause"] in of_mean)
        why = "the most allowed, and a criterion is missed" if missed else "so that the mean satisfies the criteria"
        notes.append(f"all records times {factor:.4f}, {why}")
    return CRITERIA.of(about["criteria"], whose=name, code=about.get("criteria_of", SET_RULES.code), notes=notes)


def _criteria(archive: Archive, name: str, suite: Group) -> list[Mapping[str, Any]]:
    """The criteria of a suite, of which what holds for the mean is that of the histories that the archive has."""
    every = {key: Group(attributes=archive.group_attributes(f"{ANALYSES}/{key}")) for key in archive.names(ANALYSES)}
    own = {key: of for key, of in every.items() if str(of.attributes.get("record")).startswith(f"{name}/")}
    run = min((found.motions for found in history_sets(own)), default=None)
    criteria: list[Mapping[str, Any]] = list(suite.attributes["criteria"])
    if run is None:
        return criteria
    fewer = rules_in_force(archived_hazard(archive)).fewer
    for at, found in enumerate(criteria):
        if found["text"] == FOR_MEAN and run < min(found["value"], found["required"]):
            detail = f"{found['value']:g} in the set, of which histories have {run}: {fewer}"
            criteria[at] = {**found, "value": float(run), "detail": detail}
    return criteria


def _records(groups: Mapping[str, Group]) -> list[Analysis]:
    return [Analysis(name, group) for name, group in groups.items()]


def _of_fit(spec: TableSpec[Analysis], groups: Mapping[str, Group]) -> Table:
    """The table of a fit to the target spectrum, with its band where it is the same for all."""
    bands = {(group.coords["period"].values[0], group.coords["period"].values[-1]) for group in groups.values()}
    band = " from {:.4g} s to {:.4g} s".format(*bands.pop()) if len(bands) == 1 else ""
    notes = [f"{name}: {note}" for name, group in groups.items() for note in group.attributes["match_notes"]]
    return spec.of(_records(groups), band=band, notes=notes)
