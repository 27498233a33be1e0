"""alpha_cr of buildings whose columns lean on others, some of them near buckling between the floors.

Stability functions, and beams and columns in many elements, are written here; both know nothing of the core's bows.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import NO_TORSION, bending_only, building, changed, design_of, portals
from scipy.linalg import eigh
from scipy.optimize import brentq

from edesign.core.space import SpaceModel
from edesign.frame.sections.steel_section import steel_section
from edesign.space.analysis.sway import critical_factors
from edesign.space.structure.frame import SpaceFrame

E = 210e9

ROW = changed(
    portals(x="6 m, 6 m", y="7 m", storeys="5 m", beam="IPE330") + NO_TORSION,
    ("strong: x}]", "strong: x}, {at: B, section: HEA120, material: steel, strong: y}]"),
    ("along: y, section: IPE330, material: steel, ends: pinned", "along: y, section: IPE330, material: steel"),
    (
        "braces:\n  - {along: y, frames: all, bays: 1, kind: cross, compression: true, section: SHS100x5, "
        "material: steel}\n",
        "",
    ),
    ("y: {type: concentric_diagonal, q: 4}", "y: {type: moment_frame, q: 4}"),
)
"""Three portals along y below one floor: HEB200 about the weak axis in A and C, HEA120 about the strong one in B."""
SHARES = [0.0, 0.3, 0.6, 0.9]
"""Of the force on the floor, on B. With 0.9 B is near its own buckling between fixed bases and the beam."""


def pair(stiff: float, N: float, h: float) -> tuple[float, float]:
    """Moments at the near and the far end of a column under a rotation 1 of the near one: s EI / h and s c EI / h."""
    if N == 0.0:
        return 4.0 * stiff / h, 2.0 * stiff / h
    u = h * np.sqrt(N / stiff)
    by = 2.0 - 2.0 * np.cos(u) - u * np.sin(u)
    return u * (np.sin(u) - u * np.cos(u)) / by * stiff / h, u * (u - np.sin(u)) / by * stiff / h


def sway_stiffness(stiff: float, N: float, h: float, spring: float, fixed: bool) -> float:
    """Horizontal force by displacement of a column's top that a rotational spring holds, under N."""
    near, far = pair(stiff, N, h)
    # rotations of top and column base, and the displacement of the top; a hinge at the column base is condensed
    K = np.array(
        [
            [near + spring, far, (near + far) / h],
            [far, near, (near + far) / h],
            [(near + far) / h, (near + far) / h, 2.0 * (near + far) / h**2 - N / h],
        ]
    )
    kept = [0] if fixed else [0, 1]
    return float(K[2, 2] - K[2, kept] @ np.linalg.solve(K[np.ix_(kept, kept)], K[kept, 2]))


def factors(model: SpaceModel, frame: SpaceFrame, force: dict[str, float]) -> tuple[float, float, float]:
    """alpha_cr along x, along y and of twist under forces of columns by their lines across x."""
    axial = np.zeros(len(frame.members))
    axial[frame.columns] = [-force[frame.members[number].name.split("_")[1][0]] for number in frame.columns]
    return critical_factors(model, model.modes(frame.node_mass), axial, frame.node_mass, frame.level_of_nodes)


def row(fixed: bool, slender: str = "HEA120") -> tuple[SpaceFrame, SpaceModel, float, float, float]:
    """The row of portals, the bending stiffness of its columns and the spring that a beam is in sway, 6 EI / L."""
    bases = ("supports: fixed", f"supports: {'fixed' if fixed else 'pinned'}")
    frame, model, _ = bending_only(building(ROW, bases, ("HEA120", slender)))
    beam = 6.0 * E * steel_section("IPE330").I_y / 7.0
    return frame, model, E * steel_section("HEB200").I_z, E * steel_section(slender).I_y, beam


