"""The places of dampers of a design that has found no sizes: before a run, or where it failed."""

from __future__ import annotations

from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.dampers.designs import Design
from edesign.project.project import Project
from edesign.study.variants import dampers_at_temperature, laws_of_design


def planned_dampers(project: Project, design: Design) -> Dampers:
    """Return dampers in the places of a design, without sizes; of a placement in all its candidate places.

    Args:
        project: with the laws.
        design: of the study.
    """
    dampers = dampers_at_temperature(project, design)
    runs = [
        DamperRun.model_construct(kind=design.kind, bays=design.bays, storeys=design.storeys, law=law)
        for law in laws_of_design(design)
    ]
    return dampers.model_copy(update={"devices": tuple(runs)})
