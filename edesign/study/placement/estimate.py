"""What the response spectrum says of a layout: it puts candidates in order, and no verdict rests on it."""

from __future__ import annotations

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.frame.devices import Device
from edesign.study.analysis.structure import device_stiffness
from edesign.study.design.building import mode_shears
from edesign.study.design.condensed import CondensedFrame, LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.estimate import Action, SpectralPeaks, spectral_peaks
from edesign.study.placement.candidates import Candidates
from edesign.study.placement.space import Layout, Place

RESPONSES = ("storey drift", "floor acceleration", "base shear")
_AGREEMENT = 0.02
"""Of the dampers' amplitudes between two iterations: below what separates an estimate from a history by far."""
_MOST_ITERATIONS = 12
_AMPLITUDES = 13
"""At which a damper's steady vibration is computed, from 1/300 of the largest deformation of its place up: five a
decade, between which stiffnesses are interpolated."""


class LayoutEstimates:
    """Estimates of layouts by the response spectrum, each made once.

    Dampers of any law count with the stiffness and the losses of their steady vibration at the amplitude of the
    estimate and the first frequency of the frame without dampers, with braces in series.

    Args:
        candidates: the frame with all items at all places.
        action: the spectrum, and the damping of the frame without dampers.

    Source: thesis Eq. 5.6; EN 1998-1:2004, 4.3.3.3; equivalent linear dampers: FEMA 356, 9.3.3.
    """

    def __init__(self, candidates: Candidates, action: Action) -> None:
        self._candidates, self._action = candidates, action
        bare = candidates.frame.modes()
        self._frequency = bare.first_frequency
        peaks = spectral_peaks(candidates.frame, action, bare, np.zeros(bare.omega.size))
        self._bare_deformation = peaks.combined(bare.dampers)
        self._largest = float(self._bare_deformation.max())
        self._stiffness_of: dict[object, tuple[np.ndarray, np.ndarray]] = {}
        self._known: dict[Layout, np.ndarray] = {}

    def __call__(self, layout: Layout) -> np.ndarray:
        """Estimate the `RESPONSES` of a layout, (3,): drift over height, m/s2, N; as without dampers if it fails."""
        if layout not in self._known:
            empty = self._candidates.space.empty
            try:
                self._known[layout] = self._estimate(layout)
            except (AnalysisError, InputError, np.linalg.LinAlgError):  # the search goes on without an estimate
                self._known[layout] = np.ones(len(RESPONSES)) if layout == empty else self(empty)
        return self._known[layout]

    def amplitudes(self, layout: Layout) -> dict[Place, float] | None:
        """Return the estimated deformation of damper and brace at each equipped place, m; None if it fails."""
        try:
            *_, found = self._vibration(layout)
        except (AnalysisError, InputError, np.linalg.LinAlgError):
            return None
        amplitudes = dict(zip(self._candidates.equipped(layout), found.tolist(), strict=True))
        return amplitudes if all(value > 0.0 for value in found) else None

    def _estimate(self, layout: Layout) -> np.ndarray:
        frame, modes, peaks, _ = self._vibration(layout)
        drift = peaks.combined(np.diff(modes.floors, axis=1, prepend=0.0)) / self._candidates.heights
        acceleration = peaks.combined(modes.omega[:, None] ** 2 * modes.floors)
        shear = peaks.combined(mode_shears(frame, modes)[:, :1])
        return np.maximum([drift.max(), acceleration.max(), shear[0]], np.finfo(float).tiny)

    def _vibration(self, layout: Layout) -> tuple[CondensedFrame, LinearModes, SpectralPeaks, np.ndarray]:
        """The frame with the dampers of a layout, its modes, its peaks, and the deformations of the dampers, m."""
        chosen = [(option, place) for place, option in self._candidates.equipped(layout).items()]
        rows = np.array([self._candidates.index[key] for key in chosen], dtype=int)
        devices = [self._candidates.devices[key] for key in chosen]
        frame = _with_devices(self._candidates.frame, rows)
        amplitude = self._bare_deformation[rows]
        for _ in range(_MOST_ITERATIONS):
            stiffness = np.array([self._stiffness(d, float(u)) for d, u in zip(devices, amplitude, strict=True)])
            stiffness = stiffness.astype(complex)
            modes = frame.modes(stiffness.real)
            peaks = spectral_peaks(frame, self._action, modes, strain_energy_damping(modes, stiffness))
            found = peaks.combined(modes.dampers)
            if np.all(np.abs(found - amplitude) <= _AGREEMENT * amplitude):
                break
            amplitude = np.sqrt(found * amplitude)  # stiffness may fall with the amplitude as fast as it rises
        return frame, modes, peaks, found

    def _stiffness(self, device: Device, amplitude: float) -> complex:
        """Complex stiffness of a damper with its brace at an amplitude (m), N/m."""
        key = (device.law, device.force_scale, device.deformation_scale, device.brace, device.play)
        if key not in self._stiffness_of:
            grid = self._largest * np.geomspace(1.0 / 300.0, 1.0, _AMPLITUDES)
            values = np.array([device_stiffness(device, float(u), self._frequency) for u in grid])
            self._stiffness_of[key] = (np.log(grid), values)
        at, values = self._stiffness_of[key]
        where = np.log(max(amplitude, np.exp(at[0])))
        return complex(np.interp(where, at, values.real), np.interp(where, at, values.imag))


def _with_devices(frame: CondensedFrame, rows: np.ndarray) -> CondensedFrame:
    """The condensed frame with some of its dampers' places."""
    return CondensedFrame(
        frame.mass,
        frame.influence,
        frame.floor_of,
        frame.A,
        frame.B[rows],
        frame.C[np.ix_(rows, rows)],
        frame.floor_A,
        frame.floor_B[:, rows],
    )
