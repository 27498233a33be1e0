"""A sweep in Python fits its records once: fits of the same samples, target and options are those of before."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import edesign
from edesign.ground_motion.matching import Match, MatchOptions
from edesign.ground_motion.record import Record
from edesign.ground_motion.sources import Found
from edesign.study.motions import fitted, motions
from edesign.study.motions.fitted import fitted_once


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the records that were fitted in earnest, with nothing known from before."""
    names: list[str] = []
    fit = motions.match_record

    def counted(record: Record, *rest: Any) -> Match:
        names.append(record.name)
        return fit(record, *rest)

    monkeypatch.setattr(fitted, "_made", type(fitted._made)())
    monkeypatch.setattr(motions, "match_record", counted)
    return names


def test_variants_of_a_project_do_not_fit_again(made: list[str], tmp_path: Path) -> None:
    project = edesign.load_project(edesign.new_project(tmp_path / "frame", kind="damped"))
    groups = []
    for hardening in ("1 %", "2 %"):
        changed = project.with_values("materials.S275.hardening", hardening)
        done = edesign.run_project(changed, tmp_path / f"{hardening[:1]}.h5", only=["bare_DBE_1", "bare_MCE_1"])
        with edesign.open_archive(done.archive) as archive:
            groups.append(archive.group("records/motion_1"))
    assert len(made) == 1
    for name, variable in groups[0].variables.items():
        assert np.array_equal(variable.values, groups[1].variables[name].values), name


def test_what_differs_is_fitted_again(made: list[str]) -> None:
    time = np.arange(0.0, 10.0, 0.01)
    record = Record("motion", np.sin(6.0 * time) * np.exp(-0.3 * time), 0.01, "here")
    hazard = edesign.checked_hazard(edesign.load_project(Path("projects/thesis_10_storey/project.yaml")))
    target, options = edesign.elastic_spectrum(hazard), MatchOptions("scale", periods=(0.2, 2.0))

    def fit(one: Record, of: MatchOptions = options) -> Match | None:
        return motions.fit(one.name, Found(one, "file", one.source), target, of).match

    first = fit(record)
    assert fit(record) is first and len(made) == 1
    assert fit(replace(record, acceleration=record.acceleration * (1.0 + 1e-15))) is not first
    assert fit(record, replace(options, periods=(0.2, 2.1))) is not first
    assert fit(replace(record, name="other")) is not first
    assert len(made) == 4 and pickle.dumps(target) == pickle.dumps(edesign.elastic_spectrum(hazard))


def test_no_more_are_kept_than_there_is_room_for(made: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fitted, "KEPT", 2)
    calls = []

    def make(number: int) -> int:
        calls.append(number)
        return number

    for number in (1, 2, 1, 3, 1, 2):
        assert fitted_once(make, number) == number
    assert calls == [1, 2, 3, 2]
