"""Designs that are none: what makes dampers implausible although the procedure gives them, a sentence each."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import scipy

from edesign.codes.asce7 import largest_property_factor, smallest_property_factor
from edesign.errors import InputError
from edesign.project.dampers.designs import Bounds, DriftAmplitude, ElastomerDesign, RoofAmplitude
from edesign.study.design.bounds import property_factors
from edesign.study.design.building import Building
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer import Material
from edesign.study.design.estimate import Estimate
from edesign.study.design.own_strain import effective_strain
from edesign.study.design.results import of_storeys
from edesign.study.design.sizing import Sizing, place_stiffness, total_area
from edesign.study.design.viscous import ViscousSizing
from edesign.study.design.viscous_estimate import ViscousEstimate
from edesign.study.design.viscous_frame import ViscousFrame

LARGEST_BETA = 5.0
"""k_D / k_S up to which preliminary designs go: thesis 5.3.4 after Fan (1998) and Lee (2003)."""
LARGEST_OVER_DESIGN = 1.5
"""Largest considered over design earthquake: ASCE/SEI 7-16, 11.4.5, whose design spectrum is 2/3 of the other."""
LARGEST_FORCE = 8e6
"""N, of one fluid viscous damper: the end of the standard sizes of Taylor Devices (250 to 8000 kN)."""
_LEAST_SHARE = 1e-3  # of the dampers, from which a share with the same damping is looked for
_SHARES = np.geomspace(_LEAST_SHARE, 1.0, 61)
_ROUNDING = 1e-6  # of shares and ratios


def elastomer_doubts(
    building: Building,
    spec: ElastomerDesign,
    sizing: Sizing,
    material: Material,
    found: Estimate | None,
    in_histories: float,
) -> Iterator[str]:
    """What is implausible about dampers of elastomer.

    Args:
        building: the frame with its places.
        spec: the design.
        sizing: the dampers.
        material: the elastomer at the temperature of the design.
        found: response that the spectrum estimates; None: there is no level.
        in_histories: effective strain of the dampers in the histories of a verification; nan: there are none.
    """
    yield from _too_stiff(building, sizing)
    yield from _too_slender(building, spec, sizing)
    where, reached, strains = "in the histories", in_histories, None
    if found is not None:
        strains = found.damper_strain
        estimated = effective_strain(building.at_places(sizing.stiffness), strains)
        if math.isfinite(in_histories):
            strains = strains * (in_histories / estimated)
        else:
            where, reached = f"in the estimate at {spec.level}", estimated
    if math.isfinite(reached):
        yield from _other_strain(building, spec, sizing, material, reached, where)
    if strains is not None:
        yield from _too_much_strain(building, spec, float(strains.max()), where)
        yield from _too_thick(building, spec, sizing, material, float(strains.max()), reached)


def _other_strain(
    building: Building, spec: ElastomerDesign, sizing: Sizing, material: Material, reached: float, where: str
) -> Iterator[str]:
    """What the properties at the strain of the design miss where the dampers reach another one.

    Args:
        building: the frame with its places.
        spec: the design.
        sizing: the dampers.
        material: the elastomer at the temperature of the design.
        reached: effective strain of the dampers.
        where: that was found, for people.

    Source: for the difference that needs no word ASCE/SEI 7-16, 18.2.4.5, whose bounds are 0.85 and 1.2 at least.
    """
    taken, (low, high, source) = sizing.moduli, _spread(spec.bounds)
    strains = f"the dampers reach {_percent(reached)} strain {where}, not the {_percent(sizing.strain)} of the design"
    try:
        there = material(reached)(sizing.frequency)
    except InputError as error:
        yield f"{strains}; there {error}"
        return
    stores = there.G_storage / taken.G_storage
    loses = stores * there.loss_factor / taken.loss_factor
    if low <= min(stores, loses) and max(stores, loses) <= high:
        return
    designed, real = (_first_damping(building, sizing.complex_stiffness(building, moduli=m)) for m in (taken, there))
    yield (
        f"{strains}. There G' is {1e-6 * there.G_storage:.4g} MPa, not {1e-6 * taken.G_storage:.4g} MPa, and n "
        f"{there.loss_factor:.4g}, not {taken.loss_factor:.4g}. The dampers store {stores:.3g} and lose {loses:.3g} "
        f"times what the design counts on, outside {low:g} to {high:g} ({source}). With braces they add "
        f"{_percent(real)} of damping to the first mode, not {_percent(designed)}{_remedy(spec)}"
    )


def viscous_doubts(frame: ViscousFrame, sizing: ViscousSizing, found: ViscousEstimate | None) -> Iterator[str]:
    """What is implausible about viscous dampers.

    Args:
        frame: with its dampers' law.
        sizing: the dampers.
        found: response that the spectrum estimates; None: there is no level.
    """
    building, vibration, spec = frame.building, sizing.vibration, frame.spec
    damper = 1.0j * vibration.omega * vibration.linear
    pushed = np.abs(damper / (1.0 + damper * vibration.flexibility))  # force over drift, with the spring in series
    ratio = np.bincount(building.place_storey, pushed * building.cosine**2) / building.designed_stiffness
    if ratio.max() > 1.0:
        yield (
            f"the dampers of storey {building.storeys[int(ratio.argmax())]} push {ratio.max():.3g} times as hard as "
            "its columns (omega c_eq over k_S, with braces): they hold the storey rather than damp it; 2 is the "
            "critical damping of a storey by itself"
        )
    weight = vibration.linear / frame.at_places(sizing.coefficient)

    def damping(share: float) -> float:
        coefficient = share * sizing.coefficient
        return frame.modes(weight * frame.at_places(coefficient), coefficient).first_damping

    yield from _beyond_the_optimum(damping, "coefficients")
    if found is None:
        return
    force = of_storeys(building, found.damper_force) / spec.number
    if force.max() > LARGEST_FORCE:
        yield (
            f"one damper of storey {building.storeys[int(force.argmax())]} has an estimated force of "
            f"{1e-3 * force.max():.4g} kN; standard sizes end at {1e-3 * LARGEST_FORCE:g} kN (Taylor Devices), so "
            f"take more places or a larger `number` than {spec.number}"
        )
    yield from _amplitude(frame, sizing)


def _amplitude(frame: ViscousFrame, sizing: ViscousSizing) -> Iterator[str]:
    """What a given amplitude misses where the spectrum says another one."""
    vibration, alpha, action = sizing.vibration, frame.dashpot.alpha, frame.action
    if not isinstance(frame.spec.amplitude, (RoofAmplitude, DriftAmplitude)) or action is None or alpha == 1.0:
        return
    reached = frame.spectral_roof(vibration.modes, action)
    ratio = (reached / vibration.roof) ** (alpha - 1.0)
    low, high, source = _spread(frame.spec.bounds)
    if not low <= ratio <= high:
        yield (
            f"the dampers count at a roof amplitude of {1e3 * vibration.roof:.4g} mm, but the first mode reaches "
            f"{1e3 * reached:.4g} mm at {frame.spec.level}: there c_eq is {ratio:.3g} times what the design counts on, "
            f"outside {low:g} to {high:g} ({source}); `amplitude: spectrum` follows the amplitude"
        )


def _too_stiff(building: Building, sizing: Sizing) -> Iterator[str]:
    def damping(share: float) -> float:
        k_D = share * sizing.stiffness
        return _first_damping(building, place_stiffness(building, k_D, sizing.moduli.loss_factor, sizing.brace))

    yield from _beyond_the_optimum(damping, "elastomer")
    ratio = sizing.stiffness / building.designed_stiffness
    if ratio.max() > LARGEST_BETA * (1.0 + _ROUNDING):
        yield (
            f"k_D is {ratio.max():.3g} times the stiffness of the storey in storey "
            f"{building.storeys[int(ratio.argmax())]}; preliminary designs go to {LARGEST_BETA:g} (thesis 5.3.4, after "
            "Fan and Lee): such dampers are braces of elastomer"
        )


def _beyond_the_optimum(damping: Callable[[float], float], what: str) -> Iterator[str]:
    """Whether a smaller share of the dampers adds as much damping to the first mode."""
    present = damping(1.0)
    known = [damping(share) for share in _SHARES.tolist()]
    above = next(i for i, value in enumerate(known) if value >= present * (1.0 - 1e-12))
    if above in (0, len(known) - 1):
        return
    low, high = _SHARES[above - 1 : above + 1]
    share = float(scipy.optimize.brentq(lambda x: damping(x) - present, low, high, rtol=_ROUNDING))
    yield (
        f"the dampers are beyond the size that adds most damping to the first mode ({_percent(max(known))} with "
        f"braces): they add {_percent(present)}, and {100.0 * share:.3g} % of the {what} would add as much"
    )


def _too_slender(building: Building, spec: ElastomerDesign, sizing: Sizing) -> Iterator[str]:
    """Layers that bend rather than shear.

    Source: Rivlin and Saunders (1949), Cylindrical shear mountings, Transactions of the Institution of the Rubber
        Industry 24: the stiffness of a block is G A / h over 1 + h^2 / (36 r^2), r^2 = b^2 / 12 for a square of side b.
    """
    i = int(sizing.area.argmin())
    side = math.sqrt(float(sizing.area[i]))
    share, (low, _, source) = 1.0 / (1.0 + (sizing.thickness / side) ** 2 / 3.0), _spread(spec.bounds)
    if share < low:
        yield (
            f"a layer of storey {building.storeys[i]} is {1e3 * sizing.thickness:.4g} mm thick and as a square "
            f"{1e3 * side:.4g} mm wide: it bends, and has {share:.2g} of the stiffness in shear (Rivlin and Saunders "
            f"1949), less than {low:g} ({source})"
        )


def _too_much_strain(building: Building, spec: ElastomerDesign, largest: float, where: str) -> Iterator[str]:
    limits = {f"the tests of the law `{spec.law}`": building.law.tested_strain, "`strain_limit`": spec.strain_limit}
    passed = [f"{name} ({_percent(limit)})" for name, limit in limits.items() if limit is not None and largest > limit]
    if passed:
        yield f"the layers strain to about {_percent(largest)} {where}, beyond {' and '.join(passed)}"


def _too_thick(
    building: Building,
    spec: ElastomerDesign,
    sizing: Sizing,
    material: Material,
    largest: float,
    reached: float,
) -> Iterator[str]:
    """Layers that do not come near their limit: thinner ones have the same stiffness with less elastomer.

    Args:
        building, spec, sizing, material: as for `elastomer_doubts`.
        largest: strain of all layers at the level of the design.
        reached: effective one.
    """
    limit, rarer = spec.strain_limit, LARGEST_OVER_DESIGN * largest
    if limit is None or rarer >= limit:
        return
    ratio = rarer / limit  # of the thicknesses, at the same deformation
    area = total_area(building, spec, sizing.area)
    try:
        needed = area * ratio * sizing.moduli.G_storage / material(reached / ratio)(sizing.frequency).G_storage
    except InputError:
        return
    if needed < _spread(spec.bounds)[0] * area:
        yield (
            f"the layers are thicker than they need to be: under {LARGEST_OVER_DESIGN:g} times {spec.level} (ASCE/SEI "
            f"7-16, 11.4.5: the largest considered earthquake) they strain to about {_percent(rarer)} of the "
            f"{_percent(limit)} allowed. Layers of {1e3 * ratio * sizing.thickness:.3g} mm, not "
            f"{1e3 * sizing.thickness:.3g} mm, have the same stiffness with {needed:.3g} m2 of elastomer, not "
            f"{area:.3g} m2"
        )


def _first_damping(building: Building, stiffness: np.ndarray) -> float:
    """Damping of the first mode with dampers and braces of a complex stiffness (d,) N/m."""
    return float(strain_energy_damping(building.frame.modes(stiffness.real), stiffness)[0])


def _spread(bounds: Bounds | None) -> tuple[float, float, str]:
    """Range of properties that a design covers: that of its own bounds, or the least one of ASCE/SEI 7-16."""
    low, high = (1.0, 1.0) if bounds is None else property_factors(bounds)
    if low < 1.0 < high:
        return low, high, "the bounds of the design"
    return smallest_property_factor(), largest_property_factor(), "the least bounds of ASCE/SEI 7-16, 18.2.4.5"


def _remedy(spec: ElastomerDesign) -> str:
    """What lets the design take the strain that is reached."""
    if spec.strain == "histories":
        return "; more `rounds` bring the strains together"
    word = "histories" if spec.verify is not None else "spectrum"
    return f"; `strain: {word}` takes the strain that is reached"


def _percent(value: float) -> str:
    return f"{100.0 * value:.3g} %"
