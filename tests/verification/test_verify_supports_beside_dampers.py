"""A building with dampers along x and y under an oblique pair, its masses beside their places: statics in every step.

References: equilibrium of each support with its column and with the gussets of dampers, of all supports with the loads
and with the base shear; Eq. 6.62 of EN 1993-1-1 with Annex B, written out here from N, M_y and M_z of the step.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import SMALL

from edesign.archive.dataset import Group
from edesign.frame.building_file import load_building
from edesign.frame.sections.steel_section import steel_section
from edesign.study.analysis.history import run_history

STEP, SPAN, HEIGHT = 0.01, 6.0, 4.0
LINES = [f"{x}{y}" for x in "ABC" for y in "123"]
MORE = f"""
damping: {{kind: rayleigh, ratio: 2 %, periods: [1.0 s, 0.1 s]}}
integration: {{method: newmark, time_step: {STEP} s}}
records: {{pair: {{pair: [{{file: one.csv, acceleration_unit: m/s^2}}, {{file: two.csv, acceleration_unit: m/s^2}}]}}}}
dampers:
  laws:
    oil: {{type: viscous_power, parameters: {{c: 60 kN*(s/m)^0.5, alpha: 0.5}}}}
    steel: {{type: elastic_plastic, parameters: {{k: 20 kN/mm, Fy: 40 kN, b: 0.02}}}}
  devices:
    - {{kind: chevron, along: x, frames: [X1, X3], bays: 1, storeys: all, law: steel, brace: {{stiffness: 90 kN/mm}}}}
    - {{kind: rising, along: y, frames: B, bays: 2, storeys: all, law: oil, brace: {{section: SHS100x5, material: S275}}
       }}
analyses:
  - {{name: shaken, kind: history, record: pair, angles: 30 deg, eccentricity: +x-y}}
