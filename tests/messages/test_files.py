"""Why a file cannot be used is told in words of polycnc, in both languages."""

from __future__ import annotations

import errno
import os
import tracemalloc
from typing import TYPE_CHECKING

import pytest

from polycnc.messages.catalogue import messages, set_language
from polycnc.messages.files import read_regular, read_utf_8, reason_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture
def chinese() -> Iterator[None]:
    set_language("zh-TW")
    yield
    set_language("en")


def test_a_byte_order_mark_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_bytes(b"\xef\xbb\xbfstart: {}\r\n")
    assert read_utf_8(path) == "start: {}\n"


def test_a_device_without_an_end_is_not_read() -> None:
    with pytest.raises(OSError, match="/dev/zero") as refused:
        read_utf_8("/dev/zero")
    assert reason_of(refused.value) == "it is a device or a pipe, no file"


def test_a_directory_is_called_one(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=tmp_path.name) as refused:
        read_utf_8(tmp_path)
    assert reason_of(refused.value) == "it is a directory"


@pytest.mark.usefixtures("chinese")
def test_text_in_another_encoding_says_what_to_do(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_bytes("刀具".encode("big5"))
    with pytest.raises(UnicodeError) as refused:
        read_utf_8(path)
    assert reason_of(refused.value) == "不是 UTF-8 文字檔；請另存為 UTF-8"


def test_a_rare_reason_is_told_in_the_words_of_the_system() -> None:
    assert reason_of(OSError(errno.EDOM, os.strerror(errno.EDOM))) == os.strerror(errno.EDOM)


def test_every_reason_is_named_as_the_system_names_it() -> None:
    named = {key.removeprefix("reason.") for key in messages() if key.startswith("reason.")}
    assert named - {"not-utf-8"} <= set(errno.errorcode.values())


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows")
def test_a_pipe_that_nobody_writes_to_is_not_waited_for(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    with pytest.raises(OSError, match="pipe") as refused:
        read_regular(path)
    assert reason_of(refused.value) == "it is a device or a pipe, no file"


def test_what_looks_like_a_file_and_waits_is_not_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "kmsg").touch()
    ends = os.pipe()
    monkeypatch.setattr(os, "open", lambda _path, flags: _reading(ends[0], flags))
    with pytest.raises(BlockingIOError) as refused:
        read_regular(tmp_path / "kmsg")
    assert reason_of(refused.value) == "nothing can be read from it now"
    os.close(ends[1])


def _reading(handle: int, flags: int) -> int:
    os.set_blocking(handle, not flags & os.O_NONBLOCK)
    return handle


def test_at_most_so_many_bytes_are_read(tmp_path: Path) -> None:
    path = tmp_path / "long"
    path.write_bytes(b"12345")
    assert read_regular(path, 3) == b"123"
    assert read_regular(path) == b"12345"


def test_no_more_memory_is_asked_for_than_a_file_has_bytes(tmp_path: Path) -> None:
    """What Python is asked to read it takes memory for: two gigabytes, for a program of a few lines."""
    path = tmp_path / "short"
    path.write_bytes(b"12345")
    tracemalloc.start()
    try:
        assert read_regular(path, 2 << 30) == b"12345"
        assert tracemalloc.get_traced_memory()[1] < 1 << 20
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("length", [4095, 4096, 4097, 20_000])
def test_what_does_not_say_its_size_is_read_to_its_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, length: int
) -> None:
    path = tmp_path / "unknown"
    path.write_bytes(bytes(length))
    empty, stat = tmp_path / "empty", os.stat
    empty.touch()
    monkeypatch.setattr(os, "stat", lambda asked, **named: stat(empty if asked == path else asked, **named))
    assert len(read_regular(path, 1 << 30)) == length
    assert len(read_regular(path, length - 1)) == length - 1
