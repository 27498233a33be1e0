"""Scores as a table for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from blind.laboratories.judge import FLOORS, at_floor

Score = dict[str, Any]

COLUMNS: dict[str, Callable[[Score], bool]] = {
    "all": lambda s: True,
    "laws F": lambda s: s["group"] == "F",
    "laws H": lambda s: s["group"] == "H",
    "at rest": lambda s: not s["in_motion"],
    "motion": lambda s: s["in_motion"],
}


def line(score: Score) -> str:
    """One campaign in one line."""
    hidden = " + ".join(score["effects"]) or "nothing"
    about = f"{score['name']:15s} {score['seconds']:5.0f} s  {_word(score):8s} {hidden}: "
    if score["failure"]:
        return about + score["failure"]
    ratio = "no error given" if score["ratio"] is None else f"{score['ratio']:.3g} x floor"
    return f"{about}{_names(score)}; {score['verdict']}, {ratio}"


def summary(scores: Sequence[Score]) -> str:
    """The table: questions down, groups of laws and starts of tests across; then what is amiss, line by line."""
    parts = [[s for s in scores if of(s)] for of in COLUMNS.values()]
    rows = [_column(part) for part in parts]
    lines = [f"{'':34s}" + "".join(f"{name:>9s}" for name in COLUMNS)]
    lines += [f"{label:34s}" + "".join(f"{row[label]:>9s}" for row in rows) for label in rows[0]]
    amiss = [s for s in scores if _word(s) not in ("right", "-") or not (s["kind"] == "unlisted" or at_floor(s))]
    if amiss:
        lines += ["", f"Amiss, or above {FLOORS:g} times the floor", *(f"  {line(s)}" for s in amiss)]
    return "\n".join(lines)


def _column(scores: Sequence[Score]) -> dict[str, str]:
    ran = [s for s in scores if not s["failure"]]
    one, two, clean, unlisted = ([s for s in ran if s["kind"] == k] for k in ("one", "two", "clean", "unlisted"))
    seconds = sorted(s["seconds"] for s in scores)
    return {
        "campaigns": f"{len(scores)}",
        "failures of the program": f"{len(scores) - len(ran)}",
        "clean: false alarms": _part([bool(s["found"]) for s in clean]),
        "one effect: first is right": _part([s["first"] for s in one]),
        "  .. and nothing beside it": _part([s["all"] for s in one]),
        "two effects: both, no other": _part([s["all"] for s in two]),
        "unlisted: called explained": _part([s["verdict"] == "explained" for s in unlisted]),
        "validation at most 2 x floor": _part([at_floor(s) for s in [*clean, *one, *two]]),
        "parameters in their intervals": _shares([s["inside"] for s in [*clean, *one, *two] if s["inside"]]),
        "seconds: median": f"{seconds[len(seconds) // 2]:.0f}" if seconds else "-",
        "seconds: longest": f"{seconds[-1]:.0f}" if seconds else "-",
    }


def _word(score: Score) -> str:
    """How it went."""
    if score["failure"]:
        return "failed"
    if score["kind"] == "unlisted":
        return "wrong" if score["verdict"] == "explained" else "-"
    if score["kind"] == "clean":
        return "alarm" if score["found"] else "right"
    return "right" if score["all"] else "first" if score["first"] else "wrong"


def _names(score: Score) -> str:
    return ", ".join(f"{n} {f}" if f else n for n, f in zip(score["found"], score["forms"], strict=True)) or "none"


def _shares(counts: Sequence[Sequence[int]]) -> str:
    number = sum(all_of_it for _, all_of_it in counts)
    return f"{100.0 * sum(inside for inside, _ in counts) / number:.0f} %" if number else "-"


def _part(values: Sequence[bool]) -> str:
    return f"{sum(values)} of {len(values)}" if values else "-"
