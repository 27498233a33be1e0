"""What an archive says of its incremental studies: curves of all records, and fragilities of their limits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.incremental import COLLAPSE, Stripes, collect_stripes
from edesign.assess.life_cycle import Exceedance, HazardCurve, Loss, exceedance, expected_loss
from edesign.assess.limit_fragility import LimitFragility, limit_fragility
from edesign.errors import InputError
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.archive_view import all_results
from edesign.study.results.kinds import INCREMENTAL

DRIFT = "interstorey_drift"
UNITS = {"m/s^2": ("g", STANDARD_GRAVITY), "1": ("1", 1.0)}
"""Unit of an intensity measure in the archive: how it is shown, and that in SI."""
LABELS = {"spectral_acceleration": "spectral acceleration", "pga": "peak ground acceleration", "level_factor": "factor"}


@dataclass(frozen=True)
class LifeCycle:
    """The rates at which a variant exceeds its limits, and the expected losses.

    Attributes:
        variant: of the frame.
        years: looked at.
        dispersion: of modelling, added to that of the records.
        curve: None where there is none.
        exceedances: by limit, of those that have a fragility.
        loss: None where no losses are given or none of their limits has a fragility.
        uncounted: limits without a fragility, whose losses are not in `loss`: it is a lower bound then.
        reason: why something is missing, "" otherwise.
    """

    variant: str
    years: float
    dispersion: float
    curve: HazardCurve | None
    exceedances: Mapping[str, Exceedance]
    loss: Loss | None
    uncounted: tuple[str, ...] = ()
    reason: str = ""


@dataclass(frozen=True)
class IncrementalResults:
    """The results of an incremental study.

    Attributes:
        name: of the study.
        label: of the intensity measure, with its unit.
        unit: of the intensities, a key of UNITS.
        level: name of the hazard level of the margins, "" without one.
        limits: measure and value in SI of each limit by name, with that of collapse.
        stripes: by variant and measure; variants without a single result are left out, and measures that a variant
            does not have, such as the strain of dampers of a bare frame.
        fragilities: of every variant and limit.
        states: how many histories are in each state, by variant.
        life_cycle: of each variant, where the study asks for it.
    """

    name: str
    label: str
    unit: str
    level: str
    limits: Mapping[str, tuple[str, float]]
    stripes: Mapping[str, Mapping[str, Stripes]]
    fragilities: tuple[LimitFragility, ...]
    states: Mapping[str, Mapping[str, int]]
    life_cycle: tuple[LifeCycle, ...] = ()

    @property
    def measures(self) -> tuple[str, ...]:
        """The names of the measures with curves: the drift, and those that are limited."""
        return tuple(dict.fromkeys((DRIFT, *(measure for measure, _ in self.limits.values()))))

    def stripes_of(self, measure: str) -> list[Stripes]:
        """Return the stripes of a measure, of all variants that have it."""
        return [found[measure] for found in self.stripes.values() if measure in found]

    def limits_of(self, measure: str) -> dict[str, float]:
        """Return the limits of a measure in SI by name; collapse is one of the drift."""
        return {name: value for name, (of, value) in self.limits.items() if of == measure}


def read_incremental(archive: Archive, groups: Mapping[str, Group] | None = None) -> list[IncrementalResults]:
    """Read the incremental studies of an archive that have results.

    Args:
        archive: complete or partial.
        groups: all its analyses by name, if they have been read already.
    """
    names = archive.names(INCREMENTAL)
    if not names:
        return []
    groups = all_results(archive) if groups is None else groups
    found = [_study(archive.group(f"{INCREMENTAL}/{name}"), name, groups) for name in names]
    return [one for one in found if one.stripes]


def _study(about: Group, name: str, groups: Mapping[str, Group]) -> IncrementalResults:
    given = about.attributes.get("limits")
    limits = {limit: (str(measure), float(value)) for limit, (measure, value) in dict(given or {}).items()}
    limits["collapse"] = (DRIFT, COLLAPSE)
    measures = list(dict.fromkeys((DRIFT, *(measure for measure, _ in limits.values()))))
    stripes: dict[str, dict[str, Stripes]] = {}
    states: dict[str, Counter[str]] = {}
    for variant in map(str, about.coords["variant"].values):
        mine = [g for g in groups.values() if _belongs(g, name, variant)]
        if mine:
            collected = collect_stripes(groups, name, variant, measures)
            has = {key for key, one in collected.items() if np.isfinite(one.values).any()} | {DRIFT}
            stripes[variant] = {key: one for key, one in collected.items() if key in has}
            states[variant] = Counter(str(group.attributes.get("status")) for group in mine)
    asked = about.attributes.get("life_cycle")
    unit = str(about.attributes["intensity_unit"])
    kind = str(about.attributes["intensity_measure"])
    shown = UNITS[unit][0]
    fragilities = tuple(_fragilities(stripes, limits, about))
    return IncrementalResults(
        name=name,
        label=LABELS.get(kind, kind) + (f" ({shown})" if shown != "1" else ""),
        unit=unit,
        level=str(about.attributes.get("level") or ""),
        limits=limits,
        stripes=stripes,
        fragilities=fragilities,
        states=states,
        life_cycle=tuple(_life_cycle(variant, fragilities, about) for variant in stripes) if asked else (),
    )


def _belongs(group: Group, name: str, variant: str) -> bool:
    return group.attributes.get("incremental") == name and group.attributes.get("variant") == variant


def _fragilities(
    stripes: Mapping[str, Mapping[str, Stripes]], limits: Mapping[str, tuple[str, float]], about: Group
) -> list[LimitFragility]:
    """Return the fragility of every limit; observations are independent by record, as each has all intensities."""
    variants = [str(variant) for variant in about.coords["variant"].values]
    levels = about.variables["level_intensity"].values
    found = []
    for variant, of in stripes.items():
        level = float(levels[variants.index(variant)])
        at_level = level if np.isfinite(level) else None
        for limit, (measure, value) in limits.items():
            if measure in of:
                found.append(limit_fragility(of[measure], limit, value, "capacities", at_level))
    return found


def _life_cycle(variant: str, fragilities: Sequence[LimitFragility], about: Group) -> LifeCycle:
    spec = about.attributes["life_cycle"]
    years, dispersion = float(spec["years"]), float(spec["dispersion"])
    row = [str(name) for name in about.coords["variant"].values].index(variant)
    try:
        rates = 1.0 / np.asarray(about.coords["hazard_return_period"].values, dtype=float)
        points = np.asarray(about.variables["hazard_intensity"].values[row], dtype=float)
        if not np.isfinite(points).all():
            raise InputError("the variant has no period at which the hazard curve could be taken [E-ARCH-08]")
        curve = HazardCurve(points, rates)
    except InputError as error:
        return LifeCycle(variant, years, dispersion, None, {}, None, reason=str(error))
    fits = {one.limit: one.fit for one in fragilities if one.variant == variant}
    try:
        found = {name: exceedance(fit, curve, dispersion) for name, fit in fits.items() if fit is not None}
    except InputError as error:
        return LifeCycle(variant, years, dispersion, curve, {}, None, reason=str(error))
    losses = {str(name): float(share) for name, share in spec["losses"].items()}
    uncounted = tuple(name for name in losses if name not in found)
    loss, reason = None, ""
    # what passes a limit costs no less than its loss: those of the other limits alone are a lower bound
    if counted := {name: share for name, share in losses.items() if name in found}:
        rate = {name: one.rate for name, one in found.items()}
        loss = expected_loss(rate, counted, years, float(spec["discount"]))
    elif losses:
        reason = f"no expected loss without a fragility of {', '.join(uncounted)}"
    return LifeCycle(variant, years, dispersion, curve, found, loss, uncounted, reason)