outputs: {{histories: [storeys, dampers, supports], every: 1, members: [{", ".join(f"C_{line}_1" for line in LINES)}]}}
"""


@pytest.fixture(scope="module")
def group(tmp_path_factory: pytest.TempPathFactory) -> Group:
    folder, time = tmp_path_factory.mktemp("shaken"), np.arange(0.0, 4.0, STEP)
    for name, period, size in (("one", 0.7, 4.0), ("two", 0.45, 3.0)):
        shaking = size * np.sin(2.0 * math.pi * time / period) * np.minimum(1.0, time)
        text = "\n".join(f"{t:.2f},{a:.9f}" for t, a in zip(time, shaking, strict=True))
        (folder / f"{name}.csv").write_text(f"t,a\n{text}\n")
    steel = "S275: {fy: 275 MPa, law: bilinear, hardening: 0.01}"
    (folder / "building.yaml").write_text(SMALL.replace("S275: {fy: 275 MPa}", steel) + MORE)
    building = load_building(folder / "building.yaml")
    found = run_history(building, building.analyses[0])  # type: ignore[arg-type]
    assert found.attributes["status"] == "completed"
    return found


def of(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)


def at(group: Group, coordinate: str, name: str) -> int:
    return [str(one) for one in group.coords[coordinate].values].index(name)


def test_each_support_carries_its_column_and_the_gussets_of_dampers(group: Group) -> None:
    """A chevron of F brings F/2 across and F h / w up or down at each foot, a diagonal its components."""
    force, largest = of(group, "damper_force"), 0.0
    diagonal = math.hypot(5.0, HEIGHT)
    axis_y, axis_z = of(group, "member_axis_y"), of(group, "member_axis_z")
    for line in LINES:
        column, support = at(group, "recorded_member", f"C_{line}_1"), at(group, "support", f"{line}.0")
        member = at(group, "member", f"C_{line}_1")
        V = of(group, "member_axial_force")[:, column, 0].copy()
        with_y, with_z = of(group, "member_shear_force")[:, column, 0].T
        H = with_y[:, None] * axis_z[member, :2] + with_z[:, None] * axis_y[member, :2]
        if line[0] in "AB" and line[1] in "13":
            F = force[:, at(group, "damper", f"VX_{line[1]}_1_1")]
            H[:, 0] -= 0.5 * F
            V += (1.0 if line[0] == "A" else -1.0) * -F * HEIGHT / SPAN
        if line == "B2":
            F = force[:, at(group, "damper", "RY_B_2_1")]
            H[:, 1] -= F * 5.0 / diagonal
            V -= F * HEIGHT / diagonal
        crossed = line in ("A1", "A2", "C1", "C2")  # braces of the building end there too
        if not crossed:
            largest = np.abs(V).max()
            np.testing.assert_allclose(of(group, "support_vertical_reaction")[:, support], V, atol=1e-5 * largest)
            np.testing.assert_allclose(of(group, "support_horizontal_reaction")[:, support], H, atol=1e-5 * largest)
    assert np.abs(force).max() > 40e3 and largest > 0.0


def test_all_supports_carry_the_loads_and_the_base_shear(group: Group) -> None:
    """Damping in proportion to the stiffness acts upwards too: it may be a hundredth of the loads for an instant."""
    total = of(group, "support_vertical_reaction").sum(axis=1)
    np.testing.assert_allclose(total, total[0], rtol=1e-2)
    H, shear = of(group, "support_horizontal_reaction").sum(axis=1), of(group, "base_shear")
    np.testing.assert_allclose(-H, shear, atol=1e-6 * np.abs(shear).max())
    storey = of(group, "storey_shear")[:, 0] + of(group, "storey_damper_force")[:, 0]
    np.testing.assert_allclose(storey, shear, atol=1e-6 * np.abs(shear).max())
    assert (np.abs(shear).max(axis=0) > 50e3).all()


def test_the_use_of_a_column_bent_about_both_axes_by_hand(group: Group) -> None:
    """C_B3_1, HEB200, 4 m: Eqs. 6.61 and 6.62, Annex B, of the forces that the archive keeps with the use.

    Along x the frame sways, C_my = 0.9 (Table B.3); along y braces stand, and the moment counts as uniform: C_mz = 1,
    C_mLT = 1.
    """
    member = at(group, "member", "C_B3_1")
    N = -of(group, "member_use_axial_force")[member].min()
    M_y, M_z = np.abs(of(group, "member_use_bending_moment")[member]).max(axis=0)
    s, fy, E, G = steel_section("HEB200"), 275e6, 210e9, 210e9 / 2.6
    slender_y, slender_z = (math.sqrt(s.A * fy * HEIGHT**2 / (math.pi**2 * E * inertia)) for inertia in (s.I_y, s.I_z))
    chi_y, chi_z = reduction(slender_y, 0.34), reduction(slender_z, 0.49)
    along = HEIGHT**2 * G * s.I_t / (math.pi**2 * E * s.I_z)
    M_cr = math.pi**2 * E * s.I_z / HEIGHT**2 * math.sqrt(s.I_w / s.I_z + along)
    slender_LT = math.sqrt(s.W_pl_y * fy / M_cr)
    phi = 0.5 * (1.0 + 0.34 * (slender_LT - 0.4) + 0.75 * slender_LT**2)  # 6.3.2.3, curve b, h / b = 1
    chi_LT = min(1.0, 1.0 / (phi + math.sqrt(phi**2 - 0.75 * slender_LT**2)))
    n_y, n_z = N / (chi_y * s.A * fy), N / (chi_z * s.A * fy)
    m_y, m_z = M_y / (chi_LT * s.W_pl_y * fy), M_z / (s.W_pl_z * fy)
    use = [
        n_y + k_yy(slender_y, n_y) * m_y + 0.6 * k_zz(slender_z, n_z) * m_z,
        n_z + (1.0 - 0.1 * min(1.0, slender_z) * n_z / 0.75) * m_y + k_zz(slender_z, n_z) * m_z,
    ]
    assert min(N / 1e3, M_y / 1e3, M_z / 1e3) > 1.0
    assert of(group, "member_use_max")[member] == pytest.approx(max(use), rel=1e-5)


def reduction(slenderness: float, alpha: float) -> float:
    phi = 0.5 * (1.0 + alpha * (slenderness - 0.2) + slenderness**2)
    return min(1.0, 1.0 / (phi + math.sqrt(phi**2 - slenderness**2)))


def k_yy(slenderness: float, n: float) -> float:
    return 0.9 * (1.0 + min(slenderness - 0.2, 0.8) * n)


def k_zz(slenderness: float, n: float) -> float:
    return 1.0 + min(2.0 * slenderness - 0.6, 1.4) * n
