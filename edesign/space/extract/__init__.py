"""A plane frame of a building as a project file, and a study of it with dampers."""

from edesign.space.extract.plane_frame import PlaneFrame, plane_frame
from edesign.space.extract.project_text import project_text
from edesign.space.extract.study_text import StudyNames, study_text, suite_text

__all__ = ["PlaneFrame", "StudyNames", "plane_frame", "project_text", "study_text", "suite_text"]
