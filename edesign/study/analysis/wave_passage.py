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
from edesign.study.results.recording import coordinate
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
        self._moved: dict[str, np.ndarray] = {}
        if spec.wave_passage is None:
            return
        grid = frame.grid
        delays = spec.wave_passage.delays_of({line: grid.line_place(line)[0] for line in grid.lines})
        at_base = {grid.node_name(line, 0): delay for line, delay in delays.items()}
        self._delays = {support: at_base[support] for support in frame.supports}
        for support, delay in self._delays.items():
            self._moved[support] = np.zeros(1)
            if delay > 0.0:
                self._add(frame, support, 0, "ux", ground.horizontal, delay)
                if ground.vertical is not None:
                    self._add(frame, support, 1, "uy", ground.vertical, delay)

    def _add(self, frame: FrameModel, support: str, at: int, degree: str, record: Record, delay: float) -> None:
        if not frame.supports[support][at]:
            return
        samples = delayed_by(record.acceleration, record.time_step, delay)
        on_spring = frame.grounds.get(support, (None, None, None))[at]
        node = frame.nodes[support] if on_spring is None else on_spring
        self.motions.append(SupportMotion(node, degree, (samples[0], samples[1], samples[2])))
        if at == 0:
            self._moved[support] = samples[0]

    def store(self, group: Group) -> None:
        """Add delays, and horizontal displacements of the ground under the supports, to the group of a history."""
        if not self._delays:
            return
        coordinate(group, "foot", list(self._delays), "", "name of the node at the base")
        group.add("foot_delay", ("foot",), list(self._delays.values()), "s", "by which the ground motion comes later")
        label = "horizontal displacement of the ground at the support relative to the motion without delay"
        largest = [float(np.abs(moved).max()) for moved in self._moved.values()]
        left = [float(moved[-1]) for moved in self._moved.values()]
        group.add("foot_displacement_largest", ("foot",), largest, "m", f"{label}, largest magnitude")
        group.add("foot_displacement_final", ("foot",), left, "m", f"{label}, at the end")
        apart = max(abs(value) for value in left)
        if apart > LASTING * max(largest):
            text = (
                f"supports stay {1e3 * apart:.3g} mm apart after the wave, since the record ends with a velocity; use "
                "one whose baseline is corrected"
            )
            store_warnings(group, [AnalysisWarning("feet_apart", text, apart / (LASTING * max(largest)))])
