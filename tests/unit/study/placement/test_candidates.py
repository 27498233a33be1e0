"""What a placement chooses from: mirror images, sizes that compare, the devices of a layout, and their estimates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
import yaml
from design_examples import MadeVerdict, design
from placement_examples import small_project

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation.grid import BayPlace
from edesign.study.analysis.structure import make_frame
from edesign.study.design.beside import Standing
from edesign.study.design.condensed import condense
from edesign.study.design.device_text import devices_text
from edesign.study.design.estimate import action_of
from edesign.study.placement.candidates import Candidates, make_candidates
from edesign.study.placement.estimate import LayoutEstimates
from edesign.study.placement.placement import check_placement, run_placement

CATALOGUE = (
    "a: {law: oil, scale: 40, cost: 1, brace: {stiffness: 60 kN/mm, play: 1 mm}}, "
    "b: {law: oil, scale: 80, cost: 2, brace: {stiffness: 60 kN/mm, play: 1 mm}}, "
    "c: {law: oil, scale: 80, cost: 2, brace: {stiffness: 50 kN/mm, play: 1 mm}}, "
    "d: {law: rubber, layer_area: 0.1 m^2, number: 2, cost: 2, kind: chevron, brace: {section: HEB140, material: S275}}"
)
TEXT = (
    f"method: placement, kind: rising, bays: all, catalogue: {{{CATALOGUE}}}, limits: {{mirrored: true}}, "
    "verify: {records: [first, second], levels: DBE, criteria: drift, budget: 1}"
)


VERIFY = "{records: first, levels: DBE, criteria: drift}"


@pytest.fixture(scope="module")
def candidates(tmp_path_factory: pytest.TempPathFactory) -> Candidates:
    project = small_project(tmp_path_factory.mktemp("candidates"), "[6 m, 5 m, 6 m]", "[4 m, 3.3 m]")
    spec = design(TEXT, project)
    assert isinstance(spec, PlacementDesign)
    return make_candidates(project, "tried", spec)


def test_mirror_images_lean_the_other_way(candidates: Candidates) -> None:
    """Positions: bays 1 and 3 of both storeys, then bay 2, where a diagonal has no mirror image."""
    positions = candidates.space.positions
    assert [at.places for at in positions] == [
        (("", 1, 1), ("", 3, 1)),
        (("", 1, 2), ("", 3, 2)),
        (("", 2, 1),),
        (("", 2, 2),),
    ]
    assert positions[0].options == (1, 2, 3, 4) and positions[2].options == (4,)
    assert candidates.space.size == 5 * 5 * 2 * 2
    dampers = candidates.dampers((1, 2, 4, 0))
    project = candidates.project.model_copy(update={"dampers": dampers})
    devices = make_frame(project, dampers=True).devices
    assert sorted(device.name for device in devices) == ["F_3_1", "F_3_2", "R_1_1", "R_1_2", "V_2_1"]
    by_name = {device.name: device for device in devices}
    assert by_name["R_1_2"].force_scale == by_name["F_3_2"].force_scale == 80.0
    text = yaml.safe_load(devices_text(dampers))["devices"]
    assert text[0]["brace"] == {"stiffness": "60000000.0 N/m", "play": "0.001 m"}
    assert text[-1] == {
        "kind": "chevron",
        "bays": 2,
        "storeys": 1,
        "law": "rubber",
        "number": 2,
        "layer_area": "0.1 m^2",
        "brace": {"section": "HEB140", "material": "S275"},
    }


def test_the_text_of_braces_that_are_chosen(tmp_path: Path) -> None:
    brace = "{choose: [HEB1*, SHS], material: S275, force: 90 kN, overstrength: 1.2, stiffness: 2 kN/mm}"
    project = small_project(tmp_path, "[6 m]", "[4 m]")
    items = f"a: {{law: oil, cost: 1, brace: {brace}}}"
    spec = design(f"method: placement, kind: rising, bays: all, catalogue: {{{items}}}, verify: {VERIFY}", project)
    assert isinstance(spec, PlacementDesign)
    (run,) = yaml.safe_load(devices_text(make_candidates(project, "tried", spec).dampers((1,))))["devices"]
    written = {"choose": ["HEB1*", "SHS"], "material": "S275", "overstrength": 1.2}
    assert run["brace"] == written | {"force": "90000.0 N", "stiffness": "2000000.0 N/m"}


def test_items_that_compare(candidates: Candidates) -> None:
    expected = np.eye(5, dtype=bool)
    expected[0] = True
    expected[1, 2] = expected[3, 2] = True  # a weaker one, and one behind a softer brace; a has more brace than c
    np.testing.assert_array_equal(candidates.space.not_larger, expected)


def test_items_compare_where_they_do_at_every_place(tmp_path: Path) -> None:
    """Braces of a section have 2 E A cos^2 / length: 1.30 times as much in a bay of 14 m as in one of 6 m."""
    project = small_project(tmp_path, "[14 m, 6 m]", "[4 m]")

    def candidates_with(stiffness: float) -> Candidates:
        items = (
            "a: {law: oil, scale: 40, cost: 1, brace: {section: HEB140, material: S275}}, "
            f"b: {{law: oil, scale: 80, cost: 1, brace: {{stiffness: {stiffness} N/m}}}}"
        )
        text = f"method: placement, kind: chevron, bays: all, catalogue: {{{items}}}, verify: {VERIFY}"
        spec = design(text, project)
        assert isinstance(spec, PlacementDesign)
        return make_candidates(project, "tried", spec)

    devices = candidates_with(1e6).devices
    wide, narrow = (devices[1, BayPlace("", bay, 1)].brace for bay in (1, 2))
    shape = {half: (half / np.hypot(half, 4.0)) ** 2 / np.hypot(half, 4.0) for half in (3.0, 7.0)}
    assert wide / narrow == pytest.approx(shape[7.0] / shape[3.0], rel=1e-12)
    for stiffness, smaller in ((0.9 * narrow, False), (0.5 * (narrow + wide), False), (1.1 * wide, True)):
        assert bool(candidates_with(stiffness).space.not_larger[1, 2]) is smaller


@pytest.mark.parametrize(
    ("limits", "least"),
    [
        ("most_dampers: 1, mirrored: true", 2),
        ("most_dampers: 2, storey_groups: [1-3]", 3),
        ("most_dampers: 1, continuous: true, storey_groups: [1-2]", 2),
    ],
)
def test_limits_that_leave_no_dampers_are_refused(tmp_path: Path, limits: str, least: int) -> None:
    project = small_project(tmp_path, "[6 m, 6 m]", "[4 m, 3 m, 3 m]")
    item = "{law: oil, scale: 40, cost: 1}"
    text = (
        f"method: placement, kind: chevron, bays: all, catalogue: {{a: {item}}}, limits: {{{limits}}}, verify: {VERIFY}"
    )
    spec = design(text, project)
    assert isinstance(spec, PlacementDesign)
    with pytest.raises(InputError, match=rf"^designs.tried.limits.most_dampers: .* {least} .*E-PLACE-02"):
        check_placement(project, "tried", spec, 1)


def test_amplitude_of_linear_dampers_in_one_storey_is_in_closed_form(tmp_path: Path) -> None:
    """Oscillator with a dashpot: S_d(T1, zeta + c phi^2 / (2 omega)) Gamma phi, phi of unit modal mass."""
    project = small_project(tmp_path, "[6 m]", "[4 m]")
    text = "method: placement, kind: storey, bays: all, catalogue: {a: {law: linear, scale: 400, cost: 1}}"
    spec = design(f"{text}, verify: {VERIFY}", project)
    assert isinstance(spec, PlacementDesign)
    found, action = make_candidates(project, "tried", spec), action_of(project, "DBE", None)
    amplitudes = LayoutEstimates(found, action).amplitudes((1,))
    assert amplitudes is not None
    modes = condense(found.structure).modes()
    omega, phi = float(modes.omega[0]), float(modes.floors[0, 0])
    added = 4e5 * phi**2 / (2.0 * omega)
    expected = action.displacement(omega, action.inherent_damping + added) * abs(modes.participation[0] * phi)
    # vertical modes of the beam's ends add to the CQC sum
    amplitude = amplitudes[BayPlace("", 1, 1)]
    assert amplitude == pytest.approx(expected, rel=1e-3)
    (run,) = found.dampers((1,), amplitudes).devices
    assert run.design_deformation == (float(f"{amplitude:.3g}"),)
    (plain,) = found.dampers((1,)).devices
    assert plain.design_deformation is None


def test_dampers_beside_a_placement_damp_with_it(tmp_path: Path) -> None:
    """S_d(T1, zeta + (c + c') phi^2 / (2 omega)) Gamma phi with a dashpot c' of another design in the other bay."""
    project = small_project(tmp_path, "[6 m, 6 m]", "[4 m]")
    text = "method: placement, kind: storey, bays: @, catalogue: {a: {law: linear, scale: 400, cost: 1}}"
    specs = [design(f"{text}, verify: {VERIFY}".replace("@", bay), project) for bay in ("1", "2")]
    own, other = specs
    assert isinstance(own, PlacementDesign) and isinstance(other, PlacementDesign)
    there, action = make_candidates(project, "other", other), action_of(project, "DBE", None)
    modes = condense(there.structure).modes()
    omega, phi = float(modes.omega[0]), float(modes.floors[0, 0])
    run, (damper,) = there.dampers((1,)), there.structure.frame.devices
    assert run.devices and there.project.dampers is not None
    beside = Standing(there.project.dampers.laws, run.devices, {damper.name: 1j * omega * 4e5})
    found = make_candidates(project, "tried", own, beside)
    amplitudes = LayoutEstimates(found, action).amplitudes((1,))
    assert amplitudes is not None
    added = 8e5 * phi**2 / (2.0 * omega)
    expected = action.displacement(omega, action.inherent_damping + added) * abs(modes.participation[0] * phi)
    assert amplitudes[BayPlace("", 1, 1)] == pytest.approx(expected, rel=1e-3)
    assert [device.bays for device in found.dampers((1,)).devices] == [own.bays]


def test_estimates_fall_with_dampers_and_are_those_of_the_frame_without(candidates: Candidates) -> None:
    """Without dampers a frame of two storeys that sways in its first mode has about S_d(T1) Gamma phi."""
    estimates = LayoutEstimates(candidates, action_of(candidates.project, "DBE", None))
    bare, some, more = (estimates(one)[0] for one in ((0, 0, 0, 0), (1, 0, 0, 0), (2, 2, 4, 4)))
    modes = condense(candidates.structure).modes()
    action = action_of(candidates.project, "DBE", None)
    peak = modes.participation[0] * action.displacement(float(modes.omega[0]), 0.03)
    first = np.max(np.abs(peak * np.diff(modes.floors[0], prepend=0.0)) / candidates.project.grid.storey_heights)
    assert bare == pytest.approx(first, rel=0.05) and bare > some > more > 0.0


def test_budget_for_less_than_one_layout_is_refused(candidates: Candidates) -> None:
    with pytest.raises(InputError, match="^designs.tried.verify.budget: 1 .*E-PLACE-02"):
        check_placement(candidates.project, "tried", candidates.spec, 2)


def test_item_that_cannot_stand_names_itself(tmp_path: Path) -> None:
    project = small_project(tmp_path, "[6 m]", "[4 m]")
    spec = design(
        "method: placement, kind: chevron, bays: 1, catalogue: {odd: {law: oil, scale: 4, cost: 1, "
        "brace: {section: HEB141, material: S275}}}, verify: {records: first, levels: DBE, criteria: drift}",
        project,
    )
    assert isinstance(spec, PlacementDesign)
    with pytest.raises(InputError, match="^designs.tried.catalogue.odd.brace.section: .*`HEB140`.*E-PLACE-01"):
        check_placement(project, "tried", spec, 1)


def test_a_table_of_one_damping_orders_layouts_all_the_same(tmp_path: Path) -> None:
    """The order needs the spectrum of other dampings than 5 %, which the table has not; verdicts do not need it."""
    (tmp_path / "table.csv").write_text("T [s],Se [m/s2]\n0,3\n0.1,7\n0.6,7\n4,0.5\n")
    project = small_project(tmp_path, "[6 m]", "[4 m, 3.3 m]")
    user = {"code": "user", "damping": "5 %", "levels": {"DBE": {"spectrum": {"file": str(tmp_path / "table.csv")}}}}
    project = project.with_values("hazard", user)
    spec = design(TEXT.replace("budget: 1}", "budget: 60}"), project)
    assert isinstance(spec, PlacementDesign)
    tried: list[int] = []

    def respond(wanted: Sequence[tuple[int, Dampers]]) -> Iterator[Mapping[str, Group]]:
        for _, dampers in wanted:
            tried.append(len(dampers.devices))
            yield {"only": Group(attributes={"devices": len(dampers.devices)})}

    def judge(groups: Mapping[str, Group]) -> list[MadeVerdict]:
        return [MadeVerdict(0.015 / (1 + int(str(groups["only"].attributes["devices"]))))]

    found = run_placement(project, "tried", spec, 2, respond, judge)
    assert found.status == "completed" and tried[0] == 0
    assert found.group.attributes["cost"] == 4.0  # in a bay without mirror image d alone stands, two side by side
