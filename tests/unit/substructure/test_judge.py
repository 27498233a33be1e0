"""Judging a measured test: a virtual one as the record, its mistakes, and the campaign that is made of it."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.archive.csv_files import write_csv_file
from edesign.cli.main import main
from edesign.core.substructure import SubstructureLoop
from edesign.damper.testing.campaign import load_campaign
from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.substructure import load_rts_file, parse_rts_file
from edesign.project.substructure.programme import RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.report.substructure.judgement_tables import judgement_tables
from edesign.substructure.compensation import compensators
from edesign.substructure.judgement.judge import REPRODUCED, chosen_test, judge
from edesign.substructure.judgement.record_campaign import write_record_campaign
from edesign.substructure.laboratory import NOTHING
from edesign.substructure.rig.rigs import ideal
from edesign.substructure.run import HEADERS, write_run
from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.recursion import recursion
from edesign.substructure.virtual_test import VirtualTest
from edesign.substructure.virtual_tests import VirtualLaboratory

RTS = Path(__file__).parents[3] / "projects" / "thesis_substructure" / "one_storey.yaml"


@cache
def file() -> RtsFile:
    return load_rts_file(RTS, BuildingSections())


@cache
def runs() -> dict[str, VirtualTest]:
    """The test of thesis 6.2.5, by compensator."""
    laboratory = VirtualLaboratory(file())
    whole = laboratory.tests
    laboratory.tests = tuple(test for test in whole if test.kind == "rts")
    (results,) = laboratory.run()
    return {run.compensator: run for run in results.runs}


def record(path: Path, compensator: str = "modified", **changed: np.ndarray) -> Path:
    """The record of a run, with other values in some columns."""
    write_run(runs()[compensator], path)
    if changed:
        table = np.loadtxt(path, delimiter=",", skiprows=1)
        for name, values in changed.items():
            table[:, HEADERS.index(name)] = values
        write_csv_file(list(HEADERS), table.tolist(), path, digits=9)
    return path


def column(name: str, compensator: str = "modified") -> np.ndarray:
    record_of = runs()[compensator].record
    assert record_of is not None
    return {"target_mm": 1e3 * record_of.target, "force_kN": 1e-3 * record_of.force}[name]


@pytest.mark.parametrize("compensator", ["none", "modified"])
def test_a_virtual_test_is_judged_as_it_was_run(tmp_path: Path, compensator: str) -> None:
    """Its errors are those of the run, but for the noise of the encoder, 1 um of 5 mm."""
    run = runs()[compensator]
    found = judge(record(tmp_path / "measured.csv", compensator), file())
    response = found.response
    assert response is not None and run.tracking is not None
    assert found.tracking.nrms_root == pytest.approx(run.tracking.nrms_root, rel=1e-5)
    assert response.response_error == pytest.approx(run.response_error, abs=5e-4)
    assert response.peak_error == pytest.approx(run.peak_error, abs=5e-4)
    assert response.reproduced < 1e-6  # the digits of the file
    assert response.force_nrms_root < 0.02  # held force is in it, half a step late
    assert response.force_nrms == pytest.approx(response.force_nrms_root**2)
    assert found.good is (compensator == "modified")
    assert "error of the response" in found.verdict or found.good


def test_the_critical_delay_is_that_of_the_thesis_frame(tmp_path: Path) -> None:
    """32 to 40 ms of the linearised law (design notes, section 0); the rig is late by 10 ms, held force by 0.5."""
    response = judge(record(tmp_path / "measured.csv", "none"), file()).response
    assert response is not None
    assert 0.0315 < response.critical_delay < 0.040
    assert response.delay_factor == pytest.approx(response.critical_delay / (0.01025 + 0.0005), rel=0.02)


def test_tracking_alone_needs_no_file(tmp_path: Path) -> None:
    found = judge(record(tmp_path / "measured.csv"))
    assert found.response is None and found.good is None and "--rts" in found.verdict
    assert found.tracking.correlation_delay == pytest.approx(1e-3, abs=2e-5)


def test_a_force_that_cannot_be_that_of_the_test_is_reported(tmp_path: Path) -> None:
    path = record(tmp_path / "sign.csv", force_kN=-column("force_kN"))
    turned = judge(path, file())
    assert turned.good is False and any("opposite sign" in note for note in turned.notes)
    scaled = judge(record(tmp_path / "half.csv", force_kN=0.5 * column("force_kN")), file())
    assert scaled.good is False and any("unit or channel" in note for note in scaled.notes)
    assert scaled.response is not None and scaled.response.reproduced > REPRODUCED


@pytest.mark.parametrize(
    ("late", "said"),
    [(-0.01, "leads the target by 10 ms: the compensator asks for too much"), (2.5, "2.5 s late, and no")],
)
def test_a_lead_and_a_shift_are_reported(tmp_path: Path, late: float, said: str) -> None:
    time = 1e-3 * np.arange(20_000)
    target, measured = (np.sin(t**2) * np.exp(-(((t - 8.0) / 3.0) ** 2)) for t in (time, time - late))
    rows = np.column_stack([time, target, measured]).tolist()
    write_csv_file(["time_s", "target_mm", "displacement_mm"], rows, tmp_path / "r.csv")
    assert any(said in note for note in judge(tmp_path / "r.csv").notes)


def test_a_channel_that_is_cut_off_is_reported_in_its_unit(tmp_path: Path) -> None:
    cut = np.clip(1e3 * runs()["modified"].record.measured, -3.0, 3.0)  # type: ignore[union-attr]
    with pytest.raises(InputError, match="displacement is cut off at 3 mm.*E-MEAS-03"):
        judge(record(tmp_path / "r.csv", displacement_mm=cut))


def test_noise_of_the_sensors_is_no_other_test(tmp_path: Path) -> None:
    generator = np.random.default_rng(1)
    noisy = column("force_kN") + 0.2 * generator.standard_normal(column("force_kN").size)
    found = judge(record(tmp_path / "noisy.csv", force_kN=noisy), file())
    assert found.good and found.response is not None and found.response.reproduced < 0.01


def test_records_of_something_else_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"target is (2\.0* s late|1\.99).*E-MEAS-05"):
        judge(record(tmp_path / "shifted.csv", target_mm=np.roll(column("target_mm"), 2000)), file())
    time = 5.0 + runs()["modified"].time
    with pytest.raises(InputError, match="at 5 s.*E-MEAS-05"):
        judge(record(tmp_path / "later.csv", time_s=time), file())
    with pytest.raises(InputError, match=r"dead\.csv: .*force .*E-MEAS-03"):
        judge(record(tmp_path / "dead.csv", force_kN=np.zeros(time.size)), file())
    noise = np.random.default_rng(2).standard_normal(time.size)
    with pytest.raises(InputError, match=r"noise\.csv: .*E-MEAS-04"):
        judge(record(tmp_path / "noise.csv", target_mm=noise), file())
    cut = np.minimum(column("force_kN"), 0.5 * np.max(column("force_kN")))
    with pytest.raises(InputError, match=r"cut\.csv: .*force .*E-MEAS-03"):
        judge(record(tmp_path / "cut.csv", force_kN=cut), file())
    with pytest.raises(InputError, match="el_centro"):
        judge(tmp_path / "later.csv", file(), "el_cento")


def test_an_oscillator_under_a_known_force_is_that_of_its_recursion() -> None:
    """A constant force bends a spring at rest by F/k when all has died out."""
    part = LinearPart(np.array([[1e3]]), np.array([[2e3]]), np.array([[1e5]]), np.ones(1), np.ones(1), ("floor 1",))
    step = recursion(part, 1e-3, "exact", "extrapolated")
    rig = ideal().discrete(1e-3)
    loop = SubstructureLoop(1e-3, 1, compensators.none(), rig, NOTHING.values, numerical=step)
    target = loop.by_force(np.zeros(20000), np.full(20000, 50.0))
    assert target[0] == 0.0
    assert target[-1] == pytest.approx(-50.0 / 1e5, rel=1e-6)


def short(folder: Path, rest: str) -> RtsFile:
    """A storey of 143.26 t on 22.6 kN/mm under some seconds of a sine, with rig and compensators in `rest`."""
    motion = "{file: motion.csv, acceleration_unit: m/s^2, columns: {time: t, acceleration: a}}"
    time = np.arange(0.0, 6.0, 0.01)
    ground = np.column_stack([time, np.sin(2.0 * np.pi * 1.5 * time) * np.minimum(time, 1.0)])
    np.savetxt(folder / "motion.csv", ground, delimiter=",", header="t,a", comments="")
    text = f"""\
