"""Buckling lengths of members by group and storey, against N_b,Rd of EN 1993-1-1, 6.3.1 written out."""

from __future__ import annotations

import math

import pytest
from building_examples import building, design_of, number_of
from test_own_load_cases import BRACED

from edesign.core.member_checks import Check
from edesign.errors import InputError
from edesign.space.checks.rules import brace_slenderness

PLACES = "  members: {buckling_length: {places: [{kind: braces, groups: [D2], y: 0.5, z: 0.5}]}}\n  serviceability:"


def test_crosses_joined_in_the_middle_buckle_over_half_of_their_length() -> None:
    """SHS100x5 of 275 MPa: i = 38.6 mm, L = 7.211 m: lambda = 7211 / (38.6 pi sqrt(E / fy)) = 2.15, and half of it.

    EN 1998-1, 6.7.3(1) asks for 1.3 to 2.0: of the whole length above it.
    """
    design = design_of(BRACED.replace("  serviceability:", PLACES))
    section = design.frame.section("SHS100x5")
    whole = math.sqrt(52.0) / (math.sqrt(section.I_y / section.A) * math.pi * math.sqrt(210e9 / 275e6))
    numbers = [number_of(design.frame, name) for name in ("DX_1_1_1_r", "DY_A_1_1_r")]
    assert brace_slenderness(design.building, design.frame, numbers) == pytest.approx([whole, 0.5 * whole])


def test_braces_in_compression_by_group() -> None:
    """N_b,Rd by curve a of hot finished hollow sections: chi = 1 / (Phi + sqrt(Phi2 - lambda2)), alpha = 0.21."""
    text = BRACED.replace("kind: cross, section", "kind: cross, compression: true, section")
    bare, half = design_of(text), design_of(text.replace("  serviceability:", PLACES))
    section = bare.frame.section("SHS100x5")

    def chi(factor: float) -> float:
        slender = factor * math.sqrt(52.0) / (math.sqrt(section.I_y / section.A) * math.pi * math.sqrt(210e9 / 275e6))
        Phi = 0.5 * (1.0 + 0.21 * (slender - 0.2) + slender**2)
        return 1.0 / (Phi + math.sqrt(Phi**2 - slender**2))

    column = list(Check).index(Check.N_B)
    for name, ratio in (("DY_A_1_1_r", chi(0.5) / chi(1.0)), ("DX_1_1_1_r", 1.0)):
        number = number_of(bare.frame, name)
        of_kinds = [design.members.members[design.members.kinds[number]].stability for design in (bare, half)]
        assert of_kinds[0].L_cr_y == pytest.approx(math.sqrt(52.0))
        use = [float(design.members.utilisation[number, column]) for design in (bare, half)]
        assert use[0] / use[1] == pytest.approx(ratio, rel=1e-3)  # Omega of the other braces stays


def test_later_entries_override_earlier_ones_and_storeys_count() -> None:
    lengths = building(
        BRACED.replace(
            "  serviceability:",
            "  members: {buckling_length: {columns: {y: 1.2}, places: [{storeys: 1, z: 0.8}, {kind: columns, y: 2}]}}\n"
            "  serviceability:",
        )
    ).design.members.buckling_length  # type: ignore[union-attr]
    assert (lengths.of("column", "C1", 1).y, lengths.of("column", "C1", 1).z) == (2.0, 1.0)
    assert (lengths.of("brace", "D1", 1).z, lengths.of("brace", "D1", 2).z) == (0.8, 1.0)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("{groups: [D9], y: 0.5}", r"no group `D9`.*D1"),
        ("{storeys: 2, y: 0.5}", "storey"),
        ("{kind: brace, y: 0.5}", "braces"),
        ("{y: 1e6}", "E-UNIT-03"),
    ],
)
def test_refused(entry: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        building(
            BRACED.replace(
                "  serviceability:", f"  members: {{buckling_length: {{places: [{entry}]}}}}\n  serviceability:"
            )
        )
