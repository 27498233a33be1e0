"""The examples in the docstrings of the functions that `edesign` exports do what they show."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

import edesign

NAMES = ("calibrate", "fit_law", "make_project", "match_records", "response_spectra", "run_tests", "translate")


@pytest.mark.parametrize("name", NAMES)
def test_example_of_a_public_function(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    function = getattr(edesign, name)
    found = doctest.DocTestFinder(recurse=False).find(function, name, globs={"edesign": edesign})
    (example,) = (one for one in found if one.examples)
    said: list[str] = []
    failed, tried = doctest.DocTestRunner().run(example, out=said.append)
    assert tried and not failed, "".join(said)
