"""Arrays and tables of HDF5 files that PyTables and pandas wrote, without either of them.

Their values passed HDF5's filter Blosc, which h5py lacks: the plug-in is 190 MB, the package blosc 6 MB.
"""

from __future__ import annotations

import os
import re

import h5py
import numpy as np

_BLOSC = 32001  # its number among the registered filters of HDF5


def read_array(path: str | os.PathLike[str], place: str) -> np.ndarray:
    """Return a one-dimensional data set of an HDF5 file.

    Raises:
        KeyError: there is no such data set.
        OSError: the file cannot be read.
        ImportError: blosc, which the file needs, is not installed.
        ValueError: it is damaged, or has filters that are not known here.
    """
    with h5py.File(path, "r") as file:
        return _read(file[place])


def read_table(path: str | os.PathLike[str], place: str) -> dict[str, np.ndarray]:
    """Return the columns of a table that pandas wrote in its form `table`, each (rows,), by name.

    Args, Raises: as of `read_array`.
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
    if [plan.get_filter(number)[0] for number in range(plan.get_nfilters())] != [_BLOSC]:
        return np.asarray(item[()])
    import blosc  # no other file needs it

    values = np.zeros(item.shape, item.dtype)
    for number in range(item.id.get_num_chunks()):
        first = item.id.get_chunk_info(number).chunk_offset
        passed_over, chunk = item.id.read_direct_chunk(first)
        try:
            content = np.frombuffer(chunk if passed_over else blosc.decompress(chunk), item.dtype)
        except blosc.blosc_extension.error as error:
            raise ValueError(f"a damaged Blosc chunk: {error}") from error
        part = values[first[0] : first[0] + len(content)]
        part[...] = content[: len(part)]
    return values
