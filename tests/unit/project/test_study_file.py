"""Study files that are wrong: every mistake has its place, what was seen, what is allowed, and the nearest name."""

from __future__ import annotations

import json
import random
from functools import cache
from pathlib import Path

import pytest
import yaml
from cases.small_frame import place_of
from cases.small_study import PLANNED, write
from messages import says
from spoiled_files import spoiled

from edesign.cli.main import main
from edesign.errors import InputError
from edesign.file_kinds.kinds import PROJECT, STUDY
from edesign.file_kinds.recognise import kind_of
from edesign.frame.project_file import load_project, load_study
from edesign.ground_motion import project_records
from edesign.ground_motion.suite import load_suite
from edesign.project.study.study import Study
from edesign.project.study.study_loader import StudyError, parse_study
from edesign.study.check.check import check_study_inputs
from edesign.study.check.summary import check_study
from edesign.study.plan.study_plan import make_study_plan

THESIS = Path(__file__).parents[3] / "projects" / "thesis_10_storey" / "study.yaml"
LEVELS = "(levels here: `DBE`, `MCE`)"
VARIANTS = "(variants here: `bare`, `damped`, `upper`, `warm`)"
AT_MCE = "  - {name: at MCE, measure: interstorey_drift, levels: MCE, most: 9 %}\n"
BARE = "  bare: {dampers: none}"
FIRST = "{variants: [bare, damped, upper], levels: [DBE, MCE], records: set, free_vibration: 1 s}"
WARM = "{variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}"
DETAILS = "{records: set/first, members: [C_A_1]}"


def faults(path: Path) -> list[tuple[str, str]]:
    """Place and message of each problem of a study."""
    with pytest.raises(InputError) as caught:
        study = load_study(path)
        check_study_inputs(study, make_study_plan(study))
    lines = [line for line in str(caught.value).splitlines() if not line.endswith(f"problems in {path}")]
    return [(line[: line.index(": ")], line[line.index(": ") + 2 :]) for line in lines]


