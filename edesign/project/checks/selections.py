"""Checks that selections stay inside a grid, and that what is selected one by one stands there."""

from __future__ import annotations

from collections.abc import Iterable

from edesign.project.frame.frame import Frame
from edesign.project.frame.members import BeamPlaces, ColumnPlaces
from edesign.project.notation import names
from edesign.project.notation.selections import LineSelection, NumberSelection
from edesign.project.reading.problems import Keys, Problems, listed
from edesign.project.reading.words import counted_are


class GridSelections:
    """Checks of selections in a grid of storeys; each returns whether it found nothing wrong.

    Args:
        what: "frame" or "building", for messages.
    """

    def __init__(self, problems: Problems, n_storeys: int, what: str) -> None:
        self.problems = problems
        self._n_storeys = n_storeys
        self._what = what

    def numbers(self, keys: Keys, chosen: NumberSelection, what: str, last: int, of: str = "") -> bool:
        """Check that every number is within 1 to `last`.

        Args:
            what: what they count, for messages.
            last: the largest number.
            of: further words for messages on what they belong to.
        """
        good = True
        for i, (low, high) in enumerate(chosen.ranges):
            if low < 1 or high > last:
                outside = low if low < 1 else high
                message = f"there is no {what} {outside}{of}; {what}s are numbered 1 to {last} [E-NAME-01]"
                self.problems.at_item(keys, i, message)
                good = False
        return good

    def storeys(self, keys: Keys, chosen: NumberSelection) -> bool:
        """Check that every storey exists.

        Args:
            keys: key path of what has the key `storeys`.
            chosen: the selected numbers.
        """
        return self.numbers((*keys, "storeys"), chosen, "storey", self._n_storeys)

    def floors(self, keys: Keys, chosen: NumberSelection) -> bool:
        """Check that every floor exists.

        Args:
            keys: key path of what has the key `floors`.
            chosen: the selected numbers.
        """
        return self.numbers((*keys, "floors"), chosen, "floor", self._n_storeys)

    def absent(self, keys: Keys, what: str, missing: Iterable[str]) -> bool:
        """Check that nothing that is selected is missing.

        Args:
            what: kind of the items, for messages.
            missing: names of those that are selected and do not stand.
        """
        found = list(missing)
        if found:
            message = f"{counted_are(len(found), what)} missing in this {self._what}: {listed(found)}"
            self.problems.at_value(keys, f"{message} (`all` takes those that exist) [E-NAME-01]")
        return not found

    def without_section(self, keys: Keys, what: str, bare: Iterable[str]) -> bool:
        """Check that every place of the grid has a run of members, or is listed as missing.

        Args:
            what: kind of the members, for messages.
            bare: names of the members that have neither.
        """
        found = list(bare)
        if found:
            message = f"{counted_are(len(found), what)} without a section: {listed(found)}"
            self.problems.at_key(keys, f"{message}; add an entry, or list under `missing` [E-NAME-01]")
        return not found


class Selections(GridSelections):
    """Checks of selections in a plane frame; each returns whether it found nothing wrong.

    Args:
        frame: read without schema problems.
    """

    def __init__(self, frame: Frame, problems: Problems) -> None:
        super().__init__(problems, frame.n_storeys, "frame")
        self.frame = frame

    def bays(self, keys: Keys, chosen: NumberSelection) -> bool:
        """Check that every bay exists.

        Args:
            keys: key path of what has the key `bays`.
            chosen: the selected numbers.
        """
        return self.numbers((*keys, "bays"), chosen, "bay", self.frame.n_bays)

    def lines(self, keys: Keys, chosen: LineSelection) -> bool:
        """Check that every line exists.

        Args:
            chosen: the selected lines.
        """
        good = True
        for i, span in enumerate(chosen.ranges):
            outside = next((line for line in reversed(span) if line not in self.frame.lines), None)
            if outside is not None:
                last = self.frame.lines[-1]
                first = self.frame.lines[0]
                told = f"there is no line {outside}; lines are named {first} to {last}"
                self.problems.at_item(keys, i, f"{told} [E-NAME-01]")
                good = False
            elif self.frame.lines.index(span[0]) > self.frame.lines.index(span[1]):
                message = f"the range `{span[0]}-{span[1]}` runs backwards; write `{span[1]}-{span[0]}` [E-VALUE-04]"
                self.problems.at_item(keys, i, message)
                good = False
        return good

    def column_places(self, keys: Keys, chosen: ColumnPlaces) -> bool:
        """Check that lines and storeys are within the grid.

        Args:
            chosen: the selected columns.
        """
        lines = self.lines((*keys, "lines"), chosen.lines)
        return self.storeys(keys, chosen.storeys) and lines

    def beam_places(self, keys: Keys, chosen: BeamPlaces) -> bool:
        """Check that bays and floors are within the grid.

        Args:
            chosen: the selected beams.
        """
        bays = self.bays(keys, chosen.bays)
        return self.floors(keys, chosen.floors) and bays

    def standing_columns(self, keys: Keys, chosen: ColumnPlaces) -> None:
        """Check that columns that are selected one by one exist."""
        if self.column_places(keys, chosen) and not (chosen.lines.is_all or chosen.storeys.is_all):
            absent = [p for p in self.frame.column_places(chosen) if p not in self.frame.column_at]
            self.absent(keys, "column", (names.column_name(*p) for p in absent))

    def standing_beams(self, keys: Keys, chosen: BeamPlaces) -> None:
        """Check that beams that are selected one by one exist."""
        if self.beam_places(keys, chosen) and not (chosen.bays.is_all or chosen.floors.is_all):
            absent = [p for p in self.frame.beam_places(chosen) if p not in self.frame.beam_at]
            self.absent(keys, "beam", (self.frame.beam_name(*p) for p in absent))

    def nodes(self, keys: Keys, lines: LineSelection, floors: NumberSelection) -> bool:
        """Check lines and floors, and that nodes that are selected one by one exist."""
        inside = self.lines((*keys, "lines"), lines)
        if not (self.floors(keys, floors) and inside):
            return False
        if not (lines.is_all or floors.is_all):
            rows = floors.numbers(1, self.frame.n_storeys)
            picked = [names.node_name(line, floor) for floor in rows for line in lines.names(self.frame.lines)]
            return self.absent(keys, "node", (name for name in picked if name not in self.frame.nodes))
        return True
