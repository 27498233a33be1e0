"""Forces of braces in the columns and beams of their frames, by statics."""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import NO_TORSION, PINNED, braced_frames, changed, design_of, number_of

from edesign.codes.ec3 import lateral_torsional
from edesign.frame.sections.steel_section import steel_section
from edesign.space.analysis.bracing import bracing
from edesign.space.designed import ElasticDesign

BUILDING = changed(braced_frames(storeys="4 m, 3 m"), PINNED, ("spans: y", "spans: x")) + NO_TORSION
CHEVRONS = changed(BUILDING, ("kind: cross", "kind: chevron"), ("concentric_diagonal, q: 4", "concentric_v, q: 2"))


def one_mode(found: ElasticDesign) -> tuple[np.ndarray, np.ndarray]:
    """Axial forces of the first mode along y in the linear model, and those that the worse sense has."""
    mode = int(found.modes.effective_mass_ratio[:, 1].argmax())
    axial = found.modes.end_forces[[mode], :, 6]
    plain = np.zeros((axial.shape[1], 7, 6))
    return axial[0], bracing(found.frame).axial_forces(plain, axial, np.ones((1, 1)))[:, :, 0]


def test_a_truss_with_the_diagonals_in_tension_alone() -> None:
    """One bay, two storeys, by joints: the diagonals in tension carry T_1 and T_2, twice the force of the model.

    Columns: T_2 sin in storey 2, T_2 sin_2 + T_1 sin_1 below. Beams: the roof collects from 0 to T_2 cos; the floor
    goes from T_2 cos, which comes from above, to T_1 cos, which goes on below. Beams on hinges pass no shear, so that
    statics is exact (1e-9).
    """
    found = design_of(BUILDING)
    model, worse = one_mode(found)
    frame = found.frame
    T = [2.0 * abs(model[number_of(frame, f"DY_A_1_{storey}_r")]) for storey in (1, 2)]
    cosine = [8.0 / np.hypot(8.0, height) for height in (4.0, 3.0)]
    sine = [height / np.hypot(8.0, height) for height in (4.0, 3.0)]
    for line in ("A1", "A2"):
        above, below = (worse[number_of(frame, f"C_{line}_{storey}")] for storey in (2, 1))
        np.testing.assert_allclose(above, T[1] * sine[1], rtol=1e-9)
        np.testing.assert_allclose(below, T[1] * sine[1] + T[0] * sine[0], rtol=1e-9)
    roof, floor = (worse[number_of(frame, f"BY_A_1_{level}")] for level in (2, 1))
    towards = np.linspace(0.0, 1.0, 7)
    both = np.maximum(towards, 1.0 - towards)  # of both senses, one of which mirrors the other
    np.testing.assert_allclose(roof, T[1] * cosine[1] * both, rtol=1e-9)
    each = T[1] * cosine[1] + (T[0] * cosine[0] - T[1] * cosine[1]) * towards
    np.testing.assert_allclose(floor, np.maximum(each, each[::-1]), rtol=1e-9)


def test_the_storey_shear_goes_through_the_beams() -> None:
    """The roof beam of each of two frames collects half of the storey shear, but for what columns take (5 %)."""
    found = design_of(BUILDING)
    beam = number_of(found.frame, "BY_A_1_2")
    N = found.effects.seismic[1, beam, :, 0]
    assert N.max() == pytest.approx(0.5 * found.response["y"].storey_shear[1], rel=0.05)
    assert found.effects.seismic[0, beam, :, 0].max() < 0.01 * N.max()  # columns of frames along x get longer


def test_diagonals_that_count_in_compression_leave_columns_as_they_are() -> None:
    """Each takes half of the shear; beams then collect from one half of it to the other: at most V/4 of a frame."""
    found = design_of(BUILDING, ("kind: cross,", "kind: cross, compression: true,"))
    model, worse = one_mode(found)
    H = 2.0 * abs(model[number_of(found.frame, "DY_A_1_2_r")]) * 8.0 / np.hypot(8.0, 3.0)
    roof = worse[number_of(found.frame, "BY_A_1_2")]
    np.testing.assert_allclose(roof, 0.5 * H * np.abs(np.linspace(-1.0, 1.0, 7)), atol=1e-9 * H)
    assert not worse[found.frame.columns].any()  # what the model has is not touched


