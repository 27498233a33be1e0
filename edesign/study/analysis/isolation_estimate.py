"""The isolated building as a rigid body on a linear isolation system, at each level of the hazard: an estimate."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import cache

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.ec8.analysis.isolation import EquivalentLinear, Loop, equivalent_linear
from edesign.core import LawValues
from edesign.damper.harmonic import effective_stiffness
from edesign.errors import InputError
from edesign.frame.devices import Device
from edesign.ground_motion.hazard import action_of
from edesign.project.analysis_file import AnalysisFile
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.study.analysis.structure import Structure, make_structure
from edesign.study.results.recording import coordinate, directed

_COLUMNS = (
    ("displacement", "m", "displacement of the isolated base by the equivalent linear analysis, d_dc"),
    ("stiffness", "N/m", "effective stiffness of the isolation system at it, K_eff"),
    ("period", "s", "effective period, T_eff"),
    ("damping", "1", "effective damping of the isolation system, ratio of critical, xi_eff"),
    ("acceleration", "m/s^2", "spectral acceleration, which all floors have, S_e(T_eff, xi_eff)"),
    ("shear", "N", "force through the isolation system"),
    ("stiffness_ratio", "1", "effective stiffness over that at 0.2 of the displacement"),
    ("restoring", "1", "growth of the force from half the displacement to it, over the weight"),
)


def store_isolation_estimate(group: Group, project: AnalysisFile, structure: Structure) -> None:
    """Add the equivalent linear estimate of an isolated base to a modal analysis; nothing without base or hazard.

    Args:
        structure: with its isolators.

    Raises:
        AnalysisError: the frame on its supports is unstable.
    """
    isolated, hazard = structure.frame.isolated, project.hazard
    if isolated is None or hazard is None or not hazard.levels:
        return
    fixed = make_structure(project)
    fixed.apply_gravity()
    fixed_period = float(fixed.modes(1).period[0])
    directions, mass = structure.frame.directions, structure.frame.mass
    loops = [
        system_loop([device for device in isolated.devices if device.direction == direction.degree])
        for direction in directions
    ]
    rows: list[EquivalentLinear | None] = []
    notes = []
    for level in hazard.levels:
        for direction, loop in zip(directions, loops, strict=True):
            along = f"{level}, along {direction.name}" if direction.name else level
            try:
                found = equivalent_linear(loop, mass, action_of(hazard).elastic(level), STANDARD_GRAVITY)
            except InputError as error:
                rows.append(None)
                notes.append(f"{along}: {error}")
                continue
            rows.append(found)
            notes += [f"{along}: {text}" for text in found.not_met(fixed_period)]
    coordinate(group, "hazard_level", list(hazard.levels), "", "level of the hazard")
    dims, shape = directed(structure.frame)
    for name, unit, label in _COLUMNS:
        values = np.array([np.nan if row is None else getattr(row, name) for row in rows])
        group.add(f"isolation_{name}", ("hazard_level", *dims), values.reshape(-1, *shape), unit, label)
    group.attributes |= {"fixed_base_period_s": fixed_period, "isolation_not_met": notes}


def system_loop(devices: Sequence[Device]) -> Loop:
    """Return the function that gives effective stiffness and energy of a cycle of an isolated base.

    Args:
        devices: isolators and dampers without braces, all with the displacement of the base along one direction.

    Returns:
        The function of amplitude (m), frequency (Hz) and speed at which friction counts (m/s), which returns N/m and J.
    """
    scales: dict[tuple[LawValues, float], float] = defaultdict(float)
    for device in devices:
        scales[device.values, device.deformation_scale] += device.force_scale

    @cache  # levels of the hazard look at the same displacements first
    def loop(amplitude: float, frequency: float, speed: float) -> tuple[float, float]:
        stiffness = energy = 0.0
        for (law, deformation_scale), force_scale in scales.items():
            k, work = effective_stiffness(law, deformation_scale * amplitude, frequency, deformation_scale * speed)
            stiffness += force_scale * deformation_scale * k
            energy += force_scale / deformation_scale * work
        return stiffness, energy

    return loop
