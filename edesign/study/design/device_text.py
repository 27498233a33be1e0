"""The devices of a design as they stand in a project file."""

from __future__ import annotations

import yaml

from edesign.project.dampers.dampers import Brace, BraceSection, BraceStiffness, ChosenBrace, DamperRun, Dampers


def devices_text(dampers: Dampers) -> str:
    """Return the `devices` of the block `dampers` of a project file as YAML, with full digits."""
    return yaml.safe_dump({"devices": [_entry(run) for run in dampers.devices]}, sort_keys=False, width=120)


def _entry(run: object) -> dict[str, object]:
    assert isinstance(run, DamperRun), "a design makes runs of dampers"
    size: dict[str, object] = {}
    if run.layers is not None:
        size["layers"] = run.layers
    units = {"layer_area": "m^2", "layer_thickness": "m", "strain_limit": "", "scale": "", "design_deformation": "m"}
    for key, unit in units.items():
        value = getattr(run, key)
        if value is not None:
            size[key] = _with_unit(value, unit)
    where = {} if run.along is None else {"along": run.along, "frames": _selection(str(run.frames))}
    return {
        "kind": run.kind,
        **where,
        "bays": _selection(str(run.bays)),
        "storeys": _selection(str(run.storeys)),
        "law": run.law,
        "number": run.number,
        **size,
        "brace": _brace(run.brace),
        **({"carries_gravity": True} if run.carries_gravity else {}),
    }


def _brace(brace: Brace) -> object:
    if isinstance(brace, BraceSection):
        section = list(brace.section) if isinstance(brace.section, tuple) else brace.section
        factor = {} if brace.buckling_length_factor == 1.0 else {"buckling_length_factor": brace.buckling_length_factor}
        return {"section": section, "material": brace.material, **factor}
    if isinstance(brace, ChosenBrace):
        said = brace.model_dump(mode="json", exclude_defaults=True)
        units = {"force": "N", "stiffness": "N/m"}
        return said | {key: _with_unit(getattr(brace, key), unit) for key, unit in units.items() if key in said}
    if not isinstance(brace, BraceStiffness):
        return brace
    found = {"stiffness": _with_unit(brace.stiffness, "N/m")}
    if brace.play is not None:
        found["play"] = _with_unit(brace.play, "m")
    return found


def _selection(text: str) -> object:
    return yaml.safe_load(text)


def _with_unit(value: object, unit: str) -> object:
    """A value or values with their unit; bare numbers where there is none."""
    if isinstance(value, tuple):
        return [_with_unit(item, unit) for item in value]
    return f"{value!r} {unit}" if unit else value
