"""The frames that an archive is of, built again from its texts, with the dampers of each variant as they were sized."""

from __future__ import annotations

from functools import cached_property

from edesign.archive.reader import Archive
from edesign.frame.devices import Device
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

    def first_period(self, variant: str, device: Device) -> float | None:
        """Return the first natural period of a variant, s; None where the archive has no modes of it.

        Of a building it is that of the mode with most mass along the direction of the device; of one that acts in both,
        the shorter one, with the larger pseudo velocity.
        """
        name = f"{variant}.modes"
        if self._study is None or name not in planned(self._archive):
            return None
        of = results(self._archive, name).variables
        if "period" not in of:
            return None
        masses = [of.get(f"effective_mass_ratio_{axis}") for axis in "xy"]
        moved = {degree for coefficient, _, degree in device.terms if coefficient != 0.0}
        leading = [one.values.argmax() for at, one in enumerate(masses) if one is not None and at in moved]
        in_plane = masses[1] is None or not leading
        return float(min(of["period"].values[[0] if in_plane else leading]))

    @cached_property
    def _designed(self) -> dict[str, Dampers]:
        """The dampers of each design that was completed."""
        assert self._study is not None
        return archived_dampers(self._archive, self._study)
