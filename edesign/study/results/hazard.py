"""The seismic action of a project as groups of the archive: spectra of its levels, and what they follow from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.codes.tabulated import TabulatedSpectrum
from edesign.ground_motion.hazard import action_of
from edesign.project.actions.hazard_base import Hazard
from edesign.study.results.kinds import HAZARD, HAZARD_LEVELS

PERIODS = np.concatenate([[0.0], np.geomspace(0.01, 10.0, 301)])  # s; 100 a decade


def hazard_groups(hazard: Hazard | None) -> Iterator[tuple[str, Group]]:
    """Yield place and group of the seismic action, then of each of its levels; nothing without a hazard.

    Args:
        hazard: of the project, checked by its code.
    """
    if hazard is None:
        return
    action = action_of(hazard)
    group = Group(attributes={"code": hazard.code, "levels": list(hazard.levels)})
    if not hazard.own_shapes:
        _add(group, action.elastic(None), action.design(None, None))
    yield HAZARD, group
    for order, level in enumerate(hazard.levels):
        of_level = Group(attributes={"order": order, "name": level, "facts": action.facts(level)})
        _add(of_level, action.elastic(level), action.design(level, None))
        yield f"{HAZARD_LEVELS}/{level}", of_level


def _add(group: Group, elastic: Spectrum, design: DesignOrdinates | None) -> None:
    """Ordinates up to the last period, and what shapes them."""
    period = PERIODS[elastic.last_period >= PERIODS]
    group.attributes |= {
        "label": elastic.label,
        "damping": elastic.damping,
        "zero_period": elastic.zero_period,
        "corner_periods": dict(elastic.corners),
        "criteria_of": elastic.set_rules.code,
    }
    if isinstance(elastic, TabulatedSpectrum) and elastic.correction is not None:
        group.attributes["damping_correction"] = elastic.correction
    group.coords["period"] = Variable(("period",), period, "s", "period of the oscillator")
    group.add("elastic", ("period",), elastic.acceleration(period), "m/s^2", elastic.label)
    if design is not None:
        group.add("design", ("period",), design.acceleration(period), "m/s^2", design.label)
