"""What a result says of the rig, given the truth, and scores as a table."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from blind.judge import about_of, found_in
from blind.quantities import SI
from blind.substructure.plan import RIGS

CLOSE = 0.0003
"""s: by which a delay may be missed."""


def judge(truth: Mapping[str, Any], result: Mapping[str, Any] | None, outcome: Mapping[str, Any]) -> dict[str, Any]:
    """Judge one campaign.

    Args:
        truth: of the campaign.
        result: calibration.json; None: there is none.
        outcome: of the run (seconds, failure).
    """
    about = {**about_of(truth, outcome), "lag": truth["lag"]}
    if result is None:
        return about
    found = list(result.get("effects") or [])
    lags = [effect for effect in found if effect.get("name") == "lag"]
    lag = sum(lag_of(effect, truth) for effect in lags)
    return {
        **about,
        **found_in(result),
        "named": bool(lags),
        "found_lag": lag,
        "close": abs(lag - truth["lag"]) <= CLOSE,
        "effect_named": all(any(e.get("name") == hidden["name"] for e in found) for hidden in truth["effects"]),
    }


def lag_of(effect: Mapping[str, Any], truth: Mapping[str, Any]) -> float:
    """Delay of the force of slow motions that a lag of a result makes, s; weighted as that of the truth.

    Args:
        effect: of the result, whose form may be several, joined by " + ".
        truth: of the campaign.
    """
    given = effect.get("parameters") or {}
    forms = str(effect.get("form")).split(" + ")
    return sum(_of_form(form, "" if form == forms[0] else f"{form}.", given, truth) for form in forms)


def _of_form(form: str, prefix: str, given: Mapping[str, Any], truth: Mapping[str, Any]) -> float:
    def value(name: str) -> float:
        parameter = given[f"{prefix}{name}"]
        return SI[str(parameter.get("unit") or "")][0] * float(parameter["value"])

    if form == "filter":
        return value("time_constant")
    if form == "displacement_filter":
        return -value("time_constant")
    if form == "second_order":
        return value("zeta") / (math.pi * value("f"))
    late, weights = value("lag"), truth["weights"]
    if form.startswith("growing"):
        last = max(len(weights) - 1, 1)
        grown = [value("grown") * order / last + value("skew") * time for order, time in enumerate(truth["times"])]
        late += float(np.dot(weights, grown)) / sum(weights)
    if form.endswith("with_amplitude"):
        memory, memories = math.log(value("memory")), np.log(truth["memories"])
        amplitudes = [float(np.interp(memory, memories, each)) for each in truth["amplitudes"]]
        late += value("per_amplitude") * float(np.dot(weights, amplitudes)) / sum(weights)
    return late


def summary(scores: Sequence[Mapping[str, Any]]) -> str:
    """Scores as text: by rig, and what was missed."""
    done = [s for s in scores if not s["failure"]]
    late, prompt = [s for s in done if s["kind"] != "none"], [s for s in done if s["kind"] == "none"]
    rows = [
        ("campaigns, failures of the program", f"{len(scores)}, {len(scores) - len(done)}"),
        ("late: lag named", _part(late, "named")),
        (f"  .. and within {1e3 * CLOSE:g} ms", _part(late, "named", "close")),
        ("no lag: one named all the same", _part(prompt, "named")),
        ("effect of the damper named", _part([s for s in done if s["effects"]], "effect_named")),
    ]
    if scores:
        seconds = sorted(s["seconds"] for s in scores)
        rows.append(("seconds: median, longest", f"{seconds[len(seconds) // 2]:.0f}, {seconds[-1]:.0f}"))
    lines = [f"{name:40s}{value}" for name, value in rows]
    lines += ["", f"{'':20s}{'n':>4s}{'named':>7s}{'close':>7s}{'rms of the error, ms':>22s}"]
    for rig in RIGS:
        group = [s for s in done if s["kind"] == rig]
        named = [s for s in group if s["named"]]
        squares = [(1e3 * (s["found_lag"] - s["lag"])) ** 2 for s in named]
        error = f"{math.sqrt(sum(squares) / len(squares)):.3f}" if squares else "-"
        close = sum(s["close"] for s in named)
        lines.append(f"{rig:20s}{len(group):4d}{len(named):7d}{close:7d}{error:>22s}")
    amiss = [s for s in late if not (s["named"] and s["close"])] + [s for s in prompt if s["named"]]
    lines += ["", *(line(s) for s in amiss)] if amiss else []
    lines += [f"c{s['number']:03d}  {s['failure']}" for s in scores if s["failure"]]
    return "\n".join(lines)


def line(score: Mapping[str, Any]) -> str:
    """A score in a line."""
    hidden = "".join(f" + {' '.join(effect)}" for effect in score["effects"])
    about = f"c{score['number']:03d} {score['seconds']:5.0f} s  {score['kind']}{hidden}, {1e3 * score['lag']:.2f} ms: "
    if score["failure"]:
        return about + score["failure"]
    found = ", ".join(" ".join(str(word) for word in effect) for effect in score["found"]) or "nothing"
    return about + found + (f", {1e3 * score['found_lag']:.2f} ms" if score["named"] else "")


def _part(scores: Sequence[Mapping[str, Any]], *all_of: str) -> str:
    return f"{sum(all(s[key] for key in all_of) for s in scores)} of {len(scores)}"
