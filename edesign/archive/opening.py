"""Open the file of an archive for reading, so that nothing in it can do harm."""

from __future__ import annotations

import io
from dataclasses import dataclass, field
from pathlib import Path

import h5py

from edesign.archive.global_heap import without_broken_collections
from edesign.archive.hdf5 import LIBRARY_VERSIONS, join
from edesign.archive.pieces import find_pieces
from edesign.archive.seal import sealed_size
from edesign.archive.tree import Damaged, Tree

_MOST_CUT = 4  # sizes of a file; where more was cut off, there is next to nothing to be read


@dataclass
class Opened:
    """An open archive.

    Attributes:
        tree: its groups.
        sealed: whether a checksum has shown that every byte of them is as it was written.
        readable: number of groups that can be read; 0 where `sealed`.
        damage: why others cannot be, by their places.
    """

    tree: Tree
    sealed: bool
    readable: int = 0
    damage: dict[str, str] = field(default_factory=dict)


def open_file(path: Path) -> Opened:
    """Open a file.

    A complete archive has a seal, and each group of a partial one a checksum, and nothing of either is read before
    these are found right. What has neither, as it is damaged or of an earlier layout, is read from memory, every group
    once.

    Raises:
        OSError: the system cannot read it.
        Damaged: it is no file of HDF5, or its root is damaged.
    """
    with path.open("rb") as file:
        if (size := sealed_size(file)) is not None:
            return Opened(Tree(_sealed(path), size, trusted=True), sealed=True)
        file.seek(0)
        content = file.read()
    found = find_pieces(content)
    if found.places or found.damage:
        if "" not in found.places:
            raise Damaged("", next(iter(found.damage.values()), "it is not there"))
        images = ((place, content[start:stop]) for place, (start, stop) in found.places.items() if place)
        start, stop = found.places[""]
        with h5py.File(io.BytesIO(content[start:stop]), "r") as file:
            root = Tree(file, stop - start, trusted=True).group("")
        memory = io.BytesIO()
        with h5py.File(memory, "w", libver=LIBRARY_VERSIONS) as joined:
            join(joined, root, images)
        tree = Tree(h5py.File(memory, "r"), memory.seek(0, io.SEEK_END), trusted=True)
        return Opened(tree, True, len(found.places), found.damage)
    end = int.from_bytes(content[28:36], "little")  # of a superblock of version 2, with lengths of 8 bytes
    lost = end - len(content) if end <= _MOST_CUT * len(content) else 0
    memory = io.BytesIO(without_broken_collections(content + bytes(max(0, lost))))
    try:
        tree = Tree(h5py.File(memory, "r"), len(content), trusted=False)
    except (OSError, RuntimeError, ValueError) as error:
        raise Damaged("", "not an HDF5 file, or damaged") from error
    opened = Opened(tree, sealed=False)
    for place in tree.places() if tree.layout is not None else ():
        try:
            tree.group(place)
            opened.readable += 1
        except Damaged as error:
            opened.damage[place] = error.why
    return opened


def _sealed(path: Path) -> h5py.File:
    try:
        return h5py.File(path, "r", locking=False)
    except OSError as error:
        if "locking flag" not in str(error):
            raise
        return h5py.File(path, "r")  # open in this process already, with a lock, as xarray does: HDF5 wants the same
