"""Own cross-sections, and how many fibres an I section is cut into."""

from __future__ import annotations

from collections.abc import Collection
from typing import Annotated, Literal, Protocol

from pydantic import Field

from edesign.project.notation.units import Length, PositiveArea, PositiveInertia, PositiveLength
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import did_you_mean, listed

SectionAxis = Literal["strong", "weak"]
ResidualStress = Literal["none", "eccs"]
FibreCount = Annotated[int, Field(ge=1, le=1000)]
SectionFamily = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+*? -]*$", max_length=24)]
SectionChoice = Annotated[tuple[SectionFamily, ...], Field(min_length=1)]
"""Families, patterns or sections to choose from: `SHS`, `HEB3*`, `CHS168.3x8`."""


class PlateSection(Model):
    """A doubly symmetric I section welded from three plates.

    Attributes:
        height: total height of the section, more than two flanges.
        width: width of the flanges.
        flange: thickness of a flange.
        web: thickness of the web, at most `width`.
    """

    height: PositiveLength
    width: PositiveLength
    flange: PositiveLength
    web: PositiveLength


ROUNDING = 1e-9
"""Of the depth of a section: edges of rectangles that are nearer to each other are one."""


class Rectangle(Model):
    """A rectangle of a section.

    Attributes:
        width: size across the depth of the section.
        depth: size along the depth of the section.
        centre: coordinate of its centre along the depth, upwards, from any origin.
    """

    width: PositiveLength
    depth: PositiveLength
    centre: Length


class RectangleSection(Model):
    """Any stack of rectangles; the reference axis is the centroid, wherever the coordinates start.

    Attributes:
        rectangles: the rectangles of the section, in any order.
    """

    rectangles: Annotated[tuple[Rectangle, ...], Field(min_length=1)]

    @property
    def gap(self) -> tuple[float, float] | None:
        """The lowest gap between rectangles along the depth, from and to, m; None if they touch."""
        spans = sorted((one.centre - 0.5 * one.depth, one.centre + 0.5 * one.depth) for one in self.rectangles)
        least = ROUNDING * (max(high for _, high in spans) - spans[0][0])
        top = spans[0][1]
        for low, high in spans:
            if low - top > least:
                return top, low
            top = max(top, high)
        return None


class ElasticSection(Model):
    """A section that stays elastic.

    Attributes:
        area: area of the section.
        inertia: second moment of area; only braces can do without.
    """

    area: PositiveArea
    inertia: PositiveInertia | None = None


class BoxSection(Model):
    """A box of a building, welded from four plates: flanges over the whole width, two webs between them at the edges.

    Attributes:
        height: total height of the section, more than two flanges.
        width: total width of the section, more than two webs.
        flange: thickness of a flange.
        web: thickness of a web.
        webs: number of the webs, which tells a box from an I section.
    """

    height: PositiveLength
    width: PositiveLength
    flange: PositiveLength
    web: PositiveLength
    webs: Literal[2]


class CoverPlates(Model):
    """The plates on the angles of one flange of a riveted section.

    Attributes:
        width: of the plates.
        thickness: of all plates of one flange together.
    """

    width: PositiveLength
    thickness: PositiveLength


class RivetedSection(Model):
    """A doubly symmetric I section of a building, riveted from a web plate, four angles and maybe cover plates.

    Attributes:
        height: of the web plate, over the backs of the angles.
        web: thickness of the web plate.
        angles: name of the four angles in the catalogue, such as `L80x80x10`.
        outstanding: leg of unequal angles that stands out from the web; the other one lies on it.
        covers: plates on the angles of each flange; without the key there are none.
    """

    height: PositiveLength
    web: PositiveLength
    angles: str
    outstanding: Literal["long", "short"] | None = None
    covers: CoverPlates | None = None


