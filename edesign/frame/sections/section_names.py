"""Names of catalogue sections as they are usually written, and what the catalogue has near a name that it has not."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache, cached_property
from importlib import resources

from edesign.project.reading.problems import did_you_mean, listed

_NEAR = 4  # names that a message offers
_MOST_INCHES = 50.0  # depth of a W shape; the least one in mm is 100
_KG_PER_M = 0.45359237 / 0.3048  # of a pound per foot
_SIGNS = str.maketrans({"×": "X", "✕": "X", "*": "X", ",": ".", "#": ""}) | str.maketrans("", "", " \t\u00a0_-")
_NUMBER = r"\d{1,5}(?:\.\d{1,3})?"
_NUMBERS = rf"{_NUMBER}(?:X{_NUMBER})*"
_NAME = re.compile(rf"([A-Z]+)({_NUMBERS})([A-Z]*)")
_BRITISH = re.compile(rf"({_NUMBERS})(U[A-Z]+)X?({_NUMBER})?")  # 457x191x67 UB, 457x191 UB 67

_FAMILIES = {
    "IPBL": "HEA",  # DIN 1025-3
    "IPB": "HEB",  # DIN 1025-2
    "IPBV": "HEM",  # DIN 1025-4
    "UKB": "UB",  # Tata Steel's names of the British sections
    "UKC": "UC",
    "UKBP": "UBP",
}
"""Families by the names that other standards give them."""

_LETTERED = ("HE", "IPE")
"""Series whose light and heavy sections have a letter behind the number: HE 300 B, IPE 300 A."""


@dataclass(frozen=True)
class SectionName:
    """A name in its parts: letters of the family; sizes, mm and at last kg/m, or inches and lb/ft of a W shape."""

    family: str
    sizes: tuple[float, ...]

    @cached_property
    def in_millimetres(self) -> SectionName:
        """The name in mm and kg/m: of a W shape in inches and lb/ft those of its series, any other as it is."""
        if self.family != "W" or len(self.sizes) != 2 or self.sizes[0] > _MOST_INCHES:
            return self
        inches, pounds = self.sizes
        return SectionName("W", (_series_depths().get(inches, 25.4 * inches), _KG_PER_M * pounds))

    @staticmethod
    def of(text: str) -> SectionName | None:
        """Return the parts of a name as somebody writes it; None if it is not letters with numbers."""
        folded = text.upper().translate(_SIGNS)
        if british := _BRITISH.fullmatch(folded):
            folded = british[2] + british[1] + (f"X{british[3]}" if british[3] else "")
        found = _NAME.fullmatch(folded)
        if found is None:
            return None
        family, sizes, letters = found.groups()
        if letters and family not in _LETTERED:
            return None
        family += letters
        return SectionName(_FAMILIES.get(family, family), tuple(map(float, sizes.split("X"))))


class SectionNames(Collection[str]):
    """The names of a catalogue of sections.

    Args:
        names: as the catalogue has them: `HEB300`, `HD320x127.0`, `W360x370x134`.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self._names = {name: SectionName.of(name) for name in names}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SectionNames) and list(self) == list(other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __reduce__(self) -> tuple[type[SectionNames], tuple[tuple[str, ...]]]:
        return SectionNames, (tuple(self),)  # projects that travel to other processes take the names alone

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    @cached_property
    def families(self) -> tuple[str, ...]:
        """The families in the order of the catalogue."""
        return tuple(dict.fromkeys(parts.family for parts in self._names.values() if parts))

    def _of_family(self, family: str) -> list[str]:
        """Return the names of one family.

        Args:
            family: HEB, W, ...
        """
        return [name for name, parts in self._names.items() if parts and parts.family == family]

    def chosen(self, what: str) -> list[str]:
        """Return the names that a family, a name, or a pattern with * and ? stands for.

        The family HEB has its own sections, HE those of all families that begin so. Patterns are compared with W
        shapes' names in inches and pounds per foot too. None: [].

        Args:
            what: family, name or pattern.
        """
        asked = what.upper().replace(" ", "")
        families = [family for family in self.families if family == asked] or [
            family for family in self.families if family.startswith(asked)
        ]
        if families:
            return [name for name, parts in self._names.items() if parts and parts.family in families]
        known = self.canonical(what)
        if known is not None:
            return [known]
        pattern = asked.replace("×", "X")
        spellings = ((name, self.inch_pound_name(name)) for name in self)
        return [
            name
            for name, inches in spellings
            if fnmatchcase(name.upper(), pattern) or fnmatchcase(inches.upper(), pattern)
        ]

    def inch_pound_name(self, name: str) -> str:
        """Return the name of a W shape in inches and pounds per foot, such as W14x90; "" of other sections.

        Args:
            name: of the catalogue.
        """
        return _inch_pound_spellings().get(name, "")

    def canonical(self, name: str) -> str | None:
        """Return the catalogue's own name of a section; None if it has no such section.

        Taken are the letters in any case, spaces, hyphens or nothing between the parts, x, X, × or * between sizes, a
        decimal comma, the letter of HE and IPE sections before or behind the number, British and German names of the
        families, W shapes by inches and pounds per foot, W shapes by depth and mass alone, and masses in whole kg/m.
        No name stands for two sections.

        Args:
            name: as somebody writes it.
        """
        if name in self._names:
            return name
        asked = SectionName.of(name)
        if asked is None:
            return None
        pounds = _inch_pound_names().get(asked) if asked.family == "W" else None
        return pounds or self._by_sizes(asked, exact=True) or self._by_sizes(asked, exact=False)

    def _by_sizes(self, asked: SectionName, exact: bool) -> str | None:
        found = [name for name, parts in self._names.items() if parts and _is_named(parts, asked, exact)]
        return found[0] if len(found) == 1 else None

    def near(self, name: str) -> str:
        """Return what the catalogue has near a name that it has not, as a clause; never a name of another family.

        Args:
            name: as somebody writes it.
        """
        asked = SectionName.of(name)
        families = ", ".join(self.families)
        if asked is None:  # a slip of the pen
            letters = re.match("[A-Z]*", name.upper().translate(_SIGNS))
            slip = did_you_mean(name, self._of_family(letters[0] if letters else ""))
            return slip.removeprefix("; ") or f"the catalogue has {families}, written like `HEB450`"
        metric = asked.in_millimetres
        own = self._of_family(metric.family)
        if not own:
            return f"the catalogue has no {asked.family} sections (it has {families})"
        nearest = sorted(own, key=lambda other: _distance(self._names[other], metric))[:_NEAR]
        shown = [other for other in own if other in nearest]
        if metric is not asked:  # in inches and pounds per foot
            shown = [self.inch_pound_name(other) or other for other in shown]
        return f"of {metric.family} the catalogue has near it {listed(shown)}"


def _is_named(parts: SectionName, asked: SectionName, exact: bool) -> bool:
    """Say whether a section of the catalogue goes by a name: by all its sizes, or, a W shape, by depth and mass."""
    sizes = parts.sizes
    if parts.family == "W" and len(asked.sizes) == 2:
        sizes = (sizes[0], sizes[-1])
    if parts.family != asked.family or len(sizes) != len(asked.sizes):
        return False
    if exact or len(sizes) == 1:
        return sizes == asked.sizes
    return sizes[:-1] == asked.sizes[:-1] and round(sizes[-1]) == round(asked.sizes[-1])


def _distance(parts: SectionName | None, asked: SectionName) -> tuple[float, float]:
    """How far two sections of one family are apart: in depth, then in what else both names say, as logarithms."""
    if parts is None:
        return math.inf, math.inf
    ours, theirs = parts.sizes, asked.sizes
    if len(ours) != len(theirs):  # depth, and mass if both have it
        ours, theirs = ((s[0], s[-1]) if min(len(ours), len(theirs)) > 1 else (s[0],) for s in (ours, theirs))
    apart = [abs(math.log(a / max(b, 1e-3))) for a, b in zip(ours, theirs, strict=True)]
    return apart[0], sum(apart[1:])


@cache
def _inch_pound_spellings() -> Mapping[str, str]:
    """Names of W shapes in inches and pounds per foot by those of the catalogue (data/w_shapes.csv)."""
    text = resources.files("edesign.frame.sections").joinpath("data/w_shapes.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return {row["name"]: row["inch_pound_name"] for row in rows}


@cache
def _inch_pound_names() -> Mapping[SectionName, str]:
    """The catalogue's names of W shapes by the parts of those in inches and pounds per foot."""
    spellings = _inch_pound_spellings().items()
    return {parts: name for name, spelling in spellings if (parts := SectionName.of(spelling))}


@cache
def _series_depths() -> Mapping[float, float]:
    """Nominal depths of the W series, mm by inches."""
    pairs = {parts.sizes[0]: SectionName.of(name) for parts, name in _inch_pound_names().items()}
    return {inches: parts.sizes[0] for inches, parts in pairs.items() if parts}
