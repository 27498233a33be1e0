"""Frames in space by the core of histories: plane frames standing in space, elastic buildings, biaxial bending.

References: the core of plane frames, verified by all the other tests here; the elastic space frames of
`edesign.core.space`, which share no source with it; sums over fibres by numpy.
"""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np
import pytest
from verification.space_frames import HINGES, RIGID, Frame, building
from verification.structures import E, i_layers

from edesign.core import Analysis, Bilinear, Channel, Elastic, MenegottoPinto, Model, Response, Steel

SHARP = {"tolerance": 1e-12, "element_tolerance": 1e-24}
"""Both answers are iterated to rounding, so that what is left between them is the difference of the models."""
LAWS: dict[str, Steel] = {"bilinear": Bilinear(E, 235e6, 0.01), "curved": MenegottoPinto(E, 235e6, 0.01)}
STEP = 0.01
PLACES = {"a": (0.0, 0.0), "b": (6.0, 0.0), "c": (0.0, 3.5), "d": (6.0, 3.5), "e": (0.0, 7.0), "f": (6.0, 7.0)}
COLUMNS, BEAMS = ("ac", "bd", "ce", "df"), ("cd", "ef")
MASS, LOAD, POINT = 12e3, -20e3, -30e3


def ground(seed: int = 0) -> np.ndarray:
    """A short strong motion, (nt,) m/s2."""
    rng = np.random.default_rng(seed)
    t = np.arange(250) * STEP
    phases = rng.uniform(0, 2 * np.pi, 3)
    wave = 8 * np.sin(2 * np.pi * 1.2 * t + phases[0]) + 2 * np.sin(2 * np.pi * 3.1 * t + phases[1])
    wave += np.sin(2 * np.pi * 7.0 * t + phases[2])
    return np.asarray(wave * np.exp(-(((t - 1.2) / 0.7) ** 2)))


