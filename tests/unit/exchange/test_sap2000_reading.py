"""SAP2000's text as files of edesign: what is taken, in which encodings, and what is refused in words."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from unit.exchange.sap2000_texts import FRAME, changed, with_table

from edesign.errors import EdesignError, InputError
from edesign.exchange.sap2000.tables import read_tables
from edesign.exchange.sap2000.translate import take_model
from edesign.frame.loads import beam_loads, node_loads
from edesign.frame.masses import node_masses
from edesign.frame.project_file import load_project
from edesign.project.actions.loads import Combination
from edesign.project.project import Project

Take = Callable[..., tuple[Project, tuple[str, ...]]]
COLUMN = 0.01491 * 77e3  # N/m
BEAM = 0.008446 * 77e3


@pytest.fixture()
def take(tmp_path: Path) -> Take:
    def of(text: str | bytes) -> tuple[Project, tuple[str, ...]]:
        source, target = tmp_path / "model.s2k", tmp_path / "model.yaml"
        source.write_bytes(text if isinstance(text, bytes) else text.encode())
        found = take_model(source, target)
        target.write_text(found.text)
        return load_project(target), found.left_out

    return of


def refusal(text: str | bytes, folder: Path) -> str:
    """The message on a text that is refused, without the folder."""
    source = folder / "model.s2k"
    source.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InputError) as caught:
        take_model(source, folder / "model.yaml")
    return str(caught.value).replace(f"{folder}/", "")


def test_what_is_taken_of_a_portal(take: Take) -> None:
    """The rolled sections of EN 10365, supports, loads with the self weight, and the masses of the loads."""
    project, left_out = take(FRAME)
    frame = project.frame
    assert (frame.bay_widths, frame.storey_heights) == ((6.0,), (4.0,))
    assert {run.section for run in frame.members.values()} == {"HEB300", "IPE400"}
    assert [frame.support(line) for line in "AB"] == ["fixed", "pinned"]
    permanent, variable = (beam_loads(project, Combination(G=G, Q=Q))["B_1_1"] for G, Q in ((1, 0), (0, 1)))
    assert permanent.uniform == pytest.approx(20e3 + BEAM, rel=1e-11)
    assert variable.parts == [pytest.approx((0.25, 0.75, 4e3, 6e3))]
    assert node_loads(project, Combination(G=1, Q=0))["A1"] == pytest.approx(50e3 + 2.0 * COLUMN, rel=1e-11)
    # the part between 1.5 and 4.5 m has its centre of load at 3.1 m of 6 m
    expected = (50e3 + 2.0 * COLUMN + 3.0 * (20e3 + BEAM) + 0.3 * 15e3 * (1 - 3.1 / 6.0)) / 9.80665
    assert node_masses(project)["A1"] == pytest.approx(expected, rel=1e-11)
    assert len(left_out) == 4
    for sentence, start in zip(
        left_out,
        (
            "load pattern WIND of the type Wind: 1 load",
            "there is no case of the gravity loads before the modes: G counts fully, Q with 0.3",
            "4.59228 kN on joints at the base",
            "table PREFERENCES - DIMENSIONAL: 1 record",
        ),
        strict=True,
    ):
        assert sentence.startswith(start)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_encodings_and_ends_of_lines(take: Take, encoding: str, ends: str) -> None:
    text = with_table(FRAME, "PROJECT INFORMATION", 'Item="Project Name"   Data="Bürogebäude"').replace("\n", ends)
    project, _ = take(text.encode(encoding))
    assert project.title == "Bürogebäude"


@pytest.mark.parametrize(
    ("units", "length", "force"),
    [("Kip, ft, F", 0.3048, 4448.2216152605), ("Lb, in, F", 0.0254, 4.4482216152605), ("N, mm, C", 1e-3, 1.0),
     ("Kgf, cm, C", 1e-2, 9.80665), ("Tonf, m, C", 1.0, 9806.65)],
)  # fmt: skip
def test_units(take: Take, units: str, length: float, force: float) -> None:
    """NIST SP 811: foot and inch, pound-force, kilogram-force; SAP2000's Tonf is metric."""
    E, G = 2.1e11 / force * length**2, 275e6 / force * length**2
    text = changed(
        FRAME, ("KN, m, C", units), ("E1=210000000", f"E1={E!r}"), ("Fy=275000", f"Fy={G!r}"),
        ("Area=0.01491", f"Area={0.01491 / length**2!r}"), ("I33=0.0002517", f"I33={0.0002517 / length**4!r}"),
        ("Area=0.008446", f"Area={0.008446 / length**2!r}"), ("I33=0.0002313", f"I33={0.0002313 / length**4!r}"),
        ("SelfWtMult=1", "SelfWtMult=0"),
    )  # fmt: skip
    text = re.sub(r"\b(XorR|Z)=([46])\b", lambda m: f"{m[1]}={float(m[2]) / length!r}", text)
    project, _ = take(text)
    assert project.frame.bay_widths[0] == pytest.approx(6.0, rel=1e-11)
    assert project.materials["S275"].E == pytest.approx(2.1e11, rel=1e-11)
    assert node_loads(project, Combination(G=1, Q=0))["A1"] == pytest.approx(50.0 * force, rel=1e-11)


