"""The dampers of a design as devices: force against velocity and deformation, with tolerances and what levels ask."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.reader import Archive
from edesign.assess.sets import HistorySet, history_sets
from edesign.codes.device_factors import DeviceFactors
from edesign.codes.motion_sets import SetRules
from edesign.damper.harmonic import steady_cycle
from edesign.errors import EdesignError
from edesign.frame.devices import Device
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.dampers.designs import Bounds
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.study.study import Study
from edesign.report.archive_view import results
from edesign.report.archived import archived_study
from edesign.report.assessment.tables import read_histories
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import AFTER, MEAN, VARIANTS, legend_above, new_figure, styled
from edesign.report.inputs.damper_demand import demand, factored_ratio, factors_on, velocity
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.study.design.bounds import property_factors
from edesign.study.plan.device_factors import factors_in_force
from edesign.study.results.kinds import DESIGNS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TOLERANCE = 0.15
"""Of the force of a device that is supplied. Source: NTC 2018, Tables 11.9.I to 11.9.III, column of the supply."""
_DASHPOTS = ("viscous", "viscous_power")
_POINTS = 200
_BEYOND = 1.1  # of the largest velocity that is drawn


@dataclass(frozen=True)
class Asked:
    """What histories ask of a damper: values that count, and those with the factors of the code.

    Attributes:
        label: level of the hazard.
        stroke, velocity, force: m, m/s and N; a velocity that is not known is nan.
        raised: the same with the factors of the code.
    """

    label: str
    stroke: float
    velocity: float
    force: float
    raised: tuple[float, float, float]


def device_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield a figure of the damper with the largest force of each design.

    There is none where the texts of the archive cannot be read, or a frame not be built again; the report says that
    of its tables.

    Yields:
        Name of the file, caption and figure.
    """
    try:
        study = archived_study(archive)
        found = [] if study is None else list(_device_figures(archive, study))
    except EdesignError:
        return
    yield from found


def _device_figures(archive: Archive, study: Study) -> Iterator[tuple[str, str, Figure]]:
    frames, rules = VariantFrames(archive, study.base, study), rules_in_force(study.hazard)
    sets, whole = history_sets(read_histories(archive)), partial(results, archive)
    factors = factors_in_force(study, study.hazard)
    for name in archive.names(DESIGNS):
        variant = next((key for key in frames.variants if name in study.variants[key].designs), None)
        if variant is None or variant in study.derived or isinstance(study.designs[name], PlacementDesign):
            continue
        own = archive.group_attributes(f"{DESIGNS}/{name}").get("device_names")
        devices = [one for one in frames.frame(variant).devices if not isinstance(own, list) or one.name in own]
        levels = [one for one in sets if one.variant == variant and one.completed]
        asked = {
            one.name: _asked(one, levels, whole, factors, rules, frames.first_period(variant, one)) for one in devices
        }
        known = [one for one in devices if asked[one.name]]
        if not known:
            continue
        most = max(known, key=lambda one: max(level.force for level in asked[one.name]))
        low, high, of = _band(study, name, variant)
        caption = (
            f"Design {name}: the damper with the largest force, {most.name}, with {of}. Points: what the levels ask, "
            "by the statistic that counts"
        )
        caption += "; open: with the factors of the code." if any(map(any_raised, asked[most.name])) else "."
        yield file_name("device", name), caption, device_figure(most, asked[most.name], (low, high))


def any_raised(level: Asked) -> bool:
    """Return whether factors of a code change what a level asks."""
    return level.raised[0] != level.stroke or level.raised[1] != level.velocity


def _band(study: Study, design: str, variant: str) -> tuple[float, float, str]:
    """Factors on the force at the lower and the upper end of the band, and what it is."""
    bounds: Bounds | None = study.variants[variant].bounds or getattr(study.designs[design], "bounds", None)
    low, high = (1.0, 1.0) if bounds is None else property_factors(bounds)
    if low < high:
        return low, high, f"the bounds of its properties, {low:g} to {high:g}"
    tolerance = f"a tolerance of {100.0 * TOLERANCE:g} % on its force"
    return 1.0 - TOLERANCE, 1.0 + TOLERANCE, tolerance


