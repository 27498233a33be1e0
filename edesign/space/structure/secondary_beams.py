"""Secondary beams of floors: how many of which section there are, and what lies on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from edesign.codes.ec3.section import DENSITY
from edesign.frame.sections.own_section import section_of
from edesign.project.building.building import Building
from edesign.project.building.layout import Panel
from edesign.project.building.loads import Areas
from edesign.project.building.places import panels_in
from edesign.project.notation.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class SecondaryBeam:
    """Equal secondary beams: pinned, with the loads of their strip of floor.

    Attributes:
        section, material: names of the file.
        length: m.
        strip: distance to the next, m.
        G: permanent load with its own weight where that counts, N/m downwards.
        G2: permanent load that is not structural, N/m downwards.
        Q: variable load by category, N/m downwards.
        floors: where they are.
        number: of all of them.
    """

    section: str
    material: str
    length: float
    strip: float
    G: float
    G2: float
    Q: Mapping[str, float]
    floors: tuple[int, ...]
    number: int

    @property
    def name(self) -> str:
        """What people call it: `secondary beams IPE240 over 6 m`."""
        return f"secondary beams {self.section} over {self.length:.4g} m"


def own_weight(building: Building, load: Areas) -> float:
    """Return the weight of the secondary beams of a load, N/m of each; 0 without section, or where none counts."""
    if load.secondary_section is None or not building.loads.self_weight:
        return 0.0
    return section_of(building, load.secondary_section).A * DENSITY * STANDARD_GRAVITY


def secondary_beams(building: Building) -> list[SecondaryBeam]:
    """Return the secondary beams that have a section, equal ones together, from the lowest floor on.

    All area loads of a bay that span its way over as many secondary beams lie on them.
    """
    widths_x, widths_y = building.widths("x"), building.widths("y")
    found: dict[tuple[object, ...], SecondaryBeam] = {}
    for floor in range(1, building.n_storeys + 1):
        loads = [load for load in building.loads.areas if floor in load.floors.numbers(1, building.n_storeys)]
        on: dict[Panel, list[Areas]] = {}
        for load in loads:
            for panel in panels_in(load.bays, len(widths_x), len(widths_y)) & building.layout.floors[floor]:
                on.setdefault(panel, []).append(load)
        for panel in sorted(on):
            for of in on[panel]:
                if of.secondary_section is None or of.secondary_material is None:
                    continue
                width_x, width_y = widths_x[panel[0] - 1], widths_y[panel[1] - 1]
                span, length = (width_x, width_y) if of.spans == "x" else (width_y, width_x)
                strip = span / (of.secondary_beams + 1)
                alike = [one for one in on[panel] if (one.spans, one.secondary_beams) == (of.spans, of.secondary_beams)]
                Q: dict[str, float] = {}
                for one in alike:
                    if one.category is not None and one.Q:
                        Q[one.category] = Q.get(one.category, 0.0) + one.Q * strip
                G = sum(one.G for one in alike) * strip + own_weight(building, of)
                G2 = sum(one.G2 for one in alike) * strip
                key = (of.secondary_section, of.secondary_material, length, strip, G, G2, tuple(sorted(Q.items())))
                known = found.get(key)
                floors = dict.fromkeys((*(known.floors if known else ()), floor))
                number = (known.number if known else 0) + of.secondary_beams
                names = of.secondary_section, of.secondary_material
                found[key] = SecondaryBeam(*names, length, strip, G, G2, Q, tuple(floors), number)
    return list(found.values())
