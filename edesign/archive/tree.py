"""The groups of an HDF5 file, read with care: only what an archive can contain, and no more than the file holds.

What is refused: links that lead elsewhere or in circles, data outside the file, types other than numbers and texts,
filters of others, and arrays longer than what the file holds of them can become. A file of a few kB can promise 24 GB
of zeros, or name another file.
"""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5ds, h5g, h5l, h5o, h5s, h5t, h5z

from edesign.archive.attributes import decode
from edesign.archive.checksum import CONTENT_CHECKSUM, content_checksum
from edesign.archive.dataset import Group, Variable
from edesign.archive.hdf5 import BOOLEAN_MARK, DIMENSIONS

FORMAT = 3  # version of the layout, in the root attribute `edesign_archive`
EXPANSION = {h5z.FILTER_FLETCHER32: 1, h5z.FILTER_SHUFFLE: 1, h5z.FILTER_DEFLATE: 1032}
"""Filters that an archive's data may have passed, and how many bytes one stored byte can become at most.

Source: zlib 1.3, "Technical Details": no stream of deflate expands more than 1032 times.
"""
DEEPEST = 8  # groups in each other; records/SUITE/ID are 3
_NUMBERS = (h5t.INTEGER, h5t.FLOAT)
_LARGEST_NUMBER = 8  # bytes
_DOUBLE = np.dtype("<f8")
_HDF5_SAYS = re.compile(r"(?:Unable to|Can't|Couldn't) .*? \((.*)\)", re.DOTALL)
_ERRORS = (OSError, RuntimeError, ValueError, LookupError, TypeError, MemoryError, OverflowError, NotImplementedError)
"""What h5py raises on damaged files."""


class Damaged(Exception):
    """A place of an archive cannot be read because it is damaged or no content of an archive.

    Attributes:
        place: path of the group, "" for the root.
        why: in words.
    """

    def __init__(self, place: str, why: str) -> None:
        super().__init__(f"{place or 'the root'}: {why}")
        self.place = place
        self.why = why


