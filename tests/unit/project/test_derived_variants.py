"""`vary`, `values` and `bounds` of a study: the variants that they make, and what is wrong, reported with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from messages import says

from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.project.study.derived import Derived
from edesign.project.study.study import Study
from edesign.project.study.study_loader import StudyError, parse_study
from edesign.study.check.check import check_study_inputs
from edesign.study.plan.study_plan import make_study_plan

CASE = Path(__file__).parents[2] / "cases" / "any_quantity"
TEXT = (CASE / "sweep.yaml").read_text(encoding="utf-8")
BOUNDS = "{upper: 1.3, lower_factors: {ageing: 0.9, test: 0.8, specification: 0.95}}"
BRACE = '"frame.braces[0].section", values: [IPE80, IPE120]'
DASHPOT = "dampers.laws.fluid.parameters.c"


@pytest.fixture(scope="module")
def study() -> Study:
    return load_study(CASE / "sweep.yaml")


def test_the_variants_that_are_made(study: Study) -> None:
    sweep = [f"damped_c_{i}" for i in (1, 2, 3)] + ["damped_brace_1", "damped_brace_2"]
    assert list(study.variants) == ["damped", "softer", "damped_lower", "damped_upper", *sweep]
    assert study.derived["damped_c_3"] == Derived("damped", ("vary", 0, "values", 2), "c", ("600 kN*s/m",))
    assert study.derived["damped_upper"] == Derived("damped", ("variants", "damped", "bounds"), bound="upper")
    assert study.named("damped_c_1") == study.named("damped") == "damped"
    assert study.variants_of(study.histories[0]) == tuple(study.variants)
    softer, dashpot = study.project_of("softer"), study.project_of("damped_c_3")
    assert softer.materials["S275"].E == 200e9 and study.base.materials["S275"].E == 210e9
    assert "c: 600 kN*s/m" in dashpot.text and study.project_of("damped") is study.base
    study.check_unchanged()
    study.afresh().check_unchanged()


def test_a_variant_that_is_named_takes_with_it_what_is_made_of_it() -> None:
    text = TEXT.replace("variants: all, levels", "variants: damped, levels")
    found = parse_study(text, CASE / "sweep.yaml", load_study(CASE / "sweep.yaml").base)
    assert set(found.variants_of(found.histories[0])) == set(found.variants) - {"softer"}


@pytest.mark.parametrize(
    ("old", "new", "key", "said"),
    [
        (BOUNDS, "{}", "variants.damped.bounds", "E-KEY-02"),
        ("upper: 1.3", "upper: 0.9", "variants.damped.bounds.upper", "E-VALUE-02"),
        ("{upper: 1.3,", "{upper: 1.3, temperatures: [30 degC, 0 degC],", "variants.damped.bounds.temp", "E-VALUE-04"),
        (
            "softer: {dampers: project,",
            "softer: {dampers: none, bounds: {upper: 2},",
            "variants.softer.bounds",
            "E-DAMPER-04",
        ),
        ("S275.E: 200", "S355.E: 200", "variants.softer.values.materials.S355.E", "`S355` E-NAME-01"),
        ("E: 200 GPa", "E: 200 kN", "variants.softer.values.materials.S275.E", "force E-UNIT-02"),
        ("materials.S275.E: 200 GPa", "hazard.a_gR: 0.2 g", "variants.softer.values.hazard.a_gR", "E-VARIANT-01"),
        (DASHPOT, "dampers.laws.fluit.parameters.c", "vary[0].place", "`fluid` E-NAME-01"),
        (
            "variants: damped, place: dampers",
            "variants: dampd, place: dampers",
            "vary[0].variants",
            "`damped` E-NAME-01",
        ),
        ("IPE80, IPE120]", "IPE80, IPE121]", "vary[1].values[1]", "`IPE120` E-NAME-01"),
        (
            '"frame.braces[0].section", values: [IPE80, IPE120]',
            "frame.storeys, values: [[4 m]]",
            "vary[1].values[0]",
            "",
        ),
        ("name: brace", "name: c", "vary[1].name", "E-NAME-02"),
        ("roof_acceleration,", "roof_acceleraton,", "vary[0].measures[1]", "`roof_acceleration` E-NAME-01"),
        ("roof_acceleration,", "{x: damper_force},", "vary[0].measures[1]", "E-VALUE-01"),
        ("  softer: {", "  damped_c_2: {", "vary[0].name", "E-NAME-02"),
        ("values: [40 kN*s/m, 150 kN*s/m, 600 kN*s/m]", "values: []", "vary[0].values", ""),
    ],
)
def test_what_is_wrong(old: str, new: str, key: str, said: str, study: Study) -> None:
    assert TEXT.count(old) == 1
    with pytest.raises(StudyError) as caught:
        parse_study(TEXT.replace(old, new), CASE / "sweep.yaml", study.base)
    first = caught.value.problems[0]
    assert first.keys_text.startswith(key) and says(first.message, said), str(caught.value)


def test_dampers_of_a_design_and_of_none_have_no_values(study: Study) -> None:
    text = TEXT.replace("  softer: {dampers: project, values: {materials.S275.E: 200 GPa}}", "  bare: {dampers: none}")
    text = text.replace("name: c, variants: damped", "name: c, variants: [damped, bare]")
    with pytest.raises(StudyError, match=r"vary\[0\].place.*E-DAMPER-04"):
        parse_study(text, CASE / "sweep.yaml", study.base)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("600 kN*s/m]", "600 kN]", r"vary\[0\].values\[2\].*force.*E-UNIT-02"),
        (DASHPOT, "dampers.laws.fluid.parameters.d", r"vary\[0\].values\[0\].* c.*E-LAW-02"),
    ],
)
def test_laws_of_other_values_are_checked_before_the_run(old: str, new: str, said: str, study: Study) -> None:
    found = parse_study(TEXT.replace(old, new), CASE / "sweep.yaml", study.base)
    with pytest.raises(InputError, match=said):
        check_study_inputs(found, make_study_plan(found))


GRID = """\
  - name: g
    variants: damped
    grid:
      dampers.laws.fluid.parameters.c: [40 kN*s/m, 150 kN*s/m]
      materials.S275.E: [200 GPa, 205 GPa, 210 GPa]
