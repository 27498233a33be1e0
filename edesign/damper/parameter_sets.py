"""Published parameter sets of laws (data/parameter_sets.yaml)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

from edesign.project.reading.yaml_nodes import parse


@dataclass(frozen=True)
class ParameterSet:
    """Parameters of a law as published.

    Attributes:
        name: key in files.
        law: name of the law.
        values: by name, as text with unit.
        source: where they are printed.
        temperature: at which they hold, e.g. "20 degC".
        device: whose they are.
        tested: range of the tests for people, as in law files.
        notes: what to know before use.
    """

    name: str
    law: str
    values: Mapping[str, str]
    source: str
    temperature: str
    device: str
    tested: Mapping[str, str]
    notes: tuple[str, ...]


class _ParameterSets(Mapping[str, ParameterSet]):
    """The sets by name; the file is read when one is first asked for."""

    def __getitem__(self, name: str) -> ParameterSet:
        return _read()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_read())

    def __len__(self) -> int:
        return len(_read())


PARAMETER_SETS: Mapping[str, ParameterSet] = _ParameterSets()
"""Every set by its name."""


@cache
def _read() -> dict[str, ParameterSet]:
    text = resources.files("edesign.damper").joinpath("data/parameter_sets.yaml").read_text(encoding="utf-8")
    root, _ = parse(text)
    return {
        name: ParameterSet(
            name=name,
            law=entry["law"],
            values={key: str(value) for key, value in entry["parameters"].items()},
            source=entry["source"],
            temperature=entry["temperature"],
            device=entry["device"],
            tested=entry["tested"],
            notes=tuple(entry["notes"]),
        )
        for name, entry in root.plain().items()
    }
