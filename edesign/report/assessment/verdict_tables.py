"""Tables of verdicts on criteria, of performance levels, and of rehabilitation objectives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isinf
from operator import itemgetter
from types import MappingProxyType
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.assess.members import VariantMembers, with_gravity
from edesign.assess.performance import SetPerformance, Usage, set_performance
from edesign.assess.requirement import NEGLIGIBLE as NO_VALUE
from edesign.assess.requirement import UNITS
from edesign.assess.sets import HistorySet
from edesign.assess.statistics import code_statistic
from edesign.assess.verdicts import Verdict
from edesign.codes.fema356.drift import NEGLIGIBLE, PERFORMANCE_LEVELS
from edesign.codes.fema356.objectives import BASIC, OBJECTIVES, Objective
from edesign.codes.motion_sets import SetRules
from edesign.codes.rule_check import UNREAD, with_standard
from edesign.ground_motion.hazard import objective_level, rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import CODE_IN_FORCE, Criterion, Objectives, PerformanceCriterion
from edesign.project.criteria.performance import PERFORMANCE_STANDARDS, Standard
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import missing_notes
from edesign.report.drawing.captions import record_label
from edesign.report.tables import cell
from edesign.report.tables.cell import Plain, Quantity, Rounded, State, Value
from edesign.report.tables.column import Column, col, count, text, verdict
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import ONE, Unit

BEYOND = 10
"""Demand over capacity from which on its size means nothing but that the limit is far off."""
STATES: Mapping[str, State] = {"met": "good", "not met": "bad", "open": "open"}
"""Of answers."""


@dataclass(frozen=True)
class _Measured(Quantity):
    """A value of a verdict; files have it with all digits where people read that it is negligible."""

    def data(self, column: Column) -> Plain:
        """Return the number in its unit."""
        return None if self.value is None else self.value / self.unit.si


def beyond_or(ratio: float, value: Value) -> Value:
    """Return demand over capacity, or that it is far beyond; infinite ones, of failed histories, stay.

    Args:
        value: the ratio as it is shown.
    """
    return value if ratio < BEYOND or isinf(ratio) else Rounded(f"> {BEYOND}", ratio)


def _ratio(found: Verdict) -> Value:
    return None if found.ratio is None else beyond_or(found.ratio, found.ratio)


RATIO: Column[Verdict] = col("D/C", ONE, _ratio, form=".2f")
"""Demand over capacity."""


def answer(found: Verdict, more: str = "") -> cell.Verdict:
    """Return whether a criterion is met, with more words behind it."""
    return cell.Verdict(f"{found.answer} {more}".rstrip(), STATES.get(found.answer, ""))


def measured(value: float | None, unit: str) -> Quantity | None:
    """Return a value of a verdict with the unit that people read.

    Args:
        value: in SI; None: there is none.
        unit: its SI unit.
    """
    return None if value is None else _Measured(value, Unit(*UNITS[unit]), form=".4g", negligible=NO_VALUE)


def motion_of(found: Verdict) -> str:
    """Return the record of the history that governs, by the end of its name: damped.DBE.Tabas1978 -> Tabas1978."""
    name = found.governing_history
    return name.partition(f".{found.level}.")[2] or name


def governs(found: Verdict) -> str | None:
    """Return the place and the motion of a value; None: the value is negligible."""
    if found.negligible:
        return None
    motion = found.governing_history.partition(f".{found.level}.")[2] if found.level else ""
    parts = [found.place, record_label(motion) if motion else found.governing_history]
    return ", ".join(part for part in parts if part) or None


def _remark(found: Verdict) -> str:
    """What is to be said of a verdict beside its numbers."""
    missing = f"missing: {', '.join(found.missing)}" if found.missing else ""
    return "; ".join(part for part in (found.remark, missing) if part)


def _number(found: Verdict) -> int:
    """Histories that count."""
    return found.count + len(found.missing)


VARIANT: Column[Verdict] = text("variant", lambda found: found.variant or None)
LEVEL: Column[Verdict] = text("level", lambda found: found.level or None)
CRITERIA = TableSpec[Verdict](
    "criteria",
    "Criteria",
    (
        text("criterion", "name", broken=1),
        replace(VARIANT, broken=2),
        LEVEL,
        verdict("verdict", answer),
        text("value", lambda found: measured(found.value, found.unit)),
        text("limit", lambda found: measured(found.limit, found.unit)),
        RATIO,
    ),
    notes=wrapped("D/C: demand over capacity, value / limit; limit / value if the limit is a lower bound."),
    keys=4,
)
GOVERNING = TableSpec[Verdict](
    "governing",
    "What governs the criteria",
    (
        text("criterion", "name", broken=1),
        replace(VARIANT, broken=2),
        LEVEL,
        text("place", lambda found: None if found.negligible else found.place or "structure"),
        text("motion", lambda found: None if found.negligible else motion_of(found), broken=3),
        text("statistic"),
        count("of", lambda found: f"{found.count}/{_number(found)}"),
    ),
    notes=wrapped("Where the value is largest, or smallest if the limit is a lower bound; of: histories that have it."),
    keys=6,
)
REMARKS = TableSpec[Verdict](
    "remarks_on_the_criteria",
    "Remarks on the criteria",
    (
        text("criterion", "name", broken=2),
        VARIANT,
        LEVEL,
        text("remark", lambda found: f"{found.answer}: {_remark(found)}", broken=1),
    ),
    keys=4,
    named_by_title=True,
)
REQUIREMENTS = TableSpec[tuple[str, str]](
    "requirements",
    "What the criteria require",
    (text("criterion", itemgetter(0), broken=2), text("requirement", itemgetter(1), broken=1)),
    keys=2,
)


def verdicts_tables(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[Table]:
    """Return the verdicts on criteria, the governing histories, remarks, and the requirements.

    Each fits a page; those that would be empty are left out.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code says what few histories are worth.
    """
    required = dict.fromkeys((found.name, found.requirement) for found in verdicts)
    governed = [found for found in verdicts if found.governing_history]
    tables = [
        CRITERIA.of(verdicts),
        GOVERNING.of(governed, notes=few_notes(verdicts, hazard)),
        remarks_table(verdicts),
        REQUIREMENTS.of(required),
    ]
    return [table for table in tables if table.rows]


def remarks_table(verdicts: Sequence[Verdict]) -> Table:
    """Return what is to be said of verdicts beside their numbers."""
    return REMARKS.of(found for found in verdicts if _remark(found))


def _usage(worst: tuple[str, Usage] | None) -> str | None:
    if worst is None:
        return None
    history, usage = worst
    if usage.of_force:
        return f"{usage.of_force}, {history}"
    if usage.ratio < ROUNDING:
        return "D/C 0"
    ratio = col("D/C", ONE, digits=3).text(beyond_or(usage.ratio, f"{usage.ratio:.3g}"))
    return f"D/C {ratio}: {usage.governing}, {usage.place}, {history}"


def _performance(
    reached: str, counts: str, worst: str, standard: Standard = "fema356"
) -> tuple[Column[SetPerformance], ...]:
    """The columns of one of the two ways to judge performance levels, by the names of attributes."""
    levels = [*PERFORMANCE_STANDARDS[standard].levels]

    def at(level: str) -> Callable[[SetPerformance], int]:
        return lambda found: int(getattr(found, counts)[level])

    return (
        text("variant", lambda found: found.variant or None),
        text("level", lambda found: found.level or None),
        text("reached", reached),
        *(count(level, at(level)) for level in levels),
        count("beyond", at(f"beyond {levels[-1]}")),
        count("of", lambda found: f"{found.count}/{found.count + len(found.missing)}"),
        text("governs", lambda found: _usage(getattr(found, worst)), broken=1),
    )


def _governing(standard: Standard = "fema356") -> str:
    last = [*PERFORMANCE_STANDARDS[standard].levels.values()][-1]
    return f"Governs: the history with the largest demand over capacity (D/C) of {last}, met up to 1."


BY_DRIFT = TableSpec[SetPerformance](
    "performance_by_drift",
    "FEMA 356 performance levels by drift ({statistic}, and histories at each)",
    _performance("by_drift", "drift_counts", "worst_drift"),
    notes=[
        *wrapped(
            "Drift: Table C1-3, transient 0.7, 2.5, 5 %, permanent "
            f'{100 * NEGLIGIBLE:g} ("negligible" there), 1, 5 %; of: histories that count.'
        ),
        *wrapped(_governing()),
    ],
    keys=2,
)
BY_MEMBERS = TableSpec[SetPerformance](
    "performance_by_rotation",
    "FEMA 356 performance levels by plastic rotation ({statistic}, and histories at each)",
    _performance("by_members", "member_counts", "worst_members"),
    notes=wrapped(
        "Members: Table 5-6. A column with P/P_CL > 0.5 is force-controlled and has to stay elastic: up to "
        f"{1e3 * ELASTIC_ROTATION:g} mrad count as that. P is its largest compression in the history, with what "
        f"dampers add; P_CL its buckling strength over the storey (K = 1). {_governing()}"
    ),
    keys=2,
)
_ELASTIC = f"has to stay elastic: up to {1e3 * ELASTIC_ROTATION:g} mrad count as that"
BY_ASCE41 = TableSpec[SetPerformance](
    "performance_by_rotation_asce41",
    "ASCE/SEI 41-17 performance levels by plastic rotation ({statistic}, and histories at each)",
    _performance("by_members", "member_counts", "worst_members", "asce41-17"),
    notes=wrapped(
        f"Members: Table 9-7.1, columns by P_G of gravity. One with P_G/P_ye > 0.6 {_ELASTIC}. {_governing()}"
    ),
    keys=2,
)
BY_EN1998_3 = TableSpec[SetPerformance](
    "performance_by_rotation_en1998_3",
    "EN 1998-3 limit states by plastic rotation ({statistic}, and histories at each)",
    _performance("by_members", "member_counts", "worst_members", "en1998-3"),
    notes=wrapped(
        f"Members: Table B.1, by the largest compression. One with nu = N/N_pl > 0.3, or of class 3 or 4, {_ELASTIC}. "
        f"{UNREAD} {_governing('en1998-3')}"
    ),
    keys=2,
)
_OTHERS: Mapping[Standard, TableSpec[SetPerformance]] = {"asce41-17": BY_ASCE41, "en1998-3": BY_EN1998_3}


def performance_tables(
    sets: Sequence[HistorySet],
    members: VariantMembers,
    criteria: Sequence[Criterion] = (),
    groups: Mapping[str, Group] = MappingProxyType({}),
) -> list[Table]:
    """Return the performance level of each variant at each hazard level: by drift, and by plastic rotations.

    They are those of FEMA 356, and of each other standard that a criterion asks for.

    Args:
        members: acceptance limits of the members, by variant.
        criteria: of the study.
        groups: results by name, gravity analyses among them.
    """
    judged = [(one, code_statistic(CODE_IN_FORCE, one.motions, members.rules)) for one in sets]
    taken = " or ".join(dict.fromkeys(statistic for _, statistic in judged)) or "mean"
    found = [set_performance(one, members(one.variant), statistic) for one, statistic in judged]
    known, loaded = any(members(one.variant) for one in sets), with_gravity(members, groups)
    asked = {criterion.standard for criterion in criteria if isinstance(criterion, PerformanceCriterion)}
    without = [] if known else ["No member has a section and a material that Table 5-6 knows."]
    return [
        BY_DRIFT.of(found, statistic=taken, notes=[*missing_notes(sets), *_by_number(taken, members.rules)]),
        BY_MEMBERS.of(found, statistic=taken, notes=without),
        *(
            spec.of(
                (set_performance(one, loaded(one.variant), statistic, name) for one, statistic in judged),
                statistic=taken,
            )
            for name, spec in _OTHERS.items()
            if name in asked
        ),
    ]


def _by_number(statistic: str, rules: SetRules) -> list[str]:
    """Say from how many motions on the mean counts, where the statistic is not the mean."""
    if statistic == "mean":
        return []
    return wrapped(
        f"Statistic: of fewer than {rules.number_for_mean} motions the maximum counts "
        f"({with_standard(rules.clauses.use)})."
    )


class _Judged(NamedTuple):
    """A verdict on a rehabilitation objective, and the hazard level that stands for its probability."""

    objective: Objective
    found: Verdict
    hazard_level: str | None

    @property
    def by(self) -> str:
        return self.found.name.rpartition(" ")[2]

    @property
    def variant(self) -> str:
        return self.found.variant or "-"


def _hazard(one: _Judged) -> str:
    return f"{100 * one.objective.probability:g} % in 50 years ({one.hazard_level or 'none'})"


def _performance_level(one: _Judged) -> str:
    return f"{PERFORMANCE_LEVELS[one.objective.level]} ({one.objective.level})"


def _demand(one: _Judged) -> Value:
    value = one.found.value
    return None if value is None else beyond_or(value, measured(value, one.found.unit))


REHABILITATION = TableSpec[_Judged](
    "rehabilitation_objectives",
    "Rehabilitation objectives (D/C, demand over capacity, met up to 1)",
    (
        text("objective", "objective.letter"),
        text("variant"),
        text("by"),
        verdict("verdict", lambda one: answer(one.found)),
        col("D/C", ONE, _demand),
        text("hazard level", _hazard),
        text("performance", _performance_level),
        text("class", "objective.rank"),
        text("statistic", "found.statistic"),
        count("histories", lambda one: f"{one.found.count} of {_number(one.found)}"),
        text("governs", lambda one: governs(one.found)),
    ),
    keys=4,
)
TARGETS = "Of target displacements the D/C is the maximum over patterns and directions."
LETTERS = "Objectives: FEMA 356, Table C1-1, lettered without the column of the Operational level."


def objectives_table(verdicts: Sequence[Verdict], objectives: Objectives, project: AnalysisFile) -> Table:
    """Return a row for each objective and variant; `verdicts` are those of `judge` on the objectives.

    Args:
        verdicts: the verdicts of `judge` on the objectives.
        objectives: the performance objectives of the study.
    """
    judged = [
        _Judged(OBJECTIVES[letter], found, objective_level(letter, project.hazard))
        for letter in objectives
        for found in verdicts
        if found.name.startswith(f"objective {letter},")
    ]
    notes: list[str] = []
    for one in judged:
        if one.found.of_target and TARGETS not in notes:
            notes.append(TARGETS)
        if said := _remark(one.found):
            notes.append(f"{one.objective.letter}, {one.variant}, {one.by}: {said}")
    notes += [LETTERS] * bool(judged)
    absent = [letter for letter in BASIC if letter not in objectives]
    if absent and any(one.objective.rank == "basic" for one in judged):
        notes += wrapped(
            f"Basic: {' and '.join(BASIC)} together are the basic safety objective; {absent[0]} is not judged here."
        )
    return REHABILITATION.of(judged, notes=[*notes, *few_notes(verdicts, project.hazard)])


def few_notes(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[str]:
    """Return what the code in force says of statistics over few histories, or of one, if a verdict rests on them.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code is in force.
    """
    rules = rules_in_force(hazard)
    single: dict[str, None] = {}
    few: dict[str, dict[str, None]] = {}
    for v in verdicts:
        if v.of_target or not 0 < v.number < rules.number_for_mean:
            continue
        where = ", ".join(part for part in (v.variant, v.level) if part) or "the structure"
        if v.number == 1:
            single[where] = None
        elif v.statistic not in ("maximum", "minimum", "share"):
            few.setdefault(f"{v.name} ({v.statistic})", {})[where] = None
    lines = []
    if few:
        rows = "; ".join(f"{name} of {' and '.join(sets)}" for name, sets in few.items())
        lines += wrapped(
            f"Not judged as the code does: {rows}. Of fewer than {rules.number_for_mean} motions {rules.fewer} "
            f"({with_standard(rules.clauses.use)})."
        )
    if single:
        lines += wrapped(
            f"One history only: {'; '.join(single)}. It shows how the structure responds and proves nothing: "
            f"{with_standard(rules.clauses.number)}, asks for {rules.least_number} at least."
        )
    return lines
