"""The loop of substructure tests as a block diagram with the numbers of the user's file."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.project.dampers.dampers import DamperLaw
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ShearBuilding
from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import MEAN, new_figure, styled
from edesign.report.substructure.advice_tables import specimen_in_words
from edesign.report.substructure.file import ArchivedTests
from edesign.report.substructure.linearised import LinearisedTests
from edesign.report.substructure.results import SubstructureResults
from edesign.substructure.laboratory import rig_transfer

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Lines = tuple[str, ...]
WIDE = 148.0  # of the drawing, 20 to an inch
BOX = 29.0  # width of a block
LEFTS = (1.0, 40.0, 79.0, 118.0)  # of the blocks
BOTTOM = 22.0  # of the blocks
LINE = 2.9  # height of a line of a block
HEAD = 9.5  # height of its title with what is above and below
CHARACTERS = 22  # in a line of a block
MOST_LINES = 10
COMPUTER, RIG = "#eef3fa", "#fbf3e8"
"""What is computed, and what stands in the laboratory."""


def loop_diagrams(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield the diagram of the loop; none if the file cannot be read.

    Yields:
        Name of the file, caption and figure.
    """
    described = results.described
    if described.file is not None:
        given = "" if described.file.structure is not None else " Targets are given, and the force acts on nothing."
        yield (
            "loop",
            "The loop of the tests. Blue blocks are computed each main step, ochre ones are the virtual laboratory. "
            f"The numbers are those of the file of tests.{given}",
            loop_diagram(described, results.linearised),
        )


@styled
def loop_diagram(described: ArchivedTests, linear: LinearisedTests | None) -> Figure:
    """Draw numerical part, compensator, rig and specimen in a ring, and the sensors below.

    Args:
        linear: specimen, rig and structure linearised; None: not known.
    """
    from matplotlib.patches import FancyBboxPatch

    file = described.file
    assert file is not None
    blocks = (
        (_source(file), _wrapped(_numerical(described, linear)), COMPUTER),
        ("Compensator", _wrapped(_compensators(file)), COMPUTER),
        ("Rig", _wrapped(_rig(described, linear)), RIG),
        ("Specimen", _wrapped(_specimen(described, linear)), RIG),
    )
    top = BOTTOM + max(HEAD + LINE * max(len(lines) for _, lines, _ in blocks), 24.0)
    tall = top + 6.0
    low = 0.0 if file.structure is not None else 9.0  # no force goes back below
    figure, ((axis,),) = new_figure(1, 1, WIDE / 20.0, (tall - low) / 20.0)
    axis.set_axis_off()
    axis.set_xlim(0.0, WIDE)
    axis.set_ylim(low, tall)
    for left, (title, lines, color) in zip(LEFTS, blocks, strict=True):
        axis.add_patch(
            FancyBboxPatch(
                (left, BOTTOM), BOX, top - BOTTOM, boxstyle="round,pad=0,rounding_size=1.5", fc=color, ec=MEAN, lw=0.7
            )
        )
        _text(axis, left + 1.6, top - 2.0, title, lines)
    loop = file.loop
    middle = 0.5 * (top + BOTTOM)
    unseen = (f"{loop.unseen_delay} step{'s' * (loop.unseen_delay > 1)}", "unseen") if loop.unseen_delay else ()
    _arrow(axis, (LEFTS[0] + BOX, middle), (LEFTS[1], middle), ("target", "xₜ"), unseen)
    _arrow(axis, (LEFTS[1] + BOX, middle), (LEFTS[2], middle), ("command", "u"))
    _arrow(axis, (LEFTS[2] + BOX, middle), (LEFTS[3], middle), ("moves", "x"))
    steps = ((LEFTS[0], "computer, main step", loop.main_step), (LEFTS[2], "laboratory, step", file.sub_step))
    for left, what, step in steps:
        axis.text(left, top + 1.2, f"{what} {1e3 * step:.4g} ms", fontsize=7.0, va="bottom")
    encoder, cell = _sensors(described)
    down, back = LEFTS[3] + 8.0, LEFTS[1] + 13.0
    _path(axis, [(down, BOTTOM), (down, 13.0), (back, 13.0), (back, BOTTOM)])
    _label(axis, (0.5 * (down + back), 13.0), f"measured displacement xₘ, encoder {encoder}")
    if file.structure is not None:
        down, back = LEFTS[3] + 20.0, LEFTS[0] + 13.0
        _path(axis, [(down, BOTTOM), (down, 4.0), (back, 4.0), (back, BOTTOM)])
        _label(axis, (0.5 * (down + back), 4.0), f"force F, load cell {cell}, {loop.force} over the step")
    return figure


