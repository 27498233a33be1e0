"""What criteria need of a study: hazard levels, enough motions for a code, samples fine enough, kept histories."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.assess.statistics import CODES, code_statistic, statistic
from edesign.codes.fema356.objectives import OBJECTIVES, TOLERANCE, return_period
from edesign.codes.rule_check import with_standard
from edesign.errors import InputError
from edesign.ground_motion.hazard import action_of, objective_level, rules_in_force
from edesign.ground_motion.sources import Found
from edesign.project.actions.hazard import EC8Hazard, UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.outputs import HistoryKind, Outputs
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.dampers.verification import AnyVerify
from edesign.project.reading.problems import listed
from edesign.project.study.study import Study, warm_variant
from edesign.study.plan.study_plan import make_study_plan, verifying_histories


def check_criteria_inputs(study: Study, found: Mapping[str, Found]) -> None:
    """Check that objectives have their hazard levels, and criteria enough motions and samples.

    Args:
        study: from `load_study`.
        found: recordings by reference.

    Raises:
        InputError: an objective has no hazard level, a code wants more motions than a variant has at a level, or an
            oscillator on a floor vibrates faster than the samples that are kept can show.
    """
    _check_objectives(study)
    motions = _motions(study) if any(criterion.statistic in CODES for criterion in study.criteria) else {}
    for i, criterion in enumerate(study.criteria):
        where = f"{study.where('criteria', i)}: criteria[{i}]"
        code = CODES.get(criterion.statistic)
        for (variant, level), count in motions.items():
            of_variant = not criterion.variants or variant in criterion.variants
            at_level = level in criterion.levels if criterion.levels else bool(level)
            if code is not None and of_variant and at_level and count < code.set_rules.least_number:
                raise InputError(
                    f"{where}.statistic: `{criterion.statistic}` wants at least {code.set_rules.least_number} motions "
                    f"({with_standard(code.set_rules.clauses.number)}), and {variant} has {count} at {level}"
                    " [E-CRIT-01]"
                )
        if isinstance(criterion, QuantityCriterion) and criterion.frequency is not None:
            _check_samples(study, where, criterion.frequency, found)


def _check_objectives(study: Study) -> None:
    """An objective is judged at the hazard level of its probability; how one is given depends on the code."""
    hazard = study.base.hazard
    for i, letter in enumerate(study.objectives):
        if objective_level(letter, hazard) is not None:
            continue
        wanted = OBJECTIVES[letter].probability
        probability = f"{100 * wanted:g} %"
        rarities = _rarities(hazard)
        known = ", ".join(f"`{name}` has {100 * p:.3g} % (T_R = {return_period(p):.0f} years)" for name, p in rarities)
        if hazard is None:
            has = "and the project has no `hazard`; give it one with such a level"
        elif isinstance(hazard, EC8Hazard):
            others = f": {known}" if known else ", as levels by class or factor say no probability"
            has = f"and the project has none{others}; add to `hazard: levels` one with `probability: {probability}`"
        elif isinstance(hazard, UserHazard):
            of = "a `spectrum`" if hazard.own_shapes else "a `factor`"
            others = f": {known}" if known else ""
            add = f"add to `hazard: levels` one with {of} and `probability: {probability}`"
            has = f"and the project has none{others}; {add}"
        else:
            names = listed(hazard.levels)
            none = f"there is no probability of {names}, as levels of `code: {hazard.code}` aim at a risk of collapse"
            has = (
                f"and {known or none}; leave the objective out, or give the spectra as tables "
                "(`code: user`), whose levels may state their `probability`"
            )
        raise InputError(
            f"{study.where('objectives', i)}: objectives[{i}]: objective {letter} needs a hazard level of "
            f"{probability} in 50 years, T_R = {return_period(wanted):.0f} years within {100 * TOLERANCE:.2g} %, {has}"
            " [E-CRIT-02]"
        )


def _rarities(hazard: Hazard | None) -> list[tuple[str, float]]:
    """The probabilities of exceedance in 50 years of the levels that have one."""
    if hazard is None:
        return []
    of = action_of(hazard)
    return [(name, known) for name in hazard.levels if (known := of.probability(name)) is not None]


def too_few_motions(study: Study, name: str) -> list[str]:
    """Return a warning if criteria of a design take a mean of fewer motions than the code accepts for one.

    Of one motion every statistic is the maximum.

    Args:
        study: from `load_study`.
    """
    verify, rules = study.designs[name].verify, rules_in_force(study.base.hazard)
    at_levels: dict[str | None, set[str]] = {}
    for history in verifying_histories(study, name, 1):
        at_levels.setdefault(history.level, set()).add(history.record)
    count = min(map(len, at_levels.values()), default=0)
    if verify is None or not 1 < count < rules.number_for_mean:
        return []
    ranks = {str(rank): float(rank) for rank in range(count)}
    fewer = f"{rules.fewer} ({with_standard(rules.clauses.use)})"
    return [
        f"the criterion `{asked.name}` takes the {asked.statistic} of {count} motions, fewer than "
        f"{rules.number_for_mean}: {fewer}; `statistic: code`, the default, takes the most unfavourable value"
        for asked in study.criteria
        if asked.name in verify.criteria
        and asked.share is None
        and not asked.traits.from_below
        and statistic(code_statistic(asked.statistic, count, rules), ranks) != count - 1.0
    ]


def _motions(study: Study) -> dict[tuple[str, str], int]:
    """How many motions each variant has at each level when all of the study has run; one at all its angles is one."""
    found: dict[tuple[str, str], set[str]] = {}
    for task in make_study_plan(study):
        if isinstance(task.spec, HistoryAnalysis) and task.stripe is None:
            warm = task.temperature_C
            variant = task.variant if warm is None else warm_variant(task.variant, warm)
            found.setdefault((variant, task.spec.level or ""), set()).add(task.spec.record)
    return {key: len(records) for key, records in found.items()}


def kept_for_verification(study: Study, verify: AnyVerify) -> Outputs:
    """Return the outputs that histories of a design's verification keep for its criteria."""
    kept: list[HistoryKind] = []
    for criterion in study.criteria:
        kind = criterion.traits.kept
        if kind is not None and criterion.name in verify.criteria and kind not in kept:
            kept.append(kind)
    return Outputs(histories=tuple(kept))


def _check_samples(study: Study, where: str, frequency: float, found: Mapping[str, Found]) -> None:
    """An oscillator cannot be followed beyond half the rate of the samples: there is nothing in them."""
    integration, every = study.base.integration, study.outputs.every
    given = integration.time_step if integration is not None else None
    for reference, recording in found.items():
        step = recording.record.time_step if given is None else given
        highest = 0.5 / (every * step)
        if frequency > highest:
            kept = f"one step in {every} of {step:g} s is kept" if every > 1 else f"the steps are {step:g} s"
            raise InputError(
                f"{where}.frequency: {frequency:g} Hz is beyond {highest:g} Hz, half the rate of the samples of "
                f"{reference} ({kept}; see `integration: time_step` and `outputs: every`) [E-CRIT-03]"
            )
