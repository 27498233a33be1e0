"""Buckling-restrained braces: what their manufacturer's values say of a brace.

Source: AISC 341-16, F4 (design) and K3 (qualification by tests).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

LEAST_DRIFT = 0.02
"""Least storey drift over the height that braces are made for. Source: AISC 341-16, F4.2."""


def expected_deformation(design_drift: float, height: float, cosine: float) -> float:
    """Return the deformation between work points that a brace is made for, 2 Delta_bm or that of 2 % drift, m.

    Args:
        design_drift: of the storey, m.
        height: of the storey, m.
        cosine: of the slope of the brace against the horizontal.

    Source: AISC 341-16, F4.2: twice the design storey drift, or 2 % of the storey height if more.
    """
    return max(2.0 * design_drift, LEAST_DRIFT * height) * cosine


@dataclass(frozen=True)
class RestrainedBrace:
    """A buckling-restrained brace, or several side by side.

    Attributes:
        area: of the steel core, A_sc, m2.
        yield_stress: of the core, F_ysc, Pa.
        modulus: of the core, E, Pa.
        length: between work points, L_wp, m.
        yielding_length: of the core, L_y, m.
        stiffness_factor: KF = K / (E A_sc / L_wp).
        post_yield_ratio: alpha, stiffness after yielding / before by kinematic hardening.
        overstrength: R_y, expected / given yield stress.
        points: strain of the core, omega and beta there, strains ascending.
    """

    area: float
    yield_stress: float
    modulus: float
    length: float
    yielding_length: float
    stiffness_factor: float
    post_yield_ratio: float
    overstrength: float
    points: tuple[tuple[float, float, float], ...]

    @classmethod
    def of_law(cls, values: Sequence[float]) -> RestrainedBrace:
        """Return the brace of parameters of the law `buckling_restrained`.

        Args:
            values: in the order of the core, SI units.
        """
        area, yield_stress, modulus, length, yielding_length, factor, alpha, overstrength, *rows = values
        points = tuple(zip(rows[::3], rows[1::3], rows[2::3], strict=True))
        return cls(area, yield_stress, modulus, length, yielding_length, factor, alpha, overstrength, points)

    def at(self, force_scale: float, length: float) -> RestrainedBrace:
        """Return the brace with another area and another length, whose parts keep their shares.

        Args:
            force_scale: factor on the area.
            length: between work points, m.

        Returns:
            The other brace.
        """
        share = length / self.length
        return replace(self, area=force_scale * self.area, length=length, yielding_length=share * self.yielding_length)

    @property
    def yield_force(self) -> float:
        """Yield strength P_ysc = F_ysc A_sc, N (F4.5b.2, without the resistance factor)."""
        return self.yield_stress * self.area

    @property
    def stiffness(self) -> float:
        """Stiffness K = KF E A_sc / L_wp before yielding, N/m."""
        return self.stiffness_factor * self.modulus * self.area / self.length

    @property
    def yield_deformation(self) -> float:
        """Deformation at yield Delta_by = P_ysc / K, m (K3.3)."""
        return self.yield_force / self.stiffness

    @property
    def tested_strain(self) -> float:
        """Strain of the core up to which omega and beta are known."""
        return self.points[-1][0]

    @property
    def adjusted_tension(self) -> float:
        """Adjusted strength in tension omega R_y P_ysc, N, at the largest strain that omega is known at (F4.2a)."""
        return self.points[-1][1] * self.overstrength * self.yield_force

    @property
    def adjusted_compression(self) -> float:
        """Adjusted strength in compression beta omega R_y P_ysc, N, at the largest strain of the tests (F4.2a)."""
        return self.points[-1][2] * self.adjusted_tension

    @property
    def strain_of_core(self) -> tuple[float, float]:
        """Strain of the core per force on the brace (1/N) and per deformation between work points (1/m).

        The core strains by F / (E A_sc) + p / L_y; the brace deforms by F / K + p.
        """
        per_plastic = 1.0 / self.yielding_length
        return 1.0 / (self.modulus * self.area) - per_plastic / self.stiffness, per_plastic
