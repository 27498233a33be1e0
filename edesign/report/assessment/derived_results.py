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
    """The response of a variant at a level for each value of `vary`; values without histories are left out.

    Attributes:
        vary: what was changed.
        of: name of the variant that was changed.
        level: of the hazard.
        values: as written, in their order.
        sets: histories of each.
    """

    vary: Vary
    of: str
    level: str
    values: tuple[str, ...]
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
    def quantity(self) -> str:
        """The varied quantity in words, such as `fy of S275` for materials.S275.fy."""
        *above, last = _STEP.findall(self.vary.place)
        of = next((key for key in reversed(above) if key not in _OF_NO_NAME), "")
        return f"{last} of {of}" if of else last

    @property
    def title(self) -> str:
        """The varied quantity, the variant and the level in words."""
        at = f" at {self.level}" if self.level else ""
        return f"{self.quantity}, {self.of}{at}"

    @property
    def numbers(self) -> tuple[tuple[float, ...], str] | None:
        """The values as numbers with the unit that all are written in; None where they have none in common."""
        found = [match for value in self.values if (match := _NUMBER.fullmatch(value)) is not None]
        units = {match[2] for match in found}
        if len(found) < len(self.values) or len(units) != 1:
            return None
        return tuple(float(match[1]) for match in found), units.pop()


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
                values = tuple(str(study.derived[name].value) for name, _ in pairs)
                if pairs:
                    made.append(Sweep(item, of, level, values, tuple(found for _, found in pairs)))
    return made


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
