"""The report of virtual substructure tests: sections, figures, and archives that are damaged or not complete."""

from __future__ import annotations

import io
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
from matplotlib.figure import Figure

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.project.substructure import load_rts_file
from edesign.report.archive.document import page_text
from edesign.report.archive.figures import all_figures, draw_figures
from edesign.report.archive.tables import overview
from edesign.report.drawing.captions import plain
from edesign.report.substructure.building_tables import building_tables
from edesign.report.substructure.curves import TOLERANCE, _fewer, window
from edesign.report.substructure.limits import limits_table, runs_so_far_table, undetermined_table
from edesign.report.substructure.results import SubstructureResults
from edesign.report.substructure.tables import other_methods
from edesign.report.tables.number import significant
from edesign.report.tables.text import print_tables
from edesign.substructure.rig.rigs import second_order
from edesign.substructure.run import run_tests
from edesign.substructure.stability.loop import phase_delay

RECORD = "time_s,acceleration_m_s2\n" + "".join(
    f"{0.02 * i:.2f},{2.0 * np.sin(2.0 * np.pi * 1.8 * 0.02 * i) * np.exp(-0.5 * 0.02 * i):.6f}\n" for i in range(151)
)
TESTS = """\
edesign_rts: 1
title: Short
structure: {masses: [143.26 t, 100 t], stiffnesses: [22.6e6 N/m, 22.6e6 N/m], damping: {kind: modal, ratio: 2 %}}
specimen: {law: {type: kelvin_voigt, parameters: {k: 4.346 kN/mm, c: 60 kN*s/m}}}
rig: RIG
sensors: {encoder_noise: 1 um, force_noise: 20 N, bits: 16}
loop: {main_step: 2 ms, sub_steps: 2, unseen_delay: 1 step}
compensators:
  none: {kind: none}
  cubic: {kind: polynomial, order: 3, delay: 10 ms}
  modified: {kind: modified_ats, initial: [1.0, 10 ms, 6e-5 s^2], rates: {a1: 0.01 s/s}}
  live: {kind: live_delay, delay: 8 ms}
records:
  shake: {file: shake.csv, acceleration_unit: m/s^2, columns: {time: 1, acceleration: 2}}
tests:
  - {name: cycles, kind: command, command: {type: sine, displacement: 5 mm, frequency: [1 Hz, 2 Hz], cycles: 2}}
  - {name: shaken, kind: rts, record: shake, scale: 0.3}
"""
RIG = (
    "{kind: second_order, frequency: 21.4 Hz, damping: 0.4, delay: 4.25 ms, gain: 0.99488, "
    "limits: {stroke: 50 mm, force: 100 kN}}"
)
METHOD_TESTS = """\
  - {name: slow, kind: pseudo_dynamic, record: shake, scale: 0.3, error: {kind: undershoot, share: 2 %}}
  - {name: pushed, kind: effective_force, record: shake, scale: 0.3, gain: 1e-6 m/s/N}
  - name: table
    kind: shaking_table
    record: shake
    scale: 0.3
    table: {mass: 200 t, oil_frequency: 20 Hz, gain: 60 /s}
"""
SECTIONS = "summary tested rig stability tracking test-response building coefficients limits provenance"
PROFILES = tuple(
    f"profile_{name}_shaken" for name in ("floor_displacement", "residual_floor_displacement", "floor_acceleration")
)


def _one_test(text: str) -> str:
    """The file with the test under a record only, without compensation and with the modified ATS."""
    first, _, last = text.partition("  - {name: cycles")
    kept = [line for line in first.splitlines(keepends=True) if not line.startswith(("  cubic", "  live"))]
    return "".join([*kept, last.partition("\n")[2]])


def _ran(folder: Path, text: str) -> Path:
    (folder / "shake.csv").write_text(RECORD, encoding="utf-8")
    (folder / "short.yaml").write_text(text, encoding="utf-8")
    return run_tests(load_rts_file(folder / "short.yaml"))[0]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("rts")
    archive = _ran(folder, TESTS.replace("RIG", RIG))
    for name in ("short.yaml", "shake.csv"):  # the archive is enough
        (folder / name).unlink()
    return archive


@pytest.fixture(scope="module")
def page(path: Path) -> str:
    return page_text(path)


@pytest.fixture(scope="module")
def figures(path: Path) -> list[tuple[str, str, Figure]]:
    with open_archive(path) as opened:
        return list(all_figures(opened))


