"""What tests need of the rig: stroke, velocity and force, and the displacement at which they should be aborted."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.core.substructure import RigLimits
from edesign.project.substructure.rig import ServoHydraulicRig
from edesign.substructure.computed_structure import Direct
from edesign.substructure.drive import Drive
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.virtual_tests import VirtualLaboratory

SMALLEST_ABORT = 1e-6
"""m; no rig moves so little, and a level below it would say nothing."""
ABORT = 1.5
"""Times the largest displacement that a test asks for. Errors of a response that is worth anything stay far below half
of it, and a loop that feeds the structure passes it within some cycles, before force and damage grow much more."""


@dataclass(frozen=True)
class Need:
    """Demand on the rig in a test, without the error of the loop.

    Attributes:
        test: its name.
        deformation: largest of the specimen, m.
        stroke: of the piston, with what the rig gives way, m.
        velocity: of the piston without load, m/s: with what the oil of a servo-hydraulic rig gives way.
        force: N.
        stroke_use, velocity_use, force_use: over the limits of the rig; 0: it has no limit. The force of a
            servo-hydraulic rig lowers the velocity that it has left.
    """

    test: str
    deformation: float
    stroke: float
    velocity: float
    force: float
    stroke_use: float
    velocity_use: float
    force_use: float

    @property
    def possible(self) -> bool:
        """True if the rig can do it."""
        return max(self.stroke_use, self.velocity_use, self.force_use) <= 1.0

    @property
    def beyond(self) -> str:
        """Demands beyond a limit of the rig, in words; empty: there are none."""
        uses = (("stroke", self.stroke_use), ("velocity", self.velocity_use), ("force", self.force_use))
        return ", ".join(f"{what} {100.0 * use:.0f} % of its limit" for what, use in uses if use > 1.0)


@dataclass(frozen=True)
class AbortLevel:
    """Displacement of specimen or actuator at which a test should end, m, and why."""

    displacement: float
    reason: str


def needs_of(laboratory: VirtualLaboratory, tests: Sequence[tuple[str, Drive, Direct | None]]) -> tuple[Need, ...]:
    """Return what each test needs: of the direct analysis, or of the command that is given.

    Args:
        tests: name, what drives it, and its direct analysis if there is one.
    """
    return tuple(_need(laboratory, *test) for test in tests)


def _need(laboratory: VirtualLaboratory, name: str, drive: Drive, direct: Direct | None) -> Need:
    if direct is not None:
        deformation, force = direct.deformation, direct.force
    else:
        assert drive.target is not None
        deformation, force = drive.target[:, 0], _force(laboratory, drive)
    lab, step = laboratory.laboratory, laboratory.file.loop.main_step
    plant, limits = laboratory.file.plant, lab.limits
    piston = deformation + (force / plant.flexibility.stiffness if plant.flexibility is not None else 0.0)
    oil = plant.oil_stiffness if isinstance(plant, ServoHydraulicRig) else None
    velocity = np.gradient(piston + (force / oil if oil is not None else 0.0), step)
    return Need(
        name,
        _peak(deformation),
        stroke=_peak(piston),
        velocity=_peak(velocity),
        force=_peak(force),
        stroke_use=_peak(piston) / limits.stroke,
        velocity_use=_velocity_use(velocity, force, limits, isinstance(plant, ServoHydraulicRig)),
        force_use=_peak(force) / limits.force,
    )


def _velocity_use(velocity: np.ndarray, force: np.ndarray, limits: RigLimits, servo: bool) -> float:
    """Largest velocity over what the rig gives; a valve gives v_max sqrt(1 - F/F_max) against the force, as in runs.

    Source: Merritt (1967), Hydraulic Control Systems, 5.2: the flow is proportional to the root of the pressure drop.
    """
    if not servo or math.isinf(limits.velocity):
        return _peak(velocity) / limits.velocity
    left = np.sqrt(np.maximum(1.0 - np.sign(velocity) * force / limits.force, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return _peak(np.where(velocity == 0.0, 0.0, velocity / (limits.velocity * left)))


def _force(laboratory: VirtualLaboratory, drive: Drive) -> np.ndarray:
    """Of the damper under a given target, (n,) N."""
    assert drive.target is not None
    damper = SizedDamper(laboratory.damper.values, laboratory.damper.scales)
    return damper.force(drive.time, drive.target[:, 0], drive.target[:, 1])


def abort_level(needs: Sequence[Need], stroke: float, looped: Container[str] = ()) -> AbortLevel | None:
    """Return the displacement at which tests should end; None: they hardly move.

    Args:
        needs: of all tests, at least one.
        stroke: of the rig, m; inf: without a limit.
        looped: names of the tests whose force acts on a structure, so that they can grow.
    """
    largest = max(needs, key=lambda need: need.stroke)
    level = ABORT * largest.stroke
    if not SMALLEST_ABORT <= level < math.inf:
        return None
    said = f"{ABORT:g} times the {1e3 * largest.stroke:.4g} mm that the actuator needs in {largest.test}"
    if level >= stroke:
        return AbortLevel(stroke, f"the stroke; {said} would be beyond it")
    if largest.test in looped:
        said += "; only a loop that grows gets there"
    return AbortLevel(level, said)


def _peak(values: np.ndarray) -> float:
    found = float(np.max(np.abs(values)))
    return found if math.isfinite(found) else math.inf
