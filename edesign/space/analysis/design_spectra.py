"""The spectra of a building: of its design, elastic and reduced by q, and those of the drifts that are limited."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.codes.ec8 import DesignSpectrum, ElasticSpectrum
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcSpectrum
from edesign.codes.ntc2018.drift import limit_state_of_drift
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.actions.hazard import EC8Hazard, NtcHazard
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.analysis.response import AnyDesignSpectrum


@dataclass(frozen=True)
class DesignSpectra:
    """The spectra of a building.

    Attributes:
        elastic: of the design level.
        damage: of SLD by NTC 2018; None by other codes, and where the file has no such level.
        of_drifts: of the drifts that count beside those of the design, which caps them.
        beta: lower bound factor of design spectra.
    """

    elastic: ElasticSpectrum | NtcSpectrum
    damage: NtcSpectrum | None
    of_drifts: ElasticSpectrum | NtcSpectrum | NtcDesignSpectrum
    beta: float

    def reduced(self, q: float) -> AnyDesignSpectrum:
        """Return S_d of the code for a behaviour factor."""
        if isinstance(self.elastic, NtcSpectrum):
            return NtcDesignSpectrum(self.elastic, q, beta=self.beta)
        return DesignSpectrum.of(self.elastic, q, self.beta)


def hazard_of(building: Building) -> EC8Hazard | NtcHazard:
    """Return the hazard that a building is designed for.

    Raises:
        InputError: the file has none, or its values are not known.
    """
    if building.hazard is None:
        raise InputError(
            f"{building.where('hazard')}: hazard: this block is missing; docs/reference/building_file.md explains it"
            " [E-KEY-02]"
        )
    checked_hazard(building)
    assert building.design_hazard is not None, "check_design wants it"
    return building.design_hazard


def design_spectra(building: Building, design: Design, hazard: EC8Hazard | NtcHazard, beta: float) -> DesignSpectra:
    """Return the spectra of a building.

    By EN 1998-1 the drifts that count beside those of the design are the elastic ones of the design level. By NTC 2018,
    7.3.6.1, they are those of SLD with q = 1, or of SLO, whose design spectrum is the elastic one (3.2.3.4).

    Args:
        design: its block `design`.
        beta: lower bound factor of design spectra.
    """
    elastic: ElasticSpectrum | NtcSpectrum = elastic_spectrum(hazard, building.design_level or None)  # type: ignore[assignment]
    if not isinstance(hazard, NtcHazard):
        return DesignSpectra(elastic, None, elastic, beta)
    of_state: dict[str, NtcSpectrum] = {
        state: elastic_spectrum(hazard, level)  # type: ignore[misc]
        for state in ("SLO", "SLD")
        if (level := building.level_of_limit_state(state)) is not None
    }
    damage = of_state.get("SLD")
    if design.drift.limit == "none":
        return DesignSpectra(elastic, damage, elastic, beta)
    state = limit_state_of_drift(hazard.class_of_use)
    of_drifts = NtcDesignSpectrum(of_state[state], 1.0) if state == "SLD" else of_state[state]
    return DesignSpectra(elastic, damage, of_drifts, beta)
