"""Groups in HDF5, in the form of netCDF-4: dimension scales, `units`, `long_name`. Only this package knows h5py."""

from __future__ import annotations

import h5py
import numpy as np

from edesign.archive.attributes import decode, encode
from edesign.archive.dataset import Group, Variable

# The oldest format that takes attributes above 64 kB (dense storage); newer ones mark an open file, and refuse it
# after a kill.
LIBRARY_VERSIONS = ("v108", "v108")
TEXT = h5py.string_dtype("utf-8")
BOOLEAN_MARK = "bool"  # xarray's convention: whole numbers with the attribute dtype = "bool"


def write_group(target: h5py.Group, group: Group) -> None:
    """Write a group's attributes, coordinates and variables into an empty HDF5 group.

    Raises:
        ValueError: a dimension has no coordinate, or lengths disagree (a mistake of the caller, not of the user).
    """
    for name, value in group.attributes.items():
        target.attrs[name] = encode(value)
    for name, coordinate in group.coords.items():
        if coordinate.dims != (name,):
            raise ValueError(f"coordinate {name} has dimensions {coordinate.dims}, not ({name!r},)")
        _write(target, name, coordinate).make_scale(name)
    for name, variable in group.variables.items():
        for axis, dimension in enumerate(variable.dims):
            if dimension not in group.coords:
                raise ValueError(f"{name}: dimension {dimension} has no coordinate")
            length, expected = variable.values.shape[axis], group.coords[dimension].values.shape[0]
            if length != expected:
                raise ValueError(f"{name}: {length} values along {dimension}, the coordinate has {expected}")
        dataset = _write(target, name, variable)
        for axis, dimension in enumerate(variable.dims):
            dataset.dims[axis].attach_scale(target[dimension])


def read_group(source: h5py.Group) -> Group:
    """Read one HDF5 group (not its subgroups) as it was written."""
    group = Group(attributes=read_attributes(source))
    for name, item in source.items():
        if isinstance(item, h5py.Dataset):
            (group.coords if item.is_scale else group.variables)[name] = _read(name, item)
    return group


def read_attributes(source: h5py.Group) -> dict[str, object]:
    """Read the attributes of one HDF5 group."""
    return {name: decode(value) for name, value in source.attrs.items()}


def library_versions() -> dict[str, str]:
    """Return the versions of h5py and of the HDF5 library."""
    return {"h5py_version": h5py.version.version, "hdf5_version": h5py.version.hdf5_version}


def _write(target: h5py.Group, name: str, variable: Variable) -> h5py.Dataset:
    values = np.asarray(variable.values)
    kind = values.dtype.kind
    if kind in "US" or kind == "O":
        dataset = target.create_dataset(name, data=values.astype(object), dtype=TEXT)
    elif kind == "b":
        dataset = target.create_dataset(name, data=values.astype(np.int8))
        dataset.attrs["dtype"] = BOOLEAN_MARK
    else:
        dataset = target.create_dataset(name, data=values)
    dataset.attrs["units"] = variable.unit
    dataset.attrs["long_name"] = variable.long_name
    return dataset


def _read(name: str, dataset: h5py.Dataset) -> Variable:
    if h5py.check_string_dtype(dataset.dtype) is not None:
        values = np.asarray(dataset.asstr()[()], dtype=str)
    else:
        values = np.asarray(dataset[()])
    if dataset.attrs.get("dtype") == BOOLEAN_MARK:
        values = values.astype(bool)
    if dataset.is_scale:
        dims: tuple[str, ...] = (name,)
    else:  # by the name that the scale was given: looking up its path would search the file
        dims = tuple(h5py.h5ds.get_scale_name(axis[0].id).decode() for axis in dataset.dims)
    unit = decode(dataset.attrs.get("units", ""))
    return Variable(dims, values, str(unit), str(decode(dataset.attrs.get("long_name", name))))
