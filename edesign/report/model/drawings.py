"""The model of a file, of whatever kind, as drawings."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from edesign.project.building import Building
from edesign.project.project import Project
from edesign.project.reading.file_model import FileModel
from edesign.project.study.study import Study
from edesign.project.substructure.rts_file import RtsFile
from edesign.report.model.figures import Named, project_figures
from edesign.report.model.study import study_figures
from edesign.report.model.write import heading_of, write_drawings


def draw_model(file: FileModel, path: Path) -> list[Path]:
    """Draw the model of a file.

    Args:
        file: project, study, building or substructure tests.
        path: of the drawing; errors as `write_drawings`.

    Returns:
        The files that were written.

    Raises:
        InputError: the model has a mistake that is found when it is built.
    """
    title = str(getattr(file, "title", file.path.stem))
    return write_drawings(drawings_of(file, title), path, title)


def drawings_of(file: FileModel, title: str) -> Iterator[Named]:
    """Give the drawings of a file's model: name, caption, figure.

    Args:
        file: as `draw_model`.
        title: that stands above each drawing.
    """
    heading = heading_of(file, title)
    if isinstance(file, Study):
        yield from study_figures(file, {}, heading)
    elif isinstance(file, Building):
        from edesign.report.building.model_figures import building_model_figures

        yield from building_model_figures(file, heading)
    elif isinstance(file, RtsFile):
        from edesign.report.substructure.model_figures import substructure_model_figures

        yield from substructure_model_figures(file, heading)
    elif isinstance(file, Project):
        yield from project_figures(file, heading)
