"""Summaries of tables: tests of dampers, properties, and ground motion records in any format."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.damper.testing.measured_files import EXAMPLE, read_test
from edesign.damper.testing.property_table import COLUMNS, read_property_table
from edesign.ground_motion.formats.read import FORMATS, component_labels, detect, read_record_file
from edesign.ground_motion.intensity import measures
from edesign.ground_motion.plausibility import record_warnings
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.check.damper_files import force_warnings, table_range
from edesign.tables.quantities import names_quantity
from edesign.tables.table import read_table

_PROPERTIES = 3  # headers of a property table that identify it
_TEST = 2  # and of a test: time, and displacement or force


def table_summary(path: Path) -> dict[str, str]:
    """Return the kind of a table of numbers by its headers: a damper test, properties, or samples of a record.

    Raises:
        InputError: it is wrong.
    """
    table = read_table(path, "table", EXAMPLE, names_quantity)
    if sum(header in COLUMNS for header in table.headers) >= _PROPERTIES:
        properties = read_property_table(path)
        return {
            "table": f"properties of an elastomer, {properties.strain.size} rows",
            "range": table_range(properties),
        }
    words = [header.lower() for header in table.headers]
    named = any(word.startswith(("displacement", "stroke", "axial", "force", "load")) for word in words)
    if named or sum(map(names_quantity, table.headers)) >= _TEST:
        return _test_summary(path)
    if detect(path) != "table":
        return record_summary(path)
    return {
        "table": f"{table.rows.shape[0]} rows, columns {', '.join(table.headers)}",
        **({"read": table.form.words} if table.form.words else {}),
        "use": "a record if it has accelerations: a project names it with `acceleration_unit`, and `time_step` or a\n"
        "column of times; `edesign spectrum` takes it with --unit; `edesign inspect` prints what reads it",
    }


def record_summary(path: Path) -> dict[str, str]:
    """Return format, components and measures of a ground motion record.

    Raises:
        InputError: it is none, or cannot be read.
    """
    found = detect(path)
    if found == "table":
        return table_summary(path)
    labels = component_labels(path, found)
    summary = {"record": FORMATS[found]}
    warnings = []
    for label in labels or (None,):
        record = read_record_file(path, file_format=found, component=label)
        own = measures(record)
        duration = (record.acceleration.size - 1) * record.time_step
        summary[label or "samples"] = (
            f"{record.acceleration.size} at {record.time_step:g} s, {duration:.4g} s; PGA "
            f"{own.pga / STANDARD_GRAVITY:.3g} g, PGV {own.pgv:.3g} m/s, Arias {own.arias:.3g} m/s, "
            f"D5-95 {own.duration_5_95:.3g} s"
        )
        summary.setdefault("source", record.source)
        warnings += [f"{label}: {text}" if label else text for text in record_warnings(record)]
    return summary | ({"warnings": "\n".join(warnings)} if warnings else {})


def _test_summary(path: Path) -> dict[str, str]:
    test = read_test(path, temperature_C=0.0, needs_force=False)
    steps = np.diff(test.time)
    force = "no force" if test.force is None else f"force to {1e-3 * np.max(np.abs(test.force)):.4g} kN"
    heat = test.temperature_history
    celsius = (
        "no temperature: the campaign says it" if heat is None else f"{np.min(heat):.4g} to {np.max(heat):.4g} degC"
    )
    warnings = [f"not read: {', '.join(test.unread)}"] if test.unread else []
    if np.ptp(steps) > 0.5 * np.median(steps):
        warnings.append(f"times are uneven: steps from {np.min(steps):.3g} to {np.max(steps):.3g} s")
    warnings += force_warnings(test) if test.force is not None else []
    return {
        "table": "test of a damper",
        **({"read": test.reading} if test.reading else {}),
        "samples": f"{test.time.size}, {test.time[-1] - test.time[0]:.4g} s at {1.0 / np.median(steps):.4g} Hz",
        "range": f"displacement to {1e3 * np.max(np.abs(test.displacement)):.4g} mm, {force}; {celsius}",
        **({"warnings": "\n".join(warnings)} if warnings else {}),
    }
