"""Pairs of components and their fit to the spectrum as groups of the archive."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

from edesign.archive.dataset import Group
from edesign.ground_motion.component_pairs import NAMES
from edesign.project.records.pairs import OnePair, SuitePairs
from edesign.study.motions.motions import Motion
from edesign.study.motions.pairs import PairMotion, PairSet
from edesign.study.motions.record_groups import suite_groups


def pair_groups(pairs: PairSet, order: int = 0, warnings: Sequence[str] = ()) -> Iterator[tuple[str, Group]]:
    """Yield place and group of the pairs of a record, then of their components.

    Args:
        pairs: made ready.
        order: place of the record among all.
        warnings: what the user should know of the whole.
    """
    members = [
        Motion(f"{pairs.name}/{found.record.name}", found, match, motion.failure)
        for motion in pairs.motions
        for found, match in zip(motion.pair.found, (*(motion.matches or (None, None)), None), strict=False)
    ]
    groups = suite_groups(pairs.name, members, pairs.target, pairs.criteria, order, warnings)
    place, group = next(groups)
    group.attributes["pairs"] = {
        "acting": acting_text(pairs.spec, pairs.angles),
        "rule": f"{pairs.rule.clauses}: {pairs.rule.text}".removeprefix(": ") if pairs.target is not None else "",
        "suite_factor": pairs.suite_factor,
        "of": [_about(motion, pairs) for motion in pairs.motions],
    }
    yield place, group
    yield from groups


def acting_text(spec: SuitePairs | OnePair, angles: Sequence[float] = ()) -> str:
    """Return how pairs act on the building: `along x and y, turned by 0 and 90 deg`.

    Args:
        spec: what the file says.
        angles: by which histories turn them, rad; none are said.
    """
    turned = f", turned by {' and '.join(f'{math.degrees(angle):.4g}' for angle in angles)} deg" if angles else ""
    upwards = ", with the vertical components" if spec.vertical else ""
    return f"along {' and '.join(spec.components)}{turned}{upwards}"


def _about(motion: PairMotion, pairs: PairSet) -> dict[str, Any]:
    """What an archive keeps of a pair."""
    said: dict[str, Any] = {
        "name": motion.pair.name,
        "components": [found.record.name for found in motion.pair.found],
        "azimuths_deg": [None if one is None else round(math.degrees(one), 3) for one in motion.pair.azimuths],
        "factors": list(motion.factors),
        "spectrum": "" if motion.matches is None else NAMES[pairs.spectrum] if pairs.spectrum else "each component",
        "failure": motion.failure,
    }
    if motion.fit is not None:
        said |= {"best_factor": motion.fit.best * pairs.suite_factor, "misfit": asdict(motion.fit.misfit)}
    return said
