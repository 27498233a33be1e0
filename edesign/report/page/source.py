"""An archive as the sections of the page read it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.members import gravity_states
from edesign.assess.sets import HistorySet, history_sets, measure_statistics, target_sets
from edesign.assess.statistics import Statistics
from edesign.assess.verdicts import Verdict
from edesign.errors import EdesignError
from edesign.optional_stages import optional
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.notation.axes import LETTERED, NUMBERED
from edesign.project.project import Project
from edesign.project.study.study import Study
from edesign.report.archive_view import entry, planned, results
from edesign.report.archived import archived_building, archived_project, archived_study
from edesign.report.assessment.tables import read_histories, read_judged
from edesign.report.assessment.verdict_data import verdicts_of
from edesign.report.capacity.incremental_results import IncrementalResults, read_incremental
from edesign.report.drawing.captions import UniqueNames, file_name
from edesign.report.html.section import Folded, Heading, Part, Picture, Section, Warnings, made
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.page.step import Step, steps
from edesign.report.page.words import words_of
from edesign.study.results.kinds import RECORDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Figures = Callable[[Archive], Iterator[tuple[str, str, "Figure"]]]
MOST_ALIKE = 4  # drawings of the model of a kind, such as plans, that are shown at once
_END = re.compile(rf"(?:(?<=[_XY])(?:{LETTERED}|{NUMBERED}))?$")  # of names such as plan_3, model_X2 and model_YA
ALONG_TIME = ("time", "motion_time", "matched_time", "step")


class Source:
    """The archive and the settings that sections are made from.

    Args:
        archive: open, complete or partial.
        progress: called with a line whenever something that takes long is done.
        figures: whether figures are drawn.

    Attributes:
        archive: the open archive.
        attributes: those of its root.
        left_out: what could not be drawn, and why.
    """

    def __init__(
        self, archive: Archive, progress: Callable[[str], None] = lambda line: None, figures: bool = True
    ) -> None:
        self.archive = archive
        self.attributes = archive.attributes
        self.left_out: list[str] = []
        self._progress = progress
        self._step: Step | None = None
        self._figures = figures
        self._unique = UniqueNames()

    @cached_property
    def groups(self) -> dict[str, Group]:
        """Results of every analysis of the plan by name, without histories; see `archive_view.results`."""
        return {name: results(self.archive, name).without(*ALONG_TIME) for name in planned(self.archive)}

    @cached_property
    def entries(self) -> list[dict[str, Any]]:
        """Labels, status, measures and statistics of every analysis; see `archive_view.entry`."""
        return [entry(name, group) for name, group in self.groups.items()]

    @cached_property
    def sets(self) -> tuple[HistorySet, ...]:
        """The histories by variant and level, missing ones included."""
        if self.archive.complete and not self.archive.damage:
            return history_sets(self.groups)
        there = read_histories(self.archive)
        return history_sets({name: group.without(*ALONG_TIME) for name, group in there.items()})

    @cached_property
    def targets(self) -> tuple[HistorySet, ...]:
        """The states at target displacements by variant, level and method."""
        return target_sets(self.groups)

    @cached_property
    def statistics(self) -> list[tuple[HistorySet, dict[str, Statistics]]]:
        """Each set of histories with the statistics of all its response measures."""
        return [(found, measure_statistics(found)) for found in self.sets]

    @cached_property
    def levels(self) -> list[str]:
        """Names of the hazard levels in the order of the plan."""
        return list(dict.fromkeys(found.level for found in self.sets))

    @cached_property
    def frames(self) -> VariantFrames | None:
        """The frames of the variants, None without a project or building."""
        return VariantFrames(self.archive, self.base, self.study) if self.base is not None else None

    @cached_property
    def words(self) -> dict[str, str]:
        """The words for names of analyses and records; see `words.words_of`."""
        references = (str(group.attributes.get("record") or "") for group in self.groups.values())
        of_records = (
            f"{name}/{inside}"
            for name in self.archive.names(RECORDS)
            for inside in self.archive.names(f"{RECORDS}/{name}")
        )
        return words_of(self.groups, dict.fromkeys(filter(None, (*references, *of_records))))

    @cached_property
    def judged_histories(self) -> dict[str, Group]:
        """Histories and states at target displacements that criteria judge, by name, with the variables they need."""
        sets = (*self.sets, *self.targets)
        over_time = self.study is not None and any(one.traits.over_time for one in self.study.criteria)
        if over_time:
            return read_judged(self.archive)
        judged = {name: group for found in sets for name, group in found.histories.items()}
        return judged | gravity_states(self.groups) if judged else judged

    @cached_property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Verdicts on criteria and objectives of the study, and on braces of its designs; none where none are given."""
        if self.study is None or not (self.sets or self.targets):
            return ()
        return verdicts_of(self.archive, self.study, self.judged_histories, self.study.objectives)

    @cached_property
    def incremental(self) -> list[IncrementalResults]:
        """The incremental studies that have results."""
        return read_incremental(self.archive, self.groups)

    @cached_property
    def study(self) -> Study | None:
        """The study of the archive, None without one, or if this version cannot read it."""
        try:
            return archived_study(self.archive)
        except EdesignError as error:
            self.left_out.append(f"verdicts: {error}")
            return None

    @cached_property
    def project(self) -> Project | None:
        """The project, None without one, or if this version cannot read it."""
        try:
            return archived_project(self.archive)
        except EdesignError as error:
            self.left_out.append(f"the project in words: {error}")
            return None

    @cached_property
    def building(self) -> Building | None:
        """The building, None without one, or if this version cannot read it."""
        try:
            return archived_building(self.archive)
        except EdesignError as error:
            self.left_out.append(f"the building in words: {error}")
            return None

    @property
    def base(self) -> AnalysisFile | None:
        """The project or the building whose analyses the archive has, as `project` and `building`."""
        return self.project or self.building

    @cached_property
    def provenance(self) -> dict[str, object]:
        """Moment, machine and versions of the run; {} if they are not archived."""
        return self.archive.group_attributes("provenance") if "provenance" in self.archive.names() else {}

    def text(self, name: str) -> str:
        """Return a text of the archive's root such as "project_text", "" if it is not there."""
        variable = self._root.variables.get(name)
        return str(variable.values) if variable is not None and variable.values.ndim == 0 else ""

    @cached_property
    def _root(self) -> Group:
        return self.archive.view()

    def pictures(self, *makers: Figures) -> tuple[Picture, ...]:
        """Draw the figures of functions that give (name, caption, figure) one after the other.

        One that cannot be drawn is named in `left_out`.
        """
        if not self._figures:
            return ()
        from edesign.report.drawing.style import garbage_between_figures
        from edesign.report.html.inline_svg import picture_of

        found = []
        with garbage_between_figures() as collect:
            for maker in makers:
                with self.or_left_out(maker.__name__.replace("_", " ")):
                    for name, caption, figure in maker(self.archive):
                        self._drawing(name)
                        with self.or_left_out(f"figure {name}"):
                            found.append(picture_of(self._unique(name), caption, figure))
                        del figure
                        collect()
        return tuple(found)

    def begin(self, step: Step) -> None:
        """Say that a section is begun; figures that are drawn from now on are of it."""
        self._step = step
        self._progress(step)

    def _drawing(self, name: str) -> None:
        """Say that a figure is drawn."""
        step = self._step
        self._progress(f"figure {name}" if step is None else Step(f"{step}: figure {name}", step.share))

    @contextmanager
    def or_left_out(self, what: str) -> Iterator[None]:
        """Note a figure that fails, and go on with the rest of the report."""
        with optional(what) as attempt:
            yield
        if attempt.failure is not None:
            self.left_out.append(f"{what}: {attempt.failure.reason}")


