"""The frames that an archive is of, built again from its texts, with the dampers of each variant as they were sized."""

from __future__ import annotations

from functools import cached_property

from edesign.archive.reader import Archive
from edesign.frame.frame_model import FrameModel
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Dampers
from edesign.project.study.study import Study
from edesign.report.archive_view import planned, results
from edesign.report.inputs.designed_dampers import archived_dampers
from edesign.study.analysis.structure import make_frame
from edesign.study.plan.variants import variant_project


class VariantFrames:
    """Projects or buildings of the variants of an archive, and their frames.

    Args:
        study: that its text is of; None: it is the archive of a project.
    """

    def __init__(self, archive: Archive, project: AnalysisFile, study: Study | None = None) -> None:
        self._archive, self._project, self._study = archive, project, study
        self._frames: dict[tuple[str, float | None], FrameModel] = {}

    @property
    def hazard(self) -> Hazard | None:
        """The seismic action of the project, which all variants share."""
        return self._project.hazard

    @cached_property
    def variants(self) -> tuple[str, ...]:
        """The names of the variants that can be built; a project has one, with its dampers, whose name is ""."""
        if self._study is None:
            return ("",)
        made = self._designed
        return tuple(
            name for name, variant in self._study.variants.items() if all(design in made for design in variant.designs)
        )

    def project(self, variant: str, temperature_C: float | None = None) -> AnalysisFile:
        """Return the project or building of a variant with its dampers at a temperature.

        Args:
            temperature_C: degC; None: that of the variant.
        """
        if self._study is None:
            return self._project
        return variant_project(self._study, variant, self._designed, temperature_C)

    def frame(self, variant: str, temperature_C: float | None = None) -> FrameModel:
        """Return the frame of a variant with its dampers at a temperature.

        Args:
            temperature_C: degC; None: that of the variant.

        Raises:
            InputError: it cannot be built, as a file that it needs is not at hand.
        """
        key = (variant, temperature_C)
        if key not in self._frames:
            self._frames[key] = make_frame(self.project(variant, temperature_C), dampers=True)
        return self._frames[key]

    def first_period(self, variant: str) -> float | None:
        """Return the first natural period of a variant, s; None where the archive has no modes of it."""
        name = f"{variant}.modes"
        if self._study is None or name not in planned(self._archive):
            return None
        period = results(self._archive, name).variables.get("period")
        return None if period is None else float(period.values[0])

    @cached_property
    def _designed(self) -> dict[str, Dampers]:
        """The dampers of each design that was completed."""
        assert self._study is not None
        return archived_dampers(self._archive, self._study)
