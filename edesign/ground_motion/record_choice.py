"""Records chosen out of a catalogue for the spectrum of a project."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from edesign.codes import Spectrum
from edesign.errors import InputError, split_code
from edesign.ground_motion.catalogue.candidate import Candidate, Refusal
from edesign.ground_motion.catalogue.folder import ENDINGS
from edesign.ground_motion.catalogue.gather import Catalogue, gather
from edesign.ground_motion.matching import MatchOptions
from edesign.ground_motion.selection import Selection, select, selection_periods
from edesign.ground_motion.selection_scaling import SelectionOptions
from edesign.project.records.chosen_records import ChosenRecords, FolderSource


@dataclass(frozen=True)
class RecordChoice:
    """Recording that was chosen for a record of a project, and how it is scaled.

    Attributes:
        candidates: the chosen ones by name, in the order of the names.
        selection: their factors, mean spectrum and criteria.
        T_1: for which they were chosen, s.
        T_1_given: the file says T_1; otherwise it is that of the frame.
        band: over which misfit counts, s.
        fit_band: that, widened to what the code checks, s.
        compared: how many candidates were compared.
        refused: what was left out before, and why.
        checksum: SHA-256 of all that the choice depends on, hexadecimal.
    """

    candidates: Mapping[str, Candidate]
    selection: Selection
    T_1: float
    T_1_given: bool
    band: tuple[float, float]
    fit_band: tuple[float, float]
    compared: int
    refused: tuple[Refusal, ...]
    checksum: str

    @property
    def factors(self) -> Mapping[str, float]:
        """The factor on each chosen recording, by its name."""
        return dict(zip(self.candidates, self.selection.factors.tolist(), strict=True))

    def facts(self) -> dict[str, Any]:
        """Return what an archive keeps of the choice.

        Returns:
            Values by attribute.
        """
        return {
            "T_1_s": self.T_1,
            "T_1_given": self.T_1_given,
            "band_s": list(self.band),
            "checksum": self.checksum,
            **choice_facts(tuple(self.candidates), self.selection, self.compared),
            "refused": [asdict(refusal) for refusal in self.refused],
        }


def choice_facts(names: Sequence[str], selection: Selection, compared: int) -> dict[str, Any]:
    """Return what is reported of a choice: factor of each recording by name, how near the mean is, out of how many.

    Args:
        names: of the chosen recordings.
        compared: how many candidates there were.
    """
    return {
        "compared": compared,
        "exhaustive": selection.exhaustive,
        "factors": dict(zip(names, selection.factors.tolist(), strict=True)),
        "common_factor": selection.common_factor,
        "deviation": selection.deviation,
        "largest_deviation": selection.largest_deviation,
        "scatter": selection.scatter,
        "not_met": [asdict(criterion) for criterion in selection.after.failed],
    }


def choice_lines(facts: Mapping[str, Any]) -> list[str]:
    """Return in sentences how a choice was made and how near the mean of its recordings is to the target.

    Args:
        facts: from `choice_facts`, and of a project's choice what the archive has beside them.
    """
    lines = []
    if "T_1_s" in facts:
        given = "given" if facts["T_1_given"] else "of the frame"
        low, high = facts["band_s"]
        lines.append(f"chosen for T_1 = {facts['T_1_s']:.4g} s ({given}) over periods from {low:.4g} s to {high:.4g} s")
    how = "all choices were compared" if facts["exhaustive"] else "greedy search with exchanges"
    lines.append(
        f"scaled mean / target - 1: {100 * facts['deviation']:.1f} % rms, {100 * facts['largest_deviation']:.1f} % at "
        f"most; scatter {100 * facts['scatter']:.0f} %; {how}"
    )
    lines += [
        f"scaled only, not met: {criterion['clause']}, {criterion['text']}: {criterion['value']:.3g}"
        for criterion in facts["not_met"]
    ]
    return lines


@dataclass(frozen=True)
class EarlierChoice:
    """Choice that an archive holds: if nothing has changed that it depends on, it need not be looked for again.

    Attributes:
        checksum: of the choice.
        names: of the chosen ones.
        exhaustive: every admissible choice was compared.
    """

    checksum: str
    names: tuple[str, ...]
    exhaustive: bool


def choose(
    spec: ChosenRecords, project: Path, target: Spectrum, T_1: float, earlier: EarlierChoice | None = None
) -> RecordChoice:
    """Choose records whose scaled mean is nearest to a spectrum; the same input gives the same choice.

    Args:
        spec: what the project file says.
        project: the project file, to which paths are relative.
        target: elastic spectrum at 5 % damping.
        T_1: fundamental period of the structure, s.
        earlier: the choice of an archive, which is taken if it depends on the same; the result is the same.

    Raises:
        InputError: the band of periods is empty, a folder, suite, flatfile or package cannot be read, or there are
            not enough candidates; the message says why others were left out.
    """
    widest = target.set_rules.period_band(T_1)
    low, high = widest if spec.periods is None else (period.at(T_1) for period in spec.periods)
    if low >= high:
        raise InputError(
            f"`periods` from {low:.4g} s to {high:.4g} s, with T_1 = {T_1:.4g} s, do not rise [E-MATCH-04]"
        )
    options = SelectionOptions(
        scaling=spec.scaling,
        scale_bounds=spec.scale_bounds,
        band=(low, high),
        scatter_weight=spec.scatter_weight,
        max_per_event=spec.max_per_event,
        max_per_station=spec.max_per_station,
    )
    fit_band = (min(widest[0], low), max(widest[1], high))
    periods = selection_periods(target.set_rules, T_1, options)
    found = gather(spec, project, periods, MatchOptions(method="scale", periods=fit_band))
    if not found.candidates:
        raise InputError(f"there are no candidates{_why(found.refused)}{_looked_for(spec, project)} [E-MATCH-07]")
    checksum = _checksum(found, periods, target, T_1, spec.choose, options)
    kept = list(range(len(found.candidates)))
    if earlier is not None and earlier.checksum != checksum:
        earlier = None
    if earlier is not None:
        kept = [i for i in kept if found.candidates[i].name in earlier.names]
    compared = [found.candidates[i] for i in kept]
    events, stations = [item.event for item in compared], [item.station for item in compared]
    try:
        chosen = select(
            periods, found.spectra[kept], found.pgas[kept], target, T_1, spec.choose, options, events, stations
        )
    except InputError as error:
        message, code = split_code(str(error))
        raise InputError(f"{message}{_why(found.refused)}{code}") from error
    if earlier is not None:
        chosen = replace(chosen, exhaustive=earlier.exhaustive)
    names = {compared[i].name: compared[i] for i in chosen.chosen}
    chosen = replace(chosen, chosen=tuple(kept[i] for i in chosen.chosen))
    return RecordChoice(
        candidates=names,
        selection=chosen,
        T_1=T_1,
        T_1_given=spec.T_1 is not None,
        band=(low, high),
        fit_band=fit_band,
        compared=len(found.candidates),
        refused=found.refused,
        checksum=checksum,
    )


def _checksum(
    found: Catalogue, periods: np.ndarray, target: Spectrum, T_1: float, count: int, options: SelectionOptions
) -> str:
    """SHA-256 of all that decides a choice beside the program: candidates, target, and how they are compared."""
    checksum = hashlib.sha256(f"{count} for T_1 = {T_1!r}: {options}\n".encode())
    checksum.update(target.acceleration(periods).astype("<f8").tobytes())
    checksum.update(np.float64(target.zero_period).tobytes())
    for candidate, samples in zip(found.candidates, found.checksums, strict=True):
        checksum.update(f"{candidate.name}\t{candidate.event}\t{candidate.station}\t{samples}\n".encode())
    return checksum.hexdigest()


def _looked_for(spec: ChosenRecords, project: Path) -> str:
    """Where files were looked for, and which."""
    folders = [str(project.parent / source.folder) for source in spec.sources if isinstance(source, FolderSource)]
    if not folders:
        return ""
    return f"\n    looked for in {', '.join(folders)} and all folders below: files that end in {', '.join(ENDINGS)}"


def _why(refused: tuple[Refusal, ...], most: int = 10) -> str:
    """What was left out, in lines of their own."""
    lines = [f"\n    left out: {refusal.name}: {refusal.reason}" for refusal in refused[:most]]
    if len(refused) > most:
        lines.append(f"\n    and {len(refused) - most} more")
    return "".join(lines)
