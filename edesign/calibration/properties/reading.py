"""How properties were read from the loops: faults that no loop has, only the table."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Form, Values, Words, size


@dataclass(frozen=True)
class Reading:
    """Force amplitudes read otherwise than the loops have them, in proportion to the one parameter of a form.

    Attributes:
        factors: of the force in phase, the largest force and that of the energy, (3,) per unit of the parameter.
        added: forces (3,) per unit of the parameter.
    """

    factors: tuple[float, float, float] = (0.0, 0.0, 0.0)
    added: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        """Return force amplitudes (3, rows), N, as they were read.

        Args:
            p: value of the parameter by name, SI.
            amplitudes: (3, rows) true ones, N: in phase, largest, of the energy.
        """
        (value,) = p.values()
        factors, added = np.array(self.factors), np.array(self.added)
        return np.asarray((1.0 + value * factors)[:, np.newaxis] * amplitudes + value * added[:, np.newaxis])


@dataclass(frozen=True, eq=False)
class ReadingForm(Form[Reading, Sizes]):
    """A form of an effect of how a table was read from loops."""


_PEAK = ReadingForm(
    "peak_reading",
    "share",
    "instrument",
    "the largest stress read too large by a share, as in cycles before the material has softened",
    "G_eq off by one factor beside G' and loss factor, whatever strain, frequency and temperature",
    "thesis Eqs. 3.1-3.4 and section 3.3",
    (Reading(factors=(0.0, 1.0, 0.0)),),
    lambda _: (size("share", "", 0.1, -0.5, 1.0),),
    lambda _: ((0.05,),),
    meanings={"share": "by which the largest stress is read too large"},
    negative=Words(
        "the largest stress read too small by a share",
        "G_eq off by one factor beside G' and loss factor, whatever strain, frequency and temperature",
    ),
)

FORMS = (
    _PEAK,
    replace(
        _PEAK,
        form="force",
        title="the largest stress read from noisy samples",
        signature="G_eq too large by one force at all amplitudes, most in small tests",
        mechanisms=(Reading(added=(0.0, 1.0, 0.0)),),
        parameters=lambda s: (size("force", "N", 0.05 * s.force, 0.0, 0.5 * s.force),),
        starts=lambda s: ((0.02 * s.force,),),
        meanings={"force": "by which the largest force is read too large"},
        negative=None,
    ),
    replace(
        _PEAK,
        name="storage_reading",
        title="the stress at the largest strain read too small by a share",
        signature="G' too small and the loss factor too large by one factor, G_eq right",
        mechanisms=(Reading(factors=(-1.0, 0.0, 0.0)),),
        parameters=lambda _: (size("share", "", 0.1, -1.0, 0.5),),
        meanings={"share": "by which the stress at the largest strain is read too small"},
        negative=Words(
            "the stress at the largest strain read too large by a share",
            "G' too large and the loss factor too small by one factor, G_eq right",
        ),
    ),
)
