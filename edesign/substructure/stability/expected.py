"""What an error of the specimen's force does to a substructure test, from transfer functions."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from edesign.errors import InputError
from edesign.substructure.stability.loop import Loop, Transfer, ideal
from edesign.substructure.stability.margins import LoopStability
from edesign.substructure.stability.whole import WholeStructure

DECAY = 1e-4
"""Of the slowest vibration until the record comes round again in the transform."""
MOST_SAMPLES = 2**22
"""Of the padded record: 2.9 hours at 0.0025 s. A loop that decays more slowly counts as one that does not."""


@dataclass(frozen=True)
class Change:
    """Changes of the motions that an error of the force makes, during the record.

    Attributes:
        target: in the loop, (n,) m.
        measured: displacement of the specimen by that change of its target, (n,) m.
    """

    target: np.ndarray
    measured: np.ndarray


@dataclass(frozen=True, eq=False)
class DisturbedLoops:
    """Loops with one structure about its own motion, under errors of the specimen's force.

    While the structure moves as it does with its damper, rig and compensator make another force of that motion. The
    difference e drives the loop, whose specimen is linear(ised) for what follows: (1 + k_E H G C) x = -H e, H being the
    receptance of the numerical part at the interface. For a linear specimen that is exact.

    Attributes:
        whole: the structure.
        step: between samples, s.
    """

    whole: WholeStructure
    step: float
    _found: dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the step."""
        if not self.step > 0.0:
            raise InputError(f"time step {self.step:g} s: greater than zero [E-VALUE-02]")

    def change(
        self,
        loop: Loop,
        stability: LoopStability,
        force: np.ndarray,
        direct_force: np.ndarray,
        seen: Transfer = ideal,
        moved: Transfer | None = None,
    ) -> Change | None:
        """Return what becomes of the motion; None: the loop grows, or hardly decays.

        Args:
            loop: with rig and compensator.
            stability: of this loop.
            force: (n,) of rig and compensator under the motion of the structure itself, N.
            direct_force: (n,) of the damper in the structure itself, N.
            seen: what the numerical part takes for the force, over `force`.
            moved: measured displacement over target; None: `loop.actuation`.

        Raises:
            InputError: forces that are no two rows of one length, or not finite.
        """
        if force.ndim != 1 or force.shape != direct_force.shape or not np.all(np.isfinite(force - direct_force)):
            raise InputError("forces are two rows of one length and finite values [E-SIGNAL-01]")
        padded = _length(stability, force.size, self.step)
        if padded is None:
            return None
        s, receptance, stiffness = self._spectra(padded)
        error = np.fft.rfft(force, padded) * seen(s) - np.fft.rfft(direct_force, padded)
        actuation = loop.actuation(s)
        spectrum = -receptance * error / (1.0 + stiffness * receptance * actuation)
        followed = spectrum * (actuation if moved is None else moved(s))
        return Change(*(np.fft.irfft(one, padded)[: force.size] for one in (spectrum, followed)))

    def _spectra(self, padded: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of so many values: s, H and k_E, (k,) each. Loops with one structure mostly need as many."""
        if padded not in self._found:
            s = 2j * np.pi * np.fft.rfftfreq(padded, self.step)
            own = self.whole.receptances(self.whole.interface, s)[0]
            self._found[padded] = s, own, self.whole.specimen_at(s)
        return self._found[padded]


def _length(stability: LoopStability, samples: int, time_step: float) -> int | None:
    """Samples of the padded record until loop and structure are at rest; None: too many, or never."""
    roots = [-mode.loop_damping * mode.loop_frequency for mode in stability.modes]
    decays = [-2.0 * math.pi * rate for rate in roots if math.isfinite(rate)]
    decays += [-root.real for root in stability.other_roots]
    if not stability.stable or any(decay <= 0.0 for decay in decays):
        return None
    own = (2.0 * math.pi * mode.damping * mode.frequency for mode in stability.modes)
    return _padded(min([*decays, *(rate for rate in own if math.isfinite(rate))], default=math.inf), samples, time_step)


def _padded(decay: float, samples: int, time_step: float) -> int | None:
    """Even number of samples of record and quiet, good for the transform; None: too many."""
    length = samples - math.log(DECAY) / (decay * time_step)
    if not length <= MOST_SAMPLES:
        return None
    return int(2 ** math.ceil(math.log2(length)))
