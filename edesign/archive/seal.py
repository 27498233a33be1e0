"""The seal of a complete archive: a line of text behind its HDF5 content, with the SHA-256 of every byte before it.

HDF5 checks its own structures and, where asked, chunks of data, but a page of zeros passes for data, and some of its
tables have no checksum. The seal reveals every changed byte before the library reads one. Readers of HDF5 do not
look behind the end that the file itself names, so the line is in nobody's way.
"""

from __future__ import annotations

import hashlib
import os
import re
from typing import BinaryIO

_SEAL = re.compile(rb"\nedesign archive seal: sha256 ([0-9a-f]{64}) of ([0-9]{20}) bytes\n")
LENGTH = 125  # bytes of the line
_BLOCK = 1 << 20


def seal_of(file: BinaryIO, size: int) -> bytes:
    """Return the seal of the first bytes of a file.

    Args:
        size: number of bytes that the seal covers.
    """
    return b"\nedesign archive seal: sha256 %b of %020d bytes\n" % (_sha256(file, size).encode(), size)


def sealed_size(file: BinaryIO) -> int | None:
    """Return the number of bytes that the seal at the end of a file covers; None without a valid seal.

    Args:
        file: open for reading.
    """
    size = file.seek(0, os.SEEK_END) - LENGTH
    if size <= 0:
        return None
    file.seek(size)
    found = _SEAL.fullmatch(file.read(LENGTH))
    if found is None or int(found[2]) != size or _sha256(file, size) != found[1].decode():
        return None
    return size


def _sha256(file: BinaryIO, size: int) -> str:
    digest = hashlib.sha256()
    file.seek(0)
    while size > 0:
        block = file.read(min(_BLOCK, size))
        if not block:
            break
        digest.update(block)
        size -= len(block)
    return digest.hexdigest()
