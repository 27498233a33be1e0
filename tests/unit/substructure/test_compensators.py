"""Delay compensators against what they are exact for, and their exported form against the loop, bit by bit."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
import scipy.signal
from edesign.core._edcore import ffi

from edesign.core.compensator import (
    AdaptiveTimeSeries,
    Compensator,
    DifferenceEquation,
    LiveDelay,
    Term,
    compensator_parameters,
    run_compensator,
)
from edesign.core.damper import LawValues
from edesign.core.substructure import Recursion, SubstructureLoop
from edesign.errors import InputError
from edesign.substructure.compensation import compensators
from edesign.substructure.rig import rigs

STEP = 1e-3  # s
ADAPTIVE = AdaptiveTimeSeries(
    initial=(1.0, 0.01, 6e-5),
    least=(0.7, 0.0, 0.0),
    largest=(1.3, 0.04, 8e-4),
    rate=(2.0, 0.05, 1e-3),
    threshold=1e-4,
    sections=compensators.butterworth(6, 20.0, STEP),
    differences=False,
)


def polynomial_motion(order: int, n: int = 60) -> np.ndarray:
    """Displacement, velocity, acceleration (n, 3) of a polynomial of time, one sample a step."""
    t = STEP * np.arange(n)
    u = np.polynomial.Polynomial([1.0, 3.0, -40.0, 900.0][: order + 1])
    return np.column_stack([u(t), u.deriv(1)(t), u.deriv(2)(t)])


def sines(n: int = 20000) -> np.ndarray:
    """Displacement, velocity, acceleration (n, 3) of a motion of several frequencies up to 4 Hz."""
    t = STEP * np.arange(n)
    parts = [(3e-3, 0.7, 0.1), (2e-3, 1.9, 1.0), (1e-3, 3.8, 2.0)]
    u = sum(a * np.sin(2 * pi * f * t + p) for a, f, p in parts)
    v = sum(a * 2 * pi * f * np.cos(2 * pi * f * t + p) for a, f, p in parts)
    acceleration = sum(-a * (2 * pi * f) ** 2 * np.sin(2 * pi * f * t + p) for a, f, p in parts)
    return np.column_stack([u, v, acceleration])


def test_cubic_has_the_binomial_coefficients() -> None:
    """Horiuchi et al. (1999): 4, -6, 4, -1 a delay apart."""
    found = compensators.polynomial(3, 7 * STEP, STEP)
    assert [(term.lag, pytest.approx(term.coefficient)) for term in found.terms] == [
        (0, 4.0),
        (7, -6.0),
        (14, 4.0),
        (21, -1.0),
    ]


@pytest.mark.parametrize("delay", [7e-3, 10.3e-3])
@pytest.mark.parametrize(
    ("make", "order"),
    [
        (lambda d: compensators.polynomial(3, d, STEP), 3),
        (lambda d: compensators.polynomial(2, d, STEP), 2),
        (lambda d: compensators.polynomial(3, d, STEP, spacing=STEP), 3),
        (lambda d: compensators.least_squares_polynomial(2, 12, d, STEP), 2),
        (lambda d: compensators.linear_acceleration(d, STEP), 3),
        (lambda d: compensators.fixed_alpha((1.0, d, d**2 / 2), STEP), 2),
        (lambda d: compensators.fixed_alpha((1.0, d, d**2 / 2, d**3 / 6), STEP), 3),
        (lambda d: compensators.inverse(d, STEP), 1),
    ],
)
def test_extrapolation_is_exact_for_its_polynomials(make: object, order: int, delay: float) -> None:
    """The command at t is the target at t + delay; only rounding of sums of some ten is left."""
    motion = polynomial_motion(order)
    ahead = np.polynomial.Polynomial([1.0, 3.0, -40.0, 900.0][: order + 1])(STEP * np.arange(len(motion)) + delay)
    command = run_compensator(make(delay), STEP, motion, np.zeros(len(motion)))  # type: ignore[operator]
    assert command[40:] == pytest.approx(ahead[40:], rel=1e-11)


def test_phase_lead_by_its_frequency_response() -> None:
    """(0.02 s + 1) / (0.004 s + 1) at 2 Hz; the bilinear rule warps it by (omega step)^2 / 12."""
    equation = compensators.phase_lead(0.02, 0.004, STEP)
    s = np.array([2j * pi * 2.0])
    exact = (0.02 * s + 1.0) / (0.004 * s + 1.0)
    assert compensators.response(equation, STEP, s) == pytest.approx(exact, rel=2e-4)
    t = STEP * np.arange(4000)
    motion = np.column_stack([np.sin(4.0 * pi * t), 0.0 * t, 0.0 * t])
    command = run_compensator(equation, STEP, motion, 0.0 * t)
    steady = np.abs(exact) * np.sin(4.0 * pi * t + np.angle(exact))
    assert np.max(np.abs(command - steady)[1000:]) < 1e-3


@pytest.mark.parametrize("forgetting", [0.996, 1.0, None])
def test_adaptive_time_series_finds_a_pure_delay(forgetting: float | None) -> None:
    """With the rig x = 0.99 u(t - d): alpha = 1/A, d/A, d^2/2A (thesis Eq. 6.10), within the next term of the series.

    The third derivative, at 3.8 Hz at most, is what is left out: omega d^3 / 6 of alpha_1 is 0.1 ms, and differences of
    measured displacements come half a step late, 5e-6 s2 in alpha_2.
    """
    delay, gain = 10.3e-3, 0.99
    if forgetting is None:
        compensator = compensators.ats(1.0, 16, STEP, ADAPTIVE)
    else:
        compensator = compensators.modified_ats(forgetting, ADAPTIVE)
    loop = SubstructureLoop(
        STEP, 5, compensator, rigs.pure_delay(delay, gain).discrete(STEP / 5), LawValues("kelvin_voigt", (1e6, 0.0))
    )
    found = loop.run(sines())
    alpha = np.mean(found.alpha[5000:], axis=0)
    assert alpha[0] == pytest.approx(1.0 / gain, abs=2e-3)
    assert alpha[1] == pytest.approx(delay / gain, abs=2e-4)
    assert alpha[2] == pytest.approx(delay**2 / 2.0 / gain, abs=1.5e-5)
    assert np.all((found.independence[5000:] > 0.0) & (found.independence[5000:] < 1.0))


def test_alphas_wait_keep_their_limits_and_their_rates() -> None:
    """Thesis 6.2.4: initial values until 0.1 mm is exceeded, then changes of at most the rate, within the limits."""
    slow = replace(ADAPTIVE, largest=(1.3, 0.011, 8e-4), rate=(2.0, 0.001, 1e-3))
    compensator = compensators.modified_ats(0.996, slow)
    rig = rigs.pure_delay(20e-3).discrete(STEP / 5)
    found = SubstructureLoop(STEP, 5, compensator, rig, LawValues("kelvin_voigt", (1e6, 0.0))).run(sines(4000))
    first = int(np.argmax(np.abs(found.measured) > 1e-4))
    assert first > 10
    assert np.all(found.alpha[: first + 1] == [1.0, 0.01, 6e-5])
    changes = np.abs(np.diff(found.alpha, axis=0))
    assert np.max(changes[:, 1]) == pytest.approx(0.001 * STEP, rel=1e-9)
    assert found.alpha[-1, 1] == 0.011
    assert found.limited[-1] & 2


@pytest.mark.parametrize("start", [2e-3, 12.4e-3, 25e-3])
def test_live_delay_follows_zero_crossings(start: float) -> None:
    """The delay of the rig from any start; crossings between samples err by the curvature of a sine, some us."""
    compensator = LiveDelay(order=3, delay=start, least=0.0, largest=0.05, share=0.5, threshold=1e-4)
    motion = np.zeros((8000, 3))
    motion[:, 0] = 5e-3 * np.sin(2 * pi * 2.0 * STEP * np.arange(8000))
    rig = rigs.pure_delay(12.4e-3).discrete(STEP / 5)
    found = SubstructureLoop(STEP, 5, compensator, rig, LawValues("kelvin_voigt", (1e6, 0.0))).run(motion)
    assert found.alpha[-1, 0] == pytest.approx(12.4e-3, abs=0.1e-3)
    assert found.measured[4000:] == pytest.approx(found.target[4000:], abs=1e-5)


def test_smith_predictor_makes_the_loop_the_ideal_one() -> None:
    """With a true model of rig (7 ms) and specimen (a spring) the structure moves as without delay."""
    stiffness, mass = 2e6, 2e4
    h, r = STEP, 3e6 / mass
    step = np.array([[1.0 - h * h * r, h], [-h * r, 1.0]])
    force = np.outer([-h * h, -h], [1.0 / mass, 0.0, 1.0, 0.0])
    zero, none = np.zeros((1, 2)), np.zeros((1, 4))
    numerical = Recursion(step, force, np.vstack([step[0], step[1], zero[0]]), np.vstack([force[0], force[1], none[0]]))
    ground = 0.5 * np.sin(2 * pi * 1.5 * STEP * np.arange(3000))
    runs = [
        SubstructureLoop(
            STEP,
            5,
            compensator,
            rig.discrete(STEP / 5),
            LawValues("kelvin_voigt", (stiffness, 0.0)),
            numerical=numerical,
        ).run(ground)
        for compensator, rig in (
            (compensators.none(), rigs.ideal()),
            (compensators.smith(7e-3, 1.0, stiffness, 0.0, STEP), rigs.pure_delay(7e-3)),
        )
    ]
    assert runs[1].target == pytest.approx(runs[0].target, abs=1e-9 * np.max(np.abs(runs[0].target)))


def test_nodes_beyond_the_memory_are_refused() -> None:
    with pytest.raises(InputError, match="1500 main steps.*E-RTS-04"):
        compensators.polynomial(3, 0.5, STEP)
    with pytest.raises(InputError, match=r"0\.0005 s.*E-RTS-04"):
        compensators.polynomial(3, 0.5e-3, STEP)


ALL: dict[str, Compensator] = {
    "none": compensators.none(),
    "cubic": compensators.polynomial(3, 10.2e-3, STEP),
    "lead": compensators.phase_lead(0.02, 0.004, STEP),
    "proportional": DifferenceEquation((Term("target", 0, 1.2), Term("measured", 0, -0.2))),
    "live": LiveDelay(3, 8e-3, 0.0, 0.05, 0.3, 1e-4),
    "ats": compensators.ats(0.5, 16, STEP, ADAPTIVE),
    "modified": compensators.modified_ats(0.996, replace(ADAPTIVE, differences=True)),
}

PROGRAM = """
#include "edcompensator.h"
#include <stdio.h>
static ed_compensator_parameters p;
static ed_compensator s;
int main(int argc, char **argv)
{
  double in[4], u;
  (void)argc;
  FILE *f = fopen(argv[1], "rb"), *out = fopen(argv[2], "wb");
  if (!f || !out || fread(&p, sizeof p, 1, f) != 1) return 1;
  ed_compensator_start(&p, &s);
  while (fread(in, sizeof in, 1, f) == 1) {
    u = ed_compensator_step(&p, &s, in[0], in[1], in[2], in[3]);
    fwrite(&u, sizeof u, 1, out);
  }
  fclose(out);
  return 0;
}
"""


@pytest.fixture(scope="module")
def standalone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A program of the exported header alone, compiled as strict C99."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    folder = tmp_path_factory.mktemp("exported")
    (folder / "main.c").write_text(PROGRAM, encoding="utf-8")
    header = Path(__file__).parents[3] / "core_c" / "include"
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-ffp-contract=off", f"-I{header}"]
    command = [compiler, *flags, "-o", str(folder / "main"), str(folder / "main.c"), "-lm"]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return folder / "main"


@pytest.mark.parametrize("name", ALL)
def test_exported_compensator_does_what_the_virtual_test_ran(name: str, standalone: Path, tmp_path: Path) -> None:
    """The same commands to the last bit, from the header alone and from the record of a loop."""
    rig = rigs.second_order(21.4, 0.4, 4.3e-3).discrete(STEP / 5)
    record = SubstructureLoop(STEP, 5, ALL[name], rig, LawValues("kelvin_voigt", (1e6, 1e4))).run(sines(3000))
    target = np.column_stack([record.target, record.target_velocity, record.target_acceleration])[1:]
    measured = record.measured[:-1]
    alone = run_compensator(ALL[name], STEP, target, measured)
    assert np.array_equal(alone, record.command[1:])
    parameters = bytes(ffi.buffer(compensator_parameters(ALL[name], STEP)))
    (tmp_path / "in").write_bytes(parameters + np.column_stack([target, measured]).tobytes())
    subprocess.run([str(standalone), str(tmp_path / "in"), str(tmp_path / "out")], check=True)
    assert np.array_equal(np.fromfile(tmp_path / "out"), alone)


def test_alphas_of_equal_weights_are_those_of_least_squares() -> None:
    """Forgetting 1 keeps all samples: numpy's least squares over the whole record gives the same alphas."""
    free = AdaptiveTimeSeries(
        (1.0, 0.01, 5e-5), (-9.0,) * 3, (9.0,) * 3, (1e9,) * 3, 0.0, np.zeros((0, 5)), False, forgetting=1.0
    )
    rig = rigs.pure_delay(9e-3).discrete(STEP / 5)
    found = SubstructureLoop(STEP, 5, free, rig, LawValues("kelvin_voigt", (1e6, 0.0))).run(sines(3000))
    x = found.measured[:-1]
    v = np.diff(x, prepend=0.0) / STEP
    a = np.diff(v, prepend=0.0) / STEP
    u = np.concatenate([[0.0], found.command[1:-1]])
    expected = np.linalg.lstsq(np.column_stack([x, v, a]), u, rcond=None)[0]
    # normal equations of signals of sizes 1 : 20 : 400 lose the square of their condition, some 1e3, of sixteen digits
    assert found.alpha[-1] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("order", [2, 4, 6, 8])
