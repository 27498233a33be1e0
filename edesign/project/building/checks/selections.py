"""Checks that selections stay inside the grid of a building, and that what is named one by one stands."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.members import BeamPlaces, ColumnPlaces
from edesign.project.building.names import ColumnLine, column_name, line_label, node_name
from edesign.project.building.places import ColumnLineSelection, Panels
from edesign.project.checks.selections import GridSelections
from edesign.project.notation.frames import Direction, FrameSelection
from edesign.project.notation.selections import NumberSelection
from edesign.project.reading.problems import Keys, Problems


class Selections(GridSelections):
    """Checks of selections in a building; each returns whether it found nothing wrong.

    Args:
        building: read without schema problems.
    """

    def __init__(self, building: Building, problems: Problems) -> None:
        super().__init__(problems, building.n_storeys, "building")
        self.building = building

    def bays(self, keys: Keys, blocks: tuple[Panels, ...]) -> bool:
        """Check that every bay of the plan exists."""
        good = True
        several = self.problems.node(keys).items is not None
        for i, block in enumerate(blocks):
            at = (*keys, i) if several else keys
            for along, chosen in (("x", block.x), ("y", block.y)):
                last = self.building.n_bays("x" if along == "x" else "y")
                good &= self.numbers((*at, along), chosen, "bay", last, f" along {along}")
        return good

    def lines(self, keys: Keys, chosen: ColumnLineSelection) -> bool:
        """Check that every column line exists.

        Args:
            chosen: the selected column lines.
        """
        outside = self.lines_outside(chosen)
        for i, message in outside.items():
            self.problems.at_item(keys, i, message)
        return not outside

    def lines_outside(self, chosen: ColumnLineSelection) -> dict[int, str]:
        """Return a message for each item of a selection that is outside the plan, by its number."""
        found = {}
        for i, item in enumerate(chosen.items):
            for across, span in item.spans(self.building.axes):
                if span is None or span[1] > self.building.n_bays(across):
                    found[i] = f"`{item.text}`: column lines go from {self._lines_there()} [E-NAME-01]"
                elif span[0] > span[1]:
                    found.setdefault(i, f"the range `{item.text}` runs backwards [E-VALUE-04]")
        return found

    def _lines_there(self) -> str:
        """The column lines of the plan, `A1 to D4`; the names of all grid lines where the plan gives names."""
        building, axes = self.building, self.building.axes
        last = building.n_bays("x"), building.n_bays("y")
        told = f"{ColumnLine(0, 0, axes)} to {ColumnLine(*last, axes)}"
        own = [f"`{', '.join(names)}` across {way}" for way, names in (("x", axes.x), ("y", axes.y)) if names]
        return f"{told}; lines are {' and '.join(own)}" if own else told

    def frames(self, keys: Keys, chosen: FrameSelection, along: Direction) -> bool:
        """Check that every frame exists and has the direction.

        Args:
            chosen: the selected frames.
            along: direction of the frames, x or y.
        """
        good = True
        last, axes = self.building.n_frames(along) - 1, self.building.axes
        own = axes.y if along == "x" else axes.x
        names = ", ".join(own) if own else f"{line_label(along, 0, axes)} to {line_label(along, last, axes)}"
        for i, item in enumerate(chosen.items):
            span = item.span(axes)
            if span is not None and span[0] > span[1] and item.along == along:
                self.problems.at_item(keys, i, f"the range `{item.text}` runs backwards [E-VALUE-04]")
                good = False
            elif item.along != along or span is None or span[1] > last:
                self.problems.at_item(
                    keys, i, f"there is no frame `{item.text}` along {along}; they are {names} [E-NAME-01]"
                )
                good = False
        return good

    def column_places(self, keys: Keys, chosen: ColumnPlaces) -> bool:
        """Check that column lines and storeys exist.

        Args:
            chosen: the selected columns.
        """
        lines = self.lines((*keys, "at"), chosen.at)
        return self.storeys(keys, chosen.storeys) and lines

    def beam_places(self, keys: Keys, chosen: BeamPlaces) -> bool:
        """Check that frames, bays and floors exist.

        Args:
            chosen: the selected beams.
        """
        frames = self.frames((*keys, "frames"), chosen.frames, chosen.along)
        last = self.building.n_bays(chosen.along)
        bays = self.numbers((*keys, "bays"), chosen.bays, "bay", last, f" along {chosen.along}")
        return self.floors(keys, chosen.floors) and frames and bays

    def standing_beams(self, keys: Keys, chosen: BeamPlaces) -> bool:
        """Check that beams that are selected one by one exist."""
        if not self.beam_places(keys, chosen):
            return False
        if chosen.frames.is_all or chosen.bays.is_all or chosen.floors.is_all:
            return True
        layout = self.building.layout
        return self.absent(keys, "beam", (str(p) for p in layout.beam_places(chosen) if p not in layout.beam_at))

    def standing_columns(self, keys: Keys, chosen: ColumnPlaces) -> bool:
        """Check that columns that are selected one by one exist."""
        if not self.column_places(keys, chosen):
            return False
        if chosen.at.is_all or chosen.storeys.is_all:
            return True
        layout = self.building.layout
        absent = (column_name(*at) for at in layout.column_places(chosen) if at not in layout.column_at)
        return self.absent(keys, "column", absent)

    def nodes(self, keys: Keys, lines: ColumnLineSelection, floors: NumberSelection) -> bool:
        """Check that nodes that are selected one by one exist."""
        inside = self.lines((*keys, "at"), lines)
        if not (self.floors(keys, floors) and inside):
            return False
        if lines.is_all or floors.is_all:
            return True
        there = self.building.layout.node_lines
        rows = floors.numbers(1, self.building.n_storeys)
        named = [(line, floor) for floor in rows for line in self.building.lines_of(lines)]
        return self.absent(keys, "node", (node_name(*place) for place in named if place[0] not in there[place[1]]))
