"""Elevations of a building with the dampers that designs of its study have found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from edesign.project.building import Building
from edesign.project.dampers.dampers import Dampers
from edesign.project.study.study import Study
from edesign.report.building.figures.model_elevations import model_elevations
from edesign.report.model.figures import Named
from edesign.space.structure.geometry import space_frame
from edesign.study.plan.variants import variant_project


def variant_elevations(study: Study, designed: Mapping[str, Dampers]) -> Iterator[Named]:
    """Yield the frames with dampers of each variant that has designs; of variants with the same designs the first.

    Args:
        designed: dampers by name of the design, as far as they are known.
    """
    drawn = set()
    for name, variant in study.variants.items():
        if not variant.designs or variant.designs in drawn or not all(one in designed for one in variant.designs):
            continue
        drawn.add(variant.designs)
        building = variant_project(study, name, designed)
        assert isinstance(building, Building)
        yield from model_elevations(building, space_frame(building), variant=name)
