"""The histories of an archive by variant, level, record and temperature, as figures and tables compare them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.sets import turned, without_motion
from edesign.report.drawing.captions import record_label
from edesign.report.drawing.style import AFTER, MEAN, VARIANTS
from edesign.study.results.kinds import ANALYSES, DIRECT


@dataclass(frozen=True)
class History:
    """A history of an archive.

    Attributes:
        name: of the analysis.
        variant, level, record: "" where it has none; the record is a reference such as table_5_6/Tabas1978_FER-L1.
        temperature: degC, None: the variant's own.
        shaking: angle of the record and place of the masses of a building, as at the end of names: 90deg.+x-y.
        completed: whether it came to its end.
        reason: why it did not.
    """

    name: str
    variant: str
    level: str
    record: str
    temperature: float | None
    completed: bool
    reason: str
    shaking: str = ""

    @property
    def shaken_by(self) -> str:
        """The record with angle and place of the masses, in letters that names of files keep apart."""
        shaking = self.shaking.replace("+", "plus").replace("-", "minus")
        return f"{self.record}.{shaking}" if shaking else self.record

    @property
    def of_motion(self) -> str:
        """What the names of all histories of its motion begin with: those at other angles, with other masses."""
        return self.name.removesuffix(self.shaking)

    @property
    def motion(self) -> str:
        """The record in words, of a building with its angle and the place of the masses."""
        angle, _, place = self.shaking.rpartition("deg")
        masses = {"": "", "0": "masses in place"}.get(place.strip("."), f"masses {place.strip('.')}")
        return ", ".join(filter(None, (record_label(self.record), f"{angle} deg" if angle else "", masses)))

    @property
    def temperature_label(self) -> str:
        """The temperature of the dampers in words."""
        return "design temperature" if self.temperature is None else f"{self.temperature:g} °C"

    def read(self, archive: Archive) -> Group:
        """Return the results; a variable is read on its first access."""
        return archive.view(f"{ANALYSES}/{self.name}")


def histories(archive: Archive) -> list[History]:
    """Return all histories with results, in the archive's order, without those of incremental analyses.

    Where two of a variant have the same level, record, temperature, angle and eccentricity, they are not of one
    variant: then the names of the analyses, without that of the record, stand for variants.
    """
    found, stems = [], {}
    same: Counter[tuple[object, ...]] = Counter()
    for name in archive.names(ANALYSES):
        about = archive.group_attributes(f"{ANALYSES}/{name}")
        if about.get("kind") != "history" or about.get("incremental"):
            continue
        one = history_of(name, about)
        found.append(one)
        same[one.variant, one.level, one.record, one.temperature, *turned(about)] += 1
        stems[name] = without_motion(name, about)
    mixed = {variant for (variant, *_), count in same.items() if count > 1}
    return [replace(one, variant=stems[one.name]) if one.variant in mixed else one for one in found]


def history_of(name: str, about: Mapping[str, object]) -> History:
    """Return a history by its name and attributes."""
    variant, level, record = (str(about.get(key) or "") for key in ("variant", "level", "record"))
    degrees = about.get("temperature_C")
    temperature = None if degrees is None else float(str(degrees))
    completed = about.get("status") == "completed"
    own = record.rpartition("/")[2]
    shaking = name.removeprefix(without_motion(name, about)).removeprefix(f".{own}").removeprefix(".")
    return History(name, variant, level, record, temperature, completed, str(about.get("reason") or ""), shaking)


def variant_colors(archive: Archive) -> dict[str, str]:
    """Return the color of each variant, in the archive's order; "" where analyses have none."""
    attributes = (archive.group_attributes(f"{ANALYSES}/{name}") for name in archive.names(ANALYSES))
    labels = [str(about["variant"]) for about in attributes if about.get("variant")]
    names = dict.fromkeys((*labels, *(history.variant for history in histories(archive))))
    if len(names) == 1:
        return dict.fromkeys(names, AFTER)
    others = [name for name in names if name != DIRECT]
    found = {name: VARIANTS[i % len(VARIANTS)] for i, name in enumerate(others)}
    return found | {DIRECT: MEAN}  # what compensators are compared with


