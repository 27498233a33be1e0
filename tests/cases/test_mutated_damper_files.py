"""Studies of dampers and their projects with mistakes: each is refused with its place, or read; nothing breaks off.

Of placements, elastomers whose strain is followed, dampers that yield or slip, viscous ones and isolated bases.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from cases.conftest import HERE
from cases.mutated_commands import fault, outcome
from file_mutants import mutants

CASES = ("placement", "elastomer_strain", "hysteretic_dampers", "viscous_dampers", "isolated_frame")
FEW, MANY = 16, 60  # files of each case


def ends(case: str, count: int, seed: int, folder: Path, run: bool) -> list[str]:
    """What is wrong with the ends of commands on mutants of a case, one a line."""
    shutil.copytree(HERE / "records", folder / "records")
    shutil.copytree(HERE / case, folder / case)
    paths = {kind: folder / case / f"{kind}.yaml" for kind in ("study", "project")}
    texts = {kind: path.read_text(encoding="utf-8") for kind, path in paths.items()}
    wrong = []
    for name, text in mutants(texts, count, seed):
        for kind, path in paths.items():
            path.write_text(text if kind == name.split()[1] else texts[kind], encoding="utf-8", newline="")
        run_words = ["run", str(paths["study"]), "--archive", str(folder / "run.h5"), "--overwrite", "--quiet"]
        for words in [["check", str(paths["study"])], *([run_words] if run else [])]:
            code, said = outcome(words)
            # 3: a frame that gives way under gravity or in histories, a design that misses
            if why := fault(code, said, *paths.values(), allowed=(0, 2, 3)):
                wrong.append(f"{case} {name}: {words[0]} {why}: {said[-300:]}")
            if code:
                break
    return wrong


@pytest.mark.parametrize("case", CASES)
def test_a_few_mutants_are_read_or_refused_with_a_place(case: str, tmp_path: Path) -> None:
    assert ends(case, FEW, 5, tmp_path, run=False) == []


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_many_mutants_are_read_and_run_or_refused_with_a_place(case: str, tmp_path: Path) -> None:
    assert ends(case, MANY, 6, tmp_path, run=True) == []
