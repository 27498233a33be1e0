"""Verification of a round of a design: verdicts on its histories, or those that an earlier run kept."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.criteria import Verdict
from edesign.project.dampers.dampers import Dampers
from edesign.study.design.loop import RoundOutcome, RoundVerdict

Respond = Callable[[Dampers, int], Mapping[str, Group]]
"""Runs the histories of a round (from 1) with these dampers."""
Judge = Callable[[Mapping[str, Group]], Sequence[Verdict]]
"""Verdicts of the criteria of a design on such histories."""


def judged(groups: Mapping[str, Group], judge: Judge) -> RoundOutcome:
    """The outcome of a round from its histories; a criterion that says neither yes nor no is not met.

    One that does not apply to these histories is left out, unless none does.
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


def kept_outcome(
    resume: Group | None, number: int, value: float, size: Mapping[str, float | np.ndarray]
) -> RoundOutcome | None:
    """The outcome of a round (from 1) of an earlier run, if it had the same dampers.

    Args:
        resume: what the earlier run kept.
        number: of the round.
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
    value_of, limit_of, met_of = (resume.variables[f"verdict_{part}"].values[i] for part in ("value", "limit", "met"))
    if np.any(np.isnan(met_of)):
        return None
    names = [str(criterion) for criterion in resume.coords["criterion"].values]
    met = [bool(one) for one in met_of]
    units = [str(unit) for unit in resume.variables["criterion_unit"].values]
    verdicts = zip(names, value_of.tolist(), limit_of.tolist(), met, units, strict=True)
    failed = resume.attributes.get("failed_histories", {}).get(str(number), ())
    strain = resume.variables.get("round_history_strain")
    return RoundOutcome(
        tuple(RoundVerdict(*verdict) for verdict in verdicts),
        tuple(failed),
        math.nan if strain is None else float(strain.values[i]),
    )
