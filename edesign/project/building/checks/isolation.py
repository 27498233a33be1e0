"""Cross checks of an isolated base of a building: lines and laws that exist, columns on isolators or free, its mass."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.building.isolation import Isolation
from edesign.project.building.supports import Springs
from edesign.project.checks.isolation import check_isolated_analyses, check_isolator, check_law
from edesign.project.frame.sections import Catalogue, no_section
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name

_AT: Keys = ("dampers", "isolation")


def check_isolation(building: Building, problems: Problems, profiles: Catalogue | None) -> None:
    """Check the isolated base of a building, which may have none.

    Args:
        building: its members are right.
        profiles: names of the catalogue; None leaves section names unchecked.
    """
    isolation = building.isolation
    if isolation is None:
        return
    check = Selections(building, problems)
    bases = [str(line) for line in building.layout.node_lines[0]]
    taken: dict[str, int] = {}
    inside = True
    for i, isolator in enumerate(isolation.isolators):
        keys: Keys = (*_AT, "isolators", i)
        good = check.lines((*keys, "at"), isolator.at)
        inside &= good
        check_isolator(building, problems, i, isolator, taken, "at")
        under = isolator.under(building.grid.lines, building.grid)
        bare = [line for line in under if line not in bases]
        if good and bare and not isolator.at.is_all and len(bare) == len(under):
            message = f"no column stands on line {listed(bare)}; `all` takes the lines that have one [E-NAME-01]"
            problems.at_value((*keys, "at"), message)
    for i, item in enumerate(isolation.beside):
        inside &= check.lines((*_AT, "beside", i, "at"), item.at)
        check_law(building, problems, (*_AT, "beside", i), item)
    standing = [line for line in building.footings if line in taken]
    if standing:
        message = f"line {standing[0]} stands on an isolator, and on a footing by `supports`; leave the footing out"
        problems.at_key((*_AT, "isolators"), f"{message} [E-ISOL-01]")
    if building.held_floors:
        message = "the ground holds a floor above the isolators, which could not move; leave it out, or the isolators"
        problems.at_key(("restrained_floors",), f"{message} [E-ISOL-01]")
    if inside:
        _other_bases(building, problems, [line for line in bases if line not in taken])
    _base(building, problems, isolation, profiles)
    check_isolated_analyses(building, problems)


def _other_bases(building: Building, problems: Problems, lines: list[str]) -> None:
    """Column bases without an isolator do not restrain the base in plan."""
    supports = {str(line): building.support(line) for line in building.layout.node_lines[0]}
    sliding = {line for line, at in supports.items() if isinstance(at, Springs) and (at.ux, at.uy) == ("free", "free")}
    restrained = [line for line in lines if line not in sliding]
    if restrained:
        one = len(restrained) == 1
        found = f"line{'s' * (not one)} {listed(restrained)} {'has' if one else 'have'} no isolator"
        message = f"{found} and would restrain the base; isolate them, or let them slide: `ux: free, uy: free`"
        problems.at_key((*_AT, "isolators"), f"{message} [E-ISOL-01]")


def _base(building: Building, problems: Problems, isolation: Isolation, profiles: Catalogue | None) -> None:
    """The base has a mass in analyses with masses, and beams between column bases, which nothing else restrains."""
    base, masses = isolation.base, building.masses
    if base.beams is not None and base.rotation is not None:
        message = "the column bases turn with the `beams` of the base; leave `rotation` out, or the beams [E-KEY-03]"
        problems.at_key((*_AT, "base", "rotation"), message)
    if base.beams is None and base.rotation is None:
        message = "how do the column bases turn? with `beams`, which bring their moments to the isolators"
        problems.at_key(
            (*_AT, "base"), f"{message}, or restrained by `rotation`, which lets these into the ground [E-ISOL-02]"
        )
    if base.beams is not None:
        if base.beams.material not in building.materials:
            message = unknown_name("material", base.beams.material, building.materials)
            problems.at_value((*_AT, "base", "beams", "material"), message)
        own = base.beams.section in building.sections
        if profiles is not None and not own and profiles.canonical(base.beams.section) is None:
            message = no_section(base.beams.section, building.sections, profiles)
            problems.at_value((*_AT, "base", "beams", "section"), message)
    if base.Q and base.category is None:
        message = "this key is missing, as there is Q: the category of the use, such as `A` [E-KEY-02]"
        problems.under((*_AT, "base"), "category", message)
    if base.mass is not None and masses is None:
        message = "the building itself has no `masses`, which analyses with masses need [E-MODAL-02]"
        problems.at_key((*_AT, "base", "mass"), message)
    if base.mass is None and masses is not None and (masses.from_loads is None or not base.G + base.Q > 0.0):
        message = "the base has no mass; give `mass`, or loads `G` and `Q` with `masses.from_loads` [E-MODAL-02]"
        problems.at_key((*_AT, "base"), message)
