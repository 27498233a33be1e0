"""What a result is worth, given the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from blind.quantities import compared

FLOORS = 2.0  # times the noise floor, for an error that is nothing but noise
VISIBLE = 3.0  # times the noise floor, for an effect that anybody can see

EQUAL: dict[tuple[str, str], tuple[str, ...]] = {
    ("static_offset", "hanging_mass"): ("offset",),
    ("offset", "force"): ("static_offset",),
}
"""Other names for a name and a form that are the same equation: the force of a mass that hangs is an offset of the
load cell."""

ORDER = ("right", "confounded", "equal", "late", "wrong", "nothing")
"""How an effect is named: right; as one its own result says cannot be separated from it; by another name of the same
equation, though it does not say so; right but not first; otherwise; not at all."""


def judge(truth: Mapping[str, Any], result: Mapping[str, Any] | None, outcome: Mapping[str, Any]) -> dict[str, Any]:
    """Judge one campaign.

    Args:
        truth: of the campaign.
        result: calibration.json; None: there is none.
        outcome: of the run (seconds, failure).
    """
    about = {
        **about_of(truth, outcome),
        "nrms": truth["nrms_of_effects"],
        "visible": visible(truth),
        "noise_floor": floor(truth),
    }
    if result is None:
        return about
    found = list(result.get("effects") or [])
    last = _last_error(result)
    own = result.get("noise_floor")
    return {
        **about,
        **found_in(result),
        "error": last,
        "own_floor": own,
        "at_own_floor": last is not None and own is not None and last <= FLOORS * own,
        "at_true_floor": last is not None and last <= FLOORS * floor(truth),
        "named": _named(truth["effects"], found),
        "all_named": _matched(truth["effects"], found, confounded=False),
        "all_named_or_confounded": _matched(truth["effects"], found, confounded=True),
        "surplus": max(0, len(found) - len(truth["effects"])),
        "parameters": [
            {"effect": e["name"], "form": e["form"], **p}
            for e in truth["effects"]
            for f in found
            if f.get("name") == e["name"]
            for p in compared(e, f)
        ],
    }


def about_of(truth: Mapping[str, Any], outcome: Mapping[str, Any]) -> dict[str, Any]:
    """What a score says whatever was found."""
    return {
        "number": truth["number"],
        "kind": truth["kind"],
        "effects": [[e["name"], e["form"]] for e in truth["effects"]],
        "seconds": outcome["seconds"],
        "failure": outcome["failure"],
    }


def found_in(result: Mapping[str, Any]) -> dict[str, Any]:
    """What a score says of a result, whatever is judged."""
    effects = result.get("effects") or []
    return {"found": [[e.get("name"), e.get("form")] for e in effects], "verdict": result.get("verdict")}


def floor(truth: Mapping[str, Any]) -> float:
    """Noise floor of the tests to validate, or that with the errors of displacement and thermometer if it is larger."""
    return max(truth["noise_floor"], truth["noise_floor_with_channels"])


def visible(truth: Mapping[str, Any]) -> bool:
    """Whether the effects stand out of the noise when the law's own parameters have done their best."""
    left = truth["nrms_after_refit"] if truth["law"]["refit"] else truth["nrms_of_effects"]
    return left is not None and left > VISIBLE * floor(truth)


def match(true: Mapping[str, Any], found: Mapping[str, Any]) -> str:
    """How an effect of a result names one of the truth: right, confounded, equal or wrong."""
    kinds = found.get("kind"), (found.get("may_be") or {}).get("kind")  # of either, as its own result says
    if found.get("name") == true["name"] and true["kind"] in kinds:
        return "right"
    if true["name"] in (found.get("indistinguishable_from") or ()):
        return "confounded"
    if found.get("name") in EQUAL.get((true["name"], true["form"]), ()):
        return "equal"
    return "wrong"


def _named(true: Sequence[Mapping[str, Any]], found: Sequence[Mapping[str, Any]]) -> str | None:
    """How the first effect of a result names one of the truth; None where there is nothing to name."""
    if not true:
        return None
    if not found:
        return "nothing"
    first = min((match(e, found[0]) for e in true), key=ORDER.index)
    if first == "wrong" and any(match(e, f) == "right" for e in true for f in found[1:]):
        return "late"
    return first


def _matched(true: Sequence[Mapping[str, Any]], found: Sequence[Mapping[str, Any]], confounded: bool) -> bool:
    """Whether the effects of the result are those of the truth, each once, none left, in any order."""
    if len(true) != len(found):
        return False
    if not true:
        return True
    good = ("right", "confounded", "equal") if confounded else ("right",)
    return any(
        match(true[0], f) in good and _matched(true[1:], [*found[:i], *found[i + 1 :]], confounded)
        for i, f in enumerate(found)
    )


def _last_error(result: Mapping[str, Any]) -> float | None:
    """Error on the tests to validate, at the end."""
    errors = result.get("error") or {}
    for stage in ("corrected", "refit", "declared"):
        value = (errors.get(stage) or {}).get("validate")
        if value is not None:
            return float(value)
    return None
