"""Tests by other methods: response beside the direct one, loops, and the transfer function a method is known for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.substructure.programme import EffectiveForceTest, ShakingTableTest
from edesign.report.drawing.captions import file_name, plain
from edesign.report.substructure.bode import Path, bode_figure
from edesign.report.substructure.curves import largest
from edesign.report.substructure.response_figures import (
    Loop,
    Response,
    energy_error,
    energy_figure,
    in_window,
    loop_figure,
    response_figure,
)
from edesign.report.substructure.results import BEST, FIRST, OTHERS, Series, SubstructureResults, times
from edesign.report.substructure.tables import METHODS
from edesign.substructure.methods.effective_force import force_transfer
from edesign.substructure.methods.method_tests import forcing_of, table_of
from edesign.substructure.methods.rate import motion_frequency, steady_stiffness
from edesign.substructure.methods.shaking_table import table_transfer
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.stability.loop import Transfer
from edesign.substructure.structure.numerical import LinearPart

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Drawn = tuple[str, str, "Figure"]
LABELS = ("amplitude (–)", "phase (degrees)")
PART = 0.95
"""Of the velocity fed back: a good one that is not complete, as in docs/how_to/test_methods.md."""
LEAST = 0.01  # amplitude that is drawn
DECADE, BELOW = 10.0, 4.0
"""From the first natural frequency to the ends of a figure; of a table, below it: there it follows the command."""


def method_figures(results: SubstructureResults) -> Iterator[Drawn]:
    """Yield the figures of tests by other methods.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        group = results.driven(test)
        kind = str(group.attributes.get("kind"))
        if kind in METHODS and group.coords["time"].values.size > 1:
            yield from _histories(test, METHODS[kind], group)
            yield from _transfer(results, test, group)


def _histories(test: str, method: str, group: Group) -> Iterator[Drawn]:
    """Response, loops, and where the method has it the energy error."""
    series, time = Series(test, f"{method} test", BEST, group), times(group)
    found, force, direct, direct_force = (
        np.asarray(group.variables[name].values, dtype=float)
        for name in ("deformation", "force", "direct_deformation", "direct_force")
    )
    error = plain(100.0 * float(group.variables["response_error"].values))
    sizes = f"largest {plain(1e3 * largest([found]))} mm, direct {plain(1e3 * largest([direct]))} mm"
    row = Response("damper", time, 1e3 * direct, [(series, 1e3 * found)])
    yield (
        file_name("structure", test),
        f"Deformation of the damper in the {method} test, {test}, beside the direct analysis: {sizes}. The error of "
        f"the response is {error} %. The lowest panel is the shaded window with the largest difference.",
        response_figure([row]),
    )
    loop, wanted = Loop(time, found, force), Loop(time, direct, direct_force)
    yield (
        file_name("specimen", test),
        f"Force over deformation of the damper, and below over time, {method} test, {test}. "
        f"Largest: {plain(1e-3 * largest([force]))} kN, direct {plain(1e-3 * largest([direct_force]))} kN.",
        loop_figure([(series, loop)], wanted, "the direct analysis", in_window(loop)),
    )
    if np.any(energy_error(series)):
        yield (
            file_name("interface_energy", test),
            f"Work of the damper's force along what the actuator misses, {test}. Where it rises, the test feeds energy "
            f"into the structure. At the end: {plain(float(energy_error(series)[-1]))} J.",
            energy_figure([series]),
        )


