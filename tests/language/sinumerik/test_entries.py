"""A program that is entered at many places costs as much as its blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.language.expressions.joined import MOST_JOINS
from polycnc.language.sinumerik.joining import Joiner
from polycnc.session import open_session

if TYPE_CHECKING:
    import pytest

    from polycnc.channel.steps import Step
    from polycnc.language.expressions.shapes import Shapes

SECTIONS = 60


def test_no_block_is_joined_again_and_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every REPEAT begins one section later, and runs to the same label."""
    joined: list[int] = []
    step = Joiner.step

    def counted(joiner: Joiner, shapes: Shapes) -> Step | None:
        made = step(joiner, shapes)
        joined.append(joiner.count)
        return made

    monkeypatch.setattr(Joiner, "step", counted)
    text = "R1=0\nGOTOF MAIN\n"
    text += "".join(f"PART{k}: R1=R1+1\nR2=R1*0.5\nG0 X=R2 Y={k}\n" for k in range(SECTIONS))
    text += "LAST: R3=0\nGOTOF FIN\nMAIN: R3=1\n"
    text += "".join(f"REPEAT PART{k} LAST\n" for k in range(SECTIONS)) + "FIN: M30\n"
    session = open_session(text, control="sinumerik-840d")
    result = session.run()
    assert result.ok
    assert result.variables["R1"] == SECTIONS * (SECTIONS + 1) / 2
    assert sum(joined) < (MOST_JOINS + 2) * len(text.splitlines())
