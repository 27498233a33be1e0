"""Every key is described, in the models alone, and the reference made of it is up to date."""

from __future__ import annotations

import re
from typing import Any

import pytest
import schema_files as files

from edesign import keys
from edesign.project.building.members import ColumnRun as BuildingColumnRun
from edesign.project.frame.frame import Frame
from edesign.project.frame.members import ColumnRun
from edesign.schema.kinds import KINDS
from tools import python_keys
from tools.docs_keys import FOLDER, pages

_BRIEF = 3


def _blocks(schema: dict[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """The blocks of a schema by name; a mapping of one response measure to its limit has no keys of its own."""
    found = [("", schema), *schema["$defs"].items()]
    return [(name, block) for name, block in found if "properties" in block and "minProperties" not in block]


@pytest.mark.parametrize("name", KINDS)
def test_every_key_is_described_in_a_sentence(name: str) -> None:
    for block, schema in _blocks(files.validator(name).schema):
        assert schema.get("description"), block
        for key, entry in schema["properties"].items():
            said = entry.get("description", "")
            assert len(said) >= _BRIEF and said.endswith("."), f"{block}.{key}: {said}"
            assert " None" not in said and "  " not in said, f"{block}.{key}: {said}"


def test_all_keys_together_are_those_of_the_format() -> None:
    blocks = {name: block for kind in KINDS for name, block in _blocks(files.validator(kind).schema)}
    keys = [key for block in blocks.values() for key in block["properties"]]
    assert len(keys) > 1200


def test_the_reference_of_keys_is_up_to_date() -> None:
    made = pages()
    kept = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")}
    assert sorted(kept) == sorted(made)
    old = [name for name, text in made.items() if kept[name] != text]
    assert not old, f"{', '.join(old)}: out of date; `make docs-keys` renews them"


def test_the_keys_for_python_are_up_to_date() -> None:
    assert python_keys.FILE.read_text(encoding="utf-8") == python_keys.text(), "`make docs-keys` renews edesign/keys.py"
    assert keys.ColumnRun(storeys="all", section="HEB240") == {"storeys": "all", "section": "HEB240"}
    for name, model in {"Frame": Frame, "ColumnRun": ColumnRun, "BuildingColumnRun": BuildingColumnRun}.items():
        assert set(getattr(keys, name).__annotations__) == set(model.model_fields), name


def test_links_inside_the_reference_lead_somewhere() -> None:
    for name, text in pages().items():
        headings = re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)
        anchors = [re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings]
        assert len(set(anchors)) == len(anchors), name
        for target in re.findall(r"\]\(([^)]+)\)", text):
            page, _, anchor = target.partition("#")
            assert anchor in anchors if not page else (FOLDER / page).is_file(), f"{name}: {target}"
