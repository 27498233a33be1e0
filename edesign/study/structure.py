"""A frame ready to be analysed: the core's analysis of it, and its gravity loads."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from edesign.building.frame import FrameModel, build_frame
from edesign.core import Analysis, Modes, Response
from edesign.errors import AnalysisError
from edesign.project.project import Project
from edesign.study.dampers import attachments, device_laws

DEFAULT_TOLERANCE = 1e-7  # of analyses in projects without `integration`
GRAVITY_STEPS = 10


@dataclass(frozen=True)
class Structure:
    """A frame and the analysis of it.

    Attributes:
        frame: the model with the names of its parts.
        analysis: the core's analysis, at first without loads.
    """

    frame: FrameModel
    analysis: Analysis

    def modes(self, count: int, damper_stiffness: np.ndarray | None = None) -> Modes:
        """The lowest modes in the present state, with stiffness of the dampers (n_dampers,) N/m if it is given.

        Without, buckling-restrained braces have that before they yield, and other dampers have none.

        Raises:
            AnalysisError: there are not so many modes, or the structure is unstable.
        """
        braces = {d.number: d.restrained.stiffness for d in self.frame.devices if d.restrained is not None}
        if damper_stiffness is None and braces:
            damper_stiffness = np.zeros(len(self.frame.model.damper_names))
            damper_stiffness[list(braces)] = list(braces.values())
        try:
            return self.analysis.modes(count, damper_stiffness)
        except (ValueError, RuntimeError) as error:
            raise AnalysisError(f"modes: {error}") from error

    def install_dampers(self) -> None:
        """From now on the dampers act: they are set in under the gravity loads and carry nothing of them."""
        self.analysis.install_dampers()

    def apply_gravity(self) -> Response:
        """Apply the gravity combination, which stays on.

        Raises:
            AnalysisError: no equilibrium was found under it.
        """
        response = self.analysis.static(self.frame.gravity, factor=1.0, steps=GRAVITY_STEPS)
        if response.status != "completed":
            raise AnalysisError(f"under the gravity loads: {response.reason}")
        if not response.finite:
            raise AnalysisError("under the gravity loads: a result is not a finite number")
        return response


def frame_alone(project: Project, dampers: bool = True) -> Structure:
    """Build the frame whose modes are meant by damping, lateral forces and periods: without tuned masses and dampers.

    Args:
        project: the validated project.
        dampers: whether it has its dampers, of which buckling-restrained braces are part of the frame.

    Raises:
        InputError, CoreError: as `make_structure`.
    """
    laws = device_laws(project) if dampers else {}
    braces = {name: law for name, law in laws.items() if law.restrained is not None}
    return make_structure(project, build_frame(project, laws=braces or None))


def tolerance(project: Project) -> float:
    """The dimensionless tolerance of equilibrium."""
    return project.integration.tolerance if project.integration is not None else DEFAULT_TOLERANCE


def make_frame(project: Project, dampers: bool = False, outside: Collection[str] = ()) -> FrameModel:
    """Build a project's frame, with its dampers and tuned masses or without; dampers `outside` are left out by name.

    Raises:
        InputError: the frame cannot be built, or a damper is wrong.
    """
    if not dampers or project.dampers is None:
        return build_frame(project)
    return build_frame(project, laws=device_laws(project), attachments=attachments(project), outside=outside)


def make_structure(project: Project, frame: FrameModel | None = None, dampers: bool = False) -> Structure:
    """Build a project's frame and the analysis of it.

    Args:
        project: the validated project.
        frame: its model, if it has been built and completed by further loads.
        dampers: whether the frame has its dampers and tuned masses.

    Raises:
        InputError: the frame cannot be built.
        CoreError: it is a mechanism, or parts are not connected; the message names them.
    """
    if frame is None:
        frame = make_frame(project, dampers)
    return Structure(frame, Analysis(frame.model, tolerance=tolerance(project)))
