"""The forces of dampers on the gussets and connections that hold them: along damper or brace, across and upwards."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import worst_of_each
from edesign.assess.sets import HistorySet
from edesign.codes.device_factors import DeviceFactors
from edesign.codes.motion_sets import SetRules
from edesign.codes.rule_check import with_standard
from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.notation.names import damper_place
from edesign.project.study.study import Study
from edesign.report.inputs.damper_demand import alike_devices, demands_of, factored_ratio
from edesign.report.inputs.damper_schedule import asking
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, ONE
from edesign.study.plan.device_factors import factors_in_force, factors_note

_ENDS = ("max", "min")


@dataclass(frozen=True)
class Connection:
    """A connection of a damper, or of one of its braces, and the force on it of a damper that pulls with 1.

    Attributes:
        part: what is connected: `lower gusset`, `apex`, `beam above`.
        at: node, or the beam or floors of the storey.
        force: on the structure, by coordinate, the last one upwards.
        pulled: 1: the damper or brace there is in tension when the damper is; -1: in compression.
    """

    part: str
    at: str
    force: tuple[float, ...]
    pulled: float = 1.0

    @property
    def size(self) -> float:
        """Force along the damper or brace over that of the damper."""
        return math.hypot(*self.force)

    @property
    def horizontal(self) -> float:
        """Size of the horizontal component."""
        return math.hypot(*self.force[:-1])

    @property
    def vertical(self) -> float:
        """Size of the vertical component."""
        return abs(self.force[-1])


@dataclass(frozen=True)
class _Demand:
    """The forces of histories on a connection of a damper.

    Attributes:
        tension, compression: of the damper or brace at the connection, N.
        force: of the damper or brace, the largest of the dampers of the storey that are alike, N.
        factor: of the code, on it; nan: not known.
        adjusted: strengths of a buckling-restrained brace there in tension and compression, N; of others none.
    """

    storey: int
    kind: str
    bay: str
    connection: Connection
    label: str
    tension: float
    compression: float
    force: float
    factor: float
    adjusted: tuple[float, float] | None = None

    @property
    def place(self) -> str:
        """The kind of the damper and its bay."""
        return f"{self.kind}, {self.bay}"

    @property
    def largest(self) -> float:
        """The force that the connection holds, N.

        Source: of buckling-restrained braces at least their adjusted strengths, AISC 341-16, F4.6.
        """
        return float(np.fmax(self.factor * self.force, max(self.adjusted or (math.nan,))))

    @property
    def rank(self) -> tuple[float, float]:
        """What the connection that governs has most of: the force that it holds, then that of the histories."""
        return (0.0 if math.isnan(self.largest) else self.largest), max(self.tension, self.compression)

    def component(self, size: float) -> float:
        """Return a component of the larger force with its factor, N.

        Args:
            size: of the component of a damper that pulls with 1.
        """
        return self.largest * size / self.connection.size


CONNECTIONS = TableSpec[_Demand](
    "connection_forces",
    "Connections of the dampers{of}{governing}",
    (
        text("storey", lambda one: str(one.storey or "-")),
        text("damper", "place", broken=1),
        text("connection", "connection.part"),
        text("at", "connection.at"),
        text("level", "label"),
        col("T", KN, "tension"),
        col("C", KN, "compression"),
        col("factor", ONE, "factor", 3),
        col("T_adj", KN, lambda one: one.adjusted and one.adjusted[0], optional=True),
        col("C_adj", KN, lambda one: one.adjusted and one.adjusted[1], optional=True),
        col("N", KN, "largest"),
        col("H", KN, lambda one: one.component(one.connection.horizontal)),
        col("V", KN, lambda one: one.component(one.connection.vertical)),
    ),
    keys=5,
    formulas=True,
)


GOVERNING = TableSpec[_Demand](
    "governing_connection_forces", CONNECTIONS.title, CONNECTIONS.columns, keys=CONNECTIONS.keys, formulas=True
)


def connections_of(frame: FrameModel, device: Device) -> tuple[Connection, ...]:
    """Return the connections of a damper with the forces on them of a damper that pulls with 1.

    A chevron's braces carry the damper's force to the lower corners of the bay, one of them in tension: half of it
    across, and a couple upwards. The damper pushes the beam above.

    Args:
        frame: that it stands in.
    """
    named = {number: name for name, number in frame.nodes.items()}
    forces: dict[str, list[float]] = {}
    for coefficient, node, degree in device.terms:
        forces.setdefault(named[node], [0.0] * (frame.up + 1))[degree] -= coefficient
    levels = {name: frame.places[name][-1] for name in forces}
    low = min(levels.values())
    if device.stands == "chevron":
        return tuple(_chevron(frame, device, forces, levels, low))
    if device.stands == "storey":
        return tuple(_between_floors(forces, levels, low, device.storey))
    found = []
    for name, force in forces.items():
        where = "lower gusset" if levels[name] == low else "upper gusset"
        if max(levels.values()) == low:
            where = "gusset"
        found.append(Connection(where, name, tuple(force)))
    return tuple(found)


def _chevron(
    frame: FrameModel, device: Device, forces: dict[str, list[float]], levels: dict[str, float], low: float
) -> Iterator[Connection]:
    feet = [name for name in forces if levels[name] == low]
    above = np.sum([forces[name] for name in forces if name not in feet], axis=0)
    middle = np.mean([frame.places[name] for name in feet], axis=0)
    for name in feet:
        # towards the apex, which lies above the middle, a brace pulls its foot
        outwards = float(np.dot(middle[:-1] - np.array(frame.places[name])[:-1], forces[name][:-1]))
        yield Connection("lower gusset", name, tuple(forces[name]), math.copysign(1.0, outwards))
    storey = f"storey {device.storey}"
    yield Connection("apex, to the damper", storey, tuple(-above))
    yield Connection("beam above", storey, tuple(above.tolist()))


def _between_floors(
    forces: dict[str, list[float]], levels: dict[str, float], low: float, storey: int
) -> Iterator[Connection]:
    for part, of, floor in (("floor below", True, storey - 1), ("floor above", False, storey)):
        total = np.sum([force for name, force in forces.items() if (levels[name] == low) == of], axis=0)
        yield Connection(part, f"floor {floor}", tuple(total.tolist()))


def connection_tables(
    frames: VariantFrames,
    study: Study | None,
    sets: Sequence[HistorySet],
    whole: Callable[[str], Group],
    governing: bool = False,
) -> list[Table]:
    """Return the forces on each connection of the dampers of each variant, at each level.

    Bounds of a variant, and other temperatures, ask of its own dampers; variants that `vary` makes are left out.

    Args:
        study: it is of; None: a project.
        whole: reads the results of an analysis with what was kept over time.
        governing: whether a storey has one row for each part of its connections: the place and the level whose force
            is largest.

    Raises:
        InputError: a frame cannot be built.
    """
    factors, rules = factors_in_force(study, frames.hazard), rules_in_force(frames.hazard)
    derived = study.derived if study is not None else {}
    tables = []
    for variant in frames.variants:
        if variant in derived:
            continue
        frame = frames.frame(variant)
        rows: list[_Demand] = []
        asked = [(label, one) for label, one in asking(variant, study, sets) if one.completed]
        for alike in alike_devices([device for device in frame.devices if device.stands]):
            for label, one in asked:
                rows += _demands(frames, variant, alike.devices, label, one, factors, whole)
        rows = sorted(_governing(rows) if governing else rows, key=lambda one: one.storey)
        named = study is not None and study.device_factors is not None
        notes = _notes(rows, rules, factors, named, governing)
        of = f", {variant}" if variant else ""
        largest = ", largest of each storey" if governing else ""
        spec = GOVERNING if governing else CONNECTIONS
        tables.append(spec.of(rows, notes=notes if rows else [], of=of, governing=largest, owner=variant))
    return [table for table in tables if table.rows]


def _demands(
    frames: VariantFrames,
    variant: str,
    alike: Sequence[Device],
    label: str,
    found: HistorySet,
    factors: DeviceFactors,
    whole: Callable[[str], Group],
) -> Iterator[_Demand]:
    rules, frame = rules_in_force(frames.hazard), frames.frame(variant)
    completed = found.completed
    if not all(_has(group, device) for group in completed.values() for device in alike):
        return
    first = alike[0]
    demands, period = demands_of(alike, found, frames, whole), frames.first_period(variant, first)
    stroke, speed = demands["damper_deformation"], demands["velocity"]
    factor = factors.overstrength * factored_ratio(first, stroke, speed, factors, rules, period)
    force = demands["damper_force"]
    assert force is not None, "histories with dampers have their forces"
    held = first.size.number * force.governing(rules)
    for device in alike:
        most, least = (np.array([_extreme(group, device, which) for group in completed.values()]) for which in _ENDS)
        pull, push = (_counted(worst_of_each(found, values), rules) for values in (most, -least))
        kind, place = damper_place(device.name)
        for connection in connections_of(frame, device):
            both = (pull, push) if connection.pulled > 0.0 else (push, pull)
            tension, compression = (max(value, 0.0) * connection.size for value in both)
            at = (device.storey, kind, place, connection, label)
            yield _Demand(*at, tension, compression, held * connection.size, factor, _adjusted(device))


def _adjusted(device: Device) -> tuple[float, float] | None:
    brace = device.restrained
    return None if brace is None else (brace.adjusted_tension, brace.adjusted_compression)


def _has(group: Group, device: Device) -> bool:
    return "damper_force_max" in group.variables and device.name in group.coords["damper"].values


def _extreme(group: Group, device: Device, which: str) -> float:
    number = [str(name) for name in group.coords["damper"].values].index(device.name)
    return float(group.variables[f"damper_force_{which}"].values[number])


def _counted(worst: np.ndarray, rules: SetRules) -> float:
    return float(worst.mean() if len(worst) >= rules.number_for_mean else worst.max())


def _governing(demands: Sequence[_Demand]) -> list[_Demand]:
    """Of each part in a storey, by kind of damper, the place and level with the largest force of the histories."""
    found: dict[tuple[int, str, str], _Demand] = {}
    for one in demands:
        key = (one.storey, one.kind, one.connection.part)
        before = found.get(key)
        if before is None or one.rank > before.rank:
            found[key] = one
    return list(found.values())


def _notes(rows: Sequence[_Demand], rules: SetRules, factors: DeviceFactors, asked: bool, governing: bool) -> list[str]:
    clause = f" ({with_standard(rules.clauses.use)})" if rules.clauses.use else ""
    notes = [
        "T, C: largest tension and compression of all dampers of the place, or of one of their braces, along it.",
        f"Of at least {rules.number_for_mean} motions the mean counts, else the largest{clause}.",
        "N: force required of one of the dampers of the storey that are alike, of each motion the largest, times their "
        "number at the place, the factor, and in a brace its share; H, V: its horizontal and vertical component.",
    ]
    if any(one.adjusted for one in rows):
        notes.append(
            "Connections of buckling-restrained braces hold T_adj and C_adj at least, omega R_y P_ysc and beta omega "
            "R_y P_ysc (AISC 341-16, F4.6): N is not below them."
        )
    told = factors_note(factors, asked) if factors.on_dampers else ""
    notes.append(told or "No factor is asked for: the study file has none in `device_factors`.")
    if told:
        notes.append(
            "The factor is overstrength times the ratio of forces by the law of the damper itself; a velocity that was "
            "not kept is the pseudo velocity of the first mode."
        )
    if governing:
        notes.append(
            "A row is the place and the level with the largest force of a part in a storey; all places and levels are "
            "folded in the page, in the appendix of the PDF, and in the workbook."
        )
    return notes
