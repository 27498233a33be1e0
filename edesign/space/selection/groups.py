"""The groups of a building with the sections that each may have."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from edesign.codes.ec8.steel.concentric_braces import FEW_STOREYS, SLENDERNESS, SLENDERNESS_CLAUSES
from edesign.errors import InputError
from edesign.frame.sections.section_lists import efficient, family_of, sections_of
from edesign.frame.sections.steel_section import SteelSection, steel_section
from edesign.project.building.design import DEFAULT_PRICE
from edesign.project.reading.problems import keys_text, listed
from edesign.space.checks.member_checks import LARGEST_CLASS
from edesign.space.checks.rules import (
    allowed_class,
    dissipative_class,
    pattern_of,
    slenderness_of_one_metre,
    wall_ratio,
)
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.structure.design_block import design_of, left_out, rules_of
from edesign.space.structure.frame import AXES


@dataclass(frozen=True)
class Group:
    """Members of one section.

    Attributes:
        name: of the file.
        kind: column, beam or brace.
        material: name of its steel; with yield strengths by thickness that of the section in the file.
        sections: names of those that it may have, the cheapest first; that of the file if its lists have it.
        mass: (n_sections,) of all its members with each section, kg.
        cost: (n_sections,) that mass times its price, or the mass itself where that is to be least.
        area: (n_sections,) m2.
        records: numbers of the sections that are stiffer about y than every cheaper one.
        stiffer: (n_sections,) numbers of the sections that cost more and are stiffer about y, the cheapest first.
        left_out: sections of its lists whose class is too high, or that are thicker than their steel is made.
    """

    name: str
    kind: str
    material: str
    sections: tuple[str, ...]
    mass: tuple[float, ...]
    cost: tuple[float, ...]
    area: tuple[float, ...]
    records: tuple[int, ...]
    stiffer: tuple[tuple[int, ...], ...]
    left_out: tuple[str, ...]

    def nearest(self, section: SteelSection) -> int:
        """Return the number of a section; of one off the list, of the cheapest that is as large and as stiff.

        Where none is, it is the last one.
        """
        if section.name in self.sections:
            return self.sections.index(section.name)
        every = enumerate(map(steel_section, self.sections))
        return next((k for k, of in every if of.A >= section.A and of.I_y >= section.I_y), len(self.sections) - 1)


def groups_of(analysis: ElasticAnalysis) -> tuple[Group, ...]:
    """Return the groups of a building in the order of its members.

    Raises:
        InputError: a list has a name that is no section or family, or nothing of it may be used.
    """
    return tuple(_group(analysis, name) for name in dict.fromkeys(of.group for of in analysis.frame.members))


def _group(analysis: ElasticAnalysis, name: str) -> Group:
    building, frame = analysis.building, analysis.frame
    numbers = [number for number, of in enumerate(frame.members) if of.group == name]
    member = frame.members[numbers[0]]
    (_, steel), kinds = analysis.sections.steel_of(name, member.section), f"{member.kind}s"
    select = design_of(building).select
    keys = ("lists", "groups", name) if name in select.lists.groups else ("lists", kinds)
    asked = select.lists.groups.get(name) or getattr(select.lists, kinds)
    depth = min((select.largest_depth[key] for key in (kinds, name) if key in select.largest_depth), default=math.inf)
    highest = _allowed_class(analysis, numbers)
    price, slender = _prices(analysis), _slender(analysis, name, numbers)
    chosen, left_out, given = set[str](), list[str](), frame.section(member.section).name
    restrained = frame.section(member.section).kind == "BRB"
    for place, text in enumerate(asked):
        try:
            whole = [of for of in sections_of(text) if of.h <= depth and (of.kind == "BRB") == restrained]
        except InputError as error:
            where = building.where("design", "select", *keys, place)
            raise InputError(f"{where}: {keys_text(('design', 'select', *keys))}: {error}") from error
        bent = member.kind != "brace"
        fit = [of for of in whole if _fits(analysis, name, of.name, bent, highest) and slender(of)]
        left_out += [of.name for of in whole if of not in fit]
        spare = len(whole) > 1 and not (select.same_depth or select.most_sections)  # which a dominated one may serve
        kept = efficient(fit, lambda of: of.A * price(of.name)) if spare else fit
        chosen |= {of.name for of in fit if of in kept or of.name == given}
    if not chosen:
        why = f"; of a class above {highest}, too thick, or of a wrong slenderness are {listed(left_out)}"
        why = why if left_out else ""
        why += "; its braces are buckling-restrained: list areas of cores, such as `BRB20`" if restrained else ""
        why += f"; largest_depth is {1e3 * depth:g} mm" if depth < math.inf else ""
        where = building.where("design", "select", *keys)
        raise InputError(
            f"{where}: {keys_text(('design', 'select', *keys))}: group {name} has no section left{why} [E-SPACE-07]"
        )
    ordered = sorted(chosen, key=lambda section: (steel_section(section).A * price(section), section))
    area = tuple(steel_section(section).A for section in ordered)
    metres = float(frame.length[numbers].sum())
    mass = tuple(value * steel.density * metres for value in area)
    inertia = list(area) if restrained else [steel_section(section).I_y for section in ordered]
    stiffer = tuple(
        tuple(k for k in range(number + 1, len(ordered)) if inertia[k] > inertia[number])
        for number in range(len(ordered))
    )
    return Group(
        name=name,
        kind=member.kind,
        material=member.material,
        sections=tuple(ordered),
        mass=mass,
        cost=tuple(of * price(section) for of, section in zip(mass, ordered, strict=True)),
        area=area,
        records=tuple(k for k, value in enumerate(inertia) if value > max(inertia[:k], default=0.0)),
        stiffer=stiffer,
        left_out=tuple(dict.fromkeys(left_out)),
    )


def _prices(analysis: ElasticAnalysis) -> Callable[[str], float]:
    """What a kilogram of a section costs; 1 where the mass is to be least."""
    building = analysis.building
    select = design_of(building).select
    prices = {name.upper(): value for name, value in select.prices.items()}

    def price(section: str) -> float:
        if select.objective == "mass":
            return 1.0
        family = family_of(section)
        if family in prices or DEFAULT_PRICE in select.prices:
            return prices.get(family, select.prices.get(DEFAULT_PRICE, 0.0))
        where = building.where("design", "select", "prices")
        raise InputError(
            f"{where}: design.select.prices: there is no price of {family}, to which {section} belongs; give it, or "
            f"`{DEFAULT_PRICE}` [E-SPACE-08]"
        )

    return price


def _fits(analysis: ElasticAnalysis, group: str, section: str, bent: bool, highest: int) -> bool:
    """Say whether a section is of a class that its group may have, and no thicker than its steel is made."""
    try:
        _, steel = analysis.sections.steel_of(group, section)
    except InputError:
        return False
    return dissipative_class(steel_section(section), steel.fy, bent).number <= highest


def _slender(analysis: ElasticAnalysis, group: str, members: Sequence[int]) -> Callable[[SteelSection], bool]:
    """Say whether diagonals of a section would have the slenderness and the walls that the code allows."""
    frame, design = analysis.frame, design_of(analysis.building)
    ranges: list[tuple[float, float]] = []  # of the slenderness of one metre, the lower end excluded
    if frame.n_floors > FEW_STOREYS and design.ductility_class != "low":
        for number in members:
            member = frame.members[number]
            factor = design.members.buckling_length.of(member.kind, member.group, member.storey)
            length = max(factor.y, factor.z) * float(frame.length[number])
            pattern = pattern_of(member)
            if member.kind == "brace" and SLENDERNESS_CLAUSES[pattern] not in left_out(design):
                least, most = SLENDERNESS[pattern]
                ranges.append((least / length, most / length))
    rules, brace = rules_of(design), frame.members[members[0]].kind == "brace"
    walls = rules.hollow_braces if brace and design.ductility_class != "low" else None
    if f"{rules.title}, 7.5.5" in left_out(design):
        walls = None

    def fits(section: SteelSection) -> bool:
        if section.kind == "BRB":
            return True
        wall = None if walls is None else wall_ratio(section, walls)
        if wall is not None and wall[1] > wall[2]:
            return False
        if not ranges:
            return True
        of_one_metre = slenderness_of_one_metre(section, analysis.sections.steel_of(group, section.name)[1])
        return all(least < of_one_metre <= most for least, most in set(ranges))

    return fits


def _allowed_class(analysis: ElasticAnalysis, members: Sequence[int]) -> int:
    """The highest class that the members of a group may have."""
    design = design_of(analysis.building)
    of_axes = [
        allowed_class(design, analysis.q[axis], analysis.q_limit[axis], analysis.regular)
        for axis in AXES
        if not set(analysis.dissipative[axis].tolist()).isdisjoint(members)
    ]
    return min([*of_axes, LARGEST_CLASS])
