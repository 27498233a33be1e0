"""Write the reference of the keys of all YAML files, docs/reference/keys, out of the models that read them."""

from __future__ import annotations

from pathlib import Path

from edesign.schema.keys import index_page, key_page
from edesign.schema.kinds import KINDS

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "reference" / "keys"


def pages() -> dict[str, str]:
    """Return the text of every page by its file name."""
    return {"README.md": index_page()} | {f"{name}.md": key_page(kind) for name, kind in KINDS.items()}


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