def test_a_study_that_is_right(tmp_path: Path) -> None:
    path = write(tmp_path)
    study = load_study(path)
    assert kind_of(path) == STUDY and kind_of(tmp_path / "project.yaml") == PROJECT
    assert len(make_study_plan(study)) == PLANNED
    assert study.archive_path == tmp_path / "out.h5" and study.folder == tmp_path
    assert study.variants["warm"].temperature == 35.0 and study.histories[0].free_vibration == 1.0
    assert study.base.checksum == load_project(tmp_path / "project.yaml").checksum != study.checksum


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named, the rest of the line is the message
        ("edesign_study: 1", "edesign_study: @2", "edesign_study E-VALUE-03"),
        ("objectives: [h]", "@objektives: [h]", "objektives `objectives` E-KEY-01"),
        ("project: project.yaml", "project: @projects.yaml", "project `{folder}/projects.yaml` E-FILE-01"),
        ("project: project.yaml", "project: @.", "project `{folder}` E-FILE-01"),
        # variants
        (BARE, "  @bare: {}", "variants.bare `dampers` `none` `project` `design` E-KEY-03"),
        (BARE, "  @bare: {dampers: none, design: added}", "variants.bare E-KEY-03"),
        (BARE, "  bare: {dampers: @nome}", "variants.bare.dampers E-VALUE-03"),
        (BARE, BARE + "\n  more: {design: @aded}", "variants.more.design `added` E-NAME-01"),
        (BARE, "  bare: {dampers: none, @temperature: 35 degC}", "variants.bare.temperature E-DAMPER-04"),
        (BARE, "  bare: {dampers: none, @property_factor: 2}", "variants.bare.property_factor E-DAMPER-04"),
        (BARE, BARE + "\n  @all: {dampers: none}", "variants.all E-NAME-03"),
        (BARE, BARE + "\n  @a.b: {dampers: none}", "variants.a.b"),
        ("property_factor: 1.5", "property_factor: @0", "variants.upper.property_factor E-VALUE-02"),
        ("temperature: 35 degC}\nmodal", "temperature: @35}\nmodal", "variants.warm.temperature E-VALUE-01"),
        # modal
        ("{modes: 2}", "{modes: @0}", "modal.modes E-VALUE-02"),
        ("{modes: 2}", "{modes: 2, state: @initail}", "modal.state `initial` E-VALUE-03"),
        # histories
        (FIRST, FIRST.replace("[bare,", "[@bear,"), f"there is no variant `bear`; did you mean `bare`? {VARIANTS}"),
        (
            FIRST,
            FIRST.replace("[bare, damped,", "[bare, bare, @damped,").replace("bare, bare", "damped, bare"),
            "histories[0].variants[2] E-NAME-02",
        ),
        (FIRST, FIRST.replace("[bare,", "[@all, bare,"), f"variants[0]: there is no variant `all` {VARIANTS}"),
        (FIRST, FIRST.replace("MCE]", "@MCF]"), "histories[0].levels[1] `MCE` E-NAME-01"),
        (FIRST, FIRST.replace("MCE]", "@DBE]"), "histories[0].levels[1] E-NAME-02"),
        (FIRST, FIRST.replace("MCE]", "MCE, @SLE]"), f"histories[0].levels[2]: there is no level `SLE` {LEVELS}"),
        (FIRST, "@" + FIRST.replace("levels: [DBE, MCE], ", ""), "histories[0].levels `set` E-KEY-02"),
        (FIRST, "@" + FIRST.replace("records: set, ", ""), "histories[0].records E-KEY-02"),
        (FIRST, FIRST.replace("records: set", "records: @sett"), "histories[0].records `set` E-NAME-01"),
        (FIRST, FIRST.replace("records: set", "records: [set, @set]"), "histories[0].records[1] E-NAME-02"),
        (FIRST, FIRST.replace("records: set", "records: @set/frist"), "histories[0].records `first` E-NAME-01"),
        (
            WARM,
            WARM.replace("records: set/first", "records: [set/first, @motion/x]"),
            "histories[1].records E-VALUE-01",
        ),
        (
            FIRST,
            FIRST.replace("[DBE, MCE], records: set", "@[DBE, MCE], records: motion"),
            "histories[0].levels E-SCALE-03",
        ),
        (FIRST, FIRST.replace("}", ", @temperatures: 35 degC}"), "histories[0].temperatures `bare` E-DAMPER-04"),
        (FIRST, FIRST.replace("1 s}", "1 s, collapse_drift: @0 %}"), "histories[0].collapse_drift E-VALUE-02"),
        (FIRST, FIRST.replace("1 s}", "@1}"), "histories[0].free_vibration E-UNIT-01"),
        (WARM, f"{WARM}\n  - @{WARM}", "histories[2] `warm.DBE.first` E-NAME-02"),
        ("[10 degC, 35 degC]", "[10 degC, @35]", "histories[2].temperatures[1] E-VALUE-01"),
        ("temperatures: [10 degC, 35 degC]", "temperatures: @35", "histories[2].temperatures E-VALUE-01"),
        ("temperatures: [10 degC, 35 degC]", "temperatures: @-300 degC", "histories[2].temperatures E-VALUE-02"),
        ("modal: {modes: 2}", "modal: {modes: @99}", "modal.modes E-MODAL-03"),
        # designs: what only a study knows
        ("criteria: drift,", "criteria: @drfit,", "designs.added.verify.criteria `drift` E-NAME-01"),
        ("criteria: drift,", "criteria: [drift, @drift],", "designs.added.verify.criteria[1] E-NAME-02"),
        ("criteria: drift,", "criteria: @at MCE,", "designs.added.verify.criteria E-CRIT-05"),
        (
            "{records: set, levels: DBE,",
            "{records: @set/frist, levels: DBE,",
            "designs.added.verify.records `first` E-NAME-01",
        ),
        ("method: strain_energy", "method: @strain", "designs.added.method E-VALUE-03"),
        ("law: rubber", "law: @ruber", "designs.added.law `rubber` E-NAME-01"),
        # criteria, objectives
        ("most: 2 %", "@mots: 2 %", "criteria[1].mots `most` E-KEY-01"),
        ("objectives: [h]", "objectives: [@z]", "objectives[0] E-VALUE-03"),
        ("objectives: [h]", "objectives: [@a]", "objectives[0] 50 E-CRIT-02"),
        # outputs
        ("archive: out.h5", "archive: @out.txt", "outputs.archive E-FILE-08"),
        ("[floors]", "[@flors]", "outputs.histories[0] `floors` E-VALUE-03"),
        ("every: 2", "every: @0", "outputs.every E-VALUE-02"),
        (DETAILS, DETAILS.replace("set/first", "@sett/first"), "outputs.details.records `set` E-NAME-01"),
        (DETAILS, DETAILS.replace("set/first", "@set/frist"), "outputs.details.records `first` E-NAME-01"),
        (DETAILS, DETAILS.replace("C_A_1", "@C_A_9"), "outputs.details.members[0] E-NAME-01"),
        (f"details: {DETAILS}", "@details: {members: [C_A_1]}", "outputs.details.records E-KEY-02"),
    ],
)
def test_each_mistake_is_reported_with_its_place(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = write(tmp_path, (old, new.replace("@", "")), ("criteria:\n", f"criteria:\n{AT_MCE}"))
    text = path.read_text(encoding="utf-8")
    at = text.index(new.replace("@", "")) + new.index("@")
    ((place, message),) = faults(path)
    assert place == f"{path}:{text.count(chr(10), 0, at) + 1}:{at - text.rfind(chr(10), 0, at)}"
    assert says(message, said.replace("{folder}", str(tmp_path)))


def test_a_verification_needs_levels(tmp_path: Path) -> None:
    path = write(tmp_path, ("{records: set, levels: DBE, criteria", "{records: set, criteria"))
    ((place, message),) = faults(path)
    assert place == place_of(path, "verify:")
    assert says(message, "designs.added.verify.levels: `DBE` `MCE` E-KEY-02")


def test_all_mistakes_are_reported_at_once(tmp_path: Path) -> None:
    path = write(tmp_path, ("levels: [DBE, MCE]", "levels: [DBF]"), ("records: set/first, m", "records: sett, m"))
    with pytest.raises(StudyError, match=f"2 problems in {path}"):
        load_study(path)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("masses: {from_loads: {}}\n", ""), "project.yaml analyses[0]: `masses` E-MODAL-02"),
        (("damping: {kind: rayleigh, ratio: 2 %}\n", ""), "study.yaml project: `damping` project.yaml E-KEY-02"),
        (
            ("integration: {method: newmark, time_step: 0.01 s}\n", ""),
            "study.yaml project: `integration` project.yaml E-KEY-02",
        ),
    ],
)
def test_what_the_project_has_not(tmp_path: Path, change: tuple[str, str], said: str) -> None:
    path = write(tmp_path, project=(change,))
    with pytest.raises(InputError) as caught:
        load_study(path)
    assert says(str(caught.value), said)