@dataclass
class Tree:
    """The groups of an open file.

    Args:
        file: open for reading.
        size: of the file, bytes.
        trusted: a seal has shown that every byte is as it was written; checksums of groups are then not computed.

    Attributes:
        layout: version of the layout; None if the file is none of edesign.

    Raises:
        Damaged: the root cannot be read.
    """

    file: h5py.File
    size: int
    trusted: bool
    layout: int | str | None = None
    _links: dict[str, dict[str, str]] = field(default_factory=dict)
    _owners: dict[int, str] = field(default_factory=dict)
    _held: dict[str, int] = field(default_factory=dict)
    _known: dict[str, tuple[h5g.GroupID, dict[str, Any], dict[str, tuple[str, ...]]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        with _reading(""):
            stored = self._attributes(self._open(""))
        found = decode(stored["edesign_archive"]) if "edesign_archive" in stored else None
        self.layout = found if found is None or isinstance(found, int) else str(found)
        if self.layout == 1 and CONTENT_CHECKSUM in stored:
            self.layout = FORMAT  # layout 1 has no checksums: the mark is not as it was written, as its checksum shows

    def has(self, path: str) -> bool:
        """Return whether something is at a path.

        Raises:
            Damaged: a group on the way to it is damaged.
        """
        parent, _, name = path.strip("/").rpartition("/")
        return (not parent or self.has(parent)) and (not name or name in self.links(parent))

    def links(self, place: str) -> dict[str, str]:
        """Return the names in a group, each with the reason why it must not be followed, "" where it may be.

        Raises:
            Damaged: it is no group, or is damaged.
        """
        place = place.strip("/")
        if place.count("/") >= DEEPEST:
            raise Damaged(place, f"groups in groups, {DEEPEST} deep")
        if place not in self._links:
            found: list[tuple[bytes, int, int]] = []
            with _reading(place):
                group = self._open(place)
                # the library does not bear an exception in what it calls, and uses one `link` for all
                group.links.iterate(lambda name, link: found.append((name, link.type, link.u)), info=True)
                names = [name.decode() for name, _, _ in found]
                self._links[place] = {
                    name: self._objection(f"{place}/{name}".strip("/"), kind, address)
                    for name, (_, kind, address) in zip(names, found, strict=True)
                }
        return self._links[place]

    def _objection(self, path: str, kind: int, address: int) -> str:
        """Why a link must not be followed: an archive has hard links only, and one for each object."""
        if kind != h5l.TYPE_HARD:
            return "a link to another place, which an archive cannot have"
        owner = self._owners.setdefault(address, path)
        return "" if owner == path else f"a second name of {owner or 'the root'}, which an archive cannot have"

    def groups(self, place: str, without: Container[str] = ()) -> list[str]:
        """Return the names of the groups in a group, by attribute `order`, then name.

        Args:
            without: places that are left out.

        Raises:
            Damaged: it, or one of them, is damaged.
        """
        found = []
        for name in self.links(place):
            below = f"{place}/{name}".strip("/")
            if below not in without:
                with _reading(below):
                    item = self._object(below)
                    if isinstance(item, h5g.GroupID):
                        found.append((self._order(item), name))
        return [name for _, name in sorted(found)]

    def attributes(self, place: str) -> dict[str, Any]:
        """Return the attributes of a group; without its variables, its checksum cannot be verified.

        Raises:
            Damaged: there is no such group, or it is damaged.
        """
        with _reading(place):
            if not self.trusted:
                return _decoded(self._attributes(self._open(place)))
            return dict(self._trusted(place)[1])

    def dimensions(self, place: str) -> dict[str, tuple[str, ...]]:
        """Return the dimensions of the variables of a group by their names, in the order in which it is read.

        Only of a trusted file: what it says of its variables is not verified.

        Raises:
            Damaged: there is no such group, or it cannot be read.
        """
        with _reading(place):
            return dict(self._trusted(place)[2])

    def values(self, place: str, name: str) -> np.ndarray:
        """Read the values of one variable of a group of a trusted file.

        Returns:
            An array of texts, or of numbers, which are in double precision.

        Raises:
            Damaged: there is no such variable, or it cannot be read.
        """
        with _reading(place), _about(name):
            return _in_double(self._values(self._data(place, name)))

    def labels(self, place: str, name: str) -> tuple[str, str]:
        """Read the unit and the long name of one variable of a group of a trusted file; see `values`.

        Returns:
            Unit and long name.
        """
        with _reading(place), _about(name):
            return self._labels(self._data(place, name), name)

    def _data(self, place: str, name: str) -> h5d.DatasetID:
        item = _opened(self._trusted(place)[0], name)
        if not isinstance(item, h5d.DatasetID):
            raise ValueError("this is a group, where data belong")
        return item

    def _trusted(self, place: str) -> tuple[h5g.GroupID, dict[str, Any], dict[str, tuple[str, ...]]]:
        """A group, its attributes, and dimensions of its variables; a trusted file never changes: read once."""
        place = place.strip("/")
        if place not in self._known:
            source = self._open(place)
            stored = self._attributes(source)
            dimensions = decode(stored.get(DIMENSIONS, "json:{}"))
            dims = {name: tuple(map(str, dimensions[name])) for name in self.links(place) if name in dimensions}
            self._known[place] = source, _decoded(stored), dims
        return self._known[place]

    def group(self, place: str) -> Group:
        """Read a group without its subgroups.

        Raises:
            Damaged: there is no such group, it is damaged, or holds what an archive cannot have.
        """
        place = place.strip("/")
        with _reading(place):
            source = self._open(place)
            stored = self._attributes(source)
            dimensions = decode(stored.get(DIMENSIONS, "json:{}"))
            group = Group(attributes=_decoded(stored))
            data, _, lost = self._sorted(place)
            if lost and (data if self.layout == 1 else any(name in dimensions for name in lost)):
                name, why = next(iter(lost.items()))
                raise ValueError(f"`{name}`: {why}")
            held = sum(self._held.values()) - self._held.get(place, 0)
            before = held
            for name, item in data.items():
                if name not in dimensions and self.layout != 1:
                    raise ValueError(f"`{name}` does not belong here")
                dims = tuple(map(str, dimensions[name])) if self.layout != 1 else None
                held += item.get_storage_size()
                if held > self.size:
                    raise ValueError(f"with `{name}`, the archive promises more data than the file holds")
                variable = self._variable(name, item, dims)
                (group.coords if variable.dims == (name,) else group.variables)[name] = variable
            _check_dimensions(group)
            if not self.trusted:
                self._check(stored, group)
            for items in (group.coords, group.variables):
                items.update({name: replace(item, values=_in_double(item.values)) for name, item in items.items()})
            self._held[place] = held - before
        return group

    def places(self, place: str = "") -> Iterator[str]:
        """Yield the places of all groups from one on, "" for the root; groups below a damaged group are not known."""
        yield place
        try:
            with _reading(place):
                data, groups, lost = self._sorted(place)
        except Damaged:
            return
        # beside data it was data, and stands for its group; else it was a group, to be named as what cannot be read
        for name in (*groups, *(() if data else lost)):
            yield from self.places(f"{place}/{name}".strip("/"))

    def _sorted(self, place: str) -> tuple[dict[str, h5d.DatasetID], list[str], dict[str, str]]:
        """Return the data in a group, the names of its groups, and of what cannot be opened, with the reason."""
        data: dict[str, h5d.DatasetID] = {}
        groups: list[str] = []
        lost: dict[str, str] = {}
        source = self._open(place)
        for name, objection in self.links(place).items():
            try:
                if objection:
                    raise ValueError(objection)
                item = _opened(source, name)
            except _ERRORS as error:
                lost[name] = _words(error)
            else:
                if isinstance(item, h5g.GroupID):
                    groups.append(name)
                else:
                    data[name] = item
        return data, groups, lost

    def _open(self, place: str) -> h5g.GroupID:
        item = self._object(place.strip("/"))
        if not isinstance(item, h5g.GroupID):
            raise ValueError("this is data, where a group belongs")
        return item

    def _object(self, place: str) -> Any:
        """Open an object by names that are known to be hard links."""
        if not place:
            root = h5g.open(self.file.id, b"/")
            self._owners.setdefault(h5o.get_info(root).addr, "")
            return root
        parent, _, name = place.rpartition("/")
        objection = self.links(parent).get(name, "there is nothing here")
        if objection:
            raise ValueError(objection)
        return _opened(self.file.id, place)

    def _order(self, group: h5g.GroupID) -> int:
        value = self._attribute(h5a.open(group, b"order")) if h5a.exists(group, b"order") else 0
        if not isinstance(value, (np.integer, int)):
            raise ValueError("`order` is not a whole number")
        return int(value)

    def _attributes(self, group: h5g.GroupID) -> dict[str, Any]:
        names: list[bytes] = []
        h5a.iterate(group, names.append)
        found = {}
        for name in names:
            try:
                found[name.decode()] = self._attribute(h5a.open(group, name))
            except _ERRORS as error:
                raise ValueError(f"attribute `{_text(name)}`: {_words(error)}") from error
        return found

    def _attribute(self, attribute: h5a.AttrID) -> Any:
        kind, shape = attribute.get_type(), attribute.shape
        if shape is None or len(shape) > 1:
            raise ValueError("a form that an archive cannot have")
        self._hold(math.prod(shape) * kind.get_size())
        if _is_text(kind):
            if shape:
                raise ValueError("several texts, which an archive cannot have")
            return str(_read_text(attribute, kind, shape).item())
        _check_number(kind)
        return _read_numbers(attribute, kind, shape)[()]

    def _text(self, item: h5d.DatasetID, name: bytes, default: str) -> str:
        return str(self._attribute(h5a.open(item, name))) if h5a.exists(item, name) else default

    def _variable(self, name: str, item: h5d.DatasetID, dims: tuple[str, ...] | None) -> Variable:
        with _about(name):
            values, labels = self._values(item), self._labels(item, name)
            return Variable(_scales(name, item) if dims is None else dims, values, *labels)

    def _values(self, item: h5d.DatasetID) -> np.ndarray:
        kind, shape = item.get_type(), item.shape
        if shape is None:
            raise ValueError("no values, which an archive cannot have")
        text = _is_text(kind)
        if not text:
            _check_number(kind)
        _check_storage(item, math.prod(shape) * kind.get_size())
        if text:
            return _read_text(item, kind, shape)
        values = _read_numbers(item, kind, shape)
        if values.dtype.kind in "iu" and self._text(item, b"dtype", "") == BOOLEAN_MARK:
            return values.astype(bool)
        return values

    def _labels(self, item: h5d.DatasetID, name: str) -> tuple[str, str]:
        return self._text(item, b"units", ""), self._text(item, b"long_name", name)

    def _hold(self, size: int) -> None:
        if size > self.size:
            raise ValueError(f"{size} bytes, more than the whole file")

    def _check(self, stored: dict[str, Any], group: Group) -> None:
        expected = stored.get(CONTENT_CHECKSUM)
        if self.layout == 1 or not (stored or group.coords or group.variables):
            return  # layout 1 has none, and neither has a group of groups alone
        if expected != content_checksum(stored, {**group.coords, **group.variables}):
            raise ValueError("its content is not as it was written (the checksum differs)")


def _opened(source: Any, path: str) -> h5g.GroupID | h5d.DatasetID:
    item = h5o.open(source, path.encode())
    if not isinstance(item, (h5g.GroupID, h5d.DatasetID)):
        raise ValueError("this is neither a group nor data")
    return item


@contextmanager
def _reading(place: str) -> Iterator[None]:
    """Turn what h5py raises into words, with the place."""
    try:
        yield
    except Damaged:
        raise
    except _ERRORS as error:
        raise Damaged(place.strip("/"), _words(error)) from error


def _decoded(stored: dict[str, Any]) -> dict[str, Any]:
    """Return the attributes that the group was given."""
    return {name: decode(value) for name, value in stored.items() if name not in (CONTENT_CHECKSUM, DIMENSIONS)}


@contextmanager
def _about(name: str) -> Iterator[None]:
    """Turn what h5py raises into words, with the name of the variable."""
    try:
        yield
    except _ERRORS as error:
        raise ValueError(f"`{name}`: {_words(error)}") from error


def _in_double(values: np.ndarray) -> np.ndarray:
    """Return numbers of single precision as those of double precision, with which all else goes on."""
    return values.astype(float) if values.dtype == np.float32 else values


def _scales(name: str, item: h5d.DatasetID) -> tuple[str, ...]:
    """Return the names of the dimension scales of a variable of layout 1."""
    if h5ds.is_scale(item):
        return (name,)
    scales = h5py.Dataset(item).dims  # by the name that each was given: looking up its path would search the file
    return tuple(h5ds.get_scale_name(axis[0].id).decode() for axis in scales)


def _words(error: BaseException) -> str:
    """What h5py says, without what it was about to do: `Unable to open object (wrong version)` is wrong version."""
    text = str(error.args[0] if isinstance(error, KeyError) and error.args else error) or type(error).__name__
    found = _HDF5_SAYS.fullmatch(text)
    return f"HDF5 says: {found[1]}" if found else text


def _text(name: bytes) -> str:
    return name.decode("utf-8", "backslashreplace")


def _is_text(kind: h5t.TypeID) -> bool:
    return bool(kind.get_class() == h5t.STRING)


def _check_number(kind: h5t.TypeID) -> None:
    if kind.get_class() not in _NUMBERS or kind.get_size() > _LARGEST_NUMBER:
        raise ValueError("a type of values that an archive cannot have")


def _check_storage(item: h5d.DatasetID, size: int) -> None:
    """Refuse data that lie elsewhere, or are longer than what the file holds of them.

    Raises:
        ValueError: with the reason.
    """
    plan = item.get_create_plist()
    layout, stored = plan.get_layout(), item.get_storage_size()
    if layout not in (h5d.COMPACT, h5d.CONTIGUOUS, h5d.CHUNKED) or plan.get_external_count():
        raise ValueError("its values lie in another file, which an archive cannot have")
    filters = [plan.get_filter(number)[0] for number in range(plan.get_nfilters())]
    foreign = [number for number in filters if number not in EXPANSION]
    if foreign:
        raise ValueError(f"its values passed a filter that is none of an archive (number {foreign[0]})")
    if size > stored * math.prod(EXPANSION[number] for number in filters):
        raise ValueError(f"it promises {size} bytes of values and holds {stored}")


def _read_numbers(item: h5a.AttrID | h5d.DatasetID, kind: h5t.TypeID, shape: tuple[int, ...]) -> np.ndarray:
    double = kind.equal(h5t.IEEE_F64LE)  # as most are: then h5py need not look for the types that fit each other
    values = np.empty(shape, _DOUBLE if double else kind.dtype)
    _read(item, values, kind if double else None)
    return values


def _read_text(item: h5a.AttrID | h5d.DatasetID, kind: h5t.TypeStringID, shape: tuple[int, ...]) -> np.ndarray:
    if kind.is_variable_str():  # layout 1
        values = np.empty(shape, kind.dtype)
        _read(item, values, None)
        decoded = [text.decode() if isinstance(text, bytes) else str(text or "") for text in values.ravel().tolist()]
        return np.array(decoded, dtype=str).reshape(shape)
    values = np.empty(shape, f"S{kind.get_size()}")
    _read(item, values, kind)
    return np.char.decode(values, "utf-8") if shape else np.array(values.item().decode())


def _read(item: h5a.AttrID | h5d.DatasetID, values: np.ndarray, kind: h5t.TypeID | None) -> None:
    if isinstance(item, h5a.AttrID):
        item.read(values, mtype=kind)
    elif values.size:
        item.read(h5s.ALL, h5s.ALL, values, kind)


def _check_dimensions(group: Group) -> None:
    """Check that every axis has a coordinate of its length.

    Raises:
        ValueError: one has not.
    """
    lengths = {name: coordinate.values.shape[0] for name, coordinate in group.coords.items()}
    for name, variable in group.variables.items():
        for dimension, length in zip(variable.dims, variable.values.shape, strict=True):
            if lengths.get(dimension) != length:
                raise ValueError(f"`{name}`: there is no coordinate `{dimension}` of {length} values")
