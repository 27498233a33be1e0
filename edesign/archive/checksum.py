"""SHA-256 of the content of a group, whatever the file stores it like."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from edesign.archive.dataset import Variable

CONTENT_CHECKSUM = "content_checksum"
"""Name of the attribute of a group that holds the checksum of everything else in it, without its subgroups."""


def content_checksum(attributes: Mapping[str, Any], variables: Mapping[str, Variable]) -> str:
    """Return the SHA-256 of attributes and variables as hexadecimal text.

    Args:
        attributes: as they are stored: texts, numbers, arrays of numbers.
        variables: coordinates too.
    """
    digest = hashlib.sha256()
    for name in sorted(attributes):
        if name != CONTENT_CHECKSUM:
            _add(digest, name, attributes[name])
    for name in sorted(variables):
        variable = variables[name]
        for part in (name, ",".join(variable.dims), variable.unit, variable.long_name):
            _add(digest, "", part)
        _add(digest, "values", variable.values)
    return digest.hexdigest()


def _add(digest: Any, name: str, value: Any) -> None:
    """Add a value with its type and shape, so that no two contents give the same bytes."""
    array = np.asarray(value)
    if array.dtype.kind in "UO":
        texts = [stored_text(str(text)) for text in array.ravel().tolist()]
        kind, content = "text", memoryview(b"".join(b"%d:%b" % (len(text), text) for text in texts))
    else:
        kind, content = array.dtype.str, np.ascontiguousarray(array).reshape(-1).view(np.uint8).data
    digest.update(stored_text(f"{name}\n{kind}{array.shape}{content.nbytes}\n"))
    digest.update(content)


def stored_text(text: str) -> bytes:
    r"""Return a text as UTF-8; what has no such form, as in names of files that are no text, is written `\udcff`."""
    return text.encode("utf-8", "backslashreplace")
