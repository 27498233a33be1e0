"""All declared tables by their names."""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages
from typing import Any

import edesign.report
from edesign.report.tables.table import TableSpec


def tables_by_name() -> dict[str, TableSpec[Any]]:
    """Return every declared table by its name, in the order of the names; they stand in the modules of the report.

    Raises:
        ValueError: two tables have one name.
    """
    modules = [import_module(one.name) for one in walk_packages(edesign.report.__path__, "edesign.report.")]
    found = {id(spec): spec for module in modules for spec in vars(module).values() if isinstance(spec, TableSpec)}
    names = sorted(spec.name for spec in found.values())
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError(f"tables of one name: {', '.join(sorted(twice))}")
    return {spec.name: spec for spec in sorted(found.values(), key=lambda spec: spec.name)}
