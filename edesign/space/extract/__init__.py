"""Plane frames of a building as a project file, and a study of them with dampers."""

from edesign.space.extract.elastic_use import elastic_use
from edesign.space.extract.frame_row import FrameRow, frame_row
from edesign.space.extract.project_text import left_out, project_text
from edesign.space.extract.study_text import StudyNames, study_text, suite_text

__all__ = ["FrameRow", "StudyNames", "elastic_use", "frame_row", "left_out", "project_text", "study_text", "suite_text"]