def test_dampers_of_a_project_that_has_none(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8").replace("{design: added", "{dampers: project")
    path.write_text(text[: text.index("designs:")] + text[text.index("variants:") :], encoding="utf-8")
    project = tmp_path / "project.yaml"
    text = project.read_text(encoding="utf-8")
    project.write_text(text[: text.index("dampers:")] + text[text.index("analyses:") :], encoding="utf-8")
    for name, (_, message) in zip(("damped", "upper", "warm"), faults(path), strict=True):
        assert says(message, f"variants.{name}.dampers: {project} E-DAMPER-04")


def test_a_mistake_of_the_project_is_reported_with_its_own_place(tmp_path: Path) -> None:
    path = write(tmp_path, project=(("section: HEB200", "section: HEB201"),))
    ((place, message),) = faults(path)
    assert place == place_of(tmp_path / "project.yaml", "HEB201") and says(message, "`HEB180` `HEB200` E-NAME-01")


def test_a_law_without_parameters_at_the_temperature_of_a_variant(tmp_path: Path) -> None:
    """Before any design is made; other laws than those of the variant need not know its temperature."""
    other = "  laws:\n    oil: {type: kelvin_voigt, parameters: {k: 1 kN/mm, c: 10 kN*s/m}}\n"
    path = write(tmp_path, project=(("  laws:\n", other),))
    study = load_study(path)
    assert check_study_inputs(study, make_study_plan(study))
    path = write(tmp_path, ("temperature: 35 degC}\nmodal", "temperature: 400 degC}\nmodal"))
    ((place, message),) = faults(path)
    assert place.rpartition(":")[0] == place_of(path, "warm: {").rpartition(":")[0]
    assert message.startswith(f"variants.warm: {tmp_path / 'project.yaml'}:")
    assert says(message, "dampers.laws.rubber.temperature -3.2 E-LAW-04")


def test_project_and_study_are_not_taken_for_each_other(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path)
    project = tmp_path / "project.yaml"
    with pytest.raises(InputError) as caught:
        load_study(project)
    assert says(str(caught.value), f"{project}:1:1: edesign: `edesign_study: 1` `edesign run` E-FILE-05")
    with pytest.raises(InputError) as caught:
        load_project(path)
    assert says(str(caught.value), f"{path}:1:1: edesign_study: `edesign: 1` `edesign run` E-FILE-05")
    itself = write(tmp_path, ("project: project.yaml", "project: study.yaml"))
    assert main(["run", str(itself)]) == 2
    assert capsys.readouterr().err == f"edesign: {caught.value}\n"


@pytest.mark.parametrize("text", ["", "# nothing\n", "[]", "edesign_study", "- edesign_study: 1", "{", "\t", "a: [b"])
def test_files_that_are_no_study(tmp_path: Path, text: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "study.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=str(path)):
        load_study(path)
    assert main(["check", str(path)]) == main(["run", str(path)]) == 2
    assert str(path) in capsys.readouterr().err


def test_a_file_that_is_not_there_or_a_folder(tmp_path: Path) -> None:
    for path in (tmp_path / "nothing.yaml", tmp_path):
        with pytest.raises(InputError, match=str(path)):
            load_study(path)


def test_no_change_of_a_file_leads_to_anything_but_a_message(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three hundred studies of the thesis with keys left out, values replaced, keys renamed (seeded)."""
    monkeypatch.setattr(project_records, "load_suite", cache(load_suite))  # its suite is the same for all of them
    whole = yaml.safe_load(THESIS.read_text(encoding="utf-8"))
    base = load_study(THESIS).base
    refused = 0
    for seed in range(300):
        rng = random.Random(seed)
        text = json.dumps(spoiled(whole, rng, name="Levels"), indent=1, ensure_ascii=False)  # YAML too
        try:
            study = parse_study(text, THESIS, base)
            assert isinstance(study, Study)
            make_study_plan(study)
        except InputError as error:
            refused += 1
            assert str(error).startswith(f"{THESIS}:"), text
    assert 200 < refused < 300  # some keys may be left out


def test_dampers_of_a_project_that_has_laws_alone(tmp_path: Path) -> None:
    """A frame without any damper is `none`; nothing is taken silently for it."""
    path = write(tmp_path, (BARE, "  bare: {dampers: project}"))
    ((_, message),) = faults(path)
    project = tmp_path / "project.yaml"
    assert says(message, f"variants.bare.dampers: {project} E-DAMPER-04")


def test_a_place_of_a_design_that_the_frame_lacks(tmp_path: Path) -> None:
    """The place named is the design; the devices that stand for it are in no file."""
    gone = ("frame:\n", "frame:\n  missing: {columns: [{lines: A, storeys: 2}], beams: [{bays: 1, floors: 2}]}\n")
    ((place, message),) = faults(write(tmp_path, project=(gone,)))
    assert place == place_of(tmp_path / "study.yaml", "method: strain_energy")
    assert message.startswith("designs.added: ") and "`A2`" in message and message.endswith(" [E-DESIGN-01]")
    assert message.count(" [E-") == 1


def test_what_nothing_will_be_judged_by_is_noted(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, ("criteria:\n", f"criteria:\n{AT_MCE}"), ("levels: [DBE, MCE]", "levels: DBE")))
    warnings = check_study(study)["warnings"]
    assert warnings.count("will not be judged") == 1
    assert "criterion `at MCE` will not be judged: no history at `MCE` is planned" in warnings
