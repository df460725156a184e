"""Large files are read in pages; what comes of it is what comes of reading them as a whole."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from polycnc.program import Form, ProgramFileError, load_programs, long_text
from polycnc.program.long_text import LongText, read_long
from polycnc.program.text import split_lines

PIECES = (
    b"%\n", b"O0001\n", b"N10 G1 X1.\n", b"\n", b" G1\n", b"(\xe7\xa8\x8b)\n", b"(\xb5{\xa6\xa1)\n", b"G1 X2.\r\n",
    b"X3.\x00\n", b"\x7f\x7f", b"<NAME>\n", b":0003\n", b"%_N_TEST_MPF\n", b";$PATH=/_N_WKS_DIR\n", b"M30",
    b"X1 Y2 Z3\r", b"%@MACRO\n", b"\t%\n", b"\xff\n", b"o5 (low)\n", b"\xef\xbb\xbf", b"%O0002 X5\n",
)  # fmt: skip


def told(path: Path, form: Form) -> list[Any]:
    return [
        (each.name, list(each.lines), each.number, each.first_line, each.form, each.encoding, each.replaced)
        for each in load_programs(str(path), default=form)
    ]


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(st.sampled_from(PIECES), max_size=25).map(b"".join),
    st.integers(2, 60),
    st.sampled_from((Form.WORD_ADDRESS, Form.SINUMERIK)),
    st.sampled_from((0, 1024)),
)
def test_pages_give_the_programs_that_the_whole_file_gives(
    tmp_path: Path, content: bytes, page: int, form: Form, kept: int
) -> None:
    path = tmp_path / "part.nc"
    path.write_bytes(content)
    whole = told(path, form)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(long_text, "LONG_FILE_BYTES", 0)
        patch.setattr(long_text, "PAGE_BYTES", page)
        patch.setattr(long_text, "KEPT_FILE_BYTES", kept)
        patch.setattr(long_text, "MAX_LINE", min(page - 1, 40))
        try:
            assert told(path, form) == whole
        except ProgramFileError as error:
            assert error.message == "program.line-too-long"  # noqa: PT017 - pages smaller than lines
            assert max(map(len, content.split(b"\n"))) > min(page - 1, 40)


def long(path: Path, lines: list[str], monkeypatch: pytest.MonkeyPatch, *, kept: int = 0) -> LongText:
    monkeypatch.setattr(long_text, "LONG_FILE_BYTES", 0)
    monkeypatch.setattr(long_text, "KEPT_FILE_BYTES", kept)
    monkeypatch.setattr(long_text, "PAGE_BYTES", 64)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    found = read_long(str(path))
    assert found is not None
    return found


def test_lines_slices_and_bytes_are_those_of_a_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = [f"N{i} G1 X{i}.5 (程{i})" for i in range(200)]
    monkeypatch.setattr(long_text, "MAX_LINE", 60)
    text = long(tmp_path / "part.nc", lines, monkeypatch)
    part, same = text[3:150], lines[3:150]
    assert list(text) == lines
    assert [part[i] for i in range(-147, 147)] == [same[i] for i in range(-147, 147)]
    assert list(part[::7]) == same[::7]
    for i in range(147):
        found, start, end = part.text_from(i)  # type: ignore[attr-defined]
        read = found[start:end].decode().split("\n")[:-1]
        assert read
        assert read == same[i : i + len(read)]
    with pytest.raises(IndexError):
        part[147]


def test_a_line_too_long_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(long_text, "MAX_LINE", 30)
    with pytest.raises(ProgramFileError) as error:
        long(tmp_path / "part.nc", ["G1 X1."] * 20 + ["G1 " + "X" * 40, "M30"], monkeypatch)
    assert error.value.args_by_name["line"] == 21


def test_a_file_that_shrinks_is_no_traceback(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "part.nc"
    monkeypatch.setattr(long_text, "MAX_LINE", 60)
    text = long(path, ["G1 X1."] * 100, monkeypatch)
    path.write_text("G1", encoding="ascii")
    with pytest.raises(ProgramFileError):
        text[99]


def test_a_file_that_is_kept_stays_as_it_was_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = [f"N{i} G1 X{i}." for i in range(100)]
    text = long(tmp_path / "part.nc", lines, monkeypatch, kept=1 << 20)
    (tmp_path / "part.nc").write_text("G1", encoding="ascii")
    assert list(text) == lines
    assert len(text.file.places) == 2  # one page


def test_characters_of_a_line_count_not_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(long_text, "LONG_FILE_BYTES", 0)
    path = tmp_path / "part.nc"
    path.write_text("G1\n(" + "程" * 40_000 + ")\nM30\n", encoding="utf-8")
    (program,) = load_programs(str(path))
    assert len(program.lines) == 3


def test_the_first_line_that_is_too_long_is_told() -> None:
    with pytest.raises(ProgramFileError, match="line 2 is longer than 65536 characters"):
        split_lines("G0\n" + "X" * 70_000 + "\n" + "Y" * 80_000 + "\n", "long.nc")


LINES = st.lists(
    st.sampled_from(["", " ", "G1", " G1", ";", "$1", "X$2", "\t;", "\x7f;", "(程)"]), min_size=1, max_size=20
)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(LINES, st.data())
def test_lines_are_found_page_by_page(tmp_path: Path, lines: list[str], data: st.DataObject) -> None:
    def is_meant(line: str) -> bool:
        return "G" in line

    with pytest.MonkeyPatch.context() as patch:
        text = long(tmp_path / "part.nc", lines, patch)
        first = data.draw(st.integers(0, len(text) - 1))
        part = text[first : data.draw(st.integers(first + 1, len(text)))]
        assert isinstance(part, LongText)
        if data.draw(st.booleans()):
            part = part.with_first("$9")
        read = list(part)
        assert list(part.holding("$")) == [i for i, line in enumerate(read) if "$" in line]
        blocks = [i for i, line in enumerate(read) if line[:1] not in " ;\t" or is_meant(line)]
        assert [i for run in part.not_beginning(" ;\t", is_meant) for i in run] == blocks
