"""What makes a design of dampers of elastomer implausible although the procedure gives it, a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from edesign.errors import InputError
from edesign.project.dampers.designs import ElastomerDesign, FixedProperties
from edesign.project.reading.words import percent
from edesign.study.design.building import Building
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer.material import Material
from edesign.study.design.elastomer.own_strain import effective_strain
from edesign.study.design.elastomer.sizing import Sizing, place_stiffness, total_area
from edesign.study.design.estimate import Action, Estimate, estimate
from edesign.study.design.plausibility import ROUNDING, beyond_the_optimum, spread

LARGEST_BETA = 5.0
"""k_D / k_S up to which preliminary designs go: thesis 5.3.4 after Fan (1998) and Lee (2003)."""
LARGEST_OVER_DESIGN = 1.5
"""Largest considered over design earthquake: ASCE/SEI 7-16, 11.4.5, whose design spectrum is 2/3 of the other."""


def elastomer_warnings(
    building: Building,
    spec: ElastomerDesign,
    sizing: Sizing,
    material: Material,
    action: Action | None,
    found: Estimate | None,
    in_histories: float,
) -> Iterator[str]:
    """Yield one sentence for each implausible property of a design of dampers with layers of elastomer.

    Args:
        building: the frame with its places.
        spec: the design.
        sizing: the dampers.
        material: the elastomer at the temperature of the design.
        action: of the level of the design; None: there is none.
        found: response that its spectrum estimates; None: there is no level.
        in_histories: effective strain of the dampers in the histories of a verification; nan: there are none.
    """
    yield from _too_stiff(building, sizing)
    if action is not None and found is not None:
        yield from _more_base_shear(building, spec, sizing, action, found)
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
    taken, (low, high, source) = sizing.moduli, spread(spec.bounds)
    strains = f"the dampers reach {percent(reached)} strain {where}, not the {percent(sizing.strain)} of the design"
    if isinstance(spec.properties, FixedProperties):
        # the stress of an elastomer does not fall as its strain grows: G' goes at most as 1/strain
        most = sizing.strain / reached
        if not low <= most <= high:
            yield (
                f"{strains}, where alone the given `properties` hold. At a constant stress G' would be {most:.3g} "
                f"times that value, outside {low:g} to {high:g} ({source}); take `properties` that follow the strain, "
                "or those at the strain that is reached"
            )
        return
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
        f"{percent(real)} of damping to the first mode, not {percent(designed)}{_remedy(spec)}"
    )


def _too_stiff(building: Building, sizing: Sizing) -> Iterator[str]:
    def damping(share: float) -> float:
        k_D = share * sizing.stiffness
        return _first_damping(building, place_stiffness(building, k_D, sizing.moduli.loss_factor, sizing.brace))

    yield from beyond_the_optimum(damping, "elastomer")
    ratio = sizing.stiffness / building.designed_stiffness
    if ratio.max() > LARGEST_BETA * (1.0 + ROUNDING):
        yield (
            f"k_D is {ratio.max():.3g} times the stiffness of the storey in storey "
            f"{building.storeys[int(ratio.argmax())]}; preliminary designs go to {LARGEST_BETA:g} (Fan "
            "and Lee): such dampers are braces of elastomer"
        )


def _more_base_shear(
    building: Building, spec: ElastomerDesign, sizing: Sizing, action: Action, found: Estimate
) -> Iterator[str]:
    """Dampers that stiffen the frame more than they damp it: it bears a larger base shear than without them.

    Of one storey, where the spectrum goes as 1/T and eta as EN 1998-1, 3.2.2.2(3), has it, the base shear grows from
    k_D / k_S = 50 n / (5 + 100 zeta) - 1 on, zeta the inherent damping.
    """
    none = np.zeros_like(building.at_places(sizing.stiffness), dtype=complex)
    bare = estimate(building, action, none, None, sizing.thickness)
    if found.base_shear > bare.base_shear * (1.0 + ROUNDING):
        ratio = float((sizing.stiffness / building.designed_stiffness).max())
        yield (
            f"the dampers stiffen the frame more than they damp it: with k_D of up to {ratio:.3g} times the stiffness "
            f"of a storey the base shear at {spec.level} is estimated as {1e-3 * found.base_shear:.4g} kN, and as "
            f"{1e-3 * bare.base_shear:.4g} kN without dampers"
        )


def _too_slender(building: Building, spec: ElastomerDesign, sizing: Sizing) -> Iterator[str]:
    """Layers that bend rather than shear.

    Source: Rivlin and Saunders (1949), Cylindrical shear mountings, Transactions of the Institution of the Rubber
        Industry 24: the stiffness of a block is G A / h over 1 + h^2 / (36 r^2), r^2 = b^2 / 12 for a square of side b.
    """
    i = int(sizing.area.argmin())
    side = math.sqrt(float(sizing.area[i]))
    share, (low, _, source) = 1.0 / (1.0 + (sizing.thickness / side) ** 2 / 3.0), spread(spec.bounds)
    if share < low:
        yield (
            f"a layer of storey {building.storeys[i]} is {1e3 * sizing.thickness:.4g} mm thick and as a square "
            f"{1e3 * side:.4g} mm wide: it bends, and has {share:.2g} of the stiffness in shear (Rivlin and Saunders "
            f"1949), less than {low:g} ({source})"
        )


def _too_much_strain(building: Building, spec: ElastomerDesign, largest: float, where: str) -> Iterator[str]:
    limits = {f"the tests of the law `{spec.law}`": building.law.tested_strain, "`strain_limit`": spec.strain_limit}
    passed = [f"{name} ({percent(limit)})" for name, limit in limits.items() if limit is not None and largest > limit]
    if passed:
        yield f"the layers strain to about {percent(largest)} {where}, beyond {' and '.join(passed)}"


def _too_thick(
    building: Building,
    spec: ElastomerDesign,
    sizing: Sizing,
    material: Material,
    largest: float,
    reached: float,
) -> Iterator[str]:
    """Yield a warning if layers stay so far below their strain limit that thinner ones would save elastomer.

    Args:
        building: the frame with its places.
        spec: the design.
        sizing: the dampers.
        material: the elastomer at a strain.
        largest: largest strain of the layers at the level of the design.
        reached: effective strain of the layers at the level of the design.
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
    if needed < spread(spec.bounds)[0] * area:
        yield (
            f"the layers are thicker than they need to be: under {LARGEST_OVER_DESIGN:g} times {spec.level} (ASCE/SEI "
            f"7-16, 11.4.5: the largest considered earthquake) they strain to about {percent(rarer)} of the "
            f"{percent(limit)} allowed. Layers of {1e3 * ratio * sizing.thickness:.3g} mm, not "
            f"{1e3 * sizing.thickness:.3g} mm, have the same stiffness with {needed:.3g} m2 of elastomer, not "
            f"{area:.3g} m2"
        )


def _first_damping(building: Building, stiffness: np.ndarray) -> float:
    """Damping of the first mode with dampers and braces of a complex stiffness (d,) N/m."""
    return float(strain_energy_damping(building.frame.modes(stiffness.real), stiffness)[0])


def _remedy(spec: ElastomerDesign) -> str:
    """What lets the design take the strain that is reached."""
    if spec.strain == "histories":
        return "; more `rounds` bring the strains together"
    word = "histories" if spec.verify is not None else "spectrum"
    return f"; `strain: {word}` takes the strain that is reached"
