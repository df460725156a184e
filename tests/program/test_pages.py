"""Lines of a page are looked up one by one, then taken apart; both give what splitting the text gives."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from polycnc.program.pages import Page, ended

LINES = st.lists(st.sampled_from(("", "G1", "N10 G1 X1.5", "(程)", "\x00M5", " ")), min_size=1, max_size=300)


def page(lines: list[str]) -> Page:
    return Page("".join(f"{line}\n" for line in lines).encode(), len(lines))


@given(LINES, st.lists(st.integers(0, 10**6), max_size=200))
def test_lines_asked_for_in_any_order_are_those_of_the_text(lines: list[str], asked: list[int]) -> None:
    read = [line.replace("\x00", "") for line in lines]
    looked_up = page(lines)
    for number in asked:
        assert looked_up.line(number % len(lines)) == read[number % len(lines)]


@given(LINES, st.data())
def test_stretches_are_those_of_the_text(lines: list[str], data: st.DataObject) -> None:
    read = [line.replace("\x00", "") for line in lines]
    looked_up = page(lines)
    for _ in range(3):
        first = data.draw(st.integers(0, len(lines) - 1))
        end = data.draw(st.integers(first + 1, len(lines)))
        assert list(looked_up.lines(first, end)) == read[first:end]
        start, behind = looked_up.places_of(first, end)
        found = looked_up.text[start:behind]
        assert found == "".join(f"{line}\n" for line in lines[first:end]).encode()


def test_a_page_of_which_little_is_asked_is_not_taken_apart() -> None:
    looked_up = page([f"N{i}" for i in range(10_000)])
    for number in (0, 1, 2, 9_999, 9_998, 5_000, 5_001):
        assert looked_up.line(number) == f"N{number}"
    assert looked_up._lines is None
    assert list(looked_up.lines(0, 10_000))[-1] == "N9999"
    assert looked_up._lines is not None


def test_nothing_behind_the_last_line_end_is_no_line() -> None:
    assert [ended(text) for text in (b"", b"\x1a", b"G1\n", b"G1\n\x1a", b"G1")] == [
        b"", b"", b"G1\n", b"G1\n", b"G1\n",
    ]  # fmt: skip
