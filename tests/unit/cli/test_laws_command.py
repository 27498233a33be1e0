"""`edesign laws`."""

from __future__ import annotations

import pytest

from edesign.cli.laws import laws
from edesign.damper.laws import LAWS
from edesign.errors import InputError


def test_list_names_every_law(capsys: pytest.CaptureFixture[str]) -> None:
    laws()
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[3 : 3 + len(LAWS)]] == list(LAWS)


def test_one_law(capsys: pytest.CaptureFixture[str]) -> None:
    laws("mgmm")
    text = capsys.readouterr().out
    assert "kN*(s/mm)^alpha" in text and "greater than 0 and at most 2" in text
    assert "thesis_table_4_2 (thesis Table 4.2, 20 degC)" in text and "4.24-4.29" in text
    laws("generalised_maxwell")
    assert "k2, c2 ..., 16 branches at most" in capsys.readouterr().out


def test_unknown_law() -> None:
    with pytest.raises(InputError, match="did you mean `friction`"):
        laws("frixion")
