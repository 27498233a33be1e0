"""Cross checks of pushovers: patterns that fit the frame, and what target displacements need."""

from __future__ import annotations

from edesign.project.actions.hazard import EC8Hazard, UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis.pushover import METHODS, GivenPattern, Pushover, pattern_name
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.names import check_names
from edesign.project.reading.problems import Keys, Problems, listed

OF_TARGETS = ("levels", "damping", "site_class")


def check_pushover(project: AnalysisFile, problems: Problems, keys: Keys, pushover: Pushover) -> None:
    """Check pushovers against their project, but for their drift; they have no schema problems.

    Args:
        project: of the frame and the hazard.
        keys: where they stand.
        pushover: an analysis of a project, or an item of a study.
    """
    names = [pattern_name(pattern) for pattern in pushover.pattern]
    for i, pattern in enumerate(pushover.pattern):
        if names[i] in names[:i]:
            problems.at_item(
                (*keys, "pattern"), i, f"`{names[i]}` comes twice; give it in an analysis of its own [E-NAME-02]"
            )
        elif isinstance(pattern, GivenPattern):
            _given(project, problems, (*keys, "pattern"), i, pattern, bool(pushover.targets))
    for i, method in enumerate(pushover.targets):
        if method in pushover.targets[:i]:
            problems.at_item((*keys, "targets"), i, f"`{method}` comes twice [E-NAME-02]")
    if not pushover.targets:
        if pushover.roof_drift is None:
            problems.under(
                keys, "roof_drift", f"this key is missing; or give `targets` ({listed(METHODS)}) to reach [E-KEY-02]"
            )
        for key in OF_TARGETS:
            if getattr(pushover, key) is not None:
                problems.at_key(
                    (*keys, key), f"this is of target displacements; give `targets` ({listed(METHODS)}) [E-PUSH-03]"
                )
        return
    if not project.hazard_levels:
        message = "target displacements need `hazard` with `levels`, and the file has none [E-HAZ-05]"
        problems.at_key((*keys, "targets"), message)
    elif pushover.levels is not None:
        check_names(problems, (*keys, "levels"), "level", pushover.levels, project.hazard_levels)
    if project.hazard is not None:
        _other_codes(project.hazard, problems, keys, pushover)
    if pushover.site_class is not None and "asce41" not in pushover.targets:
        problems.at_key(
            (*keys, "site_class"), "this is of the method `asce41`, which is not among the `targets` [E-PUSH-03]"
        )


def _other_codes(hazard: Hazard, problems: Problems, keys: Keys, pushover: Pushover) -> None:
    """What target displacements need of a spectrum, and EN 1998-1 has."""
    for i, method in enumerate(pushover.targets):
        if method != "asce41" and isinstance(hazard, UserHazard):
            wanted = hazard.levels if pushover.levels is None else [n for n in pushover.levels if n in hazard.levels]
            without = [n for n in wanted if (table := hazard.table(n)) is not None and table.corner_period is None]
            if without:
                message = f"`{method}` needs the corner period T_C or T_S, and the table of {listed(without)} has none"
                problems.at_item(
                    (*keys, "targets"),
                    i,
                    f"{message}; give `corner_period` with it, or take `asce41`, which needs none [E-HAZ-02]",
                )
    if "asce41" in pushover.targets and pushover.site_class is None and not isinstance(hazard, EC8Hazard):
        message = (
            f"this key is missing; only a ground type of EN 1998-1 has one, and the hazard is of `{hazard.code}`"
            " [E-KEY-02]"
        )
        problems.under(keys, "site_class", message)
    other_damping = isinstance(hazard, UserHazard) and hazard.damping_correction is None
    if other_damping and pushover.damping not in (None, hazard.damping):
        message = (
            f"the spectra of the hazard are tables for {100 * hazard.damping:g} % damping; leave this key out, or give "
            "`hazard.damping_correction` [E-KEY-03]"
        )
        problems.at_value((*keys, "damping"), message)


def _given(project: AnalysisFile, problems: Problems, keys: Keys, i: int, pattern: GivenPattern, targets: bool) -> None:
    if len(pattern.given) != 1:
        seen = f", not {listed(pattern.given)}" if pattern.given else ""
        message = f"a pattern has one of the keys {listed(GivenPattern.model_fields)}{seen} [E-VALUE-01]"
        problems.at_item(keys, i, message)
        return
    if pattern.floors is not None:
        storeys = project.grid.n_storeys
        if len(pattern.floors) != storeys:
            problems.at_item(
                keys, i, f"{len(pattern.floors)} shares for {storeys} floors; give one for each [E-VALUE-04]"
            )
        elif not any(pattern.floors):
            problems.at_item(keys, i, "all shares are zero [E-VALUE-04]")
        elif targets and not pattern.floors[-1]:
            problems.at_item(keys, i, "target displacements are of the roof, which has no share here [E-PUSH-03]")
    if pattern.modes is not None and project.hazard is None:
        problems.at_item(
            keys, i, "storey shears of modes need the spectrum of a `hazard`, and the file has none [E-HAZ-05]"
        )
    if pattern.modes is not None and project.hazard is not None:
        if project.hazard.own_shapes and len(project.hazard.levels) > 1:
            message = (
                "storey shears of modes need one shape of spectrum, and each level of the hazard has its own [E-HAZ-04]"
            )
            problems.at_item(keys, i, message)
    if pattern.mode is not None and targets and project.structure == "building":
        message = (
            "target displacements are of the mode that leads in the direction of the push; give `first_mode` for it, "
            f"or mode {pattern.mode} without `targets` [E-PUSH-03]"
        )
        problems.at_item(keys, i, message)
    elif pattern.mode is not None and pattern.mode > 1 and targets:
        message = f"target displacements are of the first mode; give mode {pattern.mode} without `targets` [E-PUSH-03]"
        problems.at_item(keys, i, message)