def _transfer(results: SubstructureResults, test: str, group: Group) -> Iterator[Drawn]:
    """What arrives of a commanded force, or of a commanded motion of a table."""
    laboratory, file = results.described.laboratory, results.described.file
    if laboratory is None or laboratory.structure is None or laboratory.damper is None or file is None:
        return
    described = next((one for one in file.tests if one.name == test), None)
    if not isinstance(described, (EffectiveForceTest, ShakingTableTest)):
        return
    time = times(group)
    motion = np.asarray(group.variables["direct_deformation"].values, dtype=float)
    if not np.any(motion):
        return
    damper = SizedDamper(laboratory.damper.values, laboratory.damper.scales)
    frequency = motion_frequency(motion, float(time[1] - time[0]))
    stiffness = steady_stiffness(damper, float(np.max(np.abs(motion))), frequency)
    draw = _effective_force if isinstance(described, EffectiveForceTest) else _shaking_table
    yield draw(described, laboratory.structure.part, stiffness)  # type: ignore[arg-type]


def _effective_force(test: EffectiveForceTest, part: LinearPart, stiffness: complex) -> Drawn:
    """Force of the first mode over its command."""
    omega, shapes = part.modes(stiffness.real)
    load = part.mass @ shapes[:, 0]

    def arrives(share: float) -> Transfer:
        def transfer(s: np.ndarray) -> np.ndarray:
            forcing, frequency = replace(forcing_of(test), velocity_feedback=share), s.imag / (2.0 * np.pi)
            force, _ = force_transfer(part, forcing, frequency, stiffness)
            return np.asarray(np.einsum("i,mij,j->m", shapes[:, 0], force, load))

        return transfer

    own = test.velocity_feedback
    paths = []
    for share, text, color in (
        (0.0, "no velocity feedback", FIRST),
        (PART, f"{100.0 * PART:g} % fed back", OTHERS[0]),
        (1.0, "all fed back", BEST),
    ):
        label = f"{text} (this test)" if share == own else text
        paths.append(Path(label, arrives(share), color))
    lines = (omega / (2.0 * np.pi)).tolist()
    there = [abs(complex(path.transfer(1j * omega[:1])[0])) for path in paths]
    caption = (
        f"Force over command in the effective force test, {test.name}, of mode 1, with the velocity of the piston fed "
        f"back to the valve or not. At {plain(lines[0])} Hz, the first natural frequency, arrive "
        f"{', '.join(f'{plain(100.0 * one)} %' for one in there)} of the force. Thin upright lines are natural "
        f"frequencies with the damper, linearised at its largest deformation."
    )
    band = (lines[0] / DECADE, lines[0] * DECADE)
    return file_name("force", test.name), caption, bode_figure(paths, lines, band, LABELS, (-90.0, 90.0), LEAST)


def _shaking_table(test: ShakingTableTest, part: LinearPart, stiffness: complex) -> Drawn:
    """Displacement of the table over its command, with the structure and without."""
    table = table_of(test)
    lines = part.frequencies(stiffness.real).tolist()
    band = (lines[0] / BELOW, 2.0 * max(lines[0], table.oil_frequency))
    frequency = np.geomspace(*band, 2000)
    bare, loaded = table_transfer(table, frequency), table_transfer(table, frequency, part, stiffness)
    ratio = np.abs(loaded / bare)[frequency <= max(lines[0], table.oil_frequency)]
    most, least = int(np.argmax(ratio)), int(np.argmin(ratio))
    caption = (
        f"Displacement over command of the shaking table, {test.name}, bare and with the structure. With it the table "
        f"moves {plain(ratio[most])} times as much as bare at {plain(frequency[most])} Hz, and {plain(ratio[least])} "
        f"times at {plain(frequency[least])} Hz. Thin upright lines are natural frequencies on fixed ground, with the "
        "damper linearised at its largest deformation."
    )
    paths = [
        Path("bare table", lambda s: table_transfer(table, s.imag / (2.0 * np.pi)), OTHERS[0], "--"),
        Path("with the structure", lambda s: table_transfer(table, s.imag / (2.0 * np.pi), part, stiffness), BEST),
    ]
    shown = min(0.5, 0.8 * float(np.min(np.abs(loaded[: ratio.size]))))
    figure = bode_figure(paths, lines, band, (*LABELS, "delay (ms)"), (-270.0, 0.0), shown)
    return file_name("table", test.name), caption, figure
