"""Response of a frame with dampers estimated by its response spectrum, mode by mode with the damping of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.actions.hazard import UserHazard
from edesign.project.analysis.damping import first_ratio
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.designs import SimplifiedDesign, SizedDesign
from edesign.study.design.condensed import CondensedFrame, LinearModes

_NEGLIGIBLE_MASS = 1e-6  # effective mass over total mass of modes that are left out


@dataclass(frozen=True)
class Action:
    """The seismic action: an elastic spectrum, and the damping ratio of the frame without dampers."""

    spectrum: Spectrum
    inherent_damping: float

    def displacement(self, omega: float, damping: float) -> float:
        """Return the spectral displacement of an oscillator, m.

        Args:
            omega: circular frequency, rad/s.
            damping: ratio of critical damping.
        """
        return float(self.spectrum.with_damping(damping).displacement(2.0 * np.pi / omega))


@dataclass(frozen=True)
class FrameEstimate:
    """Largest values over time of the response of a frame, combined from its modes by CQC.

    Attributes:
        drift: storey drift over height, (f,).
        roof_displacement: m.
        storey_shear: in the columns, without dampers, (f,) N.
        base_shear: of columns and dampers, N.
        damper_force: of the dampers at each place, (d,) N.
        dampers: what else the dampers at each place have to bear, (d,) each: strain (of layers), stroke (without brace,
            m), velocity (m/s), ductility, core_strain.
    """

    drift: np.ndarray
    roof_displacement: float
    storey_shear: np.ndarray
    base_shear: float
    damper_force: np.ndarray
    dampers: Mapping[str, np.ndarray]


def make_action(project: AnalysisFile, spec: SizedDesign) -> Action | None:
    """Return the action of a design's hazard level; None if the design names none.

    Raises:
        InputError: the hazard of the project is wrong, or its spectrum has no T_C for the lateral force method.
    """
    if spec.level is None:
        return None
    action = action_of(project, spec.level, spec.inherent_damping)
    spectrum = action.spectrum
    if isinstance(spec, SimplifiedDesign) and "T_C" not in spectrum.corners:
        table = isinstance(project.hazard, UserHazard)
        ways = "give `corner_period` with the table, or take another method" if table else "take another method"
        raise InputError(
            f"{project.where('hazard', 'code')}: hazard.code: a simplified design is by the lateral force method "
            f"of EN 1998-1, 4.3.3.2, which needs a corner period T_C; {spectrum.label} has none: {ways} [E-HAZ-02]"
        )
    return action


def action_of(project: AnalysisFile, level: str, inherent_damping: float | None) -> Action:
    """Return the action of a hazard level on a frame.

    Args:
        inherent_damping: damping ratio of the frame without dampers; None: that of the project.

    Raises:
        InputError: the hazard of the project is wrong.
    """
    ratio = first_ratio(project.damping) if inherent_damping is None else inherent_damping
    return Action(elastic_spectrum(checked_hazard(project), level), ratio)


@dataclass(frozen=True)
class SpectralPeaks:
    """Peaks of the modes that have an effective mass, and how they combine.

    Attributes:
        kept: (n,) which of all modes they are.
        displacement: (k,) generalised displacement of each.
        correlation: (k, k).
    """

    kept: np.ndarray
    displacement: np.ndarray
    correlation: np.ndarray

    def combined(self, values: np.ndarray) -> np.ndarray:
        """Return the CQC combination of modal values.

        Args:
            values: values of all modes at unit generalised displacement, (n, x).

        Returns:
            The largest values over time, (x,), in the unit of `values` times m.
        """
        scaled = self.displacement[:, None] * values[self.kept]
        squared = np.einsum("ix,ij,jx->x", scaled, self.correlation, scaled)
        return np.asarray(np.sqrt(np.maximum(squared, 0.0)))


def spectral_peaks(frame: CondensedFrame, action: Action, modes: LinearModes, added: np.ndarray) -> SpectralPeaks:
    """Return the peaks of the modes under an action; modes with a negligible effective mass are left out.

    Args:
        action: spectrum, and damping ratio of the frame without dampers.
        modes: with the dampers' stiffness.
        added: damping ratio that the dampers of the design add to each mode, (n,); those beside it add theirs.
    """
    total = float(frame.mass @ frame.influence)
    kept = modes.participation**2 > _NEGLIGIBLE_MASS * total
    damping = np.minimum(action.inherent_damping + (added + modes.beside_damping)[kept], 1.0)
    omega = modes.omega[kept]
    spectral = [action.displacement(float(w), float(zeta)) for zeta, w in zip(damping, omega, strict=True)]
    return SpectralPeaks(kept, modes.participation[kept] * np.array(spectral), cqc(omega, damping))


def cqc(omega: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Return the CQC correlation coefficients of modes, (n, n).

    Args:
        omega: circular frequencies, (n,) rad/s.
        damping: ratios of critical damping, (n,).

    Source: Der Kiureghian (1981); Chopra (2012), Eq. 13.7.9.
    """
    beta = omega[:, None] / omega
    zi, zj = damping[:, None], damping
    above = 8.0 * np.sqrt(zi * zj) * (beta * zi + zj) * beta**1.5
    below = (1.0 - beta**2) ** 2 + 4.0 * zi * zj * beta * (1.0 + beta**2) + 4.0 * (zi**2 + zj**2) * beta**2
    # of a mode without damping with itself both are zero
    return np.divide(above, below, out=np.eye(omega.size), where=below > 0.0)
