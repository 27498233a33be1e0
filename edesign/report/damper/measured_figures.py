"""Figures of damper tests: histories and loops of each, and properties over frequency."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.files import make_folder
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.cycles import find_blocks
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.testing.specimen import Specimen
from edesign.errors import ArchiveError
from edesign.optional_stages import optional
from edesign.report.drawing.captions import UniqueNames, file_name
from edesign.report.drawing.style import (
    AFTER,
    BEFORE,
    align_ordinates,
    legend_below,
    logarithmic,
    new_figure,
    save,
    styled,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MARKS = "osv^Dphd*X"
STEADY = 3  # cycles of one amplitude
MANY = 40  # cycles; more are drawn thinner


def draw_tests(
    campaign: Campaign, table: PropertyTable | None, folder: Path, figure_format: str = "svg"
) -> tuple[Path, ...]:
    """Draw every test of a campaign, and its properties over frequency at each temperature.

    Args:
        table: their properties, None if there are none.
        folder: where the files go; made if it does not exist.
        figure_format: svg, png or pdf.

    Returns:
        The files, TEST and properties_TEMPERATUREC with their suffix.

    Raises:
        ArchiveError: a figure cannot be written.
    """
    make_folder(folder)
    written = []
    unique = UniqueNames()
    for test in campaign.tests:
        path = folder / f"{unique(file_name(test.name.replace('/', '_')))}.{figure_format}"
        with optional(f"the figure {path.name}", passing=(ArchiveError,)):
            save(measured_figure(test, campaign.specimen), path)
            written.append(path)
    for celsius in table.levels[0] if table is not None else ():
        path = folder / f"properties_{celsius:.3g}C.{figure_format}"
        with optional(f"the figure {path.name}", passing=(ArchiveError,)):
            assert table is not None
            save(properties_figure(table, float(celsius)), path)
            written.append(path)
    return tuple(written)


@styled
def measured_figure(test: DamperTest, specimen: Specimen | None) -> Figure:
    """Draw displacement and force over time, and the loops of stress and strain, as Figs. 3.7 and 4.2 of the thesis.

    Of a device without layers the loops are those of force and displacement.

    The last full cycle of the longest block of one amplitude is drawn heavier; not of fewer than three, which agree by
    chance in a random history.

    Args:
        specimen: the layers that were tested; None: a device without layers.
    """
    figure, axes = new_figure(2, 2, 7.6, 3.6)
    force = test.measured_force()
    across, along = 1e3 * test.displacement, 1e-3 * force
    names = "displacement (mm)", "force (kN)"
    if specimen is not None:
        across, along = 100.0 * specimen.strain(test.displacement), 1e-6 * specimen.stress(force)
        names = "shear strain (%)", "shear stress (MPa)"
    for axis, values, label, colour in (
        (axes[0][0], 1e3 * test.displacement, "displacement (mm)", BEFORE),
        (axes[1][0], 1e-3 * force, "force (kN)", AFTER),
    ):
        axis.plot(test.time, values, color=colour, lw=0.6)
        axis.set_ylabel(label)
        axis.set_xlim(float(test.time[0]), float(test.time[-1]))
    axes[0][0].tick_params(labelbottom=False)
    axes[1][0].set_xlabel("time (s)")
    grid = axes[0][1].get_gridspec()
    assert grid is not None
    for row in axes:
        row[1].remove()
    right = figure.add_subplot(grid[:, 1], axes_class=type(axes[0][0]))
    blocks = find_blocks(test.time, test.displacement)
    cycles = sum(block.cycles for block in blocks)
    right.plot(across, along, color=BEFORE, lw=0.4 if cycles < MANY else 0.2)
    longest = max(blocks, key=lambda block: block.cycles, default=None)
    if longest is not None and longest.cycles >= STEADY:
        first, last = np.searchsorted(test.time, longest.bounds[-2:])
        part = slice(first, last + 1)
        right.plot(across[part], along[part], color=AFTER, lw=1.1, label=f"cycle {longest.cycles} of {longest.cycles}")
        right.legend(loc="upper left")
    right.set_xlabel(names[0])
    right.set_ylabel(names[1])
    align_ordinates(row[0] for row in axes)
    figure.suptitle(f"{test.label}, {test.temperature_C:g} °C", fontsize=9.0, x=0.01, ha="left")
    return figure


@styled
def properties_figure(table: PropertyTable, temperature_C: float) -> Figure:
    """Draw G', G_eq, G'' and n over frequency at each strain, as Figs. 3.15 to 3.24 of the thesis.

    Args:
        table: with rows at the temperature.
        temperature_C: one of its levels.
    """
    figure, axes = new_figure(2, 2, 7.6, 5.6)
    near = np.abs(table.temperature_C - temperature_C) <= 1.0
    strains = table.levels[1]
    level = np.argmin(np.abs(table.strain[:, None] - strains), axis=1)
    quantities = (
        (axes[0][0], 1e-6 * table.G_storage, "storage modulus $G'$ (MPa)"),
        (axes[0][1], 1e-6 * table.G_eq, "equivalent modulus $G_\\mathrm{eq}$ (MPa)"),
        (axes[1][0], 1e-6 * table.G_loss, "loss modulus $G''$ (MPa)"),
        (axes[1][1], table.loss_factor, "loss factor $n$"),
    )
    for axis, values, label in quantities:
        for i, strain in enumerate(strains):
            rows = np.flatnonzero(near & (level == i))
            rows = rows[np.argsort(table.frequency[rows])]
            colour = str(0.6 * i / max(len(strains) - 1, 1))
            axis.plot(
                table.frequency[rows],
                values[rows],
                marker=MARKS[i % len(MARKS)],
                ms=3.5,
                color=colour,
                label=f"{100 * strain:.3g} %",
            )
        logarithmic(axis)
        axis.set_xticks(table.levels[2], [f"{frequency:.3g}" for frequency in table.levels[2]])  # measured ones too
        if len(table.levels[2]) == 1:
            axis.set_xlim(0.5 * table.levels[2][0], 2.0 * table.levels[2][0])
        axis.set_ylim(bottom=0.0)
        axis.set_ylabel(label, parse_math=True)
    for axis in axes[1]:
        axis.set_xlabel("frequency (Hz)")
    figure.suptitle(f"Properties at {temperature_C:.3g} °C", fontsize=9.0, x=0.01, ha="left")
    handles, labels = axes[0][0].get_legend_handles_labels()
    legend_below(figure, handles, labels, 8, "shear strain")
    return figure
