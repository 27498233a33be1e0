"""Commands whose modules are loaded when they are called: until then a name and a sentence stand for each."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from importlib import import_module
from typing import Any, ClassVar

import typer
from typer.core import TyperCommand, TyperGroup


class LazyCommand(TyperCommand):
    """A command in the place of one of the same name, which its module holds: a function, or a group of commands.

    Args:
        name: of the command, and of what the module holds.
        summary: the sentence that the help of the group shows; the first one of the command's own help.
    """

    def __init__(self, name: str, module: str, summary: str) -> None:
        super().__init__(name, help=summary)
        self._place = module, name

    @cached_property
    def loaded(self) -> Any:
        """The command itself."""
        module, name = self._place
        found = getattr(import_module(module), name)
        if isinstance(found, TyperGroup):
            return found
        app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        app.command(name)(found)
        return typer.main.get_command(app)

    def make_context(self, *arguments: Any, **settings: Any) -> Any:
        """Make the context of the command itself, which is asked for where it is called or its words are completed."""
        return self.loaded.make_context(*arguments, **settings)


class LazyGroup(TyperGroup):
    """A group of such commands, in the order of its help.

    Attributes:
        table: module and sentence of each command, by its name.
    """

    table: ClassVar[Mapping[str, tuple[str, str]]]

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands.update({name: LazyCommand(name, *place) for name, place in self.table.items()})
