"""Verification of a design by histories: verdicts on them, stored in the archive, or read from an earlier run's."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.verdicts import Verdict
from edesign.project.criteria.criteria import Criterion, MeasureCriterion, QuantityCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.criteria.measures import MEASURES
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.designs import Design
from edesign.project.dampers.verification import AnyVerify
from edesign.study.design.loop import RoundOutcome, RoundVerdict
from edesign.study.results.recording import coordinate

Respond = Callable[[Dampers, int], Mapping[str, Group]]
"""Runs the histories of a round (from 1) with these dampers."""
Judge = Callable[[Mapping[str, Group]], Sequence[Verdict]]
"""Verdicts of the criteria of a design on such histories."""


def judged(groups: Mapping[str, Group], judge: Judge) -> RoundOutcome:
    """Return the outcome of a round from its histories; an undecided criterion counts as not met.

    One that does not apply to these histories is left out, unless none does.

    Args:
        groups: results of the histories, by name.
        judge: judges them by the criteria.
    """
    failed = tuple(name for name, group in groups.items() if group.attributes.get("status", "completed") != "completed")
    verdicts = []
    taken: set[str] = set()
    given = judge(groups)
    for verdict in [one for one in given if one.applies] or given:
        name = f"{verdict.name}, {verdict.level}" if verdict.level else verdict.name
        while name in taken:
            name += "'"
        taken.add(name)
        value = math.nan if verdict.value is None else verdict.value
        verdicts.append(RoundVerdict(name, value, verdict.limit, bool(verdict.met), verdict.unit))
    return RoundOutcome(tuple(verdicts), failed)


def histories_at(level: str | None, verify: AnyVerify | None, histories: Mapping[str, Group]) -> list[Group]:
    """Return the histories at the level of a design, else at the first level of its verification.

    Args:
        level: of the design; None: it has none.
        histories: results of the histories of a round, by name.
    """
    levels = {str(group.attributes.get("level") or "") for group in histories.values()}
    at = level if level in levels or verify is None or not verify.levels else verify.levels[0]
    return [group for group in histories.values() if (group.attributes.get("level") or "") == (at or "")]


def along_design(criterion: Criterion, spec: Design) -> Criterion:
    """Return a criterion that looks along the direction of a design of a building where it does not say another one.

    Args:
        spec: the design; one of a plane frame has no direction.
    """
    along = getattr(spec, "along", None)
    if along is None or not isinstance(criterion, MeasureCriterion | QuantityCriterion) or criterion.frames:
        return criterion
    told = MEASURES if isinstance(criterion, MeasureCriterion) else QUANTITIES
    if criterion.direction is not None or "direction" not in told[criterion.subject].in_space:
        return criterion
    return criterion.model_copy(update={"direction": along})


def mean_drift(histories: Sequence[Group], along: str | None = None) -> tuple[float, ...]:
    """Return the storey drifts over height, (f,), mean of the peaks of completed histories; empty if there are none.

    Args:
        along: direction of a building, in which the largest of its column lines counts; None: of a plane frame.
    """
    peaks = [
        _of_direction(group, along)
        for group in histories
        if group.attributes.get("status", "completed") == "completed" and "storey_drift_max" in group.variables
    ]
    return tuple(np.mean(peaks, axis=0).tolist()) if peaks else ()


def _of_direction(group: Group, along: str | None) -> np.ndarray:
    """The larger of both signs of the peaks of the storey drifts, (f,)."""
    largest, smallest = (group.variables[f"storey_drift_{which}"].values for which in ("max", "min"))
    peaks = np.maximum(largest, -smallest)
    return peaks if along is None else peaks[:, list(group.coords["direction"].values).index(along)]


def kept_outcome(
    resume: Group | None, number: int, value: float, size: Mapping[str, float | np.ndarray]
) -> RoundOutcome | None:
    """Return the outcome of a round of an earlier run if it had the same dampers, else None.

    Args:
        value: what the round changed.
        size: of its dampers, by the name of the variable `round_NAME`.
    """
    if resume is None or "criterion_unit" not in resume.variables:
        return None
    rounds = resume.coords["round"].values.tolist()
    if number not in rounds:
        return None
    i = rounds.index(number)
    now = {"changed": value, **size}
    if not all(np.array_equal(resume.variables[f"round_{name}"].values[i], x) for name, x in now.items()):
        return None
    outcome = stored_outcomes(resume, rounds)[i]
    if not outcome.verdicts:
        return None
    strain, drift, force = (resume.variables.get(f"round_history_{name}") for name in ("strain", "drift", "force"))
    if strain is not None:
        outcome = replace(outcome, strain=float(strain.values[i]))
    if drift is not None:
        outcome = replace(outcome, drift=tuple(drift.values[i].tolist()))
    if force is not None:
        level = str(resume.attributes.get("history_force_level", ""))
        outcome = replace(outcome, force=tuple(force.values[i].tolist()), force_level=level)
    return outcome


def store_outcomes(group: Group, dim: str, numbers: Sequence[int], outcomes: Sequence[RoundOutcome | None]) -> None:
    """Add the verdicts of all rounds or layouts, and the histories that failed.

    Args:
        dim: "round" or "layout".
        numbers: of the rounds or layouts, by which failed histories are named.
        outcomes: one for each; None: not verified.
    """
    known = [(row, outcome) for row, outcome in enumerate(outcomes) if outcome is not None]
    if not known:
        return
    failed = [0 if outcome is None else len(outcome.failed) for outcome in outcomes]
    group.add(f"{dim}_failed_histories", (dim,), failed, "1", "histories that were not completed")
    units = {verdict.name: verdict.unit for _, outcome in known for verdict in outcome.verdicts}
    if not units:
        return
    columns = {name: column for column, name in enumerate(units)}
    coordinate(group, "criterion", list(units), "", "name of the criterion")
    for part, label in (("value", "value that is judged"), ("limit", "its limit"), ("met", "1: met")):
        rows = np.full((len(outcomes), len(units)), np.nan)
        for row, outcome in known:
            for verdict in outcome.verdicts:
                rows[row, columns[verdict.name]] = float(getattr(verdict, part))
        label = f"{label}, in the unit of the criterion; nan: none, or it does not apply"
        group.add(f"verdict_{part}", (dim, "criterion"), rows, "1", label)
    group.add("criterion_unit", ("criterion",), list(units.values()), "", "SI unit of the value and its limit")
    group.attributes["failed_histories"] = {str(numbers[row]): list(one.failed) for row, one in known if one.failed}


def stored_outcomes(group: Group, numbers: Sequence[int]) -> list[RoundOutcome]:
    """Return the outcomes that `store_outcomes` has stored, without strains.

    A round without verdicts was not verified.

    Args:
        numbers: of the rounds or layouts, in their order.
    """
    names = [str(name) for name in group.coords["criterion"].values]
    units = [str(unit) for unit in group.variables["criterion_unit"].values]
    value, limit, met = (group.variables[f"verdict_{part}"].values for part in ("value", "limit", "met"))
    lost = group.attributes.get("failed_histories")
    failed: Mapping[str, Sequence[str]] = lost if isinstance(lost, Mapping) else {}
    return [
        RoundOutcome(
            tuple(
                RoundVerdict(name, float(value[row, i]), float(limit[row, i]), bool(met[row, i]), unit)
                for i, (name, unit) in enumerate(zip(names, units, strict=True))
                if not np.isnan(met[row, i])
            ),
            tuple(failed.get(str(number), ())),
        )
        for row, number in enumerate(numbers)
    ]