def test_a_plane_frame_with_other_things_of_the_plane(take: Take) -> None:
    """Weak axes, releases, springs, diaphragms, P-Delta and the gravity case."""
    text = changed(
        FRAME, ("U1=Yes   U2=Yes   U3=Yes   R1=No   R2=No   R3=No", "U1=No   U2=Yes   U3=Yes   R1=No   R2=No   R3=No")
    )
    text = with_table(text, "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "Frame=c1   Angle=-90   AdvanceAxes=No")
    text = with_table(text, "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", "Joint=2   CoordSys=Local   U1=5000   R2=700")
    text = with_table(
        text, "FRAME RELEASE ASSIGNMENTS 1 - GENERAL", "Frame=b1   M3I=No   M2J=Yes   M3J=Yes   PartialFix=No"
    )
    text = with_table(text, "CONSTRAINT DEFINITIONS - DIAPHRAGM", "Name=D1   CoordSys=GLOBAL   Axis=Z")
    text = with_table(text, "JOINT CONSTRAINT ASSIGNMENTS", "Joint=3   Constraint=D1", "Joint=4   Constraint=D1")
    text = with_table(
        text,
        "LOAD CASE DEFINITIONS",
        "Case=PD   Type=NonStatic   InitialCond=Zero",
        "Case=M   Type=LinModal   InitialCond=PD",
    )
    text = with_table(text, "CASE - STATIC 4 - NONLINEAR PARAMETERS", "Case=PD   GeoNonLin=P-Delta")
    load = 'Case=PD   LoadType="Load pattern"   LoadName={}   LoadSF={}'
    text = with_table(text, "CASE - STATIC 1 - LOAD ASSIGNMENTS", load.format("DEAD", 1), load.format("LIVE", 0.5))
    project, _ = take(text)
    frame = project.frame
    assert (frame.column_at["A", 1].axis, frame.column_at["B", 1].axis) == ("weak", "strong")
    assert frame.released == {"B_1_1": (False, True)}
    support = frame.support("B")
    assert not isinstance(support, str) and (support.horizontal, support.rotation) == (5e6, 7e5)  # type: ignore[union-attr]
    assert frame.diaphragm_floors == (1,)
    assert project.elements.geometry.columns == "p_delta"
    assert (project.loads.gravity.G, project.loads.gravity.Q) == (1.0, 0.5)


BEAM_LINE = "Frame=b1   JointI=3   JointJ=4   IsCurved=No"
REFUSED = {
    "no units": ('   CurrUnits="KN, m, C"', "", "E-SAP-04"),
    "other units": ("KN, m, C", "KN, mile, C", "4: PROGRAM CONTROL: .*E-SAP-04"),
    "no number": ("XorR=6   Y=0   Z=4", "XorR=6   Y=0   Z=four", "JOINT COORDINATES: `Z=four`.*E-SAP-03"),
    "too large": ("XorR=6", "XorR=6e99", "`XorR=6e99`.*E-SAP-03"),
    "no such joint": ("JointJ=4 ", "JointJ=44 ", "CONNECTIVITY - FRAME: `JointJ=44`.*E-SAP-05"),
    "twice": (BEAM_LINE, f"{BEAM_LINE}\n   {BEAM_LINE}", "Frame b1 .*E-SAP-06"),
    "inclined column": ("XorR=6   Y=0   Z=4", "XorR=6.2   Y=0   Z=4", "frame c2: .* 0.2 m .*E-SAP-16"),
    "sloping beam": ("XorR=6   Y=0   Z=4", "XorR=6   Y=0   Z=4.3", "frame b1: .* 0.3 m .*E-SAP-16"),
    "curved": (BEAM_LINE, BEAM_LINE.replace("No", "Yes"), "frame b1 .*E-SAP-12"),
    "horizontal": ("F1=0   F2=0   F3=-50", "F1=3   F2=0   F3=-50", "joint 3 .*E-SAP-25"),
    "cut off": ("END TABLE DATA\n", "", "E-SAP-02"),
    "no field": ("JointI=4   JointJ=2   ", "JointI 4 ", "`JointI 4 IsCurved=No` .*E-SAP-03"),
    "no section": (' AnalSect="IPE 400"', " AnalSect=IPE40", "`AnalSect=IPE40`: .*E-SAP-05"),
    "modifier": ("AS2=0.0033", "AS2=0.0033   I3Mod=0.5", "section HEB300: .*`I3Mod` .*E-SAP-12"),
}
TABLES = {
    "CONNECTIVITY - AREA": ("Area=1   NumJoints=4   Joint1=1", "E-SAP-11"),
    "FRAME SPRING ASSIGNMENTS": ("Frame=b1   Type=Simple", "E-SAP-11"),
    "JOINT LOADS - GROUND DISPLACEMENT": ("Joint=1   LoadPat=DEAD   U3=0.01", "E-SAP-11"),
    "FRAME PROPERTY MODIFIERS": ("Frame=b1   AMod=1   I33Mod=0.35", "frame b1: .*`I33Mod` .*E-SAP-12"),
    "FRAME TENSION AND COMPRESSION LIMITS": ("Frame=b1   TensLimit=No   CompLimit=Yes", "frame b1 .*E-SAP-12"),
    "FRAME OFFSET ALONG LENGTH ASSIGNMENTS": ("Frame=b1   LengthI=0.2   RigidFact=1", "frame b1 .*E-SAP-12"),
    "FRAME RELEASE ASSIGNMENTS 1 - GENERAL": ("Frame=b1   PI=Yes", "E-SAP-21"),
    "FRAME LOADS - POINT": ("Frame=c1   LoadPat=DEAD   Dir=X   RelDist=0.5   Force=1", "column c1 .*E-SAP-25"),
    "JOINT CONSTRAINT ASSIGNMENTS": ("Joint=3   Constraint=BODY1", "joint 3 .* BODY1.*E-SAP-14"),
}
"""Tables that would change the structure: a record, and what its message has."""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        *((changed(FRAME, (old, new)), said) for old, new, said in REFUSED.values()),
        *((with_table(FRAME, name, row), said) for name, (row, said) in TABLES.items()),
    ],
    ids=[*REFUSED, *TABLES],
)
def test_what_is_refused_says_table_line_and_part(text: str, said: str, tmp_path: Path) -> None:
    assert re.match(f"model.s2k:.*{said}]$", refusal(text, tmp_path))