def _asked(
    device: Device,
    levels: Sequence[HistorySet],
    whole: Callable[[str], Any],
    factors: DeviceFactors,
    rules: SetRules,
    period: float | None,
) -> list[Asked]:
    found = []
    for one in levels:
        stroke, force = (demand(one, [device], name) for name in ("damper_deformation", "damper_force"))
        if stroke is None or force is None:
            continue
        speed = velocity(one, whole, [device])
        on_stroke, on_velocity = factors_on(device, factors)
        ratio = factored_ratio(device, stroke, speed, factors, rules, period)
        u, f = stroke.governing(rules), force.governing(rules)
        v = math.nan if speed is None else speed.governing(rules)
        found.append(Asked(one.level or "histories", u, v, f, (on_stroke * u, on_velocity * v, ratio * f)))
    return found


@styled
def device_figure(device: Device, asked: Sequence[Asked], band: tuple[float, float]) -> Figure:
    """Draw the force of a damper against its velocity, of a dashpot, and its loop at the largest stroke that is asked.

    Args:
        device: damper of the frame; one of those side by side is drawn.
        asked: of each level.
        band: factors on the force at the ends of the band.
    """
    dashpot = device.values.law in _DASHPOTS and not device.values.effects
    figure, (axes,) = new_figure(1, 2 if dashpot else 1, 6.3 if dashpot else 3.6, 2.8)
    if dashpot:
        _force_velocity(axes[0], device, asked, band)
    _loop(axes[-1], device, asked, band)
    legend_above(axes[0])
    return figure


def _force_velocity(axis: Axes, device: Device, asked: Sequence[Asked], band: tuple[float, float]) -> None:
    c, alpha = (*device.values.values, 1.0)[:2]
    largest = max(np.nanmax([one.velocity, one.raised[1]]) for one in asked)
    v = np.linspace(0.0, _BEYOND * largest, _POINTS)
    force = 1e-3 * device.force_scale / device.size.number * c * (device.deformation_scale * v) ** alpha
    axis.fill_between(v, band[0] * force, band[1] * force, color=AFTER, alpha=0.15, lw=0.0, label=_named(band))
    axis.plot(v, force, color=AFTER, lw=1.2, label=f"law, alpha = {alpha:g}")
    _points(axis, asked, 1, 1.0)
    axis.set_xlim(0.0, _BEYOND * largest)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("velocity (m/s)")
    axis.set_ylabel("force (kN)")


def _loop(axis: Axes, device: Device, asked: Sequence[Asked], band: tuple[float, float]) -> None:
    most = max(asked, key=lambda one: one.stroke)
    known = math.isfinite(most.velocity) and most.stroke > 0.0
    frequency = most.velocity / (2.0 * math.pi * most.stroke) if known else 1.0
    amplitude = device.deformation_scale * most.stroke
    angle, force = steady_cycle(device.values, amplitude, frequency)
    x = 1e3 * most.stroke * np.sin(np.append(angle, angle[0]))
    y = 1e-3 * device.force_scale / device.size.number * np.append(force, force[0])
    for factor in band:
        axis.plot(x, factor * y, color=AFTER, lw=0.7, ls="--", label=_named(band) if factor == band[0] else None)
    axis.plot(x, y, color=AFTER, lw=1.2, label=f"steady loop at {most.label}")
    _points(axis, asked, 0, 1e3)
    axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
    axis.axvline(0.0, color=MEAN, lw=0.4, zorder=0.9)
    axis.set_xlabel("deformation (mm)")
    axis.set_ylabel("force (kN)")


def _named(band: tuple[float, float]) -> str:
    return f"{100.0 * (band[0] - 1.0):+.3g} to {100.0 * (band[1] - 1.0):+.3g} %"


def _points(axis: Axes, asked: Sequence[Asked], which: int, scale: float) -> None:
    """What each level asks, filled, and with the factors of the code, open.

    Args:
        which: 0: the stroke is along the axis, 1: the velocity.
    """
    marks: Mapping[int, str] = dict(enumerate("osD^v"))
    for i, one in enumerate(asked):
        color, mark = VARIANTS[(2 * i) % len(VARIANTS)], marks[i % len(marks)]
        bare = (one.stroke, one.velocity, one.force)
        for values, face, label in ((bare, color, one.label), (one.raised, "white", f"{one.label}, factored")):
            if values is bare or any_raised(one):
                x, y = scale * values[which], 1e-3 * values[2]
                axis.plot(x, y, marker=mark, ms=5.0, mfc=face, mec=color, ls="none", label=label)
