"""Draw docs/results/figures/compensators.svg: amplitude and phase that each compensator leaves of a delay of 10 ms.

    python tools/compensator_figure.py [FILE.svg]

Prints the errors at some frequencies too, as docs/theory/compensators.md quotes them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.core.compensator import AdaptiveTimeSeries, Compensator, DifferenceEquation, LiveDelay, Term
from edesign.core.damper import LawValues
from edesign.core.substructure import SubstructureLoop
from edesign.report.drawing.style import new_figure, save, styled
from edesign.substructure.compensation import compensators
from edesign.substructure.rig import rigs

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DELAY, STEP = 10e-3, 1e-3  # s
HIGHEST = 10.0  # Hz
QUOTED = (1.0, 2.0, 5.0, 10.0)  # Hz
SINES = ((3e-3, 0.7, 0.1), (2e-3, 1.9, 1.0), (1e-3, 3.8, 2.0))  # m, Hz, rad: to which the adaptive ones adapt
PI = (0.5, 100.0, 8e-3, 0.5e-3)  # -, 1/s, s, s
COLOURS = ("#8a8f98", "#1f5fa8", "#d9822b", "#3aa08f", "#7b3f98", "#c0392b", "#5a5f66", "#b8860b", "#111111")
Response = Callable[[np.ndarray], np.ndarray]

ADAPTIVE = AdaptiveTimeSeries(
    initial=(1.0, 8e-3, 3e-5),
    least=(0.7, 0.0, 0.0),
    largest=(1.3, 0.04, 8e-4),
    rate=(2.0, 0.05, 1e-3),
    threshold=1e-4,
    sections=compensators.butterworth(6, 20.0, STEP),
    differences=False,
)


def ahead(equation: DifferenceEquation) -> Response:
    """Measured over target where the command does not depend on what is measured."""
    return lambda s: compensators.response(equation, STEP, s) * np.exp(-s * DELAY)


def feedback(proportional: float, integral: float, lead: float, lag: float) -> Response:
    """Measured over target of the PI controller with a phase lead."""
    equation = compensators.pi_phase_lead(proportional, integral, lead, lag, STEP)
    own = tuple(term for term in equation.terms if term.of == "command")
    seen = tuple(Term("target", term.lag, -term.coefficient) for term in equation.terms if term.of == "measured")
    back = DifferenceEquation((*seen, *own))

    def closed(s: np.ndarray) -> np.ndarray:
        # what is measured is that of a step before the command
        late, rig = np.exp(-s * STEP), np.exp(-s * DELAY)
        opened = compensators.response(equation, STEP, s) * rig
        return np.asarray(opened / (1.0 + compensators.response(back, STEP, s) * late * rig))

    return closed


def adapted(compensator: Compensator) -> np.ndarray:
    """Alphas, or the delay, in the mean of the second half of 40 s of sines."""
    time = STEP * np.arange(40001)
    motion = np.zeros((len(time), 3))
    for amplitude, frequency, phase in SINES:
        omega = 2.0 * np.pi * frequency
        for order in range(3):
            motion[:, order] += amplitude * omega**order * np.sin(omega * time + phase + 0.5 * np.pi * order)
    rig = rigs.pure_delay(DELAY).discrete(STEP / 5)
    record = SubstructureLoop(STEP, 5, compensator, rig, LawValues("kelvin_voigt", (1e6, 0.0))).run(motion)
    return np.asarray(np.mean(record.alpha[len(time) // 2 :], axis=0))


def of_differences(alpha: np.ndarray) -> DifferenceEquation:
    """alpha_0 x + alpha_1 v + alpha_2 a with velocity and acceleration as backward differences."""
    rate, second = alpha[1] / STEP, alpha[2] / STEP**2
    weights = (alpha[0] + rate + second, -rate - 2.0 * second, second)
    return DifferenceEquation(tuple(Term("target", lag, float(weight)) for lag, weight in enumerate(weights)))


def responses() -> dict[str, Response]:
    """Measured over target at complex frequencies (rad/s), by kind of compensator."""
    windowed = adapted(compensators.ats(1.0, 16, STEP, ADAPTIVE))
    alpha = adapted(compensators.modified_ats(0.996, ADAPTIVE))
    live = adapted(LiveDelay(3, 8e-3, 0.0, 0.04, 0.5, 1e-4))[0]
    print(f"alphas of ats {windowed}, of modified_ats {alpha}; delay of live_delay {live:.6f} s")
    return {
        "none, smith": ahead(compensators.none()),
        "polynomial, live_delay": ahead(compensators.polynomial(3, DELAY, STEP)),
        "polynomial, spacing: step": ahead(compensators.polynomial(3, DELAY, STEP, STEP)),
        "least_squares_polynomial": ahead(compensators.least_squares_polynomial(2, 20, DELAY, STEP)),
        "linear_acceleration": ahead(compensators.linear_acceleration(DELAY, STEP)),
        "inverse": ahead(compensators.inverse(DELAY, STEP)),
        "phase_lead": ahead(compensators.phase_lead(12e-3, 2e-3, STEP)),
        "fixed_alpha, model_feedforward": ahead(compensators.fixed_alpha((1.0, DELAY, DELAY**2 / 2), STEP)),
        "ats, modified_ats": ahead(compensators.fixed_alpha(alpha, STEP)),
        "the same, derivatives: differences": ahead(of_differences(alpha)),
        "pi_phase_lead": feedback(*PI),
    }


@styled
def drawn(found: dict[str, Response]) -> Figure:
    """Amplitude error (%) and phase error (degrees) over frequency (Hz)."""
    frequency = np.linspace(0.05, HIGHEST, 400)
    figure, ((of_amplitude, of_phase),) = new_figure(1, 2, 7.2, 3.9)
    for i, (name, response) in enumerate(found.items()):
        total = response(2j * np.pi * frequency)
        style = {"color": COLOURS[i % len(COLOURS)], "ls": "-" if i < len(COLOURS) else "--", "label": name}
        of_amplitude.plot(frequency, 100.0 * (np.abs(total) - 1.0), **style)
        of_phase.plot(frequency, np.degrees(np.unwrap(np.angle(total))), **style)
    of_amplitude.set(xlabel="frequency (Hz)", ylabel="error of the amplitude (%)", ylim=(-10.0, 30.0))
    of_phase.set(xlabel="frequency (Hz)", ylabel="error of the phase (degrees; below 0: late)", ylim=(-20.0, 5.0))
    for axes in (of_amplitude, of_phase):
        axes.set_xlim(0.0, HIGHEST)
    handles, labels = of_amplitude.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    return figure


def main(path: Path) -> None:
    """Draw the figure and print the errors."""
    found = responses()
    for name, response in found.items():
        total = response(2j * np.pi * np.array(QUOTED))
        pairs = zip(np.abs(total), np.angle(total, deg=True), strict=True)
        print(f"{name:32}", "  ".join(f"{100 * (a - 1):+8.3f} % {p:+8.3f} deg" for a, p in pairs))
    save(drawn(found), path)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/results/figures/compensators.svg"))
