"""Recordings and their fit to the spectrum as groups of the archive."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.codes.ec8 import RuleCheck
from edesign.codes.motion_sets import DAMPING
from edesign.codes.spectrum import Spectrum
from edesign.ground_motion.component_pairs import NAMES, PairFit
from edesign.ground_motion.intensity import measures
from edesign.ground_motion.matching import Match
from edesign.ground_motion.plausibility import record_warnings
from edesign.ground_motion.response_spectrum import PERIODS, psa
from edesign.study.motions.motions import Motion
from edesign.study.results.kinds import RECORDS

SEISMOLOGY = {"event", "year", "station", "component", "magnitude", "distance", "v_s30", "rsn", "pair", "direction"}


def criteria(
    motions: Sequence[Motion],
    target: Spectrum,
    first_periods: Sequence[float] | None,
    variant_periods: Mapping[str, float] | None = None,
) -> tuple[RuleCheck, ...]:
    """Return the verdicts of the code's criteria on a set of recordings that were fitted.

    Args:
        motions: those that could not be fitted are left out.
        target: the elastic spectrum.
        first_periods: T1 of the structure by direction, s; None leaves the criterion on the mean spectrum open.
        variant_periods: T1 of other structures that the set acts on, s, by name; each adds that criterion.

    Source: the rules of the target's code for a set, such as EN 1998-1:2004, 3.2.3.1.2(4).
    """
    matches = [motion.match for motion in motions if motion.match is not None]
    if not matches:
        return ()
    others, clause = variant_periods or {}, target.set_rules.clauses.mean
    verdicts = list(_checked(matches, target, first_periods))
    of_mean = [i for i, verdict in enumerate(verdicts) if verdict.clause == clause]
    if others:
        for i in of_mean:
            verdicts[i] = replace(verdicts[i], text=f"{verdicts[i].text}, bare frame")
    names: dict[float, list[str]] = {}
    for name, period in others.items():
        names.setdefault(period, []).append(name)
    for period, of in reversed(names.items()):  # the period shows in the band of the text
        found = [verdict for verdict in _checked(matches, target, (period,)) if verdict.clause == clause]
        after = of_mean[-1] + 1
        verdicts[after:after] = [replace(verdict, text=f"{verdict.text}, {', '.join(of)}") for verdict in found]
    return tuple(verdicts)


def _checked(
    matches: Sequence[Match], target: Spectrum, first_periods: Sequence[float] | None
) -> tuple[RuleCheck, ...]:
    rules, T_1 = target.set_rules.of(matched=matches[0].method != "scale"), None
    if first_periods is not None:
        rules, T_1 = rules.over(first_periods)
    records = [match.matched for match in matches]
    periods = rules.check_periods(T_1) if T_1 is not None else PERIODS
    spectra = [psa(record.acceleration, record.time_step, periods, DAMPING) for record in records]
    peaks = [record.pga for record in records]
    at_5_percent = target.with_damping(DAMPING)  # which is what the codes compare
    verdicts = rules.check(periods, spectra, peaks, at_5_percent, T_1).criteria
    if T_1 is None:
        return verdicts
    first, last = float(matches[0].periods[0]), float(matches[0].periods[-1])
    low, high = rules.period_band(T_1)
    if first <= low and high <= last:
        return verdicts
    outside = f"; fitted were {first:g} s to {last:g} s only"
    return tuple(
        replace(verdict, detail=verdict.detail + outside) if verdict.clause == rules.clauses.mean else verdict
        for verdict in verdicts
    )


def failed_criteria(name: str, group: Group) -> list[str]:
    """Return one sentence for each criterion on the mean of a suite that is not met.

    Args:
        group: of the suite in the archive.
    """
    return [
        f"records {name}: not met: {found['clause']}, {found['text']}: {found['value']:.3g} {found['unit']}".rstrip()
        + f", required {found['required']:.3g}"
        for found in group.attributes.get("criteria", ())
        if found["passed"] is False
    ]


def suite_groups(
    name: str,
    motions: Sequence[Motion],
    target: Spectrum | None = None,
    verdicts: Sequence[RuleCheck] = (),
    order: int = 0,
    warnings: Sequence[str] = (),
    choice: Mapping[str, Any] | None = None,
    pair: PairFit | None = None,
) -> Iterator[tuple[str, Group]]:
    """Yield place and group of a suite, then of its recordings.

    Args:
        name: of the suite in the archive.
        target: the spectrum they were fitted to; None if they were not.
        verdicts: from `criteria`.
        order: place of the suite among all records.
        warnings: what the user should know of the whole.
        choice: how the recordings were chosen, for the archive; None if they were not.
        pair: how the recordings, the two components of one, were scaled together; None if they are not such.
    """
    fitted = [motion.match for motion in motions if motion.match is not None]
    group = Group(attributes={"order": order, "name": name, "suite": True, "records": len(motions)})
    group.attributes["warnings"] = list(warnings)
    if choice is not None:
        group.attributes["choice"] = dict(choice)
    group.attributes["origins"] = dict(Counter(motion.found.origin for motion in motions))
    if target is not None and fitted:
        periods = fitted[0].periods
        group.coords["period"] = Variable(("period",), periods, "s", "period of the oscillator")
        before = np.mean([match.psa_before for match in fitted], axis=0)
        after = np.mean([match.psa_after for match in fitted], axis=0)
        for key, values, label in (
            ("target", target.acceleration(periods), target.label),
            ("mean_psa_before", before, "pseudo-acceleration, mean of the scaled originals"),
            ("mean_psa_after", after, "pseudo-acceleration, mean of the matched records"),
        ):
            group.add(key, ("period",), values, "m/s^2", label)
        group.attributes |= {"target": target.label, "fitted": len(fitted), "suite_factor": fitted[0].suite_factor}
        if verdicts:
            group.attributes["criteria"] = [asdict(verdict) for verdict in verdicts]
            rules = target.set_rules
            group.attributes["criteria_of"] = rules.code
            # those that one factor on all records can satisfy
            group.attributes["criteria_of_mean"] = [rules.clauses.zero_period, rules.clauses.mean]
    if pair is not None:
        label = f"{NAMES[pair.spectrum]} of the scaled components"
        group.add("combined_psa", ("period",), pair.combined, "m/s^2", f"pseudo-acceleration, {label}")
        group.attributes["pair"] = {
            "spectrum": pair.spectrum,
            "factor": pair.factor,
            "best_factor": pair.best,
            "misfit": asdict(pair.misfit),
        }
    yield f"{RECORDS}/{name}", group
    for place, motion in enumerate(motions):
        yield f"{RECORDS}/{name}/{motion.name.rpartition('/')[2]}", record_group(motion, place)


def record_group(motion: Motion, order: int, warnings: Sequence[str] = ()) -> Group:
    """Return the archived group of a recording: samples, spectrum, measures, origin, and its fit if it has one.

    Args:
        order: its place among those of its suite.
        warnings: what the user should know, beside the warnings about the record itself.
    """
    found, record = motion.found, motion.found.record
    group = Group(
        attributes={
            "order": order,
            "name": motion.name,
            "origin": found.origin,
            "detail": found.detail,
            "tried": list(found.tried),
            "source": record.source,
            "checksum": record.checksum,
            "doubts": list(record_warnings(record)),  # `warnings` are those about its use
            "warnings": list(warnings),
            "status": "failed" if motion.failure else "completed",
            "reason": motion.failure,
            "recorded": asdict(measures(record)),
        }
    )
    if found.entry is not None:
        group.attributes |= {
            key: value for key, value in found.entry.model_dump(include=SEISMOLOGY).items() if value is not None
        }
    _samples(group, "time", "acceleration", record.time, record.acceleration, "as recorded")
    if motion.match is None:
        group.coords["period"] = Variable(("period",), PERIODS, "s", "period of the oscillator")
        ordinates = psa(record.acceleration, record.time_step, PERIODS, DAMPING)
        group.add("psa", ("period",), ordinates, "m/s^2", "pseudo-acceleration, as recorded")
        group.attributes["damping"] = DAMPING
    else:
        _add_match(group, motion.match)
    return group


def _add_match(group: Group, match: Match) -> None:
    group.attributes |= {
        "match_method": match.method,
        "match_scale": match.scale,
        "suite_factor": match.suite_factor,
        "match_iterations": match.iterations,
        "match_history": list(match.history),
        "match_notes": list(match.notes),
        "misfit_before": asdict(match.misfit_before),
        "misfit_after": asdict(match.misfit_after),
        "before": asdict(match.before),
        "after": asdict(match.after),
        "shape": asdict(match.shape),
        "zero_period": match.zero_period,
        "damping": match.damping,
    }
    matched = match.matched
    time = matched.time - match.lead  # that of the original
    _samples(group, "matched_time", "matched_acceleration", time, matched.acceleration, "matched")
    group.coords["period"] = Variable(("period",), match.periods, "s", "period of the oscillator")
    for name, values, label in (
        ("target", match.target, "target spectrum"),
        ("psa_before", match.psa_before, "pseudo-acceleration, as recorded times the constant factor"),
        ("psa_after", match.psa_after, "pseudo-acceleration, matched"),
    ):
        group.add(name, ("period",), values, "m/s^2", label)


def _samples(group: Group, axis: str, name: str, time: np.ndarray, values: np.ndarray, what: str) -> None:
    group.coords[axis] = Variable((axis,), time, "s", f"time, {what}")
    group.add(name, (axis,), values, "m/s^2", f"ground acceleration, {what}")