def test_a_beam_beside_a_buckled_brace() -> None:
    """EN 1998-1, 6.7.4(2), by hand: a beam of 8 m on hinges with q L2 / 8 + 0.7 N_pl sin L / 4 in the middle.

    The roof is pulled by the braces below alone: the floor gives back H = 1.3 N_pl cos evenly, and N goes from 0 at
    the column to H / 2 beside the middle. Braces keep a millionth of their stiffness under gravity (1e-4).
    """
    found = design_of(CHEVRONS)
    frame, acting = found.frame, found.effects
    N_pl = steel_section("SHS100x6").A * 275e6
    sine = [height / np.hypot(4.0, height) for height in (4.0, 3.0)]
    first, second = (number_of(frame, f"BY_A_1_2_{half}") for half in (1, 2))
    gravity = (5.0 + 0.3 * 2.0) * 1e3 * 3.0
    rows = [row for row in found.combinations if "braces" in row.name]
    assert [row.name for row in rows] == ["G + 0.3 Q + braces+", "G + 0.3 Q + braces-"]
    H = 1.3 * N_pl * np.sqrt(1.0 - sine[1] ** 2)
    for row, way in zip(rows, (1.0, -1.0), strict=True):
        forces = acting.of_static(row)
        M = gravity * 8.0**2 / 8.0 + 0.7 * N_pl * sine[1] * 8.0 / 4.0
        assert abs(forces[first, -1, 4]) == pytest.approx(M, rel=1e-4)
        assert abs(forces[first, 0, 2]) == pytest.approx(gravity * 4.0 + 0.35 * N_pl * sine[1], rel=1e-4)
        np.testing.assert_allclose(forces[first, [0, -1], 0], [0.0, -way * H / 2.0], atol=1e-6 * H)
        np.testing.assert_allclose(forces[second, [0, -1], 0], [way * H / 2.0, 0.0], atol=1e-6 * H)
    M_pl = steel_section("IPE400").W_pl_y * 275e6
    bending = list(found.members.checks).index("M_Y")
    assert found.members.utilisation[first, bending] == pytest.approx(M / M_pl, rel=1e-4)
    governing = found.members.rows[int(found.members.combination[first, bending]) - 1]
    assert governing.name.startswith("G + 0.3 Q + braces")


def test_the_floor_below_passes_the_forces_of_the_braces_above() -> None:
    """At the column the brace above pushes N_pl cos_2 (or 0.3 of it) into the beam; in the middle 1.3 N_pl cos_1 leave.

    Balance of the halves: the floor gives the difference evenly.
    """
    found = design_of(CHEVRONS)
    N_pl = steel_section("SHS100x6").A * 275e6
    low, high = (N_pl * 4.0 / np.hypot(4.0, height) for height in (4.0, 3.0))
    first, second = (number_of(found.frame, f"BY_A_1_1_{half}") for half in (1, 2))
    forces = found.effects.of_static(next(row for row in found.combinations if row.name.endswith("braces+")))
    step = 1.3 * (low - high) / 2.0
    np.testing.assert_allclose(forces[first, [0, -1], 0], [-high, -high - step], rtol=1e-9)
    np.testing.assert_allclose(forces[second, [0, -1], 0], [0.3 * high + step, 0.3 * high], rtol=1e-9)


def test_class_low_has_no_buckled_braces() -> None:
    low = CHEVRONS.replace("class: medium", "class: low").replace("q: 4", "q: 1.5").replace("q: 2", "q: 1.5")
    assert not [row for row in design_of(low).combinations if "braces" in row.name]


def test_halves_of_beams_buckle_as_one() -> None:
    """A braced beam of 8 m has the buckling length of 8 m about y, not that of its halves (6.7.4(2))."""
    found = design_of(CHEVRONS)
    span = bracing(found.frame).span
    assert span[number_of(found.frame, "BY_A_1_1_1")] == span[number_of(found.frame, "BY_A_1_1_2")] == 8.0


def test_the_class_of_a_beam_follows_its_axial_force() -> None:
    """IPE400 is of class 1 in bending. N of SHS180x10, half of 1.3 N_pl cos, presses its whole web: class 3.

    Web c/t = 331 / 8.6 = 38.5 is above 33 epsilon = 30.5. M_b,Rd then has the elastic modulus (1e-4: braces keep a
    millionth of their stiffness under gravity).
    """
    found = design_of(CHEVRONS, ("SHS100x6", "SHS180x10"))
    first = number_of(found.frame, "BY_A_1_2_1")
    row = next(row for row in found.combinations if "braces" in row.name)
    M = np.abs(found.effects.of_static(row)[first, :, 4])
    elastic = steel_section("IPE400").W_el_y * 275e6
    bending = list(found.members.checks).index("M_B")
    assert found.members.utilisation[first, bending] == pytest.approx(M.max() / elastic, rel=1e-4)