edesign_rts: 1
structure: {{masses: [143.26 t], stiffnesses: [22.6e6 N/m], damping: {{kind: modal, ratio: 2 %}}}}
specimen: {{law: {{type: kelvin_voigt, parameters: {{k: 6 kN/mm, c: 100 kN*s/m}}}}}}
records: {{ground: {motion}}}
tests: [{{name: ground, kind: rts, record: ground, scale: 1}}]
{rest}
"""
    return parse_rts_file(text, folder / "rts.yaml")


def test_a_perfect_smith_prediction_is_a_good_test(tmp_path: Path) -> None:
    """Rig and predictor have one delay, and its specimen is the law: the structure meets the force of its target.

    So the target is that of the direct analysis, up to the error of the step. Of the energy that the
    delay alone feeds into the structure, nothing stays.
    """
    smith = "smith: {kind: smith, delay: 10 ms, stiffness: 6 kN/mm, damping: 100 kN*s/m}"
    chosen = short(tmp_path, f"rig: {{kind: delay, delay: 10 ms}}\ncompensators: {{none: {{kind: none}}, {smith}}}")
    (results,) = VirtualLaboratory(chosen).run()
    none, predicted = results.runs
    write_run(predicted, tmp_path / "ground_smith.csv")
    assert (tmp_path / "ground_smith.csv").read_text().splitlines()[0].endswith(",force_kN,applied_force_kN")
    write_run(none, tmp_path / "ground_none.csv")
    assert (tmp_path / "ground_none.csv").read_text().splitlines()[0] == ",".join(HEADERS)
    found = judge(tmp_path / "ground_smith.csv", chosen)
    assert found.response is not None and results.direct is not None and predicted.record is not None
    assert found.response.reproduced < 1e-6 and found.response.response_error == found.response.target_error < 0.02
    # the specimen is ten steps late, and what is left in the corrected force is below one
    assert found.response.delay_factor == pytest.approx(found.response.critical_delay / 1e-3)
    assert found.tracking.relative_energy_error == pytest.approx(0.0, abs=0.02)
    law = 6e6 * predicted.record.target + 1e5 * predicted.record.target_velocity
    assert np.max(np.abs(predicted.record.applied_force - law)) < 0.02 * np.max(np.abs(law))
    lines = [line.rsplit(",", 1)[0] for line in (tmp_path / "ground_smith.csv").read_text().splitlines()]
    (tmp_path / "ground_bare.csv").write_text("\n".join(lines))
    bare = judge(tmp_path / "ground_bare.csv", chosen)
    assert bare.response is not None and bare.response.reproduced > REPRODUCED
    assert any("a compensator that corrects the force" in note for note in bare.notes)


def test_a_late_force_counts_as_a_late_rig(tmp_path: Path) -> None:
    """8 ms of the rig and 8 ms of the load cell are 16 ms in the loop, whose critical delay has half the factor."""
    rig = "rig: {kind: delay, delay: 8 ms}\ncompensators: {none: {kind: none}}\nsensors: {force_delay: @ ms}"
    margins = []
    for late in ("0", "8"):
        chosen = short(tmp_path, rig.replace("@", late))
        (results,) = VirtualLaboratory(chosen).run()
        write_run(results.runs[0], tmp_path / "ground.csv")
        response = judge(tmp_path / "ground.csv", chosen).response
        assert response is not None
        margins.append(response.delay_factor * 1e3 / response.critical_delay)
    assert margins == pytest.approx([1e6 / 8.0, 1e6 / 16.0], rel=2e-3)


def test_a_delay_that_cannot_be_determined_leaves_its_criterion_open(tmp_path: Path) -> None:
    """A displacement against its target has no delay; the margin is not determined, and so not met."""
    backwards = -1e3 * runs()["none"].record.measured  # type: ignore[union-attr]
    path = record(tmp_path / "measured.csv", "none", displacement_mm=backwards)
    found = judge(path, file())
    margin = next(one for one in found.criteria if one.name == "delay factor")
    assert np.isnan(margin.value) and not margin.met and not margin.determined and found.good is False
    assert "delay factor (not determined)" in found.verdict
    assert any("not determined" in row for row in judgement_tables(found)[-1].rows)


def test_a_record_that_ends_before_the_largest_deformation_is_no_good_test(tmp_path: Path) -> None:
    """The direct analysis has its largest deformation, 6.848 mm, after 2 s."""
    whole = record(tmp_path / "whole.csv")
    table = np.loadtxt(whole, delimiter=",", skiprows=1)
    part = tmp_path / "part.csv"
    write_csv_file(list(HEADERS), table[table[:, 0] <= 2.0].tolist(), part, digits=9)
    found, complete = judge(part, file()), judge(whole, file())
    assert complete.good and not found.good and "largest deformation" in found.verdict
    assert found.response is not None
    early = np.max(np.abs(found.response.direct_deformation))
    assert found.response.covered == pytest.approx(early / 6.848e-3, rel=1e-3)


@pytest.mark.parametrize("displacement", ["target", "encoder"])
def test_tests_become_a_campaign_for_calibrate(tmp_path: Path, displacement: str) -> None:
    """Three records of the test, one without compensator: two to fit to, and the third to validate with."""
    names = {"el_centro": "modified", "el_centro_first": "first", "el_centro_none": "none"}
    paths = [str(record(tmp_path / f"{name}.csv", compensator)) for name, compensator in names.items()]
    arguments = ["--rts", str(RTS), "--campaign", str(tmp_path / "campaign"), "--displacement", displacement]
    assert main(["rts", "judge", *paths, *arguments]) == 0
    campaign = load_campaign(tmp_path / "campaign" / "campaign.yaml")
    assert [(test.name, test.use) for test in campaign.tests] == list(
        zip(names, ["fit", "fit", "validate"], strict=True)
    )
    assert campaign.law is not None and campaign.law.parameters == "thesis_table_4_2"
    assert campaign.specimen.layers == 2
    for test, compensator in zip(campaign.tests, names.values(), strict=True):
        run = runs()[compensator].record
        assert run is not None and test.temperature_C == 20.0 and test.start == "at_rest"
        whole = run.target if displacement == "target" else run.measured
        np.testing.assert_allclose(test.displacement, whole, atol=1e-10)
        np.testing.assert_allclose(test.measured_force(), run.force, atol=1e-3)


@pytest.mark.parametrize("size", ["", ", layer_thickness: 24 mm", ", layers: 4", ", number: 2"])
def test_a_campaign_has_the_shear_modulus_of_the_law(tmp_path: Path, size: str) -> None:
    """G = k t / (n A) of the spring on its prototype, 5 kN/mm x 12 mm / (2 x 41400 mm2), whatever the tested size."""
    text = f"""\
