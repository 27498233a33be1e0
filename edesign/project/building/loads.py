"""Permanent (G) and variable (Q) loads of a building, downwards, and the masses that follow from them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.actions.loads import PartialLoad, PointLoad
from edesign.project.actions.national import Psi
from edesign.project.building.members import BeamPlaces
from edesign.project.building.own_cases import CaseName, LoadCaseOfFile
from edesign.project.building.places import ALL_BAYS, ALL_COLUMN_LINES, Bays, ColumnLines
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.units import AreaLoad as ForcePerArea
from edesign.project.notation.units import Factor, Force, LineLoad, PositiveMass, PositiveRatio
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Category = Literal["A", "B", "C", "D", "E", "F", "G", "H", "snow"]
"""Of the use of a floor or roof, EN 1991-1-1, 6.3; snow by EN 1991-1-3."""
Span = Literal["x", "y", "two_way"]


class Areas(Model):
    """Load on some bays of some floors; loads on one bay add up.

    A floor that spans along x rests on the beams along y, at both sides of its bay. With secondary beams it rests on
    that many more beams along y at equal distances, and these on the beams along x.

    Attributes:
        floors: floors that have the load.
        bays: bays of the plan that have the load; `all` takes those that a floor covers.
        G: permanent load, positive downwards.
        G2: permanent load that is not structural, of buildings by NTC 2018 (Table 2.6.I), positive downwards.
        Q: variable load, positive downwards.
        category: category of the use (EN 1991-1-1, 6.3), needed where there is Q.
        spans: the way that the floor spans.
        secondary_beams: beams across the span in each bay.
        secondary_section: section of these beams, which then weigh and are checked; without the key they do neither.
        secondary_material: one of `materials`, with `secondary_section`.
    """

    floors: Numbers = ALL_NUMBERS
    bays: Bays = ALL_BAYS
    G: ForcePerArea = 0.0
    G2: ForcePerArea = 0.0
    Q: ForcePerArea = 0.0
    category: Category | None = None
    spans: Span
    secondary_beams: Annotated[int, Field(ge=0, le=20)] = 0
    secondary_section: str | None = None
    secondary_material: str | None = None


class PerimeterLoad(Model):
    """Load on all beams at the edge of some floors.

    Attributes:
        floors: floors whose edges have the load.
        G: permanent load, positive downwards.
        G2: permanent load that is not structural, of buildings by NTC 2018 (Table 2.6.I), positive downwards.
        Q: variable load, positive downwards.
        category: category of the use (EN 1991-1-1, 6.3), needed where there is Q.
    """

    floors: Numbers = ALL_NUMBERS
    G: LineLoad = 0.0
    G2: LineLoad = 0.0
    Q: LineLoad = 0.0
    category: Category | None = None


class BeamLoad(BeamPlaces):
    """Loads on beams: uniform, at points and on parts.

    Attributes:
        G: permanent load on the whole beam, positive downwards.
        G2: permanent load on the whole beam that is not structural, of buildings by NTC 2018 (Table 2.6.I).
        Q: variable load on the whole beam, positive downwards.
        points: forces at places along each beam, from its end with the smaller coordinate.
        partial: loads on a part of each beam, from its end with the smaller coordinate.
        category: category of the use (EN 1991-1-1, 6.3), needed where there is Q.
    """

    G: LineLoad = 0.0
    G2: LineLoad = 0.0
    Q: LineLoad = 0.0
    points: tuple[PointLoad, ...] = ()
    partial: tuple[PartialLoad, ...] = ()
    category: Category | None = None


class NodeLoad(Model):
    """Load on the nodes of column lines at some floors.

    Attributes:
        at: column lines of the nodes.
        floors: floors of the nodes.
        G: permanent force, positive downwards.
        G2: permanent force that is not structural, of buildings by NTC 2018 (Table 2.6.I).
        Q: variable force, positive downwards.
        category: category of the use (EN 1991-1-1, 6.3), needed where there is Q.
    """

    at: ColumnLines
    floors: Numbers
    G: Force = 0.0
    G2: Force = 0.0
    Q: Force = 0.0
    category: Category | None = None


class Combination(Model):
    """Factors of G and Q in the masses, or in the gravity loads of analyses.

    Attributes:
        G: factor of permanent loads, structural or not, and of the self weight.
        Q: psi_2, one for all or by category; without the key that of the category in the country (EN 1990, Table A1.1).
    """

    G: Factor = 1.0
    Q: Annotated[Factor | dict[Category, Factor], OneOf()] | None = None

    def psi_2(self, category: str) -> float | None:
        """Return the factor of a category of Q, None where the country's holds; a mapping names all that there are."""
        return self.Q[category] if isinstance(self.Q, dict) else self.Q  # type: ignore[index]


