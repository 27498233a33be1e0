"""The devices to order of a design: sizes and largest values of one damper, estimated and of the histories."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.assess.devices import DeviceDemand, device_demand
from edesign.assess.sets import HistorySet
from edesign.codes.device_factors import NONE, DeviceFactors
from edesign.codes.motion_sets import SetRules
from edesign.codes.rule_check import with_standard
from edesign.core import LawValues
from edesign.damper.factored import force_ratio
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.items import Place, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_MM, M_S, MM, MM2, ONE, PERCENT, Unit


class _Device(NamedTuple):
    """One damper of a storey, estimated or in the histories of a variant."""

    whose: str
    storey: Place
    factor: float
    """On its strength, of a variant."""
    largest: Mapping[str, tuple[float | None, float | None]]
    """Mean and largest of the histories, SI."""
    factored: Mapping[str, float]
    """The one that counts, with the factors of the code; none where all are 1."""


def _size(name: str) -> Callable[[_Device], float]:
    return lambda device: device.storey.known(f"device_{name}")


def _strength(name: str) -> Callable[[_Device], float]:
    """A size that depends on the bound of a variant, as those to order do not."""
    return lambda device: _size(name)(device) * device.factor


def _largest(header: str, unit: Unit, name: str) -> tuple[Column[_Device], Column[_Device]]:
    return (
        col(f"mean {header}", unit, lambda device: device.largest[name][0]),
        col(f"max {header}", unit, lambda device: device.largest[name][1]),
    )


def _ordered(header: str, unit: Unit, name: str) -> Column[_Device]:
    return col(f"{header} factored", unit, lambda device: device.factored.get(name), optional=True)


_TITLE = "Devices to order: largest values of one damper"
_FILE = "devices_to_order"
_NAMED: tuple[Column[_Device], ...] = (
    text("", "whose"),
    count("storey", lambda device: int(device.storey.name)),
    count("number", _size("count")),
)
VISCOUS_DEVICES = TableSpec[_Device](
    "viscous_devices_to_order",
    _TITLE,
    (
        *_NAMED,
        col("c", "coefficient", _size("coefficient")),
        col("alpha", ONE, lambda device: float(device.storey.group.attributes["alpha"]), form="g", as_shown=True),
        *_largest("force", KN, "force"),
        *_largest("stroke", MM, "stroke"),
        *_largest("velocity", M_S, "velocity"),
        _ordered("force", KN, "force"),
        _ordered("stroke", MM, "stroke"),
        _ordered("velocity", M_S, "velocity"),
    ),
    named_as=_FILE,
)
HYSTERETIC_DEVICES = TableSpec[_Device](
    "hysteretic_devices_to_order",
    _TITLE,
    (
        *_NAMED,
        col("F_y", KN, _size("yield_force")),
        col("k", KN_MM, _size("stiffness")),
        *_largest("force", KN, "force"),
        *_largest("stroke", MM, "stroke"),
        *_largest("plastic", MM, "cumulated_plastic"),
        _ordered("force", KN, "force"),
        _ordered("stroke", MM, "stroke"),
    ),
    named_as=_FILE,
)
RESTRAINED_DEVICES = TableSpec[_Device](
    "restrained_braces_to_order",
    _TITLE,
    (
        *_NAMED,
        col("A_sc", MM2, _size("core_area")),
        col("T_adj", KN, _strength("adjusted_tension")),
        col("C_adj", KN, _strength("adjusted_compression")),
        *_largest("force", KN, "force"),
        *_largest("strain", PERCENT, "core_strain"),
        *_largest("cum.", Unit("-"), "cumulative_ductility"),
        _ordered("force", KN, "force"),
        _ordered("strain", PERCENT, "core_strain"),
    ),
    named_as=_FILE,
)
_BY_KIND = {"viscous": VISCOUS_DEVICES, "hysteretic": HYSTERETIC_DEVICES, "buckling_restrained": RESTRAINED_DEVICES}
_VALUES = ("force", "stroke", "velocity", "cumulated_plastic", "core_strain", "cumulative_ductility")


@dataclass(frozen=True)
class OrderFactors:
    """What raises the values that dampers are ordered with.

    Attributes:
        factors: of a code, or of the study.
        law: of the dampers, by which their force follows; None: it is not known, and the force is left out.
        note: where the factors come from.
    """

    factors: DeviceFactors = NONE
    law: LawValues | None = None
    note: str = ""

    def of(self, values: Mapping[str, float | None]) -> dict[str, float]:
        """Return values with their factors; none where all factors are 1.

        Args:
            values: of one damper, SI, by name.
        """
        factors = self.factors
        if factors.stroke == 1.0 and factors.velocity == 1.0:
            return {}
        by = {"stroke": factors.stroke, "velocity": factors.velocity, "core_strain": factors.stroke}
        found = {name: factor * value for name, factor in by.items() if (value := values.get(name)) is not None}
        force, stroke = values.get("force"), values.get("stroke")
        if self.law is not None and force is not None and stroke is not None:
            ratio = force_ratio(self.law, stroke, values.get("velocity"), factors.stroke, factors.velocity)
            found |= {} if math.isnan(ratio) else {"force": force * ratio}
        return found


def devices_table(
    group: Group,
    sets: Sequence[HistorySet],
    factors: Mapping[str, float],
    rules: SetRules,
    raised: OrderFactors = OrderFactors(),  # noqa: B008 - frozen
) -> Table:
    """Return the data to order the dampers: the estimate, and the demand in histories of the variants that have them.

    Args:
        group: of a design of viscous or hysteretic dampers.
        factors: property factors of the variants that have the design, by their names.
        rules: of the code in force, for statistics over motions.
        raised: factors of the code on stroke and velocity.
    """
    if "device_count" not in group.variables or group.attributes.get("status") != "completed":
        return Table("")
    demands = [device_demand(group, found, factors[found.variant]) for found in sets if found.variant in factors]
    found = [demand for demand in demands if demand is not None]
    devices = list(_devices(group, found, factors, rules, raised))
    notes = _notes(group, found) if devices else []
    if devices:
        notes += governing_notes(
            [(_whose(one), one.motions, tuple(one.values["force"].max(axis=1))) for one in found], rules
        )
    if any(factors[demand.variant] != 1.0 for demand in found):
        own = "T_adj and C_adj have" if _kind(group) == "buckling_restrained" else "forces alone have"
        notes.append(f"{own} the bound of a variant; what is ordered is without")
    if raised.note and any(device.factored for device in devices):
        notes += [*wrapped(raised.note), "factored: of the value that counts; the force by the law of the damper"]
    coefficient = group.variables.get("device_coefficient")
    units = {} if coefficient is None else {"coefficient": kilonewtons(coefficient.unit)}
    return _BY_KIND[_kind(group)].of(devices, units=units, notes=notes)


def _devices(
    group: Group, found: Sequence[DeviceDemand], factors: Mapping[str, float], rules: SetRules, raised: OrderFactors
) -> Iterator[_Device]:
    for storey in places({"": group}, "storey"):
        if "estimated_device_force" in group.variables:
            estimated = {name: storey.value(f"estimated_device_{name}") for name in _VALUES}
            both = {name: (value, None) for name, value in estimated.items()}
            yield _Device("estimate", storey, 1.0, both, raised.of(estimated))
        for demand in found:
            of = demand.values.items()
            values = {name: (both[0, storey.number], both[1, storey.number]) for name, both in of}
            counts = 0 if demand.motions >= rules.number_for_mean else 1
            ordered = raised.of({name: float(both[counts]) for name, both in values.items()})
            yield _Device(_whose(demand), storey, factors[demand.variant], values, ordered)


def _whose(demand: DeviceDemand) -> str:
    return f"{demand.variant}, {demand.level}".rstrip(", ")


def governing_notes(forces: Sequence[tuple[str, int, tuple[float, float]]], rules: SetRules) -> list[str]:
    """Return a line that says which variant and level devices are ordered for, and by which statistic.

    Args:
        forces: of each variant and level its name, its motions, and the mean and the largest force of one device, N.
        rules: of the code in force.
    """
    if not forces:
        return []

    def counted(one: tuple[str, int, tuple[float, float]]) -> float:
        return one[2][0 if one[1] >= rules.number_for_mean else 1]

    name, motions, _ = max(forces, key=counted)
    which = "mean" if motions >= rules.number_for_mean else "largest"
    clause = f" ({with_standard(rules.clauses.use)})" if rules.clauses.use else ""
    return wrapped(f"To order by: {name}, which has the largest force; the {which} of its {motions} motions{clause}.")


def _kind(group: Group) -> str:
    return "buckling_restrained" if "device_core_area" in group.variables else str(group.attributes["method"])


def _notes(group: Group, found: Sequence[DeviceDemand]) -> list[str]:
    kind = _kind(group)
    notes = []
    if "estimated_device_force" in group.variables:
        pseudo = ", pseudo velocity" if kind == "viscous" else ""
        notes.append(f"estimate: by the response spectrum of the level of the design{pseudo}")
    if kind == "hysteretic":
        hardening = float(str(group.attributes["hardening"]))
        after = f"; stiffness after yielding {hardening:g} k" if hardening > 0.0 else ""  # nan: it keeps changing
        notes.append(f"a damper yields at {_yields(group)}{after}; plastic: cumulated, work over F_y")
    elif kind == "buckling_restrained":
        notes.append("T_adj: omega R_y F_ysc A_sc, C_adj: beta omega R_y F_ysc A_sc (AISC 341-16, F4.2a)")
        notes.append(f"a brace yields at {_yields(group)}; strain: of its core")
        notes.append("cum.: cumulative ductility, the sum of the plastic deformations over that at yield")
    counts = [f"{d.variant}, {d.level}: {d.histories} of {d.planned}".replace(", :", ":") for d in found]
    if counts:
        without = "" if kind == "buckling_restrained" else "; the stroke is without the brace"
        notes.append(f"histories: {'; '.join(counts)}{without}")
    return notes


def _yields(group: Group) -> str:
    """Deformation at which a damper yields: one, or from the least to the largest of the storeys."""
    deformation = group.variables["device_yield_deformation"].values
    ends = dict.fromkeys(f"{1e3 * end:.4g}" for end in (deformation.min(), deformation.max()))
    return f"{' to '.join(ends)} mm"
