"""The model of a building as figures: plans, elevations with sections, and loads of the floors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from edesign.archive.reader import Archive
from edesign.project.building import Building
from edesign.report.archived import archived_building
from edesign.report.building.figures.load_plans import load_plans
from edesign.report.building.figures.model_elevations import model_elevations
from edesign.report.building.figures.model_values import ModelValues
from edesign.report.building.figures.plans import plans, plans_of
from edesign.report.model.figures import Named
from edesign.space.structure.geometry import space_frame


def building_model_figures(building: Building, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the drawings of a building's model.

    Args:
        heading: lines above each drawing; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    frame = space_frame(building)
    yield from model_elevations(building, frame, heading)
    yield from plans_of(ModelValues(frame), heading)
    yield from load_plans(building, frame, heading)


def archived_building_model(archive: Archive) -> Iterator[Named]:
    """Yield the drawings of the model of an archived building; only plans if its text is not in the archive."""
    building = archived_building(archive)
    yield from plans(archive) if building is None else building_model_figures(building)
