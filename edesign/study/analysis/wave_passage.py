"""Column bases that the ground motion reaches one after the other."""

from __future__ import annotations

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

    Args:
        ground: what is applied.

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
        at_base = {frame.grid.node_name(line, 0): delay for line, delay in delays.items()}
        self._delays = {support: at_base[support] for support in frame.supports}
        horizontal = (ground.horizontal, ground.across)[: len(frame.directions)]
        for support, delay in self._delays.items():
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
