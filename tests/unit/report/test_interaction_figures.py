"""Curves of resistance of a column, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.loader import parse_project
from edesign.report.response.interaction_figures import MEMBER, SECTION, resistance
from edesign.study.results.checked_members import checked_members

FRAME = """\
edesign: 1
title: Two columns
frame:
  bays: [6 m]
  storeys: [3.5 m]
  columns: [{lines: all, storeys: all, section: HEB300, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0.01}}
design: {partial_factors: {M0: 1.1, M1: 1.05}}
analyses: [{name: gravity, kind: gravity}]
"""


def test_the_curves_of_HEB300() -> None:
    """A 149.1 cm2, W_pl 1869 cm3, a = 1 - 2 x 30 x 1.9 / 149.1 = 0.2354: M_N = M_pl (1 - n) / (1 - a/2), 6.2.9.1(5).

    N_pl 3728 kN, M_pl 467.3 kN m. Against buckling chi_z is 0.826 of lambda_z 0.532, curve c: N_b 3225 kN
    (gamma_M1 1.05, A f_y / gamma_M1 = 3905 kN).
    """
    file = parse_project(FRAME, "frame.yaml", BuildingSections(), files=False)
    (column,) = checked_members(file, ["C_A_1"]).members
    section, member = resistance(column, SECTION), resistance(column, MEMBER)
    M_pl, N_pl = 1869e-6 * 275e6 / 1.1, 149.1e-4 * 275e6 / 1.1
    n = section[:, 1] / N_pl
    expected = np.minimum(M_pl, M_pl * (1.0 - n) / (1.0 - 0.5 * 0.2354))
    np.testing.assert_allclose(section[:-1, 0], expected[:-1], atol=1e-3 * M_pl)  # four digits
    assert section[-1] == pytest.approx([0.0, N_pl], rel=1e-3, abs=1.0)
    phi = 0.5 * (1.0 + 0.49 * (0.532 - 0.2) + 0.532**2)
    chi = 1.0 / (phi + (phi**2 - 0.532**2) ** 0.5)
    assert member[-1, 1] == pytest.approx(chi * 149.1e-4 * 275e6 / 1.05, rel=2e-3)
    assert np.all(np.diff(member[:, 0]) <= 0.0)
