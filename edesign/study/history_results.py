"""What a history of a frame records, and the group of an archive that becomes of it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.frame import FrameModel
from edesign.core import Channel, Response
from edesign.project.outputs import HistoryKind
from edesign.project.project import Project
from edesign.study import quantities as q
from edesign.study.buckling import buckling_warnings
from edesign.study.collapse import collapse_reason, drift_limits
from edesign.study.dampers import strain_warnings
from edesign.study.recording import channels, coordinate, store, store_run
from edesign.study.requested import requested_quantities
from edesign.study.residual import DEFINITION, residual
from edesign.study.validity import judged, rotation_limits, rotation_names
from edesign.study.warnings import store_warnings


class HistoryResults:
    """What one history of a frame records, and its evaluation.

    Args:
        project: whose `outputs` and `validity` are asked.
        frame: the model.
        collapse_drift: drift ratio at which the history ends as collapsed; None: there is none.
        histories: what is kept over time; None: what the project says.

    Attributes:
        channels: for the core. Every step is recorded, whatever is kept later: the residual response does not depend on
            what is kept.
        limits: at which the history ends, by name of a channel.

    Raises:
        InputError: a requested output does not exist.
    """

    def __init__(
        self,
        project: Project,
        frame: FrameModel,
        collapse_drift: float | None = None,
        histories: Collection[HistoryKind] | None = None,
    ) -> None:
        self._project, self._frame, self._group = project, frame, Group()
        q.coordinates(self._group, frame)
        self._wanted = project.outputs.histories if histories is None else histories
        floors, storeys = "floors" in self._wanted, "storeys" in self._wanted
        self._displacements = q.floor_displacements(frame, history=True)
        self._drift, self._drifts = q.storey_drifts(frame, history=True), q.line_drifts(frame)
        self._others = [
            q.floor_accelerations(frame, floors),
            q.floor_relative_accelerations(frame),
            q.storey_shears(frame, storeys),
            q.base_shear(frame, storeys),
            *q.member_forces(frame, q.bending_members(frame), "member", history=False),
            *q.axial_forces(frame),
            *q.plastic_rotations(frame),
            *q.dampers(frame, "dampers" in self._wanted),
            *requested_quantities(project, frame, self._group),
        ]
        self._names = rotation_names(frame, self._drifts, self._others)
        self.channels: list[Channel] = channels([self._displacements, self._drift, self._drifts, *self._others])
        self.limits = rotation_limits(project, self._names) | drift_limits(self._drifts, collapse_drift)

    def floors(self, response: Response) -> np.ndarray:
        """Return the displacements of the floors at every step, (nt, floors) m."""
        return self._displacements.values(response)

    def drift(self, response: Response) -> np.ndarray:
        """Return the drift ratios of the storeys at every step, (nt, storeys)."""
        return self._drift.values(response)

    def group(self, response: Response, acceleration: np.ndarray, time_step: float, period: float, every: int) -> Group:
        """Return the results of the history, once.

        Args:
            response: with `channels` of every step.
            acceleration: of the ground at each step, m/s2.
            time_step: s.
            period: fundamental period under gravity, for residual values, s.
            every: one step in so many is kept over time.
        """
        group, frame = self._group, self._frame
        group.attributes["fundamental_period_s"] = period
        response, doubts = judged(response, self._project, self._names)
        reason = "" if doubts is None else collapse_reason(response, self._drifts, q.line_drift_storeys(frame))
        if reason:
            response = replace(response, status="failed", reason=reason)
            group.attributes["collapsed"] = True
        coordinate(group, "time", response.time[::every], "s", "time from the start of the record")
        samples = acceleration[: response.time.size : every]
        group.add("ground_acceleration", ("time",), samples, "m/s^2", "ground acceleration as applied")
        displacements, drift = (
            replace(self._displacements, history="floors" in self._wanted),
            replace(self._drift, history="storeys" in self._wanted),
        )
        store(group, [displacements, drift, *self._others], response, "time", every)
        q.store_drift_extremes(group, frame, self._drifts, response)
        warnings = buckling_warnings(group, self._project, frame)
        if "damper_strain_max" in group.variables:
            largest, least = (group.variables[f"damper_strain_{which}"].values for which in ("max", "min"))
            warnings += strain_warnings(frame.devices, np.maximum(largest, -least))
        store_warnings(group, [] if doubts is None else [*doubts, *warnings])
        _store_energy(group, response, every, "energy" in self._wanted)
        if response.status == "completed":
            store_residuals(group, self.floors(response), self.drift(response), time_step, period)
        store_run(group, response, "time", "s")
        return group


def store_residuals(
    group: Group, floors: np.ndarray, drifts: np.ndarray | None, time_step: float, period: float
) -> None:
    """Add the residual values of a completed history to its group.

    Args:
        group: of the history.
        floors: (nt, floors) displacements at every step, m.
        drifts: (nt, storeys) ratios; None: heights are not known.
        time_step: s.
        period: fundamental period under gravity, s.
    """
    left = residual(floors, time_step, period)
    label = f"residual displacement of the floor: {DEFINITION}"
    group.add("residual_floor_displacement", ("floor",), left, "m", label)
    group.add("residual_roof_displacement", (), left[-1], "m", f"residual roof displacement: {DEFINITION}")
    if drifts is not None:
        label = f"residual drift ratio of the storey: {DEFINITION}"
        group.add("residual_storey_drift", ("storey",), residual(drifts, time_step, period), "1", label)


def _store_energy(group: Group, response: Response, every: int, history: bool) -> None:
    terms = list(response.energy)
    table = np.array([response.energy[term] for term in terms]).T
    coordinate(group, "energy_term", terms, "", "term of the energy balance")
    if history:
        group.add("energy", ("time", "energy_term"), table[::every], "J", "energy since the start of the record")
    if table.size:
        group.add("energy_final", ("energy_term",), table[-1], "J", "energy at the end")
