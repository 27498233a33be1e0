"""What looks at quantities in every step of a run, so that nothing has to be kept over time for it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.results.recording import Quantity


class Observer(Protocol):
    """Finds something in the steps of a run.

    Attributes:
        needs: names of the quantities that it sees.
        own: those of them that nothing else records.
    """

    needs: tuple[str, ...]
    own: tuple[Quantity, ...]

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps.

        Args:
            abscissas: (n,) of the steps.
            values: the quantities by name, (n, *shape); must not be changed, nor kept without a copy.
        """

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add what was found to the group of the run.

        Args:
            group: with members and ends.
            abscissa: what the run is taken in.
            unit: of the abscissa.
        """


class StepWatch:
    """The `Watch` of a run, which shows each step to observers.

    Args:
        observers: of the run; there may be none.
        start: abscissa before which steps are not shown.
    """

    def __init__(self, observers: Sequence[Observer], start: float = -np.inf) -> None:
        self._observers, self._start = observers, start
        self._seen = False
        self._quantities: list[tuple[Quantity, list[int], slice]] = []

    def watching(self, quantities: Sequence[Quantity]) -> list[Quantity]:
        """Return quantities of a run with those watched that observers need, and last the own ones of observers.

        Args:
            quantities: in the order in which they are recorded; all that are needed. Of one name the first counts:
                those of `outputs.members` come last.
        """
        quantities = [*quantities, *(one for observer in self._observers for one in observer.own)]
        first = {one.name: at for at, one in reversed(list(enumerate(quantities)))}
        chosen = {first[name] for observer in self._observers for name in observer.needs}
        found = [replace(one, watched=True) if at in chosen else one for at, one in enumerate(quantities)]
        at, self._quantities = 0, []
        for one in found:
            if one.watched:
                cells = list(one.keys)
                self._quantities.append((one, cells, slice(at, at + len(cells))))
                at += len(cells)
        return found

    def __call__(self, abscissas: np.ndarray, values: np.ndarray) -> None:
        """See further steps.

        Args:
            abscissas: (n,) of the steps.
            values: (n, watched) of the channels.
        """
        if not np.isfinite(values[-1]).all():
            return  # the run ends here, and its extremes tell
        if abscissas[0] < self._start:
            shown = abscissas >= self._start
            abscissas, values = abscissas[shown], values[shown]
            if not abscissas.size:
                return
        self._seen = True
        found: dict[str, np.ndarray] = {}
        for one, cells, place in self._quantities:
            columns = values[:, place]
            if len(cells) < len(one.cells):
                whole = np.zeros((len(values), len(one.cells)))
                whole[:, cells] = columns
                columns = whole
            found[one.name] = columns.reshape(len(values), *one.shape)
        for observer in self._observers:
            observer.see(abscissas, found)

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add what observers found to the group of the run, if a step was seen.

        Args:
            group: with members and ends.
            abscissa: what the run is taken in.
            unit: of the abscissa.
        """
        if self._seen:
            for observer in self._observers:
                observer.store(group, abscissa, unit)
