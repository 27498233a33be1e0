"""What a wheel and a source distribution take along; tests/unit/packaging/test_wheel.py builds both."""

from __future__ import annotations

import tomllib
from fnmatch import fnmatch
from pathlib import Path

import pytest

from tools.wheel import tracked

ROOT = Path(__file__).parents[3]
CONFIG = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("ending", sorted({Path(name).suffix for name in tracked() if name.startswith("edesign/")}))
def test_every_kind_of_file_of_the_package_is_packaged(ending: str) -> None:
    """A new kind of data file must be named in pyproject.toml, or an installed edesign lacks it."""
    patterns = ["*.py", *CONFIG["tool"]["setuptools"]["package-data"]["*"]]
    names = [Path(name).name for name in tracked() if name.startswith("edesign/") and Path(name).suffix == ending]
    assert [name for name in names if not any(fnmatch(name, pattern) for pattern in patterns)] == []


def test_the_package_declares_to_type_checkers_that_it_has_types() -> None:
    assert (ROOT / "edesign" / "py.typed").exists() and "py.typed" in tracked_names("edesign")


def test_folders_with_data_are_packages_or_below_one() -> None:
    """setuptools looks for data files in packages alone: in a folder without modules it finds none."""
    found = {str(Path(name).parent) for name in tracked() if name.startswith("edesign/") and not name.endswith(".py")}
    modules = {str(Path(name).parent) for name in tracked() if name.startswith("edesign/") and name.endswith(".py")}
    namespaces = CONFIG["tool"]["setuptools"]["packages"]["find"].get("namespaces", True)
    assert namespaces or found <= modules


def test_every_folder_of_the_project_is_in_the_source_distribution() -> None:
    lines = (ROOT / "MANIFEST.in").read_text(encoding="utf-8").splitlines()
    grafted = {line.split()[1] for line in lines if line.startswith("graft ")}
    assert {name.split("/")[0] for name in tracked() if "/" in name} <= grafted | {"edesign"}


def tracked_names(folder: str) -> set[str]:
    """Names of the tracked files of a folder."""
    return {Path(name).name for name in tracked() if str(Path(name).parent) == folder}
