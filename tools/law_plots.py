"""Draw docs/reference/laws/figures/LAW.svg: steady loops of every damper law at three amplitudes and 1 Hz.

    python tools/law_plots.py [FOLDER]

Parameters: tests/support/damper_examples.py. The same files whenever it runs.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.parameters import write_parameters
from edesign.report.drawing.style import new_figure, save, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AMPLITUDES = (0.003, 0.006, 0.010)  # m
COLOURS = ("#8a8f98", "#1f5fa8", "#c0392b")
CYCLES, SAMPLES = 4, 160  # the last cycle is drawn


@styled
def loops(name: str, parameters: Mapping[str, float]) -> Figure:
    """Force against deformation; each amplitude from rest."""
    time = np.arange(CYCLES * SAMPLES + 1) / SAMPLES
    ramp = np.minimum(time, 1.0)
    envelope, slope = ramp**3 * (10.0 - ramp * (15.0 - 6.0 * ramp)), 30.0 * (ramp * (1.0 - ramp)) ** 2
    sine, cosine = np.sin(2.0 * np.pi * time), np.cos(2.0 * np.pi * time)
    damper = Damper(LAWS[name], parameters)
    figure, ((axes,),) = new_figure(1, 1, 3.6, 3.1)
    for amplitude, colour in zip(reversed(AMPLITUDES), reversed(COLOURS), strict=True):
        u = amplitude * envelope * sine
        v = amplitude * (2.0 * np.pi * envelope * cosine + slope * sine)
        force = damper.force(time, u, v)
        last = slice(-SAMPLES - 1, None)
        axes.plot(1e3 * u[last], 1e-3 * force[last], color=colour, lw=1.1, label=f"{1e3 * amplitude:g} mm")
    axes.set_xlabel("deformation (mm)")
    axes.set_ylabel("force (kN)")
    axes.set_title(f"{name}, 1 Hz", loc="left")
    figure.legend(loc="outside lower center", ncols=3)
    return figure


def main(folder: Path) -> None:
    """Draw all laws and print the parameters behind each figure."""
    sys.path.append(str(Path(__file__).parents[1] / "tests" / "support"))
    from damper_examples import EXAMPLES

    folder.mkdir(parents=True, exist_ok=True)
    for name, law in LAWS.items():
        save(loops(name, EXAMPLES[name]), folder / f"{name}.svg")
        print(f"{name}: {', '.join(f'{key} = {text}' for key, text in write_parameters(law, EXAMPLES[name]).items())}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/reference/laws/figures"))
