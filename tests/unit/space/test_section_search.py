"""The search of sections: where it starts, what it proposes for all groups at once, what it says if it finds none."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from building_examples import building
from selection_examples import FRAMES, enumerated, random_frames

from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.one_thread import one_thread
from edesign.project.building import Building
from edesign.report.building.tables.selection import selection_tables
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.evaluate import Evaluation, Evaluator
from edesign.space.selection.groups import Group, groups_of
from edesign.space.selection.search import Search, column_order
from edesign.space.selection.select import select_sections
from edesign.space.selection.separable import Separable

STOREYS = range(1, 5)


def frames(seed: int = 9, *changes: tuple[str, str]) -> Building:
    return building(random_frames(seed, 4, 4).text, *changes)


def changed_sections(file: Building, **sections: str) -> Building:
    """The file with other sections of its groups."""
    text = file.text
    for group, section in sections.items():
        text = re.sub(rf"section: \w+(, .*group: {group}\b)", rf"section: {section}\1", text)
    return building(text)


def test_the_sections_of_the_file_are_a_start_whatever_its_lists() -> None:
    """One that meets its checks and one that does not: with one design allowed nothing worse than the file is left."""
    file = frames(1)
    with one_thread():
        analysis = ElasticAnalysis(file)
        evaluate = Evaluator(analysis, groups_of(analysis))
        heavy = tuple(len(group.sections) - 1 for group in evaluate.groups)
        light = (0,) * len(heavy)
        for choice in (heavy, light):
            given = changed_sections(file, **evaluate.sections(choice))
            of_file = Evaluator(ElasticAnalysis(given), evaluate.groups)
            search = Search(of_file, column_order(analysis.frame, evaluate.groups), 1)
            found = search.run(1, {"sections of the file": choice})
            assert (found.best.choice, found.best.met) == (choice, evaluate(choice).met)
        assert evaluate(heavy).met and not evaluate(light).met


def test_a_section_off_the_lists_starts_as_the_nearest_one_and_is_told() -> None:
    """The cheapest that has the area and the inertia of the section."""
    file = changed_sections(frames(), C1="HEM300", B1="IPE240")
    lines: list[str] = []
    with one_thread():
        found = select_sections(file, lines.append)
        groups = {row.group.name: row.group for row in found.groups}
        best = enumerated(file)
    assert best is not None and found.mass == pytest.approx(best.mass, rel=1e-9)
    (told,) = [line for line in lines if line.startswith("start from the sections of the file, but for")]
    for group, before in (("C1", "HEM300"), ("B1", "IPE240")):
        of, own = groups[group], steel_section(before)
        fits = [name for name in of.sections if (at := steel_section(name)).A >= own.A and at.I_y >= own.I_y]
        assert f"{group} {(fits or of.sections[-1:])[0]} for {before}" in told
    assert any(line.startswith("sections of the file: ") for line in lines)


def test_a_section_of_the_file_stays_in_its_list_though_a_lighter_one_is_better() -> None:
    """SHS160x10 is heavier than SHS180x8 and has less of all inertias and moduli."""
    text = frames().text.replace("D: [SHS150x8]", "D: [SHS]").replace("section: SHS150x8", "section: SHS160x10")
    groups = {
        name: next(of for of in groups_of(ElasticAnalysis(building(text_of))) if of.name == "D")
        for name, text_of in (("own", text), ("other", text.replace("SHS160x10", "SHS150x8")))
    }
    assert "SHS160x10" in groups["own"].sections and "SHS160x10" not in groups["other"].sections


def braced(sizes: str = "[SHS60x4, SHS70x5, SHS80x5, SHS90x6]") -> Building:
    """A frame of four storeys whose diagonals, a group a storey, must have like Omega."""
    text = FRAMES.format(
        bays=1,
        width=6.0,
        storeys=4,
        lower=2,
        above=3,
        upper_beams="B2",
        G=5.0,
        a_gR=0.16,
        ductility="medium",
        q=4,
        q_y=4,
        drift="none",
        columns="HEB450",
        beams="IPE400",
    )
    (row,) = re.findall(r".*group: D}\n", text)
    rows = [row.replace("bays: 1,", f"bays: 1, storeys: {k},").replace("group: D", f"group: D{k}") for k in STOREYS]
    text = text.replace(row, "".join(rows))
    text = text.replace("D: [SHS150x8]", ", ".join(f"D{k}: {sizes}" for k in STOREYS))
    return building(text.replace(", 6.7.3(8)]", "]"))


def test_diagonals_of_like_overstrength_are_those_of_enumeration() -> None:
    """6.7.3(8): of 4^4 choices the lightest whose Omega differ by 25 % at most."""
    with one_thread():
        file = braced()
        best, found = enumerated(file), select_sections(file)
    assert best is not None and found.certified and found.mass == pytest.approx(best.mass, rel=1e-9)
    assert found.evaluations < 4**4 / 2
    ratios = found.design.overstrength["y"].ratios
    assert ratios.max() / ratios.min() <= 1.25


def test_diagonals_in_the_way_are_named_and_no_others() -> None:
    """One size for all storeys: Omega grows upwards, and no list helps; beams at the end of theirs do not count."""
    with pytest.raises(InputError) as error:
        select_sections(braced("[SHS100x8]"))
    said = str(error.value)
    assert "the search found no sections of the lists that meet all checks" in said and "no proof" in said
    (line,) = [line for line in said.splitlines() if "6.7.3(8)" in line]
    values = {group: float(value) for value, group in re.findall(r"([0-9.]+) of (D\d) DY_\w+", line)}
    assert list(values) == ["D1", "D2", "D3", "D4"] and values["D4"] > 1.25 * values["D1"]
    ends = [line.split()[0] for line in said.splitlines() if line.endswith("the heaviest of its list")]
    assert ends == ["D1", "D2", "D3", "D4"]


def test_a_group_of_diagonals_whose_omega_no_section_makes_alike_is_named() -> None:
    """One group over four storeys: the forces differ by more than 25 %, and so does Omega whatever the section."""
    text = re.sub(
        r"storeys: [1-4], kind: cross(.*)group: D[1-4]", r"storeys: 1-4, kind: cross\1group: D", braced().text
    )
    text = re.sub(r"(  - .*group: D}\n)+", lambda of: of[0].splitlines()[0] + "\n", text)
    text = re.sub(r"D1: .*D4: \[.*?\]", "D: [SHS80x5, SHS90x6, SHS100x8]", text)
    with pytest.raises(
        InputError, match=r"no section makes it alike within D \([0-9.]+ to [0-9.]+\): smaller groups do"
    ):
        select_sections(building(text))


def test_sections_of_the_file_off_the_lists_that_are_nearer_are_told() -> None:
    """Beams of the list are too small for any column; those of the file are not."""
    file = changed_sections(frames(), B1="IPE600", B2="IPE600")
    file = building(re.sub(r"beams: \[.*\]", "beams: [IPE200]", file.text))
    with pytest.raises(InputError, match=r"the sections of the file are nearer, but its lists or wishes exclude some"):
        select_sections(file)


def test_a_model_of_single_exchanges_finds_the_best_of_many_together() -> None:
    """Utilisations that are products of powers of areas: the model is exact, and its proposal that of enumeration."""
    random = np.random.default_rng(3)
    areas = [np.cumprod(1.0 + random.uniform(0.1, 0.4, 4)) for _ in range(4)]
    powers, levels = random.uniform(0.0, 1.0, (6, 4)), random.uniform(1.2, 2.5, 6)
    groups = [_group(of) for of in areas]

    def evaluation(choice: tuple[int, ...]) -> Evaluation:
        logs = np.log(levels) - powers @ np.log([of[k] for of, k in zip(areas, choice, strict=True)])
        cost = float(sum(of[k] for of, k in zip(areas, choice, strict=True)))
        over = np.exp(logs)
        return Evaluation(
            choice, cost, cost, bool((over <= 1.0).all()), float(np.maximum(over - 1.0, 0.0).sum()), 0.0, 0, logs
        )

    base = evaluation((0, 0, 0, 0))
    model = Separable(base, groups, (), lambda choice: evaluation(choice).cost, lambda choice: True)
    for group, number in product(range(4), range(1, 4)):
        model.learn(evaluation(tuple(number if k == group else 0 for k in range(4))), group)
    proposal = model.proposal()
    best = min((of for of in map(evaluation, product(range(4), repeat=4)) if of.met), key=lambda of: of.cost)
    assert proposal is not None and evaluation(proposal).met
    assert evaluation(proposal).cost <= 1.02 * best.cost  # exchanges of two groups at a time, no enumeration
    missed = evaluation(proposal)
    model.refuse(replace(missed, logs=missed.logs + 0.1))
    assert model.proposal() != proposal


def _group(areas: np.ndarray) -> Group:
    sizes, cost = tuple(f"S{k}" for k in range(len(areas))), tuple(areas.tolist())
    return Group("G", "beam", "S275", sizes, cost, cost, cost, (), ((),) * len(sizes), ())


def test_wishes_that_come_out_cheaper_cost_nothing() -> None:
    """A search without them that was cut short may hold worse sections; these are allowed with the wishes, too."""
    file = building(frames(1).text.replace("    lists:", "    most_sections: {all: 9}\n    lists:"))
    with one_thread():
        found = select_sections(file)
    assert found.free is not None
    for more, words in ((1.0, "they cost 0.000 t of steel"), (1.1, "they cost nothing: without them nothing better")):
        worse = replace(found.free.best, cost=more * found.cost)
        tables = selection_tables(replace(found, free=replace(found.free, best=worse)))
        (told,) = [note for note in tables[-1].notes if note.startswith("wishes: ")]
        assert words in told
