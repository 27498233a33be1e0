"""Tables of verdicts on criteria, of performance levels, and of rehabilitation objectives."""

from __future__ import annotations

from collections.abc import Sequence
from math import isinf

from edesign.assess.criteria import Verdict
from edesign.assess.members import ELASTIC_ROTATION, VariantMembers
from edesign.assess.performance import Usage, set_performance
from edesign.assess.requirement import UNITS, shown
from edesign.assess.sets import HistorySet
from edesign.codes.criterion import with_standard
from edesign.codes.fema356.drift import NEGLIGIBLE, PERFORMANCE_LEVELS
from edesign.codes.fema356.objectives import OBJECTIVES
from edesign.ground_motion.hazard import objective_level, rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.project.criteria.criteria import Objectives
from edesign.project.project import Project
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import missing_notes
from edesign.report.tables.table import NumberText, Table, formatted, whole
from edesign.report.tables.text import wrapped

REMARKS = "Remarks on the criteria"
BEYOND = 10
"""Demand over capacity from which on its size means nothing but that the limit is far off."""
TARGETS = "Of target displacements the D/C is the maximum over patterns and directions."


def verdicts_tables(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[Table]:
    """Return the verdicts on criteria, the governing histories, remarks, and the requirements.

    Each fits a page; those that would be empty are left out.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code says what few histories are worth.
    """
    name = ("criterion", "variant", "level")
    answers = Table("Criteria", (*name, "verdict", "value", "limit", "D/C"), left=4, sentences=(0, 1), name="criteria")
    governs = Table(
        "What governs the criteria",
        (*name, "place", "motion", "statistic", "of"),
        left=6,
        sentences=(0, 1, 4),
        name="governing",
    )
    remarks = Table(REMARKS, (*name, "remark"), left=4, sentences=(3, 0))
    required = dict.fromkeys((verdict.name, verdict.requirement) for verdict in verdicts)
    requirements = Table(
        "What the criteria require",
        ("criterion", "requirement"),
        [list(pair) for pair in required],
        left=2,
        sentences=(1, 0),
        name="requirements",
    )
    for verdict in verdicts:
        about = [verdict.name, verdict.variant or "-", verdict.level or "-"]
        value, limit = (measured(found, verdict.unit) for found in (verdict.value, verdict.limit))
        answers.rows.append([*about, verdict.answer, value, limit, ratio_text(verdict)])
        if verdict.governing_history:
            of = [verdict.statistic, f"{verdict.count}/{verdict.count + len(verdict.missing)}"]
            where = ("-", "-") if verdict.negligible else (verdict.place or "frame", motion_of(verdict))
            governs.rows.append([*about, *where, *of])
        if said := "; ".join(part for part in (verdict.remark, _missing(verdict)) if part):
            remarks.rows.append([*about, f"{verdict.answer}: {said}"])
    answers.notes += wrapped("D/C: demand over capacity, value / limit; limit / value if the limit is a lower bound.")
    if governs.rows:
        governs.notes += wrapped(
            "Where the value is largest, or smallest if the limit is a lower bound; of: histories that have it."
        )
        governs.notes += few_notes(verdicts, hazard)
    return [table for table in (answers, governs, remarks, requirements) if table.rows]


def ratio_text(verdict: Verdict) -> str:
    """Return demand over capacity with two decimals; from 10 on how far it is beyond means nothing."""
    if verdict.ratio is None:
        return "-"
    return beyond_or(verdict.ratio, formatted(verdict.ratio, ".2f"))


def beyond_or(ratio: float, text: str) -> str:
    """Return the text of demand over capacity, or that it is far beyond; infinite ones, of failed histories, stay.

    Args:
        ratio: demand over capacity.
        text: the ratio as text.
    """
    return text if ratio < BEYOND or isinf(ratio) else NumberText(f"> {BEYOND}", ratio)


def performance_tables(sets: Sequence[HistorySet], members: VariantMembers, statistic: str = "mean") -> list[Table]:
    """Return the performance level of each variant at each hazard level: by drift, and by plastic rotations.

    Args:
        sets: the histories by variant and level.
        members: acceptance limits of the members, by variant.
        statistic: the statistic over the records.
    """
    title, under = "FEMA 356 performance levels", f"({statistic}, and histories at each)"
    columns = ("variant", "level", "reached", "IO", "LS", "CP", "beyond", "of", "governs")
    by_drift = Table(f"{title} by drift {under}", columns, left=2, sentences=8, name="performance_by_drift")
    by_members = Table(
        f"{title} by plastic rotation {under}", columns, left=2, sentences=8, name="performance_by_rotation"
    )
    for found in sets:
        p = set_performance(found, members(found.variant), statistic)
        for table, level, number, worst in (
            (by_drift, p.by_drift, p.drift_counts, p.worst_drift),
            (by_members, p.by_members, p.member_counts, p.worst_members),
        ):
            counts = [*(whole(count) for count in number.values()), f"{p.count}/{p.count + len(p.missing)}"]
            table.rows.append([p.variant or "-", p.level or "-", level or "-", *counts, _usage(worst)])
    governs = "Governs: the history with the largest demand over capacity (D/C) of Collapse Prevention, met up to 1."
    transient = "Drift: Table C1-3, transient 0.7, 2.5, 5 %, permanent"
    by_drift.notes = [
        *wrapped(f'{transient} {100 * NEGLIGIBLE:g} ("negligible" there), 1, 5 %; of: histories that count.'),
        *wrapped(governs),
        *missing_notes(sets),
    ]
    by_members.notes = wrapped(
        f"Members: Table 5-6. A column with P/P_CL > 0.5 is force-controlled and has to stay elastic: up to "
        f"{1e3 * ELASTIC_ROTATION:g} mrad count as that. P is its largest compression in the history, with what "
        f"dampers add; P_CL its buckling strength over the storey (K = 1). {governs}"
    )
    if not any(members(found.variant) for found in sets):
        by_members.notes.append("No member has a section and a material that Table 5-6 knows.")
    return [by_drift, by_members]


def objectives_table(verdicts: Sequence[Verdict], objectives: Objectives, project: Project) -> Table:
    """Return a row for each objective and variant; `verdicts` are those of `judge` on the objectives.

    Args:
        verdicts: the verdicts of `judge` on the objectives.
        objectives: the performance objectives of the study.
        project: the project.
    """
    columns = (
        "objective",
        "variant",
        "by",
        "verdict",
        "hazard level",
        "performance",
        "class",
        "D/C",
        "histories",
        "governs",
    )
    table = Table(
        "Rehabilitation objectives (mean D/C, demand over capacity, met up to 1)",
        columns,
        left=7,
        name="rehabilitation_objectives",
    )
    for letter in objectives:
        objective = OBJECTIVES[letter]
        hazard = f"{100 * objective.probability:g} % in 50 years"
        for verdict in verdicts:
            if not verdict.name.startswith(f"objective {letter},"):
                continue
            value = "-" if verdict.value is None else beyond_or(verdict.value, measured(verdict.value, verdict.unit))
            level = objective_level(letter, project.hazard)
            table.rows.append(
                [
                    letter,
                    verdict.variant or "-",
                    verdict.name.rpartition(" ")[2],
                    verdict.answer,
                    f"{hazard} ({level or 'none'})",
                    f"{PERFORMANCE_LEVELS[objective.level]} ({objective.level})",
                    objective.rank,
                    value,
                    f"{verdict.count} of {verdict.count + len(verdict.missing)}",
                    _governs(verdict),
                ]
            )
            if verdict.statistic == "maximum" and TARGETS not in table.notes:
                table.notes.append(TARGETS)
            about = [part for part in (verdict.remark, _missing(verdict)) if part]
            if about:
                table.notes.append(
                    f"{letter}, {verdict.variant or '-'}, {verdict.name.rpartition(' ')[2]}: {'; '.join(about)}"
                )
    if table.rows:
        table.notes.append("Objectives: FEMA 356, Table C1-1, lettered without the column of the Operational level.")
    table.notes += few_notes(verdicts, project.hazard)
    return table


def measured(value: float | None, unit: str) -> str:
    """Return a value of a verdict, in SI, with the unit people read; a number still.

    Args:
        value: in SI; None: there is none.
        unit: its SI unit.
    """
    if value is None:
        return "-"
    label, size = UNITS[unit]
    return NumberText(shown(value, unit), value / size, label)


def _governs(verdict: Verdict) -> str:
    if verdict.negligible:
        return "-"
    return ", ".join(part for part in (verdict.governing_history, verdict.place) if part) or "-"


def motion_of(verdict: Verdict) -> str:
    """Return the record of the history that governs, by the end of its name: damped.DBE.Tabas1978 -> Tabas1978."""
    name = verdict.governing_history
    return name.partition(f".{verdict.level}.")[2] or name


def _usage(worst: tuple[str, Usage] | None) -> str:
    if worst is None:
        return "-"
    history, usage = worst
    if usage.of_force:
        return f"{usage.of_force}, {history}"
    if usage.ratio < ROUNDING:
        return "D/C 0"
    place = usage.member or f"storey {usage.storey}"
    return f"D/C {beyond_or(usage.ratio, f'{usage.ratio:.3g}')}: {usage.governing}, {place}, {history}"


def few_notes(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[str]:
    """Return what the code in force says of statistics over few histories, or of one, if a verdict rests on them.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code is in force.
    """
    rules = rules_in_force(hazard)
    sets: dict[str, int] = {}
    for v in verdicts:
        count = v.count + len(v.missing)
        if v.statistic not in ("maximum", "share") and 0 < count < rules.number_for_mean:
            sets[", ".join(part for part in (v.variant, v.level) if part) or "the frame"] = count
    single = [name for name, count in sets.items() if count == 1]
    few = [name for name, count in sets.items() if count > 1]
    lines = []
    if few:
        lines += wrapped(
            f"Fewer than {rules.number_for_mean} histories: {'; '.join(few)}. "
            f"{rules.fewer[0].upper()}{rules.fewer[1:]} ({with_standard(rules.clauses.use)})."
        )
    if single:
        lines += wrapped(
            f"One history only: {'; '.join(single)}. It shows how the frame responds and proves nothing: "
            f"{with_standard(rules.clauses.number)}, asks for {rules.least_number} at least."
        )
    return lines


def _missing(verdict: Verdict) -> str:
    return f"missing: {', '.join(verdict.missing)}" if verdict.missing else ""
