"""Hooks of mkdocs.yml: pages that the navigation does not name follow the pages of their folder."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Any


def on_files(files: Any, config: Any) -> Any:
    """Append every page that no line of `nav` names to the section that holds the index of its folder.

    So the pages of laws and effects, one a law, need no line each, and a page that someone adds is never lost. A page
    whose folder has no section goes to the section of the folder above.

    Args:
        files: the files of the site (mkdocs.structure.files.Files).
        config: the configuration (mkdocs.config.defaults.MkDocsConfig); its `nav` is changed.

    Returns:
        The files as they are.
    """
    named = set(paths_in(config.nav))
    for page in sorted(file.src_uri for file in files.documentation_pages()):
        if page not in named:
            section_of(PurePosixPath(page).parent, config.nav).append(page)
    return files


def paths_in(nav: Any) -> list[str]:
    """Paths of the pages in a navigation, in their order."""
    if isinstance(nav, str):
        return [nav]
    return [path for entry in (nav.values() if isinstance(nav, dict) else nav) for path in paths_in(entry)]


def section_of(folder: PurePosixPath, nav: list[Any]) -> list[Any]:
    """The list of the navigation that begins with `FOLDER/README.md`, of the folder or the next one above.

    Args:
        folder: the folder of a page, relative to docs.
        nav: the navigation.

    Returns:
        The list itself, so that appending to it changes the navigation; at the top of docs the navigation.
    """
    if folder == PurePosixPath("."):
        return nav
    index = str(folder / "README.md")
    waiting = [nav]
    while waiting:
        entries = waiting.pop()
        if entries and entries[0] == index:
            return entries
        waiting += [
            value for entry in entries if isinstance(entry, dict) for value in entry.values() if isinstance(value, list)
        ]
    return section_of(folder.parent, nav)
