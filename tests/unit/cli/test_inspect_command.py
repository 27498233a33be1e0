"""`edesign inspect`: what it proposes reads the file, and what the file does not say is asked."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import yaml
from support.messages import says

from edesign.cli.main import main
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.property_table import write_property_table
from edesign.damper.thesis_tables import measured
from edesign.errors import InputError
from edesign.ground_motion.sources import find_suite
from edesign.ground_motion.suite import load_suite

SPECIMEN = "specimen: {name: p, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}\n"
TIMES = [0.01 * i for i in range(40)]
MOTION = [math.sin(0.3 * i) for i in range(40)]


def table(sign: str, point: str = ".", *, force: bool = True) -> str:
    lines = [
        sign.join(f"{value:.6f}" for value in ((t, 5.0 * u, 4.0 * u + 1.0) if force else (t, u)))
        for t, u in zip(TIMES, MOTION, strict=True)
    ]
    return "\n".join(lines).replace(".", point) + "\n"


def account(path: Path, capsys: pytest.CaptureFixture[str]) -> dict[str, object]:
    assert main(["inspect", str(path), "--json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("Time (sec),Stroke (mm),Load (kN)\n" + table(","), "utf-8"),
        ("Time,Displacement,Force\n(s),(mm),(kN)\n" + table(","), "utf-8"),
        (
            "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n\nStation Name: frame\nTime\tAxial Displacement\tAxial Force\n"
            "Sec\tmm\tkN\n" + table("\t", ","),
            "utf-16",
        ),
        ("Prüfzeit (s);Weg (mm);Kraft (kN)\n" + table(";", ","), "latin-1"),
        ("时间(秒),位移(毫米),力(千牛)\n" + table(","), "gbk"),
        ("  Time (s)   Axial Stroke (mm)  Axial Load (kN)\n" + table("  "), "utf-8"),
    ],
)
def test_the_campaign_that_is_proposed_reads_the_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, encoding: str
) -> None:
    path = tmp_path / "export 1.csv"
    path.write_bytes(text.encode(encoding))
    found = account(path, capsys)
    assert found["taken_for"] == "test of a damper" and found["questions"] == ["What was the ambient temperature?"]
    campaign = tmp_path / "campaign.yaml"
    campaign.write_text(SPECIMEN + str(found["yaml"]).replace("?", "20"), encoding="utf-8")
    (test,) = load_campaign(campaign).tests
    np.testing.assert_allclose(test.time, TIMES, atol=1e-12)
    np.testing.assert_allclose(test.displacement, [5e-3 * u for u in MOTION], atol=0.51e-9)  # six digits of mm
    np.testing.assert_allclose(test.force, [4e3 * u + 1e3 for u in MOTION], atol=0.51e-3)


@pytest.mark.parametrize(
    ("text", "unit", "asked"),
    [
        ("0 .1 .2 .3 .4\n.5 .6 .7 .8 .9\n", None, 3),
        ("Time (s),Acc (g)\n" + table(",", force=False), "g", 0),
        ("Station 7\nt;a\ns;cm/s2\n" + table(";", ",", force=False), "cm/s^2", 0),
        (table(",", force=False), None, 1),
        ("t,ns,acc_g\n" + table(","), "g", 0),
        ("0.1\n0.2\n0.3\n", None, 2),
    ],
)
def test_the_record_that_is_proposed_is_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, unit: str | None, asked: int
) -> None:
    path = tmp_path / "shake.txt"
    path.write_text(text)
    found = account(path, capsys)
    questions = found["questions"]
    assert found["taken_for"] == "record" and isinstance(questions, list) and len(questions) == asked
    proposed = str(found["yaml"]).replace("? s", "0.01 s").replace("?", "g")
    entry = yaml.safe_load(proposed)["records"]["shake"]
    assert unit is None or entry["acceleration_unit"] == unit
    suite = tmp_path / "suite.yaml"
    suite.write_text(yaml.safe_dump({"edesign_suite": 1, "title": "s", "records": [{"id": "a", **entry}]}))
    (recording,) = find_suite(load_suite(suite), (), False)
    assert recording.record.time_step == pytest.approx(0.01)
    count = len(text.split()) if ".1 .2" in text else sum(line[0] in "0123456789-" for line in text.splitlines())
    assert recording.record.acceleration.size == count


def test_the_account_for_people(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [(0.01 * i, 2.0 if i < 12 else 2.0 + math.sin(0.3 * (i - 11)), i) for i in range(40)]
    rows = rows[:20] + rows[23:]
    path = tmp_path / "a.csv"
    path.write_text("Time (s);Stroke (mm);Load\n" + "".join(f"{a:.2f};{b:.5f};{c}\n" for a, b, c in rows))
    assert main(["inspect", str(path)]) == 0
    said = capsys.readouterr().out
    assert "0.01 s, uneven, 0.39 s long; gaps before line 22" in said
    assert "12 samples (0.12 s) of rest before the motion" in said
    assert "the first sample is displaced by 2 mm" in said
    assert "- What is the unit of the force (column 3)?" in said and "units: {force: ?}" in said
    assert max(map(len, said.splitlines())) <= 120


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (SPECIMEN + "tests: []\n", "campaign E-FILE-05"),
        ("time_s;displacement_mm;force_kN\n0;0;0\n1;1,234;1\n2;2,345;3\n", ":2: `1,234` 1.234 1234? E-TABLE-09"),
        ("time_s,displacement_mm,force_kN\n0,0,0\n1,---,1\n", ":3, `---` E-TABLE-08"),
        ("", "E-REC-21"),
        ("nothing but words\nhere and there\n", "E-REC-01"),
    ],
)
def test_what_cannot_be_read(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, said: str) -> None:
    path = tmp_path / "a.txt"
    path.write_text(text)
    assert main(["inspect", str(path)]) == 2
    assert says(capsys.readouterr().err, f"a.txt {said}")


def test_each_component_of_a_recording_is_proposed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    columns = "".join(f"{t:10.3f}{u:10.3f}{2 * u:10.3f}{-u:10.3f}\n" for t, u in zip(TIMES, MOTION, strict=True))
    header = "#SampleRate(Hz): 100\n#AmplitudeUnit:  gal.\n#DataSequence: Time U(+); N(+); E(+)\n"
    path = tmp_path / "station.dat"
    path.write_text(header + columns)
    assert main(["inspect", str(path)]) == 0
    said = capsys.readouterr().out
    assert "CWB (Taiwan) text" in said and f"edesign spectrum {path} --component U" in " ".join(said.split())
    records = yaml.safe_load(said[said.index("records:") :])["records"]
    assert [record["component"] for record in records.values()] == ["U", "N", "E"]


def test_a_property_table_is_no_record(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "moduli.csv"
    write_property_table(measured(), path)
    found = account(path, capsys)
    assert found["taken_for"] == "property table" and found["questions"] == []
    assert [one["quantity"] for one in found["columns"]][:2] == ["temperature", "shear strain"]  # type: ignore[attr-defined, index]
    assert yaml.safe_load(str(found["yaml"])) == {"designs": {"NAME": {"properties": {"file": "moduli.csv"}}}}
    path.write_text(path.read_text(encoding="utf-8").replace("loss_factor", "loss"), encoding="utf-8")
    assert main(["inspect", str(path)]) == 2
    assert says(capsys.readouterr().err, "moduli.csv `loss` E-PROPS-04")


def test_zero_has_no_sign(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "record.csv"
    path.write_text(
        "t,a\n" + "".join(f"{0.01 * i:.2f},{-0.0 if i < 9 else 1e-3}\n" for i in range(12)), encoding="utf-8"
    )
    assert main(["inspect", str(path)]) == 0
    assert "-0 " not in capsys.readouterr().out.replace("\n", " \n")


def export(header: str, tail: str = "", above: str = "") -> str:
    return above + header + "\n" + "".join(f"{row}{tail}\n" for row in table(",").splitlines())


UNKNOWN = "Alpha,Beta,Gamma"
SAID = "    columns: {time: 1, displacement: 2, force: 3}\n    units: {time: s, displacement: mm, force: kN}\n"


@pytest.mark.parametrize(
    "text",
    [
        export(UNKNOWN, above="Machine: M\nDate,2024-01-01\nArea,1200\nRig,a,b,c\n"),
        export(UNKNOWN + "\ns,mm,kN"),
        export(UNKNOWN + ",\n(s),(mm),(kN),", ","),
        export(UNKNOWN + ",", ","),
        export(UNKNOWN, ",,", above="Machine: M\n").replace("Gamma", "Gamma,,"),
    ],
)
def test_what_a_campaign_reads_is_inspected_under_unknown_names_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str
) -> None:
    """Headers and rows are those that the campaign has, and both have the numbers that were written."""
    (tmp_path / "a.csv").write_text(text)
    campaign = tmp_path / "campaign.yaml"
    campaign.write_text(SPECIMEN + "tests:\n  - file: a.csv\n    temperature: 20 degC\n" + SAID)
    try:
        (test,) = load_campaign(campaign).tests
    except InputError as error:  # then inspect says the same
        assert main(["inspect", str(tmp_path / "a.csv")]) == 2
        assert str(error).partition(": ")[2] in capsys.readouterr().err
        return
    np.testing.assert_allclose(test.force, [4e3 * u + 1e3 for u in MOTION], atol=0.51e-3)  # six digits of kN
    found = account(tmp_path / "a.csv", capsys)
    assert found["rows"] == len(TIMES)
    headers = [one["header"].partition(" ")[0] for one in found["columns"]]  # type: ignore[attr-defined]
    assert headers == UNKNOWN.split(",")
    questions = found["questions"]
    assert isinstance(questions, list) and any("displacement" in question for question in questions)


def test_of_two_channels_that_may_be_meant_it_is_asked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.csv"
    for header, quantity, which in (
        ("Time (s),Stroke (mm),LVDT (mm),Load (kN)", "displacement", "2 (`Stroke (mm)`) or 3 (`LVDT (mm)`)"),
        ("Time (s),Position (mm),Load (kN),Force (kN)", "force", "3 (`Load (kN)`) or 4 (`Force (kN)`)"),
        ("Time (s),Stroke (mm),Force (kN),Force A (kN)", "force", "3 (`Force (kN)`) or 4 (`Force A (kN)`)"),
    ):
        path.write_text(header + "\n" + "".join(f"{t},{u},{2 * u},{u}\n" for t, u in zip(TIMES, MOTION, strict=True)))
        found = account(path, capsys)
        assert f"Which column is the {quantity}: {which}? Say it by `columns`." in found["questions"]  # type: ignore[operator]
        assert f"{quantity}: ?" in str(found["yaml"])
    path.write_text("Time (s),Displacement (mm),Position (mm),Force (kN)\n1,2,3,4\n2,3,4,5\n")
    assert account(path, capsys)["questions"] == ["What was the ambient temperature?"]  # names decide it


def test_cells_of_columns_that_are_not_read_may_have_anything(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a.csv"
    lines = [f"{row},{'' if i % 3 else 'ok'}" for i, row in enumerate(table(",").splitlines())]
    path.write_text("Time (s),Stroke (mm),Load (kN),Note\n" + "\n".join(lines) + "\n")
    found = account(path, capsys)
    assert [one["smallest"] is None for one in found["columns"]] == [False, False, False, True]  # type: ignore[attr-defined]
    for said in ("", SAID):
        campaign = tmp_path / "campaign.yaml"
        campaign.write_text(SPECIMEN + "tests:\n  - file: a.csv\n    temperature: 20 degC\n" + said)
        (test,) = load_campaign(campaign).tests
        np.testing.assert_allclose(test.force, [4e3 * u + 1e3 for u in MOTION], atol=0.51e-3)
        assert test.unread == ("Note",)
    path.write_text(path.read_text().replace("0.010000,1.477601,", "0.010000,,", 1))
    assert main(["inspect", str(path)]) == 2
    assert says(capsys.readouterr().err, "column 2 (`Stroke (mm)`): E-TABLE-08")


def test_lines_above_repeated_headers_are_left_out_whatever_they_say(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a.csv"
    rows = table(",").splitlines(keepends=True)
    head = "Time (s),Stroke (mm),Load (kN)\n"
    path.write_text("Block 1\n" + head + "".join(rows[:20]) + "Cycle block 2\n" + head + "".join(rows[20:]))
    found = account(path, capsys)
    assert found["rows"] == len(TIMES) and found["form"]["repeated"] == 2  # type: ignore[index]
    path.write_text(head + "".join(rows[:20]) + "Cycle block 2\n" + head + "".join(rows[20:]))
    assert main(["inspect", str(path)]) == 2  # no line stood above the headers before
    assert says(capsys.readouterr().err, "a.csv:22: 1 3 E-TABLE-07")


def test_a_point_between_thousands_blames_its_own_cell(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.csv"
    path.write_text("Zeit (s);Weg (mm);Kraft (kN)\n0,00;0,100;100,5\n0,01;1,500;1.100,5\n0,02;1,600;90,5\n")
    assert main(["inspect", str(path)]) == 2
    assert says(capsys.readouterr().err, f"{path}:3, column 3: `1.100,5` E-TABLE-09")
