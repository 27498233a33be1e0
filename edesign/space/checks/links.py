"""Seismic links of eccentric bracings, EN 1998-1:2004, 6.8; NTC 2018, 7.5.6."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.steel.concentric_braces import least_and_most
from edesign.codes.ec8.steel.eccentric_braces import (
    HOMOGENEITY,
    Category,
    LinkStiffeners,
    largest_rotation,
    link_resistance,
    link_stiffeners,
    longest_under_axial_force,
    overstrength_of_link,
    rotation,
)
from edesign.codes.ec8.verification.capacity import OVERSTRENGTH
from edesign.codes.rule_check import RuleCheck, at_most, first_of_largest
from edesign.errors import InputError
from edesign.frame.sections.steel_section import SteelSection
from edesign.project.building.building import Building, Steel
from edesign.project.building.design import Design
from edesign.space.analysis.storeys import Storeys
from edesign.space.checks.capacity import Overstrength
from edesign.space.file_places import keys_of_member
from edesign.space.structure.frame import Axis, SpaceFrame

N, V_Z, M_Y = 0, 2, 4  # places in internal forces
_LATERAL_SHARE = 0.06  # of f_y b t_f, EN 1998-1, 6.8.2(14)


@dataclass(frozen=True)
class Link:
    """A seismic link with its effects in the seismic design situation, its limits, and what it asks for.

    Attributes:
        member: its name.
        axis: of the bracing.
        section: its section.
        e: length, m.
        alpha: smaller over greater moment at its ends.
        e_s, e_L: up to which it is short, from which it is long, m.
        category: `short`, `intermediate` or `long`.
        N_Ed, V_Ed, M_Ed: N and N m, without sign.
        axial: N_Ed / N_pl,Rd.
        V_p, M_p: resistances, less beside an axial force above 0.15 N_pl,Rd, N and N m.
        longest: largest length where N_Ed is at least 0.15 N_pl,Rd, m; infinite elsewhere.
        Omega: Omega_i.
        theta_p, theta_pR: rotation and its limit, rad.
        lateral: force for which the lateral supports of either flange at its ends are designed, N.
        stiffeners: of its web.
    """

    member: str
    axis: Axis
    section: str
    e: float
    alpha: float
    e_s: float
    e_L: float
    category: Category
    N_Ed: float
    V_Ed: float
    M_Ed: float
    axial: float
    V_p: float
    M_p: float
    longest: float
    Omega: float
    theta_p: float
    theta_pR: float
    lateral: float
    stiffeners: LinkStiffeners

    @property
    def shear_use(self) -> float:
        """V_Ed / V_p,link."""
        return self.V_Ed / self.V_p if self.V_p > 0.0 else np.inf

    @property
    def moment_use(self) -> float:
        """M_Ed / M_p,link."""
        return self.M_Ed / self.M_p if self.M_p > 0.0 else np.inf


def links(
    building: Building,
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    acting: np.ndarray,
    members: np.ndarray,
    storeys: Storeys,
    elastic_drift: np.ndarray,
) -> tuple[Link, ...]:
    """Return the links of one direction.

    The plastic drift of a storey is its design drift less the elastic one under the design spectrum: no link that
    passes its checks yields before.

    Args:
        building: of the file, for the places of errors.
        materials: steels, by name.
        acting: (n_members, n_stations, 6) largest effects in the seismic design situation.
        members: (n,) numbers of the links.
        storeys: under the action in this direction.
        elastic_drift: (n_storeys,) d_e under the design spectrum, m.

    Raises:
        InputError: a link has no I section.
    """
    plastic = np.maximum(storeys.drift - elastic_drift, 0.0) / storeys.height
    braced = {
        node: member.storey
        for member in frame.members
        if member.kind == "brace" and member.eccentric
        for node in (member.start, member.end)
    }
    found = []
    for number in members:
        member = frame.members[number]
        section, f_y = frame.section(member.section), materials[member.material].fy
        of = link_resistance(f_y, *_i_section(building, member.name, section))
        e = float(frame.length[number])
        N_Ed, V_Ed = (float(acting[number, :, place].max()) for place in (N, V_Z))
        ends = acting[number, [0, -1], M_Y]
        M_Ed = float(acting[number, :, M_Y].max())
        alpha = float(ends.min() / ends.max()) if ends.max() > 0.0 else 1.0
        e_s, e_L = of.limits(alpha)
        category = of.category(e, alpha)
        storey = next(braced[node] for node in (member.start, member.end) if node in braced)
        theta_p = rotation(float(plastic[storey - 1]), e / (member.part[1] - member.part[0]), e)
        reduced = of.reduced(N_Ed)
        web = section.tw * (section.h - 2.0 * section.tf) / section.A
        longest = longest_under_axial_force(of, N_Ed, V_Ed, web)
        found.append(
            Link(
                member=member.name,
                axis=storeys.axis,
                section=member.section,
                e=e,
                alpha=alpha,
                e_s=e_s,
                e_L=e_L,
                category=category,
                N_Ed=N_Ed,
                V_Ed=V_Ed,
                M_Ed=M_Ed,
                axial=N_Ed / of.N_pl,
                V_p=reduced.V_p,
                M_p=reduced.M_p,
                longest=np.inf if longest is None else longest,
                Omega=overstrength_of_link(of, category, V_Ed, M_Ed),
                theta_p=theta_p,
                theta_pR=largest_rotation(e, e_s, e_L),
                lateral=_LATERAL_SHARE * f_y * section.b * section.tf,
                stiffeners=link_stiffeners(of, category, e, theta_p, section.b, section.tw, section.h),
            )
        )
    return tuple(found)


def _i_section(building: Building, member: str, section: SteelSection) -> tuple[float, float, float, float, float]:
    """Return A, b, t_f, t_w and d of the I section of a link."""
    if section.kind != "I":
        place = building.where(*keys_of_member(building, member), "section")
        raise InputError(
            f"{place}: {member} is a seismic link, and its section {section.name} is no I section, of which alone EN "
            "1998-1, 6.8.2(3), gives the resistances; give its group I sections [E-SPACE-11]"
        )
    return section.A, section.b, section.tf, section.tw, section.h


def overstrength_of_links(of: Sequence[Link], members: np.ndarray, axis: Axis) -> Overstrength:
    """Return Omega of one direction: the least Omega_i of its links.

    Args:
        of: links of this direction.
        members: (n,) their numbers.

    Source: EN 1998-1:2004, 6.8.3(1); NTC 2018, 7.5.6.
    """
    ratios = np.array([link.Omega for link in of])
    least = first_of_largest(-ratios)
    return Overstrength(axis, members, ratios, float(ratios[least]), of[least].member)


def beside_links(of: Sequence[Link], design: Design, q: float) -> list[str]:
    """Return a remark on beams beside links that have the effects of a building that does not dissipate energy.

    Args:
        of: links of one direction; none of another system.
        design: with gamma_ov, and the effects on these beams.
        q: behaviour factor of the direction.
    """
    factor = OVERSTRENGTH * design.overstrength * min((link.Omega for link in of), default=0.0)
    if factor <= q or design.members.beams_beside_links == "seismic" or design.ductility_class == "low":
        return []
    return [
        f"1.1 gamma_ov Omega of links along {of[0].axis} is {factor:.3g}, and counts as q = {q:.3g}: what is beside "
        "them resists as without dissipation; shorter links, or `beams_beside_links: seismic`, let links be weaker"
    ]


def link_criteria(of: Sequence[Link], overstrength: float) -> list[RuleCheck]:
    """Return the rules for the links of one direction; the worst link counts, and details are told.

    Args:
        of: links of this direction.
        overstrength: gamma_ov.

    Returns:
        Strength, length, homogeneity, rotation; category, stiffeners, lateral supports and connections for information.
    """
    axis = f"direction {of[0].axis}"

    def worst(values: list[float]) -> tuple[float, str]:
        number = first_of_largest(np.array(values))
        return values[number], of[number].member

    found = [
        at_most("6.8.2(4)", f"V_Ed / V_p,link of links, {axis}", 1.0, *worst([link.shear_use for link in of])),
        at_most("6.8.2(4)", f"M_Ed / M_p,link of links, {axis}", 1.0, *worst([link.moment_use for link in of])),
    ]
    if any(np.isfinite(link.longest) for link in of):
        uses = [link.e / link.longest if link.longest > 0.0 else np.inf for link in of]
        text = f"e over its limit where N_Ed >= 0.15 N_pl,Rd, {axis}"
        found.append(at_most("6.8.2(6)", text, 1.0, *worst(uses)))
    ratios = [link.Omega for link in of]
    detail = least_and_most(ratios, [link.member for link in of])
    text = f"overstrength of the links over the least one, {axis}"
    found.append(at_most("6.8.2(7)", text, HOMOGENEITY, max(ratios) / min(ratios) - 1.0, detail))
    use, name = worst([link.theta_p / link.theta_pR for link in of])
    link = next(link for link in of if link.member == name)
    detail = f"{name}, {link.theta_p:.3g} of {link.theta_pR:.3g} rad"
    found.append(at_most("6.8.2(10)", f"theta_p / theta_pR of links, {axis}", 1.0, use, detail))
    kinds = {kind: sum(link.category == kind for link in of) for kind in ("short", "intermediate", "long")}
    told = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if count)
    lateral, at = worst([link.lateral for link in of])
    factor, of_link = worst([OVERSTRENGTH * overstrength * link.Omega for link in of])
    for clause, text, value, unit, detail in (
        ("6.8.2(8)", f"links by their length, {axis}", float(len(of)), "", told),
        ("6.8.2(11)", f"stiffeners between the ends of a link, most, {axis}", *_stiffened(of)),
        ("6.8.2(14)", f"lateral support of both flanges at the ends of links, {axis}, kN", lateral / 1e3, "kN", at),
        ("6.8.4(1)", f"1.1 gamma_ov Omega_i on E_d,E of connections of links, most, {axis}", factor, "", of_link),
    ):
        found.append(RuleCheck(clause, text, None, value, unit, None, detail))
    return found


def _stiffened(of: Sequence[Link]) -> tuple[float, str, str]:
    """Return the largest number of stiffeners inside of a link, its unit, and what is told beside."""
    most = max(of, key=lambda link: link.stiffeners.count)
    return float(most.stiffeners.count), "", f"{most.member}; the table of links has all"
