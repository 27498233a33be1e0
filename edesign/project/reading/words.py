"""Numbers and nouns in sentences for people."""

from __future__ import annotations


def counted(number: int, noun: str) -> str:
    """Return a number with its noun: `1 storey`, `3 storeys`, `2 tuned masses`.

    Args:
        number: how many there are.
        noun: in the singular.
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}{'es' if noun.endswith('ss') else 's'}"


def counted_are(number: int, noun: str) -> str:
    """Return the beginning of a sentence on some things: `1 beam is`, `3 beams are`.

    Args:
        number: how many there are.
        noun: in the singular.
    """
    return f"{counted(number, noun)} {'is' if number == 1 else 'are'}"


def percent(ratio: float) -> str:
    """Return a ratio in per cent, with its sign: `4.25 %`."""
    return f"{100.0 * ratio:.3g} %"


def a(noun: str) -> str:
    """Return a noun with its indefinite article."""
    return f"an {noun}" if noun[0] in "aeiou" else f"a {noun}"
