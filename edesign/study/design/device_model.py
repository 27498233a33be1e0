"""Dampers of one law in the frame of a design: what they store and dissipate, and the response with them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from edesign.assess.judged_designs import NEARLY
from edesign.project.dampers.dampers import BraceSection
from edesign.project.dampers.designs import (
    BraceRatio,
    DesignedBrace,
    DriftAmplitude,
    RoofAmplitude,
    SizedDesign,
)
from edesign.study.design.braces import DesignBraces, Numbers
from edesign.study.design.building import Building, mode_shears
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.estimate import Action, FrameEstimate, SpectralPeaks, spectral_peaks


@dataclass(frozen=True, eq=False, kw_only=True)
class Sizing:
    """Dampers of a size, by any method.

    Attributes:
        target: what they were sized for: damping ratio, beta of the simplified method, or share of the storey shears;
            nan: a drift.
        size: of all dampers of each storey with dampers along its drift, (s,): horizontal storage stiffness k_D
            without braces (N/m), damping coefficient c (N (s/m)^alpha), or yield force F_y (N).
        iterations: how they were found.
        reason: why they are not good; empty if they are.
        braces: sections of the braces; none where they are rigid, or have a stiffness alone.
        reached: damping ratio that answers a target damping, of what the target is of; nan: the target is another.
    """

    target: float
    size: np.ndarray
    iterations: tuple[Any, ...] = ()
    reason: str = ""
    braces: Numbers = ()
    reached: float = math.nan

    @property
    def short(self) -> bool:
        """Whether the damping stays below the target by more than `NEARLY`."""
        return self.reached < (1.0 - NEARLY) * self.target


D = TypeVar("D", bound=SizedDesign)
V = TypeVar("V")


class DeviceModel(ABC, Generic[D, V]):
    """The dampers of a law with their braces in the frame of a design.

    How dampers count at an amplitude, a frequency and a temperature is the method's, and so is the iteration that leads
    to these: on strain and frequency (elastomer), on the dashpots of an amplitude (viscous), on the secants of an
    amplitude (hysteretic). It ends in a state V, from which all methods estimate the response alike.

    Args:
        building: the frame with its places.
        action: the spectrum; None: there is none.

    Attributes:
        power: of the cosine of a damper's slope, with which it adds to its storey.
        bare: modes without dampers of the design, but for those that the frame stands by, and with those beside.
        brace: horizontal stiffness of the braces of each storey with dampers, (s,) N/m; None: rigid.
        holding: sections of the braces; None: they have none.
    """

    power: float = 2.0

    def __init__(self, building: Building, spec: D, action: Action | None) -> None:
        self.building, self.spec, self.action = building, spec, action
        self.bare = building.frame.modes()
        self.brace = None if self.brace_ratio is None else self.brace_ratio * building.designed_stiffness
        self.holding = self._holding()
        self._held: np.ndarray | None = None
        if self.holding is not None:
            self.hold(self.holding.first())

    def _holding(self) -> DesignBraces | None:
        brace, building = getattr(self.spec, "brace", None), self.building
        if not isinstance(brace, (BraceSection, DesignedBrace)):
            return None
        least = (self.brace_ratio or 0.0) * building.designed_stiffness
        return DesignBraces(
            building.project,
            brace,
            building.places,
            building.place_storey,
            building.cosine,
            least,
            building.storeys,
        )

    def hold(self, numbers: Numbers) -> None:
        """Give the braces their sections; without sections nothing changes.

        Args:
            numbers: of the section of each storey.
        """
        if self.holding is not None:
            self._held = self.holding.stiffness(numbers)
            self.brace = self.holding.horizontal(numbers)

    @property
    def brace_ratio(self) -> float | None:
        """Least stiffness of the braces of a storey over that of the storey; None: rigid, or of any stiffness."""
        brace = getattr(self.spec, "brace", None)
        return brace.ratio if isinstance(brace, (BraceRatio, DesignedBrace)) else None

    @property
    def ratios(self) -> np.ndarray:
        """Stiffness of the braces over that of the storey, (s,); infinite: rigid."""
        if self.brace is None:
            return np.full(self.building.storeys.size, math.inf)
        if self.holding is None and self.brace_ratio is not None:
            return np.full(self.building.storeys.size, self.brace_ratio)
        return np.asarray(self.brace / self.building.designed_stiffness)

    @property
    def without(self) -> str:
        """What archived values of the bare frame are of."""
        if self.building.frame.reference is not None:
            return "with braces that do not yield"
        return "without dampers" if self.building.frame.beside is None else "with the dampers beside alone"

    @property
    def braces(self) -> np.ndarray | None:
        """Stiffness of the braces of each place along them, (d,) N/m; None: rigid."""
        if self._held is not None:
            return self._held
        return None if self.brace is None else self.building.at_places(self.brace)

    def at_places(self, size: np.ndarray) -> np.ndarray:
        """Return the size of the dampers at each place, (d,).

        Args:
            size: of all dampers of each storey along its drift, (s,).
        """
        return self.building.at_places(size, self.power)

    def of_device(self, size: np.ndarray) -> np.ndarray:
        """Return the size of one damper in each storey with dampers, (s,).

        Args:
            size: of all dampers of each storey along its drift, (s,).
        """
        return size / (self.spec.number * self.building.attachment(self.power))

    def roof_amplitude(
        self, at_roof: complex, storeys: np.ndarray, share: float, omega: float, damping: float, action: Action | None
    ) -> float:
        """Return the amplitude of the first mode at the roof, m; nan where a design with linear dampers needs none.

        Args:
            at_roof: displacement of the roof in the mode.
            storeys: drifts of the storeys in it, (f,).
            share: of the spectral displacement that the roof has, participation factor times its displacement.
            omega: circular frequency of the mode, rad/s.
            damping: damping ratio that the dampers add to it, with those beside.
            action: whose spectrum gives the amplitude; None: what the design says.
        """
        amplitude = getattr(self.spec, "amplitude", None)
        if action is None and isinstance(amplitude, RoofAmplitude):
            return amplitude.roof_displacement
        if action is None and isinstance(amplitude, DriftAmplitude):
            drifts = np.abs(storeys) / self.building.heights
            return amplitude.drift * float(abs(at_roof)) / float(drifts.max())
        action = action or self.action
        if action is None:
            return math.nan
        return abs(share) * action.displacement(omega, min(action.inherent_damping + damping, 1.0))

    def first_damping(self, stiffness: np.ndarray) -> float:
        """Return the damping ratio that dampers with their braces add to the first mode, by modal strain energy.

        Args:
            stiffness: complex, of the dampers at each place with their braces, (d,) N/m.
        """
        modes = self.building.frame.modes(stiffness.real)
        return modes.lead.mean(strain_energy_damping(modes, stiffness).__getitem__)

    @abstractmethod
    def complex_stiffness(self, state: V) -> np.ndarray:
        """Return the complex stiffness of dampers and braces at each place in the first mode, (d,) N/m."""

    @abstractmethod
    def storage(self, state: V) -> np.ndarray:
        """Return the stiffness of dampers and braces at each place with which the modes are found, (d,) N/m."""

    @abstractmethod
    def added_damping(self, state: V, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio that the dampers add to each of the modes with their storage, (n,)."""

    def losses(self, state: V, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio by what all dampers dissipate in each of the modes with their storage, (n,)."""
        return self.added_damping(state, modes)

    @abstractmethod
    def demands(
        self, state: V, modes: LinearModes, peaks: SpectralPeaks
    ) -> tuple[np.ndarray, Mapping[str, np.ndarray]]:
        """Return the largest force of the dampers at each place, (d,) N, and what else they bear (`FrameEstimate`)."""

    def peaks(self, state: V, action: Action) -> tuple[LinearModes, SpectralPeaks]:
        """Return the modes with dampers, and their peaks."""
        modes = self.building.frame.modes(self.storage(state))
        return modes, spectral_peaks(self.building.frame, action, modes, self.added_damping(state, modes))

    def drift(self, state: V, action: Action) -> np.ndarray:
        """Return the storey drifts over height by the response spectrum method, (f,)."""
        modes, peaks = self.peaks(state, action)
        return self._drift(modes, peaks)

    def estimate(self, state: V, action: Action) -> FrameEstimate:
        """Estimate the response with dampers by the response spectrum method.

        Source: EN 1998-1:2004, 3.2.2.2(3) (eta) and 4.3.3.3; CQC: Der Kiureghian (1981), Earthquake Engineering and
            Structural Dynamics 9(5), with unequal damping.
        """
        modes, peaks = self.peaks(state, action)
        force, further = self.demands(state, modes, peaks)
        return self._estimate(modes, self.storage(state), peaks, force, further)

    def bare_estimate(self, action: Action) -> FrameEstimate:
        """Estimate the response of the frame without dampers by the response spectrum method."""
        peaks = spectral_peaks(self.building.frame, action, self.bare, np.zeros(self.bare.omega.size))
        frame = self.building.frame
        return self._estimate(self.bare, frame.standing, peaks, np.zeros(frame.n_devices), {})

    def _drift(self, modes: LinearModes, peaks: SpectralPeaks) -> np.ndarray:
        return self.building.drifts(peaks.combined(modes.storeys), peaks.combined(modes.lines))

    def _estimate(
        self,
        modes: LinearModes,
        storage: np.ndarray,
        peaks: SpectralPeaks,
        damper_force: np.ndarray,
        dampers: Mapping[str, np.ndarray],
    ) -> FrameEstimate:
        """The response from the peaks of modes in which the dampers have a stiffness, (d,) N/m."""
        building = self.building
        shears = mode_shears(building.frame, modes)
        columns = shears.copy()
        horizontal = modes.dampers * storage * building.pull
        np.add.at(columns.T, building.storeys[building.place_storey] - 1, -horizontal.T)
        if (beside := building.frame.beside) is not None:
            np.add.at(columns.T, beside.storey - 1, -(modes.beside * beside.stiffness.real * beside.pull).T)
        return FrameEstimate(
            self._drift(modes, peaks),
            float(peaks.combined(modes.floors[:, -1:])[0]),
            peaks.combined(columns),
            float(peaks.combined(shears[:, :1])[0]),
            damper_force,
            dampers,
        )
