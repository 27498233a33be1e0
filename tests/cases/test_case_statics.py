"""Static results of the cases against statics, virtual work, plastic theory and the elastica, worked out here."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
E = 210e9  # Pa, of all steels
G = 9.80665  # m/s2


def by_name(group: Group, coordinate: str, variable: str) -> dict[str, np.ndarray]:
    """Values of a variable by the names of its first dimension."""
    return dict(zip(group.coords[coordinate].values, group.variables[variable].values, strict=True))


# ---- irregular_setback: (load N, x of its resultant m), by hand from the project file; lines at 0, 6, 13.5, 18.5 m

FLOOR, ROOF = 25.6e3, 17.2e3  # N/m: 22 + 0.3 * 12 and 16 + 0.3 * 4 kN/m
SETBACK_LOADS = [
    *((FLOOR * 7.5, 9.75), (FLOOR * 5.0, 16.0)),  # floor 1: bay 1 has no beam
    *((FLOOR * 6.0, 3.0), (FLOOR * 7.5, 9.75), (FLOOR * 5.0, 16.0)),  # floor 2
    *((FLOOR * 6.0, 3.0), (FLOOR * 7.5, 9.75)),  # floor 3
    *((ROOF * 6.0, 3.0), (ROOF * 7.5, 9.75)),  # floor 4
    *((4 * 18e3, 0.0), (66e3, 18.5)),  # nodes of line A, node D2
]


def test_reactions_balance_the_gravity_loads_of_the_setback(results_of: Results) -> None:
    group = results_of("irregular_setback", "gravity")
    assert list(group.coords["support"].values) == ["A0", "B0", "C0", "D0"]
    vertical = group.variables["reaction_y_final"].values
    moment = group.variables["reaction_moment_final"].values
    total = sum(load for load, _ in SETBACK_LOADS)
    assert vertical.sum() == pytest.approx(total, rel=1e-8)
    about_a0 = sum(load * x for load, x in SETBACK_LOADS)
    assert vertical @ [0.0, 6.0, 13.5, 18.5] + moment.sum() == pytest.approx(about_a0, rel=1e-8)
    assert abs(group.variables["reaction_x_final"].values.sum()) < 1e-6 * total
    assert moment[0] == moment[3] == 0.0 and abs(moment[1]) > 1e3  # A and D are pinned, B is fixed
    assert results_of("irregular_setback", "modes").attributes["mass_kg"] == pytest.approx(total / G, rel=1e-12)


@pytest.mark.parametrize("analysis", ["gravity", "push", "shake"])
def test_hinged_ends_carry_no_moment(results_of: Results, analysis: str) -> None:
    group = results_of("irregular_setback", analysis)
    extremes = [by_name(group, "member", f"member_bending_moment_{which}") for which in ("max", "min")]
    moments = {name: np.maximum(np.abs(extremes[0][name]), np.abs(extremes[1][name])) for name in extremes[0]}
    largest = max(ends.max() for ends in moments.values())
    hinged = [*moments["B_3_1"], *moments["B_3_2"], moments["B_1_4"][1], moments["C_A_1"][0], moments["C_D_1"][0]]
    assert max(hinged) < 1e-6 * largest
    assert moments["B_1_4"][0] > 0.01 * largest  # the other end of that beam is rigid


@pytest.mark.parametrize(
    ("case", "storeys"), [("irregular_setback", 4), ("braced_truss", 3), ("deteriorating_hinges", 2)]
)
def test_storey_shear_is_the_sum_of_the_lateral_loads_above(results_of: Results, case: str, storeys: int) -> None:
    group = results_of(case, "push")
    load = group.variables["lateral_load"].values
    shares = by_name(group, "loaded_node", "lateral_load_share")
    assert sum(shares.values()) == pytest.approx(1.0, rel=1e-12)
    for storey in range(1, storeys + 1):
        above = sum(share for node, share in shares.items() if int(node[1:]) >= storey)
        shear = group.variables["storey_shear"].values[:, storey - 1]
        np.testing.assert_allclose(shear, above * load, rtol=0, atol=1e-6 * load.max())
    np.testing.assert_allclose(group.variables["base_shear"].values, load, rtol=0, atol=1e-6 * load.max())


# ---- braced_truss: method of joints and virtual work

LEVELS = [0.0, 4.0, 7.5, 11.0]
COLUMN = 2 * 0.200 * 0.015 + 0.170 * 0.009  # m2, HEB200 of three rectangles
BEAM = 2 * 0.150 * 0.0107 + 0.2786 * 0.0071  # IPE300
RODS = {1: 0.0020, 2: 0.0016, 3: 0.0016}  # m2, by storey
FY = 235e6


def truss() -> tuple[dict[str, tuple[str, str, float]], dict[str, tuple[float, float]]]:
    """Members (start, end, area) and nodes (x, y) of the braced frame."""
    nodes = {f"{line}{floor}": (x, y) for line, x in (("A", 0.0), ("B", 6.0)) for floor, y in enumerate(LEVELS)}
    members = {}
    for s in (1, 2, 3):
        members |= {f"C_{line}_{s}": (f"{line}{s - 1}", f"{line}{s}", COLUMN) for line in "AB"}
        members[f"B_1_{s}"] = (f"A{s}", f"B{s}", BEAM)
    members["D_1_1_r"] = ("A0", "B1", RODS[1])
    members |= {f"D_1_{s}_f": (f"A{s}", f"B{s - 1}", RODS[s]) for s in (2, 3)}
    return members, nodes


def truss_forces() -> tuple[np.ndarray, np.ndarray, list[str], list[str]]:
    """Member forces for unit loads at the free degrees (members, 2 * 6 nodes), L / (E A), names, free nodes.

    The frame is statically determinate: 12 members, 12 equations of equilibrium at the free nodes.
    """
    members, nodes = truss()
    free = [name for name, (_, y) in nodes.items() if y > 0.0]
    equilibrium = np.zeros((2 * len(free), len(members)))
    flexibility = np.zeros(len(members))
    for m, (i, j, area) in enumerate(members.values()):
        along = np.subtract(nodes[j], nodes[i])
        length = float(np.hypot(*along))
        flexibility[m] = length / (E * area)
        for node, pull in ((i, along / length), (j, -along / length)):
            if node in free:
                equilibrium[2 * free.index(node) : 2 * free.index(node) + 2, m] = pull
    return -np.linalg.inv(equilibrium), flexibility, list(members), free


def test_truss_forces_follow_from_statics_and_sway_from_virtual_work(results_of: Results) -> None:
    group = results_of("braced_truss", "push")
    unit, flexibility, names, free = truss_forces()
    shares = by_name(group, "loaded_node", "lateral_load_share")
    for node in free:  # triangular with equal masses
        assert shares[node] == pytest.approx(LEVELS[int(node[1:])] / (2 * sum(LEVELS)), rel=1e-12)
    total = group.variables["lateral_load"].values[-1]
    loads, roof = np.zeros(2 * len(free)), np.zeros(2 * len(free))
    loads[::2] = [total * shares[node] for node in free]
    roof[::2] = [0.5 * (node in ("A3", "B3")) for node in free]
    forces = dict(zip(names, unit @ loads, strict=True))
    for kind in ("column", "brace"):
        for name, value in by_name(group, kind, f"{kind}_axial_force_final").items():
            assert value == pytest.approx(forces[name], rel=1e-6, abs=1e-6 * total), name
    sway = (unit @ loads) * flexibility @ (unit @ roof)
    assert group.variables["roof_displacement"].values[-1] == pytest.approx(sway, rel=1e-6)


def test_truss_periods_follow_from_its_flexibility(results_of: Results) -> None:
    unit, flexibility, _, _ = truss_forces()
    matrix = unit.T @ (flexibility[:, None] * unit)  # displacements for unit loads
    periods = 2 * np.pi * np.sqrt(30e3 * np.linalg.eigvalsh(matrix)[::-1][:3])
    assert results_of("braced_truss", "modes").variables["period"].values == pytest.approx(periods, rel=1e-6)


def test_diagonals_yield_at_their_squash_load_and_cap_the_storey_shear(results_of: Results) -> None:
    group = results_of("braced_truss", "shake")
    largest = by_name(group, "brace", "brace_axial_force_max")
    smallest = by_name(group, "brace", "brace_axial_force_min")
    assert largest["D_1_1_r"] == pytest.approx(FY * RODS[1], rel=1e-9) == -smallest["D_1_1_r"]
    assert all(value <= FY * RODS[2] * (1 + 1e-9) for name, value in largest.items() if name != "D_1_1_r")
    shear = np.abs(group.variables["storey_shear"].values).max(axis=0)
    assert shear[0] == pytest.approx(FY * RODS[1] * 6.0 / np.hypot(6.0, 4.0), rel=1e-6)


# ---- plastic mechanisms


def plastic_modulus(height: float, width: float, flange: float, web: float) -> float:
    """Of an I of three rectangles, m3."""
    return width * flange * (height - flange) + web * (height - 2 * flange) ** 2 / 4


def test_resistance_past_the_peak_falls_by_p_over_h(results_of: Results) -> None:
    """Six hinges of the three beams, less the overturning moment of the roof: V = 6 Mp / h - P u / h."""
    group = results_of("p_delta_past_peak", "push")
    height, load = 6.0, 2 * (250e3 + 30e3) + 2 * (500e3 + 60e3)
    mechanism = 6 * 235e6 * plastic_modulus(0.300, 0.150, 0.0107, 0.0071) / height
    shear, u = group.variables["base_shear"].values, group.variables["roof_displacement"].values
    # The hinges approach Mp from below: at 68 mrad the elastic core of a section is below 1/30 of its depth.
    assert shear[-1] + load * u[-1] / height == pytest.approx(mechanism, rel=1e-3)
    slope = np.polyfit(u[-40:], shear[-40:], 1)[0]
    assert slope == pytest.approx(-load / height, rel=5e-3)
    peak = int(np.argmax(shear))
    assert 0.1 < peak / shear.size < 0.5 and shear[-1] < 0.1 * shear[peak]
    axial = results_of("p_delta_past_peak", "gravity").variables["column_axial_force_final"].values
    assert axial.sum() == pytest.approx(-load, rel=1e-9)


def test_welded_portal_carries_its_mechanism_load(results_of: Results) -> None:
    """Pinned columns stay elastic, the beam hinges at both ends: V = 2 Mp / h."""
    group = results_of("plates_menegotto_pinto", "push")
    mechanism = 2 * 355e6 * plastic_modulus(0.420, 0.180, 0.014, 0.008) / 5.0
    # Menegotto-Pinto reaches fy from below, within 0.1 % at ten times the yield strain with R0 = 20
    assert group.variables["base_shear"].values[-1] == pytest.approx(mechanism, rel=1e-3)
    assert np.all(group.variables["column_plastic_rotation_max"].values < 1e-6)
    stress = results_of("plates_menegotto_pinto", "shake").variables["fibre_stress"].values
    assert 0.99 * 355e6 < np.abs(stress).max() <= 355e6 * (1 + 1e-9)
    depth = group.variables["fibre_depth"].values  # middles of the outermost of 4 layers of a flange
    assert depth == pytest.approx([-(0.210 - 0.014 / 8), 0.210 - 0.014 / 8], rel=1e-9)


def test_period_of_the_welded_portal(results_of: Results) -> None:
    """Sway of a portal on pins: u = V h^3 / (6 E Ic) + V h^2 L / (12 E Ib)."""
    beam = (0.180 * 0.420**3 - 0.172 * 0.392**3) / 12
    column = (0.400 * 0.600**3 - 0.380 * 0.520**3) / 12
    flexibility = 5.0**3 / (6 * E * column) + 5.0**2 * 8.0 / (12 * E * beam)
    period = 2 * np.pi * np.sqrt(600e3 / G * flexibility)
    # layers leave out their own inertia, 1/400 of the web's
    assert results_of("plates_menegotto_pinto", "modes").variables["period"].values[0] == pytest.approx(
        period, rel=2e-3
    )


# ---- corotational_mast


def test_mast_bends_like_the_elastica(results_of: Results) -> None:
    """Tip deflection of a cantilever under P L^2 / EI = 1 and 2, Bisshopp & Drucker (1945)."""
    group = results_of("corotational_mast", "push")
    length, bending = 20.0, E * 2e-5
    load, u = group.variables["lateral_load"].values, group.variables["roof_displacement"].values
    for factor, deflection in ((1.0, 0.30172), (2.0, 0.49346)):
        found = float(np.interp(deflection * length, u, load)) * length**2 / bending
        assert found == pytest.approx(factor, rel=3e-3)  # eight straight chords for the curve: (1/8)^2 / 6 = 0.0026
    small = 3 * bending / length**3  # linear stiffness
    assert load[1] / u[1] == pytest.approx(small, rel=1e-3)
    period = 2 * np.pi * np.sqrt(500.0 / small)
    assert results_of("corotational_mast", "modes").variables["period"].values[0] == pytest.approx(period, rel=1e-6)
