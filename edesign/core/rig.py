"""What stands in series with a damper in a test rig, for the C core."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Any

from edesign.core._edcore import ffi
from edesign.core.errors import CoreError


@dataclass(frozen=True)
class SeriesRig:
    """Pins with play and flexible parts in series with a damper.

    At a stretch e they carry play_stiffness (e - z) + stiffness z (1 + cubic z^2), z what of e is beyond half the play,
    either way; and damping e' beside all of it.

    Attributes:
        stiffness: N/m, above 0.
        play: of the pins from end to end, m, at least 0.
        cubic: by which the parts stiffen, 1/m2, at least 0.
        play_stiffness: stiffness within the play, N/m, at least 0.
        power: above 1, of parts that carry stiffness z |sqrt(cubic) z|^(power - 1), as bodies in contact do: with
            cubic above 0, without play.
        compression_ratio: times as stiff where they are pushed together (e < 0), above 0.
        damping: N s/m, at least 0.

    Raises:
        CoreError: a value that is not allowed.
    """

    stiffness: float
    play: float = 0.0
    cubic: float = 0.0
    play_stiffness: float = 0.0
    power: float = 1.0
    compression_ratio: float = 1.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "compression_ratio"):
            value = getattr(self, name)
            if not (value > 0.0 and isfinite(value)):
                _refuse(f"{name} = {value:g} is not allowed: finite and above 0 [E-VALUE-02]")
        power = self.power
        if not (power >= 1.0 and isfinite(power)) or (power > 1.0 and not (self.cubic > 0.0 and self.play == 0.0)):
            _refuse(f"power = {power:g} is not allowed: 1, or above with cubic > 0 and without play [E-VALUE-02]")
        for name in ("play", "cubic", "play_stiffness", "damping"):
            value = getattr(self, name)
            if not (value >= 0.0 and isfinite(value)):
                _refuse(f"{name} = {value:g} is not allowed: finite, at least 0 [E-VALUE-02]")

    def for_core(self) -> Any:
        """Return the core's structure; it lives as long as what this returns."""
        values = (
            self.stiffness,
            self.compression_ratio,
            self.cubic,
            self.power,
            self.play_stiffness,
            self.play,
            self.damping,
        )
        return ffi.new("ed_rig *", values)


def _refuse(text: str) -> None:
    raise CoreError("ED_E_ARGUMENT", f"damper in series: {text}")
