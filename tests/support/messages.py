"""What tests ask of a message: its place and its code, while its sentence may change."""

from __future__ import annotations


def says(message: str, expected: str) -> bool:
    """Return whether every word of `expected`, such as `plan.x[1] E-VALUE-02`, is in a message."""
    return all(word in message for word in expected.split())
