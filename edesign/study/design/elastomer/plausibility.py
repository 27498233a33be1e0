"""What makes a design of dampers of elastomer implausible although the procedure gives it, a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator

from edesign.codes.asce7.spectrum import EARTHQUAKES
from edesign.codes.ec8.action.importance import NEAR_COLLAPSE, NEAR_COLLAPSE_CLAUSE, factor_of_return_period
from edesign.damper.sizing import largest_damping
from edesign.errors import InputError
from edesign.ground_motion.hazard import elastic_spectrum, factor_of_level, national_of
from edesign.project.actions.hazard import AsceHazard, EC8Hazard, NtcHazard
from edesign.project.dampers.designs import ElastomerDesign, FixedProperties, StrainEnergyDesign
from edesign.project.reading.words import percent
from edesign.study.design.elastomer.distribution import nearest_scale
from edesign.study.design.elastomer.model import ElastomerModel, ElastomerSizing, effective_strain
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.pattern import pattern_of
from edesign.study.design.plausibility import ROUNDING, beyond_the_optimum, spread

LARGEST_BETA = 5.0
"""k_D / k_S up to which preliminary designs go: thesis 5.3.4 after Fan (1998) and Lee (2003)."""


def elastomer_warnings(
    model: ElastomerModel, sizing: ElastomerSizing, found: FrameEstimate | None, in_histories: float
) -> Iterator[str]:
    """Yield one sentence for each implausible property of a design of dampers with layers of elastomer.

    Args:
        found: response that the spectrum of the level estimates; None: there is no level.
        in_histories: effective strain of the dampers in the histories of a verification; nan: there are none.
    """
    spec = model.spec
    yield from _short_of_target(model, sizing)
    yield from _too_stiff(model, sizing)
    if found is not None:
        yield from _more_base_shear(model, sizing, found)
    yield from _too_slender(model, sizing)
    where, reached, strains = "in the histories", in_histories, None
    if found is not None:
        strains = found.dampers["strain"]
        estimated = effective_strain(model.at_places(sizing.size), strains)
        if math.isfinite(in_histories):
            strains = strains * (in_histories / estimated)
        else:
            where, reached = f"in the estimate at {spec.level}", estimated
    if math.isfinite(reached):
        yield from _other_strain(model, sizing, reached, where)
    if strains is not None:
        yield from _too_much_strain(model, float(strains.max()), where)
        yield from _too_thick(model, sizing, float(strains.max()), reached)


def _other_strain(model: ElastomerModel, sizing: ElastomerSizing, reached: float, where: str) -> Iterator[str]:
    """What the properties at the strain of the design miss where the dampers reach another one.

    Args:
        reached: effective strain of the dampers.
        where: that was found, for people.

    Source: for the difference that needs no word ASCE/SEI 7-16, 18.2.4.5, whose bounds are 0.85 and 1.2 at least.
    """
    spec = model.spec
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
        there = model.material(reached)(sizing.frequency)
    except InputError as error:
        yield f"{strains}; there {error}"
        return
    stores = there.G_storage / taken.G_storage
    loses = stores * there.loss_factor / taken.loss_factor
    if low <= min(stores, loses) and max(stores, loses) <= high:
        return
    designed, real = (model.first_damping(model.of(sizing, moduli=m)) for m in (taken, there))
    yield (
        f"{strains}. There G' is {1e-6 * there.G_storage:.4g} MPa, not {1e-6 * taken.G_storage:.4g} MPa, and n "
        f"{there.loss_factor:.4g}, not {taken.loss_factor:.4g}. The dampers store {stores:.3g} and lose {loses:.3g} "
        f"times what the design counts on, outside {low:g} to {high:g} ({source}). With braces they add "
        f"{percent(real)} of damping to the first mode, not {percent(designed)}{_remedy(spec)}"
    )


def _short_of_target(model: ElastomerModel, sizing: ElastomerSizing) -> Iterator[str]:
    """What dampers reach that stay below the target, and why."""
    spec = model.spec
    if not isinstance(spec, StrainEnergyDesign) or not sizing.short:
        return
    n, whose, ratio = sizing.moduli.loss_factor, "the first mode", float(model.ratios.min())
    if spec.target_in == "storeys":
        whose, most = "a storey", largest_damping(n, ratio)
    else:
        pattern = pattern_of(model.building, spec.distribution)
        most = nearest_scale(model, pattern, n, 0.5 * n * (1.0 - ROUNDING))[1]
    yield (
        f"the dampers add {percent(sizing.reached)} to {whose}, not the {percent(spec.damping or math.nan)} of the "
        f"target: behind braces of {ratio:.3g} times the stiffness of the storey, n = {n:.4g} adds {percent(most)} at "
        "most. Stiffer braces, more places or a law that loses more add more"
    )


def _too_stiff(model: ElastomerModel, sizing: ElastomerSizing) -> Iterator[str]:
    building = model.building

    def damping(share: float) -> float:
        return model.first_damping(model.stiffness(share * sizing.size, sizing.moduli.loss_factor))

    yield from beyond_the_optimum(damping, "elastomer")
    ratio = sizing.size / building.designed_stiffness
    if ratio.max() > LARGEST_BETA * (1.0 + ROUNDING):
        yield (
            f"k_D is {ratio.max():.3g} times the stiffness of the storey in storey "
            f"{building.storeys[int(ratio.argmax())]}; preliminary designs go to {LARGEST_BETA:g} (Fan "
            "and Lee): such dampers are braces of elastomer"
        )


def _more_base_shear(model: ElastomerModel, sizing: ElastomerSizing, found: FrameEstimate) -> Iterator[str]:
    """Dampers that stiffen the frame more than they damp it: it bears a larger base shear than without them.

    Of one storey, where the spectrum goes as 1/T and eta as EN 1998-1, 3.2.2.2(3), has it, the base shear grows from
    k_D / k_S = 50 n / (5 + 100 zeta) - 1 on, zeta the inherent damping.
    """
    assert model.action is not None
    bare, level = model.bare_estimate(model.action), model.spec.level
    if found.base_shear > bare.base_shear * (1.0 + ROUNDING):
        ratio = float((sizing.size / model.building.designed_stiffness).max())
        yield (
            f"the dampers stiffen the frame more than they damp it: with k_D of up to {ratio:.3g} times the stiffness "
            f"of a storey the base shear at {level} is estimated as {1e-3 * found.base_shear:.4g} kN, and as "
            f"{1e-3 * bare.base_shear:.4g} kN without dampers"
        )


def _too_slender(model: ElastomerModel, sizing: ElastomerSizing) -> Iterator[str]:
    """Layers that bend rather than shear.

    Source: Rivlin and Saunders (1949), Cylindrical shear mountings, Transactions of the Institution of the Rubber
        Industry 24: the stiffness of a block is G A / h over 1 + h^2 / (36 r^2), r^2 = b^2 / 12 for a square of side b.
    """
    i = int(sizing.area.argmin())
    side = math.sqrt(float(sizing.area[i]))
    share, (low, _, source) = 1.0 / (1.0 + (sizing.thickness / side) ** 2 / 3.0), spread(model.spec.bounds)
    if share < low:
        yield (
            f"a layer of storey {model.building.storeys[i]} is {1e3 * sizing.thickness:.4g} mm thick and as a square "
            f"{1e3 * side:.4g} mm wide: it bends, and has {share:.2g} of the stiffness in shear (Rivlin and Saunders "
            f"1949), less than {low:g} ({source})"
        )


def _too_much_strain(model: ElastomerModel, largest: float, where: str) -> Iterator[str]:
    spec, tested = model.spec, model.building.law.tested_strain
    limits = {f"the tests of the law `{spec.law}`": tested, "`strain_limit`": spec.strain_limit}
    passed = [f"{name} ({percent(limit)})" for name, limit in limits.items() if limit is not None and largest > limit]
    if passed:
        yield f"the layers strain to about {percent(largest)} {where}, beyond {' and '.join(passed)}"


def _too_thick(model: ElastomerModel, sizing: ElastomerSizing, largest: float, reached: float) -> Iterator[str]:
    """Yield a warning if layers stay so far below their strain limit that thinner ones would save elastomer.

    Args:
        largest: largest strain of the layers at the level of the design.
        reached: effective strain of the layers at the level of the design.
    """
    spec, above = model.spec, _rarest(model, 1.0 / sizing.frequency)
    if spec.strain_limit is None or above is None or above[0] * largest >= spec.strain_limit:
        return
    limit, (factor, source) = spec.strain_limit, above
    rarer = factor * largest
    ratio = rarer / limit  # of the thicknesses, at the same deformation
    area = model.total_area(sizing.area)
    try:
        needed = area * ratio * sizing.moduli.G_storage / model.material(reached / ratio)(sizing.frequency).G_storage
    except InputError:
        return
    if needed < spread(spec.bounds)[0] * area:
        yield (
            f"the layers are thicker than they need to be: under {factor:.3g} times {spec.level} ({source}) they "
            f"strain to about {percent(rarer)} of the {percent(limit)} allowed. Layers of "
            f"{1e3 * ratio * sizing.thickness:.3g} mm, not {1e3 * sizing.thickness:.3g} mm, have the same stiffness "
            f"with {needed:.3g} m2 of elastomer, not {area:.3g} m2"
        )


def _rarest(model: ElastomerModel, T: float) -> tuple[float, str] | None:
    """The rarest action of the study's code over that of the design's level, and its source; None: it has none.

    Limit states of NTC 2018 have spectra of their own shapes; displacements are compared at the period with dampers.

    Args:
        T: period of the first mode with dampers, s.

    Source: ASCE/SEI 7-16, 11.4.5, whose design spectrum is 2/3 of the largest considered one; EN 1998-1:2004, 2.1(4);
        NTC 2018, 3.2.1: SLC.
    """
    hazard, level = model.building.project.hazard, model.spec.level
    if hazard is None or level is None:
        return None
    if isinstance(hazard, AsceHazard):
        rarest, source = EARTHQUAKES["MCE_R"], "ASCE/SEI 7, 11.4.5: the largest considered earthquake"
    elif isinstance(hazard, EC8Hazard):
        national = national_of(hazard)
        k = national.hazard_exponent if hazard.k is None else hazard.k
        rarest = factor_of_return_period(NEAR_COLLAPSE, national.reference_return_period, k)
        source = NEAR_COLLAPSE_CLAUSE
    elif isinstance(hazard, NtcHazard):
        rare = next((name for name, of in hazard.levels.items() if of.limit_state == "SLC"), None)
        if rare is None:
            return None
        there, here = (float(elastic_spectrum(hazard, name).displacement(T)) for name in (rare, level))
        return max(there / here, 1.0), f"{rare} at T = {T:.3g} s, NTC 2018, 3.2.1"
    else:
        return None
    return max(rarest / factor_of_level(hazard, level), 1.0), source


def _remedy(spec: ElastomerDesign) -> str:
    """What lets the design take the strain that is reached."""
    if spec.strain == "histories":
        return "; more `rounds` bring the strains together"
    word = "histories" if spec.verify is not None else "spectrum"
    return f"; `strain: {word}` takes the strain that is reached"
