"""All recordings of a run and their fit to the spectrum as groups of the archive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.codes.ec8 import RuleCheck
from edesign.ground_motion.record_choice import RecordChoice
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import PairRecord, RecordSet, record_of
from edesign.study.motions.motions import (
    AnyMotion,
    Motion,
    first_periods_of_pairs,
    pair_fit,
    target_spectrum,
    turns,
)
from edesign.study.motions.pair_groups import pair_groups
from edesign.study.motions.pairs import PairMotion, judged_pairs
from edesign.study.motions.record_groups import criteria, record_group, suite_groups
from edesign.study.results.kinds import RECORDS


def project_record_groups(
    project: AnalysisFile,
    motions: Mapping[str, AnyMotion],
    first_periods: Callable[[], tuple[float, ...] | None],
    variant_periods: Mapping[str, Mapping[str, float]],
    warnings: Mapping[str, Sequence[str]],
) -> Iterator[tuple[str, Group]]:
    """Yield place and group of all recordings of a run, those of suites under their suite.

    Args:
        motions: its recordings, made ready, by reference.
        first_periods: gives T1 of the bare structure by direction, s.
        variant_periods: T1 of other frames that a suite acts on, s, by suite and name of the frame.
        warnings: what the user should know, by record of the project.

    Raises:
        AnalysisError: the period of the frame, which a criterion needs, cannot be found.
    """
    for order, name in enumerate(dict.fromkeys(record_of(reference) for reference in motions)):
        spec = project.records[name]
        if isinstance(spec, InSpace):
            ready = [motion for motion in motions.values() if isinstance(motion, PairMotion)]
            of_record = [motion for motion in ready if record_of(motion.name) == name]
            T_1 = first_periods_of_pairs(project, name, first_periods)
            pairs = judged_pairs(project, name, of_record, T_1, turns(project, name))
            yield from pair_groups(pairs, order, warnings.get(name, ()))
            continue
        of = {reference: motion for reference, motion in motions.items() if isinstance(motion, Motion)}
        if not isinstance(spec, RecordSet):
            group = record_group(of[name], order, warnings.get(name, ()))
            if spec.match is not None and spec.match.component == "vertical" and not of[name].failure:
                group.attributes["match_notes"] = [*group.attributes["match_notes"], "fitted to the vertical spectrum"]
            yield f"{RECORDS}/{name}", group
            continue
        members = [motion for reference, motion in of.items() if reference.startswith(f"{name}/")]
        target = target_spectrum(project, name) if project.hazard and spec.fitted else None
        verdicts: tuple[RuleCheck, ...] = ()
        if isinstance(spec, PairRecord):
            recordings = {motion.name: motion.found for motion in members}
            yield from suite_groups(
                name, members, target, (), order, warnings.get(name, ()), pair=pair_fit(project, name, recordings)
            )
            continue
        if target is not None:
            verdicts = criteria(members, target, first_periods(), variant_periods.get(name, {}))
        choice = project.record_choice(name)
        chosen = choice.facts() if isinstance(choice, RecordChoice) else None
        yield from suite_groups(name, members, target, verdicts, order, warnings.get(name, ()), chosen)
