"""All declared tables by name: what each has, with units, in the order in which it is printed."""

from __future__ import annotations

from typing import Any

from edesign.report.building import (
    basis_tables,
    check_table,
    checks,
    deflection_table,
    foundation_table,
    other_tables,
    section_table,
    selection_tables,
)
from edesign.report.building import tables as building_tables
from edesign.report.calibration import error_tables, known_effects, properties
from edesign.report.calibration import tables as calibration_tables
from edesign.report.damper import fit_tables, law_table, measured_tables, sheet_tables
from edesign.report.export import catalogue
from edesign.report.inputs import damper_schedule, law_parameters, mass_table, variants_table
from edesign.report.response import brace_table, damper_results, ground_tables, hinge_tables, restrained_braces
from edesign.report.substructure import advice_tables, identified_rig_tables, judgement_tables, limits
from edesign.report.substructure import building_tables as tested_building
from edesign.report.substructure import tables as substructure_tables
from edesign.report.tables.spec import TableSpec

MODULES = (
    advice_tables,
    basis_tables,
    brace_table,
    building_tables,
    calibration_tables,
    catalogue,
    check_table,
    checks,
    damper_results,
    damper_schedule,
    deflection_table,
    error_tables,
    fit_tables,
    foundation_table,
    ground_tables,
    hinge_tables,
    identified_rig_tables,
    judgement_tables,
    known_effects,
    law_parameters,
    law_table,
    limits,
    mass_table,
    measured_tables,
    other_tables,
    properties,
    restrained_braces,
    section_table,
    selection_tables,
    sheet_tables,
    substructure_tables,
    tested_building,
    variants_table,
)
"""Modules that declare tables; a test finds those that are missing."""


def tables_by_name() -> dict[str, TableSpec[Any]]:
    """Return every declared table by its name, in the order of the names."""
    found = [spec for module in MODULES for spec in vars(module).values() if isinstance(spec, TableSpec)]
    return {spec.name: spec for spec in sorted(found, key=lambda spec: spec.name)}
