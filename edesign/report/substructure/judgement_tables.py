"""How good a substructure test was, as tables and as plain data."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from edesign.report.tables.cell import Marked, Quantity, Value, yes_or_no
from edesign.report.tables.column import col, text, verdict
from edesign.report.tables.number import finite
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import HZ, MM, MM2, MS, ONE, PERCENT, J, Unit
from edesign.substructure.indicators import Tracking, definitions
from edesign.substructure.judgement.judge import JudgedResponse, Judgement, QualityCriterion

_UNITS = {"s": MS, "m": MM, "m2": MM2, "Hz": HZ, "J": J, "1": Unit("-")}
_SHARES = ("nrms", "nrms_root", "maximum_error", "peak_error_mean", "peak_error_largest", "relative_energy_error")
_UNDETERMINED = "not determined"


def _value(one: QualityCriterion) -> Value:
    if one.at_least:
        return "no limit" if math.isinf(one.value) else Quantity(one.value, ONE, 3)
    return Quantity(one.value, PERCENT, 3)


def _limit(one: QualityCriterion) -> Value:
    if one.at_least:
        return Marked(Quantity(one.limit, ONE, form="g"), before="at least ")
    return Quantity(one.limit, PERCENT, form="g")


TRACKING = TableSpec[Row](
    "tracking_of_record",
    "How the specimen followed in {source}",
    (text("indicator"), col("value", ONE), text("unit")),
    notes=wrapped(
        "nrms: squared errors over squared targets, without a root, and with it; "
        "frequency index: frequency evaluation index (Guo et al. 2014); tracking indicator: area enclosed in the "
        "synchronisation plot, above zero if late (Mercan & Ricles 2007); energy error: work on the specimen less that "
        "of the structure (Mosqueda et al. 2007), relative to the largest work on the specimen"
    ),
    named_by_title=True,
)
RESPONSE = TableSpec[Row](
    "response_of_record",
    "Response of the structure in {test}",
    (text("quantity"), col("value", ONE), text("unit")),
    named_by_title=True,
)
CRITERIA = TableSpec[QualityCriterion](
    "criteria_of_tests",
    "Criteria",
    (
        text("criterion", "name", broken=1),
        col("value", ONE, _value),
        col("limit", ONE, _limit),
        verdict("met", lambda one: yes_or_no(one.met) if one.met or one.determined else "not determined"),
    ),
    named_as="criteria",
)


def judgement_tables(found: Judgement) -> list[Table]:
    """Return tracking, errors of the response, and verdict of a judgement."""
    tables = [_tracking(found)]
    if found.response is not None:
        tables += [_response(found.response), CRITERIA.of(found.criteria)]
    tables[-1].notes += [line for text in (found.verdict, *found.notes) for line in wrapped(text)]
    return tables


def judgement_data(found: Judgement) -> dict[str, Any]:
    """Return a judgement as plain data in SI, for JSON; numbers that are not finite are null."""
    response = None
    if found.response is not None:
        response = {
            name: finite(value) for name, value in vars(found.response).items() if not isinstance(value, np.ndarray)
        }
    return {
        "source": str(found.source),
        "test": None if found.test is None else found.test.name,
        "step": found.step,
        "samples": found.samples,
        "tracking": {
            entry.name: finite(getattr(found.tracking, entry.name))
            for entry in dataclasses.fields(found.tracking)
            if entry.metadata
        },
        "response": response,
        "criteria": [{**{k: finite(v) for k, v in vars(one).items()}, "met": one.met} for one in found.criteria],
        "good": found.good,
        "verdict": found.verdict,
        "notes": list(found.notes),
    }


def _tracking(found: Judgement) -> Table:
    rows = [_indicator(found.tracking, name, unit) for name, (_, unit) in definitions().items()]
    return TRACKING.of(rows, source=found.source.name)


def _indicator(found: Tracking, name: str, unit: str) -> Row:
    value, words = getattr(found, name), name.replace("_", " ")
    if isinstance(value, float) and math.isnan(value):
        return (words, _UNDETERMINED, "")
    if name in _SHARES:
        return _share(words, value)
    shown = _UNITS.get(unit, Unit(unit))
    form = "d" if isinstance(value, int) else ""
    return (words, Quantity(value, shown, form=form, beside=True), shown.name)


def _share(name: str, value: float) -> Row:
    return (name, Quantity(value, PERCENT, 3, beside=True), PERCENT.name)


def _response(found: JudgedResponse) -> Table:
    compared = "target" if found.corrected else "measured displacement"
    critical = "none" if math.isinf(found.critical_delay) else Quantity(found.critical_delay, MS, beside=True)
    rows = [
        _share(f"{compared} against the direct analysis, rms", found.response_error),
        _share("its peak", found.peak_error),
        _share("recorded target against the direct analysis, rms", found.target_error),
        _share("target by the measured force against the recorded one, rms", found.reproduced),
        _share("force of the law against the measured one, NRMS", found.force_nrms),
        _share("its root", found.force_nrms_root),
        ("critical delay of the loop", critical, MS.name),
    ]
    notes = wrapped(f"ground motion: {found.driven_by}; law and measured force: both under the measured displacement")
    return RESPONSE.of(rows, notes=notes, test=found.test)
