"""The project file: YAML with units to a validated project in SI."""

from edesign.project.loader import load_project, parse_project
from edesign.project.project import Project
from edesign.project.reading.problems import Problem, ProjectError
from edesign.project.template import new_project

__all__ = ["Problem", "Project", "ProjectError", "load_project", "new_project", "parse_project"]
