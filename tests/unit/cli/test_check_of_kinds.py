"""`edesign check` of files that are no project: what it says is in them, and what may not be meant."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from building_examples import SMALL
from support.messages import says

from edesign.cli.main import main
from edesign.project.template import new_project

ROOT = Path(__file__).parents[3]
LAW = "type: zener\nparameters: {k0: 1 kN/mm, k1: 2 kN/mm, c1: 1 kN*s/mm}\n"
SPECIMEN = "specimen: {name: D1, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"


def shown(capsys: pytest.CaptureFixture[str], path: Path) -> str:
    assert main(["check", str(path)]) == 0
    said = capsys.readouterr()
    assert said.err == "" and said.out.splitlines()[-1].startswith("ok")
    return said.out


@pytest.fixture
def laboratory(tmp_path: Path) -> Path:
    return new_project(tmp_path / "laboratory", kind="laboratory").parent


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("projects/thesis_dampers/law.yaml", ["law: mgmm", "relaxation_branch.maxwell", "20 to 35 degC"]),
        ("projects/thesis_dampers/campaign.yaml", ["36 to fit to, 84 held out", "0.25 to 4 Hz"]),
        ("projects/thesis_substructure/rig.yaml", ["second_order, frequency 21.4 Hz, damping 0.4, delay 4.25 ms"]),
        ("projects/thesis_10_storey/reference.yaml", ["Table 5.8, mean response: 10 rows, 40 values, 40 with a bar"]),
        ("records/suites/thesis_table_5_6.yaml", ["recordings: 20: ", "warnings", "simulated here"]),
        ("edesign/damper/data/thesis_appendix_a.csv", ["120 rows", "10 to 50 % strain", "20 to 35 degC"]),
        ("edesign/codes/ec8/data/france.yaml", ["1, 2, 3, 4, 5 [m/s2]"]),
        ("tests/cases/records/motion.csv", ["401 rows", "acceleration_unit"]),
    ],
)
def test_what_is_in_a_file(file: str, said: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    output = " ".join(shown(capsys, ROOT / file).split())  # long lines are broken
    assert all(text in output for text in said), output


def test_tests_of_dampers(laboratory: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "7: 6 to fit to, 1 to validate" in shown(capsys, laboratory / "campaign.yaml")
    assert "7: 6 sine, 1 random" in shown(capsys, laboratory / "programme.yaml")
    test = laboratory / "tests" / "001_sine_10pct_1Hz_20C.csv"
    assert "test of a damper" in (output := shown(capsys, test)) and "displacement to 1.2 mm" in output
    lines = test.read_text().splitlines()
    turned = [lines[1], *(",".join((t, u, f"-{f}")) for t, u, f in (line.split(",") for line in lines[2:]))]
    test.write_text("\n".join(turned).replace("--", ""))
    output = shown(capsys, laboratory / "campaign.yaml")
    assert "001_sine_10pct_1Hz_20C: the damper gives energy" in output and "with 1 warning" in output
    assert "the damper gives energy" in shown(capsys, test)


def test_what_may_not_be_meant_of_a_campaign(laboratory: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = laboratory / "campaign.yaml"
    text = path.read_text().replace("12 mm", "0.12 mm").replace(", use: validate", "")
    path.write_text(text)
    output = shown(capsys, path)
    assert "a shear strain of 1000%" in output and "no test has `use: validate`" in output


def test_a_programme_with_few_samples(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "programme.yaml"
    tests = "sampling_rate: 45 Hz\ntests: [{type: sine, strain: 10 %, frequency: 3 Hz, temperature: 20 degC}]\n"
    path.write_text(f"{SPECIMEN}law: {{type: zener, parameters: {{k0: 1 kN/mm, k1: 2 kN/mm, c1: 1 kN*s/mm}}}}\n{tests}")
    assert "15 samples a cycle at 3 Hz" in shown(capsys, path)


def test_a_law_of_which_nobody_knows_the_tests(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "law.yaml"
    path.write_text(f"{LAW}standard_errors: {{k9: 1 N/m}}\n")
    output = shown(capsys, path)
    assert "`tested` is missing" in output and "k9: no parameter of zener" in output


def test_a_rig_without_limits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text("rig: {kind: delay, delay: 10 ms}\n")
    assert "no `limits`" in shown(capsys, path)


def test_a_record_and_its_warnings(laboratory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    frame = new_project(tmp_path / "frame").parent
    record = frame / "records" / "simulated_4.AT2"
    assert "PGA 0.206 g" in shown(capsys, record)
    text = record.read_text().replace("DT=  0.0100", "DT=  0.1000")
    record.write_text(text)
    assert "too coarse for frequencies above 5 Hz" in shown(capsys, record)


def test_simulated_motions_count_as_such_in_files_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As those that a suite describes: a name in a suite makes no recording of them."""
    folder = new_project(tmp_path / "study", kind="study").parent
    assert "motions (7 simulated)" in shown(capsys, folder / "study.yaml")


