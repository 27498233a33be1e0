"""The document in words: the lines of the cover."""

from __future__ import annotations

from collections.abc import Mapping

LINES = {
    "client": "Client",
    "project_number": "Project number",
    "author": "Author",
    "checker": "Checked by",
    "revision": "Revision",
    "date": "Date",
    "notes": "Notes",
}
"""Of the keys of `edesign.project.document.Document`, in the order of the cover."""


def cover_lines(said: object) -> tuple[tuple[str, str], ...]:
    """Return label and text of each line of the cover.

    Args:
        said: texts by the keys of the document, as an archive keeps them; anything else has no lines.
    """
    if not isinstance(said, Mapping):
        return ()
    return tuple((title, str(said[key])) for key, title in LINES.items() if said.get(key))
