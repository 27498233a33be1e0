"""The action of ASCE/SEI 7-16 and 7-22."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from edesign.codes.asce7 import EARTHQUAKES, AsceDesignSpectrum, AsceSpectrum
from edesign.codes.registry import find_code
from edesign.errors import InputError
from edesign.ground_motion.seismic_action.action import Check, check_level
from edesign.project.actions.hazard import AsceHazard
from edesign.project.notation.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class AsceAction:
    """Spectra of a hazard of ASCE/SEI 7; the interface is `SeismicAction`."""

    hazard: AsceHazard

    def checks(self) -> Iterator[Check]:
        """Yield the check that T_S is not beyond T_L."""
        yield ("T_L",), lambda: self.elastic(None)

    def elastic(self, level: str | None) -> AsceSpectrum:
        """Return S_a(T); None is the design earthquake.

        Args:
            level: its name in the hazard.

        Source: ASCE/SEI 7, 11.4.
        """
        h, factor = self.hazard, 1.0 if level is None else self.factor(level)
        edition = h.code.removeprefix("asce")
        return AsceSpectrum(h.S_DS, h.S_D1, h.T_L, factor, h.damping, edition, self._label(level))

    def vertical(self, level: str | None) -> AsceSpectrum:
        """Refuse a vertical spectrum.

        Args:
            level: its name in the hazard.

        Raises:
            InputError: always; 11.9 is not here.
        """
        raise InputError(
            f"there is no vertical spectrum of {find_code(self.hazard.code).title} here (its 11.9) [E-SPEC-03]"
        )

    def design(self, level: str | None, q: float | None) -> AsceDesignSpectrum | None:
        """Return S_a / (R / I_e).

        Args:
            level: its name in the hazard.
            q: stands for R; None: that of the hazard.

        Source: ASCE/SEI 7, 12.9.1.2.
        """
        R = self.hazard.R if q is None else q
        if R is None:
            return None
        label = f"{self._label(level)} / (R / I_e), R = {R:g}, I_e = {self.hazard.I_e:g}"
        return AsceDesignSpectrum(self.elastic(level), R, self.hazard.I_e, label)

    def vertical_design(self, level: str | None, q: float) -> AsceDesignSpectrum:
        """Refuse a vertical spectrum.

        Args:
            level: its name in the hazard.
            q: behaviour factor.

        Raises:
            InputError: always; 11.9 is not here.
        """
        return AsceDesignSpectrum(self.vertical(level), q)

    def factor(self, level: str) -> float:
        """Return 1 for the design earthquake, 1.5 for MCE_R (7-22, 11.4.6; 7-16, 11.4.7).

        Args:
            level: its name in the hazard.
        """
        check_level(self.hazard, level)
        return EARTHQUAKES[self.hazard.levels[level].earthquake]

    def probability(self, level: str) -> None:
        """Return None: earthquakes of ASCE/SEI 7 aim at a risk of collapse, so that their probability differs by site.

        Args:
            level: its name in the hazard.
        """

    def facts(self, level: str) -> str:
        """Return the earthquake.

        Args:
            level: its name in the hazard.
        """
        return f"{self.hazard.levels[level].earthquake}, {self.factor(level):g} x design spectrum"

    def _label(self, level: str | None) -> str:
        h = self.hazard
        values = f"S_DS = {h.S_DS / STANDARD_GRAVITY:.4g} g, S_D1 = {h.S_D1 / STANDARD_GRAVITY:.4g} g"
        name = "" if level is None else f"{level}: "
        times = "" if level is None else f" x {self.factor(level):g}"
        return f"{find_code(h.code).title} two-period, {name}{values}{times}"
