"""The devices of a design as they stand in a project file."""

from __future__ import annotations

import yaml

from edesign.project.dampers.dampers import BraceStiffness, DamperRun, Dampers


def devices_text(dampers: Dampers) -> str:
    """The `devices` of the block `dampers` of a project file, with full digits."""
    return yaml.safe_dump({"devices": [_entry(run) for run in dampers.devices]}, sort_keys=False, width=120)


def _entry(run: object) -> dict[str, object]:
    assert isinstance(run, DamperRun), "a design makes runs of dampers"
    brace: object = run.brace
    if isinstance(run.brace, BraceStiffness):
        brace = {"stiffness": _with_unit(run.brace.stiffness, "N/m")}
    size: dict[str, object] = {
        "layers": run.layers,
        "layer_area": _with_unit(run.layer_area, "m^2"),
        "layer_thickness": _with_unit(run.layer_thickness, "m"),
    }
    if run.scale is not None:
        size = {"scale": list(run.scale) if isinstance(run.scale, tuple) else run.scale}
    if run.design_deformation is not None:
        size["design_deformation"] = _with_unit(run.design_deformation, "m")
    return {
        "kind": run.kind,
        "bays": _selection(str(run.bays)),
        "storeys": _selection(str(run.storeys)),
        "law": run.law,
        "number": run.number,
        **size,
        "brace": brace,
    }


def _selection(text: str) -> object:
    return yaml.safe_load(text)


def _with_unit(value: object, unit: str) -> object:
    if isinstance(value, tuple):
        return [f"{item!r} {unit}" for item in value]
    return f"{value!r} {unit}"
