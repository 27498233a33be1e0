"""The frame of a project with all that yields in it: as the numerical part, and with its damper the direct analysis."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Channel, LawValues, Response
from edesign.core.frame_part import FrameNumericalPart
from edesign.core.response import EnergyBalance
from edesign.errors import AnalysisError, InputError
from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.project import Project
from edesign.study.analysis.history import integrator, load_and_damp
from edesign.study.analysis.history_results import HistoryResults
from edesign.study.analysis.residual import period_steps
from edesign.study.analysis.structure import Structure, make_frame, make_structure
from edesign.substructure.structure.numerical import LinearPart

GROWTH = 1e-9
"""Of a step, that rounding errors make."""
DEFORMATION, FORCE, WORK = (f"{what} of the specimen" for what in ("deformation", "force", "work"))
"""Channels that are recorded beside those of a history."""


def loop_grows(part: LinearPart, specimen: tuple[float, float], step: float, held: bool) -> bool:
    """Return whether small vibrations grow in the loop of an implicit frame, its specimen, and an ideal rig.

    Newmark's constant average acceleration, with the force of the specimen at the end of the step extrapolated or held.
    The rig moves the specimen in ramps.

    Args:
        part: the frame's tangent under gravity, of n degrees.
        specimen: a spring and a dashpot, N/m and N s/m.
        step: main step, s.
        held: whether the force is held over a step.
    """
    n, h = len(part.names), step
    inverse = np.linalg.inv(part.mass)
    at_end = np.linalg.inv(part.mass + 0.5 * h * part.damping + 0.25 * h**2 * part.stiffness)
    unit = np.eye(2 * n + 2)
    u, v, before, position = unit[:n], unit[n : 2 * n], unit[2 * n], unit[2 * n + 1]
    moved = part.interface @ u
    force = specimen[0] * moved + specimen[1] / h * (moved - position)
    ahead = force if held else 2.0 * force - before
    a0 = -inverse @ (part.damping @ v + part.stiffness @ u + np.outer(part.interface, force))
    going = u + h * v + 0.25 * h**2 * a0, v + 0.5 * h * a0
    a1 = -at_end @ (part.stiffness @ going[0] + part.damping @ going[1] + np.outer(part.interface, ahead))
    whole = np.vstack([going[0] + 0.25 * h**2 * a1, going[1] + 0.5 * h * a1, force, moved])
    return float(np.max(np.abs(np.linalg.eigvals(whole)))) > 1.0 + GROWTH


def _of_specimen(channel: Channel, number: int) -> Channel:
    """A channel in whose terms the damper of this number, which the frame does not have, is the given force."""
    terms = tuple(
        (factor, kind.replace("damper_", "given_"), 0, 0) if kind.startswith("damper_") and item == number else term
        for term in channel.terms
        for factor, kind, item, _ in (term,)
    )
    return replace(channel, terms=terms)


@dataclass(frozen=True)
class _Ready:
    """A frame in the state in which tests begin, and its fundamental period under gravity, s."""

    structure: Structure
    state: np.ndarray
    period: float


@dataclass(frozen=True)
class FrameResponse:
    """Response of the frame at main steps.

    Attributes:
        group: what a history of the project would archive.
        drift: (n, n_storeys) drift ratio of each storey.
        deformation, force: (n,) of the damper as the frame meets it, m and N.
    """

    group: Group
    drift: np.ndarray
    deformation: np.ndarray
    force: np.ndarray


@dataclass(frozen=True, eq=False)
class ProjectFrame:
    """The frame of a project of which one damper stands in the laboratory: without it, or with it in the frame.

    Attributes:
        project: the validated project; its `integration` is that of the frame.
        device: the damper in the laboratory.
        law, scales: of it in the tests, and of its force and deformation.
        collapse_drift: drift ratio at which a history ends as collapsed; None: there is none.
        histories: what is kept of a response over time.
    """

    project: Project
    device: Device
    law: LawValues
    scales: tuple[float, float]
    collapse_drift: float | None = None
    histories: tuple[HistoryKind, ...] = ()
    _ready: list[_Ready] = field(default_factory=list)

    def numerical_part(
        self, force: Literal["extrapolated", "held"], steps: int = 1, record: bool = True
    ) -> FrameNumericalPart:
        """Return the frame without the damper; all parts share one analysis.

        Args:
            force: of the specimen over a main step.
            steps: of the frame in a main step.
            record: whether it records what `tested` evaluates.

        Raises:
            InputError: the project has no `integration`, or the frame cannot be built.
            AnalysisError: no equilibrium under gravity, or no modes for the damping.
            CoreError: the frame is a mechanism without the damper.
        """
        if not self._ready:
            self._ready.append(self._prepared(inside=False))
        ready = self._ready[0]
        analysis = ready.structure.analysis
        analysis.restore(ready.state)
        results, own = self._recorded(ready.structure.frame)
        number = ready.structure.frame.devices[-1].number
        channels = [_of_specimen(channel, number) for channel in (*results.channels, *own)] if record else []
        limits = results.limits if record else {}
        assert self.project.integration is not None
        method = integrator(self.project.integration)
        return FrameNumericalPart(analysis, self.device.terms, tuple(channels), limits, method, force, steps)

    def tested(self, found: Response, ground: np.ndarray, step: float) -> FrameResponse:
        """Return the response of the frame in a test.

        The work that the frame does on the specimen is one of its dampers' there, and no input less, as it is with the
        damper in the frame.

        Args:
            found: what `numerical_part` recorded.
            ground: (n,) ground acceleration at main steps, m/s2.
            step: main step, s.
        """
        work = found.values[WORK]
        energy = {**found.energy, "input": found.energy["input"] + work, "dampers": found.energy["dampers"] + work}
        balance = EnergyBalance()
        balance.count(energy["input"], energy["residual"])
        error = balance.error(self._ready[0].structure.analysis.tolerance)
        final = {term: float(values[-1]) for term, values in energy.items() if values.size}
        statistics = {**found.statistics, "energy_error": error}
        found = replace(found, energy=energy, energy_final=final, statistics=statistics)
        return self._response(self._ready[0], found, ground, step, 1)

    def direct(self, ground: np.ndarray, step: float, every: int = 1) -> FrameResponse:
        """Return the response of the frame with the damper in it, without laboratory.

        Args:
            ground: (n,) ground acceleration at steps, m/s2.
            step: s.
            every: so many steps from one instant of the response to the next.

        Raises:
            AnalysisError: equilibrium was lost, or the result does not count; the message says when and why.
        """
        ready = self._prepared(inside=True)
        results, own = self._recorded(ready.structure.frame)
        assert self.project.integration is not None
        method = integrator(self.project.integration)
        found = ready.structure.analysis.history(
            ground,
            step,
            method,
            [*results.channels, *own],
            every,
            limits=results.limits,
            tail=period_steps(step, ready.period),
            energies=results.energies,
        )
        response = self._response(ready, found, ground, step, every)
        if response.group.attributes["status"] != "completed":
            reason = response.group.attributes["reason"]
            raise AnalysisError(f"{self.project.path}: the frame with {self.device.name} in it: {reason} [E-PART-04]")
        return response

    def _recorded(self, frame: FrameModel) -> tuple[HistoryResults, list[Channel]]:
        """What a history of the frame records, and the damper in any case."""
        number = frame.devices[-1].number
        kinds = {DEFORMATION: "damper_deformation", FORCE: "damper_force", WORK: "damper_work"}
        own = [Channel(name, ((1.0, kind, number, 0),)) for name, kind in kinds.items()]
        kept = self.collapse_drift, self.histories
        return HistoryResults(self.project, frame, *kept, keep_drift=True, watched=False), own

    def _response(self, ready: _Ready, found: Response, ground: np.ndarray, step: float, every: int) -> FrameResponse:
        results, _ = self._recorded(ready.structure.frame)
        group = results.group(found, (ground,), step, ready.period, every)
        group.attributes["height"] = self.project.grid.height
        return FrameResponse(group, results.drift(found), found.values[DEFORMATION], found.values[FORCE])

    def _prepared(self, inside: bool) -> _Ready:
        """The frame under gravity, damped, its dampers installed; the specimen is the last of them, inside or not."""
        if self.project.integration is None:
            raise InputError(f"{self.project.path}: a frame that may yield needs `integration` [E-KEY-02]")
        frame = make_frame(self.project, dampers=True, outside=(self.device.name,))
        force, deformation = self.scales
        name, law, number = self.device.name, self.law, len(frame.model.damper_names)
        if inside:
            frame.model.damper(name, law, self.device.terms, force_scale=force, deformation_scale=deformation)
        tested = self.device.tested_strain if law == self.device.values else None
        device = replace(
            self.device,
            number=number,
            values=law,
            force_scale=force,
            deformation_scale=deformation,
            tested_strain=tested,
        )
        structure = make_structure(self.project, replace(frame, devices=(*frame.devices, device)))
        period = load_and_damp(self.project, structure)
        return _Ready(structure, structure.analysis.state(), period)
