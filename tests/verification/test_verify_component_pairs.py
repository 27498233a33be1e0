"""Pairs of components: their combined spectrum and common factor, by closed form and by rotations written here."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cases import small_frame
from support.messages import says

from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.codes.ec8 import ElasticSpectrum, national_parameters
from edesign.ground_motion.component_pairs import combined_spectrum, fit_pair
from edesign.ground_motion.matching import MatchOptions
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.records.records import CombinedSpectrum
from edesign.report.ground_motion.record_figures import record_figures
from edesign.report.ground_motion.record_tables import tables_of

STEP = 0.01
T = np.geomspace(0.1, 1.5, 20)
TARGET = ElasticSpectrum(2.0, national_parameters().horizontal(1, "B"))
OPTIONS = MatchOptions(method="scale", periods=(0.1, 1.5))
SPECTRA: tuple[CombinedSpectrum, ...] = ("geometric_mean", "srss", "rotd50", "rotd100")


def motion(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    t = np.arange(600) * STEP
    frequency = np.geomspace(0.7, 8.0, 30)
    size, phase = rng.uniform(0.3, 1.7, 30), rng.uniform(0.0, 2.0 * np.pi, 30)
    return np.sin(np.pi * t / 6.0) ** 2 * (size @ np.sin(2.0 * np.pi * np.outer(frequency, t) + phase[:, None]))


def record(name: str, values: np.ndarray) -> Record:
    return Record(name, values, STEP, name)


def spectrum(values: np.ndarray, periods: np.ndarray = T) -> np.ndarray:
    return psa(values, STEP, periods)


def rotated(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Spectra in 180 directions, one degree apart."""
    angles = np.radians(np.arange(180.0))
    return np.array([spectrum(first * np.cos(a) + second * np.sin(a)) for a in angles])


def test_combined_spectra_are_those_of_all_directions() -> None:
    first, second = motion(1), 0.7 * motion(2)
    pair = record("a", first), record("b", second)
    every = rotated(first, second)
    expected = {
        "geometric_mean": np.sqrt(spectrum(first) * spectrum(second)),
        "srss": np.sqrt(spectrum(first) ** 2 + spectrum(second) ** 2),
        "rotd50": np.median(every, axis=0),
        "rotd100": every.max(axis=0),
    }
    for name in SPECTRA:
        # the core rotates responses, here the motion is rotated: linear, so only rounding differs
        assert combined_spectrum(*pair, T, 0.05, name) == pytest.approx(expected[name], rel=1e-9)


def test_of_one_motion_in_a_direction_in_closed_form() -> None:
    """(cos a, sin a) times one motion: in direction b its spectrum times |cos(a - b)|."""
    a = np.radians(30.0)
    pair = record("a", np.cos(a) * motion(3)), record("b", np.sin(a) * motion(3))
    whole = spectrum(motion(3))
    middle = np.median(np.abs(np.cos(np.radians(np.arange(180.0)) - a)))
    assert combined_spectrum(*pair, T, 0.05, "rotd100") == pytest.approx(whole, rel=1e-9)
    assert combined_spectrum(*pair, T, 0.05, "rotd50") == pytest.approx(middle * whole, rel=1e-9)
    assert combined_spectrum(*pair, T, 0.05, "geometric_mean") == pytest.approx(
        np.sqrt(np.cos(a) * np.sin(a)) * whole, rel=1e-9
    )


def test_of_circular_motion_all_directions_are_alike() -> None:
    """A harmonic that turns: steady oscillators follow with A omega0^2 / |omega0^2 - omega^2 + 2 i zeta omega0 omega|.

    The swell of D = 240 s changes slowly beside what the oscillator in resonance remembers, tau = 1 / (zeta omega0) =
    3.2 s: it stays behind by (pi tau / D)^2 = 0.18 %, others by less.
    """
    t, A, omega = np.arange(24_000) * STEP, 1.5, 2.0 * np.pi
    swell = A * np.sin(np.pi * t / t[-1]) ** 2
    pair = record("a", swell * np.cos(omega * t)), record("b", swell * np.sin(omega * t))
    periods = np.array([0.3, 0.8, 1.0, 1.5, 2.0])
    omega0 = 2.0 * np.pi / periods
    exact = A * omega0**2 / np.abs(omega0**2 - omega**2 + 2j * 0.05 * omega0 * omega)
    for name in ("geometric_mean", "rotd50", "rotd100"):
        assert combined_spectrum(*pair, periods, 0.05, name) == pytest.approx(exact, rel=2.5e-3)
    assert combined_spectrum(*pair, periods, 0.05, "srss") == pytest.approx(np.sqrt(2.0) * exact, rel=2.5e-3)


def test_srss_of_equal_components() -> None:
    """The root of two squares is sqrt 2 times one; a pair of them that have the target needs no factor."""
    first, second = record("a", motion(4)), record("b", -motion(4))
    assert combined_spectrum(first, second, T, 0.05, "srss") == pytest.approx(np.sqrt(2.0) * spectrum(motion(4)))
    alone, both = (fit_pair(first, second, TARGET, OPTIONS, name) for name in ("geometric_mean", "srss"))
    assert both.factor == pytest.approx(alone.factor) and both.combined == pytest.approx(alone.combined)


