"""What a quantity can be and what is usual, each bound with its reason; the lengths of frames and buildings."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.project.notation.quantities import LENGTH, Kind
from edesign.project.notation.units import units_of


@dataclass(frozen=True)
class Range:
    """The possible and usual bounds of a quantity, in SI.

    Attributes:
        what: its name.
        kind: the physical quantity.
        unit: in which people write it.
        possible, why: least and largest value that is read, and where these come from.
        usual, why_usual: least and largest value that is not worth a word, and where these come from.
    """

    what: str
    kind: Kind
    unit: str
    possible: tuple[float, float]
    why: str
    usual: tuple[float, float]
    why_usual: str

    def refuses(self, value: float) -> bool:
        """Return whether a value is impossible."""
        return not self.possible[0] <= value <= self.possible[1]

    def warns(self, value: float) -> bool:
        """Return whether a value is unusual."""
        return not self.usual[0] <= value <= self.usual[1]

    def shown(self, bounds: tuple[float, float]) -> str:
        """Return the bounds in the unit that people write, such as `150 to 700 MPa`."""
        factor = units_of(self.kind)[self.unit]
        return f"{bounds[0] / factor:.4g} to {bounds[1] / factor:.4g} {self.unit}".rstrip()


_LENGTHS = (
    (0.5, 150.0),
    "below it is less than the depth of an HEB500, so no bar is left; above it no rolled beam of S460 carries its own "
    "weight",
)
HEIGHT = Range("height of a storey", LENGTH, "m", *_LENGTHS, (2.0, 20.0), "people stand up in 2 m; halls have 20 m")
WIDTH = Range("width of a bay", LENGTH, "m", *_LENGTHS, (2.0, 24.0), "beams are rolled and carried up to 24 m")
