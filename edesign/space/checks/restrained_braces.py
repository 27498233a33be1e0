"""Rules for buckling-restrained braces: the strain of their cores, what their connections hold, how alike they are."""

from __future__ import annotations

import numpy as np

from edesign.codes.aisc341.buckling_restrained import expected_deformation
from edesign.codes.ec8.steel.concentric_braces import HOMOGENEITY, least_and_most
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.space.analysis.storeys import Storeys
from edesign.space.checks.capacity import Overstrength
from edesign.space.structure.frame import AXES, SpaceFrame
from edesign.space.structure.restrained import RestrainedBraces


def hardening_of(restrained: RestrainedBraces, members: np.ndarray) -> float | None:
    """Return the largest beta omega R_y of some members, what braces gain beyond P_ysc; None: none is such a brace.

    Args:
        members: numbers of them.
    """
    found = [
        of.adjusted_compression / of.yield_force
        for number, of in zip(restrained.numbers, restrained.braces, strict=True)
        if number in members
    ]
    return max(found, default=None)


def restrained_criteria(
    frame: SpaceFrame, restrained: RestrainedBraces, overstrength: Overstrength, storeys: Storeys
) -> list[RuleCheck]:
    """Return the rules for the buckling-restrained braces of one direction.

    The strain of the core is that with P_ysc in the brace, which leaves the core the most of the deformation.

    Args:
        frame: with its sections.
        overstrength: of this direction.
        storeys: of this direction, with their design drifts.

    Returns:
        The largest strain of the cores over the strain that omega and beta are known at; for each group and section
        what its connections hold; and how much the strength over the demand differs, for information.

    Source: AISC 341-16, F4.2, F4.5b and F4.6.
    """
    axis = overstrength.axis
    number = AXES.index(axis)
    strains, connections = [], dict[tuple[str, str], RuleCheck]()
    for at, brace in zip(restrained.numbers, restrained.braces, strict=True):
        member = frame.members[at]
        if at not in overstrength.members:
            continue
        run = abs(float(frame.coordinates[member.end, number] - frame.coordinates[member.start, number]))
        storey = member.storey - 1
        drift = float(storeys.drift[storey])
        moved = expected_deformation(drift, float(storeys.height[storey]), run / brace.length)
        by_force, by_deformation = brace.strain_of_core
        strain = by_force * brace.yield_force + by_deformation * moved
        strains.append(
            at_most(
                "AISC 341-16, F4.2",
                f"strain of cores at twice the design drift, at least 2 %; omega and beta are known up to it, {axis}",
                brace.tested_strain,
                strain,
                member.name,
            )
        )
        tension, compression = brace.adjusted_tension / 1e3, brace.adjusted_compression / 1e3
        connections.setdefault(
            (member.group, member.section),
            RuleCheck(
                "AISC 341-16, F4.6",
                f"connections of {member.group}, {member.section}: beta omega R_y P_ysc, kN",
                None,
                compression,
                "kN",
                None,
                f"in tension {tension:.4g} kN; P_ysc = {brace.yield_force / 1e3:.4g} kN",
            ),
        )
    ratios = overstrength.ratios
    least, most = float(ratios.min()), float(ratios.max())
    names = [frame.members[at].name for at in overstrength.members]
    detail = f"{least_and_most(ratios, names)}; {HOMOGENEITY:g} is the limit of other diagonals"
    alike = RuleCheck(
        "6.7.3(8)",
        f"overstrength of the braces over the least one, direction {axis}",
        None,
        most / least - 1.0,
        "",
        None,
        detail,
    )
    return [max(strains, key=lambda rule: rule.utilisation), *connections.values(), alike]
