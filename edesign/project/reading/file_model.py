"""The base of the models of whole files, which know where they and their parts stand."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

from pydantic import PrivateAttr

from edesign.errors import InputError
from edesign.notebook import facts_html, pictures_html
from edesign.project.reading.base import Model
from edesign.project.reading.problems import FileProblems, Problems, keys_text
from edesign.project.reading.values import KeyPath, changed_text, first_difference, shown
from edesign.project.reading.yaml_file import read_yaml_file
from edesign.project.reading.yaml_nodes import Node, find, parse

HEAD = ("title", "document")
"""Keys of a file that say what a report is called and for whom it is, and no result depends on."""


@dataclass(frozen=True)
class Reader:
    """Reads another text in the place of one that was read; equal for files that were read alike.

    Attributes:
        parse: returns the checked model of a text and a path.
        path: of the file.
        more: further arguments of `parse`.
        complete: returns a model, by the catalogue of sections, with what reading adds to it; None: nothing.
    """

    parse: Callable[..., Any]
    path: Path
    more: Mapping[str, Any]
    complete: Callable[[Any, Any], Any] | None = None

    def __call__(self, text: str, **changed: Any) -> Any:
        """Return the checked model of another text, with some of the further arguments changed."""
        return self.parse(text, self.path, **{**self.more, **changed})

    def completed(self, model: Any) -> Any:
        """Return a model with the values that reading adds to it, such as names of a catalogue."""
        return self.complete(model, self.more["profiles"]) if self.complete is not None else model


class FileModel(Model):
    """The content of a YAML file, with its place and its exact text.

    Text and values belong together: checksums and archives are of the text, analyses of the values. So values are
    changed by `with_values`, and `check_unchanged` refuses a copy that was changed in another way.
    """

    kind: ClassVar[str] = "file"
    """What it is, for messages."""

    _path: Path = PrivateAttr(default=Path())
    _text: str = PrivateAttr(default="")
    _root: Node | None = PrivateAttr(default=None)
    _read: Reader | None = PrivateAttr(default=None)
    _contents: dict[Path, bytes] = PrivateAttr(default_factory=dict)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._path.name}: {getattr(self, 'title', '')}>"

    def _repr_html_(self) -> str:
        keys = [name for name in type(self).model_fields if name in self.model_fields_set and name != "title"]
        rows = [(name, _in_short(getattr(self, name))) for name in keys]
        return facts_html(f"{getattr(self, 'title', '')} ({self._path.name})".strip(), rows) + pictures_html(self)

    def read_from(self, path: Path, text: str, root: Node, read: Reader | None = None) -> Self:
        """Set, once, the path and text that the model was read from.

        Args:
            root: the tree of the text.
            read: reads another text in its place, as this one was read.
        """
        self._path, self._text, self._root, self._read = path, text, root, read
        return self

    def with_values(self, values: Mapping[KeyPath, Any] | KeyPath, value: Any = None) -> Self:
        """Return the file with other values: its text is edited, read and checked again.

            project.with_values("materials.S275.E", "100 GPa")
            project.with_values({"frame.columns[0].section": "HEB300", "damping.ratio": "3 %"})

        Text, checksum and values of the result belong together, as those of a file. Comments stay; the file itself
        does not change. A key that may stand there and is missing is written.

        Args:
            values: new values by their places, which are written as in messages: `frame.columns[0].section`; or one
                place. A new name with points in it needs its keys one by one: ("materials", "S355.J2").
            value: the value at this one place: text with its unit, a number, a truth value, a list or a mapping.

        Raises:
            FileProblems: a place does not exist, or the file would be wrong; with file, line, column and nearest names.
            InputError: the copy was changed in another way before, or was not read from a file.
        """
        self.check_unchanged()
        assert self._read is not None
        wanted = values if isinstance(values, Mapping) else {values: value}
        problems = Problems(self.root)
        text = changed_text(self._text, self, wanted, problems)
        if problems.found:
            raise FileProblems(self._path, problems.found)
        changed: Self = self._read(text)
        return changed

    def check_unchanged(self) -> None:
        """Check that the values are those of the text.

        Raises:
            InputError: they are not; the message names the first place that differs.
        """
        if self._root is None or self._read is None:
            raise InputError(
                f"this {self.kind} was not read from a file or text; read it by `load_{self.kind}` [E-EDIT-01]"
            )
        found = first_difference(self, self._read.completed(type(self).model_validate(self._root.plain())))
        if found is not None:
            keys, mine, said = found
            place = keys_text(keys)
            raise InputError(
                f"{self.where(*keys)}: {place}: this copy of the {self.kind} has {shown(mine)} here, and its text says "
                f"{shown(said)}; change values by {self.kind}.with_values({place!r}, ...), which keeps text, checksum "
                "and values together [E-EDIT-01]"
            )

    def content(self, path: Path, read: Callable[[Path], bytes]) -> bytes:
        """Return the content of a file that this one names, as it was on its first reading.

        So checksum, archive and all analyses of a run are of one state of the file, on whatever machine they run.
        """
        if path not in self._contents:
            self._contents[path] = read(path)
        return self._contents[path]

    def lend_contents(self, taker: Callable[[Path, dict[Path, bytes]], None]) -> None:
        """Let a part that names files of its own share the folder and the contents of this file."""
        taker(self.folder, self._contents)

    def yaml_content(self, file: str, what: str) -> bytes:
        """Return the content of a YAML file that this one names, as `content`.

        Args:
            file: its path from the folder of this file.
            what: it is, for messages: "law file".

        Raises:
            InputError: it cannot be read.
        """
        return self.content(self.folder / file, lambda path: read_yaml_file(path, what))

    @property
    def path(self) -> Path:
        """The path of the file, as it was given."""
        return self._path

    @property
    def folder(self) -> Path:
        """The folder that the paths in the file are relative to."""
        return self._path.parent

    @property
    def text(self) -> str:
        """The exact text of the file."""
        return self._text

    def to_yaml(self, path: Path | str | None = None) -> str:
        """Return the exact text of the file, and write it if a path is given.

        Args:
            path: of the file to write; what is there is replaced. Files that it names are relative to its folder.

        Raises:
            InputError: the copy was changed otherwise than by `with_values`, or the file cannot be written.
        """
        self.check_unchanged()
        if path is not None:
            try:
                Path(path).write_text(self._text, encoding="utf-8", newline="\n")
            except OSError as error:
                raise InputError(f"{path}: the file cannot be written: {error.strerror} [E-FILE-06]") from None
        return self._text

    @property
    def checksum(self) -> str:
        """The SHA-256 of the text (UTF-8), hexadecimal."""
        return hashlib.sha256(self._text.encode("utf-8")).hexdigest()

    @property
    def analysis_checksum(self) -> str:
        """SHA-256 of the values that results may depend on: of all but `HEAD`, comments and layout."""
        said = self.root.plain()
        kept = {key: value for key, value in said.items() if key not in HEAD} if isinstance(said, dict) else said
        return hashlib.sha256(json.dumps(kept, default=str).encode("utf-8")).hexdigest()

    @property
    def root(self) -> Node:
        """The YAML tree of the file, for messages with places in it."""
        return self._root if self._root is not None else parse(self._text)[0]

    def where(self, *keys: str | int) -> str:
        """Return the place of a key path in the file as `file:line:column`.

        The keys are those on the way to the value, such as "analyses", 2, "record". Of a path that does not exist, the
        place is that of the nearest part that does.
        """
        if self._root is None:
            return str(self._path)
        mark = find(self._root, keys).mark
        return f"{self._path}:{mark.line}:{mark.column}"


def _in_short(value: Any) -> Any:
    """What notebooks show of a key: names of a mapping, the number of items of a list, keys of a part, or the value."""
    if isinstance(value, Model):
        return [name for name in type(value).model_fields if name in value.model_fields_set]
    if isinstance(value, Mapping):
        return list(map(str, value))
    if isinstance(value, (list, tuple)) and any(isinstance(item, Model) for item in value):
        names = [str(item.name) for item in value if getattr(item, "name", None)]
        return names if len(names) == len(value) else f"{len(value)} items"
    return value
