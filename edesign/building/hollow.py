"""Hot finished hollow sections by their names: `SHS200x10`, `RHS200x100x8`, `CHS168.3x8`."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator

from edesign.building.profiles import profile_names
from edesign.building.section import fillets
from edesign.building.section_names import SectionNames

_NAME = re.compile(r"(SHS|RHS|CHS)(\d{1,4}(?:\.\d{1,2})?)X(\d{1,4}(?:\.\d{1,2})?)(?:X(\d{1,3}(?:\.\d{1,2})?))?")
_SIGNS = str.maketrans({"×": "X", "✕": "X", "*": "X", ",": "."}) | str.maketrans("", "", " \t\u00a0_-")
_MM = 1e-3


def hollow_sizes(name: str) -> tuple[float, float, float] | None:
    """Return height, width and thickness, m, of a hollow section by its name; a tube's width is 0. None: it is none."""
    match = _NAME.fullmatch(name.upper().translate(_SIGNS))
    if match is None or (match[1] == "RHS") != (match[4] is not None):
        return None
    height, second = float(match[2]), float(match[3])
    width, thickness = (second, float(match[4])) if match[4] else (height, second)
    if not 0.0 < 2.0 * thickness < min(height, width):
        return None
    return height * _MM, 0.0 if match[1] == "CHS" else width * _MM, thickness * _MM


def hollow_area(name: str) -> float | None:
    """Return the area, m2, of a hollow section by its name; None: it is none.

    Source: EN 10210-2:2006, Annex A, with outer corner radius 1.5 T and inner 1.0 T.
    """
    sizes = hollow_sizes(name)
    if sizes is None:
        return None
    height, width, thickness = sizes
    if width == 0.0:
        return math.pi * (height - thickness) * thickness
    corners = (4.0 - math.pi) * ((1.5 * thickness) ** 2 - thickness**2)
    return 2.0 * thickness * (height + width - 2.0 * thickness) - corners


def hollow_inertia(name: str, strong: bool = True) -> float | None:
    """Return the second moment of area, m4, of a hollow section about its strong or weak axis; None: it is none.

    Source: EN 10210-2:2006, Annex A: rectangles less the rounded corners, each a square without a quarter of a circle.
    """
    sizes = hollow_sizes(name)
    if sizes is None:
        return None
    height, width, t = sizes
    if width == 0.0:
        return math.pi / 64.0 * (height**4 - (height - 2.0 * t) ** 4)
    depth, across = (max(height, width), min(height, width)) if strong else (min(height, width), max(height, width))
    walls = (across * depth**3 - (across - 2.0 * t) * (depth - 2.0 * t) ** 3) / 12.0
    outer, inner = fillets(0.5 * depth, 1.5 * t), fillets(0.5 * depth - t, t)
    lost = sum(pair.inertia + pair.area * pair.centre**2 for pair in outer)
    return walls - lost + sum(pair.inertia + pair.area * pair.centre**2 for pair in inner)


class BuildingSections(Collection[str]):
    """The names of sections that a building may use: the catalogue's, and hollow sections of any size."""

    def __init__(self, rolled: SectionNames | None = None) -> None:
        self._rolled = profile_names() if rolled is None else rolled

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BuildingSections) and self._rolled == other._rolled

    def __hash__(self) -> int:
        return hash(self._rolled)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self.canonical(name) == name

    def __iter__(self) -> Iterator[str]:
        return iter(self._rolled)

    def __len__(self) -> int:
        return len(self._rolled)

    def canonical(self, name: str) -> str | None:
        """Return the name as edesign writes it, `SHS200x10`; None if there is no such section."""
        if hollow_sizes(name) is None:
            return self._rolled.canonical(name)
        return name.upper().translate(_SIGNS).replace("X", "x")

    def near(self, name: str) -> str:
        """Return what there is near a name that is none, as a clause."""
        if name.upper().lstrip()[:3] in ("SHS", "RHS", "CHS"):
            return (
                "hollow sections are written `SHS200x10`, `RHS200x100x8`, `CHS168.3x8`, thickness below half the width"
            )
        return self._rolled.near(name)
