"""An archive as tables, figures and pages read it: analyses of the plan, their results, warnings and statistics."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.measures import response_measures
from edesign.assess.sets import DAMAGED, NOT_RUN
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed
from edesign.report.tables.number import finite
from edesign.study.motions.record_groups import failed_criteria
from edesign.study.results.kinds import ANALYSES, DESIGNS, RECORDS
from edesign.study.results.warnings import ATTRIBUTE, warnings_of

STATISTICS = ("steps", "iterations", "refactorisations", "fallbacks", "cpu_s", "energy_error")


def record_entries(archive: Archive, place: str) -> list[dict[str, Any]]:
    """Return the attributes of the records, or suites with their records, below a place of an archive.

    Args:
        place: path of the group that holds records.
    """
    entries = []
    for name in archive.names(place):
        attributes = dict(archive.group_attributes(f"{place}/{name}"))
        if attributes.get("suite"):
            attributes["records"] = record_entries(archive, f"{place}/{name}")
        entries.append(attributes)
    return entries


def planned(archive: Archive) -> list[str]:
    """Return the names of all analyses of the plan, in its order, whether they have a result or not."""
    have = archive.names(ANALYSES)
    plan = archive.attributes.get("planned")
    names = [str(name) for name in plan] if isinstance(plan, list) else []
    return names + [name for name in have if name not in names]


def find(archive: Archive, name: str) -> str:
    """Return the name of an analysis if the archive's plan has it.

    Raises:
        InputError: it has not.
    """
    names = planned(archive)
    if name not in names:
        hint = did_you_mean(name, names)
        raise InputError(
            f"{archive.path}: no analysis is named {name!r}{hint} (there are: {listed(names)}) [E-ARCH-07]"
        )
    return name


def input_warnings(archive: Archive) -> list[str]:
    """Return one sentence for each warning about the input of a run, and for missing criteria of its suites."""
    found = archive.attributes.get(ATTRIBUTE)
    texts = [str(text) for text in found] if isinstance(found, list) else []
    for name in archive.names(RECORDS):
        texts += failed_criteria(name, Group(attributes=archive.group_attributes(f"{RECORDS}/{name}")))
    return texts


def design_warnings(archive: Archive) -> list[str]:
    """Return one sentence for each warning about the designs of a study, with the name of the design."""
    lines = []
    for name in archive.names(DESIGNS):
        found = archive.group_attributes(f"{DESIGNS}/{name}").get(ATTRIBUTE)
        lines += [f"design {name}: {text}" for text in (found if isinstance(found, list) else [])]
    return lines


def results(archive: Archive, name: str) -> Group:
    """Return the results of an analysis, a group with the status "not run" or "damaged" where there is nothing else.

    Its variables are read when they are asked for, so the archive must stay open; see `Archive.view`.
    """
    path = f"{ANALYSES}/{name}"
    if why := archive.lost(path):
        return Group(attributes={"status": DAMAGED, "reason": why})
    return archive.view(path) if archive.has(path) else Group(attributes={"status": NOT_RUN})


def all_results(archive: Archive) -> dict[str, Group]:
    """Return the results of every analysis of the plan by name, in its order; see `results`."""
    return {name: results(archive, name) for name in planned(archive)}


def entry(name: str, group: Group) -> dict[str, Any]:
    """Return the summary of one analysis.

    Args:
        group: its results, as archived.
    """
    attributes = group.attributes
    labels = {label: attributes.get(label) or None for label in ("kind", "variant", "record", "level")}
    return finite(
        {
            "name": name,
            **labels,
            **ending(group),
            ATTRIBUTE: [warning.text for warning in warnings_of(group)],
            "measures": response_measures(group),
            "statistics": statistics(group),
        }
    )


def ending(group: Group) -> dict[str, str]:
    """Return status and reason of an analysis, the reason "" without one."""
    return {"status": str(group.attributes.get("status", "")), "reason": str(group.attributes.get("reason") or "")}


def statistics(group: Group) -> dict[str, Any]:
    """Return the statistics of an analysis, with None in place of numbers that are not finite or not archived."""
    given = group.attributes.get("statistics")
    found = given if isinstance(given, Mapping) else {}
    return dict(finite({key: found.get(key) for key in STATISTICS} | dict(found)))
