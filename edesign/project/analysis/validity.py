"""How wrong the energy balance of an analysis may be, and how far the frame may move, for its result to count."""

from __future__ import annotations

from edesign.project.notation.units import PositiveFactor, PositiveRatio
from edesign.project.reading.base import Model


class Validity(Model):
    """Limits beyond which an analysis has failed, and from which its result gets a warning.

    Attributes:
        energy_error: largest error of the energy balance over the energy put in, beyond which an analysis has failed.
        energy_error_warning: error of the energy balance from which the result gets a warning.
        drift: drift ratio of a storey beyond which an analysis has failed; without the key where the geometry errs by
            `energy_error`.
    """

    energy_error: PositiveRatio = 0.05
    energy_error_warning: PositiveRatio = 0.01
    drift: PositiveFactor | None = None

    @property
    def geometric_drift(self) -> float:
        """The drift ratio at which the geometry of small rotations is wrong by `energy_error`.

        A column of height h that leans by the angle theta moves by d h = h sin(theta) and is h cos(theta) high.
        P-Delta takes its height as h, so that the overturning effect of its load, tan(theta), comes out as d: too
        small by the share 1 - cos(theta). That share is `energy_error` at d = sqrt(e (2 - e)).
        """
        share = self.energy_error
        return float((share * (2.0 - share)) ** 0.5)
