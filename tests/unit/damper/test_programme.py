"""The virtual rig: what a programme plans, what it writes, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import typer
from messages import says
from typer.testing import CliRunner

from edesign.cli.characterise import characterise
from edesign.cli.test import test as test_command
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.programme import planned_tests, run_programme
from edesign.damper.testing.programme_file import load_programme
from edesign.damper.testing.property_table import read_property_table
from edesign.errors import InputError

K, C = 7e6, 2e5  # N/m, N s/m
HEAD = (
    "specimen: {name: p, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"
    "law: {type: kelvin_voigt, parameters: {k: 7 kN/mm, c: 0.2 kN*s/mm}}\n"
)
SINES = "tests:\n  - {type: sine, strain: [10 %, 0.3], frequency: [1 Hz, 2 Hz], temperature_C: 20}\n"
G = K * 0.012 / 0.0828


def write(folder: Path, text: str) -> Path:
    path = folder / "programme.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_full_factorial_takes_three_lines(tmp_path: Path) -> None:
    text = HEAD + (
        "tests:\n  - type: sine\n    strain: [10 %, 20 %, 30 %, 40 %, 50 %]\n"
        "    frequency: [0.25 Hz, 0.5 Hz, 1 Hz, 2 Hz, 3 Hz, 4 Hz]\n    temperature: [20 degC, 308.15 K]\n"
    )
    programme = load_programme(write(tmp_path, text))
    tests = [test for _, test in planned_tests(programme, programme.specimen.specimen)]
    assert len(tests) == 60 and len({test.name for test in tests}) == 60
    assert [test.temperature_C for test in tests] == pytest.approx([20.0] * 30 + [35.0] * 30)
    assert np.max(np.abs(tests[4].displacement)) == pytest.approx(0.006, rel=1e-5)  # strains change fastest
    assert tests[0].name == "001_sine_10pct_0.25Hz_20C" and tests[0].time[-1] == pytest.approx(88.0)


def test_the_campaign_has_the_force_of_the_law(tmp_path: Path) -> None:
    """Kelvin-Voigt: F = k u + c v, G' = k h / A, n = w c / k."""
    reported: list[tuple[int, int, str]] = []
    programme = load_programme(write(tmp_path, HEAD + SINES))
    run = run_programme(programme, tmp_path / "out", lambda *step: reported.append(step))
    assert [step[:2] for step in reported] == [(1, 4), (2, 4), (3, 4), (4, 4)] and run.warnings == ()
    campaign = load_campaign(tmp_path / "out" / "campaign.yaml")
    assert campaign.law is not None and campaign.law.parameters == {"k": "7 kN/mm", "c": "0.2 kN*s/mm"}
    test = campaign.tests[1]
    assert test.force is not None
    v = np.gradient(test.displacement, test.time, edge_order=2)
    assert test.force == pytest.approx(K * test.displacement + C * v, abs=1e-3 * np.max(test.force))
    table = read_property_table(tmp_path / "out" / "properties.csv")
    assert table.strain == pytest.approx([0.1, 0.3, 0.1, 0.3], rel=1e-5)
    assert table.frequency == pytest.approx([1.0, 1.0, 2.0, 2.0], rel=1e-5)
    assert table.G_storage == pytest.approx(G, rel=1e-5)
    assert table.loss_factor == pytest.approx(2.0 * np.pi * table.frequency * C / K, rel=1e-4)


def test_noise_is_of_the_share_and_seed_asked_for(tmp_path: Path) -> None:
    clean = run_programme(load_programme(write(tmp_path, HEAD + SINES)), tmp_path / "a").campaign
    noisy = HEAD + "noise: {force: 2 %, seed: 5}\n" + SINES
    first = run_programme(load_programme(write(tmp_path, noisy)), tmp_path / "b").campaign
    again = run_programme(load_programme(write(tmp_path, noisy)), tmp_path / "c").campaign
    added = []
    for one, other, third in zip(clean.tests, first.tests, again.tests, strict=True):
        assert one.force is not None and other.force is not None and third.force is not None
        noise = (other.force - one.force) / np.max(np.abs(one.force))
        assert np.std(noise) == pytest.approx(0.02, rel=0.03)  # 11 000 samples or more: 0.7 % standard error
        assert np.array_equal(other.force, third.force)
        added.append(noise[:1000])
    assert np.max(np.abs(np.corrcoef(added) - np.eye(4))) < 0.2  # each test has its own


