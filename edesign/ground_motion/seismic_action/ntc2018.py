"""The action of NTC 2018."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from edesign.codes.motion_sets import SetRules
from edesign.codes.ntc2018 import (
    LIMIT_STATES,
    SERVICEABILITY,
    ULTIMATE,
    NtcDesignSpectrum,
    NtcSpectrum,
    NtcVerticalSpectrum,
    Site,
    reference_life,
    return_period,
)
from edesign.codes.ntc2018.site import TOPOGRAPHY
from edesign.errors import InputError
from edesign.ground_motion.seismic_action.action import Check, check_level
from edesign.project.actions.hazard import NtcHazard
from edesign.project.actions.hazard_base import YEAR, level_of
from edesign.project.notation.units import STANDARD_GRAVITY

LARGEST_VERTICAL_Q = 1.5
"""Source: NTC 2018, 7.3.1."""


@dataclass(frozen=True)
class NtcAction:
    """Spectra of a hazard of NTC 2018; the interface is `SeismicAction`."""

    hazard: NtcHazard

    def checks(self) -> Iterator[Check]:
        """Yield the check of the levels."""
        yield ("levels",), lambda: [self.elastic(level) for level in self.hazard.levels]

    def elastic(self, level: str | None) -> NtcSpectrum:
        """Return S_e(T).

        Args:
            level: its name in the hazard.

        Source: NTC 2018, 3.2.3.2.1.
        """
        name, given = self._level(level)
        return NtcSpectrum(*given, self.hazard.damping, self._rules(name), self._label(name, "elastic"))

    def vertical(self, level: str | None) -> NtcVerticalSpectrum:
        """Return S_ve(T).

        Args:
            level: its name in the hazard.

        Source: NTC 2018, 3.2.3.2.2.
        """
        name, given = self._level(level)
        return NtcVerticalSpectrum(*given, self.hazard.damping, self._rules(name), self._label(name, "vertical"))

    def design(self, level: str | None, q: float | None) -> NtcDesignSpectrum | None:
        """Return S_d(T); None: there is no behaviour factor.

        Args:
            level: its name in the hazard.

        Raises:
            InputError: the level is of SLO, whose design spectrum is the elastic one (3.2.3.4).

        Source: NTC 2018, 3.2.3.5.
        """
        given = q is not None
        q = self.hazard.behaviour_factor if q is None else q
        name, _ = self._level(level)
        if q is None:
            return None
        if self.hazard.levels[name].limit_state == "SLO":
            if not given:
                return None
            raise InputError(
                "--q: for SLO the design spectrum is the elastic one (NTC 2018, 3.2.3.4); leave q out [E-SPEC-04]"
            )
        return NtcDesignSpectrum(self.elastic(level), q, self._label(name, f"design, q = {q:g}"))

    def vertical_design(self, level: str | None, q: float) -> NtcDesignSpectrum:
        """Return S_vd(T).

        Args:
            level: its name in the hazard.
            q: behaviour factor.

        Raises:
            InputError: q is above 1.5, which 7.3.1 has for the vertical component.

        Source: NTC 2018, 3.2.3.5.
        """
        if q > LARGEST_VERTICAL_Q:
            raise InputError(
                f"q = {q:g} is too large for the vertical component: {LARGEST_VERTICAL_Q:g} at most (NTC 2018, 7.3.1)"
                " [E-SPEC-04]"
            )
        name, _ = self._level(level)
        return NtcDesignSpectrum(self.vertical(level), q, self._label(name, f"design, vertical, q = {q:g}"))

    def factor(self, level: str) -> float:
        """Return 1: each level has a spectrum of its own.

        Args:
            level: its name in the hazard.
        """
        check_level(self.hazard, level)
        return 1.0

    def probability(self, level: str) -> float:
        """Return the probability of exceedance of a limit state in 50 years, which need not be V_R.

        Args:
            level: its name in the hazard.

        Source: NTC 2018, 3.2, Eq. 3.2.0.
        """
        period = return_period(self.hazard.levels[level].limit_state, self._life)
        return -math.expm1(-50.0 / period)

    def facts(self, level: str) -> str:
        """Return limit state, probability, return period, and the parameters of the site on rock.

        Args:
            level: its name in the hazard.
        """
        state = LIMIT_STATES[self.hazard.levels[level].limit_state]
        given = self.hazard.levels[level]
        life = self._life
        return (
            f"{given.limit_state}, {100 * state.probability:g} % in V_R = {life:g} years, T_R = "
            f"{return_period(given.limit_state, life):.0f} years, a_g = {given.a_g / STANDARD_GRAVITY:.4g} g, "
            f"F_0 = {given.F_0:g}, T_C* = {given.T_C_star:g} s"
        )

    @property
    def _life(self) -> float:
        """V_R, years."""
        return reference_life(self.hazard.nominal_life / YEAR, self.hazard.class_of_use)

    def _level(self, level: str | None) -> tuple[str, tuple[float, float, float, Site]]:
        name = level_of(self.hazard, level)
        check_level(self.hazard, name)
        given = self.hazard.levels[name]
        S_T = TOPOGRAPHY[self.hazard.topography] if self.hazard.S_T is None else self.hazard.S_T
        return name, (given.a_g, given.F_0, given.T_C_star, Site(self.hazard.ground, S_T))

    def _rules(self, level: str) -> SetRules:
        return ULTIMATE if LIMIT_STATES[self.hazard.levels[level].limit_state].ultimate else SERVICEABILITY

    def _label(self, level: str, what: str) -> str:
        a_g = self.hazard.levels[level].a_g / STANDARD_GRAVITY
        return f"NTC 2018 {what}, ground {self.hazard.ground}, {level}: a_g = {a_g:.3g} g"
