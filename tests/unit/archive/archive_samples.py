"""Groups of known content for the archive tests."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable


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