def test_all_kinds_of_test(tmp_path: Path) -> None:
    t = np.linspace(0.0, 3.0, 301)
    lines = [f"{a:.6g},{b:.9g}" for a, b in zip(t, np.sin(2.0 * t) * t, strict=True)]
    (tmp_path / "quake.csv").write_text("\n".join(["time_s,displacement_cm", *lines]))
    text = HEAD + (
        "sampling_rate: 500 Hz\ntests:\n"
        "  - {type: sweep, displacement: 6 mm, frequency: 2 Hz, temperature_C: 20}\n"
        "  - {type: random, strain: 10 %, level: rms, band: [0.1 Hz, 4 Hz], duration: 8 s, seed: 1,\n"
        "     temperature: 20 degC}\n"
        "  - {type: record, file: quake.csv, displacement: 5 mm, temperature_C: 20, title: quake, use: validate}\n"
        "  - {type: record, file: quake.csv, temperature_C: 20}\n"
        "  - {type: sine, strain: 10 %, frequency: 2 Hz, cycles: 2, temperature_C: 20}\n"
    )
    run = run_programme(load_programme(write(tmp_path, text)), tmp_path / "out")
    sweep, noise, scaled, given, short = run.campaign.tests
    assert sweep.time[1] == 0.002 and np.max(np.abs(sweep.displacement)) == pytest.approx(0.006, rel=1e-3)
    assert np.sqrt(np.mean(noise.displacement**2)) == pytest.approx(0.0012)
    assert np.max(np.abs(scaled.displacement)) == pytest.approx(0.005)
    assert (scaled.title, scaled.use) == ("quake", "validate")
    assert np.max(np.abs(given.displacement)) == pytest.approx(0.01 * np.max(np.abs(np.sin(2 * t) * t)), rel=1e-4)
    assert not run.properties and len(run.warnings) == 1 and "005_sine" in run.warnings[0]
    assert short.force is not None and not (tmp_path / "out" / "properties.csv").exists()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HEAD + SINES.replace("sine", "sin"), "`sin` is unknown; did you mean `sine`?"),
        (HEAD + SINES.replace("2 Hz", "12 rad/s"), "4:57: tests[0].frequency[1]: E-UNIT-02"),
        (HEAD + SINES.replace("10 %", "10 mm"), "tests[0].strain[0] E-UNIT-02"),
        (HEAD + SINES.replace(", temperature_C: 20", ""), "tests[0].temperature_C E-KEY-02"),
        (HEAD + SINES.replace("strain: [10 %, 0.3], ", ""), "tests[0].strain E-KEY-02"),
        (HEAD + SINES.replace("type: sine", "type: sine, ramp_up: 0.7"), "tests[0].ramp_up E-PROG-02"),
        (HEAD + SINES.replace("type: sine", "type: sine, displacement: 1 mm"), "tests[0].strain E-KEY-03"),
        (HEAD + "tests:\n  - {type: record, file: no.csv, temperature_C: 20}\n", "tests[0].file E-FILE-01"),
        (HEAD.replace("parameters: {k: 7 kN/mm, c: 0.2 kN*s/mm}", "refit: true") + SINES, "law.parameters E-KEY-02"),
        (HEAD.replace("kelvin_voigt", "kelvin_vogt") + SINES, "did you mean `kelvin_voigt`?"),
        (HEAD + "noise: {force: 1 %}\n" + SINES, "noise.seed E-KEY-02"),
    ],
)
def test_wrong_programmes(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError) as raised:
        load_programme(write(tmp_path, text))
    assert says(str(raised.value), said)


def test_a_wrong_parameter_names_the_file(tmp_path: Path) -> None:
    path = write(tmp_path, HEAD.replace("k: 7 kN/mm", "k: 7 kN") + SINES)
    with pytest.raises(InputError, match=r"programme\.yaml:\d+:\d+: law\.parameters\.k: .*E-UNIT-02"):
        load_programme(path)


@pytest.fixture
def app() -> typer.Typer:
    found = typer.Typer()
    found.command("test")(test_command)
    found.command("characterise")(characterise)
    return found


@pytest.mark.slow
def test_the_commands(tmp_path: Path, app: typer.Typer) -> None:
    runner = CliRunner()
    path, out = write(tmp_path, HEAD + SINES), tmp_path / "out"
    done = runner.invoke(app, ["test", str(path), "-o", str(out), "--figures", str(tmp_path / "f"), "--format", "svg"])
    assert done.exit_code == 0 and "002_sine_30pct_1Hz_20C" in done.output and "campaign:" in done.output
    assert len(list((tmp_path / "f").iterdir())) == 5
    refused = runner.invoke(app, ["test", str(path), "-o", str(out)])
    assert isinstance(refused.exception, InputError) and "there is a campaign already" in str(refused.exception)
    found = runner.invoke(app, ["characterise", str(out / "campaign.yaml"), "--json", "--per-cycle"])
    data = json.loads(found.stdout)["tests"]["001_sine_10pct_1Hz_20C"]
    assert data["mean"]["G_storage"] == pytest.approx(G, rel=1e-5)
    assert data["mean"]["cycles"] == [5, 15] and len(data["each_cycle"]["loss_factor"]) == 18
    options = ["--layers", "2", "--layer-area", "41400 mm^2", "--layer-thickness", "12 mm", "--temperature", "20 degC"]
    single = [str(out / "004_sine_30pct_2Hz_20C.csv"), *options, "-o", str(tmp_path / "p.csv"), "--cycles", "2-3"]
    assert runner.invoke(app, ["characterise", *single]).exit_code == 0
    assert read_property_table(tmp_path / "p.csv").loss_factor == pytest.approx([4.0 * np.pi * C / K], rel=1e-4)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["a.csv"], "--layers, --layer-area, --layer-thickness: E-CLI-03"),
        (["a.csv", "b.yaml"], "a.csv: E-CLI-05"),
        (["b.yaml", "--layers", "2"], "b.yaml: E-FILE-01"),
        (["a.csv", "--cycles", "five"], "--cycles E-CLI-04"),
        (["a.csv", "--cycles", "9-5"], "cycles: 9 to 5 E-TEST-08"),
        (["a.csv", "--format", "jpg"], "--format E-CLI-04"),
    ],
)
def test_wrong_words(app: typer.Typer, words: list[str], said: str) -> None:
    result = CliRunner().invoke(app, ["characterise", *words])
    assert isinstance(result.exception, InputError) and says(str(result.exception), said)
