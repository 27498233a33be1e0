"""The peer frame in edesign's numerical core, built from the same numbers as in the peers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from benchmarks.peers.frame_data import PeerFrame
from edesign.core import Analysis, Bilinear, Channel, Model, Modes, Response, Steel

Array = NDArray[np.float64]


@dataclass
class CoreFrame:
    """A model with the ids of its parts: node[line, floor], column[line, storey], beam[bay, floor], patterns."""

    model: Model
    gravity: int
    push: int
    node: dict[tuple[int, int], int] = field(default_factory=dict)
    column: dict[tuple[int, int], int] = field(default_factory=dict)
    beam: dict[tuple[int, int], int] = field(default_factory=dict)


def build(frame: PeerFrame, push_loads: Array | None = None, law: Steel | None = None) -> CoreFrame:
    """The frame with P-Delta columns and linear beams.

    Args:
        frame: in numbers.
        push_loads: horizontal, shape (n_storeys, n_lines), N.
        law: of all fibres; None for the frame's bilinear one.
    """
    model = Model()
    steel = model.material(law or Bilinear(frame.E, frame.fy, frame.hardening))
    sections = {}
    for section in dict.fromkeys((*frame.columns, *frame.beams)):
        y, area = section.layers(frame.flange_fibres[1], frame.web_fibres[1])
        sections[section] = model.fibre_section(y, area, steel)
    core = CoreFrame(model, model.pattern(), model.pattern())
    for floor, y in enumerate(frame.y):
        for line, x in enumerate(frame.x):
            core.node[line, floor] = node = model.node(f"{chr(65 + line)}{floor}", x, float(y))
            if floor == 0:
                model.fix(node, True, True, True)
            else:
                model.mass(node, frame.masses[line], 0.0)
                if push_loads is not None:
                    model.nodal_load(core.push, node, fx=float(push_loads[floor - 1, line]))
    for floor in range(1, frame.n_storeys + 1):
        for line in range(frame.n_lines):
            ends = core.node[line, floor - 1], core.node[line, floor]
            section = sections[frame.columns[floor - 1]]
            name = f"C_{chr(65 + line)}_{floor}"
            core.column[line, floor] = model.beam_column(name, *ends, section, frame.points, "p_delta")
        for bay in range(frame.n_bays):
            ends = core.node[bay, floor], core.node[bay + 1, floor]
            section = sections[frame.beams[floor - 1]]
            name = f"B_{bay + 1}_{floor}"
            core.beam[bay, floor] = model.beam_column(name, *ends, section, frame.points, "linear")
            model.uniform_load(core.gravity, core.beam[bay, floor], transverse=-frame.gravity)
    return core


def periods(frame: PeerFrame, n: int = 3) -> tuple[Array, Array]:
    """Periods without loads and under gravity, (n,) and (n,), s."""
    core = build(frame)
    analysis = Analysis(core.model)
    bare = analysis.modes(n).period
    analysis.static(core.gravity, 1.0, 10)
    return bare, analysis.modes(n).period


def first_mode_loads(frame: PeerFrame) -> Array:
    """Mass times first mode under gravity at the nodes, of sum 1, (n_storeys, n_lines)."""
    core = build(frame)
    analysis = Analysis(core.model)
    analysis.static(core.gravity, 1.0, 10)
    shape = analysis.modes(1).shapes[0, :, 0]
    loads = np.array(
        [
            [shape[core.node[line, floor]] * frame.masses[line] for line in range(frame.n_lines)]
            for floor in range(1, frame.n_storeys + 1)
        ]
    )
    return np.asarray(loads / loads.sum())


def pushover(frame: PeerFrame, roof_drift: float = 0.02, steps: int = 200, **settings: float) -> tuple[Array, Array]:
    """Roof displacement (steps + 1,) m and base shear (steps + 1,) N under first-mode loads after gravity."""
    response = pushover_response(frame, roof_drift, steps, **settings)
    return response.values["roof"], response.values["shear"]


def pushover_response(
    frame: PeerFrame, roof_drift: float = 0.02, steps: int = 200, law: Steel | None = None, **settings: float
) -> Response:
    """As `pushover`, with what it cost; `law` is that of all fibres, None for the frame's bilinear one."""
    core = build(frame, first_mode_loads(frame), law=law)
    analysis = Analysis(core.model, **settings)
    analysis.static(core.gravity, 1.0, 10)
    roof = core.node[frame.n_lines // 2, frame.n_storeys]
    channels = [
        Channel("roof", ((1.0, "displacement", roof, 0),)),
        Channel("shear", tuple((-1.0, "reaction", core.node[line, 0], 0) for line in range(frame.n_lines))),
    ]
    start = float(analysis.static(core.gravity, 1.0, 1, channels[:1]).final["roof"])
    response = analysis.pushover(core.push, roof, "ux", start + roof_drift * frame.height, steps, channels)
    if response.status != "completed":
        raise RuntimeError(response.reason)
    return response


def history(
    frame: PeerFrame,
    ground_acceleration: Array,
    dt: float,
    damping: float = 0.02,
    sampled: bool = True,
    law: Steel | None = None,
    **settings: float,
) -> tuple[Response, Modes]:
    """Time history as in the peers: gravity first, current-stiffness Rayleigh damping, average acceleration.

    Channels if sampled: roof, drift_1.., base_shear, roof_acceleration; otherwise nothing is recorded in the loop.
    `law` is that of all fibres, None for the frame's bilinear one.
    """
    core = build(frame, law=law)
    analysis = Analysis(core.model, **settings)
    response = analysis.static(core.gravity, 1.0, 10)
    if response.status != "completed":
        raise RuntimeError(response.reason)
    modes = analysis.modes(2)
    w1, w2 = modes.omega
    analysis.rayleigh(2.0 * damping * w1 * w2 / (w1 + w2), 2.0 * damping / (w1 + w2), "current")
    channels: list[Channel] = []
    if sampled:
        middle = frame.n_lines // 2
        top = core.node[middle, frame.n_storeys]
        channels = [
            Channel("roof", ((1.0, "displacement", top, 0),)),
            Channel("base_shear", tuple((1.0, "reaction", core.node[k, 0], 0) for k in range(frame.n_lines))),
            Channel("roof_acceleration", ((1.0, "total_acceleration", top, 0),)),
        ]
        for floor, height in enumerate(frame.storey_heights, start=1):
            terms = (
                (1.0 / height, "displacement", core.node[middle, floor], 0),
                (-1.0 / height, "displacement", core.node[middle, floor - 1], 0),
            )
            channels.append(Channel(f"drift_{floor}", terms))
    result = analysis.history(ground_acceleration, dt, channels=channels, every=1 if sampled else 0)
    return result, modes
