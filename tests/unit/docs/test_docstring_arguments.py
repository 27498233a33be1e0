"""Docstrings describe all arguments of what is exported, and elsewhere those that a signature does not say."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

import edesign
from tools.docstring_arguments import entries, needless

FUNCTIONS = [name for name in edesign.__all__ if inspect.isfunction(getattr(edesign, name))]


def test_no_argument_says_what_its_signature_says() -> None:
    """Each one that is listed can go: `python -m tools.docstring_arguments --remove`."""
    assert [f"{entry.path.name}: {entry.place}: {entry.text}" for entry in needless()] == []


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_of_an_exported_function_is_described(name: str) -> None:
    function = inspect.unwrap(getattr(edesign, name))
    described = [entry.place for entry in entries(Path(function.__code__.co_filename))]
    arguments = inspect.signature(function).parameters
    assert [one for one in arguments if f"{function.__name__}.{one}" not in described] == []
