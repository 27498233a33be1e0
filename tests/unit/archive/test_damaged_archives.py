"""Damaged and crafted archives end with exit code 4 and what can be read of them; none passes as whole."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from archive_mutants import (
    CRAFTS,
    DAMAGES,
    FAILURES,
    PAGE,
    Craft,
    Damage,
    Random,
    command,
    crafted_copy,
    damaged_copy,
    huge_data,
    in_fork,
    zero_page,
)
from shared_records import SHARED
from support.messages import says
from unit.archive.archive_samples import history_group, write_layout_1
from unit.assess.known_history import known_history, known_modes

from edesign.archive.dataset import Group
from edesign.archive.global_heap import SIGNATURE, without_broken_collections
from edesign.archive.pieces import find_pieces
from edesign.archive.reader import DamagedArchive, open_archive, read_archive
from edesign.archive.seal import LENGTH as SEAL_LENGTH
from edesign.archive.tree import EXPANSION
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.errors import ArchiveError, EdesignError
from edesign.project.study.reference_loader import load_reference
from edesign.report.archive.tables import overview
from edesign.report.comparison.compare import compare
from edesign.report.comparison.tables import block_tables

HANDED = SHARED.parent / "cases" / "damaged_archive.h5"
REFERENCE = """edesign_reference: 1
title: Old report
tables:
  - title: Modes
    kind: variables
    group: analyses/modes
    over: mode
    rows: [{variable: period, label: T, unit: s, values: [0.8, 0.25]}]
  - title: Response
    kind: responses
    statistic: mean
    rows: [{measure: roof_displacement, label: roof, unit: m, values: {bare: {DBE: 0.2}}}]
"""


def sample_groups() -> dict[str, Group]:
    """What an archive of edesign holds, small: modes, two histories, longer ones in chunks, and a text."""
    root = Group(attributes={"title": "Two storeys", "planned": ["modes", "a", "b", "long"], "project_file": "p.yaml"})
    root.add("project_text", (), "edesign: 1\n" * 40, "", "the project file")
    groups = {"": root, "provenance": Group(attributes={"created": "2026-01-01"})}
    groups |= {"analyses/modes": known_modes(), "analyses/a": known_history(), "analyses/b": known_history()}
    groups["analyses/long"] = history_group(3000)
    for order, place in enumerate([place for place in groups if place.startswith("analyses")]):
        groups[place].attributes |= {"order": order, "name": place, "variant": "bare", "level": "DBE"}
        groups[place].attributes["input_pga_m_s2"] = 3.0
    return groups


@pytest.fixture(scope="module")
def samples(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The same content complete, partial, as an earlier version left it of a run that was killed, and in layout 1."""
    folder, groups = tmp_path_factory.mktemp("samples"), sample_groups()
    with ArchiveWriter(folder / "whole.h5", groups[""]) as writer:
        for place, group in groups.items():
            if place:
                writer.write(place, group)
        partial = folder / "partial.h5.partial"
        partial.write_bytes(partial_path(folder / "whole.h5").read_bytes())
        whole = writer.finish({"status": "completed"})
    killed = folder / "killed.h5.partial"
    killed.write_bytes(whole.read_bytes()[:-SEAL_LENGTH])
    old = write_layout_1(folder / "old.h5", sample_groups())
    (folder / "reference.yaml").write_text(REFERENCE, encoding="utf-8")
    return {"whole": whole, "partial": partial, "killed": killed, "old": old}


def use(path: Path) -> tuple[str, str]:
    """Return what `show` and `compare` print of an archive, with all its groups, and the line on its damage."""
    reference = load_reference(path.parent / "reference.yaml")

    def read(archive: object) -> str:
        tables = [*overview(archive), *block_tables(compare(archive, reference), bars=True)]  # type: ignore[arg-type]
        return "\n".join(f"{table.title} {table.rows} {table.notes}" for table in tables if table.title)

    return read_archive(path, read)


def outcomes(
    sample: Path, folder: Path, spoil: Callable[[Path, Random], None], seeds: range
) -> list[tuple[int | str, str]]:
    """Return the exit code and what was printed for each mutant, from a fork; ("hung", "") if it does not end."""
    (folder / "reference.yaml").write_text(REFERENCE, encoding="utf-8")

    def work() -> str:
        found: list[tuple[int | str, str]] = []
        for seed in seeds:
            mutant = folder / sample.name
            spoil(mutant, np.random.default_rng(seed))
            try:
                text, damage = use(mutant)
                found.append((4 if damage else 0, text))
            except EdesignError as error:
                found.append((error.exit_code, str(error)))
            except Exception as error:
                found.append((1, repr(error)))
        return json.dumps(found)

    said = in_fork(work, limit=120.0)
    return [(said, "")] if said in FAILURES else json.loads(said)


