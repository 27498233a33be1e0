"""Column bases, and walls of a basement, that the ground motion reaches one after the other."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import SupportMotion
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.delayed import delayed_by
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.study.motions.applied import GroundMotion
from edesign.study.results.recording import coordinate, directed
from edesign.study.results.warnings import AnalysisWarning, store_warnings

LASTING = 0.01
"""Share of the largest displacement between supports that may be left; rounding of records brings less."""


class DelayedSupports:
    """The displacements of the supports of a frame under wave passage, relative to the support that it reaches first.

    Attributes:
        motions: of the supports, for the core; none of those without delay.
    """

    def __init__(self, spec: HistoryAnalysis, frame: FrameModel, ground: GroundMotion) -> None:
        self.motions: list[SupportMotion] = []
        self._delays: dict[str, float] = {}
        self._moved: dict[str, list[np.ndarray]] = {}
        if spec.wave_passage is None:
            return
        delays = spec.wave_passage.delays_of(frame.grid)
        levels = range(len(frame.floors) + 1)
        of_nodes = {frame.grid.node_name(line, at): delay for line, delay in delays.items() for at in levels}
        horizontal = (ground.horizontal, ground.across)[: len(frame.directions)]
        for support in frame.supports:
            if support not in of_nodes:
                tied = _tied(frame, support, of_nodes)
                self._delays[support] = float(np.mean(list(tied.values())))
                self._moved[support] = self._add_floor(frame, support, tied, ground)
                continue
            delay = self._delays[support] = of_nodes[support]
            self._moved[support] = [
                self._add(frame, support, direction.degree, record, delay)
                for direction, record in zip(frame.directions, horizontal, strict=True)
            ]
            self._add(frame, support, frame.up, ground.vertical, delay)

    def _add(self, frame: FrameModel, support: str, at: int, record: Record | None, delay: float) -> np.ndarray:
        """Let a degree of a support move late; returns its displacement, (nt,) m, or nothing where it does not."""
        if delay == 0.0 or record is None or not frame.supports[support][at]:
            return np.zeros(1)
        samples = delayed_by(record.acceleration, record.time_step, delay)
        grounds = frame.grounds.get(support)
        on_spring = None if grounds is None else grounds[at]
        node = frame.nodes[support] if on_spring is None else on_spring
        self.motions.append(SupportMotion(node, frame.model.degrees[at], (samples[0], samples[1], samples[2])))
        return np.asarray(samples[0])

    def _add_floor(
        self, frame: FrameModel, support: str, delays: Mapping[str, float], ground: GroundMotion
    ) -> list[np.ndarray]:
        """Let a rigid floor move as the body that is nearest to the ground at its column lines, by least squares.

        Returns the displacements of its centre of mass, (nt,) m each.
        """
        still = np.zeros((3, ground.horizontal.acceleration.size))
        late = np.array(
            [
                [still if one is None else delayed_by(one.acceleration, one.time_step, delay) for one in pair]
                for delay, pair in ((delay, (ground.horizontal, ground.across)) for delay in delays.values())
            ]
        )
        plan = np.array([frame.places[name][:2] for name in delays])
        (x, y), (x_m, y_m) = (plan - plan.mean(axis=0)).T, np.array(frame.places[support][:2]) - plan.mean(axis=0)
        fixed = dict(zip(frame.model.degrees, frame.supports[support], strict=True))
        arms = np.array([-y, x]).T * ([fixed["ux"], fixed["uy"]] if fixed["ux"] or fixed["uy"] else [True, True])
        turn = np.tensordot(arms, late, 2) / np.sum(arms**2)
        ux, uy = late.mean(axis=0)
        moved = {"ux": ux - turn * y_m, "uy": uy + turn * x_m, "rz": turn}
        for degree, (u, v, a) in moved.items():
            if fixed[degree] and np.any(u):
                self.motions.append(SupportMotion(frame.nodes[support], degree, (u, v, a)))
        return [moved[degree][0] if fixed[degree] else np.zeros(1) for degree in ("ux", "uy")]

    def store(self, group: Group, frame: FrameModel) -> None:
        """Add delays, and horizontal displacements of the ground under the supports, to the group of a history."""
        if not self._delays:
            return
        coordinate(group, "foot", list(self._delays), "", "name of the node at the base")
        group.add("foot_delay", ("foot",), list(self._delays.values()), "s", "by which the ground motion comes later")
        label = "horizontal displacement of the ground at the support relative to the motion without delay"
        dims, shape = directed(frame)
        largest = np.array([[float(np.abs(along).max()) for along in moved] for moved in self._moved.values()])
        left = np.array([[float(along[-1]) for along in moved] for moved in self._moved.values()])
        for name, values, what in (("largest", largest, "largest magnitude"), ("final", left, "at the end")):
            group.add(f"foot_displacement_{name}", ("foot", *dims), values.reshape(-1, *shape), "m", f"{label}, {what}")
        apart, most = float(np.abs(left).max()), float(largest.max())
        if apart > LASTING * most:
            text = (
                f"supports stay {1e3 * apart:.3g} mm apart after the wave, since the record ends with a velocity; use "
                "one whose baseline is corrected"
            )
            store_warnings(group, [AnalysisWarning("feet_apart", text, apart / (LASTING * most))])


def _tied(frame: FrameModel, master: str, delays: Mapping[str, float]) -> dict[str, float]:
    """Return the delays at the nodes on column lines that a master takes along."""
    nodes = {name for name, node in frame.nodes.items() if frame.model.masters.get(node) == frame.nodes[master]}
    return {name: delay for name, delay in delays.items() if name in nodes}
