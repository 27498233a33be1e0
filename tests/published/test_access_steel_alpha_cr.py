"""Sway stability of the two-storey frame of Access Steel SX006a, Example: Calculation of alpha-cr.

Two bays of 6 m, two storeys of 3.5 m, columns HEB200, beams IPE400 under 38.9 kN/m. Published: phi = 1/324, forces of
1.44 kN a floor, alpha_cr of the frame 27.06 with rigid and 6.79 with pinned bases, by the storey formula 8.06 there.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import bending_only, building, design_of, portals

from edesign.space.analysis.sway import critical_factors
from edesign.space.elastic_design import elastic_design

FRAME = (
    portals(x="6 m, 6 m", y="3 m", storeys="3.5 m, 3.5 m", beam="IPE400", fy="235 MPa", G="38.9 kN/m")
    + "  partial_factors: {G: 1.0}\n"
)


@pytest.mark.parametrize(("bases", "published"), [("fixed", 27.06), ("pinned", 6.79)])
def test_alpha_cr(bases: str, published: float) -> None:
    """Bending alone, as the published frame has it: within 0.7 %, fixed below and pinned above.

    With shear deformation, as `run` has it, 25.20 and 6.66: at 11.8 MN N / G A_s of the middle column is 6 %. The
    storey formula's 8.06 is 19 % above the frame. A factor from 10 on is exact within 2 %.
    """
    of = building(FRAME, ("supports: fixed", f"supports: {bases}"))
    found = elastic_design(of)
    frame, model, _ = bending_only(of)
    modes = model.modes(frame.node_mass)
    axial = np.zeros(len(frame.members))
    axial[frame.columns] = found.static.internal[0, frame.columns, 3, 0]
    assert critical_factors(model, modes, axial, frame.node_mass, frame.level_of_nodes)[0] == pytest.approx(
        published, rel=0.007
    )
    assert found.sway.alpha_cr[0, 0] == pytest.approx({"fixed": 25.20, "pinned": 6.66}[bases], abs=0.005)


def test_initial_sway_and_its_forces() -> None:
    """phi = 1/324 and 1.44 kN a floor and frame, to the digits printed; three columns, of which all count."""
    sway = design_of(FRAME).sway
    phi = sway.initial_sway[0, 0]
    assert round(1.0 / phi) == 324
    assert phi * 38.9 * 12.0 == pytest.approx(1.44, abs=0.005)