TWICE = {
    "LOAD PATTERN DEFINITIONS": "LoadPat=DEAD   DesignType=Dead   SelfWtMult=0",
    "JOINT COORDINATES": "Joint=3   XorR=0   Y=0   Z=5",
    "JOINT RESTRAINT ASSIGNMENTS": "Joint=2   U1=No   U2=No   U3=Yes   R1=No   R2=No   R3=No",
    "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES": "Material=S275   E1=200000000",
    "FRAME SECTION PROPERTIES 01 - GENERAL": "SectionName=HEB300   Material=S275   Area=0.02",
    "MASS SOURCE": "MassSource=MSSSRC1   LoadPat=LIVE   Multiplier=0.6",
}


@pytest.mark.parametrize(("name", "row"), TWICE.items(), ids=TWICE)
def test_records_of_one_name_are_refused(name: str, row: str, tmp_path: Path) -> None:
    text = with_table(FRAME, name, row)
    line = 1 + text.split("\n").index(f"   {row}")
    key, part = next(field for field in row.split("   ") if not field.startswith("MassSource")).split("=")
    assert refusal(text, tmp_path) == f"model.s2k:{line}: {name}: {key} {part} is there twice [E-SAP-06]"


def test_all_records_of_an_old_mass_source_count(take: Take) -> None:
    """Up to version 15 each load pattern has a record: they make the masses of the same factors in newer files."""
    newer = node_masses(take(FRAME)[0])
    begin, end = (FRAME.index(words) for words in ('TABLE:  "MASS SOURCE"', "END TABLE DATA"))
    rows = "MassFrom=Loads   LoadPat=DEAD   Multiplier=1", "MassFrom=Loads   LoadPat=LIVE   Multiplier=0.3"
    older = with_table(FRAME[:begin] + FRAME[end:], "MASSES 1 - MASS SOURCE", *rows)
    assert node_masses(take(older)[0]) == pytest.approx(newer)


