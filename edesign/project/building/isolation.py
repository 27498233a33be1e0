"""Base isolation of a building: isolators under column lines, what acts beside them, and the base on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from edesign.project.building.loads import Category
from edesign.project.building.places import ALL_COLUMN_LINES, ColumnLines
from edesign.project.building.supports import Rotation
from edesign.project.dampers.isolation import AnyBaseDevice, AnyIsolation, AnyIsolator
from edesign.project.notation.frames import Direction
from edesign.project.notation.grid import Grid
from edesign.project.notation.units import AreaLoad, PositiveLength, PositiveMass
from edesign.project.reading.base import Model


class BaseDevice(AnyBaseDevice):
    """A law between the ground and the base of a building, along one direction, at some column lines.

    Attributes:
        at: column lines; without the key all that have a column.
        direction: horizontal direction in which it acts.
    """

    at: ColumnLines = ALL_COLUMN_LINES
    direction: Direction

    def under(self, lines: Sequence[str], grid: Grid) -> tuple[str, ...]:
        """Return those of some column lines, by name, at which it stands.

        Args:
            grid: of the building, with all of its lines.
        """
        chosen = grid.lines_of(self.at)
        return tuple(line for line in lines if line in chosen)

    @property
    def axes(self) -> tuple[str, ...]:
        """The horizontal direction in which it acts."""
        return (self.direction,)


class Isolator(AnyIsolator):
    """An isolator under some column lines of a building, which carries the column and acts along x and y at once.

    Attributes:
        at: column lines; without the key all that have a column.
    """

    at: ColumnLines = ALL_COLUMN_LINES

    def under(self, lines: Sequence[str], grid: Grid) -> tuple[str, ...]:
        """Return those of some column lines, by name, at which it stands.

        Args:
            grid: of the building, with all of its lines.
        """
        chosen = grid.lines_of(self.at)
        return tuple(line for line in lines if line in chosen)

    @property
    def axes(self) -> tuple[str, ...]:
        """The horizontal directions in which it acts."""
        return "x", "y"


class BaseBeams(Model):
    """Elastic beams of an isolated base along x and y, from each column base to the next one, with upright webs.

    Attributes:
        section: name of a profile of the catalogue.
        material: one of `materials`.
    """

    section: str
    material: str


class IsolatedBase(Model):
    """The slab or grid of beams on the isolators, rigid in plan, at floor 0.

    Attributes:
        G: permanent load on the bays that the first floor covers.
        Q: variable load on them.
        category: category of the use (EN 1991-1-1, 6.3), needed where there is Q.
        mass: mass of the base, all of it; without the key that of its loads if `masses.from_loads` says so.
        beams: elastic beams from column base to column base, with which the column bases turn; this key or `rotation`.
        rotation: what restrains turns of the column bases about x and y, as a support would; this key or `beams`.
    """

    G: AreaLoad = 0.0
    Q: AreaLoad = 0.0
    category: Category | None = None
    mass: PositiveMass | None = None
    beams: BaseBeams | None = None
    rotation: Rotation | None = None


class Isolation(AnyIsolation):
    """An isolated base of a building.

    Attributes:
        isolators: what carries the columns; each line has one of them at most.
        beside: what else acts between ground and base along a direction: dampers, stops of a moat.
        base: the slab or grid of beams on the isolators.
        design_displacement: displacement of the base at which the isolators count in natural modes.
    """

    isolators: Annotated[tuple[Isolator, ...], Field(min_length=1)]
    beside: tuple[BaseDevice, ...] = ()
    base: IsolatedBase
    design_displacement: PositiveLength
