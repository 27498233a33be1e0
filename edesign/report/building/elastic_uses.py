"""The use of members in the elastic design of a building, from its archive or from a frame taken out of it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.reader import Archive
from edesign.errors import ArchiveError
from edesign.project.frame.member_design import ElasticUse
from edesign.report.archived import archived_frame
from edesign.report.building.results import BuildingResults


def elastic_uses(archive: Archive) -> Mapping[str, ElasticUse]:
    """Return the largest use of each member with its check and combination; {} where nothing is known of it."""
    frame = archived_frame(archive)
    if frame is not None:
        return {} if frame.design is None else frame.design.elastic_use
    results = BuildingResults(archive)
    if not results.has("members") or not results.has("combinations"):
        return {}
    try:
        names, checks, combinations = (
            results.values(*of).tolist()
            for of in (("members", "member"), ("members", "check"), ("combinations", "name"))
        )
        uses, governing = (results.values("members", of) for of in ("utilisation", "combination"))
    except ArchiveError:
        return {}
    found = {}
    for name, use, combination in zip(names, np.nan_to_num(uses, nan=-1.0), governing, strict=True):
        at = int(use.argmax())
        if use[at] > 0.0 and combination[at] > 0:
            under = str(combinations[int(combination[at]) - 1])
            found[str(name)] = ElasticUse.model_construct(
                use=float(use[at]), check=str(checks[at]), combination=under, across=None
            )
    return found
