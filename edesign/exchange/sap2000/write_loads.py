"""The loads and load cases of a model as SAP2000's tables in kN, m and C."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from edesign.exchange.sap2000.model import Sap2000Model

_KILO = 1e3
_MODES = 12  # SAP2000's own number
_GLOBAL = {(1.0, 0.0, 0.0): "X", (0.0, 1.0, 0.0): "Y", (0.0, 0.0, 1.0): "Z"}
Records = Iterator[Mapping[str, Any]]
"""Texts, numbers and truth values by the names of fields."""


def load_tables(model: Sap2000Model) -> Iterator[tuple[str, Records]]:
    """Yield the tables of load patterns, loads, masses' source and spectra."""
    patterns = model.patterns.values()
    yield (
        "LOAD PATTERN DEFINITIONS",
        ({"LoadPat": p.name, "DesignType": p.kind, "SelfWtMult": p.self_weight} for p in patterns),
    )
    yield (
        "JOINT LOADS - FORCE",
        (
            {"Joint": load.joint, "LoadPat": load.pattern, "CoordSys": "GLOBAL"}
            | {d: v / _KILO for d, v in zip(("F1", "F2", "F3", "M1", "M2", "M3"), load.forces, strict=True)}
            for load in model.joint_loads
        ),
    )
    yield (
        "FRAME LOADS - DISTRIBUTED",
        (
            {"Frame": load.frame, "LoadPat": load.pattern, "CoordSys": "GLOBAL", "Type": "Force"}
            | {"Dir": _GLOBAL[load.along], "DistType": "RelDist", "RelDistA": load.start, "RelDistB": load.end}
            | {"AbsDistA": load.start * length, "AbsDistB": load.end * length}
            | {"FOverLA": load.at_start / _KILO, "FOverLB": load.at_end / _KILO}
            for load in model.frame_loads
            for length in [model.length(model.frames[load.frame])]
        ),
    )
    yield (
        "FRAME LOADS - POINT",
        (
            {"Frame": load.frame, "LoadPat": load.pattern, "CoordSys": "GLOBAL", "Type": "Force"}
            | {"Dir": _GLOBAL[load.along], "DistType": "RelDist", "RelDist": load.at}
            | {"AbsDist": load.at * model.length(model.frames[load.frame]), "Force": load.force / _KILO}
            for load in model.frame_points
        ),
    )
    yield (
        "MASS SOURCE",
        iter([{"MassSource": "MSSSRC1", "Elements": False, "Masses": True, "Loads": False, "IsDefault": True}]),
    )
    yield (
        "FUNCTION - RESPONSE SPECTRUM - USER",
        (
            {"Name": f.name, "Period": float(T), "Accel": float(a), **({"FuncDamp": f.damping} if n == 0 else {})}
            for f in model.spectra
            for n, (T, a) in enumerate(zip(f.periods, f.accelerations, strict=True))
        ),
    )


def case_tables(model: Sap2000Model) -> Iterator[tuple[str, Records]]:
    """Yield the tables of load cases: of each pattern, of the gravity loads before the modes, and the modes."""
    linear = [p.name for p in model.patterns.values()]
    loads = [(name, name, 1.0) for name in linear]
    records: list[Mapping[str, Any]] = [
        {"Case": name, "Type": "LinStatic", "InitialCond": "Zero", "RunCase": True} for name in linear
    ]
    gravity = model.gravity
    if gravity is not None:
        kind = "NonStatic" if gravity.p_delta else "LinStatic"
        records.append({"Case": "GRAVITY", "Type": kind, "InitialCond": "Zero", "RunCase": True})
        loads += [("GRAVITY", name, factor) for name, factor in gravity.factors.items()]
    stiffened = gravity is not None and gravity.p_delta
    records.append(
        {"Case": "MODAL", "Type": "LinModal", "InitialCond": "GRAVITY" if stiffened else "Zero", "RunCase": True}
    )
    yield "LOAD CASE DEFINITIONS", iter(records)
    yield (
        "CASE - STATIC 1 - LOAD ASSIGNMENTS",
        (
            {"Case": case, "LoadType": "Load pattern", "LoadName": name, "LoadSF": factor}
            for case, name, factor in loads
        ),
    )
    if stiffened:
        yield "CASE - STATIC 2 - NONLINEAR LOAD APPLICATION", iter([{"Case": "GRAVITY", "LoadApp": "Full Load"}])
        parameters = {"Case": "GRAVITY", "GeoNonLin": "P-Delta", "ResultsSave": "Final State"}
        yield "CASE - STATIC 4 - NONLINEAR PARAMETERS", iter([parameters])
    yield (
        "CASE - MODAL 1 - GENERAL",
        iter([{"Case": "MODAL", "ModeType": "Eigen", "MaxNumModes": _MODES, "MinNumModes": 1}]),
    )
