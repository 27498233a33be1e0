"""Base isolation: isolators under the column lines, what acts beside them, and the base that stands on them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from edesign.project.frame.sections import SectionAxis
from edesign.project.frame.supports import Turning, Vertical
from edesign.project.notation.grid import Grid
from edesign.project.notation.selections import ALL_LINES, Lines
from edesign.project.notation.units import LineLoad, PositiveArea, PositiveFactor, PositiveLength, PositiveMass
from edesign.project.reading.base import Model
from edesign.project.reading.problems import listed

Count = Annotated[int, Field(ge=1, le=1000)]

WEIGHED = "friction_pendulum"
"""The law whose forces are proportional to the weight on it, which is its first parameter."""
CIRCULAR = ("lead_rubber", "elastic_plastic", "friction", "friction_pendulum", "bouc_wen")
"""The laws whose forces along x and y lie within a circle."""
UNCOUPLED = (
    "kelvin_voigt",
    "zener",
    "generalised_maxwell",
    "fractional_kelvin",
    "fractional_zener",
    "linearised",
)
"""The linear laws with a stiffness at rest, of which one along x and one along y are alike in all directions."""
NEEDS_STIFFNESS = (
    "what presses on the isolator at every moment is known where its `vertical` has a stiffness [E-KEY-02]"
)


class AnyBaseDevice(Model):
    """A law between the ground and the base, horizontally, at some column lines of a plane frame or a building.

    Attributes:
        law: one of `dampers.laws`.
        number: devices side by side at each line.
        layers: layers of elastomer; without the key those of the prototype.
        layer_area: area of a layer; without the key that of the prototype.
        layer_thickness: thickness of a layer; without the key that of the prototype.
        scale: factor on the forces of a law without prototype.
    """

    law: str
    number: Count = 1
    layers: Count | None = None
    layer_area: PositiveArea | None = None
    layer_thickness: PositiveLength | None = None
    scale: PositiveFactor | None = None

    @abstractmethod
    def under(self, lines: Sequence[str], grid: Grid) -> tuple[str, ...]:
        """Return those of some column lines, by name, at which it stands.

        Args:
            grid: of the structure, with all of its lines.
        """

    @property
    def axes(self) -> tuple[str, ...]:
        """The horizontal directions in which it acts, "x" and "y"; of a plane frame one without a name."""
        return ("",)


class AnyIsolator(AnyBaseDevice):
    """An isolator under some column lines, which carries the column.

    Attributes:
        vertical: one isolator in the vertical direction: `fixed`, a stiffness, or a spring.
        weight: weight on a friction pendulum: under gravity (the default), at every moment of a history, or that of its
            law.
    """

    vertical: Vertical = "fixed"
    weight: Literal["gravity", "varying", "law"] | None = None


class AnyIsolation(Model):
    """An isolated base of a plane frame or a building.

    Attributes:
        isolators: what carries the columns; each line has one of them at most.
        beside: what else acts between ground and base horizontally: dampers, stops of a moat.
        design_displacement: displacement of the base at which the isolators count in natural modes.
    """

    if TYPE_CHECKING:
        isolators: tuple[AnyIsolator, ...]
        beside: tuple[AnyBaseDevice, ...]
        design_displacement: PositiveLength


class BaseDevice(AnyBaseDevice):
    """A law between the ground and the base, horizontally, at some column lines.

    Attributes:
        lines: column lines; without the key all that have a column.
    """

    lines: Lines = ALL_LINES

    def under(self, lines: Sequence[str], grid: Grid) -> tuple[str, ...]:
        """Return those of some column lines, by name, at which it stands.

        Args:
            grid: of the structure, with all of its lines.
        """
        chosen = grid.lines_of(self.lines)
        return tuple(line for line in lines if line in chosen)


class Isolator(AnyIsolator, BaseDevice):
    """An isolator under some column lines, which carries the column."""


class BaseBeams(Model):
    """Elastic beams of an isolated base, from each column base to the next one.

    Attributes:
        section: name of a profile of the catalogue, or of `sections`.
        material: one of `materials`.
        axis: axis of the section about which the beams bend in the plane of the frame.
    """

    section: str
    material: str
    axis: SectionAxis = "strong"


class IsolatedBase(Model):
    """The slab or grid of beams on the isolators, rigid horizontally, at floor 0.

    Attributes:
        G: permanent load along the frame.
        Q: variable load along the frame.
        mass: mass of the base, all of it; without the key that of its loads if `masses.from_loads` says so.
        beams: elastic beams from column base to column base, with which the column bases turn; this key or `rotation`.
        rotation: what restrains rotations of the column bases, as a support would; this key or `beams`.
    """

    G: LineLoad = 0.0
    Q: LineLoad = 0.0
    mass: PositiveMass | None = None
    beams: BaseBeams | None = None
    rotation: Turning | None = None


class Isolation(AnyIsolation):
    """An isolated base.

    Attributes:
        isolators: what carries the columns; each line has one of them at most.
        beside: what else acts between ground and base horizontally: dampers, stops of a moat.
        base: the slab or grid of beams on the isolators.
        design_displacement: displacement of the base at which the isolators count in natural modes.
    """

    isolators: Annotated[tuple[Isolator, ...], Field(min_length=1)]
    beside: tuple[BaseDevice, ...] = ()
    base: IsolatedBase
    design_displacement: PositiveLength


def not_in_all_directions(name: str, law: str, effects: bool) -> str:
    """Say why no isolator of a building can have a law, and which ones it can have.

    Args:
        law: its type.
        effects: whether it is refused for its effects.
    """
    what = "has effects, which act in one direction alone" if effects else f"({law}) acts in one direction alone"
    return (
        f"the law `{name}` {what}; isolators of buildings have {listed(CIRCULAR)}, whose forces lie within a circle, "
        f"or as linear laws {listed(UNCOUPLED)} [E-ISOL-05]"
    )
