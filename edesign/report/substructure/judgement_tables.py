"""How good a substructure test was, as tables and as plain data."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from edesign.report.tables.table import Table, finite, number
from edesign.report.tables.text import wrapped
from edesign.substructure.indicators import Tracking, definitions
from edesign.substructure.judgement.judge import Criterion, JudgedResponse, Judgement

_SCALES = {"s": ("ms", 1e-3), "m": ("mm", 1e-3), "m2": ("mm2", 1e-6), "Hz": ("Hz", 1.0), "J": ("J", 1.0)}
_SHARES = ("nrms", "nrms_root", "maximum_error", "peak_error_mean", "peak_error_largest", "relative_energy_error")
_UNTOLD = "not told"


def judgement_tables(found: Judgement) -> list[Table]:
    """Return tracking, errors of the response, and verdict of a judgement."""
    tables = [_tracking(found)]
    if found.response is not None:
        tables += [_response(found.response), _criteria(found)]
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
    table = Table(f"How the specimen followed in {found.source.name}", ("indicator", "value", "unit"))
    for name, (_, unit) in definitions().items():
        table.rows.append([name.replace("_", " "), *_shown(found.tracking, name, unit)])
    table.notes += wrapped(
        "nrms: squared errors over squared targets, without a root, and with it; "
        "frequency index: frequency evaluation index (Guo et al. 2014); tracking indicator: area enclosed in the "
        "synchronisation plot, above zero if late (Mercan & Ricles 2007); energy error: work on the specimen less that "
        "of the structure (Mosqueda et al. 2007), relative to the largest work on the specimen"
    )
    return table


def _shown(found: Tracking, name: str, unit: str) -> tuple[str, str]:
    value = getattr(found, name)
    if isinstance(value, float) and math.isnan(value):
        return _UNTOLD, ""
    if name in _SHARES:
        return number(100.0 * value, 3), "%"
    shown, scale = _SCALES.get(unit, ("-" if unit == "1" else unit, 1.0))
    return (str(value) if isinstance(value, int) else number(value, 4, scale)), shown


def _response(found: JudgedResponse) -> Table:
    table = Table(f"Response of the structure in {found.test}", ("quantity", "value", "unit"))
    shares = (
        (
            f"{'target' if found.corrected else 'measured displacement'} against the direct analysis, rms",
            found.response_error,
        ),
        ("its peak", found.peak_error),
        ("recorded target against the direct analysis, rms", found.target_error),
        ("target by the measured force against the recorded one, rms", found.reproduced),
        ("force of the law against the measured one, NRMS", found.force_nrms),
        ("its root", found.force_nrms_root),
    )
    table.rows += [[text, number(100.0 * value, 3), "%"] for text, value in shares]
    critical = "none" if math.isinf(found.critical_delay) else number(found.critical_delay, 4, 1e-3)
    table.rows.append(["critical delay of the loop", critical, "ms"])
    table.notes += wrapped(
        f"ground motion: {found.driven_by}; law and measured force: both under the measured displacement"
    )
    return table


def _criteria(found: Judgement) -> Table:
    table = Table("Criteria", ("criterion", "value", "limit", "met"), sentences=0, name="criteria")
    table.rows += [_criterion(one) for one in found.criteria]
    return table


def _criterion(one: Criterion) -> list[str]:
    met = "yes" if one.met else "no" if one.determined else "not determined"
    if one.at_least:
        value = "no limit" if math.isinf(one.value) else number(one.value, 3)
        return [one.name, value, f"at least {one.limit:g}", met]
    return [one.name, f"{number(100.0 * one.value, 3)} %", f"{100.0 * one.limit:g} %", met]
