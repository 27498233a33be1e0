"""What a history of a frame records, and the group of an archive that becomes of it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.energy import BEFORE
from edesign.core import ENERGIES, Channel, Response
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.buckling import buckling_warnings
from edesign.study.analysis.collapse import collapse_reason, drift_limits
from edesign.study.analysis.dampers import core_strain_warnings, strain_warnings
from edesign.study.analysis.footings import footing_quantities
from edesign.study.analysis.residual import DEFINITION, residual
from edesign.study.results.braces import brace_quantities, fracture_warnings
from edesign.study.results.coordinates import bending_members, coordinates
from edesign.study.results.couples import LackingCouples
from edesign.study.results.dampers import damper_quantities, tuned_mass_displacements
from edesign.study.results.floors import (
    base_acceleration,
    base_displacement,
    base_rotation,
    diaphragm_motions,
    floor_accelerations,
    floor_displacements,
    floor_relative_accelerations,
    floor_rotations,
    point_motions,
)
from edesign.study.results.member_use import run_watch
from edesign.study.results.members import axial_forces, leaning_column_forces, member_forces, plastic_rotations
from edesign.study.results.motion import node_displacements, store_motion, without_histories
from edesign.study.results.recording import SINGLE, Quantity, channels, coordinate, directed, store, store_run
from edesign.study.results.requested import requested_quantities
from edesign.study.results.resultants import Resultants
from edesign.study.results.springs import hinge_warnings, spring_quantities
from edesign.study.results.storeys import (
    by_line,
    drifts_in_words,
    line_drifts,
    store_drift_extremes,
    store_mean_drifts,
    storey_drifts,
    storey_shears,
    storey_torques,
)
from edesign.study.results.supports import base_shear, isolator_axial_forces, isolator_displacements, support_reactions
from edesign.study.results.validity import judged, rotation_limits, rotation_names
from edesign.study.results.warnings import store_warnings
from edesign.study.results.watch import StepWatch

MOVING = ("node_displacement", "column_plastic_rotation", "beam_plastic_rotation")  # what `motion` keeps


class HistoryResults:
    """The recorded quantities of one history of a frame, and their evaluation.

    Args:
        project: whose `outputs` and `validity` are asked.
        collapse_drift: drift ratio at which the history ends as collapsed; None: there is none.
        histories: what is kept over time; None: what the project says.
        keep_drift: whether the drift of the storeys is kept over time in any case.
        watched: whether the history is watched, for the use of members and the reactions of supports.

    Attributes:
        channels: for the core. Displacements and drifts have a tail, for the residual response.
        energies: whether energies are kept over time.
        limits: at which the history ends, by name of a channel.
        watch: sees every step of the history: the use of members, reactions of supports.

    Raises:
        InputError: a requested output does not exist.
    """

    def __init__(
        self,
        project: AnalysisFile,
        frame: FrameModel,
        collapse_drift: float | None = None,
        histories: Collection[HistoryKind] | None = None,
        keep_drift: bool = False,
        watched: bool = True,
    ) -> None:
        self._project, self._frame, self._group = project, frame, Group()
        self.watch = run_watch(project, frame) if watched else StepWatch(())
        coordinates(self._group, frame)
        self._wanted = project.outputs.histories if histories is None else histories
        floors, storeys, supports = (kind in self._wanted for kind in ("floors", "storeys", "supports"))
        self.energies = "energy" in self._wanted
        self._displacements = replace(floor_displacements(frame, floors), tail=True)
        self._drift = replace(storey_drifts(frame, storeys), tail=True)
        self._drifts = replace(line_drifts(frame), tail=frame.model.dimension == 3)
        self._base = base_displacement(frame, floors)
        others = [
            floor_accelerations(frame, floors),
            floor_relative_accelerations(frame),
            *floor_rotations(frame, floors),
            *diaphragm_motions(frame, self._group, floors, accelerations=True),
            *point_motions(frame, self._group, floors),
            storey_shears(frame, storeys),
            *storey_torques(frame, storeys),
            base_shear(frame, storeys),
            *member_forces(frame, bending_members(frame), "member", history=False),
            *axial_forces(frame),
            *leaning_column_forces(frame),
            *plastic_rotations(frame, "motion" in self._wanted),
            *brace_quantities(frame, self._group),
            *spring_quantities(frame, self._group),
            *footing_quantities(frame, self._group),
            *damper_quantities(frame, "dampers" in self._wanted),
            *tuned_mass_displacements(frame, floors),
            *base_acceleration(frame, floors),
            *base_rotation(frame, floors),
            *isolator_displacements(frame, "dampers" in self._wanted),
            *isolator_axial_forces(frame),
            *(support_reactions(frame, self._group, supports) if watched or supports else ()),
            *requested_quantities(project, frame, self._group),
        ]
        self._others = self.watch.watching(others)
        self._couples = LackingCouples(frame)
        self._moving: list[Quantity] = []
        if "motion" in self._wanted:
            self._others.append(node_displacements(frame, self._group))
            self._moving = [one for one in self._others if one.name in MOVING and one.history]
        self._names = rotation_names(frame, self._drifts, self._others)
        drift = replace(self._drift, history=storeys or keep_drift)
        kept = [self._displacements, drift, *self._base, *self._others]
        self._resultants = Resultants(kept)
        self.channels: list[Channel] = channels([*kept, self._drifts, *self._couples.quantities])
        self.channels += self._resultants.channels()
        self.limits = rotation_limits(project, self._names) | drift_limits(self._drifts, collapse_drift)

    def drift(self, response: Response) -> np.ndarray:
        """Return the drift ratios of the storeys over time, (nt, storeys), if `keep_drift` was asked for."""
        return self._drift.values(response)

    def group(
        self, response: Response, acceleration: Sequence[np.ndarray], time_step: float, period: float, every: int
    ) -> Group:
        """Return the results of the history; it may be called once.

        Args:
            response: with `channels`, and a tail of a fundamental period at least.
            acceleration: of the ground at each step in each direction, (directions,) of (nt,) m/s2.
            time_step: s.
            period: fundamental period under gravity, for residual values, s.
            every: one step in so many was kept over time.
        """
        group, frame = self._group, self._frame
        group.attributes["fundamental_period_s"] = period
        response, energy_warnings = judged(response, self._project, self._names)
        reason = "" if energy_warnings is None else collapse_reason(response, self._drifts, drifts_in_words(frame))
        if reason:
            response = replace(response, status="failed", reason=reason)
            group.attributes["collapsed"] = True
        coordinate(group, "time", response.time, "s", "time from the start of the record")
        dims, shape = directed(frame)
        samples = np.stack(acceleration, axis=-1)[::every][: response.time.size].reshape(-1, *shape)
        group.add("ground_acceleration", ("time", *dims), samples, "m/s^2", "ground acceleration as applied")
        others = without_histories(self._others, self._moving)
        store(group, [self._displacements, self._drift, *self._base, *others], response, "time", SINGLE)
        if self._moving:
            store_motion(group, self._moving, response)
        self._resultants.store(group, response)
        self.watch.store(group, "time", "s")
        store_drift_extremes(group, frame, self._drifts, response)
        store_mean_drifts(group, self._drift, response)
        warnings = buckling_warnings(group, frame)
        if "damper_strain_max" in group.variables:
            largest, least = (group.variables[f"damper_strain_{which}"].values for which in ("max", "min"))
            warnings += strain_warnings(frame.devices, np.maximum(largest, -least))
        warnings += core_strain_warnings(group, frame.devices)
        warnings += fracture_warnings(group) + hinge_warnings(group, frame)
        warnings += self._couples.warnings(response)
        store_warnings(group, [] if energy_warnings is None else [*energy_warnings, *warnings])
        _store_energy(group, response, self.energies)
        if response.status == "completed":
            floors, drift = (quantity.last_values(response) for quantity in (self._displacements, self._drift))
            store_residuals(group, floors, drift, time_step, period)
            if frame.model.dimension == 3:
                lines = by_line(frame, residual(self._drifts.last_values(response), time_step, period))
                label = f"residual drift ratio of the storey on the column line: {DEFINITION}"
                group.add("residual_line_drift", ("drift_line", "direction"), lines, "1", label)
            for base in self._base:
                left = residual(base.last_values(response), time_step, period)
                label = f"residual displacement of the isolated base: {DEFINITION}"
                group.add("residual_base_displacement", base.dims, left, "m", label)
        store_run(group, response, "time", "s")
        return group


def store_residuals(
    group: Group, floors: np.ndarray, drifts: np.ndarray | None, time_step: float, period: float
) -> None:
    """Add the residual values of a completed history to its group.

    Args:
        floors: (nt, floors) displacements at every step, or in the last ones, m; of buildings (nt, floors, directions).
        drifts: of the storeys likewise, ratios; None: heights are not known.
        time_step: s.
        period: fundamental period under gravity, s.
    """
    left = residual(floors, time_step, period)
    along = ("direction",) * (left.ndim - 1)
    label = f"residual displacement of the floor: {DEFINITION}"
    group.add("residual_floor_displacement", ("floor", *along), left, "m", label)
    group.add("residual_roof_displacement", along, left[-1], "m", f"residual roof displacement: {DEFINITION}")
    if drifts is not None:
        label = f"residual drift ratio of the storey: {DEFINITION}"
        group.add("residual_storey_drift", ("storey", *along), residual(drifts, time_step, period), "1", label)


def _store_energy(group: Group, response: Response, history: bool) -> None:
    coordinate(group, "energy_term", ENERGIES, "", "term of the energy balance")
    before = np.array([response.energy_start.get(term, 0.0) for term in ENERGIES])
    if history:
        table = np.array([response.energy[term] for term in ENERGIES]).T - before
        group.add("energy", ("time", "energy_term"), table, "J", "energy since the start of the record")
    if response.energy_final:
        final = np.array([response.energy_final[term] for term in ENERGIES]) - before
        group.add("energy_final", ("energy_term",), final, "J", "energy since the start of the record, at the end")
        group.add(
            BEFORE, ("energy_term",), before, "J", "energy before the record, which the others leave out: gravity"
        )