def by_level(chosen: Iterable[History]) -> dict[str, dict[str, list[History]]]:
    """Return histories at the variants' own temperatures, by level and variant."""
    found: dict[str, dict[str, list[History]]] = {}
    for history in chosen:
        if history.temperature is None:
            found.setdefault(history.level, {}).setdefault(history.variant, []).append(history)
    return found


def by_motion(chosen: Iterable[History]) -> dict[tuple[str, str], list[History]]:
    """Return histories by level and record, of a building also by angle and place of its masses."""
    found: dict[tuple[str, str], list[History]] = {}
    for history in chosen:
        found.setdefault((history.level, history.shaken_by), []).append(history)
    return found


def worst_of_motions(
    chosen: Iterable[History], values: Iterable[np.ndarray], worst: Callable[..., np.ndarray] = np.max
) -> np.ndarray:
    """Return the worst values of each motion over its angles and the places of its masses, place by place.

    Args:
        chosen: histories of one variant and level.
        values: of each, all of one shape.
        worst: `np.max` or `np.min`.

    Returns:
        (n_motions, ...); of histories that are a motion each, as of plane frames, their values.
    """
    of: dict[str, list[np.ndarray]] = {}
    for history, value in zip(chosen, values, strict=True):
        of.setdefault(history.of_motion, []).append(value)
    return np.array([worst(same, axis=0) for same in of.values()])


def counted(chosen: Iterable[History]) -> str:
    """Return of how many records histories are, in words; one at several angles, with several masses, is one."""
    records = len({history.of_motion for history in chosen})
    return f"{records} record{'s' * (records > 1)}"


def worst_counts(chosen: Iterable[History]) -> str:
    """Return a sentence that says what counts of several histories of a motion; "" where each is a motion itself."""
    several = max(Counter((h.variant, h.of_motion) for h in chosen).values(), default=1) > 1
    return " Of each record the worst of its angles and places of the masses counts, place by place." if several else ""


def by_temperature(chosen: Iterable[History]) -> dict[tuple[str, str, str], list[History]]:
    """Return histories as `by_motion`, by variant too, those at the variant's own temperature first."""
    found: dict[tuple[str, str, str], list[History]] = {}
    for history in chosen:
        found.setdefault((history.variant, history.level, history.shaken_by), []).append(history)
    for same in found.values():
        same.sort(key=lambda history: (history.temperature is not None, history.temperature or 0.0))
    return found


def missing_text(chosen: Iterable[History]) -> str:
    """Return a sentence that names the histories that did not complete; "" if all did."""
    named = [
        ", ".join(filter(None, (h.variant, h.motion))) + f" ({h.reason})" * bool(h.reason)
        for h in chosen
        if not h.completed
    ]
    return f" Missing, as the analysis did not complete: {'; '.join(named)}." if named else ""


def groups_alike(groups: Mapping[str, Group], shown: Callable[[Group], Hashable]) -> list[dict[str, Group]]:
    """Return groups in sets of equal description, in their order.

    Args:
        groups: results by the name of the analysis.
        shown: what a table would say of a group.
    """
    found: dict[Hashable, dict[str, Group]] = {}
    for name, group in groups.items():
        found.setdefault(shown(group), {})[name] = group
    return list(found.values())


def names_of(group: Group, dimension: str) -> list[str]:
    """Return the names along a dimension of a group; [] without it.

    Args:
        group: the archived results.
    """
    if dimension not in group.coords:
        return []
    return [str(value) for value in group.coords[dimension].values]


def with_results(archive: Archive, chosen: Iterable[History], *variables: str) -> Iterator[tuple[History, Group]]:
    """Yield completed histories that have some variables, with their results.

    Args:
        *variables: names of variables that a history must have.
    """
    for history in chosen:
        if history.completed:
            group = history.read(archive)
            if all(name in group.variables for name in variables):
                yield history, group