@pytest.mark.parametrize("text", ["", "nothing", "a: 1\n", b"\x89HDF\r\n\x1a\n", b"\x00" * 99, b"TABLE", '"' * 50])
def test_what_is_no_text_of_sap2000(text: str | bytes, tmp_path: Path) -> None:
    assert refusal(text, tmp_path).startswith("model.s2k")


def test_long_lines_come_back(tmp_path: Path) -> None:
    """A record of more than 240 characters is written in several lines, as SAP2000 does."""
    from edesign.exchange.sap2000.tables import written_tables

    record = {f"Field{k}": k + 0.5 for k in range(60)} | {"Name": 'a "b" c', "Flag": True}
    (tmp_path / "x.s2k").write_text(written_tables("File x", [("A TABLE", [record]), ("EMPTY", [])]))
    text = (tmp_path / "x.s2k").read_text()
    assert max(map(len, text.splitlines())) <= 242
    (row,) = read_tables(tmp_path / "x.s2k").of("A TABLE")
    assert [row.number(f"Field{k}") for k in range(60)] == [k + 0.5 for k in range(60)]
    assert (row.text("Name"), row.yes("Flag")) == ("a 'b' c", True)


JUNK = (
    "",
    "-1",
    "0",
    "1e400",
    "nan",
    "x",
    "Yes",
    "No",
    "1,5",
    "1.2.3",
    '"',
    "é",
    "\x00",
    "\x85",
    "1e29",
    "GLOBAL",
    "3",
    "b1",
)


def spoiled(text: str, rng: random.Random) -> str:
    """A text with one to three places changed, as editors, disks and people do."""
    lines = text.split("\n")
    for _ in range(rng.choice((1, 1, 2, 3))):
        k, how = rng.randrange(len(lines)), rng.randrange(7)
        fields = list(re.finditer(r'(\w+)=("[^"]*"|\S*)', lines[k]))
        if how == 0:
            del lines[k]
        elif how == 1:
            lines.insert(k, rng.choice(lines))
        elif how == 2:
            lines = lines[:k] or lines
        elif how in (3, 4) and fields:
            part = rng.choice(fields).span(rng.choice((1, 2, 2)))
            lines[k] = lines[k][: part[0]] + rng.choice(JUNK) + lines[k][part[1] :]
        else:
            at = rng.randrange(len(lines[k]) + 1)
            lines[k] = lines[k][:at] + rng.choice(('"', "=", "_", " _", "TABLE:", "\x00", "é")) + lines[k][at:]
        lines = lines or [""]
    return "\n".join(lines)


@pytest.mark.parametrize("seed", range(4))
def test_spoiled_files_end_in_a_message_or_a_file(seed: int, tmp_path: Path) -> None:
    """Of 4 times 60 files none ends in another way; thousands more were tried so by hand."""
    rng, source = random.Random(seed), tmp_path / "model.s2k"
    for _ in range(60):
        encoding = rng.choice(("utf-8", "utf-8", "utf-16", "cp1252"))
        source.write_bytes(spoiled(FRAME, rng).encode(encoding, "replace"))
        try:
            take_model(source, tmp_path / "model.yaml")
        except EdesignError as error:
            assert "model.s2k" in str(error)


