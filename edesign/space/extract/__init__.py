"""A plane frame of a building as a project file."""

from edesign.space.extract.plane_frame import PlaneFrame, plane_frame
from edesign.space.extract.project_text import project_text

__all__ = ["PlaneFrame", "plane_frame", "project_text"]
