"""The model of a file, of whatever kind, as drawings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from edesign.project.building import Building
from edesign.project.project import Project
from edesign.project.reading.file_model import FileModel
from edesign.project.study.study import Study
from edesign.project.substructure.rts_file import RtsFile
from edesign.report.model.figures import Named, project_figures
from edesign.report.model.study import study_figures
from edesign.report.model.write import PAGE, origin, write_drawings


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
    title, about = str(getattr(file, "title", "") or file.path.stem), origin(file)
    heading = () if path.suffix.lower() == PAGE else (title, about)
    return write_drawings(drawings_of(file, heading), path, title, about)


def drawings_of(file: FileModel, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the drawings of a file's model.

    Args:
        file: as `draw_model`.
        heading: lines above each drawing; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    if isinstance(file, Study) and isinstance(file.base, Building):
        yield from drawings_of(file.base, heading)
    elif isinstance(file, Study):
        yield from study_figures(file, {}, heading)
    elif isinstance(file, Building):
        from edesign.report.building.figures.model_figures import building_model_figures

        yield from building_model_figures(file, heading)
    elif isinstance(file, RtsFile):
        from edesign.report.substructure.model_figures import substructure_model_figures

        yield from substructure_model_figures(file, heading)
    elif isinstance(file, Project):
        yield from project_figures(file, heading)
