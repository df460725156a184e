"""How far a single move has come after a time: for a signal that comes by the clock, in a run without one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.motion.kernels.columns import piece_width
from polycnc.motion.planner import Planner
from polycnc.toolpath import Kind, Toolpath

if TYPE_CHECKING:
    from array import array

    from polycnc.channel.channel import Channel
    from polycnc.control.interface import Control


def share_after(channel: Channel, end: list[float], feed: float, seconds: float) -> float | None:
    """The share of a skip move from where the channel stands that is done after a time; None if all of it is.

    Skip moves begin and end at rest, so that the time depends on nothing before them.

    Args:
        channel: Its position, context and feed mode hold.
        end: End of the move, absolute display, internal units.
        feed: Feed of the row, in the unit of its mode.
        seconds: From the start of the motion.
    """
    import numpy as np

    from polycnc.motion.sampling.run import Run

    control: Control = channel.control
    c = channel.coordinates
    toolpath = Toolpath(channel.axes)
    context = control.context(channel)
    toolpath.append(Kind.SKIP, 0, 1, toolpath.context_number(context), feed, end)
    start = [value + offset for value, offset in zip(c.image(c.zero, c.position), c.offsets, strict=True)]
    settings, n = control.motion_settings(channel), len(channel.axes)
    found: list[float] = []

    def keep(records: array[float], count: int) -> None:
        found.extend(records[: count * piece_width(n)])

    Planner(
        toolpath, channel.machine, channel=channel.number, start=start, settings=settings, on_pieces=keep,
    ).finish()  # fmt: skip
    if not found:
        return None
    pieces = np.array(found).reshape(-1, piece_width(n))
    run = Run(pieces, n)
    if seconds >= run.seconds:
        return None
    axis = run.main_axis
    place = float(run.at(np.array([seconds]))[0][0, axis])
    return (place - start[axis]) / (float(run.end[axis]) - start[axis])
