"""The two parsers of PyYAML: its own, and that of libyaml, ten times as fast, which reads some texts otherwise."""

from __future__ import annotations

import re
from typing import Any

import yaml

_QUICK: Any = getattr(yaml, "CSafeLoader", None)
"""The parser of libyaml; None where PyYAML was built without it."""
_OTHERWISE = re.compile(r"[^\n -~]|[?!]|[|>][-+0-9]*#")
"""What libyaml reads otherwise in places: tabs, line ends and signs beyond ASCII, question and exclamation marks, and
comments at the head of a block of text without a space before them."""


def quick_parser(text: str) -> Any | None:
    """Return the parser of libyaml for a text of which it makes the same events, None for others.

    Its marks differ at scalars without text and at plain ones of several lines; a text that it refuses is for
    PyYAML's own parser, which may refuse it elsewhere.

    Args:
        text: of the YAML file.
    """
    return None if _OTHERWISE.search(text) else _QUICK
