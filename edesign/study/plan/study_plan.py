"""The plan of a study: every variant x level x record x temperature, and variant x record x intensity."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from edesign.errors import InputError
from edesign.project.analysis.analyses import (
    BuildingHistory,
    BuildingPushover,
    GravityAnalysis,
    HistoryAnalysis,
    ModalAnalysis,
    PushoverAnalysis,
)
from edesign.project.analysis.pushover import Pushover, Pushovers
from edesign.project.analysis.shaking import Eccentric, Shaking
from edesign.project.reading.problems import keys_text
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import record_of
from edesign.project.study.incremental import Incremental, LevelFactorStudy
from edesign.project.study.study import Histories, Study
from edesign.study.analysis.intensity import intensity_text
from edesign.study.plan.plan import Stripe, Task, pushover_parts, recordings_of, selected, shakings
from edesign.study.plan.variants import variant_strain

MODES, GRAVITY = "modes", "gravity"
USUAL_MODES = 3


def make_study_plan(study: Study, only: Sequence[str] = ()) -> tuple[Task, ...]:
    """List the analyses of a study: modes and gravity of each variant, pushovers, histories, incremental studies.

    Args:
        only: names to which the plan is restricted: analyses, or VARIANT.LEVEL or VARIANT.STUDY for all their
            histories, VARIANT.PUSHOVER for all its parts; all if empty.

    Raises:
        InputError: a name in `only` or a recording does not exist, or two histories are the same.
    """
    tasks: list[Task] = []
    for name in study.variants:
        tasks += _of_variant(study, name)
    names = {task.name for task in tasks}
    blocks = [(("pushovers", i), _of_pushovers(study, item)) for i, item in enumerate(study.pushovers)]
    blocks += [(("histories", i), _of_histories(study, i, item)) for i, item in enumerate(study.histories)]
    blocks += [(("incremental", i), _of_incremental(study, i, item)) for i, item in enumerate(study.incremental)]
    for keys, block in blocks:
        for task in block:
            if task.name in names:
                raise InputError(
                    f"{study.where(*keys)}: {keys_text(keys)}: there is an analysis `{task.name}` already; "
                    "leave one of them out [E-NAME-02]"
                )
            names.add(task.name)
            tasks.append(task)
    return selected([replace(task, order=i) for i, task in enumerate(tasks)], only, study.path)


def _of_variant(study: Study, name: str) -> Iterator[Task]:
    variant, modal = study.variants[name], study.modal
    dampers = variant.dampers != "none"
    if study.base.masses is not None:
        spec = ModalAnalysis.model_construct(
            kind="modal",
            name=f"{name}.{MODES}",
            variant=name,
            dampers=dampers,
            modes=modal.modes if modal.modes is not None else USUAL_MODES,
            state=modal.state,
            damper_strain=variant_strain(study, name),
        )
        yield Task(0, spec, spec.name, name)
    gravity = GravityAnalysis.model_construct(kind="gravity", name=f"{name}.{GRAVITY}", variant=name, dampers=dampers)
    yield Task(0, gravity, gravity.name, name)


def _of_pushovers(study: Study, pushovers: Pushovers) -> Iterator[Task]:
    kind: type[PushoverAnalysis] = BuildingPushover if study.base.structure == "building" else PushoverAnalysis
    own = (*Pushover.model_fields, *(Eccentric.model_fields if kind is BuildingPushover else ()))
    values = {key: getattr(pushovers, key) for key in own}
    for variant in study.variants_of(pushovers):
        entry, dampers = f"{variant}.{pushovers.name}", study.variants[variant].dampers != "none"
        spec = kind.model_construct(kind="pushover", name=entry, variant=variant, dampers=dampers, **values)
        for part in pushover_parts(spec, tuple(study.base.hazard_levels)):
            yield Task(0, part, entry, variant)


def _of_histories(study: Study, index: int, histories: Histories) -> Iterator[Task]:
    wanted = recordings(study, histories.records, ("histories", index, "records"))
    details = study.outputs.details
    whole = recordings(study, details.records, ("outputs", "details", "records")) if details is not None else ()
    for variant in study.variants_of(histories):
        for temperature_C in histories.temperatures or (None,):
            for level in histories.levels or ("",):
                warm = [f"{temperature_C:g}C"] if temperature_C is not None else []
                entry = ".".join([variant, *warm, *([level] if level else [])])
                for reference in wanted:
                    name = f"{entry}.{reference.rpartition('/')[2]}"
                    spec = _history(study, histories, name, variant, reference, level)
                    for one in shakings(spec, beside=True):
                        yield Task(0, one, entry, variant, temperature_C, reference in whole)


def _of_incremental(study: Study, index: int, incremental: Incremental) -> Iterator[Task]:
    wanted = recordings(study, incremental.records, ("incremental", index, "records"))
    for variant in study.variants_of(incremental):
        entry = f"{variant}.{incremental.name}"
        level = incremental.level if isinstance(incremental, LevelFactorStudy) else ""
        for reference in wanted:
            chain = f"{entry}.{reference.rpartition('/')[2]}"
            for step, intensity in enumerate(incremental.intensities):
                name = f"{chain}.{intensity_text(incremental, intensity)}"
                for one in shakings(_history(study, incremental, name, variant, reference, level)):
                    stripe = Stripe(incremental.name, intensity, step, chain + one.name.removeprefix(name))
                    yield Task(0, one, entry, variant, stripe=stripe)


def _history(
    study: Study, asked: Histories | Incremental, name: str, variant: str, reference: str, level: str
) -> HistoryAnalysis:
    of_building: dict[str, Any] = {}
    if study.base.structure == "building":
        of_building = {key: getattr(asked, key) for key in Shaking.model_fields}
    kind = BuildingHistory if study.base.structure == "building" else HistoryAnalysis
    return kind.model_construct(
        **of_building,
        kind="history",
        name=name,
        variant=variant,
        dampers=study.variants[variant].dampers != "none",
        record=reference,
        free_vibration=asked.free_vibration,
        wave_passage=asked.wave_passage,
        collapse_drift=asked.collapse_drift,
        level=level,
        vertical=asked.vertical if isinstance(asked, Histories) else None,
    )


def recordings(study: Study, names: Sequence[str], keys: tuple[str | int, ...]) -> tuple[str, ...]:
    """Return the references of recordings: a record itself, all of a suite, or one of a suite as SUITE/ID.

    Args:
        names: of records, suites, or recordings of suites.
        keys: key path of the names in the study file, for messages.

    Raises:
        InputError: a suite has no such recording; the message names the place in the study file.
    """
    found: list[str] = []
    for i, name in enumerate(names):
        known = recordings_of(study.base, name, f"{study.where(*keys, i)}: {keys_text(keys)}")
        found += [reference for reference in known if reference not in found]
    return tuple(found)


def wanted_designs(study: Study, plan: Sequence[Task]) -> tuple[str, ...]:
    """Return the names of the designs that the variants of a plan have, in the order of the file.

    Args:
        plan: its analyses.
    """
    wanted = {name for task in plan for name in study.variants[task.variant].designs}
    return tuple(name for name in study.designs if name in wanted)


def verification_records(study: Study, name: str) -> tuple[str, ...]:
    """Return the references of the recordings that a design of a study is verified with."""
    verify = study.designs[name].verify
    return recordings(study, verify.records, ("designs", name, "verify", "records")) if verify is not None else ()


def verifying_histories(study: Study, name: str, number: int) -> Iterator[HistoryAnalysis]:
    """Yield the histories of a round of a design's verification, or of a layout: its recordings at all its levels.

    A record that is fitted to the spectrum of one level, which has a shape of its own, is run at this level alone. To
    the levels comes the one whose forces braces of sections hold.

    Args:
        number: of the round or layout, from 1.
    """
    verify = study.designs[name].verify
    if verify is None:
        return
    of_building = study.base.structure == "building"
    kind = BuildingHistory if of_building else HistoryAnalysis
    shaken = {key: getattr(verify, key) for key in ("angles", "eccentricity", "eccentricity_ratio") if of_building}
    along = getattr(study.designs[name], "along", None)
    held = getattr(study.designs[name], "brace_level", None)
    for level in dict.fromkeys((*(verify.levels or ("",)), *filter(None, (held,)))):
        for reference in verification_records(study, name):
            if study.base.fitted_level(record_of(reference)) not in (None, level):
                continue
            if along == "y" and "angles" not in verify.model_fields_set:  # a single record acts along the design
                pair = isinstance(study.base.records[record_of(reference)], InSpace)
                shaken["angles"] = (0.0,) if pair else (0.5 * math.pi,)
            spec = kind.model_construct(
                **shaken,
                kind="history",
                name=".".join([name, str(number), *([level] if level else []), reference]),
                variant=name,
                record=reference,
                level=level,
                free_vibration=verify.free_vibration,
            )
            yield from shakings(spec)


def histories_of_a_round(study: Study, name: str) -> int:
    """Return the number of histories in one round of a design's verification."""
    return sum(1 for _ in verifying_histories(study, name, 1))
