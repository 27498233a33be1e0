"""What designs are judged by beside the criteria of a study: braces hold their dampers, and the damping is reached."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import device_demand, force_of_each, names_of_dampers, names_of_history, place_forces
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.requirement import DEMAND_OVER_CAPACITY
from edesign.assess.sets import HistorySet
from edesign.assess.verdicts import Verdict
from edesign.codes.motion_sets import SetRules
from edesign.ground_motion.hazard import factor_of_level, rules_in_force
from edesign.project.dampers.designs import StrainEnergyDesign
from edesign.project.study.study import Study, own_variant

OF_DESIGN = "design"
"""The statistic of what no history says."""
CLAUSE = "EN 1993-1-1, 6.3.1"
NOTHING: Mapping[str, RaisedDevices] = MappingProxyType({})
NEARLY = 1e-3
"""Relative: what the digits in which a damping is told hide."""


@dataclass(frozen=True)
class HeldBraces:
    """The braces of a design under the histories of one variant at one level.

    Attributes:
        design: its name.
        found: the histories.
        asked: whether the braces are to hold at this level: their own one, or one below it.
        level: their own one.
        storeys: with dampers, (s,), of a placement those of its dampers.
        use: N_Ed / N_b,Rd there, (s,); None: no history was completed.
        statistic: over the motions.
    """

    design: str
    found: HistorySet
    asked: bool
    level: str
    storeys: np.ndarray
    use: np.ndarray | None
    statistic: str

    @property
    def where(self) -> str:
        """The storeys whose braces do not hold, and the largest use, in words; empty if all hold."""
        if self.use is None or not (self.use > 1.0).any():
            return ""
        beyond = ", ".join(str(storey) for storey in np.unique(self.storeys[self.use > 1.0]))
        return f"storey {beyond}, N_Ed / N_b,Rd up to {self.use.max():.3g}"


def brace_forces(
    design: Group,
    found: HistorySet,
    rules: SetRules,
    raised: RaisedDevices = RaisedDevices(),  # noqa: B008 - frozen
) -> np.ndarray | None:
    """Return N_Ed of one brace in each storey of a design under histories, (s,) N; None: no history was completed.

    Args:
        design: designs/NAME of an archive, whose braces have sections.
        rules: of the code in force, from how many motions on the mean counts.
        raised: factors of the code and the law, which give the factor of a storey by the stroke and velocity of its
            histories; where that is not known the factor of the estimate counts.
    """
    force = place_forces(found, np.asarray(design.coords["storey"].values), names_of_dampers(design), rules)
    if force is None:
        return None
    values = design.variables
    factor = _history_factor(design, found, rules, raised)
    return np.asarray(values["brace_share"].values * factor * force)


def _history_factor(design: Group, found: HistorySet, rules: SetRules, raised: RaisedDevices) -> np.ndarray:
    """Overstrength times the ratio of forces by the law at the demand of histories, (s,)."""
    estimated = np.asarray(design.variables["brace_force_factor"].values)
    own = design.attributes.get("brace_overstrength")
    demand = None if own is None or not raised.raises else device_demand(design, found)
    if demand is None:
        return estimated
    counted = demand.counted(rules)
    ratios = [raised.ratio(design, i, {name: of[i] for name, of in counted.items()}) for i in range(estimated.size)]
    return np.where(np.isnan(ratios), estimated, float(str(own)) * np.array(ratios))


def _placed_forces(design: Group, found: HistorySet, rules: SetRules) -> np.ndarray | None:
    """N_Ed of a brace of each damper of a placement that has one of a section, (s,) N; None: none was completed."""
    if not found.completed:
        return None
    names = names_of_history(next(iter(found.completed.values())))
    own = [names.index(str(name)) for name in design.coords["braced"].values]
    v = design.variables
    return np.asarray(v["braced_share"].values * v["braced_factor"].values * force_of_each(found, rules)[own])


def held_braces(
    designs: Mapping[str, Group],
    sets: Sequence[HistorySet],
    study: Study,
    raised: Mapping[str, RaisedDevices] = NOTHING,
) -> Iterator[HeldBraces]:
    """Yield the braces of each design that has sections, for each set of histories of a variant with its dampers.

    Args:
        designs: of the archive, by name.
        raised: factors of the code on the dampers of each design, and their law, by name.
    """
    rules, hazard = rules_in_force(study.base.hazard), study.base.hazard
    for name, design in designs.items():
        placed = "braced_section" in design.variables
        if not placed and "brace_section" not in design.variables:
            continue
        own, of = str(design.attributes.get("brace_level") or ""), raised.get(name, RaisedDevices())
        storeys = np.asarray(design.variables["braced_storey"].values if placed else design.coords["storey"].values)
        resistance = design.variables[f"{'braced' if placed else 'brace'}_resistance"].values
        for found in sets:
            variant = study.variants.get(own_variant(found.variant))
            if variant is None or name not in variant.designs or found.method is not None:
                continue
            below = False
            if hazard is not None and own and found.level:
                below = factor_of_level(hazard, found.level) < factor_of_level(hazard, own)
            forces = _placed_forces(design, found, rules) if placed else brace_forces(design, found, rules, of)
            use = None if forces is None else forces / resistance
            motions = len({found.motion_of[history] for history in found.completed})
            statistic = "mean" if motions >= rules.number_for_mean else "maximum"
            yield HeldBraces(name, found, below or found.level == own, own, storeys, use, statistic)


def brace_verdicts(
    designs: Mapping[str, Group],
    sets: Sequence[HistorySet],
    study: Study,
    raised: Mapping[str, RaisedDevices] = NOTHING,
) -> tuple[Verdict, ...]:
    """Return a verdict on the braces of each design, variant and level at which they are to hold.

    Args:
        designs: of the archive, by name.
        raised: factors of the code on the dampers of each design, and their law, by name.

    Source: EN 1993-1-1:2005, 6.3.1.
    """
    verdicts = []
    for one in held_braces(designs, sets, study, raised):
        if not one.asked:
            continue
        found, most = one.found, None if one.use is None else int(np.argmax(one.use))
        value = None if one.use is None or most is None else float(one.use[most])
        met = None
        if not found.not_run and found.histories:
            met = not found.failed and value is not None and value <= 1.0
        words = f"N_Ed <= N_b,Rd of the braces of design {one.design}, under its dampers with all factors"
        remark = "failed histories count as beyond the limit" if found.failed else one.where
        counts = len(found.completed), tuple(name for name in found.histories if name not in found.completed)
        verdicts.append(
            Verdict(
                f"braces of {one.design}",
                words,
                found.label,
                found.level,
                one.statistic,
                value,
                1.0,
                DEMAND_OVER_CAPACITY,
                met,
                remark,
                "",
                None if most is None else int(one.storeys[most]),
                "",
                *counts,
                motions=found.motions if found.motions < len(found.histories) else None,
                source=CLAUSE,
            )
        )
    return tuple(verdicts)


def damping_verdicts(designs: Mapping[str, Group], study: Study) -> tuple[Verdict, ...]:
    """Return a verdict on the damping that each design was asked for, for each variant of the file that has it.

    Args:
        designs: of the archive, by name.

    Source: thesis Eq. 5.6 for layers, complex modes for dashpots, Jacobsen (1930) for loops.
    """
    verdicts = []
    for name, design in designs.items():
        asked, rounds = design.attributes.get("damping_target"), design.variables.get("round_reached")
        if asked is None or rounds is None:
            continue
        limit = float(str(asked))
        value = float(rounds.values[int(str(design.attributes["chosen_round"])) - 1])
        alone = design.attributes.get("braces_in_target") is False
        of = "the dampers alone" if alone else "dampers and braces"
        spec = study.designs.get(name)
        storeys = isinstance(spec, StrainEnergyDesign) and spec.target_in == "storeys"
        to = "each storey by itself (thesis Eq. 5.9; that of modes differs)" if storeys else "the first mode"
        words = f"damping that {of} of design {name} add to {to}, at least the target"
        for variant, one in study.variants.items():
            if name in one.designs and variant not in study.derived:
                met = value >= (1.0 - NEARLY) * limit
                nothing = ("", None, "", 1, ())
                verdicts.append(
                    Verdict(
                        f"damping of {name}",
                        words,
                        variant,
                        "",
                        OF_DESIGN,
                        limit if met and value < limit else value,
                        limit,
                        "1",
                        met,
                        "" if met else "the warnings of the design say why",
                        *nothing,
                        motions=0,
                        from_below=True,
                        source="the design",
                    )
                )
    return tuple(verdicts)


def brace_warnings(
    designs: Mapping[str, Group],
    sets: Sequence[HistorySet],
    study: Study,
    raised: Mapping[str, RaisedDevices] = NOTHING,
) -> list[str]:
    """Return a sentence for each design, variant and level whose histories the braces do not hold.

    Histories count braces as elastic, so that those with more force than they hold are of another structure.

    Args:
        designs: of the archive, by name.
        raised: factors of the code on the dampers of each design, and their law, by name.
    """
    found = []
    for one in held_braces(designs, sets, study, raised):
        if one.where:
            at = ", ".join(filter(None, (one.found.variant, one.found.level)))
            level = f"; `level: {one.found.level}` of its `brace` asks for it" if one.found.level else ""
            why = "" if one.asked else f": they are to hold at {one.level} alone{level}"
            found.append(f"design {one.design}: the braces do not hold in {at}: {one.where}{why}")
    return found