def _text(axis: Axes, x: float, y: float, title: str, lines: Lines) -> None:
    axis.text(x, y, title, fontsize=8.5, fontweight="bold", va="top")
    axis.text(x, y - 5.0, "\n".join(lines), fontsize=7.0, va="top", linespacing=1.25)


def _wrapped(lines: Lines) -> Lines:
    wrapped = [part for line in lines for part in textwrap.wrap(line, CHARACTERS, subsequent_indent="  ")]
    return tuple(wrapped if len(wrapped) <= MOST_LINES else [*wrapped[: MOST_LINES - 1], "…"])


def _arrow(
    axis: Axes, start: tuple[float, float], end: tuple[float, float], above: Sequence[str], below: Sequence[str] = ()
) -> None:
    axis.annotate(
        "", end, start, arrowprops={"arrowstyle": "-|>", "lw": 0.9, "color": MEAN, "shrinkA": 0, "shrinkB": 0}
    )
    middle = 0.5 * (start[0] + end[0])
    axis.text(middle, start[1] + 1.2, "\n".join(above), fontsize=6.0, ha="center", va="bottom")
    axis.text(middle, start[1] - 1.2, "\n".join(below), fontsize=6.0, ha="center", va="top")


def _path(axis: Axes, points: Sequence[tuple[float, float]]) -> None:
    """A line with an arrow at its end."""
    axis.plot([x for x, _ in points[:-1]], [y for _, y in points[:-1]], color=MEAN, lw=0.9, solid_joinstyle="miter")
    head = {"arrowstyle": "-|>", "lw": 0.9, "color": MEAN, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", points[-1], points[-2], arrowprops=head)


def _label(axis: Axes, place: tuple[float, float], text: str) -> None:
    axis.text(*place, text, fontsize=7.0, ha="center", va="center", bbox={"fc": "white", "ec": "none", "pad": 1.5})


def _source(file: RtsFile) -> str:
    return "Numerical part" if file.structure is not None else "Given targets"


def _numerical(described: ArchivedTests, linear: LinearisedTests | None) -> Lines:
    file = described.file
    assert file is not None
    if file.structure is None:
        return tuple(test.name for test in file.tests)
    lines = []
    lab = described.laboratory
    if lab is not None and lab.structure is not None:
        part = lab.structure.part
        count = len(part.names)
        lines += [f"{count} degree{'s' * (count > 1)} of freedom"]
        lines.append(f"alone {_hertz(part.frequencies())}")
        if linear is not None:
            lines.append(f"with specimen {_hertz(linear.frequencies)}")
    elif isinstance(file.structure, ShearBuilding):
        lines += [f"{len(file.structure.masses)} storeys", f"specimen in storey {file.structure.storey}"]
    if file.may_yield:
        return (*lines, "may yield")
    method = file.integration.method.replace("_", " ")
    return (*lines, "exact integration" if method == "exact" else f"by {method}")


def _hertz(frequencies: Sequence[float] | np.ndarray) -> str:
    more = " …" if len(frequencies) > 3 else ""
    return f"{', '.join(plain(float(one)) for one in frequencies[:3])}{more} Hz"


def kind_words(kind: str) -> str:
    """Return the words for the kind of a compensator, plant or integration, as the file of tests names it.

    Args:
        kind: of the file, such as `modified_ats`.
    """
    return re.sub(r"\bats\b", "adaptive time series (ATS)", kind.replace("_", " "))


def _compensators(file: RtsFile) -> Lines:
    names = [name if name == one.kind else f"{name}: {kind_words(one.kind)}" for name, one in file.compensators.items()]
    return (*names[:MOST_LINES], f"and {len(names) - MOST_LINES} more") if len(names) > MOST_LINES + 1 else tuple(names)


def _rig(described: ArchivedTests, linear: LinearisedTests | None) -> Lines:
    plant = described.plant
    if plant is None:
        return ("not held by the archive",)
    lines = [plant.kind.replace("_", " ")]
    for key, factor, unit in (
        ("frequency", 1.0, " Hz"),
        ("damping", 1.0, ""),
        ("time_constant", 1e3, " ms"),
        ("proportional_gain", 1.0, " /s"),
        ("valve_time_constant", 1e3, " ms"),
        ("delay", 1e3, " ms"),
        ("gain", 1.0, ""),
    ):
        value = getattr(plant, key, None)
        if value:
            lines.append(f"{key.replace('_', ' ').replace('proportional ', '')} {factor * value:.4g}{unit}")
    if linear is not None and plant.kind not in ("ideal", "delay"):
        at = plain(linear.frequencies[0])
        lines.append(f"late in all {plain(1e3 * linear.rig_delay)} ms at {at} Hz")
    elif described.transfer is not None and plant.kind not in ("ideal", "delay"):
        alone = rig_transfer(plant, 0.0)
        lines.append(f"late in all {plain(1e3 * alone.low_frequency_delay)} ms, unloaded")
    limits = plant.limits
    reach = [
        f"{factor * value:.4g} {unit}"
        for value, factor, unit in (
            (limits.stroke, 1e3, "mm"),
            (limits.velocity, 1e3, "mm/s"),
            (limits.force, 1e-3, "kN"),
        )
        if value is not None
    ]
    return (*lines, *([f"reaches {', '.join(reach)}"] if reach else []))


def _specimen(described: ArchivedTests, linear: LinearisedTests | None) -> Lines:
    file = described.file
    assert file is not None
    placed = file.law
    if placed is None:
        return ("none",)
    name = f"{file.specimen.law}: " if isinstance(file.specimen.law, str) else ""
    lines = [f"{name}{_law(placed.law)}"]
    if placed.law.temperature is not None:
        lines.append(f"at {placed.law.temperature:g} °C")
    lines += [f"effect {effect.name}" for effect in file.specimen.effects]
    if linear is not None:
        at = linear.specimen
        lines.append(f"{specimen_in_words(at)} at {plain(1e3 * at.amplitude)} mm")
    return tuple(lines)


def _law(law: DamperLaw) -> str:
    return f"law of {Path(law.file).name}" if law.file is not None else (law.type or "").replace("_", " ")


def _sensors(described: ArchivedTests) -> tuple[str, str]:
    """Encoder and load cell in words."""
    file = described.file
    assert file is not None
    sensors = file.sensors
    bits = [f"{sensors.bits} bits"] if sensors.bits is not None else []
    noise = file.encoder_noise if described.plant is not None else sensors.encoder_noise or 0.0
    encoder = [f"with noise of {1e6 * noise:.4g} µm"] if noise else []
    cell = [f"with noise of {sensors.force_noise:.4g} N"] if sensors.force_noise else []
    cell += [f"late {plain(1e3 * sensors.force_delay)} ms"] if sensors.force_delay else []
    return tuple(f"{', '.join([*said, *bits]) or 'without noise'}" for said in (encoder, cell))  # type: ignore[return-value]
