"""Extremes of the bending moments inside the columns and beams of a plane frame, found while the run goes on."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis_file import AnalysisFile
from edesign.space.analysis.response import STATIONS
from edesign.study.results.checked_members import loads_inside
from edesign.study.results.coordinates import bending_members
from edesign.study.results.recording import SINGLE, Quantity, coordinate


class MomentEnvelope:
    """The largest and smallest internal moment of columns and beams at stations, over the steps of a run.

    Those of both ends do not come together, so that their extremes do not give the ones between them. In each step the
    moment is a line between the ends, plus what gravity loads inside add. It is positive as in the middle of a beam
    under loads downwards: that of a column stretches its right side.

    Args:
        file: with the loads of the gravity combination.
        frame: in plane.
    """

    needs: tuple[str, ...] = ("member_bending_moment",)
    own: tuple[Quantity, ...] = ()

    def __init__(self, file: AnalysisFile, frame: FrameModel) -> None:
        self._loads = loads_inside(file, frame, [member.name for member in bending_members(frame)])[0][..., 0]
        self._max = np.full(self._loads.shape, -np.inf)
        self._min = np.full(self._loads.shape, np.inf)

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps; see `Observer`."""
        moments = values[self.needs[0]].reshape(len(abscissas), -1, 2)
        start, end = np.ascontiguousarray(moments[..., 0]), moments[..., 1]  # inside: share end - (1 - share) start
        both, inside = start + end, np.empty_like(start)
        for k, share in enumerate(STATIONS):
            np.multiply(both, share, out=inside)
            inside -= start
            np.maximum(self._max[:, k], inside.max(axis=0), out=self._max[:, k])
            np.minimum(self._min[:, k], inside.min(axis=0), out=self._min[:, k])

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the extremes to the group; see `Observer`."""
        coordinate(group, "station", STATIONS, "1", "place on the member over its length from the start")
        for word, name, values in (("largest", "max", self._max), ("smallest", "min", self._min)):
            label = f"internal moment of the member, positive as under loads downwards, {word} value"
            values = (values + self._loads).astype(SINGLE)
            group.add(f"member_moment_inside_{name}", ("member", "station"), values, "N*m", label)
