"""Members and frames in space: closed forms of shear, springs, hinges and loads; equilibrium, invariance, errors."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from verification.space_frames import HINGES, RIGID, SECTION, E, Frame, G, building

from edesign.core import CoreError
from edesign.core.space import PROPERTIES, Points, SpaceModel

L, P, Q = 3.7, 12e3, 8e3
EI_y, EI_z = E * SECTION["I_y"], E * SECTION["I_z"]
A_Y, A_Z = 3e-3, 5e-3
ROUNDING = 1e-11  # closed forms and the core differ by rounding of a few solutions only


def cantilever(ends: tuple[float, ...] = RIGID, **section: float) -> Frame:
    """Along x, its web upright."""
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(L, 0, 0), ends=ends, **section)
    return f


def test_cantilever_with_shear() -> None:
    """Tip load: P L^3 / (3 EI) + P L / (G A_s), rotation P L^2 / (2 EI); axial P L / (EA), torsion T L / (G I_t)."""
    f = cantilever(A_y=A_Y, A_z=A_Z)
    loads = np.concatenate([f.force(1, ux=P), f.force(1, uy=P), f.force(1, uz=P), f.force(1, rx=P)])
    u = f.model().static(loads).displacements[:, 1]
    np.testing.assert_allclose(u[0, 0], P * L / (E * SECTION["A"]), rtol=ROUNDING)
    np.testing.assert_allclose(
        u[1, [1, 5]], [P * L**3 / (3 * EI_z) + P * L / (G * A_Y), P * L**2 / (2 * EI_z)], rtol=ROUNDING
    )
    np.testing.assert_allclose(
        u[2, [2, 4]], [P * L**3 / (3 * EI_y) + P * L / (G * A_Z), -P * L**2 / (2 * EI_y)], rtol=ROUNDING
    )
    np.testing.assert_allclose(u[3, 3], P * L / (G * SECTION["I_t"]), rtol=ROUNDING)


def test_springs_at_the_root() -> None:
    """A spring turns by P L / k and adds P L^2 / k at the tip, in its own plane alone."""
    k_y, k_z = 4e6, 7e6
    f = cantilever(ends=(k_y, k_z, inf, inf))
    u = f.model().static(np.concatenate([f.force(1, uy=P), f.force(1, uz=P)])).displacements[:, 1]
    np.testing.assert_allclose(u[0, 1], P * L**3 / (3 * EI_z) + P * L**2 / k_z, rtol=ROUNDING)
    np.testing.assert_allclose(u[1, 2], P * L**3 / (3 * EI_y) + P * L**2 / k_y, rtol=ROUNDING)


@pytest.mark.parametrize(
    ("ends", "start", "end"),
    [
        (RIGID, Q * L**2 / 12, Q * L**2 / 12),
        ((inf, inf, 0.0, 0.0), Q * L**2 / 8, 0.0),
        ((0.0, 0.0, inf, inf), 0.0, Q * L**2 / 8),
        (HINGES, 0.0, 0.0),
        # equal springs: q L^2 / 12 / (1 + 2 EI / (k L)), by the rotation of the end under its own moment
        ((5e7, 5e7, 5e7, 5e7), Q * L**2 / 12 / (1 + 2 * EI_y / (5e7 * L)), Q * L**2 / 12 / (1 + 2 * EI_y / (5e7 * L))),
    ],
)
def test_uniform_load_between_fixed_nodes(ends: tuple[float, ...], start: float, end: float) -> None:
    """End moments of q downwards: hogging at both ends, as tables of beams give them; the middle by equilibrium."""
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(L, 0, 0, fixed="ux uy uz rx ry"), ends=ends)
    f.post()
    model = f.model()
    load = f.uniform(0, (0.0, 0.0, -Q))
    result = model.static(uniform=load)
    np.testing.assert_allclose(result.end_forces[0, 0, [4, 10]], [-start, end], atol=1e-9 * Q * L**2)
    middle = model.internal(result.end_forces, [0.0, 0.5, 1.0], uniform=load)[0, 0]
    np.testing.assert_allclose(middle[:, 4], [start, (start + end) / 2 - Q * L**2 / 8, end], atol=1e-9 * Q * L**2)
    np.testing.assert_allclose(
        result.reactions[0, :2, 2], [Q * L / 2 + (start - end) / L, Q * L / 2 - (start - end) / L], rtol=ROUNDING
    )


def test_uniform_load_with_shear_on_a_propped_beam() -> None:
    """Fixed and propped: M = q L^2 / 8 / (1 + 3 EI / (G A L^2)), by the force method with both flexibilities."""
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(L, 0, 0, fixed="ux uy uz rx"), A_z=A_Z)
    moment = f.model().static(uniform=f.uniform(0, (0.0, 0.0, -Q))).end_forces[0, 0, 4]
    # the prop: deflection q L^4/8EI + q L^2/(2 G A), flexibility L^3/3EI + L/(G A)
    prop = (Q * L**4 / (8 * EI_y) + Q * L**2 / (2 * G * A_Z)) / (L**3 / (3 * EI_y) + L / (G * A_Z))
    np.testing.assert_allclose(moment, -(Q * L**2 / 2 - prop * L), rtol=ROUNDING)


@pytest.mark.parametrize("position", [0.0, 0.3, 0.5, 1.0])
@pytest.mark.parametrize("ends", [RIGID, (2e7, 3e7, 0.0, 5e7), HINGES])
def test_point_load_is_a_node_there(position: float, ends: tuple[float, ...]) -> None:
    """A force inside a member gives what a node with the force there gives, with shear and springs, in both planes."""
    force = (3e3, -5e3, -P)
    section = {"A_y": A_Y, "A_z": A_Z}
    one = Frame()
    one.member(one.node(0, 0, 0, fixed="all"), one.node(L, 1.0, 0.5, fixed="all"), ends=ends, **section)
    points = Points(np.array([0]), np.array([0]), np.array([position]), np.array([force]))
    one.post()
    model = one.model()
    whole = model.static(points=points)
    inner = model.internal(whole.end_forces, [position], points=points)[0, 0, 0]
    if position in (0.0, 1.0):
        expected = -np.array(force)
        np.testing.assert_allclose(whole.reactions[0, int(position), :3], expected, atol=1e-9 * P)
        return
    two = Frame()
    a, b = two.node(0, 0, 0, fixed="all"), two.node(L, 1.0, 0.5, fixed="all")
    middle = two.node(L * position, position, 0.5 * position)
    two.member(a, middle, ends=(ends[0], ends[1], inf, inf), web=one.rows[0]["web"], **section)
    two.member(middle, b, ends=(inf, inf, ends[2], ends[3]), web=one.rows[0]["web"], **section)
    parts = two.model().static(two.force(middle, ux=force[0], uy=force[1], uz=force[2]))
    scale = dict(rtol=1e-10, atol=1e-10 * P * L)
    np.testing.assert_allclose(whole.end_forces[0, 0, :6], parts.end_forces[0, 0, :6], **scale)
    np.testing.assert_allclose(whole.end_forces[0, 0, 6:], parts.end_forces[0, 1, 6:], **scale)
    np.testing.assert_allclose(inner, parts.end_forces[0, 0, 6:], **scale)


def test_bar_carries_its_weight_as_a_simple_beam() -> None:
    """A bar passes half of its load to each node, without moments there, and bends by q L^2 / 8 in between."""
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(L, 0, 0, fixed="all"), axial_only=True, I_y=0.0, I_t=0.0)
    f.member(0, f.node(0, 0, 1.0))
    model = f.model()
    load = f.uniform(0, (0.0, 0.0, -Q))
    result = model.static(uniform=load)
    np.testing.assert_allclose(result.end_forces[0, 0], [0, 0, Q * L / 2, 0, 0, 0, 0, 0, Q * L / 2, 0, 0, 0], atol=1e-9)
    np.testing.assert_allclose(
        model.internal(result.end_forces, [0.5], uniform=load)[0, 0, 0, 4], -Q * L**2 / 8, rtol=ROUNDING
    )


def test_portal_sways() -> None:
    """Fixed portal, stiff in length: 24 EI / h^3 (1 + 6 k) / (4 + 6 k), k = I_b h / (I_c L), by joint rotations."""
    h, span, ratio = 4.0, 6.0, 1.7
    f = Frame()
    bases = [f.node(x, 0, 0, fixed="all") for x in (0.0, span)]
    tops = [f.node(x, 0, h, fixed="uy rx rz") for x in (0.0, span)]
    for a, b in zip(bases, tops, strict=True):
        f.member(a, b, A=1e3)
    f.member(*tops, A=1e3, I_y=ratio * SECTION["I_y"])
    k = ratio * h / span
    u = f.model().static(f.force(tops[0], ux=P)).displacements[0, tops, 0]
    expected = P / (24 * EI_y / h**3 * (1 + 6 * k) / (4 + 6 * k))
    np.testing.assert_allclose(u, expected, rtol=1e-6)  # EA / L over EI / h^3 is 1e8: what lengths give


def test_diaphragm_turns_as_a_rigid_body() -> None:
    """Four columns 12 EI / h^3 each way below a floor that cannot tilt: u = F / sum k, rz = F e / sum k r^2."""
    h, b, d = 3.0, 5.0, 4.0
    f = Frame(masters=[(b / 2, d / 2)])
    for x in (0.0, b):
        for y in (0.0, d):
            base = f.node(x, y, 0, fixed="all")
            f.member(base, f.node(x, y, h, fixed="uz rx ry", floor=0), I_t=1e-12)
    k_x, k_y = 12 * EI_y / h**3, 12 * EI_z / h**3
    u = f.model().static(f.force(1, ux=P)).displacements[0]
    turn = P * d / 2 / (4 * k_x * (d / 2) ** 2 + 4 * k_y * (b / 2) ** 2)
    np.testing.assert_allclose(u[1, [0, 1, 5]], [P / (4 * k_x) + turn * d / 2, -turn * b / 2, turn], rtol=1e-8)  # I_t
    np.testing.assert_allclose(u[7, [0, 1, 5]], [P / (4 * k_x) - turn * d / 2, turn * b / 2, turn], rtol=1e-8)


def random_case(f: Frame, seed: int = 1) -> dict[str, object]:
    """Loads of every kind in two cases."""
    rng = np.random.default_rng(seed)
    n, m = len(f.nodes), len(f.rows)
    points = Points(rng.integers(0, 2, 5), rng.integers(0, m, 5), rng.uniform(0, 1, 5), rng.normal(0, 1e4, (5, 3)))
    return {"nodal": rng.normal(0, 1e4, (2, n, 6)), "uniform": rng.normal(0, 1e3, (2, m, 3)), "points": points}


def assert_equilibrium(f: Frame, loads: dict[str, object], reactions: np.ndarray, share: float) -> None:
    """Loads and reactions add up to nothing, moments about the origin too."""
    x = np.array(f.nodes)
    start, end = (x[[row[name] for row in f.rows]] for name in ("start", "end"))
    length = np.linalg.norm(end - start, axis=1)
    total = np.zeros((2, 6))
    scale = 0.0

    def add(case: int, place: np.ndarray, force: np.ndarray) -> None:
        nonlocal scale
        total[case, :3] += force.sum(axis=0)
        total[case, 3:] += np.cross(place, force).sum(axis=0)
        scale += np.abs(force).sum() * 10.0

    points = loads["points"]
    assert isinstance(points, Points)
    for case in range(2):
        nodal = np.asarray(loads["nodal"])[case] + reactions[case]
        add(case, x, nodal[:, :3])
        total[case, 3:] += nodal[:, 3:].sum(axis=0)
        add(case, (start + end) / 2, np.asarray(loads["uniform"])[case] * length[:, None])
        own = points.case == case
        at = points.member[own]
        add(case, start[at] + (end - start)[at] * points.position[own, None], points.force[own])
    assert np.max(np.abs(total)) < share * scale


@pytest.mark.parametrize("diaphragms", [True, False])
def test_equilibrium(diaphragms: bool) -> None:
    """A building with everything in it, also on springs: sums of forces and moments vanish to 1e-9 of what acts."""
    f = building(3, diaphragms=diaphragms)
    f.fixed[0] = (0,) * 6
    f.springs[0] = (3e8, 2e8, 5e8, 1e7, 1e7, 1e7)
    f.springs[-1] = (1e6, 2e6, 1e5, 1e5, 1e5, 4e6)  # of a node of a diaphragm, too
    loads = random_case(f)
    result = f.model().static(**loads)
    assert_equilibrium(f, loads, result.reactions, 1e-9)
    free = ~np.array(f.fixed, dtype=bool) & (np.array(f.springs) == 0.0)
    assert not result.reactions[:, free].any()
    np.testing.assert_allclose(result.reactions[:, 0], -np.array(f.springs[0]) * result.displacements[:, 0], rtol=1e-12)


def test_equilibrium_of_restrained_diaphragms() -> None:
    """A floor that is restrained in rz, ux and uy at three nodes: their reactions balance the loads."""
    f = building(5)
    f.fixed[6], f.fixed[7], f.fixed[8] = (0, 0, 0, 0, 0, 1), (1, 0, 0, 0, 0, 0), (0, 1, 0, 0, 0, 0)
    loads = random_case(f)
    result = f.model().static(**loads)
    assert_equilibrium(f, loads, result.reactions, 1e-9)
    assert not result.displacements[:, 6, [0, 1, 5]].any()


def test_turned_and_mirrored() -> None:
    """A frame turned by 35 degrees about z and mirrored at x = 0 gives the same end forces to 1e-10 of the largest."""
    f = building(4)
    loads = random_case(f)
    plain = f.model().static(**loads)
    c, s = np.cos(0.61), np.sin(0.61)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    mirror = np.diag([-1.0, 1.0, 1.0])
    # of a mirrored frame: polar vectors change sign against the others, and so does local y
    for matrix, sign in ((turn, 1.0), (mirror, -1.0)):
        g = Frame(
            [tuple(matrix @ v) for v in np.array(f.nodes)],
            f.floors,
            [tuple(matrix[:2, :2] @ v) for v in np.array(f.masters)],
            f.fixed,
            f.springs,
            [row | {"web": tuple(matrix @ np.array(row["web"]))} for row in f.rows],
        )
        nodal, points = np.asarray(loads["nodal"]), loads["points"]
        assert isinstance(points, Points)
        moved = np.concatenate([nodal[:, :, :3] @ matrix.T, sign * nodal[:, :, 3:] @ matrix.T], axis=2)
        at = Points(points.case, points.member, points.position, points.force @ matrix.T)
        result = g.model().static(moved, np.asarray(loads["uniform"]) @ matrix.T, at)
        expected = plain.end_forces * np.tile([1, sign, 1, sign, 1, sign], 2)
        # T, M_y, M_z are polar: local x, z keep, y turns round; M_y = sign^2, T and M_z = sign
        scale = np.max(np.abs(expected))
        np.testing.assert_allclose(result.end_forces, expected, atol=1e-10 * scale)


def test_internal_forces_are_those_of_two_members() -> None:
    """Forces at a station are the end forces of a member that is cut there."""
    f = building(6, storeys=1)
    loads = random_case(f)
    model = f.model()
    result = model.static(**loads)
    inner = model.internal(result.end_forces, [0.0, 0.35, 1.0], loads["uniform"], loads["points"])
    scale = np.max(np.abs(result.end_forces))
    np.testing.assert_allclose(inner[:, :, 0], -result.end_forces[:, :, :6], atol=1e-12 * scale)
    np.testing.assert_allclose(inner[:, :, 2], result.end_forces[:, :, 6:], atol=1e-12 * scale)
    load = f.uniform(2, (2e3, -3e3, 5e3))
    whole = model.static(uniform=load)
    at = model.internal(whole.end_forces, [0.35], uniform=load)[0, 2, 0]
    row = f.rows[2]
    a, b = (np.array(f.nodes[int(row[name])]) for name in ("start", "end"))
    cut = f.node(*(a + 0.35 * (b - a)))
    f.rows[2] = row | {"end": cut, "ends": (*row["ends"][:2], inf, inf)}
    f.rows.append(row | {"start": cut, "ends": (inf, inf, *row["ends"][2:])})
    loads_of_parts = f.uniform(2, (2e3, -3e3, 5e3)) + f.uniform(len(f.rows) - 1, (2e3, -3e3, 5e3))
    parts = f.model().static(uniform=loads_of_parts).end_forces[0, 2, 6:]
    np.testing.assert_allclose(at, parts, atol=1e-9 * np.max(np.abs(parts)))


def test_new_sections_are_those_of_a_new_model() -> None:
    """New sections give what a new model of them gives, to rounding; a wrong value changes nothing."""
    f = building(7)
    model = f.model()
    loads = random_case(f)
    before = model.static(**loads).end_forces
    numbers = [0, 3, 8]
    values = np.array([[f.rows[i][name] for name in PROPERTIES] for i in numbers], dtype=float) * 1.4
    model.change_sections(numbers, values)
    changed = model.static(**loads).end_forces
    for i, row in zip(numbers, values, strict=True):
        f.rows[i] |= dict(zip(PROPERTIES, row, strict=True))
    np.testing.assert_allclose(
        changed, f.model().static(**loads).end_forces, rtol=1e-11, atol=1e-9 * np.max(np.abs(before))
    )
    model.change_sections(numbers, values / 1.4)
    np.testing.assert_allclose(model.static(**loads).end_forces, before, rtol=1e-9, atol=1e-11 * np.max(np.abs(before)))
    with pytest.raises(CoreError, match="member M3: I_y is -1; it must be a finite number above 0"):
        model.change_sections([3], [[E, G, 1.0, 0.0, 0.0, 1.0, -1.0, 1.0]])
    np.testing.assert_allclose(model.static(**loads).end_forces, before, rtol=1e-9, atol=1e-11 * np.max(np.abs(before)))


def test_hinges_at_both_ends_are_no_mechanism() -> None:
    """A beam on hinges about y and z at both ends between two columns stands, and so does a node of bars alone."""
    f = Frame()
    tops = []
    for x in (0.0, 5.0):
        top = f.node(x, 0, 4.0)
        f.member(f.node(x, 0, 0, fixed="all"), top)
        tops.append(top)
    f.member(*tops, ends=HINGES)
    apex = f.node(2.5, 0.0, 6.0, fixed="uy")
    for top in tops:
        f.member(top, apex, axial_only=True)
    u = f.model().static(f.force(apex, uz=-P)).displacements[0]
    np.testing.assert_allclose(u[tops[0], [0, 2]], [-u[tops[1], 0], u[tops[1], 2]], rtol=1e-9)
    assert not u[apex, 3:].any()


def cut_loose(f: Frame) -> SpaceModel:
    f.node(9, 9, 9)
    return f.model()


def hinged_storey() -> SpaceModel:
    f = Frame(masters=[(0.0, 0.0)])
    for x, y in ((0, 0), (4, 0), (4, 3)):
        f.member(f.node(x, y, 0, fixed="all"), f.node(x, y, 3, floor=0), ends=HINGES)
    return f.model()


def hinged_base() -> SpaceModel:
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="ux uy uz rx rz"), f.node(0, 0, 3))
    return f.model()


@pytest.mark.parametrize(
    ("make", "status", "message"),
    [
        (lambda: cut_loose(cantilever()), "ED_E_DISCONNECTED", "1 node is not connected to any support: N2"),
        (hinged_storey, "ED_E_MECHANISM", "moves freely at .* of the diaphragm of N1"),
        (hinged_base, "ED_E_MECHANISM", "moves freely at N0.ry, N1.ux, N1.ry"),
        (lambda: cantilever(A=0.0).model(), "ED_E_ARGUMENT", "member M0: A is 0; it must be a finite number above 0"),
        (
            lambda: cantilever(A_y=-1.0).model(),
            "ED_E_ARGUMENT",
            "member M0: A_y is -1; it must be a finite number of at least 0",
        ),
        (lambda: cantilever(E=np.nan).model(), "ED_E_ARGUMENT", "member M0: E is nan"),
        (lambda: cantilever(ends=(-1.0, 0, 0, 0)).model(), "ED_E_ARGUMENT", "a rotational spring has stiffness -1"),
        (lambda: cantilever(E=1e200, I_y=1e200).model(), "ED_E_NOT_FINITE", "member M0: its stiffness"),
    ],
)
def test_frames_that_cannot_be(make, status: str, message: str) -> None:
    """What cannot stand, or is out of range, is refused by name."""
    with pytest.raises(CoreError, match=message) as error:
        make()
    assert error.value.status == status


def test_directions_and_supports_that_cannot_be() -> None:
    """A web along its member, a node at the place of another, and a support that a rigid floor cannot follow."""
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(0, 0, 3), web=(0.0, 0.0, 1.0))
    with pytest.raises(CoreError, match="of its web is not of length 1 and at right angles"):
        f.model()
    f.rows[0]["web"], f.nodes[1] = (1.0, 0.0, 0.0), (0, 0, 0)
    with pytest.raises(CoreError, match="member M0 has the length 0"):
        f.model()
    f = building(1)
    f.fixed[7] = (1, 0, 0, 0, 0, 0)
    with pytest.raises(CoreError, match="node N7 of a diaphragm is restrained in ux away from its master"):
        f.model()


def test_loads_that_cannot_be() -> None:
    """Loads on what is not there, at what nothing resists, or that are not numbers."""
    f = cantilever()
    apex = f.node(L, 1.0, 0)
    f.member(1, apex, axial_only=True)
    f.member(0, apex, axial_only=True)
    f.fixed[apex] = (0, 0, 1, 0, 0, 0)
    model = f.model()
    with pytest.raises(CoreError, match=r"case 0: nothing resists the load at N2\.rx"):
        model.static(f.force(apex, rx=1.0))
    with pytest.raises(CoreError, match=r"the load at N1\.uy is not a finite number"):
        model.static(f.force(1, uy=np.inf))
    with pytest.raises(CoreError, match="point load 0 on member M1: its position is 1.5 of the length"):
        model.static(points=Points(np.array([0]), np.array([1]), np.array([1.5]), np.zeros((1, 3))))
    with pytest.raises(CoreError, match="there is no member 7; there are 3"):
        model.static(points=Points(np.array([0]), np.array([7]), np.array([0.5]), np.zeros((1, 3))))
    with pytest.raises(ValueError, match=r"nodal has the shape \(1, 2, 6\), not \(1, 3, 6\)"):
        model.static(np.zeros((1, 2, 6)))
    strong = cantilever()
    with pytest.raises(CoreError, match="case 0, member M0: a force at its end is not a finite number"):
        strong.model().static(strong.force(1, uy=6e307))  # its moment at the root is too large a number