@pytest.fixture(scope="module")
def one_test(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An archive with one test and two compensators."""
    return _ran(tmp_path_factory.mktemp("one"), _one_test(TESTS.replace("RIG", RIG)))


@pytest.fixture
def archive(path: Path) -> Iterator[Archive]:
    with open_archive(path) as opened:
        yield opened


def test_the_page_has_all_sections_and_figures(page: str) -> None:
    assert re.findall(r'<section id="([a-z-]+)"', page) == SECTIONS.split()
    figures = set(re.findall(r'<figure class="picture" id="figure-([A-Za-z0-9_]+)"', page))
    kinds = ("tracking", "synchronisation", "alpha", "live_delay", "specimen", "interface_energy")
    each = {f"{kind}_{test}" for kind in kinds for test in ("cycles", "shaken")}
    always = {"loop", "model_structure", "rig", "stability_map", "structure_shaken", "mean_profiles_shaken"}
    assert figures == {*always, *PROFILES, *each}
    assert "What could not be shown" not in page and len(page) < 1.5e6
    assert "second order, frequency 21.4 Hz" in page and "late in all" in page


def test_the_verdict_says_which_compensator_keeps_the_response_right(archive: Archive, page: str) -> None:
    results = SubstructureResults(archive)
    best = results.best("shaken")
    assert best in ("cubic", "modified", "live")
    errors = {run.compensator: run.value("response_error") for run in results.runs if run.test == "shaken"}
    assert errors[best] == min(errors[name] for name in ("cubic", "modified", "live"))
    said = re.search(r"<p>shaken: (.*?)</p>", page)
    assert said is not None and f"{best} (" in said.group(1) and "at most 5.00 % are allowed" in said.group(1)
    good, _, wrong = said.group(1).partition(" the response right")
    for name, error in errors.items():
        who = "the test without compensation" if name == "none" else name
        assert who in (good if error <= 0.05 else wrong)


def test_figures_are_drawn_as_files(figures: list[tuple[str, str, Figure]], one_test: Path, tmp_path: Path) -> None:
    """All that the archive has; as files those of fewer tests."""
    names = [name for name, _, _ in figures]
    assert names[:4] == ["loop", "model_structure", "rig", "stability_map"]
    assert len(names) == len(set(names)) == 22
    assert names[-1] == "response_shaken_shake" and set(names[-4:-1]) == set(PROFILES)
    written = draw_figures(one_test, tmp_path / "figures", "png")
    drawn = [file.stem for file in written]
    assert set(drawn) < set(names) and len(drawn) == len(set(drawn)) and {"rig", "tracking_shaken"} < set(drawn)
    assert all(file.stat().st_size > 5000 for file in written)


def test_captions_have_the_numbers_of_the_archive(archive: Archive, figures: list[tuple[str, str, Figure]]) -> None:
    captions = {name: caption for name, caption, _ in figures}
    direct = archive.group("tests/shaken").variables["direct_deformation"].values
    assert f"damper: direct {plain(1e3 * np.max(np.abs(direct)))}" in captions["structure_shaken"]
    rig = second_order(21.4, 0.4, 4.25e-3, 0.99488)
    assert f"without compensation {1e3 * phase_delay(rig, 1.5):.1f} ms" in captions["rig"]
    found = archive.group("tests/shaken/live").variables["alpha_0"].values[-1]
    assert 8e-3 < found < 12e-3
    late = float(re.search(r"live ([0-9.-]+) ms", captions["rig"]).group(1))  # type: ignore[union-attr]
    assert late == pytest.approx(2.0, abs=0.3) and "Not shown" not in captions["rig"]  # the step that is not seen
    assert "live converged: a delay of" in captions["stability_map"] and "Not shown" not in captions["stability_map"]
    assert "The dashed line is the law under the target" in captions["specimen_cycles"]
    assert "The dashed line is the direct analysis" in captions["specimen_shaken"]


def test_the_law_under_the_target_is_that_of_the_specimen(archive: Archive) -> None:
    """k x + c v of the target, and the specimen's own force where the rig follows."""
    from edesign.report.substructure.response_figures import _wanted

    found, _ = _wanted(SubstructureResults(archive), "cycles")
    assert found is not None
    force = 4.346e6 * found.deformation + 60e3 * np.gradient(found.deformation, found.time)
    assert np.max(np.abs(found.force - force)) < 1e-6 * np.max(np.abs(force))


def test_limits_and_what_cannot_be_determined_are_tables(archive: Archive) -> None:
    results = SubstructureResults(archive)
    rows = limits_table(results).texts
    assert ["cycles", "modified", "alpha_1"] in [row[:3] for row in rows]  # a rate of 0.01 s/s is met
    limited = archive.group("tests/cycles/modified").variables["limited"].values
    first, last, span = next(map(float, row[3:]) for row in rows if row[:3] == ["cycles", "modified", "alpha_1"])
    met = np.flatnonzero(limited.astype(int) & 2)
    assert (first, last, span) == pytest.approx(
        (2e-3 * met[0], 2e-3 * met[-1], 2e-3 * met.size), rel=5e-3
    )  # main steps of 2 ms
    said = undetermined_table(results).texts
    assert len(said) == len(results.runs[0].group.attributes["undetermined"])
    assert not runs_so_far_table(results).rows


def test_tables_fit_on_80_columns(archive: Archive) -> None:
    results = SubstructureResults(archive)
    tables = [*overview(archive), limits_table(results), undetermined_table(results)]
    stream = io.StringIO()
    print_tables(tables, stream)
    assert max(map(len, stream.getvalue().splitlines())) <= 80


def test_a_test_that_diverged_is_shown_as_far_as_it_went(tmp_path: Path) -> None:
    rig = RIG.replace("4.25 ms", "60 ms").replace("100 kN", "9 MN")
    archive = _ran(tmp_path, _one_test(TESTS.replace("RIG", rig).replace("k: 4.346", "k: 200")))
    page = page_text(archive)
    assert "no compensator keeps the response right" in page and "What could not be shown" not in page
    assert len(re.findall(r"<li>shaken, (?:none|modified): unstable, diverged", page)) == 2
    assert "figure-tracking_shaken" in page and "figure-structure_shaken" in page
    with open_archive(archive) as opened:
        peaks = building_tables(opened)[0]
    assert [row[1] for row in peaks.texts] == ["direct analysis", "none *", "modified *"]
    assert peaks.notes[-1].startswith("* not completed") and not any("%" in cell for row in peaks.texts for cell in row)


def test_what_was_not_kept_is_not_drawn_and_not_judged(tmp_path: Path) -> None:
    text = _one_test(TESTS.replace("RIG", RIG)) + "outputs: {histories: [target]}\n"
    with open_archive(_ran(tmp_path, text)) as archive:
        names = [name for name, _, _ in all_figures(archive)]
        table = limits_table(SubstructureResults(archive))
    # of the building largest values are kept in any case
    assert names == ["loop", "model_structure", "rig", "stability_map", "mean_profiles_shaken", *PROFILES]
    assert not table.rows and "Not known of modified" in table.notes[-1]


def test_other_methods_have_a_section_and_a_rig_without_specimen_no_loops(tmp_path: Path) -> None:
    path = _ran(tmp_path, _one_test(TESTS.replace("RIG", RIG)) + METHOD_TESTS)
    page = page_text(path)
    assert 'id="other-methods"' in page and "pseudo-dynamic" in page and "What could not be shown" not in page
    drawn = {f"{kind}_{test}" for kind in ("structure", "specimen") for test in ("slow", "pushed", "table")}
    for name in (*drawn, "interface_energy_slow", "force_pushed", "table_table"):
        assert f'id="figure-{name}"' in page, name
    with open_archive(path) as archive:
        methods = other_methods(archive)
        captions = {name: caption for name, caption, _ in all_figures(archive)}
        pushed, slow = archive.group("tests/pushed"), archive.group("tests/slow")
    share = 100.0 * float(pushed.variables["force_ratio"].values)
    assert f"natural frequency, arrive {plain(share)} %" in captions["force_pushed"]
    assert ", 100 % of the force" in captions["force_pushed"]
    error = 100.0 * float(slow.variables["response_error"].values)
    (row,) = (row for row in methods.texts if row[0] == "slow")
    assert row[2:] == ["response error, rms [%]", significant(error, 3), "good" if error <= 5.0 else "too wrong"]
    stream = io.StringIO()
    print_tables([methods], stream)
    assert max(map(len, stream.getvalue().splitlines())) <= 80
    _check_energy(slow)
    left = ("structure", "specimen", "  cubic", "  live", "  - {name: shaken")
    lines = [line for line in TESTS.replace("RIG", RIG).splitlines(keepends=True) if not line.startswith(left)]
    (tmp_path / "bare").mkdir()
    with open_archive(_ran(tmp_path / "bare", "".join(lines))) as archive:
        names = [name for name, _, _ in all_figures(archive)]
    assert names == ["loop", "rig", "tracking_cycles", "synchronisation_cycles", "alpha_cycles"]


def _check_energy(slow: Group) -> None:
    """Of an undershoot d of each increment a spring k has the energy error d h k (int v^2 dt - x v at the end).

    Measured less target is -d h v, and F = k x, as the dashpot hardly counts in a test 100 times slower.
    """
    x, step = slow.variables["target"].values, 2e-3
    v = np.gradient(x, step)
    exact = 0.02 * step * 4.346e6 * (step * np.sum(v**2) - x[-1] * v[-1])
    assert slow.variables["interface_energy_error"].values[-1] == pytest.approx(exact, rel=0.05)


def test_an_interrupted_archive_shows_the_runs_so_far(one_test: Path, tmp_path: Path) -> None:
    with open_archive(one_test) as whole, ArchiveWriter(tmp_path / "part.h5", whole.group()) as writer:
        for place in ("tests/shaken", "tests/shaken/none", "tests/shaken/modified"):
            writer.write(place, whole.group(place))
        shutil.copy(tmp_path / "part.h5.partial", tmp_path / "copy.h5.partial")
    with open_archive(tmp_path / "copy.h5.partial") as archive:
        page = page_text(archive)
        rows = runs_so_far_table(SubstructureResults(archive)).texts
    assert rows == [["shaken", "none", "done", "-"], ["shaken", "modified", "done", "-"]]
    assert "indicators and verdicts come at its end" in page and "Runs so far" in page
    assert all(f"figure-{name}" in page for name in ("tracking_shaken", "structure_shaken", "alpha_shaken"))


@pytest.mark.parametrize(
    "lost", ["indicators", pytest.param("tests/shaken", marks=pytest.mark.slow), "tests/shaken/modified"]
)
def test_of_a_damaged_archive_the_rest_is_shown(
    one_test: Path, tmp_path: Path, lost: str, capsys: pytest.CaptureFixture[str]
) -> None:
    damaged = tmp_path / "damaged.h5"
    shutil.copy(one_test, damaged)
    with h5py.File(damaged, "a") as file:
        del file[lost][next(name for name in file[lost] if isinstance(file[lost][name], h5py.Dataset))]
    assert main(["report", str(damaged)]) == 4
    said = capsys.readouterr().err
    assert lost in said and "Traceback" not in said
    page = damaged.with_suffix(".html").read_text(encoding="utf-8")
    assert "damaged" in page and "figure-loop" in page


def test_figures_of_a_damaged_archive_are_drawn(
    one_test: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    damaged = tmp_path / "damaged.h5"
    shutil.copy(one_test, damaged)
    with h5py.File(damaged, "a") as file:
        del file["tests/shaken/none/measured"]
    assert main(["show", str(damaged), "--figures", str(tmp_path / "figures")]) == 4
    assert "tests/shaken/none" in capsys.readouterr().err
    assert (tmp_path / "figures" / "tracking_shaken.svg").is_file()


def test_a_rig_in_a_file_is_that_beside_the_tests_or_is_said_to_be_missing(tmp_path: Path) -> None:
    (tmp_path / "rig.yaml").write_text(f"rig: {RIG}\n", encoding="utf-8")
    text = TESTS.replace("RIG", "{file: rig.yaml}").partition("  - {name: shaken")[0]
    archive = _ran(tmp_path, text)
    with open_archive(archive) as opened:
        described = SubstructureResults(opened).described
        assert described.plant is not None and described.plant.kind == "second_order"
    (tmp_path / "rig.yaml").unlink()
    with open_archive(archive) as opened:
        described = SubstructureResults(opened).described
        if "rig_text" not in opened.group().variables:
            assert described.plant is None and "which is not at hand" in described.reported[0]
            assert ("Rig", "that of rig.yaml") in described.rows()
        page = page_text(opened)
        assert "figure-loop" in page and "Targets are given in all tests" in page


def test_a_text_of_another_version_is_reported(tmp_path: Path) -> None:
    root = Group(attributes={"kind": "substructure", "title": "Later", "rts_file": "later.yaml"})
    root.add("rts_text", (), "edesign_rts: 1\nrig: {kind: magnetic}\n", "", "text")
    with ArchiveWriter(tmp_path / "later.h5", root) as writer:
        writer.finish({"status": "completed"})
    page = page_text(tmp_path / "later.h5")
    assert "This version cannot read the text of later.yaml" in page and "rts_text" not in page


def test_extremes_and_shape_of_long_curves_are_kept() -> None:
    """Over time no peak is lost; of a loop no point is farther away than a piece of its length."""
    time = np.linspace(0.0, 400.0, 50_001)
    wave = 50.0 * np.sin(7.0 * time) + np.random.default_rng(1).normal(size=time.size)
    kept = _fewer(np.column_stack([time, wave]))
    assert len(kept) < 10_000 and np.max(kept[:, 1]) == np.max(wave) and np.min(kept[:, 1]) == np.min(wave)
    assert np.all(np.diff(kept[:, 0]) >= 0.0) and kept[-1, 0] == time[-1]
    loop = np.column_stack([100.0 * np.cos(0.05 * time), 80.0 * np.sin(0.05 * time)])
    fewer = _fewer(loop)
    assert len(fewer) < len(loop)
    assert np.max(np.hypot(*np.diff(fewer, axis=0).T)) < 4.0 * TOLERANCE


def test_a_window_has_whole_cycles_around_the_largest_error() -> None:
    time = np.linspace(0.0, 10.0, 2001)
    error = np.exp(-((time - 6.0) ** 2))
    begin, end = window(time, np.sin(2.0 * np.pi * time), error)
    assert begin < 6.0 < end and end - begin == pytest.approx(4.0, abs=0.02)
    assert window(time, np.zeros_like(time), error) == (0.0, 10.0)


def test_a_loaded_rig_and_a_dashpot_are_reported_as_check_does(tmp_path: Path) -> None:
    from edesign.report.substructure import diagram
    from edesign.substructure.advice.advice import advise
    from edesign.substructure.virtual_tests import VirtualLaboratory

    rig = "{kind: servo_hydraulic, delay: 8 ms, proportional_gain: 100 /s, valve_time_constant: 2 ms, OIL}"
    text = _one_test(TESTS.replace("RIG", rig.replace("OIL", "oil_stiffness: 60 kN/mm")).replace(", bits: 16", ""))
    power = "{type: viscous_power, parameters: {c: 60 kN*(s/m)^0.3, alpha: 0.3}}"
    text = text.replace("{type: kelvin_voigt, parameters: {k: 4.346 kN/mm, c: 60 kN*s/m}}", power)
    with open_archive(_ran(tmp_path, text)) as archive:
        results = SubstructureResults(archive)
        linear, described = results.linearised, results.described
        assert linear is not None
        lines = (*diagram._rig(described, linear), *diagram._specimen(described, linear))
        unloaded = diagram._rig(described, None)
    (said,) = advise(VirtualLaboratory(load_rts_file(tmp_path / "short.yaml"))).tests
    assert linear.frequencies == pytest.approx([mode.frequency for mode in said.modes], rel=1e-3)
    assert linear.rig_delay == pytest.approx(said.modes[0].rig_delay, rel=1e-3)
    assert f"late in all {plain(1e3 * linear.rig_delay)} ms at {plain(linear.frequencies[0])} Hz" in lines
    assert any(line.startswith("storage stiffness 0 kN/mm, equivalent dashpot") for line in lines)
    assert "late in all 18.0 ms, unloaded" in unloaded


def test_a_series_of_backward_differences_is_drawn_as_one(tmp_path: Path) -> None:
    """On samples of a sine of 25 Hz by Eq. 6.17, a step late as the file says; a second difference is late by another.

    The rig is its own closed form.
    """
    from edesign.report.substructure.rig_figures import _paths

    text = _one_test(TESTS.replace("RIG", RIG)).replace("rates:", "derivatives: differences, rates:")
    with open_archive(_ran(tmp_path, text)) as archive:
        results = SubstructureResults(archive)
        assert results.described.transfer is not None
        paths, _ = _paths(results, results.described.transfer)
        (run,) = (run for run in results.runs if run.compensator == "modified")
        alpha = [run.value(f"mean_alpha_{i}") for i in range(3)]
    (drawn,) = (path.transfer for path in paths if path.label == "modified")
    step, s = 2e-3, 50j * np.pi
    x = np.exp(s * step * np.arange(4))
    first, second = np.diff(x)[-1] / step, np.diff(x, 2)[-1] / step**2
    sent = (alpha[0] * x[-1] + alpha[1] * first + alpha[2] * second) / x[-1]
    natural = 2.0 * np.pi * 21.4
    rig = 0.99488 * natural**2 * np.exp(-4.25e-3 * s) / (s**2 + 2.0 * 0.4 * natural * s + natural**2)
    assert drawn(np.array([s]))[0] == pytest.approx(rig * sent * np.exp(-s * step), rel=1e-9)
