"""What histories ask of dampers that are alike: force, stroke, strain and velocity of one of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.assess.quantities import largest_velocity
from edesign.assess.sets import HistorySet
from edesign.codes.device_factors import DeviceFactors
from edesign.codes.motion_sets import SetRules
from edesign.damper.factored import force_ratio
from edesign.frame.devices import Device
from edesign.project.notation.names import damper_place
from edesign.project.study.study import own_variant
from edesign.report.inputs.variant_frames import VariantFrames


@dataclass(frozen=True)
class Demand:
    """The largest values of one damper over time, mean and maximum of several motions.

    Attributes:
        mean, maximum: SI units.
        count: motions that have it.
    """

    mean: float
    maximum: float
    count: int

    def governing(self, rules: SetRules) -> float:
        """Return the governing value: the mean of as many motions as a code asks for, else the maximum.

        Args:
            rules: of the code in force.
        """
        return self.mean if self.count >= rules.number_for_mean else self.maximum


@dataclass(frozen=True)
class Alike:
    """Dampers of one storey that are alike.

    Attributes:
        storey: from 1; 0: of a base.
        stands, law: names.
    """

    storey: int
    stands: str
    law: str
    devices: tuple[Device, ...]

    @property
    def places(self) -> str:
        """Their bays in words."""
        where = [damper_place(device.name)[1] for device in self.devices]
        kinds = dict.fromkeys(text.rpartition(" ")[0] for text in where)
        if len(kinds) != 1 or not next(iter(kinds)):
            return ", ".join(where)
        kind, ends = next(iter(kinds)), list(dict.fromkeys(text.rpartition(" ")[2] for text in where))
        return f"{kind}{'s' * (len(ends) > 1)} {', '.join(ends)}"

    @property
    def at(self) -> list[str]:
        """The storey and the places, as tables have them."""
        return [str(self.storey) if self.storey else "base", self.places]


def alike_devices(devices: Sequence[Device]) -> list[Alike]:
    """Return the dampers of a frame, those of a storey together that have one law, size and brace; storeys ascend."""
    found: dict[tuple[object, ...], list[Device]] = {}
    for device in devices:
        stands = damper_place(device.name)[0]
        key = (device.storey, stands, device.law, device.size, device.brace, device.force_scale)
        found.setdefault(key, []).append(device)
    groups = [Alike(int(str(key[0])), str(key[1]), str(key[2]), tuple(several)) for key, several in found.items()]
    return sorted(groups, key=lambda group: group.storey)


def demands_of(
    alike: Sequence[Device], histories: HistorySet, frames: VariantFrames, whole: Callable[[str], Group]
) -> dict[str, Demand | None]:
    """Return what histories ask of one of dampers that are alike: force, deformation, strain and velocity, by name.

    All that is told of dampers, of what holds them and of orders comes of this: of each motion the largest in the
    place that has most.

    Args:
        histories: of a variant, a bound or a temperature, at one level.
        whole: reads the results of an analysis with what was kept over time.
    """
    completed, names_of = list(histories.completed.values()), {device.name for device in alike}
    degrees = completed[0].attributes.get("temperature_C")
    temperature = None if degrees is None else float(str(degrees))
    own = own_variant(histories.variant)
    frame = frames.frame(own if own in frames.variants else "", temperature)  # of bounds, other scales
    devices = [device for device in frame.devices if device.name in names_of]
    names = ("damper_force", "damper_deformation", "damper_strain")
    found = {name: demand(histories, devices, name) for name in names}
    if devices[0].layer_thickness is None:
        found["damper_strain"] = None
    found["velocity"] = velocity(histories, whole, devices)
    return found


def demand(found: HistorySet, devices: Sequence[Device], quantity: str) -> Demand | None:
    """Return the largest demand on equal dampers under each motion; None where no history has a value.

    Of the angles of a motion, and of the places of the masses, the worst counts.

    Args:
        found: with the extremes of their dampers.
        devices: some of the frame's.
        quantity: damper_force (N, of one of those side by side), damper_deformation (m) or damper_strain.
    """
    values = {}
    for name, group in found.completed.items():
        most = peak(group, quantity)
        if most is not None:
            number = devices[0].size.number if quantity == "damper_force" else 1
            values[name] = float(np.max(most[_at(group, devices)])) / number
    return _of(found, values)


def velocity(found: HistorySet, whole: Callable[[str], Group], devices: Sequence[Device]) -> Demand | None:
    """Return the demand on the velocity of a damper without its brace, m/s.

    Of a dashpot it follows from the force, (F / c)^(1 / alpha). Of other laws it is that of the history at every step,
    and in archives of before 0.3 follows from the deformation over time, where that was kept.

    Args:
        found: with the extremes of their dampers.
        devices: that are alike.
    """
    values = {}
    for name, group in found.completed.items():
        most, largest = _of_dashpots(group, devices), peak(group, "damper_velocity")
        if most is None and largest is not None:
            most = float(largest[_at(group, devices)].max())
        if most is None:
            kept = whole(name)
            if "damper_deformation" in kept.variables and "time" in kept.coords:
                over_time = np.asarray(kept.variables["damper_deformation"].values)[:, _at(kept, devices)]
                most = float(largest_velocity(np.asarray(kept.coords["time"].values), over_time).max())
        if most is not None:
            values[name] = most
    return _of(found, values)


def factored_ratio(
    device: Device,
    stroke: Demand | None,
    speed: Demand | None,
    factors: DeviceFactors,
    rules: SetRules,
    period: float | None = None,
) -> float:
    """Return the force of a damper at stroke and velocity times the factors of a code, over that of histories.

    Args:
        stroke: demand on its deformation, m; None: not known.
        speed: demand on its velocity, m/s; None: not known.
        rules: of the code in force, which value of several histories counts.
        period: natural period, s, of the pseudo velocity that stands for one that was not kept; None: there is none.

    Returns:
        The ratio by the law of the damper; nan where that depends on a velocity that is not known.
    """
    on_stroke, on_velocity = factors_on(device, factors)
    if on_stroke == 1.0 and on_velocity == 1.0:
        return 1.0
    if stroke is None:
        return math.nan
    scale = device.deformation_scale
    own = scale * stroke.governing(rules)
    known = None if period is None else 2.0 * math.pi / period * own
    if speed is not None:
        known = scale * speed.governing(rules)
    return force_ratio(device.values, own, known, on_stroke, on_velocity)


def factors_on(device: Device, factors: DeviceFactors) -> tuple[float, float]:
    """Return the factors on stroke and velocity of a damper, or of an isolator."""
    return (factors.stroke, factors.velocity) if device.stands else (factors.isolator_stroke, 1.0)


def _of_dashpots(group: Group, devices: Sequence[Device]) -> float | None:
    """Largest velocity of dampers whose law is a dashpot alone; None: their law is another."""
    law = devices[0].values
    force = peak(group, "damper_force")
    if law.law not in ("viscous", "viscous_power") or law.effects or force is None:
        return None
    c, alpha = (*law.values, 1.0)[:2]
    scales = np.array([device.force_scale for device in devices])
    stretch = np.array([device.deformation_scale for device in devices])
    return float(np.max((force[_at(group, devices)] / (scales * c)) ** (1.0 / alpha) / stretch))


def _at(group: Group, devices: Sequence[Device]) -> list[int]:
    names = [str(name) for name in group.coords["damper"].values]
    return [names.index(device.name) for device in devices]


def _of(found: HistorySet, values: Mapping[str, float]) -> Demand | None:
    worst: dict[str, float] = {}
    for name, value in values.items():
        motion = found.motion_of[name]
        worst[motion] = max(worst.get(motion, value), value)
    every = list(worst.values())
    return Demand(float(np.mean(every)), float(np.max(every)), len(every)) if every else None