@pytest.mark.parametrize("fixed", [True, False])
@pytest.mark.parametrize("slender", ["HEA120", "HEA100"])
@pytest.mark.parametrize("share", SHARES)
def test_portals_lean_on_one_another(fixed: bool, slender: str, share: float) -> None:
    """The storey has no stiffness left: the sum over its columns vanishes.

    The error is that of an eigenvalue whose residual is below 2 %, and of columns that shorten by 1e-4 of their length.
    """
    frame, model, stiff, weak, spring = row(fixed, slender)
    N = {"A": (1.0 - share) * 2e5, "B": 2.0 * share * 2e5, "C": (1.0 - share) * 2e5}

    def of_storey(alpha: float) -> float:
        of = sway_stiffness(weak, alpha * N["B"], 5.0, spring, fixed)
        return 4.0 * sway_stiffness(stiff, alpha * N["A"], 5.0, spring, fixed) + 2.0 * of

    exact = next(
        brentq(of_storey, low, low + 0.01)
        for low in np.arange(0.01, 99.0, 0.01)
        if of_storey(low) > 0.0 >= of_storey(low + 0.01)
    )
    scale = exact / 3.0  # of the forces, so that alpha_cr is 3: where it is needed
    found = factors(model, frame, {name: scale * force for name, force in N.items()})[1] * scale
    assert found == pytest.approx(exact, rel=1e-3)


def in_elements(stiff: float, N: float, h: float, parts: int, fixed: bool) -> tuple[np.ndarray, np.ndarray]:
    """K and -K_G of a column in cubic elements over displacement and rotation of its nodes; its base is fixed."""
    L = h / parts
    K = stiff / L**3 * np.array([[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2],
                                 [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L**2, -6 * L, 4 * L**2]])  # fmt: skip
    G = N / (30 * L) * np.array([[36, 3 * L, -36, 3 * L], [3 * L, 4 * L**2, -3 * L, -(L**2)],
                                 [-36, -3 * L, 36, -3 * L], [3 * L, -(L**2), -3 * L, 4 * L**2]])  # fmt: skip
    whole = np.zeros((2, 2 * parts + 2, 2 * parts + 2))
    for part in range(parts):
        at = slice(2 * part, 2 * part + 4)
        whole[:, at, at] += [K, G]
    first = 2 if fixed else 1
    return whole[0, first:, first:], whole[1, first:, first:]


@pytest.mark.parametrize("fixed", [True, False])
def test_against_many_elements(fixed: bool) -> None:
    """The same row with 24 elements a column, all eigenvalues: alpha_cr is the one whose shape moves the floor.

    24 elements err by (u / 24)^4 / 720 < 1e-6. The share of the floor in the strain energy follows from the stiffness
    of the storey without forces. One cubic element a column, with the rotations of a horizontal force alone, is what
    the storey's geometric stiffness would be without the bowing under N: 1.17 times the factor.
    """
    frame, model, stiff, slender, spring = row(fixed)
    N = {"A": 2e4, "B": 3.5e5, "C": 2e4}
    parts = 24
    blocks = [in_elements(EI, of, 5.0, parts, fixed) for EI, of in ((stiff, N["A"]), (slender, N["B"]))]
    size = [len(K) - 1 for K, _ in blocks]
    K, G = np.zeros((2, sum(size) + 1, sum(size) + 1))  # the displacement of the floor comes last
    for (own_K, own_G), start, count in zip(blocks, (0, size[0]), (4.0, 2.0), strict=True):
        n = len(own_K)
        order = [*range(n - 2), n - 1, n - 2]
        places = [*range(start, start + n - 1), len(K) - 1]
        own_K[n - 1, n - 1] += spring
        K[np.ix_(places, places)] += count * own_K[np.ix_(order, order)]
        G[np.ix_(places, places)] += count * own_G[np.ix_(order, order)]
    theta, shapes = eigh(G, K)
    storey = 1.0 / np.linalg.inv(K)[-1, -1]
    share = storey * shapes[-1] ** 2
    sways = theta[share > 0.5].max()
    under_force = np.linalg.solve(K, np.eye(len(K))[-1])
    assert 1.16 < (under_force @ K @ under_force) / (under_force @ G @ under_force) * sways < 1.18
    assert factors(model, frame, N)[1] == pytest.approx(1.0 / sways, rel=1e-3)  # a residual of 2 %, squared


