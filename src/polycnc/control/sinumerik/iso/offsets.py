"""Offsets of the tool in the ISO dialect: G43, G49 with H, and D.

An edge of the control has lengths and a radius in one: H and D are the D number of the tool in the spindle, and must
be the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord


def select(running: IsoRun, word: IsoWord) -> None:
    """G43: the lengths that H names act; PC0001 without H where none has been named."""
    if not running.state.length and running.block.find("H") is None:
        raise running.refused(word)
    running.state.length = True


def cancel(running: IsoRun, _word: IsoWord) -> None:
    """G49: no length acts."""
    running.state.length = False
    running.extra.append("D0")


def check(running: IsoRun) -> None:
    """H where G43 acts, and D, which must be of the same number; PC0001 else."""
    length, radius = running.take("H"), running.take("D")
    active = running.channel.memory.tools.edge_number
    if length is not None:
        if not running.state.length or not length.value.is_integer():
            raise running.refused(length)
        active = int(length.value)
        running.extra.append(f"D{active}")
    if radius is not None and radius.value != active:
        raise running.refused(radius)
