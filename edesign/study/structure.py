"""A frame ready to be analysed: the core's analysis of it, and its gravity loads."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.building.frame import FrameModel, build_frame
from edesign.core import Analysis, Modes, Response
from edesign.errors import AnalysisError
from edesign.project.project import Project

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

    def modes(self, count: int) -> Modes:
        """The lowest modes in the present state.

        Raises:
            AnalysisError: there are not so many modes, or the structure is unstable.
        """
        try:
            return self.analysis.modes(count)
        except (ValueError, RuntimeError) as error:
            raise AnalysisError(f"modes: {error}") from error

    def apply_gravity(self) -> Response:
        """Apply the gravity combination, which stays on.

        Raises:
            AnalysisError: no equilibrium was found under it.
        """
        response = self.analysis.static(self.frame.gravity, factor=1.0, steps=GRAVITY_STEPS)
        if response.status != "completed":
            raise AnalysisError(f"under the gravity loads: {response.reason}")
        return response


def tolerance(project: Project) -> float:
    """The dimensionless tolerance of equilibrium."""
    return project.integration.tolerance if project.integration is not None else DEFAULT_TOLERANCE


def make_structure(project: Project, frame: FrameModel | None = None) -> Structure:
    """Build a project's frame and the analysis of it.

    Args:
        project: the validated project.
        frame: its model, if it has been built and completed by further loads.

    Raises:
        InputError: the frame cannot be built.
        CoreError: it is a mechanism, or parts are not connected; the message names them.
    """
    if frame is None:
        frame = build_frame(project)
    return Structure(frame, Analysis(frame.model, tolerance=tolerance(project)))
