"""A stage that follows the results of a command fails, or is interrupted: the results stand, the stage is reported."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import yaml
from building_examples import SMALL
from kelvin_voigt_campaign import C, K, campaign, lawful
from rts_examples import MINIMAL
from selection_examples import random_frames
from support.messages import says
from unit.report.figure_archive import small_archive

import edesign
from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.damper.law_file import read_law_file, resolve
from edesign.errors import ArchiveError, Interrupted
from edesign.optional_stages import StageFailedWarning, noting_failures, optional

PROGRAMME = """specimen: {name: p, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
law: {type: zener, parameters: {k0: 4 kN/mm, k1: 5 kN/mm, c1: 1 kN*s/mm}}
sampling_rate: 100 Hz
tests:
  - {type: sine, strain: 10 %, frequency: 1 Hz, cycles: 20, temperature: 20 degC}
"""
TABLE = """specimen: {name: made, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}
law: {type: kelvin_voigt, parameters: {k: 4 kN/mm, c: 0.2 kN*s/mm}}
properties: {table: table.csv, hold_out: {strains: [20 %]}}
"""
CAUSE = "nothing belongs to it"


@dataclass(frozen=True)
class Case:
    """A command with a stage that fails.

    Attributes:
        words: of the command, after its files are made in the present folder.
        broken: function of the stage.
        stage: what the message calls it.
        results: files that must be whole.
        alone: whether what an interrupt leaves is reported: it is not where the stage is a part of another one.
    """

    words: Callable[[], list[str]]
    broken: str
    stage: str
    results: tuple[str, ...] = ()
    alone: bool = True


def _project(*more: str) -> Callable[[], list[str]]:
    def words() -> list[str]:
        edesign.new_project(Path("frame"))
        return ["run", "frame/project.yaml", "--only", "modes", "--archive", "out.h5", *more]

    return words


def _text(name: str, text: str, *words: str) -> Callable[[], list[str]]:
    def make() -> list[str]:
        Path(name).write_text(text, encoding="utf-8")
        return list(words)

    return make


def _archive(*words: str) -> Callable[[], list[str]]:
    def make() -> list[str]:
        small_archive(Path())
        return list(words)

    return make


def _campaign(*words: str) -> Callable[[], list[str]]:
    def make() -> list[str]:
        campaign(Path("c"), _hardened, tests=5)
        return list(words)

    return make


def _designed() -> list[str]:
    Path("b.yaml").write_text(random_frames(3, 2, 3).text, encoding="utf-8")
    return ["design", "b.yaml", "--output", "out.yaml", "--workers", "1"]


def _table() -> list[str]:
    """Moduli of a spring and a dashpot side by side, in closed form: G' = k h/(n A), G'' = 2 pi f c h/(n A)."""
    rows = ["temperature_C,shear_strain_percent,frequency_Hz,G_storage_MPa,G_eq_MPa,loss_factor"]
    scale, noise = 0.012 / (2 * 0.0414), np.random.default_rng(1)
    for strain in (10, 20, 30):
        for f in (0.5, 1.0, 2.0):
            loss = 2.0 * np.pi * f * C / K
            moduli = 1e-6 * K * scale * np.array([1.0, np.hypot(1.0, loss)]) * np.exp(3e-3 * noise.normal(size=2))
            rows.append(f"20,{strain},{f},{moduli[0]:.6f},{moduli[1]:.6f},{loss:.6f}")
    Path("table.csv").write_text("\n".join([*rows, ""]), encoding="utf-8")
    return _text("c.yaml", TABLE, "calibrate", "c.yaml", "--output", "out", "--workers", "1")()


def _hardened(t, u, v, a, order):  # type: ignore[no-untyped-def]
    return lawful(t, u, v, a, order) + 3e10 * u**3


def _suite() -> list[str]:
    t = 0.01 * np.arange(1000)
    rng = np.random.default_rng(2)
    for name in ("a.csv", "b.csv"):
        rows = (f"{x:.2f},{y:.5f}" for x, y in zip(t, np.sin(np.pi * t / 10.0) * rng.normal(size=1000), strict=True))
        Path(name).write_text("\n".join(["time_s,acceleration_m_s2", *rows, ""]), encoding="utf-8")
    site = [
        "--a-gr",
        "0.2g",
        "--ground",
        "B",
        "--method",
        "scale",
        "--scale-bounds",
        "0.001",
        "1000",
        "--unit",
        "m/s^2",
        "--periods",
        "0.1s",
        "2s",
    ]
    return ["match", "a.csv", "b.csv", *site, "--archive", "out.h5", "--csv", "csv", "--figures", "figures"]


FIT = ("fit", "c/campaign.yaml", "--starts", "1", "--output", "out")
CALIBRATE = ("calibrate", "c/campaign.yaml", "--workers", "1", "--output", "out")
CALIBRATED = ("out/calibration.json", "out/law.yaml", "out/calibration.h5")
CASES = {
    "run report": Case(_project("--report"), "edesign.cli.run.write_page", "the report", ("out.h5",)),
    "run tables": Case(_project(), "edesign.cli.run.short_tables", "the tables", ("out.h5",)),
    "run all tables": Case(_project("--all"), "edesign.cli.run.overview", "the tables", ("out.h5",)),
    "run building": Case(
        _text("b.yaml", SMALL, "run", "b.yaml", "--archive", "out.h5"),
        *("edesign.report.building.tables.all.short_building_tables", "the tables", ("out.h5",)),
    ),
    "design": Case(
        *(_designed, "edesign.cli.design.selection_tables", "the tables"),
        ("out.yaml", "out.h5"),
    ),
    "calibrate page": Case(
        *(_campaign(*CALIBRATE), "edesign.report.page.calibration.calibration_page", "the report", CALIBRATED),
    ),
    "calibrate tables": Case(
        *(_campaign(*CALIBRATE, "--no-page"), "edesign.report.calibration.tables.tables_of", "the tables", CALIBRATED),
    ),
    "calibrate verdict": Case(
        *(_campaign(*CALIBRATE, "--no-page"), "edesign.report.calibration.verdict.verdict_text", "the verdict"),
        CALIBRATED,
    ),
    "calibrate table": Case(
        *(_table, "edesign.report.page.calibration.calibration_page", "the report"),
        CALIBRATED[:2],
    ),
    "fit figures": Case(
        *(_campaign(*FIT, "--figures", "figures"), "edesign.cli.fit.draw_fits", "the figures"),
        ("out/law.yaml", "out/fit.json"),
    ),
    "fit cross-validation": Case(
        *(_campaign(*FIT, "--cross-validate"), "edesign.cli.fit.cross_validate"),
        *("the cross-validation of kelvin_voigt", ("out/law.yaml", "out/fit.json")),
    ),
    "fit validation": Case(
        *(_campaign(*FIT), "edesign.cli.fit.prediction_errors"),
        *("the prediction of tests for validation by kelvin_voigt", ("out/law.yaml", "out/fit.json")),
    ),
    "test figures": Case(
        _text("p.yaml", PROGRAMME, "test", "p.yaml", "--output", "out", "--figures", "figures"),
        *("edesign.cli.test.draw_tests", "the figures", ("out/campaign.yaml",)),
    ),
    "test table": Case(
        _text("p.yaml", PROGRAMME, "test", "p.yaml", "--output", "out"),
        *("edesign.cli.test.properties_table", "the table"),
        ("out/campaign.yaml", "out/properties.csv"),
    ),
    "characterise": Case(
        lambda: [*_tested("characterise"), "--output", "out.csv", "--figures", "figures"],
        *("edesign.cli.characterise.draw_tests", "the figures", ("out.csv",)),
    ),
    "sheet": Case(
        lambda: [*_tested("sheet"), "--output", "out.csv", "--page", "out.html"],
        *("edesign.cli.sheet.sheet_page", "the report", ("out.csv",)),
    ),
    "match figures": Case(_suite, "edesign.cli.match.draw_figures", "the figures", ("out.h5", "csv/a.csv")),
    "match tables": Case(
        *(_suite, "edesign.cli.match.record_tables", "the tables", ("out.h5", "csv/b.csv")),
    ),
    "rts run": Case(
        _text("r.yaml", MINIMAL, "rts", "run", "r.yaml", "--archive", "out.h5"),
        *("edesign.cli.rts.run.overview", "the tables", ("out.h5",)),
    ),
    "spectrum": Case(
        lambda: ["spectrum", "--ground", "C", "--a-gr", "0.36g", "--csv", "out.csv", "--figure", "s.png"],
        *("edesign.cli.spectrum.draw_spectra", "the figure", ("out.csv",)),
    ),
    "show": Case(
        _archive("show", "small.h5", "--figures", "figures"),
        *("edesign.cli.show.draw_figures", "the figures", ("small.h5",)),
    ),
    "report section": Case(
        _archive("report", "small.h5", "--output", "out.html"),
        *("edesign.report.page.sections.provenance.Facts", "the section `provenance` of the report", ("out.html",)),
        alone=False,
    ),
    "report figure": Case(
        _archive("report", "small.h5", "--output", "out.html"),
        *("edesign.report.page.sections.modes.mode_figures", "mode figures", ("out.html",)),
        alone=False,
    ),
    "export": Case(
        _archive("export", "small.h5", "--csv", "out"),
        *("edesign.report.export.catalogue.overview", "the tables of `edesign show`", ("out/contents.csv",)),
        alone=False,
    ),
    "export workbook": Case(
        _archive("export", "small.h5", "--xlsx", "out.xlsx", "--csv", "out"),
        *("edesign.cli.export.write_workbook", "out.xlsx", ("out/contents.csv", "small.h5")),
        alone=False,  # a form that comes before another one: an interrupt ends both
    ),
    "check": Case(
        _text("b.yaml", SMALL, "check", "b.yaml", "out.svg", "--figure"),
        *("edesign.report.model_drawings.draw_model", "the drawing of the model"),
        alone=False,
    ),
}


def _tested(command: str) -> list[str]:
    Path("p.yaml").write_text(PROGRAMME, encoding="utf-8")
    assert main(["test", "p.yaml", "--output", "rig", "--quiet"]) == 0
    return [command, "rig/campaign.yaml"]


def _whole(path: Path) -> bool:
    """Say whether a file is there and can be read to its end."""
    if path.suffix == ".h5":
        with open_archive(path) as opened:
            return opened.complete and not opened.damage
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".json":
        return bool(json.loads(text))
    if path.name == "law.yaml":
        return bool(resolve(*read_law_file(path), None).values)
    if path.suffix == ".yaml":
        return bool(yaml.safe_load(text))
    return text.endswith("\n")


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def _break(monkeypatch: pytest.MonkeyPatch, place: str, error: BaseException) -> None:
    def broken(*_: object, **__: object) -> None:
        raise error

    broken.__name__ = place.rpartition(".")[2]
    monkeypatch.setattr(place, broken)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_stage_that_fails_leaves_the_results(
    case: Case, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = case.words()
    _break(monkeypatch, case.broken, RuntimeError(CAUSE))
    assert main(words) == 5
    said = capsys.readouterr().err
    assert f"{case.stage} failed: an error in edesign itself (RuntimeError: {CAUSE})" in said
    assert "with the output of --debug" in said and "Traceback" not in said
    assert all(_whole(Path(name)) for name in case.results)
    if Path("out.html").exists():
        assert CAUSE in Path("out.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("case", [one for one in CASES.values() if one.alone], ids=[n for n in CASES if CASES[n].alone])
def test_an_interrupt_of_a_stage_leaves_the_results(
    case: Case, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = case.words()
    _break(monkeypatch, case.broken, KeyboardInterrupt())
    assert main(words) == 130
    assert f"edesign: interrupted at {case.stage}; " in capsys.readouterr().err
    assert all(_whole(Path(name)) for name in case.results)


def test_debug_shows_the_traceback(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    case = CASES["spectrum"]
    _break(monkeypatch, case.broken, RuntimeError(CAUSE))
    assert main([*case.words(), "--debug"]) == 5
    said = capsys.readouterr().err
    assert "Traceback" in said and f"RuntimeError: {CAUSE}" in said and "in broken" in said


@pytest.mark.parametrize(
    ("broken", "stage", "left"),
    [
        (
            "edesign.calibration.results.outcome.next_test",
            "asking which further test would separate the models",
            "next_test",
        ),
        ("edesign.calibration.results.models.Posterior.compared", "comparing the models of the search", "models"),
        ("edesign.calibration.results.fit._estimates", "the intervals of", ""),
    ],
)
def test_steps_of_a_calibration_that_fail(
    broken: str, stage: str, left: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The law that was found is that without the failure, to the last digit."""
    words = _campaign(*CALIBRATE)()
    assert main([*words, "--no-page", "--quiet"]) == 0
    law = yaml.safe_load(Path("out/law.yaml").read_text(encoding="utf-8"))
    _break(monkeypatch, broken, RuntimeError(CAUSE))
    assert main(words) == 5
    said = capsys.readouterr()
    assert f"{stage}" in said.err and f"failed: an error in edesign itself (RuntimeError: {CAUSE})" in said.err
    assert yaml.safe_load(Path("out/law.yaml").read_text(encoding="utf-8")) == law
    reported = json.loads(Path("out/calibration.json").read_text(encoding="utf-8"))
    if left:
        assert not reported[left] and CAUSE in reported["failed_steps"][stage]
        assert f"Left out: {stage} failed" in " ".join(said.out.split())
    else:
        k = reported["parameters"]["corrected"]["k"]
        assert CAUSE in k["not_determined"] and k["interval"] == [None, None] and k["standard_error"] is None
    page = Path("out/calibration.html").read_text(encoding="utf-8")
    assert CAUSE in page and "Errors before and after" in page


def test_asking_for_another_law_fails(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) * (1.0 + 0.2 * np.sin(2.0 * t))

    campaign(Path("c"), hidden, tests=5)
    _break(monkeypatch, "edesign.calibration.results.outcome.other_law", ValueError("math domain error"))
    assert main([*CALIBRATE, "--effort", "40"]) == 5
    assert "asking whether another law does better failed" in capsys.readouterr().err
    assert all(_whole(Path(name)) for name in CALIBRATED)


def test_a_law_file_that_cannot_be_made_leaves_all_that_was_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = _campaign(*CALIBRATE)()
    _break(monkeypatch, "edesign.calibration.write.law_text", KeyError("T0"))
    assert main(words) == 5
    said = capsys.readouterr().err
    assert "the corrected model failed: an error in edesign itself (KeyError: 'T0')" in said
    assert "out/calibration.json is written, but not all" in said
    assert _whole(Path("out/calibration.json")) and _whole(Path("out/calibration.h5"))
    assert not Path("out/law.yaml").exists() and Path("out/calibration.html").exists()
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    assert main([*words, "--no-page", "--quiet"]) == 0
    _break(monkeypatch, "edesign.calibration.write.law_text", KeyError("T0"))
    assert main([*words, "--no-page", "--quiet"]) == 5
    assert "out/calibration.json is written (out/law.yaml is of an earlier run)" in capsys.readouterr().err


def test_a_section_of_a_calibration_says_why_it_is_not_there(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = _campaign(*CALIBRATE)()
    _break(monkeypatch, "edesign.report.calibration.tables.effects_table", KeyError("T0"))
    _break(monkeypatch, "edesign.report.page.sections.calibration.loop_figures", ValueError("no loop"))
    assert main(words) == 5
    said = capsys.readouterr().err
    assert "the section `effects` of the report failed" in said and "loop figures failed" in said
    page = Path("out/calibration.html").read_text(encoding="utf-8")
    assert "This section could not be made" in page and "KeyError: &#39;T0&#39;" in page
    assert "Not drawn: loop figures" in page and "no loop" in page and "figure-residual" in page


def test_one_law_of_several_that_cannot_be_fitted(capsys: pytest.CaptureFixture[str]) -> None:
    """Another device than the specimen: the law of a brace asks for what the campaign does not say."""
    words = _campaign(*FIT, "--law", "kelvin_voigt", "--law", "buckling_restrained")()
    assert main(words) == 5
    said = capsys.readouterr()
    assert says(said.err, "the fit of buckling_restrained failed: `A_sc` E-FIT-02")
    assert "Kelvin-Voigt" in said.out and _whole(Path("out/kelvin_voigt/law.yaml"))
    assert not Path("out/buckling_restrained").exists()
    # none of them can be fitted: there is no result to stand
    assert main([*FIT, "--law", "buckling_restrained", "--quiet"]) == 2


def test_an_interrupt_of_the_second_law_leaves_the_first(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = _campaign(*FIT, "--law", "kelvin_voigt", "--law", "maxwell")()
    fitted = edesign.damper.fitting.fit_forces

    def interrupted(law, *given, **options):  # type: ignore[no-untyped-def]
        if law.name == "maxwell":
            raise KeyboardInterrupt
        return fitted(law, *given, **options)

    monkeypatch.setattr("edesign.damper.fitting.law_fit.fit_forces", interrupted)
    assert main(words) == 130
    said = capsys.readouterr()
    assert "interrupted at the fit of maxwell; fitted before it: kelvin_voigt" in said.err
    assert "Kelvin-Voigt" in said.out and _whole(Path("out/kelvin_voigt/law.yaml"))


def test_criteria_that_fail_leave_the_matched_records(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = _suite()
    _break(monkeypatch, "edesign.study.run.match.criteria", RuntimeError(CAUSE))
    assert main(words) == 5
    said = capsys.readouterr()
    assert "the criteria of the code failed" in said.err and _whole(Path("out.h5")) and _whole(Path("csv/a.csv"))
    with open_archive(Path("out.h5")) as opened:
        (suite,) = opened.names("records")
        assert any(CAUSE in text for text in opened.group_attributes(f"records/{suite}")["warnings"])


@pytest.mark.parametrize(
    ("broken", "stage"),
    [
        ("edesign.substructure.run.indicators", "the indicators"),
        ("edesign.substructure.run.with_unstable_loops", "whether the loops of cycles are stable"),
        ("edesign.substructure.run.write_run", "the CSV file of a run"),
    ],
)
def test_what_follows_substructure_tests_may_fail(
    broken: str, stage: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*CASES["rts run"].words(), "--csv", "csv"]
    _break(monkeypatch, broken, RuntimeError(CAUSE))
    assert main(words) == 5
    assert f"{stage} failed" in capsys.readouterr().err and _whole(Path("out.h5"))
    assert main(["report", "out.h5"]) == 0


@pytest.mark.parametrize(
    ("words", "broken", "stage"),
    [
        (_project(), "edesign.study.run.records.scale_warnings", "the warnings about the records"),
        (
            _text("b.yaml", SMALL, "run", "b.yaml", "--archive", "out.h5"),
            *("edesign.study.run.building.building_warnings", "the warnings about the building"),
        ),
    ],
)
def test_warnings_that_cannot_be_reported_leave_the_results(
    words: Callable[[], list[str]],
    broken: str,
    stage: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    made = words()
    _break(monkeypatch, broken, RuntimeError(CAUSE))
    assert main(made) == 5
    assert f"{stage} failed" in capsys.readouterr().err and _whole(Path("out.h5"))


def test_a_test_of_a_programme_without_properties(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = CASES["test table"].words()
    _break(monkeypatch, "edesign.damper.testing.programme.properties", RuntimeError(CAUSE))
    assert main(words) == 5
    assert "the properties of 001_sine_10pct_1Hz_20C failed" in capsys.readouterr().err
    assert _whole(Path("out/campaign.yaml")) and not Path("out/properties.csv").exists()


def test_one_figure_of_several_that_fails(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    words = CASES["test figures"].words()
    _break(monkeypatch, "edesign.report.damper.measured_figures.measured_figure", RuntimeError(CAUSE))
    assert main(words) == 5
    assert "the figure 001_sine_10pct_1Hz_20C.svg failed" in capsys.readouterr().err
    assert Path("figures/properties_20C.svg").exists()


def test_progress_that_nobody_reads_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone(io.StringIO):
        def write(self, text: str) -> int:
            raise BrokenPipeError

    words = _campaign(*CALIBRATE, "--no-page")()
    monkeypatch.setattr("sys.stderr", Gone())
    assert main(words) == 0
    assert all(_whole(Path(name)) for name in CALIBRATED)


def test_a_pipe_whose_reader_left_is_no_failure() -> None:
    with noting_failures() as failures, pytest.raises(BrokenPipeError), optional("the tables", "x"):
        raise BrokenPipeError
    assert not failures


def test_each_failure_is_noted_once_with_its_reason() -> None:
    with noting_failures() as failures:
        for _ in range(2):
            with optional("the page", "results are in a.h5") as attempt:
                raise ArchiveError("page.html: full [E-FILE-06]")
    assert [str(one) for one in failures] == ["the page failed: page.html: full [E-FILE-06]"]
    assert attempt.failure is not None and not attempt.failure.unexpected


def test_in_python_a_failure_is_a_warning_and_an_interrupt_goes_on() -> None:
    with pytest.warns(StageFailedWarning, match="the page failed: .*KeyError: 'x'.*; the result stands: a.h5"):
        with optional("the page", "a.h5"):
            raise KeyError("x")
    with pytest.raises(KeyboardInterrupt), optional("the page"):
        raise KeyboardInterrupt
    with (
        pytest.raises(Interrupted, match="interrupted at the page; it is in a.h5"),
        optional("the page", "it is in a.h5"),
    ):
        raise KeyboardInterrupt
