"""Collections of HDF5's global heap, where texts of variable length lie, are checked before the library reads them.

They alone among the library's structures have neither a checksum nor a bounded loop: a collection is a chain of
objects, each with its size, and a free object of size zero, as in a page of zeros, lets the library read the same
place for ever (HDF5 file format specification, version 3, III.E "Global Heap").
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator
from mmap import mmap

from edesign.archive.transaction import TransactionFile

SIGNATURE = b"GCOL\x01\0\0\0"  # with the version and the reserved bytes
_HEADER = 16  # bytes of a collection's header, and of that of an object
_OBJECT = struct.Struct("<HHIQ")  # index, references, reserved, size in bytes; index 0 is the free space


def broken_collections(content: bytes | mmap) -> Iterator[int]:
    """Give the places of the collections whose chain of objects does not end at their end.

    Args:
        content: of the file; lengths take 8 bytes in it, as in every archive.
    """
    place = content.find(SIGNATURE)
    while place >= 0:
        if not _sound(content, place):
            yield place
        place = content.find(SIGNATURE, place + 1)


def disable(file: TransactionFile, places: Iterable[int]) -> None:
    """Make collections unreadable in a file in memory, so that the library says so of every text in them."""
    for place in places:
        file.seek(place)
        file.write(bytes(len(SIGNATURE)))


def _sound(content: bytes | mmap, start: int) -> bool:
    if start + _HEADER > len(content):
        return False
    end = start + int.from_bytes(content[start + 8 : start + _HEADER], "little")
    if end > len(content):
        return False
    place = start + _HEADER
    while end - place >= _HEADER:
        index, _, _, size = _OBJECT.unpack_from(content, place)
        # the free space counts its header in its size, an object does not and is filled up to 8 bytes
        length = size if index == 0 else _HEADER + (size + 7) // 8 * 8
        if not _HEADER <= length <= end - place:
            return False
        place += length
    return True
