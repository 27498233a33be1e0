"""What a campaign says of how its tests start: keys of all tests and of one, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.damper.testing.campaign import load_campaign, write_campaign
from edesign.errors import InputError

HEAD = "specimen: {name: p, layers: 2, layer_area_mm2: 41400.0, layer_thickness_mm: 12.0}\n"
CSV = "time_s,displacement_mm,force_kN\n0,0.1,0\n0.004,1.5,2\n0.008,-2,3.5\n"


def campaign(folder: Path, head: str, *tests: str) -> Path:
    for i in range(len(tests)):
        (folder / f"t{i}.csv").write_text(CSV, encoding="utf-8")
    entries = [f"  - {{file: t{i}.csv, temperature_C: 20{test}}}\n" for i, test in enumerate(tests)]
    path = folder / "campaign.yaml"
    path.write_text(HEAD + head + "tests:\n" + "".join(entries), encoding="utf-8")
    return path


def test_the_word_of_a_test_goes_before_that_of_all(tmp_path: Path) -> None:
    found = load_campaign(
        campaign(tmp_path, "start: at_rest\nstart_ramp: 20 ms\n", "", ", start: in_motion", ", start_ramp: 0.5 s")
    )
    assert [test.start for test in found.tests] == ["at_rest", "in_motion", "at_rest"]
    assert [test.start_ramp for test in found.tests] == [0.02, None, 0.5]
    assert [test.ramp for test in found.tests] == [0.02, 0.004, 0.5]
    written = write_campaign(tmp_path / "again", found.specimen, found.tests)
    again = load_campaign(written.path)
    assert [(test.start, test.start_ramp) for test in again.tests] == [
        (test.start, test.start_ramp) for test in found.tests
    ]


def test_nothing_is_said_unless_it_is(tmp_path: Path) -> None:
    (test,) = load_campaign(campaign(tmp_path, "", "")).tests
    assert (test.start, test.start_ramp, test.ramp) == ("unknown", None, 0.004)
    path = write_campaign(tmp_path / "again", load_campaign(campaign(tmp_path, "", "")).specimen, [test]).path
    assert "start" not in path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("head", "test", "said"),
    [
        ("start: at rest\n", "", r"campaign\.yaml:2:\d+: start: .*at_rest.*in_motion.*unknown.*E-VALUE-03"),
        ("", ", start: moving", r"campaign\.yaml:3:\d+: tests\[0\]\.start: .*in_motion.*E-VALUE-03"),
        ("start_ramp: 5 ms\n", "", r"campaign\.yaml:2:\d+: start_ramp: .*E-KEY-03"),
        ("start: at_rest\n", ", start: in_motion, start_ramp: 5 ms", r"tests\[0\]\.start_ramp: .*E-KEY-03"),
        ("start: at_rest\nstart_ramp: 5\n", "", r"campaign\.yaml:3:\d+: start_ramp: .*E-UNIT-01"),
        ("start: at_rest\nstart_ramp: 0 s\n", "", r"campaign.yaml:3:\d+: start_ramp: .*"),
    ],
)
def test_wrong_starts(tmp_path: Path, head: str, test: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        load_campaign(campaign(tmp_path, head, test))
