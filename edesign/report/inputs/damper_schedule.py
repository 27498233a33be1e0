"""The schedule of the dampers: where they stand, their law, size and number, and what each must be able to do."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.codes.rule_check import with_standard
from edesign.damper.laws import LAWS
from edesign.damper.parameters import DASHPOTS, coefficient_in_words
from edesign.frame.devices import Device, DeviceSize
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import AnyChosenBrace, BraceSection
from edesign.project.study.study import Study, own_variant
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.inputs.damper_demand import Alike, Demand, alike_devices, demands_of, factored_ratio, factors_on
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import MORE, Row, Table, TableSpec
from edesign.report.tables.unit import KN, KN_MM, M_S, MM, MM2, ONE, PERCENT
from edesign.study.plan.device_factors import factors_in_force, factors_note

QUANTITIES = (  # header, how it is called below, name, unit
    ("F", "force", "damper_force", KN),
    ("stroke", "stroke", "damper_deformation", MM),
    ("strain", "strain", "damper_strain", PERCENT),
    ("v", "velocity", "velocity", M_S),
)

SCHEDULE = TableSpec[Row](
    "damper_schedule",
    "Dampers{of}",
    (
        text("storey"),
        text("place"),
        text("stands as"),
        text("law"),
        count("places"),
        count("number"),
        text("size of one", broken=1),
        text("brace", broken=2),
    ),
    keys=4,
)
REQUIRED = TableSpec[Row](
    "damper_demand",
    "Required of one damper{of}",
    (text("storey"), text("place"), text("law"), text("level"), MORE, col("histories", ONE), text("governs")),
    keys=4,
)
FACTORED = TableSpec[Row](
    "damper_demand_factored",
    "Required with factors{of}",
    (
        text("storey"),
        text("place"),
        text("law"),
        text("level"),
        col("F", KN),
        col("F factored", KN),
        col("stroke", MM, negligible=ROUNDING),
        col("stroke factored", MM, negligible=ROUNDING),
        col("strain factored", PERCENT, optional=True),
        col("v", M_S, optional=True),
        col("v factored", M_S, optional=True),
    ),
    keys=4,
)


def schedule_tables(
    frames: VariantFrames, study: Study | None, sets: Sequence[HistorySet], whole: Callable[[str], Group]
) -> list[Table]:
    """Return the dampers of each variant with their properties, and the demand on one of them in histories.

    Bounds of a variant, and other temperatures, ask of its own dampers; variants that `vary` makes are left out.

    Args:
        study: it is of; None: a project.
        whole: reads the results of an analysis with what was kept over time.

    Raises:
        InputError: a frame cannot be built.
    """
    derived = study.derived if study is not None else {}
    tables = []
    for variant in frames.variants:
        if variant in derived:
            continue
        alike = alike_devices(frames.frame(variant).devices)
        if alike:
            tables.append(_schedule(variant, alike, frames.project(variant)))
            found = _found(alike, asking(variant, study, sets), frames, whole)
            tables.append(_required(variant, alike, found, frames))
            tables.append(_factored(variant, alike, found.demands, frames, study))
    return [table for table in tables if table.rows]


def asking(variant: str, study: Study | None, sets: Sequence[HistorySet]) -> list[tuple[str, HistorySet]]:
    """Return the histories that ask of the dampers of a variant, and how they are called: level, bound, temperature.

    Args:
        study: it is of; None: a project.
    """
    found = []
    for one in sets:
        own = own_variant(one.variant) if study is not None else ""
        source = study.derived.get(own) if study is not None else None
        if (source.of if source is not None else own) != variant or (source is not None and source.vary):
            continue
        bound = f"{source.bound} bound" if source is not None and source.bound else ""
        warm = one.variant.removeprefix(own).strip() if study is not None else one.variant
        found.append((", ".join(part for part in (one.level, bound, warm) if part) or "all", one))
    return found


def _schedule(variant: str, alike: Sequence[Alike], project: AnalysisFile) -> Table:
    rows: list[Row] = []
    for group in alike:
        one, places = group.devices[0], len(group.devices)
        rows.append((*group.at, group.stands, group.law, places, places * one.size.number, _size(one), _brace(one)))
    places = sum(len(group.devices) for group in alike)
    number = sum(len(group.devices) * group.devices[0].size.number for group in alike)
    notes = []
    if project.dampers is not None and any(
        isinstance(d.brace, (BraceSection, AnyChosenBrace)) for d in project.dampers.devices
    ):
        notes.append("The stiffness of a brace follows from its section and length.")
    total = ("total", "", "", "", places, number, "", "")
    return SCHEDULE.of([*rows, total], notes=notes, of=f", {variant}" if variant else "", owner=variant)


def _size(device: Device) -> str:
    size, law = device.size, device.values
    if device.restrained is not None:
        brace = device.restrained
        return f"core of {significant(brace.area / size.number / MM2.si)} mm2"
    if device.layer_thickness is not None:
        return _layers(device.size, device.layer_thickness)
    if law.law in DASHPOTS and not law.effects:
        c, alpha = (*law.values, 1.0)[:2]
        return f"c = {coefficient_in_words(c * size.scale, alpha)}"
    if law.law == "friction_pendulum":  # scaled to the weight that it stands under
        return f"weight {significant(device.force_scale / size.number * law.values[0] / KN.si)} kN"
    return "as the law" if size.scale == 1.0 else f"{significant(size.scale)} times the law"


def _layers(size: DeviceSize, thickness: float) -> str:
    parts = []
    if size.layers is not None:
        parts.append(f"{size.layers} layers")
    if size.layer_area is not None:
        parts.append(f"{significant(size.layer_area)} m2 each")
    parts.append(f"{significant(thickness / MM.si)} mm thick")
    return ", ".join(parts) if size.resized else f"the law's own, {parts[-1]}"


def _brace(device: Device) -> str:
    if device.restrained is not None:
        return "itself"
    if not device.brace:
        return "rigid"
    stiffness = f"{significant(device.brace / KN_MM.si)} kN/mm"
    play = f", play {significant(device.play / MM.si)} mm" if device.play else ""
    return f"{device.brace_bar.section}, {stiffness}{play}" if device.brace_bar is not None else stiffness + play


@dataclass(frozen=True)
class _Found:
    """What histories ask of the dampers of a variant.

    Attributes:
        asking: the histories of each level.
        demands: by number of the dampers that are alike, and level.
    """

    asking: Sequence[tuple[str, HistorySet]]
    demands: dict[tuple[int, str], dict[str, Demand | None]]


def _found(
    alike: Sequence[Alike],
    asking: Sequence[tuple[str, HistorySet]],
    frames: VariantFrames,
    whole: Callable[[str], Group],
) -> _Found:
    demands = {
        (at, label): demands_of(group.devices, histories, frames, whole)
        for at, group in enumerate(alike)
        for label, histories in asking
        if histories.completed
    }
    return _Found(asking, demands)


def _factored(
    variant: str,
    alike: Sequence[Alike],
    found: dict[tuple[int, str], dict[str, Demand | None]],
    frames: VariantFrames,
    study: Study | None,
) -> Table:
    """The governing values of histories, bare and with the factors of the code; none where all factors are 1."""
    factors, rules = factors_in_force(study, frames.hazard), rules_in_force(frames.hazard)
    rows: list[Row] = []
    for (at, label), demands in found.items():
        group, one = alike[at], alike[at].devices[0]
        on_stroke, on_velocity = factors_on(one, factors)
        if (on_stroke, on_velocity) == (1.0, 1.0) or not any(demands.values()):
            continue
        force, stroke, strain, speed = (_governs(demands.get(name), rules) for _, _, name, _ in QUANTITIES)
        period = frames.first_period(variant, one)
        of = (demands.get("damper_deformation"), demands.get("velocity"), factors, rules, period)
        ratio = factored_ratio(one, *of)
        rows.append(
            (
                *group.at,
                group.law,
                label,
                force,
                None if math.isnan(ratio) else _times(force, ratio),
                stroke,
                _times(stroke, on_stroke),
                _times(strain, on_stroke),
                speed,
                _times(speed, on_velocity),
            )
        )
    if not rows:
        return Table("")
    notes = [
        factors_note(factors, study is not None and study.device_factors is not None),
        f"Of at least {rules.number_for_mean} motions the mean counts, else the largest.",
        "F is of one damper, factored by its law at the factored stroke and velocity.",
        "For this, a velocity that was not kept is the pseudo velocity of the first mode.",
    ]
    return FACTORED.of(
        sorted(rows, key=lambda row: str(row[0])), notes=notes, of=f", {variant}" if variant else "", owner=variant
    )


def _governs(found: Demand | None, rules: SetRules) -> float | None:
    return None if found is None else found.governing(rules)


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None else factor * value


def _required(variant: str, alike: Sequence[Alike], asked: _Found, frames: VariantFrames) -> Table:
    """What is required of one damper: mean and maximum of each level, and the level that governs."""
    asking, found = asked.asking, asked.demands
    rules = rules_in_force(frames.hazard)
    shown = [q for q in QUANTITIES if any(one.get(q[2]) is not None for one in found.values())]
    asks = {label for (_, label), one in found.items() if any(value is not None for value in one.values())}
    counts = {label: histories for label, histories in asking if label in asks}  # others are without these dampers
    single = all(len(histories.completed) == 1 for histories in counts.values())
    spread = ("",) if single else (" mean", " max")
    columns: list[Column[Row]] = [
        col(f"{short}{which}", unit, negligible=ROUNDING) for short, *_, unit in shown for which in spread
    ]
    rows: list[Row] = []
    for at, group in enumerate(alike):
        governing = {name: _most(found, at, list(counts), name, rules) for _, _, name, _ in shown}
        for label, histories in counts.items():
            cells = [cell for _, _, name, _ in shown for cell in _pair(found[at, label].get(name))[-len(spread) :]]
            of = f"{len(histories.completed)}/{len(histories.histories)}"
            governs = [word for _, word, name, _ in shown if governing[name] == label]
            rows.append((*group.at, group.law, label, *cells, of, ", ".join(governs)))
    notes = [*_notes(single, len(counts) > 1, rules), *_velocity_notes(found, alike)] if rows else []
    without = ("governs",) if len(counts) < 2 else ()
    return REQUIRED.of(
        rows, more=columns, without=without, notes=notes, of=f", {variant}" if variant else "", owner=variant
    )


def _notes(single: bool, levels: bool, rules: SetRules) -> list[str]:
    notes = ["The force is that of one damper; the stroke is to either side and without the brace."]
    if single:
        notes.append("The values are the largest over the time of one history, in the place that has most.")
    else:
        notes.append("Of the largest values of each motion: mean and maximum over them, in the place that has most.")
    if levels:
        clause = with_standard(rules.clauses.use)
        which = f"the mean of at least {rules.number_for_mean} motions, else the maximum ({clause})"
        notes.append(f"The level governs whose value is largest: {which}.")
    return notes


def _most(
    found: dict[tuple[int, str], dict[str, Demand | None]], at: int, levels: Sequence[str], name: str, rules: SetRules
) -> str:
    values = {label: one.governing(rules) for label in levels if (one := found[at, label].get(name)) is not None}
    return max(values, key=lambda label: values[label]) if any(values.values()) else ""


def _pair(found: Demand | None) -> tuple[float | None, float | None]:
    return (None, None) if found is None else (found.mean, found.maximum)


def _velocity_notes(found: dict[tuple[int, str], dict[str, Demand | None]], alike: Sequence[Alike]) -> list[str]:
    known = [one["velocity"] is not None for one in found.values()]
    if all(known):
        return ["The velocity v is that of the damper without its brace."]
    laws = {LAWS[device.values.law] for group in alike for device in group.devices}
    if not any(known) and not any(law.rate_dependent for law in laws):
        return []  # none asks for it
    kept = "`dampers` among the kept histories"
    if not any(known):
        return [f"The archive has no velocities of the dampers; they are found with {kept}."]
    return [f"The velocity v is known of dashpots, and of other dampers that were kept over time ({kept})."]
