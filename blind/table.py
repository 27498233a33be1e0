"""Scores as a table for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

from blind.judge import ORDER

Score = dict[str, Any]


def summary(scores: Sequence[Score]) -> str:
    """All tables as text."""
    parts = [_overview(scores), _failures(scores)]
    clean = [s for s in scores if s["kind"] == "clean" and not s["failure"] and s["found"]]
    if clean:
        parts.append("False alarms on clean data\n" + "\n".join(f"  c{s['number']:03d}  {_names(s)}" for s in clean))
    one = [s for s in scores if s["kind"] == "one" and not s["failure"]]
    if one:
        parts.append(_groups("One effect, by effect", one, lambda s: s["effects"][0][0]))
        parts.append(_groups("One effect, by form", one, lambda s: " ".join(s["effects"][0])))
        wrong = [s for s in one if s["named"] != "right" or s["surplus"]]
        parts.append(_list("One effect, not as it should be", wrong))
    parts.append(_list("Two effects, not fully named", [s for s in _of(scores, "two") if not s["all_named"]]))
    parts.append(_list("Unlisted effects", _of(scores, "unlisted")))
    return "\n\n".join(part for part in parts if part)


def _of(scores: Sequence[Score], kind: str) -> list[Score]:
    return [s for s in scores if s["kind"] == kind and not s["failure"]]


def _overview(scores: Sequence[Score]) -> str:
    one, two, clean, unlisted = (_of(scores, kind) for kind in ("one", "two", "clean", "unlisted"))
    parameters = [p for s in scores if not s["failure"] for p in s["parameters"]]
    seconds = sorted(s["seconds"] for s in scores)
    seen, both = [s for s in one if s["visible"]], [s for s in two if s["visible"]]
    first = [s["named"] in ("right", "confounded") for s in one]
    rows = [
        ("campaigns", f"{len(scores)}"),
        ("failures of the program", f"{sum(bool(s['failure']) for s in scores)}"),
        ("clean: false alarms", _part([bool(s["found"]) for s in clean])),
        ("one effect: named right, first", _part([s["named"] == "right" for s in one])),
        ("  .. or reported as confounded", _part(first)),
        ("  .. right, of those above the noise after a refit", _part([s["named"] == "right" for s in seen])),
        ("  .. right and no other beside it", _part([s["all_named"] for s in one])),
        ("two effects: both named, no other", _part([s["all_named"] for s in two])),
        ("  .. or reported as confounded", _part([s["all_named_or_confounded"] for s in two])),
        ("  .. both named, of those above the noise", _part([s["all_named"] for s in both])),
        ("  .. one named right, first", _part([s["named"] == "right" for s in two])),
        ("unlisted: called explained", _part([s["verdict"] == "explained" for s in unlisted])),
        ("  .. of those above the noise", _part([s["verdict"] == "explained" for s in unlisted if s["visible"]])),
        ("validation at most 2 x own floor, listed effects", _part([s["at_own_floor"] for s in [*clean, *one, *two]])),
        (
            "validation at most 2 x true floor, listed effects",
            _part([s["at_true_floor"] for s in [*clean, *one, *two]]),
        ),
        ("parameters inside their 95 % intervals", _part([p["inside"] for p in parameters])),
    ]
    if seconds:
        rows.append(("seconds: median, longest", f"{seconds[len(seconds) // 2]:.0f}, {seconds[-1]:.0f}"))
    return "\n".join(f"{name:52s}{value}" for name, value in rows)


def _groups(title: str, scores: Sequence[Score], key: Callable[[Score], str]) -> str:
    head = (
        f"{'':44s}{'n':>4s}"
        + "".join(f"{word:>8s}" for word in ORDER)
        + f"{'seen':>6s}{'own':>5s}{'true':>5s}{'par.':>7s}{'s':>6s}"
    )
    lines = [title, head]
    for name in sorted({key(s) for s in scores}):
        group = [s for s in scores if key(s) == name]
        counts = Counter(s["named"] for s in group)
        inside = [p["inside"] for s in group for p in s["parameters"]]
        lines.append(
            f"  {name:42s}{len(group):4d}"
            + "".join(f"{counts[word] or '.':>8}" for word in ORDER)
            + f"{sum(s['visible'] for s in group):6d}{sum(s['at_own_floor'] for s in group):5d}"
            + f"{sum(s['at_true_floor'] for s in group):5d}{f'{sum(inside)}/{len(inside)}' if inside else '.':>7s}"
            + f"{sum(s['seconds'] for s in group) / len(group):6.0f}"
        )
    return "\n".join(lines)


def _list(title: str, scores: Sequence[Score]) -> str:
    if not scores:
        return ""
    lines = [title]
    for s in scores:
        hidden = " + ".join(" ".join(effect) for effect in s["effects"])
        error = "" if s["error"] is None else f"{100 * s['error']:.4f} %"
        lines.append(
            f"  c{s['number']:03d}  {hidden:52s} {100 * s['nrms']:7.3f} %{' ' if s['visible'] else '*'} "
            f"left {error:>10s}  floor {100 * s['noise_floor']:.4f} %  {s['verdict']}: {_names(s)}"
        )
    return "\n".join([*lines, "  (* below three times the noise after a refit of the law)"])


def _failures(scores: Sequence[Score]) -> str:
    failed = [s for s in scores if s["failure"]]
    return "\n".join(["Failures", *(f"  c{s['number']:03d}  {s['failure']}" for s in failed)]) if failed else ""


def _names(score: Score) -> str:
    return ", ".join(" ".join(str(word) for word in effect) for effect in score["found"]) or "none"


def _part(values: Sequence[bool]) -> str:
    return f"{sum(values)} of {len(values)}" if values else "-"
