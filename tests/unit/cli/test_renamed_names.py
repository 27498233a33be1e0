"""Old names of keys and options still read, mean what the new ones mean, and a note names the new ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.cli.main import main
from edesign.ground_motion.sources import is_simulated, origin_of_file
from edesign.ground_motion.suite import load_suite
from edesign.project.reading.yaml_nodes import parse
from edesign.renamed_names import KEYS, OPTIONS

SUITE = (
    "edesign_suite: 1\ntitle: Trial\nrecords:\n"
    "  - {id: one, magnitude: 6.5, distance: 12 km, v_s30: 500 m/s, stand_in: {seed: 1}}\n"
    "  - {id: two, magnitude: 6.5, distance: 12 km, v_s30: 500 m/s, stand_in: {seed: 2}}\n"
)
MATCH = ["--ground", "B", "--a-gr", "0.2g", "--method", "scale", "--no-stand-ins"]


def said_of(old: str, new: str) -> str:
    return f"edesign: note: the key `{old}` of `records` is now called `{new}`; the old name still reads\n"


def test_a_command_notes_an_old_key_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "old.yaml").write_text(SUITE, encoding="utf-8")
    (tmp_path / "new.yaml").write_text(SUITE.replace("stand_in", "simulated"), encoding="utf-8")
    assert main(["check", str(tmp_path / "old.yaml")]) == 0
    old = capsys.readouterr()
    assert main(["check", str(tmp_path / "new.yaml")]) == 0
    new = capsys.readouterr()
    assert old.err == said_of("stand_in", "simulated") and new.err == ""
    assert old.out.replace("old.yaml", "new.yaml") == new.out and "2 simulated" in new.out


def test_a_command_notes_an_old_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "set.yaml").write_text(SUITE.replace("stand_in", "simulated"), encoding="utf-8")
    assert main(["match", str(tmp_path / "set.yaml"), *MATCH]) == 2
    said = capsys.readouterr().err
    assert "the option --no-stand-ins is now called --no-simulated-records; the old name still reads" in said
    assert "simulated record: refused" in said


def test_python_warns_of_an_old_key(tmp_path: Path) -> None:
    (tmp_path / "python.yaml").write_text(SUITE, encoding="utf-8")
    with pytest.warns(FutureWarning, match="`stand_in` of `records` is now called `simulated`"):
        suite = load_suite(tmp_path / "python.yaml")
    assert suite.records[1].simulated is not None and suite.records[1].simulated.seed == 2


@pytest.mark.filterwarnings("ignore::FutureWarning")
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("records: {a: {suite: x, stand_ins: false}}", "records: {a: {suite: x, simulated_records: false}}"),
        (
            "records: {a: {from: {suite: x, stand_ins: true}}}",
            "records: {a: {from: {suite: x, simulated_records: true}}}",
        ),
        (
            "records: {a: {from: [{suite: x, stand_ins: true}]}}",
            "records: {a: {from: [{suite: x, simulated_records: true}]}}",
        ),
        ("records: {stand_in: {suite: x}}", "records: {stand_in: {suite: x}}"),  # the user's name of a record
        ("sections: {a: {stand_ins: 1}}", "sections: {a: {stand_ins: 1}}"),
    ],
)
def test_places_of_old_keys(old: str, new: str) -> None:
    assert parse(old)[0].plain() == parse(new)[0].plain()


@pytest.mark.filterwarnings("ignore::FutureWarning")
def test_an_old_key_beside_its_new_name_comes_twice() -> None:
    faults = parse("records: {a: {stand_ins: true, simulated_records: false}}")[1]
    assert len(faults) == 1 and "line 1, column 15" in faults[0].message


def test_no_new_name_is_an_old_one_too() -> None:
    assert not {key.old for key in KEYS} & {key.new for key in KEYS}
    assert not set(OPTIONS) & set(OPTIONS.values())


def test_old_files_and_archives_say_what_was_simulated(tmp_path: Path) -> None:
    path = tmp_path / "old.AT2"
    path.write_text("SIMULATED BY EDESIGN, NOT RECORDED: STAND-IN FOR A RECORDING, NO EVIDENCE FOR A DESIGN\n")
    assert origin_of_file(path) == "simulated"
    assert is_simulated("stand-in") and is_simulated("simulated") and not is_simulated("file")