def without_path(text: str, path: Path) -> str:
    return text.replace(str(path.parent), "")


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize(
    "layout", ["whole", "partial", *(pytest.param(of, marks=pytest.mark.slow) for of in ("killed", "old"))]
)
def test_damage_is_noticed(samples: dict[str, Path], tmp_path: Path, layout: str, damage: Damage) -> None:
    """A complete archive: always. Otherwise what is printed is what it was, as nothing reads the place.

    At the end of a partial archive nothing separates damage from what a kill left, and a group less is listed there.
    Layout 1 has no checksum of numbers and texts, so that other ones may be printed there.
    """
    sample = samples[layout]
    right = without_path(use(sample)[0], sample)
    found = outcomes(sample, tmp_path, lambda path, random: damaged_copy(sample, path, damage, random), range(2))
    codes = Counter(code for code, _ in found)
    assert set(codes) <= ({4} if layout == "whole" else {0, 4}), (codes, [text for code, text in found if code == 1])
    if layout == "killed":
        assert all(without_path(text, tmp_path / "x") == right for code, text in found if code == 0)


@pytest.mark.parametrize("damage", DAMAGES)
def test_what_is_read_of_a_partial_archive_is_as_it_was(
    samples: dict[str, Path], tmp_path: Path, damage: Damage
) -> None:
    """However it was damaged: every group that is there, and others are named, but for the last ones."""
    content = samples["partial"].read_bytes()
    whole = find_pieces(content)
    right = {place: content[start:stop] for place, (start, stop) in whole.places.items()}
    for seed in range(20):
        damaged_copy(samples["partial"], tmp_path / "a", damage, np.random.default_rng(seed))
        spoilt = (tmp_path / "a").read_bytes()
        found = find_pieces(spoilt)
        assert all(spoilt[start:stop] == right[place] for place, (start, stop) in found.places.items())
        lost = [place for place in right if place not in found.places]
        assert found.damage or list(right)[len(right) - len(lost) :] == lost


# only what has no seal is not refused at once, so that each of them counts there; of the others, every fifth
@pytest.mark.parametrize(
    ("layout", "craft"),
    [
        pytest.param(layout, craft, marks=[pytest.mark.slow] * (layout != "killed" and i % 5 != first))
        for first, layout in enumerate(("whole", "killed", "old"))
        for i, craft in enumerate(CRAFTS)
    ],
)
def test_crafted_archives_are_refused(samples: dict[str, Path], tmp_path: Path, layout: str, craft: Craft) -> None:
    """In a complete archive all of them, as the seal does not fit; elsewhere, what an archive cannot contain."""
    sample = samples[layout]
    found = outcomes(sample, tmp_path, lambda path, random: crafted_copy(sample, path, craft, random), range(1))
    codes = {code for code, _ in found}
    assert codes <= ({4} if layout == "whole" else {0, 4}), [text for code, text in found if code not in (0, 4)]