class Loads(Model):
    """All loads of the building.

    Attributes:
        areas: loads on bays of floors.
        perimeter: loads along the edge of floors.
        beams: loads on beams: uniform, at points and on parts.
        nodes: forces on nodes.
        self_weight: whether members weigh, by their area and density.
        gravity: factors of the combination that acts before and during histories and pushovers.
        live_load_reduction: whether variable loads are reduced in persistent combinations (EN 1991-1-1, 6.3.1.2).
        pattern: whether area loads Q of the categories A to G also act on every other bay alone, in the elastic design:
            `chessboard`, or on strips, which alternate along x or along y, and from floor to floor.
        cases: own load cases of the elastic design, by name.
        psi: psi_0, psi_1 and psi_2 of own categories of these cases, by name of the category.
    """

    areas: tuple[Areas, ...] = ()
    perimeter: tuple[PerimeterLoad, ...] = ()
    beams: tuple[BeamLoad, ...] = ()
    nodes: tuple[NodeLoad, ...] = ()
    self_weight: bool = True
    gravity: Combination = Combination()
    live_load_reduction: bool = False
    pattern: Literal["none", "chessboard", "strips_x", "strips_y"] = "none"
    cases: dict[CaseName, LoadCaseOfFile] = Field(default_factory=dict)
    psi: dict[CaseName, Psi] = Field(default_factory=dict)

    @property
    def items(self) -> tuple[Areas | PerimeterLoad | BeamLoad | NodeLoad, ...]:
        """Return all loads in the order of the file's lists."""
        return (*self.areas, *self.perimeter, *self.beams, *self.nodes)


class GivenMass(Model):
    """The mass of each of some nodes; a node is given its mass once.

    Attributes:
        at: column lines of the nodes.
        floors: floors of the nodes.
        mass: mass of each of the nodes.
    """

    at: ColumnLines = ALL_COLUMN_LINES
    floors: Numbers
    mass: PositiveMass


class AddedMass(Model):
    """A mass at each of some nodes beside what the loads bring; those at one node add up.

    Attributes:
        at: column lines of the nodes.
        floors: floors of the nodes.
        mass: added to each of the nodes.
    """

    at: ColumnLines
    floors: Numbers
    mass: PositiveMass


class Masses(Model):
    """Masses of the nodes, from the loads or given.

    Attributes:
        from_loads: factors of the loads that are masses; this key or `given`.
        given: masses node by node; this key or `from_loads`.
        added: masses at nodes beside those of the loads, such as machines; with `from_loads`.
        phi: factor phi by which psi_2 is multiplied to psi_E (EN 1998-1, 4.2.4(2)P, Eq. 4.2).
        directions: whether a mass resists horizontal motion only, or in analyses vertical motion too.
    """

    from_loads: Combination | None = None
    given: tuple[GivenMass, ...] | None = None
    added: tuple[AddedMass, ...] = ()
    phi: PositiveRatio = 1.0
    directions: Literal["horizontal", "both"] = "horizontal"