def test_recordings_in_another_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As a run of the study finds them."""
    frame, study = new_project(tmp_path / "frame"), new_project(tmp_path / "study", kind="study")
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "RSN767_LOMAP_G03000.AT2").write_bytes((frame.parent / "records" / "simulated_4.AT2").read_bytes())
    for source, words, said in (
        (study, [mine], "motions"),
        (study, [mine / "b"], "E-FILE-01"),
        (frame, [mine], "E-SUITE-11"),
    ):
        assert (main(["check", str(source), "--folder", *map(str, words)]) == 0) == (said == "motions")
        assert said in "".join(capsys.readouterr())
    pairs = tmp_path / "pairs.yaml"
    pairs.write_text(SMALL + "records: {far: {suite: fema_p695_far_field, components: [x, y]}}\n", encoding="utf-8")
    assert main(["check", str(pairs), "--folder", str(mine)]) == 0


def test_results_of_edesign(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "calibration.json"
    error = {"declared": {"validate": 0.2}, "refit": {"validate": 0.01}, "corrected": {"validate": None}}
    found = {"verdict": "explained", "error": error, "effects": [{"name": "payne"}], "search": "cut_short"}
    path.write_text(json.dumps(found))
    output = shown(capsys, path)
    assert "declared 20 %, refit 1 %, corrected -" in output and "the search is cut_short" in output


def test_an_archive(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project = new_project(tmp_path / "frame")
    assert main(["run", str(project), "--only", "modes", "--quiet"]) == 0
    (archive,) = project.parent.glob("*.h5")
    assert "analyses:   1 completed" in shown(capsys, archive)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("x.yaml", LAW.replace("k0", "k9"), "x.yaml:2:"),
        ("x.yaml", f"{SPECIMEN}tests: [{{file: a.csv, temperature: 20 degC}}]\n", "x.yaml:2: E-FILE-01"),
        ("x.yaml", "structure: {name: hall}\n", "E-FILE-05"),
        ("x.yaml", "rig: {kind: dely}\n", "x.yaml:1:"),
        ("x.yaml", "edesign_suite: 1\ntitle: x\nrecords: [{id: a, file: a.AT2}]\n", "a.AT2"),
        ("x.yaml", "zones: {}\n", "x.yaml:1:"),
        ("x.yaml", "- 1\n", "x.yaml:1: E-FILE-05"),
        ("x.json", "{", "JSON E-FILE-05"),
        ("x.json", "[]", "calibration.json fit.json E-FILE-05"),
        ("x.json", '{"verdict": "none", "error": 1}', "calibration.json fit.json E-FILE-05"),
        ("x.json", '{"verdict": 1, "error": {"declared": 5}, "effects": 3}', "written: E-FILE-05"),
        ("x.json", '{"nrms_percent": 1, "law": {}, "fitted": 3}', "written: E-FILE-05"),
        ("x.at2", "one\ntwo\nthree\nfour\n", "x.at2:4:"),
        ("x.csv", "time_s,displacement_mm,force_kN\n0,0,0\n0,1,1\n", "x.csv"),
        ("x.csv", "a,b\n", "x.csv"),
    ],
)
def test_wrong_files(name: str, text: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / name
    path.write_text(text)
    assert main(["check", str(path)]) == 2
    error = capsys.readouterr().err
    assert says(error, said) and str(path) in error and "Traceback" not in error and "itself" not in error


def test_no_file_at_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in (tmp_path / "nowhere.yaml", tmp_path, tmp_path / "nowhere.json", tmp_path / "nowhere.AT2"):
        assert main(["check", str(path)]) == 2
        assert str(path) in capsys.readouterr().err
    shutil.copy(ROOT / "README.md", tmp_path / "README.md")
    assert main(["check", str(tmp_path / "README.md")]) == 2


def test_a_recording_is_known_by_its_content_whatever_its_suffix(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    header = "UNCORRECTED ACCELEROGRAM DATA\n" + "X\n" * 5 + "CHAN  1: EW\n" + "X\n" * 3
    header += (
        "NO. OF POINTS =      4  RECORD LENGTH =  0.015 SEC\nUNITS OF UNCOR ACCEL ARE SEC AND G/10.\n" + "X\n" * 15
    )
    path = tmp_path / "017m30lw.s0a"
    path.write_text(header + "  0.000  0.000  0.005  1.000  0.010 -2.000\n  0.015  0.500\n")
    assert "4 at 0.005 s, 0.015 s; PGA 0.2 g" in shown(capsys, path)
    (tmp_path / "a.zip").write_bytes(b"PK\x03\x04\0\0")
    assert main(["check", str(tmp_path / "a.zip")]) == 2
    assert says(capsys.readouterr().err, "a.zip: compressed E-REC-02")
