"""IPN against the tables of a mill, and where tapered flanges are refused."""

from __future__ import annotations

import pytest
from building_examples import ANALYSED, SMALL, building, design_of

from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.section_lists import sections_of
from edesign.frame.sections.steel_section import steel_section
from edesign.frame.sections.tapered import tapered_names
from edesign.space.extract import frame_row, project_text
from edesign.space.nonlinear.build import build_building
from edesign.space.structure.geometry import space_frame

MILL = {
    "IPN80": (19.5, 77.8, 5.95),
    "IPN100": (34.2, 171.0, 8.32),
    "IPN120": (54.7, 328.0, 11.2),
    "IPN140": (81.9, 573.0, 14.4),
    "IPN160": (117.0, 935.0, 17.9),
    "IPN180": (161.0, 1450.0, 21.9),
    "IPN200": (214.0, 2140.0, 26.3),
    "IPN220": (278.0, 3060.0, 31.1),
    "IPN240": (354.0, 4250.0, 36.2),
    "IPN260": (442.0, 5740.0, 41.9),
    "IPN280": (542.0, 7590.0, 48.0),
    "IPN300": (653.0, 9800.0, 54.2),
    "IPN320": (782.0, 12510.0, 61.1),
    "IPN340": (923.0, 15700.0, 68.1),
    "IPN360": (1090.0, 19610.0, 76.2),
    "IPN380": (1260.0, 24010.0, 84.0),
    "IPN400": (1460.0, 29210.0, 92.6),
    "IPN450": (2040.0, 45850.0, 115.0),
    "IPN500": (2750.0, 68740.0, 141.0),
    "IPN550": (3610.0, 99180.0, 167.0),
    "IPN600": (4630.0, 139000.0, 199.0),
}
"""W_el,y cm3, I_y cm4 and mass kg/m: DIN 1025-1, as in a catalogue of ArcelorMittal, Perfiles y Barras Comerciales."""
WEAK = {"IPN240": 221.0, "IPN260": 288.0, "IPN280": 364.0, "IPN300": 451.0, "IPN320": 555.0}
"""I_z, cm4, of the same standard in other tables."""


@pytest.mark.parametrize("name", MILL)
def test_sections_of_the_mill(name: str) -> None:
    """I_y and W_el to 0.7 %, the mass to 1 %: the rounding of the tables, and of their masses to three digits."""
    modulus, inertia, mass = MILL[name]
    found = steel_section(name)
    assert 1e8 * found.I_y == pytest.approx(inertia, rel=7e-3)
    assert 1e6 * found.W_el_y == pytest.approx(modulus, rel=7e-3)
    assert found.mass == pytest.approx(mass, rel=1e-2)
    assert found.kind == "I" and found.has_class and not found.welded


@pytest.mark.parametrize("name", WEAK)
def test_weak_axis(name: str) -> None:
    assert 1e8 * steel_section(name).I_z == pytest.approx(WEAK[name], rel=1e-2)


def test_every_section_has_a_table() -> None:
    assert list(tapered_names()) == list(MILL)


def test_names() -> None:
    for written in ("IPN300", "IPN 300", "INP 300", "ipn-300"):
        assert steel_section(written).name == "IPN300"
    names = BuildingSections()
    assert names.canonical("IPN300") is None and names.canonical_in_building("INP 300") == "IPN300"
    assert "`IPN300`" in names.near("IPN310") and "elastic buildings alone" in names.near("IPN310")
    assert len(sections_of("IPN")) == len(MILL)


OLD = SMALL.replace("section: IPE300", "section: INP 300")


def test_design_with_tapered_beams() -> None:
    """They are checked as rolled I sections; M_Rd = W_pl f_y = 762 cm3 x 275 MPa = 209.5 kN m."""
    design = design_of(OLD)
    number = next(k for k, member in enumerate(design.frame.members) if member.name == "BX_1_1_1")
    assert design.frame.members[number].section == "IPN300"
    assert design.members.members[design.members.kinds[number]].constants.M_y_Rd == pytest.approx(209.5e3, rel=2e-3)
    assert number not in design.frame.unclassified


def test_fibres_and_plane_frames_are_refused() -> None:
    made = building(OLD)
    with pytest.raises(InputError, match="tapered flanges, which frames in a plane"):
        project_text(frame_row(made, space_frame(made), "X2"))
    with pytest.raises(InputError, match="tapered flanges, whose fibres are not"):
        build_building(building(ANALYSED.replace("section: IPE300", "section: IPN300")))
