"""The frame of a project with all that yields in it: as the numerical part, and with its damper the direct analysis."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from edesign.building.devices import Device
from edesign.core import Channel, LawValues
from edesign.core.frame_part import FrameNumericalPart
from edesign.errors import AnalysisError, InputError
from edesign.project.project import Project
from edesign.study.history import integrator, load_and_damp
from edesign.study.quantities import floor_displacements
from edesign.study.structure import Structure, make_frame, make_structure
from edesign.substructure.structure.numerical import LinearPart

GROWTH = 1e-9
"""Of a step, that rounding errors make."""


def loop_grows(part: LinearPart, specimen_stiffness: float, step: float, held: bool) -> bool:
    """Return whether small vibrations grow in the loop of an implicit frame, a spring as specimen, and an ideal rig.

    Newmark's constant average acceleration, with the force of the specimen at the end of the step extrapolated or held.

    Args:
        part: the frame's tangent under gravity, of n degrees.
        specimen_stiffness: N/m.
        step: main step, s.
        held: whether the force is held over a step.
    """
    n, h = len(part.names), step
    inverse = np.linalg.inv(part.mass)
    at_end = np.linalg.inv(part.mass + 0.5 * h * part.damping + 0.25 * h**2 * part.stiffness)
    unit = np.eye(2 * n + 1)
    u, v, before = unit[:n], unit[n : 2 * n], unit[2 * n]
    force = specimen_stiffness * part.interface @ u
    ahead = force if held else 2.0 * force - before
    a0 = -inverse @ (part.damping @ v + part.stiffness @ u + np.outer(part.interface, force))
    going = u + h * v + 0.25 * h**2 * a0, v + 0.5 * h * a0
    a1 = -at_end @ (part.stiffness @ going[0] + part.damping @ going[1] + np.outer(part.interface, ahead))
    whole = np.vstack([going[0] + 0.25 * h**2 * a1, going[1] + 0.5 * h * a1, force])
    return float(np.max(np.abs(np.linalg.eigvals(whole)))) > 1.0 + GROWTH


@dataclass(frozen=True)
class Response:
    """Of the frame with its damper in it.

    Attributes:
        deformation, force: (n,) of the damper, m and N.
        floors: (n, n_floors) horizontal displacement of the floors, m.
    """

    deformation: np.ndarray
    force: np.ndarray
    floors: np.ndarray


@dataclass(frozen=True, eq=False)
class ProjectFrame:
    """The frame of a project without the damper that stands in the laboratory, under gravity.

    Attributes:
        project: the validated project; its `integration` is that of the frame.
        device: the damper in the laboratory.
    """

    project: Project
    device: Device
    _ready: list[tuple[Structure, np.ndarray]] = field(default_factory=list)

    def numerical_part(self, force: Literal["extrapolated", "held"], steps: int = 1) -> FrameNumericalPart:
        """Return the frame, whose outputs are the displacements of its floors; all parts share one analysis.

        Args:
            force: of the specimen over a main step.
            steps: of the frame in a main step.

        Raises:
            InputError: the project has no `integration`, or the frame cannot be built.
            AnalysisError: no equilibrium under gravity, or no modes for the damping.
            CoreError: the frame is a mechanism without the damper.
        """
        if not self._ready:
            structure = self._structure(None)
            self._ready.append((structure, structure.analysis.state()))
        structure, rest = self._ready[0]
        structure.analysis.restore(rest)
        outputs = tuple(floor_displacements(structure.frame, history=True).channels())
        assert self.project.integration is not None
        method = integrator(self.project.integration)
        return FrameNumericalPart(structure.analysis, self.device.terms, outputs, method, force, steps)

    def response(
        self, ground: np.ndarray, step: float, law: LawValues, scales: tuple[float, float], every: int = 1
    ) -> Response:
        """Return the response of the frame with the damper in it, without laboratory.

        Args:
            ground: (n,) ground acceleration at steps, m/s2.
            step: s.
            law: of the damper.
            scales: of its force and deformation.
            every: so many steps from one instant of the response to the next.

        Raises:
            AnalysisError: equilibrium was lost; the message says when and why.
        """
        structure = self._structure((law, scales))
        number = len(structure.frame.model.damper_names) - 1
        floors = floor_displacements(structure.frame, history=True)
        own = [Channel(kind, ((1.0, kind, number, 0),)) for kind in ("damper_deformation", "damper_force")]
        assert self.project.integration is not None
        found = structure.analysis.history(
            ground, step, integrator(self.project.integration), [*floors.channels(), *own], every
        )
        if found.status != "completed":
            raise AnalysisError(f"{self.project.path}: the frame with {self.device.name} in it: {found.reason}")
        return Response(found.values["damper_deformation"], found.values["damper_force"], floors.values(found))

    def _structure(self, specimen: tuple[LawValues, tuple[float, float]] | None) -> Structure:
        """The frame under gravity, damped, its dampers installed: the specimen as the last one, or without it."""
        if self.project.integration is None:
            raise InputError(f"{self.project.path}: a frame that may yield needs `integration`")
        frame = make_frame(self.project, dampers=True, outside=(self.device.name,))
        if specimen is not None:
            law, (force, deformation) = specimen
            name = self.device.name
            frame.model.damper(name, law, self.device.terms, force_scale=force, deformation_scale=deformation)
        structure = make_structure(self.project, frame)
        load_and_damp(self.project, structure)
        return structure
