"""A study whose project is a building: variants under a pair at two places of the masses, pushovers, criteria."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import DAMPED
from cases.small_frame import RECORD, TEXT
from scipy.signal import lsim

from edesign.archive.reader import open_archive
from edesign.assess.incremental import collect_stripes
from edesign.assess.verdicts import judge
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.report.archive.document import page_text
from edesign.report.archive.tables import short_tables
from edesign.study.motions.pairs import prepare_pairs
from edesign.study.run.run import run_study

BUILDING = (
    DAMPED
    + """\
damping: {kind: rayleigh, ratio: 3 %, periods: [1.2 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s}
records: {pairs: {suite: fema_p695_far_field, only: 1, components: [x, y], match: {method: scale}}}
"""
)
STUDY = """\
edesign_study: 1
title: Two storeys under a pair
project: building.yaml
variants:
  bare: {dampers: none}
  damped: {dampers: project}
  stiff: {dampers: none, values: {'columns[0].section': HEB300}}
histories:
  - {variants: all, levels: DBE, records: pairs, eccentricity: [0, +x+y]}
pushovers:
  - {name: push, variants: bare, pattern: first_mode, direction: x, roof_drift: 2 %, eccentricity: +y}
criteria:
  - {name: drift, measure: interstorey_drift, most: 1.5 %, levels: DBE}
  - {name: corner, quantity: line_drift, at: A1, direction: x, most: 1.5 %, levels: DBE}
outputs: {histories: [floors, storeys]}
"""


def write(folder: Path, study: str = STUDY, building: str = BUILDING) -> Path:
    (folder / "building.yaml").write_text(building, encoding="utf-8")
    path = folder / "study.yaml"
    path.write_text(study, encoding="utf-8")
    return path


def test_a_study_on_a_building_is_planned_run_judged_and_reported(tmp_path: Path) -> None:
    study = load_study(write(tmp_path))
    summary = run_study(study, workers=2)
    assert all(outcome.status == "completed" for outcome in summary.outcomes), summary.outcomes
    with open_archive(summary.archive) as archive:
        assert archive.attributes["kind"] == "study"
        assert archive.attributes["building_file"] == "building.yaml"
        names = archive.attributes["planned"]
        assert {"bare.push.x+", "bare.push.x-", "damped.DBE.1.0", "damped.DBE.1.+x+y", "stiff.modes"} <= set(names)
        groups = {name: archive.group(f"analyses/{name}") for name in names if ".DBE." in name}
        drifts = {
            name: max(np.abs(group.variables[f"storey_drift_{which}"].values).max() for which in ("max", "min"))
            for name, group in groups.items()
        }
        assert drifts["damped.DBE.1.0"] < 0.8 * drifts["bare.DBE.1.0"]
        verdicts = judge(study.criteria, (), groups, study.base, study)
        for variant in ("bare", "damped", "stiff"):
            own = next(one for one in verdicts if one.variant == variant and one.name == "drift")
            # of one motion the worse of both places counts
            assert own.value == pytest.approx(max(drifts[f"{variant}.DBE.1.{at}"] for at in ("0", "+x+y")), rel=1e-12)
        assert any(table.title.startswith("Verdicts") for table in short_tables(archive))
        page = page_text(archive)
    assert "could not be" not in page
    for figure in ("hinges_X1", "profile_storey_drift_DBE_x", "profile_storey_drift_DBE_y", "orbits"):
        assert f"figure-{figure}" in page, figure


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("direction: x, roof", "direction: right, roof"), "`right` is not of a building"),
        (("direction: x, roof", "roof"), "this key is missing; a building is pushed in one of"),
        (("direction: x, roof", "direction: up, roof"), "`up` is unknown (allowed: `right`, `left`, `both`, `x+`"),
        (("eccentricity: +y}", "eccentricity: +x}"), "does not displace the loads of a push along x"),
        (("eccentricity: [0, +x+y]", "wave_passage: {velocity: 500 m/s, direction: left}"), "is an angle from x"),
        (("at: A1,", "at: Z9,"), "Z9"),
        (("columns[0].section': HEB300", "braces[0].frames': A"), "adds or removes members or storeys"),
    ],
)
def test_what_a_study_cannot_ask_of_a_building_is_refused_with_its_place(
    tmp_path: Path, change: tuple[str, str], said: str
) -> None:
    assert STUDY.count(change[0]) == 1
    with pytest.raises(InputError, match="study.yaml:") as found:
        load_study(write(tmp_path, STUDY.replace(*change)))
    assert said in str(found.value)


def test_a_plane_frame_is_not_pushed_as_a_building(tmp_path: Path) -> None:
    (tmp_path / "motion.AT2").write_text(RECORD, encoding="utf-8")
    (tmp_path / "project.yaml").write_text(TEXT, encoding="utf-8")
    path = tmp_path / "study.yaml"
    head = "edesign_study: 1\ntitle: Plane\nproject: project.yaml\nvariants: {bare: {dampers: none}}\n"
    push = "pushovers: [{name: push, pattern: uniform, roof_drift: 1 %, direction: x+, eccentricity: +y}]\n"
    path.write_text(head + push, encoding="utf-8")
    with pytest.raises(InputError, match=r"`x\+` is not of a frame"):
        load_study(path)
    path.write_text(head + push.replace("x+", "left"), encoding="utf-8")
    with pytest.raises(InputError, match="a plane frame has no masses beside their places"):
        load_study(path)


INCREMENTAL = """\
edesign_study: 1
title: Two storeys under pairs that are scaled
project: building.yaml
variants: {bare: {dampers: none}}
incremental:
  - {name: ida, records: raw, intensity: spectral_acceleration, levels: [0.05 g, 0.1 g, 30 g, 40 g],
     angles: [0 deg, 90 deg], limits: {LS: {interstorey_drift: 1 %}}}
  - {name: peak, records: raw, intensity: pga, levels: [0.1 g, 0.2 g]}
"""


def test_pairs_are_scaled_until_a_building_collapses(tmp_path: Path) -> None:
    """Intensities are geometric means of both components, at the mean of T1 along x and y; the worse angle counts.

    Reference: spectra of the components by scipy's exact response to linear pieces.
    """
    raw = BUILDING.replace("pairs: {suite: fema_p695_far_field, only: 1, components: [x, y], match: {method: scale}}",
                           "raw: {suite: fema_p695_far_field, only: [1, 2], components: [x, y]}")  # fmt: skip
    study = load_study(write(tmp_path, INCREMENTAL, raw))
    summary = run_study(study, workers=2)
    with open_archive(summary.archive) as archive:
        names = archive.attributes["planned"]
        groups = {name: archive.group(f"analyses/{name}") for name in names if "ida" in name or "peak" in name}
        about = archive.group("incremental/ida")
        modes = archive.group("analyses/bare.modes")
        tables = page_text(archive)
    leading = [modes.variables[f"effective_mass_ratio_{axis}"].values.argmax() for axis in "xy"]
    T = modes.variables["period"].values[leading].mean()
    assert about.variables["period"].values[0] == pytest.approx(T, rel=1e-9)
    recordings = prepare_pairs(study.base, "raw").motions
    for motion in recordings:
        measures: dict[str, list[float]] = {"ida": [], "peak": []}
        for record in motion.records:
            omega, time = 2.0 * np.pi / T, record.time_step * np.arange(record.acceleration.size)
            oscillator = [-1.0], [1.0, 2.0 * 0.05 * omega, omega**2]
            measures["ida"].append(omega**2 * abs(lsim(oscillator, record.acceleration, time)[1]).max())
            measures["peak"].append(np.abs(record.acceleration).max())
        number = motion.name.rpartition("/")[2]
        for name, intensity in (("ida", "0.1g.90deg"), ("peak", "0.2g")):
            group = groups[f"bare.{name}.{number}.{intensity}"]
            factor = float(intensity.partition("g")[0]) * 9.80665 / np.sqrt(np.prod(measures[name]))
            # 3e-3: between steps of 0.01 s the records are linear here, and band-limited in the package
            assert group.attributes["scale_factor"] == pytest.approx(factor, rel=3e-3)
    assert groups["bare.ida.1.30g.0deg"].attributes["collapsed"] == 1
    stripes = collect_stripes(groups, "ida", "bare", ("interstorey_drift",))["interstorey_drift"]
    assert stripes.records == ("raw/1", "raw/2") and np.isinf(stripes.values[:, 2:]).all()
    for row, number in enumerate("12"):
        of = [groups[f"bare.ida.{number}.0.1g.{angle}deg"] for angle in (0, 90)]
        worst = max(np.abs(g.variables[f"storey_drift_{w}"].values).max() for g in of for w in ("max", "min"))
        assert stripes.values[row, 1] == pytest.approx(worst, rel=1e-12)
    assert "Fragilit" in tables
