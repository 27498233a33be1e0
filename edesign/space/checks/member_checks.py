"""Checks of all members under all combinations, EN 1993-1-1 and EN 1998-1: constants in Python, the pass in the core.

Sets of combinations: persistent (6.10), seismic, and capacity, in which the seismic effects are those of members that
yield: 1.1 gamma_ov Omega (EN 1998-1, 6.6.3(1)P and 6.7.4(1)). Where buckling-restrained braces yield it also has
their adjusted strengths in place of the effects along them. Members that dissipate energy are checked in the seismic
set, all others in the capacity set; in ductility class low all in the seismic set. Beams that chevrons or V braces meet
have a set of their own, in which a brace has buckled (6.7.4(2)), and members that the vertical component concerns one
with it (4.3.3.5.2).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import numpy as np

from edesign.codes.ec3 import cross_section
from edesign.codes.ec3.member import Stability
from edesign.codes.ec3.moment_factors import SWAY, linear_moment_factor_a
from edesign.codes.ec8.steel.moment_frames import hinge_shear
from edesign.codes.ec8.verification.capacity import OVERSTRENGTH
from edesign.codes.en1990.combinations import Combination
from edesign.core.member_checks import (
    BEAM_CHECKS,
    CLAUSES,
    MEMBER_CHECKS,
    SECTION_CHECKS,
    Check,
    MemberTable,
    Utilisations,
    mask,
    member_checks,
)
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.steel_section import SteelSection
from edesign.project.building.building import Building, Steel
from edesign.project.building.design import Design
from edesign.project.frame.member_design import FrameDesign, LengthFactors
from edesign.space.analysis.bracing import Bracing, bracing
from edesign.space.analysis.buckled_diagonals import CASES as BUCKLING
from edesign.space.analysis.buckled_diagonals import buckling_combinations
from edesign.space.analysis.effects import Effects, largest
from edesign.space.analysis.response import STATIONS
from edesign.space.analysis.yielded_braces import restrained_case
from edesign.space.checks.buckling_moments import FreeBeamMoments, FreeBeams
from edesign.space.checks.capacity import Overstrength, bends_about_y
from edesign.space.checks.steel_member import SteelMember
from edesign.space.structure.design_block import MOMENT_FRAME, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, NO_DIAPHRAGM, Axis, Member, SpaceFrame

PERSISTENT, SEISMIC, CAPACITY, YIELDED, VERTICAL, VERTICAL_CAPACITY = range(6)
LARGEST_PLASTIC_CLASS = 2
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
        rows: the combinations that the numbers mean: those of actions, the amplified ones, those with yielded braces,
            and those with the vertical component, amplified at the end.
        counts: how many of them are in each of these sets.
        slender: numbers of the members of class 4, whose utilisations are infinite: effective sections (EN 1993-1-5)
            are not in the checks.
        members: what the checks take the members for: each kind of them once.
        kinds: (n_members,) which of `members` each member is.
        free_beams: M_b,Rd of beams that no slab holds, under all rows; None where a slab holds all.
    """

    checks: tuple[str, ...]
    clauses: tuple[str, ...]
    utilisation: np.ndarray
    combination: np.ndarray
    station: np.ndarray
    rows: tuple[Combination, ...]
    counts: tuple[int, ...]
    slender: tuple[int, ...]
    members: tuple[SteelMember, ...]
    kinds: np.ndarray
    free_beams: FreeBeamMoments | None

    @property
    def amplified(self) -> tuple[Combination, ...]:
        """The combinations with amplified seismic effects."""
        before = sum(self.counts[:CAPACITY])
        return self.rows[before : before + self.counts[CAPACITY]]


