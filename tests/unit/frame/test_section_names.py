"""Names of sections as engineers write them, against the standards and tables that give them."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import pytest

import edesign
from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.profiles import profile, profile_names
from edesign.frame.sections.section_names import SectionName
from edesign.frame.sections.steel_section import steel_section
from edesign.project import ProjectError

INCH, POUND_PER_FOOT = 0.0254, 0.45359237 / 0.3048  # m, kg/m


@pytest.mark.parametrize(
    ("written", "name"),
    [
        *[(text, "HEB300") for text in ("HEB300", "HE300B", "HE 300 B", "HE-300-B", "HEB 300", "heb-300", "he300b")],
        *[(text, "HEB300") for text in ("HE B 300", "IPB 300", "IPB300", "HE\u00a0300\u00a0B", " HE 300 B ")],
        ("HE 300 A", "HEA300"),
        ("IPBl 300", "HEA300"),
        ("HE300M", "HEM300"),
        ("IPBv 300", "HEM300"),
        *[(text, "IPE400") for text in ("IPE 400", "IPE-400", "ipe_400")],
        *[(text, "HD320x127.0") for text in ("HD320x127", "HD 320 X 127", "HD320×127,0", "HD-320*127.0")],
        *[(text, "UB457x191x67") for text in ("UB 457x191x67", "457x191x67 UB", "457 × 191 UB 67", "UKB457x191x67")],
        ("UC 203 x 203 x 46", "UC203x203x46"),
        ("UKBP 305x305x79", "UBP305x305x79"),
        *[(text, "W360x370x134") for text in ("W14x90", "W 14 X 90", "w14×90", "W360x134", "W 360 x 370 x 134")],
        ("W16x36", "W410x180x53"),  # not the lighter W410x140x53.3
        ("W14X38", "W360x170x58"),
        ("W360x57.8", "W360x170x58"),  # as AISC and as the catalogue round it
        ("W410x39", "W410x140x38.8"),
    ],
)
def test_the_usual_spellings(written: str, name: str) -> None:
    assert profile_names().canonical(written) == name
    assert profile(written) is profile(name)


@pytest.mark.parametrize("name", ["HE300AA", "IPE 300 A", "HE300", "UB457x67", "W360x371x134", "W14", "", "x"])
def test_no_other_section_takes_the_place_of_one_that_is_missing(name: str) -> None:
    assert profile_names().canonical(name) is None


def test_every_name_of_the_catalogue_is_its_own_and_no_two_are_one() -> None:
    names = profile_names()
    assert all(names.canonical(name) == name for name in names)
    for spelled in (str.lower, lambda name: name.replace("x", " × "), lambda name: name.replace(".", ",")):
        assert [names.canonical(spelled(name)) for name in names] == list(names)
    assert len({SectionName.of(name) for name in names}) == len(names)


def test_w_shapes_are_those_of_the_american_tables() -> None:
    """All 288 W shapes that both have: published values beside the section that the inch-pound name gives.

    The mass in a metric name is that of the metric table, at most 1.5 kg/m from the pounds per foot of the other name.
    Depths and widths are rounded to three digits there (0.5 %) and in the catalogue to whole mm; some areas are 2 %
    smaller, between those of the catalogue with its fillets and without.

    Source: AISC Shapes Database v16.0 (aisc_w_shapes.csv).
    """
    with (Path(__file__).parent / "aisc_w_shapes.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert len(rows) == 288
    found = set()
    for row in rows:
        name = profile_names().canonical(row["name"])
        assert name is not None and name.startswith("W")
        shape, found_here = profile(name), steel_section(name)
        assert shape.h == pytest.approx(INCH * float(row["d [in]"]), rel=0.008), row["name"]
        assert shape.b == pytest.approx(INCH * float(row["bf [in]"]), rel=0.01), row["name"]
        assert found_here.A == pytest.approx(INCH**2 * float(row["A [in2]"]), rel=0.025), row["name"]
        assert found_here.I_y == pytest.approx(INCH**4 * float(row["Ix [in4]"]), rel=0.03), row["name"]
        assert found_here.I_z == pytest.approx(INCH**4 * float(row["Iy [in4]"]), rel=0.03), row["name"]
        assert found_here.W_pl_y == pytest.approx(INCH**3 * float(row["Zx [in3]"]), rel=0.03), row["name"]
        pounds = float(row["name"].partition("x")[2])
        assert float(name.rpartition("x")[2]) == pytest.approx(POUND_PER_FOOT * pounds, rel=0.003, abs=1.5), row["name"]
        found.add(name)
    assert len(found) == len(rows)


@pytest.mark.parametrize(
    ("written", "name", "printed"),
    [
        ("HSS8X8X1/2", "HSS8x8x0.5", (13.5, 125.0, 125.0, 37.5, 37.5, 204.0)),
        ("HSS8x6x.500", "HSS8x6x0.5", (11.6, 98.2, 62.5, 30.5, 24.9, 127.0)),
        ("hss 6 x 10 x 1/2", "HSS10x6x0.5", (13.5, 171.0, 76.8, 43.0, 30.1, 176.0)),
    ],
)
def test_american_hollow_sections_have_their_printed_properties(
    written: str, name: str, printed: tuple[float, ...]
) -> None:
    """A in2, I_x and I_y in4, Z_x and Z_y in3, J in4; printed in three digits, J by another formula (1 %).

    Source: AISC Steel Construction Manual, 14th ed., Tables 1-11 and 1-12; walls count with 0.93 of the nominal
        thickness.
    """
    assert BuildingSections().canonical(written) == name
    assert BuildingSections().canonical(name) == name
    of = steel_section(name)
    found = [of.A / INCH**2, of.I_y / INCH**4, of.I_z / INCH**4, of.W_pl_y / INCH**3, of.W_pl_z / INCH**3]
    assert found == pytest.approx(printed[:5], rel=5e-3)
    assert of.I_t / INCH**4 == pytest.approx(printed[5], rel=0.01)


def test_round_american_sections_have_two_sizes() -> None:
    of, t = steel_section("HSS6.625x0.280"), 0.93 * 0.280
    assert (of.kind, of.A / INCH**2) == ("CHS", pytest.approx(math.pi * t * (6.625 - t)))


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("HSS203.2x203.2x12.7", "sizes of HSS are in inches"),
        ("HSS8", "two or three sizes"),
        ("HSS8x8x1/0", "two or three sizes"),
        ("HSS4x4x2", "sizes of HSS are in inches"),
    ],
)
def test_names_that_are_no_american_section_say_how_they_are_written(name: str, message: str) -> None:
    assert BuildingSections().canonical(name) is None
    assert message in BuildingSections().near(name)


def test_properties_are_those_of_the_european_table() -> None:
    """EN 10365: A cm2, I_y cm4, I_z cm4, W_pl,y cm3, mass kg/m, in four digits (five of I_y)."""
    for name, printed in {
        "IPE300": (53.81, 8356, 603.8, 628.4, 42.2),
        "HEA200": (53.83, 3692, 1336, 429.5, 42.3),
        "HEB300": (149.1, 25170, 8563, 1869, 117),
        "HEM300": (303.1, 59200, 19400, 4078, 238),
    }.items():
        found = steel_section(name)
        values = (1e4 * found.A, 1e8 * found.I_y, 1e8 * found.I_z, 1e6 * found.W_pl_y, found.mass)
        assert values == pytest.approx(printed, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("HEB305", "of HEB the catalogue has near it `HEB280`, `HEB300`, `HEB320`, `HEB340`"),
        ("HE 305 B", "of HEB the catalogue has near it `HEB280`, `HEB300`, `HEB320`, `HEB340`"),
        ("L100x10", r"the catalogue has no L sections \(it has IPE, HEA, HEB, HEM, HD, HP, UB, UBP, UC, W\)"),
        ("HE300AA", "the catalogue has no HEAA sections"),
        ("W14x91", "of W the catalogue has near it `W14x109`, `W14x99`, `W14x90`, `W14x82`"),
        ("UB457x191x70", "of UB .* near it `UB457x191x89`, `UB457x191x82`, `UB457x191x74`, `UB457x191x67`"),
        ("HEB26O", "did you mean `HEB260`"),
        ("column", "the catalogue has IPE, .*, written like `HEB450`"),
        ("HEB0", "of HEB the catalogue has near it `HEB100`"),
    ],
)
def test_a_name_that_is_missing_offers_its_own_family_alone(name: str, message: str) -> None:
    with pytest.raises(InputError, match=f"there is no section `{name}`; {message}"):
        profile(name)


def test_a_project_has_the_catalogue_s_own_names(tmp_path: Path) -> None:
    path = edesign.new_project(tmp_path / "frame")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("HEB240", "HE 240 B").replace("IPE330", "W14x38"), encoding="utf-8")
    members = edesign.load_project(path).frame.members
    assert (members["C_A_1"].section, members["B_1_1"].section) == ("HEB240", "W360x170x58")
    own = "sections:\n  W14x38: {height: 0.4 m, width: 0.2 m, flange: 20 mm, web: 10 mm}\n"
    path.write_text(text.replace("IPE330", "W14x38") + own, encoding="utf-8")
    assert edesign.load_project(path).frame.members["B_1_1"].section == "W14x38"  # own sections go before
    path.write_text(text.replace("HEB240", "HE265B"), encoding="utf-8")
    with pytest.raises(ProjectError, match=r"there is no section `HE265B`; of HEB the catalogue has near it `HEB240`"):
        edesign.load_project(path)


def test_other_mistakes_of_a_file_do_not_make_its_section_names_unknown(tmp_path: Path) -> None:
    path = edesign.new_project(tmp_path / "frame")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("HEB240", "HE 240 B").replace("title:", "titel:"), encoding="utf-8")
    with pytest.raises(ProjectError) as error:
        edesign.load_project(path)
    assert "titel" in str(error.value) and "no section" not in str(error.value)
