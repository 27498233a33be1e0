"""The core has the parameters of laws as edesign/damper/laws.py has them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from edesign.core.damper import law_number
from edesign.damper.laws import LAWS
from tools.law_parameters import HEADER, header

PUBLIC = Path(__file__).parents[3] / "core_c" / "include" / "eddamper.h"


def test_header_of_the_core_is_of_this_table() -> None:
    assert HEADER.read_text(encoding="utf-8") == header(), "run `python -m tools.law_parameters` and build again"


def test_the_core_has_these_laws_and_no_other() -> None:
    numbers = re.findall(r"ED_LAW_(\w+) = (\d+)", PUBLIC.read_text(encoding="utf-8"))
    assert {name.lower(): int(number) for name, number in numbers} == {name: law_number(name) for name in LAWS}


@pytest.mark.parametrize("name", LAWS)
def test_public_header_names_the_parameters_in_their_order(name: str) -> None:
    law = LAWS[name]
    (comment,) = re.findall(rf"ED_LAW_{name.upper()} = \d+,?\s*/\* (.*?) \*/", PUBLIC.read_text(encoding="utf-8"))
    first, _, rest = comment.partition(", then ")
    words = re.split(r"[:(]", first)[0].split()
    assert words == [parameter.name for parameter in law.parameters]
    assert bool(rest) == bool(law.branch)
    assert rest.split()[: len(law.branch)] == [f"{parameter.name}_i" for parameter in law.branch]
