"""Warnings about the result of an analysis: found by the analysis, archived with it, printed in reports.

Those about the input stand in the root of the archive, as sentences (`edesign.study.check.advice`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Literal

from edesign.archive.dataset import Group

ATTRIBUTE = "warnings"
Kind = Literal[
    "energy_error",
    "damper_strain",
    "strain_limit",
    "damper_amplitude",
    "damper_couple",
    "core_strain",
    "brace_buckling",
    "column_buckling",
    "hinge_axial",
    "brace_fracture",
    "isolator_foot_moments",
    "isolator_height",
    "isolator_tension",
    "isolator_uplift",
    "isolator_weight",
    "target_range",
    "target_torsion",
    "target_strength",
    "target_limit",
    "target_damping",
    "target_damping_twice",
    "feet_apart",
]

COMMON: Mapping[Kind, str] = {
    "energy_error": "the energy balance is not reliable",
    "damper_strain": "dampers strain beyond the tests of their law",
    "strain_limit": "dampers strain beyond their strain limit",
    "damper_amplitude": "modes leave out dampers whose amplitude is not known",
    "damper_couple": "dampers between floors lack their couples",
    "core_strain": "cores of buckling-restrained braces strain beyond the manufacturer's values",
    "brace_buckling": "braces carry more compression than their buckling resistance",
    "brace_fracture": "fibres of braces have broken",
    "column_buckling": "columns carry more compression than their buckling resistance",
    "hinge_axial": "hinges do not know the axial forces of their columns",
    "isolator_foot_moments": "axial forces of isolators leave out moments of column bases that go into the ground",
    "isolator_height": "the base lacks moments of axial forces and displacement of isolators",
    "isolator_tension": "isolators that cannot lift off are pulled",
    "isolator_uplift": "friction pendulums lose contact",
    "isolator_weight": "friction pendulums slide as under the weight of gravity alone",
    "target_range": "capacity curves end before 150 % of the target displacement",
    "target_torsion": "the building is torsionally flexible: members at its stiff side turn more than in a push",
    "target_strength": "the frame is too weak for the nonlinear static procedure of ASCE/SEI 41",
    "target_limit": "FEMA 356 limits C_1 of short periods, which FEMA 440 advises against",
    "target_damping": "target displacements do not count the damping of the dampers",
    "target_damping_twice": "target displacements count the work of dampers twice",
    "feet_apart": "supports stay apart after the wave has passed",
}
"""What analyses with a warning of one kind have in common."""


@dataclass(frozen=True)
class AnalysisWarning:
    """A warning about the result of an analysis.

    Attributes:
        kind: a key of `COMMON`.
        text: a sentence without its full stop, with the numbers.
        ratio: the value over the one from which there is a warning, to find the worst of several analyses.
    """

    kind: Kind
    text: str
    ratio: float


def store_warnings(group: Group, warnings: Iterable[AnalysisWarning]) -> None:
    """Add warnings to those of an analysis.

    Args:
        warnings: the further ones.
    """
    group.attributes[ATTRIBUTE] = [
        *(asdict(warning) for warning in warnings_of(group)),
        *(asdict(warning) for warning in warnings),
    ]


def warnings_of(group: Group) -> list[AnalysisWarning]:
    """Return the archived warnings of an analysis."""
    found = group.attributes.get(ATTRIBUTE)
    items = found if isinstance(found, list) else []
    return [
        AnalysisWarning(item["kind"], str(item["text"]), float(item["ratio"]))
        for item in items
        if isinstance(item, Mapping) and item.get("kind") in COMMON
    ]


def warning_lines(groups: Mapping[str, Group]) -> list[str]:
    """Return the warnings of analyses in lines; those of one kind share a line with the worst of them.

    Args:
        groups: results of analyses by name; the line says of how many.
    """
    lines = []
    for grouped in grouped_warnings(groups):
        if grouped.count == 1:
            lines.append(f"{grouped.worst}: {grouped.text}")
        else:
            where = f"in {grouped.count} of {len(groups)} analyses {grouped.common}"
            lines.append(f"{where}, most in {grouped.worst}: {grouped.text}")
    return lines


@dataclass(frozen=True)
class GroupedWarning:
    """Warnings of one kind.

    Attributes:
        worst: the analysis that has the worst of them, or the only one.
        count: analyses that have such warnings.
        common: what these analyses have in common.
        text: of the worst.
    """

    worst: str
    count: int
    common: str
    text: str


def grouped_warnings(groups: Mapping[str, Group]) -> list[GroupedWarning]:
    """Return the warnings of analyses, grouped by kind where several analyses have them."""
    found = []
    for kind, common in COMMON.items():
        each = {name: [w for w in warnings_of(group) if w.kind == kind] for name, group in groups.items()}
        each = {name: several for name, several in each.items() if several}
        if not each:
            continue
        worst = max(each, key=lambda name: max(warning.ratio for warning in each[name]))
        texts = [warning.text for warning in each[worst]]
        for text in texts if len(each) == 1 else ["; ".join(texts)]:
            found.append(GroupedWarning(worst, len(each), common, text))
    return found
