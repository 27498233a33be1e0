"""All figures of an archive, in the order of a report, and as files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from edesign.archive.files import make_folder
from edesign.archive.reader import Archive, open_archive
from edesign.errors import EdesignError
from edesign.optional_stages import optional
from edesign.report.archived import is_building_archive, is_substructure_archive
from edesign.report.assessment.vary_figures import vary_figures
from edesign.report.building.curves import mode_shapes, spectra, storey_curves
from edesign.report.building.elevations import elevations
from edesign.report.building.model_figures import archived_building_model
from edesign.report.capacity.incremental_figures import incremental_figures
from edesign.report.capacity.pushover_figures import hinge_figures, pushover_figures
from edesign.report.design.figures import design_figures
from edesign.report.drawing.captions import UniqueNames
from edesign.report.drawing.style import check_format, garbage_between_figures, save
from edesign.report.ground_motion.hazard_figures import hazard_figures
from edesign.report.ground_motion.record_figures import record_figures
from edesign.report.model.archived import model_figures
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.brace_figures import brace_figures
from edesign.report.response.damper_loops import damper_figures
from edesign.report.response.energy_figures import energy_figures
from edesign.report.response.frame_figures import frame_figures
from edesign.report.response.mean_profiles import mean_profile_figures
from edesign.report.response.mode_figures import mode_figures
from edesign.report.response.moment_rotation_figures import moment_rotation_figures
from edesign.report.response.profile_figures import profile_figures
from edesign.report.response.response_figures import response_figures
from edesign.report.response.temperature_figures import temperature_figures

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BUILDING_FIGURES = (archived_building_model, spectra, mode_shapes, storey_curves, elevations)


def building_drawings(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of a building; none of other archives.

    Yields:
        Name of the file, caption and figure.
    """
    if is_building_archive(archive):
        yield from chain.from_iterable(figures(archive) for figures in BUILDING_FIGURES)


def substructure_drawings(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of virtual substructure tests; none of other archives.

    Yields:
        Name of the file, caption and figure.
    """
    if is_substructure_archive(archive):
        from edesign.report.substructure.figures import substructure_figures

        yield from substructure_figures(archive)


FIGURES = (
    building_drawings,
    substructure_drawings,
    model_figures,
    hazard_figures,
    record_figures,
    mode_figures,
    design_figures,
    pushover_figures,
    hinge_figures,
    mean_profile_figures,
    profile_figures,
    frame_figures,
    axial_figures,
    response_figures,
    energy_figures,
    moment_rotation_figures,
    brace_figures,
    damper_figures,
    temperature_figures,
    vary_figures,
    incremental_figures,
)
"""Each gives (name of the file, caption, figure) for what an archive has of its subject."""


def all_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of an archive.

    Yields:
        Name of the file, caption and figure.
    """
    return chain.from_iterable(figures(archive) for figures in FIGURES)


def draw_figures(
    archive: str | os.PathLike[str] | Archive, folder: Path, figure_format: str = "svg"
) -> tuple[Path, ...]:
    """Draw all figures of an archive into files.

    Args:
        archive: path, or open archive, complete or partial, of `edesign match` or `edesign run`.
        folder: where the files go; made if it does not exist.
        figure_format: svg, png or pdf.

    Returns:
        The files, named as `all_figures` says, with their suffix; none where there is nothing to draw.

    Raises:
        ArchiveError: the archive cannot be read, or a figure cannot be written.
        InputError: the format is unknown, or the archive's project cannot be read by this version.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return draw_figures(opened, folder, figure_format)
    suffix = check_format(figure_format)
    written: list[Path] = []
    unique = UniqueNames()
    with garbage_between_figures() as collect:
        for figures in FIGURES:
            with optional(figures.__name__.replace("_", " "), passing=(EdesignError,)):
                for name, _, figure in figures(archive):
                    if not written:
                        make_folder(folder)
                    path = folder / f"{unique(name)}.{suffix}"
                    save(figure, path)
                    written.append(path)
                    del figure
                    collect()
    return tuple(written)
