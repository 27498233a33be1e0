"""The kinds of YAML files that have a schema, and the models that read them."""

from __future__ import annotations

from importlib import import_module

from pydantic import BaseModel

from edesign.errors import InputError
from edesign.file_kinds.kinds import CHECKED_KINDS, YAML_KINDS, FileKind
from edesign.project.reading.problems import did_you_mean, listed

KINDS = {kind.schema: kind for kind in (*YAML_KINDS, *CHECKED_KINDS) if kind.schema}
"""By the name of the schema; of kinds that have keys in common those with more of them stand first."""


def model_of(kind: FileKind) -> type[BaseModel]:
    """Import and return the model of a kind that has a schema."""
    module, _, name = kind.model.rpartition(".")
    found: type[BaseModel] = getattr(import_module(module), name)
    return found


def kind_named(name: str) -> FileKind:
    """Return a kind of file by the name of its schema.

    Raises:
        InputError: there is none.
    """
    if name not in KINDS:
        hint = did_you_mean(name, KINDS)
        raise InputError(f"there is no kind of file `{name}`{hint} (there are: {listed(KINDS, 30)}) [E-NAME-01]")
    return KINDS[name]
