"""What a result is worth, given the truth of a laboratory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

FLOORS = 2.0  # times the noise floor, as a ratio of powers: for an error that is nothing but noise
READINGS = ("extremes",)
"""Readings of a law that a result may name among its effects. They count where the truth has them, nowhere else."""

NOT_COMPARED = ("temperature_law", "one_sided", "velocity_exponent")
"""Effects beside which the parameters of a law are a convention: the temperature at which they hold, the direction that
is the law's own, the velocity at which its viscous force is the law's."""


def judge(
    name: str,
    truth: Mapping[str, Any],
    result: Mapping[str, Any] | None,
    outcome: Mapping[str, Any],
    validate: Sequence[str],
) -> dict[str, Any]:
    """Judge one campaign.

    Args:
        name: of the campaign.
        truth: of the campaign.
        result: calibration.json; None: there is none.
        outcome: of the run (seconds, failure).
        validate: names of the tests to validate.

    Returns:
        The score. `first`, `all` are None where there is nothing to name. What an effect is as well (`parts` of the
        truth: a wandering zero is not nothing where a test begins) may be named too. `ratio` is the error on the tests
        to validate over the floor of the truth, both as powers, None where there is none. `inside` are the parameters
        of the law whose 95 % interval holds the true value, and all that were fitted, where the effects are those
        hidden and not others that are accepted for them: beside a lag, the stiffness is not that beside a flexible rig.
    """
    about = {
        "name": name,
        "kind": truth["category"].split("_")[0],
        "group": truth["group"],
        "law": truth["law"],
        "in_motion": bool(truth["tests_in_motion"]),
        "effects": [e["name"] for e in truth["effects"]],
        "seconds": outcome["seconds"],
        "failure": outcome["failure"],
        "floor": truth["noise_floor_validate"] ** 2,
    }
    if result is None:
        return about
    hidden = [{e["name"], *e.get("accept", ())} for e in truth["effects"]]
    parts = {part for e in truth["effects"] for part in e.get("parts", ())}
    nowhere = parts.union(READINGS).difference(*hidden)
    effects = [e for e in _told(result) if e["name"] not in nowhere]
    found = [e["name"] for e in effects]
    error = _error(truth, result, validate)
    true = [] if about["kind"] == "unlisted" else hidden
    right = about["kind"] != "unlisted" and matched([{e["name"]} for e in truth["effects"]], found)
    return {
        **about,
        "found": found,
        "forms": [e.get("form") for e in effects],
        "verdict": result.get("verdict"),
        "first": bool(found and any(found[0] in names for names in true)) if true else None,
        "all": matched(true, found) if true else None,
        "ratio": None if error is None else error / about["floor"],
        "inside": _inside(truth, result) if right else None,
    }


def _told(result: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """What a result names: its effects, the one fault of a test that disagrees, spikes that are left out of the fit.

    A report tells all three. Of several faults that one test may have none is named.
    """
    told = list(result.get("effects") or ())
    known = {(e["name"], e.get("form")) for e in told}
    faults = [test["faults"] for test in result.get("outlying_tests") or () if len(test["faults"]) == 1]
    told += [fault for (fault,) in faults if (fault["name"], fault["form"]) not in known]
    spikes = result.get("spikes") or {}
    return told + [{"name": "spikes", "form": channel} for channel, tests in spikes.items() if tests]


def _inside(truth: Mapping[str, Any], result: Mapping[str, Any]) -> list[int] | None:
    """How many parameters of the law have an interval that holds the true value, and how many were fitted.

    None where they are given otherwise: of the MGMM at 20 degC, and beside effects that share what the law does.
    """
    if truth["law"] == "mgmm" or any({e["name"], *e.get("accept", ())} & set(NOT_COMPARED) for e in truth["effects"]):
        return None
    fitted = result["parameters"].get("corrected") or result["parameters"]["refit"]
    true, declared = (dict(truth[key].get("parameters", truth[key])) for key in ("law_true", "law_declared"))
    if truth["law"] == "bouc_wen":
        # z has no unit of its own: the fit holds beta + gamma = A, so that z comes to 1
        size = (true.get("A", 1.0) / (true["beta"] + true["gamma"])) ** (1.0 / true["n"])
        true |= {"Fy": true["Fy"] * size, "Y": true["Y"] * size, "beta": true["beta"] * size ** true["n"]}
    if truth["law"] == "friction":  # the fit holds N
        true |= {"mu": true["mu"] * true["N"] / declared["N"]}
    intervals = {name: fitted[name]["interval"] for name in true if fitted.get(name, {}).get("standard_error")}
    return [sum(low <= true[name] <= high for name, (low, high) in intervals.items()), len(intervals)]


def matched(true: Sequence[set[str]], found: Sequence[str]) -> bool:
    """Whether the names found are those of the truth, each once, none left, in any order."""
    if len(true) != len(found):
        return False
    return not true or any(
        name in true[0] and matched(true[1:], [*found[:i], *found[i + 1 :]]) for i, name in enumerate(found)
    )


def at_floor(score: Mapping[str, Any]) -> bool:
    """Whether the error on the tests to validate is at most twice the floor."""
    return score["ratio"] is not None and score["ratio"] <= FLOORS


def _error(truth: Mapping[str, Any], result: Mapping[str, Any], validate: Sequence[str]) -> float | None:
    """Error on the tests to validate at the end, a share of power, put together as the truth's floor is.

    The tests are pooled by their samples; where the truth says that its floor is a mean over tests, so is the error.
    """
    errors = result.get("error") or {}
    for stage in ("corrected", "refit", "declared"):
        said = errors.get(stage) or {}
        if said.get("validate") is None:
            continue
        if "mean over tests" in str(truth.get("nrms_is", "")):
            each = [said.get("tests", {}).get(test) for test in validate]
            return sum(each) / len(each) if each and None not in each else None
        return float(said["validate"])
    return None