class MemberChecker:
    """Checks the members of a building, whatever sections they have.

    Args:
        building: with the materials and the block `design`.
        frame: its members; their sections may change from check to check, their places may not.
        dissipative: numbers of the dissipative members of both directions.
        bracing: beams that braces meet.
        vertical: numbers of the members that the vertical component concerns.
    """

    def __init__(
        self,
        building: Building,
        frame: SpaceFrame,
        dissipative: Mapping[Axis, np.ndarray],
        bracing: Bracing,
        vertical: np.ndarray,
    ) -> None:
        self._building = building
        self._design = design_of(building)
        self._rules = rules_of(self._design)
        self._masks = _masks(frame, self._design, dissipative, bracing.halves, vertical)
        self._section = frame.section
        roles = _roles_of(self._design, frame, bracing)
        self._roles = list(dict.fromkeys(roles))
        places = {role: place for place, role in enumerate(self._roles)}
        self._role_of_members = np.array([places[role] for role in roles], dtype=int)
        free = self._design.members.lateral_restraint.beams == "ends"
        M1 = self._design.partial_factors.M1
        self._free_beams = FreeBeams(frame, building.materials, M1, bracing) if free else None
        self._known: dict[tuple[str, str, bool, int], SteelMember] = {}

    def results(
        self,
        frame: SpaceFrame,
        effects: Effects,
        fundamental: Sequence[Combination],
        seismic: Sequence[Combination],
        overstrength: Mapping[Axis, Overstrength],
        q: Mapping[Axis, float],
        yielded: Sequence[Combination],
        vertical: Sequence[Combination],
    ) -> MemberResults:
        """Check all members.

        Args:
            frame: with the sections of the members.
            fundamental: combinations for persistent design situations.
            seismic: combinations for seismic design situations.
            overstrength: Omega of both directions.
            q: largest factor on seismic effects in both directions, as a rule the behaviour factor.
            yielded: combinations for beams beside buckled braces.
            vertical: seismic combinations with the vertical component.

        Returns:
            Utilisations of all members with what governs them.
        """
        raised, raised_vertical = (
            amplified_combinations(self._design, rows, overstrength, q) for rows in (seismic, vertical)
        )
        if BUCKLING[0] in effects.cases:
            raised = (*raised, *buckling_combinations(raised))
        raised = (*raised, *restrained_combinations(seismic, raised, effects.cases))
        sets = fundamental, seismic, raised, yielded, vertical, raised_vertical
        rows = [row for of_set in sets for row in of_set]
        counts = tuple(map(len, sets))
        members, kinds, slender = self._members(frame, effects, rows)
        found, free_beams = self._checked(frame, members, kinds, slender, effects, rows, counts)
        applies = found.combination >= 0
        return MemberResults(
            checks=tuple(check.name for check in Check),
            clauses=tuple(self._rules.told(CLAUSES[check]) for check in Check),
            utilisation=np.where(applies, found.utilisation, np.nan),
            combination=np.where(applies, found.combination + 1, 0),
            station=np.where(applies, STATIONS[np.maximum(found.station, 0)], np.nan),
            rows=tuple(rows),
            counts=counts,
            slender=tuple(slender),
            members=tuple(members),
            kinds=kinds,
            free_beams=free_beams,
        )

    def under_frozen_forces(self, frame: SpaceFrame, effects: Effects, results: MemberResults) -> np.ndarray:
        """Return the largest utilisation of each member under forces that were found with other sections, (n_members,).

        Returns:
            (n_members,), dimensionless.
        """
        checked = self._members(frame, effects, results.rows)
        found, _ = self._checked(frame, *checked, effects, results.rows, results.counts)
        return found.utilisation.max(axis=1)

    def _checked(
        self,
        frame: SpaceFrame,
        members: Sequence[SteelMember],
        kinds: np.ndarray,
        slender: Sequence[int],
        effects: Effects,
        rows: Sequence[Combination],
        counts: tuple[int, ...],
    ) -> tuple[Utilisations, FreeBeamMoments | None]:
        spectral, factors = _spectral(effects, rows)
        table = MemberTable.of([member.constants for member in members])
        of_members = MemberTable(table.constants[kinds], table.kind[kinds])
        static_factors = effects.static_factors(rows)
        M_b = of_beams = None
        if self._free_beams is not None:
            free, M_b = self._free_beams, np.repeat(of_members.column("M_b_Rd")[:, None], len(rows), axis=1)
            M_Rk = of_members.column("M_y_Rd")[free.members] * self._design.partial_factors.M0
            of_beams = free.resistances(frame, effects, spectral, static_factors, factors, M_Rk)
            M_b[free.members] = of_beams.M_b_Rd
        found = member_checks(
            statics=effects.static,
            spectral=spectral,
            static_factors=static_factors,
            spectral_factors=factors,
            combination_set=np.repeat(np.arange(len(counts)), counts),
            gravity=np.ones(len(effects.cases), dtype=int),
            members=of_members,
            masks=self._masks_of(frame),
            M_b=M_b,
        )
        found.utilisation[slender] = np.where(found.combination[slender] >= 0, np.inf, found.utilisation[slender])
        return found, of_beams

    def _masks_of(self, frame: SpaceFrame) -> np.ndarray:
        """Return the checks of each member with the sections that it has: none without a class."""
        if not frame.unclassified.size:
            return self._masks
        found = self._masks.copy()
        found[frame.unclassified] = 0
        return found

    def _members(
        self, frame: SpaceFrame, effects: Effects, rows: Sequence[Combination]
    ) -> tuple[list[SteelMember], np.ndarray, list[int]]:
        """Return kinds of members under the largest compressions, which of them each is, and members of class 4."""
        pairs, of_members = frame.sections
        kinds = of_members * len(self._roles) + self._role_of_members
        distinct, kind_of_members = np.unique(kinds, return_inverse=True)
        found: list[SteelMember] = []
        undecided: list[int] = []
        too_slender: list[int] = []
        for number, kind in enumerate(distinct):
            (name, material), role = pairs[kind // len(self._roles)], int(kind) % len(self._roles)
            of = self._roles[role]
            least, highest = _classes(
                self._section(name), self._building.materials[material].fy, of.kind != "brace", of.compressed
            )
            if least > LARGEST_CLASS:
                too_slender.append(number)
            elif highest > LARGEST_PLASTIC_CLASS and least != highest:  # the force decides
                undecided.append(number)
            found.append(self._of(name, material, least, role))
        slender = np.flatnonzero(np.isin(kind_of_members, too_slender)).tolist()
        if undecided:
            open_ones = np.flatnonzero(np.isin(kind_of_members, undecided))
            of_them = Effects(effects.cases, effects.static[:, open_ones], effects.seismic[:, open_ones])
            force = np.zeros(len(frame.members))
            force[open_ones] = largest(of_them, rows)[:, :, 0].max(axis=1)
            for number in undecided:
                of_kind = open_ones[kind_of_members[open_ones] == number]
                worst = self._class_of(frame.members[of_kind[0]], float(force[of_kind].max()))
                if worst <= LARGEST_PLASTIC_CLASS:  # then that of all, as the class rises with the force
                    continue
                for place in of_kind:
                    member, role = frame.members[place], int(self._role_of_members[place])
                    of_class = self._class_of(member, float(force[place]))
                    if of_class > LARGEST_CLASS:
                        slender.append(int(place))
                    kind_of_members[place] = len(found)
                    found.append(self._of(member.section, member.material, of_class, role))
        return found, kind_of_members, slender

    def _class_of(self, member: Member, compression: float) -> int:
        fy, bent = self._building.materials[member.material].fy, member.kind != "brace"
        return section_class(self._section(member.section), fy, -compression, about_y=bent).number

    def _of(self, name: str, material: str, of_class: int, role: int) -> SteelMember:
        key = (name, material, of_class <= LARGEST_PLASTIC_CLASS, role)
        if key not in self._known:
            steel = self._building.materials[material]
            self._known[key] = _member(self._design, self._section(name), steel, key[2], self._roles[role])
        return self._known[key]


def as_checked(building: Building, frame: SpaceFrame) -> tuple[list[SteelMember], list[SteelMember]]:
    """Return the members of a frame as the checks see them: all as of class 1 or 2, and all as of class 3.

    Equal members are one object.

    Args:
        building: with steels by thickness and the block `design`.
    """
    design = design_of(building)
    known: dict[tuple[str, str, bool, _Role], SteelMember] = {}

    def of_class(plastic: bool) -> list[SteelMember]:
        found = []
        for member, role in zip(frame.members, _roles_of(design, frame, bracing(frame)), strict=True):
            key = (member.section, member.material, plastic, role)
            if key not in known:
                steel = building.materials[member.material]
                known[key] = _member(design, frame.section(member.section), steel, plastic, role)
            found.append(known[key])
        return found

    return of_class(True), of_class(False)


def member_of_frame(
    design: FrameDesign, section: SteelSection, steel: Steel, plastic: bool, kind: str, length: float, sways: bool
) -> SteelMember:
    """Return a member of a plane frame as the checks see it, with what the design of a building would make of it.

    Args:
        design: lengths, restraints and factors.
        plastic: as of class 1 or 2; else of class 3.
        kind: column, beam or brace.
        length: between supports, m.
        sways: whether it is a column of a frame that sways.
    """
    of: LengthFactors = getattr(design.members.buckling_length, f"{kind}s")
    return _member(design, section, steel, plastic, _Role(kind, length, 0, sways, sways, True, of.y, of.z))


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
    design: Design,
    seismic: Sequence[Combination],
    overstrength: Mapping[Axis, Overstrength],
    q: Mapping[Axis, float],
) -> tuple[Combination, ...]:
    """Return the seismic combinations with 1.1 gamma_ov Omega on the seismic effects; none in ductility class low.

    Along buckling-restrained braces it is beta omega R_y Omega.

    An Omega below 1, of a dissipative member that fails its own check, counts as 1. More than the effects of the
    elastic spectrum, q times those of the design spectrum, cannot come: the factor is at most q. By NTC 2018, 7.2.2, it
    is at most that of a building that does not dissipate energy, q / q_ND.

    Args:
        seismic: combinations for the seismic design situation.
        overstrength: Omega of both directions.
        q: largest factor in both directions.

    Source: EN 1998-1:2004, 6.6.3(1)P, Eq. 6.6; 6.7.4(1), Eq. 6.12; NTC 2018, 7.5.4.2, Eqs. 7.5.7 to 7.5.9.
    """
    if design.ductility_class == "low":
        return ()
    factor = {
        axis: min((of.hardening or OVERSTRENGTH * design.overstrength) * max(of.Omega, 1.0), q[axis])
        for axis, of in overstrength.items()
    }
    found = []
    for row in seismic:
        x, y, z = row.seismic
        name = _SEISMIC_TERM.sub(lambda term: f"{float(term[1] or 1.0) * factor[term[2]]:.3g} E_{term[2]}", row.name)  # type: ignore[index]
        found.append(replace(row, name=name, seismic=(x * factor["x"], y * factor["y"], z)))
    return tuple(found)


