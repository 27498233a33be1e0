"""Error that rig and compensator leave in the motion and in the response, from transfer functions."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from edesign.errors import InputError
from edesign.substructure.stability.loop import Loop
from edesign.substructure.stability.margins import LoopStability
from edesign.substructure.stability.whole import WholeStructure

DECAY = 1e-4
"""Of the slowest vibration until the record comes round again in the transform."""
MOST_SAMPLES = 2**22
"""Of the padded record: 2.9 hours at 0.0025 s. A loop that decays more slowly counts as one that does not."""
REFINEMENT = 4
"""Steps for each of the record, linear between its values; at a tenth of its rate amplitudes hold within 0.3 %."""


@dataclass(frozen=True)
class ExpectedErrors:
    """Linearised substructure test against the structure itself, during the record.

    Attributes:
        response_rms: rms error of the interface's deformation over the rms of the direct one; inf: it grows.
        response_peak: peak over the direct peak, less 1.
        time: (m,), s.
        direct: deformation of the interface in the structure itself, (m,), m.
        target, measured: in the loop, (m,), m; nan: it grows.
    """

    response_rms: float
    response_peak: float
    time: np.ndarray
    direct: np.ndarray
    target: np.ndarray
    measured: np.ndarray


@dataclass(frozen=True, eq=False)
class DirectResponse:
    """The structure itself under a ground motion: what every loop with it is compared with.

    Attributes:
        whole: the structure.
        influence: (n,).
        ground_acceleration: (m,), m/s2, from rest.
        time_step: of it, s.
        free_vibration: time after the record that counts, s.

    Raises:
        InputError: shapes that do not fit, a record with values that are not finite, a step not greater than zero.
    """

    whole: WholeStructure
    influence: np.ndarray
    ground_acceleration: np.ndarray
    time_step: float
    free_vibration: float = 0.0
    _found: dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the record."""
        n = self.whole.interface.size
        if self.influence.shape != (n,):
            raise InputError(f"influence: shape {self.influence.shape} beside {n} degrees of freedom")
        if self.ground_acceleration.ndim != 1 or not np.all(np.isfinite(self.ground_acceleration)):
            raise InputError("the ground acceleration is no single row of finite values")
        if not np.any(self.ground_acceleration):
            raise InputError("the ground does not move")
        if not (self.time_step > 0.0 and self.free_vibration >= 0.0):
            raise InputError(f"time step {self.time_step:g} s, free vibration {self.free_vibration:g} s")

    @property
    def step(self) -> float:
        """Between values of the response, s."""
        return self.time_step / REFINEMENT

    @property
    def size(self) -> int:
        """Number of values of the response that count."""
        refined = (self.ground_acceleration.size - 1) * REFINEMENT + 1
        return refined + round(self.free_vibration / self.step)

    def spectra(self, padded: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of so many values, an even number: s (k,), the deformation of the interface (k,), and T (k,).

        Loops with one structure mostly need as many; they are found once.
        """
        if padded not in self._found:
            s = 2j * np.pi * np.fft.rfftfreq(padded, self.step)
            alone, moved = self.whole.receptances(-self.whole.mass @ self.influence, s)
            force = self.whole.specimen_at(s) * alone
            ground = np.fft.rfft(_refined(self.ground_acceleration), padded)
            self._found[padded] = s, ground * moved / (1.0 + force), force / (1.0 + force)
        return self._found[padded]


def expected_errors(loop: Loop, stability: LoopStability, response: DirectResponse) -> ExpectedErrors:
    """Error of the response to be expected under a ground motion.

    Args:
        loop: with rig and compensator.
        stability: of this loop.
        response: of the structure in the loop.
    """
    steady, padded = stability.stable, _length(stability, response.size, response.step)
    if padded is None:
        steady, padded = False, _length_of_direct(stability, response.size, response.step)
    s, direct, share = response.spectra(padded)
    own, time = np.fft.irfft(direct, padded)[: response.size], np.arange(response.size) * response.step
    if not steady:
        nothing = np.full(time.size, np.nan)
        return ExpectedErrors(math.inf, math.inf, time, own, nothing, nothing)
    actuation = loop.actuation(s)
    looped = direct / (1.0 + (actuation - 1.0) * share)
    target, measured = (np.fft.irfft(one, padded)[: time.size] for one in (looped, looped * actuation))
    return ExpectedErrors(
        _rms(target - own) / _rms(own),
        float(np.max(np.abs(target)) / np.max(np.abs(own)) - 1.0),
        time,
        own,
        target,
        measured,
    )


def _refined(ground: np.ndarray) -> np.ndarray:
    """Record with further values on the straight lines between its own."""
    at = np.arange((ground.size - 1) * REFINEMENT + 1) / REFINEMENT
    return np.asarray(np.interp(at, np.arange(ground.size), ground))


def _length(stability: LoopStability, samples: int, time_step: float) -> int | None:
    """Samples of the padded record until loop and structure are at rest; None: too many, or never."""
    roots = [-mode.loop_damping * mode.loop_frequency for mode in stability.modes]
    decays = [-2.0 * math.pi * rate for rate in roots if math.isfinite(rate)]
    decays += [-root.real for root in stability.other_roots]
    if not stability.stable or any(decay <= 0.0 for decay in decays):
        return None
    return _padded(min([*decays, *_own_decays(stability)]), samples, time_step)


def _length_of_direct(stability: LoopStability, samples: int, time_step: float) -> int:
    """The same for the structure alone, as far as it can be."""
    return _padded(min(_own_decays(stability), default=math.inf), samples, time_step) or MOST_SAMPLES


def _own_decays(stability: LoopStability) -> list[float]:
    """Rates at which the structure's modes decay, 1/s."""
    rates = (2.0 * math.pi * mode.damping * mode.frequency for mode in stability.modes)
    return [rate for rate in rates if math.isfinite(rate)]


def _padded(decay: float, samples: int, time_step: float) -> int | None:
    """Even number of samples of record and quiet, good for the transform; None: too many."""
    length = 2.0 * samples - math.log(DECAY) / (decay * time_step)
    if not length <= MOST_SAMPLES:
        return None
    return int(2 ** math.ceil(math.log2(length)))


def _rms(values: np.ndarray) -> float:
    """Root mean square over time."""
    return float(np.sqrt(np.mean(values**2)))
