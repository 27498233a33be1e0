"""Every law has a page in docs/reference/laws that names its parameters as they are, and a figure."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from edesign.damper.laws import LAWS
from edesign.damper.parameters import practical_unit

PAGES = Path(__file__).parents[3] / "docs" / "reference" / "laws"


@pytest.mark.parametrize("name", LAWS)
def test_page_has_all_parameters(name: str) -> None:
    law, text = LAWS[name], (PAGES / f"{name}.md").read_text(encoding="utf-8")
    table = re.findall(r"^\| `(\w+)` \| (.+?) \| (.+?) \| (.+?) \| (.+) \|$", text, re.M)
    rows = {name: tuple(cell.replace("`", "") for cell in cells) for name, *cells in table}
    parameters = law.with_branches(1 if law.branch else 0)
    assert list(rows)[: len(parameters)] == [parameter.name for parameter in parameters]
    for parameter in parameters:
        default = "-" if parameter.default is None else f"{parameter.default:g}"
        assert rows[parameter.name][:3] == (practical_unit(parameter) or "-", parameter.allowed, default)
        if parameter in law.parameters:  # of branches a page says more
            assert rows[parameter.name][3] == parameter.meaning
    assert law.source in " ".join(text.split())  # which a line may break
    for part in ("Temperature:", "Integration:"):
        assert f"\n{part}" in text


@pytest.mark.parametrize("name", LAWS)
def test_page_has_a_small_figure(name: str) -> None:
    assert f"figures/{name}.svg" in (PAGES / f"{name}.md").read_text(encoding="utf-8")
    figure = PAGES / "figures" / f"{name}.svg"
    assert 2_000 < figure.stat().st_size < 60_000
    assert "<dc:date>" not in figure.read_text(encoding="utf-8")


def test_index_links_to_every_page() -> None:
    index = (PAGES / "README.md").read_text(encoding="utf-8")
    linked = set(re.findall(r"\]\((\w+)\.md\)", index))
    assert linked == {page.stem for page in PAGES.glob("*.md")} - {"README"}
    assert set(LAWS) < linked