@pytest.mark.parametrize("cutoff", [5.0, 20.0, 490.0])
def test_the_filter_is_that_of_scipy(order: int, cutoff: float) -> None:
    """The same transfer function, whose rounding grows with the order to some 1e-12; gains of its sections differ."""
    found = np.insert(compensators.butterworth(order, cutoff, STEP), 3, 1.0, axis=1)
    frequencies = np.linspace(0.0, 0.99 / STEP / 2.0, 50)
    of_ours, of_scipy = (
        scipy.signal.sosfreqz(sections, frequencies, fs=1.0 / STEP)[1]
        for sections in (found, scipy.signal.butter(order, cutoff, fs=1.0 / STEP, output="sos"))
    )
    assert of_ours == pytest.approx(of_scipy, rel=1e-10, abs=1e-14)


def test_the_controller_is_by_the_bilinear_rule_of_scipy() -> None:
    """Coefficients of the target: those of (p + i/s) behind those of the lead."""
    found = compensators.pi_phase_lead(2.0, 95.0, 5.93e-3, 0.5e-3, STEP)
    controller, _ = scipy.signal.bilinear([2.0, 95.0], [1.0, 0.0], fs=1.0 / STEP)
    ahead, _ = scipy.signal.bilinear([5.93e-3, 1.0], [0.5e-3, 1.0], fs=1.0 / STEP)
    of_target = [term.coefficient for term in found.terms if term.of == "target"]
    assert of_target == pytest.approx(np.convolve(controller, ahead).tolist(), rel=1e-12)
