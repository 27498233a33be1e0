"""Whether the result of an analysis counts: its energy balance closes, its numbers are finite, its geometry holds.

A frame that has run away in a computation says nothing about the building. It is not collapsed either: a collapse is a
state of equilibrium that was lost, found by a computation that is sound up to there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.validity import Validity
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.words import percent
from edesign.study.results.recording import Quantity
from edesign.study.results.storeys import drifts_in_words
from edesign.study.results.warnings import AnalysisWarning

AT = {
    "time": "at {:.6g} s",
    "load factor": "at a load factor of {:.4g}",
    "displacement": "at a roof displacement of {:.4g} m",
}
"""Where in a run, by what its steps are taken in."""


def rotation_names(frame: FrameModel, drifts: Quantity, others: Iterable[Quantity] = ()) -> dict[str, str]:
    """Return the channels that `largest_drift` limits, storey drifts and rotations of member ends, in words.

    A drift is the rotation of a column's chord, so that rotations in rad have the same limit.

    Args:
        drifts: on its column lines, as `line_drifts` gives them.
        others: quantities of an analysis; those in rad over columns or beams and their ends count.
    """
    words = drifts_in_words(frame)
    found = {key: f"the {words[i]}" for i, key in drifts.keys.items()}
    kinds = {"column": frame.of_kind("column"), "beam": frame.of_kind("beam")}
    for quantity in others:
        if quantity.unit == "rad" and quantity.dims[1:2] == ("end",) and quantity.dims[0] in kinds:
            members, of_each = kinds[quantity.dims[0]], math.prod(quantity.shape[1:])
            what = quantity.name.partition("_")[2].replace("_", " ")
            found |= {key: f"the {what} of {members[i // of_each].name}" for i, key in quantity.keys.items()}
    return found


def rotation_limits(project: AnalysisFile, names: Mapping[str, str]) -> dict[str, float]:
    """Return the limit of each channel of `rotation_names`.

    Args:
        names: as `rotation_names` gives them.

    Returns:
        The limit by name of the channel; empty where the geometry has no limit.
    """
    largest = project.largest_drift
    return {} if largest is None else dict.fromkeys(names, largest)


def judged(
    response: Response, project: AnalysisFile, names: Mapping[str, str], along: str = "time"
) -> tuple[Response, list[AnalysisWarning] | None]:
    """Return a response, failed if it is not valid, and the warnings about its energy balance.

    Warnings about a result that does not count are None: nothing more is to be said of its numbers.

    Args:
        response: of a run; one that ended at a limit is failed, or collapsed by what comes after.
        project: whose `validity` is asked.
        names: as `rotation_names` gives them.
        along: what the steps of the run are taken in, a key of `AT`.
    """
    if response.status == "interrupted":
        return response, []
    reason = _run_away(response, project, names, along)
    if reason:
        if response.status == "failed":
            reason = f"{reason}; {response.reason}"
        return replace(response, status="failed", reason=reason), None
    if response.status != "completed":
        return response, []
    return response, _energy_warnings(response, project.validity)


def _run_away(response: Response, project: AnalysisFile, names: Mapping[str, str], along: str) -> str:
    """Say why a result does not count, "" if it does."""
    validity = project.validity
    passed, largest = response.passed, project.largest_drift
    if passed is not None and passed.channel in names and largest is not None and abs(passed.value) > largest:
        drift = "drift" in names[passed.channel]
        value, limit = (percent(x) if drift else f"{x:.3g} rad" for x in (abs(passed.value), largest))
        return (
            f"{names[passed.channel]} reached {value} {AT[along].format(passed.time)}; the geometry of the model holds "
            f"up to {limit} (`validity.drift`) [E-VALID-01]"
        )
    if not response.finite:
        return "a result is not a finite number [E-VALID-02]"
    error = response.statistics.get("energy_error", 0.0)
    if not error <= validity.energy_error:
        return (
            f"the energy balance is wrong by {percent(error)} of the energy put in, more than "
            f"{percent(validity.energy_error)} (`validity.energy_error`); a smaller step may help [E-VALID-03]"
        )
    return ""


def _energy_warnings(response: Response, validity: Validity) -> list[AnalysisWarning]:
    error, limit = response.statistics.get("energy_error", 0.0), validity.energy_error_warning
    if error <= limit:
        return []
    text = (
        f"the energy balance is wrong by {percent(error)} of the energy put in, more than {percent(limit)} "
        "(`validity.energy_error_warning`); a smaller step may help"
    )
    return [AnalysisWarning("energy_error", text, error / limit)]
