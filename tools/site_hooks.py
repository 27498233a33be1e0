"""Hooks of mkdocs.yml: pages that the navigation does not name follow the pages of their folder."""

from __future__ import annotations

import re
import sys
from pathlib import Path, PurePosixPath
from typing import Any


def on_files(files: Any, config: Any) -> Any:
    """Append every page that no line of `nav` names to the section that holds the index of its folder.

    So the pages of laws and effects, one a law, need no line each, and a page that someone adds is never lost. They
    stand in the order in which the index links to them, those without a link at the end. A folder whose index is not
    named becomes a section of the folder above, under the heading of the index.

    Args:
        files: the files of the site (mkdocs.structure.files.Files).
        config: the configuration (mkdocs.config.defaults.MkDocsConfig); its `nav` is changed.

    Returns:
        The files as they are.
    """
    named = set(paths_in(config.nav))
    left = [file.src_uri for file in files.documentation_pages() if file.src_uri not in named]
    indexes = sorted(page for page in left if page.endswith("/README.md"))
    for page in indexes:
        heading = re.search(r"^# (.*)$", (Path(config.docs_dir) / page).read_text(encoding="utf-8"), re.MULTILINE)
        title = heading[1].replace("`", "") if heading else PurePosixPath(page).parent.name
        section_of(PurePosixPath(page).parent, config.nav).append({title: [page]})
    rest = [page for page in left if page not in indexes]
    for page in sorted(rest, key=lambda page: place_in_index(PurePosixPath(page), Path(config.docs_dir))):
        section_of(PurePosixPath(page).parent, config.nav).append(page)
    return files


def place_in_index(page: PurePosixPath, docs: Path) -> tuple[str, int, str]:
    """Where a page stands: its folder, the place of the first link to it in the folder's index, its name.

    Args:
        page: relative to docs.
        docs: the folder of all pages.

    Returns:
        A key to sort by; pages that the index does not link to come last.
    """
    index = docs / page.parent / "README.md"
    at = index.read_text(encoding="utf-8").find(f"]({page.name}") if index.exists() else -1
    return str(page.parent), at if at >= 0 else sys.maxsize, page.name


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
