"""A program that is entered at many places costs as much as its blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.language.expressions.joined import MAX_JOINED
from polycnc.language.word_address import executable, joining
from polycnc.session import open_session

if TYPE_CHECKING:
    import pytest

    from polycnc.channel.steps import Step
    from polycnc.language.expressions.shapes import Shapes


def joined_lines(calls: int, monkeypatch: pytest.MonkeyPatch) -> tuple[int, int]:
    """Lines that are joined in a program with so many M98 Q, each of which enters one section later; its blocks."""
    lines: list[int] = []
    join = joining.join

    def counted(shapes: Shapes, stretch: list[tuple[int, Step]]) -> Step:
        lines.append(len(stretch))
        return join(shapes, stretch)

    monkeypatch.setattr(executable, "join", counted)
    text = "O1\nG21 G90 G94 F500.\n#1=0\n"
    text += "".join(f"M98 Q{1000 + k}\n" for k in range(calls)) + "M30\n"
    text += "".join(f"N{1000 + k} #1=#1+1\n#2=#1*0.5\nG1 X#2 Y{k}.\n" for k in range(calls)) + "M99\n"
    session = open_session(text, control="fanuc-m")
    result = session.run()
    assert result.ok
    assert result.variables["#1"] == calls * (calls + 1) / 2
    return sum(lines), session.channel.blocks


def test_what_is_joined_grows_with_the_entries_and_not_with_their_square(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines, blocks = joined_lines(100, monkeypatch)
    assert blocks > 15_000
    assert lines < 100 * MAX_JOINED
