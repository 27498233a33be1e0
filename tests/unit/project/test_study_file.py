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
from spoiled_files import spoiled

from edesign.building.project_file import load_project, load_study
from edesign.cli.main import main
from edesign.errors import InputError
from edesign.file_kinds.kinds import PROJECT, STUDY
from edesign.file_kinds.recognise import kind_of
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
        ("edesign_study: 1", "edesign_study: @2", "edesign_study: "),
        ("objectives: [h]", "@objektives: [h]", "objektives: unknown key; did you mean `objectives`?"),
        ("project: project.yaml", "project: @projects.yaml", "project: there is no file `{folder}/projects.yaml`"),
        ("project: project.yaml", "project: @.", "project: there is no file `{folder}` (the path is relative to"),
        # variants
        (BARE, "  @bare: {}", "variants.bare: give either `dampers` (`none` or `project`) or a `design`"),
        (BARE, "  @bare: {dampers: none, design: added}", "variants.bare: give either `dampers`"),
        (BARE, "  bare: {dampers: @nome}", "variants.bare.dampers: "),
        (
            BARE,
            BARE + "\n  more: {design: @aded}",
            "there is no design `aded`; did you mean `added`? (designs here: `a",
        ),
        (BARE, "  bare: {dampers: none, @temperature: 35 degC}", "variants.bare.temperature: this variant has no damp"),
        (BARE, "  bare: {dampers: none, @property_factor: 2}", "variants.bare.property_factor: this variant has no da"),
        (BARE, BARE + "\n  @all: {dampers: none}", "variants.all: `all` stands for all variants"),
        (BARE, BARE + "\n  @a.b: {dampers: none}", "variants.a.b"),
        ("property_factor: 1.5", "property_factor: @0", "variants.upper.property_factor: "),
        ("temperature: 35 degC}\nmodal", "temperature: @35}\nmodal", "variants.warm.temperature: "),
        # modal
        ("{modes: 2}", "{modes: @0}", "modal.modes: "),
        ("{modes: 2}", "{modes: 2, state: @initail}", "modal.state: `initail` is unknown; did you mean `initial`?"),
        # histories
        (FIRST, FIRST.replace("[bare,", "[@bear,"), f"there is no variant `bear`; did you mean `bare`? {VARIANTS}"),
        (
            FIRST,
            FIRST.replace("[bare, damped,", "[bare, bare, @damped,").replace("bare, bare", "damped, bare"),
            "histories[0].variants[2]: `damped` comes twice",
        ),
        (FIRST, FIRST.replace("[bare,", "[@all, bare,"), f"variants[0]: there is no variant `all` {VARIANTS}"),
        (FIRST, FIRST.replace("MCE]", "@MCF]"), "histories[0].levels[1]: there is no level `MCF`; did you mean `MCE`"),
        (FIRST, FIRST.replace("MCE]", "@DBE]"), "histories[0].levels[1]: `DBE` comes twice"),
        (FIRST, FIRST.replace("MCE]", "MCE, @SLE]"), f"histories[0].levels[2]: there is no level `SLE` {LEVELS}"),
        (
            FIRST,
            "@" + FIRST.replace("levels: [DBE, MCE], ", ""),
            "histories[0].levels: this key is missing; `set` is f",
        ),
        (FIRST, "@" + FIRST.replace("records: set, ", ""), "histories[0].records: this key is missing"),
        (
            FIRST,
            FIRST.replace("records: set", "records: @sett"),
            "there is no record `sett`; did you mean `set`? (reco",
        ),
        (FIRST, FIRST.replace("records: set", "records: [set, @set]"), "histories[0].records[1]: `set` comes twice"),
        (
            FIRST,
            FIRST.replace("records: set", "records: @set/frist"),
            "there is no recording `frist`; did you mean `fi",
        ),
        (
            WARM,
            WARM.replace("records: set/first", "records: [set/first, @motion/x]"),
            "`motion` is a single record, not a",
        ),
        (FIRST, FIRST.replace("[DBE, MCE], records: set", "@[DBE, MCE], records: motion"), "`motion` is not fitted to"),
        (
            FIRST,
            FIRST.replace("}", ", @temperatures: 35 degC}"),
            "the variant `bare` has no dampers, whose temperature",
        ),
        (FIRST, FIRST.replace("1 s}", "1 s, collapse_drift: @0 %}"), "histories[0].collapse_drift: "),
        (FIRST, FIRST.replace("1 s}", "@1}"), "histories[0].free_vibration: "),
        (WARM, f"{WARM}\n  - @{WARM}", "histories[2]: there is an analysis `warm.DBE.first` already; leave one of"),
        ("[10 degC, 35 degC]", "[10 degC, @35]", "histories[2].temperatures[1]: "),
        (
            "temperatures: [10 degC, 35 degC]",
            "temperatures: @35",
            "histories[2].temperatures: `35` is no temperature; write number",
        ),
        (
            "temperatures: [10 degC, 35 degC]",
            "temperatures: @-300 degC",
            "histories[2].temperatures: `-300 degC` is below absolute zero",
        ),
        ("modal: {modes: 2}", "modal: {modes: @99}", "modal.modes: there is no mode 99; the frame has "),
        # designs: what only a study knows
        ("criteria: drift,", "criteria: @drfit,", "added.verify.criteria: there is no criterion `drfit`; did you mean"),
        ("criteria: drift,", "criteria: [drift, @drift],", "designs.added.verify.criteria[1]: `drift` comes twice"),
        (
            "criteria: drift,",
            "criteria: @at MCE,",
            "added.verify.criteria: `at MCE` is of `MCE`, and the histories here",
        ),
        ("{records: set, levels: DBE,", "{records: @set/frist, levels: DBE,", "there is no recording `frist`; did you"),
        ("method: strain_energy", "method: @strain", "designs.added.method: "),
        ("law: rubber", "law: @ruber", "designs.added.law: there is no damper law `ruber`; did you mean `rubber`?"),
        # criteria, objectives
        ("most: 2 %", "@mots: 2 %", "criteria[1].mots: unknown key; did you mean `most`?"),
        ("objectives: [h]", "objectives: [@z]", "objectives[0]: "),
        ("objectives: [h]", "objectives: [@a]", "objective a needs a hazard level of 50 % in 50 years"),
        # outputs
        ("archive: out.h5", "archive: @out.txt", "outputs.archive: `out.txt` needs the ending .h5, .hdf5 or .nc"),
        ("[floors]", "[@flors]", "outputs.histories[0]: `flors` is unknown; did you mean `floors`?"),
        ("every: 2", "every: @0", "outputs.every: "),
        (
            DETAILS,
            DETAILS.replace("set/first", "@sett/first"),
            "outputs.details.records: there is no record `sett`; di",
        ),
        (DETAILS, DETAILS.replace("set/first", "@set/frist"), "outputs.details.records: there is no recording `frist`"),
        (DETAILS, DETAILS.replace("C_A_1", "@C_A_9"), "outputs.details.members[0]: there is no "),
        (f"details: {DETAILS}", "@details: {members: [C_A_1]}", "outputs.details.records: this key is missing"),
    ],
)
def test_each_mistake_is_reported_with_its_place(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = write(tmp_path, (old, new.replace("@", "")), ("criteria:\n", f"criteria:\n{AT_MCE}"))
    text = path.read_text(encoding="utf-8")
    at = text.index(new.replace("@", "")) + new.index("@")
    ((place, message),) = faults(path)
    assert place == f"{path}:{text.count(chr(10), 0, at) + 1}:{at - text.rfind(chr(10), 0, at)}"
    assert said.replace("{folder}", str(tmp_path)) in message


def test_a_verification_needs_levels(tmp_path: Path) -> None:
    path = write(tmp_path, ("{records: set, levels: DBE, criteria", "{records: set, criteria"))
    message = f"criteria judge histories at levels of the hazard: {LEVELS[14:-1]}"
    assert faults(path) == [(place_of(path, "verify:"), f"designs.added.verify.levels: this key is missing; {message}")]


def test_all_mistakes_are_reported_at_once(tmp_path: Path) -> None:
    path = write(tmp_path, ("levels: [DBE, MCE]", "levels: [DBF]"), ("records: set/first, m", "records: sett, m"))
    with pytest.raises(StudyError, match=f"2 problems in {path}"):
        load_study(path)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("masses: {from_loads: {}}\n", ""), "histories need `masses`, and {project} has none"),
        (("damping: {kind: rayleigh, ratio: 2 %}\n", ""), "histories need `damping`, and {project} has none"),
        (
            ("integration: {method: newmark, time_step: 0.01 s}\n", ""),
            "histories need `integration`, and {project} has",
        ),
    ],
)
def test_what_the_project_has_not(tmp_path: Path, change: tuple[str, str], said: str) -> None:
    path = write(tmp_path, project=(change,))
    with pytest.raises(InputError) as caught:
        load_study(path)
    project = tmp_path / "project.yaml"
    assert said.replace("{project}", str(project)) in str(caught.value) or str(caught.value).startswith(str(project))


