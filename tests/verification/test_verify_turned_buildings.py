"""A mirrored and a turned building give mirrored and turned results, whatever the axes of their members.

Reference: the same building where it was drawn. Vectors follow turn and mirror, rotations and moments as axial ones.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.corner_building import Built, Placing, building, motions, node_channels, shaken

from edesign.core import HHT, Bilinear, Channel, Integrator, MenegottoPinto, Newmark, Response, Steel

DT = 0.01
LAWS: dict[str, Steel] = {"bilinear": Bilinear(2.1e11, 235e6, 0.01), "curved": MenegottoPinto(2.1e11, 235e6, 0.01)}


def channels(built: Built) -> list[Channel]:
    ends = [
        Channel(f"f{k}.{c}", ((1.0, "global_force", member, c),))
        for k, member in enumerate(built.members)
        for c in range(12)
    ]
    locals_ = [Channel(f"q{k}", ((1.0, "axial_force", member, 0),)) for k, member in enumerate(built.members)]
    dampers = [Channel(f"d{k}", ((1.0, "damper_force", damper, 0),)) for k, damper in enumerate(built.dampers)]
    return node_channels(built) + ends + locals_ + dampers


def run(placing: Placing, law: str, geometry: str, diaphragms: bool, method: Integrator) -> tuple[Built, Response]:
    built = building(placing, LAWS[law], geometry, diaphragms)
    ground = np.array([placing.vector(sample) for sample in motions(DT, 1.6, 9.0).T]).T
    return built, shaken(built, ground, DT, channels(built), method=method, shortcuts=law != "curved")


def compare(got: np.ndarray, expected: np.ndarray, scale: float) -> None:
    np.testing.assert_allclose(got, expected, atol=1e-9 * scale, rtol=0)


PLACINGS = {
    "turned": Placing(0.7),
    "far": Placing(2.9),
    "mirrored": Placing(mirrored=True),
    "mirrored and turned": Placing(-1.1, True),
    "other local axes": Placing(web_turn=0.9),
    "lying": Placing(0.7, tilt=1.9),
}
METHODS: dict[str, Integrator] = {"newmark": Newmark(), "hht": HHT(-0.1)}


@pytest.mark.parametrize(
    ("law", "geometry", "method"),
    [
        ("bilinear", "p_delta", "newmark"),
        ("bilinear", "p_delta", "hht"),
        ("curved", "p_delta", "newmark"),
        ("bilinear", "corotational", "newmark"),
    ],
)
@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
def test_axes_mean_nothing(law: str, geometry: str, method: str, diaphragms: bool) -> None:
    """1e-9 of the largest: equilibrium to 1e-12 of the largest force, grown over 160 steps that yield.

    Curved layers go without the shortcut that takes their curve as straight for 1e-9 of the stress: how often depends
    on the axes.
    """
    here, plain = run(Placing(), law, geometry, diaphragms, METHODS[method])
    assert plain.energy["hysteretic"][-1] > 0.2 * plain.energy["input"][-1]
    if geometry == "p_delta":
        assert abs(plain.energy["p_delta"]).max() > 1e-3 * plain.energy["input"][-1]
    moved = max(np.abs(plain.values[f"u{node}.{d}"]).max() for node in here.nodes for d in range(2))
    turned = max(np.abs(plain.values[f"u{node}.{d}"]).max() for node in here.nodes for d in range(3, 6))
    force = max(np.abs(plain.values[f"f{k}.{c}"]).max() for k in range(8) for c in (0, 1, 2))
    moment = max(np.abs(plain.values[f"f{k}.{c}"]).max() for k in range(8) for c in (3, 4, 5))
    for placing in PLACINGS.values():
        if diaphragms and placing.tilt:
            continue  # they are level
        built, r = run(placing, law, geometry, diaphragms, METHODS[method])
        for node in here.nodes:
            u = np.array([plain.values[f"u{node}.{d}"] for d in range(6)])
            to = np.array([[*placing.vector(s[:3]), *placing.turn(s[3:])] for s in u.T]).T
            got = np.array([r.values[f"u{node}.{d}"] for d in range(6)])
            compare(got[:3], to[:3], moved)
            compare(got[3:], to[3:], turned)
        for k in range(len(here.members)):
            f = np.array([plain.values[f"f{k}.{c}"] for c in range(12)])
            got = np.array([r.values[f"f{k}.{c}"] for c in range(12)])
            for end in (0, 6):
                to = np.array([[*placing.vector(s[end : end + 3]), *placing.turn(s[end + 3 : end + 6])] for s in f.T]).T
                compare(got[end : end + 3], to[:3], force)
                compare(got[end + 3 : end + 6], to[3:], moment)
        for name in [f"q{k}" for k in range(len(here.members))] + [f"d{k}" for k in range(len(built.dampers))]:
            compare(r.values[name], plain.values[name], force)
        for name, energy in plain.energy.items():
            compare(r.energy[name], energy, abs(plain.energy["input"]).max())