def restrained_combinations(
    seismic: Sequence[Combination], raised: Sequence[Combination], cases: Sequence[str]
) -> tuple[Combination, ...]:
    """Return the combinations in which all buckling-restrained braces of a direction have their adjusted strengths.

    They stand in place of the effects of the direction whose action counts in full; across it the amplified effects
    stay. Where there are such braces in both directions, all of them yield at once, as columns may be common to both
    (D1.4a).

    Args:
        seismic: combinations for the seismic design situation.
        raised: the same with amplified effects, in the same order, and maybe others behind them.
        cases: names of the static cases.

    Source: AISC 341-16, F4.3 and D1.4a; EN 1998-1:2004, 4.3.3.5.1(3), for what acts across.
    """
    axes = [axis for axis in AXES if restrained_case(axis, 0) in cases]
    found: dict[tuple[object, ...], Combination] = {}
    for plain, row in zip(seismic, raised, strict=False):
        full = [axis for axis in axes if abs(plain.seismic[AXES.index(axis)]) == 1.0]
        if not full or min(row.seismic[:2]) <= 0.0:  # one sense of both is enough: spectral effects have no sign
            continue
        gone = axes if len(axes) == 2 else full
        x, y = (0.0 if axis in gone else row.seismic[k] for k, axis in enumerate(AXES))
        name = row.name
        for axis in gone:
            name = re.sub(rf" \+ (?:[0-9.]+ )?E_{axis}\b", "", name)
        for senses in product(range(2), repeat=len(gone)):
            added = [restrained_case(axis, sense) for axis, sense in zip(gone, senses, strict=True)]
            static = {**row.static, **dict.fromkeys(added, 1.0)}
            key = (x, y, *sorted(static.items()))
            found.setdefault(
                key, replace(row, name=" + ".join([name, *added]), static=static, seismic=(x, y, row.seismic[2]))
            )
    return tuple(found.values())


