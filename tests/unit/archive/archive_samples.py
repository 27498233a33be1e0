"""Groups of known content for the archive tests."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

from edesign.archive.attributes import encode
from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive


def axis(name: str, values: object, unit: str) -> dict[str, Variable]:
    return {name: Variable((name,), np.asarray(values), unit, name)}


def history_group(steps: int = 50, seed: int = 1) -> Group:
    """Floor displacements of three floors, a text, a truth value, a scalar and nested attributes."""
    random = np.random.default_rng(seed)
    group = Group(coords={**axis("time", np.arange(steps) * 0.01, "s"), **axis("floor", [1, 2, 3], "1")})
    group.coords |= axis("member", ["C_A_1", "B_1_1"], "")
    group.add("displacement", ("time", "floor"), random.normal(size=(steps, 3)), "m", "floor displacement")
    group.add("axial_force", ("member",), [-1.5e6, 2.0], "N", "extreme axial force")
    group.add("yielded", ("member",), [True, False], "1", "whether the member yielded")
    group.add("ratio", (), 0.5, "1", "a scalar")
    group.add("note", (), "10 °C, ünïcode", "", "a text")
    group.attributes = {
        "status": "completed",
        "reason": "",
        "steps": steps,
        "energy_error": 1.25e-9,
        "record": None,
        "converged": True,
        "statistics": {"steps": steps, "cpu_s": 0.1},
        "events": [{"time": 0.1, "step": 10, "rung": "halved", "detail": "é"}],
        "tricky": "json: not JSON",
        "ratios": np.array([0.02, 0.03]),
        "empty": [],
    }
    return group


def archived_groups(path: Path) -> dict[str, Group]:
    """Read the root, as "", and all groups in it and in these, by their places."""
    with open_archive(path) as archive:
        places = ["", *archive.names()]
        places += [f"{parent}/{name}" for parent in places[1:] for name in archive.names(parent)]
        return {place: archive.group(place) for place in places}


def write_layout_1(path: Path, groups: dict[str, Group]) -> Path:
    """Write an archive as the first version did: texts of variable length, no checksums; "" is the root."""
    texts = h5py.string_dtype("utf-8")
    with h5py.File(path, "w", libver=("v108", "v108")) as file:
        for place, group in groups.items():
            target = file.require_group(place or "/")
            for name, variable in {**group.coords, **group.variables}.items():
                values = variable.values
                if values.dtype.kind == "U":
                    dataset = target.create_dataset(name, data=values.astype(object), dtype=texts)
                else:
                    dataset = target.create_dataset(
                        name, data=values.astype(np.int8) if values.dtype == bool else values
                    )
                dataset.attrs.update({"units": variable.unit, "long_name": variable.long_name})
                if values.dtype == bool:
                    dataset.attrs["dtype"] = "bool"
                if name in group.coords:
                    dataset.make_scale(name)
                for axis, dimension in enumerate(variable.dims if name in group.variables else ()):
                    dataset.dims[axis].attach_scale(target[dimension])
            for name, value in group.attributes.items():
                target.attrs[name] = encode(value)
        file.attrs.update({"edesign_archive": 1, "complete": 1})
    return path
