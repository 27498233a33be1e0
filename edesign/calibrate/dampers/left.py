"""What a model leaves of the tests that it was fitted to, as forms of effects take their starts from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibrate.dampers.peaks import common_tones
from edesign.calibrate.dampers.trial import Trial


@dataclass(frozen=True, eq=False)
class Left:
    """Tests, and the residuals (n_i,) N of each."""

    trials: Sequence[Trial] = ()
    residuals: Sequence[np.ndarray] = ()

    @cached_property
    def tones(self) -> tuple[float, ...]:
        """Frequencies Hz of narrow peaks, looked for once for all forms that ask."""
        return common_tones(self.trials, self.residuals)
