"""The tables of all designs of a study."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from edesign.archive.reader import Archive
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.sets import HistorySet
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.study.study import Study
from edesign.report.design.tables import design_tables
from edesign.report.tables.table import Table
from edesign.study.plan.device_factors import raised_devices
from edesign.study.plan.variants import bound_of
from edesign.study.results.kinds import DESIGNS


def designs_tables(archive: Archive, study: Study | None, sets: Sequence[HistorySet]) -> list[Table]:
    """Return the tables of each design: size of the dampers of each storey, and the damping that they add.

    Args:
        archive: of a study.
        study: that it holds; None: it cannot be read.
    """
    tables = []
    hazard = None if study is None else study.base.hazard
    for name in archive.names(DESIGNS):
        factors = {} if study is None else property_factors_of(study, name)
        raised = RaisedDevices() if study is None else raised_devices(study, name)
        found = design_tables(archive.group(f"{DESIGNS}/{name}"), sets, factors, hazard, raised)
        tables += [replace(table, owner=name) for table in found]
    return tables


def property_factors_of(study: Study, design: str) -> dict[str, float]:
    """Return the factors on the forces of the dampers of the variants that have a design: of law, variant and bound.

    Of a placement that of the law is left out, as its dampers may have several laws.
    """
    dampers, spec = study.base.dampers, study.designs[design]
    own = 1.0
    if dampers is not None and not isinstance(spec, PlacementDesign):
        own = dampers.laws[spec.law].property_factor
    return {
        key: own * (variant.property_factor or 1.0) * bound_of(study, key)[0]
        for key, variant in study.variants.items()
        if design in variant.designs
    }