def box() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fibres of a square tube 250x10: y, z, area."""
    s = (np.arange(8) + 0.5) / 8 * 0.24 - 0.12
    flat = np.full(8, 0.12)
    area = np.full(32, 0.24 * 0.01 / 8)
    return np.concatenate([s, s, flat, -flat]), np.concatenate([flat, -flat, s, s]), area


def in_plane(law: str, geometry: str, pinned: bool) -> tuple[Model, dict[str, int], dict[str, int], int]:
    """A portal of two storeys with loads inside its beams, by the plane core."""
    m = Model()
    depth, area = box()[1:]
    section = m.fibre_section(depth, area, m.material(LAWS[law]))
    nodes = {name: m.node(name, *place) for name, place in PLACES.items()}
    free = (False, pinned)
    members = {n: m.beam_column(n, nodes[n[0]], nodes[n[1]], section, 5, geometry) for n in COLUMNS}
    members |= {
        n: m.beam_column(n, nodes[n[0]], nodes[n[1]], section, 5, geometry, free if n == "ef" else (False, False))
        for n in BEAMS
    }
    pattern = m.pattern()
    for n in BEAMS:
        m.uniform_load(pattern, members[n], 0.0, LOAD)
        m.point_load(pattern, members[n], 0.3, 5e3, POINT)
    for name, node in nodes.items():
        if name in "ab":
            m.fix(node, ux=True, uy=True, rz=True)
        else:
            m.mass(node, MASS, MASS)
    m.nodal_load(pattern, nodes["e"], 3e3, -200e3, 10e3)
    return m, nodes, members, pattern


def in_space(law: str, geometry: str, pinned: bool, angle: float) -> tuple[Model, dict[str, int], dict[str, int], int]:
    """The same frame standing in space at an angle in plan."""
    c, s = cos(angle), sin(angle)
    m = Model(3)
    y, z, area = box()
    section = m.fibre_section(y, area, m.material(LAWS[law]), z=z, GJ=5e6)
    nodes = {name: m.node(name, c * x, s * x, height) for name, (x, height) in PLACES.items()}
    free = (False, False, pinned, False)
    members = {n: m.beam_column(n, nodes[n[0]], nodes[n[1]], section, 5, geometry, web=(c, s, 0.0)) for n in COLUMNS}
    members |= {
        n: m.beam_column(
            n, nodes[n[0]], nodes[n[1]], section, 5, geometry, free if n == "ef" else (False,) * 4, web=(0.0, 0.0, 1.0)
        )
        for n in BEAMS
    }
    pattern = m.pattern()
    for n in BEAMS:
        m.uniform_load(pattern, members[n], 0.0, 0.0, LOAD)
        m.point_load(pattern, members[n], 0.3, 5e3, 0.0, POINT)
    for name, node in nodes.items():
        if name in "ab":
            m.fix(node, ux=True, uy=True, uz=True, rx=True, ry=True, rz=True)
        else:
            m.mass(node, MASS, MASS, mz=MASS)
    # anticlockwise in the plane frame is about its normal, (s, -c, 0)
    m.nodal_load(pattern, nodes["e"], 3e3 * c, 3e3 * s, fz=-200e3, mx=10e3 * s, my=-10e3 * c)
    return m, nodes, members, pattern


def shake(
    m: Model, pattern: int, channels: list[Channel], motions: tuple[np.ndarray, ...], straight: bool
) -> tuple[np.ndarray, Response]:
    """Periods under gravity, and the history behind it."""
    # a curved law is a straight line within its reach, 1e-12 of yield; from there the two would part in the history
    a = Analysis(m, **SHARP, fast_elastic=float(straight))
    gravity = a.static(pattern, 1.0, 4)
    assert gravity.status == "completed", gravity.reason
    periods = a.modes(int((a.masses() > 0.0).sum())).period
    a.rayleigh(0.3, 0.002, "current")
    along, up, *across = motions
    response = a.history(along, STEP, channels=channels, vertical=up, along_y=across[0] if across else None)
    assert response.status == "completed", response.reason
    return periods, response


@pytest.mark.parametrize("degrees", [0, 90, 30])
@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
@pytest.mark.parametrize("law", LAWS)
def test_a_plane_frame_stands_in_space(law: str, geometry: str, degrees: int) -> None:
    """A yielding portal with a hinge and loads inside its beams answers as in its plane, whatever its angle in plan.

    1e-9 of each quantity's largest value: rounding that grows in the history.
    """
    angle = radians(degrees)
    c, s = cos(angle), sin(angle)
    m, nodes, members, pattern = in_plane(law, geometry, True)
    along, up = ground(), 0.3 * ground(1)
    quantities = {
        "u": ("displacement", "e", (0,)),
        "v": ("displacement", "f", (1,)),
        "turn": ("displacement", "c", (2,)),
    }
    channels = [Channel(k, ((1.0, kind, nodes[at], d[0]),)) for k, (kind, at, d) in quantities.items()]
    channels += [Channel(f"q{i}", ((1.0, "end_force", members["ac"], i),)) for i in range(6)]
    channels += [Channel(f"b{i}", ((1.0, "end_force", members["ef"], i),)) for i in range(5)]
    channels += [Channel("hinge", ((1.0, "plastic_rotation", members["ac"], 0),))]
    channels += [Channel("stress", ((1.0, "section_force", members["cd"], 2 * 2 + 1),))]
    plane_periods, plane = shake(m, pattern, channels, (along, up), law == "bilinear")
    assert plane.maximum["hinge"] > 0.005 or plane.minimum["hinge"] < -0.005  # it yields

    m, nodes, members, pattern = in_space(law, geometry, True, angle)
    # local y of columns is the normal (s, -c, 0), that of beams its opposite; local z of columns is along the frame
    column = {0: (1, 0), 1: (-1, 2), 2: (1, 4), 3: (1, 6), 4: (-1, 8), 5: (1, 10)}
    beam = {0: (1, 0), 1: (1, 2), 2: (-1, 4), 3: (1, 6), 4: (1, 8), 5: (-1, 10)}
    turned = {
        "u": ((c, "displacement", nodes["e"], 0), (s, "displacement", nodes["e"], 1)),
        "v": ((1.0, "displacement", nodes["f"], 2),),
        "turn": ((s, "displacement", nodes["c"], 3), (-c, "displacement", nodes["c"], 4)),
        "hinge": ((1.0, "plastic_rotation", members["ac"], 2),),
        "stress": ((-1.0, "section_force", members["cd"], 3 * 2 + 2),),
        "out": ((-s, "displacement", nodes["e"], 0), (c, "displacement", nodes["e"], 1)),
    }
    turned |= {f"q{i}": ((float(sign), "end_force", members["ac"], k),) for i, (sign, k) in column.items()}
    turned |= {f"b{i}": ((float(sign), "end_force", members["ef"], k),) for i, (sign, k) in beam.items()}
    channels = [Channel(name, terms) for name, terms in turned.items()]
    periods, space = shake(m, pattern, channels, (c * along, up, s * along), law == "bilinear")
    for name, values in plane.values.items():
        assert np.abs(space.values[name] - values).max() <= 1e-9 * np.abs(values).max(), name
    assert np.abs(space.values["out"]).max() <= 1e-9 * np.abs(plane.values["u"]).max()
    for period in plane_periods:
        assert np.abs(periods / period - 1.0).min() < 1e-9
    assert abs(space.statistics["energy_error"] - plane.statistics["energy_error"]) < 1e-9


def elastic_frame(seed: int, diaphragms: bool) -> tuple[Frame, np.ndarray]:
    """An irregular small building without shear deformation and semi-rigid ends, and its masses, centred on masters."""
    frame = building(seed, bays=(2, 2), storeys=2, diaphragms=diaphragms)
    mass = np.random.default_rng(seed).uniform(1e4, 3e4, len(frame.nodes))
    mass[[fixed[0] == 1 for fixed in frame.fixed]] = 0.0
    for row in frame.rows:
        row["A_y"] = row["A_z"] = 0.0
        row["ends"] = HINGES if 0.0 in row["ends"] else RIGID
    floors, places = np.array(frame.floors), np.array(frame.nodes)[:, :2]
    for k in range(len(frame.masters)):
        of = floors == k
        frame.masters[k] = tuple(np.average(places[of], axis=0, weights=mass[of]))
    return frame, mass


def in_core(frame: Frame, mass: np.ndarray, fibres: bool) -> tuple[Model, list[int], list[int], list[int]]:
    """The frame by the core of histories, by elastic sections or by four fibres of the same A, I_y, I_z."""
    m = Model(3)
    steel = m.material(Elastic(1.0))
    nodes = [m.node(f"N{i}", x, y, z) for i, (x, y, z) in enumerate(frame.nodes)]
    heights = [frame.nodes[frame.floors.index(k)][2] for k in range(len(frame.masters))]
    masters = [m.node(f"floor.{k}", x, y, heights[k]) for k, (x, y) in enumerate(frame.masters)]
    for k, master in enumerate(masters):
        m.fix(master, uz=True, rx=True, ry=True)
        m.diaphragm(master, [node for node, floor in zip(nodes, frame.floors, strict=True) if floor == k])
    for node, fixed, own in zip(nodes, frame.fixed, mass, strict=True):
        ux, uy, uz, rx, ry, rz = map(bool, fixed)
        m.fix(node, ux=ux, uy=uy, uz=uz, rx=rx, ry=ry, rz=rz)
        m.mass(node, own, own)
    members = []
    for i, row in enumerate(frame.rows):
        EA, EI_y, EI_z, GJ = row["E"] * row["A"], row["E"] * row["I_y"], row["E"] * row["I_z"], row["G"] * row["I_t"]
        if row["axial_only"]:
            members.append(m.truss(f"M{i}", nodes[row["start"]], nodes[row["end"]], steel, EA))
            continue
        if fibres:  # at the corners of a rectangle of the radii of gyration
            y, z = np.sqrt(EI_z / EA) * np.array([1, 1, -1, -1]), np.sqrt(EI_y / EA) * np.array([1, -1, 1, -1])
            section = m.fibre_section(y, np.full(4, EA / 4), steel, z=z, GJ=GJ)
        else:
            section = m.elastic_section(EA, EI_z, EI_y, GJ)
        free = [end == 0.0 for end in row["ends"]]
        ends = nodes[row["start"]], nodes[row["end"]]
        members.append(m.beam_column(f"M{i}", *ends, section, 5, "linear", free, web=row["web"]))
    return m, nodes, masters, members


@pytest.mark.parametrize("fibres", [False, True])
@pytest.mark.parametrize("diaphragms", [True, False])
def test_elastic_buildings(diaphragms: bool, fibres: bool) -> None:
    """Periods, displacements, end forces and reactions of an irregular building are those of the elastic space frame.

    1e-9: two factorisations of one matrix.
    """
    frame, mass = elastic_frame(3, diaphragms)
    elastic = frame.model()
    m, nodes, _, members = in_core(frame, mass, fibres)
    rng = np.random.default_rng(4)
    nodal, uniform = rng.normal(0, 1e4, (1, len(nodes), 6)), rng.normal(0, 3e3, (1, len(members), 3))
    bars = [row["axial_only"] for row in frame.rows]
    uniform[0, bars] = 0.0
    pattern = m.pattern()
    for node, (fx, fy, fz, mx, my, mz) in zip(nodes, nodal[0], strict=True):
        m.nodal_load(pattern, node, fx, fy, mz, fz=fz, mx=mx, my=my)
    for member, row, load in zip(members, frame.rows, uniform[0], strict=True):
        x = np.subtract(frame.nodes[row["end"]], frame.nodes[row["start"]])
        x, z = x / np.linalg.norm(x), np.array(row["web"])
        if load.any():
            m.uniform_load(pattern, member, x @ load, np.cross(z, x) @ load, z @ load)
    expected = elastic.static(nodal, uniform)
    a = Analysis(m, **SHARP)
    channels = [Channel(f"u{n}.{d}", ((1.0, "displacement", n, d),)) for n in nodes for d in range(6)]
    channels += [
        Channel(f"f{e}.{k}", ((1.0, "end_force", e, k),))
        for e, bar in zip(members, bars, strict=True)
        for k in ((0, 6) if bar else range(12))
    ]
    periods = a.modes(6).period
    response = a.static(pattern, 1.0, 1, channels)
    assert response.status == "completed", response.reason
    np.testing.assert_allclose(periods, elastic.modes(mass, 6).period, rtol=1e-9)
    forces = expected.end_forces[0]
    for kinds in ((0, 1, 2), (3, 4, 5)):  # displacements, then rotations; forces, then moments
        scale = np.abs(expected.displacements[0][:, kinds]).max()
        for n in nodes:
            for d in kinds:
                assert abs(response.final[f"u{n}.{d}"] - expected.displacements[0, n, d]) < 1e-9 * scale
        ends = [*kinds, *(6 + k for k in kinds)]
        scale = np.abs(forces[:, ends]).max()
        for e in members:
            for k in ends:
                if f"f{e}.{k}" in response.final:
                    assert abs(response.final[f"f{e}.{k}"] - forces[e, k]) < 1e-9 * scale


def test_shapes_of_modes_at_all_nodes() -> None:
    """Shapes of modes at nodes of diaphragms are those of the elastic space frame, each up to its sign."""
    frame, mass = elastic_frame(5, True)
    m, nodes, _, _ = in_core(frame, mass, False)
    expected = frame.model().modes(mass, 4)
    modes = Analysis(m).modes(4)
    for own, other in zip(modes.shapes[:, nodes, :3], expected.displacements[:, :, :3], strict=True):
        sign = np.sign((own * other).sum())
        np.testing.assert_allclose(own, sign * other, rtol=0, atol=1e-8 * np.abs(other).max())
    ratios = expected.effective_mass_ratio[:, :2]
    np.testing.assert_allclose(modes.effective_mass_ratio[:, :2], ratios, rtol=0, atol=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_biaxial_bending_with_axial_force(law: str) -> None:
    """A yielding section under N, M_y and M_z carries the sum over its fibres at the strains that the core gives.

    The path goes out and back about a skew axis, so that fibres have unloaded; the stress of a bilinear fibre is
    written out here, that of a curved one is what the core records. 1e-10: sums in another order.
    """
    y, z, area = box()
    m = Model(3)
    section = m.fibre_section(y, area, m.material(LAWS[law]), z=z, GJ=5e6)
    foot, top = m.node("foot", 0, 0, 0), m.node("top", 0, 0, 2.0)
    m.fix(foot, ux=True, uy=True, uz=True, rx=True, ry=True, rz=True)
    column = m.beam_column("column", foot, top, section, 3, "linear", web=(1.0, 0.0, 0.0))
    axial, pushed = m.pattern(), m.pattern()
    m.nodal_load(axial, top, fz=-0.3 * 235e6 * area.sum())
    m.nodal_load(pushed, top, 1.0, 0.6)
    a = Analysis(m, **SHARP)
    a.static(axial, 1.0, 2)
    n = len(np.unique(np.stack([y, z]), axis=1).T)
    channels = [Channel(f"s{k}", ((1.0, "section_force", column, k),)) for k in range(3)]
    channels += [Channel(f"e{k}", ((1.0, "section_deformation", column, k),)) for k in range(3)]
    channels += [Channel(f"stress{i}", ((1.0, "fibre_stress", column, i),)) for i in range(n)]
    channels += [Channel(f"strain{i}", ((1.0, "fibre_strain", column, i),)) for i in range(n)]
    runs = [a.pushover(pushed, top, "ux", target, 60, channels) for target in (0.03, -0.02, 0.01)]
    assert all(run.status == "completed" for run in runs)
    values = {name: np.concatenate([run.values[name] for run in runs]) for name in runs[0].values}
    order = np.lexsort((z, y))
    y, z, area = y[order], z[order], area[order]
    strain = values["e0"] - np.outer(y, values["e1"]) + np.outer(z, values["e2"])
    np.testing.assert_allclose(strain, [values[f"strain{i}"] for i in range(n)], rtol=0, atol=1e-16)
    stress = np.array([values[f"stress{i}"] for i in range(n)])
    if law == "bilinear":
        np.testing.assert_allclose(bilinear(strain), stress, rtol=0, atol=1e-10 * 235e6)
        assert np.abs(strain).max() > 5 * 235e6 / E
    scale = 235e6 * area.sum()
    np.testing.assert_allclose(area @ stress, values["s0"], rtol=0, atol=1e-10 * scale)
    np.testing.assert_allclose(-(area * y) @ stress, values["s1"], rtol=0, atol=1e-10 * scale)
    np.testing.assert_allclose((area * z) @ stress, values["s2"], rtol=0, atol=1e-10 * scale)


def bilinear(strain: np.ndarray) -> np.ndarray:
    """Stresses of kinematic hardening along a path of strains, (fibres, steps); the gravity load stayed elastic."""
    fy, b = 235e6, 0.01
    centre = np.zeros(len(strain))
    found = []
    for now in strain.T:
        back = b * E * now
        trial = E * now - centre
        yielded = np.abs(trial - back) > (1 - b) * fy
        stress = np.where(yielded, back + np.sign(trial - back) * (1 - b) * fy, trial)
        centre = np.where(yielded, E * now - stress, centre)
        found.append(stress)
    return np.array(found).T


def test_strength_about_both_axes_of_an_i_section() -> None:
    """An I of three plates carries W_pl f_y about either axis, its web adding nothing about the weak one."""
    h, b, tf, tw = shape = (0.45, 0.19, 0.0146, 0.0094)
    depth, layer = i_layers(8, 32, shape)
    y, z, area = [], [], []
    for at, whole in zip(depth, layer, strict=True):
        flange = abs(at) > h / 2 - tf
        parts = 16 if flange else 1
        y += list(((np.arange(parts) + 0.5) / parts - 0.5) * b) if flange else [0.0]
        z += [at] * parts
        area += [whole / parts] * parts
    strong, weak = b * tf * (h - tf) + tw * (h - 2 * tf) ** 2 / 4, b**2 * tf / 2
    for load, expected in (((0.0, 1.0), strong), ((1.0, 0.0), weak)):
        m = Model(3)
        section = m.fibre_section(y, area, m.material(Bilinear(E, 275e6, 0.0)), z=z, GJ=1e5)
        foot, top = m.node("foot", 0, 0, 0), m.node("top", 0, 0, 2.0)
        m.fix(foot, ux=True, uy=True, uz=True, rx=True, ry=True, rz=True)
        m.beam_column("column", foot, top, section, 5, "linear", web=(0.0, 1.0, 0.0))
        pattern = m.pattern()
        m.nodal_load(pattern, top, *load)
        degree = "ux" if load[0] else "uy"
        factor = [Channel("factor", ((1.0, "load_factor", pattern, 0),))]
        response = Analysis(m).pushover(pattern, top, degree, 0.2, 40, factor)
        # all fibres yield but those next to the axis: midpoint rule of 16 strips of a flange, 32 of the web
        assert response.final["factor"] * 2.0 == pytest.approx(expected * 275e6, rel=4e-3)