def drawn(name: str, figures: Callable[[], Iterable[tuple[str, str, Figure]]]) -> list[Part]:
    """Return figures as pictures; where one cannot be drawn, a warning that says why is the last part.

    Args:
        name: of them, for people.
        figures: gives name, caption and figure.
    """
    from edesign.report.html.inline_svg import picture_of

    found, words = list[Part](), name.strip("_").replace("_", " ")
    with optional(words) as attempt:
        found.extend(picture_of(*item) for item in figures())
    if attempt.failure is not None:
        found.append(Warnings(f"Not drawn: {words}", (attempt.failure.reason,)))
    return found


def by_level(pictures: Iterable[Picture], levels: Iterable[str]) -> dict[str, list[Picture]]:
    """Sort pictures by the hazard level that their names give; those that give none come under "".

    Args:
        pictures: figures of the page.
    """
    tokens = {level: f"_{file_name(level)}_" for level in levels if level}
    found: dict[str, list[Picture]] = {}
    for picture in pictures:
        at = next((level for level, token in tokens.items() if token in f"{picture.name}_"), "")
        found.setdefault(at, []).append(picture)
    return {level: found[level] for level in (*tokens, "") if level in found}


def first_of_each(pictures: Iterable[Picture], most: int = MOST_ALIKE) -> list[Part]:
    """Return drawings of the model, of each kind so many; the others are shown on demand.

    Args:
        pictures: figures of the page; those whose names differ in their ends are of a kind.
    """
    shown, others, counts = list[Part](), list[Picture](), Counter[str]()
    for picture in pictures:
        kind = _END.sub("", picture.name)
        counts[kind] += 1
        if counts[kind] > most:
            others.append(picture)
        else:
            shown.append(picture)
    return [*shown, Folded(f"More drawings of the model ({len(others)})", tuple(others))] if others else shown


def level_heading(level: str, levels: Collection[str]) -> Heading:
    """Return the heading of pictures of a level; those of none are of all, unless there are histories without one.

    Args:
        level: name of the hazard level; "" without levels.
        levels: names of the hazard levels.
    """
    return Heading(level or ("Without a hazard level" if "" in levels else "All levels"))


def headed(pictures: Iterable[Picture], levels: Collection[str]) -> list[Part]:
    """Return pictures below the names of their hazard levels, where there are several.

    Args:
        pictures: figures of the page.
    """
    sorted_pictures = by_level(pictures, levels)
    parts: list[Part] = []
    for level, several in sorted_pictures.items():
        parts += [level_heading(level, levels)] if len(sorted_pictures) > 1 else []
        parts += several
    return parts


def made_of(source: Source, makers: Iterable[Callable[[Source], Section]]) -> list[Section]:
    """Return the sections that have content; one that cannot be made says why.

    Args:
        source: the archive.
        makers: a function for each section, whose name is reported where it fails.
    """
    found, chosen = [], list(makers)
    for make, step in zip(chosen, steps([make.__name__ for make in chosen]), strict=True):
        source.begin(step)
        found.append(made(make.__name__, partial(make, source)))
    return [section for section in found if section]
