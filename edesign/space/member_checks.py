"""Checks of all members under all combinations, EN 1993-1-1 and EN 1998-1: constants in Python, the pass in the core.

Sets of combinations: persistent (6.10), seismic, and capacity, in which the seismic effects are those of members that
yield: 1.1 gamma_ov Omega (EN 1998-1, 6.6.3(1)P and 6.7.4(1)). Members that dissipate energy are checked in the seismic
set, all others in the capacity set; in ductility class low all in the seismic set.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.building.section_class import section_class
from edesign.building.steel_section import SteelSection, steel_section
from edesign.codes.ec3 import cross_section, lateral_torsional
from edesign.codes.ec3.buckling import (
    buckling_resistance,
    critical_force,
    hollow_curve,
    reduction_factor,
    rolled_i_curve,
    slenderness,
)
from edesign.codes.ec3.moment_factors import SWAY
from edesign.codes.ec8.moment_frames import hinge_shear
from edesign.codes.en1990.combinations import Combination
from edesign.core.member_checks import (
    BEAM_CHECKS,
    CLAUSES,
    MEMBER_CHECKS,
    SECTION_CHECKS,
    Check,
    MemberConstants,
    mask,
    member_checks,
)
from edesign.errors import InputError
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.capacity import Overstrength, bends_about_y, dissipative_members
from edesign.space.criteria import MOMENT_FRAME, design_of, system_of
from edesign.space.effects import Effects, largest
from edesign.space.frame import Member, SpaceFrame
from edesign.space.response import AXES, STATIONS, Axis

PERSISTENT, SEISMIC, CAPACITY = range(3)
LARGEST_CLASS = 3
_SEISMIC_TERM = re.compile(r"(?:([0-9.]+) )?E_([xy])")


@dataclass(frozen=True)
class MemberResults:
    """The largest utilisation of each member in each check.

    Attributes:
        checks: (n_checks,) names, with the clause: `N-M (EN 1993-1-1, 6.2.9)`.
        clauses: (n_checks,) clauses.
        utilisation: (n_members, n_checks); nan where the check does not apply.
        combination: (n_members, n_checks) number of the governing combination, from 1; 0 where it does not apply.
        station: (n_members, n_checks) governing place as a fraction of the length; nan where it does not apply.
        rows: the combinations that the numbers mean: those of actions, then the amplified ones.
    """

    checks: tuple[str, ...]
    clauses: tuple[str, ...]
    utilisation: np.ndarray
    combination: np.ndarray
    station: np.ndarray
    rows: tuple[Combination, ...]


def member_results(
    building: Building,
    frame: SpaceFrame,
    effects: Effects,
    fundamental: Sequence[Combination],
    seismic: Sequence[Combination],
    overstrength: Mapping[Axis, Overstrength],
    gamma_ov: float,
) -> MemberResults:
    """Check all members.

    Args:
        building, frame: with the members.
        effects: of the actions.
        fundamental, seismic: combinations for persistent and for seismic design situations.
        overstrength: Omega of both directions.
        gamma_ov: material overstrength factor.

    Raises:
        InputError: a section is of class 4.
    """
    design = design_of(building)
    amplified = amplified_combinations(design, seismic, overstrength, gamma_ov)
    rows = (*fundamental, *seismic, *amplified)
    force = -np.abs(largest(effects, rows)[:, :, 0].max(axis=1))
    members = [
        _constants(building, design, member, float(frame.length[number]), float(force[number]))
        for number, member in enumerate(frame.members)
    ]
    spectral, factors = _spectral(effects, rows)
    found = member_checks(
        statics=effects.static,
        spectral=spectral,
        static_factors=np.array([[row.static.get(case, 0.0) for case in effects.cases] for row in rows]),
        spectral_factors=factors,
        combination_set=np.repeat([PERSISTENT, SEISMIC, CAPACITY], [len(fundamental), len(seismic), len(amplified)]),
        gravity=np.ones(len(effects.cases), dtype=int),
        members=members,
        masks=_masks(frame, design, bool(amplified)),
    )
    applies = found.combination >= 0
    return MemberResults(
        checks=tuple(check.name for check in Check),
        clauses=tuple(CLAUSES[check] for check in Check),
        utilisation=np.where(applies, found.utilisation, np.nan),
        combination=np.where(applies, found.combination + 1, 0),
        station=np.where(applies, STATIONS[np.maximum(found.station, 0)], np.nan),
        rows=rows,
    )


def _spectral(effects: Effects, rows: Sequence[Combination]) -> tuple[np.ndarray, np.ndarray]:
    """Return magnitudes of seismic effects, and the factor of each in each combination.

    Components that add up as squares are one more magnitude for each pair of factors.
    """
    squares = {row.seismic[:2] for row in rows if row.directions == "srss" and any(row.seismic)}
    pairs = sorted({(abs(x), abs(y)) for x, y in squares})
    more = [np.sqrt((x * effects.seismic[0]) ** 2 + (y * effects.seismic[1]) ** 2) for x, y in pairs]
    factors = np.zeros((len(rows), 2 + len(pairs)))
    for number, row in enumerate(rows):
        x, y = abs(row.seismic[0]), abs(row.seismic[1])
        if (x, y) in pairs:
            factors[number, 2 + pairs.index((x, y))] = 1.0
        else:
            factors[number, :2] = x, y
    return np.stack([*effects.seismic, *more]), factors


def amplified_combinations(
    design: Design, seismic: Sequence[Combination], overstrength: Mapping[Axis, Overstrength], gamma_ov: float
) -> tuple[Combination, ...]:
    """Return the seismic combinations with 1.1 gamma_ov Omega on the seismic effects; none in ductility class low.

    An Omega below 1, of a dissipative member that fails its own check, counts as 1.

    Source: EN 1998-1:2004, 6.6.3(1)P, Eq. 6.6; 6.7.4(1), Eq. 6.12.
    """
    if design.ductility_class == "low":
        return ()
    factor = {axis: 1.1 * gamma_ov * max(overstrength[axis].Omega, 1.0) for axis in AXES}
    found = []
    for row in seismic:
        x, y, z = row.seismic
        name = _SEISMIC_TERM.sub(lambda term: f"{float(term[1] or 1.0) * factor[term[2]]:.3g} E_{term[2]}", row.name)  # type: ignore[index]
        found.append(replace(row, name=name, seismic=(x * factor["x"], y * factor["y"], z)))
    return tuple(found)


def _masks(frame: SpaceFrame, design: Design, capacity: bool) -> np.ndarray:
    """Return the checks of each member in each set of combinations, as bits, (n_members, 3)."""
    usual = {kind: mask(*SECTION_CHECKS, *MEMBER_CHECKS) for kind in ("beam", "column")}
    usual["brace"] = mask(Check.N, Check.N_B)
    masks = np.zeros((len(frame.members), 3), dtype=np.intc)
    dissipative = {axis: set(dissipative_members(frame, axis, system_of(design, axis).type).tolist()) for axis in AXES}
    frames = any(system_of(design, axis).type == MOMENT_FRAME for axis in AXES)
    for number, member in enumerate(frame.members):
        of_kind = usual[member.kind] if member.compression else mask(Check.N)
        dissipates = any(number in dissipative[axis] for axis in AXES)
        masks[number, PERSISTENT] = of_kind
        masks[number, SEISMIC if dissipates or not capacity else CAPACITY] = of_kind
        if capacity and dissipates and member.kind == "beam":
            masks[number, SEISMIC] |= mask(*BEAM_CHECKS)
        if capacity and frames and member.kind == "column":
            masks[number, CAPACITY] |= mask(Check.COLUMN_V)
    return masks


def _constants(building: Building, design: Design, member: Member, length: float, N_Ed: float) -> MemberConstants:
    """Return the constants of a member under a largest compression N_Ed, N."""
    section, steel = steel_section(member.section), building.materials[member.material]
    fy, factors = steel.fy, design.partial_factors
    bent = member.kind != "brace"
    of_class = section_class(section, fy, N_Ed if member.kind != "beam" else 0.0, about_y=bent, about_z=False).number
    if of_class > LARGEST_CLASS:
        raise InputError(
            f"{building.path}: {member.name}: {member.section} is of class {of_class} under its forces, and effective "
            f"sections (EN 1993-1-5) are not in the checks; choose a section of class {LARGEST_CLASS} or less"
        )
    plastic = of_class <= 2
    W_y = section.W_pl_y if plastic else section.W_el_y
    W_z = section.W_pl_z if plastic else section.W_el_z
    M_y, M_z = (cross_section.moment_resistance(W, fy, factors.M0) for W in (W_y, W_z))
    hollow = section.kind != "I"
    web = section.h - 2.0 * section.tf
    webs = 2.0 * section.tw if section.kind == "RHS" else section.tw
    shares = [
        cross_section.web_share(section.A, 2.0 * side * section.tf)
        for side in (section.b, section.h if hollow else section.b)
    ]
    twists = section.kind == "I" and not (member.kind == "beam" and design.members.lateral_restraint.beams == "slab")
    return MemberConstants(
        N_Rd=cross_section.axial_resistance(section.A, fy, factors.M0),
        V_y_Rd=cross_section.shear_resistance(section.A_vy, fy, factors.M0),
        V_z_Rd=cross_section.shear_resistance(section.A_vz, fy, factors.M0),
        M_y_Rd=M_y,
        M_z_Rd=M_z,
        M_y_shear=min(cross_section.moment_of_shear_area(web, webs, fy, factors.M0), M_y) if plastic else M_y,
        N_web=0.0 if hollow else web * section.tw * fy / factors.M0,
        a_y=shares[0],
        a_z=shares[1],
        M_z_Rk=W_z * fy / factors.M1,
        V_M=float(hinge_shear(M_y, M_y, length)) if member.kind == "beam" and max(member.ends) > 0.0 else 0.0,
        shape=section.kind,
        class_3=not plastic,
        twists=twists,
        **_stability(design, member, section, fy, steel.E, steel.nu, W_y, length),
    )


def _stability(
    design: Design, member: Member, section: SteelSection, fy: float, E: float, nu: float, W_y: float, length: float
) -> dict[str, float]:
    """Return what 6.3 needs. Moment factors are those of a uniform moment but for sway (Table B.3), and C1 is 1."""
    checks = design.members
    of_length = getattr(checks.buckling_length, f"{member.kind}s")
    restrained = (member.kind == "beam" and checks.lateral_restraint.beams == "slab") or (
        member.kind == "column" and checks.lateral_restraint.columns == "all_along"
    )
    chi, slender = {}, {}
    for name, inertia, factor in (("y", section.I_y, of_length.y), ("z", section.I_z, of_length.z)):
        if name == "z" and member.kind == "beam" and restrained:
            chi[name], slender[name] = 1.0, 0.0
            continue
        slender[name] = slenderness(section.A, fy, critical_force(E, inertia, factor * length))
        if section.kind == "I":
            curve = rolled_i_curve(section.h, section.b, section.tf, name, fy)  # type: ignore[arg-type]
        else:
            curve = hollow_curve(fy, section.cold_formed)
        chi[name] = reduction_factor(slender[name], curve)
    chi_LT = 1.0
    if section.kind == "I" and not restrained and member.kind != "brace":
        G = E / (2.0 * (1.0 + nu))
        M_cr = lateral_torsional.critical_moment(E, G, section.I_z, section.I_t, section.I_w, length)
        lambda_LT = lateral_torsional.slenderness(W_y, fy, M_cr)
        chi_LT = lateral_torsional.reduction_factor(lambda_LT, lateral_torsional.rolled_curve(section.h, section.b))
    gamma_M1 = design.partial_factors.M1
    sway = [axis for axis in AXES if system_of(design, axis).type == MOMENT_FRAME]
    about = {bends_about_y(member, axis) for axis in sway} if member.kind == "column" else set()
    return {
        "N_b_y_Rd": buckling_resistance(section.A, fy, chi["y"], gamma_M1),
        "N_b_z_Rd": buckling_resistance(section.A, fy, chi["z"], gamma_M1),
        "M_b_Rd": lateral_torsional.buckling_moment(chi_LT, W_y, fy, gamma_M1),
        "lambda_y": slender["y"],
        "lambda_z": slender["z"],
        "C_my": SWAY if True in about else 1.0,
        "C_mz": SWAY if False in about else 1.0,
        "C_mLT": 1.0,
    }
