"""The transaction file against a plain bytearray, and its promise: the disk holds a commit or the one before it."""

from __future__ import annotations

import io
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.archive import transaction
from edesign.archive.transaction import TransactionFile

operations = st.lists(
    st.one_of(
        st.tuples(st.just("write"), st.integers(0, 200), st.binary(min_size=1, max_size=90)),
        st.tuples(st.just("truncate"), st.integers(0, 250), st.just(b"")),
        st.tuples(st.just("commit"), st.just(0), st.just(b"")),
    ),
    max_size=25,
)


@given(operations)
@settings(max_examples=60, deadline=None)
def test_behaves_like_a_file_in_memory(steps: list[tuple[str, int, bytes]]) -> None:
    old_page, transaction.PAGE = transaction.PAGE, 32  # many page borders in a small file
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "f"
            file, model, committed = TransactionFile(path), io.BytesIO(), b""
            for kind, number, content in steps:
                if kind == "write":
                    file.seek(number)
                    model.seek(number)
                    file.write(content)
                    model.write(content)
                elif kind == "truncate":
                    file.truncate(number)
                    size = len(model.getvalue())
                    model.truncate(number)
                    if number > size:
                        model.seek(size)
                        model.write(bytes(number - size))
                else:
                    file.commit()
                    committed = model.getvalue()
                assert path.read_bytes() == committed
                seen = bytearray(400)
                file.seek(0)
                count = file.readinto(memoryview(seen))
                assert bytes(seen[:count]) == model.getvalue()
            file.close()
    finally:
        transaction.PAGE = old_page


def test_a_failed_commit_leaves_the_last_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "f"
    file = TransactionFile(path)
    file.write(b"a" * 100_000)
    file.commit()
    file.seek(0)
    file.write(b"b" * 300_000)
    real, calls = transaction.os.pwrite, []

    def fails_on_second_call(descriptor: int, data: bytes, offset: int) -> int:
        calls.append(offset)
        if len(calls) == 2:
            raise OSError(28, "No space left on device")
        return real(descriptor, data, offset)

    monkeypatch.setattr(transaction.os, "pwrite", fails_on_second_call)
    with pytest.raises(OSError, match="No space"):
        file.commit()
    file.close()
    assert min(calls) >= 100_000  # nothing committed was touched
    assert path.read_bytes() == b"a" * 100_000


def test_two_writers_exclude_each_other(tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    first = TransactionFile(tmp_path / "f")
    with pytest.raises(BlockingIOError):
        TransactionFile(tmp_path / "f")
    first.close()
    TransactionFile(tmp_path / "f").close()
