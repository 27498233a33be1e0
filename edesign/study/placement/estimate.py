"""What the response spectrum says of a layout: it puts candidates in order, and no verdict rests on it."""

from __future__ import annotations

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.frame.devices import Device
from edesign.project.notation.grid import BayPlace
from edesign.study.analysis.structure import device_stiffness
from edesign.study.design.estimate import Action
from edesign.study.placement.candidates import Candidates
from edesign.study.placement.response import LinearResponse, linear_response
from edesign.study.placement.space import Layout

_AGREEMENT = 0.02
"""Of the dampers' amplitudes between two iterations: below what separates an estimate from a history by far."""
_MOST_ITERATIONS = 12
_AMPLITUDES = 13
"""At which a damper's steady vibration is computed, from 1/300 of the largest deformation of its place up: five a
decade, between which stiffnesses are interpolated."""


class LayoutEstimates:
    """Estimates of layouts by the response spectrum, each made once.

    Dampers of any law count with the stiffness and the losses of their steady vibration at the amplitude of the
    estimate, with braces in series. Their frequency is the first of the frame without dampers, in a building that of
    the leading mode in their direction. Both components of ground motion shake a building with the whole spectrum;
    their effects are combined by the square root of the sum of squares.

    Args:
        candidates: the frame with all items at all places.
        action: the spectrum, and the damping of the frame without dampers.

    Source: thesis Eq. 5.6; EN 1998-1:2004, 4.3.3.3, 4.3.3.5.1(2)b; equivalent linear dampers: FEMA 356, 9.3.3.
    """

    def __init__(self, candidates: Candidates, action: Action) -> None:
        self._candidates = candidates
        self._response = linear_response(candidates.structure, action, candidates.beside.stiffness)
        self._frequencies = self._response.leading_frequencies()
        bare, peaks = self._response.vibration(np.zeros(len(candidates.index), dtype=complex))
        self._bare_deformation = peaks.combined(bare.dampers)
        self._largest = float(self._bare_deformation.max())
        self._stiffness_of: dict[object, tuple[np.ndarray, np.ndarray]] = {}
        self._known: dict[Layout, np.ndarray] = {}

    @property
    def frequency(self) -> float:
        """The frequency of the mode that leads without dampers, of several directions the largest, Hz."""
        return max(self._frequencies)

    def __call__(self, layout: Layout) -> np.ndarray:
        """Estimate the responses of a layout; as without dampers if it fails.

        They are the largest storey drift over height, floor acceleration in m/s2 and base shear in N, of a building
        also those along each direction, and the drifts of each plane frame along itself.
        """
        if layout not in self._known:
            empty = self._candidates.space.empty
            try:
                self._known[layout] = self._estimate(layout)
            except (AnalysisError, InputError, np.linalg.LinAlgError):  # the search goes on without an estimate
                self._known[layout] = np.ones(self._response.count) if layout == empty else self(empty)
        return self._known[layout]

    def amplitudes(self, layout: Layout) -> dict[BayPlace, float] | None:
        """Return the estimated deformation of damper and brace at each equipped place, m; None if it fails."""
        try:
            *_, found = self._vibration(layout)
        except (AnalysisError, InputError, np.linalg.LinAlgError):
            return None
        amplitudes = dict(zip(self._candidates.equipped(layout), found.tolist(), strict=True))
        return amplitudes if all(value > 0.0 for value in found) else None

    def _estimate(self, layout: Layout) -> np.ndarray:
        response, stiffness, _ = self._vibration(layout)
        return np.maximum(response.largest(stiffness), np.finfo(float).tiny)

    def _vibration(self, layout: Layout) -> tuple[LinearResponse, np.ndarray, np.ndarray]:
        """The frame with the dampers of a layout, the stiffness of these, N/m, and their deformations, m."""
        chosen = [(option, place) for place, option in self._candidates.equipped(layout).items()]
        rows = np.array([self._candidates.index[key] for key in chosen], dtype=int)
        devices = [self._candidates.devices[key] for key in chosen]
        response = self._response.with_devices(rows)
        amplitude = self._bare_deformation[rows]
        for _ in range(_MOST_ITERATIONS):
            stiffness = np.array([self._stiffness(d, float(u)) for d, u in zip(devices, amplitude, strict=True)])
            stiffness = stiffness.astype(complex)
            modes, peaks = response.vibration(stiffness)
            found = peaks.combined(modes.dampers)
            if np.all(np.abs(found - amplitude) <= _AGREEMENT * amplitude):
                break
            amplitude = np.sqrt(found * amplitude)  # stiffness may fall with the amplitude as fast as it rises
        return response, stiffness, found

    def _stiffness(self, device: Device, amplitude: float) -> complex:
        """Complex stiffness of a damper with its brace at an amplitude (m), N/m."""
        frequency = self._frequencies[device.direction or 0]
        key = (device.law, device.force_scale, device.deformation_scale, device.brace, device.play, frequency)
        if key not in self._stiffness_of:
            grid = self._largest * np.geomspace(1.0 / 300.0, 1.0, _AMPLITUDES)
            values = np.array([device_stiffness(device, float(u), frequency) for u in grid])
            self._stiffness_of[key] = (np.log(grid), values)
        at, values = self._stiffness_of[key]
        where = np.log(max(amplitude, np.exp(at[0])))
        return complex(np.interp(where, at, values.real), np.interp(where, at, values.imag))