edesign_rts: 1
specimen:
  law:
    type: kelvin_voigt
    parameters: {{k: 5 kN/mm, c: 0 N*s/m}}
    prototype: {{layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}}
{f"  {size[2:]}" if size else ""}
rig: {{kind: ideal}}
compensators: {{none: {{kind: none}}}}
tests: [{{name: cycles, kind: command, command: {{type: sine, displacement: 5 mm, frequency: 1 Hz}}}}]
"""
    chosen = parse_rts_file(text, tmp_path / "rts.yaml")
    (results,) = VirtualLaboratory(chosen).run()
    write_run(results.runs[0], tmp_path / "cycles.csv")
    found = write_record_campaign([judge(tmp_path / "cycles.csv", chosen)], chosen, tmp_path / "campaign")
    (test,) = found.tests
    shear = found.specimen.strain(test.displacement)
    modulus = np.max(found.specimen.stress(test.measured_force())) / np.max(shear)
    assert modulus == pytest.approx(5e6 * 12e-3 / (2 * 41400e-6), rel=1e-6)
    tested = 24e-3 if "thickness" in size else 12e-3
    assert np.max(shear) == pytest.approx(5e-3 / tested, rel=1e-3)


def test_a_record_is_of_the_test_whose_name_it_has(tmp_path: Path) -> None:
    """The longest such name; any other one is of the only test in the loop, unless its test is said."""
    tests = {name: chosen_test(file(), Path(f"{name}.csv")).name for name in ("white_none", "cycles", "white2", "new")}
    assert tests == {"white_none": "white", "cycles": "cycles", "white2": "el_centro", "new": "el_centro"}
    assert chosen_test(file(), Path("white_none.csv"), "cycles").name == "cycles"
    in_loop = file().tests[-1]
    assert isinstance(in_loop, RtsTest)
    names = ("white", "white_a")
    two = file().model_copy(update={"tests": tuple(in_loop.model_copy(update={"name": name}) for name in names)})
    assert chosen_test(two, Path("white_a_none.csv")).name == "white_a"
    with pytest.raises(InputError, match="which of white, white_a.*E-MEAS-04"):
        chosen_test(two, Path("measured.csv"))


def test_a_command_is_judged_by_its_tracking_alone(tmp_path: Path) -> None:
    found = judge(record(tmp_path / "cycles_none.csv", "none"), file())
    assert found.response is None and found.good is None and "a command has no response" in found.verdict
    arguments = ["rts", "judge", str(record(tmp_path / "white.csv")), "--rts", str(RTS), "--check"]
    assert main(arguments) == 0  # there is no criterion that it could miss


def test_a_campaign_needs_its_channels_and_a_name_for_each_test(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one = record(tmp_path / "el_centro.csv")
    found = judge(one, file())
    other = tmp_path / "other"
    other.mkdir()
    with pytest.raises(InputError, match="campaign: .* called el_centro; .*E-NAME-02"):
        write_record_campaign([found, judge(record(other / "el_centro.csv"), file())], file(), tmp_path / "campaign")
    assert not (tmp_path / "campaign").exists()
    table = np.loadtxt(one, delimiter=",", skiprows=1)[:, :-1]
    write_csv_file(list(HEADERS[:-1]), table.tolist(), one, digits=9)
    with pytest.raises(InputError, match=r"el_centro\.csv:1: .*force_kN.*E-MEAS-01"):
        write_record_campaign([found], file(), tmp_path / "campaign")
    assert main(["rts", "judge", str(one), str(one), "--rts", str(RTS), "--test", "el_centro"]) == 2
    assert says(capsys.readouterr().err, "--test: 1 2 E-CLI-05")


def test_the_command_prints_json_and_says_what_it_needs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = record(tmp_path / "measured.csv", "none")
    assert main(["rts", "judge", str(path), "--rts", str(RTS), "--json", "--check"]) == 3
    (data,) = json.loads(capsys.readouterr().out)
    assert data["test"] == "el_centro" and data["good"] is False and data["response"]["test"] == "el_centro"
    assert [one["met"] for one in data["criteria"]] == [True, False, True, True]
    assert main(["rts", "judge", str(path), "--campaign", str(tmp_path / "c")]) == 2
    assert says(capsys.readouterr().err, "--campaign: --rts E-CLI-01")
    assert main(["rts", "judge", str(path), "--displacement", "lvdt"]) == 2