def test_dampers_of_a_project_that_has_none(tmp_path: Path) -> None:
    path = write(tmp_path)
    text = path.read_text(encoding="utf-8").replace("{design: added", "{dampers: project")
    path.write_text(text[: text.index("designs:")] + text[text.index("variants:") :], encoding="utf-8")
    project = tmp_path / "project.yaml"
    text = project.read_text(encoding="utf-8")
    project.write_text(text[: text.index("dampers:")] + text[text.index("analyses:") :], encoding="utf-8")
    assert [message for _, message in faults(path)] == [
        f"variants.{name}.dampers: {project} has no devices, no attachments and no isolation under `dampers`"
        for name in ("damped", "upper", "warm")
    ]


def test_a_mistake_of_the_project_is_reported_with_its_own_place(tmp_path: Path) -> None:
    path = write(tmp_path, project=(("section: HEB200", "section: HEB201"),))
    ((place, message),) = faults(path)
    assert (
        place == place_of(tmp_path / "project.yaml", "HEB201")
        and "of HEB the catalogue has near it `HEB180`, `HEB200`" in message
    )


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
    assert "dampers.laws.rubber.temperature: gamma_T at 400 degC would be -3.2" in message


def test_project_and_study_are_not_taken_for_each_other(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path)
    project = tmp_path / "project.yaml"
    with pytest.raises(InputError) as caught:
        load_study(project)
    assert str(caught.value) == f"{project}:1:1: edesign: this is a project file; a study file begins with " + (
        "`edesign_study: 1`; `edesign run` runs it"
    )
    with pytest.raises(InputError) as caught:
        load_project(path)
    expected = f"{path}:1:1: edesign_study: this is a study file; a project file begins with `edesign: 1`; " + (
        "`edesign run` runs it"
    )
    assert str(caught.value) == expected
    itself = write(tmp_path, ("project: project.yaml", "project: study.yaml"))
    assert main(["run", str(itself)]) == 2
    assert capsys.readouterr().err == f"edesign: {expected}\n"


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
    assert (
        message == f"variants.bare.dampers: {project} has no devices, no attachments and no isolation under `dampers`"
    )


def test_a_place_of_a_design_that_the_frame_lacks(tmp_path: Path) -> None:
    """The place named is the design; the devices that stand for it are in no file."""
    gone = ("frame:\n", "frame:\n  missing: {columns: [{lines: A, storeys: 2}], beams: [{bays: 1, floors: 2}]}\n")
    ((place, message),) = faults(write(tmp_path, project=(gone,)))
    assert place == place_of(tmp_path / "study.yaml", "method: strain_energy")
    assert message.startswith("designs.added: there is no node `A2` ") and message.endswith(" [E-DESIGN-01]")
    assert message.count(" [E-") == 1


def test_what_nothing_will_be_judged_by_is_noted(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, ("criteria:\n", f"criteria:\n{AT_MCE}"), ("levels: [DBE, MCE]", "levels: DBE")))
    warnings = check_study(study)["warnings"]
    assert warnings.count("will not be judged") == 1
    assert "criterion `at MCE` will not be judged: no history at `MCE` is planned" in warnings
