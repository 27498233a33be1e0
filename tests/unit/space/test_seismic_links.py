"""Eccentric bracings in buildings: links by statics, their rules by hand, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from building_examples import NO_TORSION, PINNED, building, changed, design_of, moment_frames, number_of
from matplotlib.text import Text

from edesign import load_building, run_building
from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building import Building
from edesign.report.building.figures.elevations import elevations
from edesign.report.building.figures.plans import _wholes
from edesign.report.building.results import BuildingResults
from edesign.space.analysis.effects import largest
from edesign.space.analysis.sway import SwayAnalysis
from edesign.space.checks.links import link_criteria
from edesign.space.elastic_design import ElasticAnalysis, ElasticDesign
from edesign.space.extract.plane_frame import plane_frame
from edesign.space.nonlinear.build import build_building
from edesign.space.selection.evaluate import LINKS, searched_clauses
from edesign.space.selection.select import select_sections
from edesign.space.structure.geometry import space_frame

_BRACES = "{along: @, frames: all, bays: all, kind: chevron, link: 0.6 m, section: SHS150x8, material: S275, group: D@}"
SPLIT_K = (
    changed(
        moment_frames(),
        PINNED,
        ("ends: rigid, group: BX", "ends: pinned, group: BX"),
        ("ends: rigid, group: BY", "ends: pinned, group: BY"),
        ("materials:", "braces:\n" + "".join(f"  - {_BRACES.replace('@', axis)}\n" for axis in "xy") + "materials:"),
        (
            "{x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}",
            "{x: {type: eccentric, q: 4}, y: {type: eccentric, q: 4}}",
        ),
    )
    + NO_TORSION
)
"""One storey of 4 m, bays of 6 m along x and 8 m along y, all on hinges, so that braces alone resist."""
DIAGONALS = SPLIT_K.replace("kind: chevron", "kind: rising", 1)
"""The same with one diagonal in either frame along x."""


@pytest.fixture(scope="module")
def split_k() -> ElasticDesign:
    return design_of(SPLIT_K)


@pytest.mark.parametrize("text", [SPLIT_K, DIAGONALS])
def test_forces_of_links_by_statics(text: str) -> None:
    """V = F h / L of either frame, whatever e; M = V e / 2 at both ends of a link in the middle of the span.

    At a hinge to a column M is V e at the other end alone. A brace of a pair has F / 2 / cos, one alone F / cos, over
    (L - e) / 2 or L - e. Columns are on hinges and beams pass no moments on: statics is exact (1e-6).
    """
    found, pair = design_of(text), text is SPLIT_K
    for axis, L, place in (("x", 6.0, "BX_1_1_1"), ("y", 8.0, "BY_A_1_1"))[: 2 if pair else 1]:
        F = 0.5 * found.response[axis].base_shear * found.storeys[axis].amplification[0]  # type: ignore[index]
        link = found.effects.seismic["xy".index(axis), number_of(found.frame, f"{place}_2")]
        V = F * 4.0 / L
        np.testing.assert_allclose(link[:, 2], V, rtol=1e-6)
        ends = (0.5 * V * 0.6, 0.5 * V * 0.6) if pair else (V * 0.6, 0.0)
        np.testing.assert_allclose(link[[0, -1], 4], ends, rtol=1e-6, atol=1e-6 * V)
        run = 0.5 * (L - 0.6) if pair else L - 0.6
        brace = found.effects.seismic["xy".index(axis), number_of(found.frame, f"D{place[1:]}_r"), 0, 0]
        assert brace == pytest.approx((0.5 if pair else 1.0) * F * math.hypot(run, 4.0) / run, rel=1e-6)


def test_braces_beside_links_carry_gravity() -> None:
    """By moments about the hinge of the column, and the shear of the beam on springs: equilibrium at the brace's end.

    V left of the node less V right of it is the vertical force of the brace, and there is one (1e-9).
    """
    found = design_of(SPLIT_K)
    frame, G = found.frame, found.static.internal[found.static.names.index("G")]
    beam, link, brace = (number_of(frame, name) for name in ("BX_1_1_1_1", "BX_1_1_1_2", "DX_1_1_1_r"))
    up = G[brace, 0, 0] * 4.0 / math.hypot(2.7, 4.0)
    assert up < -10e3
    assert abs(G[beam, -1, 2] - G[link, 0, 2]) == pytest.approx(-up, rel=1e-9)


def test_sway_counts_what_braces_beside_links_carry(split_k: ElasticDesign) -> None:
    """Columns and braces carry the whole load of the roof, 5 and 2 kN/m2 on 48 m2 (1e-9)."""
    frame, static = split_k.frame, split_k.static
    sway = SwayAnalysis(frame, True)
    N = static.internal[:, :, 3, 0]
    down = -(N[:, frame.columns] + N @ sway._beside_links.T).sum(axis=1)
    assert dict(zip(static.names, down, strict=True)) == pytest.approx({"G": 240e3, "Q": 96e3}, rel=1e-9)


def test_rules_of_a_link_by_hand(split_k: ElasticDesign) -> None:
    """IPE400 of S275: M_p = 275 . 180 . 13.5 . 386.5 = 258.3 kN m, V_p = 275 / 1.732 . 8.6 . 386.5 = 527.7 kN.

    M_p / V_p is 0.489 m, so that 0.6 m is short: e_s = 0.783 m. Gravity is the same at both ends of the link.
    """
    link = next(link for link in split_k.links if link.member == "BX_1_1_1_2")
    V_p, M_p = 527.7e3, 258.3e3
    assert (link.V_p, link.M_p) == pytest.approx((V_p, M_p), rel=1e-4)
    assert (link.category, link.alpha) == ("short", pytest.approx(1.0))
    assert (link.e_s, link.e_L) == pytest.approx((1.6 * M_p / V_p, 3.0 * M_p / V_p), rel=3e-4)
    acting = largest(split_k.effects, [row for row in split_k.combinations if any(row.seismic)])
    number = number_of(split_k.frame, link.member)
    assert link.Omega == pytest.approx(1.5 * V_p / link.V_Ed, rel=1e-4)
    assert link.V_Ed <= acting[number, :, 2].max() * (1.0 + 1e-9)
    d_e = split_k.response["x"].drift[0]
    plastic = (split_k.storeys["x"].drift[0] - d_e) / 4.0
    assert 0.0 < d_e < split_k.storeys["x"].drift[0]
    assert link.theta_p == pytest.approx(plastic * 6.0 / 0.6, rel=1e-9) and link.theta_pR == 0.08
    assert link.lateral == pytest.approx(0.06 * 275e6 * 0.18 * 0.0135, rel=1e-4)
    (told,) = (rule for rule in link_criteria([link], 1.25) if rule.clause == "6.8.2(14)")
    assert told.text.endswith("kN") and told.value == pytest.approx(40.1, rel=1e-3)


def test_braces_and_columns_take_what_links_give(split_k: ElasticDesign) -> None:
    """6.8.3(1): 1.1 . 1.25 . Omega, at most q = 4, on E of braces, columns and beams beside links; links have E."""
    Omega = min(link.Omega for link in split_k.links if link.axis == "x")
    assert split_k.overstrength["x"].Omega == Omega
    factor = min(1.375 * Omega, 4.0)
    raised = split_k.members.amplified
    assert {round(max(row.seismic[0] for row in raised), 9)} == {round(factor, 9)}
    sets = np.cumsum([0, *split_k.members.counts])
    of_set = np.searchsorted(sets, split_k.members.combination, side="left") - 1
    for name, expected in (("DX_1_1_1_r", {0, 2}), ("BX_1_1_1_1", {0, 2}), ("BX_1_1_1_2", {0, 1})):
        row = number_of(split_k.frame, name)
        assert set(of_set[row][split_k.members.combination[row] > 0].tolist()) <= expected
    letter = design_of(SPLIT_K + "  members: {beams_beside_links: seismic}\n")
    row = number_of(letter.frame, "BX_1_1_1_1")
    of_set = np.searchsorted(sets, letter.members.combination, side="left") - 1
    assert set(of_set[row][letter.members.combination[row] > 0].tolist()) <= {0, 1}


def test_upper_limits_of_q() -> None:
    """Table 6.2: 4 in DCM, 5 . 1.2 in DCH; alpha_u / alpha_1 of the file counts there."""
    table = SPLIT_K.replace("q: 4", "q: table")
    assert dict(design_of(table).q) == {"x": 4.0, "y": 4.0}
    high = table.replace("ductility_class: medium", "ductility_class: high")
    given = changed(high, ("{x: {type: eccentric", "{x: {alpha_u_over_alpha_1: 1.1, type: eccentric"))
    assert dict(design_of(given).q) == {"x": pytest.approx(5.5), "y": 6.0}


def test_uneven_links_are_told(split_k: ElasticDesign) -> None:
    """6.8.2(7): 25 % are allowed; twice the overstrength is 100 % above the least one."""
    of = [link for link in split_k.links if link.axis == "x"]
    uneven = [of[0], replace(of[1], Omega=2.0 * of[0].Omega)]
    rule = next(rule for rule in link_criteria(uneven, 1.25) if rule.clause == "6.8.2(7)")
    assert (rule.value, rule.passed) == (pytest.approx(1.0), False)
    assert all(f"({link.member})" in rule.detail for link in uneven)


def test_axial_force_above_the_share_shortens_links(split_k: ElasticDesign) -> None:
    """6.8.2(6): e over 0.3 m is above 1, and told."""
    link = replace(split_k.links[0], longest=0.3)
    rule = next(rule for rule in link_criteria([link], 1.25) if rule.clause == "6.8.2(6)")
    assert (rule.value, rule.passed) == (pytest.approx(2.0), False)


def test_links_by_ntc_2018() -> None:
    """7.5.6 has the equations of 6.8: Omega is that of the same forces, and the clauses are those of the code."""
    states = ", ".join(
        f"{name}: {{limit_state: {name}, a_g: {a_g} m/s^2, F_0: 2.5, T_C_star: 0.3 s}}"
        for name, a_g in (("SLD", 0.9), ("SLV", 2.5))
    )
    found = design_of(
        SPLIT_K,
        (
            "{code: ec8-2004, a_gR: 2.5 m/s^2, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}",
            f"{{code: ntc-2018, nominal_life: 50 years, class_of_use: II, ground: A, levels: {{{states}}}}}",
        ),
        ("design:\n", "design:\n  code: {seismic: ntc-2018}\n"),
    )
    link = found.links[0]
    assert link.Omega == pytest.approx(1.5 * 527.7e3 / link.V_Ed, rel=1e-4)
    told = {rule.told for rule in found.criteria if rule.clause.startswith("6.8.")}
    assert told == {"NTC 2018, 7.5.6", "EN 1998-1, 6.8.2(11)", "EN 1998-1, 6.8.2(14)"}


def test_loads_reach_the_parts_of_a_beam() -> None:
    """A force at 0.3, 0.45 and 0.5 of 6 m: on the part, at the node at 2.7 m, and on the link of 2.7 to 3.3 m."""
    text = SPLIT_K.replace(
        "  self_weight: false\n",
        "  beams:\n    - {along: x, frames: 1, points: [{at: [1.8 m, 2.7 m, 3 m], G: 10 kN}]}\n  self_weight: false\n",
    )
    frame = space_frame(building(text))
    G, names = frame.cases["G"], [member.name for member in frame.members]
    found = {
        (names[member], round(float(place), 9)): force
        for member, place, force in zip(G.point_member, G.point_position, G.point_force[:, 2], strict=True)
        if names[member].startswith("BX_1_1_1")
    }
    assert found == {("BX_1_1_1_1", round(1.8 / 2.7, 9)): -10e3, ("BX_1_1_1_2", 0.5): -10e3}
    assert G.nodal[frame.node_names.index("BX_1_1_1.1"), 2] == -10e3


@pytest.mark.parametrize(
    ("kind", "starts", "ends"),
    [
        ("chevron", {"r": "A1.0", "f": "B1.0"}, {"r": "BX_1_1_1.1", "f": "BX_1_1_1.2"}),
        ("rising", {"r": "A1.0"}, {"r": "BX_1_1_1.1"}),
        ("falling", {"f": "B1.0"}, {"f": "BX_1_1_1.1"}),
    ],
)
def test_where_braces_meet_beams(kind: str, starts: dict[str, str], ends: dict[str, str]) -> None:
    frame = space_frame(building(SPLIT_K.replace("kind: chevron", f"kind: {kind}")))
    for way, start in starts.items():
        member = frame.members[number_of(frame, f"DX_1_1_1_{way}")]
        assert (frame.node_names[member.start], frame.node_names[member.end]) == (start, ends[way])
    x = sorted(float(frame.coordinates[n, 0]) for n, name in enumerate(frame.node_names) if name.startswith("BX_1_1_1"))
    assert x == pytest.approx({"chevron": [2.7, 3.3], "rising": [5.4], "falling": [0.6]}[kind])
    (link,) = [member for member in frame.members if member.link and member.beam == "BX_1_1_1"]
    assert frame.length[number_of(frame, link.name)] == pytest.approx(0.6)


def test_v_braces_hang_links_into_the_beam_below() -> None:
    text = SPLIT_K.replace("storeys: [4 m]", "storeys: [4 m, 3 m]").replace("kind: chevron", "kind: v, storeys: 2")
    text = text.replace("supports: pinned", "supports: fixed")
    frame = space_frame(building(text))
    member = frame.members[number_of(frame, "DX_1_1_2_f")]
    assert (frame.node_names[member.start], frame.node_names[member.end]) == ("BX_1_1_1.1", "A1.2")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("kind: chevron, link: 0.6 m", "kind: cross, link: 0.6 m"), "a cross ends at the corners.*E-BLDG-01"),
        (("link: 0.6 m", "link: 6 m"), "the link of 6 m leaves nothing of the beam of 6 m.*E-VALUE-02"),
        (("link: 0.6 m", "link: 0.6 m, compression: false"), "count in tension and compression.*E-BLDG-01"),
        (("link: 0.6 m, ", ""), "`eccentric`, and a brace along x has no `link`.*E-BLDG-01"),
        (
            ("x: {type: eccentric", "x: {type: concentric_v"),
            "`concentric_v`, and a brace along x has a `link`.*E-BLDG-01",
        ),
        (("section: IPE400", "section: RHS300x200x10"), "BX_1_1_1_2 is a seismic link, .* no I section.*E-SPACE-11"),
    ],
)
def test_what_is_refused(change: tuple[str, str], message: str) -> None:
    with pytest.raises(InputError, match=message):
        design_of(SPLIT_K.replace(*change, 1))


def test_two_bracings_at_one_beam_are_refused() -> None:
    text = SPLIT_K.replace("storeys: [4 m]", "storeys: [4 m, 3 m]")
    more = _BRACES.replace("@", "x").replace("kind: chevron", "kind: v, storeys: 2").replace("group: Dx", "group: V")
    text = text.replace("kind: chevron", "kind: chevron, storeys: 1").replace("braces:\n", f"braces:\n  - {more}\n")
    with pytest.raises(InputError, match="other braces, or dampers in their place, meet the beam BX_1_1_1.*E-BLDG-01"):
        building(text)


def _made() -> Building:
    return building(SPLIT_K)


def test_links_have_no_histories() -> None:
    """They yield in shear, which no element does: analyses, models of them and plane frames are refused by name."""
    with pytest.raises(InputError, match="links have the elastic design; leave one out .E-SPACE-12"):
        building(SPLIT_K + "analyses: [{name: modes, kind: modal, modes: 2}]\n")
    with pytest.raises(InputError, match=r"braces\[0\].link: .*E-SPACE-12"):
        build_building(_made())
    with pytest.raises(InputError, match="frame X1: DX_1_1_1 has a `link`.*E-SPACE-12"):
        plane_frame(_made(), space_frame(_made()), "X1").check()


def test_sections_of_links_are_chosen() -> None:
    """The lightest beams and braces of short lists, all checks met, are those of all 27 choices tried one by one."""
    lists = (
        "  select: {lists: {columns: [HEB300], beams: [IPE270], braces: [SHS150x8], "
        "groups: {BX: [IPE120, IPE160, IPE240], BY: [IPE120, IPE160, IPE240], Dx: [SHS60x4, SHS80x5, SHS150x8]}}}\n"
    )
    made = building(SPLIT_K + lists)
    analysis = ElasticAnalysis(made)
    found = []
    for beam_x in ("IPE120", "IPE160", "IPE240"):
        for beam_y in ("IPE120", "IPE160", "IPE240"):
            for brace in ("SHS60x4", "SHS80x5", "SHS150x8"):
                choice = {"BX": beam_x, "BY": beam_y, "Dx": brace, "Dy": "SHS150x8", "C": "HEB300"}
                design = analysis.design(choice)
                if design.passed:
                    members = design.frame.members
                    mass = sum(
                        steel_section(of.section).A * length
                        for of, length in zip(members, design.frame.length, strict=True)
                    )
                    found.append((mass, choice))
    assert 0 < len(found) < 27
    chosen = {of.group.name: of.after for of in select_sections(made).groups}
    best = min(found, key=lambda one: one[0])[1]
    assert chosen == best


def test_the_search_looks_at_the_rules_of_links() -> None:
    assert set(LINKS) <= searched_clauses(ElasticAnalysis(_made()))


def test_the_office_of_the_docs_meets_all_checks() -> None:
    """Its links: IPE220 of S355 in the middle of spans, V_p = 355 / 1.732 . 5.9 . 210.8 = 254.9 kN, M_p = 75.7 kN m."""
    page = (Path(__file__).parents[3] / "docs" / "how_to" / "eccentric_bracings.md").read_text(encoding="utf-8")
    found = design_of(page.partition('```yaml title="office.yaml"\n')[2].partition("```")[0])
    assert found.passed and len(found.links) == 12
    link = next(link for link in found.links if link.member == "BX_1_2_1_2")
    assert (link.V_p, link.M_p) == pytest.approx((254.9e3, 75.7e3), rel=1e-3)
    assert not any("gamma_ov Omega of links" in note for note in found.notes)


def test_links_in_drawings(tmp_path: Path) -> None:
    """Elevations by use have links as thick lines; in plan a beam of three parts is one of 6 m or 8 m."""
    (tmp_path / "k.yaml").write_text(SPLIT_K, encoding="utf-8")
    written, _ = run_building(load_building(tmp_path / "k.yaml"))
    with open_archive(written) as archive:
        drawn = [figure for _, _, figure in elevations(archive)]
        results = BuildingResults(archive)
        start, end = (results.values("members", name)[:, :2] for name in ("start", "end"))
        beams = np.flatnonzero(results.values("members", "kind") == "beam")
        start, end, whole = _wholes(results, start, end, beams, dict.fromkeys(beams.tolist(), "a"))
    texts = [text.get_text() for figure in drawn for text in figure.findobj(Text)]
    assert texts.count("seismic link") == len(drawn) == 2
    assert beams.size == 12 and sorted(np.linalg.norm(end - start, axis=1)[whole].round(9)) == [6.0, 6.0, 8.0, 8.0]
