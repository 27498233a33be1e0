"""The map of the packages is what the docstrings say, and leaves no folder out."""

from __future__ import annotations

from tools import package_map


def test_page_is_up_to_date() -> None:
    page = package_map.PAGE.read_text(encoding="utf-8")
    assert page == package_map.page(), "python tools/package_map.py writes docs/develop/map.md"


def test_every_package_and_module_says_what_it_is() -> None:
    assert package_map.without_docstring() == []


def test_every_folder_has_its_place() -> None:
    assert package_map.unplaced() == []
    assert all((package_map.ROOT / folder).is_dir() for folder in package_map.FOLDERS)
