"""A thousand damaged and crafted copies of a real archive, each read by the commands in a process of its own.

    make pytest ARGS="-m study -k thousand_damaged -s"

prints how many ended with which exit code, for each kind of damage.
"""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from archive_mutants import CRAFTS, DAMAGES, PAGE, Ended, command, counted, crafted_copy, damaged_copy, zero_page
from cases.report_project import write_report_project
from unit.archive.archive_samples import archived_groups, write_layout_1

from edesign.archive.reader import open_archive
from edesign.archive.seal import LENGTH as SEAL_LENGTH
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.cli.main import main
from edesign.frame.project_file import load_project
from edesign.study.run.run import run_project

pytestmark = pytest.mark.study

EACH = 250  # of each of four archives: a thousand
LIMIT = 20.0  # s of CPU time; the whole archive takes below 2 s, its report below 10 s
REFERENCE = """edesign_reference: 1
title: Old report
tables:
  - title: Response
    kind: responses
    statistic: mean
    rows: [{measure: interstorey_drift, label: drift, unit: "%", values: {bare: {DBE: 1.0}, damped: {DBE: 0.5}}}]
"""
PATTERN = (*DAMAGES, *DAMAGES, *DAMAGES, *CRAFTS)


@pytest.fixture(scope="module")
def samples(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The archive of a real run: complete, just before its end, as earlier versions had it then, and in layout 1."""
    folder = tmp_path_factory.mktemp("thousand")
    project = load_project(write_report_project(folder))
    partial = partial_path(folder / "partial.h5")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ArchiveWriter, "discard", ArchiveWriter.close)  # which leaves the partial file
        run_project(project, folder / "partial.h5")
    whole = (folder / "partial.h5").rename(folder / "whole.h5")
    killed = partial_path(folder / "killed.h5")
    killed.write_bytes(whole.read_bytes()[:-SEAL_LENGTH])
    old = write_layout_1(folder / "old.h5", archived_groups(whole))
    (folder / "reference.yaml").write_text(REFERENCE, encoding="utf-8")
    for path in (whole, partial, killed, old):
        assert main(["show", str(path)]) == 0  # what the forks need is loaded then
    return {"whole": whole, "partial": partial, "killed": killed, "old": old}


@pytest.mark.parametrize("layout", ["whole", "partial", "killed", "old"])
def test_a_thousand_damaged_archives(samples: dict[str, Path], tmp_path: Path, layout: str) -> None:
    sample = samples[layout]
    mutant = tmp_path / sample.name
    commands = [["show"], ["compare", str(sample.parent / "reference.yaml")]]
    mutant.write_bytes(sample.read_bytes())
    right = [command(_words(words, mutant)).output for words in commands]
    ends: dict[str, list[Ended]] = defaultdict(list)
    for seed in range(EACH):
        kind, random = PATTERN[seed % len(PATTERN)], np.random.default_rng(seed)
        if layout == "partial" and kind in CRAFTS:
            continue  # it is no file of HDF5 that a library changes
        (crafted_copy if kind in CRAFTS else damaged_copy)(sample, mutant, kind, random)  # type: ignore[operator]
        for words, reported in zip(commands, right, strict=True):
            ended = command(_words(words, mutant), LIMIT)
            ends[kind.__name__].append(ended)
            where = f"{layout}, seed {seed}: {kind.__name__}, {words[0]}: {ended}"
            assert ended.code in (0, 4), where
            if layout == "whole":
                assert ended.code == 4, where
            elif layout == "killed" and kind in DAMAGES:
                assert ended.code == 4 or ended.output == reported, where
        if seed % 20 == 0:
            page = str(tmp_path / "page.html")
            ended = command(["report", "--quiet", "--output", page, str(mutant)], 3 * LIMIT)
            assert ended.code in (0, 4), f"{layout}, seed {seed}: {kind.__name__}, report: {ended}"
            ends["report"].append(ended)
    print(f"\n{layout}: {EACH} mutants, two commands each\n{counted(ends)}")


def test_every_page_of_a_complete_archive(samples: dict[str, Path], tmp_path: Path) -> None:
    content = samples["whole"].read_bytes()
    mutant = tmp_path / "a.h5"
    pages = [n for n in range(-(-len(content) // PAGE)) if any(content[n * PAGE : (n + 1) * PAGE])]
    for page in pages:
        mutant.write_bytes(zero_page(bytearray(content), page))
        with pytest.raises(Exception, match="damaged"):
            open_archive(mutant)
    print(f"\n{len(pages)} pages of zeros, all noticed")


def _words(words: list[str], path: Path) -> list[str]:
    return [words[0], str(path), *words[1:]]