def test_columns_beside_single_diagonals_that_buckle() -> None:
    """EN 1998-1, 6.7.4(3), by joints: in bays 1 and 3 of three, mirrored; those in compression push with N_b,Rd.

    SHS100x6 of 8.94 m, curve a: lambda = 2.70 and N_b,Rd = 0.127 N_pl,Rd (by hand, three digits). The floor moves
    along y: the diagonal of bay 3, which falls, buckles. Its head is at line 3 and its lower end at line 4.
    """
    found = design_of(
        BUILDING,
        ("y: [8 m]", "y: [8 m, 8 m, 8 m]"),
        ("storeys: [4 m, 3 m]", "storeys: [4 m]"),
        (
            "  - {along: y, frames: all, bays: all, kind: cross,",
            "  - {along: y, frames: all, bays: 1, kind: rising, section: SHS100x6, material: S275}\n"
            "  - {along: y, frames: all, bays: 3, kind: falling,",
        ),
    )
    length = np.hypot(8.0, 4.0)
    section = steel_section("SHS100x6")
    slenderness = length / section.i_z / (np.pi * np.sqrt(210e9 / 275e6))
    phi = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness**2)
    N_b = section.A * 275e6 / (phi + np.sqrt(phi**2 - slenderness**2))
    assert slenderness == pytest.approx(2.70, abs=0.005) and N_b / (section.A * 275e6) == pytest.approx(0.127, abs=5e-4)
    case = found.effects.cases.index("buckling+")
    pushed = {
        line: found.effects.static[case, number_of(found.frame, f"C_A{line}_1"), 0, 0] / (N_b * 4.0 / length)
        for line in (1, 2, 3, 4)
    }
    assert pushed == pytest.approx({1: 0.0, 2: 0.0, 3: 1.0, 4: 0.0}, abs=1e-9)
    names = [row.name for row in found.members.amplified]
    assert len([name for name in names if name.endswith("buckling+")]) == 2
    assert not any("buckling" in row.name for row in design_of(BUILDING).combinations)


def test_beams_of_floors_that_are_not_rigid() -> None:
    """Of the masses at both nodes of the roof half pulls and half pushes: N = T cos - F / 2 at the diagonal's head.

    The diagonal in tension takes F, all of it, at the far node: the beam passes on the half of the near one. Columns
    on pins take a little of F by bending over the floor (2 %).
    """
    found = design_of(BUILDING, ("columns:", "diaphragms: none\ncolumns:"))
    model, worse = one_mode(found)
    T = 2.0 * abs(model[number_of(found.frame, "DY_A_1_2_r")]) * 8.0 / np.hypot(8.0, 3.0)
    np.testing.assert_allclose(worse[number_of(found.frame, "BY_A_1_2")], 0.5 * T, rtol=0.02)


def test_braces_that_meet_a_beam_do_not_hold_it_sideways() -> None:
    """M_b,Rd of halves by the formulas of the whole beam: C1 = 1, its span, and its loads at their worst place."""
    design = design_of(CHEVRONS + "  members: {lateral_restraint: {beams: ends}}\n")
    free, frame = design.members.free_beams, design.frame
    assert free is not None and free.uniform.any() and not free.uniform.all()
    for place in np.flatnonzero(free.uniform):
        member = frame.members[free.members[place]]
        s, span = steel_section(member.section), float(free.span[place])
        assert span == pytest.approx(2.0 * frame.length[free.members[place]])
        fy = 275e6
        for row, combination in enumerate(design.members.rows):
            acting = design.effects
            static = acting.of_static(combination)[free.members[place], :, 4]
            M_max = float((np.abs(static) + acting.of_seismic(combination)[free.members[place], :, 4]).max())
            load = sum(combination.static.get(case, 0.0) * free.loads[k, place] for k, case in enumerate(acting.cases))
            C2_z_g = 0.5 * s.h * span * max(load, 0.0) / (math.pi**2 * M_max)
            of = 210e9, 210e9 / 2.6, s.I_z, s.I_t, s.I_w, span
            M_cr = lateral_torsional.critical_moment(*of, 1.0, 1.0, C2_z_g)
            slender = lateral_torsional.slenderness(s.W_pl_y, fy, M_cr)
            chi = lateral_torsional.reduction_factor(slender, lateral_torsional.rolled_curve(s.h, s.b))
            assert free.M_b_Rd[place, row] == pytest.approx(chi * s.W_pl_y * fy, rel=1e-6)
