"""Effects of damper laws in files: names, units, temperature; in projects and on the virtual rig; refusals."""

from __future__ import annotations

import re
from pathlib import Path

import damper_effects as definitions
import numpy as np
import pytest

from edesign.core import Analysis, Channel, CoreDamper, Newmark
from edesign.core.damper import PLACEMENTS
from edesign.damper.damper import Damper
from edesign.damper.effect_forms import FORMER_FORMS
from edesign.damper.effects import LAW_EFFECTS, LawEffect
from edesign.damper.effects_file import read_effects, write_effects
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.laws import law
from edesign.damper.parameters import practical_unit, read_parameters
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.programme import run_programme
from edesign.damper.testing.programme_file import load_programme
from edesign.damper.testing.steady_state import predict
from edesign.damper.thesis_tables import PROTOTYPE
from edesign.errors import InputError
from edesign.frame.project_file import load_project
from edesign.project.dampers.dampers import Effect
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.structure import make_frame

ROOT = Path(__file__).parents[3]
THESIS = (ROOT / "projects" / "thesis_one_storey" / "project.yaml").read_text(encoding="utf-8")
MGMM = read_parameters(law("mgmm"), "thesis_table_4_2")
EFFECTS = """effects:
  - {name: payne, form: whole, parameters: {d: 20 %, a0: 3 mm, m: 1, tau_a: 5 s}}
  - {name: velocity_exponent, form: dashpot, parameters: {c: 1.2 kN*(s/mm)^0.4, alpha: 0.4}}
  - {name: degradation, form: energy, parameters: {d: 0.1, E0: 20 kJ}}
"""
LAW = "type: mgmm\nparameters: thesis_table_4_2\n" + EFFECTS
READ = (
    LawEffect("payne", "whole", {"d": 0.2, "a0": 3e-3, "m": 1.0, "tau_a": 5.0}),
    LawEffect("velocity_exponent", "dashpot", {"c": 1.2e3 * 1e3**0.4, "alpha": 0.4}),
    LawEffect("degradation", "energy", {"d": 0.1, "E0": 2e4}),
)


def law_file(folder: Path, text: str) -> Path:
    path = folder / "law.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def project_file(folder: Path, old: str = "      parameters: thesis_table_4_2\n", new: str = "") -> Path:
    """The one-storey system of the thesis with effects of its damper, at another size of it."""
    block = "".join(f"      {line}\n" for line in EFFECTS.splitlines())
    text = THESIS.replace(old, new or old + block).replace(
        "law: tested}", "law: tested, layers: 4, layer_thickness: 6 mm}"
    )
    path = folder / "project.yaml"
    path.write_text(text, encoding="utf-8")
    return path


# ---- files


@pytest.mark.parametrize("placed", definitions.PLACED)
def test_what_is_written_reads_back(placed):
    effect = definitions.example(*placed)
    (written,) = write_effects([effect])
    (back,) = read_effects([Effect(**written)])
    assert (back.name, back.form, back.placement) == placed
    assert ("placement" in written) == (effect.placement != "whole")
    assert back.values == pytest.approx(effect.values, rel=1e-12)
    assert set(written["parameters"]) == {parameter.name for parameter in effect.definition.parameters}


@pytest.mark.parametrize(("name", "former"), FORMER_FORMS)
def test_a_former_form_is_read_and_written_as_one_of_today_with_its_placement(name, former):
    form, placement = FORMER_FORMS[name, former]
    today = definitions.example(name, form, placement)
    (written,) = write_effects([today])
    (back,) = read_effects([Effect(name=name, form=former, parameters=written["parameters"])])
    assert (back.form, back.placement, back.label) == (form, placement, f"{name}.{form} (inside)")
    assert back.for_core().values == pytest.approx(today.for_core().values, rel=1e-12)
    assert write_effects([back]) == [written]


def test_a_law_file_carries_effects(tmp_path):
    found = resolve(*read_law_file(law_file(tmp_path, LAW)), None)
    assert found.values == MGMM
    assert [one.definition.name for one in found.effects] == [one.definition.name for one in READ]
    for one, expected in zip(found.effects, READ, strict=True):
        assert one.values == pytest.approx(expected.values, rel=1e-12)
    assert [one.name for one in found.for_core.effects] == [one.definition.name for one in READ]