def test_links_are_dampers_of_a_frame(take: Take, tmp_path: Path) -> None:
    text = with_table(FRAME, "LINK PROPERTY DEFINITIONS 01 - GENERAL", "Link=L   LinkType=Linear")
    text = with_table(text, "LINK PROPERTY DEFINITIONS 02 - LINEAR", "Link=L   DOF=U1   TransKE=900   TransCE=40")
    text = with_table(text, "CONNECTIVITY - LINK", "Link=1   JointI=1   JointJ=4")
    text = with_table(text, "LINK PROPERTY ASSIGNMENTS", "Link=1   LinkType=Linear   LinkProp=L")
    project, _ = take(text)
    assert project.dampers is not None
    assert project.dampers.laws["L"].parameters == {"k": "900 kN/m", "c": "40 kN*s/m"}
    assert project.dampers.devices[0].nodes == ("A0", "B1")  # type: ignore[union-attr]
    assert "# - links 1: their share of the gravity loads; dampers are set in under these" in project.text
    for field, joints in (("Mass", "masses"), ("Weight", "loads")):
        heavy = changed(text, ("LinkType=Linear\n", f"LinkType=Linear   {field}=0.5\n"))
        reported = refusal(heavy, tmp_path)
        assert f"link property L has a `{field}`" in reported and f"{joints} of joints [E-SAP-13]" in reported
    other = changed(
        text, ("LinkType=Linear\n", 'LinkType="Plastic (Wen)"\n'), ("DEFINITIONS 02 - LINEAR", "DEFINITIONS 10 - WEN")
    )
    assert re.search(r"link 1 .*`Plastic \(Wen\)`.*E-SAP-13", refusal(other, tmp_path))


def test_masses_at_joints_of_no_member_are_refused(tmp_path: Path) -> None:
    """A joint in the middle of a diaphragm, as older models have it."""
    text = changed(
        FRAME,
        ("Masses=No   Loads=Yes", "Masses=Yes   Loads=Yes"),
        ("   Joint=1   Coord", "   Joint=9   XorR=3   Y=0   Z=4\n   Joint=1   Coord"),
    )
    text = with_table(text, "JOINT ADDED MASS ASSIGNMENTS", "Joint=9   CoordSys=GLOBAL   Mass1=50   Mass2=50   Mass3=0")
    assert re.search("joint 9: .* .E-SAP-26]", refusal(text, tmp_path))


def without_table(name: str) -> str:
    """The text of the frame without a table."""
    before, _, after = FRAME.partition(f'TABLE:  "{name}"')
    return before + after[after.index("TABLE:") :] if "TABLE:" in after else before + "END TABLE DATA\n"


def test_missing_tables(tmp_path: Path) -> None:
    """Without supports nothing is written that `edesign check` would refuse; masses nobody asked for are reported."""
    file = tmp_path / "model.s2k"
    file.write_text(without_table("JOINT RESTRAINT ASSIGNMENTS"))
    with pytest.raises(InputError, match="E-SAP-07"):
        take_model(file, tmp_path / "model.yaml")
    file.write_text(without_table("MASS SOURCE"))
    assert any("no mass source" in line for line in take_model(file, tmp_path / "model.yaml").left_out)


def test_order_and_line_ends_do_not_matter(tmp_path: Path) -> None:
    """Joints in another order, tables in another order and the line ends of Windows make the same file."""
    file, target = tmp_path / "model.s2k", tmp_path / "model.yaml"
    file.write_text(FRAME)
    whole = take_model(file, target).text
    head, *tables = FRAME.removesuffix("\nEND TABLE DATA\n").split('TABLE:  "')
    joints = [line for line in FRAME.splitlines(keepends=True) if "CoordType" in line]
    last_first = "".join([head, *(f'TABLE:  "{table.rstrip()}\n\n' for table in reversed(tables)), "END TABLE DATA\n"])
    last_first = last_first.replace("".join(joints), "".join(reversed(joints)))
    file.write_bytes(last_first.replace("\n", "\r\n").encode())
    assert sorted(take_model(file, target).text.splitlines()) == sorted(whole.splitlines())
