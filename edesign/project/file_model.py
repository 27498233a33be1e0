"""The base of the models of whole files, which know where they and their parts stand."""

from __future__ import annotations

from pathlib import Path
from typing import Self

from pydantic import PrivateAttr

from edesign.project.base import Model
from edesign.project.yaml_nodes import Node, find, parse


class FileModel(Model):
    """The content of a YAML file, with its place and its exact text."""

    _path: Path = PrivateAttr(default=Path())
    _text: str = PrivateAttr(default="")
    _root: Node | None = PrivateAttr(default=None)

    def read_from(self, path: Path, text: str, root: Node) -> Self:
        """Tell the model, once, where it comes from; `root` is the tree of the text."""
        self._path, self._text, self._root = path, text, root
        return self

    @property
    def path(self) -> Path:
        """The file, as it was given."""
        return self._path

    @property
    def folder(self) -> Path:
        """The folder that the paths in the file are relative to."""
        return self._path.parent

    @property
    def text(self) -> str:
        """The exact text of the file."""
        return self._text

    @property
    def root(self) -> Node:
        """The YAML tree of the file, for messages with places in it."""
        return self._root if self._root is not None else parse(self._text)[0]

    def where(self, *keys: str | int) -> str:
        """`file:line:column` of a key path, e.g. where("analyses", 2, "record"); of the nearest part that exists."""
        if self._root is None:
            return str(self._path)
        mark = find(self._root, keys).mark
        return f"{self._path}:{mark.line}:{mark.column}"