"""


def of_grid(study: Study, grid: str = GRID) -> Study:
    begin, _, rest = TEXT.partition("  - {name: c,")
    _, _, end = rest.partition("IPE120]}\n")
    return parse_study(begin + grid + end, CASE / "sweep.yaml", study.base)


def test_a_grid_makes_a_variant_of_every_combination(study: Study) -> None:
    found = of_grid(study)
    made = [name for name, source in found.derived.items() if source.vary == "g"]
    assert made[:4] == ["damped_g_1_1", "damped_g_1_2", "damped_g_1_3", "damped_g_2_1"] and len(made) == 6
    project = found.project_of("damped_g_1_3")
    assert project.materials["S275"].E == 210e9 and "c: 40 kN*s/m" in project.text
    assert found.derived["damped_g_1_3"].said == "40 kN*s/m, 210 GPa"


@pytest.mark.parametrize(
    ("old", "new", "key", "said"),
    [
        ("205 GPa", "205 kN", "vary[0].grid.materials.S275.E[1]", "force E-UNIT-02"),
        ("materials.S275.E", "materials.S355.E", "vary[0].grid.materials.S355.E", "`S355` E-NAME-01"),
        ("materials.S275.E: [", "hazard.a_gR: [", "vary[0].grid.hazard.a_gR", "E-VARIANT-01"),
        ("    grid:", "    place: materials.S275.E\n    grid:", "vary[0]", "either E-KEY-03"),
        ("    grid:", "    values: [200 GPa]\n    grid:", "vary[0]", "together E-KEY-03"),
        ("[40 kN*s/m, 150 kN*s/m]", "[]", "vary[0].grid.dampers.laws.fluid.parameters.c", ""),
        ("  - name: g", "  - {name: g_1, variants: damped, place: materials.S275.E, values: [200 GPa]}\n  - name: g",
         "vary[1].name", "`damped_g_1_1` E-NAME-02"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_grid(old: str, new: str, key: str, said: str, study: Study) -> None:
    assert GRID.count(old) == 1
    with pytest.raises(StudyError) as caught:
        of_grid(study, GRID.replace(old, new))
    first = caught.value.problems[0]
    assert first.keys_text == key and says(first.message, said), str(caught.value)


def test_a_grid_is_written_from_python(study: Study) -> None:
    places = {"dampers.laws.fluid.parameters.c": ["40 kN*s/m", "150 kN*s/m"], "materials.S275.E": ["200 GPa"]}
    found = study.with_values("vary", [{"name": "g", "variants": "damped", "grid": places}])
    assert [name for name in found.derived if "_g_" in name] == ["damped_g_1_1", "damped_g_2_1"]
