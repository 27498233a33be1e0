"""The plan of a study: every variant x level x record x temperature, in the order of the file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from building_examples import PAIRS, building
from cases.small_study import HISTORIES, PLANNED, write

from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.project.analysis.analyses import HistoryAnalysis, ModalAnalysis
from edesign.project.study.study import Histories, Study, StudyOutputs
from edesign.study.plan.study_plan import make_study_plan, wanted_designs
from edesign.study.run.run import run_study

WARM = "  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}\n"
MODES = ("{name: modes, kind: modal, modes: 2}", "{name: gravity, kind: gravity}")
THREE = ("first", "second", "third")
PLAN = [
    *(f"{variant}.{kind}" for variant in ("bare", "damped", "upper", "warm") for kind in ("modes", "gravity")),
    *(f"{v}.{level}.{r}" for v in ("bare", "damped", "upper") for level in ("DBE", "MCE") for r in THREE),
    "warm.DBE.first",
    "damped.10C.DBE.first",
    "damped.35C.DBE.first",
]


@pytest.fixture
def study(tmp_path: Path) -> Study:
    return load_study(write(tmp_path))


def test_names_and_order(study: Study) -> None:
    plan = make_study_plan(study)
    assert [task.name for task in plan] == PLAN and len(PLAN) == PLANNED == 8 + HISTORIES
    assert [task.order for task in plan] == list(range(PLANNED))
    assert [task.path for task in plan] == [f"analyses/{name}" for name in PLAN]


def test_histories_of_a_building(study: Study) -> None:
    """Angles and places of its masses stand in the names where there are several or one not zero, and in the labels."""
    asked = Histories(
        variants=("bare",),
        levels=("DBE",),
        records=("both",),
        angles=("0 deg", "22.5 deg"),  # type: ignore[arg-type]
        eccentricity=(0, "+x-y"),  # type: ignore[arg-type]
    )
    one = asked.model_copy(update={"eccentricity": ("+x-y",), "angles": (0.5 * math.pi,)})
    for histories, names in ((asked, ["0deg.0", "0deg.+x-y", "22.5deg.0", "22.5deg.+x-y"]), (one, ["90deg.+x-y"])):
        update = {"histories": (histories,), "variants": {"bare": study.variants["bare"]}, "outputs": StudyOutputs()}
        of = study.model_copy(update=update)
        of.set_base(building(PAIRS))  # type: ignore[arg-type]
        tasks = [task for task in make_study_plan(of) if task.record]
        assert [task.name for task in tasks] == [f"bare.DBE.both.{name}".rstrip(".") for name in names]
        assert {task.entry for task in tasks} == {"bare.DBE"}
        last = tasks[-1].labels
        assert last["eccentricity"] == "+x-y" and last["angle_deg"] == pytest.approx(90.0 if one is histories else 22.5)


def test_labels_say_what_each_analysis_is_of(study: Study) -> None:
    labels = {task.name: task.labels for task in make_study_plan(study)}
    assert labels["damped.35C.DBE.first"] == {
        "order": PLANNED - 1,
        "name": "damped.35C.DBE.first",
        "kind": "history",
        "variant": "damped",
        "record": "set/first",
        "level": "DBE",
        "temperature_C": 35.0,
    }
    assert labels["warm.DBE.first"]["temperature_C"] is None  # its own
    modes = {"order": 2, "name": "damped.modes", "kind": "modal", "variant": "damped"}
    assert labels["damped.modes"] == {**modes, "record": None, "level": None, "temperature_C": None}


def test_what_the_analyses_ask_for(study: Study) -> None:
    tasks = {task.name: task for task in make_study_plan(study)}
    bare, damped = tasks["bare.modes"].spec, tasks["damped.modes"].spec
    assert isinstance(bare, ModalAnalysis) and isinstance(damped, ModalAnalysis)
    assert (bare.modes, bare.dampers, bare.damper_strain) == (2, False, None)
    assert (damped.modes, damped.dampers, damped.damper_strain) == (2, True, 0.2)  # the strain of the design
    for name, task in tasks.items():
        spec = task.spec
        if isinstance(spec, HistoryAnalysis):
            assert spec.dampers == (not name.startswith("bare")) and spec.free_vibration == 1.0
            assert spec.scale is None and spec.pga is None  # the level says the scale
    whole = [name for name, task in tasks.items() if task.details]
    assert whole == [name for name in PLAN if name.endswith(".first")]


@pytest.mark.parametrize(
    ("only", "found"),
    [
        (("bare.DBE",), [f"bare.DBE.{name}" for name in THREE]),
        (("damped.35C.DBE",), ["damped.35C.DBE.first"]),
        (("upper.MCE.third", "bare.modes"), ["bare.modes", "upper.MCE.third"]),  # in the order of the plan
        (("warm.gravity", "warm.gravity"), ["warm.gravity"]),
    ],
)
def test_a_part_of_the_plan_keeps_its_numbers(study: Study, only: tuple[str, ...], found: list[str]) -> None:
    plan = make_study_plan(study, only)
    assert [task.name for task in plan] == found
    assert [task.order for task in plan] == [PLAN.index(name) for name in found]


def test_designs_are_made_for_the_variants_of_the_plan(study: Study) -> None:
    assert wanted_designs(study, make_study_plan(study)) == ("added",)
    assert wanted_designs(study, make_study_plan(study, ["upper.gravity"])) == ("added",)
    assert wanted_designs(study, make_study_plan(study, ["bare.DBE"])) == ()


@pytest.mark.parametrize("name", ["bare.DBF", "bear.DBE", "bare", "DBE", "bare.DBE.", ""])
def test_a_part_that_there_is_not(study: Study, name: str) -> None:
    with pytest.raises(InputError, match=r"bare\.modes, bare\.gravity, damped.*E-NAME-01"):
        make_study_plan(study, [name])


def test_all_variants_in_the_order_of_the_file(tmp_path: Path) -> None:
    path = write(tmp_path, ("{variants: [bare, damped, upper], levels", "{variants: all, levels"), (WARM, ""))
    histories = [task for task in make_study_plan(load_study(path)) if task.spec.kind == "history"]
    assert list(dict.fromkeys(task.variant for task in histories)) == ["bare", "damped", "upper", "warm"]
    assert len(histories) == 4 * 2 * 3 + 2
    path = write(tmp_path, ("{variants: [bare, damped, upper], levels", "{variants: [upper, bare], levels"))
    histories = [task for task in make_study_plan(load_study(path)) if task.spec.kind == "history"]
    assert list(dict.fromkeys(task.variant for task in histories))[:2] == ["bare", "upper"]


def test_a_record_that_is_not_fitted_needs_no_level(tmp_path: Path) -> None:
    other = "  - {variants: bare, records: motion}\n  - {variants: bare, levels: DBE, records: motion}\n"
    plan = make_study_plan(load_study(write(tmp_path, (WARM, other))))
    found = {task.name: (task.labels["level"], task.record, task.entry) for task in plan if task.record == "motion"}
    assert found == {"bare.motion": (None, "motion", "bare"), "bare.DBE.motion": ("DBE", "motion", "bare.DBE")}


def test_temperatures_in_kelvin_and_below_zero(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, ("[10 degC, 35 degC]", "[308 K, -5 degC, 0 degC]")))
    assert [task.entry for task in make_study_plan(study)[-3:]] == [
        "damped.34.85C.DBE",
        "damped.-5C.DBE",
        "damped.0C.DBE",
    ]


def test_no_masses_no_modes(tmp_path: Path) -> None:
    path = write(tmp_path, project=(("masses: {from_loads: {}}\n", ""), MODES))
    text = path.read_text(encoding="utf-8")
    head, tail = text.index("designs:"), text.index("\ncriteria:") + 1
    path.write_text(f"{text[:head]}variants: {{bare: {{dampers: none}}}}\n{text[tail:]}", encoding="utf-8")
    text = path.read_text(encoding="utf-8")
    assert [task.name for task in make_study_plan(load_study(path))] == ["bare.gravity"]


@pytest.mark.parametrize(("given", "found"), [("", 1), ("modal: {modes: 1}\n", 1)])
def test_a_frame_of_one_storey_has_one_mode(tmp_path: Path, given: str, found: int) -> None:
    """One diaphragm that moves sideways: the three modes that are usual are not demanded of it."""
    one = (
        ("storeys: [4 m, 3 m]", "storeys: [4 m]"),
        ("frame:\n", "frame:\n  diaphragms: all\n"),
        ("masses: {from_loads: {}}", "masses: {from_loads: {}, directions: horizontal}"),
        ("damping: {kind: rayleigh, ratio: 2 %}", "damping: {kind: modal, ratio: 2 %, modes: 1}"),
        ("analyses: [{name: modes, kind: modal, modes: 2}]", "analyses: [{name: gravity, kind: gravity}]"),
    )
    path = write(tmp_path, ("modal: {modes: 2}\n", given), project=one)
    summary = run_study(load_study(path), only=["bare.modes"])
    assert [outcome.status for outcome in summary.outcomes] == ["completed"]
    with open_archive(summary.archive) as archive:
        assert archive.group("analyses/bare.modes").variables["period"].values.size == found
