"""What a run of the core records: the rows that it writes are taken over piece by piece, and a part of them is kept.

So the memory of a run does not grow with its steps, but with what is kept of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from edesign.core._edcore import ffi
from edesign.core.response import ENERGIES, Channel, EnergyBalance, Watch

PIECE = 4096
"""Steps from one taking over to the next at most: what it costs is then far below a step, and 50 channels need 2 MB."""
_WATCHED_NUMBERS = 2**19
"""Of all written channels, from one taking over to the next, where some are watched: 4 MB. Measured: fewer cost
more calls of what watches, and more gain nothing."""


class Recording:
    """Recorder of the channels of a run while it goes on.

    Attributes:
        end: abscissa of the last row, nan without any.
        balance: of the energies.
        start: of each channel that keeps it, in the first row; empty without any.
        energy_start, energy_final: J of each of ENERGIES in the first and last row; empty without any.
        piece: how many steps there may be from one taking over to the next.

    Args:
        channels: in the order of the core's.
        before: statistics of the analysis when the run began.
        rows: how many rows there will be at most, with the one at the start.
        every: one row of so many is kept.
        tail: how many of the last rows are kept of channels with a tail.
        energies: whether the energies of the kept rows are kept; their balance counts every row.
        whole: whether the core writes all rows before the first is taken over.
        watch: sees the channels that are watched, every row.
    """

    def __init__(
        self,
        channels: Sequence[Channel],
        limits: Mapping[str, float],
        before: Mapping[str, float],
        rows: int,
        every: int = 1,
        tail: int = 0,
        energies: bool = True,
        whole: bool = False,
        watch: Watch | None = None,
    ) -> None:
        self.channels, self.limits, self.before = tuple(channels), dict(limits), before
        self.end, self.balance = float("nan"), EnergyBalance()
        self.start: dict[str, float] = {}
        self.energy_start: dict[str, float] = {}
        self.energy_final: dict[str, float] = {}
        written = [channel for channel in channels if channel.written]
        self._starts = {channel.name: i for i, channel in enumerate(written) if channel.start}
        self._kept = {channel.name: i for i, channel in enumerate(written) if channel.history}
        self._tails = {channel.name: i for i, channel in enumerate(written) if channel.tail}
        watched = [i for i, channel in enumerate(written) if channel.watched]
        together = bool(watched) and watched[-1] - watched[0] == len(watched) - 1
        self._watch, self._watched = watch, slice(watched[0], watched[-1] + 1) if together else watched
        self._every, self._seen, self._rows = every, 0, 0
        self.piece = max(1, min(PIECE, _WATCHED_NUMBERS // len(written))) if watched else PIECE
        size = rows if whole else min(rows, self.piece + 1)
        self._abscissa = np.full(size, np.nan)
        self._values = np.empty((size, len(written)))
        self._energy = np.empty((size, len(ENERGIES)))
        count = (rows - 1) // every + 1
        self._time = np.empty(count)
        self._histories = np.empty((len(self._kept), count))  # memory that is not written to is not taken
        self._energies = np.empty((len(ENERGIES), count if energies else 0))
        self._tail = np.empty((0, len(self._tails)))
        self._longest = tail

    def buffers(self) -> tuple[Any, Any, Any]:
        """Return the abscissas, values and energies that the core writes to."""
        return tuple(ffi.from_buffer("double[]", b.ravel()) for b in (self._abscissa, self._values, self._energy))

    def take(self, count: int) -> None:
        """Take over the first rows of the buffers; the core writes the next ones there."""
        if not count:
            return
        self.end = float(self._abscissa[count - 1])
        if not self._seen:
            self.start = {name: float(self._values[0, column]) for name, column in self._starts.items()}
            self.energy_start = dict(zip(ENERGIES, map(float, self._energy[0]), strict=True))
        self.energy_final = dict(zip(ENERGIES, map(float, self._energy[count - 1]), strict=True))
        given, missing = (self._energy[:count, ENERGIES.index(name)] for name in ("input", "residual"))
        self.balance.count(given, missing)
        chosen = np.arange(-self._seen % self._every, count, self._every)
        place = slice(self._rows, self._rows + len(chosen))
        self._time[place] = self._abscissa[chosen]
        for row, column in enumerate(self._kept.values()):
            self._histories[row, place] = self._values[chosen, column]
        if self._energies.size:
            self._energies[:, place] = self._energy[chosen].T
        if self._longest and self._tails:
            latest = self._values[max(0, count - self._longest) : count, list(self._tails.values())]
            self._tail = np.concatenate((self._tail[max(0, len(self._tail) + len(latest) - self._longest) :], latest))
        if self._watch is not None:
            self._watch(self._abscissa[:count], self._values[:count, self._watched])
        self._seen += count
        self._rows += len(chosen)
        self._abscissa[:count] = np.nan

    def take_rest(self) -> None:
        """Take over what stands in the buffers once the run has ended."""
        self.take(int(np.count_nonzero(np.isfinite(self._abscissa))))

    @property
    def time(self) -> np.ndarray:
        """Abscissas of the rows that are kept, (rows kept,)."""
        return self._time[: self._rows]

    @property
    def values(self) -> dict[str, np.ndarray]:
        """Values of each channel with history, (rows kept,)."""
        return {name: self._histories[row, : self._rows] for row, name in enumerate(self._kept)}

    @property
    def tail(self) -> dict[str, np.ndarray]:
        """Last rows of each channel with a tail, (last rows,)."""
        return {name: self._tail[:, column] for column, name in enumerate(self._tails)}

    @property
    def energy(self) -> dict[str, np.ndarray]:
        """Energies of each of ENERGIES, (rows kept,) J; without values if they are not kept."""
        return {name: self._energies[i, : self._rows] for i, name in enumerate(ENERGIES)}