def test_a_project_or_its_law_file_says_the_effects(tmp_path):
    law_file(tmp_path, LAW)
    block = "".join(f"      {line}\n" for line in EFFECTS.splitlines())
    old = "      type: mgmm\n      parameters: thesis_table_4_2\n      temperature: 20 degC\n"
    both = project_file(tmp_path, old, "      file: law.yaml\n" + block)
    with pytest.raises(InputError, match=r"laws\.tested\.effects: .*E-KEY-03"):
        load_project(both)
    alone = device_laws(load_project(project_file(tmp_path, old, "      file: law.yaml\n")))
    assert alone == device_laws(load_project(project_file(tmp_path)))


WRONG = {
    "no such effect": (
        ("name: payne", "name: pain"),
        r"law.yaml:4:12: effects\[0\].name: there is no effect `pain` of a damper law; did you mean `payne`\?",
    ),
    "no such form": (
        ("form: whole", "form: hole"),
        r"law.yaml:4:25: effects\[0\].form: the effect `payne` has no form `hole`; did you mean `whole`\?",
    ),
    "unit": (("a0: 3 mm", "a0: 3 kN"), r"law.yaml:4:58: effects\[0\].parameters.a0: .*`1 mm`.*E-UNIT-02"),
    "no unit": (("tau_a: 5 s", "tau_a: 5"), r"effects\[0\].parameters.tau_a: .*E-UNIT-01"),
    "unknown parameter": (
        ("E0: 20 kJ", "E_0: 20 kJ"),
        r"law.yaml:6:\d+: effects\[2\].parameters.E_0: .*did you mean `E0`\?.*E-LAW-02",
    ),
    "missing parameter": ((", E0: 20 kJ", ""), r"effects\[2\].parameters.E0: .*E-LAW-02"),
    "out of bounds": (("d: 0.1", "d: 1.1"), r"law.yaml:6:\d+: effects\[2\].parameters.d: .*at most 1 .*E-VALUE-02"),
    "exponent": (("alpha: 0.4}", "alpha: 0.5}"), r"effects\[1\].parameters.c: .*alpha = 0.5 .*E-UNIT-02"),
    "unknown key": (("form: whole,", "form: whole, kind: x,"), r"effects\[0\].kind: .*E-KEY-01"),
    "no form": (("form: whole, ", ""), r"law.yaml:4:5: effects\[0\].form: .*E-KEY-02"),
    "inside": (
        (
            LAW,
            LAW.replace("mgmm", "viscous")
            .replace("thesis_table_4_2", "{c: 1 kN*s/mm}")
            .replace("whole", "whole_inside"),
        ),
        r"law.yaml:4:25: effects\[0\].form: effect payne.whole: .* law viscous .*E-CORE-02",
    ),
    "no such placement": (
        ("form: whole,", "form: whole, placement: spring,"),
        r"law.yaml:4:43: effects\[0\].placement: `spring` is unknown; did you mean `springs`\? "
        r"\(allowed: `whole`, `inside`, `springs`, `dashpots`\)",
    ),
    "a force on springs": (
        ("form: dashpot,", "form: dashpot, placement: springs,"),
        r"effects\[1\].placement: effect velocity_exponent.dashpot: .*\(allowed: `whole`, `inside`\).*E-LAW-01",
    ),
    "springs of a law without": (
        (
            LAW,
            LAW.replace("mgmm", "viscous")
            .replace("thesis_table_4_2", "{c: 1 kN*s/mm}")
            .replace("form: whole,", "form: whole, placement: springs,"),
        ),
        r"law.yaml:4:43: effects\[0\].placement: effect payne.whole: .* law viscous .*E-CORE-02",
    ),
    "inside by placement": (
        (
            LAW,
            LAW.replace("mgmm", "viscous")
            .replace("thesis_table_4_2", "{c: 1 kN*s/mm}")
            .replace("form: whole,", "form: whole, placement: inside,"),
        ),
        r"effects\[0\].placement: effect payne.whole: .* law viscous .*E-CORE-02",
    ),
    "two placements": (
        ("form: whole,", "form: whole_inside, placement: whole,"),
        r"effects\[0\].placement: effect payne.whole_inside: .*`inside`, .*`whole`; .*E-LAW-01",
    ),
    "neither side": (
        (EFFECTS, "effects: [{name: one_sided, form: factor, parameters: {b: 0.1, side: 0.5}}]\n"),
        r"law.yaml:3:70: effects\[0\].parameters.side: .*1 or -1 .*E-LAW-03",
    ),
    "no factor": (
        (EFFECTS, "effects: [{name: ageing, form: linear, parameters: {rate: -0.2, n: 6}}]\n"),
        r"effects\[0\].parameters: effect ageing.linear: 1 \+ rate n = -0.2 .*E-LAW-04",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_reported_with_its_place(tmp_path, case):
    (old, new), message = WRONG[case]
    assert old in LAW
    path = law_file(tmp_path, LAW.replace(old, new))
    with pytest.raises(InputError, match=message):
        resolve(*read_law_file(path), None)


def test_all_that_is_wrong_is_reported_at_once_and_in_a_project_too(tmp_path):
    path = project_file(tmp_path)
    path.write_text(
        path.read_text().replace("a0: 3 mm", "a0: 0 mm").replace("E0: 20 kJ", "E0: 20 kW"), encoding="utf-8"
    )
    with pytest.raises(InputError) as error:
        device_laws(load_project(path))
    lines = str(error.value).splitlines()
    assert len(lines) == 2
    assert re.search(r"project.yaml:44:\d+: dampers.laws.tested.effects\[0\].parameters.a0: .*greater than 0", lines[0])
    assert re.search(r"project.yaml:46:\d+: dampers.laws.tested.effects\[2\].parameters.E0: ", lines[1])


def test_an_effect_that_a_braced_law_cannot_have_is_reported(tmp_path):
    path = project_file(tmp_path)
    text = (
        path.read_text()
        .replace("type: mgmm", "type: maxwell_power")
        .replace("thesis_table_4_2", "{c: 300 kN*(s/m)^0.35, alpha: 0.35, k: 50 kN/mm}")
    )
    path.write_text(text.replace("layers: 4,", "layers: 4, brace: {stiffness: 90 kN/mm},"), encoding="utf-8")
    message = r"project.yaml:\d+:\d+: dampers.devices\[0\]: .*S_1_1: effect payne.whole: .* brace must be rigid"
    with pytest.raises(InputError, match=message):
        make_frame(load_project(path), dampers=True)


# ---- temperature and age


def test_a_temperature_is_that_of_the_dampers(tmp_path):
    text = "type: mgmm\nparameters: thesis_table_4_2\neffects:\n"
    effect = "  - {name: temperature_law, form: exponential, parameters: {b: 0.02 1/K, T0: 293.15 K}}\n"
    described = read_law_file(law_file(tmp_path, text + effect))
    warm = resolve(*described, 35.0)
    assert warm.values["k0"] == pytest.approx(0.82 * MGMM["k0"])  # Table 4.4, and the effect on top of it
    assert "published factor gamma_T" in warm.warnings[0]
    assert warm.for_core.effects[0].values == pytest.approx((np.exp(-0.3),))
    assert resolve(*described, None).for_core.effects[0].values == (1.0,)
    both = law_file(tmp_path, text + effect + "temperature_law: {gamma_T: {20 degC: 1, 35 degC: 0.8}}\n")
    warm = resolve(*read_law_file(both), 35.0)
    assert warm.values["k0"] == pytest.approx(0.8 * MGMM["k0"]) and warm.warnings == ()
    assert warm.for_core.effects[0].values == pytest.approx((np.exp(-0.3),))


def test_arrhenius_is_a_wlf_whose_rate_falls_with_the_absolute_temperature(tmp_path):
    # E/R = 3000 K about 20 degC: b = E/(R T0^2), c = 1/T0
    numbers = f"{{b: {3000.0 / 293.15**2:.12g} 1/K, c: {1.0 / 293.15:.12g} 1/K, T0: 20 degC}}"
    effect = f"effects: [{{name: temperature_law, form: wlf, parameters: {numbers}}}]\n"
    described = read_law_file(
        law_file(tmp_path, "type: kelvin_voigt\nparameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}\n" + effect)
    )
    for degrees in (5.0, 20.0, 35.0):
        expected = np.exp(3000.0 * (1.0 / (273.15 + degrees) - 1.0 / 293.15))
        assert resolve(*described, degrees).for_core.effects[0].values == pytest.approx((expected,), rel=1e-9)


def test_a_transition_is_half_done_at_its_middle(tmp_path):
    effect = (
        "effects: [{name: temperature_law, form: transition, parameters: {d: 0.4, Tc: 300 K, w: 1 K, T0: -10 degC}}]\n"
    )
    described = read_law_file(
        law_file(tmp_path, "type: kelvin_voigt\nparameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}\n" + effect)
    )
    for degrees, expected in ((-10.0, 1.0), (26.85, 0.8), (60.0, 0.6)):  # 36 widths away S is 0 or 1 to 1e-14
        assert resolve(*described, degrees).for_core.effects[0].values == pytest.approx((expected,), rel=1e-12)


@pytest.mark.parametrize(
    ("effect", "degrees", "message"),
    [
        ("form: wlf, parameters: {b: 0.02 1/K, c: 0.02 1/K, T0: 20 degC}", -40.0, "= -0.2 at -40 degC .*E-LAW-04"),
        (
            "form: transition, parameters: {d: 1.5, Tc: 30 degC, w: 2 K, T0: 20 degC}",
            40.0,
            r"at 40 degC, .* -0\.48.*E-LAW-04",
        ),
    ],
)
def test_where_a_law_of_the_temperature_ends_is_reported(tmp_path, effect, degrees, message):
    text = "type: kelvin_voigt\nparameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}\n"
    described = read_law_file(law_file(tmp_path, f"{text}effects: [{{name: temperature_law, {effect}}}]\n"))
    with pytest.raises(InputError, match=message):
        resolve(*described, degrees)


def test_a_law_without_temperature_law_has_the_effect_alone(tmp_path):
    text = "type: kelvin_voigt\nparameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}\n"
    effect = "effects: [{name: temperature_law, form: exponential, parameters: {b: 0.02 1/K, T0: 20 degC}}]\n"
    warm = resolve(*read_law_file(law_file(tmp_path, text + effect)), 35.0)
    assert warm.values["k"] == 3e6 and warm.warnings == ()
    (warning,) = resolve(*read_law_file(law_file(tmp_path, text)), 35.0).warnings
    assert "no temperature law here" in warning


def test_constant_factors_multiply_the_force():
    t = np.linspace(0.0, 1.0, 101)
    u = 5e-3 * np.sin(6.0 * t)
    aged = LawEffect("ageing", "linear", {"rate": -0.02, "n": 5.0})
    cold = LawEffect("temperature_law", "exponential", {"b": 0.01, "T0": 20.0})
    both = Damper(law("mgmm"), MGMM, effects=(aged, cold), temperature_C=10.0).force(t, u)
    assert both == pytest.approx(0.9 * np.exp(0.1) * Damper(law("mgmm"), MGMM).force(t, u), rel=1e-12)


def test_properties_of_steady_tests_see_effects_and_temperature():
    """Law and effects are multiplied: G' and G'' by the same factor, the loss factor stays."""
    cold = LawEffect("temperature_law", "exponential", {"b": 0.02, "T0": 20.0})
    plain = predict(Damper(law("mgmm"), MGMM), PROTOTYPE, 0.3, 1.0, [20.0, 30.0], cycles=(2, 3))
    found = predict(Damper(law("mgmm"), MGMM, effects=(cold,)), PROTOTYPE, 0.3, 1.0, [20.0, 30.0], cycles=(2, 3))
    assert found.G_storage == pytest.approx(plain.G_storage * np.exp([0.0, -0.2]), rel=1e-12)
    assert found.loss_factor == pytest.approx(plain.loss_factor, rel=1e-12)
    assert found.warnings == plain.warnings


# ---- in a project and on the rig


def test_a_frame_has_the_effects_of_its_law_at_the_size_of_the_device(tmp_path):
    project = load_project(project_file(tmp_path))
    frame = make_frame(project, dampers=True)
    (device,) = frame.devices
    assert (device.force_scale, device.deformation_scale) == (2.0, 2.0)
    analysis = Analysis(frame.model, tolerance=1e-10)
    analysis.install_dampers()
    channels = [
        Channel(name, tuple((c, name, node, degree) for c, node, degree in device.terms))
        for name in ("displacement", "velocity")
    ]
    force = Channel("force", ((1.0, "damper_force", device.number, 0),))
    dt = 0.005
    t = np.arange(401) * dt
    ground = 3.0 * np.sin(2.0 * np.pi * 2.0 * t) * np.exp(-t)
    found = analysis.history(ground, dt, method=Newmark(), channels=(*channels, force)).values
    u, v = found["displacement"], found["velocity"]
    assert np.max(np.abs(u)) > 1e-3
    plain = CoreDamper("mgmm", list(MGMM.values())).force(t, 2.0 * u, 2.0 * v)
    expected = 2.0 * definitions.with_effects(READ, plain, t, 2.0 * u, 2.0 * v)
    peak = np.max(np.abs(expected))
    assert np.max(np.abs(found["force"] - expected)) < 1e-8 * peak  # the same steps; rounding of u in the frame
    assert np.max(np.abs(2.0 * plain - expected)) > 0.05 * peak


def test_the_virtual_specimen_has_effects_that_its_campaign_does_not_name(tmp_path):
    block = "".join(f"  {line}\n" for line in EFFECTS.splitlines())
    text = (
        "specimen: {name: p, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"
        f"law:\n  type: mgmm\n  parameters: thesis_table_4_2\n{block}"
        "tests: [{type: sweep, strain: 30 %, frequency: 1 Hz, temperature_C: 20}]\n"
    )
    path = tmp_path / "programme.yaml"
    path.write_text(text, encoding="utf-8")
    run_programme(load_programme(path), tmp_path / "out")
    campaign = load_campaign(tmp_path / "out" / "campaign.yaml")
    (test,) = campaign.tests
    assert "effects" not in (tmp_path / "out" / "campaign.yaml").read_text(encoding="utf-8")
    expected = Damper(law("mgmm"), MGMM, effects=READ).force(test.time, test.displacement)
    assert test.force == pytest.approx(expected, abs=1e-5 * np.max(np.abs(expected)))  # digits of the CSV
    path.write_text(text.replace("E0: 20 kJ", "E0: 20 mm"), encoding="utf-8")
    with pytest.raises(InputError, match=r"programme\.yaml:8:\d+: law\.effects\[2\]\.parameters\.E0: .*E-UNIT-02"):
        load_programme(path)


# ---- the page


def test_the_page_has_every_effect_with_its_parameters():
    text = (ROOT / "docs" / "reference" / "laws" / "effects.md").read_text(encoding="utf-8")
    rows = set(re.findall(r"^\| `([\w.]+)` \| `(\w+)` \| (\S+) \| .+ \|$", text, re.M))
    assert rows == {(k.name, p.name, practical_unit(p) or "-") for k in LAW_EFFECTS.values() for p in k.parameters}
    for name, form in LAW_EFFECTS:
        assert re.search(rf"^\| `{name}`, `{form}` \|", text, re.M), (name, form)
    placements = re.findall(
        r"^\| `(\w+)` \| .* \| .* \|$", text.partition("## Placement")[2].partition("\n## ")[0], re.M
    )
    assert placements == list(PLACEMENTS)
    for name, former in FORMER_FORMS:
        assert re.search(rf"^\| `{name}` \| .*`{former}`", text, re.M), (name, former)