class SpaceElasticSection(Model):
    """A section of a building that stays elastic, by its properties; its shape is not known.

    Attributes:
        area: area of the section.
        inertia: second moment of area about the strong axis; only braces can do without.
        weak_inertia: second moment of area about the weak axis; only braces can do without.
        torsion_constant: St Venant torsion constant; only braces can do without.
        shear_area: shear area along the web; without the key the section does not deform in shear along it.
        weak_shear_area: shear area across the web; without the key the section does not deform in shear across it.
    """

    area: PositiveArea
    inertia: PositiveInertia | None = None
    weak_inertia: PositiveInertia | None = None
    torsion_constant: PositiveInertia | None = None
    shear_area: PositiveArea | None = None
    weak_shear_area: PositiveArea | None = None

    @property
    def missing(self) -> tuple[str, ...]:
        """The keys that columns and beams need and that are not given."""
        return tuple(key for key in ("inertia", "weak_inertia", "torsion_constant") if getattr(self, key) is None)


Section = Annotated[
    PlateSection | RectangleSection | ElasticSection,
    OneOf(otherwise=PlateSection, rectangles=RectangleSection, area=ElasticSection, inertia=ElasticSection),
]

SpaceSection = Annotated[
    PlateSection | BoxSection | RivetedSection | RectangleSection | SpaceElasticSection,
    OneOf(
        otherwise=PlateSection,
        angles=RivetedSection,
        webs=BoxSection,
        rectangles=RectangleSection,
        area=SpaceElasticSection,
        inertia=SpaceElasticSection,
    ),
]
"""Of a building, whose members bend about both axes."""


class Fibres(Model):
    """Fibre counts of an I section, and whether the root fillets of rolled profiles are kept.

    Attributes:
        flange_width: fibres across a flange.
        flange_thickness: fibres through a flange.
        web_height: fibres along the web.
        web_thickness: fibres through the web.
        fillets: whether the root fillets of rolled profiles are kept; otherwise they are three rectangles.
        residual_stress: stresses of columns and beams before any load; `eccs` of rolled I sections.
    """

    flange_width: FibreCount = 16
    flange_thickness: FibreCount = 4
    web_height: FibreCount = 16
    web_thickness: FibreCount = 2
    fillets: bool = False
    residual_stress: ResidualStress = "none"


FIBRES_OF_HALF_A_FLANGE = 4
"""By default, which gives 32 fibres of a section in space."""


class SpaceFibres(Model):
    """Fibre counts of a section that bends about both axes.

    Attributes:
        half_flange: fibres of half a flange; a section has eight times as many.
        residual_stress: stresses of columns and beams before any load; `eccs` of rolled I sections.
    """

    half_flange: Annotated[int, Field(ge=2, le=50)] = FIBRES_OF_HALF_A_FLANGE
    residual_stress: ResidualStress = "none"


class Catalogue(Collection[str], Protocol):
    """The names of sections that a project need not define."""

    def canonical(self, name: str) -> str | None:
        """Return the catalogue's own name of a section that may be spelled otherwise; None for an unknown one."""

    def canonical_in_building(self, name: str, brace: bool = False) -> str | None:
        """Return the catalogue's own name of a section that only buildings, or their braces, may have; or None."""

    def near(self, name: str) -> str:
        """Return the catalogue's names near an unknown one as a clause for messages."""


HOLLOW_FAMILIES = ("SHS", "RHS", "CHS", "HSS")
"""Square, rectangular and circular hollow sections, hot finished; `CF` before it: cold formed; `HSS`: of ASTM A500."""


def is_hollow(name: str) -> bool:
    """Return whether a name of the catalogue is that of a hollow section."""
    return name.removeprefix("CF").startswith(HOLLOW_FAMILIES)


def no_section(name: str, own: Collection[str], catalogue: Catalogue) -> str:
    """Return the message on a name that is neither a section of the project nor one of the catalogue.

    Args:
        own: names of the file's own sections.
        catalogue: of sections, for names that are alike.
    """
    hint = did_you_mean(name, own) or f"; {catalogue.near(name)}"
    there = f"own sections: {listed(own)}; " if own else ""
    return f"there is no section `{name}`{hint} ({there}`edesign sections` lists the catalogue) [E-NAME-01]"
