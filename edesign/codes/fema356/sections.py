"""What the acceptance criteria need of a doubly symmetric steel I section."""

from __future__ import annotations

from dataclasses import dataclass

KSI = 6.894757293168361e6
"""Pa in 1 ksi: 1000 lbf/in2 with 4.4482216152605 N and 0.0254 m, both exact."""


@dataclass(frozen=True)
class ISection:
    """A doubly symmetric I section and its steel.

    Attributes:
        flange_slenderness: b_f / (2 t_f).
        web_slenderness: h / t_w, h being the clear depth of the web between fillets.
        area: m2.
        inertia: second moment of area about the axis of bending, m4.
        weak_inertia: about the other axis, m4.
        plastic_modulus: Z about the axis of bending, m3.
        E: modulus of elasticity, Pa.
        expected_yield: F_ye, Pa.
        lower_bound_yield: F_yLB, Pa.
        flange_outstand: c / t_f, c being the outstand of a flange beyond the fillet.
        web_thickness: m.
    """

    flange_slenderness: float
    web_slenderness: float
    area: float
    inertia: float
    weak_inertia: float
    plastic_modulus: float
    E: float
    expected_yield: float
    lower_bound_yield: float
    flange_outstand: float
    web_thickness: float

    @property
    def yield_axial_force(self) -> float:
        """Axial force at yield P_ye = A F_ye, N."""
        return self.area * self.expected_yield

    def slenderness_limit(self, coefficient: float) -> float:
        """Return `coefficient` / sqrt(F_ye) with F_ye in ksi, as FEMA 356 writes its limits; a pure number.

        Args:
            coefficient: as the tables of FEMA 356 give it.
        """
        return coefficient / (self.expected_yield / KSI) ** 0.5
