"""Sets of histories of the variants that a study made of others, sorted: values in turn, bounds beside the variant."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from edesign.assess.sets import HistorySet
from edesign.project.criteria.measures import SHORT_NAMES
from edesign.project.study.derived import Vary
from edesign.project.study.study import Study

USUAL = ("interstorey_drift", "roof_acceleration_m_s2", "base_shear_N", "damper_force_N")
"""Measures that are shown where the study does not choose."""
_NUMBER = re.compile(r"\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(.*?)\s*")
_STEP = re.compile(r"[^.\[\]]+(?:\[[0-9]+\])?")
_OF_NO_NAME = ("parameters",)
"""Keys that do not say what a quantity is of."""


@dataclass(frozen=True)
class Sweep:
    """The response of a variant at a level for each combination of `vary`; those without histories are left out.

    Attributes:
        vary: what was changed.
        of: name of the variant that was changed.
        level: of the hazard.
        points: values as written, in the order of their places, of each combination.
        sets: histories of each.
    """

    vary: Vary
    of: str
    level: str
    points: tuple[tuple[str, ...], ...]
    sets: tuple[HistorySet, ...]

    @cached_property
    def measures(self) -> tuple[str, ...]:
        """The measures that are shown and that some history has."""
        wanted = tuple(SHORT_NAMES[name] for name in self.vary.measures) or USUAL
        return tuple(
            name
            for name in wanted
            if any(found[name] is not None for one in self.sets for found in one.measures.values())
        )

    @property
    def quantities(self) -> tuple[str, ...]:
        """The varied quantities in words, such as `fy of S275` for materials.S275.fy."""
        return tuple(map(_quantity, self.vary.places))

    @property
    def title(self) -> str:
        """The varied quantities, the variant and the level in words."""
        at = f" at {self.level}" if self.level else ""
        return f"{' and '.join(self.quantities)}, {self.of}{at}"

    @property
    def curves(self) -> dict[tuple[str, ...], list[tuple[str, HistorySet]]]:
        """Values of the first place with their histories, by the values of the other places."""
        found: dict[tuple[str, ...], list[tuple[str, HistorySet]]] = {}
        for (value, *others), one in zip(self.points, self.sets, strict=True):
            found.setdefault(tuple(others), []).append((value, one))
        return found

    @property
    def numbers(self) -> tuple[dict[str, float], str] | None:
        """The values of the first place as numbers with the unit that all are written in; None if they differ in it."""
        found = {value: _NUMBER.fullmatch(value) for value, *_ in self.points}
        units = {match[2] if match is not None else None for match in found.values()}
        if len(units) != 1 or None in units:
            return None
        return {value: float(match[1]) for value, match in found.items() if match is not None}, str(units.pop())


@dataclass(frozen=True)
class Bounded:
    """The response of a variant at a level with lower, nominal and upper properties of its dampers."""

    of: str
    level: str
    sets: Mapping[str, HistorySet]


def sweeps(study: Study, sets: Sequence[HistorySet]) -> list[Sweep]:
    """Return the sweeps of a study that have histories, in the order of the file."""
    there = {(found.variant, found.level): found for found in sets}
    levels = dict.fromkeys(found.level for found in sets)
    made = []
    for item in study.vary:
        for of in item.variants:
            names = [name for name, source in study.derived.items() if (source.of, source.vary) == (of, item.name)]
            for level in levels:
                pairs = [(name, there[name, level]) for name in names if (name, level) in there]
                points = tuple(tuple(map(str, study.derived[name].values)) for name, _ in pairs)
                if pairs:
                    made.append(Sweep(item, of, level, points, tuple(found for _, found in pairs)))
    return made


def _quantity(place: str) -> str:
    *above, last = _STEP.findall(place)
    of = next((key for key in reversed(above) if key not in _OF_NO_NAME), "")
    return f"{last} of {of}" if of else last


def bounded(study: Study, sets: Sequence[HistorySet]) -> list[Bounded]:
    """Return the variants with bounds whose histories are there on both sides, level by level."""
    there = {(found.variant, found.level): found for found in sets}
    made = []
    for of, variant in study.variants.items():
        if variant.bounds is None:
            continue
        names = {source.bound: name for name, source in study.derived.items() if source.of == of and source.bound}
        sides = {"lower": names.get("lower", ""), "nominal": of, "upper": names.get("upper", "")}
        for level in dict.fromkeys(found.level for found in sets):
            chosen = {side: there[name, level] for side, name in sides.items() if (name, level) in there}
            if len(chosen) == len(sides):
                made.append(Bounded(of, level, chosen))
    return made


def not_swept(study: Study, sets: Sequence[HistorySet]) -> list[HistorySet]:
    """Return the sets without those of `vary`, which have tables of their own."""
    return [found for found in sets if found.variant not in study.derived or study.derived[found.variant].bound]
