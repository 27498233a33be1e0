"""The forms of effects that records of structures may show, one table a subject."""

from __future__ import annotations

from edesign.calibration.structures.effect import StructureForm
from edesign.calibration.structures.effects import base, channel, damping, isolation, mass, partitions
from edesign.calibration.structures.sizes import StructureSizes

TABLES = (base, damping, isolation, channel)
"""Modules, each with its FORMS; those of single floors and storeys follow from the building."""


def forms(sizes: StructureSizes) -> tuple[StructureForm, ...]:
    """Return all forms that a structure and its channels can show."""
    every = (*partitions.of(sizes), *mass.of(sizes), *(form for table in TABLES for form in table.FORMS))
    return tuple(form for form in every if form.shown(sizes))
