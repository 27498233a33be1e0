"""How far members are used, and what supports carry, under the histories of a set, by the rule of a code.

Of enough motions the mean counts, else the largest. Of a motion that comes at several angles, or with several places of
the masses, the worst history counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.project.notation.names import member_kind, storey_of

SECTION, BUCKLING = "section", "buckling"
_USES = (("section_use", SECTION), ("member_use", BUCKLING))


@dataclass(frozen=True)
class LoadedMember:
    """A column, beam or brace under the histories of a set.

    Attributes:
        name: of the member.
        kind: column, beam or brace.
        storey: of a beam the one below its floor.
        use: by the rule of the code, over all checks.
        check: which governs: section, buckling, or that of a brace.
        largest: use in the history that has the largest.
        history: its name.
        at: time of the largest use there, s.
        N, V, M: internal forces of that step, N and N m, of the end or the member that governs: N positive in tension,
            V and M the largest magnitudes, of a building about and along the axis with more.
        tension: largest tension of a column by the rule of the code, N; 0 of others.
        across: use of a column with the compression of the seismic action across, by the rule of the code; None: its
            file has none.
    """

    name: str
    kind: str
    storey: int
    use: float
    check: str
    largest: float
    history: str
    at: float
    N: float
    V: float
    M: float
    tension: float
    across: float | None = None


@dataclass(frozen=True)
class SupportForces:
    """An extreme of the reactions of a support under the histories of a set, with what acts with it.

    Attributes:
        support: node that is supported.
        extreme: which one, such as `most compression`.
        V: vertical reaction, N upwards; negative: uplift.
        H: horizontal reactions, of a building along x and y, N: magnitudes.
        M: moments, of a building about x and y, N m: magnitudes.
        history: the one with the largest extreme.
    """

    support: str
    extreme: str
    V: float
    H: tuple[float, ...]
    M: tuple[float, ...]
    history: str


def without_dampers(sets: Sequence[HistorySet], found: HistorySet) -> HistorySet | None:
    """Return the first set at the level of another one whose frame has no dampers; None: there is none but itself.

    Args:
        found: one of them.
    """
    for one in sets:
        groups = one.completed.values()
        if one.level == found.level and groups and not any("damper" in group.coords for group in groups):
            return None if one is found else one
    return None


def rule_of(found: HistorySet, rules: SetRules) -> str:
    """Return the statistic that a code takes over the motions of a set: mean or maximum."""
    return "mean" if found.motions >= rules.number_for_mean else "maximum"


def in_words(rules: SetRules) -> str:
    """Return the code of rules, and its clause on the mean of the responses."""
    clause = rules.clauses.use
    return clause if clause.startswith(rules.code) else ", ".join(part for part in (rules.code, clause) if part)


def loaded_members(found: HistorySet, rules: SetRules) -> list[LoadedMember]:
    """Return all members that are judged under the completed histories of a set, columns, beams, then braces.

    Those whose section or steel has no clause are left out, and all of archives that do not know uses.
    """
    names, groups = list(found.completed), list(found.completed.values())
    if not groups or "section_use_max" not in groups[0].variables:
        return []
    mean = rule_of(found, rules) == "mean"
    return [*_bending(found, names, groups, mean), *_braces(found, names, groups, mean)]


def _bending(found: HistorySet, names: Sequence[str], groups: Sequence[Group], mean: bool) -> Iterator[LoadedMember]:
    members = [str(name) for name in groups[0].coords["member"].values]
    kinds = [kind for kind in _USES if f"{kind[0]}_max" in groups[0].variables]
    every = np.array([[_values(group, f"{name}_max") for name, _ in kinds] for group in groups])
    tension = _tensions(found, names, groups, mean)
    across: list[float] = [np.nan] * len(members)
    if all("across_use_max" in group.variables for group in groups):
        across = _by_rule(found, names, np.array([_values(group, "across_use_max") for group in groups]), mean).tolist()
    of_rule = [_by_rule(found, names, every[:, k], mean) for k in range(len(kinds))]
    for at, name in enumerate(members):
        k = int(np.argmax([use[at] for use in of_rule]))
        row = int(np.argmax(every[:, k, at]))
        group, (quantity, check) = groups[row], kinds[k]
        when = np.asarray(group.variables[f"{quantity}_at"].values)[at]
        forces = [
            np.asarray(group.variables[f"{quantity}_{part}"].values)[at]
            for part in _PARTS
            if f"{quantity}_{part}" in group.variables
        ]
        if not np.isfinite(when).any():
            continue
        if quantity == "section_use":
            end = int(np.argmax(np.asarray(group.variables["section_use_max"].values)[at]))
            when, forces = when[end], [force[end] for force in forces]
        axial, *others = forces or (np.array(np.nan),) * 3
        axial = np.ravel(axial)
        if check == BUCKLING and f"{quantity}{_MIDDLE}" in group.variables:
            middle = np.asarray(group.variables[f"{quantity}{_MIDDLE}"].values)[at]
            axial = np.concatenate([axial, middle[np.isfinite(middle)]])
        yield LoadedMember(
            name,
            member_kind(name),
            storey_of(name),
            float(of_rule[k][at]),
            check,
            float(every[row, k, at]),
            names[row],
            float(when),
            float(axial[np.argmin(axial)]),
            float(np.abs(others[0]).max()),
            float(np.abs(others[1]).max()),
            tension.get(name, 0.0),
            None if np.isnan(across[at]) else across[at],
        )


_PARTS = ("axial_force", "shear_force", "bending_moment")
_MIDDLE = "_axial_force_middle"


def _braces(found: HistorySet, names: Sequence[str], groups: Sequence[Group], mean: bool) -> Iterator[LoadedMember]:
    if "brace_use_max" not in groups[0].variables:
        return
    every = np.array([_values(group, "brace_use_max") for group in groups])
    use = _by_rule(found, names, every, mean)
    for at, name in enumerate(str(name) for name in groups[0].coords["brace"].values):
        row = int(np.argmax(every[:, at]))
        when, force = (float(groups[row].variables[f"brace_use_{of}"].values[at]) for of in ("at", "axial_force"))
        if np.isfinite(when):
            check = "tension" if force > 0.0 else BUCKLING
            largest = float(every[row, at])
            about = (name, "brace", storey_of(name), float(use[at]), check, largest, names[row], when)
            yield LoadedMember(*about, force, 0.0, 0.0, 0.0)


def _values(group: Group, name: str) -> np.ndarray:
    """The largest values of each member over its ends, (n,)."""
    values = np.asarray(group.variables[name].values, dtype=float)
    return np.asarray(values.reshape(len(values), -1).max(axis=1))


def _by_rule(found: HistorySet, names: Sequence[str], values: np.ndarray, mean: bool) -> np.ndarray:
    """Statistic of the code over the motions of a set of values of its histories, (histories, n)."""
    motions: dict[str, list[int]] = {}
    for row, name in enumerate(names):
        motions.setdefault(found.motion_of[name], []).append(row)
    worst = np.array([values[rows].max(axis=0) for rows in motions.values()])
    return np.asarray(worst.mean(axis=0) if mean else worst.max(axis=0))


def _tensions(found: HistorySet, names: Sequence[str], groups: Sequence[Group], mean: bool) -> dict[str, float]:
    name = "column_axial_force_max"
    if name not in groups[0].variables:
        return {}
    largest = _by_rule(
        found, names, np.array([np.maximum(group.variables[name].values, 0.0) for group in groups]), mean
    )
    return dict(zip(map(str, groups[0].coords["column"].values), largest.tolist(), strict=True))


@dataclass(frozen=True)
class BeamForces:
    """Axial forces at the ends of a beam under the histories of a set, by the rule of the code.

    Attributes:
        storey: below its floor.
        start, end: largest tension and compression at either end, N.
    """

    beam: str
    storey: int
    start: tuple[float, float]
    end: tuple[float, float]


def beam_forces(found: HistorySet, rules: SetRules) -> list[BeamForces]:
    """Return the axial forces of the beams that collect those of dampers and braces under the histories of a set."""
    names, groups = list(found.completed), list(found.completed.values())
    if not groups or "collector" not in groups[0].coords:
        return []
    members = [str(name) for name in groups[0].coords["member"].values]
    beams = [str(name) for name in groups[0].coords["collector"].values]
    chosen, mean = [members.index(beam) for beam in beams], rule_of(found, rules) == "mean"
    inside = np.array([-1.0, 1.0])
    most, least = (
        np.array([np.asarray(group.variables[f"member_axial_force_{which}"].values)[chosen] for group in groups])
        for which in ("max", "min")
    )
    both = np.stack([most * inside, least * inside])
    sides = np.stack([np.maximum(both.max(axis=0), 0.0), np.maximum(-both.min(axis=0), 0.0)], axis=-1)
    by_rule = _by_rule(found, names, sides, mean)
    return [
        BeamForces(beam, storey_of(beam), tuple(of[0].tolist()), tuple(of[1].tolist()))
        for beam, of in zip(beams, by_rule, strict=True)
    ]


def support_forces(found: HistorySet, rules: SetRules) -> list[SupportForces]:
    """Return the extremes of all supports under the completed histories of a set, each with what acts with it.

    Of a mean the concurrent reactions are means too, horizontal ones and moments of their magnitudes, as they come
    from both sides.
    """
    names, groups = list(found.completed), list(found.completed.values())
    if not groups or "support_extreme_at" not in groups[0].variables:
        return []
    V, H, M = (
        np.array([np.asarray(group.variables[f"support_extreme_{name}"].values, dtype=float) for group in groups])
        for name in ("vertical_reaction", "horizontal_reaction", "moment")
    )
    H, M = np.abs(H.reshape(*V.shape, -1)), np.abs(M.reshape(*V.shape, -1)[..., :2])
    extremes = np.stack(
        [V[..., 0], -V[..., 1], np.linalg.norm(H[:, :, 2], axis=-1), np.linalg.norm(M[:, :, 3], axis=-1)], axis=-1
    )
    every = np.concatenate([V[..., None], H, M], axis=-1)
    motions: dict[str, list[int]] = {}
    for row, name in enumerate(names):
        motions.setdefault(found.motion_of[name], []).append(row)
    result = []
    for i, support in enumerate(str(name) for name in groups[0].coords["support"].values):
        for k, extreme in enumerate(str(name) for name in groups[0].coords["support_extreme"].values):
            rows = [max(own, key=lambda row: extremes[row, i, k]) for own in motions.values()]  # noqa: B023
            worst = max(rows, key=lambda row: extremes[row, i, k])  # noqa: B023
            of = every[rows, i, k].mean(axis=0) if rule_of(found, rules) == "mean" else every[worst, i, k]
            count = H.shape[-1]
            along, about = tuple(of[1 : 1 + count].tolist()), tuple(of[1 + count :].tolist())
            result.append(SupportForces(support, extreme, float(of[0]), along, about, names[worst]))
    return result
