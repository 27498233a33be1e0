"""Verdicts on criteria of a study for the first page, and the section of all checks."""

from __future__ import annotations

from edesign.assess.members import VariantMembers
from edesign.assess.verdicts import Verdict, judge
from edesign.project.study.study import Study, own_variant
from edesign.report.assessment.check_table import check_table
from edesign.report.assessment.verdict_tables import objectives_table, performance_tables, remarks_table
from edesign.report.assessment.verdicts_in_short import verdicts_in_short
from edesign.report.html.section import Folded, Headline, Part, Section
from edesign.report.page.source import Source
from edesign.report.tables.table import Table

SIDE_BY_SIDE = 6  # variants in the table of the first page
MANY = 60  # rows, from which the table of all checks is folded


def verdict_tiles(verdicts: tuple[Verdict, ...], study: Study | None = None) -> tuple[Headline, ...]:
    """Return the number of applicable criteria that each variant meets, and those that it does not meet.

    Those that `vary` of the study makes are only in the tables.

    Args:
        study: the study; None: the archive is of a project.
    """
    tiles = []
    applying = [verdict for verdict in _not_swept(verdicts, study) if verdict.applies]
    for variant in dict.fromkeys(verdict.variant for verdict in applying):
        mine = [verdict for verdict in applying if verdict.variant == variant]
        missed = list(dict.fromkeys(verdict.name for verdict in mine if verdict.met is False))
        still_open = sum(verdict.met is None for verdict in mine)
        details = [f"not met: {', '.join(missed)}"] if missed else []
        details += [f"{still_open} open"] if still_open else []
        state = "bad" if missed else "" if still_open else "good"
        value = f"{sum(verdict.met is True for verdict in mine)} of {len(mine)}"
        label = f"Criteria met{f', {variant}' if variant else ''}"
        tiles.append(Headline(value, label, "; ".join(details) or "all are met", state))
    return tuple(tiles)


def verdict_table(verdicts: tuple[Verdict, ...], study: Study | None) -> Table:
    """Return demand over capacity by criterion and variant for the first page; of too many variants no rows.

    Args:
        study: the study; None: the archive is of a project.
    """
    shown = _not_swept(verdicts, study)
    if study is None or not shown or len({verdict.variant for verdict in shown}) > SIDE_BY_SIDE:
        return Table("")
    return verdicts_in_short(shown, study.base.hazard)[0]


def _not_swept(verdicts: tuple[Verdict, ...], study: Study | None) -> list[Verdict]:
    swept = {name for name, source in study.derived.items() if source.vary} if study is not None else set()
    return [verdict for verdict in verdicts if own_variant(verdict.variant) not in swept]


def checks(source: Source) -> Section:
    """Return the section on criteria with source, demand, capacity and verdict, objectives, and performance levels."""
    title = "Checks"
    study, project = source.study, source.base
    parts: list[Part] = []
    of_objectives: tuple[Verdict, ...] = ()
    if study is not None and project is not None and study.objectives and source.judged_histories:
        of_objectives = judge((), study.objectives, source.judged_histories, project, study)
    own = [found for found in source.verdicts if found not in of_objectives]
    if own and study is not None:
        table, remarks = check_table(own, study.criteria), remarks_table(own)
        parts.append(Folded(f"All checks ({len(table.rows)})", (table,)) if len(table.rows) > MANY else table)
        parts += [remarks] if remarks.rows else []
    if of_objectives and study is not None and project is not None:
        parts.append(objectives_table(of_objectives, study.objectives, project))
    if project is not None and any(found.completed for found in source.sets):
        criteria = study.criteria if study is not None else ()
        parts += performance_tables(source.sets, VariantMembers(project, study), criteria, source.groups)
    return Section("checks", title, (), tuple(parts))
