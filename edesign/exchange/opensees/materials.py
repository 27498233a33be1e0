"""Laws of edesign as uniaxial materials of OpenSees."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite

from edesign.core import (
    Bilinear,
    ContactSpring,
    DeterioratingSide,
    DeterioratingSpring,
    Elastic,
    LawValues,
    MultilinearSpring,
)
from edesign.core.materials import Steel
from edesign.core.springs import SpringLaw

Material = tuple[str | float, ...]
"""Name and parameters of a uniaxial material; its tag comes between them."""

FOR_GOOD = 1e6
"""Deformation energy over M_y without deterioration: cycles of a building use up less than a millionth of it."""
OUT_OF_REACH = 1e12
"""Yield force of a contact that does not yield, over one newton."""
OTHER_LAW = "take another law, or leave out all dampers with --without-dampers"
"""What to do about a damper that OpenSees lacks."""


class NoSuchMaterial(Exception):
    """OpenSees has no material of the law; the text says what it lacks."""


def steel_material(law: Steel) -> Material:
    """Return the material of a steel law."""
    if isinstance(law, Elastic):
        return ("Elastic", law.E)
    if isinstance(law, Bilinear):
        return ("Steel01", law.fy, law.E, law.b)
    return ("Steel02", law.fy, law.E, law.b, law.R0, law.cR1, law.cR2)


def spring_material(law: SpringLaw) -> Material:
    """Return the material of a spring.

    Raises:
        NoSuchMaterial: OpenSees has none.
    """
    if isinstance(law, MultilinearSpring):
        if not law.corners:
            return ("Elastic", law.slope)
        if len(law.corners) > 1:
            raise NoSuchMaterial("no material has several corners with kinematic hardening [E-OPS-05]")
        return ("Steel01", law.corners[0][1], law.stiffness, law.slope / law.stiffness)
    if isinstance(law, ContactSpring):
        if isfinite(law.capacity):
            return ("ElasticPPGap", law.stiffness, -law.capacity, 0.0, 0.0, "damage")
        return ("ENT", law.stiffness)
    return _hinge_material(law)


def _hinge_material(law: DeterioratingSpring) -> Material:
    M_y = law.positive.yield_force
    energies = (law.strength, law.after_capping, law.unloading)
    Lambdas = (FOR_GOOD if energy == inf else energy / M_y for energy in energies)
    rates = (law.positive.rate, law.negative.rate)
    return ("IMKBilin", law.stiffness, *_side(law.positive), *_side(law.negative), *Lambdas, *law.exponents, *rates)


def _side(side: DeterioratingSide) -> tuple[float, ...]:
    return side.plastic, side.capping, side.ultimate, side.yield_force, side.capped, side.residual


@dataclass(frozen=True)
class Branch:
    """A part of a damper; several stand side by side.

    Attributes:
        material: of it.
        moves: it resists speed alone.
        spring: stiffness in series with it, N/m; 0: none.
    """

    material: Material
    moves: bool = False
    spring: float = 0.0


def damper_branches(law: LawValues, force: float, deformation: float, brace: float) -> tuple[list[Branch], bool]:
    """Return the branches that a damper is, with the brace inside where that is exact.

    Args:
        force: F = force * law(deformation * u).
        deformation: see `force`.
        brace: stiffness in series, N/m; 0: rigid.

    Returns:
        The branches, and whether the brace is in them.

    Raises:
        NoSuchMaterial: OpenSees has none.
    """
    if law.effects:
        raise NoSuchMaterial(f"its `effects` are of edesign alone; {OTHER_LAW} [E-OPS-01]")
    make = _LAWS.get(law.law)
    if make is None:
        raise NoSuchMaterial(f"no material of OpenSees has the law `{law.law}`; {OTHER_LAW} [E-OPS-01]")
    return make(tuple(law.values), force, deformation, brace)


_Made = tuple[list[Branch], bool]


def _in_series(stiffness: float, brace: float) -> float:
    return stiffness if brace == 0.0 else 1.0 / (1.0 / stiffness + 1.0 / brace)


def _kelvin_voigt(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    return [Branch(("Elastic", F * d * p[0])), Branch(("Viscous", F * d * p[1], 1.0), moves=True)], False


def _linearised(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    return _kelvin_voigt((p[0], 2.0 * p[1] * p[0] / p[2]), F, d, brace)


def _generalised_maxwell(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    found = [Branch(("Elastic", F * d * p[0]))] if p[0] > 0.0 else []
    for k, c in zip(p[1::2], p[2::2], strict=True):
        found.append(Branch(("Viscous", F * d * c, 1.0), moves=True, spring=F * d * k))
    return found, False


def _viscous(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    return [Branch(("Viscous", F * d * p[0], 1.0), moves=True)], False


def _viscous_power(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    c, alpha = p
    if alpha == 1.0:
        return _viscous((c,), F, d, brace)
    c *= F * d**alpha
    return [Branch(("ViscousDamper", brace, c, alpha) if brace > 0.0 else ("Viscous", c, alpha), moves=True)], True


def _maxwell(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    return _maxwell_power((p[0], 1.0, p[0] / p[1]), F, d, brace)


def _maxwell_power(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    c, alpha, k = F * d ** p[1] * p[0], p[1], _in_series(F * d * p[2], brace)
    if alpha == 1.0:
        return [Branch(("Viscous", c, 1.0), moves=True, spring=k)], True
    return [Branch(("ViscousDamper", k, c, alpha), moves=True)], True


def _bilinear_oil(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    if brace == 0.0:
        raise NoSuchMaterial(
            "`BilinearOilDamper` has a spring in series; give the damper a `brace` with a stiffness [E-OPS-01]"
        )
    c, relief, ratio = p
    return [Branch(("BilinearOilDamper", brace, F * d * c, F * relief, ratio), moves=True)], True


def _elastic_plastic(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    k, yields, b = F * d * p[0], F * p[1], p[2]
    both = _in_series(k, brace)
    after = _in_series(b * k, brace) if b > 0.0 else 0.0
    return [Branch(("Steel01", yields, both, after / both))], True


def _friction(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    return _elastic_plastic((p[2], p[0] * p[1], 0.0), F, d, brace)


def _lead_rubber(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    yields = p[0] + p[1] * p[2]
    return _elastic_plastic((yields / p[2], yields, p[1] * p[2] / yields), F, d, brace)


def _self_centring(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    k, opens, b, beta = p
    return [Branch(("SelfCentering", F * d * k, b * F * d * k, F * opens, beta))], False


def _gap(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    k, gap, loss, side = p
    if loss > 0.0:
        raise NoSuchMaterial(f"no material of OpenSees loses energy in contact (`d`); {OTHER_LAW} [E-OPS-01]")
    sides = (1.0, -1.0) if side == 0.0 else (side,)
    if any(abs(one) != 1.0 for one in sides):
        raise NoSuchMaterial(f"no contact of OpenSees has a `side` between -1 and 1; {OTHER_LAW} [E-OPS-01]")
    return [Branch(("ElasticPPGap", F * d * k, one * OUT_OF_REACH, one * gap / d, 0.0)) for one in sides], False


def _bouc_wen(p: tuple[float, ...], F: float, d: float, brace: float) -> _Made:
    yields, y, alpha, A, beta, gamma, n = F * p[0], p[1] / d, *p[2:]
    if A == 1.0:  # its parameters have each other's names; its own iteration is the more reliable of both materials
        return [Branch(("BoucWenOriginal", yields / y, yields, alpha, 0.0, 2.0, n, gamma, beta))], False
    return [Branch(("BoucWen", alpha, yields / y, n, beta / y**n, gamma / y**n, A, 0.0, 0.0, 0.0))], False


_LAWS = {
    "kelvin_voigt": _kelvin_voigt,
    "linearised": _linearised,
    "zener": _generalised_maxwell,
    "generalised_maxwell": _generalised_maxwell,
    "viscous": _viscous,
    "viscous_power": _viscous_power,
    "maxwell": _maxwell,
    "maxwell_power": _maxwell_power,
    "bilinear_oil": _bilinear_oil,
    "elastic_plastic": _elastic_plastic,
    "friction": _friction,
    "lead_rubber": _lead_rubber,
    "self_centring": _self_centring,
    "gap": _gap,
    "bouc_wen": _bouc_wen,
}
"""Laws of dampers that OpenSees has, by their names."""
