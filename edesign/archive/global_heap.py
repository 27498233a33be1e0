"""Collections of HDF5's global heap, where texts of variable length lie, are checked before the library reads them.

They alone among the library's structures have neither a checksum nor a bounded loop: a collection is a chain of
objects, each with its size, and a free object of size zero, as in a page of zeros, lets the library read the same
place for ever (HDF5 file format specification, version 3, III.E "Global Heap").
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterable, Iterator

from edesign.archive.seal import Readable
from edesign.archive.transaction import TransactionFile

SIGNATURE = b"GCOL\x01\0\0\0"  # with the version and the reserved bytes
_BLOCK = 1 << 20  # bytes that are searched at a time
_HEADER = 16  # bytes of a collection's header, and of that of an object
_OBJECT = struct.Struct("<HHIQ")  # index, references, reserved, size in bytes; index 0 is the free space


def broken_collections(file: Readable) -> list[int]:
    """Return the places of the collections whose chain of objects does not end at their end.

    Args:
        file: open for reading; lengths take 8 bytes in it, as in every archive.
    """
    size = file.seek(0, os.SEEK_END)
    return [place for place in _places(file) if not _sound(file, place, size)]


def _places(file: Readable) -> Iterator[int]:
    """Give the places of the signature, also where two blocks meet."""
    start, rest = 0, b""
    while True:
        file.seek(start)
        block = file.read(_BLOCK)
        if not block:
            return
        text, origin = rest + block, start - len(rest)
        found = text.find(SIGNATURE)
        while found >= 0:
            yield origin + found
            found = text.find(SIGNATURE, found + 1)
        start += len(block)
        rest = text[1 - len(SIGNATURE) :]


def disable(file: TransactionFile, places: Iterable[int]) -> None:
    """Make collections unreadable in a file in memory, so that the library reports an error for every text in them.

    Args:
        file: held in memory; the disk is not touched.
        places: offsets of the collections, bytes.
    """
    for place in places:
        file.seek(place)
        file.write(bytes(len(SIGNATURE)))


def _sound(file: Readable, start: int, size: int) -> bool:
    file.seek(start)
    header = file.read(_HEADER)
    length = int.from_bytes(header[len(SIGNATURE) :], "little")
    if len(header) < _HEADER or not _HEADER <= length <= size - start:
        return False
    objects = file.read(length - _HEADER)
    place = 0
    while len(objects) - place >= _HEADER:
        index, _, _, content = _OBJECT.unpack_from(objects, place)
        # the free space counts its header in its size, an object does not and is filled up to 8 bytes
        step = content if index == 0 else _HEADER + (content + 7) // 8 * 8
        if not _HEADER <= step <= len(objects) - place:
            return False
        place += step
    return True
