"""How far a single move has come after a time: for a signal that comes by the clock, in a run without one."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import piece_width
from polycnc.motion.planner import Planner
from polycnc.toolpath import Kind, Toolpath
from polycnc.toolpath.kinds import NO_CURVE

if TYPE_CHECKING:
    from array import array

    from polycnc.channel.channel import Channel
    from polycnc.motion.sampling.run import Run


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

    toolpath = Toolpath(channel.axes)
    context = channel.control.context(channel)
    toolpath.append(Kind.SKIP, 0, 1, toolpath.context_number(context), feed, end)
    run = _run(channel, toolpath, channel.coordinates.position)
    if run is None or seconds >= run.seconds:
        return None
    axis = run.main_axis
    begin, place = float(run.start[axis]), float(run.at(np.array([seconds]))[0][0, axis])
    return (place - begin) / (float(run.end[axis]) - begin)


def later_on_row(
    channel: Channel, mark: int, start: list[float], share: float, seconds: float
) -> tuple[float | None, float]:
    """What comes some time after a share of the row that the running block has made.

    The row counts as a move from rest to rest, whatever stands in front of it and behind it.

    Args:
        channel: Its toolpath has the row.
        mark: Number of the row within the chunk.
        start: Where the row begins, absolute display, internal units.
        share: From where on its way the time counts.
        seconds: The time.

    Returns:
        The share that is done then, None where the row is over by then, and the seconds that are left at its end.
    """
    row = channel.toolpath.row_of(channel.toolpath.chunk, mark)
    toolpath = Toolpath(channel.axes)
    curve = toolpath.add_curve(*row.curve) if row.curve else NO_CURVE
    number = toolpath.context_number(row.context)
    toolpath.append(row.kind, 0, 1, number, row.feed, list(row.end), curve)
    run = _run(channel, toolpath, start)
    if run is None:
        return None, seconds
    then = run.time_of(share) + seconds if share > 0.0 else seconds
    return (run.share_at(then), 0.0) if then < run.seconds else (None, then - run.seconds)


def _run(channel: Channel, toolpath: Toolpath, begin: list[float]) -> Run | None:
    """The planned run of the rows of a toolpath, which begin at a position of the display; None without a way."""
    import numpy as np

    from polycnc.motion.sampling.run import Run

    c, n = channel.coordinates, len(channel.axes)
    start = [value + offset for value, offset in zip(c.image(c.zero, begin), c.offsets, strict=True)]
    found: list[float] = []

    def keep(records: array[float], count: int) -> None:
        found.extend(records[: count * piece_width(n)])

    settings = channel.control.motion_settings(channel)
    planner = Planner(
        toolpath, channel.machine, channel=channel.number, start=start, settings=settings, on_pieces=keep
    )
    planner.finish()
    if not found:
        return None
    pieces = np.array(found).reshape(-1, piece_width(n))
    return Run(pieces, n, planner.rapids_of(pieces[0], toolpath.contexts[-1]))
