"""The devices to order of a design: sizes and largest values of one damper, estimated and of the histories."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.assess.devices import DeviceDemand, device_demand
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.codes.rule_check import with_standard
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.items import Place, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_MM, M2, M_S, MM, MM2, ONE, PERCENT, Unit


class _Device(NamedTuple):
    """One damper of a storey, estimated or in the histories of a variant."""

    whose: str
    storey: Place
    factor: float
    """On its strength, of a variant."""
    largest: Mapping[str, tuple[float | None, float | None]]
    """Mean and largest of the histories, SI."""
    counted: Mapping[str, float | None]
    """The one that counts by the number of motions."""
    factored: Mapping[str, float]
    """It with the factors of the code; none where all are 1."""

    @property
    def asked(self) -> Mapping[str, float | None]:
        """What the damper has to have, with the factors of the code; its force is none where its law is not known."""
        unknown = {"force": None} if self.factored and "force" not in self.factored else {}
        return {**self.counted, **unknown, **self.factored}


def _size(name: str) -> Callable[[_Device], float]:
    return lambda device: device.storey.known(f"device_{name}")


def _strength(name: str) -> Callable[[_Device], float]:
    """A size that depends on the bound of a variant, as those to order do not."""
    return lambda device: _size(name)(device) * device.factor


def _ordered(header: str, unit: Unit, name: str) -> Column[_Device]:
    return col(header, unit, lambda device: device.asked.get(name), optional=True)


def _factored(header: str, unit: Unit, name: str) -> Column[_Device]:
    return col(f"{header} factored", unit, lambda device: device.factored.get(name), optional=True)


def _largest(header: str, unit: Unit, name: str) -> tuple[Column[_Device], Column[_Device]]:
    return (
        col(f"mean {header}", unit, lambda device: device.largest.get(name, _NONE)[0]),
        col(f"max {header}", unit, lambda device: device.largest.get(name, _NONE)[1]),
    )


_NONE = (None, None)
LARGEST = "Largest values of one damper"
ORDER, LARGEST_TITLE = "Devices to order, design {design}", f"{LARGEST}, design {{design}}"
_ORDER_FILE, _LARGEST_FILE = "devices_to_order", "largest_values_of_a_damper"
_NAMED: tuple[Column[_Device], ...] = (
    count("storey", lambda device: int(device.storey.name)),
    count("number", _size("count")),
)
_WHOSE: Column[_Device] = text("", "whose")
_FORCE_BY: Column[_Device] = text("force by", lambda device: device.whose or None, optional=True)
_OF_VISCOUS: tuple[Column[_Device], ...] = (
    *_NAMED,
    col("c", "coefficient", _size("coefficient")),
    col("alpha", ONE, lambda device: float(device.storey.group.attributes["alpha"]), form="g", as_shown=True),
)
_OF_LAYERS: tuple[Column[_Device], ...] = (
    *_NAMED,
    count("layers", lambda device: int(str(device.storey.group.attributes["layers"]))),
    col("area of one", M2, lambda device: device.storey.known("layer_area")),
    col("thickness", MM, lambda device: _thickness(device.storey.group)),
)
_OF_HYSTERETIC: tuple[Column[_Device], ...] = (
    *_NAMED,
    col("F_y", KN, _size("yield_force")),
    col("k", KN_MM, _size("stiffness")),
)
_OF_BRACES: tuple[Column[_Device], ...] = (
    *_NAMED,
    col("A_sc", MM2, _size("core_area")),
    col("T_adj", KN, _strength("adjusted_tension")),
    col("C_adj", KN, _strength("adjusted_compression")),
)
_FORCE, _STROKE = ("force", KN, "force"), ("stroke", MM, "stroke")
_VELOCITY, _PLASTIC = ("velocity", M_S, "velocity"), ("plastic", MM, "cumulated_plastic")
_STRAIN, _CUMULATED = ("strain", PERCENT, "core_strain"), ("cum.", Unit("-"), "cumulative_ductility")
_SHEAR = ("strain", PERCENT, "strain")
ELASTOMER_DEVICES = TableSpec[_Device](
    "elastomer_devices_to_order",
    ORDER,
    (*_OF_LAYERS, *(_ordered(*of) for of in (_FORCE, _STROKE, _SHEAR, _VELOCITY)), _FORCE_BY),
    named_as=_ORDER_FILE,
)
ELASTOMER_LARGEST = TableSpec[_Device](
    "largest_values_of_elastomer_devices",
    LARGEST_TITLE,
    (
        _WHOSE,
        *_NAMED,
        *_largest(*_FORCE),
        *_largest(*_STROKE),
        *_largest(*_SHEAR),
        *_largest(*_VELOCITY),
        *(_factored(*of) for of in (_FORCE, _STROKE, _SHEAR, _VELOCITY)),
    ),
    named_as=_LARGEST_FILE,
)
VISCOUS_DEVICES = TableSpec[_Device](
    "viscous_devices_to_order",
    ORDER,
    (*_OF_VISCOUS, _ordered(*_FORCE), _ordered(*_STROKE), _ordered(*_VELOCITY), _FORCE_BY),
    named_as=_ORDER_FILE,
)
VISCOUS_LARGEST = TableSpec[_Device](
    "largest_values_of_viscous_devices",
    LARGEST_TITLE,
    (
        _WHOSE,
        *_OF_VISCOUS,
        *_largest(*_FORCE),
        *_largest(*_STROKE),
        *_largest(*_VELOCITY),
        _factored(*_FORCE),
        _factored(*_STROKE),
        _factored(*_VELOCITY),
    ),
    named_as=_LARGEST_FILE,
)
HYSTERETIC_DEVICES = TableSpec[_Device](
    "hysteretic_devices_to_order",
    ORDER,
    (*_OF_HYSTERETIC, _ordered(*_FORCE), _ordered(*_STROKE), _ordered(*_PLASTIC), _FORCE_BY),
    named_as=_ORDER_FILE,
)
HYSTERETIC_LARGEST = TableSpec[_Device](
    "largest_values_of_hysteretic_devices",
    LARGEST_TITLE,
    (
        _WHOSE,
        *_OF_HYSTERETIC,
        *_largest(*_FORCE),
        *_largest(*_STROKE),
        *_largest(*_PLASTIC),
        _factored(*_FORCE),
        _factored(*_STROKE),
    ),
    named_as=_LARGEST_FILE,
)
RESTRAINED_DEVICES = TableSpec[_Device](
    "restrained_braces_to_order",
    ORDER,
    (*_OF_BRACES, _ordered(*_FORCE), _ordered(*_STRAIN), _ordered(*_CUMULATED), _FORCE_BY),
    named_as=_ORDER_FILE,
)
RESTRAINED_LARGEST = TableSpec[_Device](
    "largest_values_of_restrained_braces",
    LARGEST_TITLE,
    (
        _WHOSE,
        *_OF_BRACES,
        *_largest(*_FORCE),
        *_largest(*_STRAIN),
        *_largest(*_CUMULATED),
        _factored(*_FORCE),
        _factored(*_STRAIN),
    ),
    named_as=_LARGEST_FILE,
)
_BY_KIND = {
    "elastomer": (ELASTOMER_DEVICES, ELASTOMER_LARGEST),
    "viscous": (VISCOUS_DEVICES, VISCOUS_LARGEST),
    "hysteretic": (HYSTERETIC_DEVICES, HYSTERETIC_LARGEST),
    "buckling_restrained": (RESTRAINED_DEVICES, RESTRAINED_LARGEST),
}
ESTIMATE = "estimate"
_VALUES = ("force", "stroke", "strain", "velocity", "cumulated_plastic", "core_strain", "cumulative_ductility")


def devices_tables(
    group: Group,
    sets: Sequence[HistorySet],
    factors: Mapping[str, float],
    rules: SetRules,
    raised: RaisedDevices = RaisedDevices(),  # noqa: B008 - frozen
) -> list[Table]:
    """Return what is ordered, a row for each storey, and the values that it comes from.

    Each value to order is the largest over the variants and levels that have the design, by the statistic that the code
    takes of their motions, and with the factors of the code. Without histories it is the estimate. The other table has
    the estimate and the demand in histories of each variant and level.

    Args:
        group: of a design, not of a placement.
        factors: property factors of the variants that have the design, by their names.
        rules: of the code in force, for statistics over motions.
        raised: factors of the code on stroke and velocity.
    """
    if "device_count" not in group.variables or group.attributes.get("status") != "completed":
        return []
    demands = [device_demand(group, found, factors[found.variant]) for found in sets if found.variant in factors]
    found = [demand for demand in demands if demand is not None]
    devices = list(_devices(group, found, factors, rules, raised))
    if not devices:
        return []
    factored = raised.note and any(device.factored for device in devices)
    with_factors = wrapped(f"{raised.note.rstrip('.')}; the force with them by the law.") * bool(factored)
    bounds = []
    if any(factors[demand.variant] != 1.0 for demand in found):
        own = "T_adj and C_adj have" if _kind(group) == "buckling_restrained" else "Forces alone have"
        bounds.append(f"{own} the bound of a variant; what is ordered is without.")
    coefficient = group.variables.get("device_coefficient")
    units = {} if coefficient is None else {"coefficient": kilonewtons(coefficient.unit)}
    order, largest = _BY_KIND[_kind(group)]
    ordered, design = list(_to_order(devices)), group.attributes.get("name", "")
    of = {one.whose for one in ordered}
    governs = f"Force in all storeys by {of.pop()}." if len(of) == 1 and found else ""
    ordered = [one._replace(whose="") for one in ordered] if governs else ordered
    said = [*[governs] * bool(governs), *_order_notes(found, rules), *with_factors, *_device_notes(group)]
    return [
        order.of(ordered, units=units, notes=said, design=design),
        largest.of(devices, design=design, units=units, notes=[*_notes(group, found), *bounds, *with_factors]),
    ]


def _to_order(devices: Sequence[_Device]) -> Iterator[_Device]:
    """One device for each storey, whose values are the largest of those in histories, else the estimated ones."""
    by_storey: dict[int, list[_Device]] = {}
    for device in devices:
        by_storey.setdefault(device.storey.number, []).append(device)
    for all_of in by_storey.values():
        of = [device for device in all_of if device.whose != ESTIMATE] or all_of
        names = [name for name in _VALUES if any(device.asked.get(name) is not None for device in of)]
        asked = {name: max(value for device in of if (value := device.asked.get(name)) is not None) for name in names}
        first = max(of, key=lambda device: device.asked.get("force") or 0.0)
        yield _Device(first.whose, first.storey, 1.0, {}, asked, {})


def _order_notes(found: Sequence[DeviceDemand], rules: SetRules) -> list[str]:
    """Say which values are ordered."""
    if not found:
        return ["Values of one damper, by the estimate: there are no histories yet."]
    clause = f" ({with_standard(rules.clauses.use)})" if rules.clauses.use else ""
    return wrapped(
        "Each value, of one damper, is the largest of all variants and levels with the design, of each the "
        f"mean of at least {rules.number_for_mean} motions, else the largest{clause}."
    )


def _devices(
    group: Group, found: Sequence[DeviceDemand], factors: Mapping[str, float], rules: SetRules, raised: RaisedDevices
) -> Iterator[_Device]:
    for storey in places({"": group}, "storey"):
        if (estimated := _estimated(group, storey))["force"] is not None:
            both = {name: (value, None) for name, value in estimated.items()}
            yield _Device(ESTIMATE, storey, 1.0, both, estimated, raised.of(group, storey.number, estimated))
        for demand in found:
            of = demand.values.items()
            values = {name: (both[0, storey.number], both[1, storey.number]) for name, both in of}
            counted = {name: float(of[storey.number]) for name, of in demand.counted(rules).items()}
            yield _Device(
                _whose(demand),
                storey,
                factors[demand.variant],
                values,
                counted,
                raised.of(group, storey.number, counted),
            )


def _estimated(group: Group, storey: Place) -> dict[str, float | None]:
    """The estimate for one damper of a storey; of layers the velocity is that of a sine at the first frequency."""
    if _kind(group) != "elastomer":
        return {name: storey.value(f"estimated_device_{name}") for name in _VALUES}
    force, strain = storey.value("estimated_damper_force"), storey.value("estimated_damper_strain")
    if force is None or strain is None:
        return {"force": None}
    about, stroke = group.attributes, strain * _thickness(group)
    velocity = 2.0 * math.pi * float(str(about["frequency_Hz"])) * stroke
    return {"force": force / float(str(about["number"])), "stroke": stroke, "strain": strain, "velocity": velocity}


def _thickness(group: Group) -> float:
    return float(str(group.attributes["layer_thickness_m"]))


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
    if "layer_thickness_m" in group.attributes:
        return "elastomer"
    return "buckling_restrained" if "device_core_area" in group.variables else str(group.attributes["method"])


def _device_notes(group: Group) -> list[str]:
    """What the values of a kind of damper are."""
    kind = _kind(group)
    if kind == "elastomer":
        about = group.attributes
        return wrapped(
            f"G' {1e-6 * float(str(about['G_storage_Pa'])):.4g} MPa and loss factor "
            f"{float(str(about['loss_factor'])):.4g} at {float(str(about['frequency_Hz'])):.3g} Hz and "
            f"{100.0 * float(str(about['strain'])):.3g} % strain: each area is that of a layer with these. Strain: of "
            "the layers, stroke over thickness. The stroke is that of the damper, without its brace."
        )
    if kind == "viscous":
        return ["The stroke is that of the damper, without its brace."]
    if kind == "hysteretic":
        hardening = float(str(group.attributes["hardening"]))
        after = f"; stiffness after yielding {hardening:g} k" if hardening > 0.0 else ""  # nan: it keeps changing
        return [
            f"A damper yields at {_yields(group)}{after}. Plastic: cumulated, work over F_y.",
            "The stroke is that of the damper, without its brace.",
        ]
    return [
        "T_adj: omega R_y F_ysc A_sc, C_adj: beta omega R_y F_ysc A_sc (AISC 341-16, F4.2a).",
        f"A brace yields at {_yields(group)}. Strain: of its core.",
        "Cum.: cumulative ductility, the sum of the plastic deformations over that at yield.",
    ]


def _notes(group: Group, found: Sequence[DeviceDemand]) -> list[str]:
    notes = []
    if {"estimated_device_force", "estimated_damper_strain"} & {*group.variables}:
        pseudo = ", pseudo velocity" if _kind(group) in ("viscous", "elastomer") else ""
        notes.append(f"Estimate: by the response spectrum of the level of the design{pseudo}.")
    counts = [f"{d.variant}, {d.level}: {d.histories} of {d.planned}".replace(", :", ":") for d in found]
    return [*notes, *([f"Histories: {'; '.join(counts)}."] if counts else [])]


def _yields(group: Group) -> str:
    """Deformation at which a damper yields: one, or from the least to the largest of the storeys."""
    deformation = group.variables["device_yield_deformation"].values
    ends = dict.fromkeys(f"{1e3 * end:.4g}" for end in (deformation.min(), deformation.max()))
    return f"{' to '.join(ends)} mm"
