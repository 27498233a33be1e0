"""The model of an archive as figures."""

from __future__ import annotations

from collections.abc import Iterator

from edesign.archive.reader import Archive
from edesign.project.project import Project
from edesign.project.study.study import Study
from edesign.report.archived import archived_project, archived_study
from edesign.report.inputs.designed_dampers import archived_dampers
from edesign.report.model.figures import Named, project_figures
from edesign.report.model.study import study_figures


def model_figures(archive: Archive) -> Iterator[Named]:
    """Yield the drawings of the model whose analyses an archive has; none without its project."""
    project = archived_project(archive)
    if project is not None:
        yield from model_drawings(archive, project, archived_study(archive))


def model_drawings(archive: Archive, project: Project, study: Study | None) -> Iterator[Named]:
    """Yield the drawings of a project or study with the dampers that its designs have found.

    Args:
        project: the project that the archive holds.
        study: the study that the archive holds; None: it is of a project.

    Yields:
        Name of the file, caption and figure of each drawing.
    """
    if study is None:
        yield from project_figures(project)
        return
    yield from study_figures(study, archived_dampers(archive, study))