def _masks(
    frame: SpaceFrame, design: Design, of_axes: Mapping[Axis, np.ndarray], halves: np.ndarray, vertical: np.ndarray
) -> np.ndarray:
    """Return the checks of each member in each set of combinations, as bits, (n_members, n_sets)."""
    capacity = design.ductility_class != "low"
    usual = {kind: mask(*SECTION_CHECKS, *MEMBER_CHECKS) for kind in ("beam", "column")}
    usual["brace"] = mask(Check.N, Check.N_B)
    masks = np.zeros((len(frame.members), VERTICAL_CAPACITY + 1), dtype=np.intc)
    masks[halves, YIELDED] = usual["beam"]
    dissipative = {int(number) for axis in AXES for number in of_axes[axis]}
    frames = any(system_of(design, axis).type == MOMENT_FRAME for axis in AXES)
    for number, member in enumerate(frame.members):
        of_kind = usual[member.kind]
        dissipates = number in dissipative
        if not member.compression:
            of_kind = mask(Check.N)  # in tension; the diagonal of the pair in compression is not there
        if frame.section(member.section).kind == "BRB":
            of_kind = mask(Check.N)  # its casing keeps it from buckling
        masks[number, PERSISTENT] = of_kind
        beside_link = member.eccentric and member.kind == "beam" and design.members.beams_beside_links == "seismic"
        masks[number, SEISMIC if dissipates or beside_link or not capacity else CAPACITY] = of_kind
        if capacity and dissipates and member.kind == "beam" and not member.link:
            masks[number, SEISMIC] |= mask(*BEAM_CHECKS)
        if capacity and frames and member.kind == "column":
            masks[number, CAPACITY] |= mask(Check.COLUMN_V)
    masks[vertical, VERTICAL], masks[vertical, VERTICAL_CAPACITY] = masks[vertical, SEISMIC], masks[vertical, CAPACITY]
    return masks


