"""Five hundred building files with mistakes: each is refused with its place, or read; nothing breaks off or hangs.

    make pytest ARGS="-m study -k mutated_building -s"

prints how many commands ended with which exit code. What is read is also run, and, where it is small, extracted and
designed.
"""

from __future__ import annotations

import random
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
from building_examples import ANALYSED, DAMPED, ISOLATED
from cases.mutated_commands import TooLong, fault, outcome
from every_building_key import EVERY_KEY, HELD, OTHER_FORMS, RESTRAINED
from file_mutants import MUTATIONS, mutants
from pydantic import BaseModel

from edesign.project.building.building import Building
from edesign.project.reading.yaml_nodes import parse

PROJECTS = Path(__file__).parents[2] / "projects"
COUNT, SEED = 500, 1
SHARED = (
    "analyses",
    "dampers",
    "damping",
    "elements",
    "fibres",
    "hazard",
    "integration",
    "outputs",
    "records",
    "validity",
)
"""Blocks of projects, whose mutants have their keys."""
SMALL = ("every_key", "other_forms")
"""Files that are extracted and designed too: of few members, and with few evaluations."""


def texts() -> dict[str, str]:
    return {
        "thesis": (PROJECTS / "thesis_building" / "building.yaml").read_text(encoding="utf-8"),
        "office": (PROJECTS / "office_6_storeys" / "building.yaml").read_text(encoding="utf-8"),
        "every_key": EVERY_KEY,
        "other_forms": OTHER_FORMS,
        "held": HELD,
        "analysed": ANALYSED,
        "damped": DAMPED,
        "isolated": ISOLATED,
    }


def commands(kind: str, path: Path, folder: Path) -> Iterator[list[str]]:
    yield ["check", str(path)]
    if kind in ("analysed", "damped", "isolated"):
        return  # their histories take longer than a mutant is worth
    yield ["run", str(path), "--archive", str(folder / "run.h5"), "--overwrite", "--quiet"]
    if kind in SMALL:
        frame = ["--frame", "X3", "--output", str(folder / "frame.yaml"), "--overwrite"]  # it has no springs
        yield ["extract", str(path), *frame]
        yield ["design", str(path), "--output", str(folder / "designed.yaml"), "--overwrite", "-w", "1", "--quiet"]


@pytest.mark.study
def test_mutated_building_files_are_read_or_refused_with_a_place(tmp_path: Path) -> None:
    ends: Counter[tuple[str, int | str]] = Counter()
    wrong, slowest = [], 0.0
    for name, text in mutants(texts(), COUNT, SEED):
        path = tmp_path / f"{name.split()[0]}.yaml"
        path.write_text(text, encoding="utf-8", newline="")
        for words in commands(name.split()[1], path, tmp_path):
            begin = time.process_time()
            code, said = outcome(words)
            slowest = max(slowest, time.process_time() - begin)
            assert code != TooLong.__name__, f"{name}: {words[0]}"
            ends[words[0], code] += 1
            if why := fault(code, said, path):
                wrong.append(f"{name}: {words[0]} {why}: {said[-300:]}")
            if code:
                break
    print(f"\nslowest command {slowest:.1f} s of CPU time; {dict(sorted(ends.items(), key=str))}")
    assert not wrong, "\n".join(wrong)


def test_a_few_mutants_of_each_kind_are_refused_with_a_place(tmp_path: Path) -> None:
    """Of each mutation the first draws on the file with all keys, by `check` alone."""
    rnd = random.Random(7)
    for mutation in dict.fromkeys(MUTATIONS):
        for number in range(2):
            path = tmp_path / f"{mutation.__name__}{number}.yaml"
            path.write_text(mutation(EVERY_KEY, rnd), encoding="utf-8", newline="")
            code, said = outcome(["check", str(path)])
            assert not fault(code, said, path), f"{path.name}: {said}"


@pytest.mark.parametrize("kind", SMALL)
def test_the_files_themselves_are_right(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "building.yaml"
    path.write_text(texts()[kind], encoding="utf-8")
    assert outcome(["check", str(path)])[0] == 0
    code, said = outcome(["run", str(path), "--quiet"])
    assert code == 0, said


# ---- every key ----


def keys_written(text: str) -> set[str]:
    """Paths of the keys of a file, without numbers of lists and with `*` for names that the file gives itself."""

    def below(value: Any, path: str) -> Iterator[str]:
        if isinstance(value, dict):
            for key, part in value.items():
                yield f"{path}.{key}"
                yield from below(part, f"{path}.{key}")
        for part in value if isinstance(value, tuple) else ():
            yield from below(part, path)

    return set(below(parse(text)[0].plain(), ""))


def keys_known(model: type[BaseModel], path: str = "") -> Iterator[str]:
    """Paths of the keys of a model; below mappings with names of the file's own there are no further ones."""
    for name, field in model.model_fields.items():
        yield f"{path}.{name}"
        for part in models_in(field.annotation):
            yield from keys_known(part, f"{path}.{name}")


def models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    if getattr(annotation, "__origin__", None) is dict:
        return []
    return [model for part in get_args(annotation) for model in models_in(part)]


def test_the_two_forms_have_every_key_of_the_format() -> None:
    refused = {".hazard.behaviour_factor", ".design.systems.y.alpha_u_over_alpha_1"}  # of a building, of braced frames
    refused |= {f".loads.{part}.G2" for part in ("areas", "perimeter", "beams", "nodes")}  # by any code but NTC 2018
    known = {key for key in keys_known(Building) if key.split(".")[1] not in SHARED} - refused
    written = {key for text in (EVERY_KEY, OTHER_FORMS, HELD, RESTRAINED) for key in keys_written(text)}
    assert known - written == set()
