"""Fits that are interrupted, laws at temperatures other than that of their tests, and what figures show."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.damper.damper import Damper
from edesign.damper.fitting import fit_forces
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaT, at
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.signals import random, sine, sweep_4_4
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError
from edesign.report.damper.fit_figures import fit_figure
from edesign.report.damper.measured_figures import measured_figure as draw_test
from edesign.stopping import in_threads

MGMM = LAWS["mgmm"]
TABLE_4_2 = read_parameters(MGMM, "thesis_table_4_2")
SPECIMEN = Specimen("p", 2, 0.0414, 0.012)


def test_other_threads_stop_with_an_interrupted_fit() -> None:
    stop, at_work = threading.Event(), threading.Event()
    ended = []

    def work(item: int) -> None:
        if item == 0:
            assert at_work.wait(5.0)
            raise KeyboardInterrupt
        at_work.set()
        ended.append(stop.wait(5.0))

    with pytest.raises(KeyboardInterrupt):
        list(in_threads(work, range(2), 2, stop))
    assert ended == [True]


def test_a_search_in_a_thread_ends_when_the_fit_is_interrupted() -> None:
    """Without the event the pool waits for whole descents: 15 s for a large campaign."""
    t, u = sweep_4_4(0.006, 1.0, sampling_rate=100.0)
    force = Damper(MGMM, TABLE_4_2).force(t, u)
    tests = [DamperTest("a", t, u, force)]
    main = threading.get_ident()
    calls = {"other": 0, "after": 0}
    raised = threading.Event()

    def predict(values: dict[str, float], loading: object) -> np.ndarray:
        if threading.get_ident() != main:
            calls["after" if raised.is_set() else "other"] += 1
            if calls["other"] == 150:  # in the middle of the descents
                raised.set()
                raise KeyboardInterrupt
            time.sleep(0.0005)
        return Damper(MGMM, values).force(loading.time, loading.displacement, loading.velocity)  # type: ignore[attr-defined]

    with pytest.raises(KeyboardInterrupt):
        fit_forces(MGMM, tests, predict=predict, workers=2, starts=4)
    assert calls["other"] >= 150
    assert calls["after"] <= 10  # a Jacobian alone has nine


@pytest.mark.parametrize("reference", [20.0, 25.0, 31.0])
def test_parameters_of_another_temperature_are_shifted_from_there(reference: float) -> None:
    """Shifting from 20 degC to the reference and on is shifting all the way: gamma_T(T) / gamma_T(reference)."""
    there = at(MGMM, TABLE_4_2, reference, GammaT())[0]
    assert at(MGMM, there, 35.0, None, reference)[0] == pytest.approx(at(MGMM, TABLE_4_2, 35.0, GammaT())[0], rel=1e-12)
    assert at(MGMM, there, reference, None, reference) == (there, ())


def test_a_law_fitted_at_25_degC_is_not_softened_again_at_25_degC(tmp_path: Path) -> None:
    text = """type: mgmm
parameters: thesis_table_4_2
tested: {shear_strain: 10 to 50 %, frequency: 0.25 to 4 Hz, temperature: RANGE}
"""
    path = tmp_path / "law.yaml"
    path.write_text(text.replace("RANGE", "25 degC"))
    found = resolve(*read_law_file(path), 25.0)
    values, warnings = found.values, found.warnings
    assert values == TABLE_4_2 and warnings == ()
    found = resolve(*read_law_file(path), 30.0)
    values, warnings = found.values, found.warnings
    assert values["k_b"] == pytest.approx(TABLE_4_2["k_b"] * 0.875 / 0.935, rel=1e-12)  # Table 4.4
    assert any("it was tested at 25 degC and is used at 30 degC" in warning for warning in warnings)
    path.write_text(text.replace("RANGE", "22 to 28 degC"))  # one set for all of them
    assert resolve(*read_law_file(path), 27.0).values == TABLE_4_2


def test_far_outside_the_range_the_message_names_all_of_it() -> None:
    with pytest.raises(InputError, match="from 20 to 35 degC.*E-LAW-04"):
        GammaT().gamma(400.0)


def test_a_hold_that_limits_the_fit_is_reported() -> None:
    """Fixed at the 0.19 kN s/mm of Table 4.2, c_b gives more damping than a device has that is made with none."""
    t, u = random(6.0, (0.2, 4.0), 1, peak=0.006, sampling_rate=100.0)
    soft = TABLE_4_2 | {"c1": 1e3, "c_b": 0.0, "c_a": 0.0, "c_NL": 0.0, "k0": 0.0}
    test = DamperTest("a", t, u, Damper(MGMM, soft).force(t, u))
    fixed = {name: soft[name] for name in ("k_a", "k_b", "u_ref", "c_a", "v_ref", "alpha", "c_NL")}
    fit = fit_forces(MGMM, [test], soft | {"c_b": TABLE_4_2["c_b"]}, fixed=fixed, starts=1)
    assert "c1" in fit.at_bound
    assert any(warning.startswith("c1 is left with nothing beside c_b") for warning in fit.warnings)


def _loops(test: DamperTest) -> list[str]:
    axes = draw_test(test, SPECIMEN).axes
    return [str(line.get_label()) for line in axes[-1].get_lines() if not str(line.get_label()).startswith("_")]


def test_only_steady_cycles_are_drawn_heavier() -> None:
    steady = DamperTest("s", *sine(0.006, 1.0, 5, sampling_rate=100.0))
    chance = DamperTest("r", *random(10.0, (0.2, 4.0), 3, peak=0.006, sampling_rate=100.0))
    assert _loops(replace(steady, force=steady.displacement * 1e6)) == ["cycle 5 of 5"]
    assert _loops(replace(chance, force=chance.displacement * 1e6)) == []


def test_the_legend_of_a_fit_lies_beside_the_curves() -> None:
    t, u = sine(0.006, 1.0, 5, sampling_rate=100.0)
    test = DamperTest("s", t, u, 7e6 * u)
    figure = fit_figure(test, 7.1e6 * u, "zener", "zener: s, 20 °C, NRMS 0.02 %")
    assert all(axis.get_legend() is None for axis in figure.axes)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["measured", "zener", "zener − measured"]
    figure.canvas.draw()
    box = figure.legends[0].get_window_extent()
    assert not any(box.overlaps(axis.get_window_extent()) for axis in figure.axes)
