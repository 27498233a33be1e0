"""Sections chosen for small buildings: beside enumeration, and what is reported where none does."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from building_examples import building
from selection_examples import FRAMES, INTERIOR, enumerated, random_frames

from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.frame.sections.steel_section import steel_section
from edesign.one_thread import one_thread
from edesign.project.reading.problems import FileProblems
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.basis import selection_table
from edesign.report.building.tables.selection import selection_tables
from edesign.report.tables.number import significant
from edesign.space.check import check_building
from edesign.space.checks.rules import brace_slenderness
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis, elastic_design
from edesign.space.selection.evaluate import Evaluator, utilisations
from edesign.space.selection.groups import groups_of
from edesign.space.selection.search import Search, column_order
from edesign.space.selection.select import Selection, _left_out, governing_check, select_sections, with_sections
from edesign.space.selection.wishes import nominal_depth

TEXT = FRAMES.format(
    bays=2,
    width=6.0,
    storeys=4,
    lower=2,
    above=3,
    upper_beams="B2",
    G=5.0,
    a_gR=0.24,
    ductility="high",
    q=6.5,
    q_y=4,
    drift="ductile",
    columns="HEB",
    beams="IPE",
)
"""Two frames of two bays and four storeys, four groups to choose, whole families."""


@pytest.fixture(scope="module")
def whole() -> Selection:
    """The sections chosen for TEXT."""
    return select_sections(building(TEXT))


def compared(one: ElasticDesign, other: ElasticDesign) -> None:
    """1e-9: both solve the same equations, one after a new factorisation in an old order of pivots."""
    np.testing.assert_allclose(one.modes.period, other.modes.period, rtol=1e-9)
    np.testing.assert_allclose(one.frame.node_mass, other.frame.node_mass, rtol=1e-9)
    np.testing.assert_allclose(one.members.utilisation, other.members.utilisation, rtol=1e-9, atol=1e-12)
    for mine, its in zip(one.criteria, other.criteria, strict=True):
        assert (mine.clause, mine.passed) == (its.clause, its.passed)
        assert mine.value == pytest.approx(its.value, rel=1e-9, abs=1e-12)
    for joint, same in zip(one.joints, other.joints, strict=True):
        assert (joint.node, joint.ratio) == (same.node, pytest.approx(same.ratio, rel=1e-9))


def test_an_analysis_with_other_sections_is_that_of_a_file_with_them() -> None:
    file = building(TEXT)
    analysis = ElasticAnalysis(file)
    for sections in (
        {"C1": "HEB400", "B1": "IPE450"},
        {"C1": "HEM300", "C2": "HEA300", "B1": "IPE300", "B2": "IPE270", "D": "SHS200x10"},
        {"BY": "IPE270"},
    ):
        found = analysis.design(sections)
        compared(found, elastic_design(with_sections(file, sections)))
    compared(analysis.design(), elastic_design(file))


def test_an_evaluation_meets_its_checks_as_the_design_does() -> None:
    """Every limit at most 1 is the same as every check and rule met, and the excess is none only then."""
    with one_thread():
        for seed in range(40, 46):
            analysis = ElasticAnalysis(random_frames(seed, 6, 4))
            evaluate = Evaluator(analysis, groups_of(analysis))
            for choice in ((0, 0, 0, 0, 0, 0), (5, 5, 5, 0, 5, 0), (5, 0, 2, 0, 1, 0)):
                found, design = evaluate(choice), evaluate.design(choice)
                over = np.concatenate(list(utilisations(design, evaluate.searched).values()))
                limits = [rule for rule in design.criteria if rule.clause in evaluate.searched]
                met = not (design.members.utilisation > 1.0).any() and all(rule.passed is not False for rule in limits)
                assert found.met == met == bool((over <= 1.0 + 1e-9).all())
                assert (found.excess == 0.0) == bool((over <= 1.0).all())


def test_members_of_class_4_are_refused_and_count_as_failed_in_a_search() -> None:
    """IPE400 of 460 MPa under N = 0.7 A f_y: c/t = 38.5 is above 42 eps / (0.67 + 0.33 psi), 37.6 for psi = 0.38."""
    heavy = building(
        TEXT.replace("HEB300", "IPE400"), ("G: 5.00 kN/m^2", "G: 60 kN/m^2"), ("{fy: 275 MPa}", "{fy: 460 MPa}")
    )
    with pytest.raises(InputError, match=r"C_\w+_1: IPE400 of S275 .*E-EC3-03"):
        elastic_design(heavy)
    analysis = ElasticAnalysis(heavy)
    design = analysis.design()
    assert {design.frame.members[number].group for number in design.members.slender} == {"C1"}
    assert np.isinf(np.nanmax(design.members.utilisation[list(design.members.slender)], axis=1)).all()
    assert not analysis.design({"C1": "HEB600"}).members.slender


@pytest.mark.parametrize(
    "seeds", [(9, 10, 11, 12), pytest.param((*range(9), *range(13, 20)), marks=pytest.mark.slow)], ids=["some", "more"]
)
def test_choices_are_those_of_enumeration(seeds: tuple[int, ...]) -> None:
    """Of 20 small problems all optima; the loop was proven by enumeration on 80 larger ones (the study below).

    No choice meets all checks of 11, 12, 16 and 18.
    """
    with one_thread():
        for seed in seeds:
            file = random_frames(seed, 4, 3)
            best = enumerated(file)
            if best is None:
                with pytest.raises(InputError, match="E-SPACE-07"):
                    select_sections(file)
            else:
                found = select_sections(file)
                assert found.certified and found.mass == pytest.approx(best.mass, rel=1e-9), seed


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "cheap"), [(23, "HEB"), (27, "IPE")])
def test_with_prices_the_choice_is_the_cheapest_of_enumeration(seed: int, cheap: str) -> None:
    """One family at a tenth of the price of the others: the cheapest frame of these is not the lightest one."""
    prices = f"    objective: cost\n    prices: {{default: 1, {cheap}: 0.1}}\n    lists:"
    with one_thread():
        file = random_frames(seed, 4, 3)
        priced = building(file.text, ("    lists:", prices))
        found, best, lightest = select_sections(priced), enumerated(priced), select_sections(file)
    assert best is not None and found.cost == pytest.approx(best.cost, rel=1e-9)
    assert found.mass > 1.005 * lightest.mass


COLUMNS = "columns: [HEA260, HEB260, HEM260, HEA300, HEB300, HEM300, HEB340]"
WISHES = {
    "same_depth: columns": "one nominal depth of columns in a line",
    "same_depth: beams": "one nominal depth of beams in a line",
    "most_sections: {columns: 1, beams: 2}": "at most 1 section of columns, at most 2 sections of beams",
    "most_sections: {all: 4}": "at most 4 sections of all members",
    "same_depth: [columns, beams]\n    most_sections: {beams: 2}": "at most 2 sections of beams",
}


def fabricated(seed: int, wish: str) -> str:
    """A random frame of columns in three widths and beams of a group a bay, with a wish."""
    text = re.sub(r"columns: \[HE.*\]", COLUMNS, random_frames(seed, 4, 4).text)
    text = re.sub(r"count: [12], ", "count: 2, ", text)
    text = re.sub(r"along: x, floors: [0-9-]+, section: IPE360", "along: x, bays: 1, section: IPE360", text)
    text = re.sub(r"along: x, floors: [0-9-]+, section: IPE330", "along: x, bays: 2, section: IPE330", text)
    return text.replace("    lists:", f"    {wish}\n    lists:")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3, 5, 8])
@pytest.mark.parametrize("wish", WISHES)
def test_wishes_of_a_fabricator_are_granted_at_the_least_mass(seed: int, wish: str) -> None:
    """Enumeration of all choices that the wish allows; and what it costs beside the choice of a file without it."""
    with one_thread():
        file = building(fabricated(seed, wish))
        best = enumerated(file)
        if best is None:  # of seed 8 alone
            with pytest.raises(InputError, match="E-SPACE-07"):
                select_sections(file)
            return
        found = select_sections(file)
        assert found.certified and found.mass == pytest.approx(best.mass, rel=1e-9)
        (free,) = [enumerated(building(file.text.replace(wish, "most_sections: {columns: 99}")))]
    assert found.free is not None and free is not None and found.free.best.mass == pytest.approx(free.mass, rel=1e-9)
    (told,) = [note for note in selection_tables(found)[-1].notes if note.startswith("wishes: ")]
    assert WISHES[wish] in told and f"they cost {significant((best.mass - free.mass) / 1e3)} t of steel" in told


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3, 5])
@pytest.mark.parametrize(("splice", "doubler"), [(900, 1), (1, 700), (400, 400)])
def test_splices_and_doublers_count_in_the_price(seed: int, splice: int, doubler: int) -> None:
    """Enumeration with the price of each; a doubler is known after the analysis alone."""
    each = f"objective: cost\n    prices: {{default: 2}}\n    prices_each: {{splice: {splice}, doubler: {doubler}}}"
    with one_thread():
        file = building(fabricated(seed, each))
        best, found = enumerated(file), select_sections(file)
    assert best is not None and found.cost == pytest.approx(best.cost, rel=1e-9) and found.certified
    columns = [member for member in found.design.frame.members if member.kind == "column"]
    section = {member.end: member.section for member in columns}
    spliced = sum(section.get(member.start, member.section) != member.section for member in columns)
    plates = sum(panel.doubler > 0.0 for panel in found.design.panels)
    assert (found.splices, found.doublers) == (spliced, plates)
    assert found.cost == pytest.approx(2.0 * found.mass + splice * spliced + doubler * plates, rel=1e-9)


def test_what_binds_groups_together() -> None:
    """Columns above each other, beams that meet; sections at least as large that the wishes allow."""
    file = building(fabricated(2, "same_depth: [columns, beams]\n    most_sections: {beams: 2}"))
    analysis = ElasticAnalysis(file)
    evaluate = Evaluator(analysis, groups_of(analysis))
    names, wishes = [group.name for group in evaluate.groups], evaluate.wishes
    assert [{names[group] for group in line} for line in wishes.lines] == [{"C1", "C2"}, {"B1", "B2"}]
    assert [nominal_depth(name) for name in ("HEB300", "IPE 330", "W18X50", "SHS150x8")] == [300, 330, 18, 150]
    numbers = [0] * len(names)
    numbers[names.index("C1")] = len(evaluate.groups[names.index("C1")].sections) - 1
    numbers[names.index("B2")] = 2
    raised = wishes.raised(numbers)
    assert raised is not None and wishes.met(raised) and not wishes.met(numbers)
    assert all(
        group.area[now] >= group.area[before]
        for group, now, before in zip(evaluate.groups, raised, numbers, strict=True)
    )


def test_what_no_list_can_grant_is_refused() -> None:
    text = fabricated(2, "same_depth: columns").replace("groups: {BY", "groups: {C1: [HEB300], C2: [HEB260], BY")
    with pytest.raises(InputError, match=r"design.select: no sections .*`same_depth`.*E-SPACE-07"):
        select_sections(building(text))
    with pytest.raises(InputError, match=r"prices_each.splice: prices count where the objective is .cost."):
        building(fabricated(2, "prices_each: {splice: 3}"))


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("objective: cost", r"design.select.objective: .cost. needs the prices of a kilogram"),
        ("prices: {HEB: 2}", r"design.select.prices: prices count where the objective is .cost."),
        ("objective: cost\n    prices: {HEB: 2}", r" IPE, .* IPE\w+ .*E-SPACE-08"),
        ("objective: cost\n    prices: {HEB: 0, default: 1}", r"design.select.prices.HEB"),
    ],
)
def test_prices_that_are_missing_or_idle_are_named(keys: str, message: str) -> None:
    with pytest.raises((FileProblems, InputError), match=message):
        select_sections(building(TEXT, ("    lists:", f"    {keys}\n    lists:")))


@pytest.mark.study
def test_choices_of_eighty_frames_are_those_of_enumeration() -> None:
    """Four groups of nine sections: all but two are optima, none more than 1.7 % heavier.

    These are the figures of an independent prototype of the loop. Of a frame that no choice lets meet the checks, as
    that of seed 68, the search says so.
    """
    gaps = []
    with one_thread():
        for seed in range(80):
            file = random_frames(seed, 9, 4)
            best = enumerated(file)
            if best is None:
                with pytest.raises(InputError, match="the search found no sections of the lists that meet all checks"):
                    select_sections(file)
                continue
            gaps.append(select_sections(file).mass / best.mass - 1.0)
    assert len(gaps) >= 78
    assert sum(gap < 1e-9 for gap in gaps) >= len(gaps) - 2
    assert max(gaps) <= 0.017


@pytest.mark.slow
def test_no_exchange_of_a_certified_choice_is_lighter_and_meets_the_checks() -> None:
    with one_thread():
        file = building(TEXT)
        analysis = ElasticAnalysis(file)
        evaluate = Evaluator(analysis, groups_of(analysis))
        search = Search(evaluate, column_order(analysis.frame, evaluate.groups), 10_000)
        found = search.run(2)
        assert found.certified and found.best.met
        count = evaluate.count
        assert all(not evaluate(choice).met for choice in search.lighter(found.best.choice))
        assert evaluate.count == count  # the search has analysed them all


@pytest.mark.slow
def test_a_search_is_repeatable() -> None:
    file = building(TEXT)
    lines: list[list[str]] = [[], []]
    one, other = (select_sections(file, reported.append) for reported in lines)
    assert lines[0] == lines[1] and one.evaluations == other.evaluations
    assert one.building.text == other.building.text


def test_the_design_of_a_selection_is_that_of_its_file(whole: Selection) -> None:
    compared(whole.design, elastic_design(building(whole.building.text)))
    steel = sum(row.mass for row in whole.groups)
    assert whole.mass == pytest.approx(steel, rel=1e-12)
    assert all(row.governing.utilisation <= 1.0 for row in whole.groups)
    assert {row.group.name: row.held_by for row in whole.groups}["BY"] == "the lightest of its list"
    # its plan is torsionally soft, r < l_s, which takes alpha_u / alpha_1 away: no section gives q = 6.5 back
    assert {rule.clause for rule in whole.not_met} <= {"6.3.2(1)", "6.7.3(2)", "6.7.3(8)"}


def test_the_interior_frame_of_the_thesis_by_strength_is_no_heavier_than_an_independent_loop_finds_it() -> None:
    """41.3 t a frame by an independent numpy loop: strength and capacity alone, without second-order effects."""
    file = building(INTERIOR)
    file = file.with_values(
        {
            "design.drift": "none",
            "design.second_order": "none",
            "design.select.leave_out": ["6.5.3(2)", "6.6.3(6)", "6.7.3(1)", "6.7.3(2)", "6.7.3(8)", "4.4.2.2(3)"],
            "design.select.starts": 1,
        }
    )
    found = select_sections(file)
    assert sum(row.mass for row in found.groups if len(row.group.sections) > 1) / 2.0 <= 41.3e3


@pytest.mark.slow
@pytest.mark.study
def test_the_interior_frame_of_the_thesis_by_all_of_ec8() -> None:
    """54.4 t a frame by the independent loop, whose sections miss sum M_Rc / sum M_Rb here: 1.28 for 1.3.

    Of the 9000 choices next below it in mass, each group within three sizes, down to 52.4 t, none meets all checks.
    Rules that the independent loop does not know, for column bases and web panels, are left out.
    """
    found = select_sections(building(INTERIOR))
    frame = sum(row.mass for row in found.groups if len(row.group.sections) > 1) / 2.0
    assert frame <= 54.441e3  # a kg for the last digit


# --- what is reported


def test_a_member_without_resistance_is_reported_in_words() -> None:
    members = SimpleNamespace(
        utilisation=np.array([[np.nan, np.inf]]),
        combination=np.array([[0, 1]]),
        checks=("N", "EQ_6_61"),
        clauses=("EN 1993-1-1, 6.2.3", "EN 1993-1-1, 6.3.3"),
        rows=(SimpleNamespace(name="1.35 G"),),
    )
    frame = SimpleNamespace(members=(SimpleNamespace(group="BY", name="BY_B_1_3"),))
    governing = governing_check(SimpleNamespace(members=members, frame=frame), "BY")  # type: ignore[arg-type]
    assert math.isinf(governing.utilisation)
    assert str(governing).startswith("EQ_6_61 (EN 1993-1-1, 6.3.3): no resistance is left to BY_B_1_3 in 1.35 G")


def test_what_stands_in_the_way_is_reported() -> None:
    file = building(TEXT, ("beams: [IPE]", "beams: [IPE200, IPE220]"))
    with pytest.raises(InputError) as error:
        select_sections(file)
    said = str(error.value)
    assert said.startswith("building.yaml:30:5: design.select: ") and said.endswith("[E-SPACE-07]")
    assert "in the way: B1: M_Y" in said and "B1 has IPE220, the heaviest of its list" in said


def test_sections_of_too_high_a_class_are_left_out_by_name() -> None:
    lines: list[str] = []
    brief = ("leave_out:", "evaluations: 2\n    leave_out:")  # it is reported before the search
    with pytest.raises(InputError, match="by `evaluations` .E-SPACE-07"):
        select_sections(building(TEXT, ("D: [SHS150x8]", "D: [SHS200x5, SHS150x8]"), brief), lines.append)
    assert lines[0] == "left out for their class, thickness or slenderness: of group D SHS200x5"


def test_groups_of_a_kind_share_a_line_that_stays_short() -> None:
    base = next(of for of in groups_of(ElasticAnalysis(building(TEXT))) if of.name == "D")
    names = tuple(f"SHS{i}" for i in range(9))
    groups = [replace(base, name="D1", left_out=(*names, "SHS90")), replace(base, name="D2", left_out=names)]
    (line,) = _left_out([*groups, replace(base, left_out=())])
    assert line == (
        "left out for their class, thickness or slenderness: of groups D1, D2 SHS0, SHS1, SHS2, SHS3, SHS4, SHS5 "
        "and 3 more; of group D1 also SHS90"
    )
    apart = [replace(base, name=name, left_out=(name,)) for name in ("D1", "D2")]
    assert next(_left_out(apart)).endswith(": of group D1 D1; of group D2 D2")


def test_lists_of_diagonals_hold_what_has_an_allowed_slenderness() -> None:
    """Crosses of more than two storeys: 1.3 < lambda <= 2.0 (EN 1998-1, 6.7.3(1)); thin large tubes are below it."""
    asked = building(TEXT, ("D: [SHS150x8]", "D: [SHS]"), ("6.7.3(1), ", ""))
    analysis = ElasticAnalysis(asked)
    group = next(of for of in groups_of(analysis) if of.name == "D")
    numbers = np.array([n for n, member in enumerate(analysis.frame.members) if member.group == "D"])
    assert "SHS250x8" in group.left_out and len(group.sections) > 5
    for section in group.sections:
        slender = brace_slenderness(asked, analysis.sections.frame_with({"D": section}), numbers)
        assert ((slender > 1.3) & (slender <= 2.0)).all()
    free = next(
        of for of in groups_of(ElasticAnalysis(building(TEXT, ("D: [SHS150x8]", "D: [SHS]")))) if of.name == "D"
    )
    assert "SHS250x8" in free.sections


def test_wrong_lists_are_reported_at_their_place() -> None:
    with pytest.raises(InputError, match="building.yaml:31:17: design.select.lists.columns: .*HEBB.*E-NAME-01"):
        select_sections(building(TEXT, ("columns: [HEB]", "columns: [HEBB]")))
    with pytest.raises(InputError, match="design.select.lists.groups.D: `RHS` .*E-SECT-03"):
        select_sections(building(TEXT, ("D: [SHS150x8]", "D: [RHS]")))
    with pytest.raises(FileProblems, match="there is no group `DD`; did you mean `D`?"):
        building(TEXT, ("D: [SHS150x8]", "DD: [SHS150x8]"))
    with pytest.raises(FileProblems, match="largest_depth.beam: there is no group `beam`; did you mean `beams`?"):
        building(TEXT, ("leave_out:", "largest_depth: {beam: 400 mm}\n    leave_out:"))
    with pytest.raises(InputError, match="group D .* class above 1, .* `SHS200x5` .E-SPACE-07"):
        select_sections(building(TEXT, ("D: [SHS150x8]", "D: [SHS200x5]")))
    with pytest.raises(InputError, match="E-SPACE-07"):
        select_sections(building(TEXT, ("groups: {BY", "groups: {C1: [HEB200], C2: [HEB300], BY")))


def test_check_knows_the_families_that_have_prices() -> None:
    """Before any analysis; `default` is none of them and stands for the rest."""
    prices = "    objective: cost\n    prices: {%s: 2, default: 1}\n    lists:"
    check_building(building(TEXT, ("    lists:", prices % "HEB")))
    with pytest.raises(InputError, match=r"building.yaml:31:\d+: design.select.prices: .*`HEC`; did you mean"):
        check_building(building(TEXT, ("    lists:", prices % "HEC")))
    with pytest.raises(InputError, match="design.select.lists.columns: .*HEBB.*E-NAME-01"):
        check_building(building(TEXT, ("columns: [HEB]", "columns: [HEBB]")))


def test_beams_are_no_deeper_than_the_file_allows(whole: Selection) -> None:
    found = select_sections(building(TEXT, ("leave_out:", "largest_depth: {beams: 290 mm}\n    leave_out:")))
    assert max(steel_section(row.after).h for row in whole.groups if row.group.kind == "beam") > 0.29
    assert max(steel_section(row.after).h for row in found.groups if row.group.kind == "beam") <= 0.29
    assert found.mass > whole.mass


def test_a_budget_of_evaluations_ends_the_search_with_what_it_has(whole: Selection) -> None:
    found = select_sections(building(TEXT, ("leave_out:", f"evaluations: {whole.evaluations // 3}\n    leave_out:")))
    assert not found.certified and found.mass >= whole.mass
    with pytest.raises(InputError, match="by `evaluations` .E-SPACE-07"):
        select_sections(building(TEXT, ("leave_out:", "evaluations: 2\n    leave_out:")))


# --- the command


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "building.yaml"
    path.write_text(TEXT)
    return path


def test_design_writes_a_file_that_runs_and_passes(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["design", "building.yaml", "--output", "new.yaml"]) == 0
    said = capsys.readouterr()
    assert "sections of the file: all checks met with" in said.err and " of 3: " in said.err
    assert "What holds each group up" in said.out
    assert "certificate: no single and no double exchange of sections is lighter and meets all checks" in said.out
    assert said.out.splitlines()[-1] == "new.yaml and new.h5 written. Next: edesign report new.h5"
    lines = Path("new.yaml").read_text().splitlines()
    assert lines[0].startswith("# Written by edesign ") and ' from "building.yaml"; ' in lines[0]
    assert lines[1].startswith("# Sections chosen: ") and lines[1].endswith(" designs analysed.")
    for old, new in zip(TEXT.splitlines(), lines[2:], strict=True):
        assert old == new or ("section: " in old and old.split("section: ")[0] == new.split("section: ")[0])
    assert main(["check", "new.yaml"]) == 0
    with open_archive("new.h5") as archive:
        chosen = archive.group("building/selection").variables
        assert archive.attributes["building_checksum"] == load_building("new.yaml").checksum
    assert main(["run", "new.yaml", "--quiet"]) == 0  # the same archive, which keeps what is known
    with open_archive("new.h5") as archive:
        assert (archive.group("building/selection").variables["held_by"].values == chosen["held_by"].values).all()
        table = selection_table(BuildingResults(archive))
    assert [row[2] for row in table.rows] == chosen["after"].values.tolist()
    Path("new.yaml").write_text("\n".join([*lines, "# changed", ""]))
    assert main(["run", "new.yaml", "--quiet"]) == 0  # another text: how its sections came is not known
    with open_archive("new.h5") as archive:
        assert not archive.has("building/selection")


def test_design_writes_nothing_where_it_fails(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file.write_text(TEXT.replace("beams: [IPE]", "beams: [IPE200]"))
    assert main(["design", "building.yaml", "--quiet"]) == 2
    said = capsys.readouterr()
    assert said.out == "" and "in the way: B1" in said.err and "Traceback" not in said.err
    assert not Path("designed.yaml").exists()
    Path("designed.yaml").write_text("mine\n")
    assert main(["design", "building.yaml", "--quiet"]) == 2
    assert "edesign did not write this file" in capsys.readouterr().err


def test_an_interrupted_design_leaves_nothing(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(self: Evaluator, choice: tuple[int, ...]) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Evaluator, "__call__", stop)
    assert main(["design", "building.yaml"]) == 130
    assert [path.name for path in file.parent.iterdir()] == ["building.yaml"]
