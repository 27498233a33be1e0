"""Sizing of viscoelastic dampers: stiffness for a target damping, braces in series, layers (thesis 5.3.4)."""

from __future__ import annotations

import math
from typing import TypeVar, overload

import numpy as np

from edesign.errors import InputError

Real = TypeVar("Real", float, np.ndarray)


def largest_damping(loss_factor: float, brace_ratio: float = math.inf) -> float:
    """Return the added damping ratio that no damper of this loss factor exceeds.

    It is n/2 with a rigid brace, less with a real one.

    Args:
        loss_factor: n of the elastomer.
        brace_ratio: stiffness of the brace over that of the storey.

    Source: limit of thesis Eq. 5.9 for k_D towards infinity; with a brace the largest K''/(2 (k_S + K')) of brace and
        damper in series over the damper's stiffness.
    """
    if math.isinf(brace_ratio):
        return 0.5 * loss_factor
    r, N = brace_ratio, 1.0 + loss_factor**2
    return 0.5 * loss_factor * r / (2.0 + r + 2.0 * math.sqrt(N * (1.0 + r)))


def stiffness_ratio(damping: float, loss_factor: float, brace_ratio: float = math.inf) -> float:
    """Return k_D / k_S: storage stiffness of the dampers of a storey over the stiffness of the storey.

    Args:
        damping: target ratio of critical that the dampers add.
        loss_factor: n of the elastomer.
        brace_ratio: stiffness of the brace over that of the storey, if brace and damper together shall reach the
            target; infinite: the brace is rigid, or the target is that of the dampers alone.

    Raises:
        InputError: no damper of this loss factor reaches the target.

    Source: thesis Eq. 5.9; with a brace K''/(2 (k_S + K')) = zeta of the complex stiffness K' + i K'' of brace and
        damper in series, a quadratic in k_D whose smaller root is the economic one.
    """
    limit = largest_damping(loss_factor, brace_ratio)
    if not 0.0 < damping < limit:
        brace = "" if math.isinf(brace_ratio) else f" behind a brace {brace_ratio:g} times as stiff as the storey"
        raise InputError(
            f"a damping of {100.0 * damping:.4g} % is a target no damper can reach: with a loss factor n of "
            f"{loss_factor:.4g}{brace} it must be greater than 0 and less than {100.0 * limit:.4g} % "
            "(n / 2 for rigid braces, thesis Eq. 5.9) [E-DESIGN-04]"
        )
    if math.isinf(brace_ratio):
        return 2.0 * damping / (loss_factor - 2.0 * damping)
    n, r = loss_factor, brace_ratio
    a = 2.0 * damping * (1.0 + n**2) * (1.0 + r)
    b = n * r**2 - 2.0 * damping * (2.0 * r + r**2)
    c = 2.0 * damping * r**2
    return 2.0 * c / (b + math.sqrt(max(b**2 - 4.0 * a * c, 0.0)))


@overload
def in_series(damper: complex, brace: float) -> complex: ...
@overload
def in_series(damper: np.ndarray, brace: float | np.ndarray) -> np.ndarray: ...
def in_series(damper: complex | np.ndarray, brace: float | np.ndarray) -> complex | np.ndarray:
    """Return the complex stiffness of dampers and their braces in series.

    Args:
        damper: K' + i K'', N/m.
        brace: N/m; infinite: rigid.
    """
    return damper / (1.0 + damper / brace)


def layer_area(k_D: Real, thickness: float, G_storage: float, layers: int, dampers: Real) -> Real:
    """Return the area of one layer of elastomer, m2.

    Args:
        k_D: horizontal storage stiffness of all dampers of the storey, N/m.
        thickness: of one layer, m.
        G_storage: storage modulus, Pa.
        layers: of one damper, side by side.
        dampers: dampers of the storey, each counted with the square of the cosine of its slope.

    Source: thesis Eq. 5.14, in which 1/4 stands for two dampers of two layers.
    """
    return k_D * thickness / (G_storage * layers * dampers)


def layer_thickness(drift: float, height: float, strain_limit: float, cosine: float = 1.0) -> float:
    """Return the thickness of a layer that strains to its limit at a storey drift, m.

    Args:
        drift: storey drift over storey height.
        height: of the storey, m.
        strain_limit: largest shear strain.
        cosine: of the damper's slope.

    Source: thesis 5.3.4, h = 35 mm / 0.5.
    """
    return drift * height * cosine / strain_limit


def damping_of_frequencies(loss_factor: float, omega: Real, omega_damped: Real) -> Real:
    """Return the damping ratio that dampers add, from frequencies without and with their storage stiffness.

    Args:
        loss_factor: eta of the dampers.
        omega: without the storage stiffness, rad/s.
        omega_damped: with it, rad/s.

    Source: thesis Eq. 5.8, which takes the mode shapes for unchanged.
    """
    return 0.5 * loss_factor * (1.0 - (omega / omega_damped) ** 2)
