"""The linear response of a frame or building to a response spectrum, with any of the dampers of its candidates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from edesign.study.analysis.structure import Structure
from edesign.study.design.building import mode_shears
from edesign.study.design.condensed import CondensedFrame, LinearModes, condense
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.estimate import Action, SpectralPeaks, spectral_peaks


@dataclass(frozen=True)
class Peaks:
    """Peaks of the modes by direction of the ground motion."""

    by_direction: tuple[SpectralPeaks, ...]

    def combined(self, values: np.ndarray) -> np.ndarray:
        """Return the largest values over time, of directions by the square root of the sum of squares.

        Args:
            values: values of all modes at unit generalised displacement, (n, x).
        """
        found = [peaks.combined(values) for peaks in self.by_direction]
        return found[0] if len(found) == 1 else np.sqrt(np.sum(np.square(found), axis=0))


@dataclass(frozen=True)
class LinearResponse:
    """A frame without the stiffness of dampers, shaken in each of its directions.

    Attributes:
        frames: condensed, by direction.
        action: the spectrum, and the damping of the frame without dampers.
        heights: of the storeys, m.
        of_frames: by direction the numbers of the column lines of each plane frame of a building along it.
    """

    frames: tuple[CondensedFrame, ...]
    action: Action
    heights: np.ndarray
    of_frames: tuple[tuple[np.ndarray, ...], ...]

    @property
    def count(self) -> int:
        """The number of the responses of `largest`."""
        return 3 if len(self.frames) == 1 else 3 * (1 + len(self.frames)) + sum(map(len, self.of_frames))

    def with_devices(self, rows: np.ndarray) -> LinearResponse:
        """Return the frame with some of its dampers' places."""
        return replace(self, frames=tuple(_with_devices(frame, rows) for frame in self.frames))

    def leading_frequencies(self) -> tuple[float, ...]:
        """Return the frequency of the mode that leads without dampers in each direction, Hz."""
        return tuple(frame.modes().first_frequency for frame in self.frames)

    def vibration(self, stiffness: np.ndarray, direction: int = 0) -> tuple[LinearModes, Peaks]:
        """Return all natural modes with dampers, and their peaks under the action in each direction.

        Args:
            stiffness: complex, of each damper with its brace, (d,) N/m.
            direction: of the floors and column lines of the modes.

        Raises:
            AnalysisError: a squared frequency is not positive.
        """
        modes = self.frames[direction].modes(stiffness.real)
        added = strain_energy_damping(modes, stiffness)
        peaks = []
        for axis, frame in enumerate(self.frames):
            own = modes if axis == direction else replace(modes, participation=_participation(frame, modes))
            peaks.append(spectral_peaks(frame, self.action, own, added))
        return modes, Peaks(tuple(peaks))

    def largest(self, stiffness: np.ndarray) -> np.ndarray:
        """Return the largest storey drift over height, floor acceleration in m/s2 and base shear in N.

        In a building those of the worse direction are followed by those along each direction, where the drift is that
        of the worst column line, and by the drifts of each plane frame along itself.

        Args:
            stiffness: complex, of each damper with its brace, (d,) N/m.
        """
        along, of_frames = [], []
        for axis, frame in enumerate(self.frames):
            modes, peaks = self.vibration(stiffness, axis)
            accelerations = peaks.combined(modes.omega[:, None] ** 2 * modes.floors)
            shear = peaks.combined(mode_shears(frame, modes)[:, :1])
            if frame.plan is None:
                drifts = peaks.combined(modes.storeys) / self.heights
            else:
                drifts = peaks.combined(modes.lines)
                of_frames += [drifts[lines].max() for lines in self.of_frames[axis]]
            along.append([drifts.max(), accelerations.max(), shear[0]])
        if len(along) == 1:
            return np.array(along[0])
        return np.concatenate([np.max(along, axis=0), np.ravel(along), of_frames])


def linear_response(
    structure: Structure, action: Action, beside: Mapping[str, complex] = MappingProxyType({})
) -> LinearResponse:
    """Return the linear response of a structure in its present state, with its dampers' places.

    Args:
        structure: under gravity or not.
        action: the spectrum, and the damping of the frame without dampers.
        beside: complex stiffness, N/m, by name, of dampers that are no candidates but stand in it.

    Raises:
        AnalysisError: nothing has a mass, or the stiffness is singular.
    """
    model = structure.frame
    of_frames: list[dict[str, list[int]]] = [{} for _ in model.directions]
    for axis, numbers in enumerate(of_frames):
        lines = [line for storey in model.storeys for line in storey.drifts[axis]]
        for number, line in enumerate(lines):
            for frame in line.frames:
                numbers.setdefault(frame, []).append(number)
    return LinearResponse(
        tuple(condense(structure, axis, beside) for axis in range(len(model.directions))),
        action,
        np.array([storey.height for storey in model.storeys]),
        tuple(tuple(np.array(one) for one in numbers.values()) for numbers in of_frames),
    )


def _participation(frame: CondensedFrame, modes: LinearModes) -> np.ndarray:
    """Participation of modes for ground motion in the direction of a condensed frame, (n,) sqrt(kg)."""
    return np.asarray(modes.masses @ (frame.mass * frame.influence))


def _with_devices(frame: CondensedFrame, rows: np.ndarray) -> CondensedFrame:
    """The condensed frame with some of its dampers' places."""
    plan = frame.plan
    if plan is not None:
        plan = replace(plan, line_B=plan.line_B[:, rows], storey_B=plan.storey_B[:, rows])
    others = None if frame.beside is None else replace(frame.beside, C=frame.beside.C[:, rows])
    frame = replace(frame, beside=others)
    return replace(frame, B=frame.B[rows], C=frame.C[np.ix_(rows, rows)], floor_B=frame.floor_B[:, rows], plan=plan)
