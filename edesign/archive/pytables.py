"""Arrays and tables of HDF5 files that PyTables and pandas wrote, without either of them."""

from __future__ import annotations

import os
import re

import h5py
import numpy as np

from edesign.archive.blosc import FILTER, decompress


def read_array(path: str | os.PathLike[str], place: str) -> np.ndarray:
    """Return a one-dimensional data set of an HDF5 file.

    Args:
        path: of the file.
        place: of the data set in it.

    Raises:
        KeyError: there is no such data set.
        OSError: the file cannot be read.
        ValueError: it is damaged, or has filters that are not known here.
    """
    with h5py.File(path, "r") as file:
        return _read(file[place])


def read_table(path: str | os.PathLike[str], place: str) -> dict[str, np.ndarray]:
    """Return the columns of a table that pandas wrote in its form `table`, each (rows,), by name.

    Args, Raises: as of `read_array`.

    Args:
        path: of the file.
        place: of the table in the file.
    """
    with h5py.File(path, "r") as file:
        item = file[place]["table"]
        rows = _read(item)
        columns: dict[str, np.ndarray] = {}
        for field in rows.dtype.names or ():
            if not field.startswith("values_block_"):
                columns[field] = rows[field]
                continue
            # a pickled list of texts, in the protocol of lines: `(lp0\nVDT\np1\naVNumPoints\np2\na.`
            names = re.findall(r"V(.*)\n", bytes(item.attrs[f"{field}_kind"]).decode("ascii"))
            columns |= {name: rows[field][:, i] for i, name in enumerate(names)}
        return columns


def _read(item: h5py.Dataset) -> np.ndarray:
    plan = item.id.get_create_plist()
    if [plan.get_filter(number)[0] for number in range(plan.get_nfilters())] != [FILTER]:
        return np.asarray(item[()])
    values = np.zeros(item.shape, item.dtype)
    for number in range(item.id.get_num_chunks()):
        first = item.id.get_chunk_info(number).chunk_offset
        passed_over, chunk = item.id.read_direct_chunk(first)
        content = np.frombuffer(chunk if passed_over else decompress(chunk), item.dtype)
        part = values[first[0] : first[0] + len(content)]
        part[...] = content[: len(part)]
    return values
