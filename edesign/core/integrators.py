"""Time integration methods as parameters of the core."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.core._edcore import lib


@dataclass(frozen=True)
class Newmark:
    """Newmark (1959); the default is the constant average acceleration method."""

    gamma: float = 0.5
    beta: float = 0.25

    def parameters(self) -> tuple[int, list[float]]:
        """Return method and parameters for the core."""
        return lib.ED_NEWMARK, [self.gamma, self.beta]


@dataclass(frozen=True)
class GeneralisedAlpha:
    """Generalised-alpha by its spectral radius at infinity (Chung & Hulbert 1993, Eqs. 25 and 17-20)."""

    rho_inf: float = 0.8

    def parameters(self) -> tuple[int, list[float]]:
        """Return method and parameters for the core."""
        am = (2.0 * self.rho_inf - 1.0) / (self.rho_inf + 1.0)
        af = self.rho_inf / (self.rho_inf + 1.0)
        return lib.ED_GENERALISED_ALPHA, [am, af, 0.5 - am + af, 0.25 * (1.0 - am + af) ** 2]


@dataclass(frozen=True)
class HHT:
    """Hilber, Hughes & Taylor (1977) with alpha in [-1/3, 0]."""

    alpha: float = -0.05

    def parameters(self) -> tuple[int, list[float]]:
        """Return method and parameters for the core."""
        af = -self.alpha
        return lib.ED_GENERALISED_ALPHA, [0.0, af, 0.5 + af, 0.25 * (1.0 + af) ** 2]


Integrator = Newmark | GeneralisedAlpha | HHT