@pytest.mark.slow
def test_a_page_of_zeros_is_noticed(samples: dict[str, Path], tmp_path: Path) -> None:
    content = samples["whole"].read_bytes()
    pages = [page for page in range(-(-len(content) // PAGE)) if any(content[page * PAGE : (page + 1) * PAGE])]
    pages = pages[:: -(-len(pages) // 16)]  # the study of a thousand mutants has them all
    numbers = iter(pages)

    def spoil(path: Path, random: Random) -> None:
        path.write_bytes(zero_page(bytearray(content), next(numbers)))

    assert {code for code, _ in outcomes(samples["whole"], tmp_path, spoil, range(len(pages)))} == {4}


def test_intact_groups_of_a_damaged_archive_are_shown(samples: dict[str, Path], tmp_path: Path) -> None:
    """A bit of a history in chunks flips: the other analyses are printed, and every table says which one is not."""
    path = tmp_path / "a.h5"
    content = bytearray(samples["whole"].read_bytes())
    with h5py.File(samples["whole"]) as file:
        place = file["analyses/long/displacement"].id.get_chunk_info(0).byte_offset
    content[place + 100] ^= 1
    path.write_bytes(content)
    with pytest.raises(DamagedArchive, match="it is not as it was written(.|\\n)*E-ARCH-03"):
        open_archive(path)
    with open_archive(path, damaged=True) as archive:
        assert archive.names("analyses") == ["modes", "a", "b"] and list(archive.damage) == ["analyses/long"]
        assert archive.damage["analyses/long"].startswith("`displacement`: HDF5 says: ")
        with pytest.raises(DamagedArchive, match="analyses/long: `displacement`.*E-ARCH-03"):
            archive.group("analyses/long")
        np.testing.assert_equal(
            archive.group("analyses/a").variables["storey_drift_max"].values,
            known_history().variables["storey_drift_max"].values,
        )
    ended = command(["show", str(path)])
    assert ended.code == 4 and "6 of 7 groups can be read" in ended.output and "0.8000" in ended.output
    assert "completed, 1 damaged" in ended.output
    assert "The archive is damaged" in ended.errors and "analyses/long: `displacement`" in ended.errors
    page = tmp_path / "a.html"
    ended = command(["report", "--quiet", str(path)], limit=30)
    assert ended.code == 4 and says(ended.errors, f"{page} E-ARCH-03") and ended.errors.count("E-ARCH-03") == 1
    assert "The archive is damaged" in page.read_text(encoding="utf-8")


def test_numbers_of_a_chunk_of_zeros_are_not_taken_for_right(samples: dict[str, Path], tmp_path: Path) -> None:
    """Fletcher's checksum of zeros is zero; but zeros are no stream of deflate."""
    path = tmp_path / "killed.h5.partial"
    content = bytearray(samples["killed"].read_bytes())
    with h5py.File(samples["killed"]) as file:
        chunk = file["analyses/long/displacement"].id.get_chunk_info(0)
    content[chunk.byte_offset : chunk.byte_offset + chunk.size] = bytes(chunk.size)
    path.write_bytes(content)
    with h5py.File(path) as file, pytest.raises(OSError, match="filter returned failure"):
        file["analyses/long/displacement"][:100]
    with pytest.raises(ArchiveError, match=r"analyses/long: .*filter returned failure(.|\n)*E-ARCH-03"):
        open_archive(path)


def test_a_promise_of_24_gigabytes_takes_no_memory(samples: dict[str, Path], tmp_path: Path) -> None:
    """The fork may take 1 GB, and nothing of 24 GB is on the disk."""
    for seed in range(2):
        path = tmp_path / "killed.h5.partial"
        crafted_copy(samples["killed"], path, huge_data, np.random.default_rng(seed))
        ended = command(["show", str(path)])
        assert ended.code == 4 and "24000000000 bytes of values" in ended.errors


def test_data_takes_no_more_than_the_file_can_hold(samples: dict[str, Path], tmp_path: Path) -> None:
    """Chunks that all lie at one place, as a file could name them, and groups that share data."""
    assert max(EXPANSION.values()) == 1032  # of deflate at most, by zlib's own description; no other filter compresses
    path = tmp_path / "killed.h5.partial"
    path.write_bytes(samples["killed"].read_bytes())
    with h5py.File(path, "r+") as file:
        for number in range(30):
            file[f"analyses/a/copy_{number}"] = file["analyses/long/displacement"]
    ended = command(["show", str(path)])
    assert ended.code == 4 and "a second name of analyses/a" in ended.errors


@pytest.mark.skipif(not HANDED.is_file(), reason="no folder of cases beside the repository")
def test_a_page_of_zeros_in_the_heap_of_texts(tmp_path: Path) -> None:
    """An archive of layout 1 that HDF5 reads without end; its record and five other groups are whole."""
    ended = command(["show", str(HANDED), "--all"], limit=10)
    assert ended.code == 4 and "5 of 6 groups can be read" in ended.output and "0.278" in ended.output
    assert command(["report", "--quiet", str(HANDED), "--output", str(tmp_path / "a.html")], limit=30).code == 4


def test_collections_of_the_heap_end_where_they_say(samples: dict[str, Path]) -> None:
    """The chain of objects of each: as the library wrote it, with a free object of size zero, and cut off."""
    content = samples["old"].read_bytes()
    assert content.count(SIGNATURE) >= 2 and without_broken_collections(content) == content
    place = content.find(SIGNATURE)
    free = content[: place + 64] + bytes(448) + content[place + 512 :]
    cut = content[: place + 20]
    for broken in (free, cut):
        mended = without_broken_collections(broken)
        assert mended == broken[:place] + bytes(len(SIGNATURE)) + broken[place + len(SIGNATURE) :]


def test_an_archive_of_layout_1_is_read_as_it_was(samples: dict[str, Path]) -> None:
    with open_archive(samples["old"]) as archive:
        assert archive.complete and archive.names("analyses") == ["modes", "a", "b", "long"]
        for place, group in sample_groups().items():
            read = archive.group(place)
            found = {**read.coords, **read.variables}
            for name, variable in {**group.coords, **group.variables}.items():
                assert (found[name].dims, found[name].unit) == (variable.dims, variable.unit)
                np.testing.assert_array_equal(found[name].values, variable.values)
                assert found[name].values.dtype.kind == variable.values.dtype.kind
            for name, value in group.attributes.items():
                np.testing.assert_equal(read.attributes[name], value)


def test_a_change_by_another_program_is_damage(samples: dict[str, Path], tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    path.write_bytes(samples["whole"].read_bytes())
    with h5py.File(path, "r+") as file:
        file["analyses/a"].attrs["status"] = "failed"
    with open_archive(path, damaged=True) as archive:
        assert list(archive.damage) == ["analyses/a"] and "its seal does not fit" in archive.damage_in_short()


def test_the_mark_of_layout_1_does_not_spare_a_group_its_checksum(samples: dict[str, Path], tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    path.write_bytes(samples["whole"].read_bytes())
    with h5py.File(path, "r+") as file:
        file.attrs["edesign_archive"] = 1
    with open_archive(path, damaged=True) as archive:
        assert "the checksum differs" in archive.damage[""]
