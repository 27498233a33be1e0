"""Verdicts on criteria and objectives of a study, for the first page; performance levels in a section of their own."""

from __future__ import annotations

from edesign.assess.criteria import Verdict, judge
from edesign.assess.members import VariantMembers
from edesign.assess.quantities import HISTORY_OF
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.study.study import Study, own_variant
from edesign.report.assessment.tables import read_judged
from edesign.report.assessment.verdict_tables import objectives_table, performance_tables, verdicts_tables
from edesign.report.page.section import Headline, Section
from edesign.report.page.source import Source
from edesign.report.tables.table import Table


def judged(source: Source) -> tuple[tuple[Verdict, ...], list[Table]]:
    """Return the verdicts on the criteria, and the tables of criteria and objectives; nothing where none are given."""
    study, project = source.study, source.project
    if study is None or project is None or not (source.sets or source.targets):
        return (), []
    over_time = any(isinstance(c, QuantityCriterion) and c.quantity in HISTORY_OF for c in study.criteria)
    sets = (*source.sets, *source.targets)
    histories = (
        read_judged(source.archive)
        if over_time
        else {name: group for found in sets for name, group in found.histories.items()}
    )
    verdicts = judge(study.criteria, (), histories, project, study)
    tables = verdicts_tables(verdicts) if verdicts else []
    if study.objectives:
        of_objectives = judge((), study.objectives, histories, project, study)
        tables.append(objectives_table(of_objectives, study.objectives, project))
    return verdicts, tables


def verdict_tiles(verdicts: tuple[Verdict, ...], study: Study | None = None) -> tuple[Headline, ...]:
    """Return for each variant how many of the criteria that apply it meets, and which it does not.

    Those that `vary` of the study makes are only in the tables.
    """
    tiles = []
    swept = {name for name, source in study.derived.items() if source.vary} if study is not None else set()
    applying = [verdict for verdict in verdicts if verdict.applies and own_variant(verdict.variant) not in swept]
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


def performance(source: Source) -> Section:
    """Which structural performance level each variant reaches at each hazard level."""
    title = "Performance levels"
    if source.project is None or not any(found.completed for found in source.sets):
        return Section("performance", title)
    tables = performance_tables(source.sets, VariantMembers(source.project, source.study))
    return Section("performance", title, (), tuple(tables))
