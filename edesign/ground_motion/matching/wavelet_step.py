"""One linear step of the matching by wavelets: which peaks, which wavelets, what they do to each other."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from edesign.ground_motion.matching.amplitudes import amplitudes
from edesign.ground_motion.matching.ordinates import Ordinates, State
from edesign.ground_motion.matching.peaks import Peaks
from edesign.ground_motion.matching.response_matrix import Wavelets, response_matrix, wavelets_for

NEAR = 0.8  # of the target: peaks from here on are watched
_OVER = 1.01  # of the target: what a trial may have before it teaches
_SAME = 0.15  # of the period: peaks nearer than that are one


@dataclass(frozen=True)
class Step:
    """Linear equations at one state, from which amplitudes are chosen.

    Attributes:
        peaks: those watched; `largest` are those to be brought to their targets.
        wavelets: to be added.
        matrix: change of |peak|/target per amplitude, shape (n_peaks, n).
        missing: 1 - |peak|/target, shape (n_peaks,).
        ordinates: what is matched.
    """

    peaks: Peaks
    wavelets: Wavelets
    matrix: np.ndarray
    missing: np.ndarray
    ordinates: Ordinates

    @classmethod
    def at(
        cls, state: State, ordinates: Ordinates, width_factor: float, lags: tuple[float, ...], time_step: float
    ) -> Step:
        """Linearise at a state.

        Args:
            state: motion and peaks.
            lags: of the peak behind the centres of wavelets, in widths.
            time_step: s.

        Returns:
            The linear equations of the amplitudes of the wavelets.
        """
        watched = np.abs(state.peaks.value) > NEAR * ordinates.target[state.peaks.ordinate]
        if ordinates.with_ground:
            watched |= state.peaks.largest
        else:
            watched |= state.peaks.largest & (state.peaks.ordinate < ordinates.periods.size)
        peaks = state.peaks.where(watched)
        seats = ordinates.seats
        wavelets = wavelets_for(
            state.peaks.time[state.peaks.largest][seats],
            ordinates.periods[seats],
            ordinates.target[seats],
            ordinates.damping,
            (state.motion.size - 1) * time_step,
            width_factor,
            lags,
        )
        matrix, missing = _rows(peaks, wavelets, ordinates)
        return cls(peaks, wavelets, matrix, missing, ordinates)

    def amplitudes(self, damping: float) -> np.ndarray:
        """Return the amplitudes of the wavelets; see `edesign.ground_motion.matching.amplitudes`.

        Args:
            damping: of the least squares.

        Returns:
            One value a wavelet, m/s2.
        """
        return amplitudes(self.matrix, self.missing, np.flatnonzero(self.peaks.largest), damping)

    def taught_by(self, trial: State, tried: np.ndarray) -> Step:
        """Return the step that also watches the peaks by which a trial exceeded the target.

        What they are without the trial's wavelets is exact, as responses add up.

        Args:
            trial: the state after the step.
            tried: the amplitudes that led to it.
        """
        new = trial.peaks.where(np.abs(trial.peaks.value) > _OVER * self.ordinates.target[trial.peaks.ordinate])
        apart = np.abs(new.time[:, None] - self.peaks.time)
        near = _SAME * np.append(self.ordinates.periods, self.ordinates.periods[0])[new.ordinate]
        known = np.any((new.ordinate[:, None] == self.peaks.ordinate) & (apart < near[:, None]), axis=1)
        if np.all(known):
            return self
        new = new.where(~known)
        matrix, missing = _rows(new, self.wavelets, self.ordinates)
        order = np.argsort(np.concatenate((self.peaks.ordinate, new.ordinate)), kind="stable")
        peaks = Peaks(
            np.concatenate((self.peaks.ordinate, new.ordinate))[order],
            np.concatenate((self.peaks.time, new.time))[order],
            np.concatenate((self.peaks.value, new.value))[order],
            np.concatenate((self.peaks.largest, np.zeros(new.ordinate.size, dtype=bool)))[order],
        )
        return replace(
            self,
            peaks=peaks,
            matrix=np.vstack((self.matrix, matrix))[order],
            missing=np.concatenate((self.missing, missing + matrix @ tried))[order],
        )


def _rows(peaks: Peaks, wavelets: Wavelets, ordinates: Ordinates) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the matrix towards the targets, and what the peaks miss."""
    goal = ordinates.target[peaks.ordinate]
    matrix = response_matrix(peaks, wavelets, ordinates.periods, ordinates.damping)
    return matrix * (np.sign(peaks.value) / goal)[:, None], 1.0 - np.abs(peaks.value) / goal
