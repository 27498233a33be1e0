"""Tables of effects are those of the code, and every form of an effect has its equation and its words."""

from __future__ import annotations

import re

import pytest

from tools import effect_pages
from tools.effect_forms import Row

ROWS = {f"{row.form.name}.{row.name}": row for row in effect_pages.ROWS if effect_pages.page_of(row) == row.form.name}


def test_tables_are_those_of_the_code() -> None:
    old = [path.name for path, text in effect_pages.texts().items() if path.read_text(encoding="utf-8") != text]
    assert old == [], "python -m tools.effect_pages writes docs/reference/effects"


def test_every_form_has_its_equation_and_every_equation_its_form() -> None:
    pages = dict.fromkeys(map(effect_pages.page_of, effect_pages.ROWS))
    written = {effect for page in pages for effect in effect_pages.equations(page)}
    assert written == {(row.form.name, row.name) for row in effect_pages.ROWS}


@pytest.mark.parametrize("name", ROWS)
def test_every_parameter_has_its_meaning(name: str) -> None:
    row: Row = ROWS[name]
    text = (effect_pages.FOLDER / f"{row.form.name}.md").read_text(encoding="utf-8").partition("## Forms")[0]
    reported = set(re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE))
    assert {one.name for one, _, _ in row.parameters} <= reported


@pytest.mark.parametrize(
    ("form", "parameter", "prior", "bounds"),
    [
        # of edesign/calibration/dampers/effects, read by eye: a stiffness is the largest force over deformation
        ("payne.elastic", "k", "N(0, 0.6 F/u)", "-2 F/u to 2 F/u"),
        ("payne.whole", "a0", "ln N(0.4 u, 1.5)", "0.01 u to 10 u"),
        ("mullins.path", "recovery", "N(0.5, 0.5)", "0 to 1"),
        ("self_heating.rate", "beta", "N(0, 0.5 N/W)", "0 to 20 N/W"),
        ("inertia.mass", "mass", "N(0, 0.1 F/a)", "0 to 10 F/a"),
        # 0.3 over the seven steps between eight tests depends on no size alone
        ("ageing.linear", "rate", "N(0, 0.0429)", "-0.129 to 1.29"),
    ],
)
def test_priors_are_reported_in_sizes_of_the_campaign(form: str, parameter: str, prior: str, bounds: str) -> None:
    (found,) = ((of, reach) for one, of, reach in ROWS[form].parameters if one.name == parameter)
    assert found == (prior, bounds)