@pytest.mark.parametrize("name", SPECTRA)
def test_the_factor_is_the_mean_of_the_logarithms_within_its_bounds(name: CombinedSpectrum) -> None:
    first, second = record("a", 0.3 * motion(1)), record("b", 0.2 * motion(2))
    found = fit_pair(first, second, TARGET, OPTIONS, name)
    periods = OPTIONS.matching_periods
    of_equal = np.sqrt(2.0) if name == "srss" else 1.0
    ratio = of_equal * TARGET.acceleration(periods) / combined_spectrum(first, second, periods, 0.05, name)
    assert found.factor == pytest.approx(np.exp(np.log(ratio).mean()), rel=1e-12)
    tripled = fit_pair(first.scaled(3.0), second.scaled(3.0), TARGET, OPTIONS, name)
    assert 3.0 * tripled.factor == pytest.approx(found.factor, rel=1e-9)
    assert tripled.combined == pytest.approx(found.combined, rel=1e-9)
    bounded = MatchOptions(method="scale", periods=(0.1, 1.5), scale_bounds=(0.1, 0.5 * found.factor))
    assert fit_pair(first, second, TARGET, bounded, name).factor == pytest.approx(0.5 * found.factor)
    assert fit_pair(first, second, TARGET, bounded, name).best == pytest.approx(found.factor)


PAIR = """\
hazard:
  code: ec8-2004
  a_gR: 0.2 g
  ground: B
  spectrum: 1
  levels: {DBE: {probability: 10 %}}
records:
  both:
    {pair: [{file: motion.AT2}, {file: other.AT2}], spectrum: rotd50, match: {method: scale, periods: [0.1 s, 1.5 s]}}
"""


def project(folder: Path, *changes: tuple[str, str]) -> Path:
    def at2(values: np.ndarray) -> str:
        rows = "\n".join(f"{value:.12e}" for value in values)
        head = "PEER NGA STRONG MOTION DATABASE RECORD\nMade for tests\nACCELERATION TIME SERIES IN UNITS OF G\n"
        return f"{head}NPTS= {values.size}, DT= .01 SEC\n{rows}\n"

    (folder / "other.AT2").write_text(at2(0.02 * motion(2)[:-50]))
    history = "  - {name: shake, kind: history, record: motion, pga: 0.3 g}\n"
    given = (
        ("records:\n  motion: {file: motion.AT2}\n", PAIR),
        (history, "  - {name: shake, kind: history, record: both, level: DBE}\n"),
    )
    path = small_frame.write(folder, *given, record=at2(0.03 * motion(1)))
    text = path.read_text()
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    path.write_text(text)
    return path


def test_a_history_of_a_pair_is_one_of_each_component(tmp_path: Path) -> None:
    assert main(["run", str(project(tmp_path)), "--quiet"]) == 0
    with open_archive(tmp_path / "project.h5") as archive:
        assert archive.names("analyses")[-2:] == ["shake.both.1", "shake.both.2"]
        pair = archive.group("records/both")
        about = pair.attributes["pair"]
        assert about["spectrum"] == "rotd50"
        motions = [STANDARD_GRAVITY * 0.03 * motion(1), STANDARD_GRAVITY * 0.02 * motion(2)]
        motions[1][-50:] = 0.0  # the shorter component ends with zeros
        for number, values in enumerate(motions, start=1):
            applied = archive.group(f"analyses/shake.both.{number}").variables["ground_acceleration"].values
            assert applied[: values.size] == pytest.approx(about["factor"] * values, rel=1e-8, abs=1e-10)
        periods = pair.coords["period"].values
        ratio = pair.variables["combined_psa"].values / pair.variables["target"].values
        # least squares of the logarithms at the matching periods; these are others, three times as dense
        assert np.log(ratio[(periods >= 0.1) & (periods <= 1.5)]).mean() == pytest.approx(0.0, abs=5e-3)
        figures = {name: caption for name, caption, _ in record_figures(archive)}
        assert list(figures) == ["both_after", "both.1", "both.2"]
        assert "their RotD50, and the target" in figures["both_after"]
        assert any(table.title == "both: both components by one factor" for table in tables_of(archive))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("method: scale", "method: wavelets", "records.both.match.method: E-SCALE-01"),
        ("{file: other.AT2}", "{file: motion.AT2}", "records.both.pair[1]: E-NAME-02"),
        ("{file: other.AT2}", "{file: none.AT2}", "records.both.pair[1].file: E-FILE-01"),
        ("{file: other.AT2}", "{file: other.AT2, match: {}}", "records.both.pair[1].match: E-KEY-03"),
        (", {file: other.AT2}", "", "records.both.pair: E-VALUE-01"),
        ("spectrum: rotd50", "spectrum: rotd", "records.both.spectrum: did you mean E-VALUE-03"),
        (", match: {method: scale, periods: [0.1 s, 1.5 s]}", "", "records.both.spectrum: E-SCALE-02"),
        ("record: both, level: DBE", "record: both, level: DBE, pga: 0.3 g", "analyses[2].pga: `both` E-KEY-03"),
        (
            "{file: other.AT2}",
            "{file: other.AT2, processing: [{resample: {time_step: 0.02 s}}]}",
            "0.01 s 0.02 s E-MOTION-04",
        ),
    ],
)
def test_mistakes(tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str) -> None:
    path = project(tmp_path, (old, new))
    assert main(["check", str(path)]) == 2
    assert says(errors := capsys.readouterr().err, said) and f"{path}:" in errors
