"""Isolators of buildings as bearing elements, whose forces along x and y lie within a circle in OpenSees too."""

from __future__ import annotations

from edesign.core import LawValues
from edesign.exchange.opensees.materials import NoSuchMaterial, damper_branches

Words = tuple[str | int | float, ...]
UPRIGHT: Words = ("-orient", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
"""Axes of a bearing without length: its own x upwards, its y along x."""
FORCE_BALANCE: Words = ("-iter", 100, 1e-9)
"""Of a friction pendulum: iterations at most, and the force in N at which they end; 1e-12 is below its rounding."""
_EXPONENT = 2.0
"""Of a second hardening, which the bearings have not."""
_WEIGHED = (
    "its friction follows the weight under gravity, and that of OpenSees the axial force of the moment; translate a "
    "copy with `weight: varying` and a stiffness as `vertical` [E-OPS-01]"
)


def bearing(law: LawValues, force: float, deformation: float) -> Words:
    """Return the name of the element of a bearing whose forces do not depend on what presses on it, and its parameters.

    Args:
        force: F = force * law(deformation * u).
        deformation: see `force`.

    Raises:
        NoSuchMaterial: OpenSees has none.
    """
    if law.law == "bouc_wen":
        Fy, Y, alpha, A, beta, gamma, n = law.values
        hysteretic, after = (1.0 - alpha) * Fy * A / Y, alpha * Fy / Y
        stiffness = force * deformation * (hysteretic + after)
        words = stiffness, force * (1.0 - alpha) * Fy, after / (hysteretic + after), 0.0, _EXPONENT
        return "elastomericBearingBoucWen", *words, n, gamma / A, beta / A  # the names are each other's
    if law.law == "friction_pendulum":
        W, R, slow, fast, rate, Y = law.values
        if slow < fast and rate > 0.0:
            raise NoSuchMaterial(_WEIGHED)
        k = W / R + slow * W / Y
        return _plastic(force * deformation * k, force * slow * W, W / R / k)
    (branch,), _ = damper_branches(law, force, deformation, 0.0)
    yields, initial, hardening = map(float, branch.material[1:])
    return _plastic(initial, yields * (1.0 - hardening), hardening)


def pendulum(law: LawValues, force: float, weight: float) -> tuple[Words, Words]:
    """Return the friction model of a friction pendulum under the axial force of the moment, and its parameters.

    Args:
        force: F = force * law(u) under the weight.
        weight: N.

    Returns:
        Name and parameters of the friction model; radius and stiffness before it slips, which stays that under the
        weight in OpenSees.
    """
    W, R, slow, fast, rate, Y = law.values
    friction = force * W / weight  # over that of the law; the dish is that of the file
    return ("VelDependent", friction * slow, friction * fast, rate), (R / friction, force * slow * W / Y)


def _plastic(stiffness: float, strength: float, hardening: float) -> Words:
    return "elastomericBearingPlasticity", stiffness, strength, hardening, 0.0, _EXPONENT