def test_columns_between_floors_add_what_they_move_of_the_floor() -> None:
    """Braced columns on fixed bases buckle below their hinged tops, and push at the floor as they do.

    They buckle at 20.19 EI / h^2, before half of alpha_cr. Sway grows by 1 / (1 - 1 / alpha_cr), the stiffness of the
    storey without forces over that with them. What the shapes before that of the bracing leave is proportional to its
    factor, so that alpha_cr is not above; what shapes further up have of it makes it 1.3 % less here.
    """
    frame, model, _ = bending_only(building(portals() + NO_TORSION))
    length = np.hypot(6.0, 5.0)
    K = 4.0 * E * steel_section("SHS100x5").A * (6.0 / length) ** 2 / length
    V = 0.2 * K * 5.0  # K h / V = 5
    found = factors(model, frame, {"A": V / 4.0, "B": V / 4.0})
    EI = E * steel_section("HEB200").I_z
    axial = np.where([member.kind == "column" for member in frame.members], -V / 4.0, 0.0)
    assert model.critical_factor(axial) < 1.001 * 4.493409457909064**2 * EI / 5.0**2 / (V / 4.0) < 0.5 * found[1]
    before, under = (K + 4.0 * sway_stiffness(EI, N, 5.0, 0.0, True) for N in (1e-9 * V, V / 4.0))
    assert 0.98 < found[1] * (1.0 - under / before) < 1.001


def test_alpha_cr_of_a_design() -> None:
    """The whole way from a file: alpha_cr of the row, whose members shear and shorten too, which costs at most 5 %."""
    design = design_of(ROW, ("loads:\n", "loads:\n  nodes: [{at: B, floors: 1, G: 90 kN}]\n"))
    force = -design.static.internal[0, design.frame.columns, 3, 0] * 1.35
    names = [design.frame.members[number].name[2] for number in design.frame.columns]
    frame, model, *_ = row(fixed=True)
    bending = factors(model, frame, dict(zip(names, force, strict=True)))[1]
    assert 0.95 < design.sway.alpha_cr[0, 1] / bending < 1.0


HOUSE = """\
edesign_building: 1
title: A storey of HEB300, and a small house of HEA100 upon it
plan: {x: {count: 5, width: 6 m}, y: {count: 4, width: 6 m}}
storeys: [3.5 m, 4 m]
setbacks: [{floors: 2, bays: {x: 1, y: 1}}]
diaphragms: all
columns:
  - {section: HEB300, strong: x, material: S275}
  - {storeys: 2, section: HEA100, strong: x, material: S275}
beams: [{along: x, section: IPE400, material: S275}, {along: y, section: IPE400, material: S275}]
materials: {S275: {fy: 275 MPa}}
loads:
  areas: [{floors: 1, G: 6 kN/m^2, spans: x}, {floors: 2, G: 4.5 kN/m^2, spans: y}]
  self_weight: false
masses: {from_loads: {G: 1.0}}
hazard: {code: ec8-2004, a_gR: 0.02 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: low
  systems: {x: {type: moment_frame, q: 1.5}, y: {type: moment_frame, q: 1.5}}
"""


def test_a_light_storey_sways_by_itself() -> None:
    """The house has 3 % of the mass, and is the storey that sways: along its weak axis, between stiff beams.

    Columns whose ends do not turn sway at pi^2 EI / h^2. Here beams hold them, whose I / L is 115 times theirs (23130
    cm^4 / 6 m by 134 cm^4 / 4 m). Ends turn next to nothing; the stiff storey below moves by some percent as well.
    """
    found = design_of(HOUSE)
    force = 1.35 * 4.5e3 * 6.0 * 6.0 / 4.0
    Euler = np.pi**2 * E * steel_section("HEA100").I_z / 4.0**2 / force
    assert 0.9 < found.sway.alpha_cr[0, 1] / Euler < 1.0
    assert found.sway.amplification[0, 1] == pytest.approx(1.0 / (1.0 - 1.0 / found.sway.alpha_cr[0, 1]))


def test_floors_that_twist_are_amplified_both_ways() -> None:
    """alpha_cr of twist below 10 counts in both directions: what acts beside the centre of rotation twists floors."""
    found = design_of(HOUSE).sway
    twist = found.alpha_cr[0, 2]
    assert twist < found.alpha_cr[0, 0] < 10.0
    assert found.amplification[0, 0] == pytest.approx(1.0 / (1.0 - 1.0 / twist))