@dataclass(frozen=True)
class _Role:
    """What the constants of a member depend on beside its section and steel.

    Attributes:
        kind: column, beam or brace.
        length: between supports, m; braces that meet a beam do not support it (EN 1998-1, 6.7.4(2)).
        hinges: at how many ends a beam passes moments on.
        sways_y, sways_z: a column that bends about this axis in a moment frame.
        compressed: whether it may have an axial force.
        y, z: buckling length over its length, about either axis.
    """

    kind: str
    length: float
    hinges: int
    sways_y: bool
    sways_z: bool
    compressed: bool
    y: float
    z: float


def _compressed(frame: SpaceFrame, bracing: Bracing) -> np.ndarray:
    """Return which members may have axial forces, (n_members,): all but beams inside a diaphragm without braces."""
    start, end = frame.ends
    found = np.array([member.kind != "beam" for member in frame.members])
    found |= (frame.node_diaphragm[start] == NO_DIAPHRAGM) | (frame.node_diaphragm[start] != frame.node_diaphragm[end])
    found[bracing.collectors] = True
    return found


def _roles_of(design: Design, frame: SpaceFrame, braced: Bracing) -> list[_Role]:
    compressed = _compressed(frame, braced).tolist()
    return [_role(design, *of) for of in zip(frame.members, braced.span.tolist(), compressed, strict=True)]


def _role(design: Design, member: Member, length: float, compressed: bool) -> _Role:
    sway = [axis for axis in AXES if system_of(design, axis).type == MOMENT_FRAME]
    about = {bends_about_y(member, axis) for axis in sway} if member.kind == "column" else set()
    hinges = sum(stiffness > 0.0 for stiffness in (member.ends[0], member.ends[2])) if member.kind == "beam" else 0
    of = design.members.buckling_length.of(member.kind, member.group, member.storey)
    return _Role(member.kind, length, hinges, True in about, False in about, compressed, of.y, of.z)


@cache
def _classes(section: SteelSection, fy: float, bent: bool, compressed: bool) -> tuple[int, int]:
    """Return the least and the highest class of a section, with which it rises, up to its whole area in compression."""
    if not section.has_class:
        return 1, 1  # none of its checks is asked for
    forces = (0.0, -section.A * fy if compressed else 0.0)
    least, highest = (section_class(section, fy, N, about_y=bent, about_z=False).number for N in forces)
    return least, highest


def _member(
    design: Design | FrameDesign, section: SteelSection, steel: Steel, plastic: bool, role: _Role
) -> SteelMember:
    """Return a member as its checks see it; `plastic`: of class 1 or 2.

    Moment factors are those of a uniform moment, which is on the safe side, but for sway (Table B.3). So is M_cr, but
    that of beams without a slab is found in each combination.
    """
    checks, factors = design.members, design.partial_factors
    restrained = (role.kind == "beam" and checks.lateral_restraint.beams == "slab") or (
        role.kind == "column" and checks.lateral_restraint.columns == "all_along"
    )
    V_M = 0.0
    if role.hinges and section.has_class:
        M_pl = cross_section.moment_resistance(section.W_pl_y, steel.fy, factors.M0)
        V_M = 0.5 * role.hinges * float(hinge_shear(M_pl, M_pl, role.length))
    annex_a = checks.interaction == "annex_a"
    uniform, slope = linear_moment_factor_a(1.0, 0.0, 1.0), linear_moment_factor_a(1.0, 1.0, 1.0)
    return SteelMember(
        section,
        steel.fy,
        Stability(
            L_cr_y=role.y * role.length,
            L_cr_z=0.0 if role.kind == "beam" and restrained else role.z * role.length,
            L_LT=0.0 if restrained or role.kind == "brace" else role.length,
            C_my=uniform if annex_a else SWAY if role.sways_y else 1.0,
            C_mz=uniform if annex_a else SWAY if role.sways_z else 1.0,
            C_mLT=1.0,
            C_my_N=slope - uniform,
            C_mz_N=slope - uniform,
            twists=not (role.kind == "beam" and restrained),
        ),
        LARGEST_PLASTIC_CLASS if plastic else LARGEST_CLASS,
        V_M=V_M,
        E=steel.E,
        G=steel.E / (2.0 * (1.0 + steel.nu)),
        gamma_M0=factors.M0,
        gamma_M1=factors.M1,
        annex_a=annex_a,
    )
