"""The peer building in edesign's numerical core, built from the same numbers as in the peers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.peers.building_data import BuildingHistory, PeerBuilding
from benchmarks.peers.frame_data import MENEGOTTO_PINTO
from benchmarks.timing import describe
from edesign.core import Analysis, Bilinear, Channel, Elastic, MenegottoPinto, Model, Response, Steel
from edesign.core.analysis import SupportMotion

Array = NDArray[np.float64]

AXIAL, ABOUT_Y, ABOUT_Z = 0, 4, 5  # components of end forces at the start of a member


@dataclass(frozen=True)
class CoreBuilding:
    """A model with the pattern of its gravity loads; its nodes and members have the numbers of the building."""

    model: Model
    gravity: int


def build(building: PeerBuilding) -> CoreBuilding:
    """The building with its gravity loads."""
    model = Model(dimension=3)
    floors = (f"master {k + 1}" for k in range(building.n_floors))
    places = np.concatenate([building.coordinates, building.masters])
    nodes = [
        model.node(name, *map(float, place)) for name, place in zip((*building.names, *floors), places, strict=True)
    ]
    for node in building.supports:
        model.fix(nodes[node], **dict(zip(model.degrees, map(bool, building.fixed[node]), strict=True)))
    for master, floor in zip(nodes[building.n_nodes :], building.diaphragms, strict=True):
        model.fix(master, uz=True, rx=True, ry=True)
        model.diaphragm(master, [nodes[int(node)] for node in floor])
    for node, (mx, my, mz, mrx, mry, mrz) in zip(nodes, building.mass.tolist(), strict=True):
        model.mass(node, mx, my, mrz, mz=mz, mrx=mrx, mry=mry)
    materials = [model.material(_law(building, section.E, section.fy)) for section in building.sections]
    sections = [
        model.fibre_section(s.fibres.y, s.fibres.area, material, z=s.fibres.z, GJ=s.GJ)
        for s, material in zip(building.sections, materials, strict=True)
    ]
    pattern = model.pattern()
    for node, load in zip(nodes, building.nodal.tolist(), strict=False):
        fx, fy, fz, mx, my, mz = load
        model.nodal_load(pattern, node, fx, fy, mz, fz=fz, mx=mx, my=my)
    for number, member in enumerate(building.members):
        ends, s = (nodes[member.start], nodes[member.end]), member.section
        if member.bar:
            geometry = "corotational" if building.geometry == "corotational" else "linear"
            area = member.share * building.sections[s].area
            model.truss(member.name, *ends, materials[s], area, geometry)
            continue
        breaks, points = building.breaks.get(number, ()), building.points_of_pieces(number)
        element = model.beam_column(
            member.name, *ends, sections[s], points, building.geometry, member.pins, breaks, member.web
        )
        if building.uniform[number].any():
            model.uniform_load(pattern, element, *building.uniform[number].tolist())
    for load in building.points:
        model.point_load(pattern, load.member, load.position, *load.force)
    return CoreBuilding(model, pattern)


def _law(building: PeerBuilding, E: float, fy: float) -> Steel:
    if building.steel == "elastic":
        return Elastic(E)
    if building.steel == "bilinear":
        return Bilinear(E, fy, building.hardening)
    return MenegottoPinto(E, fy, building.hardening, *MENEGOTTO_PINTO)


def history(
    building: PeerBuilding, motion: tuple[Array, Array], dt: float, sampled: bool = True, **settings: float
) -> BuildingHistory:
    """Time history under two components after gravity; without sampling only what it cost is found.

    motion: along x and y, (n,) each, m/s2, every dt (s), the first values at the time 0.
    """
    core = build(building)
    analysis = Analysis(core.model, **settings)
    count = max(building.damped_modes)
    result = BuildingHistory(bare=analysis.modes(count).period)
    _completed(analysis.static(core.gravity, 1.0, 10))
    modes = analysis.modes(count)
    w1, w2 = (float(modes.omega[mode - 1]) for mode in building.damped_modes)
    result.loaded = modes.period
    result.rayleigh = 2.0 * building.damping * w1 * w2 / (w1 + w2), 2.0 * building.damping / (w1 + w2)
    analysis.rayleigh(*result.rayleigh, building.damping_stiffness)
    channels = _channels(building) if sampled else []
    run = analysis.history(motion[0], dt, channels=channels, every=1 if sampled else 0, along_y=motion[1])
    held = [event for event in run.events if str(event["fallback"]).startswith("damping")]
    result.frozen = tuple(int(str(event["step"])) for event in held)
    result.status, result.steps = run.status, int(run.statistics["steps"])
    result.cpu_s, result.cost = float(run.statistics["cpu_s"]), describe(run)
    if sampled:
        floors = range(building.n_floors)
        result.floors = np.stack([_rows(run, [f"u{k}_{c}" for c in (0, 1, 5)]) for k in floors], axis=1)
        result.accelerations = np.stack([_rows(run, [f"a{k}_{c}" for c in (0, 1)]) for k in floors], axis=1)
        result.base_shear = _rows(run, ["shear_0", "shear_1"])
        result.column = _rows(run, [f"column_{c}" for c in (AXIAL, ABOUT_Y, ABOUT_Z)])
    return result


def _channels(building: PeerBuilding) -> list[Channel]:
    found = []
    for k in range(building.n_floors):
        master = building.n_nodes + k
        found += [Channel(f"u{k}_{c}", ((1.0, "displacement", master, c),)) for c in (0, 1, 5)]
        found += [Channel(f"a{k}_{c}", ((1.0, "total_acceleration", master, c),)) for c in (0, 1)]
    for c in (0, 1):
        found.append(Channel(f"shear_{c}", tuple((1.0, "reaction", node, c) for node in building.supports)))
    for c in (AXIAL, ABOUT_Y, ABOUT_Z):
        found.append(Channel(f"column_{c}", ((1.0, "end_force", building.watched, c),)))
    return found


def _rows(run: Response, names: list[str]) -> Array:
    return np.stack([run.values[name] for name in names], axis=1)


def _completed(run: Response) -> None:
    if run.status != "completed":
        raise RuntimeError(run.reason)


def imposed_path(column: PeerBuilding, path: Array, **settings: float) -> Array:
    """Forces of a column's head along x and y that move it on a path after gravity, and its uz, (n, 3), N and m.

    path: (n, 2), m, from rest at 0.
    """
    core = build(column)
    head = column.n_nodes - 1
    core.model.fix(head, ux=True, uy=True)
    analysis = Analysis(core.model, **settings)
    _completed(analysis.static(core.gravity, 1.0, 10))
    still = np.zeros(len(path))
    supports = [SupportMotion(head, degree, (path[:, i], still, still)) for i, degree in enumerate(("ux", "uy"))]
    terms = [("reaction", 0), ("reaction", 1), ("displacement", 2)]
    channels = [Channel(f"{kind} {c}", ((1.0, kind, head, c),)) for kind, c in terms]
    run = analysis.history(still, 1.0, channels=channels, supports=supports)
    _completed(run)
    return _rows(run, [channel.name for channel in channels])
